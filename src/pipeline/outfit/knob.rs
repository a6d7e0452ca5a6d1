//! A knob to turn the driver by: a hole in its face and a part that is pushed into it.

use super::{OutfitError, Taken};
use crate::assembly::{Fixture, Gear, Opening, Post, Stance};
use crate::geometry::{self, Point};
use crate::outline::simplify;
use crate::policy;
use crate::solid::{circle, hole};

/// Radii of the grip that are tried, mm: as two fingers like it, and less where there is little room.
const GRIPS: [f64; 3] = [6.0, 5.0, 4.0];
/// Height of the grip, mm.
const GRIP_HEIGHT: f64 = 16.0;
/// Radius of the peg, in radii of the grip.
const PEG_SHARE: f64 = 0.5;
/// Play a side of the peg, mm: it is pushed in and stays.
const PEG_PLAY: f64 = 0.05;
/// Wall between the hole and the edge, mm.
const WALL: f64 = 2.0;
/// How far the peg stays above the bottom face, mm.
const PEG_SHORT: f64 = 0.5;

/// Cuts the hole as far from the axis as the grip has room, and makes the knob for gear number `number`.
pub(super) fn add(
    gear: &mut Gear,
    number: usize,
    thickness: f64,
    taken: &mut Taken,
) -> Result<Fixture, OutfitError> {
    let fine = policy::BORE_CHORD_TOLERANCE;
    let found = GRIPS.into_iter().find_map(|grip| Some((grip, place(gear, grip, taken)?)));
    let Some((grip, at)) = found else {
        return Err(OutfitError::NoRoom {
            gear: gear.name.clone(),
            what: "a knob".to_owned(),
            asked: 2.0 * GRIPS[2],
            largest: 0.0,
        });
    };
    let around = |radius| circle(radius, fine).iter().map(|p| p + at.coords).collect::<Vec<_>>();
    let peg = PEG_SHARE * grip;
    taken.rings.push(around(grip));
    let opening = hole(peg + PEG_PLAY, fine).iter().map(|p| p + at.coords).collect();
    gear.fittings.openings.push(Opening { name: "knob".to_owned(), ring: opening });
    Ok(Fixture {
        name: "knob".to_owned(),
        outline: circle(grip, fine),
        holes: Vec::new(),
        thickness: GRIP_HEIGHT,
        posts: vec![Post {
            ring: circle(peg, fine),
            hole: None,
            from: GRIP_HEIGHT,
            to: GRIP_HEIGHT + thickness - PEG_SHORT,
        }],
        pockets: Vec::new(),
        stance: Stance::turned_over(at, thickness + GRIP_HEIGHT).turning_with(number),
    })
}

/// The point farthest from the axis about which a grip stays over the gear and clear of all that is taken.
fn place(gear: &Gear, grip: f64, taken: &Taken) -> Option<Point> {
    let room = geometry::offset(
        &gear.outline,
        -(grip.max(PEG_SHARE * grip + WALL)),
        policy::OPENING_CHORD,
    );
    let barred = taken.grown(grip + policy::BORE_WALL);
    let corners = room.iter().flat_map(|face| simplify(&face[0], policy::OPENING_TOLERANCE));
    corners
        .filter(|p| !barred.iter().any(|ring| geometry::contains(ring, *p)))
        .max_by(|a, b| a.coords.norm().total_cmp(&b.coords.norm()))
}
