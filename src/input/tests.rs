use super::*;
use crate::input::SolidFileError;
use std::f64::consts::PI;
use std::fmt::Write;

/// Group codes and values of a DXF entity.
type Tags<'a> = &'a [(i32, &'a str)];

fn dxf(unit: u32, entities: &[Tags<'_>]) -> String {
    let unit = unit.to_string();
    let mut text = String::new();
    let mut put = |tags: Tags<'_>| {
        for (code, value) in tags {
            writeln!(text, "{code}\n{value}").unwrap();
        }
    };
    put(&[(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1015")]);
    put(&[(9, "$INSUNITS"), (70, &unit), (0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")]);
    entities.iter().for_each(|tags| put(tags));
    put(&[(0, "ENDSEC"), (0, "EOF")]);
    text
}

fn read(name: &str, text: impl AsRef<[u8]>, part: &str) -> Result<Toothed, InputError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, text).unwrap();
    load_toothed(&format!("{}{part}", path.display()), Side::Follower)
}

fn near(value: f64, truth: f64) {
    assert!((value / truth - 1.0).abs() < 1e-4, "{value} is not {truth}");
}

const CIRCLE: Tags<'_> = &[(0, "CIRCLE"), (8, "0"), (10, "5"), (20, "1"), (40, "0.5")];
/// A stadium: 10 long between half circles of radius 2 about (0, 1) and (10, 1).
const STADIUM: Tags<'_> = &[
    (0, "LWPOLYLINE"),
    (100, "AcDbEntity"),
    (8, "0"),
    (100, "AcDbPolyline"),
    (90, "4"),
    (70, "1"),
    (10, "0"),
    (20, "-1"),
    (10, "10"),
    (20, "-1"),
    (42, "1"),
    (10, "10"),
    (20, "3"),
    (10, "0"),
    (20, "3"),
    (42, "1"),
];
const STADIUM_AREA: f64 = 40.0 + 4.0 * PI;

#[test]
fn bulges_are_arcs_and_the_unit_of_the_drawing_counts() {
    for (unit, scale) in [(0, 1.0), (4, 1.0), (5, 10.0), (1, 25.4)] {
        let gear = read("a.dxf", dxf(unit, &[STADIUM, CIRCLE]), "").unwrap();
        near(gear.outline.area(), STADIUM_AREA * scale * scale);
        near(gear.outline.centroid().x, 5.0 * scale);
        assert_eq!(gear.holes.len(), 1);
        // The chords of so small a hole are as long as those of the outline: 0.04 % of its area.
        assert!((gear.holes[0].area() / (0.25 * PI * scale * scale) - 1.0).abs() < 1e-3);
        near(gear.holes[0].centroid().y, scale);
    }
}

#[test]
fn four_quarter_arcs_are_a_circle_whichever_way_they_run() {
    for (order, bulge) in [([0, 1, 2, 3], "0.414213562373"), ([3, 2, 1, 0], "-0.414213562373")] {
        let corners = [("2", "0"), ("0", "2"), ("-2", "0"), ("0", "-2")];
        let mut tags = STADIUM[..6].to_vec();
        for (x, y) in order.map(|i: usize| corners[i]) {
            tags.extend([(10, x), (20, y), (42, bulge)]);
        }
        let gear = read("a.dxf", dxf(4, &[&tags]), "").unwrap();
        near(gear.outline.area(), 4.0 * PI);
        assert!(gear.outline.points().iter().all(|p| (p.coords.norm() - 2.0).abs() < 1e-9));
    }
}

#[test]
fn lines_and_arcs_in_any_order_and_sense_are_one_contour() {
    let line = |from: [&'static str; 2], to: [&'static str; 2]| {
        [(0, "LINE"), (8, "0"), (10, from[0]), (20, from[1]), (11, to[0]), (21, to[1])]
    };
    let arc = |x: &'static str, from: &'static str, to: &'static str| {
        [(0, "ARC"), (8, "0"), (10, x), (20, "1"), (40, "2"), (50, from), (51, to)]
    };
    let (low, high) = (line(["10", "-1"], ["0", "-1"]), line(["10", "3"], ["0", "3"]));
    let (left, right) = (arc("0", "90", "270"), arc("10", "-90", "90"));
    let whole = read("a.dxf", dxf(4, &[&high, &left, CIRCLE, &low, &right]), "").unwrap();
    near(whole.outline.area(), STADIUM_AREA);
    assert_eq!(whole.holes.len(), 1);
    let error = read("a.dxf", dxf(4, &[&high, &left, &low]), "").unwrap_err();
    assert!(matches!(error, InputError::Open { gap, .. } if (gap - 4.0).abs() < 1e-9), "{error}");
}

#[test]
fn a_rational_spline_is_the_circle_that_it_stands_for() {
    let mut tags = vec![(0, "SPLINE".to_owned()), (8, "0".to_owned())];
    let mut put = |code: i32, value: f64| tags.push((code, value.to_string()));
    (70..=71).for_each(|code| put(code, if code == 70 { 5.0 } else { 2.0 }));
    put(72, 12.0);
    put(73, 9.0);
    let knots = [0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0];
    knots.into_iter().for_each(|k| put(40, k));
    let corner = [(3.0, 0.0), (3.0, 3.0), (0.0, 3.0), (-3.0, 3.0), (-3.0, 0.0)];
    let rest = [(-3.0, -3.0), (0.0, -3.0), (3.0, -3.0), (3.0, 0.0)];
    for (i, (x, y)) in corner.into_iter().chain(rest).enumerate() {
        put(41, if i % 2 == 0 { 1.0 } else { 0.5_f64.sqrt() });
        put(10, x);
        put(20, y);
        put(30, 0.0);
    }
    let tags: Vec<(i32, &str)> = tags.iter().map(|(c, v)| (*c, v.as_str())).collect();
    let gear = read("a.dxf", dxf(4, &[&tags]), "").unwrap();
    // Chords between sixteen points to a quarter: 0.2 % of the area.
    assert!((gear.outline.area() / (9.0 * PI) - 1.0).abs() < 2e-3, "{}", gear.outline.area());
    let reach = |p: &Point| (p.coords.norm() - 3.0).abs();
    assert!(gear.outline.points().iter().all(|p| reach(p) < 1e-9));
}

#[test]
fn a_gear_is_found_on_the_layer_of_its_name() {
    let polyline = |layer: &'static str, side: &'static str| {
        let mut tags = vec![(0, "LWPOLYLINE"), (100, "AcDbEntity"), (8, layer)];
        tags.extend([(100, "AcDbPolyline"), (90, "4"), (70, "1")]);
        for (x, y) in [("0", "0"), (side, "0"), (side, side), ("0", side)] {
            tags.extend([(10, x), (20, y)]);
        }
        tags
    };
    let (driver, follower) = (polyline("driver", "9"), polyline("follower", "6"));
    let crossing = [(0, "CIRCLE"), (8, "pitch-curves"), (10, "3"), (20, "3"), (40, "2.99")];
    let text = dxf(4, &[&driver, CIRCLE, &crossing, &follower]);
    near(read("a.dxf", &text, "").unwrap().outline.area(), 36.0);
    near(read("a.dxf", &text, "#driver").unwrap().outline.area(), 81.0);
    let error = read("a.dxf", &text, "#idler").unwrap_err();
    assert!(matches!(error, InputError::NoSuchPart { .. }), "{error}");
}

#[test]
fn what_crosses_the_boundary_is_no_hole() {
    let across = [(0, "CIRCLE"), (8, "0"), (10, "5"), (20, "1"), (40, "2.5")];
    assert!(read("a.dxf", dxf(4, &[STADIUM, &across]), "").unwrap().holes.is_empty());
}

#[test]
fn what_is_not_read_from_a_drawing_is_named() {
    let text = [(0, "MTEXT"), (8, "0"), (10, "0"), (20, "0"), (1, "3")];
    let said = |text: String| read("a.dxf", text, "").unwrap_err().to_string();
    assert!(said(dxf(4, &[&text])).contains("MTEXT"));
    assert!(said(dxf(3, &[STADIUM])).contains("unit is `Miles`; save it in millimetres"));
    assert!(said(dxf(4, &[])).contains("is a curve; draw"));
    assert!(said("0\nSECTION\n2\nENT".to_owned()).contains("breaks off"));
}

/// A pyramid 4 by 4 wide and 2 high: half-way up its section is 2 by 2.
const PYRAMID: [[f64; 3]; 5] =
    [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [0.0, 4.0, 0.0], [2.0, 2.0, 2.0]];
const FACES: [[usize; 3]; 6] = [[0, 2, 1], [0, 3, 2], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];

fn section(gear: &Toothed) {
    // The cut is taken 1e-4 of the height off the middle.
    assert!((gear.outline.area() - 4.0).abs() < 4e-3, "{}", gear.outline.area());
    near(gear.outline.centroid().x, 2.0);
}

#[test]
fn solids_are_cut_at_half_their_thickness() {
    let vertices = PYRAMID
        .iter()
        .fold(String::new(), |text, v| format!("{text}v {} {} {}\n", v[0], v[1], v[2]));
    let faces = |list: &[[usize; 3]]| {
        list.iter().fold(String::new(), |text, f| {
            format!("{text}f {}//1 {}//1 {}//1\n", f[0] + 1, f[1] + 1, f[2] + 1)
        })
    };
    let objects = format!("{vertices}o follower\n{}o driver\nf 1 2 5\n", faces(&FACES));
    section(&read("a.obj", &objects, "").unwrap());
    let open = read("a.obj", format!("{vertices}{}", faces(&FACES[..5])), "").unwrap_err();
    assert!(matches!(open, InputError::Solid { error: SolidFileError::Open, .. }), "{open}");
    let mut stl = "solid a\n".to_owned();
    for face in FACES {
        stl += "facet normal 0 0 1\nouter loop\n";
        for [x, y, z] in face.map(|i| PYRAMID[i]) {
            writeln!(stl, "vertex {x} {y} {z}").unwrap();
        }
        stl += "endloop\nendfacet\n";
    }
    section(&read("a.stl", stl + "endsolid a\n", "").unwrap());
}

#[test]
fn solids_with_a_vertex_at_no_place_are_refused() {
    // Corners of the pyramid's base: the cut alone does not show them.
    let binary = |x: f32| {
        let mut bytes = vec![0_u8; 80];
        bytes.extend((FACES.len() as u32).to_le_bytes());
        for face in FACES {
            bytes.extend([0_u8; 12]);
            for corner in face {
                let [_, y, z] = PYRAMID[corner];
                let x = if corner == 0 { x } else { PYRAMID[corner][0] as f32 };
                for value in [x, y as f32, z as f32] {
                    bytes.extend(value.to_le_bytes());
                }
            }
            bytes.extend([0_u8; 2]);
        }
        bytes
    };
    section(&read("a.stl", binary(0.0), "").unwrap());
    for x in [f32::NAN, f32::INFINITY, 1e38, -2e9] {
        let error = read("a.stl", binary(x), "").unwrap_err();
        assert!(
            matches!(error, InputError::Solid { error: SolidFileError::Vertex { .. }, .. }),
            "{error}"
        );
        assert!(error.to_string().contains("; repair"), "{error}");
    }
}

#[test]
fn a_fold_of_no_width_is_taken_out_and_it_is_said() {
    let with_fold = |tip: &str| format!("0,0\n5,0\n5,5\n2,5\n{tip}\n1.9,5\n0,5\n");
    let gear = read("a.csv", with_fold("1.8,5.000002"), "").unwrap();
    near(gear.outline.area(), 25.0);
    let crossing = read("a.csv", with_fold("1.8,5.000002\n1.95,4.999998"), "").unwrap();
    near(crossing.outline.area(), 25.0);
    assert!(crossing.thinned.is_some_and(|t| t.tolerance < 1e-4));
    let error = read("a.csv", with_fold("1,6\n3,6"), "").unwrap_err();
    assert!(matches!(error, InputError::Outline { .. }), "{error}");
}

#[test]
fn a_record_tells_of_the_pair_and_points_do_not() {
    let square = |side: f64| format!("[[0,0],[{side},0],[{side},{side}],[0,{side}]]");
    let text = format!(
        r#"{{"center_distance": 7, "driver": {{"teeth": 3, "outline": {}, "bore": null}},
        "follower": {{"teeth": 4, "outline": {}, "bore": [[1,1],[2,1],[2,2]]}},
        "motion": {{"driver_angle": [0, 1], "follower_angle": [0, 2]}}}}"#,
        square(3.0),
        square(5.0)
    );
    let gear = read("design.json", &text, "").unwrap();
    near(gear.outline.area(), 25.0);
    assert_eq!(gear.holes.len(), 1);
    let record = gear.record.unwrap();
    assert_eq!((record.center_distance, record.teeth), (7.0, Some([3, 4])));
    assert_eq!(record.follower_angle, [0.0, 2.0]);
    let plain = read("a.csv", "x,y\n0,0\n5,0\n5,5\n0,5\n", "").unwrap();
    assert_eq!((plain.outline, plain.record), (gear.outline, None));
}
