//! What a finished pair is fitted with: hubs, holes, lettering, marks for assembly, a base plate.
//!
//! Only places and figures are chosen here, as [`Fittings`](crate::assembly::Fittings) of the gears and
//! [`Fixture`](crate::assembly::Fixture)s of the assembly; [`crate::solid`] makes solids of them.

mod base;
mod face;
mod hub;
mod knob;
mod label;
mod lightening;
mod options;
mod phase;
mod screws;
mod stand;

pub use face::{DrawnHoles, FaceChoice, FaceFit, FaceStyle};
pub use options::{
    Base, Hold, HubChoice, Label, LabelPlace, LabelText, Lightening, Mount, Outfit, OutfitError,
    Screws,
};

use crate::assembly::{Assembly, Gear, PlacedGear};
use crate::control::StageName;
use crate::diagnose::{Code, Diagnostic};
use crate::geometry::{self, Point, Vector};
use crate::input::Inner;
use crate::policy;
use crate::solid::circle;

/// Fits the gears out as asked. `names` are what the gears are called in lettering, `module` their module,
/// mm; `drawings` what is drawn inside of each gear's shape, in its frame. What a wish leaves undone for want of room, though it does no harm, comes back as warnings.
///
/// # Errors
/// See [`OutfitError`]; the assembly must not be used then.
pub fn fit_out(
    assembly: &mut Assembly,
    outfit: &Outfit,
    names: &[String],
    module: f64,
    drawings: &[Inner],
) -> Result<Vec<Diagnostic>, OutfitError> {
    let mut warnings = Vec::new();
    outfit.check(assembly.thickness)?;
    let partners: Vec<Option<Vector>> = (0..assembly.gears.len())
        .map(|i| Some(partner(&assembly.gears, i)?.axis - assembly.gears[i].axis))
        .collect();
    let mut parts = Vec::new();
    let thickness = assembly.thickness;
    for (i, placed) in assembly.gears.iter_mut().enumerate() {
        let gear = &mut placed.gear;
        gear.fittings.chamfer = outfit.chamfer;
        let mut taken = Taken::new(gear);
        if let Some(choice) = &outfit.hub {
            hub::add(gear, choice, &mut taken)?;
        }
        if let Some(choice) = &outfit.screws {
            screws::add(gear, choice, &mut taken)?;
        }
        if outfit.knob && i == 0 {
            parts.push(knob::add(gear, i, thickness, &mut taken)?);
        }
        let sizes = (module, outfit.nozzle);
        let inner = drawings.get(i).filter(|inner| !inner.is_empty());
        if let Some(inner) = inner {
            let choice = (outfit.holes, &outfit.face);
            warnings.extend(face::add_holes(gear, choice, inner, sizes, &mut taken));
        }
        if outfit.wants_phase_mark()
            && let Some(towards) = partners[i]
            && !phase::add(gear, towards, module, &mut taken)
        {
            warnings.push(warning(Code::NoPhaseMark, gear));
        }
        if let Some(choice) = &outfit.label {
            let left_out = label::add(gear, choice, i, names, &mut taken)?;
            warnings.extend(left_out.map(|code| warning(code, gear)));
        }
        let towards = partners[i].unwrap_or_else(Vector::x);
        if !lightening::add(gear, outfit.lightening, towards, module, &taken) {
            warnings.push(warning(Code::NoLightening, gear));
        }
        if let Some(inner) = inner {
            warnings.extend(face::add(gear, &outfit.face, inner, sizes, &taken));
        }
    }
    assembly.fixtures.extend(base::parts(assembly, outfit)?);
    assembly.fixtures.extend(parts);
    Ok(warnings)
}

fn warning(code: Code, gear: &Gear) -> Diagnostic {
    Diagnostic::warning(code, StageName::Outfitted).about(&gear.name)
}

/// The gear that meshes with gear `i`: the next, or for the last the one before.
fn partner(gears: &[PlacedGear], i: usize) -> Option<&PlacedGear> {
    gears.get(i + 1).or_else(|| gears.get(i.checked_sub(1)?))
}

/// What of a gear's face is spoken for.
struct Taken {
    /// Within this radius about the axis nothing may be put; mm.
    radius: f64,
    /// Rings elsewhere, counter-clockwise.
    rings: Vec<Vec<Point>>,
}

impl Taken {
    fn new(gear: &Gear) -> Self {
        let reach = |ring: &Vec<Point>| ring.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
        let bore = gear.bore.as_ref().map_or(0.0, reach);
        // A bevel needs its own width beside the bore.
        let bevel = if bore > 0.0 { gear.fittings.chamfer } else { 0.0 };
        Self { radius: bore + bevel, rings: Vec::new() }
    }

    /// All of it, each ring grown by `wall`.
    fn grown(&self, wall: f64) -> Vec<Vec<Point>> {
        let grown = |ring: &Vec<Point>| {
            geometry::largest(geometry::offset(ring, wall, policy::OPENING_CHORD))
                .map(|face| face[0].clone())
        };
        let mut rings: Vec<Vec<Point>> = self.rings.iter().filter_map(grown).collect();
        if self.radius > 0.0 {
            rings.push(circle(self.radius + wall, policy::BORE_CHORD_TOLERANCE));
        }
        rings
    }
}

/// From the axis to the nearest point of the outline, mm; zero for an axis outside.
pub(super) fn clear_radius(outline: &[Point]) -> f64 {
    if !geometry::contains(outline, Point::origin()) {
        return 0.0;
    }
    let edges = outline.iter().zip(outline.iter().cycle().skip(1));
    edges
        .map(|(a, b)| {
            let along = b - a;
            let t = (-a.coords).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE);
            (a + along * t.clamp(0.0, 1.0)).coords.norm()
        })
        .fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests;
