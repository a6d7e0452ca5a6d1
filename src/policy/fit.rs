//! Pitch curves and the search for a pair.

// Pitch and fit.

/// Samples a transmission function needs at least: fewer cannot carry even one bump each way.
pub const MIN_TRANSMISSION_SAMPLES: usize = 8;
/// Least psi' over its mean. Below it a gear's radius is less than a thousandth of the other's: it passes through its own axis.
pub const MIN_RELATIVE_SPEED: f64 = 1e-3;
/// Greatest sample of psi' that is worked with as it is; larger and smaller ones are scaled first, for sums of their
/// squares would overflow or vanish.
pub const SAMPLE_RANGE: (f64, f64) = (1e-100, 1e100);
/// Cap on safeguarded Newton steps; bisection alone reaches rounding in 53.
pub const MAX_NEWTON_STEPS: usize = 60;

// Rounding of pitch curves.

/// Standard deviation of the blur where nothing is too sharp, samples: it takes the kinks of the
/// lean bound away and nothing that can be seen.
pub const BLUR_LEAST: f64 = 1.0;
/// Widest blur, as a share of one period.
pub const BLUR_MOST: f64 = 0.06;
/// Rounds in which the blur may widen. With the growth below they reach from the least to the widest.
pub const BLUR_ROUNDS: usize = 40;
/// Least and largest factor by which a blur widens in one round.
pub const BLUR_GROWTH: (f64, f64) = (1.12, 1.6);
/// Change of a blur's standard deviation from sample to sample at most; faster changes make kinks.
pub const BLUR_WIDTH_SLOPE: f64 = 0.25;
/// Smoothing passes over the widths, so that the blur sets in gently.
pub const BLUR_WIDTH_PASSES: usize = 8;
/// Standard deviations at which the Gaussian is cut off: what is left out is below 1e-4.
pub const BLUR_REACH: f64 = 3.7;
/// Driver poses per period when the follower is carved as solids: the paper's N.
pub const SOLID_CARVING_POSES: u32 = 1024;
/// Height in modules by which a tooth may fall short and still count as full.
pub const HEIGHT_GIVEN_UP: f64 = 0.02;
/// Pressure angles closer than this (radians) count as the same.
pub const SAME_ANGLE: f64 = 1e-6;
/// Thinnest wall between opposite sides of a gear's body that goes without a warning, in modules.
pub const THIN_WALL: f64 = 0.5;
/// Chord of the rounded corners of the body in that check, radians of arc.
pub const BODY_CHORD: f64 = 0.3;
/// Area (relative) that rounding may add to a star-shaped curve without its being called lost.
pub const STAR_SHAPED_WITHIN: f64 = 1e-9;
/// Greatest K or 1/K: beyond it the small gear's features vanish beside the large gear's.
pub const MAX_RATIO: u32 = 100;
