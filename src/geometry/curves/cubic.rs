//! A smooth curve through sampled points: cubic spans that meet in value and derivative.

use super::band::Chain;
use super::samples::Samples;
use crate::geometry::{Point, Vector, cross};
use crate::policy;

/// A piecewise cubic curve with a continuous derivative.
#[derive(Clone, Debug, PartialEq)]
pub struct CubicPath {
    /// Parameter at each node, increasing, about the length walked.
    pub knots: Vec<f64>,
    /// Position at each node.
    pub points: Vec<Point>,
    /// Derivative by the parameter at each node, nearly of length one.
    pub derivatives: Vec<Vector>,
}

impl CubicPath {
    /// Position and derivative at a parameter.
    #[must_use]
    pub fn at(&self, u: f64) -> (Point, Vector) {
        let i = self.span(u);
        let h = self.knots[i + 1] - self.knots[i];
        let s = (u - self.knots[i]) / h;
        let [a, b, c, d] = basis(s);
        let [e, f, g, k] = basis_slope(s);
        let (p, q) = (self.points[i].coords, self.points[i + 1].coords);
        let (v, w) = (h * self.derivatives[i], h * self.derivatives[i + 1]);
        (Point::from(a * p + b * v + c * q + d * w), (e * p + f * v + g * q + k * w) / h)
    }

    fn span(&self, u: f64) -> usize {
        let last = self.knots.len() - 2;
        self.knots.partition_point(|&k| k <= u).saturating_sub(1).min(last)
    }

    /// Control points as a cubic B-spline: its knots are this path's, the first and last four times,
    /// the others twice.
    #[must_use]
    pub fn control_points(&self) -> Vec<Point> {
        let n = self.points.len();
        let mut control = vec![self.points[0]];
        for i in 0..n - 1 {
            let third = (self.knots[i + 1] - self.knots[i]) / 3.0;
            control.push(self.points[i] + third * self.derivatives[i]);
            control.push(self.points[i + 1] - third * self.derivatives[i + 1]);
        }
        control.push(self.points[n - 1]);
        control
    }

    /// The same curve walked the other way.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let end = self.knots[self.knots.len() - 1];
        Self {
            knots: self.knots.iter().rev().map(|k| end - k).collect(),
            points: self.points.iter().rev().copied().collect(),
            derivatives: self.derivatives.iter().rev().map(|d| -d).collect(),
        }
    }

    /// The part from node `first` to node `last`.
    #[must_use]
    pub fn part(&self, first: usize, last: usize) -> Self {
        Self {
            knots: self.knots[first..=last].to_vec(),
            points: self.points[first..=last].to_vec(),
            derivatives: self.derivatives[first..=last].to_vec(),
        }
    }

    /// Twice the area swept from the origin, exact.
    #[must_use]
    pub fn doubled_area(&self) -> f64 {
        // Three-point Gauss on each span is exact for the fifth-degree integrand.
        let nodes = [(0.5 - 0.15_f64.sqrt(), 5.0), (0.5, 8.0), (0.5 + 0.15_f64.sqrt(), 5.0)];
        self.knots
            .windows(2)
            .map(|k| {
                let h = k[1] - k[0];
                let sum: f64 = nodes
                    .iter()
                    .map(|&(s, weight)| {
                        let (p, d) = self.at(k[0] + s * h);
                        weight * cross(p.coords, d)
                    })
                    .sum();
                h * sum / 18.0
            })
            .sum()
    }
}

fn basis(s: f64) -> [f64; 4] {
    let r = 1.0 - s;
    [r * r * (1.0 + 2.0 * s), s * r * r, s * s * (3.0 - 2.0 * s), -s * s * r]
}

fn basis_slope(s: f64) -> [f64; 4] {
    [6.0 * s * (s - 1.0), (1.0 - s) * (1.0 - 3.0 * s), 6.0 * s * (1.0 - s), s * (3.0 * s - 2.0)]
}

/// The curve with few spans that passes the vertices within `tolerance` and their chords within
/// [`Samples::allowance`]; it meets the first and last vertex exactly unless the samples run round a ring.
///
/// # Errors
/// A vertex, not the first or last, where no smooth curve does that.
pub(super) fn fit(samples: &Samples, tolerance: f64) -> Result<CubicPath, usize> {
    let inner = samples.points.len() / 2;
    let mut nodes = first_nodes(samples);
    let mut stuck = Vec::new();
    for _ in 0..policy::CUBIC_ROUNDS {
        let path = solve(samples, &nodes).ok_or(inner)?;
        let missed = missed_spans(samples, &path, &nodes, tolerance);
        if missed.is_empty() {
            return Ok(path);
        }
        stuck = nodes[missed[0]..=missed[0] + 1].to_vec();
        let before = nodes.len();
        for &i in missed.iter().rev() {
            let (a, b) = (nodes[i], nodes[i + 1]);
            if b - a >= 2 {
                let middle = 0.5 * (samples.walked[a] + samples.walked[b]);
                let at = samples.walked.partition_point(|&w| w < middle).clamp(a + 1, b - 1);
                nodes.insert(i + 1, at);
            }
        }
        if nodes.len() == before {
            break;
        }
    }
    let last = samples.points.len() - 1;
    Err(stuck.into_iter().find(|&k| k > 0 && k < last).unwrap_or(inner))
}

/// Vertices at which spans begin with: after a certain turn, so that each is about one bend.
fn first_nodes(samples: &Samples) -> Vec<usize> {
    let last = samples.points.len() - 1;
    let mut nodes = vec![0];
    let mut turned = 0.0;
    for i in 1..last {
        turned += samples.turns[i].abs();
        if turned > policy::CUBIC_TURN {
            nodes.push(i);
            turned = 0.0;
        }
    }
    // A ring needs three nodes to be more than a line there and back.
    while samples.ring && nodes.len() < 3 && last > 3 {
        nodes = vec![0, last / 3, 2 * last / 3];
    }
    nodes.push(last);
    nodes
}

fn solve(samples: &Samples, nodes: &[usize]) -> Option<CubicPath> {
    let spans = nodes.len() - 1;
    let count = if samples.ring { spans } else { spans + 1 };
    let mut chain = Chain::new(count, samples.ring);
    let knots: Vec<f64> = nodes.iter().map(|&i| samples.walked[i]).collect();
    // Derivatives are sought as lengths, so that both unknowns of a node are of one size.
    let unit = knots[spans] / spans as f64;
    for i in 0..spans {
        let h = knots[i + 1] - knots[i];
        let scaled = |row: [f64; 4]| [row[0], row[1] * h / unit, row[2], row[3] * h / unit];
        let last = if i + 1 == spans && !samples.ring { nodes[i + 1] + 1 } else { nodes[i + 1] };
        for k in nodes[i]..last {
            let s = (samples.walked[k] - knots[i]) / h;
            chain.observe(i, scaled(basis(s)), samples.points[k].coords, 1.0);
        }
        let e = policy::CUBIC_STIFFNESS;
        let q = h / unit;
        chain.stiffen(
            i,
            [
                [12.0 * e, 6.0 * e * q, -12.0 * e, 6.0 * e * q],
                [6.0 * e * q, 4.0 * e * q * q, -6.0 * e * q, 2.0 * e * q * q],
                [-12.0 * e, -6.0 * e * q, 12.0 * e, -6.0 * e * q],
                [6.0 * e * q, 2.0 * e * q * q, -6.0 * e * q, 4.0 * e * q * q],
            ],
        );
    }
    if !samples.ring {
        chain.fix(0, samples.points[0].coords);
        chain.fix(spans, samples.points[samples.points.len() - 1].coords);
    }
    let mut found = chain.solve()?;
    if samples.ring {
        found.push(found[0]);
    }
    Some(CubicPath {
        knots,
        points: found.iter().map(|f| Point::from(f[0])).collect(),
        derivatives: found.iter().map(|f| f[1] / unit).collect(),
    })
}

/// Spans, in order, on which a vertex or a chord is missed.
fn missed_spans(
    samples: &Samples,
    path: &CubicPath,
    nodes: &[usize],
    tolerance: f64,
) -> Vec<usize> {
    let off = |u: f64, p: Point| {
        let (q, d) = path.at(u);
        // Along the curve a point may slide; only the distance across counts.
        let speed = d.norm();
        if (0.5..2.0).contains(&speed) { cross(d, p - q).abs() / speed } else { f64::INFINITY }
    };
    let missed = |a: usize, b: usize| {
        (a..=b).any(|k| off(samples.walked[k], samples.points[k]) > tolerance)
            || (a..b).any(|k| {
                let most = samples.allowance(k, 2.0 * tolerance);
                samples.places(k).iter().any(|&(u, p)| off(u, p) > most)
            })
    };
    (0..nodes.len() - 1).filter(|&i| missed(nodes[i], nodes[i + 1])).collect()
}
