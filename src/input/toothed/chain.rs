//! Contours out of pieces whose ends meet.

use super::Ring;
use crate::geometry::Point;
use crate::policy;
use std::collections::HashMap;

/// Joins open pieces (of at least two points, every coordinate within some 10^15 gaps of zero) where their ends lie
/// within `gap`. Pieces that are left over make open rings.
///
/// O(n) for ends that lie apart; `None` where so many lie close together that it would take more than
/// [`policy::CHAIN_TESTS`].
pub(super) fn chained(pieces: Vec<Vec<Point>>, gap: f64) -> Option<Vec<Ring>> {
    let cell = |p: Point| ((p.x / gap).floor() as i64, (p.y / gap).floor() as i64);
    let mut ends: HashMap<(i64, i64), Vec<(usize, bool)>> = HashMap::new();
    for (i, piece) in pieces.iter().enumerate() {
        if let (Some(&first), Some(&last)) = (piece.first(), piece.last()) {
            ends.entry(cell(first)).or_default().push((i, false));
            ends.entry(cell(last)).or_default().push((i, true));
        }
    }
    let mut used = vec![false; pieces.len()];
    let around = |at: Point| {
        let (column, row) = cell(at);
        let keys = (-1..=1).flat_map(move |dx| (-1..=1).map(move |dy| (column + dx, row + dy)));
        keys.filter_map(|key| ends.get(&key))
    };
    let nearest = |at: Point, used: &[bool]| -> Option<(usize, bool)> {
        around(at)
            .flatten()
            .filter(|(i, _)| !used[*i])
            .map(|&(i, last)| {
                let end = if last { pieces[i].last() } else { pieces[i].first() };
                (end.map_or(f64::INFINITY, |e| (e - at).norm()), i, last)
            })
            .filter(|(distance, ..)| *distance <= gap)
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
            .map(|(_, i, last)| (i, last))
    };
    let mut rings = Vec::new();
    let mut tests = 0;
    for start in 0..pieces.len() {
        if used[start] || pieces[start].len() < 2 {
            continue;
        }
        used[start] = true;
        let mut points = pieces[start].clone();
        // Onwards from the last point, then from the first.
        for _ in 0..2 {
            while let Some(&end) = points.last() {
                tests += around(end).map(Vec::len).sum::<usize>();
                if tests > policy::CHAIN_TESTS {
                    return None;
                }
                let Some((i, reversed)) = nearest(end, &used) else { break };
                used[i] = true;
                if reversed {
                    points.extend(pieces[i].iter().rev().skip(1));
                } else {
                    points.extend(pieces[i].iter().skip(1));
                }
            }
            points.reverse();
        }
        let closed = points.len() > 3 && (points[0] - points[points.len() - 1]).norm() <= gap;
        if closed {
            points.pop();
        }
        rings.push(Ring { points, closed });
    }
    Some(rings)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crowd_of_ends_is_given_up_soon() {
        let crowd = |n: u32| -> Vec<Vec<Point>> {
            let at = |i: u32| Point::new(1e-9 * f64::from(i), 0.0);
            (0..n).map(|i| vec![at(i), at(i + 1)]).collect()
        };
        // Both ends of the chain lie within the gap too: a ring.
        let joined = chained(crowd(100), 1e-6).unwrap();
        assert_eq!((joined.len(), joined[0].points.len(), joined[0].closed), (1, 100, true));
        assert!(chained(crowd(50_000), 1e-6).is_none());
    }
}
