//! `centrode simulate`: a saved design run again as rigid bodies.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;
use centrode::control::Control;
use centrode::diagnose::{Diagnostic, Limits, Severity, Verdict, of_severity, sentences};
use centrode::export::{Staging, write_json};
use centrode::meshing::{
    ContactInput, ContactOptions, DynamicsInput, DynamicsOptions, MeshingReport, analyse, prove,
};
use centrode::pipeline::{Design, Stages};
use centrode::report::report_html;
use centrode::results::{bare_page, design_page, run_lines};
use centrode::schema::{RECORD_NAME, Record, SavedDesign, run_record};
use serde_json::json;

use super::args::SimulateArgs;
use super::files::write_text;
use super::progress::Progress;
use super::{Outcome, proof};

pub(crate) fn run(args: &SimulateArgs) -> anyhow::Result<Outcome> {
    let saved = SavedDesign::read(&args.design)?;
    let progress = Progress::new();
    progress.doing("analysing the contact");
    let control = progress.control();
    let runs = args.run.runs(saved.thickness, args.cycles);
    let (folder, record) = place(&args.design);
    let staging = Staging::new(&folder)?;
    let (report, diagnostics, files) = match saved.stages(&control)? {
        Some(stages) => {
            progress.doing("running the gears");
            let made = again(&stages, runs, &control)?;
            let report = made.proof.clone().context("the pair was not run")?;
            let mut files = proof::write_tables(staging.path(), &report)?;
            let page = report_html(&made.assembly, &design_page(&made, String::new()));
            files.push(write_text(staging.path(), "report.html", &page)?);
            // Last, so that the record's verdict is that of the files beside it.
            let path = staging.path().join(&record);
            write_json(&path, &Record::new(&made))?;
            files.push(path);
            (report, made.diagnostics, files)
        }
        None => {
            let report =
                bare(&saved, &runs, &control).with_context(|| args.design.display().to_string())?;
            let mut files = proof::write_tables(staging.path(), &report)?;
            let page = report_html(&saved.assembly(), &bare_page(&saved, &report));
            files.push(write_text(staging.path(), "report.html", &page)?);
            let diagnostics = report.diagnostics.clone();
            (report, diagnostics, files)
        }
    };
    progress.doing("writing files");
    let files = staging.publish(&files)?;
    progress.done();
    tell(&report, &diagnostics, &files, args.json)
}

/// The folder of a record, and its name in it.
fn place(design: &Path) -> (PathBuf, PathBuf) {
    if design.is_dir() {
        return (design.to_owned(), RECORD_NAME.into());
    }
    let folder = design.parent().filter(|p| !p.as_os_str().is_empty());
    let name = design.file_name().map_or_else(|| RECORD_NAME.into(), PathBuf::from);
    (folder.unwrap_or(Path::new(".")).to_owned(), name)
}

/// The runs of a saved design, and what they show.
pub(super) fn report(
    args: &SimulateArgs,
    saved: &SavedDesign,
    control: &Control,
) -> anyhow::Result<MeshingReport> {
    let runs = args.run.runs(saved.thickness, args.cycles);
    match saved.stages(control)? {
        Some(stages) => again(&stages, runs, control)?.proof.context("the pair was not run"),
        None => bare(saved, &runs, control),
    }
}

/// The same pair with other runs.
fn again(stages: &Stages, runs: Vec<DynamicsOptions>, control: &Control) -> anyhow::Result<Design> {
    let stages = stages.run_again(runs, control)?;
    stages.as_ref().and_then(Design::of).context("the record holds no finished pair")
}

/// The run of a pair of which the outlines alone are known.
fn bare(
    saved: &SavedDesign,
    runs: &[DynamicsOptions],
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
    let input = DynamicsInput { contact, driver_teeth: driver.teeth };
    Ok(prove(&input, analysis, runs, &Limits::default())?)
}

fn tell(
    report: &MeshingReport,
    diagnostics: &[Diagnostic],
    files: &[PathBuf],
    as_json: bool,
) -> anyhow::Result<Outcome> {
    let verdict = Verdict::of(diagnostics);
    let mut out = std::io::stdout().lock();
    if as_json {
        let value = json!({
            "verdict": verdict.label(),
            "meshes": verdict.is_sound(),
            "faults": sentences(diagnostics, Severity::Fault),
            "warnings": sentences(diagnostics, Severity::Warning),
            "diagnostics": diagnostics,
            "runs": report.runs.iter().map(run_record).collect::<Vec<_>>(),
            "files": files,
        });
        writeln!(out, "{value}").context("cannot write to standard output")?;
    } else {
        let mut lines = vec![verdict.label().to_owned()];
        for (severity, word) in [(Severity::Fault, "fault"), (Severity::Warning, "warning")] {
            let told = of_severity(diagnostics, severity);
            lines.extend(told.map(|d| format!("  {word}: {d}")));
        }
        lines.extend(run_lines(report));
        lines.extend(files.iter().map(|f| f.display().to_string()));
        writeln!(out, "{}", lines.join("\n")).context("cannot write to standard output")?;
    }
    Ok(if verdict.is_sound() { Outcome::Good } else { Outcome::NotSound })
}
