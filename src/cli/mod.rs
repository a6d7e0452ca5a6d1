//! Arguments, progress and exit codes; everything else is the library's.

mod args;
mod design;
mod progress;
mod report;
mod shapes;
mod units;

pub(crate) use args::Cli;
use args::Command;
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

/// Carries out the command line.
pub(crate) fn run(cli: Cli) -> anyhow::Result<Outcome> {
    match cli.command {
        Command::Design(args) => design::run(&args),
        Command::Shapes(args) => shapes::run(&args),
    }
}

/// Prints what clap has to say; help and version are no errors.
pub(crate) fn refused(error: &clap::Error) -> ExitCode {
    // A closed pipe is no reason to fail harder.
    let _ = error.print();
    if error.use_stderr() { ExitCode::from(BAD_INPUT) } else { ExitCode::SUCCESS }
}
