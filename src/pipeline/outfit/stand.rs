//! What goes with a base: feet, an upright stand, caps on the pins.

use super::OutfitError;
use super::base::moved;
use crate::assembly::{Fixture, PlacedGear, Pocket, Post, Stance};
use crate::geometry::{self, Point};
use crate::policy;
use crate::solid::{circle, hole};

/// Radius of the holes that feet are pushed into, mm.
pub(super) const FOOT_HOLE: f64 = 2.5;
/// Radius of a foot, mm.
const FOOT_RADIUS: f64 = 7.0;
/// Height of a foot, mm.
const FOOT_HEIGHT: f64 = 5.0;
/// Play a side of what is pushed in and stays, mm.
const PUSH_PLAY: f64 = 0.05;
/// How far a peg stays below the top of its hole, mm.
const PEG_SHORT: f64 = 0.5;

/// How far a pin reaches beyond its gear for a cap, mm: the gear's end play and the cap's grip.
pub(super) const CAP_REACH: f64 = CAP_PLAY + CAP_GRIP;
/// End play of a gear under its cap, mm.
const CAP_PLAY: f64 = 0.4;
/// Length of pin that a cap holds, mm.
const CAP_GRIP: f64 = 4.0;
/// Top of a cap over its pin, mm.
const CAP_ROOF: f64 = 1.2;
/// Wall of a cap, and how far it overlaps the bore, mm.
const CAP_WALL: f64 = 2.0;

/// Radius of the corners of an upright plate, mm.
pub(super) const CORNER: f64 = 6.0;
/// Plate below the reach of the teeth on an upright stand, mm: the height of its feet, and fingers' room.
pub(super) const ROOM_BELOW: f64 = STAND_HEIGHT + 3.0;
/// Height of the feet of an upright stand, mm.
const STAND_HEIGHT: f64 = 16.0;
/// Narrowest stand, mm.
const STAND_LEAST: f64 = 50.0;
/// Width of a stand in heights of its plate: it does not tip when the gears are turned.
const STAND_SHARE: f64 = 0.45;
/// Height of the ends of a foot, mm.
const STAND_TOE: f64 = 5.0;
/// Wall beside the slot at its top, mm.
const STAND_CHEEK: f64 = 6.0;
/// Play a side where plate and foot are pushed into each other, mm.
const SLOT_PLAY: f64 = 0.1;

/// A foot with a peg for each hole under a plate.
pub(super) fn feet(holes: &[Point], plate: Stance, thickness: f64) -> Vec<Fixture> {
    let fine = policy::BORE_CHORD_TOLERANCE;
    let bottom = plate.place.translation.z;
    let foot = |(i, at): (usize, &Point)| Fixture {
        name: format!("foot-{}", i + 1),
        outline: circle(FOOT_RADIUS, fine),
        holes: Vec::new(),
        thickness: FOOT_HEIGHT,
        posts: vec![Post {
            ring: circle(FOOT_HOLE - PUSH_PLAY, fine),
            hole: None,
            from: FOOT_HEIGHT,
            to: FOOT_HEIGHT + thickness - PEG_SHORT,
        }],
        pockets: Vec::new(),
        stance: Stance::at(*at, bottom - FOOT_HEIGHT),
    };
    holes.iter().enumerate().map(foot).collect()
}

/// A cap for a pin of `radius` through a gear whose top is at world height `top`: printed with its opening up.
pub(super) fn cap(placed: &PlacedGear, radius: f64, top: f64) -> Fixture {
    let fine = policy::BORE_CHORD_TOLERANCE;
    let bore = placed.gear.bore.iter().flatten().map(|p| p.coords.norm()).fold(0.0, f64::max);
    let height = CAP_ROOF + CAP_GRIP;
    Fixture {
        name: format!("{}-cap", placed.gear.name),
        outline: circle(bore.max(radius) + CAP_WALL, fine),
        holes: Vec::new(),
        thickness: height,
        posts: Vec::new(),
        pockets: vec![Pocket {
            ring: hole(radius + PUSH_PLAY, fine),
            hole: None,
            from: CAP_ROOF,
            to: height,
        }],
        stance: Stance::turned_over(placed.axis, top + CAP_PLAY + height),
    }
}

/// Notches the lower edge of a plate between `low` and `high` and makes the two feet that it stands in.
pub(super) fn upright(
    plate: &mut Fixture,
    low: Point,
    high: Point,
) -> Result<Vec<Fixture>, OutfitError> {
    let width = plate.thickness;
    let half = 0.5 * width + SLOT_PLAY;
    let inset = CORNER + width;
    let places = [low.x + inset, high.x - inset];
    let notches: Vec<Vec<Point>> = places
        .iter()
        .map(|x| {
            let (left, right) = (x - half, x + half);
            let (below, above) = (low.y - 1.0, low.y + 0.5 * STAND_HEIGHT);
            [(left, below), (right, below), (right, above), (left, above)]
                .map(|(x, y)| Point::new(x, y))
                .to_vec()
        })
        .collect();
    let cut = geometry::largest(geometry::difference(&plate.outline, &notches));
    let no_room = || OutfitError::BadSize {
        what: "the thickness of the base",
        value: width,
        remedy: "the plate is too small for two feet; give a thinner one".to_owned(),
    };
    let ring = cut.filter(|face| face.len() == 1).ok_or_else(no_room)?;
    plate.outline = ring.into_iter().next().ok_or_else(no_room)?;
    let reach = (STAND_SHARE * (high.y - low.y)).max(STAND_LEAST) * 0.5;
    let cheek = half + STAND_CHEEK;
    let middle = 0.5 * STAND_HEIGHT;
    let side = [
        (reach, 0.0),
        (reach, STAND_TOE),
        (cheek, STAND_HEIGHT),
        (half, STAND_HEIGHT),
        (half, middle),
    ];
    let right = side.iter().map(|&(x, y)| Point::new(x, y));
    let left = side.iter().rev().map(|&(x, y)| Point::new(-x, y));
    let outline: Vec<Point> = right.chain(left).collect();
    let depth = plate.stance.place.translation.z + 0.5 * width;
    let foot = |(i, x): (usize, f64)| Fixture {
        name: format!("stand-{}", i + 1),
        outline: moved(&outline, Point::origin()),
        holes: Vec::new(),
        thickness: width,
        posts: Vec::new(),
        pockets: Vec::new(),
        stance: Stance::on_edge([x + 0.5 * width, low.y, depth]),
    };
    Ok(places.into_iter().enumerate().map(foot).collect())
}
