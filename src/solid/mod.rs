//! Gears as watertight solids: extrusion, bores, and the literal carving of a
//! follower by its driver, all through the Manifold kernel.
//!
//! Outlines are prisms over the gear's frame, from z = 0 to the thickness, in
//! mm. No mesh leaves this room before [`check`] has found it closed, oriented,
//! two-manifold, in one piece, of the right genus and volume.

mod bore;
mod carve;
mod check;
mod error;
mod gear;
mod kernel;
mod mesh;
mod shading;

pub use bore::{Bore, circle, fits};
pub use carve::{Carved, carve_follower_with_manifold};
pub use check::{Expected, Fault, check};
pub use error::SolidError;
pub use gear::{assembly_solids, gear_solid};
pub use kernel::Solid;
pub use mesh::Mesh;
pub use shading::{Shading, shade};

#[cfg(test)]
pub(crate) use gear::tests;
