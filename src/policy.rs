//! Every numeric tolerance of the program, each with its unit and its reason.
//!
//! Lengths are relative to the thing they guard (gear module, size of a
//! shape), so that a design scales without changing its decisions.

// Pitch and fit.

/// Samples a transmission function needs at least: fewer cannot carry even one bump each way.
pub const MIN_TRANSMISSION_SAMPLES: usize = 8;
/// Least psi' over its mean. Below it a gear's radius is less than a thousandth of the other's: it passes through its own axis.
pub const MIN_RELATIVE_SPEED: f64 = 1e-3;
/// Cap on safeguarded Newton steps; bisection alone reaches rounding in 53.
pub const MAX_NEWTON_STEPS: usize = 60;
/// Least radius of a shape about a rotation centre over its greatest; below it the centre counts as on the boundary.
pub const MIN_RELATIVE_RADIUS: f64 = 1e-6;
/// Area (relative) that rounding may add to a star-shaped curve without its being called lost.
pub const STAR_SHAPED_WITHIN: f64 = 1e-9;
/// Greatest K or 1/K: beyond it the small gear's features vanish beside the large gear's.
pub const MAX_RATIO: u32 = 100;
/// Default lean bound, radians (60 degrees): steeper flanks bind under friction and swing by clearance.
pub const DEFAULT_MAX_LEAN: f64 = std::f64::consts::FRAC_PI_3;
/// Relative excess over a bound that counts as rounding.
pub const LIMIT_ROUNDING: f64 = 1e-9;
/// Rounds of bounding, each tighter by what the spline exceeded; past them psi' is drawn to its mean.
pub const LIMIT_ROUNDS: usize = 8;
/// Extra tightening of a round, so that the rounds do not creep up on the bound for ever.
pub const LIMIT_TIGHTENING: f64 = 0.998;
/// Most by which one round tightens a bound.
pub const LIMIT_LARGEST_STEP: f64 = 0.8;
/// Halvings when psi' is drawn to its mean: the pull is found to a millionth.
pub const LIMIT_BISECTIONS: usize = 20;
/// Binomial smoothing passes over the kinks of a Lipschitz envelope, so that the spline does not overshoot there.
pub const LEAN_SMOOTHING_PASSES: usize = 4;
/// Rounds of local diffusion for one curvature bound.
pub const CURVATURE_ROUNDS: usize = 60;
/// Reach of one diffusion round over the radian length of a curve at the bound: larger rounds off more than it must.
pub const CURVATURE_DIFFUSION: f64 = 0.15;
/// Samples by which diffusion spreads beyond those over the bound, halved in strength at each.
pub const CURVATURE_SPREAD: usize = 4;
