//! The contact of two gears at one driver angle.

use crate::geometry::{Point, Vector};

/// One place where the driver touches the follower under load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// World position, mm.
    pub point: Point,
    /// World direction from the driver into the follower, unit length.
    pub normal: Vector,
    /// What is left between the surfaces along the normal, mm: 0 for the first contact.
    pub separation: f64,
    /// Working pressure angle, radians: between the normal and the perpendicular to the line
    /// of centres, which is the way both gears move at the pitch point.
    pub pressure_angle: f64,
}

/// What was found at one driver angle.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactPose {
    /// Driver angle phi, radians.
    pub driver_angle: f64,
    /// Turn of the follower back from its designed angle until it touches, radians; negative
    /// when the gears interfere at the designed angle and it must first turn ahead by so much.
    /// The searched range when there is no contact.
    pub play_behind: f64,
    /// The same in the direction of its motion.
    pub play_ahead: f64,
    /// Follower angle under load less its designed angle, radians: `-play_behind`.
    pub transmission_error: f64,
    /// The same as arc at the pitch point, as a fraction of the pitch.
    pub transmission_error_pitch: f64,
    /// No contact under load within the searched range.
    pub lost: bool,
    /// No contact when the follower runs ahead (load reversed) within the searched range.
    pub lost_reversed: bool,
    /// One contact for each pair of teeth that touches under load, the first one first.
    pub contacts: Vec<Contact>,
    /// How deep a point of one gear lies inside the other at the designed angle, mm; 0 if clear.
    pub interference: f64,
    /// Radius of the follower's pitch curve at the pitch point, mm.
    pub follower_radius: f64,
    /// Turn of the follower by one pitch at that radius, radians.
    pub pitch_angle: f64,
}
