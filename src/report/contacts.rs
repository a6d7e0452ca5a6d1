//! From a run of both gears to the contacts that the page draws, and their form in the page.

use super::data::{ContactFrame, Touch};
use super::text::Grid;
use crate::meshing::{Dynamics, Touches};
use crate::policy::{PAGE_CONTACT_DIGITS, PAGE_CONTACT_FRAMES, PAGE_USUAL_FORCES};
use serde_json::{Value, json};

/// The contacts of the first cycle of a run, by rising driver angle.
///
/// `driver_cycle` is the driver's turn, radians, after which every gear is back in its first pose. The
/// driver's axis is taken as the origin. A run backward is put where the page shows the same pose.
/// Forces are given over the one that [`PAGE_USUAL_FORCES`] of all stay under, and cut off there:
/// where several teeth wedge each other for a step, forces whose moments cancel can be of any size.
///
/// Moments at which a motor stood still or swung back are left out; so is what is not finite.
#[must_use]
pub fn contact_frames(run: &Dynamics, driver_cycle: f64) -> Vec<ContactFrame> {
    let mut sizes: Vec<f64> = run
        .touches
        .iter()
        .flat_map(|t| &t.points)
        .map(|(_, force)| force.norm())
        .filter(|f| f.is_finite())
        .collect();
    sizes.sort_by(f64::total_cmp);
    let usual = (PAGE_USUAL_FORCES * sizes.len() as f64).ceil() as usize;
    let unit =
        usual.checked_sub(1).and_then(|i| sizes.get(i)).map_or(1.0, |f| f.max(f64::MIN_POSITIVE));
    let frame = |touches: &Touches| ContactFrame {
        driver_angle: touches.driver_angle.rem_euclid(driver_cycle),
        touches: touches
            .points
            .iter()
            .map(|(p, force)| {
                let length = force.norm().max(unit);
                Touch { x: p.x, y: p.y, force: [force.x / length, force.y / length] }
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
    let fine = 10f64.powi(PAGE_CONTACT_DIGITS);
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
            foretold: None,
        }
    }

    #[test]
    fn frames_rise_within_the_cycle_and_forces_are_over_the_usual_ones() {
        let at = |driver_angle, force: f64| Touches {
            driver_angle,
            points: vec![(Point::new(24.0, 1.0), Vector::new(0.6 * force, -0.8 * force))],
        };
        // Of few forces the greatest is the unit.
        let frames = contact_frames(&run(vec![at(-0.1, 5.0), at(-0.3, 20.0), at(-0.2, 1.0)]), TAU);
        let angles: Vec<f64> = frames.iter().map(|f| f.driver_angle).collect();
        let wanted = [TAU - 0.3, TAU - 0.2, TAU - 0.1];
        assert!(angles.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-12), "{angles:?}");
        let first = frames[0].touches[0];
        assert!((first.force[0] - 0.6).abs() < 1e-12 && (first.force[1] + 0.8).abs() < 1e-12);
        assert!((frames[2].touches[0].force[0] - 0.15).abs() < 1e-12);
        // One wedged tooth among many does not shrink all others.
        let many = (0..100).map(|i| at(0.01 * f64::from(i), if i == 40 { 1e6 } else { 2.0 }));
        let frames = contact_frames(&run(many.collect()), TAU);
        for frame in &frames {
            let [x, y] = frame.touches[0].force;
            assert!((x - 0.6).abs() < 1e-12 && (y + 0.8).abs() < 1e-12, "{frame:?}");
        }
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
