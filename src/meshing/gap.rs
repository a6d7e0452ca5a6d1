//! Where a follower can stand between the teeth of a driver, when nothing is known of its motion.

use super::play::{Body, Pose, free_play};
use crate::geometry::Point;
use crate::policy;
use std::f64::consts::{FRAC_PI_4, PI};

/// Two gears made ready for many questions. Frames as for
/// [`ContactInput`](super::ContactInput).
#[derive(Debug)]
pub struct GapFinder {
    driver: Body,
    follower: Body,
    center_distance: f64,
    module: f64,
}

/// Angles at which the follower touches on one side and on the other, radians clockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Where it rests under load: turned back as far as it goes.
    pub from: f64,
    /// Turned ahead as far as it goes; below `from` when the teeth are squeezed between each other.
    pub to: f64,
    /// Overlap at [`Self::center`], mm; 0 if clear.
    pub depth: f64,
}

impl Gap {
    /// Half-way between both contacts.
    #[must_use]
    pub fn center(&self) -> f64 {
        0.5 * (self.from + self.to)
    }
}

impl GapFinder {
    /// Takes outlines (mm, counter-clockwise, own frames, at least three finite points each), the
    /// distance of the axes and the module, mm.
    #[must_use]
    pub fn new(driver: &[Point], follower: &[Point], center_distance: f64, module: f64) -> Self {
        let spacing = policy::CONTACT_PROBE_SPACING * module;
        let (driver, follower) =
            rayon::join(|| Body::new(driver, spacing), || Body::new(follower, spacing));
        Self { driver, follower, center_distance, module }
    }

    /// How deep the gears lie in each other at two angles, mm; 0 if clear. Past half a module only
    /// a lower bound.
    #[must_use]
    pub fn depth(&self, driver_angle: f64, follower_angle: f64, follower_radius: f64) -> f64 {
        let pose = self.pose(driver_angle, follower_angle, follower_radius);
        free_play(&self.driver, &self.follower, &pose).depth
    }

    fn pose(&self, driver_angle: f64, follower_angle: f64, follower_radius: f64) -> Pose {
        let pitch = PI * self.module / follower_radius;
        Pose {
            driver_angle,
            follower_angle,
            center_distance: self.center_distance,
            max_play: (policy::GAP_REACH * pitch).min(FRAC_PI_4),
            slack: 0.0,
            deep: policy::DEEP_INTERFERENCE * self.module,
            pitch_point: Point::new(self.center_distance - follower_radius, 0.0),
        }
    }

    /// The gap about the follower angle `guess` at a driver angle, searched up to
    /// [`policy::GAP_REACH`] of the follower's pitch at `follower_radius` (mm) from it. `None`
    /// where one side is not met within that or the gears lie deep in each other.
    ///
    /// Exact for the polygons when clear; when squeezed, the position that shares the overlap out.
    #[must_use]
    pub fn gap(&self, driver_angle: f64, guess: f64, follower_radius: f64) -> Option<Gap> {
        let pitch = PI * self.module / follower_radius;
        let reach = (policy::GAP_REACH * pitch).min(FRAC_PI_4);
        let mut angle = guess;
        let mut found = None;
        for _ in 0..policy::GAP_ROUNDS {
            let pose = self.pose(driver_angle, angle, follower_radius);
            let play = free_play(&self.driver, &self.follower, &pose);
            if play.depth > pose.deep {
                return None;
            }
            let next = match (play.behind, play.ahead) {
                (Some(behind), Some(ahead)) => {
                    if behind + ahead < -reach {
                        return None;
                    }
                    let gap = Gap { from: angle - behind, to: angle + ahead, depth: play.depth };
                    if play.depth == 0.0 {
                        return Some(gap);
                    }
                    found = Some(gap);
                    gap.center()
                }
                // Overlapping on one side: free it first, then look again.
                (Some(behind), None) if behind < 0.0 => angle - behind,
                (None, Some(ahead)) if ahead < 0.0 => angle + ahead,
                _ => return None,
            };
            if (next - angle).abs() < policy::GAP_SETTLED * pitch || (next - guess).abs() > reach {
                break;
            }
            angle = next;
        }
        found
    }
}
