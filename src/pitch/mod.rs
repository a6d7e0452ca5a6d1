//! Rolling kinematics: polar curves, transmission functions and the pair of
//! pitch curves (centrodes) that roll on each other.

mod centrodes;
mod polar;
mod transmission;

pub use centrodes::Centrodes;
pub use polar::{PolarCurve, PolarError};
pub use transmission::{Transmission, TransmissionError};

pub(crate) use polar::{center_distance, driver_law, follower_law};
