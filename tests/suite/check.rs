//! `centrode check` passes pairs that mesh, catches those that do not, and refuses what is no pair.

use crate::common::{centrode, complaint};
use centrode::gear::Side;
use centrode::input::load_toothed;
use centrode::policy::EXPORT_TOLERANCE;
use serde_json::Value;
use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::Output;
use std::time::{Duration, Instant};

const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data");
const DRIVER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/involute_24_driver.csv");
const FOLLOWER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/involute_48_follower.csv");
/// Longest time a check may take, in an unoptimised build on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);

struct Bench(tempfile::TempDir);

impl Bench {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn file(&self, name: &str, content: impl AsRef<[u8]>) -> String {
        let path = self.0.path().join(name);
        fs::write(&path, content).unwrap();
        path.to_string_lossy().into_owned()
    }
}

fn spoiled(name: &str) -> String {
    format!("{DATA}/spoiled/{name}.json")
}

fn check(arguments: &[&str]) -> Output {
    let start = Instant::now();
    let output = centrode(["check"].iter().chain(arguments));
    assert!(start.elapsed() < PATIENCE, "{arguments:?} took {:?}", start.elapsed());
    output
}

/// The exit code and the answer of `--json`.
fn answer(arguments: &[&str]) -> (i32, Value) {
    let output = check(&[arguments, &["--json"]].concat());
    let text = String::from_utf8_lossy(&output.stdout);
    let value = serde_json::from_str(&text).unwrap_or_else(|e| {
        panic!("{arguments:?}: {e}: {text} {}", complaint(&output));
    });
    (output.status.code().unwrap(), value)
}

fn meshes(arguments: &[&str]) -> Value {
    let (code, said) = answer(arguments);
    assert_eq!(code, 0, "{arguments:?}: {}", said["faults"]);
    assert_eq!(said["meshes"], true);
    said
}

/// The pair is judged, and fails for one of these reasons.
fn fails(arguments: &[&str], reasons: &[&str]) {
    let (code, said) = answer(arguments);
    assert_eq!((code, &said["meshes"]), (1, &Value::Bool(false)), "{arguments:?}: {said}");
    let faults = said["faults"].as_array().unwrap();
    let named = |f: &Value| reasons.iter().any(|r| f["code"] == *r);
    assert!(faults.iter().any(named), "{arguments:?}: {}", said["faults"]);
    assert!(faults.iter().all(|f| f["severity"] == "fault" && f["sentence"].is_string()));
}

/// The input is refused with one line that holds the words and a remedy.
fn refuses(arguments: &[&str], words: &[&str]) {
    let output = check(arguments);
    let said = complaint(&output);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
    assert!(said.starts_with("error: ") && said.trim_end().lines().count() == 1, "{said}");
    for word in words {
        assert!(said.contains(word), "`{word}` is not in: {said}");
    }
    assert!(output.stdout.is_empty());
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn points(path: &str) -> Vec<[f64; 2]> {
    let text = fs::read_to_string(path).unwrap();
    if path.ends_with(".json") {
        let value: Value = serde_json::from_str(&text).unwrap();
        let list = value["outline"].as_array().unwrap();
        return list.iter().map(|p| [number(&p[0]), number(&p[1])]).collect();
    }
    text.lines()
        .filter(|l| l.starts_with(|c: char| c == '-' || c.is_ascii_digit()))
        .map(|l| l.split_once(',').unwrap())
        .map(|(x, y)| [x.parse().unwrap(), y.parse().unwrap()])
        .collect()
}

fn csv(points: &[[f64; 2]]) -> String {
    points.iter().fold(String::new(), |mut text, [x, y]| {
        writeln!(text, "{x:.6},{y:.6}").unwrap();
        text
    })
}

fn scaled(path: &str, scale: f64) -> String {
    let points: Vec<[f64; 2]> = points(path).iter().map(|p| p.map(|c| c * scale)).collect();
    csv(&points)
}

#[test]
fn groups_of_a_drawing_tell_the_gears_apart() {
    let bench = Bench::new();
    let layer = |name: &str, driver: f64, follower: f64| {
        format!(
            "<g id='{name}'><g id='driver-{name}' transform='translate(50 50)'><circle r='{driver}'/></g>\
             <g id='follower-{name}' transform='translate(150 50)'><circle r='{follower}'/></g></g>"
        )
    };
    let svg = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='220mm' height='100mm' viewBox='0 0 220 100'>{}{}</svg>",
        layer("bores", 3.0, 4.0),
        layer("outlines", 30.0, 40.0)
    );
    let path = bench.file("laser.svg", svg);
    let read = |source: &str, role| load_toothed(source, role).unwrap();
    let by_name = format!("{path}#follower");
    for (gear, radius) in [
        (read(&path, Side::Driver), 30.0),
        (read(&path, Side::Follower), 40.0),
        (read(&by_name, Side::Driver), 40.0),
    ] {
        let area = PI * radius * radius;
        assert!((gear.outline.area() / area - 1.0).abs() < 0.01, "{}", gear.outline.area());
        assert_eq!(gear.holes.len(), 1);
    }
    let none = load_toothed(&format!("{path}#idler"), Side::Driver).unwrap_err().to_string();
    assert!(none.contains("no part `idler`"), "{none}");
}

#[test]
fn an_involute_pair_of_another_program_meshes() {
    let said = meshes(&[DRIVER, FOLLOWER, "-L", "72"]);
    assert_eq!(said["teeth"], serde_json::json!([24, 48]));
    assert_eq!(number(&said["ratio"]), 2.0);
    assert!((number(&said["module"]) - 2.0).abs() < 0.05);
    assert!(number(&said["contact"]["transmission_error_peak_to_peak_pitch"]) < 0.005);
    // The drawing is turned by 0.2345 rad; one gap in 48 is as good as any other.
    let pitch = TAU / 48.0;
    let off = (number(&said["phase"]) - 0.2345).rem_euclid(pitch);
    assert!(off.min(pitch - off) < 1e-3, "{}", said["phase"]);
    assert!(!said["runs"].as_array().unwrap().is_empty());
}

#[test]
fn spoiled_involute_pairs_fail_where_geometry_says_so() {
    let alone = |driver: &str, reasons: &[&str]| {
        fails(&[&spoiled(driver), FOLLOWER, "-L", "72", "--no-simulate"], reasons);
    };
    alone("involute_driver_3_teeth_removed", &["contact-lost", "transmission-error"]);
    alone("involute_driver_8_teeth_removed", &["contact-lost", "transmission-error"]);
    alone("involute_driver_two_teeth_merged", &["overlap"]);
    alone("involute_driver_lump_in_a_gap", &["overlap"]);
    fails(&[DRIVER, FOLLOWER, "-L", "71.3"], &["overlap"]);
    fails(&[DRIVER, FOLLOWER, "-L", "72", "--ratio", "2.1"], &["overlap", "contact-lost"]);
    let bench = Bench::new();
    let driver = bench.file("d.csv", scaled(DRIVER, 1.01));
    let follower = bench.file("f.csv", scaled(FOLLOWER, 1.01));
    fails(&[&driver, &follower, "-L", "72"], &["overlap"]);
}

#[test]
fn a_wrong_phase_fails_and_the_right_one_does_not() {
    let bench = Bench::new();
    let motion: String =
        (0..=64).map(|i| TAU * f64::from(i) / 32.0).map(|a| format!("{a},{}\n", a / 2.0)).collect();
    let motion = bench.file("psi.csv", format!("driver,follower\n{motion}"));
    let at = |degrees: f64| -> Vec<String> {
        let fixed = [DRIVER, FOLLOWER, "-L", "72", "--no-simulate", "--motion", &motion, "--phase"];
        fixed.iter().map(ToString::to_string).chain([degrees.to_string()]).collect()
    };
    let plain = |all: &[String]| all.iter().map(String::as_str).collect::<Vec<_>>().join("\u{1}");
    let right = plain(&at(0.2345_f64.to_degrees()));
    let wrong = plain(&at(0.2345_f64.to_degrees() + 4.0));
    meshes(&right.split('\u{1}').collect::<Vec<_>>());
    fails(&wrong.split('\u{1}').collect::<Vec<_>>(), &["overlap"]);
}

#[test]
fn a_silhouette_pair_meshes_by_its_outlines_alone_and_fails_spoiled() {
    let follower = spoiled("heart-dove_follower");
    let bench = Bench::new();
    let (c, s) = (1.0_f64.cos(), 1.0_f64.sin());
    let turned: Vec<[f64; 2]> =
        points(&follower).iter().map(|[x, y]| [c * x - s * y, s * x + c * y]).collect();
    let turned = bench.file("turned.csv", csv(&turned));
    let said = meshes(&[&spoiled("heart-dove_driver"), &turned, "-L", "80", "--no-simulate"]);
    assert_eq!(said["teeth"], serde_json::json!([32, 32]));
    assert_eq!(said["motion_source"], "contact");
    assert!((number(&said["phase"]) - 1.0).abs() < 0.01, "{}", said["phase"]);
    for (kind, reasons) in [
        ("8_teeth_removed", ["contact-lost", "skipped-teeth"]),
        ("two_teeth_merged", ["overlap", "jam"]),
        ("lump_in_a_gap", ["overlap", "jam"]),
    ] {
        let driver = spoiled(&format!("heart-dove_driver_{kind}"));
        fails(&[&driver, &follower, "-L", "80", "--no-simulate"], &reasons);
    }
}

#[test]
fn our_own_exports_read_back_and_mesh() {
    let bench = Bench::new();
    let folder = bench.0.path().join("pair").to_string_lossy().into_owned();
    let made = centrode(["design", "heart", "dove", "--teeth", "32", "-o", &folder]);
    assert!(made.status.success(), "{}", complaint(&made));
    let said = meshes(&[&folder, &folder, "--no-simulate"]);
    assert_eq!((said["motion_source"].as_str(), number(&said["phase"])), (Some("record"), 0.0));
    for (driver, follower) in [
        ("driver.stl", "follower.stl"),
        ("pair.obj", "pair.obj"),
        ("driver.dxf", "follower.dxf"),
        ("pair.dxf", "pair.dxf"),
    ] {
        let [driver, follower] = [driver, follower].map(|name| format!("{folder}/{name}"));
        let said = meshes(&[&driver, &follower, "-L", "80", "--no-simulate"]);
        assert_eq!(said["teeth"], serde_json::json!([32, 32]));
        assert_eq!(said["axis_source"], serde_json::json!(["bore", "bore"]));
        assert!(number(&said["phase"]).abs() < 0.01, "{}", said["phase"]);
    }
}

#[test]
fn exported_drawings_hold_the_gears_within_the_tolerance() {
    let bench = Bench::new();
    let folder = bench.0.path().join("pair").to_string_lossy().into_owned();
    let options = ["--bore", "6mm", "--export", "dxf,json", "-o", &folder];
    let made = centrode(["design", "ellipse", "ellipse", "--teeth", "24"].iter().chain(&options));
    assert!(made.status.success(), "{}", complaint(&made));
    let gear = |file: &str, role| load_toothed(&format!("{folder}/{file}"), role).unwrap();
    for dialect in [&["--dxf-r12"][..], &["--dxf-polyline"], &[]] {
        let command = ["export", &folder, "--export", "dxf"];
        let again = centrode(command.iter().chain(dialect));
        assert!(again.status.success(), "{}", complaint(&again));
        for role in [Side::Driver, Side::Follower] {
            let truth = gear("design.json", role);
            for file in ["pair.dxf", &format!("{}.dxf", role.name())] {
                let drawn = gear(file, role);
                let off = (drawn.outline.area() - truth.outline.area()).abs();
                let points = truth.outline.points();
                let next = points.iter().cycle().skip(1);
                let perimeter: f64 = points.iter().zip(next).map(|(a, b)| (b - a).norm()).sum();
                assert!(off < EXPORT_TOLERANCE * perimeter, "{file} {dialect:?}: {off}");
                assert_eq!(drawn.holes.len(), 1, "{file} {dialect:?}");
                assert!((drawn.holes[0].area() / (9.0 * PI) - 1.0).abs() < 2e-3);
            }
        }
    }
}

#[test]
fn good_pairs_pass_as_rigid_bodies() {
    let bench = Bench::new();
    for (driver, follower, more) in [
        ("heart", "dove", ["--teeth", "32", "-k", "1"]),
        ("cat", "dove", ["--teeth", "32", "-k", "1/2"]),
    ] {
        let folder = bench.0.path().join(driver).to_string_lossy().into_owned();
        let options = ["--export", "json", "-o", &folder];
        let made = centrode(["design", driver, follower].iter().chain(&more).chain(&options));
        assert!(made.status.success(), "{}", complaint(&made));
        let record = format!("{folder}/design.json");
        let parts = [format!("{record}#driver"), format!("{record}#follower")];
        let said = meshes(&[&parts[0], &parts[1]]);
        let run = &said["runs"][0];
        assert!(number(&run["tracking_rms"]).to_degrees() < 0.02, "{run}");
        assert!(number(&run["torque_rms"]) < 0.05, "{run}");
    }
}

#[test]
fn drawings_say_the_same_as_points() {
    let bench = Bench::new();
    let path = |file: &str| {
        let data: Vec<String> =
            points(file).iter().map(|[x, y]| format!("{:.5} {:.5}", x + 60.0, 60.0 - y)).collect();
        format!("M{}Z", data.join("L"))
    };
    let svg = |file: &str, size: &str, view: f64| {
        format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" {size} viewBox="0 0 {view} {view}"><path fill="none" stroke="red" d="{}"/><circle cx="60" cy="60" r="3" fill="none" stroke="red"/></svg>"#,
            path(file)
        )
    };
    let driver = bench.file("d.svg", svg(DRIVER, r#"width="120mm" height="120mm""#, 120.0));
    let follower = bench.file("f.svg", svg(FOLLOWER, "", 120.0));
    let dxf = |file: &str| {
        let vertices = points(file);
        let mut text =
            "0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n8\n0\n10\n7\n20\n9\n30\n0\n40\n3\n".to_owned();
        for (i, [x, y]) in vertices.iter().enumerate() {
            let [u, v] = vertices[(i + 1) % vertices.len()];
            write!(
                text,
                "0\nLINE\n8\n0\n10\n{}\n20\n{}\n30\n0\n11\n{}\n21\n{}\n31\n0\n",
                x + 7.0,
                y + 9.0,
                u + 7.0,
                v + 9.0
            )
            .unwrap();
        }
        text + "0\nENDSEC\n0\nEOF\n"
    };
    let lines = bench.file("d.dxf", dxf(DRIVER));
    let plain = meshes(&[DRIVER, FOLLOWER, "-L", "72", "--no-simulate"]);
    for driver in [&driver, &lines] {
        let said = meshes(&[driver, &follower, "-L", "72", "--no-simulate"]);
        assert_eq!(said["teeth"], plain["teeth"]);
        assert_eq!(said["axis_source"], serde_json::json!(["bore", "bore"]));
        let ratio = |v: &Value| number(&v["contact"]["min_backlash"]);
        assert!((ratio(&said) / ratio(&plain) - 1.0).abs() < 0.02, "{said}");
    }
}

#[test]
fn gears_that_never_touch_or_overlap_from_the_start_are_judged() {
    fails(&[DRIVER, FOLLOWER, "--no-simulate", "-L", "50"], &["overlap"]);
    fails(&[DRIVER, FOLLOWER, "--no-simulate", "-L", "77"], &["no-contact"]);
}

#[test]
fn what_is_no_pair_is_refused() {
    let bench = Bench::new();
    let with = |extra: &[&str], words: &[&str]| {
        refuses(&[&[DRIVER, FOLLOWER, "--no-simulate"], extra].concat(), words);
    };
    with(&[], &["--center-distance"]);
    with(&["-L", "72", "--driver-axis", "40,0"], &["outside the gear", "driver"]);
    with(&["-L", "72", "--follower-axis", "0,90"], &["outside the gear", "follower"]);
    for bad in ["0", "-5", "nan", "inf"] {
        refuses(&[DRIVER, FOLLOWER, "-L", "72", "--load", bad], &["load", "above zero"]);
        with(&["-L", bad], &["center-distance"]);
        with(&["-L", "72", "--ratio", bad], &["ratio", "above zero"]);
    }
    let motion = |name: &str, text: &str, words: &[&str]| {
        let file = bench.file(name, text);
        with(&["-L", "72", "--motion", &file], words);
    };
    motion("falls.csv", "0,0\n2,1\n4,0.5\n6.2832,3.1416\n", &["does not increase", "sample 2"]);
    motion("part.csv", "0,0\n1,0.5\n2,1\n3,1.5\n", &["turns of the driver"]);
    motion("nan.csv", "0,0\n1,nan\n2,1\n6.28,3.14\n", &["line 2"]);
    motion("short.csv", "0,0\n6.283185307,3.14159265\n", &["at least four"]);
    with(&["-L", "72", "--motion", "/nowhere.csv"], &["nowhere.csv", "check the path"]);
}

#[test]
fn outlines_that_are_none_are_refused() {
    let bench = Bench::new();
    let driver = |file: &str, words: &[&str]| refuses(&[file, FOLLOWER, "-L", "72"], words);
    let gear = points(DRIVER);
    driver(&bench.file("open.csv", csv(&gear[..gear.len() * 3 / 4])), &["open by", "close it"]);
    let mut crossed = gear.clone();
    crossed.swap(100, 160);
    driver(&bench.file("crossed.csv", csv(&crossed)), &["crosses itself", "redraw"]);
    let mut odd = csv(&gear);
    odd.push_str("nan,3\n");
    driver(&bench.file("nan.csv", &odd), &["nan,3", "two finite numbers"]);
    driver(&bench.file("empty.json", "[]"), &["no closed contour"]);
    driver(&bench.file("broken.stl", "solid\nfacet\n"), &["STL", "save it again"]);
    driver(&bench.file("broken.obj", "v 0 0 0\nf 1 2 9\n"), &["OBJ", "line 2"]);
    driver("no-such-gear.csv", &["no such file"]);
    let circle: Vec<[f64; 2]> = (0..500)
        .map(|i| TAU * f64::from(i) / 500.0)
        .map(|a| [25.0 * a.cos(), 25.0 * a.sin()])
        .collect();
    driver(&bench.file("disc.csv", csv(&circle)), &["no regular teeth", "toothed"]);
    let open = r#"<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0L9 0L9 9" fill="none" stroke="black"/></svg>"#;
    driver(&bench.file("open.svg", open), &["open by"]);
}

#[test]
fn a_million_vertices_are_thinned_and_it_is_said() {
    let bench = Bench::new();
    let gear = points(DRIVER);
    let each = 1_000_000 / gear.len() + 1;
    let many: Vec<[f64; 2]> = (0..gear.len())
        .flat_map(|i| {
            let ([x, y], [u, v]) = (gear[i], gear[(i + 1) % gear.len()]);
            (0..each)
                .map(move |k| k as f64 / each as f64)
                .map(move |t| [x + t * (u - x), y + t * (v - y)])
        })
        .collect();
    assert!(many.len() >= 1_000_000);
    let driver = bench.file("many.csv", csv(&many));
    let said = meshes(&[&driver, FOLLOWER, "-L", "72", "--no-simulate"]);
    let notes = said["notes"].to_string();
    assert!(notes.contains("thinned from") && notes.contains("within"), "{notes}");
    assert!(Path::new(&driver).exists());
}
