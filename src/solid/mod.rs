//! Gears as watertight solids: extrusion, bores, and the literal carving of a
//! follower by its driver, all through the Manifold kernel.
//!
//! Outlines are prisms over the gear's frame, from z = 0 to the thickness, in
//! mm. No mesh leaves this room before [`check`] has found it closed, oriented,
//! two-manifold, in one piece, of the right genus and volume.

mod bevel;
mod bore;
mod bore_name;
mod carve;
mod check;
mod error;
mod fixture;
mod gear;
pub mod hardware;
mod kernel;
mod mesh;
mod nozzle;
mod screw;
mod shading;
mod wall;

pub use bore::{Bore, circle, hole, pin_radius};
pub use bore_name::{BoreName, Fit, NoSuchBore, NotAScrew};
pub use carve::{Carved, carve_follower_with_manifold};
pub use check::{Expected, Fault, check};
pub use error::SolidError;
pub use fixture::fixture_solid;
pub use gear::{assembly_solids, gear_solid};
pub use kernel::Solid;
pub use mesh::Mesh;
pub use nozzle::{NOZZLE, PrintFinding, print_findings};
pub use shading::{Shading, shade};
pub use wall::fits;

#[cfg(test)]
mod fitted_tests;
#[cfg(test)]
pub(crate) use gear::tests;
