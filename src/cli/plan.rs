//! The command line as a function: the words of a command become what the library takes. The studio and the Python package
//! ask through it, so that every option has one meaning and one default. Nothing here opens a file but [`Plan::files`].

use std::path::{Path, PathBuf};

use centrode::check::{CheckOptions, CheckReport};
use centrode::control::Control;
use centrode::export::{ExportError, Staging, Wanted};
use centrode::input::{LoadOptions, Shape};
use centrode::meshing::MeshingReport;
use centrode::pipeline::{Design, DesignOptions, Request};
use centrode::pitch::Transmission;
use centrode::schema::SavedDesign;
use centrode::solid::assembly_solids;
use clap::{CommandFactory, Parser};
use serde::Serialize;

use super::args::{Cli, Command, ExportArgs};
use super::mirror::mirrored;
use super::{check, design, making, mate, motion, report, simulate};

/// Where a pair comes from, the drawings still to be read.
#[derive(Debug)]
pub enum Origin {
    /// Two drawings.
    Two,
    /// One drawing.
    One,
    /// A motion, and what the gears are called.
    Motion(Transmission, [String; 2]),
}

/// A command line that makes a pair, understood.
#[derive(Debug)]
pub struct Plan {
    /// Where the pair comes from.
    pub origin: Origin,
    /// How drawings are read.
    pub load: LoadOptions,
    /// What is asked of the pair; [`Plan::request`] turns shapes over besides.
    pub options: DesignOptions,
    command: Command,
}

/// Why a command line is not understood.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.told())]
pub struct Blamed {
    /// The option to blame, without dashes, where it is known.
    pub option: Option<String>,
    /// What is wrong, and what to do.
    pub text: String,
}

impl Blamed {
    fn told(&self) -> String {
        match &self.option {
            Some(option) => format!("{option}: {}", self.text),
            None => self.text.clone(),
        }
    }

    fn of(option: &str, error: &anyhow::Error) -> Self {
        Self { option: Some(option.to_owned()), text: super::told(error) }
    }

    fn without_option(text: impl Into<String>) -> Self {
        Self { option: None, text: text.into() }
    }
}

/// Understands the words of a command that makes a pair, the program's name first.
///
/// # Errors
/// [`Blamed`]: an option that there is not, or a value out of its range.
///
/// ```
/// let words = ["centrode", "design", "heart", "dove", "--teeth=24", "--output=out"];
/// let plan = centrode::cli::plan::plan(&words.map(str::to_owned))?;
/// assert_eq!(plan.options.teeth, centrode::pipeline::ToothCount::Teeth(24));
/// # Ok::<(), centrode::cli::plan::Blamed>(())
/// ```
pub fn plan(words: &[String]) -> Result<Plan, Blamed> {
    let cli = parsed(words)?;
    let (origin, load, options) = match &cli.command {
        Command::Design(args) => {
            let options = design::options(args).map_err(|e| Blamed::of("ratio", &e))?;
            (Origin::Two, args.shape.options(), options)
        }
        Command::Mate(args) => (Origin::One, args.reading.options(), mate::options(args)),
        Command::Motion(args) => {
            if motion::reads_a_table(args) {
                let text = "tables are read by `centrode motion`; write a formula here".to_owned();
                return Err(Blamed { option: Some("law".to_owned()), text });
            }
            let (transmission, names) = motion::motion(args).map_err(|e| Blamed::of("law", &e))?;
            (Origin::Motion(transmission, names), LoadOptions::default(), motion::options(args))
        }
        _ => return Err(Blamed::without_option("this command makes no pair")),
    };
    Ok(Plan { origin, load, options, command: cli.command })
}

/// A command line that judges two gears, understood.
#[derive(Debug)]
pub struct CheckPlan {
    /// Files of driver and follower.
    pub gears: [String; 2],
    /// Widest gap between ends of lines that is joined, mm.
    pub join: Option<f64>,
    /// How the pair is checked, under a control that nobody holds.
    pub options: CheckOptions,
}

/// Understands the words of `centrode check` for one pair. The files of `--motion` and `--limits` are read.
///
/// # Errors
/// As [`plan`].
pub fn check_plan(words: &[String]) -> Result<CheckPlan, Blamed> {
    let Command::Check(args) = parsed(words)?.command else {
        return Err(Blamed::without_option("this command judges no gears"));
    };
    let (gears, options) =
        check::plan(&args, Control::new()).map_err(|e| Blamed::without_option(super::told(&e)))?;
    Ok(CheckPlan { gears, join: args.join, options })
}

/// What `centrode check --json` prints of a report.
///
/// # Errors
/// [`Blamed`] where a figure cannot be written, which is a bug.
pub fn check_record(report: &CheckReport) -> Result<String, Blamed> {
    check::record(report).map_err(|e| Blamed::without_option(super::told(&e)))
}

/// Runs a saved design as the words of `centrode simulate` say.
///
/// # Errors
/// As [`plan`], where the pair swings, and after a cancel.
pub fn simulated(
    words: &[String],
    saved: &SavedDesign,
    control: &Control,
) -> Result<MeshingReport, Blamed> {
    let Command::Simulate(args) = parsed(words)?.command else {
        return Err(Blamed::without_option("this command runs no gears"));
    };
    simulate::report(&args, saved, control).map_err(|e| Blamed::without_option(super::told(&e)))
}

/// Understands the words of `centrode export`: the formats, and how they are written.
///
/// # Errors
/// As [`plan`].
pub fn wanted(words: &[String]) -> Result<Wanted, Blamed> {
    let Command::Export(args) = parsed(words)?.command else {
        return Err(Blamed::without_option("this command exports nothing"));
    };
    Ok(args.formats.wanted())
}

/// An option of a command.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct OptionFacts {
    /// Its name without dashes.
    pub name: String,
    /// Whether it takes a value; else it is a flag.
    pub takes_value: bool,
    /// Its default as it would be written; none for a flag, and where it is chosen.
    pub default: Option<String>,
    /// The values there are, where they are few.
    pub choices: Vec<String>,
    /// One sentence about it.
    pub help: String,
}

/// The options of a command such as `design`.
///
/// # Errors
/// [`Blamed`] where there is no such command.
pub fn options_of(command: &str) -> Result<Vec<OptionFacts>, Blamed> {
    let mut cli = Cli::command();
    // Options that every command takes are handed down.
    cli.build();
    let found = cli
        .find_subcommand(command)
        .ok_or_else(|| Blamed::without_option(format!("there is no command {command:?}")))?;
    let facts = |arg: &clap::Arg| {
        let takes_value = arg.get_action().takes_values();
        let choices = if takes_value { arg.get_possible_values() } else { Vec::new() };
        Some(OptionFacts {
            name: arg.get_long()?.to_owned(),
            takes_value,
            default: arg
                .get_default_values()
                .first()
                .filter(|_| takes_value)
                .map(|v| v.to_string_lossy().into_owned()),
            choices: choices.iter().map(|v| v.get_name().to_owned()).collect(),
            help: arg.get_help().map(ToString::to_string).unwrap_or_default(),
        })
    };
    Ok(found.get_arguments().filter_map(facts).collect())
}

fn parsed(words: &[String]) -> Result<Cli, Blamed> {
    Cli::try_parse_from(words).map_err(|error| blamed(&error))
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
    /// All that is asked, of the drawings that [`Plan::origin`] wants; those that `--mirror` names are turned over.
    ///
    /// # Errors
    /// [`Blamed`] where drawings are missing, where a mirrored shape does not fit, and after a cancel.
    pub fn request(&self, shapes: Vec<Shape>, control: &Control) -> Result<Request, Blamed> {
        let mut options = self.options.clone();
        let mut shapes = shapes.into_iter();
        let mut next =
            || shapes.next().ok_or_else(|| Blamed::without_option("a drawing is missing"));
        let request = match &self.origin {
            Origin::Two => {
                let given = [next()?, next()?];
                let Command::Design(args) = &self.command else {
                    return Err(Blamed::without_option("this command takes no two drawings"));
                };
                let turned = mirrored(given, args.fit.mirror, &mut options, control);
                let [driver, follower] = turned.map_err(|e| Blamed::of("mirror", &e))?;
                Request::two_shapes(driver, follower)
            }
            Origin::One => Request::one_shape(next()?),
            Origin::Motion(transmission, names) => {
                Request::motion(transmission.clone(), names.clone())
            }
        };
        Ok(request.with(options))
    }

    /// What makes the command end without a pair, if anything does: it lists alternatives.
    #[must_use]
    pub fn lists_alternatives(&self) -> bool {
        matches!(&self.command, Command::Design(args) if args.fit.alternatives.is_some())
    }

    /// The formats that the command would write.
    #[must_use]
    pub fn wanted(&self) -> Wanted {
        self.formats().map(ExportArgs::wanted).unwrap_or_default()
    }

    fn formats(&self) -> Option<&ExportArgs> {
        match &self.command {
            Command::Design(args) => Some(&args.pair.formats),
            Command::Mate(args) => Some(&args.pair.formats),
            Command::Motion(args) => Some(&args.pair.formats),
            _ => None,
        }
    }

    /// The files that the command would write of a finished design, in a hidden folder inside `output`; `words` is what was
    /// planned.
    ///
    /// # Errors
    /// [`Blamed`]: a part that makes no sound solid, or a folder that takes no files.
    pub fn files(
        &self,
        made: &Design,
        words: &[String],
        output: &Path,
    ) -> Result<(Staging, Vec<PathBuf>), Blamed> {
        let told = |error: anyhow::Error| Blamed::without_option(super::told(&error));
        let formats = self.formats().ok_or_else(|| Blamed::without_option("no pair is made"))?;
        let meshes = assembly_solids(&made.assembly).map_err(|e| told(e.into()))?;
        let staging = Staging::new(output).map_err(|e| told(e.into()))?;
        let command = command_text(words);
        let files = making::write_into(staging.path(), made, &meshes, formats, command)
            .map_err(|error: ExportError| told(staging.told_of_the_final_place(error).into()))?;
        Ok((staging, files))
    }
}

/// The words as a person types them, for copying; without the folder.
#[must_use]
pub fn command_text(words: &[String]) -> String {
    report::command_line(words.iter().skip(1).cloned())
}

/// The page `report.html` of a finished design; `words` is the command that makes it.
#[must_use]
pub fn page(made: &Design, words: &[String]) -> String {
    centrode::report::report_html(
        &made.assembly,
        &centrode::results::design_page(made, command_text(words)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &str) -> Vec<String> {
        line.split(' ').map(str::to_owned).collect()
    }

    #[test]
    fn an_option_to_blame_is_named_with_the_reason() {
        let blamed = plan(&words("centrode design heart dove -o out --teeth=many")).unwrap_err();
        assert_eq!(blamed.option.as_deref(), Some("teeth"));
        let blamed = plan(&words("centrode design heart dove -o out --tooth=3")).unwrap_err();
        assert_eq!(blamed.option.as_deref(), Some("tooth"));
        assert!(plan(&words("centrode shapes")).is_err());
        assert!(check_plan(&words("centrode shapes")).is_err());
    }

    #[test]
    fn every_command_of_the_package_tells_its_options_and_defaults() {
        let design = options_of("design").unwrap();
        let named = |name: &str| design.iter().find(|o| o.name == name).unwrap();
        assert_eq!(named("center-distance").default.as_deref(), Some("80mm"));
        assert_eq!(named("teeth-style").choices, ["involute", "wave", "regular-wave"]);
        assert!(!named("no-simulate").takes_value && named("threads").takes_value);
        for command in ["mate", "motion", "check", "simulate", "export", "train", "gallery"] {
            assert!(options_of(command).unwrap().len() > 4, "{command}");
        }
        assert!(options_of("desing").is_err());
    }
}
