//! What a run leaves: its steps, their averages and their distance from the exact contact, and the
//! figures to judge by.

use super::contact::{ContactInput, turns_behind};
use super::run::{
    Dynamics, DynamicsError, DynamicsInput, DynamicsOptions, DynamicsSummary, Step, Stop,
};
use super::summary::WorstPlace;
use super::touches::Touches;
use super::world::World;
use crate::gear::Gearing;
use crate::geometry::Point;
use crate::policy;
use std::f64::consts::{PI, TAU};

/// Turn of the follower within which its exact contact is looked for first, radians (0.2 degrees): a follower further
/// from it fails.
const NEAR_CONTACT: f64 = policy::WORST_TRACKING;

/// Collects steps and turns them into a [`Dynamics`].
pub(super) struct Recorder {
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
    pub(super) fn new(pair: &ContactInput<'_>, options: &DynamicsOptions) -> Self {
        Self {
            steps: Vec::new(),
            touches: Vec::new(),
            touch_stride: (options.steps_per_tooth / policy::TOUCHES_PER_TOOTH).max(1) as usize,
            driver_cycle: pair.motion.cycle(),
            same_tooth: policy::SAME_TOOTH_DISTANCE * pair.module,
            load: options.load,
            work_in: 0.0,
            work_out: 0.0,
        }
    }

    pub(super) fn record(&mut self, world: &World, psi: f64) {
        let (driver_angle, follower_angle) = (world.angles()[0], -world.angles()[1]);
        let contacts = world.contacts(0);
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

    pub(super) fn finish(
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
            steps.iter().map(|s| options.load * pair.motion.derivative(s.driver_angle)).collect();
        for (step, (torque, ideal)) in
            steps.iter_mut().zip(averaged(&raw, half).into_iter().zip(averaged(&ideal, half)))
        {
            (step.windowed_torque, step.ideal_torque) = (torque, ideal);
        }
        contact_angles(input, options, &mut steps)?;
        let summary = summarise(input, options, &steps);
        Ok(Dynamics {
            options: *options,
            steps,
            summary,
            touches: self.touches,
            stopped,
            foretold: None,
        })
    }
}

/// Mean over `half` neighbours on each side, fewer at the ends.
pub(super) fn averaged(values: &[f64], half: usize) -> Vec<f64> {
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
    // Looked for from a little ahead of the follower, so that it is free there.
    let places: Vec<[f64; 2]> = steps
        .iter()
        .step_by(stride)
        .map(|s| [s.driver_angle, s.follower_angle + policy::CONTACT_LEAD])
        .collect();
    let found = turns_behind(&input.contact, &places, NEAR_CONTACT)?;
    for (i, step) in steps.iter_mut().enumerate() {
        let (k, rest) = (i / stride, (i % stride) as f64 / stride as f64);
        let (a, b) = (found[k], found[(k + 1).min(found.len() - 1)]);
        step.contact_angle =
            a.zip(b).map(|(a, b)| step.follower_angle + policy::CONTACT_LEAD - a - (b - a) * rest);
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
        let speed = pair.motion.derivative(s.driver_angle);
        PI * pair.module / Gearing::External.radii(pair.center_distance, speed).follower
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
