//! `centrode simulate`: a saved design run again as rigid bodies.

use std::io::Write;

use anyhow::Context;
use centrode::control::Control;
use centrode::diagnose::{Limits, Severity, of_severity, sentences};
use centrode::export::Staging;
use centrode::meshing::{
    ContactInput, ContactOptions, DynamicsInput, MeshingReport, analyse, prove,
};
use centrode::report::{ReportData, Section, report_html};
use centrode::schema::{SavedDesign, run_record};
use serde_json::json;

use super::args::SimulateArgs;
use super::files::write_text;
use super::progress::Progress;
use super::{Outcome, proof};

pub(crate) fn run(args: &SimulateArgs) -> anyhow::Result<Outcome> {
    let saved = SavedDesign::read(&args.design)?;
    let progress = Progress::new();
    progress.doing("working out the contact");
    let report = report(args, &saved, &progress.control())
        .with_context(|| args.design.display().to_string())?;
    progress.doing("writing files");
    let folder = match (args.design.is_dir(), args.design.parent()) {
        (true, _) | (false, None) => args.design.clone(),
        (false, Some(parent)) if parent.as_os_str().is_empty() => ".".into(),
        (false, Some(parent)) => parent.to_owned(),
    };
    let staging = Staging::new(&folder)?;
    let mut files = proof::write_tables(staging.path(), &report)?;
    let page = report_html(&saved.assembly(), &page(&saved, &report));
    files.push(write_text(staging.path(), "report.html", &page)?);
    let files = staging.publish(&files)?;
    progress.done();
    let mut out = std::io::stdout().lock();
    if args.json {
        let value = json!({
            "verdict": report.verdict().label(),
            "meshes": report.verdict().is_sound(),
            "faults": sentences(&report.diagnostics, Severity::Fault),
            "warnings": sentences(&report.diagnostics, Severity::Warning),
            "diagnostics": report.diagnostics,
            "runs": report.runs.iter().map(run_record).collect::<Vec<_>>(),
            "files": files,
        });
        writeln!(out, "{value}").context("cannot write to standard output")?;
    } else {
        let mut lines = vec![report.verdict().label().to_owned()];
        for (severity, word) in [(Severity::Fault, "fault"), (Severity::Warning, "warning")] {
            let told = of_severity(&report.diagnostics, severity);
            lines.extend(told.map(|d| format!("  {word}: {d}")));
        }
        lines.extend(proof::lines(&report));
        lines.extend(files.iter().map(|f| f.display().to_string()));
        writeln!(out, "{}", lines.join("\n")).context("cannot write to standard output")?;
    }
    Ok(if report.verdict().is_sound() { Outcome::Good } else { Outcome::NotSound })
}

/// The runs of a saved design, and what they show.
pub(super) fn report(
    args: &SimulateArgs,
    saved: &SavedDesign,
    control: &Control,
) -> anyhow::Result<MeshingReport> {
    let motion = saved.motion()?;
    let [driver, follower] = &saved.gears;
    let contact = ContactInput {
        driver: &driver.outline,
        follower: &follower.outline,
        center_distance: saved.center_distance,
        module: saved.module,
        motion: &motion,
        control,
    };
    let analysis = analyse(&contact, &ContactOptions::default())?;
    let runs = args.run.runs(saved.thickness, args.cycles);
    let input = DynamicsInput { contact, driver_teeth: driver.teeth };
    Ok(prove(&input, analysis, &runs, &Limits::default())?)
}

fn page(saved: &SavedDesign, report: &MeshingReport) -> ReportData {
    let [driver, follower] = &saved.gears;
    let gears = Section::new("Gears")
        .row("Teeth", format!("{} and {}", driver.teeth, follower.teeth))
        .row("Module", format!("{:.3} mm", saved.module))
        .row("Centre distance", format!("{:.3} mm", saved.center_distance))
        .row("Thickness", format!("{:.2} mm", saved.thickness));
    let verdict = report.verdict();
    let gravest = if verdict.is_sound() { Severity::Warning } else { Severity::Fault };
    let said = sentences(&report.diagnostics, gravest);
    ReportData {
        title: format!("{} and {}, simulated", saved.names[0], saved.names[1]),
        command: String::new(),
        made_by: concat!("centrode ", env!("CARGO_PKG_VERSION")).to_owned(),
        verdict,
        summary: if said.is_empty() {
            "The pair meshes: contact is kept and the torque arrives.".to_owned()
        } else {
            said.join(" ")
        },
        sections: std::iter::once(gears).chain(proof::sections(report)).collect(),
        plots: proof::plots(report),
        contacts: proof::contacts(report, saved.driver_angle.last().copied().unwrap_or_default()),
        notes: report.diagnostics.iter().map(Into::into).collect(),
    }
}
