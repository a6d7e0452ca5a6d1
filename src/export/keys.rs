//! Which samples of a motion an animation needs as keys.

use crate::assembly::Assembly;
use crate::policy;

/// Indices of motion samples, first and last among them, between which every gear's angle runs
/// straight within [`policy::ANIMATION_ANGLE_ERROR`] of the samples left out, and its farthest point within
/// [`policy::ANIMATION_ARC_ERROR`], by at most [`policy::ANIMATION_LONGEST_STEP`]. Greedy, so not the fewest, but near it.
pub(super) fn keys(assembly: &Assembly) -> Vec<usize> {
    let allowed: Vec<f64> = assembly
        .gears
        .iter()
        .map(|g| {
            let reach = g.gear.outline.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
            policy::ANIMATION_ANGLE_ERROR.min(policy::ANIMATION_ARC_ERROR / reach)
        })
        .collect();
    let last = assembly.driver_angle.len().saturating_sub(1);
    let mut keys = vec![0];
    let mut from = 0;
    while from < last {
        let mut to = from + 1;
        while to < last && straight(assembly, &allowed, from, to + 1) {
            to += 1;
        }
        keys.push(to);
        from = to;
    }
    keys
}

fn straight(assembly: &Assembly, allowed: &[f64], from: usize, to: usize) -> bool {
    let time = &assembly.driver_angle;
    assembly.gears.iter().map(|g| &g.angle).zip(allowed).all(|(angle, allowed)| {
        let turn = angle[to] - angle[from];
        turn.abs() < policy::ANIMATION_LONGEST_STEP
            && (from + 1..to).all(|i| {
                let t = (time[i] - time[from]) / (time[to] - time[from]);
                (angle[from] + t * turn - angle[i]).abs() <= *allowed
            })
    })
}

#[cfg(test)]
mod tests {
    use super::super::tests::wavy_pair;
    use super::*;

    #[test]
    fn straight_motion_needs_a_key_only_every_sixty_degrees() {
        let (mut assembly, _) = wavy_pair();
        assembly.gears.truncate(1);
        let keys = keys(&assembly);
        assert_eq!((keys[0], *keys.last().unwrap()), (0, 1024));
        assert!(keys.len() == 8 || keys.len() == 7, "{}", keys.len());
    }

    #[test]
    fn large_gears_get_more_keys() {
        let (mut assembly, _) = wavy_pair();
        let few = keys(&assembly).len();
        for placed in &mut assembly.gears {
            placed.gear.outline.iter_mut().for_each(|p| *p *= 20.0);
        }
        // The reach went from 42.5 to 850 mm: a tenth of the angle, three times the keys.
        let many = keys(&assembly).len();
        assert!(many > 2 * few, "{few} {many}");
    }

    #[test]
    fn between_keys_the_motion_is_within_the_tolerance() {
        let (assembly, _) = wavy_pair();
        let keys = keys(&assembly);
        assert!(keys.len() < 400, "{}", keys.len());
        for pair in keys.windows(2) {
            for placed in &assembly.gears {
                let (a, b) = (placed.angle[pair[0]], placed.angle[pair[1]]);
                assert!((b - a).abs() < 1.05);
                for i in pair[0]..=pair[1] {
                    let t = (i - pair[0]) as f64 / (pair[1] - pair[0]) as f64;
                    let off = (a + t * (b - a) - placed.angle[i]).abs();
                    assert!(off.to_degrees() < 0.0101, "{off}");
                }
            }
        }
    }
}
