//! From a wish to a finished pair of gears, in stages.
//!
//! A [`Request`] says what is wanted: two shapes, one shape, or a motion, and every option. It becomes, one after the
//! other, [`Wanted`] (the motion), [`Sized`] (pitch curves at their size), [`Toothed`] (outlines), [`Analysed`] (their
//! contact), [`Proven`] (rigid-body runs) and [`Outfitted`] (bores, hubs, lettering, base). A stage never changes; it holds
//! the one before it and what it found out ([`crate::diagnose::Diagnostic`]).
//!
//! A [`Session`] makes the stages and keeps those of earlier requests: only what depends on a changed part of a request is
//! made again. It tries gentler teeth and less slope where a pair fails (the repairs in `revision.rs`), tells a watcher of
//! every stage, and stops when its [`Control`](crate::control::Control) says so. [`design`], [`mate`] and [`from_motion`]
//! are short ways for one request.

mod analysed;
mod bounds;
mod feasibility;
mod finished;
mod options;
pub mod outfit;
mod outfitted;
mod proven;
mod request;
mod revision;
mod sector;
mod session;
mod sized;
mod toothed;
mod wanted;

pub use analysed::Analysed;
pub use bounds::Bounds;
pub use finished::{Design, design, from_motion, mate};
pub use options::{BoreChoice, DesignOptions, PipelineError, Scale, TeethStyle, ToothCount};
pub use outfitted::Outfitted;
pub use proven::Proven;
pub use request::{Drawn, Request, Source};
pub use revision::Revision;
pub use session::{Session, Stage, Stages};
pub use sized::Sized;
pub use toothed::Toothed;
pub use wanted::Wanted;
