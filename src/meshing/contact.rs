//! Quasi-static contact analysis of two gears, from their outlines alone.
//!
//! The driver is held at an angle, the follower is turned about its axis
//! from its designed angle until the outlines touch: behind, where the load
//! presses it against the driver, and ahead. Nothing is assumed about how
//! the outlines were made. Frames: the driver's axis is the origin, the
//! follower's lies at (L, 0); at driver angle phi the driver is turned by
//! phi and the follower by -psi(phi), counter-clockwise positive.

use super::play::{Body, Play, Pose, Touch, free_play};
use super::pose::{Contact, ContactPose};
use super::summary::ContactSummary;
use crate::control::{Cancelled, Control, Meter, StageName};
use crate::gear::{Gearing, Motion, Side};
use crate::geometry::{Point, cross, perimeter};
use crate::policy;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_4, PI};

/// Two gears, where they sit and how they are meant to turn.
#[derive(Clone, Copy)]
pub struct ContactInput<'a> {
    /// Driver outline in its own frame, mm, counter-clockwise, no repeated last point.
    pub driver: &'a [Point],
    /// Follower outline in its own frame, mm, counter-clockwise, no repeated last point.
    pub follower: &'a [Point],
    /// Distance of the axes, mm.
    pub center_distance: f64,
    /// Module, mm: pitch over pi, measured along the pitch curve.
    pub module: f64,
    /// How the follower turns, clockwise, with the driver.
    pub motion: &'a dyn Motion,
    /// Who may stop the work and hears how far it is.
    pub control: &'a Control,
}

impl std::fmt::Debug for ContactInput<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ContactInput")
            .field("driver", &self.driver.len())
            .field("follower", &self.follower.len())
            .field("center_distance", &self.center_distance)
            .field("module", &self.module)
            .field("cycle", &self.motion.cycle())
            .finish_non_exhaustive()
    }
}

/// How closely to look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactOptions {
    /// Poses over the cycle, placed by the golden ratio: they lie on no grid of teeth.
    pub poses: usize,
    /// Largest turn of the follower in search of a contact, as a share of its angular pitch at
    /// the pitch point. No contact within it is lost contact.
    pub search_pitch: f64,
    /// Surfaces closer than this count as in contact, in modules.
    pub contact_distance: f64,
}

impl Default for ContactOptions {
    fn default() -> Self {
        Self {
            poses: policy::CONTACT_POSES,
            search_pitch: policy::CONTACT_SEARCH_PITCH,
            contact_distance: policy::CONTACT_DISTANCE,
        }
    }
}

/// Why an analysis cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ContactError {
    /// The work was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// An outline has no area.
    #[error("the {gear} has {count} points; give an outline of at least three")]
    TooFewPoints {
        /// Which gear.
        gear: Side,
        /// Points given.
        count: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("point {index} of the {gear} is not a finite number; correct it")]
    NotFinite {
        /// Which gear.
        gear: Side,
        /// Index of the point, from zero.
        index: usize,
    },
    /// A length, an angle or a count is not a positive number.
    #[error("the {name} is {value}; give a positive number")]
    NotPositive {
        /// What it is.
        name: &'static str,
        /// What was given.
        value: f64,
    },
    /// A module that has nothing to do with the outlines.
    #[error(
        "a module of {module:e} mm is too fine for these outlines; give at least {least:.1e} mm"
    )]
    TooFine {
        /// The module given, mm.
        module: f64,
        /// The least that is taken, mm.
        least: f64,
    },
    /// The motion is not finite, or its derivative not positive.
    #[error("the motion is not increasing at driver angle {driver_angle:.6} rad; give one that is")]
    BadMotion {
        /// Driver angle, radians.
        driver_angle: f64,
    },
}

/// Every pose in the order of the driver's angle, and what they amount to.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactAnalysis {
    /// Distance of the axes, mm.
    pub center_distance: f64,
    /// The poses.
    pub poses: Vec<ContactPose>,
    /// The figures to judge by.
    pub summary: ContactSummary,
}

/// Analyses the contact of two gears over one cycle.
///
/// Plays are exact for the polygons given, up to rounding; interference is measured at the
/// outlines' points (and at points between, a quarter module apart), and once it passes
/// [`policy::DEEP_INTERFERENCE`] only a lower bound is given. Work grows with the number
/// of points near the other gear, not with the size of the gears.
///
/// # Errors
/// See [`ContactError`].
pub fn analyse(
    input: &ContactInput<'_>,
    options: &ContactOptions,
) -> Result<ContactAnalysis, ContactError> {
    analyse_from(Vec::new(), input, options)
}

impl ContactAnalysis {
    /// The analysis with `options.poses` poses, when this one of the same input has fewer: poses
    /// that are known are kept. The result is that of [`analyse`] with all poses at once.
    ///
    /// # Errors
    /// See [`ContactError`].
    pub fn refined(
        self,
        input: &ContactInput<'_>,
        options: &ContactOptions,
    ) -> Result<Self, ContactError> {
        if self.poses.len() >= options.poses {
            return Ok(self);
        }
        analyse_from(self.poses, input, options)
    }

    /// The same contact with the follower's error under load counted from another motion: one that leads the
    /// designed one by `lead` radians at a driver angle. Plays and contacts stay as they are.
    #[must_use]
    pub fn against(&self, lead: &dyn Fn(f64) -> f64) -> Self {
        let mut poses = self.poses.clone();
        for pose in &mut poses {
            pose.transmission_error = -pose.play_behind - lead(pose.driver_angle);
            pose.transmission_error_pitch = pose.transmission_error / pose.pitch_angle;
        }
        let summary = self.summary.with_errors_of(&poses);
        Self { poses, summary, center_distance: self.center_distance }
    }
}

/// Adds the poses that are missing; those of `known` are the first of the staggered sequence.
fn analyse_from(
    known: Vec<ContactPose>,
    input: &ContactInput<'_>,
    options: &ContactOptions,
) -> Result<ContactAnalysis, ContactError> {
    check(input, options)?;
    let angles: Vec<f64> = (known.len()..options.poses)
        .map(|i| ((i as f64 + 0.5) * policy::GOLDEN_FRACTION).fract() * input.motion.cycle())
        .collect();
    let meter = input.control.meter(StageName::Analysed, angles.len());
    let mut poses = poses_counted(input, options, &angles, Some(&meter))?;
    poses.extend(known);
    poses.sort_by(|a, b| a.driver_angle.total_cmp(&b.driver_angle));
    let summary = ContactSummary::new(&poses, input.motion.cycle());
    Ok(ContactAnalysis { center_distance: input.center_distance, poses, summary })
}

/// The contact at each of the given driver angles (radians), in their order.
///
/// # Errors
/// See [`ContactError`].
pub fn poses_at(
    input: &ContactInput<'_>,
    options: &ContactOptions,
    driver_angles: &[f64],
) -> Result<Vec<ContactPose>, ContactError> {
    check(input, options)?;
    poses_counted(input, options, driver_angles, None)
}

fn poses_counted(
    input: &ContactInput<'_>,
    options: &ContactOptions,
    driver_angles: &[f64],
    meter: Option<&Meter<'_>>,
) -> Result<Vec<ContactPose>, ContactError> {
    let spacing = policy::CONTACT_PROBE_SPACING * input.module;
    input.control.run(|| {
        let (driver, follower) =
            rayon::join(|| Body::new(input.driver, spacing), || Body::new(input.follower, spacing));
        driver_angles
            .par_iter()
            .map(|&angle| {
                input.control.check()?;
                let pose = pose_at(input, options, &driver, &follower, angle);
                if let Some(meter) = meter {
                    meter.add(1);
                }
                pose
            })
            .collect()
    })
}

/// How far the follower turns behind, from each of the given poses, until it touches, radians; `None` where it does
/// not touch within half a pitch. A pose is a driver angle and a follower angle in the sense of psi.
///
/// The poses are taken to be nearly in contact, `close` radians from it or less: what is within reach of so much is
/// looked at first, and the rest only where that finds no contact or an overlap. The result does not depend on `close`.
///
/// # Errors
/// See [`ContactError`].
pub(super) fn turns_behind(
    input: &ContactInput<'_>,
    poses: &[[f64; 2]],
    close: f64,
) -> Result<Vec<Option<f64>>, ContactError> {
    let options = ContactOptions::default();
    check(input, &options)?;
    let spacing = policy::CONTACT_PROBE_SPACING * input.module;
    input.control.run(|| {
        let (driver, follower) =
            rayon::join(|| Body::new(input.driver, spacing), || Body::new(input.follower, spacing));
        let turn = |&[driver_angle, follower_angle]: &[f64; 2]| {
            input.control.check()?;
            let wide = designed(input, &options, driver_angle, follower_angle)?;
            let near = Pose { max_play: close.min(wide.max_play), slack: 0.0, ..wide };
            let play = free_play(&driver, &follower, &near);
            if play.depth == 0.0 && play.behind.is_some() {
                return Ok(play.behind);
            }
            Ok(free_play(&driver, &follower, &wide).behind)
        };
        poses.par_iter().map(turn).collect()
    })
}

fn check(input: &ContactInput<'_>, options: &ContactOptions) -> Result<(), ContactError> {
    for (gear, outline) in [(Side::Driver, input.driver), (Side::Follower, input.follower)] {
        if outline.len() < 3 {
            return Err(ContactError::TooFewPoints { gear, count: outline.len() });
        }
        if let Some(index) = outline.iter().position(|p| !(p.x.is_finite() && p.y.is_finite())) {
            return Err(ContactError::NotFinite { gear, index });
        }
    }
    let numbers = [
        ("centre distance", input.center_distance),
        ("module", input.module),
        ("driver cycle", input.motion.cycle()),
        ("number of poses", options.poses as f64),
        ("search range", options.search_pitch),
        ("contact distance", options.contact_distance),
    ];
    if let Some((name, value)) = numbers.into_iter().find(|(_, v)| !(v.is_finite() && *v > 0.0)) {
        return Err(ContactError::NotPositive { name, value });
    }
    let length = perimeter(input.driver).max(perimeter(input.follower));
    let least = length / policy::CONTACT_MOST_MODULES;
    // Written so that a length without bounds is refused too.
    let coarse = input.module >= least;
    if coarse { Ok(()) } else { Err(ContactError::TooFine { module: input.module, least }) }
}

/// Radius of the follower's pitch curve at the pitch point, mm, and the turn of the follower by one pitch there.
fn pitch_at(input: &ContactInput<'_>, driver_angle: f64) -> (f64, f64) {
    let speed = input.motion.derivative(driver_angle);
    let follower_radius = Gearing::External.radii(input.center_distance, speed).follower;
    (follower_radius, PI * input.module / follower_radius)
}

/// The pose in which the gears stand at these angles.
fn designed(
    input: &ContactInput<'_>,
    options: &ContactOptions,
    driver_angle: f64,
    follower_angle: f64,
) -> Result<Pose, ContactError> {
    let ratio = input.motion.derivative(driver_angle);
    if !(follower_angle.is_finite() && ratio.is_finite() && ratio > 0.0) {
        return Err(ContactError::BadMotion { driver_angle });
    }
    let (follower_radius, pitch) = pitch_at(input, driver_angle);
    let near = options.contact_distance * input.module;
    Ok(Pose {
        driver_angle,
        follower_angle,
        center_distance: input.center_distance,
        // Half a quarter turn: more would find the far side of a gear of very few teeth.
        max_play: (options.search_pitch * pitch).min(FRAC_PI_4),
        // Twice the turn that closes the contact distance at the pitch radius: it covers contacts
        // whose normal passes the axis at half that radius or more.
        slack: 2.0 * near / follower_radius,
        deep: policy::DEEP_INTERFERENCE * input.module,
        pitch_point: Point::new(input.center_distance - follower_radius, 0.0),
    })
}

fn pose_at(
    input: &ContactInput<'_>,
    options: &ContactOptions,
    driver: &Body,
    follower: &Body,
    driver_angle: f64,
) -> Result<ContactPose, ContactError> {
    let pose = designed(input, options, driver_angle, input.motion.psi(driver_angle))?;
    let (follower_radius, pitch) = pitch_at(input, driver_angle);
    let play = free_play(driver, follower, &pose);
    let contacts = contacts(&play, input, options);
    let behind = play.behind.unwrap_or(pose.max_play);
    Ok(ContactPose {
        driver_angle,
        play_behind: behind,
        play_ahead: play.ahead.unwrap_or(pose.max_play),
        transmission_error: -behind,
        transmission_error_pitch: -behind / pitch,
        lost: play.behind.is_none(),
        lost_reversed: play.ahead.is_none(),
        contacts,
        interference: play.depth,
        follower_radius,
        pitch_angle: pitch,
    })
}

/// One contact per pair of teeth out of all touching places.
fn contacts(play: &Play, input: &ContactInput<'_>, options: &ContactOptions) -> Vec<Contact> {
    let Some(first) = play.behind else { return Vec::new() };
    let axis = Point::new(input.center_distance, 0.0);
    let separation = |touch: &Touch| {
        (touch.turn - first).max(0.0) * cross(touch.point - axis, touch.normal).abs()
    };
    let near = options.contact_distance * input.module;
    let mut places: Vec<(f64, &Touch)> =
        play.touches.iter().map(|t| (separation(t), t)).filter(|(s, _)| *s <= near).collect();
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    let apart = policy::SAME_TOOTH_DISTANCE * input.module;
    let mut found: Vec<Contact> = Vec::new();
    for (separation, touch) in places {
        if found.iter().all(|c| (c.point - touch.point).norm() > apart) {
            found.push(Contact {
                point: touch.point,
                normal: touch.normal,
                separation,
                pressure_angle: touch.normal.y.abs().min(1.0).acos(),
            });
        }
    }
    found
}

#[cfg(test)]
#[path = "contact_tests.rs"]
mod tests;
