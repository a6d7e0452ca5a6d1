//! The transmission function psi: how far the follower turns for each angle of the driver.

use std::f64::consts::TAU;
use std::sync::Arc;

use crate::gear::Motion;
use crate::geometry::{gcd, solve_cyclic};
use crate::policy;

/// Why samples do not make a transmission function.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TransmissionError {
    /// Too few samples for a spline that means anything.
    #[error("{count} samples of psi' are too few; give at least {least}")]
    TooFewSamples {
        /// Samples given.
        count: usize,
        /// Samples needed.
        least: usize,
    },
    /// A sample is NaN or infinite.
    #[error("sample {index} of psi' is not a finite number; correct the input of the law")]
    NotFinite {
        /// Index of the sample, from zero.
        index: usize,
    },
    /// The follower would stop or turn back.
    #[error(
        "psi' falls to {value:.3e} times its mean at driver angle {at:.4}, where the follower would stop or turn \
         back; smooth the law, take more samples or move the rotation centre inwards"
    )]
    NotIncreasing {
        /// Driver angle, radians.
        at: f64,
        /// Value of psi' over its mean.
        value: f64,
    },
    /// A fold of zero.
    #[error("a gear has no symmetry of order 0; give 1 for a gear without symmetry")]
    ZeroFold,
}

/// psi over one period, strictly increasing by construction.
///
/// psi' is a periodic cubic spline over uniform knots (twice continuously
/// differentiable) and psi is its exact integral, so that psi, its derivatives
/// and its inverse always agree to rounding. Angles are radians; every function
/// takes any real angle and costs O(1), [`Self::inverse`] O(log n).
#[derive(Clone, Debug, PartialEq)]
pub struct Transmission {
    spline: Arc<Spline>,
    driver_fold: u32,
    follower_fold: u32,
    /// Spline argument at driver angle 0, in `0..driver_period`, and psi there.
    phase: f64,
    psi_at_phase: f64,
    samples: Vec<f64>,
}

impl Motion for Transmission {
    fn psi(&self, driver_angle: f64) -> f64 {
        self.psi(driver_angle)
    }

    fn derivative(&self, driver_angle: f64) -> f64 {
        self.derivative(driver_angle)
    }

    fn cycle(&self) -> f64 {
        self.driver_period() * f64::from(self.cycle_periods())
    }
}

/// The periodic spline of psi' and its running integral.
#[derive(Clone, Debug, PartialEq)]
struct Spline {
    step: f64,
    period: f64,
    rise: f64,
    /// psi' on interval i is `c0 + c1 t + c2 t^2 + c3 t^3`, t in 0..1.
    coefficients: Vec<[f64; 4]>,
    /// psi at the knots, one more than there are intervals.
    psi: Vec<f64>,
    min: (f64, f64),
    max: (f64, f64),
}

impl Transmission {
    /// Takes `samples` of psi', uniform over one driver period `2 pi / driver_fold` from driver angle 0,
    /// and scales them so that psi rises by `2 pi / follower_fold` over that period.
    ///
    /// # Errors
    /// Fewer than eight samples, numbers that are not finite, a fold of zero, or a spline through the samples
    /// that is not positive everywhere (between the samples too).
    pub fn from_derivative(
        samples: &[f64],
        driver_fold: u32,
        follower_fold: u32,
    ) -> Result<Self, TransmissionError> {
        let least = policy::MIN_TRANSMISSION_SAMPLES;
        if samples.len() < least {
            return Err(TransmissionError::TooFewSamples { count: samples.len(), least });
        }
        if let Some(index) = samples.iter().position(|v| !v.is_finite()) {
            return Err(TransmissionError::NotFinite { index });
        }
        if driver_fold == 0 || follower_fold == 0 {
            return Err(TransmissionError::ZeroFold);
        }
        let period = TAU / f64::from(driver_fold);
        let rise = TAU / f64::from(follower_fold);
        // Only their proportions count; numbers near the ends of the range would lose theirs in sums and quotients.
        let largest = samples.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        let (low, high) = policy::SAMPLE_RANGE;
        if largest > 0.0 && !(low..=high).contains(&largest) {
            let brought_near: Vec<f64> = samples.iter().map(|v| v / largest).collect();
            return Self::from_derivative(&brought_near, driver_fold, follower_fold);
        }
        let mean = samples.iter().sum::<f64>() / samples.len() as f64;
        if !(mean > 0.0 && mean.is_finite()) {
            let at = samples.iter().position(|&v| v <= 0.0).unwrap_or(0);
            let at = at as f64 * period / samples.len() as f64;
            return Err(TransmissionError::NotIncreasing { at, value: mean.min(0.0) });
        }
        let scale = rise / period / mean;
        let samples: Vec<f64> = samples.iter().map(|v| v * scale).collect();
        let spline = Spline::through(&samples, period, rise);
        let floor = policy::MIN_RELATIVE_SPEED * rise / period;
        if spline.min.1 <= floor || spline.min.1.is_nan() {
            return Err(TransmissionError::NotIncreasing {
                at: spline.min.0,
                value: spline.min.1 * period / rise,
            });
        }
        Ok(Self {
            spline: Arc::new(spline),
            driver_fold,
            follower_fold,
            phase: 0.0,
            psi_at_phase: 0.0,
            samples,
        })
    }

    /// Order of the driver's rotational symmetry that psi relies on.
    #[must_use]
    pub fn driver_fold(&self) -> u32 {
        self.driver_fold
    }

    /// Order of the follower's rotational symmetry that psi relies on.
    #[must_use]
    pub fn follower_fold(&self) -> u32 {
        self.follower_fold
    }

    /// K: driver turns for one turn of the follower.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        f64::from(self.follower_fold) / f64::from(self.driver_fold)
    }

    /// Driver angle after which psi' repeats, `2 pi / driver_fold`.
    #[must_use]
    pub fn driver_period(&self) -> f64 {
        self.spline.period
    }

    /// Follower angle of one period, `2 pi / follower_fold`.
    #[must_use]
    pub fn follower_period(&self) -> f64 {
        self.spline.rise
    }

    /// Periods after which both gears are back where they began.
    #[must_use]
    pub fn cycle_periods(&self) -> u32 {
        self.driver_fold / gcd(self.driver_fold, self.follower_fold) * self.follower_fold
    }

    /// Follower angle at driver angle `phi`; psi(0) = 0.
    #[must_use]
    pub fn psi(&self, phi: f64) -> f64 {
        let spline = &*self.spline;
        let (turns, i, t) = spline.locate(self.phase + phi);
        turns * spline.rise + spline.psi_within(i, t) - self.psi_at_phase
    }

    /// psi', equal to the driver's torque over the follower's.
    #[must_use]
    pub fn derivative(&self, phi: f64) -> f64 {
        let (_, i, t) = self.spline.locate(self.phase + phi);
        self.spline.value(i, t)
    }

    /// psi''.
    #[must_use]
    pub fn second_derivative(&self, phi: f64) -> f64 {
        let (_, i, t) = self.spline.locate(self.phase + phi);
        let [_, c1, c2, c3] = self.spline.coefficients[i];
        (c1 + t * (2.0 * c2 + t * 3.0 * c3)) / self.spline.step
    }

    /// psi''', continuous and linear between knots.
    #[must_use]
    pub fn third_derivative(&self, phi: f64) -> f64 {
        let (_, i, t) = self.spline.locate(self.phase + phi);
        let [_, _, c2, c3] = self.spline.coefficients[i];
        (2.0 * c2 + 6.0 * c3 * t) / (self.spline.step * self.spline.step)
    }

    /// The driver angle at follower angle `phi_f`, to machine precision.
    #[must_use]
    pub fn inverse(&self, phi_f: f64) -> f64 {
        let spline = &*self.spline;
        let target = phi_f + self.psi_at_phase;
        let turns = (target / spline.rise).floor();
        let rest = (target - turns * spline.rise).clamp(0.0, spline.rise);
        let last = spline.coefficients.len() - 1;
        let i = spline.psi.partition_point(|&v| v <= rest).saturating_sub(1).min(last);
        let t = spline.solve_within(i, rest);
        turns * spline.period + (i as f64 + t) * spline.step - self.phase
    }

    /// The same motion started at `phi0`: `psi_new(phi) = psi(phi0 + phi) - psi(phi0)`, exactly.
    ///
    /// Only the start moves; knots stay where they were, so [`Self::samples`] of the result determine it
    /// exactly only when `phi0` is a whole number of sample steps.
    #[must_use]
    pub fn shifted(&self, phi0: f64) -> Self {
        let spline = Arc::clone(&self.spline);
        let phase = (self.phase + phi0).rem_euclid(spline.period);
        let phase = if phase < spline.period { phase } else { 0.0 };
        let (_, i, t) = spline.locate(phase);
        let psi_at_phase = spline.psi_within(i, t);
        let samples = (0..self.samples.len())
            .map(|k| {
                let (_, i, t) = spline.locate(phase + k as f64 * spline.step);
                spline.value(i, t)
            })
            .collect();
        Self { spline, phase, psi_at_phase, samples, ..*self }
    }

    /// The inverse function as a transmission, the follower driving.
    ///
    /// It is interpolated through as many exact samples as this one has. As a picture it is the pair seen in a
    /// mirror: driver and follower still turn counter-clockwise and clockwise, and both pitch curves are reflected.
    ///
    /// # Errors
    /// [`TransmissionError::NotIncreasing`] when the samples are too coarse for the inverse.
    pub fn reversed(&self) -> Result<Self, TransmissionError> {
        let n = self.samples.len();
        let step = self.follower_period() / n as f64;
        let samples: Vec<f64> =
            (0..n).map(|i| 1.0 / self.derivative(self.inverse(i as f64 * step))).collect();
        Self::from_derivative(&samples, self.follower_fold, self.driver_fold)
    }

    /// Greatest psi' over the whole spline, between samples too.
    #[must_use]
    pub fn max_derivative(&self) -> f64 {
        self.spline.max.1
    }

    /// Least psi' over the whole spline, between samples too.
    #[must_use]
    pub fn min_derivative(&self) -> f64 {
        self.spline.min.1
    }

    /// psi' at the knots of its spline, uniform over one period from [`Self::phase`] before driver angle 0.
    #[must_use]
    pub fn knots(&self) -> Vec<f64> {
        self.spline.coefficients.iter().map(|c| c[0]).collect()
    }

    /// Where driver angle 0 lies on the spline, radians; 0 where it was not [shifted](Self::shifted).
    #[must_use]
    pub fn phase(&self) -> f64 {
        self.phase
    }

    /// psi' at uniform driver angles over one period, from driver angle 0.
    #[must_use]
    pub fn samples(&self) -> &[f64] {
        &self.samples
    }
}

impl Spline {
    fn through(samples: &[f64], period: f64, rise: f64) -> Self {
        let n = samples.len();
        let step = period / n as f64;
        let slopes = periodic_slopes(samples);
        let coefficients: Vec<[f64; 4]> = (0..n)
            .map(|i| {
                let j = (i + 1) % n;
                let (y0, y1, d0, d1) = (samples[i], samples[j], slopes[i], slopes[j]);
                [y0, d0, 3.0 * (y1 - y0) - 2.0 * d0 - d1, 2.0 * (y0 - y1) + d0 + d1]
            })
            .collect();
        let mut psi = Vec::with_capacity(n + 1);
        let mut total = 0.0;
        psi.push(0.0);
        for c in &coefficients {
            total += step * (c[0] + c[1] / 2.0 + c[2] / 3.0 + c[3] / 4.0);
            psi.push(total);
        }
        psi[n] = rise;
        let mut spline = Self {
            step,
            period,
            rise,
            coefficients,
            psi,
            min: (0.0, samples[0]),
            max: (0.0, samples[0]),
        };
        spline.find_extremes();
        spline
    }

    fn find_extremes(&mut self) {
        for i in 0..self.coefficients.len() {
            for t in stationary_points(self.coefficients[i]).into_iter().flatten().chain([0.0]) {
                let here = ((i as f64 + t) * self.step, self.value(i, t));
                if here.1 < self.min.1 {
                    self.min = here;
                }
                if here.1 > self.max.1 {
                    self.max = here;
                }
            }
        }
    }

    /// Whole periods before `x`, the interval it falls in and the position within, 0..=1.
    fn locate(&self, x: f64) -> (f64, usize, f64) {
        let turns = (x / self.period).floor();
        let u = ((x - turns * self.period) / self.step).max(0.0);
        let i = (u as usize).min(self.coefficients.len() - 1);
        (turns, i, u - i as f64)
    }

    fn value(&self, i: usize, t: f64) -> f64 {
        let [c0, c1, c2, c3] = self.coefficients[i];
        c0 + t * (c1 + t * (c2 + t * c3))
    }

    fn psi_within(&self, i: usize, t: f64) -> f64 {
        let [c0, c1, c2, c3] = self.coefficients[i];
        self.psi[i] + self.step * t * (c0 + t * (c1 / 2.0 + t * (c2 / 3.0 + t * c3 / 4.0)))
    }

    /// The position in interval `i` where psi is `target`: Newton steps kept inside a shrinking bracket.
    fn solve_within(&self, i: usize, target: f64) -> f64 {
        let (mut low, mut high) = (0.0_f64, 1.0_f64);
        let mut t = ((target - self.psi[i]) / (self.psi[i + 1] - self.psi[i])).clamp(0.0, 1.0);
        for _ in 0..policy::MAX_NEWTON_STEPS {
            let residual = self.psi_within(i, t) - target;
            if residual > 0.0 {
                high = t;
            } else {
                low = t;
            }
            let newton = t - residual / (self.step * self.value(i, t));
            let next = if newton >= low && newton <= high { newton } else { 0.5 * (low + high) };
            if (next - t).abs() <= f64::EPSILON {
                return next;
            }
            t = next;
        }
        t
    }
}

/// Slopes (per knot interval) of the periodic cubic spline through `samples`.
fn periodic_slopes(samples: &[f64]) -> Vec<f64> {
    let n = samples.len();
    let rhs: Vec<f64> =
        (0..n).map(|i| 3.0 * (samples[(i + 1) % n] - samples[(i + n - 1) % n])).collect();
    let side = vec![1.0; n];
    solve_cyclic(&side, &vec![4.0; n], &side, &rhs)
}

/// Where in 0..1 the cubic with these coefficients has a horizontal tangent.
fn stationary_points([_, c1, c2, c3]: [f64; 4]) -> [Option<f64>; 2] {
    let inside = |t: f64| (t > 0.0 && t < 1.0).then_some(t);
    let (a, b, c) = (3.0 * c3, 2.0 * c2, c1);
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return [None, None];
    }
    let q = -0.5 * (b + discriminant.sqrt().copysign(b));
    [inside(q / a), inside(c / q)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wavy(n: usize, folds: (u32, u32)) -> Transmission {
        let samples: Vec<f64> = (0..n)
            .map(|i| {
                let x = TAU * i as f64 / n as f64;
                1.0 + 0.4 * x.sin() + 0.2 * (3.0 * x + 0.5).cos()
            })
            .collect();
        Transmission::from_derivative(&samples, folds.0, folds.1).unwrap()
    }

    #[test]
    fn circles_turn_evenly() {
        let even = Transmission::from_derivative(&[7.0; 16], 1, 3).unwrap();
        assert_eq!(even.ratio(), 3.0);
        for k in -20..20 {
            let phi = 0.7 * f64::from(k);
            assert!((even.psi(phi) - phi / 3.0).abs() < 1e-14);
            assert!((even.inverse(phi) - 3.0 * phi).abs() < 1e-13);
        }
    }

    #[test]
    fn the_spline_follows_a_smooth_law() {
        let t = wavy(512, (1, 1));
        for k in 0..777 {
            let x = 0.013 * f64::from(k) - 2.0;
            let law = 1.0 + 0.4 * x.sin() + 0.2 * (3.0 * x + 0.5).cos();
            let integral =
                x - 0.4 * (x.cos() - 1.0) + 0.2 / 3.0 * ((3.0 * x + 0.5).sin() - 0.5_f64.sin());
            assert!((t.derivative(x) - law).abs() < 1e-8);
            assert!((t.psi(x) - integral).abs() < 1e-9);
            let slope = 0.4 * x.cos() - 0.6 * (3.0 * x + 0.5).sin();
            assert!((t.second_derivative(x) - slope).abs() < 1e-5);
            let bend = -0.4 * x.sin() - 1.8 * (3.0 * x + 0.5).cos();
            assert!((t.third_derivative(x) - bend).abs() < 2e-3);
        }
    }

    #[test]
    fn psi_closes_and_inverts_to_rounding() {
        for folds in [(1, 1), (1, 3), (4, 1)] {
            let t = wavy(100, folds).shifted(0.3333);
            assert_eq!(t.psi(0.0), 0.0);
            for k in -50..50 {
                let phi = 0.173 * f64::from(k);
                let around = t.psi(phi + t.driver_period()) - t.psi(phi);
                assert!((around - t.follower_period()).abs() < 1e-13);
                assert!((t.inverse(t.psi(phi)) - phi).abs() < 4e-14, "{folds:?} {phi}");
            }
        }
    }

    #[test]
    fn a_shift_moves_only_the_start() {
        let t = wavy(64, (1, 2));
        let s = t.shifted(-1.234);
        for k in 0..40 {
            let phi = 0.31 * f64::from(k) - 3.0;
            assert!((s.psi(phi) - (t.psi(phi - 1.234) - t.psi(-1.234))).abs() < 1e-13);
        }
        assert!((s.samples()[3] - s.derivative(3.0 * TAU / 64.0)).abs() < 1e-13);
    }

    #[test]
    fn reversing_twice_gives_the_law_back() {
        let t = wavy(2048, (1, 2));
        let back = t.reversed().unwrap();
        assert_eq!((back.driver_fold(), back.follower_fold()), (2, 1));
        let twice = back.reversed().unwrap();
        for k in 0..60 {
            let phi = 0.11 * f64::from(k);
            let wrong = (back.psi(t.psi(phi)) - phi).abs();
            assert!(wrong < 1e-9, "{wrong}");
            assert!((twice.psi(phi) - t.psi(phi)).abs() < 1e-9);
        }
    }

    #[test]
    fn extremes_hold_between_samples() {
        let samples = [1.0, 1.0, 1.0, 1.0, 2.0, 2.0, 1.0, 1.0, 1.0, 1.0];
        let t = Transmission::from_derivative(&samples, 1, 1).unwrap();
        let dense = (0..100_000).map(|i| t.derivative(1e-4 * f64::from(i)));
        let (low, high) = dense.fold((9.0_f64, 0.0_f64), |(l, h), v| (l.min(v), h.max(v)));
        let knots = t.samples().iter().copied().fold(0.0, f64::max);
        assert!(t.max_derivative() > knots + 0.01);
        assert!(t.max_derivative() >= high && t.max_derivative() - high < 1e-7);
        assert!(t.min_derivative() <= low && low - t.min_derivative() < 1e-7);
    }

    #[test]
    fn laws_that_stop_are_refused() {
        let refuse = |s: &[f64]| Transmission::from_derivative(s, 1, 1).unwrap_err();
        assert!(matches!(refuse(&[1.0; 7]), TransmissionError::TooFewSamples { count: 7, .. }));
        let mut samples = [1.0; 12];
        samples[5] = f64::NAN;
        assert_eq!(refuse(&samples), TransmissionError::NotFinite { index: 5 });
        samples[5] = 0.0;
        assert!(matches!(refuse(&samples), TransmissionError::NotIncreasing { .. }));
        samples = [0.001; 12];
        samples[5] = 10.0;
        assert!(matches!(refuse(&samples), TransmissionError::NotIncreasing { .. }));
        assert!(matches!(refuse(&[-1.0; 12]), TransmissionError::NotIncreasing { .. }));
        let none = Transmission::from_derivative(&[1.0; 12], 0, 1);
        assert_eq!(none.unwrap_err(), TransmissionError::ZeroFold);
    }
}
