//! Where the teeth of a run press on each other, and how hard.

use super::world::WorldContact;
use crate::geometry::{Point, Vector};

/// The loaded contacts of one moment of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Touches {
    /// Driver angle, radians; negative when driven backward.
    pub driver_angle: f64,
    /// One entry for each pair of teeth that carries load: where it touches, in the world's frame
    /// (mm, driver axis at the origin), and the force on the follower there, N.
    pub points: Vec<(Point, Vector)>,
}

impl Touches {
    /// Contacts closer than `same_tooth` mm become one, with the sum of their forces, in the middle
    /// of them as the forces weigh.
    pub(super) fn new(
        driver_angle: f64,
        contacts: &[WorldContact],
        same_tooth: f64,
        load: f64,
    ) -> Self {
        let mut teeth: Vec<Tooth> = Vec::new();
        for contact in contacts.iter().filter(|c| c.loaded) {
            let near = |t: &&mut Tooth| (t.first - contact.point).norm() <= same_tooth;
            let weight = contact.force.norm();
            let offset = |first: Point| (contact.point - first) * weight;
            match teeth.iter_mut().find(near) {
                Some(tooth) => {
                    tooth.weight += weight;
                    tooth.offset += offset(tooth.first);
                    tooth.force += contact.force;
                }
                None => teeth.push(Tooth {
                    first: contact.point,
                    weight,
                    offset: Vector::zeros(),
                    force: contact.force,
                }),
            }
        }
        let points = teeth
            .into_iter()
            .filter(|t| t.weight > 0.0)
            .map(|t| (t.first + t.offset / t.weight, t.force * load))
            .collect();
        Self { driver_angle, points }
    }

    /// From the mirrored world back to the real one.
    pub(super) fn turn_back(&mut self) {
        self.driver_angle = -self.driver_angle;
        for (point, force) in &mut self.points {
            (point.y, force.y) = (-point.y, -force.y);
        }
    }
}

/// Contacts of one pair of teeth.
struct Tooth {
    first: Point,
    weight: f64,
    /// Sum of the weighted distances from the first.
    offset: Vector,
    /// Over the load, 1/mm.
    force: Vector,
}
