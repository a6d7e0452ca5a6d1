//! Contours out of pieces whose ends meet.

use super::Ring;
use crate::geometry::Point;
use std::collections::HashMap;

/// Joins open pieces (of at least two points) where their ends lie within `gap`; O(n). Pieces that
/// are left over make open rings.
pub(super) fn chained(pieces: Vec<Vec<Point>>, gap: f64) -> Vec<Ring> {
    let cell = |p: Point| ((p.x / gap).floor() as i64, (p.y / gap).floor() as i64);
    let mut ends: HashMap<(i64, i64), Vec<(usize, bool)>> = HashMap::new();
    for (i, piece) in pieces.iter().enumerate() {
        if let (Some(&first), Some(&last)) = (piece.first(), piece.last()) {
            ends.entry(cell(first)).or_default().push((i, false));
            ends.entry(cell(last)).or_default().push((i, true));
        }
    }
    let mut used = vec![false; pieces.len()];
    let nearest = |at: Point, used: &[bool]| -> Option<(usize, bool)> {
        let (column, row) = cell(at);
        let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (column + dx, row + dy)));
        around
            .filter_map(|key| ends.get(&key))
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
    for start in 0..pieces.len() {
        if used[start] || pieces[start].len() < 2 {
            continue;
        }
        used[start] = true;
        let mut points = pieces[start].clone();
        // Onwards from the last point, then from the first.
        for _ in 0..2 {
            while let Some((i, reversed)) = points.last().and_then(|&end| nearest(end, &used)) {
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
    rings
}
