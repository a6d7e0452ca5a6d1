//! What a run as rigid bodies is asked for, and what it leaves.

use super::contact::{ContactError, ContactInput};
use super::locking::Foretold;
use super::partition::PartitionError;
use super::summary::WorstPlace;
use super::touches::Touches;
use crate::control::Cancelled;
use crate::gear::Side;
use crate::policy;

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
    /// The run was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The pair itself cannot be analysed.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// An outline cannot be cut into convex pieces.
    #[error("the {gear}: {source}")]
    Partition {
        /// `driver` or `follower`.
        gear: Side,
        /// What is wrong with it.
        source: PartitionError,
    },
    /// A motor that cannot turn the gears however well they mesh.
    #[error(
        "a motor of {limit:.1} N mm is too weak: the load alone asks for {least:.1} N mm where the follower is fastest; give it more, or a smaller load"
    )]
    WeakMotor {
        /// Torque limit of the motor, N mm.
        limit: f64,
        /// The load times the greatest psi', N mm.
        least: f64,
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
    /// What the contact alone says of a run with friction, once [`judge`](super::judge) has seen it.
    pub foretold: Option<Foretold>,
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

impl Dynamics {
    /// From the mirrored world back to the real one.
    pub(super) fn turn_back(&mut self) {
        for step in &mut self.steps {
            step.driver_angle = -step.driver_angle;
            step.follower_angle = -step.follower_angle;
            step.psi = -step.psi;
            step.contact_angle = step.contact_angle.map(|a| -a);
        }
        self.touches.iter_mut().for_each(Touches::turn_back);
        if let Some(foretold) = &mut self.foretold {
            foretold.least.driver_angle = -foretold.least.driver_angle;
        }
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
