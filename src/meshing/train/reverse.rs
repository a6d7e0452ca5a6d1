//! Pairs whose follower drives, as every second gear of a chain does.

use crate::assembly::PairModel;
use crate::control::Control;
use crate::diagnose::Limits;
use crate::gear::MotionError;
use crate::meshing::contact::{ContactInput, ContactOptions, analyse};
use crate::meshing::run::{DynamicsError, DynamicsInput, DynamicsOptions};
use crate::meshing::verdict::{MeshingReport, prove, proving_runs};
use crate::policy;

use super::TrainRunError;

/// Runs a pair with its follower driving in the sense in which the pair turns, as it does where the follower of one
/// mesh of a train is the first gear of the next: other flanks carry then, and friction may lock what turns well the
/// other way round.
///
/// Driver angles in the report are angles of the pair's follower, radians. The load of `options` is on the pair's
/// driver; one cycle is run.
///
/// # Errors
/// [`TrainRunError`].
pub fn prove_driven_by_follower(
    pair: &PairModel,
    options: &DynamicsOptions,
    control: &Control,
) -> Result<MeshingReport, TrainRunError> {
    let swapped = pair.swapped().map_err(|source: MotionError| TrainRunError::Motion {
        gear: pair.gears.follower.name.clone(),
        source,
    })?;
    let input = ContactInput {
        driver: &swapped.gears.driver.outline,
        follower: &swapped.gears.follower.outline,
        center_distance: swapped.center_distance,
        module: swapped.module,
        motion: &swapped.motion,
        control,
    };
    let poses = ContactOptions { poses: policy::CONTACT_POSES_TRIED, ..ContactOptions::default() };
    let contact = analyse(&input, &poses).map_err(DynamicsError::from)?;
    let options = DynamicsOptions { cycles: 1.0, ..*options };
    let input = DynamicsInput { contact: input, driver_teeth: swapped.gears.driver.teeth };
    Ok(prove(&input, contact, &proving_runs(&options, false), &Limits::default())?)
}
