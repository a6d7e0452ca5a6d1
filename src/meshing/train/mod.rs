//! Trains of gears: the play of every mesh and how it adds up, and a run of the whole train as rigid
//! bodies.

mod play;
mod reverse;
mod run;
#[cfg(test)]
mod tests;
mod verdict;

pub use play::train_play;
pub use reverse::prove_driven_by_follower;
pub use run::{quiet_speed, simulate_train, simulate_train_all};
pub use verdict::judge_train;

use super::contact::ContactError;
use super::run::{DynamicsError, DynamicsOptions, Stop};
use crate::assembly::{Assembly, PlacedGear};
use crate::gear::{MotionError, SampledMotion};
use crate::geometry;
use std::f64::consts::PI;

/// Why a train cannot be judged.
#[derive(Debug, thiserror::Error)]
pub enum TrainRunError {
    /// A mesh cannot be analysed.
    #[error("{gears}: {source}")]
    Contact {
        /// The two gears.
        gears: String,
        /// What is wrong.
        source: ContactError,
    },
    /// A gear's motion is none.
    #[error("{gear}: {source}")]
    Motion {
        /// The gear.
        gear: String,
        /// What is wrong.
        source: MotionError,
    },
    /// The bodies cannot be made, or an option is out of range.
    #[error(transparent)]
    Dynamics(#[from] DynamicsError),
}

/// What is known of one mesh from its outlines alone. Angles of its second gear, radians.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshPlay {
    /// The two gears, by number.
    pub gears: [usize; 2],
    /// Least and greatest free play over the cycle.
    pub play: [f64; 2],
    /// Poses at which no contact was found.
    pub lost: usize,
    /// Poses looked at.
    pub poses: usize,
    /// Deepest overlap at the designed pose, mm.
    pub interference: f64,
}

/// The play of all meshes, and what of it reaches each gear.
#[derive(Clone, Debug, PartialEq)]
pub struct TrainPlay {
    /// One entry a mesh, in the assembly's order.
    pub meshes: Vec<MeshPlay>,
    /// Greatest play of each gear when the first is held, radians: its own mesh's, and that of every mesh before it as
    /// the ratios hand it on.
    pub accumulated: Vec<f64>,
}

/// One moment of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct TrainStep {
    /// Driver angle, radians.
    pub driver_angle: f64,
    /// World rotation of every gear less its designed one, radians, along the sense in which it turns.
    pub errors: Vec<f64>,
    /// Torque on the driver, averaged over [`crate::policy::TORQUE_WINDOW_TEETH`], N mm.
    pub torque: f64,
    /// What the loads ask of the driver by the composed transmission function, averaged likewise, N mm.
    pub ideal_torque: f64,
}

/// What became of one mesh in a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshFigures {
    /// The two gears, by number.
    pub gears: [usize; 2],
    /// Longest turn of its first gear without load on any tooth of this mesh, in pitches of that gear.
    pub free_run: f64,
    /// Deepest overlap, mm.
    pub penetration: f64,
    /// Mean number of contact points that carry load.
    pub contacts: f64,
}

/// A run of a train.
#[derive(Clone, Debug, PartialEq)]
pub struct TrainRun {
    /// How it was run.
    pub options: DynamicsOptions,
    /// Every step after the lead-in.
    pub steps: Vec<TrainStep>,
    /// One entry a mesh.
    pub meshes: Vec<MeshFigures>,
    /// Greatest less smallest error of each gear, radians.
    pub swing: Vec<f64>,
    /// Work at the loads over work at the driver.
    pub efficiency: f64,
    /// Why it ended early, if it did.
    pub stopped: Option<Stop>,
}

/// psi of every gear: how far it has turned along its own sense when the driver has turned.
struct Motions(Vec<SampledMotion>);

impl Motions {
    fn new(assembly: &Assembly) -> Result<Self, TrainRunError> {
        let motion = |placed: &PlacedGear| {
            let along: Vec<f64> = placed.angle.iter().map(|a| placed.sense() * a).collect();
            SampledMotion::new(&assembly.driver_angle, &along)
                .map_err(|source| TrainRunError::Motion { gear: placed.gear.name.clone(), source })
        };
        Ok(Self(assembly.gears.iter().map(motion).collect::<Result<_, _>>()?))
    }
}

/// Gears at the ends of the train: none hangs on them.
fn leaves(assembly: &Assembly) -> Vec<usize> {
    let drives = |i: usize| {
        assembly.meshes.iter().any(|m| m[0] == i && m[1] > i)
            || assembly.axles.iter().any(|a| a[0] == i)
    };
    (1..assembly.gears.len()).filter(|&i| !drives(i)).collect()
}

fn module_of(placed: &PlacedGear) -> f64 {
    geometry::perimeter(&placed.gear.pitch_curve) / (PI * f64::from(placed.gear.teeth.max(1)))
}
