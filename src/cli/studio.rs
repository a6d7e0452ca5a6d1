//! `centrode studio`: the command, and what the studio takes from the command line.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use anyhow::bail;
use centrode::export::{ExportError, Staging};
use centrode::input::LoadOptions;
use centrode::pipeline::{Design, DesignOptions};
use centrode::pitch::Transmission;
use centrode::solid::assembly_solids;
use clap::{Args, Parser, ValueHint};

use super::args::{Cli, Command, ExportArgs};
use super::{Outcome, design, making, mate, motion, scene};

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

/// Where a pair comes from, the drawings still to be read.
#[derive(Debug)]
pub(crate) enum Origin {
    Two,
    One,
    Motion(Transmission, [String; 2]),
}

/// A command line that makes a pair, understood.
#[derive(Debug)]
pub(crate) struct Plan {
    pub(crate) origin: Origin,
    pub(crate) load: LoadOptions,
    pub(crate) options: DesignOptions,
    command: Command,
}

/// Why a command line is not understood.
#[derive(Debug)]
pub(crate) struct Blamed {
    /// The option to blame, where it is known.
    pub(crate) option: Option<String>,
    pub(crate) text: String,
}

/// Understands the words of a command that makes a pair. No file is opened.
pub(crate) fn plan(words: &[String]) -> Result<Plan, Blamed> {
    let cli = Cli::try_parse_from(words).map_err(|error| blamed(&error))?;
    let failed = |option: &str, error: anyhow::Error| Blamed {
        option: Some(option.to_owned()),
        text: crate::cli::told(&error),
    };
    let (origin, load, options) = match &cli.command {
        Command::Design(args) => {
            let options = design::options(args).map_err(|e| failed("ratio", e))?;
            (Origin::Two, args.shape.options(), options)
        }
        Command::Mate(args) => (Origin::One, args.reading.options(), mate::options(args)),
        Command::Motion(args) => {
            if motion::reads_a_table(args) {
                let text = "tables are read by `centrode motion`; write a formula here".to_owned();
                return Err(Blamed { option: Some("law".to_owned()), text });
            }
            let (transmission, names) = motion::motion(args).map_err(|e| failed("law", e))?;
            (Origin::Motion(transmission, names), LoadOptions::default(), motion::options(args))
        }
        _ => return Err(Blamed { option: None, text: "this command makes no pair".to_owned() }),
    };
    Ok(Plan { origin, load, options, command: cli.command })
}

fn blamed(error: &clap::Error) -> Blamed {
    use clap::error::{ContextKind, ContextValue};
    let named = match error.get(ContextKind::InvalidArg) {
        Some(ContextValue::String(text)) => Some(text.clone()),
        Some(ContextValue::Strings(texts)) => texts.first().cloned(),
        _ => None,
    };
    let option = named.and_then(|text| {
        let word = text.split([' ', '=']).next()?.trim_start_matches('-').to_owned();
        (!word.is_empty() && !word.starts_with('<')).then_some(word)
    });
    let said = super::in_one_line(&error.to_string());
    let text = said.trim_start_matches("error: ").replace(" (--help lists the options)", "");
    // What follows the colon is the reason; the option's own name stands beside it.
    let text = match (&option, text.split_once(": ")) {
        (Some(_), Some((head, reason))) if head.starts_with("invalid value") => reason.to_owned(),
        _ => text,
    };
    Blamed { option, text: super::plain(&text) }
}

impl Plan {
    fn formats(&self) -> anyhow::Result<&ExportArgs> {
        Ok(match &self.command {
            Command::Design(args) => &args.pair.formats,
            Command::Mate(args) => &args.pair.formats,
            Command::Motion(args) => &args.pair.formats,
            _ => bail!("this command makes no pair"),
        })
    }

    /// The files that the command would write of a finished design, in a hidden folder inside `output`.
    pub(crate) fn files(
        &self,
        made: &Design,
        words: &[String],
        output: &Path,
    ) -> anyhow::Result<(Staging, Vec<PathBuf>)> {
        let meshes = assembly_solids(&made.assembly)?;
        let staging = Staging::new(output)?;
        let command = super::report::command_line(words.iter().skip(1).cloned());
        let files = making::write_into(staging.path(), made, &meshes, self.formats()?, command)
            .map_err(|error: ExportError| staging.told_of_the_final_place(error))?;
        Ok((staging, files))
    }
}

/// The words as a person types them, for copying.
pub(crate) fn command_text(words: &[String]) -> String {
    super::report::command_line(words.iter().skip(1).cloned())
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
