//! Proof that two finished gears drive each other: quasi-static contact
//! analysis of their outlines, and their exact convex parts.

mod contact;
mod index;
mod motion;
mod partition;
mod play;
#[cfg(test)]
mod spur;
mod summary;

pub use contact::{
    Contact, ContactAnalysis, ContactError, ContactInput, ContactOptions, ContactPose, analyse,
    poses_at,
};
pub use motion::{MotionError, SampledMotion};
pub use partition::{PartitionError, convex_partition};
pub use summary::{ContactSummary, Deviation, LostArc, WorstPlace};
