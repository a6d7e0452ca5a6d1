//! The smooth curves that a sampled outline stands for: corners, lines, arcs and cubic splines.
//!
//! Vertices of an outline lie on its true curve; its chords cut corners by up to their bow. A traced curve
//! passes every vertex within the tolerance (folds without width excepted) and strays from the middle of a chord by no more than twice the
//! tolerance and twice the bow.

mod arc;
mod band;
mod biarc;
mod cubic;
mod path;
mod samples;
#[cfg(test)]
mod tests;

pub use arc::Arc;
pub use cubic::CubicPath;
pub use path::ArcPath;

use super::{Point, centroid, signed_area};
use crate::policy;
use samples::{Samples, turn};

/// Places on each arc and cubic span where a trace is tested for crossings.
const SHARES: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

/// How closely and how an outline is traced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TraceOptions {
    /// Greatest distance between a vertex and the curve, in the unit of the outline (mm).
    pub tolerance: f64,
    /// Edges much longer than their neighbours are straight by intent, as in a drawn hole; otherwise they
    /// are chords of a curve that was sampled coarsely there.
    pub straight_edges: bool,
}

impl Default for TraceOptions {
    fn default() -> Self {
        Self { tolerance: policy::EXPORT_TOLERANCE, straight_edges: false }
    }
}

/// Why an outline has no traced curve.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum TraceError {
    /// The tolerance is zero, negative, not a number, or finer than the files can hold.
    #[error(
        "a tolerance of {tolerance:e} mm cannot be kept; give at least {} mm",
        policy::LEAST_EXPORT_TOLERANCE
    )]
    Tolerance {
        /// What was asked.
        tolerance: f64,
    },
    /// The outline has no area or a point that is no number.
    #[error("the outline encloses no area; repair it before tracing it")]
    Empty,
    /// The curve strays too far from the outline.
    #[error(
        "the curve passes a vertex at {found:.5} mm instead of {tolerance:.5} mm near ({:.3}, {:.3}); use straight segments or a larger tolerance",
        at.x, at.y
    )]
    TooFar {
        /// Greatest distance found.
        found: f64,
        /// The tolerance.
        tolerance: f64,
        /// Where.
        at: Point,
    },
    /// The curve crosses itself.
    #[error(
        "the curve crosses itself near ({:.3}, {:.3}) mm; use a smaller tolerance or straight segments",
        at.x, at.y
    )]
    Crossing {
        /// Where.
        at: Point,
    },
}

/// What a smooth stretch between two corners is.
#[derive(Clone, Debug, PartialEq)]
pub enum Stretch {
    /// A straight line.
    Line(Arc),
    /// One circular arc of less than half a turn.
    Arc(Arc),
    /// A smooth curve.
    Cubic(CubicPath),
}

impl Stretch {
    /// Where it starts.
    #[must_use]
    pub fn from(&self) -> Point {
        match self {
            Self::Line(arc) | Self::Arc(arc) => arc.from,
            Self::Cubic(path) => path.points[0],
        }
    }

    /// Twice the area swept from the origin, exact.
    #[must_use]
    pub fn doubled_area(&self) -> f64 {
        match self {
            Self::Line(arc) | Self::Arc(arc) => {
                super::cross(arc.from.coords, arc.to.coords) + 2.0 * arc.segment_area()
            }
            Self::Cubic(path) => path.doubled_area(),
        }
    }
}

/// A closed outline as smooth stretches, each ending exactly where the next starts.
#[derive(Clone, Debug)]
pub struct Trace {
    stretches: Vec<Stretch>,
    samples: Vec<Samples>,
    tolerance: f64,
}

impl Trace {
    /// Traces a closed outline (no repeated last point) with curves that use up half the tolerance; the
    /// rest is left to [`Trace::arcs`].
    ///
    /// # Errors
    /// [`TraceError`].
    pub fn new(points: &[Point], options: TraceOptions) -> Result<Self, TraceError> {
        let tolerance = options.tolerance;
        if !(tolerance >= policy::LEAST_EXPORT_TOLERANCE && tolerance.is_finite()) {
            return Err(TraceError::Tolerance { tolerance });
        }
        if points.len() < 3
            || !points.iter().all(|p| p.x.is_finite() && p.y.is_finite())
            || signed_area(points) == 0.0
        {
            return Err(TraceError::Empty);
        }
        let points = without_specks(points, policy::CURVE_SHORTEST * tolerance);
        let points = without_barbs(points, tolerance);
        if points.len() < 3 {
            return Err(TraceError::Empty);
        }
        let fine = policy::CURVE_SHARE * tolerance;
        let mut waiting = split(&points, options.straight_edges);
        waiting.reverse();
        let (mut samples, mut stretches) = (Vec::new(), Vec::new());
        while let Some(run) = waiting.pop() {
            match stretch(&run, fine) {
                Ok(found) => {
                    samples.push(run);
                    stretches.push(found);
                }
                // No smooth curve: a corner after all. A run of two vertices is a line, so this ends.
                Err(k) => waiting.extend(run.parted(k).into_iter().rev()),
            }
        }
        let trace = Self { stretches, samples, tolerance };
        match super::first_self_crossing(&trace.flattened()) {
            Some(at) => Err(TraceError::Crossing { at }),
            None => Ok(trace),
        }
    }

    /// Points along the curve, a few on each arc and cubic span.
    fn flattened(&self) -> Vec<Point> {
        let mut points = Vec::new();
        for stretch in &self.stretches {
            match stretch {
                Stretch::Line(arc) => points.push(arc.from),
                Stretch::Arc(arc) => points.extend(SHARES.map(|t| arc.at(t))),
                Stretch::Cubic(path) => {
                    for k in path.knots.windows(2) {
                        points.extend(SHARES.map(|t| path.at(k[0] + t * (k[1] - k[0])).0));
                    }
                }
            }
        }
        points
    }

    /// The outline's own straight edges as a trace: no deviation at all.
    #[must_use]
    pub fn polygon(points: &[Point]) -> Self {
        let edge = |a: &Point, b: &Point| Samples::new(vec![*a, *b], false);
        let samples: Vec<Samples> =
            points.iter().zip(points.iter().cycle().skip(1)).map(|(a, b)| edge(a, b)).collect();
        let line = |s: &Samples| Stretch::Line(Arc::line(s.points[0], s.points[1]));
        let stretches = samples.iter().map(line).collect();
        Self { stretches, samples, tolerance: policy::EXPORT_TOLERANCE }
    }

    /// The stretches in the outline's order.
    #[must_use]
    pub fn stretches(&self) -> &[Stretch] {
        &self.stretches
    }

    /// Signed area inside the traced curve, exact.
    #[must_use]
    pub fn signed_area(&self) -> f64 {
        0.5 * self.stretches.iter().map(Stretch::doubled_area).sum::<f64>()
    }

    /// The outline as arcs and lines with continuous tangents except at corners.
    ///
    /// # Errors
    /// [`TraceError::TooFar`] or [`TraceError::Crossing`]: what comes back is measured against every vertex
    /// and chord and is simple.
    pub fn arcs(&self) -> Result<ArcPath, TraceError> {
        let mut arcs: Vec<Arc> = Vec::new();
        let mut path = ArcPath::default();
        for (stretch, samples) in self.stretches.iter().zip(&self.samples) {
            arcs.clear();
            match stretch {
                Stretch::Line(arc) | Stretch::Arc(arc) => arcs.push(*arc),
                Stretch::Cubic(cubic) => {
                    arcs.extend(biarc::arcs_along(cubic, samples, self.tolerance));
                }
            }
            path.append(&arcs, samples, self.tolerance)?;
        }
        path.check_simple()?;
        Ok(path)
    }
}

/// Radius of the round hole about its centre that a regular polygon was drawn round, or none: `(center,
/// radius)`, the radius that of the inscribed circle.
#[must_use]
pub fn round_hole(points: &[Point]) -> Option<(Point, f64)> {
    let n = points.len();
    if n < 12 {
        return None;
    }
    let center = centroid(points);
    let corner = (points[0] - center).norm();
    let side = (points[1] - points[0]).norm();
    let even = (0..n).all(|i| {
        let (p, q) = (points[i], points[(i + 1) % n]);
        ((p - center).norm() - corner).abs() <= policy::ROUND_HOLE_EVENNESS * corner
            && ((q - p).norm() - side).abs() <= policy::ROUND_HOLE_EVENNESS * corner
    });
    even.then(|| (center, corner * (std::f64::consts::PI / n as f64).cos()))
}

fn without_specks(points: &[Point], shortest: f64) -> Vec<Point> {
    let mut kept: Vec<Point> = Vec::with_capacity(points.len());
    for &p in points {
        if kept.last().is_none_or(|q| (p - q).norm() >= shortest) {
            kept.push(p);
        }
    }
    while kept.len() > 3 && (kept[0] - kept[kept.len() - 1]).norm() < shortest {
        kept.pop();
    }
    kept
}

/// Without vertices at which the outline turns back on itself within `width`.
pub(crate) fn without_barbs(mut points: Vec<Point>, width: f64) -> Vec<Point> {
    loop {
        let n = points.len();
        let barb = (0..n).find(|&i| {
            let (a, b, c) = (points[(i + n - 1) % n], points[i], points[(i + 1) % n]);
            let (near, far) = if (b - a).norm() < (c - b).norm() { (a, c) } else { (c, a) };
            turn(a, b, c).abs() > policy::BARB_TURN && Arc::line(b, far).distance(near) < width
        });
        match barb {
            Some(i) if n > 3 => points.remove(i),
            _ => return points,
        };
    }
}

/// The stretches between corners; one ring when there are none.
fn split(points: &[Point], straight_edges: bool) -> Vec<Samples> {
    let n = points.len();
    let point = |i: usize| points[i % n];
    let mut cut: Vec<bool> = (0..n)
        .map(|i| turn(point(i + n - 1), point(i), point(i + 1)).abs() > policy::CORNER_TURN)
        .collect();
    let length = |i: usize| (point(i + 1) - point(i)).norm();
    for i in 0..n {
        let [before, after] = [length(i + n - 1), length(i)];
        let most = policy::STRAIGHT_EDGE_RATIO * length(i + n - 1).max(length(i + 1));
        if straight_edges && after > most {
            cut[i] = true;
            cut[(i + 1) % n] = true;
        }
        // A curve through three vertices leaves the longer chord by nearly the whole turn. Sampled
        // curves have long chords where they hardly bend: this one is straight.
        let [short, long] = [before.min(after), before.max(after)];
        let leaves = turn(point(i + n - 1), point(i), point(i + 1)).abs() * long / (long + short);
        cut[i] |= long > policy::BEND_RATIO * short && leaves > policy::BEND_TURN;
    }
    let Some(first) = cut.iter().position(|&c| c) else {
        let ring = (0..=n).map(point).collect();
        return vec![Samples::new(ring, true)];
    };
    let mut all = Vec::new();
    let mut run = vec![point(first)];
    for i in first + 1..=first + n {
        run.push(point(i));
        if cut[i % n] {
            all.push(Samples::new(std::mem::replace(&mut run, vec![point(i)]), false));
        }
    }
    all
}

/// The simplest curve for the samples, or the vertex that must be a corner.
fn stretch(samples: &Samples, tolerance: f64) -> Result<Stretch, usize> {
    let points = &samples.points;
    let (from, to) = (points[0], points[points.len() - 1]);
    let keeps = |arc: &Arc| {
        points.iter().all(|&p| arc.distance(p) <= tolerance)
            && (0..points.len() - 1)
                .all(|k| arc.distance(samples.middle(k)) <= samples.allowance(k, 2.0 * tolerance))
    };
    if !samples.ring {
        let line = Arc::line(from, to);
        if keeps(&line) {
            return Ok(Stretch::Line(line));
        }
        // The arc through the ends and the vertex nearest the middle.
        let half = 0.5 * samples.walked[points.len() - 1];
        let k = samples.walked.partition_point(|&w| w < half).clamp(1, points.len() - 2);
        // The angle at a point of the arc is half a turn less half the arc's angle.
        let seen = turn(from, points[k], to);
        let arc = Arc { from, to, bulge: (0.5 * seen).tan() };
        if arc.bulge.abs() < 1.0 && keeps(&arc) {
            return Ok(Stretch::Arc(arc));
        }
    }
    cubic::fit(samples, tolerance).map(Stretch::Cubic)
}
