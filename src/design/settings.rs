//! What is varied until teeth fit: their number, and bounds on the pitch curves.

use super::attempt::scaled;
use super::source::Source;
use super::{DesignError, DesignOptions, ToothCount};
use crate::fit;
use crate::pitch::Centrodes;
use crate::policy;

/// What may be changed from one attempt to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Settings {
    pub(super) teeth: u32,
    /// Bound on curvature times module.
    curvature: f64,
    max_lean: f64,
    /// Whether the motion is taken as it is, without bounds.
    pub(super) exact: bool,
}

impl Settings {
    /// The same with the lean held `less` radians below what these allow.
    pub(super) fn with_less_lean(&self, less: f64) -> Self {
        Self { max_lean: self.max_lean - less, exact: false, ..*self }
    }

    /// Steepest lean allowed, radians.
    pub(super) fn max_lean(&self) -> f64 {
        self.max_lean
    }

    /// The settings asked for, the number of teeth chosen if it was left open.
    pub(super) fn first(source: &Source<'_>, options: &DesignOptions) -> Result<Self, DesignError> {
        let transmission = &source.transmission;
        let folds = source.folds();
        let mut settings = Self {
            teeth: 0,
            curvature: policy::CURVATURE_TIMES_MODULE,
            max_lean: options.fit.limits.max_lean,
            exact: source.exact,
        };
        let perimeter = |centrodes: &Centrodes| centrodes.perimeter().0;
        match options.teeth {
            ToothCount::Teeth(count) => {
                if count % folds.0 != 0 {
                    return Err(DesignError::Option {
                        name: "the number of driver teeth",
                        value: f64::from(count),
                        remedy: format!("give a multiple of {}, as the ratio demands", folds.0),
                    });
                }
                settings.teeth = count;
            }
            ToothCount::Module(module) => {
                let centrodes = scaled(transmission.clone(), options, None);
                let count = perimeter(&centrodes) / (std::f64::consts::PI * module);
                settings.teeth = whole_teeth(count, folds);
            }
            ToothCount::Auto => {
                let centrodes = scaled(transmission.clone(), options, None);
                let most =
                    perimeter(&centrodes) / (std::f64::consts::PI * policy::SMALLEST_CHOSEN_MODULE);
                let bend = if source.exact { source.bend() } else { 0.0 };
                let (fewest, greatest) = teeth_range(folds);
                for count in policy::TOOTH_COUNTS {
                    let count = whole_teeth(f64::from(count.max(fewest).min(greatest)), folds);
                    if settings.teeth != 0 && f64::from(count) > most {
                        break;
                    }
                    settings.teeth = count;
                    let follows = if source.exact {
                        bend <= settings.curvature * std::f64::consts::PI * f64::from(count)
                    } else {
                        let (_, cost) = fit::apply(&source.raw, folds, &settings.limits(options))?;
                        cost.shape - source.limited.shape < policy::ROUNDING_ACCEPTED
                    };
                    if follows {
                        break;
                    }
                }
            }
        }
        let (least, most) = policy::TEETH_RANGE;
        let follower = settings.teeth * folds.1 / folds.0;
        let remedy = if matches!(options.teeth, ToothCount::Teeth(_)) {
            let (fewest, greatest) = teeth_range(folds);
            format!("give {fewest} to {greatest} driver teeth")
        } else {
            format!("choose a module that gives {least} to {most} teeth")
        };
        for (name, count) in [
            ("the number of driver teeth", settings.teeth),
            ("the number of follower teeth", follower),
        ] {
            if !(least..=most).contains(&count) {
                return Err(DesignError::Option { name, value: f64::from(count), remedy });
            }
        }
        Ok(settings)
    }

    /// Bounds on the motion for these settings.
    pub(super) fn limits(&self, options: &DesignOptions) -> fit::Limits {
        fit::Limits {
            max_lean: self.max_lean,
            max_curvature: Some(self.curvature * std::f64::consts::PI * f64::from(self.teeth)),
            ..options.fit.limits
        }
    }

    /// Settings that ask less of the teeth than these, which led to this lean, and what they change.
    pub(super) fn gentler(&self, lean: f64) -> (Self, String) {
        let mut next = *self;
        if self.exact {
            next.exact = false;
            let said = format!(
                "lean held to {:.0} degrees and pitch curves rounded to a radius of {:.2} modules",
                next.max_lean.to_degrees(),
                1.0 / next.curvature
            );
            return (next, said);
        }
        if lean > policy::LEAN_WORTH_REDUCING && self.curvature < policy::CURVATURE_TIMES_MODULE {
            next.max_lean = (lean - policy::LEAN_REPAIR).min(self.max_lean);
            (next, format!("lean held to {:.0} degrees", next.max_lean.to_degrees()))
        } else {
            next.curvature *= policy::CURVATURE_REPAIR;
            (
                next,
                format!("pitch curves rounded to a radius of {:.2} modules", 1.0 / next.curvature),
            )
        }
    }
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
