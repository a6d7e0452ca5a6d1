//! Motions that are wanted for a part of a turn only.

use super::{LawError, LawOptions, Quantity, closed, difference};
use crate::pitch::Transmission;
use crate::policy;

/// The part of a turn of the driver for which a motion is wanted, radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Driver angle at its beginning.
    pub from: f64,
    /// Driver angle at its end, greater.
    pub to: f64,
}

impl Segment {
    /// Its length, radians.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.to - self.from
    }
}

/// The motion that follows a function between two driver angles and closes smoothly over the rest of its
/// period: there ln psi' is a cubic that takes over value and slope on both sides, plus a flat bump
/// as high as the follower's turn needs. So psi' stays positive whatever is asked.
///
/// # Errors
/// [`LawError`] when the segment is no part of a period, the function is not finite or not positive on it, is a radius, or
/// turns the follower so far that too little of its period is left.
///
/// ```
/// use centrode::law::{LawOptions, Segment, from_segment};
///
/// // A pump's follower that gains speed evenly for a third of a turn.
/// let segment = Segment { from: 0.0, to: 2.0 };
/// let made = from_segment(|phi| 0.7 + 0.3 * phi, segment, &LawOptions::default())?;
/// assert!((made.derivative(1.0) - 1.0).abs() < 1e-6);
/// assert!((made.psi(std::f64::consts::TAU) - std::f64::consts::TAU).abs() < 1e-9);
/// # Ok::<(), centrode::law::LawError>(())
/// ```
pub fn from_segment(
    function: impl Fn(f64) -> f64,
    segment: Segment,
    options: &LawOptions,
) -> Result<Transmission, LawError> {
    let quantity = options.quantity;
    let speed: &dyn Fn(f64) -> f64 = match quantity {
        Quantity::Speed => &function,
        Quantity::Angle => &|phi| difference(&function, phi),
        Quantity::DriverRadius => return Err(LawError::SegmentOfRadius),
    };
    let period = options.period();
    let (least, most) = policy::LAW_SEGMENT;
    let length = segment.length();
    // Written so that an end that is no number is refused too.
    if !(length >= least * period && length <= most * period) {
        return Err(LawError::SegmentLength { length, least: least * period, most: most * period });
    }
    let n = policy::LAW_SAMPLES;
    let step = period / n as f64;
    // How far into the segment, or past its beginning, each sample lies.
    let past = |i: usize| (i as f64 * step - segment.from).rem_euclid(period);
    let mut samples = vec![0.0; n];
    let mut gain = 0.0;
    let mut mean = 0.0;
    for (i, sample) in samples.iter_mut().enumerate() {
        let x = past(i);
        if x <= length {
            *sample = speed(segment.from + x);
            if !sample.is_finite() {
                return Err(LawError::NotFinite { quantity, at: segment.from + x });
            }
            gain += *sample * step;
            mean += sample.abs() * step / length;
        }
    }
    let lowest =
        (0..n).filter(|&i| past(i) <= length).min_by(|&a, &b| samples[a].total_cmp(&samples[b]));
    if let Some(i) = lowest
        && samples[i] <= policy::LAW_LEAST * mean
    {
        let least = policy::LAW_LEAST * mean;
        return Err(LawError::NotPositive {
            quantity,
            value: samples[i],
            at: segment.from + past(i),
            least,
        });
    }
    let whole = options.mean() * period;
    if gain >= whole * (1.0 - policy::LAW_LEAST) {
        return Err(LawError::SegmentGain { gain, whole });
    }
    let closing = Closing::between(speed, segment, period, step);
    let rest: Vec<usize> = (0..n).filter(|&i| past(i) > length).collect();
    let share = |i: usize| (past(i) - length) / (period - length);
    let turned =
        |height: f64| -> f64 { rest.iter().map(|&i| step * closing.at(share(i), height)).sum() };
    let height = root(|h| turned(h) - (whole - gain));
    for &i in &rest {
        samples[i] = closing.at(share(i), height);
        if samples[i] <= policy::LAW_LEAST * options.mean() {
            return Err(LawError::SegmentGain { gain, whole });
        }
    }
    closed(samples, options)
}

/// ln psi' between the end of the segment and its next beginning.
struct Closing {
    /// At both ends: value, and slope by the share of the way.
    ends: [(f64, f64); 2],
}

impl Closing {
    fn between(speed: &dyn Fn(f64) -> f64, segment: Segment, period: f64, step: f64) -> Self {
        let way = period - segment.length();
        let log = |phi: f64| speed(phi).ln();
        // One-sided, for outside the segment nothing is known.
        let end = |phi: f64, h: f64| {
            let slope = (4.0 * log(phi + h) - log(phi + 2.0 * h) - 3.0 * log(phi)) / (2.0 * h);
            (log(phi), if slope.is_finite() { slope * way } else { 0.0 })
        };
        Self { ends: [end(segment.to, -step), end(segment.from, step)] }
    }

    /// psi' at a share of the way, the bump `height` high.
    fn at(&self, t: f64, height: f64) -> f64 {
        let [(p, v), (q, w)] = self.ends;
        let r = 1.0 - t;
        let cubic = r * r * (1.0 + 2.0 * t) * p + t * r * r * v + t * t * (3.0 - 2.0 * t) * q
            - t * t * r * w;
        // Flat in the middle, no value and no slope at the ends.
        let bump = (1.0 - (2.0 * t - 1.0).powi(4)).powi(2);
        (cubic + height * bump).exp()
    }
}

/// The zero of a rising function.
fn root(f: impl Fn(f64) -> f64) -> f64 {
    let mut reach = 1.0;
    while reach < policy::LAW_CLOSING_MOST && (f(-reach) > 0.0 || f(reach) < 0.0) {
        reach *= 2.0;
    }
    let (mut low, mut high) = (-reach, reach);
    for _ in 0..policy::LAW_CLOSING_HALVINGS {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::Ratio;
    use std::f64::consts::TAU;

    fn options(quantity: Quantity) -> LawOptions {
        LawOptions { quantity, ..LawOptions::default() }
    }

    #[test]
    fn the_segment_is_followed_and_the_rest_is_smooth() {
        let law = |phi: f64| 0.6 + 0.4 * phi;
        let segment = Segment { from: -0.5, to: 1.7 };
        let made = from_segment(law, segment, &options(Quantity::Speed)).unwrap();
        for k in 0..=20 {
            let phi = segment.from + 0.01 + (segment.length() - 0.02) * f64::from(k) / 20.0;
            assert!((made.derivative(phi) - law(phi)).abs() < 1e-4, "{phi}");
        }
        assert!((made.psi(TAU) - TAU).abs() < 1e-9);
        // No step in the acceleration beyond what the law itself has.
        let slope = |phi: f64| (made.derivative(phi + 1e-3) - made.derivative(phi - 1e-3)) / 2e-3;
        for end in [segment.from, segment.to] {
            assert!((slope(end + 0.02) - slope(end - 0.02)).abs() < 0.15, "{end}");
        }
        assert!(made.min_derivative() > 0.1);
    }

    #[test]
    fn angles_and_speeds_agree_at_any_ratio() {
        let ratio = Ratio::rational(3, 2).unwrap();
        let segment = Segment { from: 0.2, to: 1.6 };
        let with = |quantity| LawOptions { ratio, ..options(quantity) };
        let speed = from_segment(|phi| 0.5 + 0.1 * phi, segment, &with(Quantity::Speed)).unwrap();
        let angle = |phi: f64| 0.5 * phi + 0.05 * phi * phi;
        let by_angle = from_segment(angle, segment, &with(Quantity::Angle)).unwrap();
        for k in 0..30 {
            let phi = 0.2 * f64::from(k);
            assert!((speed.psi(phi) - by_angle.psi(phi)).abs() < 1e-6, "{phi}");
        }
        assert_eq!((speed.driver_fold(), speed.follower_fold()), (2, 3));
    }

    #[test]
    fn what_cannot_be_closed_is_told_so() {
        let plain = options(Quantity::Speed);
        let segment = Segment { from: 0.0, to: 3.0 };
        let fast = from_segment(|_| 2.2, segment, &plain).unwrap_err();
        assert!(
            matches!(fast, LawError::SegmentGain { .. }) && fast.to_string().contains("378.2"),
            "{fast}"
        );
        let stops = from_segment(|phi| 1.0 - 0.5 * phi, segment, &plain).unwrap_err();
        assert!(matches!(stops, LawError::NotPositive { .. }), "{stops}");
        for (from, to) in
            [(1.0, 1.0), (2.0, 1.0), (0.0, 7.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)]
        {
            let error = from_segment(|_| 1.0, Segment { from, to }, &plain).unwrap_err();
            assert!(matches!(error, LawError::SegmentLength { .. }), "{error}");
        }
        let radius = from_segment(|_| 1.0, segment, &options(Quantity::DriverRadius)).unwrap_err();
        assert_eq!(radius, LawError::SegmentOfRadius);
        assert!(from_segment(|_| f64::NAN, segment, &plain).is_err());
        // Little left to turn: still a motion; next to nothing: none.
        let slow = from_segment(|_| 1.7, segment, &plain).unwrap();
        assert!(slow.min_derivative() > 0.0);
        let slower = from_segment(|_| 1.98, segment, &plain).unwrap_err();
        assert!(matches!(slower, LawError::SegmentGain { .. }), "{slower}");
    }
}
