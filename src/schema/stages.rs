//! The stages of a design as `design.json` keeps them, beside what other programs read of it.
//!
//! What a stage was made from stands here; contact and strength are worked out again from it, which gives the same
//! figures but for rounding.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::saved::{SavedDesign, plain_name, ring};
use crate::control::Control;
use crate::diagnose::Diagnostic;
use crate::fit::{Fit, FittedGear, LimitCost, Objective, Refinement, Similarity};
use crate::gear::{Pair, Side};
use crate::geometry::Point;
use crate::input::Shape;
use crate::outline::Outline;
use crate::pipeline::{
    Bounds, DesignOptions, Drawn, Outfitted, PipelineError, Proven, Request, Revision, Sized,
    Source, Stages, Toothed, Wanted,
};
use crate::pitch::{Centrodes, Transmission};
use crate::policy;
use crate::teeth::{EdgeKind, LoadedMotion, Profile, ToothRecord, ToothedPair};

type Ring = Vec<[f64; 2]>;

/// All that the other parts of the record do not tell of the stages.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct StagesRecord {
    source: SourceWord,
    wanted: WantedRecord,
    revisions: Vec<Revision>,
    sized: SizedRecord,
    toothed: ToothedRecord,
    proven: Found,
    outfitted: Found,
}

/// Where the pair comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum SourceWord {
    TwoShapes,
    OneShape,
    Motion,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Found {
    diagnostics: Vec<Diagnostic>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct WantedRecord {
    motion: TransmissionRecord,
    /// psi' before bounds.
    raw: Vec<f64>,
    limited: LimitCost,
    exact: bool,
    symmetric: bool,
    drawings: Pair<Option<DrawnRecord>>,
    fit: Option<FitRecord>,
    diagnostics: Vec<Diagnostic>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct FitRecord {
    objective: Objective,
    pairs_scored: usize,
    refinement: Option<Refinement>,
}

/// A drawing in its own frame, and where it lies in its gear for a centre distance of 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct DrawnRecord {
    name: String,
    raw: Ring,
    /// After smoothing.
    outline: Ring,
    axis: [f64; 2],
    center: [f64; 2],
    angle: f64,
    scale: f64,
    iou: f64,
    contour: f64,
    lost_area: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct TransmissionRecord {
    /// Periods in a turn of each gear.
    folds: Pair<u32>,
    /// psi' at the knots of its spline, even over one period.
    derivative: Vec<f64>,
    /// Where driver angle 0 lies on the spline, radians.
    phase: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct SizedRecord {
    motion: TransmissionRecord,
    bounds: Bounds,
    rounding: LimitCost,
    likeness: Pair<Option<f64>>,
    diagnostics: Vec<Diagnostic>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct ToothedRecord {
    /// The outlines as they were generated.
    generated: Pair<ProfileRecord>,
    /// With their clearance, where that was taken off afterwards.
    finished: Option<Pair<ProfileRecord>>,
    uncovered: [f64; 2],
    cuts: usize,
    teeth: Vec<ToothRecord>,
    /// The motions of the loaded pair, follower behind and ahead.
    loaded: Option<[LoadedRecord; 2]>,
    diagnostics: Vec<Diagnostic>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct LoadedRecord {
    motion: TransmissionRecord,
    offset: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct ProfileRecord {
    points: Ring,
    /// One letter for each edge: flank, tip, root.
    edges: String,
}

const EDGES: [(char, EdgeKind); 3] =
    [('f', EdgeKind::Flank), ('t', EdgeKind::Tip), ('r', EdgeKind::Root)];

fn plain(points: &[Point]) -> Ring {
    points.iter().map(|p| [p.x, p.y]).collect()
}

fn points(ring: Ring) -> Vec<Point> {
    ring.into_iter().map(|[x, y]| Point::new(x, y)).collect()
}

impl TransmissionRecord {
    fn new(transmission: &Transmission) -> Self {
        Self {
            folds: Pair::new(transmission.driver_fold(), transmission.follower_fold()),
            derivative: transmission.knots(),
            phase: transmission.phase(),
        }
    }

    /// `what` is the motion's name in a message.
    fn read(self, what: &str) -> Result<Transmission, String> {
        let Pair { driver, follower } = self.folds;
        if driver.max(follower) > policy::MAX_RATIO || !self.phase.is_finite() {
            return Err(format!("its {what} motion repeats too often, or begins nowhere"));
        }
        let made = Transmission::from_derivative(&self.derivative, driver, follower)
            .map_err(|e| format!("its {what} motion is none: {e}"))?;
        Ok(if self.phase == 0.0 { made } else { made.shifted(self.phase) })
    }
}

impl ProfileRecord {
    fn new(profile: &Profile) -> Self {
        let letter = |kind: &EdgeKind| EDGES.iter().find(|(_, k)| k == kind).map(|(l, _)| *l);
        Self {
            points: plain(&profile.points),
            edges: profile.kinds.iter().filter_map(letter).collect(),
        }
    }

    fn read(self, side: Side) -> Result<Profile, String> {
        let kind = |letter: char| EDGES.into_iter().find(|(l, _)| *l == letter).map(|(_, k)| k);
        let kinds: Option<Vec<EdgeKind>> = self.edges.chars().map(kind).collect();
        let points = ring("generated outline", side, self.points)?;
        match kinds {
            Some(kinds) if kinds.len() == points.len() => Ok(Profile { points, kinds }),
            _ => Err(format!("the edges of its {side} do not go with its outline")),
        }
    }
}

impl DrawnRecord {
    fn new(drawn: &Drawn) -> Self {
        let Drawn { shape, gear } = drawn;
        let at = |p: Point| [p.x, p.y];
        Self {
            name: shape.name.clone(),
            raw: plain(shape.raw.points()),
            outline: plain(shape.outline.points()),
            axis: at(gear.center_in_input),
            center: at(gear.placement.center),
            angle: gear.placement.angle,
            scale: gear.placement.scale,
            iou: gear.iou,
            contour: gear.contour,
            lost_area: gear.lost_area,
        }
    }

    fn read(self, side: Side) -> Result<Drawn, String> {
        plain_name(&self.name)?;
        let outline = |points: Vec<Point>| {
            Outline::new(points).map_err(|e| format!("the drawing of its {side} is none: {e}"))
        };
        let at = |[x, y]: [f64; 2]| Point::new(x, y);
        if !(self.scale > 0.0 && self.scale.is_finite()) {
            return Err(format!("the drawing of its {side} has no size"));
        }
        Ok(Drawn {
            shape: Arc::new(Shape {
                name: self.name,
                raw: outline(points(self.raw))?,
                outline: outline(points(self.outline))?,
                // What is drawn inside is in the fittings of the finished gears.
                inner: crate::input::Inner::default(),
                notes: Vec::new(),
            }),
            gear: FittedGear {
                center_in_input: at(self.axis),
                placement: Similarity {
                    center: at(self.center),
                    angle: self.angle,
                    scale: self.scale,
                },
                iou: self.iou,
                contour: self.contour,
                lost_area: self.lost_area,
            },
        })
    }
}

impl StagesRecord {
    /// None before the last stage.
    pub(super) fn new(stages: &Stages) -> Option<Self> {
        let outfitted = stages.outfitted.as_ref()?;
        let proven = &outfitted.proven;
        let toothed = &proven.analysed.toothed;
        let sized = &toothed.sized;
        let wanted = &sized.wanted;
        let pair = &toothed.pair;
        let generated = Pair::new(&pair.driver, &pair.follower);
        let is_apart = generated != toothed.finished.as_ref();
        let loaded = |motion: &LoadedMotion| LoadedRecord {
            motion: TransmissionRecord::new(motion.transmission()),
            offset: motion.offset(),
        };
        Some(Self {
            source: match stages.asked.source {
                Source::TwoShapes { .. } => SourceWord::TwoShapes,
                Source::OneShape { .. } => SourceWord::OneShape,
                Source::Motion { .. } => SourceWord::Motion,
            },
            wanted: WantedRecord {
                motion: TransmissionRecord::new(&wanted.transmission),
                raw: wanted.raw.clone(),
                limited: wanted.limited,
                exact: wanted.exact,
                symmetric: wanted.symmetric,
                drawings: wanted.drawings.as_ref().map(|d| d.as_ref().map(DrawnRecord::new)),
                fit: wanted.fit.as_ref().map(|fit| FitRecord {
                    objective: fit.objective,
                    pairs_scored: fit.pairs_scored,
                    refinement: fit.refinement,
                }),
                diagnostics: wanted.diagnostics.clone(),
            },
            revisions: stages.revisions.clone(),
            sized: SizedRecord {
                motion: TransmissionRecord::new(&sized.centrodes.transmission),
                bounds: sized.bounds,
                rounding: sized.rounding,
                likeness: sized.likeness,
                diagnostics: sized.diagnostics.clone(),
            },
            toothed: ToothedRecord {
                generated: generated.map(ProfileRecord::new),
                finished: is_apart.then(|| toothed.finished.as_ref().map(ProfileRecord::new)),
                uncovered: pair.uncovered,
                cuts: pair.cuts,
                teeth: pair.records.clone(),
                loaded: pair.loaded.as_ref().map(|both| both.each_ref().map(loaded)),
                diagnostics: toothed.diagnostics.clone(),
            },
            proven: Found { diagnostics: proven.diagnostics.clone() },
            outfitted: Found { diagnostics: outfitted.diagnostics.clone() },
        })
    }

    /// The stages of the saved design that this is a part of.
    pub(super) fn read(
        self,
        saved: &SavedDesign,
        (asked, used): (DesignOptions, DesignOptions),
    ) -> Result<Kept, String> {
        let wanted = self.wanted.read(saved)?;
        let source = match (self.source, &wanted.drawings) {
            (SourceWord::TwoShapes, Pair { driver: Some(d), follower: Some(f) }) => {
                Source::TwoShapes { driver: d.shape.clone(), follower: f.shape.clone() }
            }
            (SourceWord::OneShape, Pair { driver: Some(d), .. }) => {
                Source::OneShape { shape: d.shape.clone() }
            }
            (SourceWord::Motion, drawings) => Source::Motion {
                transmission: wanted.transmission.clone(),
                names: saved.names.clone(),
                drawings: Box::new([drawings.driver.clone(), drawings.follower.clone()]),
            },
            _ => return Err("a drawing that it was made from is missing".to_owned()),
        };
        let transmission = self.sized.motion.read("designed")?;
        if (transmission.ratio() / saved.ratio - 1.0).abs() > policy::RECORD_RATIO_OFF {
            return Err("its ratio is not that of its designed motion".to_owned());
        }
        let gears = Pair::from(saved.gears.each_ref());
        let sized = Sized {
            wanted: Arc::new(wanted),
            centrodes: Centrodes { transmission, center_distance: saved.center_distance },
            teeth: gears.map(|g| g.teeth),
            module: saved.module,
            bounds: self.sized.bounds,
            rounding: self.sized.rounding,
            pitch_curves: gears.map(|g| g.pitch_curve.clone()),
            inputs: gears.map(|g| g.input.clone()),
            likeness: self.sized.likeness,
            diagnostics: self.sized.diagnostics,
        };
        let toothed = self.toothed.read(sized)?;
        Ok(Kept {
            asked: Request { source, options: asked },
            used,
            revisions: self.revisions,
            toothed: Arc::new(toothed),
            proven: self.proven.diagnostics,
            outfitted: self.outfitted.diagnostics,
        })
    }
}

impl WantedRecord {
    fn read(self, saved: &SavedDesign) -> Result<Wanted, String> {
        let transmission = self.motion.read("wanted")?;
        let drawings =
            self.drawings.try_map(|side, drawn| drawn.map(|drawn| drawn.read(side)).transpose())?;
        let fit = match (self.fit, &drawings) {
            (Some(fit), Pair { driver: Some(driver), follower: Some(follower) }) => Some(Fit {
                transmission: transmission.clone(),
                raw: self.raw.clone(),
                objective: fit.objective,
                limited: self.limited,
                driver: driver.gear,
                follower: follower.gear,
                pairs_scored: fit.pairs_scored,
                refinement: fit.refinement,
            }),
            (Some(_), _) => return Err("a drawing that was fitted is missing".to_owned()),
            (None, _) => None,
        };
        Ok(Wanted {
            names: saved.names.clone(),
            transmission,
            raw: self.raw,
            limited: self.limited,
            drawings,
            fit,
            exact: self.exact,
            symmetric: self.symmetric,
            diagnostics: self.diagnostics,
        })
    }
}

impl ToothedRecord {
    fn read(self, sized: Sized) -> Result<Toothed, String> {
        let profiles = |pair: Pair<ProfileRecord>| pair.try_map(|side, p| p.read(side));
        let generated = profiles(self.generated)?;
        let finished = self.finished.map(profiles).transpose()?;
        let finished = finished.unwrap_or_else(|| generated.clone());
        let loaded = self.loaded.map(|[behind, ahead]| {
            let read = |record: LoadedRecord| {
                let offset = record.offset;
                record.motion.read("loaded").map(|motion| LoadedMotion::new(motion, offset))
            };
            Ok::<_, String>([read(behind)?, read(ahead)?])
        });
        Ok(Toothed {
            pair: ToothedPair {
                driver: generated.driver,
                follower: generated.follower,
                module: sized.module,
                uncovered: self.uncovered,
                cuts: self.cuts,
                records: self.teeth,
                loaded: loaded.transpose()?,
            },
            sized: Arc::new(sized),
            finished,
            diagnostics: self.diagnostics,
        })
    }
}

/// What was read of the stages; contact and strength are not worked out yet.
#[derive(Clone, Debug)]
pub(super) struct Kept {
    asked: Request,
    used: DesignOptions,
    revisions: Vec<Revision>,
    toothed: Arc<Toothed>,
    proven: Vec<Diagnostic>,
    outfitted: Vec<Diagnostic>,
}

impl Kept {
    /// All stages; the runs themselves are not kept, only what they showed.
    pub(super) fn stages(
        &self,
        saved: &SavedDesign,
        control: &Control,
    ) -> Result<Stages, PipelineError> {
        let options = &self.asked.options;
        let toothed = &self.toothed;
        let analysed = toothed.analysed(options, control)?;
        let strength = analysed.strength(options);
        let analysed = Arc::new(analysed);
        let diagnostics = self.proven.clone();
        let proven = Arc::new(Proven { analysed: analysed.clone(), report: None, diagnostics });
        let outfitted = Outfitted {
            proven: proven.clone(),
            assembly: saved.assembly(),
            strength,
            diagnostics: self.outfitted.clone(),
        };
        Ok(Stages {
            asked: self.asked.clone(),
            used: self.used.clone(),
            revisions: self.revisions.clone(),
            wanted: toothed.sized.wanted.clone(),
            sized: Some(toothed.sized.clone()),
            toothed: Some(toothed.clone()),
            analysed: Some(analysed),
            proven: Some(proven),
            outfitted: Some(Arc::new(outfitted)),
        })
    }
}
