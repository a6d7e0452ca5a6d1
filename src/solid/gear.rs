//! A gear as a solid.

use super::bevel::{bevelled_prism, bore_bevel};
use super::bore::circle;
use super::screw::{set_screw, taken};
use super::wall::{apart, distance_between, fits};
use super::{Expected, Mesh, Solid, SolidError, check, fixture_solid};
use crate::assembly::{Assembly, Gear};
use crate::geometry::{self, Point};
use crate::policy;
use rayon::prelude::*;

/// The gear as a checked mesh in its own frame, from z = 0 to `thickness`, mm, its hub and what is
/// raised on it above that.
///
/// The outline's prism, with or without bevelled lower edge, and the hub's, less those of bore,
/// openings and sunk marks, which stick out of the faces they cut, plus those of raised marks.
///
/// # Errors
/// A [`SolidError`]; no mesh comes back that is not sound.
pub fn gear_solid(gear: &Gear, thickness: f64) -> Result<Mesh, SolidError> {
    if !(thickness > 0.0 && thickness.is_finite()) {
        return Err(SolidError::NotPositiveThickness { thickness });
    }
    simple(&gear.name, &gear.outline)?;
    let fittings = &gear.fittings;
    if !(0.0..thickness).contains(&fittings.chamfer) {
        return Err(SolidError::NoBevel { part: gear.name.clone(), chamfer: fittings.chamfer });
    }
    let (mut body, mut expected) = blank(gear, thickness)?;
    let radius = gear.outline.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
    let wall = policy::SOLID_LEAST_WALL * radius;
    if let Some(hole) = &gear.bore {
        simple(&format!("{}'s bore", gear.name), hole)?;
        fits(&gear.outline, hole, wall)?;
    }
    let parts = Carried::of(gear, wall)?;
    parts.keep_apart(gear)?;
    let overhang = policy::CUTTER_OVERHANG * thickness;
    let mut top = thickness;
    if let (Some(hub), Some(ring)) = (&fittings.hub, &parts.hub) {
        top += hub.height;
        body = body.union(&prism_between(ring, 0.5 * thickness, top));
        expected.volume += geometry::area(ring) * hub.height;
    }
    if let Some(hole) = &gear.bore {
        expected.genus += 1;
        if fittings.chamfer > 0.0 {
            let (flare, hole) = bore_bevel(&gear.name, hole, overhang, fittings.chamfer)?;
            let shaft = prism_between(&hole, -overhang, top + overhang);
            body = body.subtract(&shaft.union(&Solid::from_mesh(&flare.mesh)));
            expected.volume -= flare.lifted + geometry::area(&hole) * (top - fittings.chamfer);
        } else {
            body = body.subtract(&prism_between(hole, -overhang, top + overhang));
            expected.volume -= geometry::area(hole) * top;
        }
    }
    for opening in &fittings.openings {
        body = body.subtract(&prism_through(&opening.ring, thickness));
        expected.volume -= geometry::area(&opening.ring) * thickness;
        expected.genus += 1;
    }
    for mark in &fittings.marks {
        let (outer, holes) = (&mark.face[0], &mark.face[1..]);
        let area = geometry::area(outer) - holes.iter().map(|h| geometry::area(h)).sum::<f64>();
        let figure = |height: f64| Solid::extrude(outer, holes, height);
        let sunk = (-mark.height).max(0.0);
        if sunk >= thickness {
            let why = format!("it is {sunk} mm deep in a gear of {thickness} mm");
            return Err(SolidError::Outside {
                part: gear.name.clone(),
                what: mark.name.clone(),
                why,
            });
        }
        body = if sunk > 0.0 {
            body.subtract(&figure(sunk + overhang).translate(0.0, 0.0, thickness - sunk))
        } else {
            let root = 0.5 * thickness;
            body.union(&figure(root + mark.height).translate(0.0, 0.0, thickness - root))
        };
        expected.volume += area * mark.height;
    }
    if let (Some(hub), Some(ring), Some(hole)) = (&fittings.hub, &parts.hub, &gear.bore)
        && let Some(diameter) = hub.set_screw
    {
        let fine = policy::BORE_CHORD_TOLERANCE;
        let (screw, section) =
            set_screw(diameter, 2.0 * hub.radius, thickness + 0.5 * hub.height, fine);
        body = body.subtract(&screw);
        expected.volume -= taken(&section, ring, hole);
        expected.genus += 1;
    }
    let mesh = body.mesh();
    check(&mesh, expected)
        .map_err(|fault| SolidError::Unsound { part: gear.name.clone(), fault })?;
    Ok(mesh)
}

/// The gear without any hole.
fn blank(gear: &Gear, thickness: f64) -> Result<(Solid, Expected), SolidError> {
    let chamfer = gear.fittings.chamfer;
    if chamfer == 0.0 {
        let volume = geometry::area(&gear.outline) * thickness;
        let body = Solid::extrude(&gear.outline, &[], thickness);
        return Ok((body, Expected { volume, genus: 0 }));
    }
    let made = bevelled_prism(&gear.name, &gear.outline, thickness, chamfer)?;
    let volume = geometry::area(&made.outer) * (thickness - chamfer) - made.lifted;
    Ok((Solid::from_mesh(&made.mesh), Expected { volume, genus: 0 }))
}

/// Something that a gear carries: its name, its edge and its holes.
type Carry<'a> = (&'a str, &'a [Point], &'a [Vec<Point>]);

/// Whether two of them do not touch: each lies outside of the other, or in one of its holes.
fn clear(a: &Carry<'_>, b: &Carry<'_>) -> bool {
    let within = |inner: &Carry<'_>, outer: &Carry<'_>| {
        let hole = outer.2.iter().find(|hole| geometry::contains(hole, inner.1[0]));
        hole.is_some_and(|hole| distance_between(hole, inner.1) > 0.0)
    };
    apart(a.1, b.1) || within(a, b) || within(b, a)
}

/// The rings of what a gear carries.
struct Carried<'a> {
    /// Openings and marks with their names.
    rings: Vec<Carry<'a>>,
    hub: Option<Vec<Point>>,
}

impl<'a> Carried<'a> {
    /// Passes rings that are simple and lie inside the outline.
    fn of(gear: &'a Gear, wall: f64) -> Result<Self, SolidError> {
        let fittings = &gear.fittings;
        let outside = |what: &str, why: &str| SolidError::Outside {
            part: gear.name.clone(),
            what: what.to_owned(),
            why: why.to_owned(),
        };
        let mut rings: Vec<Carry<'_>> = Vec::new();
        for opening in &fittings.openings {
            rings.push((&opening.name, &opening.ring, &[]));
        }
        for mark in &fittings.marks {
            if !mark.height.is_finite() || mark.height == 0.0 || mark.face.is_empty() {
                return Err(outside(&mark.name, "it has no height or no edge"));
            }
            rings.push((&mark.name, &mark.face[0], &mark.face[1..]));
        }
        for (name, ring, _) in &rings {
            simple(&format!("{}'s {name}", gear.name), ring)?;
            let within = geometry::contains(&gear.outline, ring[0])
                && distance_between(&gear.outline, ring) > wall;
            if !within {
                return Err(outside(name, "it cuts the edge"));
            }
        }
        let Some(hub) = &fittings.hub else { return Ok(Self { rings, hub: None }) };
        if !(hub.radius > 0.0 && hub.height > 0.0 && (hub.radius + hub.height).is_finite()) {
            return Err(outside("the hub", "it has no size"));
        }
        let ring = circle(hub.radius, policy::BORE_CHORD_TOLERANCE);
        if fits(&gear.outline, &ring, wall).is_err() {
            return Err(outside("the hub", "it reaches over the edge"));
        }
        if let Some(hole) = &gear.bore
            && fits(&ring, hole, wall).is_err()
        {
            return Err(outside("the hub", "it is no wider than the bore"));
        }
        if let Some(diameter) = hub.set_screw {
            if gear.bore.is_none() {
                return Err(outside("the set screw", "there is no bore to lead to"));
            }
            if !(diameter > 0.0 && diameter < hub.height && diameter < 2.0 * hub.radius) {
                return Err(outside("the set screw", "it is wider than the hub"));
            }
        }
        Ok(Self { rings, hub: Some(ring) })
    }

    /// Passes what does not touch each other, the bore, or the hub.
    fn keep_apart(&self, gear: &Gear) -> Result<(), SolidError> {
        let mut all = self.rings.clone();
        match (&self.hub, &gear.bore) {
            (Some(ring), _) => all.push(("the hub", ring, &[])),
            (None, Some(hole)) => all.push(("the bore", hole, &[])),
            (None, None) => {}
        }
        for (i, second) in all.iter().enumerate() {
            if let Some(first) = all[..i].iter().find(|first| !clear(first, second)) {
                return Err(SolidError::Overlap {
                    part: gear.name.clone(),
                    first: first.0.to_owned(),
                    second: second.0.to_owned(),
                });
            }
        }
        Ok(())
    }
}

/// One checked mesh for each gear of the assembly, in the gears' order, then one for each fixture; all
/// in their own frames.
///
/// # Errors
/// Those of [`gear_solid`] and [`fixture_solid`], of the first part that fails.
pub fn assembly_solids(assembly: &Assembly) -> Result<Vec<Mesh>, SolidError> {
    let gears = assembly.gears.par_iter().map(|g| gear_solid(&g.gear, assembly.thickness));
    gears.chain(assembly.fixtures.par_iter().map(fixture_solid)).collect()
}

/// The prism over `base` between two heights.
pub(super) fn prism_between(base: &[Point], from: f64, to: f64) -> Solid {
    Solid::extrude(base, &[], to - from).translate(0.0, 0.0, from)
}

/// The prism over `base` that cuts through stock between z = 0 and `thickness`.
pub(super) fn prism_through(base: &[Point], thickness: f64) -> Solid {
    let overhang = policy::CUTTER_OVERHANG * thickness;
    prism_between(base, -overhang, thickness + overhang)
}

pub(super) fn simple(part: &str, ring: &[Point]) -> Result<(), SolidError> {
    let refuse = |why: String| Err(SolidError::NotSimple { part: part.to_owned(), why });
    if let Some(i) = ring.iter().position(|p| !(p.x.is_finite() && p.y.is_finite())) {
        return refuse(format!("point {i} is not a finite number"));
    }
    if ring.len() < 3 || geometry::area(ring) == 0.0 {
        return refuse("it encloses no area".to_owned());
    }
    if let Some(p) = geometry::first_self_crossing(ring) {
        return refuse(format!("it crosses itself at ({:.4}, {:.4}) mm", p.x, p.y));
    }
    Ok(())
}

#[cfg(test)]
pub(crate) mod tests {
    use super::super::{Bore, Fault};
    use super::*;
    use crate::assembly::Fittings;
    use std::f64::consts::TAU;

    /// A wavy gear of 16 lobes, mm.
    pub(crate) fn wavy(name: &str, samples: usize, bore: Bore) -> Gear {
        let at = |i: usize| {
            let angle = TAU * i as f64 / samples as f64;
            geometry::rotate(Point::new(40.0 + 2.5 * (16.0 * angle).cos(), 0.0), angle)
        };
        let outline: Vec<Point> = (0..samples).map(at).collect();
        Gear {
            name: name.to_owned(),
            pitch_curve: outline.clone(),
            input: outline.clone(),
            outline,
            bore: bore.polygon(0.01).unwrap(),
            teeth: 16,
            fittings: Fittings::default(),
        }
    }

    #[test]
    fn the_solid_fills_its_outline() {
        let gear = wavy("driver", 800, Bore::None);
        let mesh = gear_solid(&gear, 6.0).unwrap();
        // The closed form for r = a + b cos n t is pi (a^2 + b^2/2); 800 chords miss 1e-3 of it.
        let smooth = std::f64::consts::PI * (40.0_f64.powi(2) + 0.5 * 2.5_f64.powi(2)) * 6.0;
        assert!((mesh.volume() / smooth - 1.0).abs() < 2e-3);
        let heights: Vec<f64> = mesh.positions.iter().map(|p| p[2]).collect();
        assert!(heights.iter().all(|&z| z == 0.0 || z == 6.0));
        assert_eq!(mesh.positions.len(), 1600);
    }

    #[test]
    fn bores_go_through() {
        for bore in [Bore::Round { diameter: 5.0 }, Bore::Lego { play: policy::LEGO_AXLE_PLAY }] {
            let gear = wavy("driver", 400, bore);
            let hole = geometry::area(gear.bore.as_ref().unwrap());
            let mesh = gear_solid(&gear, 4.0).unwrap();
            let volume = (geometry::area(&gear.outline) - hole) * 4.0;
            assert!((mesh.volume() / volume - 1.0).abs() < policy::SOLID_VOLUME_ERROR);
        }
    }

    #[test]
    fn a_gear_of_ten_thousand_points_is_sound() {
        assert!(gear_solid(&wavy("driver", 10_000, Bore::Round { diameter: 8.0 }), 5.0).is_ok());
    }

    #[test]
    fn bad_gears_are_refused_by_name() {
        let gear = wavy("driver", 200, Bore::None);
        for thickness in [0.0, -2.0, f64::NAN] {
            assert!(matches!(
                gear_solid(&gear, thickness),
                Err(SolidError::NotPositiveThickness { .. })
            ));
        }
        let too_wide = wavy("driver", 200, Bore::Round { diameter: 78.0 });
        match gear_solid(&too_wide, 5.0) {
            Err(SolidError::BoreTooLarge { largest, .. }) => {
                assert!((74.0..75.1).contains(&largest), "{largest}");
            }
            other => panic!("{other:?}"),
        }
        let mut crossed = gear.clone();
        crossed.outline.swap(10, 60);
        assert!(matches!(gear_solid(&crossed, 5.0), Err(SolidError::NotSimple { .. })));
        let mut wild = gear;
        wild.outline[7].x = f64::NAN;
        let message = gear_solid(&wild, 5.0).unwrap_err().to_string();
        assert!(message.contains("driver") && message.contains("point 7"), "{message}");
    }

    #[test]
    fn an_unsound_solid_names_the_part() {
        let error = SolidError::Unsound { part: "follower".into(), fault: Fault::Empty };
        assert!(error.to_string().contains("follower"));
    }
}
