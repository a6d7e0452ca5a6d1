//! Gears with everything on them.

use super::gear::tests::wavy;
use super::{Bore, Mesh, SolidError, circle, gear_solid};
use crate::assembly::{Gear, Hub, Mark, Opening};
use crate::geometry::{self, Point};
use crate::policy;
use std::f64::consts::PI;

const THICKNESS: f64 = 6.0;

fn at(x: f64, y: f64, r: f64) -> Vec<Point> {
    circle(r, 1e-4).iter().map(|p| Point::new(p.x + x, p.y + y)).collect()
}

/// Volume without what is checked in a test.
fn plain(gear: &Gear) -> f64 {
    geometry::area(&gear.outline) * THICKNESS
}

fn made(gear: &Gear) -> Mesh {
    gear_solid(gear, THICKNESS).unwrap_or_else(|e| panic!("{e}"))
}

fn holes(mesh: &Mesh) -> i64 {
    let edges = 3 * mesh.triangles.len() as i64 / 2;
    1 - (mesh.positions.len() as i64 - edges + mesh.triangles.len() as i64) / 2
}

#[test]
fn every_kind_of_bore_goes_through() {
    for bore in [
        Bore::D { diameter: 5.0, flat: 4.5 },
        Bore::Hex { across: 6.0 },
        Bore::Square { side: 4.0 },
        Bore::with_standard_key(10.0).unwrap(),
    ] {
        let gear = wavy("driver", 400, bore);
        let hole = geometry::area(gear.bore.as_ref().unwrap()) * THICKNESS;
        let mesh = made(&gear);
        assert!((mesh.volume() - plain(&gear) + hole).abs() < 0.05, "{bore:?}");
        assert_eq!(holes(&mesh), 1);
    }
}

#[test]
fn a_hub_with_a_set_screw_stands_on_the_gear() {
    let mut gear = wavy("driver", 400, Bore::Square { side: 6.0 });
    gear.fittings.hub = Some(Hub { radius: 8.0, height: 7.0, set_screw: Some(3.0) });
    let mesh = made(&gear);
    assert_eq!(holes(&mesh), 2);
    let top = mesh.positions.iter().map(|p| p[2]).fold(0.0, f64::max);
    assert_eq!(top, THICKNESS + 7.0);
    // The screw's hole ends on the hub's round: shorter than on the axis by what the arc falls off,
    // on average y^2/2R with y^2 averaging to r^2/4.
    let screw = PI * 2.25 * (8.0 - 2.25 / 4.0 / 16.0 - 3.0);
    let hub = geometry::area(&circle(8.0, policy::BORE_CHORD_TOLERANCE));
    let volume = plain(&gear) + hub * 7.0 - 36.0 * (THICKNESS + 7.0) - screw;
    assert!((mesh.volume() - volume).abs() < 0.01 * screw, "{} {volume}", mesh.volume());
    // On the +x side only.
    let on_screw = |p: &&[f64; 3]| (p[2] - THICKNESS - 3.5).abs() < 1.49 && p[2] > THICKNESS;
    assert!(mesh.positions.iter().filter(on_screw).all(|p| p[0] > 0.0));
}

#[test]
fn openings_and_marks_count_with_their_sign() {
    let mut gear = wavy("driver", 400, Bore::Round { diameter: 5.0 });
    for (i, (x, y)) in [(20.0, 0.0), (-20.0, 0.0), (0.0, 20.0)].into_iter().enumerate() {
        let name = format!("screw {}", i + 1);
        gear.fittings.openings.push(Opening { name, ring: at(x, y, 3.0) });
    }
    let mut inner = at(0.0, -20.0, 2.0);
    inner.reverse();
    let ring = vec![at(0.0, -20.0, 4.0), inner];
    for (height, name) in [(0.6, "raised"), (-0.4, "sunk")] {
        let mut gear = gear.clone();
        gear.fittings.marks.push(Mark { name: name.to_owned(), face: ring.clone(), height });
        let mesh = made(&gear);
        assert_eq!(holes(&mesh), 4, "{name}");
        let bore = geometry::area(gear.bore.as_ref().unwrap());
        let volume = plain(&gear) - (bore + PI * 27.0) * THICKNESS + PI * 12.0 * height;
        assert!((mesh.volume() - volume).abs() < 0.1, "{name}: {} {volume}", mesh.volume());
    }
}

#[test]
fn a_chamfer_takes_half_its_square_along_both_edges() {
    let c = 0.4;
    for bore in [Bore::Round { diameter: 5.0 }, Bore::Lego { play: 0.1 }, Bore::Hex { across: 6.0 }]
    {
        let mut gear = wavy("driver", 900, bore);
        let before = made(&gear).volume();
        gear.fittings.chamfer = c;
        let mesh = made(&gear);
        let edges =
            geometry::perimeter(&gear.outline) + geometry::perimeter(gear.bore.as_ref().unwrap());
        let taken = 0.5 * c * c * edges;
        assert!(((before - mesh.volume()) / taken - 1.0).abs() < 0.02, "{bore:?}");
        assert_eq!(holes(&mesh), 1);
        // The foot of the gear stands back from its outline, the rest does not.
        let reach = |z: f64| {
            let at_z = mesh.positions.iter().filter(|p| (p[2] - z).abs() < 1e-6);
            at_z.map(|p| p[0].hypot(p[1])).fold(0.0, f64::max)
        };
        assert!((reach(c) - reach(0.0) - c).abs() < 0.01, "{} {}", reach(c), reach(0.0));
        assert!((reach(c) - reach(THICKNESS)).abs() < 1e-5);
    }
}

#[test]
fn all_of_it_together_is_one_sound_body() {
    let mut gear = wavy("driver", 3000, Bore::D { diameter: 6.0, flat: 5.4 });
    gear.fittings.chamfer = 0.5;
    gear.fittings.hub = Some(Hub { radius: 8.0, height: 5.0, set_screw: Some(2.5) });
    gear.fittings.openings.push(Opening { name: "hole 1".into(), ring: at(20.0, 5.0, 6.0) });
    let face = vec![at(-20.0, 5.0, 6.0)];
    gear.fittings.marks.push(Mark { name: "dot".into(), face, height: -0.4 });
    assert_eq!(holes(&made(&gear)), 3);
}

#[test]
fn what_does_not_fit_is_named() {
    let gear = wavy("driver", 400, Bore::Round { diameter: 5.0 });
    let refused = |change: &dyn Fn(&mut Gear)| {
        let mut gear = gear.clone();
        change(&mut gear);
        gear_solid(&gear, THICKNESS).unwrap_err()
    };
    let hub = |radius| Hub { radius, height: 5.0, set_screw: None };
    for (error, words) in [
        (refused(&|g| g.fittings.hub = Some(hub(39.0))), ["hub", "edge"]),
        (refused(&|g| g.fittings.hub = Some(hub(2.0))), ["hub", "bore"]),
        (
            refused(&|g| g.fittings.hub = Some(Hub { set_screw: Some(6.0), ..hub(8.0) })),
            ["set screw", "wider"],
        ),
        (
            refused(&|g| {
                g.fittings.openings =
                    vec![Opening { name: "screw 1".into(), ring: at(4.0, 0.0, 3.0) }];
            }),
            ["screw 1", "the bore"],
        ),
        (
            refused(&|g| {
                g.fittings.openings =
                    vec![Opening { name: "screw 1".into(), ring: at(40.0, 0.0, 3.0) }];
            }),
            ["screw 1", "edge"],
        ),
        (
            refused(&|g| {
                let face = vec![at(20.0, 0.0, 3.0)];
                g.fittings.marks = vec![Mark { name: "dot".into(), face, height: -6.0 }];
            }),
            ["dot", "deep"],
        ),
        (refused(&|g| g.fittings.chamfer = 7.0), ["bevelled", "--chamfer"]),
    ] {
        let said = error.to_string();
        assert!(words.iter().all(|w| said.contains(w)), "{said}");
        assert!(!matches!(error, SolidError::Unsound { .. }), "{said}");
    }
}
