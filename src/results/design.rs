//! What is told of a design: a few lines for a person, figures for programs, and the page.

use serde_json::{Value, json};

use crate::diagnose::{Severity, Verdict, of_severity};
use crate::gear::{Motion, Side};
use crate::meshing::ContactPose;
use crate::pipeline::{BoreChoice, Design};
use crate::report::{Plot, ReportData, Section};
use crate::schema::run_record;
use crate::solid::{PrintFinding, print_findings};

/// Samples of a curve on the page.
const PLOT_SAMPLES: usize = 721;

/// The figures of a design for programs.
#[must_use]
pub fn design_figures(made: &Design) -> Value {
    let objective = made.objective();
    let contact = &made.contact.summary;
    let error = made.exact_contact.summary.transmission_error_pitch.as_ref();
    let mut value = json!({
        "verdict": made.verdict(),
        "faults": made.told(Severity::Fault),
        "warnings": made.told(Severity::Warning),
        "steps": made.told(Severity::Note),
        "diagnostics": made.diagnostics,
        "teeth": made.teeth,
        "module": made.pair.module,
        "center_distance": made.centrodes.center_distance,
        "transmission_error_p99": error.map(|e| e.p99_deviation),
        "lost_poses": contact.lost_poses,
        "weakest_tooth_stress": made.strength.weakest().map(|t| t.stress),
        "efficiency": made.strength.efficiency,
        "contact_ratio": contact.contact_ratio,
        "bore": bore(made),
        "printing": printing(made).iter().map(ToString::to_string).collect::<Vec<_>>(),
        "simulation": made.proof.as_ref().map(|p| p.runs.iter().map(run_record).collect::<Vec<_>>()),
    });
    if let Some(objective) = objective {
        value["objective"] = json!({
            "E": objective.shape + objective.weight * objective.torque,
            "shape": objective.shape,
            "torque": objective.torque,
            "weight": objective.weight,
            "limiting_cost": objective.limiting_cost,
            "folding_cost": objective.folding_cost,
            "lost_cost": objective.lost_cost,
            "total": objective.total,
        });
    }
    if made.likeness.iter().any(Option::is_some) {
        value["resemblance"] = json!(made.likeness);
        value["lost_area"] = json!(made.drawings.map(|d| d.map(|d| d.lost_area)));
    }
    value["max_derivative"] = json!(made.centrodes.transmission.max_derivative());
    if let Some(refinement) = made.fit.as_ref().and_then(|f| f.refinement) {
        value["refinement"] = json!([refinement.before, refinement.after]);
    }
    value
}

/// A few lines for a person.
#[must_use]
pub fn design_lines(made: &Design) -> Vec<String> {
    let objective = made.objective();
    let contact = &made.contact.summary;
    let error = made.exact_contact.summary.transmission_error_pitch.as_ref();
    let mut lines = Vec::new();
    let mut say = |line: String| lines.push(line);
    say(format!(
        "{} and {}: {} and {} teeth, module {:.3} mm, axes {:.2} mm apart",
        made.names[0],
        made.names[1],
        made.teeth[0],
        made.teeth[1],
        made.pair.module,
        made.centrodes.center_distance
    ));
    let torque = made.centrodes.transmission.max_derivative();
    match (made.likeness, objective) {
        ([Some(driver), Some(follower)], Some(objective)) => say(format!(
            "likeness {:.1} % and {:.1} %, E {:.3} (shape {:.3}, torque up to {torque:.2} times the load)",
            100.0 * driver,
            100.0 * follower,
            objective.shape + objective.weight * objective.torque,
            objective.shape,
        )),
        (likeness, _) => {
            for (share, name) in likeness.iter().zip(Side::BOTH) {
                if let Some(share) = share {
                    say(format!("likeness of the {name} {:.1} %", 100.0 * share));
                }
            }
            say(format!(
                "psi' {:.3} to {torque:.3}, slope of the pitch curves up to {:.1} degrees",
                made.centrodes.transmission.min_derivative(),
                made.centrodes.max_lean().to_degrees()
            ));
        }
    }
    if let Some(error) = error {
        say(format!(
            "contact ratio {:.2}, transmission error {:.3} % of a pitch (99th percentile), contact lost at {} of {} poses",
            contact.contact_ratio,
            100.0 * error.p99_deviation,
            contact.lost_poses,
            made.contact.poses.len()
        ));
    }
    if let Some(tooth) = made.strength.weakest() {
        say(format!(
            "weakest tooth: number {} of the {}, {:.2} MPa by Lewis's formula under {:.0} N mm",
            tooth.index, tooth.side, tooth.stress, made.strength.load.torque
        ));
    }
    if let Some(bore) = bore(made) {
        say(format!("bore {bore}"));
    }
    for finding in printing(made) {
        say(format!("printing: {finding}"));
    }
    for line in made.proof.iter().flat_map(super::run_lines) {
        say(line);
    }
    let words =
        [(Severity::Note, "step"), (Severity::Warning, "warning"), (Severity::Fault, "not sound")];
    for (severity, word) in words {
        for found in of_severity(&made.diagnostics, severity) {
            say(format!("{word}: {found}"));
        }
    }
    lines
}

/// What the printer's nozzle cannot draw.
fn printing(made: &Design) -> Vec<PrintFinding> {
    let options = &made.options;
    print_findings(&made.assembly, made.pair.module, options.clearance, options.outfit.nozzle)
}

/// What a bore asked for by name is like.
fn bore(made: &Design) -> Option<String> {
    match made.options.bore {
        BoreChoice::Named(name) => Some(name.told(made.options.outfit.fit)),
        _ => None,
    }
}

/// The page of a design: text and plots. `command` makes it again.
#[must_use]
pub fn design_page(made: &Design, command: String) -> ReportData {
    let verdict = made.verdict();
    let summary = match verdict {
        Verdict::Good => {
            "Contact is never lost and nothing overlaps through the whole cycle.".to_owned()
        }
        Verdict::Warnings => super::in_sentences(&made.told(Severity::Warning)),
        Verdict::Unsound => super::in_sentences(&made.told(Severity::Fault)),
    };
    ReportData {
        title: format!("{} and {}", made.names[0], made.names[1]),
        command,
        made_by: concat!("centrode ", env!("CARGO_PKG_VERSION")).to_owned(),
        verdict,
        summary,
        sections: sections(made)
            .into_iter()
            .chain(made.proof.iter().flat_map(super::run_sections))
            .collect(),
        plots: plots(made)
            .into_iter()
            .chain(made.proof.iter().filter(|_| !made.assembly.swings()).flat_map(super::run_plots))
            .collect(),
        // Those of sectors are known for the whole gears only.
        contacts: made
            .proof
            .as_ref()
            .filter(|_| !made.assembly.swings())
            .map(|p| {
                super::run_contacts(
                    p,
                    made.assembly.driver_angle.last().copied().unwrap_or_default(),
                )
            })
            .unwrap_or_default(),
        notes: made.diagnostics.iter().map(Into::into).collect(),
    }
}

fn sections(made: &Design) -> Vec<Section> {
    let objective = made.objective();
    let contact = &made.contact.summary;
    let transmission = &made.centrodes.transmission;
    let percent = |v: f64| format!("{:.1} %", 100.0 * v);
    let degrees = |v: f64| format!("{:.2}°", v.to_degrees());
    let mut gears = Section::new("Gears")
        .row("Teeth", format!("{} and {}", made.teeth[0], made.teeth[1]))
        .row("Module", format!("{:.3} mm", made.pair.module))
        .row("Centre distance", format!("{:.3} mm", made.centrodes.center_distance))
        .row("Thickness", format!("{:.2} mm", made.assembly.thickness))
        .noted_row(
            "Clearance",
            format!("{:.3} mm", made.options.clearance),
            "of each gear, along the normal of its flanks",
        );
    if let Some(bore) = bore(made) {
        gears = gears.row("Bore", bore);
    }
    if let (Some(least), Some(most)) = (&contact.min_backlash, &contact.max_backlash) {
        gears = gears.noted_row(
            "Angular backlash",
            format!("{} to {}", degrees(least.value), degrees(most.value)),
            "of the follower, over the cycle",
        );
    }
    let mut fit = Section::new(if objective.is_some() { "Fit" } else { "Motion" });
    for (share, name) in made.likeness.iter().zip(Side::BOTH) {
        if let Some(share) = share {
            fit = fit.noted_row(
                format!("Likeness of the {name}"),
                percent(*share),
                "area of intersection over union",
            );
        }
    }
    for (drawing, name) in made.drawings.iter().zip(Side::BOTH) {
        if let Some(drawing) = drawing {
            fit = fit.noted_row(
                format!("Area of the {name}'s drawing hidden from its axis"),
                percent(drawing.lost_area),
                "filled in, for a pitch curve has one radius in each direction",
            );
        }
    }
    if let Some(objective) = objective {
        fit = fit
            .noted_row(
                "E",
                format!("{:.4}", objective.shape + objective.weight * objective.torque),
                format!(
                    "E_s + {} E_tau, Eq. 11; with the cost of bounds {:.4}",
                    objective.weight, objective.total
                ),
            )
            .noted_row("E_s", format!("{:.4}", objective.shape), "change of shape, Eq. 12")
            .noted_row(
                "E_tau",
                format!("{:.4}", objective.torque),
                "greatest driver torque over the follower's",
            );
    }
    let fit = fit
        .noted_row(
            "Greatest slope of the pitch curves",
            degrees(made.centrodes.max_lean()),
            "pitch-curve normal against radius",
        )
        .row(
            "psi'",
            format!("{:.3} to {:.3}", transmission.min_derivative(), transmission.max_derivative()),
        );
    let mut mesh = Section::new("Mesh")
        .noted_row(
            "Contact ratio",
            format!("{:.2}", contact.contact_ratio),
            "teeth in contact, mean",
        )
        .row(
            "Contact lost",
            format!("at {} of {} poses", contact.lost_poses, made.contact.poses.len()),
        );
    if let Some(error) = &made.exact_contact.summary.transmission_error_pitch {
        mesh = mesh.noted_row(
            "Transmission error",
            format!(
                "{:.4} % median, {:.3} % 99th percentile",
                100.0 * error.median_deviation,
                100.0 * error.p99_deviation
            ),
            "of a pitch, against the motion that the flanks were made for",
        );
    }
    if let Some(worst) = &contact.max_pressure_angle {
        mesh = mesh.row("Largest pressure angle", degrees(worst.value));
    }
    let [full, steeper, shortened, blunted] = made.tooth_tally();
    if full + steeper + shortened + blunted > 0 {
        mesh = mesh.noted_row(
            "Teeth of one period",
            format!("{full} full, {steeper} steeper, {shortened} shortened, {blunted} blunted"),
            "both gears; steeper: pressure angle raised up to 30°; shortened: to avoid undercut; blunted: pointed tip",
        );
    }
    vec![gears, fit, mesh, strength_section(made)]
}

/// Bending of the weakest tooth, power and efficiency.
fn strength_section(made: &Design) -> Section {
    let strength = &made.strength;
    let mut section = Section::new("Strength, a first look")
        .row("Load on the follower", format!("{:.1} N mm", strength.load.torque));
    if let Some(tooth) = strength.weakest() {
        section = section
            .noted_row(
                "Weakest tooth",
                format!("number {} of the {}", tooth.index, tooth.side),
                format!(
                    "counter-clockwise from 0; its tip is at ({:.1}, {:.1}) mm, in mesh at {:.0}° of driver turn",
                    tooth.tip.x,
                    tooth.tip.y,
                    tooth.driver_angle.to_degrees()
                ),
            )
            .noted_row(
                "Its bending stress",
                format!("{:.2} MPa", tooth.stress),
                format!(
                    "Lewis's formula, one tooth carries {:.1} N at its tip, Y = {:.3}; static, without stress concentration",
                    tooth.force, tooth.form_factor
                ),
            );
    }
    section
        .noted_row(
            "Mean power",
            format!("{:.3} W", strength.power),
            format!("at {:.0} turns of the driver a minute", strength.load.rpm),
        )
        .noted_row(
            "Efficiency",
            format!("{:.1} %", 100.0 * strength.efficiency),
            format!(
                "estimated as for spur gears, with friction {:.2}; bearings not counted",
                strength.load.friction
            ),
        )
}

fn plots(made: &Design) -> Vec<Plot> {
    let transmission = &made.centrodes.transmission;
    // A pair that swings begins anew where its segment begins.
    let sector = made.options.sector.filter(|_| made.assembly.swings());
    let from = sector.map_or(0.0, |s| s.from);
    let reach =
        sector.map_or_else(|| made.assembly.driver_angle.last().copied(), |s| Some(s.length()));
    let reach = reach.unwrap_or(0.0);
    let sampled = |f: &dyn Fn(f64) -> f64| -> Vec<(f64, f64)> {
        (0..PLOT_SAMPLES)
            .map(|i| reach * i as f64 / (PLOT_SAMPLES - 1) as f64)
            .map(|phi| (phi, f(from + phi)))
            .collect()
    };
    let cycle = transmission.cycle();
    let posed = |f: &dyn Fn(&ContactPose) -> f64| -> Vec<(f64, f64)> {
        let mut points: Vec<(f64, f64)> = made
            .contact
            .poses
            .iter()
            .map(|p| ((p.driver_angle - from).rem_euclid(cycle), f(p)))
            .filter(|p| p.0 <= reach)
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points
    };
    let error = posed(&|p| p.transmission_error.to_degrees());
    let teeth = posed(&|p| p.contacts.len() as f64);
    let turned = |phi: f64| (transmission.psi(phi) - transmission.psi(from)).to_degrees();
    vec![
        Plot::over_driver_angle("Transmission function psi", "follower angle, °")
            .series("psi", sampled(&turned)),
        Plot::over_driver_angle("Its derivative psi': driver torque over load", "psi'")
            .series("psi'", sampled(&|phi| transmission.derivative(phi))),
        Plot::over_driver_angle("Transmission error under load, with clearance", "follower lag, °")
            .series("error", error),
        Plot::over_driver_angle("Teeth in contact", "number").series("teeth", teeth),
        Plot::over_driver_angle("Slope of the pitch curves", "°")
            .series("slope", sampled(&|phi| made.centrodes.lean(phi).to_degrees())),
    ]
}
