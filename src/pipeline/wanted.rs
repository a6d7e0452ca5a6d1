//! The first stage: the motion that is wanted, wherever it comes from.

use super::request::{Drawn, Request, Source};
use super::{DesignOptions, PipelineError};
use crate::control::{Control, StageName};
use crate::diagnose::{Code, Diagnostic};
use crate::fit::{self, Fit, FitOptions, Fitter, LimitCost, Limits};
use crate::gear::Pair;
use crate::pitch::{Centrodes, Transmission};

/// Change of shape (in the measure of E_s) that a person wants to hear of.
pub(super) const CHANGE_WORTH_SAYING: f64 = 0.005;

/// A wanted motion, and the drawings that it came from.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// What the gears are called.
    pub names: [String; 2],
    /// The motion, bounds on torque and slope kept; lengths for centre distance 1.
    pub transmission: Transmission,
    /// psi' before bounds, at the samples of [`Self::transmission`].
    pub raw: Vec<f64>,
    /// What the bounds changed.
    pub limited: LimitCost,
    /// Where each gear's drawing lies in it; none for a gear without a drawing.
    pub drawings: Pair<Option<Drawn>>,
    /// The fit of two shapes.
    pub fit: Option<Fit>,
    /// Whether the motion itself is what is wanted, to be changed only when no teeth follow it.
    pub exact: bool,
    /// Whether both pitch curves must be one.
    pub symmetric: bool,
    /// What was found out.
    pub diagnostics: Vec<Diagnostic>,
}

/// The part of a request that this stage depends on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Part {
    source: Source,
    ratio: fit::Ratio,
    fit: FitOptions,
}

impl Part {
    /// `max_lean`: the bound on the slope, radians, in place of the one asked for.
    pub(super) fn of(request: &Request, max_lean: f64) -> Self {
        let DesignOptions { fit, .. } = &request.options;
        let limits = Limits { max_lean, ..fit.limits };
        let fit = match &request.source {
            // What is said of fitting does not matter to a motion.
            Source::Motion { .. } => FitOptions::default(),
            _ => FitOptions { limits, ..fit.clone() },
        };
        Self { source: request.source.clone(), ratio: request.ratio(), fit }
    }

    /// `fitter` keeps the scan of the shapes that it saw last.
    pub(super) fn make(
        &self,
        fitter: &mut Fitter,
        control: &Control,
    ) -> Result<Wanted, PipelineError> {
        let mut made = match &self.source {
            Source::TwoShapes { driver, follower } => {
                let (d, f) = (&driver.outline, &follower.outline);
                let fit = fitter.fit(d, f, self.ratio, &self.fit, control)?;
                Wanted {
                    names: [driver.name.clone(), follower.name.clone()],
                    transmission: fit.transmission.clone(),
                    raw: fit.raw.clone(),
                    limited: fit.limited,
                    drawings: Pair {
                        driver: Some(Drawn { shape: driver.clone(), gear: fit.driver }),
                        follower: Some(Drawn { shape: follower.clone(), gear: fit.follower }),
                    },
                    fit: Some(fit),
                    exact: false,
                    symmetric: self.fit.symmetric,
                    diagnostics: Vec::new(),
                }
            }
            Source::OneShape { shape } => {
                let mated = fit::mate(&shape.outline, self.ratio, &self.fit, control)?;
                let driver = Some(Drawn { shape: shape.clone(), gear: mated.driver });
                Wanted {
                    names: [shape.name.clone(), format!("mate of {}", shape.name)],
                    transmission: mated.transmission,
                    raw: mated.raw,
                    limited: mated.limited,
                    drawings: Pair { driver, follower: None },
                    fit: None,
                    exact: false,
                    symmetric: false,
                    diagnostics: Vec::new(),
                }
            }
            Source::Motion { transmission, names, drawings } => Wanted {
                names: names.clone(),
                raw: transmission.samples().to_vec(),
                limited: LimitCost::default(),
                transmission: transmission.clone(),
                drawings: (**drawings).clone().into(),
                fit: None,
                exact: true,
                symmetric: false,
                diagnostics: Vec::new(),
            },
        };
        made.diagnostics = made.found();
        Ok(made)
    }
}

impl Wanted {
    /// Periods of the motion in a turn of the driver and of the follower.
    #[must_use]
    pub fn folds(&self) -> (u32, u32) {
        (self.transmission.driver_fold(), self.transmission.follower_fold())
    }

    fn found(&self) -> Vec<Diagnostic> {
        let stage = StageName::Wanted;
        let mut found = Vec::new();
        if let Some(refined) = self.fit.as_ref().and_then(|fit| fit.refinement)
            && refined.after < refined.before
        {
            let note = Diagnostic::note(Code::Refined, stage);
            found.push(note.with("before", refined.before).with("after", refined.after));
        }
        if self.limited.shape > CHANGE_WORTH_SAYING {
            let note = Diagnostic::note(Code::LimitsKept, stage).with("shape", self.limited.shape);
            found.push(note.with("from", self.limited.lean.0).with("to", self.limited.lean.1));
        }
        found
    }

    /// Greatest curvature of either pitch curve times the driver's perimeter.
    pub(super) fn bend(&self) -> f64 {
        let centrodes = Centrodes { transmission: self.transmission.clone(), center_distance: 1.0 };
        let n = self.transmission.samples().len();
        let step = self.transmission.driver_period() / n as f64;
        let most = (0..n).fold(0.0_f64, |most, i| {
            let (driver, follower) = centrodes.curvatures(i as f64 * step);
            most.max(driver.abs()).max(follower.abs())
        });
        most * centrodes.perimeter().0
    }

    /// How far, radians, a motion strays from the one wanted, both begun at the same place.
    pub(super) fn strays(&self, made: &Transmission) -> f64 {
        let n = self.transmission.samples().len();
        let step = self.transmission.driver_period() / n as f64;
        let apart = |i: usize| {
            let phi = i as f64 * step;
            made.psi(phi) - self.transmission.psi(phi)
        };
        let (low, high) =
            (0..n).map(apart).fold((0.0_f64, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)));
        high - low
    }
}
