//! The motions that a pair makes: the designed one, and what it makes of it under load.
//!
//! Clearance lets the follower fall behind its designed angle until flanks of hand -1 hold it, or run
//! ahead until those of hand +1 do. Each hand is generated in the motion in which it carries, so that
//! it is conjugate with its clearance, and the follower may stand anywhere between the two.

use super::rolling::{Instant, Rolling};
use crate::gear::Motion;
use crate::pitch::{Centrodes, Transmission};

/// The motion of the follower while one hand of flanks carries: `psi(phi)` of a transmission, and an angle
/// at which it starts.
#[derive(Clone, Debug)]
pub struct LoadedMotion {
    transmission: Transmission,
    offset: f64,
}

impl LoadedMotion {
    /// A motion that starts at follower angle `offset`, radians.
    pub(crate) fn new(transmission: Transmission, offset: f64) -> Self {
        Self { transmission, offset }
    }

    /// The motion from angle 0.
    pub(crate) fn transmission(&self) -> &Transmission {
        &self.transmission
    }

    /// Follower angle at driver angle 0, radians.
    pub(crate) fn offset(&self) -> f64 {
        self.offset
    }

    fn rolling(&self, center_distance: f64) -> Rolling {
        let centrodes = Centrodes { transmission: self.transmission.clone(), center_distance };
        Rolling::with_offset(centrodes, self.offset)
    }
}

/// At driver angle 0 the follower stands at the offset, not at 0.
impl Motion for LoadedMotion {
    fn psi(&self, driver_angle: f64) -> f64 {
        self.transmission.psi(driver_angle) + self.offset
    }

    fn derivative(&self, driver_angle: f64) -> f64 {
        self.transmission.derivative(driver_angle)
    }

    fn cycle(&self) -> f64 {
        self.transmission.cycle()
    }
}

/// The designed rolling and, where there is clearance, the two of the loaded pair.
#[derive(Clone, Debug)]
pub(crate) struct Motions {
    designed: Rolling,
    /// Follower behind, ahead.
    loaded: Option<Box<[Rolling; 2]>>,
}

impl Motions {
    /// Without clearance the pair makes the designed motion under any load.
    pub(crate) fn without_clearance(designed: Rolling) -> Self {
        Self { designed, loaded: None }
    }

    /// The same pair with other motions under load, behind first.
    pub(crate) fn with_loaded(self, loaded: &[LoadedMotion; 2]) -> Self {
        let center_distance = self.designed.centrodes().center_distance;
        let loaded = loaded.each_ref().map(|motion| motion.rolling(center_distance));
        Self { designed: self.designed, loaded: Some(Box::new(loaded)) }
    }

    /// The designed rolling.
    pub(crate) fn designed(&self) -> &Rolling {
        &self.designed
    }

    /// The rolling in which flanks of hand `sigma` touch.
    pub(crate) fn of(&self, sigma: f64) -> &Rolling {
        match self.loaded.as_deref() {
            None => &self.designed,
            Some([behind, ahead]) => {
                if sigma < 0.0 {
                    behind
                } else {
                    ahead
                }
            }
        }
    }

    /// Whether the follower can stand at more than one angle.
    pub(crate) fn has_play(&self) -> bool {
        self.loaded.is_some()
    }

    /// Follower angle minus its designed angle when flanks of hand `sigma` carry, radians.
    pub(crate) fn lead(&self, sigma: f64, phi: f64) -> f64 {
        self.of(sigma).follower_angle(phi) - self.designed.follower_angle(phi)
    }

    /// The gears at designed arc length `s`, the follower between its place behind (`level` 0) and ahead
    /// (1). Of the pitch curves only the pitch point is known.
    pub(crate) fn between(&self, s: f64, level: f64) -> Instant {
        let phi = self.designed.driver_angle(s);
        let mix = |value: &dyn Fn(&Rolling) -> f64| {
            let (behind, ahead) = (value(self.of(-1.0)), value(self.of(1.0)));
            behind + level * (ahead - behind)
        };
        let psi = mix(&|rolling| rolling.follower_angle(phi));
        let speed = mix(&|rolling| rolling.centrodes().transmission.derivative(phi));
        let center_distance = self.designed.centrodes().center_distance;
        Instant::of_motion(phi, psi, speed, center_distance).counted(s)
    }
}
