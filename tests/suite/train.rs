//! `centrode train`: saved pairs become trains whose every gear stands and turns right, or a sentence says why not.

use crate::common::{centrode, complaint};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

struct Bench {
    top: tempfile::TempDir,
}

impl Bench {
    /// A folder with a saved pair of ellipses in it.
    fn new() -> Self {
        let bench = Self { top: tempfile::tempdir().unwrap() };
        let made = centrode([
            "design",
            "ellipse",
            "ellipse",
            "--teeth",
            "24",
            "--no-simulate",
            "--export",
            "json",
            "-o",
            &bench.at("pair").to_string_lossy(),
        ]);
        assert!(made.status.success(), "{}", complaint(&made));
        bench
    }

    fn at(&self, name: &str) -> PathBuf {
        self.top.path().join(name)
    }

    fn train(&self, plan: &Path, more: &[&str]) -> Output {
        let (plan, out) = (plan.to_string_lossy().into_owned(), self.at("train"));
        let out = out.to_string_lossy().into_owned();
        centrode(["train", &plan, "-o", &out].into_iter().chain(more.iter().copied()))
    }

    fn refuses(&self, plan: &Path, more: &[&str], words: &[&str]) {
        let said = self.train(plan, more);
        let text = complaint(&said);
        assert_eq!(said.status.code(), Some(2), "{more:?}: {text}");
        assert_eq!(text.trim().lines().count(), 1, "{text}");
        for word in words {
            assert!(text.contains(word), "{word:?} is not in {text}");
        }
        assert!(!self.at("train").exists(), "something was written");
    }
}

#[test]
fn a_repeated_pair_turns_as_bodies_and_every_format_is_written() {
    let bench = Bench::new();
    let said = bench.train(
        &bench.at("pair"),
        &["--repeat", "2", "--layout", "zigzag", "--cycles", "0.5", "--json"],
    );
    assert!(said.status.success(), "{}", complaint(&said));
    let value: Value = serde_json::from_slice(&said.stdout).unwrap();
    assert_eq!(value["sound"], true);
    let load = value["runs"][0]["load"].as_f64().unwrap();
    let greatest = value["runs"][0]["greatest_ideal_torque"].as_f64().unwrap();
    let found = value["runs"][0]["greatest_torque"].as_f64().unwrap();
    assert!((found - greatest).abs() < 0.15 * load.max(greatest), "{found} {greatest}");
    for name in [
        "gear01.stl",
        "gear04.stl",
        "pair.glb",
        "pair.step",
        "pair.dxf",
        "scene.xml",
        "motion.csv",
        "train.json",
    ] {
        assert!(bench.at("train").join(name).metadata().unwrap().len() > 1000, "{name}");
    }
    let motion = fs::read_to_string(bench.at("train/motion.csv")).unwrap();
    let last: Vec<f64> =
        motion.lines().last().unwrap().split(',').map(|n| n.parse().unwrap()).collect();
    let turn = std::f64::consts::TAU;
    for (i, angle) in last[1..].iter().enumerate() {
        let wanted = if i % 2 == 0 { turn } else { -turn };
        assert!((angle - wanted).abs() < 1e-6, "{last:?}");
    }
}

#[test]
fn a_tree_with_a_shared_axle_comes_from_a_file() {
    let bench = Bench::new();
    let plan = bench.at("tree.toml");
    let gear = |name: &str, role: &str, more: &str| {
        format!("[[gears]]\nname = \"{name}\"\npair = \"e\"\nrole = \"{role}\"\n{more}\n")
    };
    let text = [
        "[pairs.e]\ndesign = \"pair\"\n".to_owned(),
        gear("crank", "driver", ""),
        gear("left", "follower", "on = \"crank\"\ndirection = 150"),
        gear("right", "follower", "on = \"crank\"\ndirection = 10"),
        gear("above", "driver", "axle = \"right\"\nrise = 10\nturn = 20"),
        gear("far", "follower", "on = \"above\"\ndirection = -60"),
    ]
    .concat();
    fs::write(&plan, text).unwrap();
    let said = bench.train(&plan, &["--cycles", "0.25", "--export", "glb,stl"]);
    assert!(said.status.success(), "{}", complaint(&said));
    let record: Value =
        serde_json::from_str(&fs::read_to_string(bench.at("train/train.json")).unwrap()).unwrap();
    assert_eq!(record["axles"], serde_json::json!([[2, 3]]));
    assert_eq!(record["gears"][4]["level"], 10.0);
}

#[test]
fn what_cannot_be_a_train_is_refused_in_a_sentence() {
    let bench = Bench::new();
    let pair = bench.at("pair");
    bench.refuses(&pair, &["--gears", "1"], &["1 gears", "2 to"]);
    bench.refuses(&pair, &["--repeat", "4000"], &["8000 gears"]);
    bench.refuses(&pair, &["--gears", "5", "--layout", "ring"], &["5 gears", "even"]);
    bench.refuses(&pair, &["--repeat", "2", "--layout", "ring"], &["does not close", "degrees"]);
    bench.refuses(&pair, &["--gears", "4", "--layout", "arc", "--bend", "140"], &["collide"]);
    bench.refuses(&bench.at("nothing"), &[], &["nothing", "centrode design"]);
    let plan = bench.at("bad.toml");
    fs::write(&plan, "[pairs.e]\ndesign = \"pair\"\nspeed = 3\n").unwrap();
    bench.refuses(&plan, &[], &["bad.toml", "speed"]);
}
