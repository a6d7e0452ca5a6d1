//! Pairs of arcs along a smooth curve.

use super::arc::Arc;
use super::cubic::CubicPath;
use super::samples::Samples;
use crate::geometry::{Point, Vector, cross};
use crate::policy;

/// The two arcs that leave `p` along `t`, reach `q` along `w` and share their tangent where they meet,
/// with equal lengths of tangent on both ends. `None` where an arc would turn by half a circle or more.
pub(super) fn biarc(p: Point, t: Vector, q: Point, w: Vector) -> Option<[Arc; 2]> {
    let v = q - p;
    let (sum, apart) = (v.dot(&(t + w)), 2.0 * (1.0 - t.dot(&w)));
    let square = v.norm_squared();
    // Root of apart d^2 + 2 sum d - square, in the form that stays exact for parallel tangents.
    let d = square / (sum + (sum * sum + apart * square).sqrt());
    if !(d > 0.0 && d.is_finite()) {
        return None;
    }
    let joint = nalgebra::center(&(p + d * t), &(q - d * w));
    let first = joint - p;
    let second = q - joint;
    let half = |from: Vector, to: Vector| cross(from, to).atan2(from.dot(&to));
    let (a, b) = (half(t, first), half(second, w));
    let most = std::f64::consts::FRAC_PI_2;
    if a.abs() >= most || b.abs() >= most {
        return None;
    }
    Some([arc(p, joint, a), arc(joint, q, b)])
}

/// The arc whose chord makes the angle `half` with its tangents; straight when it hardly leaves its chord.
fn arc(from: Point, to: Point, half: f64) -> Arc {
    let bulge = (0.5 * half).tan();
    let sagitta = 0.5 * (to - from).norm() * bulge.abs();
    Arc { from, to, bulge: if sagitta < policy::STRAIGHT_SAGITTA { 0.0 } else { bulge } }
}

/// Arcs along `path` with continuous tangents that pass the samples within `tolerance`, and their chords
/// within [`Samples::allowance`]: the longest pair of arcs that does, again and again.
pub(super) fn arcs_along(path: &CubicPath, samples: &Samples, tolerance: f64) -> Vec<Arc> {
    let last = samples.points.len() - 1;
    let at: Vec<(Point, Vector)> = samples
        .walked
        .iter()
        .map(|&u| {
            let (p, d) = path.at(u);
            (p, d.normalize())
        })
        .collect();
    let good = |i: usize, j: usize| -> Option<[Arc; 2]> {
        let pair = biarc(at[i].0, at[i].1, at[j].0, at[j].1)?;
        let off = |p: Point| pair[0].distance(p).min(pair[1].distance(p));
        let close = (i..=j).all(|k| off(samples.points[k]) <= tolerance)
            && (i..j).all(|k| {
                let most = samples.allowance(k, tolerance);
                samples.places(k).iter().all(|&(_, p)| off(p) <= most)
            });
        close.then_some(pair)
    };
    let mut arcs = Vec::new();
    let mut i = 0;
    while i < last {
        let next = i + 1;
        let tame = |pair: &[Arc; 2]| pair.iter().all(|a| a.angle().abs() < policy::CUBIC_TURN);
        let single = biarc(at[i].0, at[i].1, at[next].0, at[next].1).filter(tame);
        let mut best = (next, single);
        let mut step = 2;
        let mut beyond = last + 1;
        while i + step <= last {
            match good(i, i + step) {
                Some(pair) => best = (i + step, Some(pair)),
                None => {
                    beyond = i + step;
                    break;
                }
            }
            step *= 2;
        }
        let mut ahead = beyond.min(last + 1);
        while best.0 + 1 < ahead {
            let middle = usize::midpoint(best.0, ahead);
            match good(i, middle) {
                Some(pair) => best = (middle, Some(pair)),
                None => ahead = middle,
            }
        }
        match best.1 {
            Some(pair) => arcs.extend(pair),
            // Tangents that no pair of arcs can serve: a speck of the outline, crossed straight.
            None => arcs.push(Arc::line(at[i].0, at[best.0].0)),
        }
        i = best.0;
    }
    arcs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_arcs_share_their_tangent_and_keep_the_ends() {
        for (angle, out) in [(0.3, 0.9), (-0.7, 0.2), (1.2, -1.0), (0.0, 0.4), (0.5, 0.5)] {
            let (p, q) = (Point::new(1.0, 2.0), Point::new(4.0, 2.5));
            let direction = |a: f64| Vector::new(a.cos(), a.sin());
            let [first, second] = biarc(p, direction(angle), q, direction(out)).unwrap();
            assert_eq!((first.from, first.to, second.to), (p, second.from, q));
            assert!((first.tangents()[0] - direction(angle)).norm() < 1e-12);
            assert!((second.tangents()[1] - direction(out)).norm() < 1e-12);
            assert!((first.tangents()[1] - second.tangents()[0]).norm() < 1e-12);
        }
    }

    #[test]
    fn tangents_along_the_chord_give_lines() {
        let [a, b] =
            biarc(Point::origin(), Vector::x(), Point::new(2.0, 0.0), Vector::x()).unwrap();
        assert_eq!((a.bulge, b.bulge), (0.0, 0.0));
        assert_eq!(a.to, Point::new(1.0, 0.0));
        assert!(biarc(Point::origin(), -Vector::x(), Point::new(2.0, 0.0), -Vector::x()).is_none());
    }
}
