//! What is told of rigid-body runs: lines, tables, plots, contacts on the page.

use crate::meshing::{Direction, Drive, Dynamics, MeshingReport};
use crate::report::{ContactFrame, Plot, Section, contact_frames};

/// Tables of the measuring run and of that by motor.
pub const RUN_TABLES: [&str; 2] = ["simulation.csv", "simulation-motor.csv"];

/// Points of a curve on the page, at most.
const PLOT_POINTS: usize = 1500;

/// Name of a run's table: that of the measuring run forward is plain `simulation.csv`; others say how they differ.
#[must_use]
pub fn table_name(run: &Dynamics) -> String {
    let motor = if is_motor(run) { "-motor" } else { "" };
    let back = if run.options.direction == Direction::Backward { "-backward" } else { "" };
    format!("simulation{motor}{back}.csv")
}

fn is_motor(run: &Dynamics) -> bool {
    matches!(run.options.drive, Drive::Motor(_))
}

/// One line for each run.
#[must_use]
pub fn lines(proof: &MeshingReport) -> Vec<String> {
    proof
        .runs
        .iter()
        .map(|run| {
            let s = &run.summary;
            format!(
                "simulated {}: transmission error {:.2} degrees peak to peak ({:.1} % of a pitch), {:.4} degrees RMS from exact contact, torque up to {:.0} N mm, efficiency {:.1} %{}",
                title(run),
                s.swing_angle.to_degrees(),
                100.0 * s.swing,
                s.tracking_rms.to_degrees(),
                s.greatest_torque.map_or(0.0, |w| w.value),
                100.0 * s.efficiency,
                run.foretold.map_or(String::new(), |f| {
                    format!(" ({:.1} % by contact analysis)", 100.0 * f.efficiency)
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
        format!("driven at constant speed {way}, no friction")
    }
}

/// A table of numbers for each run.
#[must_use]
pub fn sections(proof: &MeshingReport) -> Vec<Section> {
    let degrees = |v: f64| format!("{:.3}°", v.to_degrees());
    let at = |angle: f64| format!("at {:.1}° of driver turn", angle.to_degrees());
    proof
        .runs
        .iter()
        .map(|run| {
            let (s, o) = (&run.summary, &run.options);
            let placed = |w: Option<crate::meshing::WorstPlace>, text: &dyn Fn(f64) -> String| {
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
                    format!("{:.1} % of a pitch; includes the backlash", 100.0 * s.swing),
                )
                .row("From the exact contact, RMS", degrees(s.tracking_rms))
                .noted_row("From the exact contact, worst", tracking.0, tracking.1)
                .noted_row("Greatest driver torque", torque.0, torque.1)
                .noted_row("Greatest torque beyond psi' times the load", excess.0, excess.1)
                .row("Contact ratio", format!("{:.2}", s.contact_ratio))
                .noted_row("Longest loss of contact", free.0, free.1)
                .noted_row("Greatest penetration", pressed.0, pressed.1)
                .noted_row(
                    "Efficiency",
                    format!("{:.1} %", 100.0 * s.efficiency),
                    run.foretold.map_or(String::new(), |f| {
                        format!("{:.1} % by contact analysis", 100.0 * f.efficiency)
                    }),
                )
        })
        .collect()
}

/// Transmission error and driver torque over the driver's angle, one curve for each run.
#[must_use]
pub fn plots(proof: &MeshingReport) -> Vec<Plot> {
    let mut error = Plot::over_driver_angle("Simulated transmission error", "follower less psi, °");
    let mut torque = Plot::over_driver_angle("Simulated driver torque", "N mm");
    let curve = |run: &Dynamics, value: &dyn Fn(&crate::meshing::Step) -> f64| {
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
#[must_use]
pub fn contacts(proof: &MeshingReport, driver_cycle: f64) -> Vec<ContactFrame> {
    let measured =
        proof.runs.iter().find(|r| !is_motor(r) && r.options.direction == Direction::Forward);
    measured.map(|run| contact_frames(run, driver_cycle)).unwrap_or_default()
}
