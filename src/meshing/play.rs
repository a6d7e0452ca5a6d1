//! Free play of the follower at one pose: every point of either gear that is
//! near the other is turned about the follower's axis until it touches.
//!
//! Between two vertices the angular gap of two straight edges, seen as a
//! function of the radius about the follower's axis, has no extremum of its
//! own, so points of both outlines against edges of the other give the
//! play of the polygons exactly.

use super::index::{Crossing, EdgeIndex};
use crate::geometry::{Point, Vector, bounds, quarter_turn};
use crate::policy;

/// One gear made ready for many poses.
#[derive(Debug)]
pub(super) struct Body {
    index: EdgeIndex,
    probes: Vec<Point>,
    blocks: Vec<Block>,
    /// Consecutive blocks, with `first` and `last` counting blocks.
    groups: Vec<Block>,
}

/// Consecutive probes (or blocks of them) and a circle around them.
#[derive(Debug)]
struct Block {
    center: Point,
    radius: f64,
    first: usize,
    last: usize,
}

impl Body {
    /// `spacing` is the longest stretch without a probe, mm.
    pub(super) fn new(outline: &[Point], spacing: f64) -> Self {
        let mut probes = Vec::with_capacity(outline.len());
        for (a, b) in outline.iter().zip(outline.iter().cycle().skip(1)) {
            let pieces = ((b - a).norm() / spacing).ceil().max(1.0);
            probes.extend((0..pieces as usize).map(|i| a + (b - a) * (i as f64 / pieces)));
        }
        let blocks: Vec<Block> = blocks_of(&probes, policy::CONTACT_BLOCK).collect();
        let in_group = policy::CONTACT_GROUP;
        let groups = blocks_of(&probes, policy::CONTACT_BLOCK * in_group)
            .enumerate()
            .map(|(i, group)| Block {
                first: i * in_group,
                last: blocks.len().min((i + 1) * in_group),
                ..group
            })
            .collect();
        Self { index: EdgeIndex::new(outline.to_vec()), probes, blocks, groups }
    }
}

fn blocks_of(probes: &[Point], size: usize) -> impl Iterator<Item = Block> {
    probes.chunks(size).enumerate().map(move |(i, chunk)| {
        let (low, high) = bounds(chunk);
        Block {
            center: nalgebra::center(&low, &high),
            radius: 0.5 * (high - low).norm(),
            first: i * size,
            last: i * size + chunk.len(),
        }
    })
}

/// A block that may matter at one pose.
struct Close<'a> {
    block: &'a Block,
    /// Square of its distance from the pitch point.
    from_pitch_point: f64,
    /// Greatest distance of its points from the axis they turn about.
    arm: f64,
    /// What the other gear's boundary certainly keeps from all of its points; negative when its
    /// points may be on either side of the boundary or lie inside the other gear.
    clear: f64,
}

/// A rotation followed by a shift.
#[derive(Clone, Copy, Debug)]
struct Placement {
    sin: f64,
    cos: f64,
    shift: Vector,
}

impl Placement {
    fn new(angle: f64, shift: Vector) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { sin, cos, shift }
    }

    fn turn(&self, v: Vector) -> Vector {
        Vector::new(self.cos * v.x - self.sin * v.y, self.sin * v.x + self.cos * v.y)
    }

    fn place(&self, p: Point) -> Point {
        Point::from(self.turn(p.coords) + self.shift)
    }
}

/// The designed pose and how far to look from it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose {
    pub(super) driver_angle: f64,
    /// phi_F = psi, clockwise.
    pub(super) follower_angle: f64,
    pub(super) center_distance: f64,
    /// Largest turn of the follower that is searched, radians.
    pub(super) max_play: f64,
    /// Contacts this much further (radians) than the first are gathered as well.
    pub(super) slack: f64,
    /// Interference deeper than this (mm) need not be measured further.
    pub(super) deep: f64,
    /// World position of the pitch point.
    pub(super) pitch_point: Point,
}

/// A place where the gears meet once the follower has turned behind by `turn`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    /// Turn of the follower behind, radians, until this place touches (negative: ahead).
    pub(super) turn: f64,
    /// World position when it touches.
    pub(super) point: Point,
    /// World direction, from the driver into the follower, unit length.
    pub(super) normal: Vector,
}

/// What was found at one pose.
#[derive(Clone, Debug)]
pub(super) struct Play {
    /// Turn behind until contact, radians; `None` when none within reach.
    pub(super) behind: Option<f64>,
    /// Turn ahead until contact, radians; `None` when none within reach.
    pub(super) ahead: Option<f64>,
    /// Depth to which a point of one gear is inside the other at the designed pose, mm.
    pub(super) depth: f64,
    /// Touches behind, within the slack of the first; not sorted.
    pub(super) touches: Vec<Touch>,
}

/// Which gear the turning probes belong to.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Probing {
    Driver,
    Follower,
}

/// A point inside the other gear, and where it could leave on either side.
struct Inside {
    ways: [Option<Crossing>; 2],
    p: Point,
    probing: Probing,
}

impl Inside {
    /// The shorter of the two turns that free the point.
    fn shorter(&self) -> f64 {
        self.ways.iter().flatten().map(|c| c.angle.abs()).fold(f64::INFINITY, f64::min)
    }
}

struct Search<'a> {
    pose: &'a Pose,
    play: Play,
    inside: Vec<Inside>,
}

/// Finds the free play at one pose.
pub(super) fn free_play(driver: &Body, follower: &Body, pose: &Pose) -> Play {
    let between = Vector::new(pose.center_distance, 0.0);
    let sum = pose.driver_angle + pose.follower_angle;
    let into_follower =
        Placement::new(sum, -Placement::new(pose.follower_angle, Vector::zeros()).turn(between));
    let axis = Placement::new(-pose.driver_angle, Vector::zeros()).turn(between);
    let into_driver = Placement::new(-sum, axis);
    let play = Play { behind: None, ahead: None, depth: 0.0, touches: Vec::new() };
    let mut search = Search { pose, play, inside: Vec::new() };
    let in_follower =
        Placement::new(pose.follower_angle, Vector::zeros()).place(pose.pitch_point - between);
    let in_driver = Placement::new(-pose.driver_angle, Vector::zeros()).place(pose.pitch_point);
    search.probe(driver, follower, &into_follower, Point::origin(), in_follower, Probing::Driver);
    search.probe(follower, driver, &into_driver, Point::from(axis), in_driver, Probing::Follower);
    search.settle(driver, follower);
    search.play
}

impl Search<'_> {
    /// Turns the probes of `body` about `axis` against the edges of `other`, in its frame.
    fn probe(
        &mut self,
        body: &Body,
        other: &Body,
        placement: &Placement,
        axis: Point,
        near: Point,
        probing: Probing,
    ) {
        let mut close: Vec<Close<'_>> = Vec::new();
        let max_play = self.pose.max_play;
        let closeness = |block| {
            let close = close_up(block, placement, axis, near, other);
            (close.clear <= close.arm * max_play).then_some(close)
        };
        for group in &body.groups {
            if closeness(group).is_some() {
                close.extend(body.blocks[group.first..group.last].iter().filter_map(closeness));
            }
        }
        // The closest first: a short play found early shortens every later search.
        close.sort_by(|a, b| a.from_pitch_point.total_cmp(&b.from_pitch_point));
        for close in close {
            if self.play.depth > self.pose.deep {
                return;
            }
            let (behind, ahead) = self.limits();
            if close.clear > close.arm * behind.max(ahead) {
                continue;
            }
            for &p in &body.probes[close.block.first..close.block.last] {
                self.probe_point(placement.place(p), axis, &other.index, probing);
            }
        }
    }

    /// Turns behind and ahead of which nothing more needs to be known, radians.
    fn limits(&self) -> (f64, f64) {
        let max = self.pose.max_play;
        let behind = self.play.behind.map_or(max, |b| b + self.pose.slack).clamp(0.0, max);
        (behind, self.play.ahead.unwrap_or(max).clamp(0.0, max))
    }

    fn probe_point(&mut self, p: Point, axis: Point, index: &EdgeIndex, probing: Probing) {
        let (behind, ahead) = self.limits();
        // A driver point ahead of which the follower must turn lies clockwise of its material.
        let (plus, minus) =
            if probing == Probing::Driver { (ahead, behind) } else { (behind, ahead) };
        let widest = plus.max(minus) * (p - axis).norm();
        let (next, last) = if index.clear_distance(p) > widest {
            (None, None)
        } else {
            (index.first_crossing(p, axis, 1.0, plus), index.first_crossing(p, axis, -1.0, minus))
        };
        let is_inside = match (next, last) {
            (Some(next), _) => !next.entering,
            (None, Some(last)) => last.entering,
            (None, None) => index.inside(p),
        };
        if is_inside {
            self.interfere(p, axis, index, probing);
            return;
        }
        for crossing in [next, last].into_iter().flatten() {
            self.note(&crossing, p, index, probing);
        }
    }

    /// Takes note of a point inside the other gear; [`Self::settle`] decides how it gets out.
    fn interfere(&mut self, p: Point, axis: Point, index: &EdgeIndex, probing: Probing) {
        let depth = index.distance(p, self.play.depth);
        self.play.depth = self.play.depth.max(depth);
        let max = self.pose.max_play;
        let ways = [1.0, -1.0].map(|direction| index.first_crossing(p, axis, direction, max));
        self.inside.push(Inside { ways, p, probing });
    }

    /// Frees the points that are inside the other gear, the deepest first, each by the turn that
    /// adds least to what the points before it asked for: a point near a tooth's tip could also
    /// leave over the tip, but follows its flank.
    fn settle(&mut self, driver: &Body, follower: &Body) {
        let max = self.pose.max_play;
        let mut inside = std::mem::take(&mut self.inside);
        inside.sort_by(|a, b| b.shorter().total_cmp(&a.shorter()));
        let (mut behind, mut ahead) = (0.0_f64, 0.0_f64);
        for point in &inside {
            let extra = |crossing: &&Crossing| {
                let asked = if is_ahead(crossing, point.probing) { ahead } else { behind };
                (crossing.angle.abs() - asked).max(0.0)
            };
            let ways = point.ways.iter().flatten();
            let Some(way) = ways.min_by(|a, b| extra(a).total_cmp(&extra(b))) else {
                self.play.behind = Some(-max);
                self.play.ahead = Some(-max);
                return;
            };
            let asked = if is_ahead(way, point.probing) { &mut ahead } else { &mut behind };
            *asked = asked.max(way.angle.abs());
            let body = if point.probing == Probing::Driver { follower } else { driver };
            self.note(way, point.p, &body.index, point.probing);
        }
    }

    /// Takes one meeting of a point and an edge into account.
    fn note(&mut self, crossing: &Crossing, p: Point, index: &EdgeIndex, probing: Probing) {
        let turn = if crossing.entering { crossing.angle } else { -crossing.angle };
        if is_ahead(crossing, probing) {
            self.play.ahead = Some(self.play.ahead.map_or(turn, |best| best.min(turn)));
            return;
        }
        let first = self.play.behind.map_or(turn, |best| best.min(turn));
        self.play.behind = Some(first);
        if turn <= first + self.pose.slack {
            let touch = self.touch(turn, crossing, p, index, probing);
            self.play.touches.push(touch);
        }
    }

    fn touch(
        &self,
        turn: f64,
        crossing: &Crossing,
        p: Point,
        index: &EdgeIndex,
        probing: Probing,
    ) -> Touch {
        let (a, b) = index.edge(crossing.edge);
        let outward = -quarter_turn(b - a).try_normalize(0.0).unwrap_or_else(Vector::zeros);
        let pose = self.pose;
        let (point, normal) = match probing {
            // The point is the driver's and stays; the edge is the follower's and has turned.
            Probing::Driver => {
                let designed =
                    Placement::new(-pose.follower_angle, Vector::new(pose.center_distance, 0.0));
                let rest = Placement::new(turn - pose.follower_angle, Vector::zeros());
                (designed.place(p), -rest.turn(outward))
            }
            Probing::Follower => {
                let driver = Placement::new(pose.driver_angle, Vector::zeros());
                (driver.place(crossing.at), driver.turn(outward))
            }
        };
        Touch { turn, point, normal }
    }
}

/// Where a block lies at this pose; lengths in mm.
fn close_up<'a>(
    block: &'a Block,
    placement: &Placement,
    axis: Point,
    near: Point,
    other: &Body,
) -> Close<'a> {
    let center = placement.place(block.center);
    let clear = other.index.clear_distance(center) - block.radius;
    Close {
        block,
        from_pitch_point: (center - near).norm_squared(),
        arm: (center - axis).norm() + block.radius,
        clear: if other.index.inside(center) { f64::NEG_INFINITY } else { clear },
    }
}

/// Whether a crossing bounds the follower's turn ahead (else behind). Seen from a driver point,
/// follower material that begins at a greater angle is met when the follower turns ahead
/// (clockwise); seen from a follower point it is the other way round.
fn is_ahead(crossing: &Crossing, probing: Probing) -> bool {
    crossing.entering == (probing == Probing::Driver)
}
