//! Arguments, progress and exit codes; everything else is the library's.

mod args;
mod check;
mod design;
mod export;
mod files;
mod gallery;
mod gallery_shapes;
mod making;
mod mate;
mod motion;
mod outfit;
mod progress;
mod proof;
mod report;
mod scene;
mod shapes;
mod shell;
mod simulate;
mod train;
mod units;
mod version;

pub(crate) use args::Cli;
use args::Command;
use clap::error::ErrorKind;
use std::ffi::OsString;
use std::process::ExitCode;

/// Exit code for bad input; nothing was written.
pub(crate) const BAD_INPUT: u8 = 2;
/// Exit code for a result that was made but is not sound.
const NOT_SOUND: u8 = 1;

/// How a command ended that could be carried out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// All is well.
    Good,
    /// Something was made that must not be trusted.
    NotSound,
}

impl Outcome {
    pub(crate) fn exit_code(self) -> ExitCode {
        match self {
            Self::Good => ExitCode::SUCCESS,
            Self::NotSound => ExitCode::from(NOT_SOUND),
        }
    }
}

/// Carries out the command line of this process.
pub(crate) fn run(cli: &Cli) -> anyhow::Result<Outcome> {
    if cli.quiet {
        progress::silence();
    }
    if let Some(count) = cli.threads {
        rayon::ThreadPoolBuilder::new().num_threads(usize::from(count)).build_global()?;
    }
    let words: Vec<OsString> = std::env::args_os().collect();
    carry_out(cli, &words)
}

/// Carries out a command line; `words` is what was parsed into `cli`.
fn carry_out(cli: &Cli, words: &[OsString]) -> anyhow::Result<Outcome> {
    let outcome = match &cli.command {
        Command::Design(args) => design::run(args),
        Command::Motion(args) => motion::run(args),
        Command::Mate(args) => mate::run(args),
        Command::Check(args) => check::run(args),
        Command::Simulate(args) => simulate::run(args),
        Command::Export(args) => export::run(args),
        Command::Train(args) => train::run(args),
        Command::Shapes(args) => shapes::run(args),
        Command::Gallery(args) => gallery::run(args, words),
        Command::Run(args) => scene::run(args),
        Command::Completions(args) => shell::completions(args),
        Command::Man(args) => shell::man(args),
    }?;
    if let Some(path) = &cli.save_scene {
        scene::save(path, words)?;
    }
    Ok(outcome)
}

/// Prints what clap has to say; help and version are no errors, errors take one line.
pub(crate) fn refused(error: &clap::Error) -> ExitCode {
    if !error.use_stderr() || error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        // A closed pipe is no reason to fail harder.
        let _ = error.print();
    } else {
        eprintln!("{}", in_one_line(&error.to_string()).replace(char::is_control, " "));
    }
    if error.use_stderr() { ExitCode::from(BAD_INPUT) } else { ExitCode::SUCCESS }
}

/// What clap says on several lines, without the usage, on one.
fn in_one_line(said: &str) -> String {
    let relevant = said.lines().take_while(|line| !line.starts_with("Usage:"));
    let parts: Vec<&str> = relevant
        .map(str::trim)
        .filter(|line| !line.is_empty() && !line.starts_with("For more information"))
        .collect();
    format!("{} (--help lists the options)", parts.join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn usage_errors_fit_one_line() {
        let said = "error: required:\n  <DRIVER>\n\nUsage: centrode\n\nFor more information, try\n";
        assert_eq!(in_one_line(said), "error: required: <DRIVER> (--help lists the options)");
    }
}
