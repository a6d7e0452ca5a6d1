//! Bounds on the blended law that keep the pair drivable, at the least change found.
//!
//! Working on y = ln r_D, the driver's pitch curve, makes closing harmless: Eq. 9 closes the pair by
//! scaling r_D, and the lean, d y / d phi, does not see a scale. In order:
//! 1. lean: y between its upper and lower Lipschitz envelopes, lightly smoothed;
//! 2. curvature: a blur of y where a pitch curve bends too sharply, and only there;
//! 3. torque: Eq. 16 with the rescaling solved for, so that the bound survives it.
//!
//! The bounds on lean and torque are checked on the spline that is delivered, between samples too. What rounding of corners leaves
//! over the bounds is taken away by drawing psi' towards its mean, which reaches every bound in the end.

use std::f64::consts::TAU;

use super::lipschitz::{between, envelope, smoothed};
use crate::gear::Gearing;
use crate::geometry::solve_cyclic;
use crate::pitch::{Centrodes, Transmission, TransmissionError, center_distance};
use crate::policy;

/// Bounds on a law psi'.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Greatest psi', the driver's torque over the follower's (Eq. 16); none by default.
    pub max_derivative: Option<f64>,
    /// Greatest angle between pitch normal and radius, radians; 60 degrees by default.
    pub max_lean: f64,
    /// Greatest |curvature| of either pitch curve times the driver's perimeter; none by default. Kept at the
    /// samples, and between them to within the spline's own ripple; [`LimitCost::curvature`] says what came out.
    pub max_curvature: Option<f64>,
}

impl Default for Limits {
    fn default() -> Self {
        Self { max_derivative: None, max_lean: policy::DEFAULT_MAX_LEAN, max_curvature: None }
    }
}

/// What the limits changed.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct LimitCost {
    /// Change of shape in the measure of Eq. 12: 4 times the integral of (change of psi')^2 over the driver's turn. Added to
    /// Delta it is what Eq. 12 would give for gears drawn to the limited law (at equal balance).
    pub shape: f64,
    /// Greatest lean before and after, radians.
    pub lean: (f64, f64),
    /// Greatest psi' before and after.
    pub derivative: (f64, f64),
    /// Greatest |curvature| times the driver's perimeter before and after.
    pub curvature: (f64, f64),
}

/// Why limits cannot be kept.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LimitError {
    /// The torque bound lies below the mean of psi'.
    #[error(
        "psi' cannot stay below {bound}: its mean is {mean:.4}; allow at least {mean:.4}, or a larger ratio"
    )]
    TorqueBelowMean {
        /// Bound asked for.
        bound: f64,
        /// Mean of psi', 1/K.
        mean: f64,
    },
    /// The lean bound is not an angle between 0 and 90 degrees.
    #[error("a lean bound of {degrees:.2} degrees has no meaning; give one above 0 and below 90")]
    LeanOutOfRange {
        /// Bound asked for, degrees.
        degrees: f64,
    },
    /// Even a pair of circles bends more.
    #[error(
        "even circles bend by {least:.3} in units of the driver's perimeter; allow a curvature above that"
    )]
    CurvatureBelowCircle {
        /// The circles' curvature times the driver's perimeter.
        least: f64,
    },
    /// The samples are no law.
    #[error(transparent)]
    Transmission(#[from] TransmissionError),
}

/// Greatest psi', lean and relative curvature of a law, as delivered.
#[derive(Clone, Copy, Debug)]
struct Extremes {
    derivative: f64,
    lean: f64,
    curvature: f64,
}

impl Extremes {
    fn of(transmission: Transmission, with_curvature: bool) -> Self {
        let derivative = transmission.max_derivative();
        let centrodes = Centrodes { transmission, center_distance: 1.0 };
        let n = 2 * centrodes.transmission.samples().len();
        let step = centrodes.transmission.driver_period() / n as f64;
        let mut curvature = 0.0_f64;
        let mut length = 0.0;
        if with_curvature {
            for i in 0..n {
                let (d, f) = centrodes.curvatures(i as f64 * step);
                curvature = curvature.max(d.abs()).max(f.abs());
                length += centrodes.arc_speed(i as f64 * step);
            }
            curvature *= length * step * f64::from(centrodes.transmission.driver_fold());
        }
        Self { derivative, lean: centrodes.max_lean(), curvature }
    }
}

/// The limits with the pair's folds, ready to be applied.
struct Task<'a> {
    limits: &'a Limits,
    folds: (u32, u32),
    ratio: f64,
}

/// Bounds `samples` of psi' (uniform over one period of a pair with these driver and follower folds) and closes them.
///
/// Samples that keep every bound come back unchanged but for the scale that closes them.
///
/// # Errors
/// See [`LimitError`].
pub fn apply(
    samples: &[f64],
    folds: (u32, u32),
    limits: &Limits,
) -> Result<(Vec<f64>, LimitCost), LimitError> {
    let ratio = f64::from(folds.1) / f64::from(folds.0);
    let task = Task { limits, folds, ratio };
    task.check()?;
    if samples.iter().any(|v| !(*v > 0.0 && v.is_finite())) {
        // The spline's own check says which sample is at fault.
        Transmission::from_derivative(samples, folds.0, folds.1)?;
    }
    let blend = closed(samples, 1.0 / ratio);
    let detailed = limits.max_curvature.is_some();
    // Only a spline that overshoots below zero fails here, and bounding the lean mends it.
    let before = task.extremes(&blend, detailed).unwrap_or(Extremes {
        derivative: blend.iter().copied().fold(0.0, f64::max),
        lean: TAU / 4.0,
        curvature: f64::INFINITY,
    });
    let (law, after) =
        if task.keeps(&before) { (blend.clone(), before) } else { task.bound(&blend, &before)? };
    let change: f64 = law.iter().zip(&blend).map(|(a, b)| (a - b) * (a - b)).sum();
    let cost = LimitCost {
        shape: 4.0 * TAU * change / law.len() as f64,
        lean: (before.lean, after.lean),
        derivative: (before.derivative, after.derivative),
        curvature: (before.curvature, after.curvature),
    };
    Ok((law, cost))
}

/// The samples scaled to the mean `mean`.
fn closed(samples: &[f64], mean: f64) -> Vec<f64> {
    let scale = mean * samples.len() as f64 / samples.iter().sum::<f64>();
    samples.iter().map(|v| v * scale).collect()
}

impl Task<'_> {
    fn check(&self) -> Result<(), LimitError> {
        let Limits { max_derivative, max_lean, max_curvature } = *self.limits;
        if !(max_lean > 0.0 && max_lean < TAU / 4.0) {
            return Err(LimitError::LeanOutOfRange { degrees: max_lean.to_degrees() });
        }
        let mean = 1.0 / self.ratio;
        if let Some(bound) = max_derivative
            && (bound < mean || bound.is_nan())
        {
            return Err(LimitError::TorqueBelowMean { bound, mean });
        }
        let least = TAU * (1.0 / self.ratio).max(1.0);
        match max_curvature {
            Some(bound) if bound <= least || bound.is_nan() => {
                Err(LimitError::CurvatureBelowCircle { least })
            }
            _ => Ok(()),
        }
    }

    fn extremes(&self, law: &[f64], with_curvature: bool) -> Option<Extremes> {
        let transmission = Transmission::from_derivative(law, self.folds.0, self.folds.1).ok()?;
        Some(Extremes::of(transmission, with_curvature))
    }

    fn keeps(&self, found: &Extremes) -> bool {
        let within = |value: f64, bound: Option<f64>| {
            bound.is_none_or(|b| value <= b * (1.0 + policy::LIMIT_ROUNDING))
        };
        within(found.lean, Some(self.limits.max_lean))
            && within(found.derivative, self.limits.max_derivative)
    }

    /// Repeats the three steps, each a little tighter by what the spline was found to exceed.
    fn bound(&self, blend: &[f64], before: &Extremes) -> Result<(Vec<f64>, Extremes), LimitError> {
        let detailed = self.limits.max_curvature.is_some();
        let slope = self.limits.max_lean.tan();
        let mut tight_slope = slope;
        let mut law = blend.to_vec();
        let mut lean_over = before.lean > self.limits.max_lean;
        for _ in 0..policy::LIMIT_ROUNDS {
            // Rounding is slow to find: what an earlier round reached is kept. The lean bound is quick and starts afresh.
            let mut bounded = if detailed { law.clone() } else { blend.to_vec() };
            if lean_over {
                bounded = self.bound_lean(&bounded, tight_slope);
            }
            if let Some(most) = self.limits.max_curvature {
                bounded = self.bound_curvature(&bounded, most);
            }
            if let Some(most) = self.limits.max_derivative {
                bounded = bound_torque(&bounded, most);
            }
            law = bounded;
            let Some(found) = self.extremes(&law, detailed) else {
                lean_over = true;
                tight_slope *= policy::LIMIT_TIGHTENING;
                continue;
            };
            if let Some(most) = self.limits.max_derivative {
                law = drawn_to_mean(
                    &law,
                    (most * self.ratio - 1.0) / (found.derivative * self.ratio - 1.0),
                );
            }
            if let Some(found) = self.extremes(&law, detailed)
                && self.keeps(&found)
            {
                return Ok((law, found));
            }
            if found.lean > self.limits.max_lean {
                lean_over = true;
                tight_slope *= (slope / found.lean.tan()).max(policy::LIMIT_LARGEST_STEP)
                    * policy::LIMIT_TIGHTENING;
            }
        }
        self.diffuse_until_kept(&law, detailed)
    }

    /// The least even diffusion of y that keeps the lean, drawn to the mean for the torque. Even diffusion never
    /// raises the lean and ends in circles.
    fn diffuse_until_kept(
        &self,
        law: &[f64],
        detailed: bool,
    ) -> Result<(Vec<f64>, Extremes), LimitError> {
        let n = law.len();
        let even = vec![1.0 / self.ratio; n];
        let circles = Transmission::from_derivative(&even, self.folds.0, self.folds.1)?;
        let mut best = (even, Extremes::of(circles, detailed));
        let y = log_radius(law);
        let (mut low, mut high) = (0.0, (n as f64).ln());
        for _ in 0..policy::LIMIT_BISECTIONS {
            let middle: f64 = 0.5 * (low + high);
            // From nothing to the whole turn, evenly in the logarithm of the reach.
            let reach = middle.exp_m1();
            let mut drawn = self.law_of(&diffused(&diffused(&y, reach * reach), reach * reach));
            if let (Some(most), Some(found)) =
                (self.limits.max_derivative, self.extremes(&drawn, false))
            {
                let factor = (most * self.ratio - 1.0) / (found.derivative * self.ratio - 1.0);
                drawn = drawn_to_mean(&drawn, factor);
            }
            match self.extremes(&drawn, detailed) {
                Some(found) if self.keeps(&found) => {
                    best = (drawn, found);
                    high = middle;
                }
                _ => low = middle,
            }
        }
        Ok(best)
    }

    /// psi' of the driver pitch curve exp(y), closed by Eq. 9.
    fn law_of(&self, y: &[f64]) -> Vec<f64> {
        let radii: Vec<f64> = y.iter().map(|v| v.exp()).collect();
        let l = center_distance(&radii, self.ratio);
        radii.iter().map(|r| r / (l - r)).collect()
    }

    fn step(&self, n: usize) -> f64 {
        TAU / f64::from(self.folds.0) / n as f64
    }

    fn bound_lean(&self, law: &[f64], slope: f64) -> Vec<f64> {
        let y = log_radius(law);
        let rise = slope * self.step(law.len());
        let upper = envelope(&y, rise, 1.0);
        let lower = envelope(&y, rise, -1.0);
        let mut y = between(&upper, &lower, law);
        for _ in 0..policy::LEAN_SMOOTHING_PASSES {
            y = smoothed(&y);
        }
        self.law_of(&y)
    }

    /// Blurs y where either pitch curve bends by more than `most` (times the driver's perimeter), and as
    /// little as will do: the width of the blur grows, round by round, about each place that is over.
    ///
    /// Every round blurs the given curve afresh, so nothing piles up; a round that still finds a place over
    /// after the last is delivered all the same, as a corner that no blur of a reasonable width rounds.
    fn bound_curvature(&self, law: &[f64], most: f64) -> Vec<f64> {
        let n = law.len();
        let y = log_radius(law);
        let mut widths = vec![policy::BLUR_LEAST; n];
        let mut law = law.to_vec();
        for _ in 0..policy::BLUR_ROUNDS {
            law = self.law_of(&blurred(&y, &widths));
            let (bend, length) = self.bends(&law);
            let mut wider = widths.clone();
            let mut any = false;
            for i in 0..n {
                let over = bend[i] * length / (most * (1.0 - policy::CURVATURE_RIPPLE));
                if over <= 1.0 {
                    continue;
                }
                any = true;
                let wanted =
                    widths[i] * over.sqrt().clamp(policy::BLUR_GROWTH.0, policy::BLUR_GROWTH.1);
                let wanted = wanted.min(policy::BLUR_MOST * n as f64);
                wider[i] = wider[i].max(wanted);
            }
            if !any {
                break;
            }
            // Widths that change gently bend nothing by themselves.
            wider = envelope(&wider, policy::BLUR_WIDTH_SLOPE, 1.0);
            for _ in 0..policy::BLUR_WIDTH_PASSES {
                wider = smoothed(&wider);
            }
            widths = wider.iter().zip(&widths).map(|(a, b)| a.max(*b)).collect();
        }
        law
    }

    /// The greater |curvature| of the two pitch curves at each sample for L = 1, and the driver's perimeter.
    fn bends(&self, law: &[f64]) -> (Vec<f64>, f64) {
        let n = law.len();
        let h = self.step(n);
        let mut length = 0.0;
        let bends = (0..n)
            .map(|i| {
                let (p, next, previous) = (law[i], law[(i + 1) % n], law[(i + n - 1) % n]);
                let (p1, p2) =
                    ((next - previous) / (2.0 * h), (next - 2.0 * p + previous) / (h * h));
                let at = Gearing::External.at(1.0, [p, p1, p2]);
                length += at.arc_speed();
                let bend = at.curvatures().map(f64::abs);
                bend.driver.max(bend.follower)
            })
            .collect();
        (bends, length * h * f64::from(self.folds.0))
    }
}

/// ln of the driver's pitch radius over the centre distance.
fn log_radius(law: &[f64]) -> Vec<f64> {
    law.iter().map(|&p| Gearing::External.radii(1.0, p).driver.ln()).collect()
}

/// One implicit step of diffusion, `strength` in samples squared.
fn diffused(y: &[f64], strength: f64) -> Vec<f64> {
    let side = vec![-strength; y.len()];
    let diagonal = vec![1.0 + 2.0 * strength; y.len()];
    solve_cyclic(&side, &diagonal, &side, y)
}

/// The periodic average of y under a Gaussian whose standard deviation (samples) is given at each sample.
fn blurred(y: &[f64], widths: &[f64]) -> Vec<f64> {
    let n = y.len();
    (0..n)
        .map(|i| {
            let reach = ((policy::BLUR_REACH * widths[i]).ceil() as usize).min(n / 2);
            let (mut sum, mut weights) = (y[i], 1.0);
            for k in 1..=reach {
                let w = (-0.5 * (k as f64 / widths[i]).powi(2)).exp();
                sum += w * (y[(i + k) % n] + y[(i + n - k) % n]);
                weights += 2.0 * w;
            }
            sum / weights
        })
        .collect()
}

/// min(s psi', most) with the scale s that closes it: the limit of truncating and rescaling in turn (Eq. 16).
pub(super) fn bound_torque(law: &[f64], most: f64) -> Vec<f64> {
    let n = law.len() as f64;
    let total: f64 = law.iter().sum();
    let mut sorted = law.to_vec();
    sorted.sort_by(|a, b| b.total_cmp(a));
    // With the k greatest cut off, the rest is scaled to carry what remains.
    let (mut rest, mut scale) = (total, 1.0);
    for (k, v) in sorted.iter().enumerate() {
        scale = (total - k as f64 * most) / rest;
        if scale * v <= most {
            break;
        }
        rest -= v;
    }
    if most * n <= total * (1.0 + f64::EPSILON) {
        return vec![total / n; law.len()];
    }
    law.iter().map(|v| (scale * v).min(most)).collect()
}

/// mean + factor (psi' - mean): keeps the integral; a factor of 1 or more changes nothing.
fn drawn_to_mean(law: &[f64], factor: f64) -> Vec<f64> {
    if factor >= 1.0 || factor.is_nan() {
        return law.to_vec();
    }
    let mean = law.iter().sum::<f64>() / law.len() as f64;
    law.iter().map(|v| mean + factor.max(0.0) * (v - mean)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A law with a cliff, a spike and a corner.
    fn rough(n: usize) -> Vec<f64> {
        (0..n)
            .map(|i| {
                let x = i as f64 / n as f64;
                0.3 + x
                    + if x > 0.5 { 1.2 } else { 0.0 }
                    + 2.0 * (-((x - 0.25) * 60.0).powi(2)).exp()
            })
            .collect()
    }

    fn delivered(law: &[f64], folds: (u32, u32)) -> Extremes {
        Extremes::of(Transmission::from_derivative(law, folds.0, folds.1).unwrap(), true)
    }

    #[test]
    fn a_law_within_its_limits_is_left_alone() {
        let law: Vec<f64> =
            (0..64).map(|i| 1.0 + 0.2 * (TAU * f64::from(i) / 64.0).sin()).collect();
        let (same, cost) = apply(&law, (1, 1), &Limits::default()).unwrap();
        assert!(law.iter().zip(&same).all(|(a, b)| (a - b).abs() < 1e-14));
        assert_eq!(cost.shape, 0.0);
    }

    #[test]
    fn every_bound_holds_on_the_spline() {
        for folds in [(1, 1), (1, 3), (2, 1)] {
            let mean = f64::from(folds.0) / f64::from(folds.1);
            for (torque, lean, bend) in [
                (None, 60.0, None),
                (Some(1.5), 50.0, None),
                (Some(1.02), 75.0, None),
                (None, 40.0, Some(60.0)),
                (Some(2.0), 60.0, Some(30.0)),
            ] {
                let limits = Limits {
                    max_derivative: torque.map(|v| v * mean),
                    max_lean: f64::to_radians(lean),
                    max_curvature: bend,
                };
                let (law, cost) = apply(&rough(512), folds, &limits).unwrap();
                let found = delivered(&law, folds);
                let slack = 1.0 + 2.0 * policy::LIMIT_ROUNDING;
                assert!(found.lean <= limits.max_lean * slack, "{limits:?} {found:?}");
                assert!(found.derivative <= limits.max_derivative.unwrap_or(9e9) * slack);
                // A corner that the widest blur leaves over the bound is delivered far rounder than it came.
                let most = bend.unwrap_or(f64::INFINITY) * (1.0 + 2.0 * policy::CURVATURE_RIPPLE);
                let rounder = found.curvature < 0.2 * cost.curvature.0;
                assert!(found.curvature <= most || rounder, "{limits:?} {found:?} {cost:?}");
                let total: f64 = law.iter().sum();
                assert!((total / 512.0 / mean - 1.0).abs() < 1e-12);
                assert!(cost.shape > 0.0);
                // Not by giving up: something of the shape is left.
                assert!(found.derivative > 1.01 * mean, "{limits:?} {found:?}");
            }
        }
    }

    #[test]
    fn a_torque_bound_at_the_mean_makes_circles() {
        let limits = Limits { max_derivative: Some(0.5), ..Limits::default() };
        let (law, _) = apply(&rough(128), (1, 2), &limits).unwrap();
        assert!(law.iter().all(|v| (v - 0.5).abs() < 1e-9));
    }

    #[test]
    fn truncation_and_rescaling_have_converged() {
        let law = closed(&rough(256), 1.0);
        let cut = bound_torque(&law, 1.3);
        assert!((cut.iter().sum::<f64>() / 256.0 - 1.0).abs() < 1e-12);
        // Below the bound the law is scaled by one factor.
        let scales: Vec<f64> =
            law.iter().zip(&cut).filter(|(_, c)| **c < 1.3 - 1e-12).map(|(l, c)| c / l).collect();
        assert!(scales.len() > 10 && scales.iter().all(|s| (s / scales[0] - 1.0).abs() < 1e-12));
    }

    #[test]
    fn impossible_limits_are_refused() {
        let try_with = |limits: Limits| apply(&[1.0; 32], (1, 2), &limits).unwrap_err();
        let base = Limits::default();
        let torque = try_with(Limits { max_derivative: Some(0.4), ..base });
        assert_eq!(torque, LimitError::TorqueBelowMean { bound: 0.4, mean: 0.5 });
        for max_lean in [0.0, 1.6, f64::NAN, -1.0] {
            let lean = try_with(Limits { max_lean, ..base });
            assert!(matches!(lean, LimitError::LeanOutOfRange { .. }));
        }
        let bend = try_with(Limits { max_curvature: Some(6.0), ..base });
        assert!(matches!(bend, LimitError::CurvatureBelowCircle { .. }));
        assert!(apply(&[0.0; 32], (1, 1), &base).is_err());
    }
}
