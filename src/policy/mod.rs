//! Every numeric tolerance of the program, each with its unit and its reason, one file a concern.
//!
//! Lengths are relative to the thing they guard (gear module, size of a
//! shape), so that a design scales without changing its decisions.

mod check;
mod design;
mod export;
mod fit;
mod gallery;
mod law;
mod meshing;
mod outfit;
mod outline;
mod polish;
mod reading;
mod report;
mod solid;
mod strength;
mod teeth;
mod train;

pub use check::*;
pub use design::*;
pub use export::*;
pub use fit::*;
pub use gallery::*;
pub use law::*;
pub use meshing::*;
pub use outfit::*;
pub use outline::*;
pub use polish::*;
pub use reading::*;
pub use report::*;
pub use solid::*;
pub use strength::*;
pub use teeth::*;
pub use train::*;
