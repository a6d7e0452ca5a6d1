//! A pair as trains are made of it.

use super::{Fittings, Gear};
use crate::gear::{MotionError, Pair, SampledMotion};
use crate::geometry::Point;

/// A pair of gears that trains are made of. Lengths mm, each gear in its own frame.
#[derive(Clone, Debug)]
pub struct PairModel {
    /// Driver and follower as designed.
    pub gears: Pair<Gear>,
    /// psi over the driver angle.
    pub motion: SampledMotion,
    /// Distance of the axes.
    pub center_distance: f64,
    /// Module.
    pub module: f64,
}

impl PairModel {
    /// The pair with its follower as the driver, turning in the sense in which the pair was designed to turn. Each gear
    /// is seen from below, so that the new driver turns counter-clockwise; fittings are left out.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn swapped(&self) -> Result<Self, MotionError> {
        let seen = |ring: &[Point]| ring.iter().rev().map(|p| Point::new(-p.x, p.y)).collect();
        let turned_over = |gear: &Gear| Gear {
            name: gear.name.clone(),
            outline: seen(&gear.outline),
            bore: gear.bore.as_deref().map(seen),
            pitch_curve: seen(&gear.pitch_curve),
            input: seen(&gear.input),
            teeth: gear.teeth,
            fittings: Fittings::default(),
        };
        Ok(Self {
            gears: Pair {
                driver: turned_over(&self.gears.follower),
                follower: turned_over(&self.gears.driver),
            },
            motion: self.motion.inverted()?,
            ..*self
        })
    }
}
