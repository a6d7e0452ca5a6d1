//! Hubs.

use super::{HubChoice, OutfitError, Taken, clear_radius};
use crate::assembly::{Gear, Hub};
use crate::policy;

/// A hub stays within its own gear's roots. There the gear never overlaps its mate, so a hub above the
/// mate's face never meets the mate, its hub or what is raised on it.
pub(super) fn add(
    gear: &mut Gear,
    choice: &HubChoice,
    taken: &mut Taken,
) -> Result<(), OutfitError> {
    if choice.set_screw.is_some() && gear.bore.is_none() {
        return Err(OutfitError::NoBore { gear: gear.name.clone(), what: "a set screw" });
    }
    let wall = if choice.set_screw.is_some() {
        policy::SET_SCREW_THREAD.max(policy::HUB_WALL)
    } else {
        policy::HUB_WALL
    };
    let radius = choice.diameter.map_or(taken.radius + wall, |d| 0.5 * d);
    let most = clear_radius(&gear.outline) - policy::BORE_WALL;
    let no_room = |asked: f64, largest: f64| OutfitError::NoRoom {
        gear: gear.name.clone(),
        what: "a hub".to_owned(),
        asked: 2.0 * asked,
        largest: 2.0 * largest,
    };
    let least = taken.radius + policy::BORE_WALL;
    if radius > most {
        return Err(no_room(radius, if most > least { most } else { 0.0 }));
    }
    if radius < least {
        let remedy = format!("around this bore it takes {:.2} mm or more", 2.0 * least);
        let (what, value) = ("the diameter of the hub", 2.0 * radius);
        return Err(OutfitError::BadSize { what, value, remedy });
    }
    taken.radius = radius;
    gear.fittings.hub = Some(Hub { radius, height: choice.height, set_screw: choice.set_screw });
    Ok(())
}
