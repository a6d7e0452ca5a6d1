//! What was found of a pair, each with its place and its remedy where it has one.

use std::f64::consts::{PI, TAU};

use centrode::diagnose::{Code, Diagnostic, Place, Severity, of_severity};
use centrode::gear::Side;
use centrode::geometry::Point;
use centrode::pipeline::Design;
use serde::Serialize;

use super::protocol::Remedy;

/// One line of the list.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Finding {
    /// `fault`, `warning` or `step`.
    kind: &'static str,
    /// The stable word of its code.
    code: &'static str,
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
            let remedies = if kind == "step" { Vec::new() } else { remedies(found, made) };
            Finding {
                kind,
                code: found.code.word(),
                angle: angle(found, made),
                remedies,
                text: found.to_string(),
            }
        })
    };
    let faults = of(Severity::Fault, "fault");
    faults.chain(of(Severity::Warning, "warning")).chain(of(Severity::Note, "step")).collect()
}

/// What may be turned to mend a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Turn {
    MoreTeeth,
    FewerTeeth,
    LessClearance,
    MoreClearance,
    LessSlope,
    MoreSmoothing,
    Larger,
}

/// What helps against each kind of finding, the best first.
fn turns(found: &Diagnostic) -> &'static [Turn] {
    use Turn::{
        FewerTeeth, Larger, LessClearance, LessSlope, MoreClearance, MoreSmoothing, MoreTeeth,
    };
    match found.code {
        Code::Undercut => &[LessSlope, MoreSmoothing],
        Code::ToothError => &[MoreTeeth, LessSlope],
        Code::ThinBody | Code::SectorContact => &[MoreTeeth],
        Code::SelfCrossing => &[MoreTeeth, LessClearance],
        Code::ContactLost | Code::ContactLostBackward if found.figure("exact") == Some(0.0) => {
            &[LessClearance, FewerTeeth]
        }
        Code::ContactLost | Code::ContactLostBackward => &[MoreTeeth, LessSlope],
        Code::Overlap => &[MoreClearance, FewerTeeth],
        Code::TransmissionError => &[LessClearance, LessSlope],
        Code::PressureAngle | Code::SelfLocking | Code::Torque | Code::Efficiency => &[LessSlope],
        Code::Backlash => &[LessClearance, LessSlope, FewerTeeth],
        Code::Jam | Code::Penetration => &[MoreClearance],
        Code::FreeRun => &[LessClearance],
        Code::NarrowBore
        | Code::NoBore
        | Code::NoPhaseMark
        | Code::NoLightening
        | Code::NameHasNoRoom => &[Larger],
        _ => &[],
    }
}

/// Settings that may help, with the values to try.
fn remedies(found: &Diagnostic, made: &Design) -> Vec<Remedy> {
    turns(found).iter().filter_map(|turn| remedy(*turn, made)).collect()
}

fn remedy(turn: Turn, made: &Design) -> Option<Remedy> {
    let options = &made.options;
    let to = |option: &str, value: f64, digits: usize| {
        Some(Remedy { option: option.to_owned(), value: format!("{value:.digits$}") })
    };
    let folds = f64::from(made.centrodes.transmission.driver_fold().max(1));
    let teeth =
        |factor: f64| to("teeth", (f64::from(made.teeth[0]) * factor / folds).round() * folds, 0);
    let steepest = options.fit.limits.max_lean.min(made.centrodes.max_lean()).to_degrees();
    match turn {
        Turn::MoreTeeth => teeth(1.25),
        Turn::FewerTeeth => teeth(0.8),
        Turn::LessClearance if options.clearance > 0.0 => {
            to("clearance", options.clearance * 0.6, 3)
        }
        Turn::MoreClearance => to("clearance", (options.clearance * 1.5).max(0.05), 3),
        // Only a pair made from drawings has its slope and smoothing bounded.
        Turn::LessSlope if made.drawings[0].is_some() && steepest > 25.0 => {
            to("max-lean", (steepest - 6.0).max(20.0), 0)
        }
        Turn::MoreSmoothing if made.drawings[0].is_some() => to("smoothing", 0.05, 2),
        Turn::Larger => to("center-distance", made.centrodes.center_distance * 1.25, 0),
        _ => None,
    }
}

/// The driver angle at which the place of a finding is in mesh, radians.
fn angle(found: &Diagnostic, made: &Design) -> Option<f64> {
    let motion = made.assembly.motion().ok()?;
    let (side, bearing) = match found.place? {
        Place::DriverAngle(angle) => return Some(angle),
        Place::Gear(_) => return None,
        Place::Point { gear, x, y } => (gear, y.atan2(x)),
        Place::Tooth { gear, index } => {
            let gears = [Side::Driver, Side::Follower];
            let i = gears.iter().position(|g| *g == gear)?;
            let curve = &made.assembly.gears.get(i)?.gear.pitch_curve;
            // Teeth follow each other evenly along the pitch curve.
            let share = index as f64 / f64::from(made.teeth[i].max(1));
            let at = along(curve, share)?;
            (gear, at.y.atan2(at.x))
        }
    };
    let angle = match side {
        Side::Driver => -bearing,
        Side::Follower => motion.inverse((bearing - PI).rem_euclid(TAU)),
    };
    Some(angle.rem_euclid(motion.cycle()))
}

/// The point of a closed curve after a share of its length.
fn along(curve: &[Point], share: f64) -> Option<Point> {
    let steps = || curve.iter().zip(curve.iter().cycle().skip(1));
    let whole: f64 = steps().map(|(a, b)| (b - a).norm()).sum();
    let mut left = share * whole;
    for (a, b) in steps() {
        let step = (b - a).norm();
        if left <= step && step > 0.0 {
            return Some(a + (b - a) * (left / step));
        }
        left -= step;
    }
    curve.first().copied()
}

#[cfg(test)]
mod tests {
    use super::super::example::pair;
    use super::*;
    use centrode::control::StageName;

    #[test]
    fn remedies_turn_settings_the_way_that_helps() {
        let made = pair();
        let found = Diagnostic::fault(Code::Jam, StageName::Proven);
        let [remedy] = &remedies(&found, &made)[..] else { panic!("one remedy") };
        assert_eq!(remedy.option, "clearance");
        assert!(remedy.value.parse::<f64>().unwrap() > made.options.clearance);
        let found = Diagnostic::warning(Code::ThinBody, StageName::Toothed);
        // Of a motion that repeats twice, a whole number of teeth a period.
        assert_eq!(remedies(&found, &made)[0].value, "30");
        // No drawing, no bound on slope.
        let found = Diagnostic::warning(Code::PressureAngle, StageName::Analysed);
        assert!(remedies(&found, &made).is_empty());
    }

    #[test]
    fn places_on_a_gear_are_shown_where_they_mesh() {
        let made = pair();
        let at = |place| {
            let found = Diagnostic::warning(Code::ThinBody, StageName::Toothed).at(place);
            angle(&found, &made).unwrap()
        };
        let up = at(Place::Point { gear: Side::Driver, x: 0.0, y: 10.0 });
        assert!((up - 1.5 * PI).abs() < 1e-9, "{up}");
        // A point of the follower that faces the driver meshes in the first pose.
        let facing = at(Place::Point { gear: Side::Follower, x: -10.0, y: 0.0 });
        assert!(facing < 1e-6 || TAU - facing < 1e-6, "{facing}");
        let first = at(Place::Tooth { gear: Side::Driver, index: 0 });
        assert!(first < 0.3 || TAU - first < 0.3, "{first}");
    }
}
