//! Carving one gear with the other: the follower is what the moving driver leaves of a blank.
//!
//! The boundary of the region that a moving polygon sweeps consists of paths of its corners and of
//! places where an edge moves along itself (paper, section 3.3 (iii); envelope theory in Litvin and
//! Fuentes, ch. 6). Seen from the follower the driver turns about the pitch point `P`, so a boundary
//! point `q` with tangent `t` moves outward where `(q - P) . t < 0`. A corner is on the envelope
//! while that sign differs between its two edges, an edge while it differs between its two ends.
//! Only these pieces are kept, each given a little depth into the driver, and their union is cut
//! from the blank; the part that holds the follower's axis is the gear. Corner paths are followed
//! from instant to instant, so no scallops appear between instants.

use rayon::prelude::*;

use super::rolling::{Instant, Rolling};
use crate::control::{Cancelled, Control};
use crate::gear::Side;
use crate::geometry::{self, Point, Vector, cross, quarter_turn};
use crate::outline::simplify;
use crate::policy;

/// What carving found.
#[derive(Clone, Debug)]
pub(crate) struct Carved {
    /// The follower, counter-clockwise, in its frame; the blank itself when nothing was cut.
    pub(crate) outline: Vec<Point>,
    /// Pieces of envelope that were cut away.
    pub(crate) cuts: usize,
}

/// Carves `blank` (follower's frame) with `tool` (driver's frame) over `arc` mm of rolling from 0, at
/// `instants` evenly spaced instants. `depth` (mm) is how far each envelope piece reaches into the
/// tool; it must stay below the tool's thinnest wall. With `only_inside`, pieces of envelope that lie
/// outside the blank are left out before any boolean, but for those next to one that lies inside: the
/// cut must reach the blank's boundary on all sides, or what it separates stays attached.
pub(crate) fn carve(
    rolling: &Rolling,
    tool: &[Point],
    blank: &[Point],
    (arc, instants): (f64, usize),
    depth: f64,
    only_inside: bool,
    control: &Control,
) -> Result<Option<Carved>, Cancelled> {
    // Some instants past the end: where the cycle closes, its pieces must overlap, not just meet.
    let frames: Vec<Instant> = (0..=instants + policy::CARVE_SURROUND)
        .into_par_iter()
        .map(|k| rolling.at(arc * k as f64 / instants as f64))
        .collect();
    control.check()?;
    let carved = carve_at(&frames, tool, blank, depth, only_inside, control);
    control.check()?;
    Ok(carved)
}

/// The same at given instants, in order; neighbours must be close. What comes of work that was cancelled has no meaning.
pub(crate) fn carve_at(
    frames: &[Instant],
    tool: &[Point],
    blank: &[Point],
    depth: f64,
    only_inside: bool,
    control: &Control,
) -> Option<Carved> {
    let tool = Tool::new(tool, depth);
    let index = RadialIndex::new(blank);
    let active: Vec<Vec<usize>> = frames
        .par_windows(2)
        .with_min_len(16)
        .map(|pair| {
            if control.is_cancelled() {
                return Vec::new();
            }
            tool.active(&pair[0], &pair[1], &index, only_inside)
        })
        .collect();
    let found = active.iter().any(|corners| !corners.is_empty());
    let active = if only_inside { surrounded(&active, tool.points.len()) } else { active };
    let mut pieces: Vec<Vec<Point>> = frames
        .par_windows(2)
        .zip(&active)
        .with_min_len(16)
        .flat_map_iter(|(pair, corners)| tool.envelope(&pair[0], &pair[1], corners))
        .collect();
    if !only_inside {
        // The inside of the tool, a little smaller, at some of the instants: what the thin pieces of
        // envelope separate must not hang on to the gear by a gap between two of them.
        let core =
            geometry::largest(geometry::offset(tool.points, -0.5 * depth, policy::BODY_CHORD))
                .and_then(|face| face.into_iter().next())
                .map(|ring| simplify(&ring, 0.25 * depth));
        if let Some(core) = core {
            pieces.par_extend(
                frames
                    .par_iter()
                    .step_by(policy::CARVE_CORE_STRIDE)
                    .map(|at| core.iter().map(|&p| path(p, at)).collect::<Vec<_>>()),
            );
        }
    }
    if only_inside && found && !closes(frames) {
        // What is swept ends with the tool's own outline at the first and the last instant.
        for at in frames.first().into_iter().chain(frames.last()) {
            pieces.push(tool.points.iter().map(|&p| path(p, at)).collect());
        }
    }
    if pieces.is_empty() {
        return Some(Carved { outline: blank.to_vec(), cuts: 0 });
    }
    // Unions of neighbouring pieces first: they overlap one another and little else.
    let chunk = pieces.len().div_ceil(policy::CARVE_CHUNKS).max(1);
    let merged: Vec<Vec<Point>> = pieces
        .par_chunks(chunk)
        .filter(|_| !control.is_cancelled())
        .flat_map_iter(|part| geometry::union(part).into_iter().flatten())
        .collect();
    control.check().ok()?;
    let left = geometry::difference(blank, &merged);
    let outline = left
        .into_iter()
        .filter_map(|face| face.into_iter().next())
        .find(|ring| geometry::contains(ring, Point::origin()))?;
    Some(Carved { outline, cuts: pieces.len() })
}

/// Whether the instants run through a whole cycle of both gears.
fn closes(frames: &[Instant]) -> bool {
    let (Some(first), Some(last)) = (frames.first(), frames.last()) else { return true };
    last.s > first.s
}

struct Tool<'a> {
    points: &'a [Point],
    tangents: Vec<Vector>,
    /// Each corner moved into the tool.
    inner: Vec<Point>,
    convex: Vec<bool>,
    /// Circles around [`policy::CARVE_BLOCK`] corners each.
    blocks: Vec<(Point, f64)>,
}

impl<'a> Tool<'a> {
    fn new(points: &'a [Point], depth: f64) -> Self {
        let n = points.len();
        let tangents: Vec<Vector> =
            (0..n).map(|i| (points[(i + 1) % n] - points[i]).normalize()).collect();
        let before = |i: usize| tangents[(i + n - 1) % n];
        let inner = (0..n)
            .map(|i| {
                let inward = quarter_turn(before(i)) + quarter_turn(tangents[i]);
                points[i] + depth * inward.try_normalize(1e-12).unwrap_or(quarter_turn(tangents[i]))
            })
            .collect();
        let convex = (0..n).map(|i| cross(before(i), tangents[i]) > 0.0).collect();
        let blocks = points
            .chunks(policy::CARVE_BLOCK)
            .map(|block| {
                let (low, high) = geometry::bounds(block);
                (nalgebra::center(&low, &high), 0.5 * (high - low).norm())
            })
            .collect();
        Self { points, tangents, inner, convex, blocks }
    }

    /// Which edges, or the corners at their starts, may be on the envelope between two neighbouring instants.
    fn active(
        &self,
        from: &Instant,
        to: &Instant,
        blank: &RadialIndex<'_>,
        only_inside: bool,
    ) -> Vec<usize> {
        let n = self.points.len();
        let motion = Motion::new(from, to);
        let reached = self
            .blocks
            .iter()
            .enumerate()
            .filter(|(_, (center, radius))| blank.may_be_near(path(*center, from), *radius));
        let corners = reached.flat_map(|(b, _)| {
            let first = b * policy::CARVE_BLOCK;
            first..n.min(first + policy::CARVE_BLOCK)
        });
        corners
            .filter(|&i| {
                let (corner, edge) = self.kinds(i, &motion);
                if !(corner || edge) {
                    return false;
                }
                let (p0, n0) = (path(self.points[i], from), path(self.points[(i + 1) % n], from));
                if !only_inside {
                    return blank.near(p0);
                }
                let along = |t: f64| p0 + t * (n0 - p0);
                let probes =
                    [p0, n0, along(0.25), along(0.5), along(0.75), path(self.points[i], to)];
                blank.near(p0) && probes.iter().any(|&q| blank.contains(q))
            })
            .collect()
    }

    /// Whether the corner at the start of edge `i`, and the edge itself, are on the envelope.
    fn kinds(&self, i: usize, motion: &Motion) -> (bool, bool) {
        let n = self.points.len();
        let (p, t) = (self.points[i], self.tangents[i]);
        let here = motion.outward(p, t);
        let there = motion.outward(self.points[(i + 1) % n], t);
        let last = motion.outward(p, self.tangents[(i + n - 1) % n]);
        let differs = |a: [bool; 2], b: [bool; 2]| {
            a[0] != b[0] || a[1] != b[1] || a[0] != a[1] || b[0] != b[1]
        };
        (self.convex[i] && differs(here, last), differs(here, there))
    }

    /// The envelope pieces of the given edges and their corners between two neighbouring instants, in
    /// the follower's frame.
    fn envelope(&self, from: &Instant, to: &Instant, corners: &[usize]) -> Vec<Vec<Point>> {
        let n = self.points.len();
        let motion = Motion::new(from, to);
        let mut pieces = Vec::new();
        let mut push = |quad: [Point; 4]| {
            let mut quad = quad.to_vec();
            if geometry::signed_area(&quad) < 0.0 {
                quad.reverse();
            }
            pieces.push(quad);
        };
        for &i in corners {
            let (corner, edge) = self.kinds(i, &motion);
            let next = (i + 1) % n;
            let [p0, p1] = [from, to].map(|at| path(self.points[i], at));
            let [q0, q1] = [from, to].map(|at| path(self.inner[i], at));
            if corner {
                push([p0, p1, q1, q0]);
            }
            if edge {
                let [n0, n1] = [from, to].map(|at| path(self.points[next], at));
                let [m0, m1] = [from, to].map(|at| path(self.inner[next], at));
                push([p0, n0, m0, q0]);
                push([p1, n1, m1, q1]);
            }
        }
        pieces
    }
}

/// A point of the driver's frame in the follower's.
fn path(p: Point, at: &Instant) -> Point {
    at.to_local(Side::Follower, at.to_world(Side::Driver, p))
}

/// The pitch point in the driver's frame at two neighbouring instants.
struct Motion([Point; 2]);

impl Motion {
    fn new(from: &Instant, to: &Instant) -> Self {
        Self([from, to].map(|i| i.to_local(Side::Driver, i.pitch)))
    }

    /// Whether point `p` of an edge with tangent `t` moves outward, at both instants.
    fn outward(&self, p: Point, t: Vector) -> [bool; 2] {
        self.0.map(|pitch| (p - pitch).dot(&t) < 0.0)
    }
}

/// Each corner together with its neighbours along the tool and in time.
fn surrounded(active: &[Vec<usize>], corners: usize) -> Vec<Vec<usize>> {
    let reach = policy::CARVE_SURROUND;
    (0..active.len())
        .into_par_iter()
        .map(|k| {
            let times = k.saturating_sub(reach)..active.len().min(k + reach + 1);
            let mut found: Vec<usize> = active[times]
                .iter()
                .flatten()
                .flat_map(|&i| (0..=2 * reach).map(move |d| (i + corners + d - reach) % corners))
                .collect();
            found.sort_unstable();
            found.dedup();
            found
        })
        .collect()
}

/// Edges of a polygon about the origin by polar angle, to ask what is inside.
struct RadialIndex<'a> {
    points: &'a [Point],
    bins: Vec<Vec<u32>>,
    farthest: Vec<f64>,
    /// Greatest radius in each coarse sector and those to either side, and of all.
    sectors: Vec<f64>,
    widest: f64,
}

impl<'a> RadialIndex<'a> {
    fn new(points: &'a [Point]) -> Self {
        let n = points.len();
        let count = n.clamp(16, 4096);
        let mut bins = vec![Vec::new(); count];
        let mut farthest = vec![0.0_f64; count];
        let width = std::f64::consts::TAU / count as f64;
        for i in 0..n {
            let (a, b) = (points[i], points[(i + 1) % n]);
            let from = a.y.atan2(a.x);
            let turn = cross(a.coords, b.coords).atan2(a.coords.dot(&b.coords));
            let (low, high) = (from.min(from + turn), from.max(from + turn));
            let (first, last) = ((low / width).floor() as i64, (high / width).floor() as i64);
            for bin in first..=last {
                let bin = bin.rem_euclid(count as i64) as usize;
                bins[bin].push(i as u32);
                farthest[bin] = farthest[bin].max(a.coords.norm()).max(b.coords.norm());
            }
        }
        let coarse = policy::CARVE_SECTORS;
        let mut greatest = vec![0.0_f64; coarse];
        for bin in 0..count {
            // As far as `near` may look from this bin, for each sector that it overlaps.
            let r = [count - 1, 0, 1].map(|d| farthest[(bin + d) % count]);
            let r = r.into_iter().fold(0.0, f64::max);
            for sector in bin * coarse / count..=(bin + 1) * coarse / count {
                let sector = &mut greatest[sector % coarse];
                *sector = sector.max(r);
            }
        }
        let around = |i: usize| [coarse - 1, 0, 1].map(|d| (i + d) % coarse);
        let sectors: Vec<f64> = (0..coarse)
            .map(|i| around(i).into_iter().map(|j| greatest[j]).fold(0.0, f64::max))
            .collect();
        let widest = farthest.iter().copied().fold(0.0, f64::max);
        Self { points, bins, farthest, sectors, widest }
    }

    fn bin(&self, p: Point) -> usize {
        let width = std::f64::consts::TAU / self.bins.len() as f64;
        ((p.y.atan2(p.x) / width).floor() as i64).rem_euclid(self.bins.len() as i64) as usize
    }

    /// False only when [`Self::near`] is false for all points within `radius` of `center`.
    fn may_be_near(&self, center: Point, radius: f64) -> bool {
        let distance = center.coords.norm();
        let nearest = distance - radius;
        if nearest > self.widest {
            return false;
        }
        // The sectors are good for a block that spans no more than one to either side.
        let count = self.sectors.len();
        let width = std::f64::consts::TAU / count as f64;
        if radius >= distance * width.sin() {
            return true;
        }
        let sector = (center.y.atan2(center.x) / width).floor() as i64;
        nearest <= self.sectors[sector.rem_euclid(count as i64) as usize]
    }

    /// Whether `p` lies within the farthest edge of its bin or of a neighbouring one.
    fn near(&self, p: Point) -> bool {
        let (bin, count) = (self.bin(p), self.bins.len());
        let r = p.coords.norm();
        [count - 1, 0, 1].iter().any(|d| r <= self.farthest[(bin + d) % count])
    }

    /// Whether `p` lies inside: an odd number of edges crosses the ray from it away from the origin.
    fn contains(&self, p: Point) -> bool {
        let n = self.points.len();
        let crossings = self.bins[self.bin(p)]
            .iter()
            .filter(|&&i| {
                let (a, b) = (self.points[i as usize], self.points[(i as usize + 1) % n]);
                let (ca, cb) = (cross(p.coords, a.coords), cross(p.coords, b.coords));
                if (ca > 0.0) == (cb > 0.0) || a.coords.dot(&p.coords) < 0.0 {
                    return false;
                }
                let hit = a + (b - a) * (ca / (ca - cb));
                hit.coords.norm_squared() > p.coords.norm_squared()
            })
            .count();
        crossings % 2 == 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn a_block_is_left_out_only_when_none_of_its_points_is_near() {
        for (samples, lobes) in [(40, 3.0), (700, 9.0), (5000, 31.0)] {
            let blank: Vec<Point> = (0..samples)
                .map(|i| TAU * f64::from(i) / f64::from(samples))
                .map(|t| geometry::rotate(Point::new(30.0 + 12.0 * (lobes * t).sin(), 0.0), t))
                .collect();
            let index = RadialIndex::new(&blank);
            let mut left_out = 0;
            for i in 0..4000 {
                let share = f64::from(i) / 4000.0;
                let center =
                    geometry::rotate(Point::new(10.0 + 40.0 * share, 0.0), TAU * (97.0 * share));
                let radius = 4.0 * (share * 61.0).fract();
                if index.may_be_near(center, radius) {
                    continue;
                }
                left_out += 1;
                for k in 0..60 {
                    let turn = TAU * f64::from(k) / 12.0;
                    let far = radius * (1.0 - f64::from(k / 12) / 5.0);
                    let p = center + Vector::new(far * turn.cos(), far * turn.sin());
                    assert!(!index.near(p), "{samples} {center} {radius} {p}");
                }
            }
            assert!(left_out > 400, "{samples}: {left_out}");
        }
    }
}
