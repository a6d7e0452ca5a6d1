//! A chosen candidate turned into a motion, with both drawings placed in their gears.

use std::f64::consts::{PI, TAU};

use super::likeness::contour_share;
use super::objective::{Candidate, Problem, Scored};
use super::{Fit, FitError};
use crate::gear::Side;
use crate::geometry::{self, Point, rotate};
use crate::pitch::{Centrodes, PolarCurve, Transmission};
use crate::policy;

/// A map that keeps form: `scale * turn(angle) * (p - center)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Similarity {
    /// Point of the drawing that goes to the origin.
    pub center: Point,
    /// Rotation, radians, counter-clockwise.
    pub angle: f64,
    /// Length in the gear for one unit of the drawing.
    pub scale: f64,
}

impl Similarity {
    /// Where `p` of the drawing lies in the gear's frame.
    #[must_use]
    pub fn apply(&self, p: Point) -> Point {
        rotate(Point::from(self.scale * (p - self.center)), self.angle)
    }
}

/// A drawing in its gear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedGear {
    /// The rotation centre, in the drawing's coordinates.
    pub center_in_input: Point,
    /// From the drawing to the gear's frame at driver angle 0, for a centre distance of 1. The drawing gets
    /// the area of the pitch curve.
    pub placement: Similarity,
    /// Area of the intersection over area of the union of pitch curve and drawing as placed.
    pub iou: f64,
    /// Share of the contours of both that runs where the other one does, see [`super::contour_share`].
    pub contour: f64,
    /// Area (over the drawing's) that the outermost crossings of rays from the centre fill in.
    pub lost_area: f64,
}

impl FittedGear {
    /// A drawing laid on its pitch curve, both measured.
    pub(super) fn laid(
        placement: Similarity,
        (curve, input): (&[Point], &[Point]),
        lost_area: f64,
    ) -> Self {
        let placed: Vec<Point> = input.iter().map(|p| placement.apply(*p)).collect();
        Self {
            center_in_input: placement.center,
            placement,
            iou: geometry::intersection_over_union(curve, &placed),
            contour: contour_share(curve, &placed),
            lost_area,
        }
    }

    /// Likeness to a person's eye: the mean of the shares of area and of contour.
    #[must_use]
    pub fn likeness(&self) -> f64 {
        0.5 * (self.iou + self.contour)
    }
}

pub(super) fn place(
    problem: &Problem<'_>,
    candidate: &Candidate,
    pairs_scored: usize,
) -> Result<Fit, FitError> {
    let mut candidate = problem.pinned(*candidate);
    let mut begun = Begun::new(problem, &candidate)?;
    if let Some(wanted) = problem.fixed.orientation {
        for _ in 0..policy::ORIENTATION_ROUNDS {
            let off = (begun.follower_angle - wanted + PI).rem_euclid(TAU) - PI;
            if off.abs() < policy::ORIENTATION_WITHIN {
                break;
            }
            // The drawing turns by 1 / K for each radian that its law is shifted by.
            let way = if problem.short_side() == Side::Driver { 1.0 } else { -1.0 };
            candidate.shift += way * off * problem.ratio.value();
            begun = Begun::new(problem, &candidate)?;
        }
    }
    let Begun { scored, centrodes, start, follower_angle } = begun;
    let raw = turned(&scored.blend, -start / problem.step());
    let count = policy::PLACEMENT_SAMPLES;
    let (driver_fold, follower_fold) = problem.folds();
    let driver_curve = centrodes.driver_curve(count * driver_fold as usize);
    let follower_curve = centrodes.follower_curve(count * follower_fold as usize);
    let fitted = |center: Point,
                  input: &[Point],
                  curve: &[Point],
                  angle: f64,
                  lost_area: f64,
                  search: f64| {
        let scale = (geometry::area(curve) / geometry::area(input)).sqrt();
        let mut placement = Similarity { center, angle, scale };
        if search > 0.0 {
            placement.angle = best_angle(input, curve, &placement, search);
        }
        FittedGear::laid(placement, (curve, input), lost_area)
    };
    let driver =
        fitted(candidate.driver, problem.driver, &driver_curve, 0.0, scored.lost_area.0, 0.0);
    let follower = fitted(
        candidate.follower,
        problem.follower,
        &follower_curve,
        follower_angle,
        scored.lost_area.1,
        if problem.fixed.orientation.is_some() { 0.0 } else { policy::PLACEMENT_SWING },
    );
    Ok(Fit {
        transmission: centrodes.transmission,
        raw,
        objective: scored.objective,
        limited: scored.cost,
        driver,
        follower,
        pairs_scored,
        refinement: None,
    })
}

/// A candidate scored, with its motion begun where the driver's drawing stands upright.
struct Begun {
    scored: Scored,
    centrodes: Centrodes,
    /// Driver angle, in the pair's motion, at which the window starts.
    start: f64,
    follower_angle: f64,
}

impl Begun {
    fn new(problem: &Problem<'_>, candidate: &Candidate) -> Result<Self, FitError> {
        let scored = problem.score(candidate)?;
        let (driver_fold, follower_fold) = problem.folds();
        let window = Transmission::from_derivative(&scored.limited, driver_fold, follower_fold)?;
        // In the window's angles the driver's own direction is -shift at 0 when the driver is the long gear.
        let start = if problem.short_side() == Side::Driver { 0.0 } else { candidate.shift };
        let transmission = if start == 0.0 { window } else { window.shifted(-start) };
        let centrodes = Centrodes { transmission, center_distance: 1.0 };
        let follower_angle = follower_angle(problem, candidate, &scored, &centrodes, start);
        Ok(Self { scored, centrodes, start, follower_angle })
    }
}

/// A candidate's motion, the driver's drawing upright, and the turn of the follower's drawing.
pub(super) fn motion(
    problem: &Problem<'_>,
    candidate: &Candidate,
) -> Result<(Transmission, f64), FitError> {
    let begun = Begun::new(problem, candidate)?;
    Ok((begun.centrodes.transmission, begun.follower_angle))
}

/// Mean turn from the follower's drawing to its gear: at each sample the direction in the drawing that its own law puts at the
/// pitch point should lie where the pair's motion puts it, at `pi + psi`.
fn follower_angle(
    problem: &Problem<'_>,
    candidate: &Candidate,
    scored: &Scored,
    centrodes: &Centrodes,
    start: f64,
) -> f64 {
    let n = problem.samples;
    let (from, per_turn) = match problem.short_side() {
        Side::Driver => (candidate.shift, n * problem.windows()),
        Side::Follower => (0.0, n),
    };
    let directions = scored.follower_law.directions_at(from, n, per_turn);
    let (mut sin, mut cos) = (0.0, 0.0);
    for (i, direction) in directions.iter().enumerate() {
        let phi = start + i as f64 * problem.step();
        let turn = PI + centrodes.transmission.psi(phi) - direction;
        sin += turn.sin();
        cos += turn.cos();
    }
    sin.atan2(cos)
}

/// The angle within `swing` of the given one at which drawing and curve, as polar curves about the axis, share most area.
fn best_angle(input: &[Point], curve: &[Point], placement: &Similarity, swing: f64) -> f64 {
    let n = policy::PLACEMENT_SAMPLES;
    let placed: Vec<Point> = input.iter().map(|p| placement.apply(*p)).collect();
    let squares = |points: &[Point]| {
        let polar = PolarCurve::about(points, Point::origin(), n).ok()?;
        Some(polar.radii().iter().map(|r| r * r).collect::<Vec<f64>>())
    };
    let (Some(drawn), Some(made)) = (squares(&placed), squares(curve)) else {
        return placement.angle;
    };
    let reach = (swing / TAU * n as f64).round() as i64;
    let shared = |k: i64| -> f64 {
        let from = k.rem_euclid(n as i64) as usize;
        // The drawing turned by k steps has at direction i what it had at i - k.
        let turned = drawn.iter().chain(&drawn).skip(n - from);
        made.iter().zip(turned).map(|(a, b)| a.min(*b)).sum()
    };
    // Nearest first, so that among equals (circles) the given angle stays.
    let mut best = (shared(0), 0);
    for k in (1..=reach).flat_map(|k| [k, -k]) {
        let area = shared(k);
        if area > best.0 * (1.0 + f64::EPSILON * n as f64) {
            best = (area, k);
        }
    }
    placement.angle + best.1 as f64 * TAU / n as f64
}

/// A ring of samples read from position `from` on, linear between them.
fn turned(samples: &[f64], from: f64) -> Vec<f64> {
    let n = samples.len();
    let whole = from.floor();
    let t = from - whole;
    let first = (whole as i64).rem_euclid(n as i64) as usize;
    (0..n)
        .map(|i| {
            let (a, b) = (samples[(first + i) % n], samples[(first + i + 1) % n]);
            a + t * (b - a)
        })
        .collect()
}
