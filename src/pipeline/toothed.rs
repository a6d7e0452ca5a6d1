//! The third stage: the outlines of both gears, with their clearance.

use std::sync::Arc;

use super::feasibility;
use super::sized::Sized;
use super::{DesignOptions, PipelineError, TeethStyle};
use crate::control::{Control, StageName};
use crate::diagnose::{Code, Diagnostic, Place};
use crate::gear::Pair;
use crate::geometry;
use crate::policy;
use crate::solid::{carve_follower_with_manifold, circle};
use crate::teeth::{self, Profile, TeethError, TeethOptions, ToothedPair};

/// Deepest root clearance, modules: four times the usual one; the roots of small gears then still keep away from the axis.
const DEEPEST_ROOT_CLEARANCE: f64 = 1.0;

/// Toothed gears.
#[derive(Clone, Debug)]
pub struct Toothed {
    /// The stage before.
    pub sized: Arc<Sized>,
    /// The teeth as they were generated.
    pub pair: ToothedPair,
    /// The finished outlines, with clearance, each in its own frame.
    pub finished: Pair<Profile>,
    /// What was found out.
    pub diagnostics: Vec<Diagnostic>,
}

/// The part of a request that this stage depends on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Part {
    style: TeethStyle,
    pressure_angle: f64,
    addendum: f64,
    clearance: f64,
    backlash: f64,
    root_clearance: Option<f64>,
    chord_tolerance: f64,
    /// Thickness of the solids that carve, mm; none where the exact envelope does.
    solids: Option<f64>,
}

impl Part {
    pub(super) fn of(options: &DesignOptions) -> Self {
        Self {
            style: options.style,
            pressure_angle: options.pressure_angle,
            addendum: options.addendum,
            clearance: options.clearance,
            backlash: options.backlash,
            root_clearance: options.root_clearance,
            chord_tolerance: options.chord_tolerance,
            solids: options.carve_with_solids.then_some(options.thickness),
        }
    }

    pub(super) fn make(
        &self,
        sized: &Arc<Sized>,
        control: &Control,
    ) -> Result<Toothed, PipelineError> {
        control.progress(StageName::Toothed, 0.0);
        let (centrodes, module) = (&sized.centrodes, sized.module);
        if let Some(root) = self.root_clearance {
            let most = DEEPEST_ROOT_CLEARANCE * module;
            if root > most {
                let remedy = format!("give up to {most:.3} mm, the module of these teeth");
                let name = "the root clearance";
                return Err(PipelineError::Option { name, value: root, remedy });
            }
        }
        let usual = TeethOptions::default();
        let options = TeethOptions {
            driver_teeth: sized.teeth.driver,
            pressure_angle: self.pressure_angle,
            addendum: self.addendum,
            // A follower that is carved by solids is carved by the designed motion, before its clearance.
            clearance: if self.solids.is_some() { 0.0 } else { self.clearance },
            backlash: self.backlash,
            root_clearance: self.root_clearance.map_or(usual.root_clearance, |mm| mm / module),
            chord_tolerance: self.chord_tolerance,
            control: control.clone(),
            ..usual
        };
        let pair = match self.style {
            TeethStyle::Involute => teeth::involute_pair(centrodes, &options)?,
            TeethStyle::Wave => teeth::wave_pair(centrodes, &options)?,
            TeethStyle::RegularWave => teeth::regular_wave_pair(centrodes, &options)?,
        };
        let pair = match self.solids {
            Some(thickness) => self.carved_by_solids(sized, pair, thickness)?,
            None => pair,
        };
        control.check()?;
        let finished = self.finished(&pair)?;
        let root = options.root_clearance * module;
        let mut diagnostics = feasibility::found(sized, &pair, self.addendum * module + root);
        for (side, profile) in finished.as_ref().each() {
            if let Some(at) = geometry::first_self_crossing(&profile.points) {
                let fault = Diagnostic::fault(Code::SelfCrossing, StageName::Toothed);
                diagnostics.push(fault.at(Place::point(side, at)));
            }
        }
        control.progress(StageName::Toothed, 1.0);
        Ok(Toothed { sized: sized.clone(), pair, finished, diagnostics })
    }

    /// Both gears with their clearance.
    fn finished(&self, pair: &ToothedPair) -> Result<Pair<Profile>, PipelineError> {
        if pair.loaded.is_some() {
            return Ok(Pair { driver: pair.driver.clone(), follower: pair.follower.clone() });
        }
        let inset = |profile: &Profile| {
            profile
                .inset(self.clearance)
                .map(|p| p.without_short_edges(policy::SHORTEST_EDGE * pair.module))
                .ok_or(TeethError::NothingLeft { clearance: self.clearance })
        };
        Ok(Pair { driver: inset(&pair.driver)?, follower: inset(&pair.follower)? })
    }

    /// The pair with its follower carved literally: a disc less the driver at many instants, as solids.
    fn carved_by_solids(
        &self,
        sized: &Sized,
        pair: ToothedPair,
        thickness: f64,
    ) -> Result<ToothedPair, PipelineError> {
        let transmission = &sized.centrodes.transmission;
        let rim = sized.pitch_curves.follower.iter().map(|p| p.coords.norm());
        let widest = rim.fold(0.0, f64::max);
        let blank = circle(widest + self.addendum * pair.module, policy::BORE_CHORD_TOLERANCE);
        let count = policy::SOLID_CARVING_POSES * transmission.cycle_periods();
        let cycle = sized.cycle();
        let poses: Vec<(f64, f64)> = (0..count)
            .map(|i| cycle * f64::from(i) / f64::from(count))
            .map(|phi| (phi, transmission.psi(phi)))
            .collect();
        let carved = carve_follower_with_manifold(
            &pair.driver.points,
            &blank,
            sized.centrodes.center_distance,
            &poses,
            thickness,
        )?;
        let follower = pair.follower.relabelled(carved.outline);
        Ok(ToothedPair { follower, ..pair })
    }
}

impl Toothed {
    /// How many teeth of one period, both gears together, are full, steeper, shortened, blunted.
    #[must_use]
    pub fn tooth_tally(&self) -> [usize; 4] {
        feasibility::tally(&self.pair.records)
    }
}
