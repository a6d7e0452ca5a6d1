//! Rolling kinematics: polar curves, transmission functions and the pair of
//! pitch curves (centrodes) that roll on each other.

mod centrodes;
mod transmission;

pub use centrodes::Centrodes;
pub use transmission::{Transmission, TransmissionError};
