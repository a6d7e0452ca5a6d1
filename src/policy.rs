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
