//! The fifth stage: rigid-body runs, and the verdict on them.

use std::sync::Arc;

use super::analysed::Analysed;
use super::{DesignOptions, PipelineError};
use crate::control::{Control, StageName};
use crate::diagnose::{Diagnostic, Limits, Verdict};
use crate::meshing::{DynamicsInput, DynamicsOptions, MeshingReport, prove};

/// A pair that was run, or was not asked to be, or was not worth it.
#[derive(Clone, Debug)]
pub struct Proven {
    /// The stage before.
    pub analysed: Arc<Analysed>,
    /// The runs; none where none were asked for, and where contact alone shows that the pair fails.
    pub report: Option<MeshingReport>,
    /// What the runs showed.
    pub diagnostics: Vec<Diagnostic>,
}

/// The part of a request that this stage depends on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Part {
    runs: Vec<DynamicsOptions>,
    limits: Limits,
}

impl Part {
    pub(super) fn of(options: &DesignOptions) -> Self {
        Self { runs: options.runs.clone(), limits: options.limits }
    }

    pub(super) fn make(
        &self,
        analysed: &Arc<Analysed>,
        control: &Control,
    ) -> Result<Proven, PipelineError> {
        let toothed = &analysed.toothed;
        let before = toothed.diagnostics.iter().chain(&analysed.diagnostics);
        if self.runs.is_empty() || !Verdict::of(before).is_sound() {
            let diagnostics = Vec::new();
            return Ok(Proven { analysed: analysed.clone(), report: None, diagnostics });
        }
        self.run(analysed, control)
    }

    /// Runs the pair, whatever its contact is like.
    pub(super) fn run(
        &self,
        analysed: &Arc<Analysed>,
        control: &Control,
    ) -> Result<Proven, PipelineError> {
        let toothed = &analysed.toothed;
        let contact = toothed.in_mesh(toothed.finished.as_ref(), control);
        let input = DynamicsInput { contact, driver_teeth: toothed.sized.teeth.driver };
        let report = prove(&input, analysed.contact.clone(), &self.runs, &self.limits)?;
        let of_runs = |d: &&Diagnostic| d.stage == StageName::Proven;
        let diagnostics = report.diagnostics.iter().filter(of_runs).cloned().collect();
        Ok(Proven { analysed: analysed.clone(), report: Some(report), diagnostics })
    }
}

impl Proven {
    /// All that outlines, contact and runs showed.
    pub fn findings(&self) -> impl Iterator<Item = &Diagnostic> {
        let toothed = &self.analysed.toothed;
        toothed.diagnostics.iter().chain(&self.analysed.diagnostics).chain(&self.diagnostics)
    }

    /// Whether the pair may be used.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        Verdict::of(self.findings()).is_sound()
    }
}
