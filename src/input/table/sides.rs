//! Lists that give the two sides of a shape one after the other, or beside each other, as airfoil files do.

use super::cells::Cell;
use crate::geometry::{Point, first_self_crossing};

/// Fewest points on a side.
const SIDE: usize = 3;

/// The outline of a list of points with blank lines before some of them.
///
/// A list that is an outline already, as airfoils in Selig's form are, stays as it is. In Lednicer's form the first line
/// counts the points of both sides and each side begins at the nose; other lists of two sides that run the same way are put
/// together likewise.
pub(super) fn put_together(points: Vec<Point>, breaks: &[usize]) -> Vec<Point> {
    if let Some((first, rest)) = points.split_first() {
        let whole = |v: f64| v >= SIDE as f64 && v.fract() == 0.0;
        if whole(first.x) && whole(first.y) && rest.len() as f64 == first.x + first.y {
            return joined(&rest[..first.x as usize], &rest[first.x as usize..]);
        }
    }
    let split = match *breaks {
        [at] => Some(at),
        [] => turned_back(&points),
        _ => None,
    };
    if let Some(at) = split
        && at >= SIDE
        && points.len() - at >= SIDE
        && same_way(&points[..at], &points[at..])
        && first_self_crossing(&points).is_some()
    {
        let whole = joined(&points[..at], &points[at..]);
        if first_self_crossing(&whole).is_none() {
            return whole;
        }
    }
    points
}

/// The first side in reverse, then the second.
fn joined(first: &[Point], second: &[Point]) -> Vec<Point> {
    let mut whole: Vec<Point> = first.iter().rev().chain(second).copied().collect();
    whole.dedup();
    whole
}

/// Where x jumps back to where it began, if it runs one way before and after.
fn turned_back(points: &[Point]) -> Option<usize> {
    let steps: Vec<f64> = points.windows(2).map(|w| w[1].x - w[0].x).collect();
    let sense = steps.iter().find(|s| **s != 0.0)?.signum();
    let back: Vec<usize> = (0..steps.len()).filter(|&i| steps[i] * sense < 0.0).collect();
    match back[..] {
        [at] => Some(at + 1),
        _ => None,
    }
}

fn same_way(first: &[Point], second: &[Point]) -> bool {
    let run = |side: &[Point]| side[side.len() - 1].x - side[0].x;
    run(first) * run(second) > 0.0
}

/// The outline of rows of x and two heights, the first above the second.
pub(super) fn two_columns_of_heights(rows: &[&[Cell]]) -> Option<Vec<Point>> {
    if rows.len() < SIDE || rows.iter().any(|r| r.len() != 3) {
        return None;
    }
    let of = |i: usize| -> Option<Vec<f64>> { rows.iter().map(|r| r[i].number()).collect() };
    let [x, a, b] = [of(0)?, of(1)?, of(2)?];
    let n = x.len();
    let rising = x.windows(2).all(|w| w[1] > w[0]) || x.windows(2).all(|w| w[1] < w[0]);
    let depth = (0..n).map(|i| a[i] - b[i]);
    let most = depth.clone().fold(0.0, f64::max);
    let closed = (a[0] - b[0]).abs() <= 0.05 * most && (a[n - 1] - b[n - 1]).abs() <= 0.05 * most;
    if !(rising
        && closed
        && depth.clone().all(|d| d >= 0.0)
        && depth.skip(1).take(n - 2).all(|d| d > 0.0))
    {
        return None;
    }
    let upper = (0..n).rev().map(|i| Point::new(x[i], a[i]));
    let mut whole: Vec<Point> = upper.chain((0..n).map(|i| Point::new(x[i], b[i]))).collect();
    whole.dedup();
    Some(whole)
}
