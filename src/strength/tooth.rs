//! Lewis's form factor, measured on the outline of each tooth.

use crate::geometry::{Point, Vector};
use crate::policy;
use crate::teeth::{EdgeKind, Profile};

/// How well one tooth resists bending.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FormFactor {
    /// Number of the tooth, counter-clockwise from the first of the outline.
    pub index: usize,
    /// Y for a load at the tip, the weaker of the two flanks.
    pub value: f64,
    /// Middle of the tip, mm.
    pub tip: Point,
    /// Thickness of the section that bends most, mm.
    pub thickness: f64,
    /// Its depth below the tip, mm.
    pub depth: f64,
}

/// Lewis's Y of every tooth of a gear, counter-clockwise from the first tip of the outline.
///
/// The load acts at a corner of the tip, along the normal of its flank; where it crosses the middle of the tooth stands the vertex of
/// Lewis's parabola. The largest parabola inside the tooth touches it where `t^2 / (6 h m)` is least: t the thickness at
/// depth h below the vertex. Teeth without a measurable section are left out.
#[must_use]
pub fn form_factors(profile: &Profile, module: f64) -> Vec<FormFactor> {
    let n = profile.points.len();
    let tips = tip_runs(profile);
    let count = tips.len();
    if count < 2 {
        return Vec::new();
    }
    (0..count)
        .filter_map(|k| {
            let (before, here, after) =
                (tips[(k + count - 1) % count], tips[k], tips[(k + 1) % count]);
            let from = root_between(profile, before.1, here.0);
            let to = root_between(profile, here.1, after.0);
            let walk =
                |from: usize, to: usize| (0..=(to + n - from) % n).map(move |i| (from + i) % n);
            let falling: Vec<Point> = walk(here.1, to).map(|i| profile.points[i]).collect();
            let mut rising: Vec<Point> = walk(from, here.0).map(|i| profile.points[i]).collect();
            rising.reverse();
            measured(k, [&rising, &falling], module)
        })
        .collect()
}

/// First and last point of each tip; pieces of a tip with no root between are one.
fn tip_runs(profile: &Profile) -> Vec<(usize, usize)> {
    let n = profile.points.len();
    let Some(start) = profile.kinds.iter().position(|k| *k == EdgeKind::Root) else {
        return Vec::new();
    };
    let mut runs: Vec<(usize, usize)> = Vec::new();
    let mut open = false;
    for i in (start..start + n).map(|i| i % n) {
        match profile.kinds[i] {
            EdgeKind::Root => open = false,
            EdgeKind::Flank => {}
            EdgeKind::Tip => {
                let end = (i + 1) % n;
                match runs.last_mut() {
                    Some(run) if open => run.1 = end,
                    _ => runs.push((i, end)),
                }
                open = true;
            }
        }
    }
    runs
}

/// The middle, by length, of the outline's root edges between two points.
fn root_between(profile: &Profile, from: usize, to: usize) -> usize {
    let n = profile.points.len();
    let edges: Vec<usize> = (0..(to + n - from) % n).map(|k| (from + k) % n).collect();
    let length = |i: &usize| (profile.points[(i + 1) % n] - profile.points[*i]).norm();
    let roots: Vec<usize> =
        edges.iter().copied().filter(|i| profile.kinds[*i] == EdgeKind::Root).collect();
    let mut left = 0.5 * roots.iter().map(length).sum::<f64>();
    for i in &roots {
        left -= length(i);
        if left <= 0.0 {
            return (i + 1) % n;
        }
    }
    from
}

/// The factor of a tooth with these two sides, each from its corner of the tip down to the middle of the root.
fn measured(index: usize, sides: [&[Point]; 2], module: f64) -> Option<FormFactor> {
    let ([first, .., left_root], [second, .., right_root]) = (sides[0], sides[1]) else {
        return None;
    };
    let tip = first + 0.5 * (second - first);
    let along = (right_root - left_root).try_normalize(f64::EPSILON)?;
    // Down into the gear: the roots lie below the tip.
    let mut down = Vector::new(-along.y, along.x);
    if down.dot(&(left_root - tip)) < 0.0 {
        down = -down;
    }
    // Distance from the middle of the tooth outwards, and depth below the tip.
    let local = |side: &[Point], sign: f64| -> Vec<(f64, f64)> {
        side.iter().map(|p| (sign * along.dot(&(p - tip)), down.dot(&(p - tip)))).collect()
    };
    let halves = [local(sides[0], -1.0), local(sides[1], 1.0)];
    let deepest =
        halves.iter().map(|h| h.last().map_or(0.0, |p| p.1)).fold(f64::INFINITY, f64::min);
    let steps = policy::LEWIS_SECTIONS;
    let mut best: Option<FormFactor> = None;
    for half in &halves {
        let vertex = vertex(half)?;
        for i in 1..=steps {
            let depth = vertex + (deepest - vertex) * f64::from(i) / f64::from(steps);
            let [Some(a), Some(b)] = [&halves[0], &halves[1]].map(|h| half_width(h, depth)) else {
                continue;
            };
            let (thickness, below) = (a + b, depth - vertex);
            if below < policy::LEWIS_LEAST_DEPTH * module || thickness <= 0.0 {
                continue;
            }
            let value = thickness * thickness / (6.0 * below * module);
            if best.is_none_or(|b| value < b.value) {
                best = Some(FormFactor { index, value, tip, thickness, depth });
            }
        }
    }
    best
}

/// Depth at which the normal of the flank at the corner of the tip crosses the middle of the tooth.
fn vertex(half: &[(f64, f64)]) -> Option<f64> {
    let (x, depth) = *half.first()?;
    let (nx, nd) =
        half.iter().copied().find(|p| p.1 > depth + policy::LEWIS_FLANK_STEP * x.abs())?;
    Some(depth + x * (nx - x) / (nd - depth))
}

/// Distance of a side from the middle at a depth, the nearest where it is crossed more than once.
fn half_width(half: &[(f64, f64)], depth: f64) -> Option<f64> {
    half.windows(2)
        .filter(|w| (w[0].1 <= depth) != (w[1].1 <= depth))
        .map(|w| {
            let t = (depth - w[0].1) / (w[1].1 - w[0].1);
            w[0].0 + t * (w[1].0 - w[0].0)
        })
        .min_by(f64::total_cmp)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wedge_has_the_factor_of_its_parabola() {
        // Sides x = 0.2 + depth: the normal at the corner crosses the middle 0.2 deep, so with h = depth - 0.2 the
        // thickness is 2 (h + 0.4), and (h + 0.4)^2 / h is least at h = 0.4.
        let side = |sign: f64| -> Vec<Point> {
            (0..=200)
                .map(|i| 0.01 * f64::from(i))
                .map(|d| Point::new(sign * (0.2 + d), -d))
                .collect()
        };
        let found = measured(7, [&side(-1.0), &side(1.0)], 1.0).unwrap();
        assert!((found.value - 4.0 * 0.64 / (6.0 * 0.4)).abs() < 1e-3, "{found:?}");
        assert!((found.depth - 0.6).abs() < 0.02 && (found.thickness - 1.6).abs() < 0.05);
    }

    #[test]
    fn an_outline_without_teeth_has_none() {
        let points = vec![Point::origin(), Point::new(1.0, 0.0), Point::new(0.0, 1.0)];
        let profile = Profile { points, kinds: vec![EdgeKind::Root; 3] };
        assert!(form_factors(&profile, 1.0).is_empty());
    }
}
