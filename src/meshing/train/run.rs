//! A run of a whole train as rigid bodies.

use super::play::mesh_poses;
use super::{MeshFigures, Motions, TrainRun, TrainRunError, TrainStep, leaves, module_of};
use crate::assembly::{Assembly, PlacedGear};
use crate::control::{Control, StageName};
use crate::gear::Side;
use crate::meshing::dynamics::inertia;
use crate::meshing::recorder::averaged;
use crate::meshing::run::{Drive, DynamicsError, DynamicsOptions, Stop};
use crate::meshing::world::{SUBSTEPS, World, WorldContact, WorldGear, WorldInput};
use crate::policy;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Most that the loads may change the speed of a gear in a substep, over the driver's speed. A train whose gears are
/// jerked by three times that speed is pressed into its teeth by 0.04 mm, by ten times so far that it skips them.
const MOST_JUMP: f64 = 0.125;
/// Most substeps of a step: the time of a run grows with them.
const MOST_SUBSTEPS: usize = 64;
/// Least inertia of a gear over the torque that it carries and the time of a step: the one that the most substeps
/// bear.
const LEAST_FLYWHEEL: f64 = 1.0 / (MOST_SUBSTEPS as f64 * MOST_JUMP);
/// Halvings of its speed after which a train that still rattles is left alone.
const MOST_HALVINGS: u32 = 2;

/// Runs a train: the first gear is led or driven by a motor, a torque of `options.load` holds back each gear at an end.
///
/// A led run asks about the geometry: every gear has the least inertia with which the run is numerically right, whatever
/// the speed. A run by motor asks about the machine: gears have their own inertia, or that least one if it is greater.
///
/// Deterministic. The direction in the options is not used: a train is run as its assembly turns.
///
/// # Errors
/// [`TrainRunError`].
pub fn simulate_train(
    assembly: &Assembly,
    options: &DynamicsOptions,
    control: &Control,
) -> Result<TrainRun, TrainRunError> {
    control.run(|| run(assembly, options, control))
}

/// Runs a train in every way given, side by side; their order is kept.
///
/// # Errors
/// [`TrainRunError`].
pub fn simulate_train_all(
    assembly: &Assembly,
    runs: &[DynamicsOptions],
    control: &Control,
) -> Result<Vec<TrainRun>, TrainRunError> {
    let parts = control.split(runs.len());
    control.run(|| {
        runs.par_iter().zip(&parts).map(|(options, part)| run(assembly, options, part)).collect()
    })
}

fn run(
    assembly: &Assembly,
    options: &DynamicsOptions,
    control: &Control,
) -> Result<TrainRun, TrainRunError> {
    let motions = Motions::new(assembly)?;
    let cycle = motions.0[0].cycle();
    let gears = &assembly.gears;
    let module = gears.iter().map(module_of).fold(f64::INFINITY, f64::min);
    let teeth = gears.iter().map(|g| g.gear.teeth).max().unwrap_or(1);
    let step = TAU / f64::from(teeth) / f64::from(policy::TRAIN_STEPS_PER_TOOTH);
    let tooth = policy::TRAIN_STEPS_PER_TOOTH as usize;
    // Every mesh has to close before anything is recorded.
    let lead_teeth =
        policy::LEAD_IN_TEETH + policy::TRAIN_LEAD_IN_PER_MESH * assembly.meshes.len() as f64;
    let lead = (lead_teeth * tooth as f64).ceil() as usize;
    let start = -(lead as f64) * step;
    let wanted = (options.cycles * cycle / step).ceil();
    let count = wanted.min(policy::MOST_STEPS as f64) as usize;
    let ends = leaves(assembly);
    let sense: Vec<f64> = gears.iter().map(PlacedGear::sense).collect();
    let asked = |phi: f64| ends.iter().map(|&i| motions.0[i].derivative(phi)).sum::<f64>();
    let samples = || {
        (0..policy::ACCELERATION_SAMPLES)
            .map(|i| cycle * i as f64 / policy::ACCELERATION_SAMPLES as f64)
    };
    let motor = match options.drive {
        Drive::Led => None,
        Drive::Motor(Some(limit)) => Some(limit / options.load),
        Drive::Motor(None) => {
            Some(policy::MOTOR_RESERVE * samples().map(asked).fold(0.0, f64::max))
        }
    };
    let behind = starting_lag(assembly, &motions, start, control)?;
    let carried = carried_torques(assembly, &motions, &ends);
    let inertias: Vec<f64> = (0..gears.len())
        .map(|i| {
            let least = LEAST_FLYWHEEL * step * carried[i];
            let on_one_axle = (0..gears.len()).filter(|&g| axle(assembly, g) == axle(assembly, i));
            let own = |g: usize| inertia(&gears[g].gear.outline, options) / options.load;
            if motor.is_none() { least } else { on_one_axle.map(own).sum::<f64>().max(least) }
        })
        .collect();
    let jump = (0..gears.len()).map(|i| step * carried[i] / inertias[i]).fold(0.0, f64::max);
    let bodies = gears
        .iter()
        .enumerate()
        .map(|(i, placed)| {
            let motion = &motions.0[i];
            WorldGear {
                outline: &placed.gear.outline,
                axis: placed.axis,
                angle: sense[i] * (motion.psi(start) - behind[i]),
                speed: sense[i] * motion.derivative(start),
                inertia: inertias[i],
                torque: if ends.contains(&i) { -sense[i] } else { 0.0 },
                fixed_to: assembly.axles.iter().find(|a| a[1] == i).map(|a| a[0]),
            }
        })
        .collect();
    let distance =
        assembly.meshes.first().map_or(1.0, |&[a, b]| (gears[b].axis - gears[a].axis).norm());
    let mut world = World::new(&WorldInput {
        gears: bodies,
        meshes: assembly.meshes.clone(),
        center_distance: distance,
        module,
        friction: options.friction,
        step,
        motor,
        substeps: substeps(jump),
    })
    .map_err(|(number, source)| DynamicsError::Partition {
        gear: Side::BOTH[number.min(1)],
        source,
    })?;
    let mut steps: Vec<TrainStep> = Vec::new();
    let mut tally: Vec<Tally> = vec![Tally::default(); assembly.meshes.len()];
    let (mut work_in, mut work_out) = (0.0, 0.0);
    let mut last: Option<Vec<f64>> = None;
    let end = (count as f64 - 0.5) * step;
    let patience = if motor.is_some() { policy::MOTOR_PATIENCE } else { 1.0 };
    let budget = (patience * (count + lead) as f64) as usize;
    let mut stopped = (wanted > count as f64).then_some(Stop::TooLong { driver_angle: end });
    let mut before = start;
    let meter = control.meter(StageName::Proven, count + lead);
    for i in 1..=budget {
        control.check().map_err(DynamicsError::from)?;
        meter.add(1);
        let sound = world.step();
        let angles = world.angles().to_vec();
        let phi = angles[0];
        if !sound {
            stopped = Some(Stop::Diverged { driver_angle: before });
            break;
        }
        if phi > 0.0 || i > lead {
            let mut torque = 0.0;
            for (k, tally) in tally.iter_mut().enumerate() {
                let contacts = world.contacts(k);
                if assembly.meshes[k][0] == 0 {
                    torque -= options.load * contacts.iter().map(|c| c.moment).sum::<f64>();
                }
                tally.add(motions.0[assembly.meshes[k][0]].psi(phi), &contacts);
            }
            if let Some(last) = &last {
                work_in += torque * (phi - last[0]);
                work_out += ends
                    .iter()
                    .map(|&e| options.load * sense[e] * (angles[e] - last[e]))
                    .sum::<f64>();
            }
            let errors =
                (0..gears.len()).map(|g| sense[g] * angles[g] - motions.0[g].psi(phi)).collect();
            let ideal_torque = options.load * asked(phi);
            steps.push(TrainStep { driver_angle: phi, errors, torque, ideal_torque });
            last = Some(angles);
        }
        if i % tooth == 0 {
            if phi - before < policy::STALLED * tooth as f64 * step {
                stopped = Some(Stop::Stalled { driver_angle: phi });
                break;
            }
            before = phi;
        }
        if phi > end {
            break;
        }
    }
    let half = (0.5 * policy::TORQUE_WINDOW_TEETH * tooth as f64).round() as usize;
    for (value, field) in [
        (averaged(&steps.iter().map(|s| s.torque).collect::<Vec<_>>(), half), 0),
        (averaged(&steps.iter().map(|s| s.ideal_torque).collect::<Vec<_>>(), half), 1),
    ] {
        for (step, v) in steps.iter_mut().zip(value) {
            if field == 0 { step.torque = v } else { step.ideal_torque = v }
        }
    }
    let swing = (0..gears.len())
        .map(|g| {
            let (low, high) = steps
                .iter()
                .map(|s| s.errors[g])
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), e| (l.min(e), h.max(e)));
            (high - low).max(0.0)
        })
        .collect();
    let meshes = tally
        .iter()
        .zip(&assembly.meshes)
        .map(|(tally, &[a, b])| {
            let pitch = TAU / f64::from(gears[a].gear.teeth.max(1));
            MeshFigures {
                gears: [a, b],
                free_run: tally.longest / pitch,
                penetration: tally.penetration,
                contacts: tally.contacts as f64 / steps.len().max(1) as f64,
            }
        })
        .collect();
    let efficiency = if work_in > 0.0 { work_out / work_in } else { 0.0 };
    Ok(TrainRun { options: *options, steps, meshes, swing, efficiency, stopped })
}

/// The gear whose body a gear is part of.
fn axle(assembly: &Assembly, gear: usize) -> usize {
    assembly.axles.iter().find(|a| a[1] == gear).map_or(gear, |a| axle(assembly, a[0]))
}

/// Whether `gear` is, or hangs directly or not on, `on`.
fn hangs_on(assembly: &Assembly, mut gear: usize, on: usize) -> bool {
    while gear > on {
        let links = assembly.axles.iter().chain(&assembly.meshes);
        let Some(link) = links.into_iter().find(|l| l[1] == gear && l[0] < gear) else {
            return false;
        };
        gear = link[0];
    }
    gear == on
}

/// The greatest torque over the load that the ends of the train ask of each gear in the cycle.
fn carried_torques(assembly: &Assembly, motions: &Motions, ends: &[usize]) -> Vec<f64> {
    let cycle = motions.0[0].cycle();
    let samples = policy::ACCELERATION_SAMPLES;
    (0..assembly.gears.len())
        .map(|i| {
            let behind: Vec<usize> =
                ends.iter().copied().filter(|&e| hangs_on(assembly, e, i)).collect();
            (0..samples)
                .map(|k| {
                    let phi = cycle * k as f64 / samples as f64;
                    let speeds = behind.iter().map(|&e| motions.0[e].derivative(phi)).sum::<f64>();
                    speeds / motions.0[i].derivative(phi)
                })
                .fold(0.0, f64::max)
        })
        .collect()
}

/// Solver substeps of a step in which the loads alone would change the speed of a gear by `jump` of the driver's.
fn substeps(jump: f64) -> usize {
    let groups = (jump / (SUBSTEPS as f64 * MOST_JUMP) - 1e-9).ceil();
    let groups = groups.max(1.0).min((MOST_SUBSTEPS / SUBSTEPS) as f64);
    SUBSTEPS * groups as usize
}

/// The mesh that loses contact for longest in a run by motor, if that is long enough to hear.
pub(super) fn rattle(run: &TrainRun) -> Option<MeshFigures> {
    let worst = run.meshes.iter().max_by(|a, b| a.free_run.total_cmp(&b.free_run))?;
    let heard = run.options.drive != Drive::Led && worst.free_run > policy::WORST_FREE_RUN;
    heard.then_some(*worst)
}

/// A speed in turns a minute at which a train does not rattle, if `run`, by motor, does and a few halvings of its speed
/// find one.
///
/// # Errors
/// [`TrainRunError`].
pub fn quiet_speed(
    assembly: &Assembly,
    run: &TrainRun,
    control: &Control,
) -> Result<Option<f64>, TrainRunError> {
    if rattle(run).is_none() || run.stopped.is_some() {
        return Ok(None);
    }
    for halvings in 1..=MOST_HALVINGS {
        let rpm = run.options.rpm / f64::from(1u32 << halvings);
        let options = DynamicsOptions { rpm, cycles: run.options.cycles.min(1.0), ..run.options };
        let slower = simulate_train(assembly, &options, control)?;
        if rattle(&slower).is_none() && slower.stopped.is_none() {
            return Ok(Some(rpm));
        }
    }
    Ok(None)
}

/// How far each gear stands behind its designed pose when every mesh is closed by the loads, radians.
fn starting_lag(
    assembly: &Assembly,
    motions: &Motions,
    start: f64,
    control: &Control,
) -> Result<Vec<f64>, TrainRunError> {
    let mut behind = vec![0.0; assembly.gears.len()];
    for i in 1..assembly.gears.len() {
        if let Some(&[on, _]) = assembly.axles.iter().find(|a| a[1] == i) {
            behind[i] = behind[on];
        } else if let Some(&[on, _]) = assembly.meshes.iter().find(|m| m[1] == i && m[0] < i) {
            let pose = mesh_poses(assembly, motions, [on, i], &[start], control)?;
            let own = pose.first().filter(|p| !p.lost).map_or(0.0, |p| p.play_behind);
            let speed = |j: usize| motions.0[j].derivative(start);
            behind[i] = behind[on] * speed(i) / speed(on) + own;
        }
    }
    Ok(behind)
}

/// What is gathered of one mesh.
#[derive(Clone, Debug, Default)]
struct Tally {
    free_since: Option<f64>,
    longest: f64,
    penetration: f64,
    contacts: usize,
}

impl Tally {
    /// `turned` is how far the mesh's first gear has turned, radians.
    fn add(&mut self, turned: f64, contacts: &[WorldContact]) {
        let loaded = contacts.iter().filter(|c| c.loaded).count();
        self.contacts += loaded;
        self.penetration = contacts.iter().map(|c| -c.distance).fold(self.penetration, f64::max);
        if loaded > 0 {
            self.free_since = None;
        } else {
            let since = *self.free_since.get_or_insert(turned);
            self.longest = self.longest.max(turned - since);
        }
    }
}
