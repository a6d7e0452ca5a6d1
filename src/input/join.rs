//! Closed contours out of pieces whose ends meet, or nearly do.

use super::contours::Contour;
use crate::geometry::{self, Point, Vector, cross};
use std::collections::{HashMap, HashSet};

/// Ends this close belong together whatever the tolerance, over the diagonal of the drawing: rounding of written numbers.
const EXACT_GAP: f64 = 1e-6;
/// Widest gap that is joined unless the user says otherwise: this many mm, or this share of the diagonal if that is more.
/// A cutter's own programs join 0.05 mm and more; teeth are wider.
const JOIN_GAP: (f64, f64) = (0.05, 1e-4);
/// Share of the diagonal that a default gap stays below: small drawings have small details.
const JOIN_MOST: f64 = 5e-3;
/// Comparisons of ends after which a drawing is given up: a crowd of ends in one spot takes time with the square of their
/// number.
const TESTS: usize = 50_000_000;

/// What was joined beyond rounding, in the unit of the drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Joints {
    pub(super) places: usize,
    pub(super) widest: f64,
    pub(super) tolerance: f64,
}

/// The widest gap that is joined, in a drawing of this diagonal whose unit has so many mm. `asked` is in mm.
pub(super) fn tolerance(asked: Option<f64>, diagonal: f64, mm: f64) -> f64 {
    match asked {
        Some(gap) => gap / mm,
        None => (JOIN_GAP.0 / mm).max(JOIN_GAP.1 * diagonal).min(JOIN_MOST * diagonal),
    }
}

/// Joins open pieces where their ends lie within `tolerance`, those that meet exactly first. Pieces that lead nowhere are
/// left over as open contours. Pieces that are drawn twice, also in reverse, count once.
///
/// `None` where so many ends lie close together that it would take more than [`TESTS`] comparisons.
pub(super) fn joined(
    pieces: Vec<Contour>,
    diagonal: f64,
    tolerance: f64,
) -> Option<(Vec<Contour>, Joints)> {
    let exact = EXACT_GAP * diagonal;
    let (mut closed, open): (Vec<_>, Vec<_>) = pieces.into_iter().partition(|p| p.closed);
    let mut tests = 0;
    let mut joints = Joints { tolerance, ..Joints::default() };
    let mut open = once(parted(open, exact, &mut tests), exact);
    for gap in [exact, tolerance.max(exact)] {
        // What leads nowhere would lead the walk astray, so it waits until the rings are found.
        let (kept, dangling) = without_dead_ends(open, gap, &mut tests)?;
        let mut left = Vec::new();
        for made in chained(kept, gap, exact, &mut tests, &mut joints)?.into_iter() {
            if made.closed { closed.push(made) } else { left.push(made) }
        }
        left.extend(dangling);
        open = chained(left, gap, exact, &mut tests, &mut joints)?;
        let (rings, rest): (Vec<_>, Vec<_>) = open.into_iter().partition(|p| p.closed);
        closed.extend(rings);
        open = rest;
    }
    closed.extend(open);
    Some((closed, joints))
}

/// Pieces whose straight lines are cut where lines that lie upon them end: what overlaps is then drawn twice, and counts once.
/// A drawing with too many lines on one another stays as it is.
fn parted(pieces: Vec<Contour>, exact: f64, tests: &mut usize) -> Vec<Contour> {
    let exact = exact.max(f64::MIN_POSITIVE);
    let ends = |c: &Contour| match c.points[..] {
        [a, b] if (b - a).norm() > exact => Some((a, b)),
        _ => None,
    };
    let straight: Vec<(Point, Point)> = pieces.iter().filter_map(ends).collect();
    let middle = straight.iter().fold(Vector::zeros(), |sum, (a, b)| sum + a.coords + b.coords)
        / (2 * straight.len().max(1)) as f64;
    let reach = straight.iter().map(|(a, _)| (a.coords - middle).norm()).fold(exact, f64::max);
    let step = LINE_STEP * reach;
    let keys = |a: Point, b: Point| {
        let along = b - a;
        let angle = along.y.atan2(along.x).rem_euclid(std::f64::consts::PI);
        let offset = cross(Vector::new(angle.cos(), angle.sin()), a.coords - middle);
        let turned = angle - std::f64::consts::PI;
        [(angle, offset), (turned, -offset)]
            .map(|(a, o)| ((a / LINE_STEP).round() as i64, (o / step).round() as i64))
    };
    let mut on: HashMap<(i64, i64), Vec<(Point, Point)>> = HashMap::new();
    for &(a, b) in &straight {
        for key in keys(a, b) {
            on.entry(key).or_default().push((a, b));
        }
    }
    let mut made = Vec::with_capacity(pieces.len());
    for piece in &pieces {
        let Some((a, b)) = ends(piece) else {
            made.push(piece.clone());
            continue;
        };
        let (length, unit) = ((b - a).norm(), (b - a).normalize());
        let mut cuts = vec![0.0, length];
        let (turn, offset) = keys(a, b)[0];
        for key in (-1..=1).flat_map(|t| (-1..=1).map(move |o| (turn + t, offset + o))) {
            let others = on.get(&key).map_or(&[][..], Vec::as_slice);
            *tests += others.len();
            if *tests > TESTS / 2 {
                *tests = 0;
                return pieces;
            }
            for &(p, q) in others {
                let [u, v] = [p, q].map(|p| unit.dot(&(p - a)));
                let beside = [p, q].iter().all(|&p| cross(unit, p - a).abs() <= exact);
                if beside && u.min(v) < length - exact && u.max(v) > exact {
                    cuts.extend([u, v].iter().filter(|w| **w > exact && **w < length - exact));
                }
            }
        }
        cuts.sort_by(f64::total_cmp);
        cuts.dedup_by(|b, a| *b - *a <= exact);
        for ends in cuts.windows(2) {
            let at = |w: f64| if w >= length - exact { b } else { a + w * unit };
            made.push(Contour { points: ends.iter().map(|w| at(*w)).collect(), ..piece.clone() });
        }
    }
    made
}

/// Directions (radians) and offsets (over the size of the drawing) of lines this close are compared.
const LINE_STEP: f64 = 1e-4;

/// Pieces without those that are drawn again.
fn once(pieces: Vec<Contour>, exact: f64) -> Vec<Contour> {
    let step = exact.max(f64::MIN_POSITIVE);
    let cell = |p: Point| [(p.x / step).round() as i64, (p.y / step).round() as i64];
    let mut seen: HashSet<[[i64; 2]; 3]> = HashSet::new();
    let mut kept = Vec::with_capacity(pieces.len());
    for piece in pieces {
        let (Some(&a), Some(&b)) = (piece.points.first(), piece.points.last()) else { continue };
        let (a, b) = (cell(a), cell(b));
        let middle = cell(halfway(&piece.points));
        if piece.points.len() > 1 && seen.insert([a.min(b), a.max(b), middle]) {
            kept.push(piece);
        }
    }
    kept
}

/// The point half of the way along.
fn halfway(points: &[Point]) -> Point {
    let total: f64 = points.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
    let mut left = 0.5 * total;
    for w in points.windows(2) {
        let step = (w[1] - w[0]).norm();
        if step >= left && step > 0.0 {
            return w[0] + (w[1] - w[0]) * (left / step);
        }
        left -= step;
    }
    points[points.len() - 1]
}

/// Which ends meet: a number for each end of each piece, the same for ends within `gap` of each other.
fn nodes(pieces: &[Contour], gap: f64, tests: &mut usize) -> Option<Vec<[usize; 2]>> {
    let gap = gap.max(f64::MIN_POSITIVE);
    let ends: Vec<Point> =
        pieces.iter().flat_map(|p| [p.points[0], p.points[p.points.len() - 1]]).collect();
    let cell = |p: Point| ((p.x / gap).floor() as i64, (p.y / gap).floor() as i64);
    let mut grid: HashMap<(i64, i64), Vec<usize>> = HashMap::new();
    let mut parent: Vec<usize> = (0..ends.len()).collect();
    for (i, &end) in ends.iter().enumerate() {
        let (column, row) = cell(end);
        for key in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
            let key = (column.saturating_add(key.0), row.saturating_add(key.1));
            let Some(others) = grid.get(&key) else { continue };
            *tests += others.len();
            if *tests > TESTS {
                return None;
            }
            for &j in others {
                if (ends[j] - end).norm() <= gap {
                    let (a, b) = (root(&mut parent, i), root(&mut parent, j));
                    parent[a.max(b)] = a.min(b);
                }
            }
        }
        grid.entry((column, row)).or_default().push(i);
    }
    Some(
        (0..pieces.len())
            .map(|i| [root(&mut parent, 2 * i), root(&mut parent, 2 * i + 1)])
            .collect(),
    )
}

fn root(parent: &mut [usize], mut i: usize) -> usize {
    while parent[i] != i {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    i
}

/// Splits pieces into those that may be part of a ring and those that lead to a free end.
fn without_dead_ends(
    pieces: Vec<Contour>,
    gap: f64,
    tests: &mut usize,
) -> Option<(Vec<Contour>, Vec<Contour>)> {
    let nodes = nodes(&pieces, gap, tests)?;
    let mut at: HashMap<usize, Vec<usize>> = HashMap::new();
    for (i, ends) in nodes.iter().enumerate() {
        ends.iter().for_each(|n| at.entry(*n).or_default().push(i));
    }
    let mut degree: HashMap<usize, usize> = at.iter().map(|(n, list)| (*n, list.len())).collect();
    let mut dead = vec![false; pieces.len()];
    let mut free: Vec<usize> = degree.iter().filter(|(_, d)| **d == 1).map(|(n, _)| *n).collect();
    while let Some(node) = free.pop() {
        for &i in &at[&node] {
            if std::mem::replace(&mut dead[i], true) {
                continue;
            }
            for n in nodes[i] {
                if let Some(d) = degree.get_mut(&n) {
                    *d -= 1;
                    if *d == 1 {
                        free.push(n);
                    }
                }
            }
        }
    }
    let (mut kept, mut dangling) = (Vec::new(), Vec::new());
    for (piece, dead) in pieces.into_iter().zip(dead) {
        (if dead { &mut dangling } else { &mut kept }).push(piece);
    }
    Some((kept, dangling))
}

/// Walks from piece to piece; where several go on, first on the same layer, then straight ahead.
fn chained(
    pieces: Vec<Contour>,
    gap: f64,
    exact: f64,
    tests: &mut usize,
    joints: &mut Joints,
) -> Option<Vec<Contour>> {
    let nodes = nodes(&pieces, gap, tests)?;
    let mut at: HashMap<usize, Vec<usize>> = HashMap::new();
    for (i, ends) in nodes.iter().enumerate() {
        ends.iter().for_each(|n| at.entry(*n).or_default().push(i));
    }
    let mut used = vec![false; pieces.len()];
    let mut made = Vec::new();
    for start in 0..pieces.len() {
        if used[start] {
            continue;
        }
        used[start] = true;
        let mut chain = pieces[start].clone();
        let [mut first, mut last] = nodes[start];
        let long = chain.points.len() > 2 || first != last;
        let mut gaps = Vec::new();
        // Onwards from the last point, then from the first.
        for _ in 0..2 {
            while first != last {
                let heading = heading(&chain.points);
                let candidates = at.get(&last).map_or(&[][..], Vec::as_slice);
                *tests += candidates.len();
                if *tests > TESTS {
                    return None;
                }
                let next = candidates
                    .iter()
                    .filter(|i| !used[**i])
                    .map(|&i| {
                        let reversed = nodes[i][0] != last;
                        let other =
                            pieces[i].layer != chain.layer || pieces[i].dashed != chain.dashed;
                        let end = if reversed {
                            pieces[i].points.last()
                        } else {
                            pieces[i].points.first()
                        };
                        let miss =
                            end.zip(chain.points.last()).map_or(0.0, |(a, b)| (a - b).norm());
                        let bend = turn(heading, tail(&pieces[i].points, reversed));
                        (i, reversed, other, miss > exact, bend, miss)
                    })
                    .min_by(|a, b| {
                        (a.2, a.3).cmp(&(b.2, b.3)).then(a.4.total_cmp(&b.4)).then(a.0.cmp(&b.0))
                    });
                let Some((i, reversed, .., miss)) = next else { break };
                used[i] = true;
                let more: Vec<Point> = if reversed {
                    pieces[i].points.iter().rev().copied().collect()
                } else {
                    pieces[i].points.clone()
                };
                if miss > exact {
                    gaps.push(miss);
                }
                append(&mut chain.points, more, miss > exact);
                last = nodes[i][usize::from(!reversed)];
            }
            chain.points.reverse();
            std::mem::swap(&mut first, &mut last);
        }
        if first == last && long && chain.points.len() > 2 {
            let miss = (chain.points[0] - chain.points[chain.points.len() - 1]).norm();
            // Ends that are apart by more than they are long make no ring.
            if miss <= 0.1 * geometry::perimeter(&chain.points) {
                if miss > exact {
                    gaps.push(miss);
                }
                let last = chain.points.pop();
                if let Some(last) = last.filter(|_| miss > exact) {
                    chain.points[0] = nalgebra::center(&chain.points[0], &last);
                }
                chain.closed = true;
            }
        }
        joints.places += gaps.len();
        joints.widest = gaps.into_iter().fold(joints.widest, f64::max);
        made.push(chain);
    }
    Some(made)
}

/// Adds the points behind a joint; where the ends miss each other they meet half-way.
fn append(points: &mut Vec<Point>, more: Vec<Point>, apart: bool) {
    if apart && let (Some(last), Some(first)) = (points.last_mut(), more.first()) {
        *last = nalgebra::center(last, first);
    }
    points.extend(more.into_iter().skip(1));
}

/// Direction at the end of a chain.
fn heading(points: &[Point]) -> Vector {
    let n = points.len();
    if n < 2 { Vector::zeros() } else { points[n - 1] - points[n - 2] }
}

/// Direction at the start of a piece that is walked forwards or in reverse.
fn tail(points: &[Point], reversed: bool) -> Vector {
    let n = points.len();
    match n {
        0 | 1 => Vector::zeros(),
        _ if reversed => points[n - 2] - points[n - 1],
        _ => points[1] - points[0],
    }
}

fn turn(a: Vector, b: Vector) -> f64 {
    cross(a, b).atan2(a.dot(&b)).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn piece(points: &[(f64, f64)]) -> Contour {
        let points = points.iter().map(|&(x, y)| Point::new(x, y)).collect();
        Contour { points, ..Contour::default() }
    }

    #[test]
    fn a_crowd_of_ends_is_given_up_soon() {
        let crowd = |n: u32| -> Vec<Contour> {
            (0..n).map(|i| piece(&[(1e-9 * f64::from(i), 0.0), (0.3, f64::from(i))])).collect()
        };
        assert!(joined(crowd(100), 1.0, 1e-3).is_some());
        assert!(joined(crowd(20_000), 1.0, 1e-3).is_none());
    }

    #[test]
    fn rings_are_found_beside_lines_that_lead_nowhere_and_lines_drawn_twice() {
        let square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)];
        let mut pieces: Vec<Contour> =
            (0..4).map(|i| piece(&[square[i], square[(i + 1) % 4]])).collect();
        pieces.insert(1, piece(&[(4.0, 0.0), (9.0, 0.0)]));
        pieces.push(piece(&[(4.0, 4.0), (4.0, 0.0)]));
        let (made, joints) = joined(pieces, 10.0, 0.01).unwrap();
        let rings: Vec<&Contour> = made.iter().filter(|c| c.closed).collect();
        assert_eq!((rings.len(), made.len(), joints.places), (1, 2, 0));
        assert!((geometry::area(&rings[0].points) - 16.0).abs() < 1e-12);
    }

    #[test]
    fn lines_that_lie_upon_one_another_in_part_count_once() {
        let square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)];
        for turn in [0.0, 0.3, 1.5, 3.1] {
            let at = |(x, y): (f64, f64)| {
                (x * f64::cos(turn) - y * f64::sin(turn), x * f64::sin(turn) + y * f64::cos(turn))
            };
            let mut pieces = Vec::new();
            for i in 0..4 {
                let (a, b) = (square[i], square[(i + 1) % 4]);
                let between = |t: f64| (a.0 + t * (b.0 - a.0), a.1 + t * (b.1 - a.1));
                pieces.push(piece(&[at(a), at(between(0.7))]));
                pieces.push(piece(&[at(b), at(between(0.4))]));
            }
            // A line of construction along one side and beyond.
            pieces.push(piece(&[at((-3.0, 0.0)), at((9.0, 0.0))]));
            let (made, joints) = joined(pieces, 10.0, 0.01).unwrap();
            let rings: Vec<&Contour> = made.iter().filter(|c| c.closed).collect();
            assert_eq!((rings.len(), joints.places), (1, 0), "{turn}");
            assert!((geometry::area(&rings[0].points) - 16.0).abs() < 1e-9);
        }
    }

    #[test]
    fn gaps_within_the_tolerance_are_joined_and_counted() {
        let open = || {
            vec![
                piece(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0)]),
                piece(&[(4.02, 4.0), (0.0, 4.0), (0.0, 0.03)]),
            ]
        };
        let (made, joints) = joined(open(), 6.0, 0.05).unwrap();
        assert!(made.len() == 1 && made[0].closed);
        assert_eq!(joints.places, 2);
        assert!((joints.widest - 0.03).abs() < 1e-9);
        let (made, joints) = joined(open(), 6.0, 0.025).unwrap();
        assert!(made.len() == 1 && !made[0].closed && joints.places == 1, "{made:?}");
    }
}
