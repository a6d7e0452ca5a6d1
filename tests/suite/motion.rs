//! Gears from a motion and from one shape, fixed choices, and what a system installs.

use crate::common::{centrode, complaint, tree};
use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

use serde_json::Value;

/// Makes a pair with little to write; its record.
fn made(arguments: &[&str]) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("out");
    let rest = ["--no-simulate", "--export", "json,html", "-o"].map(str::to_owned);
    let place = [output.to_string_lossy().into_owned()];
    let all = arguments.iter().map(|a| (*a).to_owned()).chain(rest).chain(place);
    let said = centrode(all);
    assert_eq!(said.status.code(), Some(0), "{arguments:?}: {}", complaint(&said));
    let page = fs::read_to_string(output.join("report.html")).unwrap();
    assert!(!page.contains("NaN"), "{arguments:?}");
    let text = fs::read_to_string(output.join("design.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn refuses(arguments: &[&str], words: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("out").to_string_lossy().into_owned();
    let said = centrode(arguments.iter().copied().chain(["-o", &output]));
    let text = complaint(&said);
    assert_eq!(said.status.code(), Some(2), "{arguments:?}: {text}");
    assert_eq!(text.trim_end().lines().count(), 1, "{text}");
    assert!(text.starts_with("error: ") && !text.contains("panicked"), "{text}");
    for word in words {
        assert!(text.contains(word), "`{word}` is missing: {text}");
    }
    assert!(tree(folder.path()).is_empty(), "{arguments:?} left something");
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

/// The record's motion follows psi within `tolerance`, radians.
fn follows(record: &Value, psi: impl Fn(f64) -> f64, tolerance: f64) {
    let driver = numbers(&record["motion"]["driver_angle"]);
    let follower = numbers(&record["motion"]["follower_angle"]);
    for (phi, turned) in driver.iter().zip(&follower) {
        assert!((turned - psi(*phi)).abs() < tolerance, "{phi}: {turned}");
    }
}

#[test]
fn a_formula_becomes_the_motion_it_says() {
    let record = made(&["motion", "1 + 0.3*cos(2*phi)"]);
    follows(&record, |phi| phi + 0.15 * (2.0 * phi).sin(), 1e-8);
    assert_eq!(record["meshing"]["verdict"], "good");
    assert!(record.get("objective").is_none() && record.get("resemblance").is_none());
    assert_eq!(record["driver"]["input"].as_array().unwrap().len(), 0);
    assert!(record["strength"]["weakest_tooth"]["stress"].as_f64().unwrap() > 0.0);
    let by_angle = made(&["motion", "phi + 0.15*sin(2*phi)", "--psi"]);
    follows(&by_angle, |phi| phi + 0.15 * (2.0 * phi).sin(), 1e-8);
}

#[test]
fn a_part_of_a_turn_is_followed_and_the_rest_closes() {
    // From 30 to 150 degrees the follower gains speed evenly.
    let record = made(&["motion", "0.7 + 0.2*phi", "--from", "30", "--to", "150"]);
    let driver = numbers(&record["motion"]["driver_angle"]);
    let follower = numbers(&record["motion"]["follower_angle"]);
    let (from, to) = (TAU / 12.0, TAU * 5.0 / 12.0);
    let law = |phi: f64| 0.7 * (phi - from) + 0.1 * (phi * phi - from * from);
    let inside: Vec<_> =
        driver.iter().zip(&follower).filter(|(phi, _)| (from..=to).contains(*phi)).collect();
    let (first, turned) = inside[0];
    for (phi, angle) in &inside {
        assert!((**angle - turned - (law(**phi) - law(*first))).abs() < 1e-4, "{phi}");
    }
    assert!(inside.len() > 300);
    assert!((follower[follower.len() - 1] - TAU).abs() < 1e-9);
    assert_eq!(record["meshing"]["lost_poses"], 0);
    refuses(
        &["motion", "2.2", "--from", "0", "--to", "170"],
        &["turns the follower by 374", "shorten"],
    );
    refuses(&["motion", "1", "--from", "0", "--to", "360"], &["342.0", "closing"]);
    refuses(&["motion", "1", "--from", "0"], &["--to"]);
    refuses(&["motion", "--preset", "constant", "--from", "0", "--to", "9"], &["--from"]);
}

#[test]
fn sectors_keep_the_teeth_of_their_part_and_swing() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("sector").to_string_lossy().into_owned();
    let law = ["motion", "0.7 + 0.2*phi", "--from", "30", "--to", "150"];
    let said = centrode(law.iter().copied().chain([
        "--sector",
        "--no-simulate",
        "--export",
        "json,svg,glb,stl",
        "-o",
        &out,
    ]));
    assert_eq!(said.status.code(), Some(0), "{}", complaint(&said));
    let text = fs::read_to_string(folder.path().join("sector/design.json")).unwrap();
    let record: Value = serde_json::from_str(&text).unwrap();
    let whole = made(&law);
    assert_eq!(record["motion"]["swings"], true);
    // The samples are the way there, from the beginning of the part on.
    let driver = numbers(&record["motion"]["driver_angle"]);
    assert!((driver[driver.len() - 1] - TAU / 3.0).abs() < 1e-12);
    let from = TAU / 12.0;
    follows(&record, |x| 0.7 * x + 0.1 * ((from + x).powi(2) - from * from), 1e-4);
    let area = |record: &Value, gear: &str| {
        let ring: Vec<Vec<f64>> = serde_json::from_value(record[gear]["outline"].clone()).unwrap();
        let next = ring.iter().cycle().skip(1);
        0.5 * ring.iter().zip(next).map(|(p, q)| p[0] * q[1] - p[1] * q[0]).sum::<f64>()
    };
    for gear in ["driver", "follower"] {
        let share = area(&record, gear) / area(&whole, gear);
        assert!((0.2..0.7).contains(&share), "{gear}: {share}");
    }
    // The record makes the same files again; a train, which turns whole gears, refuses it.
    let again = folder.path().join("again").to_string_lossy().into_owned();
    let said = centrode(["export", &out, "--export", "glb", "-o", &again]);
    assert_eq!(said.status.code(), Some(0), "{}", complaint(&said));
    let bytes = |place: &str| fs::read(folder.path().join(place).join("pair.glb")).unwrap();
    assert_eq!(bytes("sector"), bytes("again"));
    let said = centrode(["train", &out, "-o", &again]);
    assert_eq!(said.status.code(), Some(2));
    assert!(complaint(&said).contains("--sector"), "{}", complaint(&said));
    refuses(&["motion", "1", "--sector"], &["--from"]);
}

#[test]
fn a_simulation_brings_the_record_up_to_date_and_keeps_the_page() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("pair").to_string_lossy().into_owned();
    let quick = ["motion", "1 + 0.3*cos(phi)", "--teeth", "24", "--no-simulate"];
    let said = centrode([&quick[..], &["--export", "html", "-o", &out]].concat());
    assert_eq!(said.status.code(), Some(0), "{}", complaint(&said));
    let read = |name: &str| fs::read_to_string(Path::new(&out).join(name)).unwrap();
    let record = || serde_json::from_str::<serde_json::Value>(&read("design.json")).unwrap();
    let before = record();
    assert_eq!(before["meshing"]["runs"], serde_json::json!([]));
    let said = centrode(["simulate", &out, "--cycles", "1", "--load", "250"]);
    assert_eq!(said.status.code(), Some(0), "{}", complaint(&said));
    let after = record();
    assert_eq!(after["meshing"]["runs"][0]["load"], 250.0);
    for kept in ["driver", "follower", "motion", "settings", "used"] {
        assert_eq!(after[kept], before[kept], "{kept}");
    }
    assert_eq!(after["meshing"]["contact_ratio"], before["meshing"]["contact_ratio"]);
    assert!(read("report.html").contains("Transmission function psi"), "the page of the design");
    // A page can be made of the record alone.
    let again = folder.path().join("again").to_string_lossy().into_owned();
    let said = centrode(["export", &out, "--export", "html", "-o", &again]);
    assert_eq!(said.status.code(), Some(0), "{}", complaint(&said));
    let page = fs::read_to_string(Path::new(&again).join("report.html")).unwrap();
    assert!(page.contains("Transmission function psi"));
}

#[test]
fn three_turns_may_make_two() {
    let record = made(&["motion", "(1 + 0.2*cos(2*phi))*2/3", "--ratio", "3:2"]);
    follows(&record, |phi| (phi + 0.1 * (2.0 * phi).sin()) * 2.0 / 3.0, 1e-8);
    let last = numbers(&record["motion"]["driver_angle"]).last().copied().unwrap();
    assert!((last - 3.0 * TAU).abs() < 1e-9, "{last}");
    let teeth = |gear: &str| record[gear]["teeth"].as_u64().unwrap();
    assert_eq!(2 * teeth("follower"), 3 * teeth("driver"));
    assert_eq!(record["meshing"]["lost_poses"], 0);
}

#[test]
fn presets_radii_and_tables() {
    let e = 0.3;
    let ellipse = |phi: f64| {
        let turns = ((phi + TAU / 2.0) / TAU).floor();
        let half = 0.5 * (phi - turns * TAU);
        2.0 * ((1.0 - e) / (1.0 + e) * half.tan()).atan() + turns * TAU
    };
    follows(&made(&["motion", "--preset", "ellipse:0.3"]), ellipse, 1e-6);
    follows(&made(&["motion", "--centrode", "25/(1 + 0.3*cos(phi))"]), ellipse, 1e-6);
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("law.csv");
    let rows: String = (0..=360)
        .map(|i| format!("{i};{:.9}\n", 1.0 + 0.2 * f64::from(i).to_radians().sin()))
        .collect();
    fs::write(&table, format!("angle in deg;psi'\n{}", rows.replace('.', ","))).unwrap();
    let record = made(&["motion", &table.to_string_lossy()]);
    follows(&record, |phi| phi + 0.2 - 0.2 * phi.cos(), 1e-6);
    assert_eq!(record["names"][0], "law");
}

#[test]
fn what_is_no_motion_is_refused_in_a_sentence() {
    refuses(&["motion", "1 + sine(phi)"], &["\"sine\"", "; "]);
    refuses(&["motion", "1 + 1.5*cos(phi)"], &["180.0 degrees", "stop or turn back"]);
    refuses(&["motion", "1.2 + 0.1*cos(phi)"], &["72.0 degrees past", "--normalise"]);
    refuses(&["motion", "1 + 0.3*cos(phi/2)"], &["does not repeat", "each turn of the driver"]);
    refuses(&["motion", "(1 + 0.3*cos(phi))*2/3", "-k", "3:2"], &["repeats 2 times"]);
    refuses(&["motion", "1/0"], &["no finite number"]);
    refuses(&["motion", "none.csv"], &["none.csv", "check the path"]);
    refuses(&["motion", &"(".repeat(400)], &["flatter"]);
    refuses(&["motion", "--preset", "ellipse:2"], &["0 to 0.9"]);
    refuses(&["motion", "1", "--preset", "constant"], &["cannot be used with"]);
    refuses(&["motion", "--centrode", "cos(phi)"], &["through its axis"]);
    refuses(&["motion", "1", "--ratio", "2.5"], &["3:2"]);
    refuses(&["motion"], &["LAW"]);
    let folder = tempfile::tempdir().unwrap();
    let bad = folder.path().join("bad.csv");
    for (text, word) in [
        (&b"0,1\n1,x\n"[..], "line 2"),
        (b"0,1\n0,1\n", "line 2"),
        (b"", "0 rows"),
        (b"\xff\xfe\x00", "UTF-8"),
        (b"0 1\n1 1\n2 1\n3 1\n4 1\n5 1\n6 1\n7 1\n8 1\n", "one period"),
    ] {
        fs::write(&bad, text).unwrap();
        refuses(&["motion", &bad.to_string_lossy()], &["bad.csv", word]);
    }
    refuses(&["motion", &format!("{}/x.csv", folder.path().display())], &["x.csv"]);
}

#[test]
fn a_shape_gets_its_mate() {
    let record = made(&["mate", "heart", "--ratio", "2"]);
    let teeth = |gear: &str| record[gear]["teeth"].as_u64().unwrap();
    assert_eq!(teeth("follower"), 2 * teeth("driver"));
    assert!(record["resemblance"]["driver_iou"].as_f64().unwrap() > 0.9);
    assert!(record["resemblance"].get("follower_iou").is_none());
    assert!(record["follower"]["rotation_center_in_input"].is_null());
    let record = made(&["mate", "egg", "--axis", "100,110"]);
    assert_eq!(numbers(&record["driver"]["rotation_center_in_input"]), [100.0, 110.0]);
    refuses(&["mate", "heart", "--axis", "900,900"], &["(900.0000, 900.0000)", "heart", "; "]);
    refuses(&["mate", "haert"], &["did you mean"]);
}

#[test]
fn axes_and_pose_may_be_fixed() {
    let fixed = ["--driver-axis", "100,110", "--follower-axis", "100,95", "--orientation", "40"];
    let record = made(&[&["design", "egg", "pear"], &fixed[..]].concat());
    assert_eq!(numbers(&record["driver"]["rotation_center_in_input"]), [100.0, 110.0]);
    assert_eq!(numbers(&record["follower"]["rotation_center_in_input"]), [100.0, 95.0]);
    assert_eq!(record["settings"]["orientation"], 40);
    refuses(&["design", "egg", "pear", "--driver-axis", "-5,-5"], &["(-5.0000, -5.0000)"]);
    refuses(&["design", "egg", "pear", "--driver-axis", "5"], &["12.5,-3"]);
    refuses(&["design", "egg", "pear", "--symmetric"], &["made from one shape"]);
    refuses(&["design", "egg", "egg", "--symmetric", "-k", "2"], &["ratio of 1"]);
}

#[test]
fn completions_pages_and_silence() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let said = centrode(["completions", shell]);
        let script = String::from_utf8(said.stdout).unwrap();
        assert!(script.contains("quick-return") || script.contains("normalise"), "{shell}");
    }
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("man");
    let said = centrode(["man", "-o", &place.to_string_lossy()]);
    assert!(said.status.success(), "{}", complaint(&said));
    let page = |name: &str| fs::read_to_string(Path::new(&place).join(name)).unwrap();
    assert!(page("centrode.1").starts_with(".ie") || page("centrode.1").contains(".TH"));
    assert!(page("centrode-motion.1").contains("normalise"));
    let version = String::from_utf8(centrode(["--version"]).stdout).unwrap();
    for word in ["solids:", "target:", "profile:", env!("CARGO_PKG_VERSION")] {
        assert!(version.contains(word), "{version}");
    }
    assert!(!version.contains('/'), "a path in {version}");
    let out = folder.path().join("out").to_string_lossy().into_owned();
    let quiet = ["motion", "1", "-q", "--threads", "1", "--no-simulate", "--export", "json", "-o"];
    let said = centrode(quiet.iter().copied().chain([out.as_str()]));
    assert!(said.status.success() && said.stdout.is_empty() && said.stderr.is_empty());
    refuses(&["motion", "1", "--threads", "0"], &["1..=1024"]);
}
