//! What a person is told of the simulation of a pair, and the files that hold it.

use std::path::{Path, PathBuf};

use centrode::export::{ExportError, write_atomically};
use centrode::meshing::{
    Direction, Drive, Dynamics, DynamicsOptions, MeshingReport, proving_runs, write_csv,
};
use centrode::report::{ContactFrame, Plot, Section, contact_frames};

use super::args::RunArgs;

/// Tables of the measuring run and of that by motor.
pub(crate) const TABLES: [&str; 2] = ["simulation.csv", "simulation-motor.csv"];

/// Points of a curve on the page, at most.
const PLOT_POINTS: usize = 1500;

impl RunArgs {
    /// The runs asked for, of gears of `thickness` mm through `cycles` whole cycles.
    pub(crate) fn runs(&self, thickness: f64, cycles: f64) -> Vec<DynamicsOptions> {
        let options = DynamicsOptions {
            drive: self.motor_torque.map_or(Drive::Led, |limit| Drive::Motor(Some(limit))),
            load: self.load,
            rpm: self.rpm,
            friction: self.friction,
            density: self.density.unwrap_or(self.material),
            thickness,
            cycles,
            ..DynamicsOptions::default()
        };
        proving_runs(&options, self.both)
    }
}

/// Writes one table for each run into `folder`.
pub(crate) fn write_tables(
    folder: &Path,
    proof: &MeshingReport,
) -> Result<Vec<PathBuf>, ExportError> {
    let mut files = Vec::new();
    for run in &proof.runs {
        let path = folder.join(file_name(run));
        write_atomically(&path, |out| write_csv(run, out))?;
        files.push(path);
    }
    Ok(files)
}

/// The measuring run forward is plain `simulation.csv`; others say how they differ.
fn file_name(run: &Dynamics) -> String {
    let motor = if is_motor(run) { "-motor" } else { "" };
    let back = if run.options.direction == Direction::Backward { "-backward" } else { "" };
    format!("simulation{motor}{back}.csv")
}

fn is_motor(run: &Dynamics) -> bool {
    matches!(run.options.drive, Drive::Motor(_))
}

/// One line for each run.
pub(crate) fn lines(proof: &MeshingReport) -> Vec<String> {
    proof
        .runs
        .iter()
        .map(|run| {
            let s = &run.summary;
            format!(
                "simulated {}: swing {:.2} degrees ({:.1} % of a pitch), {:.4} degrees RMS from exact contact, torque up to {:.0} N mm, {:.1} % of the work arrives{}",
                title(run),
                s.swing_angle.to_degrees(),
                100.0 * s.swing,
                s.tracking_rms.to_degrees(),
                s.greatest_torque.map_or(0.0, |w| w.value),
                100.0 * s.efficiency,
                run.foretold.map_or(String::new(), |f| {
                    format!(" ({:.1} % by the contact alone)", 100.0 * f.efficiency)
                }),
            )
        })
        .collect()
}

fn title(run: &Dynamics) -> String {
    let way = if run.options.direction == Direction::Backward { "backward" } else { "forward" };
    if is_motor(run) {
        format!("by motor {way}, friction {:.2}", run.options.friction)
    } else {
        format!("led {way}, no friction")
    }
}

/// A table of numbers for each run.
pub(crate) fn sections(proof: &MeshingReport) -> Vec<Section> {
    let degrees = |v: f64| format!("{:.3}°", v.to_degrees());
    let at = |angle: f64| format!("at {:.1}° of driver turn", angle.to_degrees());
    proof
        .runs
        .iter()
        .map(|run| {
            let (s, o) = (&run.summary, &run.options);
            let placed = |w: Option<centrode::meshing::WorstPlace>,
                          text: &dyn Fn(f64) -> String| {
                w.map_or(("none".to_owned(), String::new()), |w| {
                    (text(w.value), at(w.driver_angle))
                })
            };
            let torque = placed(s.greatest_torque, &|v| format!("{v:.1} N mm"));
            let excess = placed(s.torque_excess, &|v| format!("{:.1} N mm", v * o.load));
            let free = placed(s.free_run, &|v| format!("{v:.3} of a pitch"));
            let pressed = placed(s.penetration, &|v| format!("{v:.4} mm"));
            let tracking = placed(s.tracking_worst, &degrees);
            Section::new(format!("Simulation, {}", title(run)))
                .row("Load on the follower", format!("{:.1} N mm", o.load))
                .row("Speed of the driver", format!("{:.1} rpm", o.rpm))
                .row("Steps", run.steps.len().to_string())
                .noted_row(
                    "Transmission error, peak to peak",
                    degrees(s.swing_angle),
                    format!(
                        "{:.1} % of a pitch; includes the play that clearance opens",
                        100.0 * s.swing
                    ),
                )
                .row("From the exact contact, RMS", degrees(s.tracking_rms))
                .noted_row("From the exact contact, worst", tracking.0, tracking.1)
                .noted_row("Greatest driver torque", torque.0, torque.1)
                .noted_row("Furthest from psi' times the load", excess.0, excess.1)
                .row("Pairs of teeth that carry load", format!("{:.2}", s.contact_ratio))
                .noted_row("Longest run without contact", free.0, free.1)
                .noted_row("Deepest press into the mate", pressed.0, pressed.1)
                .noted_row(
                    "Work that reaches the load",
                    format!("{:.1} %", 100.0 * s.efficiency),
                    run.foretold.map_or(String::new(), |f| {
                        format!("{:.1} % by the contact alone", 100.0 * f.efficiency)
                    }),
                )
        })
        .collect()
}

/// Transmission error and driver torque over the driver's angle, one curve for each run.
pub(crate) fn plots(proof: &MeshingReport) -> Vec<Plot> {
    let mut error = Plot::over_driver_angle("Simulated transmission error", "follower less psi, °");
    let mut torque = Plot::over_driver_angle("Simulated driver torque", "N mm");
    let curve = |run: &Dynamics, value: &dyn Fn(&centrode::meshing::Step) -> f64| {
        let stride = run.steps.len().div_ceil(PLOT_POINTS).max(1);
        // A motor may slip back for a moment; the page wants angles that do not.
        let mut last = f64::NEG_INFINITY;
        run.steps
            .iter()
            .step_by(stride)
            .map(|s| (s.driver_angle, value(s)))
            .filter(|p| {
                let rises = p.0 >= last;
                last = last.max(p.0);
                rises
            })
            .collect::<Vec<_>>()
    };
    for run in proof.runs.iter().filter(|r| r.options.direction == Direction::Forward) {
        let name = title(run);
        error = error.series(name.clone(), curve(run, &|s| s.transmission_error().to_degrees()));
        if !is_motor(run) {
            torque = torque.series("psi' times the load", curve(run, &|s| s.ideal_torque));
        }
        torque = torque.series(name, curve(run, &|s| s.windowed_torque));
    }
    vec![error, torque]
}

/// What the page draws on the turning gears: the contacts of the measuring run forward.
pub(crate) fn contacts(proof: &MeshingReport, driver_cycle: f64) -> Vec<ContactFrame> {
    let measured =
        proof.runs.iter().find(|r| !is_motor(r) && r.options.direction == Direction::Forward);
    measured.map(|run| contact_frames(run, driver_cycle)).unwrap_or_default()
}
