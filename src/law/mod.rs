//! Wanted motions: a formula, a table or a name becomes a [`Transmission`].
//!
//! Angles are driver angles in radians, from the pose in which the pair is drawn. A motion closes when psi' averages
//! `1 / K`, and repeats when both gears are closed curves: at a ratio of m driver turns to n turns of the follower (in
//! lowest terms) psi' must have repeated n times when the driver has made one turn.

mod error;
mod formula;
mod preset;
mod segment;
mod table;

pub use error::LawError;
pub use formula::Formula;
pub use preset::{PRESETS, Preset, PresetHelp};
pub use segment::{Segment, from_segment};
pub use table::Table;

use std::f64::consts::TAU;

use crate::fit::Ratio;
use crate::pitch::{PolarCurve, Transmission, driver_law};
use crate::policy;

/// What a function of an angle stands for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quantity {
    /// psi': the follower's speed over the driver's, by driver angle.
    #[default]
    Speed,
    /// psi: the follower's angle, radians, by driver angle. Only its changes count.
    Angle,
    /// Radius of the driver's pitch curve by direction, counter-clockwise about the driver's axis, in any unit: the centre
    /// distance that closes the pair is found.
    DriverRadius,
}

/// How a motion is read.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LawOptions {
    /// Turns of the driver for one of the follower.
    pub ratio: Ratio,
    /// What is given.
    pub quantity: Quantity,
    /// Whether a motion that does not close is scaled until it does, instead of refused.
    pub normalise: bool,
}

impl LawOptions {
    /// Driver angle after which psi' must repeat.
    fn period(&self) -> f64 {
        TAU / f64::from(self.ratio.driver_fold())
    }

    /// Mean of psi', n/m.
    fn mean(&self) -> f64 {
        1.0 / self.ratio.value()
    }
}

/// The motion that a function describes.
///
/// # Errors
/// [`LawError`] when it is not finite or not positive somewhere, does not repeat, or does not close.
///
/// ```
/// use centrode::law::{LawOptions, from_function};
///
/// let lobed = from_function(|phi| 1.0 + 0.3 * (2.0 * phi).cos(), &LawOptions::default())?;
/// assert!((lobed.derivative(0.0) - 1.3).abs() < 1e-9);
/// let open = from_function(|phi| 1.0 + 0.1 * phi, &LawOptions::default());
/// assert!(open.unwrap_err().to_string().contains("repeat"));
/// # Ok::<(), centrode::law::LawError>(())
/// ```
pub fn from_function(
    function: impl Fn(f64) -> f64,
    options: &LawOptions,
) -> Result<Transmission, LawError> {
    let n = policy::LAW_SAMPLES;
    let period = options.period();
    let step = period / n as f64;
    let value: &dyn Fn(f64) -> f64 = match options.quantity {
        Quantity::Angle => &|phi| difference(&function, phi),
        Quantity::Speed | Quantity::DriverRadius => &function,
    };
    let samples: Vec<f64> = (0..n).map(|i| value(i as f64 * step)).collect();
    let quantity = options.quantity;
    for (i, v) in samples.iter().enumerate() {
        if !v.is_finite() {
            return Err(LawError::NotFinite { quantity, at: i as f64 * step });
        }
    }
    let largest = samples.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    // Where it should have repeated: within the turn of the driver, and after it.
    let fold = options.ratio.driver_fold() as usize;
    let mut strays = Vec::new();
    for (i, &now) in samples.iter().enumerate() {
        let here = i as f64 * step;
        let again = value(here + period * (1 + i % fold) as f64);
        // Written so that a value that is not a number is refused too.
        let repeats = (again - now).abs() <= policy::LAW_REPEATS_WITHIN * largest;
        if !repeats {
            strays.push((here, (now, again)));
        }
    }
    // At a step rounding alone decides on which side of it a sample falls.
    if strays.len() > policy::LAW_STEPS
        && let Some(&(at, values)) = strays.first()
    {
        return Err(LawError::NotPeriodic {
            quantity,
            folds: options.ratio.driver_fold(),
            turns: (options.ratio.follower_fold(), options.ratio.driver_fold()),
            at,
            values,
        });
    }
    if let Some(at) = misses(&samples, value, step) {
        return Err(LawError::TooFast { quantity, at });
    }
    closed(samples, options)
}

/// Where samples first fail to tell what a function does between them, if they do so in more than a few places: waves
/// shorter than the samples are apart look like other waves.
fn misses(samples: &[f64], value: &dyn Fn(f64) -> f64, step: f64) -> Option<f64> {
    let n = samples.len();
    let (low, high) =
        samples.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
    let allowed = (policy::LAW_MISS * (high - low))
        .max(policy::LAW_REPEATS_WITHIN * low.abs().max(high.abs()));
    // On no grid of the samples.
    let t = 1.0 - policy::GOLDEN_FRACTION;
    let weights = [
        -t * (t - 1.0) * (t - 2.0) / 6.0,
        (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
        -(t + 1.0) * t * (t - 2.0) / 2.0,
        (t + 1.0) * t * (t - 1.0) / 6.0,
    ];
    let missed = |i: &usize| {
        let told: f64 = (0..4).map(|k| weights[k] * samples[(i + n + k - 1) % n]).sum();
        let off = (value((*i as f64 + t) * step) - told).abs();
        // Written so that a value that is not a number counts too.
        let met = off <= allowed;
        !met
    };
    let places: Vec<usize> = (0..n).filter(missed).collect();
    let most = policy::LAW_MISSES * n as f64;
    places.first().filter(|_| places.len() as f64 > most).map(|&i| i as f64 * step)
}

/// How often samples of one period pass through the middle of their range upwards, trembling aside.
fn waves(samples: &[f64], mean: f64) -> usize {
    let (low, high) =
        samples.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
    if high - low <= policy::LAW_FLAT * mean {
        return 0;
    }
    let band = policy::LAW_TREMBLE * (high - low);
    let middle = 0.5 * (low + high);
    let mut below = false;
    let mut count = 0;
    for v in samples.iter().chain(samples.first()) {
        if *v < middle - band {
            below = true;
        } else if *v > middle + band && below {
            below = false;
            count += 1;
        }
    }
    count
}

/// Samples of psi' or of the radius over one period, checked and closed.
fn closed(samples: Vec<f64>, options: &LawOptions) -> Result<Transmission, LawError> {
    let n = samples.len();
    let step = options.period() / n as f64;
    let quantity = options.quantity;
    let mean = samples.iter().sum::<f64>() / n as f64;
    let (least, at) = samples
        .iter()
        .enumerate()
        .map(|(i, v)| (*v, i as f64 * step))
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .unwrap_or((0.0, 0.0));
    // Written so that a mean below zero is refused too.
    let positive = mean > 0.0 && least > policy::LAW_LEAST * mean;
    if !positive {
        return Err(LawError::NotPositive {
            quantity,
            value: least,
            at,
            least: policy::LAW_LEAST * mean.abs(),
        });
    }
    let folds = (options.ratio.driver_fold(), options.ratio.follower_fold());
    let count = waves(&samples, mean) * folds.0 as usize;
    if count > policy::LAW_WAVES {
        return Err(LawError::TooManyWaves { quantity, count, most: policy::LAW_WAVES });
    }
    let samples = if quantity == Quantity::DriverRadius {
        // All directions of the driver's turn, for the centre distance.
        let whole: Vec<f64> = (0..n * folds.0 as usize).map(|i| samples[i % n]).collect();
        let curve = PolarCurve::from_radii(whole)?;
        let law = driver_law(curve.radii(), curve.center_distance(options.ratio.value()));
        law[..n].to_vec()
    } else {
        let wanted = options.mean();
        let off = mean / wanted - 1.0;
        if off.abs() > policy::LAW_CLOSES_WITHIN && !options.normalise {
            return Err(LawError::NotClosed {
                quantity,
                mean,
                wanted,
                turns: (options.ratio.follower_fold(), options.ratio.driver_fold()),
            });
        }
        samples
    };
    Ok(Transmission::from_derivative(&samples, folds.0, folds.1)?)
}

/// The derivative of a function by the five-point rule.
fn difference(function: &dyn Fn(f64) -> f64, at: f64) -> f64 {
    let h = policy::LAW_DIFFERENCE;
    let apart = |k: f64| function(at + k * h) - function(at - k * h);
    (8.0 * apart(1.0) - apart(2.0)) / (12.0 * h)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn options(ratio: (u32, u32), quantity: Quantity) -> LawOptions {
        let ratio = Ratio::rational(ratio.0, ratio.1).unwrap();
        LawOptions { ratio, quantity, normalise: false }
    }

    #[test]
    fn speed_angle_and_radius_of_one_motion_agree() {
        let speed = |phi: f64| 1.0 + 0.3 * (2.0 * phi).cos();
        let by_speed = from_function(speed, &options((1, 1), Quantity::Speed)).unwrap();
        let angle = |phi: f64| 0.7 + phi + 0.15 * (2.0 * phi).sin();
        let by_angle = from_function(angle, &options((1, 1), Quantity::Angle)).unwrap();
        // The pitch point moves clockwise through the driver's directions.
        let radius = |theta: f64| 50.0 * speed(-theta) / (1.0 + speed(-theta));
        let by_radius = from_function(radius, &options((1, 1), Quantity::DriverRadius)).unwrap();
        for k in 0..40 {
            let phi = 0.2 * f64::from(k);
            let exact = angle(phi) - angle(0.0);
            for made in [&by_speed, &by_angle, &by_radius] {
                assert!((made.psi(phi) - exact).abs() < 1e-8, "{phi}");
            }
        }
    }

    #[test]
    fn a_rational_motion_closes_on_both_gears() {
        let law = |phi: f64| (1.0 + 0.2 * (2.0 * phi).cos()) * 2.0 / 3.0;
        let made = from_function(law, &options((3, 2), Quantity::Speed)).unwrap();
        assert_eq!((made.driver_fold(), made.follower_fold()), (2, 3));
        // Three turns of the driver are two of the follower.
        assert!((made.psi(3.0 * TAU) - 2.0 * TAU).abs() < 1e-9);
        // After a turn of the driven gear the driver is elsewhere, and psi' is what it was.
        let later = made.inverse(TAU + made.psi(0.4));
        assert!((made.derivative(later) - made.derivative(0.4)).abs() < 1e-9);
        let once = |phi: f64| (1.0 + 0.2 * phi.cos()) * 2.0 / 3.0;
        let error = from_function(once, &options((3, 2), Quantity::Speed)).unwrap_err();
        assert!(matches!(error, LawError::NotPeriodic { folds: 2, .. }), "{error}");
    }

    #[test]
    fn waves_that_samples_cannot_tell_are_refused_and_steps_are_not() {
        let plain = options((1, 1), Quantity::Speed);
        let wave = |n: f64| from_function(move |phi| 1.0 + 0.3 * (n * phi).cos(), &plain);
        // The last two look like one wave and like a constant.
        for n in [2049.0, 4097.0, 8192.0] {
            let error = wave(n).unwrap_err();
            assert!(matches!(error, LawError::TooFast { .. }), "{n}: {error}");
        }
        let many = wave(200.0).unwrap_err();
        assert!(matches!(many, LawError::TooManyWaves { count: 200, .. }), "{many}");
        assert!((wave(100.0).unwrap().derivative(0.0) - 1.3).abs() < 1e-3);
        // Two samples more lie on the upper side of its steps than on the lower.
        let scaled = LawOptions { normalise: true, ..plain };
        let step = from_function(|phi| 1.0 + 0.3 * phi.sin().signum(), &scaled).unwrap();
        assert!((step.derivative(1.0) - 1.3).abs() < 1e-2);
        // As small as numbers get.
        let tiny = from_function(|_| 1e-308, &scaled).unwrap();
        assert!((tiny.psi(TAU) - TAU).abs() < 1e-9);
    }

    #[test]
    fn what_is_no_motion_is_told_so() {
        let plain = options((1, 1), Quantity::Speed);
        let not_closed = from_function(|phi| 1.2 + 0.3 * phi.cos(), &plain).unwrap_err();
        assert!(not_closed.to_string().contains("72.0 degrees"), "{not_closed}");
        let scaled = LawOptions { normalise: true, ..plain };
        let made = from_function(|phi| 1.2 + 0.3 * phi.cos(), &scaled).unwrap();
        assert!((made.derivative(0.0) - 1.25).abs() < 1e-9);
        let backwards = from_function(|phi| 1.0 + 1.5 * phi.cos(), &plain).unwrap_err();
        assert!(backwards.to_string().contains("180.0 degrees"), "{backwards}");
        let pole = from_function(|phi| 1.0 / phi, &plain).unwrap_err();
        assert!(matches!(pole, LawError::NotFinite { .. }), "{pole}");
        assert!(from_function(|_| -1.0, &plain).is_err());
        assert!(from_function(|_| f64::NAN, &scaled).is_err());
        assert!(from_function(f64::sqrt, &scaled).is_err());
    }
}
