//! The fourth stage: contact of the outlines over one cycle, and the judge's word on it.

use std::sync::Arc;

use super::toothed::Toothed;
use super::{DesignOptions, PipelineError};
use crate::control::Control;
use crate::diagnose::{Code, Diagnostic, Limits, Severity};
use crate::gear::{Motion, Pair};
use crate::meshing::{ContactAnalysis, ContactInput, ContactOptions, analyse, judge_contact};
use crate::policy;
use crate::teeth::Profile;

/// Poses at which a pair is judged while settings are still tried: ten a tooth of a common gear. The delivered pair is
/// judged at all of them.
const POSES_TRIED: usize = 480;

/// A pair whose contact is known.
#[derive(Clone, Debug)]
pub struct Analysed {
    /// The stage before.
    pub toothed: Arc<Toothed>,
    /// Contact against the motion that the flanks were made for: the error of the teeth themselves.
    pub exact: ContactAnalysis,
    /// Contact of the finished gears.
    pub contact: ContactAnalysis,
    /// The limits that it was judged by.
    pub limits: Limits,
    /// What was found out.
    pub diagnostics: Vec<Diagnostic>,
}

/// The part of a request that this stage depends on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Part {
    poses: usize,
    limits: Limits,
}

impl Part {
    /// `tried`: at the few poses that tell whether an attempt is worth a closer look.
    pub(super) fn of(options: &DesignOptions, toothed: &Toothed, tried: bool) -> Self {
        let module = toothed.sized.module;
        // What chords and carving leave by design, where no clearance hides it.
        let drawn =
            policy::CARVE_SKIN + 2.0 * options.chord_tolerance - 2.0 * options.clearance / module;
        let limits = Limits { overlap: options.limits.overlap + drawn.max(0.0), ..options.limits };
        let poses = if tried { POSES_TRIED } else { policy::CONTACT_POSES };
        Self { poses, limits }
    }

    /// Poses of the analysis `known` of the same gears are kept.
    pub(super) fn make(
        &self,
        toothed: &Arc<Toothed>,
        known: Option<&Analysed>,
        control: &Control,
    ) -> Result<Analysed, PipelineError> {
        let Toothed { pair, finished, .. } = &**toothed;
        let look = |known: Option<&ContactAnalysis>, gears: Pair<&Profile>| {
            let options = ContactOptions { poses: self.poses, ..ContactOptions::default() };
            let input = toothed.in_mesh(gears, control);
            match known {
                Some(known) => known.clone().refined(&input, &options),
                None => analyse(&input, &options),
            }
        };
        let contact = look(known.map(|k| &k.contact), finished.as_ref())?;
        let exact = if let Some([behind, _]) = &pair.loaded {
            let transmission = &toothed.sized.centrodes.transmission;
            contact.against(&|phi| behind.psi(phi) - transmission.psi(phi))
        } else if pair.driver == finished.driver {
            contact.clone()
        } else {
            // An inset gives the play of each flank its own swing, which is no error of its shape.
            let drawn = Pair { driver: &pair.driver, follower: &pair.follower };
            look(known.map(|k| &k.exact), drawn)?
        };
        let sized = &toothed.sized;
        let (module, teeth) = (sized.module, sized.teeth.driver);
        let diagnostics = judge_contact(&contact, Some(&exact), module, teeth, &self.limits);
        let (toothed, limits) = (toothed.clone(), self.limits);
        Ok(Analysed { toothed, exact, contact, limits, diagnostics })
    }
}

impl Toothed {
    /// Their contact, as [`Session`](super::Session) has it analysed for these options.
    ///
    /// # Errors
    /// [`PipelineError::Contact`], [`PipelineError::Cancelled`].
    pub fn analysed(
        self: &Arc<Self>,
        options: &DesignOptions,
        control: &Control,
    ) -> Result<Analysed, PipelineError> {
        Part::of(options, self, options.quick).make(self, None, control)
    }

    /// Gears of this pair in mesh.
    pub(super) fn in_mesh<'a>(
        &'a self,
        gears: Pair<&'a Profile>,
        control: &'a Control,
    ) -> ContactInput<'a> {
        let centrodes = &self.sized.centrodes;
        ContactInput {
            driver: &gears.driver.points,
            follower: &gears.follower.points,
            center_distance: centrodes.center_distance,
            module: self.sized.module,
            motion: &centrodes.transmission,
            control,
        }
    }
}

impl Analysed {
    /// 99th percentile of the transmission error against the motion that the flanks were made for, pitches; infinite
    /// without contact.
    #[must_use]
    pub fn tooth_error(&self) -> f64 {
        let error = self.exact.summary.transmission_error_pitch;
        error.map_or(f64::INFINITY, |e| e.p99_deviation)
    }

    /// Whether the teeth need no gentler settings.
    pub(super) fn is_good(&self) -> bool {
        let needs_better = |d: &Diagnostic| match d.code {
            Code::ToothError => true,
            code => d.severity == Severity::Fault && is_of_the_teeth(code),
        };
        !self.diagnostics.iter().any(needs_better)
    }

    /// To compare attempts: lost contact and interference weigh more than any transmission error.
    pub(super) fn badness(&self) -> f64 {
        let summary = &self.contact.summary;
        let lost = (summary.lost_poses + summary.lost_poses_reversed) as f64;
        let lost = policy::CONTACT_POSES as f64 * lost / self.contact.poses.len().max(1) as f64;
        let module = self.toothed.sized.module;
        let depth = summary.max_interference.map_or(0.0, |w| w.value / module);
        lost + 10.0 * (depth - self.limits.overlap).max(0.0) + self.tooth_error().min(1.0)
    }
}

/// Whether a fault lies in teeth that do not mesh, which less slope alone does not mend.
pub(super) fn is_of_the_teeth(code: Code) -> bool {
    matches!(
        code,
        Code::ContactLost
            | Code::ContactLostBackward
            | Code::NoContact
            | Code::Overlap
            | Code::ToothError
            | Code::SelfCrossing
    )
}
