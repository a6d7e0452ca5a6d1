//! A gear as a solid.

use super::{Expected, Mesh, Solid, SolidError, bore, check};
use crate::assembly::{Assembly, Gear};
use crate::geometry::{self, Point};
use crate::policy;
use rayon::prelude::*;

/// The gear as a checked mesh in its own frame, from z = 0 to `thickness`, mm: the outline's prism
/// less the bore's, which sticks out of both faces.
///
/// # Errors
/// A [`SolidError`]; no mesh comes back that is not sound.
pub fn gear_solid(gear: &Gear, thickness: f64) -> Result<Mesh, SolidError> {
    if !(thickness > 0.0 && thickness.is_finite()) {
        return Err(SolidError::NotPositiveThickness { thickness });
    }
    simple(&gear.name, &gear.outline)?;
    let body = Solid::extrude(&gear.outline, &[], thickness);
    let mut expected = Expected { volume: geometry::area(&gear.outline) * thickness, genus: 0 };
    let body = match &gear.bore {
        None => body,
        Some(hole) => {
            simple(&format!("{}'s bore", gear.name), hole)?;
            let radius = gear.outline.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
            bore::fits(&gear.outline, hole, policy::SOLID_LEAST_WALL * radius)?;
            expected.volume -= geometry::area(hole) * thickness;
            expected.genus = 1;
            body.subtract(&prism_through(hole, thickness))
        }
    };
    let mesh = body.mesh();
    check(&mesh, expected)
        .map_err(|fault| SolidError::Unsound { part: gear.name.clone(), fault })?;
    Ok(mesh)
}

/// One checked mesh for each gear of the assembly, in the gears' order and own frames.
///
/// # Errors
/// Those of [`gear_solid`], of the first gear that fails.
pub fn assembly_solids(assembly: &Assembly) -> Result<Vec<Mesh>, SolidError> {
    assembly.gears.par_iter().map(|g| gear_solid(&g.gear, assembly.thickness)).collect()
}

/// The prism over `base` that cuts through stock between z = 0 and `thickness`.
pub(super) fn prism_through(base: &[Point], thickness: f64) -> Solid {
    let overhang = policy::CUTTER_OVERHANG * thickness;
    Solid::extrude(base, &[], thickness + 2.0 * overhang).translate(0.0, 0.0, -overhang)
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
