//! Strength.

/// Least cosine between the force on a tooth and the way its point moves (85 degrees): steeper pairs bind, and a force
/// without bounds would say nothing.
pub const LEAST_FORCE_COSINE: f64 = 0.087;
/// Sections of a tooth that are tried for the weakest; the factor changes by the square of a step.
pub const LEWIS_SECTIONS: u32 = 200;
/// Sections nearer to the vertex of the parabola than this bear no bending, in modules.
pub const LEWIS_LEAST_DEPTH: f64 = 0.05;
/// Depth, in half tips, over which the direction of a flank at its tip is taken: longer than the least edges.
pub const LEWIS_FLANK_STEP: f64 = 0.05;
