//! From a run of both gears to the contacts that the page draws, and their form in the page.

use super::data::{ContactFrame, Touch};
use super::text::Grid;
use crate::meshing::{Dynamics, Touches};
use crate::policy::PAGE_CONTACT_FRAMES;
use serde_json::{Value, json};

/// Places of a driver angle in the page, and of a force: finer than a screen shows.
const DIGITS: i32 = 4;

/// The contacts of the first cycle of a run, by rising driver angle.
///
/// `driver_cycle` is the driver's turn, radians, after which every gear is back in its first pose. The
/// driver's axis is taken as the origin. A run backward is put where the page shows the same pose.
/// Moments at which a motor stood still or swung back are left out; so is what is not finite.
#[must_use]
pub fn contact_frames(run: &Dynamics, driver_cycle: f64) -> Vec<ContactFrame> {
    let greatest = run
        .touches
        .iter()
        .flat_map(|t| &t.points)
        .map(|(_, force)| force.norm())
        .filter(|f| f.is_finite())
        .fold(f64::MIN_POSITIVE, f64::max);
    let frame = |touches: &Touches| ContactFrame {
        driver_angle: touches.driver_angle.rem_euclid(driver_cycle),
        touches: touches
            .points
            .iter()
            .map(|(p, force)| Touch {
                x: p.x,
                y: p.y,
                force: [force.x / greatest, force.y / greatest],
            })
            .filter(is_finite)
            .collect(),
    };
    let mut frames: Vec<ContactFrame> =
        run.touches.iter().map(frame).filter(|f| f.driver_angle.is_finite()).collect();
    frames.sort_by(|a, b| a.driver_angle.total_cmp(&b.driver_angle));
    frames.dedup_by(|b, a| b.driver_angle <= a.driver_angle);
    frames
}

fn is_finite(touch: &Touch) -> bool {
    [touch.x, touch.y, touch.force[0], touch.force[1]].iter().all(|v| v.is_finite())
}

/// Lists `[driver angle, x, y, force x, force y, x, y, ...]`, at most [`PAGE_CONTACT_FRAMES`].
pub(super) fn block(frames: &[ContactFrame], grid: Grid) -> Value {
    let fine = 10f64.powi(DIGITS);
    // Adding zero makes a minus zero plain.
    let rounded = |v: f64| (v * fine).round() / fine + 0.0;
    let stride = frames.len().div_ceil(PAGE_CONTACT_FRAMES).max(1);
    let list = |frame: &ContactFrame| -> Vec<f64> {
        let touches = frame.touches.iter().filter(|t| is_finite(t)).flat_map(|t| {
            let [x, y] = t.force;
            [grid.rounded(t.x), grid.rounded(t.y), rounded(x), rounded(y)]
        });
        std::iter::once(rounded(frame.driver_angle)).chain(touches).collect()
    };
    let known = frames.iter().filter(|f| f.driver_angle.is_finite());
    json!(known.step_by(stride).map(list).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Point, Vector};
    use crate::meshing::{DynamicsOptions, DynamicsSummary};
    use std::f64::consts::TAU;

    fn run(touches: Vec<Touches>) -> Dynamics {
        Dynamics {
            options: DynamicsOptions::default(),
            steps: Vec::new(),
            summary: DynamicsSummary::default(),
            touches,
            stopped: None,
        }
    }

    #[test]
    fn frames_rise_within_the_cycle_and_the_greatest_force_is_one() {
        let at = |driver_angle, force: f64| Touches {
            driver_angle,
            points: vec![(Point::new(24.0, 1.0), Vector::new(0.6 * force, -0.8 * force))],
        };
        let frames = contact_frames(&run(vec![at(-0.1, 5.0), at(-0.3, 20.0), at(-0.2, 1.0)]), TAU);
        let angles: Vec<f64> = frames.iter().map(|f| f.driver_angle).collect();
        let wanted = [TAU - 0.3, TAU - 0.2, TAU - 0.1];
        assert!(angles.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-12), "{angles:?}");
        let first = frames[0].touches[0];
        assert!((first.force[0] - 0.6).abs() < 1e-12 && (first.force[1] + 0.8).abs() < 1e-12);
        assert!((frames[2].touches[0].force[0] - 0.15).abs() < 1e-12);
    }

    #[test]
    fn what_is_not_finite_is_left_out() {
        let bad = Touches {
            driver_angle: 0.5,
            points: vec![
                (Point::new(f64::NAN, 0.0), Vector::new(1.0, 0.0)),
                (Point::new(1.0, 0.0), Vector::new(2.0, 0.0)),
            ],
        };
        let lost = Touches { driver_angle: f64::NAN, points: Vec::new() };
        let frames = contact_frames(&run(vec![bad, lost]), TAU);
        assert_eq!(frames.len(), 1);
        assert_eq!(frames[0].touches, [Touch { x: 1.0, y: 0.0, force: [1.0, 0.0] }]);
    }

    #[test]
    fn long_runs_are_thinned() {
        let frame = |i: usize| ContactFrame { driver_angle: i as f64, touches: Vec::new() };
        let frames: Vec<_> = (0..3 * PAGE_CONTACT_FRAMES + 1).map(frame).collect();
        let made = block(&frames, Grid::for_extent(100.0, 5));
        let count = made.as_array().map_or(0, Vec::len);
        assert!(count > PAGE_CONTACT_FRAMES / 2 && count <= PAGE_CONTACT_FRAMES, "{count}");
    }
}
