//! What a person is told of each finding, with the remedy of each fault and warning.

use std::fmt;

use super::{Code, Diagnostic, Place};

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let figure = |name: &str| self.figure(name).unwrap_or(f64::NAN);
        let degrees = |name: &str| figure(name).to_degrees();
        let percent = |name: &str| 100.0 * figure(name);
        let gear = || match self.place.and_then(Place::gear) {
            Some(side) => side.to_string(),
            None if self.subject.is_empty() => "gear".to_owned(),
            None => self.subject.clone(),
        };
        let subject = &self.subject;
        // Within one turn, as a person finds it on the gear.
        let at = self.driver_angle().unwrap_or(f64::NAN).to_degrees().rem_euclid(360.0);
        match self.code {
            Code::LimitsKept => write!(
                f,
                "the limits on slope and torque changed the pitch curves by {:.3}, measured as E_s (slope from {:.0} to {:.0} degrees)",
                figure("shape"),
                degrees("from"),
                degrees("to")
            ),
            Code::Refined => write!(
                f,
                "refined: the area by which pitch curves and drawings differ, plus the weighted torque, went from {:.1} to {:.1} %",
                percent("before"),
                percent("after")
            ),
            Code::PoorLikeness => write!(
                f,
                "the {} keeps only {:.0} % of the likeness of {subject}; use a thicker shape or one with shallower bays",
                gear(),
                percent("share")
            ),
            Code::HiddenArea => write!(
                f,
                "areas of {subject} hidden from the {}'s axis are filled in, {:.1} % of its area; a shape with shallower bays keeps more",
                gear(),
                percent("share")
            ),
            Code::CornersRounded => write!(
                f,
                "corners too sharp for the teeth were rounded, which changes the pitch curves by {:.3}, measured as E_s",
                figure("shape")
            ),
            Code::MotionChanged => write!(
                f,
                "the motion was changed by up to {:.2} degrees of the follower so that teeth can follow it",
                degrees("angle")
            ),
            Code::GentlerTeeth => {
                let slope = self
                    .figure("slope")
                    .map(|s| format!("slope held to {:.0} degrees", s.to_degrees()));
                let radius = self
                    .figure("radius")
                    .map(|r| format!("pitch curves rounded to a radius of {r:.2} modules"));
                let done: Vec<String> = slope.into_iter().chain(radius).collect();
                write!(
                    f,
                    "gentler teeth, {}: transmission error {:.2} % of a pitch instead of {:.2} %",
                    done.join(" and "),
                    percent("after"),
                    percent("before")
                )
            }
            Code::LessSlope => write!(
                f,
                "slope held to {:.0} degrees, for the first pair failed its proof ({subject})",
                degrees("slope")
            ),
            Code::Undercut => {
                let index = match self.place {
                    Some(Place::Tooth { index, .. }) => index,
                    _ => 0,
                };
                write!(
                    f,
                    "contact of {} of {} teeth ends before the next tooth engages (contact ratio below 1), worst tooth {index} of the {} ({:.2}); try more smoothing or a lower --max-lean",
                    figure("count"),
                    figure("teeth"),
                    gear(),
                    figure("share")
                )
            }
            Code::ThinBody => {
                let (x, y) = self.point();
                write!(
                    f,
                    "the body of the {} is thinner than {:.2} mm between its roots near ({x:.1}, {y:.1}); use more teeth or a thicker shape",
                    gear(),
                    figure("thickness")
                )
            }
            Code::SelfCrossing => {
                let (x, y) = self.point();
                write!(
                    f,
                    "the outline of the {} crosses itself at ({x:.3}, {y:.3}); try more teeth or less clearance",
                    gear()
                )
            }
            Code::ContactLost => write!(
                f,
                "contact is lost over {:.1} degrees of driver turn, first at {at:.1} degrees; {}",
                degrees("angle"),
                self.remedy_of_lost_contact()
            ),
            Code::ContactLostBackward => write!(
                f,
                "driven backwards, the pair loses contact; {}",
                self.remedy_of_lost_contact()
            ),
            Code::NoContact => match self.figure("gap") {
                Some(gap) => write!(
                    f,
                    "the gears never touch, a gap of {gap:.3} mm remains; bring the axes closer"
                ),
                None => write!(f, "the gears never touch; bring the axes closer"),
            },
            Code::Overlap => write!(
                f,
                "the outlines overlap by {:.4} mm at {at:.1} degrees; give more clearance, fewer teeth or a larger centre distance",
                figure("depth")
            ),
            Code::ToothError => write!(
                f,
                "the teeth deviate by up to {:.1} % of a pitch (99th percentile, without clearance); try more teeth or a lower --max-lean",
                percent("pitches")
            ),
            Code::TransmissionError => write!(
                f,
                "transmission error {:.2} degrees peak to peak, {:.1} % of a pitch (limit {:.0} %); reduce clearance or slope, or try another number of teeth",
                degrees("angle"),
                percent("pitches"),
                percent("limit")
            ),
            Code::PressureAngle => write!(
                f,
                "the working pressure angle reaches {:.0} degrees at {at:.0} degrees of driver turn: with friction the pair may bind there; use a lower --max-lean or pressure angle",
                degrees("angle")
            ),
            Code::Backlash => write!(
                f,
                "the backlash reaches {:.0} % of a pitch at {at:.0} degrees of driver turn; give less clearance, less slope or fewer teeth",
                percent("pitches")
            ),
            Code::Jam => write!(
                f,
                "the gears jam at {at:.0} degrees: a motor of several times the torque does not turn them past it; give more clearance"
            ),
            Code::FlungApart => write!(
                f,
                "the simulation diverges at {at:.0} degrees; check that the outlines do not overlap there"
            ),
            Code::FreeRun => write!(
                f,
                "the driver loses contact for {:.2} of a pitch at {at:.0} degrees (limit {:.2}); reduce clearance, speed or the follower's mass",
                figure("pitches"),
                figure("limit")
            ),
            Code::Penetration => write!(
                f,
                "the gears are pressed {:.3} mm into each other at {at:.0} degrees (limit {:.3}): they would jam; give more clearance",
                figure("depth"),
                figure("limit")
            ),
            Code::SkippedTeeth => write!(
                f,
                "the follower ends {:.1} pitches from where it should be: it skips teeth; check tooth counts and centre distance",
                figure("pitches")
            ),
            Code::OffContact => write!(
                f,
                "the follower is {:.2} degrees from where the flanks touch at {at:.0} degrees (limit {:.2}); look for teeth that are missing, doubled or in the way",
                degrees("angle"),
                degrees("limit")
            ),
            Code::Torque => write!(
                f,
                "the driver's torque differs from its ideal by {:+.2} times the load at {at:.0} degrees (limit {:.2}); reduce friction or slope",
                figure("loads"),
                figure("limit")
            ),
            Code::SelfLocking => write!(
                f,
                "a friction of {:.2} locks the gears at {at:.0} degrees, however strong the motor; grease them, or reduce slope or torque there",
                figure("friction")
            ),
            Code::Efficiency => write!(
                f,
                "the efficiency is {:.0} % (limit {:.0} %); reduce friction or slope",
                percent("share"),
                percent("limit")
            ),
            Code::CutShort => write!(
                f,
                "the run ended at {:.0} degrees, after the largest number of steps allowed; simulate fewer cycles",
                self.driver_angle().unwrap_or(f64::NAN).to_degrees()
            ),
            Code::NarrowBore => write!(
                f,
                "the bore of the {} is {:.1} mm: a wider one would leave too thin a wall; make the pair larger",
                gear(),
                figure("diameter")
            ),
            Code::NoBore => write!(
                f,
                "the {} has no bore: there is no room for one at its axis; make the pair larger, or move the axis",
                gear()
            ),
            Code::NoPhaseMark => write!(
                f,
                "the {} has no room for a phase mark; use a smaller hub, or make the pair larger",
                gear()
            ),
            Code::NoLightening => write!(
                f,
                "the {} has no room for lightening holes; ask for fewer, or make the pair larger",
                gear()
            ),
            Code::HolesLost => write!(
                f,
                "of the {:.0} holes drawn in the {}, {:.0} are filled, for no wall would be left beside them; make the pair larger, or the bore smaller",
                figure("of"),
                gear(),
                figure("count")
            ),
            Code::FaceLost => write!(
                f,
                "the {} has no room for its inner drawing; make the pair larger, or leave --face out",
                gear()
            ),
            Code::FaceClipped => write!(
                f,
                "the {} loses {:.0} % of its inner drawing to teeth, axle or fittings; make the pair larger, or the bore and hub smaller",
                gear(),
                percent("share")
            ),
            Code::FaceLines => write!(
                f,
                "in the drawing on the {}, {:.0} lines were widened to the nozzle of {:.2} mm and {:.0} specks left out",
                gear(),
                figure("widened"),
                figure("nozzle"),
                figure("dropped")
            ),
            Code::NameHasNoRoom => write!(
                f,
                "the name does not fit on the {}; give a shorter text, or make the pair larger",
                gear()
            ),
            Code::NameUnwritable => write!(
                f,
                "the name on the {} has characters that no font here has; give a text in plain letters",
                gear()
            ),
            Code::SectorCut => write!(
                f,
                "the {} was cut to {:.0} of its {:.0} teeth, which mesh from {:.1} to {:.1} degrees of driver turn",
                gear(),
                figure("teeth"),
                figure("of"),
                degrees("from"),
                degrees("to")
            ),
            Code::SectorWhole => {
                write!(
                    f,
                    "the {} needs nearly all of its teeth for the segment and stays whole",
                    gear()
                )
            }
            Code::SectorKeepsContact => write!(
                f,
                "the cut gears keep contact at all {:.0} poses of the segment; the other figures are those of the whole gears",
                figure("poses")
            ),
            Code::SectorContact => write!(
                f,
                "cut to its segment, the pair loses contact or overlaps at {at:.1} degrees of driver turn; leave out --sector or give more teeth"
            ),
        }
    }
}

impl Diagnostic {
    fn point(&self) -> (f64, f64) {
        match self.place {
            Some(Place::Point { x, y, .. }) => (x, y),
            _ => (f64::NAN, f64::NAN),
        }
    }

    /// Where the teeth themselves keep contact, clearance opens them too far for their size.
    fn remedy_of_lost_contact(&self) -> &'static str {
        match self.figure("exact") {
            Some(0.0) => "give less clearance or fewer teeth",
            Some(_) => "try more teeth, more smoothing or a lower --max-lean",
            None => "add the missing flanks or bring the axes closer",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::StageName;
    use crate::gear::Side;

    #[test]
    fn every_warning_says_what_to_do() {
        let notes = [
            Code::LimitsKept,
            Code::Refined,
            Code::CornersRounded,
            Code::MotionChanged,
            Code::GentlerTeeth,
            Code::LessSlope,
            Code::SectorCut,
            Code::SectorWhole,
            Code::SectorKeepsContact,
            Code::FaceLines,
        ];
        for &code in Code::ALL {
            let found = Diagnostic::warning(code, StageName::Analysed)
                .at(Place::Gear(Side::Driver))
                .about("heart");
            let told = found.to_string();
            assert!(
                !told.contains('\n') && told.chars().next().is_some_and(char::is_lowercase),
                "{told}"
            );
            if !notes.contains(&code) {
                assert!(told.contains("; "), "{code}: {told}");
            }
        }
    }
}
