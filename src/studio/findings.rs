//! What was found of a pair, each with its place and its remedy where it has one.

use centrode::diagnose::{Severity, of_severity};
use centrode::pipeline::Design;
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
    made.verdict().word()
}

/// Faults first, then warnings, then what was done.
pub(super) fn all(made: &Design) -> Vec<Finding> {
    let of = |severity, kind: &'static str| {
        of_severity(&made.diagnostics, severity).map(move |found| {
            let text = found.to_string();
            let remedies = if kind == "step" { Vec::new() } else { remedies(&text, made) };
            Finding { kind, angle: found.driver_angle(), remedies, text }
        })
    };
    let faults = of(Severity::Fault, "fault");
    faults.chain(of(Severity::Warning, "warning")).chain(of(Severity::Note, "step")).collect()
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
    if (text.contains("max-lean") || text.contains("slope") || text.contains("bind")) && lean > 25.0
    {
        found.push(remedy("max-lean", (lean - 7.0).max(20.0), 0));
    }
    found
}
