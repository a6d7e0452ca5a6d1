//! Inputs that once broke something, as `fuzz/` and reading its targets' code found them: each is now refused with one plain
//! line, in no time.

use centrode::check::{CheckOptions, check};
use centrode::gear::Side;
use centrode::input::{LoadOptions, shape_from_bytes, toothed_from_bytes};
use centrode::law::{Quantity, Table};
use centrode::outline::Outline;
use centrode::scene::{Key, Kind, read, write};
use centrode::schema::SavedDesign;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Longest time that a refusal may take, also in an unoptimised build on a busy machine.
const PATIENCE: Duration = Duration::from_secs(20);

fn found(name: &str) -> (PathBuf, Vec<u8>) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/found").join(name);
    let bytes = std::fs::read(&path).unwrap_or_else(|e| panic!("{name}: {e}"));
    (path, bytes)
}

/// Reads each file and compares what it says.
fn refused(cases: &[(&str, &str)], read: impl Fn(&str, &[u8]) -> Result<(), String>) {
    for (name, word) in cases {
        let start = Instant::now();
        let said = read(name, &found(name).1).expect_err(name);
        assert!(start.elapsed() < PATIENCE, "{name} took {:?}", start.elapsed());
        assert!(said.contains(word), "{name}: {word:?} is missing in {said:?}");
        assert!(!said.contains(char::is_control), "{name}: {said:?}");
        assert!(said.len() < 600, "{name}: {} bytes", said.len());
    }
}

#[test]
fn control_characters_of_a_drawing_do_not_reach_the_terminal() {
    let cases = [("points-1.csv", "line 3 (`4 [31m,3`)"), ("points-2.csv", "not plain text")];
    refused(&cases, |name, bytes| {
        let made = shape_from_bytes(bytes, name, &LoadOptions::default());
        made.map(drop).map_err(|e| e.to_string())
    });
    refused(&[("table-1.csv", "line 10 of the table")], |_, bytes| {
        Table::parse(bytes, Quantity::Angle).map(drop).map_err(|e| e.to_string())
    });
}

#[test]
fn an_arc_wider_than_the_world_is_refused() {
    // Its pieces were counted by the million, and the reader moved all of them for each.
    refused(&[("svg-1.svg", "1.1e39")], |name, bytes| {
        let made = shape_from_bytes(bytes, name, &LoadOptions::default());
        made.map(drop).map_err(|e| e.to_string())
    });
}

#[test]
fn an_outline_that_is_accepted_is_accepted_again() {
    let (path, bytes) = found("mesh-2.obj");
    let made = toothed_from_bytes(&bytes, &path.to_string_lossy(), None, Side::Driver);
    if let Ok(gear) = made {
        let points = gear.outline.points().to_vec();
        assert_eq!(Outline::new(points).as_ref(), Ok(&gear.outline));
    }
}

#[test]
fn finished_gears_far_away_or_of_absurd_numbers_are_refused() {
    let cases = [
        ("dxf-1.dxf", "is a curve"),
        // Cells of the grid in which ends of lines are joined were counted beyond the integers.
        ("dxf-2.dxf", "beyond 1e9"),
        // The work on a spline grows with the square of its degree.
        ("dxf-3.dxf", "a spline whose"),
        // The number of a vertex counted back from the last overflowed.
        ("mesh-1.obj", "line 4"),
    ];
    refused(&cases, |name, bytes| {
        let made = toothed_from_bytes(bytes, name, None, Side::Driver);
        made.map(drop).map_err(|e| e.to_string())
    });
}

#[test]
fn records_with_absurd_numbers_are_refused() {
    let cases = [
        // Steps of a run by the tooth, and candidates for a ring's symmetry: both without end.
        ("design-1.json", "4000000000 teeth"),
        // Places by the module on an outline: more than there is memory.
        ("design-2.json", "its module is 1e-300"),
        ("design-3.json", "its center_distance is 1e308"),
        ("design-4.json", "do not rise"),
        ("design-5.json", "O of its driver has no edge"),
        ("design-6.json", "control characters"),
        ("design-7.json", "point 0"),
    ];
    refused(&cases, |_, bytes| {
        let text = std::str::from_utf8(bytes).map_err(|e| e.to_string())?;
        SavedDesign::from_json(text).map(drop)
    });
}

#[test]
fn a_check_does_not_believe_absurd_tooth_counts() {
    refused(&[("design-1.json", "4000000000 teeth")], |name, bytes| {
        let gear = |role| toothed_from_bytes(bytes, name, None, role).unwrap();
        let options = CheckOptions { center_distance: Some(16.0), ..CheckOptions::default() };
        let made = check(&gear(Side::Driver), &gear(Side::Follower), &options);
        made.map(drop).map_err(|e| e.to_string())
    });
}

fn keys() -> Vec<Key> {
    let key = |name: &str, table: Option<&str>| Key {
        name: name.to_owned(),
        table: table.map(str::to_owned),
        kind: Kind::One,
        help: String::new(),
        default: None,
    };
    vec![key("driver", None), key("follower", None), key("max-lean", Some("fit"))]
}

#[test]
fn names_that_look_like_numbers_stay_what_they_are() {
    let text = String::from_utf8(found("scene-1.toml").1).unwrap();
    let said = read(&text, &keys()).unwrap();
    let values: Vec<&str> = said.iter().map(|s| s.values[0].as_str()).collect();
    assert_eq!(values, ["1e5", "-0.0"]);
    assert_eq!(read(&write("design", &keys(), &said), &keys()), Ok(said));
}

#[test]
fn a_scene_is_quoted_in_one_plain_line() {
    refused(&[("scene-2.toml", "\"strict ly\"")], |_, bytes| {
        read(std::str::from_utf8(bytes).unwrap(), &keys()).map(drop).map_err(|e| e.to_string())
    });
}

#[cfg(unix)]
#[test]
fn files_without_an_end_are_read_no_further_than_their_bound() {
    let error = SavedDesign::read(Path::new("/dev/zero")).unwrap_err().to_string();
    assert!(error.contains("more than") && !error.contains(char::is_control), "{error}");
    let error = centrode::schema::read_train(Path::new("/dev/zero")).unwrap_err().to_string();
    assert!(error.contains("more than"), "{error}");
}
