//! The one judge: findings from a contact analysis and from runs, by the same limits wherever a pair comes from.

use super::contact::{ContactAnalysis, ContactInput};
use super::dynamics::simulate;
use super::locking::{Foretold, foretell};
use super::run::{Direction, Drive, Dynamics, DynamicsError, DynamicsInput, DynamicsOptions, Stop};
use crate::control::StageName;
use crate::diagnose::{Code, Diagnostic, Limits, Severity, Verdict, once_each};
use crate::gear::Side;
use rayon::prelude::*;

/// What is known of a pair's meshing, in one place.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshingReport {
    /// What was found, each kind once.
    pub diagnostics: Vec<Diagnostic>,
    /// The contact analysis.
    pub contact: ContactAnalysis,
    /// The runs.
    pub runs: Vec<Dynamics>,
}

impl MeshingReport {
    /// The outcome.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        Verdict::of(&self.diagnostics)
    }
}

/// Joins contact analysis and runs. `module` in mm, `driver_teeth` on one turn.
#[must_use]
pub fn judge(
    contact: ContactAnalysis,
    mut runs: Vec<Dynamics>,
    module: f64,
    driver_teeth: u32,
    limits: &Limits,
) -> MeshingReport {
    let mut found = judge_contact(&contact, None, module, driver_teeth, limits);
    for run in &mut runs {
        let (forward, friction) =
            (run.options.direction == Direction::Forward, run.options.friction);
        if forward && friction > 0.0 {
            run.foretold = foretell(&contact, friction, Side::Driver);
        }
    }
    found.extend(runs.iter().flat_map(|run| judge_run(run, module, limits)));
    MeshingReport { diagnostics: once_each(found), contact, runs }
}

/// What a contact analysis shows. `exact` is that of the same teeth without clearance, where it is known: it tells lost
/// contact by wide gaps from lost contact by missing flanks. `module` in mm, `driver_teeth` on one turn.
#[must_use]
pub fn judge_contact(
    contact: &ContactAnalysis,
    exact: Option<&ContactAnalysis>,
    module: f64,
    driver_teeth: u32,
    limits: &Limits,
) -> Vec<Diagnostic> {
    let stage = StageName::Analysed;
    let mut found = Vec::new();
    let pitch = std::f64::consts::TAU / f64::from(driver_teeth.max(1));
    let summary = &contact.summary;
    let lost = |code: Code| {
        let fault = Diagnostic::fault(code, stage);
        match exact.map(|e| e.summary.lost_poses + e.summary.lost_poses_reversed) {
            None => fault,
            Some(count) => fault.with("exact", if count > 0 { 1.0 } else { 0.0 }),
        }
    };
    if summary.lost_poses == contact.poses.len() {
        found.push(Diagnostic::fault(Code::NoContact, stage));
    } else if let Some(arc) = summary.lost.first() {
        let mut finding =
            lost(Code::ContactLost).at_driver_angle(arc.from).with("angle", summary.lost_angle);
        let longest = summary.lost.iter().map(|a| a.to - a.from).fold(0.0, f64::max);
        if longest <= limits.lost_arc * pitch {
            finding.severity = Severity::Warning;
        }
        found.push(finding);
    } else if limits.made.is_some() && summary.lost_poses_reversed > 0 {
        found.push(lost(Code::ContactLostBackward));
    }
    if let Some(worst) = summary.max_interference
        && worst.value > limits.overlap * module
    {
        let fault = Diagnostic::fault(Code::Overlap, stage);
        found.push(fault.at_driver_angle(worst.driver_angle).with("depth", worst.value));
    }
    if let Some(made) = limits.made {
        let error = exact.unwrap_or(contact).summary.transmission_error_pitch;
        let error = error.map_or(f64::INFINITY, |e| e.p99_deviation);
        found.extend(graded(error, made.tooth_error, made.noted_tooth_error, |_| {
            Diagnostic::fault(Code::ToothError, stage).with("pitches", error)
        }));
        let held = contact.poses.iter().filter(|p| !p.lost && !p.lost_reversed);
        let widest = held
            .map(|p| ((p.play_behind + p.play_ahead) / p.pitch_angle, p.driver_angle))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((share, at)) = widest {
            found.extend(graded(share, made.backlash, made.noted_backlash, |limit| {
                let fault = Diagnostic::fault(Code::Backlash, stage).at_driver_angle(at);
                fault.with("pitches", share).with("limit", limit)
            }));
        }
        if let Some(worst) = summary.max_pressure_angle
            && worst.value > made.pressure_angle
        {
            let warning = Diagnostic::warning(Code::PressureAngle, stage);
            found.push(warning.at_driver_angle(worst.driver_angle).with("angle", worst.value));
        }
        found.extend(foretell(contact, made.friction, Side::Driver).and_then(|f| locks(&f)));
    }
    if let (Some(angle), Some(share)) =
        (summary.transmission_error, summary.transmission_error_pitch)
    {
        found.extend(transmission_error(stage, angle.peak_to_peak, share.peak_to_peak, limits));
    }
    found
}

/// What one run shows. `module` in mm.
#[must_use]
pub fn judge_run(run: &Dynamics, module: f64, limits: &Limits) -> Vec<Diagnostic> {
    let stage = StageName::Proven;
    let fault = |code, at| Diagnostic::fault(code, stage).at_driver_angle(at);
    let warning = |code, at| Diagnostic::warning(code, stage).at_driver_angle(at);
    let mut found = Vec::new();
    let s = &run.summary;
    // NaN compares false with every limit, so test for it first.
    let figures =
        [s.tracking_rms, s.swing, s.torque_rms, s.net_turn, s.contact_ratio, s.efficiency];
    if run.stopped.is_none() && !figures.iter().all(|v| v.is_finite()) {
        let at = run.steps.first().map_or(0.0, |step| step.driver_angle);
        found.push(fault(Code::FlungApart, at));
    }
    found.extend(run.foretold.as_ref().and_then(locks));
    match run.stopped {
        Some(Stop::Stalled { driver_angle }) => found.push(fault(Code::Jam, driver_angle)),
        Some(Stop::Diverged { driver_angle }) => found.push(fault(Code::FlungApart, driver_angle)),
        Some(Stop::TooLong { driver_angle }) => found.push(warning(Code::CutShort, driver_angle)),
        None => {}
    }
    if let Some(w) = s.free_run {
        found.extend(graded(w.value, limits.free_run, limits.noted_free_run, |limit| {
            fault(Code::FreeRun, w.driver_angle).with("pitches", w.value).with("limit", limit)
        }));
    }
    let depth = limits.penetration * module;
    if let Some(w) = s.penetration
        && w.value > depth
    {
        let pressed = fault(Code::Penetration, w.driver_angle);
        found.push(pressed.with("depth", w.value).with("limit", depth));
    }
    if s.net_turn.abs() > limits.net_turn {
        let slipped = Diagnostic::fault(Code::SkippedTeeth, stage);
        found.push(slipped.with("pitches", s.net_turn).with("limit", limits.net_turn));
    }
    if let Some(w) = s.tracking_worst
        && w.value.abs() > limits.tracking
    {
        let off = fault(Code::OffContact, w.driver_angle);
        found.push(off.with("angle", w.value.abs()).with("limit", limits.tracking));
    }
    found.extend(transmission_error(stage, s.swing_angle, s.swing, limits));
    if let Some(w) = s.torque_excess
        && w.value.abs() > limits.torque_excess
    {
        // With friction binding is told by the motor.
        let grade =
            if run.options.friction == 0.0 { Diagnostic::fault } else { Diagnostic::warning };
        let torque = grade(Code::Torque, stage).at_driver_angle(w.driver_angle);
        found.push(torque.with("loads", w.value).with("limit", limits.torque_excess));
    }
    if run.stopped.is_none() && s.efficiency < limits.efficiency {
        let losses = Diagnostic::warning(Code::Efficiency, stage);
        found.push(losses.with("share", s.efficiency).with("limit", limits.efficiency));
    }
    found
}

/// The finding of a pair that locks itself by friction.
fn locks(foretold: &Foretold) -> Option<Diagnostic> {
    foretold.locks().then(|| {
        Diagnostic::warning(Code::SelfLocking, StageName::Analysed)
            .at_driver_angle(foretold.least.driver_angle)
            .with("friction", foretold.friction)
    })
}

/// Transmission error peak to peak, radians and local pitches, wherever it was measured.
fn transmission_error(
    stage: StageName,
    angle: f64,
    pitches: f64,
    limits: &Limits,
) -> Option<Diagnostic> {
    graded(pitches, limits.transmission_error, limits.noted_transmission_error, |limit| {
        let fault = Diagnostic::fault(Code::TransmissionError, stage);
        fault.with("angle", angle).with("pitches", pitches).with("limit", limit)
    })
}

/// The finding (made for the limit that is passed) as a fault above `fails`, as a warning above `warns`.
fn graded(
    value: f64,
    fails: f64,
    warns: f64,
    made: impl FnOnce(f64) -> Diagnostic,
) -> Option<Diagnostic> {
    if value > fails {
        Some(made(fails))
    } else if value > warns {
        let mut warning = made(warns);
        warning.severity = Severity::Warning;
        Some(warning)
    } else {
        None
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
