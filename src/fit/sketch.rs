//! What limits would cost a law, to first order: for ranking thousands of candidates.
//!
//! [`super::limits::apply`] works on the spline that is delivered and comes back until every bound is kept between its samples too.
//! Here each bound is put on the samples once. Whatever wins is judged by `apply` in the end.

use std::f64::consts::TAU;

use super::limits::{Limits, bound_torque};
use super::lipschitz::{between, envelope};
use crate::gear::Gearing;
use crate::pitch::center_distance;

/// The bounds of a pair, ready to be put on laws of one length.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sketch {
    ratio: f64,
    /// Change of ln r_D from sample to sample at most.
    rise: f64,
    most: Option<f64>,
}

/// What bounds leave of a law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sketched {
    /// Change of shape, in the measure of E_s.
    pub(super) shape: f64,
    /// Greatest psi'.
    pub(super) torque: f64,
}

impl Sketch {
    /// For laws of `samples` over one period of a pair with these driver and follower folds. The bound on curvature is left out.
    pub(super) fn new(folds: (u32, u32), limits: &Limits, samples: usize) -> Self {
        let step = TAU / f64::from(folds.0) / samples as f64;
        Self {
            ratio: f64::from(folds.1) / f64::from(folds.0),
            rise: limits.max_lean.tan() * step,
            most: limits.max_derivative,
        }
    }

    /// What the bounds leave of a law that closes.
    pub(super) fn of(&self, law: &[f64]) -> Sketched {
        let next = law.iter().cycle().skip(1);
        // d ln r_D = d psi' / (psi' (1 + psi')).
        let leans = law.iter().zip(next).any(|(a, b)| {
            let middle = 0.5 * (a + b);
            (b - a).abs() > self.rise * middle * (1.0 + middle)
        });
        let mut bounded = if leans { Some(self.bound_lean(law)) } else { None };
        let greatest = |law: &[f64]| law.iter().copied().fold(0.0, f64::max);
        let mut torque = greatest(bounded.as_deref().unwrap_or(law));
        if let Some(most) = self.most.filter(|most| torque > *most) {
            let held = bound_torque(bounded.as_deref().unwrap_or(law), most);
            torque = greatest(&held);
            bounded = Some(held);
        }
        let shape = bounded.map_or(0.0, |b| {
            let change: f64 = b.iter().zip(law).map(|(a, b)| (a - b) * (a - b)).sum();
            4.0 * TAU * change / law.len() as f64
        });
        Sketched { shape, torque }
    }

    fn bound_lean(&self, law: &[f64]) -> Vec<f64> {
        let y: Vec<f64> =
            law.iter().map(|&p| Gearing::External.radii(1.0, p).driver.ln()).collect();
        let upper = envelope(&y, self.rise, 1.0);
        let lower = envelope(&y, self.rise, -1.0);
        let radii: Vec<f64> = between(&upper, &lower, law).iter().map(|y| y.exp()).collect();
        let l = center_distance(&radii, self.ratio);
        radii.iter().map(|r| r / (l - r)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::limits::apply;

    #[test]
    fn a_sketch_is_near_what_the_limits_cost() {
        let wave = |height: f64| -> Vec<f64> {
            let law = (0..512).map(|i| {
                let x = TAU * f64::from(i) / 512.0;
                (height * (x + 0.3).cos() + 0.5 * height * (3.0 * x).sin()).exp()
            });
            let law: Vec<f64> = law.collect();
            let mean = law.iter().sum::<f64>() / 512.0;
            law.iter().map(|p| p / mean).collect()
        };
        for (height, max_derivative) in [(0.2, None), (0.8, None), (0.8, Some(1.5)), (1.2, None)] {
            let limits = Limits { max_derivative, max_lean: 0.8, ..Limits::default() };
            let law = wave(height);
            let (_, cost) = apply(&law, (1, 1), &limits).unwrap();
            let sketched = Sketch::new((1, 1), &limits, 512).of(&law);
            let slack = 0.02 + 0.1 * cost.shape;
            assert!((sketched.shape - cost.shape).abs() < slack, "{height} {sketched:?} {cost:?}");
            let apart = (sketched.torque / cost.derivative.1 - 1.0).abs();
            assert!(apart < 0.05, "{height} {sketched:?} {cost:?}");
            assert_eq!(sketched.shape == 0.0, height == 0.2);
        }
    }
}
