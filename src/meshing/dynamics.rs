//! A run of both gears as rigid bodies: the driver is led, or driven by a motor of limited torque,
//! through whole cycles while a constant torque holds the follower back.
//!
//! Frames and signs as everywhere: the driver turns counter-clockwise, the follower clockwise by
//! psi. Driven the other way the pair is mirrored, run, and its angles are given back as negative
//! numbers.

use super::contact::{ContactInput, ContactOptions, analyse, poses_at};
use super::locking::foretell;
use super::recorder::Recorder;
use super::run::{Direction, Drive, Dynamics, DynamicsError, DynamicsInput, DynamicsOptions, Stop};
use super::world::{SUBSTEPS, World, WorldGear, WorldInput};
use crate::control::StageName;
use crate::gear::{Mirrored, Motion, Side};
use crate::geometry::{Point, Vector, cross};
use crate::policy;
use std::f64::consts::TAU;

/// Poses at which friction of a pair that turns backward is looked at: ten a tooth of a common gear.
const FORETOLD_POSES: usize = policy::CONTACT_POSES_TRIED;

/// Runs a pair.
///
/// Deterministic: the same input gives the same steps, bit for bit. The number of steps is bounded
/// ([`policy::MOST_STEPS`]); a run that would need more, that stalls or diverges ends early and
/// says so in [`Dynamics::stopped`].
///
/// # Errors
/// See [`DynamicsError`].
pub fn simulate(
    input: &DynamicsInput<'_>,
    options: &DynamicsOptions,
) -> Result<Dynamics, DynamicsError> {
    check(input, options)?;
    let plain = &input.contact;
    if options.direction == Direction::Forward {
        return plain.control.run(|| run(input, options));
    }
    let mirrored = |outline: &[Point]| -> Vec<Point> {
        outline.iter().rev().map(|p| Point::new(p.x, -p.y)).collect()
    };
    let (driver, follower) = (mirrored(plain.driver), mirrored(plain.follower));
    let contact = ContactInput {
        driver: &driver,
        follower: &follower,
        motion: &Mirrored(plain.motion),
        ..*plain
    };
    let mut made = plain.control.run(|| run(&DynamicsInput { contact, ..*input }, options))?;
    if options.friction > 0.0 {
        // Other flanks carry than in the contact analysis of a pair, which turns forward.
        let poses = ContactOptions { poses: FORETOLD_POSES, ..ContactOptions::default() };
        let analysis = plain.control.run(|| analyse(&contact, &poses))?;
        made.foretold = foretell(&analysis, options.friction, Side::Driver);
    }
    made.turn_back();
    Ok(made)
}

fn check(input: &DynamicsInput<'_>, options: &DynamicsOptions) -> Result<(), DynamicsError> {
    let positive = "a number from 1e-9 to 1e9";
    let (least, most) = policy::QUANTITY_RANGE;
    let limit = match options.drive {
        Drive::Motor(Some(limit)) => limit,
        _ => 1.0,
    };
    let ranges = [
        ("load", options.load, least, most, positive),
        ("speed", options.rpm, least, most, positive),
        ("density", options.density, least, most, positive),
        ("thickness", options.thickness, least, most, positive),
        ("number of cycles", options.cycles, least, most, positive),
        ("torque limit of the motor", limit, least, most, positive),
        ("friction", options.friction, 0.0, 2.0, "0 to 2"),
        ("number of driver teeth", f64::from(input.driver_teeth), 1.0, most, "at least 1"),
        ("number of steps a tooth", f64::from(options.steps_per_tooth), 1.0, 1e5, "1 to 100000"),
    ];
    if let Some((name, value, _, _, remedy)) =
        ranges.into_iter().find(|(_, value, low, high, _)| !(low..=high).contains(&value))
    {
        return Err(DynamicsError::Option { name, value, remedy });
    }
    if let Drive::Motor(Some(limit)) = options.drive {
        let least = options.load * steepest(input.contact.motion);
        if limit <= least {
            return Err(DynamicsError::WeakMotor { limit, least });
        }
    }
    Ok(())
}

/// A led or driven run counter-clockwise.
fn run(input: &DynamicsInput<'_>, options: &DynamicsOptions) -> Result<Dynamics, DynamicsError> {
    let pair = &input.contact;
    let step = TAU / f64::from(input.driver_teeth) / f64::from(options.steps_per_tooth);
    let lead_steps = (policy::LEAD_IN_TEETH * f64::from(options.steps_per_tooth)).ceil() as usize;
    let start = -(lead_steps as f64) * step;
    let wanted = (options.cycles * pair.motion.cycle() / step).ceil();
    let count = wanted.min(policy::MOST_STEPS as f64) as usize;
    // Bad outlines and motions are found here, before any step.
    let first = poses_at(pair, &ContactOptions::default(), &[start])?.swap_remove(0);
    let play = if first.lost { 0.0 } else { first.play_behind };
    let curve = greatest_acceleration(pair.motion);
    let real = inertia(pair.follower, options) / options.load;
    let steepest = steepest(pair.motion);
    let motor = match options.drive {
        Drive::Led => None,
        Drive::Motor(limit) => {
            Some(limit.map_or(policy::MOTOR_RESERVE * steepest, |l| l / options.load))
        }
    };
    let inertia = real.max(policy::LEAST_KAPPA / curve);
    let driver = WorldGear {
        outline: pair.driver,
        axis: Point::origin(),
        angle: start,
        speed: 1.0,
        inertia,
        torque: 0.0,
        fixed_to: None,
    };
    let follower = WorldGear {
        outline: pair.follower,
        axis: Point::new(pair.center_distance, 0.0),
        angle: play - pair.motion.psi(start),
        speed: -pair.motion.derivative(start),
        // The follower turns clockwise; the load holds it back.
        torque: 1.0,
        ..driver
    };
    let mut world = World::new(&WorldInput {
        gears: vec![driver, follower],
        meshes: vec![[0, 1]],
        center_distance: pair.center_distance,
        module: pair.module,
        friction: options.friction,
        step,
        motor,
        substeps: SUBSTEPS,
    })
    .map_err(|(number, source)| DynamicsError::Partition {
        gear: Side::BOTH[number.min(1)],
        source,
    })?;
    let mut recorder = Recorder::new(pair, options);
    let end = (count as f64 - 0.5) * step;
    let patience = if motor.is_some() { policy::MOTOR_PATIENCE } else { 1.0 };
    let budget = (patience * (count + lead_steps) as f64) as usize;
    let tooth = options.steps_per_tooth as usize;
    let mut stopped = (wanted > count as f64).then_some(Stop::TooLong { driver_angle: end });
    let mut before = start;
    let meter = pair.control.meter(StageName::Proven, count + lead_steps);
    for i in 1..=budget {
        pair.control.check()?;
        meter.add(1);
        let sound = world.step();
        let driver_angle = world.angles()[0];
        if !sound {
            stopped = Some(Stop::Diverged { driver_angle: before });
            break;
        }
        if i > lead_steps || motor.is_some() {
            recorder.record(&world, pair.motion.psi(driver_angle));
        }
        if i % tooth == 0 {
            if driver_angle - before < policy::STALLED * tooth as f64 * step {
                stopped = Some(Stop::Stalled { driver_angle });
                break;
            }
            before = driver_angle;
        }
        if driver_angle > end {
            break;
        }
    }
    recorder.finish(input, options, stopped)
}

/// Moment of inertia of a gear about its axis times the square of the driver's speed, N mm.
pub(super) fn inertia(outline: &[Point], options: &DynamicsOptions) -> f64 {
    let edges = outline.iter().zip(outline.iter().cycle().skip(1));
    let polar: f64 = edges
        .map(|(a, b)| {
            let (a, b): (Vector, Vector) = (a.coords, b.coords);
            cross(a, b) * (a.norm_squared() + a.dot(&b) + b.norm_squared()) / 12.0
        })
        .sum();
    // kg/m^3 to t/mm^3, so that t mm^2 / s^2 is N mm.
    let density = options.density * 1e-12;
    let speed = options.rpm * TAU / 60.0;
    density * options.thickness * polar.abs() * speed * speed
}

/// Greatest |psi''|, at least [`policy::LEAST_ACCELERATION`] of the mean ratio.
pub(super) fn greatest_acceleration(motion: &dyn Motion) -> f64 {
    let h = TAU / policy::ACCELERATION_SAMPLES as f64;
    let mean = (motion.psi(motion.cycle()) - motion.psi(0.0)) / motion.cycle();
    over_cycle(motion)
        .map(|a| (motion.derivative(a + h) - motion.derivative(a - h)).abs() / (2.0 * h))
        .fold(policy::LEAST_ACCELERATION * mean, f64::max)
}

fn steepest(motion: &dyn Motion) -> f64 {
    over_cycle(motion).map(|a| motion.derivative(a)).fold(0.0, f64::max)
}

fn over_cycle(motion: &dyn Motion) -> impl Iterator<Item = f64> {
    let h = TAU / policy::ACCELERATION_SAMPLES as f64;
    let count = (motion.cycle() / h).ceil().min(policy::MOST_STEPS as f64) as usize;
    (0..count).map(move |i| i as f64 * h)
}

#[cfg(test)]
#[path = "dynamics_tests.rs"]
mod tests;
