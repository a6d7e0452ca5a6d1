//! The two gears of a pair: which of them is meant, what is known of both, how one turns with the other, and where their
//! pitch curves touch.

mod gearing;
mod motion;
mod pair;
mod sampled;
mod side;

pub use gearing::{Gearing, PitchPoint};
pub use motion::{EvenMotion, Mirrored, Motion};
pub use pair::Pair;
pub use sampled::{MotionError, SampledMotion};
pub use side::Side;
