//! The command line: arguments, progress and exit codes; everything else is in the rooms above.
//!
//! [`main`] is the whole program: parse, run, report one error in one place.

mod args;
mod check;
mod design;
mod export;
mod files;
mod gallery;
mod gallery_shapes;
mod making;
mod mate;
mod mirror;
mod motion;
mod outfit;
pub mod plan;
mod presets;
mod progress;
mod proof;
mod report;
mod scene;
mod shapes;
mod shell;
mod simulate;
#[cfg(feature = "studio")]
pub(crate) mod studio;
mod train;
mod units;
mod version;

pub(crate) use args::Cli;
use args::Command;
use centrode::control::Control;
use centrode::policy;
use clap::Parser;
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
    pub(crate) fn exit_code(self) -> u8 {
        match self {
            Self::Good => 0,
            Self::NotSound => NOT_SOUND,
        }
    }
}

/// Carries out the command line of this process; see [`main_of`].
#[must_use]
pub fn main() -> ExitCode {
    ExitCode::from(main_of(std::env::args_os().collect()))
}

/// Parses a command line, the program's name first, carries it out, and reports what failed in one line on standard error.
/// A process calls it once: whether it is quiet and the command it writes into its pages are its own.
///
/// Returns 0 when all is well, 1 for a result that was made but is not sound, 2 for bad input.
#[must_use]
pub fn main_of(words: Vec<OsString>) -> u8 {
    let words = words.as_slice();
    if presets::asked(words.iter().cloned()) {
        presets::print();
        return 0;
    }
    let cli = match Cli::try_parse_from(words) {
        Ok(cli) => cli,
        Err(error) => return refused(&error),
    };
    match run(&cli, words) {
        Ok(outcome) => outcome.exit_code(),
        Err(error) => {
            eprintln!("error: {}", plain(&told(&error)));
            BAD_INPUT
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

/// Carries out a command line that was parsed.
fn run(cli: &Cli, words: &[OsString]) -> anyhow::Result<Outcome> {
    if cli.quiet {
        progress::silence();
    }
    let mut control = Control::new();
    if let Some(count) = cli.threads {
        control = control.with_threads(usize::from(count))?;
    }
    control.run(|| carry_out(cli, words))
}

/// Carries out a command line; `words` is what was parsed into `cli`.
fn carry_out(cli: &Cli, words: &[OsString]) -> anyhow::Result<Outcome> {
    if let Some(path) = &cli.save_scene {
        scene::check_save(path, words)?;
    }
    let outcome = match &cli.command {
        Command::Design(args) => design::run(args, words),
        Command::Motion(args) => motion::run(args, words),
        Command::Mate(args) => mate::run(args, words),
        Command::Check(args) => check::run(args),
        Command::Simulate(args) => simulate::run(args),
        Command::Export(args) => export::run(args),
        #[cfg(feature = "studio")]
        Command::Studio(args) => studio::run(args),
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
pub(crate) fn refused(error: &clap::Error) -> u8 {
    if !error.use_stderr() || error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        // A closed pipe is no reason to fail harder.
        let _ = error.print();
    } else {
        eprintln!("{}", plain(&in_one_line(&error.to_string())));
    }
    if error.use_stderr() { BAD_INPUT } else { 0 }
}

/// One line that steers no terminal and echoes nothing at length, whatever a file name, an option or a library's message
/// contains.
pub(crate) fn plain(said: &str) -> String {
    let line = said.replace(char::is_control, " ");
    let words: Vec<String> = line.split(' ').map(|word| short_word(&short_numbers(word))).collect();
    let line = words.join(" ");
    let count = line.chars().count();
    if count <= policy::MESSAGE_LENGTH {
        return line;
    }
    // The beginning names the place, the end the remedy.
    let head: String = line.chars().take(policy::MESSAGE_LENGTH * 2 / 3).collect();
    let tail: String = line.chars().skip(count - policy::MESSAGE_LENGTH / 3).collect();
    format!("{head} ... {tail}")
}

/// A word that is no path, without its middle where it is very long.
fn short_word(word: &str) -> String {
    let count = word.chars().count();
    let kept = policy::WORD_LENGTH / 2;
    if count <= policy::WORD_LENGTH || word.contains(['/', '\\']) {
        return word.to_owned();
    }
    let head: String = word.chars().take(kept).collect();
    let tail: String = word.chars().skip(count - kept).collect();
    format!("{head}...{tail}")
}

/// The word with numbers of very many digits in powers of ten.
fn short_numbers(word: &str) -> String {
    let mut made = String::with_capacity(word.len());
    let mut rest = word;
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
        let (before, from) = rest.split_at(start);
        made.push_str(before);
        let digits = |text: &str| text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
        let mut end = digits(from);
        if let Some(places) = from[end..].strip_prefix('.') {
            end += 1 + digits(places);
        }
        let (number, after) = from.split_at(end);
        match number.parse::<f64>() {
            Ok(value) if number.len() > policy::NUMBER_LENGTH => {
                made.push_str(&format!("{value:.3e}"));
            }
            _ => made.push_str(number),
        }
        rest = after;
    }
    made + rest
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
    fn messages_echo_nothing_at_length() {
        let far = format!("error: the centre (-{:.4}, 0.0000) is outside; move it", 1e308);
        assert_eq!(plain(&far), "error: the centre (-1.000e308, 0.0000) is outside; move it");
        let near = format!("no length '{:.320}'; give more", 1e-300);
        assert_eq!(plain(&near), "no length '1.000e-300'; give more");
        let kept = "a\tb/20261122193922.svg: 12.5 and 100000000000000000000.; v1.2.3.";
        assert_eq!(plain(kept), kept.replace('\t', " "));
        let letters = plain(&format!("no font has '{}é'; choose others", "x".repeat(3000)));
        assert!(letters.len() < 200 && letters.ends_with("xé'; choose others"), "{letters}");
        let many = plain(&format!("here: {}; choose others", "word ".repeat(3000)));
        assert!(many.chars().count() < policy::MESSAGE_LENGTH + 10);
        assert!(many.starts_with("here: word") && many.ends_with("; choose others"), "{many}");
    }

    #[test]
    fn usage_errors_fit_one_line() {
        let said = "error: required:\n  <DRIVER>\n\nUsage: centrode\n\nFor more information, try\n";
        assert_eq!(in_one_line(said), "error: required: <DRIVER> (--help lists the options)");
    }
}
