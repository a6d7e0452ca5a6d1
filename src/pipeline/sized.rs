//! The second stage: both pitch curves at their size, gentle enough for a number of teeth.

use std::sync::Arc;

use super::bounds::{Bounds, driver_teeth};
use super::wanted::{CHANGE_WORTH_SAYING, Wanted};
use super::{DesignOptions, PipelineError, Scale, ToothCount};
use crate::control::{Control, StageName};
use crate::diagnose::{Code, Diagnostic, Place};
use crate::fit::{self, FittedGear, LimitCost, Limits};
use crate::gear::{Motion, Pair, Side};
use crate::geometry::{self, Point};
use crate::input::{Inner, Shape};
use crate::pitch::{Centrodes, Transmission};
use crate::policy;

/// Share of a drawing's area hidden from the axis that a person wants to hear of.
const HIDDEN_AREA_WORTH_SAYING: f64 = policy::LOST_AREA_WORTH_SAYING;

/// Pitch curves at their size.
#[derive(Clone, Debug)]
pub struct Sized {
    /// The stage before.
    pub wanted: Arc<Wanted>,
    /// The pitch curves that carry the teeth.
    pub centrodes: Centrodes,
    /// Teeth of each gear.
    pub teeth: Pair<u32>,
    /// Module, mm.
    pub module: f64,
    /// The bounds that the pitch curves keep.
    pub bounds: Bounds,
    /// What these changed of the motion before any bounds.
    pub rounding: LimitCost,
    /// Each gear's pitch curve in its own frame, mm.
    pub pitch_curves: Pair<Vec<Point>>,
    /// Each drawing as it lies on its gear, with the area of the pitch curve, mm; empty without a drawing.
    pub inputs: Pair<Vec<Point>>,
    /// Likeness of pitch curve and drawing: area of intersection over union.
    pub likeness: Pair<Option<f64>>,
    /// What was found out.
    pub diagnostics: Vec<Diagnostic>,
}

/// The part of a request that this stage depends on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Part {
    scale: Scale,
    teeth: ToothCount,
    addendum: f64,
    limits: Limits,
    bounds: Bounds,
}

impl Part {
    /// `teeth`: the number in place of the one asked for.
    pub(super) fn of(options: &DesignOptions, bounds: Bounds, teeth: Option<u32>) -> Self {
        Self {
            scale: options.scale,
            teeth: teeth.map_or(options.teeth, ToothCount::Teeth),
            addendum: options.addendum,
            limits: options.fit.limits,
            bounds,
        }
    }

    pub(super) fn make(
        &self,
        wanted: &Arc<Wanted>,
        control: &Control,
    ) -> Result<Sized, PipelineError> {
        let bounds = self.bounds;
        let of_size = (self.scale, self.addendum);
        let teeth = driver_teeth(wanted, self.teeth, of_size, (bounds, &self.limits))?;
        control.check()?;
        let (transmission, rounding) = if bounds.exact {
            (wanted.transmission.clone(), wanted.limited)
        } else {
            let folds = wanted.folds();
            let limits = bounds.limits(teeth, &self.limits);
            let (samples, rounding) = fit::apply(&wanted.raw, folds, &limits)?;
            let samples =
                if wanted.symmetric { fit::symmetrised(&samples)?.samples } else { samples };
            (Transmission::from_derivative(&samples, folds.0, folds.1)?, rounding)
        };
        control.check()?;
        let centrodes = scaled(transmission, self.scale, self.addendum, Some(teeth));
        let module = centrodes.perimeter().0 / (std::f64::consts::PI * f64::from(teeth));
        let pitch_curves = Pair {
            driver: centrodes.driver_curve(policy::PITCH_CURVE_POINTS),
            follower: centrodes.follower_curve(policy::PITCH_CURVE_POINTS),
        };
        let inputs = wanted.drawings.as_ref().map_sides(|side, drawn| {
            let placed = |d: &super::Drawn| placed_input(&d.shape, &d.gear, &pitch_curves[side]);
            drawn.as_ref().map_or_else(Vec::new, placed)
        });
        let likeness = wanted.drawings.as_ref().map_sides(|side, drawn| {
            drawn.as_ref()?;
            Some(geometry::intersection_over_union(&pitch_curves[side], &inputs[side]))
        });
        let (driver_fold, follower_fold) = wanted.folds();
        let follower_teeth = teeth * follower_fold / driver_fold;
        let mut made = Sized {
            wanted: wanted.clone(),
            centrodes,
            teeth: Pair { driver: teeth, follower: follower_teeth },
            module,
            bounds,
            rounding,
            pitch_curves,
            inputs,
            likeness,
            diagnostics: Vec::new(),
        };
        made.diagnostics = made.found();
        Ok(made)
    }
}

impl Sized {
    /// Driver angle after which both gears are back where they began, radians.
    #[must_use]
    pub fn cycle(&self) -> f64 {
        self.centrodes.transmission.cycle()
    }

    /// What is drawn inside of a gear's shape, as it lies on the gear.
    pub(super) fn inner(&self, side: Side) -> Inner {
        let placed = |d: &super::Drawn| {
            d.shape.inner.mapped(placing(&d.shape, &d.gear, &self.pitch_curves[side]))
        };
        self.wanted.drawings[side].as_ref().map_or_else(Inner::default, placed)
    }

    fn found(&self) -> Vec<Diagnostic> {
        let (stage, wanted) = (StageName::Sized, &self.wanted);
        let mut found = Vec::new();
        let rounded = self.rounding.shape - wanted.limited.shape;
        if rounded > CHANGE_WORTH_SAYING {
            found.push(Diagnostic::note(Code::CornersRounded, stage).with("shape", rounded));
        }
        if wanted.exact && !self.bounds.exact {
            let angle = wanted.strays(&self.centrodes.transmission);
            found.push(Diagnostic::note(Code::MotionChanged, stage).with("angle", angle));
        }
        for side in Side::BOTH {
            let Some(drawn) = &wanted.drawings[side] else { continue };
            let warning = |code, share| {
                let warning = Diagnostic::warning(code, stage).at(Place::Gear(side));
                warning.about(&drawn.shape.name).with("share", share)
            };
            if let Some(share) = self.likeness[side].filter(|s| *s < policy::POOR_LIKENESS) {
                found.push(warning(Code::PoorLikeness, share));
            }
            if drawn.gear.lost_area > HIDDEN_AREA_WORTH_SAYING {
                found.push(warning(Code::HiddenArea, drawn.gear.lost_area));
            }
        }
        found
    }
}

/// The pitch curves at the size asked for; the extent counts the tips of `teeth` driver teeth.
pub(super) fn scaled(
    transmission: Transmission,
    scale: Scale,
    addendum: f64,
    teeth: Option<u32>,
) -> Centrodes {
    match scale {
        Scale::CenterDistance(center_distance) => Centrodes { transmission, center_distance },
        Scale::Extent(extent) => {
            let unit = Centrodes { transmission, center_distance: 1.0 };
            let mut points = unit.driver_curve(policy::PITCH_CURVE_POINTS);
            let follower = unit.follower_curve(policy::PITCH_CURVE_POINTS);
            points.extend(follower.iter().map(|p| Point::new(p.x + 1.0, p.y)));
            let (low, high) = geometry::bounds(&points);
            let module =
                |count: u32| unit.perimeter().0 / (std::f64::consts::PI * f64::from(count));
            let tips = 2.0 * addendum * teeth.map_or(0.0, module);
            let size = (high - low).max() + tips;
            Centrodes { center_distance: extent / size, ..unit }
        }
    }
}

/// The drawing as it lies on its gear.
fn placed_input(shape: &Shape, gear: &FittedGear, pitch_curve: &[Point]) -> Vec<Point> {
    shape.raw.points().iter().map(placing(shape, gear, pitch_curve)).collect()
}

/// What takes a drawing to its gear: the fitted pose, scaled to the area of the pitch curve.
fn placing(
    shape: &Shape,
    gear: &FittedGear,
    pitch_curve: &[Point],
) -> impl Fn(&Point) -> Point + use<> {
    let placement = gear.placement;
    let placed: Vec<Point> = shape.raw.points().iter().map(|p| placement.apply(*p)).collect();
    let scale = (geometry::area(pitch_curve) / geometry::area(&placed)).sqrt();
    move |p| placement.apply(*p) * scale
}
