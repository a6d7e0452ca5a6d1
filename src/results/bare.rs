//! The page of a pair of which the outlines and the motion alone are known: records of version 0.

use super::{run_contacts, run_plots, run_sections};
use crate::diagnose::{Severity, sentences};
use crate::meshing::MeshingReport;
use crate::report::{ReportData, Section};
use crate::schema::SavedDesign;

/// The page of a saved pair that was run.
#[must_use]
pub fn bare_page(saved: &SavedDesign, report: &MeshingReport) -> ReportData {
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
            super::in_sentences(&said)
        },
        sections: std::iter::once(gears).chain(run_sections(report)).collect(),
        plots: run_plots(report),
        contacts: run_contacts(report, saved.driver_angle.last().copied().unwrap_or_default()),
        notes: report.diagnostics.iter().map(Into::into).collect(),
    }
}
