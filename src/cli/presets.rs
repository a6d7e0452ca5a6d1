//! `centrode motion --help-presets`: what the presets are.

use std::ffi::OsString;
use std::io::Write;

use centrode::law::PRESETS;

/// Whether a command line asks for the presets, which needs none of `motion`'s other options.
pub(crate) fn asked(mut words: impl Iterator<Item = OsString>) -> bool {
    words.nth(1).is_some_and(|w| w == "motion") && words.any(|w| w == "--help-presets")
}

/// The table.
fn table() -> String {
    let mut text = String::from(
        "Motions with a name, for `centrode motion --preset NAME`. At a ratio of M:N each repeats N times in a turn of the driver.\n\n",
    );
    let width = PRESETS.iter().map(|p| p.form.len()).max().unwrap_or_default();
    let example = PRESETS.iter().map(|p| p.example.len()).max().unwrap_or_default();
    for preset in PRESETS {
        text += &format!("{:width$}  {:example$}  {}\n", preset.form, preset.example, preset.does);
    }
    text += "\npsi' is the follower's speed over the driver's. For a part of a turn give LAW with --from and --to.\n";
    text
}

/// Prints the table.
pub(crate) fn print() {
    // A closed pipe is no reason to fail.
    let _ = std::io::stdout().lock().write_all(table().as_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_asked_for_without_anything_else() {
        let words = |line: &str| line.split(' ').map(OsString::from).collect::<Vec<_>>();
        assert!(asked(words("centrode motion --help-presets").into_iter()));
        assert!(!asked(words("centrode design --help-presets").into_iter()));
        assert!(PRESETS.iter().all(|p| table().contains(p.example)));
    }
}
