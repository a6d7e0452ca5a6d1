use std::fmt::Debug;

/// How the follower turns with the driver: psi, increasing, and over which driver angle both gears come back.
///
/// Angles are radians, each in the sense in which its gear turns; any real driver angle is allowed. What is asked at one
/// angle is asked many times, so it should cost no more than a look into a table.
pub trait Motion: Debug + Sync {
    /// Follower angle at a driver angle.
    fn psi(&self, driver_angle: f64) -> f64;

    /// psi' there: speed of the follower over that of the driver, torque of the driver over that of the follower.
    fn derivative(&self, driver_angle: f64) -> f64;

    /// Driver angle of one whole cycle, after which all teeth meet as before.
    fn cycle(&self) -> f64;
}

/// Round gears: the follower turns evenly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EvenMotion {
    /// psi', which stays as it is.
    pub speed: f64,
    /// Driver angle of one whole cycle, radians.
    pub cycle: f64,
}

impl Motion for EvenMotion {
    fn psi(&self, driver_angle: f64) -> f64 {
        self.speed * driver_angle
    }

    fn derivative(&self, _driver_angle: f64) -> f64 {
        self.speed
    }

    fn cycle(&self) -> f64 {
        self.cycle
    }
}

/// A motion run backwards and seen in a mirror, so that the driver turns counter-clockwise again.
#[derive(Clone, Copy, Debug)]
pub struct Mirrored<'a>(pub &'a dyn Motion);

impl Motion for Mirrored<'_> {
    fn psi(&self, driver_angle: f64) -> f64 {
        -self.0.psi(-driver_angle)
    }

    fn derivative(&self, driver_angle: f64) -> f64 {
        self.0.derivative(-driver_angle)
    }

    fn cycle(&self) -> f64 {
        self.0.cycle()
    }
}
