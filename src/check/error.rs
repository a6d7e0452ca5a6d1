//! What cannot be checked.

use super::motion::MotionFileError;
use crate::gear::Side;
use crate::meshing::{ContactError, DynamicsError};

/// Why a pair cannot be checked. A pair that can be, and fails, is no error.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CheckError {
    /// No centre distance.
    #[error("the distance of the axes is not known; give --center-distance")]
    NoCenterDistance,
    /// A number that is not above zero.
    #[error("the {name} is {value}; give a number above zero")]
    NotPositive {
        /// What it is.
        name: &'static str,
        /// What was given.
        value: f64,
    },
    /// An axis beside its gear.
    #[error(
        "the {gear}'s axis ({x:.3}, {y:.3}) lies outside the gear; give one inside its outline"
    )]
    AxisOutside {
        /// Which gear.
        gear: Side,
        /// Where, mm.
        x: f64,
        /// Where, mm.
        y: f64,
    },
    /// No hint where the axis is.
    #[error(
        "the {gear} has {holes} holes and the origin is outside it, so its axis is unknown; give --{gear}-axis x,y"
    )]
    NoAxis {
        /// Which gear.
        gear: Side,
        /// Holes in it.
        holes: usize,
    },
    /// No regular teeth.
    #[error("no regular teeth were found on the {gear}; give a toothed outline, or --teeth N,M")]
    NoTeeth {
        /// Which gear.
        gear: Side,
    },
    /// A count of teeth that is out of range.
    #[error(
        "the {gear} is said to have {count} teeth; give --teeth N,M with {least} to {most} each"
    )]
    TeethRange {
        /// Which gear.
        gear: Side,
        /// Teeth given, or recorded.
        count: u32,
        /// Fewest that are counted.
        least: u32,
        /// Most that are counted.
        most: u32,
    },
    /// The motion is no motion.
    #[error(transparent)]
    Motion(#[from] MotionFileError),
    /// The cycle is too long.
    #[error(
        "{driver} and {follower} teeth meet as before only after {turns} turns of the driver, more than {limit}; give --teeth N,M if they are counted wrongly, else --ratio or --motion"
    )]
    LongCycle {
        /// Teeth of the driver.
        driver: u32,
        /// Teeth of the follower.
        follower: u32,
        /// Turns of the driver.
        turns: u32,
        /// Most that are checked.
        limit: u32,
    },
    /// The contact analysis refuses.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// The rigid-body run refuses.
    #[error(transparent)]
    Dynamics(#[from] DynamicsError),
}
