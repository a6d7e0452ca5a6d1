//! Proof that two finished gears drive each other: quasi-static contact
//! analysis of their outlines, a run of both as rigid bodies, and a verdict.

mod band;
mod contact;
mod csv;
mod dynamics;
mod gap;
mod index;
mod locking;
mod partition;
mod play;
mod pose;
mod profile;
mod recorder;
mod run;
#[cfg(test)]
mod spur;
mod summary;
mod surface;
mod touches;
mod train;
mod verdict;
mod world;

pub use contact::{ContactAnalysis, ContactError, ContactInput, ContactOptions, analyse, poses_at};
pub use csv::write_csv;
pub use dynamics::simulate;
pub use gap::{Gap, GapFinder};
pub use locking::{Foretold, foretell};
pub use partition::{PartitionError, convex_partition};
pub use pose::{Contact, ContactPose};
pub use run::{
    Direction, Drive, Dynamics, DynamicsError, DynamicsInput, DynamicsOptions, DynamicsSummary,
    Step, Stop,
};
pub use summary::{ContactSummary, Deviation, LostArc, WorstPlace};
pub use touches::Touches;
pub use train::{
    MeshFigures, MeshPlay, TrainPlay, TrainRun, TrainRunError, TrainStep, judge_train,
    prove_driven_by_follower, quiet_speed, simulate_train, simulate_train_all, train_play,
};
pub use verdict::{MeshingReport, judge, judge_contact, judge_run, prove, proving_runs};
