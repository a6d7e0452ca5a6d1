//! Proof that two finished gears drive each other: quasi-static contact
//! analysis of their outlines.

mod contact;
mod index;
mod play;
#[cfg(test)]
mod spur;
mod summary;

pub use contact::{
    Contact, ContactAnalysis, ContactError, ContactInput, ContactOptions, ContactPose, analyse,
};
pub use summary::{ContactSummary, Deviation, LostArc, WorstPlace};
