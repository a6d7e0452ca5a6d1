//! The `centrode` command: parse, run, report one error in one place.

mod cli;

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
            // One line that steers no terminal, whatever a file name or a library's message contains.
            eprintln!("error: {}", format!("{error:#}").replace(char::is_control, " "));
            ExitCode::from(cli::BAD_INPUT)
        }
    }
}
