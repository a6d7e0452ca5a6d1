//! A motion known by samples, as files carry it.

use super::Motion;
use crate::geometry::solve_cyclic;
use crate::policy;

/// psi and psi' through samples of one whole cycle, repeated for ever: a periodic cubic spline.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledMotion {
    driver: Vec<f64>,
    follower: Vec<f64>,
    slope: Vec<f64>,
    /// How many times the samples make one whole cycle.
    repeats: u32,
}

/// Why samples make no motion.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MotionError {
    /// Fewer than four samples, or lists of unequal length.
    #[error(
        "the motion has {driver} driver and {follower} follower angles; give at least four of each, as many of one as of the other"
    )]
    BadCount {
        /// Driver angles given.
        driver: usize,
        /// Follower angles given.
        follower: usize,
    },
    /// An angle is not finite, or does not increase.
    #[error(
        "the motion does not increase at sample {index}; both angles must grow from one sample to the next"
    )]
    NotIncreasing {
        /// Index of the sample, from zero.
        index: usize,
    },
    /// The gears are sectors.
    #[error(
        "the gears are cut to sectors that swing over a part of a turn; give a pair made without --sector"
    )]
    Swings,
    /// The assembly is not a pair.
    #[error("the assembly has {count} gears; give a pair")]
    NotAPair {
        /// Gears in it.
        count: usize,
    },
}

impl SampledMotion {
    /// The motion through `follower` (radians, in the sense of its own rotation, increasing) at
    /// `driver` (radians, increasing); the last sample closes one whole cycle of both gears.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn new(driver: &[f64], follower: &[f64]) -> Result<Self, MotionError> {
        if driver.len() != follower.len() || driver.len() < 4 {
            return Err(MotionError::BadCount { driver: driver.len(), follower: follower.len() });
        }
        let grows = |v: &[f64], i: usize| v[i].is_finite() && v[i] > v[i - 1];
        if let Some(index) = (1..driver.len()).find(|&i| !(grows(driver, i) && grows(follower, i)))
        {
            return Err(MotionError::NotIncreasing { index });
        }
        if !(driver[0].is_finite() && follower[0].is_finite()) {
            return Err(MotionError::NotIncreasing { index: 0 });
        }
        let slope = slopes(driver, follower);
        Ok(Self { driver: driver.to_vec(), follower: follower.to_vec(), slope, repeats: 1 })
    }

    /// The same motion, of which `count` cycles of the samples make a whole cycle of both gears.
    #[must_use]
    pub fn repeated(self, count: u32) -> Self {
        Self { repeats: self.repeats * count.max(1), ..self }
    }

    /// The motion of the same pair with its follower as the driver.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn inverted(&self) -> Result<Self, MotionError> {
        Ok(Self::new(&self.follower, &self.driver)?.repeated(self.repeats))
    }

    /// Driver angle of one whole cycle, radians.
    #[must_use]
    pub fn cycle(&self) -> f64 {
        f64::from(self.repeats) * self.span()
    }

    /// Driver angle that the samples cover.
    fn span(&self) -> f64 {
        self.driver[self.driver.len() - 1] - self.driver[0]
    }

    /// psi at a driver angle, radians.
    #[must_use]
    pub fn psi(&self, driver_angle: f64) -> f64 {
        let (i, t, turns) = self.place(driver_angle);
        let last = self.follower.len() - 1;
        let h = self.driver[i + 1] - self.driver[i];
        let (y0, y1) = (self.follower[i], self.follower[i + 1]);
        let (s0, s1) = (h * self.slope[i], h * self.slope[(i + 1) % last]);
        let rise = turns * (self.follower[last] - self.follower[0]);
        let (t2, t3) = (t * t, t * t * t);
        rise + y0
            + s0 * t
            + (3.0 * (y1 - y0) - 2.0 * s0 - s1) * t2
            + (2.0 * (y0 - y1) + s0 + s1) * t3
    }

    /// psi' at a driver angle.
    #[must_use]
    pub fn derivative(&self, driver_angle: f64) -> f64 {
        let (i, t, _) = self.place(driver_angle);
        let last = self.follower.len() - 1;
        let h = self.driver[i + 1] - self.driver[i];
        let rise = self.follower[i + 1] - self.follower[i];
        let (s0, s1) = (h * self.slope[i], h * self.slope[(i + 1) % last]);
        (s0 + 2.0 * (3.0 * rise - 2.0 * s0 - s1) * t + 3.0 * (s0 + s1 - 2.0 * rise) * t * t) / h
    }

    /// The driver angle at which psi is `follower_angle`, both radians; psi of it is `follower_angle` to rounding.
    #[must_use]
    pub fn inverse(&self, follower_angle: f64) -> f64 {
        let last = self.follower.len() - 1;
        let rise = self.follower[last] - self.follower[0];
        let turns = ((follower_angle - self.follower[0]) / rise).floor();
        let at = follower_angle - turns * rise;
        let i = self.follower.partition_point(|&f| f <= at).clamp(1, last) - 1;
        let (mut low, mut high) = (self.driver[i], self.driver[i + 1]);
        let share = (at - self.follower[i]) / (self.follower[i + 1] - self.follower[i]);
        let mut guess = low + share * (high - low);
        // Newton's method, kept in the interval in which psi passes the angle.
        for _ in 0..policy::INVERSE_STEPS {
            let off = self.psi(guess) - at;
            if off > 0.0 {
                high = guess
            } else {
                low = guess
            }
            let next = guess - off / self.derivative(guess);
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            if (next - guess).abs() <= f64::EPSILON * (1.0 + guess.abs()) {
                break;
            }
            guess = next;
        }
        guess + turns * self.span()
    }

    /// Interval, place in it (0 to 1) and whole cycles before it.
    fn place(&self, driver_angle: f64) -> (usize, f64, f64) {
        let turns = ((driver_angle - self.driver[0]) / self.span()).floor();
        let at = driver_angle - turns * self.span();
        let i = self.driver.partition_point(|&d| d <= at).clamp(1, self.driver.len() - 1) - 1;
        (i, (at - self.driver[i]) / (self.driver[i + 1] - self.driver[i]), turns)
    }
}

impl Motion for SampledMotion {
    fn psi(&self, driver_angle: f64) -> f64 {
        self.psi(driver_angle)
    }

    fn derivative(&self, driver_angle: f64) -> f64 {
        self.derivative(driver_angle)
    }

    fn cycle(&self) -> f64 {
        self.cycle()
    }
}

/// Slopes that make the second derivative continuous round the cycle.
fn slopes(driver: &[f64], follower: &[f64]) -> Vec<f64> {
    let n = driver.len() - 1;
    let h = |i: usize| driver[i + 1] - driver[i];
    let rate = |i: usize| (follower[i + 1] - follower[i]) / h(i);
    let before = |i: usize| (i + n - 1) % n;
    let lower: Vec<f64> = (0..n).map(|i| 1.0 / h(before(i))).collect();
    let upper: Vec<f64> = (0..n).map(|i| 1.0 / h(i)).collect();
    let diagonal: Vec<f64> = lower.iter().zip(&upper).map(|(a, b)| 2.0 * (a + b)).collect();
    let rhs: Vec<f64> =
        (0..n).map(|i| 3.0 * (rate(before(i)) * lower[i] + rate(i) * upper[i])).collect();
    solve_cyclic(&lower, &diagonal, &upper, &rhs)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn a_wavy_motion_is_followed_between_its_samples() {
        let psi = |a: f64| a + 0.2 * a.sin();
        let driver: Vec<f64> = (0..=256).map(|i| TAU * f64::from(i) / 256.0).collect();
        let follower: Vec<f64> = driver.iter().map(|&a| psi(a)).collect();
        let motion = SampledMotion::new(&driver, &follower).unwrap();
        for a in [-7.3, 0.0, 0.1234, 3.3, 6.25, TAU, 20.0] {
            assert!((motion.psi(a) - psi(a)).abs() < 1e-8, "{a}");
            assert!((motion.derivative(a) - (1.0 + 0.2 * a.cos())).abs() < 1e-6, "{a}");
            assert!((motion.inverse(motion.psi(a)) - a).abs() < 1e-12, "{a}");
        }
    }

    #[test]
    fn a_repeated_motion_differs_in_its_cycle_alone() {
        let driver = [0.0, 1.0, 2.0, 3.0, 4.0];
        let once = SampledMotion::new(&driver, &[0.0, 0.4, 1.1, 1.4, 2.0]).unwrap();
        let thrice = once.clone().repeated(3);
        assert_eq!((once.cycle(), thrice.cycle()), (4.0, 12.0));
        for a in [-5.0, 0.3, 3.9, 11.0] {
            assert_eq!(thrice.psi(a), once.psi(a));
            assert!((thrice.inverse(once.psi(a)) - a).abs() < 1e-12);
        }
    }

    #[test]
    fn a_motion_that_stops_is_refused() {
        let angles = [0.0, 1.0, 2.0, 2.0, 3.0];
        let steady = [0.0, 1.0, 2.0, 3.0, 4.0];
        let error = SampledMotion::new(&steady, &angles);
        assert_eq!(error, Err(MotionError::NotIncreasing { index: 3 }));
        assert!(SampledMotion::new(&steady[..3], &steady[..3]).is_err());
    }
}
