//! Where a pair locks itself by friction, and how much of the work arrives, told from the contact alone.
//!
//! At a contact the driver pushes along the normal n and, by friction, along the way it slides on the follower: the
//! force on the follower is f = n + mu s, s the direction of sliding. The power that the driver gives is f . v_D, what the
//! follower takes is f . v_F, with v the velocities of the two gears at the contact. Where f . v_F is not positive, no
//! torque of the driver turns the follower, however large: the line of the force passes the follower's axis on the
//! wrong side. Bearings are taken to be free of friction.

use super::contact::ContactAnalysis;
use super::pose::{Contact, ContactPose};
use super::summary::WorstPlace;
use crate::gear::Side;
use crate::geometry::{Point, Vector, quarter_turn};

/// What friction does to a pair over one cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foretold {
    /// Coefficient of Coulomb friction between the flanks.
    pub friction: f64,
    /// Work at the load over work at the gear that drives, over the cycle, at a constant load; 0 for a pair that locks.
    pub efficiency: f64,
    /// The least share of the power that arrives anywhere, and the driver angle there. Zero or less: the pair locks.
    pub least: WorstPlace,
}

impl Foretold {
    /// Whether the pair locks somewhere.
    #[must_use]
    pub fn locks(&self) -> bool {
        self.least.value <= 0.0
    }
}

/// Works out what friction does, from the contacts of a whole cycle.
///
/// `driving` is the gear that drives. With [`Side::Driver`] the motion is that of the analysis. With
/// [`Side::Follower`] it is the same flanks that carry, the follower turns both gears back, and the load is on the
/// driver. Where several pairs of teeth touch they share the load evenly for the efficiency; a pose locks only if all
/// of them do. `None` if no pose has a contact. Lengths mm, `friction` 0 or more.
#[must_use]
pub fn foretell(contact: &ContactAnalysis, friction: f64, driving: Side) -> Option<Foretold> {
    let center_distance = contact.center_distance;
    let mut least: Option<WorstPlace> = None;
    let (mut given, mut taken) = (0.0, 0.0);
    for pose in &contact.poses {
        let powers: Vec<[f64; 2]> = pose
            .contacts
            .iter()
            .map(|c| powers(pose, c, center_distance, friction, driving))
            .collect();
        let share = |[in_, out]: &[f64; 2]| if *out > 0.0 { out / in_ } else { out.min(0.0) };
        let Some(best) = powers.iter().map(share).max_by(f64::total_cmp) else { continue };
        if least.is_none_or(|w| best < w.value) {
            least = Some(WorstPlace { value: best, driver_angle: pose.driver_angle });
        }
        let sum = powers
            .iter()
            .filter(|p| share(p) > 0.0)
            .fold([0.0; 2], |s, p| [s[0] + p[0], s[1] + p[1]]);
        // Work of a constant load in a step of the driver.
        let work = match driving {
            Side::Driver => center_distance / pose.follower_radius - 1.0,
            Side::Follower => 1.0,
        };
        taken += work;
        given += work * sum[0] / sum[1];
    }
    let least = least?;
    let efficiency = if least.value > 0.0 { taken / given } else { 0.0 };
    Some(Foretold { friction, efficiency, least })
}

/// Power that the driving gear gives and that the other takes at a contact, for a unit normal force and a driver that
/// turns by one radian in a unit of time.
fn powers(
    pose: &ContactPose,
    contact: &Contact,
    center_distance: f64,
    friction: f64,
    driving: Side,
) -> [f64; 2] {
    let ratio = center_distance / pose.follower_radius - 1.0;
    let axis = Point::new(center_distance, 0.0);
    let of_driver = quarter_turn(contact.point.coords);
    let of_follower = -ratio * quarter_turn(contact.point - axis);
    let along = quarter_turn(contact.normal);
    let rub: Vector = along * (friction * along.dot(&(of_driver - of_follower)).signum());
    match driving {
        Side::Driver => {
            let force = contact.normal + rub;
            [force.dot(&of_driver), force.dot(&of_follower)]
        }
        // Both velocities, the normal and the way of sliding are reversed; their products are not, but for friction.
        Side::Follower => {
            let force = contact.normal - rub;
            [force.dot(&of_follower), force.dot(&of_driver)]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::summary::ContactSummary;
    use super::*;
    use proptest::prelude::*;

    /// One pose of a pair of ratio 1 with axes 80 mm apart, touching `along` mm from the pitch point on the line of
    /// action of pressure angle `angle`.
    fn touching(angle: f64, along: f64) -> ContactAnalysis {
        let normal = Vector::new(angle.sin(), angle.cos());
        let pose = ContactPose {
            driver_angle: 0.5,
            play_behind: 0.0,
            play_ahead: 0.0,
            transmission_error: 0.0,
            transmission_error_pitch: 0.0,
            lost: false,
            lost_reversed: false,
            contacts: vec![Contact {
                point: Point::new(40.0, 0.0) + normal * along,
                normal,
                separation: 0.0,
                pressure_angle: angle,
            }],
            interference: 0.0,
            follower_radius: 40.0,
            pitch_angle: 0.1,
        };
        let summary = ContactSummary::new(std::slice::from_ref(&pose), 1.0);
        ContactAnalysis { center_distance: 80.0, poses: vec![pose], summary }
    }

    proptest! {
        /// The force acts along a line turned by the angle of friction; where that line meets the line of centres are
        /// the lever arms of both gears.
        #[test]
        fn lever_arms_of_the_force_give_the_same(
            angle in 0.0..1.3_f64, along in -8.0..8.0_f64, friction in 0.0..0.6_f64,
        ) {
            prop_assume!(along.abs() > 1e-3);
            let found = foretell(&touching(angle, along), friction, Side::Driver).unwrap();
            // Beyond the pitch point the driver's flank slides one way on the follower's, before it the other.
            let turned = angle - friction.atan() * along.signum();
            let force = Vector::new(turned.sin(), turned.cos());
            let point = Point::new(40.0, 0.0) + Vector::new(angle.sin(), angle.cos()) * along;
            let meets = point.x - point.y * force.x / force.y;
            if force.y > 0.0 && meets < 80.0 {
                let wanted = (80.0 - meets) / meets;
                prop_assert!((found.efficiency - wanted).abs() < 1e-9, "{} {wanted}", found.efficiency);
                prop_assert!(!found.locks());
            } else {
                prop_assert!(found.locks() && found.efficiency == 0.0);
            }
        }
    }

    #[test]
    fn nothing_is_lost_without_friction_or_without_sliding() {
        for side in Side::BOTH {
            let smooth = foretell(&touching(1.2, 5.0), 0.0, side).unwrap();
            assert!((smooth.efficiency - 1.0).abs() < 1e-12);
            let rolling = foretell(&touching(0.0, 0.0), 0.5, side).unwrap();
            assert!((rolling.efficiency - 1.0).abs() < 1e-9, "{}", rolling.efficiency);
        }
    }

    #[test]
    fn a_steep_flank_locks_and_says_where() {
        let found = foretell(&touching(1.3, -20.0), 0.5, Side::Driver).unwrap();
        assert!(found.locks());
        assert_eq!(found.least.driver_angle, 0.5);
    }
}
