//! `centrode gallery`: every pair in a row, resumed, sharded and joined.

use crate::common::{centrode, complaint, tree};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

struct Bench {
    top: tempfile::TempDir,
}

impl Bench {
    fn new() -> Self {
        Self { top: tempfile::tempdir().unwrap() }
    }

    fn at(&self, name: &str) -> PathBuf {
        self.top.path().join(name)
    }

    /// Runs the gallery into the folder `name`.
    fn run(&self, name: &str, words: &[&str]) -> Output {
        let place = self.at(name).to_string_lossy().into_owned();
        centrode(["gallery"].iter().chain(words).chain(&["-o", &place]))
    }

    fn made(&self, name: &str, words: &[&str]) -> String {
        let said = self.run(name, words);
        assert_eq!(said.status.code(), Some(0), "{words:?}: {}", complaint(&said));
        self.csv(name)
    }

    fn csv(&self, name: &str) -> String {
        fs::read_to_string(self.at(name).join("gallery.csv")).unwrap()
    }

    fn folder_of(&self, name: &str, drawings: &[(&str, &str)]) -> String {
        let folder = self.at(name);
        fs::create_dir(&folder).unwrap();
        for (file, content) in drawings {
            fs::write(folder.join(file), content).unwrap();
        }
        folder.to_string_lossy().into_owned()
    }
}

fn column(csv: &str, name: &str) -> Vec<String> {
    let mut lines = csv.lines();
    let at = lines.next().unwrap().split(',').position(|n| n == name).unwrap();
    lines.map(|l| l.split(',').nth(at).unwrap().to_owned()).collect()
}

fn shape(name: &str) -> &'static str {
    centrode::outline::library::svg(name).unwrap()
}

#[test]
fn parts_join_to_the_same_rows() {
    let bench = Bench::new();
    let words = ["heart", "drop", "ellipse", "-k", "1,1/2", "--no-teeth"];
    let whole = bench.made("whole", &words);
    assert_eq!(whole.lines().count(), 13, "three shapes make six pairs, each at two ratios");
    let e: Vec<f64> = column(&whole, "E").iter().map(|v| v.parse().unwrap()).collect();
    assert!(e.windows(2).all(|w| w[0] <= w[1]), "sorted by E: {e:?}");
    for part in ["1/3", "2/3", "3/3"] {
        let name = part.replace('/', "of");
        bench.made(&name, &words.iter().copied().chain(["--shard", part]).collect::<Vec<_>>());
    }
    let parts = ["1of3", "2of3", "3of3"].map(|n| bench.at(n).to_string_lossy().into_owned());
    let joined = bench.run("joined", &["merge", &parts[2], &parts[0], &parts[1]]);
    assert_eq!(joined.status.code(), Some(0), "{}", complaint(&joined));
    for file in ["gallery.csv", "gallery.json", "index.html"] {
        let read = |name: &str| fs::read(bench.at(name).join(file)).unwrap();
        assert_eq!(read("whole"), read("joined"), "{file}");
    }
    let names = |name: &str| {
        let below = |p: &PathBuf| p.strip_prefix(bench.at(name)).unwrap().to_owned();
        tree(&bench.at(name)).iter().map(below).collect::<Vec<_>>()
    };
    assert_eq!(names("whole"), names("joined"));
}

#[test]
fn a_stopped_run_goes_on_and_complete_pairs_stay() {
    let bench = Bench::new();
    let words = ["ellipse", "egg", "--teeth", "20"];
    let first = bench.made("g", &words);
    assert_eq!(column(&first, "lost_poses"), ["0"; 3]);
    let pair = |name: &str| bench.at("g").join(name);
    let stamp = |p: &Path| fs::metadata(p.join("row.json")).unwrap().modified().unwrap();
    let kept = stamp(&pair("ellipse+egg-k1"));
    // As a killed run leaves it: no row yet, and a file half written.
    let stopped = pair("egg+egg-k1");
    fs::remove_file(stopped.join("row.json")).unwrap();
    fs::write(stopped.join(".design.json.77.part"), "{").unwrap();
    // And a row that is no row.
    fs::write(pair("ellipse+ellipse-k1").join("row.json"), "{\"folder\":").unwrap();
    assert_eq!(bench.made("g", &words), first);
    assert_eq!(stamp(&pair("ellipse+egg-k1")), kept, "a complete pair was made again");
    assert!(tree(&bench.at("g")).iter().all(|p| p.extension().is_none_or(|e| e != "part")));
    // Other options make other pairs.
    bench.made("g", &["ellipse", "egg", "--teeth", "22"]);
    assert_ne!(stamp(&pair("ellipse+egg-k1")), kept);
}

#[test]
fn a_bad_drawing_is_told_and_the_others_are_made() {
    let bench = Bench::new();
    let folder = bench.folder_of(
        "drawings",
        &[("a.svg", shape("ellipse")), ("b.svg", "<svg"), ("c.csv", "1,2\n"), ("note.md", "no")],
    );
    let said = bench.run("g", &[&folder, "--no-teeth"]);
    let text = complaint(&said);
    assert_eq!(said.status.code(), Some(1), "{text}");
    assert!(
        text.contains("b.svg") && text.contains("c.csv") && !text.contains("note.md"),
        "{text}"
    );
    assert_eq!(column(&bench.csv("g"), "driver"), ["a"]);
}

#[test]
fn a_pair_that_cannot_be_made_is_a_row() {
    let bench = Bench::new();
    // Five teeth a period and a clearance that leaves nothing of them.
    let csv = bench.made("g", &["ellipse", "egg", "--clearance", "30mm", "--teeth", "12"]);
    assert_eq!(column(&csv, "verdict"), ["refused"; 3]);
    assert!(csv.contains("clearance"), "{csv}");
}

#[test]
fn a_list_names_pairs_and_their_ratios() {
    let bench = Bench::new();
    let folder = bench.folder_of(
        "lists",
        &[("own.svg", shape("egg")), ("pairs.txt", "# two\nown.svg ellipse 2\nellipse, own.svg\n")],
    );
    let list = format!("{folder}/pairs.txt");
    let csv = bench.made("g", &["--pairs", &list, "-k", "1/2", "--no-teeth"]);
    let mut said: Vec<_> = column(&csv, "folder");
    said.sort();
    assert_eq!(said, ["ellipse+own-k1over2", "own+ellipse-k2"]);
}

#[test]
fn quotes_hold_names_with_blanks_and_hidden_files_are_left_alone() {
    let bench = Bench::new();
    let folder = bench.folder_of(
        "lists",
        &[("own shape.svg", shape("egg")), ("pairs.txt", "\"own shape.svg\" ellipse 2\n")],
    );
    let csv = bench.made("g", &["--pairs", &format!("{folder}/pairs.txt"), "--no-teeth"]);
    assert_eq!(column(&csv, "folder"), ["own_shape+ellipse-k2"]);
    let folder =
        bench.folder_of("drawings", &[("a.svg", shape("ellipse")), (".hidden.svg", "<svg")]);
    assert_eq!(column(&bench.made("h", &[&folder, "--no-teeth"]), "driver"), ["a"]);
}

#[test]
fn a_threshold_without_an_image_is_remarked_unless_all_is_quiet() {
    let bench = Bench::new();
    let words = ["ellipse", "--no-teeth", "--threshold", "100"];
    let said = bench.run("g", &words);
    assert_eq!(said.status.code(), Some(0), "{}", complaint(&said));
    let lines = complaint(&said);
    assert!(lines.starts_with("warning: --threshold changes nothing"), "{lines}");
    let said = bench.run("g", &[&words[..], &["--quiet"]].concat());
    assert_eq!((said.status.code(), complaint(&said)), (Some(0), String::new()));
}

#[test]
fn the_manual_has_a_page_for_every_step() {
    let bench = Bench::new();
    let place = bench.at("man").to_string_lossy().into_owned();
    let said = centrode(["man", "-o", &place, "--quiet"]);
    assert_eq!(said.status.code(), Some(0), "{}", complaint(&said));
    assert!(said.stdout.is_empty());
    for name in ["centrode.1", "centrode-gallery.1", "centrode-gallery-merge.1"] {
        assert!(bench.at("man").join(name).is_file(), "{name}");
    }
    assert!(!bench.at("man").join("centrode-gallery-help.1").exists());
}

#[test]
fn nonsense_is_refused_and_nothing_is_written() {
    let bench = Bench::new();
    let empty = bench.folder_of("empty", &[]);
    let bad = bench.folder_of("bad", &[("x.svg", "<svg"), ("pairs.txt", "heart\n")]);
    let list = format!("{bad}/pairs.txt");
    for (words, expected) in [
        (vec![empty.as_str()], "no drawing"),
        (vec![bad.as_str()], "no pair"),
        (vec![], "no shapes"),
        (vec!["heart", "-k", "1,0"], "\"0\""),
        (vec!["heart", "-k", "1.5"], "\"1.5\""),
        (vec!["heart", "--shard", "3/2"], "3/2"),
        (vec!["heart", "--teeth", "many"], "many"),
        (vec!["--pairs", list.as_str()], "line 1"),
        (vec!["merge", empty.as_str()], "no pair here"),
    ] {
        let said = bench.run("out", &words);
        let text = complaint(&said);
        assert_eq!(said.status.code(), Some(2), "{words:?}: {text}");
        assert!(text.contains(expected), "{words:?}: {text}");
        assert!(!bench.at("out").exists(), "{words:?}");
    }
}
