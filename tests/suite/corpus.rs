//! Small files as drawing, modelling and spreadsheet programs write them (`tests/data/corpus`): each gives the gear, or the
//! shape, that its program shows, or a sentence that says why not.

use centrode::gear::{Pair, Side};
use centrode::geometry::{self, Point};
use centrode::input::{InputError, LoadOptions, Note, Toothed, load, load_gears, load_toothed};
use centrode::outline::Smoothing;
use std::f64::consts::TAU;

fn file(name: &str) -> String {
    format!("{}/tests/data/corpus/{name}", env!("CARGO_MANIFEST_DIR"))
}

/// The gear of most files: 12 teeth with straight flanks, 28 mm wide.
fn corners() -> Vec<Point> {
    let at = |i: u32, share: f64, radius: f64| {
        let angle = TAU * (f64::from(i) + share) / 12.0;
        Point::new(radius * angle.cos(), radius * angle.sin())
    };
    (0..12)
        .flat_map(|i| [at(i, -0.36, 9.5), at(i, -0.15, 14.0), at(i, 0.15, 14.0), at(i, 0.36, 9.5)])
        .collect()
}

fn read(name: &str) -> Toothed {
    load_toothed(&file(name), Side::Driver).unwrap_or_else(|error| panic!("{error}"))
}

/// The file holds the gear about a place, and a bore of radius 2 there if it has one.
fn is_the_gear(name: &str, x: f64, y: f64, tolerance: f64) {
    let gear = read(name);
    let area = geometry::area(&corners());
    assert!(
        (gear.outline.area() / area - 1.0).abs() < tolerance,
        "{name}: {}",
        gear.outline.area()
    );
    let place = Point::new(x, y);
    assert!((gear.outline.centroid() - place).norm() < 0.02, "{name}: {}", gear.outline.centroid());
    for hole in &gear.holes {
        assert!((hole.centroid() - place).norm() < 1e-3, "{name}: {}", hole.centroid());
        assert!((hole.area() - 4.0 * std::f64::consts::PI).abs() < 0.1, "{name}: {}", hole.area());
    }
    assert!(gear.holes.len() < 2, "{name}: {} holes", gear.holes.len());
}

fn refused(name: &str) -> InputError {
    let error = load_toothed(&file(name), Side::Driver).unwrap_err();
    let said = error.to_string();
    assert!(said.contains(name) && said.contains(';') && !said.contains('\n'), "{said}");
    error
}

#[test]
fn dxf_drawings_give_the_gear_that_is_shown() {
    is_the_gear("circle-from-behind.dxf", 60.0, 20.0, 1e-4);
    is_the_gear("polyline-from-behind.dxf", 60.0, 20.0, 1e-4);
    is_the_gear("nested-blocks.dxf", 100.0, 50.0, 1e-4);
    is_the_gear("mirrored-block.dxf", 30.0, 0.0, 1e-4);
    is_the_gear("ends-that-miss.dxf", 0.0, 0.0, 2e-3);
    for name in ["ellipse-hatch-text.dxf", "sheet.dxf", "inches.dxf", "r12.dxf", "binary.dxf"] {
        is_the_gear(name, 0.0, 0.0, 1e-4);
    }
    let spline = read("fit-points.dxf");
    assert!((spline.outline.area() - std::f64::consts::PI * (144.0 + 0.5 * 1.69)).abs() < 0.2);
    assert!(read("ends-that-miss.dxf").notes.iter().any(|n| matches!(n, Note::Joined { .. })));
    assert!(read("inches.dxf").notes.iter().any(|n| matches!(n, Note::Unit { unit: "inch", .. })));
}

#[test]
fn drawings_that_leave_a_choice_or_a_gap_say_so() {
    match refused("open.dxf") {
        InputError::Open { gap, .. } => {
            let corners = corners();
            let first = (corners[0] - corners[47]).norm();
            assert!((gap - first).abs() < 1e-3, "{gap}");
        }
        other => panic!("{other}"),
    }
    match refused("three-gears.dxf") {
        InputError::Several { count, list, example, .. } => {
            assert_eq!((count, example.as_str()), (3, "G0"));
            assert!(list.contains("12 teeth") && list.contains("(40.0000, 0.0000)"), "{list}");
        }
        other => panic!("{other}"),
    }
    assert!(matches!(refused("ring.dxf"), InputError::InnerGear { .. }));
    for (part, x) in [("#G40", 40.0), ("#2", 40.0), ("#G80", 80.0)] {
        let gear = load_toothed(&file(&format!("three-gears.dxf{part}")), Side::Driver).unwrap();
        assert!((gear.outline.centroid().x - x).abs() < 0.02, "{part}");
    }
}

#[test]
fn two_gears_on_a_sheet_are_the_pair() {
    for name in ["two-gears.dxf", "array.dxf"] {
        let source = file(name);
        let pair = load_gears(Pair::new(source.as_str(), source.as_str()), None).unwrap();
        let apart = pair.follower.outline.centroid() - pair.driver.outline.centroid();
        assert!((apart.norm() - 40.0).abs() < 0.05, "{name}: {apart}");
        assert!(pair.driver.notes.contains(&Note::BothGears));
        assert!(matches!(refused(name), InputError::Several { count: 2, .. }));
    }
}

#[test]
fn svg_drawings_give_the_gear_that_is_shown() {
    for name in
        ["frame.svg", "guides.svg", "white-bore.svg", "utf16.svg", "latin1.svg", "inches.svg"]
    {
        is_the_gear(name, 0.0, 0.0, 1e-3);
    }
    let pieces = read("pieces.svg");
    assert!(pieces.outline.area() > 360.0, "{}", pieces.outline.area());
    let reach = pieces.outline.points().iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
    assert!((reach - 14.09).abs() < 0.01, "{reach}");
}

#[test]
fn tables_give_the_gear_that_was_written() {
    for name in [
        "semicolons.csv",
        "quoted.csv",
        "units.txt",
        "inches.csv",
        "xyz.txt",
        "labels.csv",
        "utf16.csv",
    ] {
        is_the_gear(name, 0.0, 0.0, 1e-3);
    }
}

#[test]
fn solids_are_cut_where_their_teeth_are() {
    for name in ["hub.stl", "latin1.stl"] {
        is_the_gear(name, 0.0, 0.0, 1e-4);
    }
    for (name, axis) in [("standing.stl", 'x'), ("y-up.obj", 'y')] {
        is_the_gear(name, 0.0, 0.0, 1e-4);
        assert!(read(name).notes.contains(&Note::Turned { axis }), "{name}");
    }
}

#[test]
fn what_check_reads_design_reads_too() {
    let options = LoadOptions { smoothing: Smoothing::Fixed(0.0), ..LoadOptions::default() };
    let area = geometry::area(&corners());
    for (name, scale) in
        [("sheet.dxf", 1.0), ("inches.dxf", 25.4), ("binary.dxf", 1.0), ("hub.stl", 1.0)]
    {
        let shape = load(&file(name), &options).unwrap();
        let found = shape.raw.area() * scale * scale;
        assert!((found / area - 1.0).abs() < 1e-3, "{name}: {found}");
        assert!(shape.notes.contains(&Note::TeethNotKept { teeth: 12 }), "{name}");
    }
}

#[test]
fn airfoils_in_every_form_are_the_same_shape() {
    let options = LoadOptions { smoothing: Smoothing::Fixed(0.0), ..LoadOptions::default() };
    let area = |name: &str| load(&file(name), &options).unwrap().raw.area();
    let selig = area("selig.dat");
    assert!((selig - 0.0822).abs() < 2e-3, "{selig}");
    for name in ["lednicer.dat", "two-sides.csv"] {
        assert!((area(name) / selig - 1.0).abs() < 1e-6, "{name}: {}", area(name));
    }
}
