//! Trains of gears: the play of every mesh and how it adds up, and a run of the whole train as rigid
//! bodies.

use super::contact::{ContactError, ContactInput, ContactOptions, ContactPose, poses_at};
use super::dynamics::{
    Drive, DynamicsError, DynamicsOptions, Stop, greatest_acceleration, inertia,
};
use super::recorder::averaged;
use super::world::{World, WorldGear, WorldInput};
use crate::assembly::{Assembly, PlacedGear};
use crate::control::{Control, StageName};
use crate::gear::{Motion, MotionError, SampledMotion, Side};
use crate::geometry::{self, Point};
use crate::policy;
use std::f64::consts::{PI, TAU};

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
    /// Torque on the driver, averaged over [`policy::TORQUE_WINDOW_TEETH`], N mm.
    pub torque: f64,
    /// What the loads ask of the driver by the composed transmission function, averaged likewise, N mm.
    pub ideal_torque: f64,
}

/// What became of one mesh in a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshFigures {
    /// The two gears, by number.
    pub gears: [usize; 2],
    /// Longest turn of the driver without load on any tooth of this mesh, in pitches of its first gear.
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

/// How the second gear of a mesh turns with its first, by way of the train's driver.
#[derive(Debug)]
struct MeshMotion<'a> {
    first: &'a SampledMotion,
    second: &'a SampledMotion,
}

impl Motion for MeshMotion<'_> {
    fn psi(&self, angle: f64) -> f64 {
        self.second.psi(self.first.inverse(angle))
    }

    fn derivative(&self, angle: f64) -> f64 {
        let driver_angle = self.first.inverse(angle);
        self.second.derivative(driver_angle) / self.first.derivative(driver_angle)
    }

    fn cycle(&self) -> f64 {
        self.first.psi(self.first.cycle())
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

/// Measures the free play of every mesh at `poses` poses of the train's cycle.
///
/// # Errors
/// [`TrainRunError`].
pub fn train_play(
    assembly: &Assembly,
    poses: usize,
    control: &Control,
) -> Result<TrainPlay, TrainRunError> {
    let motions = Motions::new(assembly)?;
    let cycle = motions.0[0].cycle();
    let angles: Vec<f64> =
        (0..poses).map(|i| ((i as f64 + 0.5) * policy::GOLDEN_FRACTION).fract() * cycle).collect();
    let mut meshes = Vec::new();
    let mut all: Vec<(usize, usize, Vec<ContactPose>)> = Vec::new();
    for &[a, b] in &assembly.meshes {
        let found = mesh_poses(assembly, &motions, [a, b], &angles, control)?;
        let play = |p: &ContactPose| p.play_behind + p.play_ahead;
        let free = || found.iter().filter(|p| !p.lost && !p.lost_reversed).map(play);
        meshes.push(MeshPlay {
            gears: [a, b],
            play: [free().fold(f64::INFINITY, f64::min), free().fold(0.0, f64::max)],
            lost: found.iter().filter(|p| p.lost).count(),
            poses: found.len(),
            interference: found.iter().map(|p| p.interference).fold(0.0, f64::max),
        });
        all.push((a, b, found));
    }
    let mut accumulated = vec![0.0_f64; assembly.gears.len()];
    for (k, &phi) in angles.iter().enumerate() {
        let mut here = vec![0.0; assembly.gears.len()];
        for i in 1..assembly.gears.len() {
            let speed = |j: usize| motions.0[j].derivative(phi);
            if let Some(&[on, _]) = assembly.axles.iter().find(|a| a[1] == i) {
                here[i] = here[on];
            } else if let Some((on, _, found)) = all.iter().find(|m| m.1 == i && m.0 < i) {
                let own = found[k].play_behind + found[k].play_ahead;
                here[i] = here[*on] * speed(i) / speed(*on) + own;
            }
            accumulated[i] = accumulated[i].max(here[i]);
        }
    }
    Ok(TrainPlay { meshes, accumulated })
}

/// The contact of one mesh, seen as a pair: its line of centres along +x, its first gear turning counter-clockwise.
fn mesh_poses(
    assembly: &Assembly,
    motions: &Motions,
    [a, b]: [usize; 2],
    driver_angles: &[f64],
    control: &Control,
) -> Result<Vec<ContactPose>, TrainRunError> {
    let (first, second) = (&assembly.gears[a], &assembly.gears[b]);
    let line = second.axis - first.axis;
    let direction = line.y.atan2(line.x);
    let mirrored = first.sense() < 0.0;
    let seen = |placed: &PlacedGear| -> Vec<Point> {
        let turned = placed.gear.outline.iter().map(|&p| geometry::rotate(p, -direction));
        if mirrored {
            let mut points: Vec<Point> = turned.map(|p| Point::new(p.x, -p.y)).collect();
            points.reverse();
            points
        } else {
            turned.collect()
        }
    };
    let (driver, follower) = (seen(first), seen(second));
    let angles: Vec<f64> = driver_angles.iter().map(|&phi| motions.0[a].psi(phi)).collect();
    let motion = MeshMotion { first: &motions.0[a], second: &motions.0[b] };
    let input = ContactInput {
        driver: &driver,
        follower: &follower,
        center_distance: line.norm(),
        module: module_of(first),
        motion: &motion,
        control,
    };
    poses_at(&input, &ContactOptions::default(), &angles).map_err(|source| TrainRunError::Contact {
        gears: format!("{} and {}", first.gear.name, second.gear.name),
        source,
    })
}

/// Runs a train: the first gear is led or driven by a motor, a torque of `options.load` holds back each gear at an end.
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
    let bodies = gears
        .iter()
        .enumerate()
        .map(|(i, placed)| {
            let motion = &motions.0[i];
            let curve = greatest_acceleration(motion);
            let real = inertia(&placed.gear.outline, options) / options.load;
            WorldGear {
                outline: &placed.gear.outline,
                axis: placed.axis,
                angle: sense[i] * (motion.psi(start) - behind[i]),
                speed: sense[i] * motion.derivative(start),
                inertia: real.max(policy::LEAST_KAPPA / curve),
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
                tally.add(phi, &contacts);
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
            let mean = motions.0[a].psi(cycle) / cycle;
            let pitch = TAU / f64::from(gears[a].gear.teeth.max(1)) / mean;
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
    fn add(&mut self, phi: f64, contacts: &[super::world::WorldContact]) {
        let loaded = contacts.iter().filter(|c| c.loaded).count();
        self.contacts += loaded;
        self.penetration = contacts.iter().map(|c| -c.distance).fold(self.penetration, f64::max);
        if loaded > 0 {
            self.free_since = None;
        } else {
            let since = *self.free_since.get_or_insert(phi);
            self.longest = self.longest.max(phi - since);
        }
    }
}

/// What is wrong with a train, and what deserves attention: one sentence each.
#[must_use]
pub fn judge_train(
    assembly: &Assembly,
    play: &TrainPlay,
    runs: &[TrainRun],
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
                "the gears are flung apart at {:.0} degrees; check that no two overlap there",
                degrees(driver_angle)
            )),
            Some(Stop::TooLong { .. }) => warnings.push(
                "the run was cut short after as many steps as are allowed; simulate fewer cycles".to_owned(),
            ),
            None => {}
        }
        for mesh in &run.meshes {
            let module = module_of(&assembly.gears[mesh.gears[0]]);
            let free = format!(
                "{} run free for {:.2} of a pitch; reduce clearance or speed",
                name(mesh.gears),
                mesh.free_run
            );
            if mesh.free_run > policy::TRAIN_WORST_FREE_RUN {
                faults.push(free);
            } else if mesh.free_run > policy::WORST_FREE_RUN {
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

#[cfg(test)]
mod tests {
    use super::super::spur::Spur;
    use super::*;
    use crate::assembly::{Gear, Layout, PairModel, TrainPlan};
    use crate::gear::Pair;

    /// Two spur gears with involute teeth, as a pair.
    fn pair() -> PairModel {
        let spur =
            Spur { teeth: 24, module: 2.0, pressure_angle: 20.0_f64.to_radians(), thinning: 0.1 };
        let angles: Vec<f64> = (0..=64).map(|i| TAU * f64::from(i) / 64.0).collect();
        let circle =
            |i: u32| geometry::rotate(Point::new(spur.radius(), 0.0), TAU * f64::from(i) / 720.0);
        let pitch_curve: Vec<Point> = (0..720).map(circle).collect();
        let gear = |name: &str, start: f64| Gear {
            name: name.to_owned(),
            input: pitch_curve.clone(),
            pitch_curve: pitch_curve.clone(),
            outline: spur.outline(start, 24, spur.teeth),
            bore: None,
            fittings: crate::assembly::Fittings::default(),
            teeth: spur.teeth,
        };
        PairModel {
            gears: Pair::new(
                gear("driver", 0.0),
                gear("follower", PI + PI / f64::from(spur.teeth)),
            ),
            motion: SampledMotion::new(&angles, &angles).unwrap(),
            center_distance: 2.0 * spur.radius(),
            module: spur.module,
        }
    }

    #[test]
    fn play_adds_up_along_a_chain_of_round_gears() {
        let plan = TrainPlan::chain(pair(), 4, Layout::ZigZag(0.4), 8.0).unwrap();
        let train = plan.assemble().unwrap();
        let play = train_play(&train.assembly, 24, Control::unwatched()).unwrap();
        let one = play.meshes[0].play;
        assert!(one[0] > 0.0);
        for (k, mesh) in play.meshes.iter().enumerate() {
            assert_eq!(mesh.lost, 0);
            assert!((mesh.play[1] - one[1]).abs() < 0.02 * one[1], "{k}: {:?} {one:?}", mesh.play);
        }
        let most = play.accumulated[3];
        assert!(most <= 3.0 * one[1] * 1.001 && most >= 3.0 * one[0] * 0.999);
    }

    #[test]
    fn a_chain_of_round_gears_turns_and_its_torque_is_the_load() {
        let plan = TrainPlan::chain(pair(), 3, Layout::Straight, 8.0).unwrap();
        let train = plan.assemble().unwrap();
        let options = DynamicsOptions { friction: 0.0, cycles: 0.25, ..DynamicsOptions::default() };
        let run = simulate_train(&train.assembly, &options, Control::unwatched()).unwrap();
        assert_eq!(run.stopped, None);
        let play = train_play(&train.assembly, 24, Control::unwatched()).unwrap();
        let (faults, _) = judge_train(&train.assembly, &play, std::slice::from_ref(&run));
        assert!(faults.is_empty(), "{faults:?}");
        let mean = run.steps.iter().map(|s| s.torque).sum::<f64>() / run.steps.len() as f64;
        assert!((mean / options.load - 1.0).abs() < 0.02, "{mean}");
        assert!((run.efficiency - 1.0).abs() < 0.02, "{}", run.efficiency);
        // Under load each gear lags by half the play of each mesh before it.
        for (gear, lag) in run.steps.last().unwrap().errors.iter().enumerate() {
            assert!((lag + 0.5 * play.accumulated[gear]).abs() < 2e-3, "{gear}: {lag}");
        }
    }
}
