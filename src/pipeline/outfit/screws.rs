//! A circle of screw holes.

use super::{OutfitError, Screws, Taken, clear_radius};
use crate::assembly::{Gear, Opening};
use crate::geometry::Point;
use crate::policy;
use crate::solid::hole;
use std::f64::consts::{PI, TAU};

pub(super) fn add(gear: &mut Gear, choice: &Screws, taken: &mut Taken) -> Result<(), OutfitError> {
    let wall = policy::BORE_WALL;
    let clear = clear_radius(&gear.outline);
    let (inner, outer) = (taken.radius + wall, clear - wall);
    let place = choice.circle.unwrap_or(0.5 * (inner + outer));
    // As large as the nearest of bore, roots and next hole allow.
    let beside = if choice.count > 1 {
        place * (PI / f64::from(choice.count)).sin() - 0.5 * wall
    } else {
        f64::INFINITY
    };
    let largest = (place - inner).min(outer - place).min(beside).max(0.0);
    let radius = 0.5 * choice.diameter;
    // Rounding must not refuse the size that was told.
    if radius > largest + 1e-9 {
        return Err(OutfitError::NoRoom {
            gear: gear.name.clone(),
            what: format!("{} screws on a circle of radius {place:.1} mm", choice.count),
            asked: choice.diameter,
            largest: 2.0 * largest,
        });
    }
    for i in 0..choice.count {
        // Off the x axis, where the phase mark is.
        let angle = TAU * (f64::from(i) + 0.5) / f64::from(choice.count);
        let center = Point::new(place * angle.cos(), place * angle.sin());
        let round = hole(radius, policy::BORE_CHORD_TOLERANCE);
        let ring: Vec<Point> = round.iter().map(|p| center + p.coords).collect();
        taken.rings.push(ring.clone());
        gear.fittings.openings.push(Opening { name: format!("screw {}", i + 1), ring });
    }
    Ok(())
}
