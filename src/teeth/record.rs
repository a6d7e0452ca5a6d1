//! What became of each tooth.

use super::flank::Flank;
use super::layout::{Layout, Rack};
use super::motions::Motions;
use crate::gear::Side;
use crate::policy;

/// How a tooth differs from the rack's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ToothShape {
    /// Full height, no flank steeper than the pressure angle asked for; flatter where the pitch curve slopes.
    Full,
    /// Full height, but a flank needed a steeper pressure angle to stay in contact.
    Steeper,
    /// Cut short, because a flank of one of the gears would have a cusp there (undercut).
    Shortened,
    /// Cut short, because its two flanks meet in a point.
    Blunted,
}

/// One tooth of one gear.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct ToothRecord {
    /// The gear.
    pub side: Side,
    /// Number of the tooth in order of mesh, from zero, within one period of the motion.
    pub index: usize,
    /// What became of it.
    pub shape: ToothShape,
    /// Pressure angles of its two flanks, radians, in order of mesh.
    pub pressure_angles: [f64; 2],
    /// Height above the pitch curve at the two corners of its tip, in modules.
    pub heights: [f64; 2],
    /// Width of its tip, in modules.
    pub top_land: f64,
    /// Rolled length in contact of its two flanks over the pitch.
    pub contact_ratios: [f64; 2],
}

/// The record of every tooth of one period, driver first.
pub(crate) fn records(motions: &Motions, layout: &Layout, rack: &Rack) -> Vec<ToothRecord> {
    Side::BOTH
        .into_iter()
        .flat_map(|side| {
            layout
                .teeth(side)
                .into_iter()
                .enumerate()
                .map(move |(index, tooth)| record(motions, rack, side, index, &tooth))
        })
        .collect()
}

fn record(
    motions: &Motions,
    rack: &Rack,
    side: Side,
    index: usize,
    tooth: &[Flank; 2],
) -> ToothRecord {
    let rolling = motions.designed();
    let corners = tooth.map(|flank| {
        let delta = side.sign() * flank.reach(side);
        rolling.foot(side, flank.point(motions.of(flank.sigma), side, delta), flank.station)
    });
    let heights = corners.map(|(_, height)| height / rack.module);
    let middle = rolling.at(0.5 * (corners[0].0 + corners[1].0)).local(side);
    let mean = 0.5 * (corners[0].1 + corners[1].1);
    let top_land = (corners[1].0 - corners[0].0) * (1.0 + middle.curvature * mean) / rack.module;
    let full = heights.iter().all(|h| *h > rack.addendum / rack.module - policy::HEIGHT_GIVEN_UP);
    let steeper = tooth.iter().any(|f| f.alpha > rack.pressure_angle + policy::SAME_ANGLE);
    let shape = match (full, steeper) {
        (true, false) => ToothShape::Full,
        (true, true) => ToothShape::Steeper,
        (false, _) if top_land < policy::SMALLEST_TOP_LAND + policy::HEIGHT_GIVEN_UP => {
            ToothShape::Blunted
        }
        (false, _) => ToothShape::Shortened,
    };
    ToothRecord {
        side,
        index,
        shape,
        pressure_angles: tooth.map(|f| f.alpha),
        heights,
        top_land,
        contact_ratios: tooth.map(|f| f.contact_length() / rack.pitch),
    }
}
