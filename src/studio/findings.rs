//! What was found of a pair, each with its place and its remedy where it has one.

use centrode::design::Design;
use serde::Serialize;

use super::protocol::Remedy;

/// One line of the list.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Finding {
    /// `fault`, `warning` or `step`.
    kind: &'static str,
    text: String,
    /// Driver angle at which it happens, radians.
    angle: Option<f64>,
    remedies: Vec<Remedy>,
}

/// Good, with warnings, or not sound.
pub(super) fn verdict(made: &Design) -> &'static str {
    match (made.is_sound(), made.warnings.is_empty()) {
        (false, _) => "unsound",
        (true, false) => "warnings",
        (true, true) => "good",
    }
}

/// Faults first, then warnings, then what was done.
pub(super) fn all(made: &Design) -> Vec<Finding> {
    let one = |kind: &'static str, texts: &[String]| -> Vec<Finding> {
        texts
            .iter()
            .map(|text| Finding {
                kind,
                text: text.clone(),
                angle: angle_in(text),
                remedies: if kind == "step" { Vec::new() } else { remedies(text, made) },
            })
            .collect()
    };
    let mut all = one("fault", &made.faults);
    all.extend(one("warning", &made.warnings));
    all.extend(one("step", &made.steps));
    all
}

/// The angle in "at 123 degrees".
fn angle_in(text: &str) -> Option<f64> {
    let (_, after) = text.rsplit_once(" at ").filter(|(_, a)| a.contains(" degrees"))?;
    let number = after.split(" degrees").next()?;
    number.trim().parse::<f64>().ok().map(f64::to_radians)
}

/// Settings that the sentence names, moved the way it says.
fn remedies(text: &str, made: &Design) -> Vec<Remedy> {
    let options = &made.options;
    let remedy = |option: &str, value: f64, digits: usize| Remedy {
        option: option.to_owned(),
        value: format!("{value:.digits$}"),
    };
    let folds = made.centrodes.transmission.driver_fold().max(1);
    let teeth = |factor: f64| {
        let count = f64::from(made.teeth[0]) * factor / f64::from(folds);
        remedy("teeth", count.round() * f64::from(folds), 0)
    };
    let lean = options.fit.limits.max_lean.to_degrees();
    let mut found = Vec::new();
    if text.contains("more teeth") {
        found.push(teeth(1.25));
    }
    if text.contains("fewer teeth") {
        found.push(teeth(0.8));
    }
    if text.contains("less clearance") && options.clearance > 0.0 {
        found.push(remedy("clearance", options.clearance * 0.6, 3));
    }
    if text.contains("more clearance") {
        found.push(remedy("clearance", (options.clearance * 1.5).max(0.05), 3));
    }
    if (text.contains("max-lean") || text.contains("less lean") || text.contains("bind"))
        && lean > 25.0
    {
        found.push(remedy("max-lean", (lean - 7.0).max(20.0), 0));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_place_is_read_from_the_sentence() {
        let at = angle_in(
            "the working pressure angle reaches 71 degrees at 90 degrees of driver turn: it may bind",
        );
        assert!((at.unwrap() - std::f64::consts::FRAC_PI_2).abs() < 1e-9);
        assert_eq!(angle_in("lean held to 50 degrees"), None);
    }
}
