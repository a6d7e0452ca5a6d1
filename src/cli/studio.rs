//! `centrode studio`: the command, and what the studio takes from the command line.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::{Args, ValueHint};

use super::{Outcome, scene};

pub(crate) use super::train::files as train_files;

/// Options of `centrode studio`.
#[derive(Debug, Args)]
pub(crate) struct StudioArgs {
    /// Drawings to begin with, one or two: files or built-in names
    #[arg(value_name = "FILE", num_args = 0..=2, value_hint = ValueHint::FilePath)]
    pub(crate) files: Vec<String>,
    /// Port of the page on this machine [default: 4827, or the next free one]
    #[arg(long, value_name = "N")]
    pub(crate) port: Option<u16>,
    /// Print the address only; do not open a browser
    #[arg(long)]
    pub(crate) no_open: bool,
    /// Folder that the page may write finished files to [default: out, made when the first are written]
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
}

pub(crate) fn run(args: &StudioArgs) -> anyhow::Result<Outcome> {
    crate::studio::run(args)?;
    Ok(Outcome::Good)
}

/// The scene that makes the same pair.
pub(crate) fn scene_text(words: &[String]) -> anyhow::Result<String> {
    let words: Vec<OsString> = words.iter().map(OsString::from).collect();
    scene::text(&words, Path::new(""))
}

/// A scene's command, drawings or motion, and options with their values; a flag has the value `true`.
pub(crate) type Opened = (String, Vec<String>, Vec<(String, String)>);

/// Reads a scene. No file is opened.
pub(crate) fn opened(text: &str) -> anyhow::Result<Opened> {
    let (command, places, settings) = scene::parts(text)?;
    let option = |s: centrode::scene::Setting| {
        let value = if s.values.is_empty() { "true".to_owned() } else { s.values.join(",") };
        (s.key, value)
    };
    Ok((command, places, settings.into_iter().map(option).collect()))
}
