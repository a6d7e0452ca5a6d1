//! Centrode turns two drawings into a pair of non-circular gears that mesh.

pub mod assembly;
pub mod check;
pub mod design;
pub mod export;
pub mod fit;
pub mod gallery;
pub mod geometry;
pub mod law;
pub mod meshing;
pub mod outline;
pub mod pitch;
pub mod policy;
pub mod report;
pub mod scene;
pub mod solid;
pub mod teeth;
