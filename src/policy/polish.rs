//! Refinement of a fit.

/// Default weight in E of the area that cannot be seen from an axis, as a share of the drawing's.
pub const DEFAULT_STAR_WEIGHT: f64 = 2.0;
/// Share of a drawing's area that must be lost before the loss is worth a warning.
pub const LOST_AREA_WORTH_SAYING: f64 = 0.005;
