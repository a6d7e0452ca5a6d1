//! Choosing the motion from two shapes: objective, alignment, search for the
//! rotation centres, and bounds that keep the pair drivable.

mod align;
mod laws;
mod limits;
mod ratio;

pub use limits::{LimitCost, LimitError, Limits, apply};
pub use ratio::{Ratio, RatioError};
