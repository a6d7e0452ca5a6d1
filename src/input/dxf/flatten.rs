//! Curves of entities as chords.

use super::entity::{Conic, Curve, Spline};
use super::map::Map;
use super::spline;
use crate::geometry::{Point, Vector, quarter_turn};
use crate::policy;
use std::f64::consts::TAU;

/// A curve mapped into the drawing.
pub(super) enum Piece {
    Chords {
        points: Vec<Point>,
        closed: bool,
    },
    /// Stretches of a polyline with arcs.
    Arcs {
        pieces: Vec<Conic>,
        ends: Vec<Point>,
        closed: bool,
    },
}

/// The pieces of a curve; `None` for a spline whose numbers do not belong together.
pub(super) fn piece(curve: &Curve, map: &Map) -> Option<Piece> {
    Some(match curve {
        Curve::Polyline { vertices, closed } => polyline(vertices, *closed, map),
        Curve::Conic(conic) => {
            let conic = mapped(conic, map);
            let ends = vec![at(&conic, 0.0), at(&conic, 1.0)];
            Piece::Arcs { pieces: vec![conic], ends, closed: conic.sweep >= TAU }
        }
        Curve::Spline(curve) => {
            let (points, closed) = of_spline(curve)?;
            Piece::Chords { points: points.into_iter().map(|p| map.point(p)).collect(), closed }
        }
        Curve::Insert(_) => return None,
    })
}

fn mapped(conic: &Conic, map: &Map) -> Conic {
    Conic {
        center: map.point(conic.center),
        u: map.vector(conic.u),
        v: map.vector(conic.v),
        ..*conic
    }
}

fn at(conic: &Conic, share: f64) -> Point {
    let (sine, cosine) = (conic.start + share * conic.sweep).sin_cos();
    conic.center + cosine * conic.u + sine * conic.v
}

fn polyline(vertices: &[(Point, f64)], closed: bool, map: &Map) -> Piece {
    if vertices.iter().all(|v| v.1.abs() < 1e-12) {
        let points = vertices.iter().map(|v| map.point(v.0)).collect();
        return Piece::Chords { points, closed };
    }
    let count = vertices.len();
    let last = if closed { count } else { count.saturating_sub(1) };
    let pieces = (0..last)
        .map(|i| mapped(&bulged(vertices[i].0, vertices[(i + 1) % count].0, vertices[i].1), map))
        .collect();
    let mut ends: Vec<Point> = vertices.iter().map(|v| map.point(v.0)).collect();
    if closed {
        ends.extend(ends.first().copied());
    }
    Piece::Arcs { pieces, ends, closed }
}

/// From `a` to `b`; a straight line has no sweep.
fn bulged(a: Point, b: Point, bulge: f64) -> Conic {
    let chord = b - a;
    if bulge.abs() < 1e-12 || chord.norm() == 0.0 {
        return Conic { center: a, u: Vector::zeros(), v: Vector::zeros(), start: 0.0, sweep: 0.0 };
    }
    let height = 0.25 * (1.0 / bulge - bulge);
    let center = nalgebra::center(&a, &b) + quarter_turn(chord) * height;
    let u = a - center;
    Conic { center, u, v: quarter_turn(u), start: 0.0, sweep: 4.0 * bulge.atan() }
}

impl Piece {
    /// Points that show how large the drawing is.
    pub(super) fn marks(&self) -> Vec<Point> {
        match self {
            Self::Chords { points, .. } => points.clone(),
            Self::Arcs { .. } => self.flattened(f64::INFINITY).0,
        }
    }

    /// The curve as chords within `tolerance`, its ends included, and whether it is closed.
    pub(super) fn flattened(&self, tolerance: f64) -> (Vec<Point>, bool) {
        match self {
            Self::Chords { points, closed } => (points.clone(), *closed),
            Self::Arcs { pieces, ends, closed } => {
                let mut points: Vec<Point> = ends.first().copied().into_iter().collect();
                for (conic, end) in pieces.iter().zip(&ends[1..]) {
                    let radius = conic.u.norm().max(conic.v.norm());
                    let chord = (8.0 * tolerance / radius).sqrt().clamp(1e-3, 0.8);
                    let count = (conic.sweep.abs() / chord).ceil().max(1.0) as usize;
                    points.extend((1..count).map(|i| at(conic, i as f64 / count as f64)));
                    points.push(*end);
                }
                if *closed {
                    points.pop();
                }
                (points, *closed)
            }
        }
    }
}

/// Points of a spline, and whether it closes.
fn of_spline(curve: &Spline) -> Option<(Vec<Point>, bool)> {
    let Spline { degree, knots, control, weights, fit, closed } = curve;
    let per_span = policy::SPLINE_CHORDS;
    let mut made = spline::points(*degree, knots, control, weights, per_span);
    if made.is_none() && knots.is_empty() && control.len() > 1 {
        // Control points whose knots were left out.
        let degree = (*degree).clamp(1, 3).min(control.len() - 1);
        let (knots, points) = spline::even(degree, control, *closed);
        let weights = if weights.len() == control.len() && !*closed { &weights[..] } else { &[] };
        made = spline::points(degree, &knots, &points, weights, per_span);
    }
    if made.is_none() && fit.len() > 1 {
        made = Some(spline::through(fit, *closed, per_span));
    }
    let mut points = made?;
    let whole =
        points.len() > 3 && (points[0] - points[points.len() - 1]).norm() <= 1e-9 * length(&points);
    if whole {
        points.pop();
    }
    Some((points, whole || *closed))
}

fn length(points: &[Point]) -> f64 {
    points.windows(2).map(|w| (w[1] - w[0]).norm()).sum()
}
