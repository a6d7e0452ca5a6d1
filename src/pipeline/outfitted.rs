//! The last stage: gears with bores and all they carry, on their axes, with one cycle of motion.

use std::sync::Arc;

use super::analysed::Analysed;
use super::proven::Proven;
use super::{BoreChoice, DesignOptions, PipelineError, outfit, sector};
use crate::assembly::{Assembly, Fittings, Gear, PlacedGear};
use crate::control::{Control, StageName};
use crate::diagnose::{Code, Diagnostic, Place, Verdict};
use crate::gear::{Pair, Side};
use crate::geometry::Point;
use crate::input::Inner;
use crate::law::Segment;
use crate::policy;
use crate::solid::Bore;
use crate::strength::{Load, Loaded, Strength, strength};

/// Shares of the default bore that are tried, widest first, where a gear has little room for it.
const BORE_SHARES: [f64; 4] = [1.0, 0.8, 0.6, 0.4];

/// A pair that can be made.
#[derive(Clone, Debug)]
pub struct Outfitted {
    /// The stage before.
    pub proven: Arc<Proven>,
    /// The gears with clearance and bores, on their axes, with one cycle of motion.
    pub assembly: Assembly,
    /// Bending of the teeth, power and efficiency under [`DesignOptions::load`].
    pub strength: Strength,
    /// What was found out.
    pub diagnostics: Vec<Diagnostic>,
}

/// The part of a request that this stage depends on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Part {
    bore: BoreChoice,
    outfit: outfit::Outfit,
    sector: Option<Segment>,
    load: Load,
    thickness: f64,
    pressure_angle: f64,
}

impl Part {
    pub(super) fn of(options: &DesignOptions) -> Self {
        Self {
            bore: options.bore,
            outfit: options.outfit.clone(),
            sector: options.sector,
            load: options.load,
            thickness: options.thickness,
            pressure_angle: options.pressure_angle,
        }
    }

    pub(super) fn make(
        &self,
        proven: &Arc<Proven>,
        control: &Control,
    ) -> Result<Outfitted, PipelineError> {
        control.check()?;
        control.progress(StageName::Outfitted, 0.0);
        let analysed = &proven.analysed;
        let toothed = &analysed.toothed;
        let sized = &toothed.sized;
        let mut found = Vec::new();
        let gears = Pair::from_fn(|side| side).try_map(|side, _| {
            let outline = toothed.finished[side].points.clone();
            let bore = self.bore(side, &outline, &mut found)?;
            Ok::<_, PipelineError>(Gear {
                name: side.name().to_owned(),
                outline,
                bore,
                pitch_curve: sized.pitch_curves[side].clone(),
                input: sized.inputs[side].clone(),
                teeth: sized.teeth[side],
                fittings: Fittings::default(),
            })
        })?;
        let mut assembly = self.assembled(proven, gears);
        if let Some(segment) = self.sector {
            let cut = (segment, &self.outfit);
            found.extend(sector::cut(&mut assembly, analysed, cut, control)?);
        }
        let names = &sized.wanted.names;
        let drawings: Vec<Inner> = Side::BOTH.map(|side| sized.inner(side)).to_vec();
        let outfit = &self.outfit;
        found.extend(outfit::fit_out(&mut assembly, outfit, names, sized.module, &drawings)?);
        let strength = analysed.under(self.load, self.thickness, self.pressure_angle);
        control.progress(StageName::Outfitted, 1.0);
        Ok(Outfitted { proven: proven.clone(), assembly, strength, diagnostics: found })
    }

    /// Both gears on their axes with one cycle of motion.
    fn assembled(&self, proven: &Proven, gears: Pair<Gear>) -> Assembly {
        let sized = &proven.analysed.toothed.sized;
        let transmission = &sized.centrodes.transmission;
        let count = policy::MOTION_SAMPLES * transmission.cycle_periods() as usize;
        let at = |i: usize| sized.cycle() * i as f64 / count as f64;
        let driver_angle: Vec<f64> = (0..=count).map(at).collect();
        let angles = Pair {
            driver: driver_angle.clone(),
            follower: driver_angle.iter().map(|&phi| -transmission.psi(phi)).collect(),
        };
        let place = |side| match side {
            Side::Driver => Point::origin(),
            Side::Follower => Point::new(sized.centrodes.center_distance, 0.0),
        };
        let placed = gears.zip(angles).map_sides(|side, (gear, angle)| PlacedGear {
            gear,
            axis: place(side),
            level: 0.0,
            angle,
        });
        Assembly {
            gears: placed.into_iter().collect(),
            driver_angle,
            thickness: self.thickness,
            meshes: vec![[0, 1]],
            axles: Vec::new(),
            fixtures: Vec::new(),
        }
    }

    fn bore(
        &self,
        side: Side,
        outline: &[Point],
        found: &mut Vec<Diagnostic>,
    ) -> Result<Option<Vec<Point>>, PipelineError> {
        let tolerance = policy::BORE_CHORD_TOLERANCE;
        let with_play = |bore: Bore| self.outfit.play().map_or(bore, |play| bore.with_play(play));
        let warning = |code| Diagnostic::warning(code, StageName::Outfitted).at(Place::Gear(side));
        match self.bore {
            BoreChoice::Exactly(bore) => {
                Ok(with_play(bore).fitted(outline, policy::BORE_WALL, tolerance)?)
            }
            BoreChoice::Named(name) => {
                let bore = name.hole(self.outfit.fit).map_err(outfit::OutfitError::from)?;
                Ok(bore.fitted(outline, policy::BORE_WALL, tolerance)?)
            }
            BoreChoice::AtMost(diameter) => {
                for share in BORE_SHARES {
                    let bore = with_play(Bore::Round { diameter: share * diameter });
                    if let Ok(hole) = bore.fitted(outline, policy::BORE_WALL, tolerance) {
                        if share < 1.0 {
                            let narrow = warning(Code::NarrowBore);
                            found.push(narrow.with("diameter", share * diameter));
                        }
                        return Ok(hole);
                    }
                }
                found.push(warning(Code::NoBore));
                Ok(None)
            }
        }
    }
}

impl Analysed {
    /// Bending of the teeth, power and efficiency under the load of `options`.
    #[must_use]
    pub fn strength(&self, options: &DesignOptions) -> Strength {
        self.under(options.load, options.thickness, options.pressure_angle)
    }

    fn under(&self, load: Load, thickness: f64, pressure_angle: f64) -> Strength {
        let toothed = &self.toothed;
        strength(&Loaded {
            centrodes: &toothed.sized.centrodes,
            profiles: [&toothed.finished.driver, &toothed.finished.follower],
            module: toothed.sized.module,
            thickness,
            pressure_angle,
            contact_ratio: self.contact.summary.contact_ratio,
            load,
        })
    }
}

impl Outfitted {
    /// The verdict on the pair.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        let sized = &self.proven.analysed.toothed.sized;
        let before = sized.wanted.diagnostics.iter().chain(&sized.diagnostics);
        Verdict::of(before.chain(self.proven.findings()).chain(&self.diagnostics))
    }
}
