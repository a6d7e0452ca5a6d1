//! The `centrode` command: parse, run, report one error in one place.

mod cli;
#[cfg(feature = "studio")]
mod studio;

use std::process::ExitCode;

use clap::Parser;
use cli::Cli;

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return cli::refused(&error),
    };
    match cli::run(&cli) {
        Ok(outcome) => outcome.exit_code(),
        Err(error) => {
            eprintln!("error: {}", cli::plain(&told(&error)));
            ExitCode::from(cli::BAD_INPUT)
        }
    }
}

/// What failed and why, from the outermost to the innermost cause; a cause that has been quoted is not said again.
pub(crate) fn told(error: &anyhow::Error) -> String {
    error.chain().map(ToString::to_string).fold(String::new(), |said, cause| {
        if said.is_empty() {
            cause
        } else if said.contains(&cause) {
            said
        } else {
            format!("{said}: {cause}")
        }
    })
}
