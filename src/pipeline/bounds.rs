//! What is varied until teeth fit: bounds on the pitch curves; and how many teeth there are.

use super::sized::scaled;
use super::wanted::Wanted;
use super::{PipelineError, Scale, ToothCount};
use crate::control::StageName;
use crate::diagnose::{Code, Diagnostic};
use crate::fit::{self, Limits};
use crate::policy;

/// Largest curvature of a pitch curve times the module, first choice. At a constant curvature flanks of 30 degrees hand
/// motion on up to 0.40; a corner that is that sharp over less than a pitch may be sharper, and what this leaves is found
/// by the contact analysis and repaired.
const CURVATURE_TIMES_MODULE: f64 = 0.5;
/// Factor on that bound at each repair: coarser steps cost likeness, finer ones attempts.
const CURVATURE_REPAIR: f64 = 0.75;
/// Taken from the bound on the slope at each repair: 5 degrees.
pub(super) const SLOPE_REPAIR: f64 = 5.0 * std::f64::consts::PI / 180.0;
/// Slope below which reducing it gains less than it costs in likeness: 40 degrees.
const SLOPE_WORTH_REDUCING: f64 = 40.0 * std::f64::consts::PI / 180.0;
/// Tooth counts that are tried, smallest first.
const TOOTH_COUNTS: [u32; 7] = [24, 32, 40, 48, 56, 64, 72];
/// Change of shape (in the measure of E_s) by rounding corners below which fewer teeth are taken.
const ROUNDING_ACCEPTED: f64 = 0.03;
/// Smallest module chosen without being asked, mm: below it a common printer fails.
const SMALLEST_CHOSEN_MODULE: f64 = 1.2;

/// Bounds that the pitch curves keep for the sake of the teeth.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Bounds {
    /// Greatest curvature of a pitch curve times the module.
    pub curvature: f64,
    /// Steepest slope of a pitch curve against its radius, radians.
    pub max_lean: f64,
    /// Whether the motion is taken as it is, without bounds.
    pub exact: bool,
}

impl Bounds {
    /// Those asked for.
    pub(super) fn first(wanted: &Wanted, max_lean: f64) -> Self {
        Self { curvature: CURVATURE_TIMES_MODULE, max_lean, exact: wanted.exact }
    }

    /// The same with the slope held `less` radians below what these allow.
    pub(super) fn with_less_slope(self, less: f64) -> Self {
        Self { max_lean: self.max_lean - less, exact: false, ..self }
    }

    /// Bounds that ask less of the teeth than these, which led to this slope; and a note of what they change.
    pub(super) fn gentler(self, slope: f64) -> (Self, Diagnostic) {
        let note = Diagnostic::note(Code::GentlerTeeth, StageName::Sized);
        let mut next = self;
        if self.exact {
            next.exact = false;
            let note = note.with("slope", next.max_lean).with("radius", 1.0 / next.curvature);
            return (next, note);
        }
        if slope > SLOPE_WORTH_REDUCING && self.curvature < CURVATURE_TIMES_MODULE {
            next.max_lean = (slope - SLOPE_REPAIR).min(self.max_lean);
            (next, note.with("slope", next.max_lean))
        } else {
            next.curvature *= CURVATURE_REPAIR;
            (next, note.with("radius", 1.0 / next.curvature))
        }
    }

    /// Bounds on a motion that carries `teeth` driver teeth, besides those asked for.
    pub(super) fn limits(&self, teeth: u32, asked: &Limits) -> Limits {
        Limits {
            max_lean: self.max_lean,
            max_curvature: Some(self.curvature * std::f64::consts::PI * f64::from(teeth)),
            ..*asked
        }
    }
}

/// The number of driver teeth asked for, or a good one if it was left open.
pub(super) fn driver_teeth(
    wanted: &Wanted,
    teeth: ToothCount,
    (scale, addendum): (Scale, f64),
    (bounds, asked): (Bounds, &Limits),
) -> Result<u32, PipelineError> {
    let folds = wanted.folds();
    let perimeter = || scaled(wanted.transmission.clone(), scale, addendum, None).perimeter().0;
    let mut chosen = 0;
    match teeth {
        ToothCount::Teeth(count) => {
            if count % folds.0 != 0 {
                return Err(PipelineError::Option {
                    name: "the number of driver teeth",
                    value: f64::from(count),
                    remedy: format!("give a multiple of {}, as the ratio demands", folds.0),
                });
            }
            chosen = count;
        }
        ToothCount::Module(module) => {
            chosen = whole_teeth(perimeter() / (std::f64::consts::PI * module), folds);
        }
        ToothCount::Auto => {
            let most = perimeter() / (std::f64::consts::PI * SMALLEST_CHOSEN_MODULE);
            let bend = if wanted.exact { wanted.bend() } else { 0.0 };
            let (fewest, greatest) = teeth_range(folds);
            for count in TOOTH_COUNTS {
                let count = whole_teeth(f64::from(count.max(fewest).min(greatest)), folds);
                if chosen != 0 && f64::from(count) > most {
                    break;
                }
                chosen = count;
                let follows = if wanted.exact {
                    bend <= bounds.curvature * std::f64::consts::PI * f64::from(count)
                } else {
                    let (_, cost) = fit::apply(&wanted.raw, folds, &bounds.limits(count, asked))?;
                    cost.shape - wanted.limited.shape < ROUNDING_ACCEPTED
                };
                if follows {
                    break;
                }
            }
        }
    }
    let (least, most) = policy::TEETH_RANGE;
    let follower = chosen * folds.1 / folds.0;
    let remedy = if matches!(teeth, ToothCount::Teeth(_)) {
        let (fewest, greatest) = teeth_range(folds);
        format!("give {fewest} to {greatest} driver teeth")
    } else {
        format!("choose a module that gives {least} to {most} teeth")
    };
    for (name, count) in
        [("the number of driver teeth", chosen), ("the number of follower teeth", follower)]
    {
        if !(least..=most).contains(&count) {
            return Err(PipelineError::Option { name, value: f64::from(count), remedy });
        }
    }
    Ok(chosen)
}

fn whole_teeth(count: f64, folds: (u32, u32)) -> u32 {
    ((count / f64::from(folds.0)).round().max(1.0) as u32).saturating_mul(folds.0)
}

/// Fewest and most driver teeth with which both gears have a number within [`policy::TEETH_RANGE`].
fn teeth_range((driver, follower): (u32, u32)) -> (u32, u32) {
    let (least, most) = policy::TEETH_RANGE;
    let fewest = driver.saturating_mul(least.div_ceil(follower));
    let greatest = driver.saturating_mul(most / follower);
    (least.max(fewest), most.min(greatest))
}
