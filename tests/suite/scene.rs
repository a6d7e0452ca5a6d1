//! Scenes: the same run as the command line, and clear words for mistakes.

use crate::common::{centrode, complaint, tree};
use std::fs;
use std::path::Path;

/// Options under which a pair takes little time.
const QUICK: [&str; 3] = ["--no-simulate", "--export", "json"];

fn text(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}

#[test]
fn a_saved_scene_makes_the_same_pair_from_another_folder() {
    let top = tempfile::tempdir().unwrap();
    let drawing = top.path().join("my heart.svg");
    fs::write(&drawing, centrode::outline::library::svg("heart").unwrap()).unwrap();
    let (first, second) = (top.path().join("first"), top.path().join("second"));
    let scene = top.path().join("scenes/saved.toml");
    let said = centrode(
        [
            "design",
            &text(&drawing),
            "ellipse",
            "--teeth=30",
            "--max-lean",
            "50",
            "-o",
            &text(&first),
        ]
        .iter()
        .chain(&QUICK)
        .chain(&["--save-scene", &text(&scene)]),
    );
    assert_eq!(said.status.code(), Some(0), "{}", complaint(&said));
    let saved = fs::read_to_string(&scene).unwrap();
    for line in ["teeth = 30", "max-lean = 50", "no-simulate = true", "follower = \"ellipse\""] {
        assert!(saved.contains(line), "`{line}` is missing: {saved}");
    }
    let said = centrode(["run", &text(&scene), "-o", &text(&second)]);
    assert_eq!(said.status.code(), Some(0), "{}", complaint(&said));
    let record = |folder: &Path| fs::read_to_string(folder.join("design.json")).unwrap();
    assert_eq!(record(&first), record(&second));
    let other = top.path().join("other");
    let said = centrode(["run", &text(&scene), "-o", &text(&other), "--", "--teeth", "36"]);
    assert_eq!(said.status.code(), Some(0), "{}", complaint(&said));
    assert!(record(&other).contains("\"teeth\": 36"), "an option after -- takes the scene's place");
}

#[test]
fn mistakes_are_refused_in_one_line_and_nothing_is_written() {
    let top = tempfile::tempdir().unwrap();
    let scene = top.path().join("bad.toml");
    let output = top.path().join("out");
    let pair = "driver = 'heart'\nfollower = 'drop'\n";
    for (scene_text, words) in [
        (format!("{pair}[fit]\nmax-lena = 50"), vec!["\"max-lena\"", "\"max-lean\""]),
        (format!("{pair}[teeths]\nteeth = 50"), vec!["[teeths]", "[teeth]"]),
        (format!("{pair}max-lean = 50"), vec!["\"max-lean\"", "move it to [fit]"]),
        (format!("{pair}[size]\nthickness = '8 miles'"), vec!["--thickness", "8 miles"]),
        (format!("{pair}[teeth]\nteeth = 24.5"), vec!["--teeth", "24.5"]),
        (format!("{pair}ratio = 0"), vec!["ratio"]),
        ("driver = 'heart'".to_owned(), vec!["FOLLOWER"]),
        (
            "driver = 'nothing.svg'\nfollower = 'drop'".to_owned(),
            vec!["nothing.svg", "no such file"],
        ),
        ("command = 'desing'".to_owned(), vec!["\"desing\"", "\"design\""]),
        ("command = 'run'".to_owned(), vec!["\"run\""]),
        ("driver heart".to_owned(), vec!["line 1"]),
    ] {
        fs::write(&scene, &scene_text).unwrap();
        let said = centrode(["run", &text(&scene), "-o", &text(&output)]);
        let complaint = complaint(&said);
        assert_eq!(said.status.code(), Some(2), "{scene_text}: {complaint}");
        assert_eq!(complaint.trim_end().lines().count(), 1, "{complaint}");
        assert!(complaint.starts_with("error: "), "{complaint}");
        for word in words {
            assert!(complaint.contains(word), "{scene_text}: `{word}` is missing: {complaint}");
        }
        assert!(!output.exists(), "{scene_text} made the output folder");
    }
    let said = centrode(["run", &text(&top.path().join("none.toml"))]);
    assert_eq!(said.status.code(), Some(2));
    assert!(complaint(&said).contains("none.toml"));
}

#[test]
fn every_scene_of_the_project_is_understood() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/paper");
    let mut scenes: Vec<_> = tree(&folder);
    scenes.retain(|p| p.extension().is_some_and(|e| e == "toml"));
    assert!(scenes.len() >= 30);
    for scene in scenes {
        // What is impossible is found after everything was read and before anything is made.
        let is_train = fs::read_to_string(&scene).unwrap().contains("command = \"train\"");
        let more = if is_train { ["--load", "0"] } else { ["--pressure-angle", "80"] };
        let scene_and_place = ["run", &text(&scene), "--", more[0], more[1], "-o", "/dev/null/x"];
        let said = centrode(scene_and_place);
        let complaint = complaint(&said);
        let fine = ["pressure angle", "--load", "/dev/null"].iter().any(|w| complaint.contains(w));
        assert!(fine, "{}: {complaint}", scene.display());
    }
}
