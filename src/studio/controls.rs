//! The controls of the page: the options of the command line, with what a slider must know besides.
//!
//! Names, groups, sentences of help, defaults and choices are read from the command line itself; nothing is repeated
//! here but how an option is shown.

use clap::{Arg, ArgAction};
use serde::Serialize;

use super::protocol::Way;

/// How an option is set.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum Look {
    /// A number with a slider; the field takes more than the slider where the option does.
    Number { unit: &'static str, from: f64, to: f64, step: f64 },
    /// One of a list.
    Choice,
    /// On or off.
    Flag,
    /// Words.
    Text { usual: &'static [&'static str] },
    /// A place in a drawing, set by dragging.
    Point,
}

/// One control.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Control {
    key: String,
    group: String,
    help: String,
    #[serde(flatten)]
    look: Look,
    /// As the command line writes it; none where the program chooses.
    default: Option<String>,
    /// What the program chooses by itself, where there is no default.
    chosen: Option<String>,
    choices: Vec<String>,
    /// Shown at once, above the groups.
    main: bool,
    /// Options that cannot be given together with this one.
    conflicts: Vec<String>,
}

const fn number(unit: &'static str, from: f64, to: f64, step: f64) -> Look {
    Look::Number { unit, from, to, step }
}

/// Options with a number, their unit and the range of their slider.
const NUMBERS: &[(&str, Look)] = &[
    ("teeth", number("", 8.0, 120.0, 1.0)),
    ("module", number("mm", 0.5, 6.0, 0.05)),
    ("center-distance", number("mm", 20.0, 200.0, 1.0)),
    ("size", number("mm", 30.0, 300.0, 1.0)),
    ("thickness", number("mm", 1.0, 30.0, 0.5)),
    ("clearance", number("mm", 0.0, 0.5, 0.01)),
    ("backlash", number("mm", 0.0, 0.5, 0.01)),
    ("root-clearance", number("mm", 0.0, 2.0, 0.05)),
    ("pressure-angle", number("°", 10.0, 35.0, 0.5)),
    ("addendum", number("modules", 0.2, 1.5, 0.05)),
    ("chord-tolerance", number("modules", 0.0001, 0.01, 0.0001)),
    ("torque-weight", number("", 0.0, 2.0, 0.05)),
    ("balance", number("", 0.0, 1.0, 0.01)),
    ("max-torque", number("×", 1.05, 8.0, 0.05)),
    ("max-lean", number("°", 10.0, 75.0, 1.0)),
    ("orientation", number("°", -180.0, 180.0, 1.0)),
    ("star-weight", number("", 0.0, 10.0, 0.1)),
    ("smoothing", number("", 0.0, 1.0, 0.01)),
    ("threshold", number("", 0.0, 255.0, 1.0)),
    ("load", number("N mm", 1.0, 2000.0, 1.0)),
    ("rpm", number("rpm", 1.0, 300.0, 1.0)),
    ("friction", number("", 0.0, 0.6, 0.01)),
    ("density", number("kg/m³", 500.0, 9000.0, 10.0)),
    ("motor-torque", number("N mm", 1.0, 10_000.0, 10.0)),
    ("hub-diameter", number("mm", 4.0, 40.0, 0.5)),
    ("hub-height", number("mm", 1.0, 20.0, 0.5)),
    ("set-screw", number("mm", 1.0, 6.0, 0.1)),
    ("screws", number("", 2.0, 12.0, 1.0)),
    ("screw-diameter", number("mm", 1.0, 8.0, 0.1)),
    ("screw-circle", number("mm", 4.0, 60.0, 0.5)),
    ("chamfer", number("mm", 0.0, 1.5, 0.05)),
    ("base-thickness", number("mm", 1.0, 20.0, 0.5)),
    ("letter-height", number("mm", 2.0, 15.0, 0.5)),
    ("face-depth", number("mm", 0.1, 5.0, 0.1)),
    ("nozzle", number("mm", 0.1, 1.2, 0.05)),
    ("curve-tolerance", number("mm", 0.0005, 0.05, 0.0005)),
    ("kerf", number("mm", 0.0, 1.0, 0.01)),
    ("effort", number("", 1.0, 5.0, 1.0)),
    ("from", number("°", 0.0, 360.0, 1.0)),
    ("to", number("°", 0.0, 360.0, 1.0)),
];

/// Options written as words, with what is often written.
const WORDS: &[(&str, &[&str])] = &[
    ("ratio", &["1", "2", "3", "1/2", "1/3"]),
    ("bore", &["5mm", "d:5", "hex:6", "square:4", "keyway:8", "lego", "M5", "608", "none"]),
    ("fit", &["tight", "slide", "loose"]),
    ("lightening", &["auto", "3", "5"]),
    ("emboss", &["names"]),
    ("engrave", &["names"]),
    ("letters-at", &["axis", "above", "below", "left", "right"]),
    ("base", &["none", "pins", "M5", "insert:M5", "608", "lego"]),
    ("base-mount", &["M4", "feet"]),
    (
        "material",
        &[
            "pla",
            "petg",
            "abs",
            "nylon",
            "pom",
            "resin",
            "plywood",
            "acrylic",
            "aluminium",
            "steel",
        ],
    ),
    ("preset", &["ellipse:0.4", "eccentric:0.3", "dwell:0.2", "quick-return:2", "constant"]),
    ("centrode", &["1/(1 + 0.3*cos(2*phi))"]),
    ("bed", &["200x200", "220x220", "256x256"]),
];

const POINTS: &[&str] = &["driver-axis", "follower-axis", "axis"];

/// Those above the groups, in this order.
const MAIN: &[&str] =
    &["ratio", "teeth", "center-distance", "clearance", "balance", "max-lean", "max-torque"];

/// Options that are no controls: what the page does otherwise, or has no use for.
const LEFT_OUT: &[&str] = &[
    "help",
    "version",
    "quiet",
    "threads",
    "save-scene",
    "output",
    "json",
    "export",
    "force",
    "animate",
    "no-refine",
    "alternatives",
    "choose",
];

/// The controls of a command.
pub(super) fn of(way: Way, command: &clap::Command) -> Vec<Control> {
    let Some(known) = command.find_subcommand(way.command()) else { return Vec::new() };
    let mut controls: Vec<Control> =
        known.get_arguments().filter_map(|arg| control(arg, known)).collect();
    controls.sort_by_key(|c| MAIN.iter().position(|m| *m == c.key).unwrap_or(MAIN.len()));
    controls
}

fn control(arg: &Arg, command: &clap::Command) -> Option<Control> {
    let key = arg.get_long()?.to_owned();
    if LEFT_OUT.contains(&key.as_str()) {
        return None;
    }
    let flag = matches!(arg.get_action(), ArgAction::SetTrue | ArgAction::SetFalse);
    let choices: Vec<String> =
        arg.get_possible_values().iter().map(|v| v.get_name().to_owned()).collect();
    let look = if flag {
        Look::Flag
    } else if POINTS.contains(&key.as_str()) {
        Look::Point
    } else if let Some((_, look)) = NUMBERS.iter().find(|(k, _)| *k == key) {
        *look
    } else if !choices.is_empty() {
        Look::Choice
    } else {
        let usual = WORDS.iter().find(|(k, _)| *k == key).map_or(&[][..], |(_, usual)| usual);
        Look::Text { usual }
    };
    let said = arg.get_help().map(ToString::to_string).unwrap_or_default();
    let (help, chosen) = match said.split_once(" [default: ") {
        Some((help, chosen)) => (help.to_owned(), Some(chosen.trim_end_matches(']').to_owned())),
        None => (said, None),
    };
    let default = arg
        .get_default_values()
        .first()
        .filter(|_| !flag)
        .map(|v| v.to_string_lossy().into_owned());
    let conflicts = command
        .get_arg_conflicts_with(arg)
        .into_iter()
        .filter_map(|other| other.get_long().map(str::to_owned))
        .collect();
    Some(Control {
        main: MAIN.contains(&key.as_str()),
        group: arg.get_help_heading().unwrap_or("Motion").to_owned(),
        key,
        help,
        look,
        default,
        chosen,
        choices,
        conflicts,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn every_control_has_a_sentence_and_every_number_a_range_that_holds_its_default() {
        let command = crate::cli::Cli::command();
        for way in [Way::Design, Way::Mate, Way::Motion] {
            let controls = of(way, &command);
            assert!(controls.len() > 30, "{way:?}");
            for c in &controls {
                assert!(!c.help.is_empty() && !c.group.is_empty(), "{c:?}");
                if let (Look::Number { from, to, step, .. }, Some(default)) = (c.look, &c.default) {
                    let value: f64 = default.trim_end_matches("mm").parse().unwrap();
                    assert!(from <= value && value <= to && step > 0.0, "{c:?}");
                }
            }
        }
    }

    #[test]
    fn no_option_is_named_that_the_command_line_does_not_have() {
        let command = crate::cli::Cli::command();
        let known: Vec<String> = [Way::Design, Way::Mate, Way::Motion]
            .into_iter()
            .filter_map(|way| command.find_subcommand(way.command()))
            .flat_map(|c| c.get_arguments().filter_map(|a| a.get_long().map(str::to_owned)))
            .collect();
        let named = NUMBERS.iter().map(|n| n.0).chain(WORDS.iter().map(|w| w.0));
        for name in named.chain(POINTS.iter().copied()).chain(MAIN.iter().copied()) {
            assert!(known.iter().any(|k| k == name), "{name}");
        }
    }
}
