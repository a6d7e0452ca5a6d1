//! `centrode check`: a verdict on any two gears, or on a table of pairs.

mod args;
mod batch;
mod junit;

use std::io::Write;
use std::path::Path;
use std::time::Instant;

use anyhow::{Context, bail};
use centrode::check::{
    CheckOptions, CheckReport, MotionGiven, check, default_runs, motion_from_columns,
};
use centrode::control::Control;
use centrode::diagnose::{Diagnostic, Limits, Severity, of_severity};
use centrode::gear::Pair;
use centrode::input::load_gears;
use centrode::meshing::{Direction, DynamicsOptions};
use serde::Serialize;

pub(crate) use args::CheckArgs;
use args::PairFacts;

use super::Outcome;
use super::files::{check_file, told_of};
use super::progress::Progress;

/// One pair of files to judge.
#[derive(Clone, Debug)]
struct Job {
    driver: String,
    follower: String,
    facts: PairFacts,
}

pub(crate) fn run(args: &CheckArgs) -> anyhow::Result<Outcome> {
    if let Some(path) = &args.junit {
        check_file(path).map_err(|e| told_of("--junit", e))?;
    }
    if let Some(table) = &args.batch {
        return batch::run(args, table);
    }
    let start = Instant::now();
    let job = job(args)?;
    let progress = Progress::new();
    let report = report_of(&job, args, &progress)?;
    progress.done();
    let seconds = start.elapsed().as_secs_f64();
    let text = if args.json { record(&report)? + "\n" } else { human(&report, seconds) };
    print(&text)?;
    let outcome = if report.verdict().is_sound() { Outcome::Good } else { Outcome::NotSound };
    if let Some(path) = &args.junit {
        let case = Case { driver: job.driver, follower: job.follower, seconds, made: Ok(report) };
        junit::write(path, &[case])?;
    }
    Ok(outcome)
}

/// The pair that stands on the command line.
fn job(args: &CheckArgs) -> anyhow::Result<Job> {
    let (Some(driver), Some(follower)) = (&args.driver, &args.follower) else {
        bail!("two gears are checked; name the driver and the follower, or a table with --batch");
    };
    let facts = args.facts.clone();
    Ok(Job { driver: driver.clone(), follower: follower.clone(), facts })
}

fn report_of(job: &Job, args: &CheckArgs, progress: &Progress) -> anyhow::Result<CheckReport> {
    let options = with_facts(args, &job.facts, progress.control())?;
    progress.doing("reading the gears");
    let sources = Pair::new(job.driver.as_str(), job.follower.as_str());
    let Pair { driver, follower } = load_gears(sources, args.join)?;
    progress.doing("checking the pair");
    Ok(check(&driver, &follower, &options)?)
}

fn print(text: &str) -> anyhow::Result<()> {
    std::io::stdout().lock().write_all(text.as_bytes()).context("cannot write to standard output")
}

/// One pair and what became of it.
#[derive(Debug)]
struct Case {
    driver: String,
    follower: String,
    seconds: f64,
    /// The report, or why the pair could not be judged.
    made: Result<CheckReport, String>,
}

impl Case {
    fn is_sound(&self) -> bool {
        self.made.as_ref().is_ok_and(|report| report.verdict().is_sound())
    }
}

/// Both gears as files, and how they are checked.
pub(super) fn plan(
    args: &CheckArgs,
    control: Control,
) -> anyhow::Result<([String; 2], CheckOptions)> {
    let job = job(args)?;
    let options = with_facts(args, &job.facts, control)?;
    Ok(([job.driver, job.follower], options))
}

/// As the library takes them.
fn with_facts(
    args: &CheckArgs,
    facts: &PairFacts,
    control: Control,
) -> anyhow::Result<CheckOptions> {
    let run = DynamicsOptions {
        load: args.load,
        rpm: args.rpm,
        friction: args.friction,
        thickness: args.thickness,
        ..DynamicsOptions::default()
    };
    Ok(CheckOptions {
        center_distance: facts.center_distance,
        axes: [facts.driver_axis, facts.follower_axis],
        teeth: facts.teeth,
        phase: facts.phase,
        motion: motion(facts)?,
        runs: if args.no_simulate { Vec::new() } else { default_runs(&run, args.both) },
        limits: limits(facts.limits.as_deref())?,
        control,
        ..CheckOptions::default()
    })
}

/// Where a pair fails; the defaults where no file is named.
fn limits(path: Option<&Path>) -> anyhow::Result<Limits> {
    let Some(path) = path else { return Ok(Limits::default()) };
    let read = || -> anyhow::Result<Limits> {
        let text = std::fs::read_to_string(path)
            .context("the limits cannot be read; give a TOML file such as `overlap = 0.02`")?;
        Limits::from_toml(&text)
            .map_err(|why| anyhow::anyhow!("{why}; docs/python.md lists the limits"))
    };
    read().with_context(|| path.display().to_string())
}

fn motion(facts: &PairFacts) -> anyhow::Result<MotionGiven> {
    if let Some(ratio) = facts.ratio {
        return Ok(MotionGiven::Ratio(ratio));
    }
    let Some(path) = &facts.motion else { return Ok(MotionGiven::Unknown) };
    let (driver, follower) = read_motion(path).with_context(|| path.display().to_string())?;
    Ok(MotionGiven::Sampled { driver, follower })
}

fn read_motion(path: &Path) -> anyhow::Result<(Vec<f64>, Vec<f64>)> {
    let length =
        std::fs::metadata(path).context("the motion cannot be read; check the path")?.len();
    let limit = centrode::policy::INPUT_BYTES;
    anyhow::ensure!(length <= limit, "the motion has more than {limit} bytes; give fewer samples");
    let text = std::fs::read_to_string(path)
        .context("the motion cannot be read; give a text file of two columns")?;
    Ok(motion_from_columns(&text)?)
}

fn human(report: &CheckReport, seconds: f64) -> String {
    let mut lines = vec![report.verdict().label().to_owned()];
    for fault in of_severity(&report.diagnostics, Severity::Fault) {
        lines.push(format!("  fault: {fault}"));
    }
    for warning in of_severity(&report.diagnostics, Severity::Warning) {
        lines.push(format!("  warning: {warning}"));
    }
    lines.push(format!(
        "teeth {} and {}, module {:.3} mm, axes {:.3} mm apart ({} and {})",
        report.teeth[0],
        report.teeth[1],
        report.module,
        report.center_distance,
        report.axes[0].1.name(),
        report.axes[1].1.name()
    ));
    lines.push(format!(
        "ratio {:.4} (motion from {}), follower turned {:.3} degrees clockwise{}",
        report.ratio,
        report.motion.name(),
        report.phase.to_degrees(),
        if report.phase_given { "" } else { " (found)" }
    ));
    if let Some(contact) = &report.contact {
        let swing = contact.transmission_error_pitch.map_or(f64::NAN, |e| 100.0 * e.peak_to_peak);
        let backlash = contact.min_backlash.map_or(f64::NAN, |w| w.value.to_degrees());
        let overlap = contact.max_interference.map_or(0.0, |w| w.value);
        lines.push(format!(
            "contact: {:.2} pairs of teeth, swing {swing:.2} % of a pitch, backlash at least {backlash:.3} degrees, overlap {overlap:.4} mm",
            contact.contact_ratio
        ));
    }
    for run in &report.runs {
        let s = &run.summary;
        lines.push(format!(
            "run {}: {} steps, {:.4} degrees RMS from contact, {:.0} % of the work arrives",
            if run.options.direction == Direction::Backward { "backward" } else { "forward" },
            run.steps.len(),
            s.tracking_rms.to_degrees(),
            100.0 * s.efficiency
        ));
    }
    for note in &report.notes {
        lines.push(format!("note: {note}"));
    }
    lines.push(format!("{seconds:.1} s"));
    lines.join("\n") + "\n"
}

/// What `--json` prints; keys are kept from version to version. Lengths mm, angles radians.
#[derive(Debug, Serialize)]
struct Record<'a> {
    verdict: &'static str,
    meshes: bool,
    faults: Vec<&'a Diagnostic>,
    warnings: Vec<&'a Diagnostic>,
    teeth: [u32; 2],
    module: f64,
    center_distance: f64,
    driver_axis: [f64; 2],
    follower_axis: [f64; 2],
    axis_source: [&'static str; 2],
    phase: f64,
    phase_given: bool,
    ratio: f64,
    motion_source: &'static str,
    driver_cycle: f64,
    driver_angle: Vec<f64>,
    follower_angle: &'a [f64],
    contact: Option<ContactRecord>,
    runs: Vec<RunRecord>,
    notes: &'a [String],
}

#[derive(Debug, Serialize)]
struct ContactRecord {
    contact_ratio: f64,
    transmission_error_peak_to_peak: Option<f64>,
    transmission_error_peak_to_peak_pitch: Option<f64>,
    min_backlash: Option<f64>,
    max_backlash: Option<f64>,
    lost_angle: f64,
    max_interference: f64,
    max_pressure_angle: Option<f64>,
}

#[derive(Debug, Serialize)]
struct RunRecord {
    direction: String,
    steps: usize,
    stopped: bool,
    tracking_rms: f64,
    tracking_worst: Option<f64>,
    swing_pitch: f64,
    torque_rms: f64,
    penetration: Option<f64>,
    net_turn_pitch: f64,
    efficiency: f64,
}

/// The verdict as JSON, without a line's end.
pub(super) fn record(report: &CheckReport) -> anyhow::Result<String> {
    let found = |severity| of_severity(&report.diagnostics, severity).collect();
    let intervals = report.psi.len().saturating_sub(1).max(1) as f64;
    let record = Record {
        verdict: report.verdict().label(),
        meshes: report.verdict().is_sound(),
        faults: found(Severity::Fault),
        warnings: found(Severity::Warning),
        teeth: report.teeth,
        module: report.module,
        center_distance: report.center_distance,
        driver_axis: [report.axes[0].0.x, report.axes[0].0.y],
        follower_axis: [report.axes[1].0.x, report.axes[1].0.y],
        axis_source: [report.axes[0].1.name(), report.axes[1].1.name()],
        phase: report.phase,
        phase_given: report.phase_given,
        ratio: report.ratio,
        motion_source: report.motion.name(),
        driver_cycle: report.driver_cycle,
        driver_angle: (0..report.psi.len())
            .map(|i| report.driver_cycle * i as f64 / intervals)
            .collect(),
        follower_angle: &report.psi,
        contact: report.contact.as_ref().map(|c| ContactRecord {
            contact_ratio: c.contact_ratio,
            transmission_error_peak_to_peak: c.transmission_error.map(|e| e.peak_to_peak),
            transmission_error_peak_to_peak_pitch: c
                .transmission_error_pitch
                .map(|e| e.peak_to_peak),
            min_backlash: c.min_backlash.map(|w| w.value),
            max_backlash: c.max_backlash.map(|w| w.value),
            lost_angle: c.lost_angle,
            max_interference: c.max_interference.map_or(0.0, |w| w.value),
            max_pressure_angle: c.max_pressure_angle.map(|w| w.value),
        }),
        runs: report
            .runs
            .iter()
            .map(|run| RunRecord {
                direction: format!("{:?}", run.options.direction).to_lowercase(),
                steps: run.steps.len(),
                stopped: run.stopped.is_some(),
                tracking_rms: run.summary.tracking_rms,
                tracking_worst: run.summary.tracking_worst.map(|w| w.value),
                swing_pitch: run.summary.swing,
                torque_rms: run.summary.torque_rms,
                penetration: run.summary.penetration.map(|w| w.value),
                net_turn_pitch: run.summary.net_turn,
                efficiency: run.summary.efficiency,
            })
            .collect(),
        notes: &report.notes,
    };
    Ok(serde_json::to_string(&record)?)
}
