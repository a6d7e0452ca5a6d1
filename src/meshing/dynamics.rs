//! A run of both gears as rigid bodies: the driver is led, or driven by a motor of limited torque,
//! through whole cycles while a constant torque holds the follower back.
//!
//! Frames and signs as everywhere: the driver turns counter-clockwise, the follower clockwise by
//! psi. Driven the other way the pair is mirrored, run, and its angles are given back as negative
//! numbers.

use super::contact::{ContactError, ContactInput, ContactOptions, ContactPose, poses_at};
use super::partition::PartitionError;
use super::summary::WorstPlace;
use super::touches::Touches;
use super::world::{World, WorldInput};
use crate::geometry::{Point, Vector, cross};
use crate::policy;
use std::f64::consts::{PI, TAU};

/// How the driver is turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drive {
    /// At an even speed, whatever torque that takes: to measure.
    Led,
    /// By a motor with a torque limit in N mm, or [`policy::MOTOR_RESERVE`] times the greatest torque
    /// that the load asks of it: to find where the gears jam.
    Motor(Option<f64>),
}

/// Sense of the driver's rotation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Counter-clockwise.
    Forward,
    /// Clockwise.
    Backward,
}

/// The pair to run.
#[derive(Clone, Copy, Debug)]
pub struct DynamicsInput<'a> {
    /// The gears, their places and the motion they should have.
    pub contact: ContactInput<'a>,
    /// Teeth of the driver on one turn; sets the length of a step.
    pub driver_teeth: u32,
}

/// How the pair is run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DynamicsOptions {
    /// How the driver is turned.
    pub drive: Drive,
    /// Sense of its rotation.
    pub direction: Direction,
    /// Torque that holds the follower back, N mm; positive.
    pub load: f64,
    /// Speed of the driver, turns a minute; positive.
    pub rpm: f64,
    /// Coulomb friction between the flanks, 0 to 2.
    pub friction: f64,
    /// Density of the follower, kg/m^3; positive.
    pub density: f64,
    /// Thickness of the follower, mm; positive.
    pub thickness: f64,
    /// Whole cycles of both gears to run.
    pub cycles: f64,
    /// Steps while the driver turns by one tooth.
    pub steps_per_tooth: u32,
}

impl Default for DynamicsOptions {
    fn default() -> Self {
        Self {
            drive: Drive::Led,
            direction: Direction::Forward,
            load: policy::DEFAULT_LOAD,
            rpm: policy::DEFAULT_RPM,
            friction: policy::DEFAULT_FRICTION,
            density: policy::DEFAULT_DENSITY,
            thickness: policy::DEFAULT_THICKNESS,
            cycles: policy::SIMULATED_CYCLES,
            steps_per_tooth: policy::STEPS_PER_TOOTH,
        }
    }
}

/// Why a run cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DynamicsError {
    /// The pair itself cannot be analysed.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// An outline cannot be cut into convex pieces.
    #[error("the {gear}: {source}")]
    Partition {
        /// `driver` or `follower`.
        gear: &'static str,
        /// What is wrong with it.
        source: PartitionError,
    },
    /// An option is out of its range.
    #[error("the {name} is {value}; give {remedy}")]
    Option {
        /// Which.
        name: &'static str,
        /// What was given.
        value: f64,
        /// What may be given.
        remedy: &'static str,
    },
}

/// State after one step. Angles in radians, continuous; torque and work in N mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Driver angle; negative when driven backward.
    pub driver_angle: f64,
    /// Follower angle in the sense of psi.
    pub follower_angle: f64,
    /// psi at the driver angle.
    pub psi: f64,
    /// Follower angle at which the outlines touch under load; none where they do not.
    pub contact_angle: Option<f64>,
    /// Torque on the driver in this step.
    pub driver_torque: f64,
    /// The same averaged over [`policy::TORQUE_WINDOW_TEETH`] about this step.
    pub windowed_torque: f64,
    /// psi' times the load (Eq. 3), averaged likewise.
    pub ideal_torque: f64,
    /// Pairs of teeth that carry load.
    pub contacts: u32,
    /// Deepest overlap, mm.
    pub penetration: f64,
    /// No tooth carries load.
    pub lost: bool,
    /// Work put into the driver since the record began.
    pub work_in: f64,
    /// Work taken out by the load since then.
    pub work_out: f64,
}

impl Step {
    /// Follower angle less psi.
    #[must_use]
    pub fn transmission_error(&self) -> f64 {
        self.follower_angle - self.psi
    }

    /// Follower angle less the contact angle, taken along the sense of rotation.
    #[must_use]
    pub fn tracking_error(&self) -> Option<f64> {
        self.contact_angle.map(|angle| self.follower_angle - angle)
    }
}

/// Why a run ended before its time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stop {
    /// The motor could not turn the driver past this angle, radians.
    Stalled {
        /// Driver angle, radians.
        driver_angle: f64,
    },
    /// The bodies were flung apart.
    Diverged {
        /// Last driver angle, radians.
        driver_angle: f64,
    },
    /// The run would take more than [`policy::MOST_STEPS`] steps.
    TooLong {
        /// Last driver angle, radians.
        driver_angle: f64,
    },
}

/// A run and what it amounts to.
#[derive(Clone, Debug, PartialEq)]
pub struct Dynamics {
    /// How it was run.
    pub options: DynamicsOptions,
    /// Every step after the lead-in.
    pub steps: Vec<Step>,
    /// The figures to judge by.
    pub summary: DynamicsSummary,
    /// Contacts and forces of the first cycle, [`policy::TOUCHES_PER_TOOTH`] times a tooth.
    pub touches: Vec<Touches>,
    /// Why it ended early, if it did.
    pub stopped: Option<Stop>,
}

/// The figures of one run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DynamicsSummary {
    /// Root mean square of the distance from the contact angle, radians, where there is contact.
    pub tracking_rms: f64,
    /// Greatest distance from the contact angle, radians.
    pub tracking_worst: Option<WorstPlace>,
    /// Greatest less smallest follower angle against psi, in local pitches of the follower.
    pub swing: f64,
    /// The same in radians.
    pub swing_angle: f64,
    /// Greatest distance of the windowed torque from psi' tau, in loads.
    pub torque_excess: Option<WorstPlace>,
    /// Root mean square of that distance, in loads.
    pub torque_rms: f64,
    /// Greatest windowed torque on the driver, N mm.
    pub greatest_torque: Option<WorstPlace>,
    /// Deepest overlap, mm.
    pub penetration: Option<WorstPlace>,
    /// Longest turn of the driver without contact, in its mean pitches, and where it begins.
    pub free_run: Option<WorstPlace>,
    /// Follower angle gained or lost against psi from the first step to the last, in mean pitches.
    pub net_turn: f64,
    /// Mean number of pairs of teeth that carry load.
    pub contact_ratio: f64,
    /// Work out over work in.
    pub efficiency: f64,
}

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
    if options.direction == Direction::Forward {
        return run(input, options);
    }
    let mirrored = |outline: &[Point]| -> Vec<Point> {
        outline.iter().rev().map(|p| Point::new(p.x, -p.y)).collect()
    };
    let plain = &input.contact;
    let (driver, follower) = (mirrored(plain.driver), mirrored(plain.follower));
    let contact = ContactInput {
        driver: &driver,
        follower: &follower,
        motion: &|angle| -(plain.motion)(-angle),
        motion_derivative: &|angle| (plain.motion_derivative)(-angle),
        ..*plain
    };
    let mut made = run(&DynamicsInput { contact, ..*input }, options)?;
    made.turn_back();
    Ok(made)
}

fn check(input: &DynamicsInput<'_>, options: &DynamicsOptions) -> Result<(), DynamicsError> {
    let positive = "a number above zero";
    let most = f64::MAX;
    let limit = match options.drive {
        Drive::Motor(Some(limit)) => limit,
        _ => 1.0,
    };
    let ranges = [
        ("load", options.load, f64::MIN_POSITIVE, most, positive),
        ("speed", options.rpm, f64::MIN_POSITIVE, most, positive),
        ("density", options.density, f64::MIN_POSITIVE, most, positive),
        ("thickness", options.thickness, f64::MIN_POSITIVE, most, positive),
        ("number of cycles", options.cycles, f64::MIN_POSITIVE, most, positive),
        ("torque limit of the motor", limit, f64::MIN_POSITIVE, most, positive),
        ("friction", options.friction, 0.0, 2.0, "0 to 2"),
        ("number of driver teeth", f64::from(input.driver_teeth), 1.0, most, "at least 1"),
        ("number of steps a tooth", f64::from(options.steps_per_tooth), 1.0, 1e5, "1 to 100000"),
    ];
    match ranges.into_iter().find(|(_, value, low, high, _)| !(low..=high).contains(&value)) {
        Some((name, value, _, _, remedy)) => Err(DynamicsError::Option { name, value, remedy }),
        None => Ok(()),
    }
}

/// A led or driven run counter-clockwise.
fn run(input: &DynamicsInput<'_>, options: &DynamicsOptions) -> Result<Dynamics, DynamicsError> {
    let pair = &input.contact;
    let step = TAU / f64::from(input.driver_teeth) / f64::from(options.steps_per_tooth);
    let lead_steps = (policy::LEAD_IN_TEETH * f64::from(options.steps_per_tooth)).ceil() as usize;
    let start = -(lead_steps as f64) * step;
    let wanted = (options.cycles * pair.driver_cycle / step).ceil();
    let count = wanted.min(policy::MOST_STEPS as f64) as usize;
    // Bad outlines and motions are found here, before any step.
    let first = poses_at(pair, &ContactOptions::default(), &[start])?.swap_remove(0);
    let play = if first.lost { 0.0 } else { first.play_behind };
    let curve = greatest_acceleration(pair);
    let real = inertia(pair.follower, options) / options.load;
    let steepest = steepest(pair);
    let motor = match options.drive {
        Drive::Led => None,
        Drive::Motor(limit) => {
            Some(limit.map_or(policy::MOTOR_RESERVE * steepest, |l| l / options.load))
        }
    };
    let mut world = World::new(&WorldInput {
        outlines: [pair.driver, pair.follower],
        center_distance: pair.center_distance,
        module: pair.module,
        angles: [start, play - (pair.motion)(start)],
        follower_speed: -(pair.motion_derivative)(start),
        inertia: real.max(policy::LEAST_KAPPA / curve),
        friction: options.friction,
        step,
        motor,
    })
    .map_err(|[driver, follower]| {
        let gear = if driver.is_some() { "driver" } else { "follower" };
        let source = driver.or(follower).unwrap_or(PartitionError::NoArea);
        DynamicsError::Partition { gear, source }
    })?;
    let mut recorder = Recorder::new(pair, options);
    let end = (count as f64 - 0.5) * step;
    let patience = if motor.is_some() { policy::MOTOR_PATIENCE } else { 1.0 };
    let budget = (patience * (count + lead_steps) as f64) as usize;
    let tooth = options.steps_per_tooth as usize;
    let mut stopped = (wanted > count as f64).then_some(Stop::TooLong { driver_angle: end });
    let mut before = start;
    for i in 1..=budget {
        let sound = world.step();
        let [driver_angle, _] = world.angles();
        if !sound {
            stopped = Some(Stop::Diverged { driver_angle: before });
            break;
        }
        if i > lead_steps || motor.is_some() {
            recorder.record(&world, (pair.motion)(driver_angle));
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
fn inertia(outline: &[Point], options: &DynamicsOptions) -> f64 {
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
fn greatest_acceleration(pair: &ContactInput<'_>) -> f64 {
    let h = TAU / policy::ACCELERATION_SAMPLES as f64;
    let mean = (pair.motion)(pair.driver_cycle) - (pair.motion)(0.0);
    let least = policy::LEAST_ACCELERATION * mean / pair.driver_cycle;
    over_cycle(pair)
        .map(|a| {
            ((pair.motion_derivative)(a + h) - (pair.motion_derivative)(a - h)).abs() / (2.0 * h)
        })
        .fold(least, f64::max)
}

fn steepest(pair: &ContactInput<'_>) -> f64 {
    over_cycle(pair).map(pair.motion_derivative).fold(0.0, f64::max)
}

fn over_cycle(pair: &ContactInput<'_>) -> impl Iterator<Item = f64> {
    let h = TAU / policy::ACCELERATION_SAMPLES as f64;
    let count = (pair.driver_cycle / h).ceil().min(policy::MOST_STEPS as f64) as usize;
    (0..count).map(move |i| i as f64 * h)
}

/// Collects steps and turns them into a [`Dynamics`].
struct Recorder {
    steps: Vec<Step>,
    touches: Vec<Touches>,
    /// Steps from one entry of `touches` to the next.
    touch_stride: usize,
    driver_cycle: f64,
    same_tooth: f64,
    load: f64,
    work_in: f64,
    work_out: f64,
}

impl Recorder {
    fn new(pair: &ContactInput<'_>, options: &DynamicsOptions) -> Self {
        Self {
            steps: Vec::new(),
            touches: Vec::new(),
            touch_stride: (options.steps_per_tooth / policy::TOUCHES_PER_TOOTH).max(1) as usize,
            driver_cycle: pair.driver_cycle,
            same_tooth: policy::SAME_TOOTH_DISTANCE * pair.module,
            load: options.load,
            work_in: 0.0,
            work_out: 0.0,
        }
    }

    fn record(&mut self, world: &World, psi: f64) {
        let [driver_angle, follower] = world.angles();
        let follower_angle = -follower;
        let contacts = world.contacts();
        // What the driver is given is what the follower takes from it.
        let driver_torque = -self.load * contacts.iter().map(|c| c.moment).sum::<f64>();
        let mut teeth: Vec<Point> = Vec::new();
        for contact in contacts.iter().filter(|c| c.loaded) {
            if teeth.iter().all(|p| (p - contact.point).norm() > self.same_tooth) {
                teeth.push(contact.point);
            }
        }
        let first_cycle = (0.0..self.driver_cycle).contains(&driver_angle);
        if first_cycle && self.steps.len().is_multiple_of(self.touch_stride) {
            let touches = Touches::new(driver_angle, &contacts, self.same_tooth, self.load);
            self.touches.push(touches);
        }
        if let Some(last) = self.steps.last() {
            self.work_in += driver_torque * (driver_angle - last.driver_angle);
            self.work_out += self.load * (follower_angle - last.follower_angle);
        }
        self.steps.push(Step {
            driver_angle,
            follower_angle,
            psi,
            contact_angle: None,
            driver_torque,
            windowed_torque: driver_torque,
            ideal_torque: 0.0,
            contacts: teeth.len() as u32,
            penetration: contacts.iter().map(|c| -c.distance).fold(0.0, f64::max),
            lost: teeth.is_empty(),
            work_in: self.work_in,
            work_out: self.work_out,
        });
    }

    fn finish(
        self,
        input: &DynamicsInput<'_>,
        options: &DynamicsOptions,
        stopped: Option<Stop>,
    ) -> Result<Dynamics, DynamicsError> {
        let pair = &input.contact;
        let mut steps = self.steps;
        let window = policy::TORQUE_WINDOW_TEETH * f64::from(options.steps_per_tooth);
        let half = (0.5 * window).round() as usize;
        let raw: Vec<f64> = steps.iter().map(|s| s.driver_torque).collect();
        let ideal: Vec<f64> =
            steps.iter().map(|s| options.load * (pair.motion_derivative)(s.driver_angle)).collect();
        for (step, (torque, ideal)) in
            steps.iter_mut().zip(averaged(&raw, half).into_iter().zip(averaged(&ideal, half)))
        {
            (step.windowed_torque, step.ideal_torque) = (torque, ideal);
        }
        contact_angles(input, options, &mut steps)?;
        let summary = summarise(input, options, &steps);
        Ok(Dynamics { options: *options, steps, summary, touches: self.touches, stopped })
    }
}

/// Mean over `half` neighbours on each side, fewer at the ends.
fn averaged(values: &[f64], half: usize) -> Vec<f64> {
    let mut sums = vec![0.0];
    for v in values {
        sums.push(sums[sums.len() - 1] + v);
    }
    (0..values.len())
        .map(|i| {
            let (from, to) = (i.saturating_sub(half), (i + half + 1).min(values.len()));
            (sums[to] - sums[from]) / (to - from) as f64
        })
        .collect()
}

/// The exact contact nearest to where the run has the follower, at even places; between them the
/// distance from it runs straight.
fn contact_angles(
    input: &DynamicsInput<'_>,
    options: &DynamicsOptions,
    steps: &mut [Step],
) -> Result<(), DynamicsError> {
    let stride = (options.steps_per_tooth / policy::CONTACT_ANGLES_PER_TOOTH).max(1) as usize;
    let places: Vec<[f64; 2]> =
        steps.iter().step_by(stride).map(|s| [s.driver_angle, s.follower_angle]).collect();
    // Looked for from a little ahead of the follower, so that it is free there.
    let led = |angle: f64| {
        let i = places.partition_point(|p| p[0] < angle).min(places.len() - 1);
        places[i][1] + policy::CONTACT_LEAD
    };
    let pair = ContactInput { motion: &led, ..input.contact };
    let angles: Vec<f64> = places.iter().map(|p| p[0]).collect();
    let found = poses_at(&pair, &ContactOptions::default(), &angles)?;
    let distance =
        |pose: &ContactPose| (!pose.lost).then_some(pose.play_behind - policy::CONTACT_LEAD);
    for (i, step) in steps.iter_mut().enumerate() {
        let (k, rest) = (i / stride, (i % stride) as f64 / stride as f64);
        let (a, b) = (distance(&found[k]), distance(&found[(k + 1).min(found.len() - 1)]));
        step.contact_angle = a.zip(b).map(|(a, b)| step.follower_angle - a - (b - a) * rest);
    }
    Ok(())
}

fn summarise(
    input: &DynamicsInput<'_>,
    options: &DynamicsOptions,
    steps: &[Step],
) -> DynamicsSummary {
    let pair = &input.contact;
    let (Some(first), Some(last)) = (steps.first(), steps.last()) else {
        return DynamicsSummary::default();
    };
    let pitch = TAU / f64::from(input.driver_teeth);
    let count = steps.len() as f64;
    let worst = |values: &mut dyn Iterator<Item = (f64, f64)>| {
        values
            .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
            .map(|(driver_angle, value)| WorstPlace { value, driver_angle })
    };
    let tracked =
        || steps.iter().filter_map(|s| s.tracking_error().map(|error| (s.driver_angle, error)));
    let tracked_count = tracked().count().max(1) as f64;
    let excess = || {
        steps.iter().map(|s| (s.driver_angle, (s.windowed_torque - s.ideal_torque) / options.load))
    };
    let span = |value: &dyn Fn(&Step) -> f64| {
        let (low, high) = steps
            .iter()
            .map(value)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        high - low
    };
    let local_pitch = |s: &Step| {
        PI * pair.module * (1.0 + (pair.motion_derivative)(s.driver_angle)) / pair.center_distance
    };
    let mean_pitch = pitch * last.psi.abs().max(f64::MIN_POSITIVE)
        / last.driver_angle.abs().max(f64::MIN_POSITIVE);
    DynamicsSummary {
        tracking_rms: (tracked().map(|(_, e)| e * e).sum::<f64>() / tracked_count).sqrt(),
        tracking_worst: worst(&mut tracked()),
        swing: span(&|s| s.transmission_error() / local_pitch(s)),
        swing_angle: span(&Step::transmission_error),
        torque_excess: worst(&mut excess()),
        torque_rms: (excess().map(|(_, e)| e * e).sum::<f64>() / count).sqrt(),
        greatest_torque: worst(&mut steps.iter().map(|s| (s.driver_angle, s.windowed_torque))),
        penetration: worst(&mut steps.iter().map(|s| (s.driver_angle, s.penetration)))
            .filter(|w| w.value > 0.0),
        free_run: longest_free_run(steps).map(|w| WorstPlace { value: w.value / pitch, ..w }),
        net_turn: (last.transmission_error() - first.transmission_error()) / mean_pitch,
        contact_ratio: steps.iter().map(|s| f64::from(s.contacts)).sum::<f64>() / count,
        efficiency: if last.work_in > 0.0 { last.work_out / last.work_in } else { 0.0 },
    }
}

/// Longest turn of the driver without contact, radians, and where it begins.
fn longest_free_run(steps: &[Step]) -> Option<WorstPlace> {
    let mut longest: Option<WorstPlace> = None;
    let mut begun: Option<f64> = None;
    for step in steps {
        if !step.lost {
            begun = None;
            continue;
        }
        let from = *begun.get_or_insert(step.driver_angle);
        let value = step.driver_angle - from;
        if longest.is_none_or(|w| value > w.value) {
            longest = Some(WorstPlace { value, driver_angle: from });
        }
    }
    longest.filter(|w| w.value > 0.0)
}

impl Dynamics {
    /// From the mirrored world back to the real one.
    fn turn_back(&mut self) {
        for step in &mut self.steps {
            step.driver_angle = -step.driver_angle;
            step.follower_angle = -step.follower_angle;
            step.psi = -step.psi;
            step.contact_angle = step.contact_angle.map(|a| -a);
        }
        self.touches.iter_mut().for_each(Touches::turn_back);
        let s = &mut self.summary;
        let places = [
            &mut s.tracking_worst,
            &mut s.torque_excess,
            &mut s.greatest_torque,
            &mut s.penetration,
            &mut s.free_run,
        ];
        for place in places.into_iter().flatten() {
            place.driver_angle = -place.driver_angle;
        }
        if let Some(
            Stop::Stalled { driver_angle }
            | Stop::Diverged { driver_angle }
            | Stop::TooLong { driver_angle },
        ) = &mut self.stopped
        {
            *driver_angle = -*driver_angle;
        }
    }
}

#[cfg(test)]
#[path = "dynamics_tests.rs"]
mod tests;
