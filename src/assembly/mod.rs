//! Finished gears placed on their axes, and how they move.
//!
//! Every picture, solid and file is made from an [`Assembly`]; it knows
//! nothing of how the gears were designed.

mod bend;
mod collisions;
mod fittings;
mod pair_model;
mod train;

pub use bend::{Bent, BentChain};
pub use pair_model::PairModel;
pub use train::{Layout, Link, Train, TrainError, TrainGear, TrainPlan};

pub use fittings::{Fittings, Fixture, Hub, Mark, Opening, Pocket, Post, Stance};

use crate::gear::{MotionError, SampledMotion};
use crate::geometry::Point;
use nalgebra::{Isometry3, UnitQuaternion, Vector3};

/// A finished gear in its own frame: origin on its axis, mm, counter-clockwise outline.
#[derive(Clone, Debug, PartialEq)]
pub struct Gear {
    /// Name of the part in every file, such as `driver`.
    pub name: String,
    /// Toothed outline with clearance applied; no repeated last point.
    pub outline: Vec<Point>,
    /// Hole about the axis, counter-clockwise, or none.
    pub bore: Option<Vec<Point>>,
    /// Pitch curve (centrode), counter-clockwise.
    pub pitch_curve: Vec<Point>,
    /// The drawing this gear should resemble, placed in the gear's frame.
    pub input: Vec<Point>,
    /// Number of teeth on one full turn.
    pub teeth: u32,
    /// What it carries besides teeth and bore.
    pub fittings: Fittings,
}

/// A gear on its axis, with its motion.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedGear {
    /// The gear.
    pub gear: Gear,
    /// World position of the axis, mm.
    pub axis: Point,
    /// World height of its lower face, mm: gears on one axle lie in layers.
    pub level: f64,
    /// World rotation at each sample of [`Assembly::driver_angle`], radians,
    /// counter-clockwise positive, continuous (not wrapped), zero at the first sample.
    pub angle: Vec<f64>,
}

impl PlacedGear {
    /// 1 where the gear turns counter-clockwise, -1 where it turns clockwise.
    #[must_use]
    pub fn sense(&self) -> f64 {
        match (self.angle.first(), self.angle.last()) {
            (Some(first), Some(last)) if last < first => -1.0,
            _ => 1.0,
        }
    }
}

impl Assembly {
    /// What takes a gear's frame to the world's in the first pose, mm.
    #[must_use]
    pub fn first_pose(&self, gear: usize) -> Isometry3<f64> {
        let Some(placed) = self.gears.get(gear) else { return Isometry3::identity() };
        let angle = placed.angle.first().copied().unwrap_or(0.0);
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle);
        let shift = Vector3::new(placed.axis.x, placed.axis.y, placed.level);
        Isometry3::from_parts(shift.into(), turn)
    }

    /// What takes a fixture's frame to the world's in the first pose, mm.
    #[must_use]
    pub fn pose_of(&self, fixture: &Fixture) -> Isometry3<f64> {
        let Stance { place, with } = fixture.stance;
        with.map_or(place, |gear| self.first_pose(gear) * place)
    }

    /// Whether the gears swing there and back instead of turning round and round: the driver then ends where it began,
    /// and [`Assembly::driver_angle`] is the way it has gone, back as well as there.
    #[must_use]
    pub fn swings(&self) -> bool {
        let ends = self.gears.first().and_then(|g| g.angle.first().zip(g.angle.last()));
        ends.is_some_and(|(first, last)| last <= first)
    }

    /// The motion of a pair.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn motion(&self) -> Result<SampledMotion, MotionError> {
        let [_, follower] = self.gears.as_slice() else {
            return Err(MotionError::NotAPair { count: self.gears.len() });
        };
        let angles: Vec<f64> = follower.angle.iter().map(|a| -a).collect();
        SampledMotion::new(&self.driver_angle, &angles)
    }
}

/// Gears in mesh and one whole cycle of their motion. All axes are parallel to z.
#[derive(Clone, Debug, PartialEq)]
pub struct Assembly {
    /// The gears; the first is the driver.
    pub gears: Vec<PlacedGear>,
    /// Driver angle phi_D at each motion sample, radians, from zero, increasing;
    /// the last sample closes the cycle (every gear is back in its first pose).
    pub driver_angle: Vec<f64>,
    /// Thickness of every gear, mm, upwards from its level.
    pub thickness: f64,
    /// Gears that touch, by number, the one that drives first.
    pub meshes: Vec<[usize; 2]>,
    /// Gears fixed on one axle, by number.
    pub axles: Vec<[usize; 2]>,
    /// Parts beside the gears, such as a base plate or a knob.
    pub fixtures: Vec<Fixture>,
}
