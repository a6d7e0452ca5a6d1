//! Judges two finished gears of which nothing is known but their outlines: finds axes, teeth, phase
//! and motion, then has [`crate::meshing`] look at them.

mod axis;
mod error;
mod motion;
mod pair;
mod phase;
mod teeth;
mod trace;

pub use axis::AxisSource;
pub use error::CheckError;
pub use motion::{MotionFileError, motion_from_columns};

use crate::control::{Control, StageName};
use crate::diagnose::{Code, Diagnostic, Limits, Verdict};
use crate::gear::{Motion, Side};
use crate::geometry::Point;
use crate::input::{PairRecord, Toothed};
use crate::meshing::{
    ContactInput, ContactOptions, ContactSummary, Direction, Dynamics, DynamicsInput,
    DynamicsOptions, analyse, judge, judge_contact, simulate,
};
use crate::policy;
use motion::Known;
use pair::Pair;
use std::f64::consts::TAU;
use trace::Untraced;

/// The motion a pair is checked against.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum MotionGiven {
    /// That of the `design.json` if both gears come from the same one, else derived from contact.
    #[default]
    Unknown,
    /// An even one: so many turns of the driver for one of the follower.
    Ratio(f64),
    /// Samples of driver and follower angle, radians, over whole turns of the driver.
    Sampled {
        /// Driver angles.
        driver: Vec<f64>,
        /// Follower angles.
        follower: Vec<f64>,
    },
}

/// Where the motion came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionSource {
    /// A ratio was given.
    Ratio,
    /// Samples were given.
    Samples,
    /// The `design.json` of the pair.
    Record,
    /// Both gears are round: the ratio of their tooth counts.
    Teeth,
    /// The contact of the outlines.
    Contact,
}

impl MotionSource {
    /// A stable word for programs.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Ratio => "ratio",
            Self::Samples => "samples",
            Self::Record => "record",
            Self::Teeth => "teeth",
            Self::Contact => "contact",
        }
    }
}

/// How a pair is checked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CheckOptions {
    /// Distance of the axes, mm; that of the `design.json` when left out, or of both where they agree.
    pub center_distance: Option<f64>,
    /// Axes of driver and follower in the frames of their files, mm; found when left out.
    pub axes: [Option<Point>; 2],
    /// Teeth of driver and follower; counted when left out.
    pub teeth: Option<[u32; 2]>,
    /// Turn of the follower's drawing at driver angle 0, radians clockwise; found when left out.
    pub phase: Option<f64>,
    /// The motion.
    pub motion: MotionGiven,
    /// How closely contact is looked at.
    pub contact: ContactOptions,
    /// Runs as rigid bodies, made when the contact analysis finds no fault. Their cycles are set by
    /// [`policy::CHECK_CYCLES`].
    pub runs: Vec<DynamicsOptions>,
    /// Where a pair fails.
    pub limits: Limits,
    /// Who may stop the work and hears how far it is.
    pub control: Control,
}

/// What was found. Lengths mm, angles radians.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckReport {
    /// Why it fails and what deserves attention, each kind once.
    pub diagnostics: Vec<Diagnostic>,
    /// Axes of driver and follower in the frames of their files.
    pub axes: [(Point, AxisSource); 2],
    /// Distance of the axes.
    pub center_distance: f64,
    /// Teeth of driver and follower.
    pub teeth: [u32; 2],
    /// Module: length of the pitch curve over pi and its teeth; by the spacing of the teeth where no motion was found.
    pub module: f64,
    /// Turn of the follower's drawing at driver angle 0, clockwise.
    pub phase: f64,
    /// Whether the phase was given, or follows from the record.
    pub phase_given: bool,
    /// Turns of the driver for one of the follower.
    pub ratio: f64,
    /// Where the motion came from.
    pub motion: MotionSource,
    /// Driver angle over which the pair was checked.
    pub driver_cycle: f64,
    /// psi at even driver angles over the cycle, first and last included; empty without a motion.
    pub psi: Vec<f64>,
    /// Figures of the contact analysis; none when no motion could be found.
    pub contact: Option<ContactSummary>,
    /// The runs that were made.
    pub runs: Vec<Dynamics>,
    /// What a reader should know, one sentence each.
    pub notes: Vec<String>,
}

/// Checks a pair.
///
/// Bounded in work: outlines by [`policy::OUTLINE_VERTICES_KEPT`] vertices, the cycle by
/// [`policy::CHECK_TURNS`] driver turns, runs by [`policy::MOST_STEPS`] steps.
///
/// # Errors
/// See [`CheckError`]: input that is no pair of gears. A pair that does not mesh is no error.
pub fn check(
    driver: &Toothed,
    follower: &Toothed,
    options: &CheckOptions,
) -> Result<CheckReport, CheckError> {
    let mut notes = Vec::new();
    for (gear, side) in [(driver, Side::Driver), (follower, Side::Follower)] {
        if let Some(t) = gear.thinned {
            notes.push(format!(
                "the {} was thinned from {} to {} vertices, within {:.1e} mm",
                side, t.from, t.to, t.tolerance
            ));
        }
        notes.extend(gear.notes.iter().map(|note| format!("{side}: {note}")));
    }
    let record = common_record(driver, follower);
    let center_distance = options
        .center_distance
        .or(common_distance(driver, follower))
        .ok_or(CheckError::NoCenterDistance)?;
    if !(center_distance.is_finite() && center_distance > 0.0) {
        return Err(CheckError::NotPositive { name: "centre distance", value: center_distance });
    }
    let found = [
        axis::axis(driver, Side::Driver, options.axes[0])?,
        axis::axis(follower, Side::Follower, options.axes[1])?,
    ];
    let axes = found.each_ref().map(|(axis, source, _)| (*axis, *source));
    notes.extend(found.into_iter().filter_map(|(.., note)| note));
    let pair = set_up([driver, follower], &axes, center_distance, record, options.teeth)?;
    if let Some(gap) = apart(&pair) {
        let sizes = [driver, follower].map(|gear| {
            let (low, high) = gear.outline.bounds();
            high - low
        });
        notes.push(format!(
            "as read, the driver is {:.3} x {:.3} mm and the follower {:.3} x {:.3} mm; if that is not their size, correct the units of the files",
            sizes[0].x, sizes[0].y, sizes[1].x, sizes[1].y
        ));
        let fault = Diagnostic::fault(Code::NoContact, StageName::Analysed).with("gap", gap);
        return Ok(unjudged(&pair, axes, fault, options.phase, notes));
    }
    let known = match motion::known(&pair, record, &options.motion)? {
        Some(known) => known,
        None => match derived(&pair, options.phase) {
            Ok(known) => known,
            Err(Untraced::NoStart) => {
                return Ok(unjudged(&pair, axes, overlap(&pair), options.phase, notes));
            }
            Err(reason) => return Ok(unmoved(&pair, axes, reason, options.phase, notes)),
        },
    };
    let given = options.phase.or(known.phase.filter(|_| known.source == MotionSource::Record));
    let phase = match given.or(known.phase) {
        Some(phase) => phase,
        None => match phase::for_motion(&pair, &*known.motion) {
            Some(found) => found.phase,
            None => return Ok(unjudged(&pair, axes, overlap(&pair), options.phase, notes)),
        },
    };
    judged(&pair, axes, &known, (phase, given.is_some()), options, notes)
}

/// What both gears' files tell, if they are the same file.
fn common_record<'a>(driver: &'a Toothed, follower: &'a Toothed) -> Option<&'a PairRecord> {
    driver.record.as_ref().filter(|d| follower.record.as_ref() == Some(d))
}

/// The distance of the axes that both gears' files tell, be they of one pair or of two alike.
fn common_distance(driver: &Toothed, follower: &Toothed) -> Option<f64> {
    let [first, second] = [driver, follower].map(|g| g.record.as_ref().map(|r| r.center_distance));
    let (first, second) = first.zip(second)?;
    ((first - second).abs() <= policy::DISTANCES_AGREE * first.abs()).then_some(first)
}

fn set_up(
    gears: [&Toothed; 2],
    axes: &[(Point, AxisSource); 2],
    center_distance: f64,
    record: Option<&PairRecord>,
    teeth: Option<[u32; 2]>,
) -> Result<Pair, CheckError> {
    let centred = |i: usize| -> Vec<Point> {
        gears[i].outline.points().iter().map(|p| p - axes[i].0.coords).collect()
    };
    let outlines = [centred(0), centred(1)];
    let known = teeth.or(record.and_then(|r| r.teeth));
    let counted = |i: usize| {
        let gear = Side::BOTH[i];
        let (least, most) = policy::TEETH_BELIEVED;
        if let Some(count) = known.map(|t| t[i]).filter(|n| !(least..=most).contains(n)) {
            return Err(CheckError::TeethRange { gear, count, least, most });
        }
        teeth::teeth(&outlines[i], known.map(|t| t[i])).ok_or(CheckError::NoTeeth { gear })
    };
    let (first, second) = rayon::join(|| counted(0), || counted(1));
    let [driver, follower] = outlines;
    let mut teeth = [first?, second?];
    teeth::settle(&mut teeth);
    Ok(Pair::new(driver, follower, center_distance, teeth))
}

/// What is left between the gears at every angle, mm, if they cannot touch.
fn apart(pair: &Pair) -> Option<f64> {
    let reach = |o: &[Point]| o.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
    let gap = pair.center_distance - reach(&pair.driver) - reach(&pair.follower);
    (gap >= 0.0).then_some(gap)
}

/// The overlap at driver angle 0, of the follower turned where it is least.
fn overlap(pair: &Pair) -> Diagnostic {
    let depth = (0..OVERLAP_ANGLES)
        .map(|i| pair.depth(0.0, TAU * f64::from(i) / f64::from(OVERLAP_ANGLES)))
        .fold(f64::INFINITY, f64::min);
    Diagnostic::fault(Code::Overlap, StageName::Analysed).at_driver_angle(0.0).with("depth", depth)
}

/// Angles of the follower at which the overlap of a pair that does not fit is looked at.
const OVERLAP_ANGLES: u32 = 720;

/// Module by the length of both pitch curves over the teeth that roll by: twice the centre distance over the teeth of both
/// where the gears are round.
fn module_of(pair: &Pair, motion: &dyn Motion) -> f64 {
    let teeth = f64::from(pair.teeth[0].count) * motion.cycle() / TAU;
    let at = |i: u32| {
        let angle = motion.cycle() * f64::from(i) / f64::from(MODULE_POSES);
        let slope = motion.derivative(angle);
        let radius = pair.center_distance * slope / (1.0 + slope);
        Point::new(radius * angle.cos(), -radius * angle.sin())
    };
    let length: f64 = (0..MODULE_POSES).map(|i| (at(i + 1) - at(i)).norm()).sum();
    let module = length / (std::f64::consts::PI * teeth);
    if module.is_finite() && module > 0.0 { module } else { pair.module }
}

/// Chords in which the pitch curve is measured: 1e-7 of its length is lost.
const MODULE_POSES: u32 = 8192;

/// The motion that contact tells; round gears turn evenly.
fn derived(pair: &Pair, phase: Option<f64>) -> Result<Known, Untraced> {
    if pair.is_round() {
        let turns = pair.cycle_turns().min(pair.ratio().max(1.0).ceil() as u32);
        return Ok(Known::even(pair.ratio(), f64::from(turns), MotionSource::Teeth));
    }
    let traced = trace::traced(pair, phase)?;
    Ok(Known::sampled(traced.motion, Some(traced.phase), MotionSource::Contact))
}

fn judged(
    pair: &Pair,
    axes: [(Point, AxisSource); 2],
    known: &Known,
    (phase, phase_given): (f64, bool),
    options: &CheckOptions,
    mut notes: Vec<String>,
) -> Result<CheckReport, CheckError> {
    let follower: Vec<Point> =
        pair.follower.iter().map(|&p| crate::geometry::rotate(p, -phase)).collect();
    let input = ContactInput {
        driver: &pair.driver,
        follower: &follower,
        center_distance: pair.center_distance,
        module: pair.module,
        motion: &*known.motion,
        control: &options.control,
    };
    let analysis = analyse(&input, &options.contact)?;
    let teeth = [pair.teeth[0].count, pair.teeth[1].count];
    let found = judge_contact(&analysis, None, pair.module, teeth[0], &options.limits);
    let sound = Verdict::of(&found).is_sound();
    let mut runs = Vec::new();
    if sound {
        for run in &options.runs {
            let run = DynamicsOptions { cycles: policy::CHECK_CYCLES, ..*run };
            runs.push(simulate(&DynamicsInput { contact: input, driver_teeth: teeth[0] }, &run)?);
        }
    } else if !options.runs.is_empty() {
        notes.push("no rigid-body run was made, for contact alone shows the fault".to_owned());
    }
    if options.motion != MotionGiven::Unknown && (pair.ratio() - known.ratio()).abs() > 1e-3 {
        notes.push(format!(
            "the teeth counted ({} and {}) give a ratio of {:.4}, the motion {:.4}",
            teeth[0],
            teeth[1],
            pair.ratio(),
            known.ratio()
        ));
    }
    let report = judge(analysis, runs, pair.module, teeth[0], &options.limits);
    let samples = policy::CHECK_SAMPLES;
    let cycle = known.motion.cycle();
    let psi = |angle: f64| known.motion.psi(angle);
    let at = |i: usize| psi(cycle * i as f64 / samples as f64) - psi(0.0);
    Ok(CheckReport {
        diagnostics: report.diagnostics,
        axes,
        center_distance: pair.center_distance,
        teeth,
        module: module_of(pair, &*known.motion),
        phase,
        phase_given,
        ratio: known.ratio(),
        motion: known.source,
        driver_cycle: cycle,
        psi: (0..=samples).map(at).collect(),
        contact: Some(report.contact.summary),
        runs: report.runs,
        notes,
    })
}

/// A pair whose contact forces no motion that could be judged further.
fn unmoved(
    pair: &Pair,
    axes: [(Point, AxisSource); 2],
    reason: Untraced,
    phase: Option<f64>,
    mut notes: Vec<String>,
) -> CheckReport {
    let fault = |code| Diagnostic::fault(code, StageName::Analysed);
    let fault = match reason {
        Untraced::NoStart => fault(Code::NoContact),
        Untraced::Stopped { at } => fault(Code::Jam).at_driver_angle(at),
        Untraced::NotClosed { pitches } => fault(Code::SkippedTeeth).with("pitches", pitches),
    };
    notes.push("no motion could be derived from contact; --motion or --ratio gives one".to_owned());
    unjudged(pair, axes, fault, phase, notes)
}

/// A pair of which the first look shows that it does not mesh.
fn unjudged(
    pair: &Pair,
    axes: [(Point, AxisSource); 2],
    fault: Diagnostic,
    phase: Option<f64>,
    notes: Vec<String>,
) -> CheckReport {
    let [driver, follower] = pair.teeth.each_ref().map(|t| f64::from(t.count));
    let module = if pair.is_round() {
        2.0 * pair.center_distance / (driver + follower)
    } else {
        pair.module
    };
    CheckReport {
        diagnostics: vec![fault],
        axes,
        center_distance: pair.center_distance,
        teeth: [pair.teeth[0].count, pair.teeth[1].count],
        module,
        phase: phase.unwrap_or(0.0),
        phase_given: phase.is_some(),
        ratio: pair.ratio(),
        motion: MotionSource::Contact,
        driver_cycle: TAU * f64::from(pair.cycle_turns()),
        psi: Vec::new(),
        contact: None,
        runs: Vec::new(),
        notes,
    }
}

impl CheckReport {
    /// The outcome.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        Verdict::of(&self.diagnostics)
    }
}

/// The runs that are made by default: one forward, led.
#[must_use]
pub fn default_runs(options: &DynamicsOptions, both_ways: bool) -> Vec<DynamicsOptions> {
    let backward = DynamicsOptions { direction: Direction::Backward, ..*options };
    if both_ways { vec![*options, backward] } else { vec![*options] }
}

#[cfg(test)]
mod tests;
