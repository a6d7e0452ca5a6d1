//! What a train's play and runs amount to.

use super::run::rattle;
use super::{TrainPlay, TrainRun, module_of};
use crate::assembly::Assembly;
use crate::meshing::run::{Drive, Stop};
use crate::policy;
use std::f64::consts::TAU;

/// What is wrong with a train, and what deserves attention: one sentence each.
///
/// Whether every mesh keeps its contact is judged by the led runs, in which the gears have next to no inertia. Where a
/// run by motor loses contact that those keep, the gears are thrown about within their play: the train rattles at that
/// speed, which is a warning. `quiet` is a speed in turns a minute at which it does not, where one is known.
#[must_use]
pub fn judge_train(
    assembly: &Assembly,
    play: &TrainPlay,
    runs: &[TrainRun],
    quiet: Option<f64>,
) -> (Vec<String>, Vec<String>) {
    let (mut faults, mut warnings) = (Vec::new(), Vec::new());
    let name = |[a, b]: [usize; 2]| {
        format!("{} and {}", assembly.gears[a].gear.name, assembly.gears[b].gear.name)
    };
    for mesh in &play.meshes {
        let module = module_of(&assembly.gears[mesh.gears[0]]);
        if mesh.lost as f64 > policy::WORST_LOST_SHARE * mesh.poses as f64 {
            faults.push(format!(
                "{} do not touch at {} of {} poses; make the pair again with less clearance",
                name(mesh.gears),
                mesh.lost,
                mesh.poses
            ));
        }
        if mesh.interference > policy::WORST_OVERLAP * module {
            faults.push(format!(
                "{} overlap by {:.3} mm; make the pair again with more clearance",
                name(mesh.gears),
                mesh.interference
            ));
        }
    }
    for run in runs {
        let degrees = |angle: f64| angle.to_degrees().rem_euclid(360.0);
        match run.stopped {
            Some(Stop::Stalled { driver_angle }) => faults.push(format!(
                "the train jams when its driver stands at {:.0} degrees: a motor of several times the torque does not turn it on; use pairs of smaller torque, or fewer gears",
                degrees(driver_angle)
            )),
            Some(Stop::Diverged { driver_angle }) => faults.push(format!(
                "the simulation diverges at {:.0} degrees; check that no two gears overlap there",
                degrees(driver_angle)
            )),
            Some(Stop::TooLong { .. }) => warnings.push(
                "the run was cut short after as many steps as are allowed; simulate fewer cycles".to_owned(),
            ),
            None => {}
        }
        for mesh in &run.meshes {
            let module = module_of(&assembly.gears[mesh.gears[0]]);
            let led = run.options.drive == Drive::Led;
            let free = format!(
                "{} lose contact for {:.2} of a pitch; make the pair again with less clearance",
                name(mesh.gears),
                mesh.free_run
            );
            if led && mesh.free_run > policy::TRAIN_WORST_FREE_RUN {
                faults.push(free);
            } else if led && mesh.free_run > policy::WORST_FREE_RUN {
                warnings.push(free);
            }
            if mesh.penetration > policy::WORST_PENETRATION * module {
                faults.push(format!(
                    "{} are pressed {:.3} mm into each other; give more clearance",
                    name(mesh.gears),
                    mesh.penetration
                ));
            }
        }
        if let Some(worst) = rattle(run) {
            let remedy = quiet.map_or_else(
                || "turn it more slowly, load it more, or make it lighter".to_owned(),
                |rpm| format!("at {rpm} rpm it does not"),
            );
            warnings.push(format!(
                "the train rattles at {} rpm: {} lose contact for {:.2} of a pitch; {remedy}",
                run.options.rpm,
                name(worst.gears),
                worst.free_run
            ));
        }
        for (i, placed) in assembly.gears.iter().enumerate() {
            let pitch = TAU / f64::from(placed.gear.teeth.max(1));
            let error = run.steps.last().map_or(0.0, |s| s.errors[i]);
            if error.abs() > policy::WORST_NET_TURN * pitch + play.accumulated[i] {
                faults.push(format!(
                    "{} ends {:.1} pitches from where it should be; it skips teeth",
                    placed.gear.name,
                    error / pitch
                ));
            }
        }
    }
    faults.dedup();
    warnings.dedup();
    (faults, warnings)
}
