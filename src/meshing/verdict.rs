//! One verdict from the contact analysis and the runs.

use super::contact::{ContactAnalysis, ContactInput};
use super::dynamics::{
    Direction, Drive, Dynamics, DynamicsError, DynamicsInput, DynamicsOptions, Stop, simulate,
};
use crate::policy;
use rayon::prelude::*;
use std::fmt;

/// Where a pair fails, and where it deserves a warning. Defaults and their reasons in [`policy`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Longest run without contact, driver pitches: fails.
    pub free_run: f64,
    /// The same: warns.
    pub noted_free_run: f64,
    /// Windowed torque off psi' tau, in loads, of a run without friction: fails. With friction it
    /// warns, for binding is then told by the motor.
    pub torque_excess: f64,
    /// Penetration in modules: fails.
    pub penetration: f64,
    /// Net turn off psi, follower pitches: fails.
    pub net_turn: f64,
    /// Distance of a led follower from the exact contact, radians: fails.
    pub tracking: f64,
    /// Transmission error peak to peak against psi, local pitches: fails.
    pub swing: f64,
    /// The same: warns.
    pub noted_swing: f64,
    /// Driver pitches without contact in the contact analysis: fails.
    pub lost_arc: f64,
    /// Overlap at the designed pose, modules: fails.
    pub overlap: f64,
    /// Efficiency: warns below.
    pub efficiency: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            free_run: policy::WORST_FREE_RUN,
            noted_free_run: policy::NOTED_FREE_RUN,
            torque_excess: policy::WORST_TORQUE_EXCESS,
            penetration: policy::WORST_PENETRATION,
            net_turn: policy::WORST_NET_TURN,
            tracking: policy::WORST_TRACKING,
            swing: policy::WORST_SWING,
            noted_swing: policy::NOTED_SWING,
            lost_arc: policy::WORST_LOST_ARC,
            overlap: policy::WORST_OVERLAP,
            efficiency: policy::NOTED_EFFICIENCY,
        }
    }
}

/// The outcome.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// The pair meshes.
    Meshes,
    /// It meshes; something deserves attention.
    MeshesWithWarnings,
    /// It does not mesh.
    DoesNotMesh,
}

impl Verdict {
    /// A few plain words.
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Self::Meshes => "meshes",
            Self::MeshesWithWarnings => "meshes with warnings",
            Self::DoesNotMesh => "does not mesh",
        }
    }
}

/// Why a pair fails or deserves a warning. Angles are driver angles in radians; its sentence is
/// its [`fmt::Display`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "the fields repeat the names explained at the variants")]
pub enum Reason {
    /// The motor stalled.
    Jam { at: f64 },
    /// The bodies were flung apart.
    FlungApart { at: f64 },
    /// Contact is lost over `angle` radians in all, first at `at`.
    ContactLost { at: f64, angle: f64 },
    /// The gears never touch.
    NoContact,
    /// The outlines overlap by `depth` mm at the designed pose.
    Overlap { at: f64, depth: f64 },
    /// The driver runs free for `pitches` of its pitches from `at` on.
    FreeRun { at: f64, pitches: f64, limit: f64 },
    /// The gears are pressed `depth` mm into each other.
    Penetration { at: f64, depth: f64, limit: f64 },
    /// The follower gained or lost `pitches` of its pitches.
    Slipped { pitches: f64 },
    /// The follower left the exact contact by `angle` radians.
    LeftContact { at: f64, angle: f64, limit: f64 },
    /// Transmission error peak to peak against psi, radians and local pitches.
    Swing { angle: f64, pitches: f64, limit: f64 },
    /// The windowed torque is off by `loads` load torques.
    Torque { at: f64, loads: f64, limit: f64 },
    /// Only `share` of the work arrives.
    Losses { share: f64, limit: f64 },
    /// The run was cut short after the greatest number of steps, at this angle.
    CutShort { at: f64 },
}

impl Reason {
    /// Driver angle where it happens, radians, if it happens at one place.
    #[must_use]
    pub fn driver_angle(&self) -> Option<f64> {
        match *self {
            Self::Jam { at }
            | Self::FlungApart { at }
            | Self::ContactLost { at, .. }
            | Self::Overlap { at, .. }
            | Self::FreeRun { at, .. }
            | Self::Penetration { at, .. }
            | Self::LeftContact { at, .. }
            | Self::Torque { at, .. }
            | Self::CutShort { at } => Some(at),
            Self::NoContact | Self::Slipped { .. } | Self::Swing { .. } | Self::Losses { .. } => {
                None
            }
        }
    }

    /// A stable word for programs.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Jam { .. } => "jam",
            Self::FlungApart { .. } => "flung_apart",
            Self::ContactLost { .. } => "contact_lost",
            Self::NoContact => "no_contact",
            Self::Overlap { .. } => "overlap",
            Self::FreeRun { .. } => "free_run",
            Self::Penetration { .. } => "penetration",
            Self::Slipped { .. } => "slipped",
            Self::LeftContact { .. } => "left_contact",
            Self::Swing { .. } => "swing",
            Self::Torque { .. } => "torque",
            Self::Losses { .. } => "losses",
            Self::CutShort { .. } => "cut_short",
        }
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Angles within one turn, as a person would find them on the gear.
        let place = |at: &f64| at.to_degrees().rem_euclid(360.0);
        match self {
            Self::Jam { at } => write!(
                f,
                "the gears jam at {:.0} degrees: a motor of several times the torque does not turn them on; give more clearance",
                place(at)
            ),
            Self::FlungApart { at } => write!(
                f,
                "the gears are flung apart at {:.0} degrees; check that they do not overlap there",
                place(at)
            ),
            Self::ContactLost { at, angle } => write!(
                f,
                "contact is lost over {:.1} degrees, first at {:.0} degrees; add the missing flanks or bring the axes closer",
                angle.to_degrees(),
                place(at)
            ),
            Self::NoContact => write!(f, "the gears never touch; bring the axes closer"),
            Self::Overlap { at, depth } => write!(
                f,
                "the outlines overlap by {depth:.3} mm at {:.0} degrees; give more clearance or a larger centre distance",
                place(at)
            ),
            Self::FreeRun { at, pitches, limit } => write!(
                f,
                "the driver runs free for {pitches:.2} of a pitch at {:.0} degrees (limit {limit:.2}); reduce clearance, speed or the follower's mass",
                place(at)
            ),
            Self::Penetration { at, depth, limit } => write!(
                f,
                "the gears are pressed {depth:.3} mm into each other at {:.0} degrees (limit {limit:.3}): they would jam; give more clearance",
                place(at)
            ),
            Self::Slipped { pitches } => write!(
                f,
                "the follower ends {pitches:.1} pitches from where it should be; it skips teeth, check tooth counts and centre distance"
            ),
            Self::LeftContact { at, angle, limit } => write!(
                f,
                "the follower is {:.2} degrees from where the flanks touch at {:.0} degrees (limit {:.2}); look for teeth that are missing, doubled or in the way",
                angle.abs().to_degrees(),
                place(at),
                limit.to_degrees()
            ),
            Self::Swing { angle, pitches, limit } => write!(
                f,
                "transmission error {:.2} degrees peak to peak, {:.1} % of a pitch (limit {:.0} %); reduce clearance or lean, or try another number of teeth",
                angle.to_degrees(),
                100.0 * pitches,
                100.0 * limit
            ),
            Self::Torque { at, loads, limit } => write!(
                f,
                "the driver's torque is {loads:+.2} loads off its ideal at {:.0} degrees (limit {limit:.2}); reduce friction or lean",
                place(at)
            ),
            Self::Losses { share, limit } => write!(
                f,
                "only {:.0} % of the work arrives (limit {:.0} %); reduce friction or lean",
                100.0 * share,
                100.0 * limit
            ),
            Self::CutShort { at } => write!(
                f,
                "the run was cut short at {:.0} degrees, after as many steps as are allowed; simulate fewer cycles",
                at.to_degrees()
            ),
        }
    }
}

/// What is known of a pair's meshing, in one place.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshingReport {
    /// The outcome.
    pub verdict: Verdict,
    /// Why it fails; empty unless it does.
    pub faults: Vec<Reason>,
    /// What deserves attention.
    pub warnings: Vec<Reason>,
    /// The contact analysis.
    pub contact: ContactAnalysis,
    /// The runs.
    pub runs: Vec<Dynamics>,
}

/// Joins contact analysis and runs. `module` in mm, `driver_teeth` on one turn.
#[must_use]
pub fn judge(
    contact: ContactAnalysis,
    runs: Vec<Dynamics>,
    module: f64,
    driver_teeth: u32,
    limits: &Limits,
) -> MeshingReport {
    let mut faults = Vec::new();
    let mut warnings = Vec::new();
    let pitch = std::f64::consts::TAU / f64::from(driver_teeth.max(1));
    let summary = &contact.summary;
    if summary.lost_poses == contact.poses.len() {
        faults.push(Reason::NoContact);
    } else if let Some(arc) = summary.lost.first() {
        let reason = Reason::ContactLost { at: arc.from, angle: summary.lost_angle };
        let longest = summary.lost.iter().map(|a| a.to - a.from).fold(0.0, f64::max);
        if longest > limits.lost_arc * pitch { &mut faults } else { &mut warnings }.push(reason);
    }
    if let Some(worst) = summary.max_interference
        && worst.value > limits.overlap * module
    {
        faults.push(Reason::Overlap { at: worst.driver_angle, depth: worst.value });
    }
    for run in &runs {
        judge_run(run, module, limits, &mut faults, &mut warnings);
    }
    once_each(&mut faults);
    once_each(&mut warnings);
    warnings.retain(|w| !faults.iter().any(|f| f.name() == w.name()));
    let verdict = match (faults.is_empty(), warnings.is_empty()) {
        (false, _) => Verdict::DoesNotMesh,
        (true, false) => Verdict::MeshesWithWarnings,
        (true, true) => Verdict::Meshes,
    };
    MeshingReport { verdict, faults, warnings, contact, runs }
}

/// Keeps the first of each kind: runs that fail alike are told once.
fn once_each(reasons: &mut Vec<Reason>) {
    let mut told: Vec<&'static str> = Vec::new();
    reasons.retain(|r| {
        let new = !told.contains(&r.name());
        told.push(r.name());
        new
    });
}

fn judge_run(
    run: &Dynamics,
    module: f64,
    limits: &Limits,
    faults: &mut Vec<Reason>,
    warnings: &mut Vec<Reason>,
) {
    let s = &run.summary;
    // A figure that is no number passes every limit.
    let figures =
        [s.tracking_rms, s.swing, s.torque_rms, s.net_turn, s.contact_ratio, s.efficiency];
    if run.stopped.is_none() && !figures.iter().all(|v| v.is_finite()) {
        let at = run.steps.first().map_or(0.0, |step| step.driver_angle);
        faults.push(Reason::FlungApart { at });
    }
    match run.stopped {
        Some(Stop::Stalled { driver_angle }) => faults.push(Reason::Jam { at: driver_angle }),
        Some(Stop::Diverged { driver_angle }) => {
            faults.push(Reason::FlungApart { at: driver_angle });
        }
        Some(Stop::TooLong { driver_angle }) => {
            warnings.push(Reason::CutShort { at: driver_angle });
        }
        None => {}
    }
    if let Some(w) = s.free_run {
        let reason = |limit| Reason::FreeRun { at: w.driver_angle, pitches: w.value, limit };
        if w.value > limits.free_run {
            faults.push(reason(limits.free_run));
        } else if w.value > limits.noted_free_run {
            warnings.push(reason(limits.noted_free_run));
        }
    }
    if let Some(w) = s.penetration
        && w.value > limits.penetration * module
    {
        let limit = limits.penetration * module;
        faults.push(Reason::Penetration { at: w.driver_angle, depth: w.value, limit });
    }
    if s.net_turn.abs() > limits.net_turn {
        faults.push(Reason::Slipped { pitches: s.net_turn });
    }
    if let Some(w) = s.tracking_worst
        && w.value.abs() > limits.tracking
    {
        let limit = limits.tracking;
        faults.push(Reason::LeftContact { at: w.driver_angle, angle: w.value, limit });
    }
    let swing = |limit| Reason::Swing { angle: s.swing_angle, pitches: s.swing, limit };
    if s.swing > limits.swing {
        faults.push(swing(limits.swing));
    } else if s.swing > limits.noted_swing {
        warnings.push(swing(limits.noted_swing));
    }
    if let Some(w) = s.torque_excess
        && w.value.abs() > limits.torque_excess
    {
        let limit = limits.torque_excess;
        let reason = Reason::Torque { at: w.driver_angle, loads: w.value, limit };
        if run.options.friction == 0.0 { faults } else { &mut *warnings }.push(reason);
    }
    if run.stopped.is_none() && s.efficiency < limits.efficiency {
        warnings.push(Reason::Losses { share: s.efficiency, limit: limits.efficiency });
    }
}

/// Runs a pair in every way given and judges it together with its contact analysis.
///
/// The runs are independent of one another and are made side by side; their order is kept.
///
/// # Errors
/// See [`DynamicsError`].
pub fn prove(
    input: &DynamicsInput<'_>,
    contact: ContactAnalysis,
    runs: &[DynamicsOptions],
    limits: &Limits,
) -> Result<MeshingReport, DynamicsError> {
    let control = input.contact.control;
    let parts = control.split(runs.len());
    let made: Result<Vec<Dynamics>, DynamicsError> = control.run(|| {
        runs.par_iter()
            .zip(&parts)
            .map(|(options, control)| {
                let contact = ContactInput { control, ..input.contact };
                simulate(&DynamicsInput { contact, ..*input }, options)
            })
            .collect()
    });
    Ok(judge(contact, made?, input.contact.module, input.driver_teeth, limits))
}

/// The runs that prove a pair: for each sense of rotation one that measures, led and without friction,
/// and one that looks for jams, by motor and with the friction given.
#[must_use]
pub fn proving_runs(options: &DynamicsOptions, both_ways: bool) -> Vec<DynamicsOptions> {
    let senses: &[Direction] =
        if both_ways { &[Direction::Forward, Direction::Backward] } else { &[Direction::Forward] };
    let motor = match options.drive {
        Drive::Led => Drive::Motor(None),
        motor => motor,
    };
    senses
        .iter()
        .flat_map(|&direction| {
            [
                DynamicsOptions { drive: Drive::Led, friction: 0.0, direction, ..*options },
                DynamicsOptions { drive: motor, direction, ..*options },
            ]
        })
        .collect()
}
