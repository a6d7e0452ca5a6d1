//! What goes wrong around a run: it is killed, its folder goes, another run writes beside it, the surroundings are odd.
//! Files that stood there stay whole, and whatever is said is a sentence.

use crate::common::{complaint, tree};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

/// A design that writes a few files in little time.
fn quick(shapes: [&str; 2], output: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_centrode"));
    command.arg("design").args(shapes).args(["--search", "paper", "--no-simulate", "--force"]);
    command.args(["--export", "json,stl,step", "-o"]).arg(output);
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Every file below a folder with its bytes.
fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let name = |p: &PathBuf| p.strip_prefix(folder).unwrap().to_owned();
    let files = tree(folder).into_iter().filter(|p| p.is_file());
    files.map(|p| (name(&p), fs::read(&p).unwrap())).collect()
}

fn is_hidden(path: &Path) -> bool {
    path.components().any(|c| c.as_os_str().to_string_lossy().starts_with('.'))
}

#[test]
fn a_killed_run_leaves_old_files_whole() {
    let top = tempfile::tempdir().unwrap();
    let place = top.path().join("out");
    assert!(quick(["heart", "dove"], &place).status().unwrap().success());
    let old = contents(&place);
    let fresh = top.path().join("fresh");
    assert!(quick(["drop", "leaf"], &fresh).status().unwrap().success());
    let new = contents(&fresh);
    assert_eq!(old.keys().collect::<Vec<_>>(), new.keys().collect::<Vec<_>>());
    for delay in [20, 100, 200, 300, 400, 500, 600, 800] {
        let mut running = quick(["drop", "leaf"], &place).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(delay));
        running.kill().unwrap();
        running.wait().unwrap();
        let now = contents(&place);
        for (name, bytes) in &old {
            let whole = now[name] == *bytes || now[name] == new[name];
            assert!(whole, "{} is in pieces after {delay} ms", name.display());
        }
    }
    // The next run takes away what killed ones left.
    assert!(quick(["drop", "leaf"], &place).status().unwrap().success());
    assert_eq!(contents(&place), new);
    assert!(!tree(&place).iter().any(|p| is_hidden(p.strip_prefix(&place).unwrap())));
}

#[test]
fn two_runs_may_write_into_one_folder() {
    let top = tempfile::tempdir().unwrap();
    let place = top.path().join("out");
    let running = [0, 1].map(|_| quick(["heart", "dove"], &place).spawn().unwrap());
    for run in running {
        let said = run.wait_with_output().unwrap();
        assert_eq!(said.status.code(), Some(0), "{}", complaint(&said));
    }
    let alone = top.path().join("alone");
    assert!(quick(["heart", "dove"], &alone).status().unwrap().success());
    assert_eq!(contents(&place), contents(&alone));
}

#[test]
fn a_folder_that_vanishes_midway() {
    let top = tempfile::tempdir().unwrap();
    let place = top.path().join("out");
    for delay in [100, 300, 500] {
        fs::create_dir_all(&place).unwrap();
        let running = quick(["heart", "dove"], &place).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(delay));
        let _ = fs::remove_dir_all(&place);
        let said = running.wait_with_output().unwrap();
        let text = complaint(&said);
        assert!(!text.contains("panicked"), "{text}");
        match said.status.code() {
            Some(0) => assert!(
                serde_json::from_slice::<Value>(
                    &fs::read(place.join("design.json")).unwrap_or_else(|_| b"{}".to_vec())
                )
                .is_ok()
            ),
            Some(2) => assert_eq!(text.trim_end().lines().count(), 1, "{text}"),
            other => panic!("{other:?}: {text}"),
        }
        let _ = fs::remove_dir_all(&place);
    }
}

#[test]
fn surroundings_change_nothing() {
    let top = tempfile::tempdir().unwrap();
    let [plain, odd] = ["plain", "odd"].map(|n| top.path().join(n));
    assert!(quick(["heart", "dove"], &plain).status().unwrap().success());
    let said = quick(["heart", "dove"], &odd)
        .env_clear()
        .envs([
            ("LC_ALL", "de_DE.UTF-8"),
            ("LANG", "tr_TR"),
            ("TZ", "Nowhere/Land"),
            ("TMPDIR", "/nowhere/at/all"),
            ("SOURCE_DATE_EPOCH", "-5"),
            ("COLUMNS", "0"),
            ("RAYON_NUM_THREADS", "1"),
        ])
        .output()
        .unwrap();
    assert_eq!(said.status.code(), Some(0), "{}", complaint(&said));
    assert_eq!(contents(&plain), contents(&odd));
}
