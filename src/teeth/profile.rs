//! The toothed outline of one gear, put together from flanks, tips and roots.

use rayon::prelude::*;

use super::flank::Flank;
use super::layout::{Layout, Rack};
use super::motions::Motions;
use super::root::{cap, root_curve};
use crate::gear::Side;
use crate::geometry::{Point, rotate};
use crate::policy;

/// What an edge of a gear's outline is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum EdgeKind {
    /// Transmits motion.
    Flank,
    /// Top land of a tooth.
    Tip,
    /// Root and fillet between two teeth.
    Root,
}

/// A closed outline whose edges are labelled: `kinds[i]` belongs to the edge from point `i` to the next.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Counter-clockwise points in the gear's frame, mm; no repeated last point.
    pub points: Vec<Point>,
    /// One label per edge.
    pub kinds: Vec<EdgeKind>,
}

/// The outline of one gear. `folds` periods make the whole gear; `backlash` (mm,
/// along the pitch curve) is shared equally by the four flanks that meet in it; flank chords keep
/// within `tolerance` mm.
pub(crate) fn gear_profile(
    motions: &Motions,
    layout: &Layout,
    rack: &Rack,
    side: Side,
    folds: u32,
    backlash: f64,
    tolerance: f64,
) -> Profile {
    let teeth = layout.teeth(side);
    let spaces = spaces_after(&teeth, layout);
    let pieces: Vec<Vec<(Point, EdgeKind)>> = teeth
        .par_iter()
        .zip(&spaces)
        .map(|(tooth, space)| {
            let mut piece = Vec::new();
            let [a, b] = tooth;
            let full = |flank: &Flank| {
                (side.sign() * flank.reach(side), -side.sign() * flank.reach(side.partner()))
            };
            let [a, b] = [a, b].map(|f| f.thinned(side, backlash));
            let (tip, bottom) = full(&a);
            let rising = a.sample(motions.of(a.sigma), side, (bottom, tip), tolerance);
            let (tip, bottom) = full(&b);
            let falling = b.sample(motions.of(b.sigma), side, (tip, bottom), tolerance);
            let land = cap(motions, &[a, b], side, 0.0, 0.0, 1);
            let interior = |line: Vec<Point>| {
                let count = line.len();
                line.into_iter().skip(1).take(count.saturating_sub(2))
            };
            piece.extend(rising.into_iter().map(|p| (p, EdgeKind::Flank)));
            if let Some(last) = piece.last_mut() {
                last.1 = EdgeKind::Tip;
            }
            piece.extend(interior(land).map(|p| (p, EdgeKind::Tip)));
            piece.extend(falling.into_iter().map(|p| (p, EdgeKind::Flank)));
            if let Some(last) = piece.last_mut() {
                last.1 = EdgeKind::Root;
            }
            piece.extend(
                root_curve(motions, rack, space, side, backlash)
                    .into_iter()
                    .map(|p| (p, EdgeKind::Root)),
            );
            piece
        })
        .collect();
    let (period, direction) = match side {
        Side::Driver => (std::f64::consts::TAU / f64::from(folds), -1.0),
        Side::Follower => (std::f64::consts::TAU / f64::from(folds), 1.0),
    };
    let one: Vec<(Point, EdgeKind)> = pieces.into_iter().flatten().collect();
    let (mut points, mut kinds) = (Vec::new(), Vec::new());
    for fold in 0..folds {
        let turn = direction * period * f64::from(fold);
        points.extend(one.iter().map(|(p, _)| if fold == 0 { *p } else { rotate(*p, turn) }));
        kinds.extend(one.iter().map(|(_, kind)| *kind));
    }
    if side == Side::Driver {
        // The driver's arc length runs clockwise.
        points.reverse();
        kinds.reverse();
        kinds.rotate_left(1);
    }
    Profile { points, kinds }.without_short_edges(policy::SHORTEST_EDGE * rack.module)
}

fn spaces_after(teeth: &[[Flank; 2]], layout: &Layout) -> Vec<[Flank; 2]> {
    (0..teeth.len())
        .map(|j| {
            let next = teeth.get(j + 1).map_or_else(|| layout.later(teeth[0][0]), |next| next[0]);
            [teeth[j][1], next]
        })
        .collect()
}

impl Profile {
    /// The profile made of `folds` exact copies of its first part: carving repeats only to rounding. The part
    /// runs from a tip point to that point's image, which must be there within `tolerance` mm; a profile
    /// without such a point comes back as it is.
    #[must_use]
    pub fn repeated(self, folds: u32, tolerance: f64) -> Self {
        if folds < 2 {
            return self;
        }
        let turn = std::f64::consts::TAU / f64::from(folds);
        let n = self.points.len();
        let image = |i: usize| {
            let p = rotate(self.points[i], turn);
            (0..n).find(|&j| (self.points[j] - p).norm() < tolerance)
        };
        let start = (0..n)
            .filter(|&i| self.kinds[i] == EdgeKind::Tip)
            .find_map(|i| image(i).map(|end| (i, (end + n - i) % n)));
        let Some((start, count)) = start else { return self };
        let part = (0..count).map(|k| (start + k) % n);
        let (mut points, mut kinds) = (Vec::new(), Vec::new());
        for fold in 0..folds {
            let angle = turn * f64::from(fold);
            points.extend(part.clone().map(|i| rotate(self.points[i], angle)));
            kinds.extend(part.clone().map(|i| self.kinds[i]));
        }
        Self { points, kinds }
    }

    /// Drops points that lie closer than `shortest` to the one before.
    #[must_use]
    pub fn without_short_edges(self, shortest: f64) -> Self {
        let mut points: Vec<Point> = Vec::with_capacity(self.points.len());
        let mut kinds = Vec::with_capacity(self.kinds.len());
        for (p, kind) in self.points.into_iter().zip(self.kinds) {
            if points.last().is_none_or(|q| (p - q).norm() >= shortest) {
                points.push(p);
                kinds.push(kind);
            }
        }
        while points.len() > 3 && (points[0] - points[points.len() - 1]).norm() < shortest {
            points.pop();
            kinds.pop();
        }
        Self { points, kinds }
    }
}
