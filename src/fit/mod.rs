//! Choosing the motion from two shapes: objective, alignment, search for the
//! rotation centres, and bounds that keep the pair drivable.
//!
//! [`fit`] is sections 4, 5.1 and 5.2 of the paper: each shape, turned about a
//! centre, would impose a law psi'; the centres and the shift are chosen where the
//! two laws differ least, and the pair gets the blend of both. Every length in a
//! [`Fit`] is for a centre distance of 1.

mod align;
mod difference;
mod fitter;
mod global_search;
mod grid;
mod laws;
mod likeness;
mod limits;
mod lipschitz;
mod mate;
mod objective;
mod paper_search;
mod placement;
mod polish;
mod ratio;
mod refine;
mod scan;
mod sketch;
mod symmetric;

pub use difference::difference;
pub use fitter::Fitter;
pub use likeness::contour_share;
pub use limits::{LimitCost, LimitError, Limits, apply};
pub use mate::{Mated, mate};
pub use objective::{Fixed, Objective};
pub use placement::{FittedGear, Similarity};
pub use polish::Refinement;
pub use ratio::{Ratio, RatioError};
pub use symmetric::{Symmetric, symmetrised};

use crate::control::{Cancelled, Control};
use crate::outline::Outline;
use crate::pitch::{PolarError, Transmission, TransmissionError};
use crate::policy;

/// How rotation centres are searched.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Search {
    /// The paper's recursive 3 x 3 grid: J = 3, depth 3, 128 shifts.
    Paper,
    /// The dense grid of [`Self::Global`] without continuous refinement: a first answer in a tenth of a second. With
    /// [`FitOptions::refine`] only its few best are moved on.
    Coarse,
    /// A dense grid of more than 50,000 pairs at every shift, then continuous refinement; never worse than `Paper`.
    #[default]
    Global,
}

/// What a fit can be told.
#[derive(Clone, Debug, PartialEq)]
pub struct FitOptions {
    /// How centres are searched.
    pub search: Search,
    /// t of Eq. 14 in 0..=1: 1 keeps the driver's shape, 0 the follower's.
    pub balance: f64,
    /// omega of Eq. 11, the weight of the greatest torque.
    pub weight: f64,
    /// Bounds on the blended law.
    pub limits: Limits,
    /// Samples of one period of psi' (the paper's N).
    pub samples: usize,
    /// What the search may not choose.
    pub fixed: Fixed,
    /// Whether both gears must have the same pitch curve; both shapes must then be one, and the ratio 1.
    pub symmetric: bool,
    /// Weight in E of the shares of area that cannot be seen from the axes (see [`Objective::lost_cost`]).
    pub star_weight: f64,
    /// Whether motion, axes and drawings' places are moved on together after the search, until the pitch curves cover the
    /// drawings best.
    pub refine: bool,
    /// How many starts a refinement makes, [`EFFORTS`]: each step takes about four times as long as the one before.
    pub effort: u8,
    /// Which of [`alternatives`] is taken, counted from 1; none for the best pair, which is found faster.
    pub choose: Option<usize>,
}

/// Most different pairs that are looked for.
pub const MOST_ALTERNATIVES: usize = 12;

/// Least and greatest [`FitOptions::effort`].
pub const EFFORTS: std::ops::RangeInclusive<u8> = 1..=5;

impl Default for FitOptions {
    fn default() -> Self {
        Self {
            search: Search::default(),
            balance: 0.5,
            weight: policy::DEFAULT_TORQUE_WEIGHT,
            limits: Limits::default(),
            samples: policy::DEFAULT_FIT_SAMPLES,
            fixed: Fixed::default(),
            symmetric: false,
            star_weight: policy::DEFAULT_STAR_WEIGHT,
            refine: true,
            effort: 2,
            choose: None,
        }
    }
}

/// Why two shapes were not fitted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FitError {
    /// t lies outside 0..=1.
    #[error(
        "a balance of {balance} has no meaning; give one from 0 (keep the follower's shape) to 1 (keep the driver's)"
    )]
    Balance {
        /// Balance asked for.
        balance: f64,
    },
    /// omega is negative or not finite.
    #[error("a torque weight of {weight} has no meaning; give 0 or more, 0.2 as in the paper")]
    Weight {
        /// Weight asked for.
        weight: f64,
    },
    /// The weight of lost area is negative or not finite.
    #[error("a star weight of {weight} has no meaning; give 0 or more, 0 to count no lost area")]
    StarWeight {
        /// Weight asked for.
        weight: f64,
    },
    /// No such effort.
    #[error("an effort of {effort} is out of range; give {} to {}", EFFORTS.start(), EFFORTS.end())]
    Effort {
        /// Effort asked for.
        effort: u8,
    },
    /// No such alternative.
    #[error(
        "there is no pair {choose} to choose: these shapes make {found} different pairs; give 1 to {found}"
    )]
    NoSuchAlternative {
        /// Number asked for.
        choose: usize,
        /// Different pairs found.
        found: usize,
    },
    /// Too few or too many samples.
    #[error("{samples} samples of the law are out of range; give {least} to {most}")]
    Samples {
        /// Samples asked for.
        samples: usize,
        /// Least allowed.
        least: usize,
        /// Most allowed at this ratio.
        most: usize,
    },
    /// Two shapes at a ratio that is neither whole nor the reciprocal of a whole number.
    #[error(
        "two shapes cannot be fitted at a ratio of {ratio}; give a whole number or the reciprocal of one, or make the pair from a motion or from one shape"
    )]
    Rational {
        /// Ratio asked for.
        ratio: Ratio,
    },
    /// Two shapes or a ratio that cannot give equal gears.
    #[error(
        "both gears can be the same curve only {need}; name one shape twice and keep the ratio 1, or do not ask for symmetry"
    )]
    Symmetric {
        /// What is not given.
        need: &'static str,
    },
    /// A fixed axis or angle is not a number.
    #[error("a fixed axis or orientation is not a finite number; correct it or leave it out")]
    FixedNotFinite,
    /// No rotation centre inside a shape makes a pair.
    #[error("no pair of rotation centres inside the shapes makes a law; use thicker shapes")]
    NoCenter,
    /// The search was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// A shape cannot be seen from its centre.
    #[error(transparent)]
    Polar(#[from] PolarError),
    /// The limits cannot be kept.
    #[error(transparent)]
    Limit(#[from] LimitError),
    /// The bounded law is no transmission.
    #[error(transparent)]
    Transmission(#[from] TransmissionError),
}

/// Two shapes fitted to each other.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The pair's motion, limits kept. At driver angle 0 the driver's drawing stands upright.
    pub transmission: Transmission,
    /// Eq. 14 before limits: psi' at the driver angles of [`Transmission::samples`].
    pub raw: Vec<f64>,
    /// E and its parts.
    pub objective: Objective,
    /// What the limits changed.
    pub limited: LimitCost,
    /// The driver's drawing in its gear.
    pub driver: FittedGear,
    /// The follower's drawing in its gear.
    pub follower: FittedGear,
    /// Pairs of centres that were scored.
    pub pairs_scored: usize,
    /// What the refinement changed, if there was one.
    pub refinement: Option<Refinement>,
}

/// Finds rotation centres in both shapes and the motion that changes the shapes least.
///
/// The drawings may have any unit and size; only their forms matter. The same input always gives the same result, on any
/// number of threads.
///
/// # Errors
/// See [`FitError`].
pub fn fit(
    driver: &Outline,
    follower: &Outline,
    ratio: Ratio,
    options: &FitOptions,
    control: &Control,
) -> Result<Fit, FitError> {
    Fitter::default().fit(driver, follower, ratio, options, control)
}

/// The best `count` *different* pairs that two shapes make, best first: by J of the refinement, or by E without one.
///
/// The first is about what [`fit`] gives. Each differs from all before it by more than a neighbour would ([`difference`] of 0.08 at
/// least); where the shapes do not make so many different pairs there are fewer. At most [`MOST_ALTERNATIVES`] are looked for,
/// always in the same order: [`FitOptions::choose`] takes one by its number.
///
/// # Errors
/// See [`FitError`].
pub fn alternatives(
    driver: &Outline,
    follower: &Outline,
    ratio: Ratio,
    options: &FitOptions,
    count: usize,
    control: &Control,
) -> Result<Vec<Fit>, FitError> {
    Fitter::default().alternatives(driver, follower, ratio, options, count, control)
}

fn check(ratio: Ratio, options: &FitOptions) -> Result<(), FitError> {
    let FitOptions { balance, weight, samples, .. } = *options;
    if !(0.0..=1.0).contains(&balance) {
        return Err(FitError::Balance { balance });
    }
    if !(weight >= 0.0 && weight.is_finite()) {
        return Err(FitError::Weight { weight });
    }
    if !options.fixed.is_finite() {
        return Err(FitError::FixedNotFinite);
    }
    if !EFFORTS.contains(&options.effort) {
        return Err(FitError::Effort { effort: options.effort });
    }
    let weight = options.star_weight;
    if !(weight >= 0.0 && weight.is_finite()) {
        return Err(FitError::StarWeight { weight });
    }
    let windows = ratio.driver_fold().max(ratio.follower_fold()) as usize;
    let (least, most) = (policy::FIT_SAMPLES_LEAST, policy::FIT_SAMPLES_MOST / windows);
    if !(least..=most).contains(&samples) {
        return Err(FitError::Samples { samples, least, most });
    }
    Ok(())
}

#[cfg(test)]
mod tests;
