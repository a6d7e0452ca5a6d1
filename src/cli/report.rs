//! What is printed of a design, and the command line as the page shows it.

use std::ffi::OsString;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Duration;

use centrode::pipeline::Design;
use centrode::results::{design_figures, design_lines};
use serde_json::json;

/// Prints the summary: JSON on standard output, or a few lines for a person.
pub(crate) fn summary(
    made: &Design,
    files: &[PathBuf],
    folder: &Path,
    elapsed: Duration,
    as_json: bool,
) -> anyhow::Result<()> {
    let mut out = std::io::stdout().lock();
    if as_json {
        let mut value = design_figures(made);
        value["folder"] = json!(folder);
        value["files"] = json!(files);
        value["seconds"] = json!(elapsed.as_secs_f64());
        writeln!(out, "{value}")?;
        return Ok(());
    }
    if super::progress::is_silent() {
        return Ok(());
    }
    for line in design_lines(made) {
        writeln!(out, "{line}")?;
    }
    let (count, seconds) = (files.len(), elapsed.as_secs_f64());
    writeln!(out, "{count} files in {} after {seconds:.1} s", folder.display())?;
    if let Some(page) = files.iter().find(|f| f.ends_with("report.html")) {
        writeln!(out, "open {}", page.display())?;
    }
    Ok(())
}

/// As [`command_line`], of the words of a command line with the program's own first.
pub(super) fn shown(words: &[OsString]) -> String {
    command_line(words.iter().skip(1).map(|w| w.to_string_lossy().into_owned()))
}

/// The command that makes this again, without the paths of the program and of the folder, which are not
/// part of the design.
pub(super) fn command_line(mut given: impl Iterator<Item = String>) -> String {
    let quoted = |word: String| {
        if word.chars().all(|c| c.is_ascii_alphanumeric() || "-_./:=".contains(c)) {
            word
        } else {
            format!("'{}'", word.replace('\'', "'\\''"))
        }
    };
    let mut words = Vec::new();
    while let Some(word) = given.next() {
        match word.as_str() {
            "-o" | "--output" | "--save-scene" => _ = given.next(),
            w if w.starts_with("-o") || w.starts_with("--output=") => {}
            w if w.starts_with("--save-scene=") => {}
            _ => words.push(quoted(word)),
        }
    }
    format!("centrode {} -o out", words.join(" "))
}
