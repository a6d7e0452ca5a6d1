//! The pair under check: outlines on their axes, what is known of their teeth, and where the
//! follower can stand.

use super::teeth::Teeth;
use crate::geometry::{Point, gcd};
use crate::meshing::{Gap, GapFinder};
use std::f64::consts::PI;

/// Two gears in their own frames.
#[derive(Debug)]
pub(super) struct Pair {
    pub(super) driver: Vec<Point>,
    pub(super) follower: Vec<Point>,
    pub(super) center_distance: f64,
    pub(super) module: f64,
    pub(super) teeth: [Teeth; 2],
    pub(super) finder: GapFinder,
}

impl Pair {
    pub(super) fn new(
        driver: Vec<Point>,
        follower: Vec<Point>,
        center_distance: f64,
        teeth: [Teeth; 2],
    ) -> Self {
        let module = 0.5 * (teeth[0].pitch + teeth[1].pitch) / PI;
        let finder = GapFinder::new(&driver, &follower, center_distance, module);
        Self { driver, follower, center_distance, module, teeth, finder }
    }

    /// Whether both gears are round about their axes.
    pub(super) fn is_round(&self) -> bool {
        self.teeth.iter().all(|t| t.round)
    }

    /// Turns of the driver for one of the follower, by the teeth.
    pub(super) fn ratio(&self) -> f64 {
        f64::from(self.teeth[1].count) / f64::from(self.teeth[0].count)
    }

    /// Turns of the driver until all teeth meet as before.
    pub(super) fn cycle_turns(&self) -> u32 {
        let [a, b] = [self.teeth[0].count, self.teeth[1].count];
        b / gcd(a, b).max(1)
    }

    /// Radii of driver and follower at the pitch point, mm, by their middle lines.
    pub(super) fn radii(&self, driver_angle: f64, follower_angle: f64) -> [f64; 2] {
        let driver = self.teeth[0].radius(-driver_angle);
        let follower = self.teeth[1].radius(PI + follower_angle);
        let scale = self.center_distance / (driver + follower);
        [driver * scale, follower * scale]
    }

    /// Pitch of the follower there, radians.
    pub(super) fn pitch(&self, driver_angle: f64, follower_angle: f64) -> f64 {
        PI * self.module / self.radii(driver_angle, follower_angle)[1]
    }

    /// The gap about a follower angle.
    pub(super) fn gap(&self, driver_angle: f64, follower_angle: f64) -> Option<Gap> {
        let radius = self.radii(driver_angle, follower_angle)[1];
        self.finder.gap(driver_angle, follower_angle, radius)
    }

    /// How deep the gears lie in each other, mm.
    pub(super) fn depth(&self, driver_angle: f64, follower_angle: f64) -> f64 {
        let radius = self.radii(driver_angle, follower_angle)[1];
        self.finder.depth(driver_angle, follower_angle, radius)
    }
}
