//! Refinement: the pair's motion and both drawings' places moved together until the pitch curves cover the drawings best.
//!
//! The searches blend two laws that one shift aligned. Here psi' is a [`law`] of its own, so both pitch curves come from one
//! psi and mate exactly whatever the numbers, and what is made small ([`cost`]) is the area by which pitch curves and
//! drawings differ. The steps (`docs/refinement.md`):
//! 1. starts: the searches' best pairs of centres with their blended laws, and the same centres with a warped alignment
//!    ([`warp`]);
//! 2. each start is improved by L-BFGS on widely blurred drawings and few waves, the better ones on sharper drawings and
//!    more waves;
//! 3. the ends are put under the limits and measured on polygons; the best is taken if it beats what the search gave.

mod cost;
mod field;
mod law;
mod plan;
mod warp;

pub(super) use plan::Plan;

use rayon::prelude::*;

use self::cost::{Cost, PLACES, Wish};
use self::field::{Field, Raster};
use self::law::Basis;
use super::align::Aligner;
use super::grid::{interior_grid, thinned};
use super::limits::{LimitCost, apply};
use super::objective::{Candidate, Objective, Problem};
use super::placement::{self, FittedGear, Similarity};
use super::{Fit, FitError};
use crate::control::StageName;
use crate::gear::Side;
use crate::geometry::{self, Point};
use crate::pitch::{Centrodes, Transmission};
use crate::policy;

/// Weight of omega max psi' beside the share of area that differs: kappa. At 0.25 likeness hardly gains and torque falls by a
/// third; at 0.04 the torque stays about what it was.
const TORQUE: f64 = 0.04;
/// Waves of a start's law.
const START_WAVES: usize = 8;
/// Samples of the law of a start: it keeps only a few waves.
const START_SAMPLES: usize = 128;
/// Ends nearer to each other than this (lengths over the drawing's, radians, shares) are one.
const TWINS: f64 = 0.02;
/// Centres of the search that join those spread for warped alignments.
const FOUND_CENTERS: usize = 4;
/// A found centre nearer than this to one of those spread, over their spacing, adds nothing.
const CENTERS_APART: f64 = 0.3;

/// What a refinement changed; the measure is `t (1 - IoU_D) + (1 - t) (1 - IoU_F) + kappa omega max psi'`.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Refinement {
    /// The measure of what the search gave.
    pub before: f64,
    /// The measure of what is delivered, not above `before`.
    pub after: f64,
    /// Places from which the refinement started.
    pub starts: usize,
    /// Whether a warped alignment won.
    pub is_warped: bool,
}

/// A drawing moved to its centroid and scaled to area 1.
struct Drawing {
    centroid: Point,
    size: f64,
    points: Vec<Point>,
}

impl Drawing {
    fn new(points: &[Point]) -> Self {
        let (centroid, size) = (geometry::centroid(points), geometry::area(points).sqrt());
        let points = points.iter().map(|p| Point::from((p - centroid) / size)).collect();
        Self { centroid, size, points }
    }

    fn inward(&self, p: Point) -> Point {
        Point::from((p - self.centroid) / self.size)
    }

    fn outward(&self, p: Point) -> Point {
        self.centroid + self.size * p.coords
    }
}

/// A point of the search space on its way.
#[derive(Clone, Debug)]
struct Path {
    x: Vec<f64>,
    value: f64,
    is_warped: bool,
}

/// Refined pairs, the best first; the given one leads where nothing better is found.
pub(super) fn polished(
    problem: &Problem<'_>,
    found: Fit,
    candidates: &[Candidate],
    plan: &Plan,
) -> Vec<Fit> {
    let drawings = [Drawing::new(problem.driver), Drawing::new(problem.follower)];
    let wish = wish(problem);
    let rasters = [0, 1].map(|i| Raster::new(&drawings[i].points));
    let candidates = &candidates[..candidates.len().min(plan.candidates)];
    let mut paths = starts(problem, &wish, &drawings, candidates, plan);
    let count = paths.len();
    let folds = problem.windows();
    for (index, stage) in plan.stages.iter().enumerate() {
        let places = (stage.places / folds).max(4 * stage.waves).max(policy::FIT_SAMPLES_LEAST);
        let basis = Basis::new(places, stage.waves);
        let fields: [Field; 2] = [0, 1].map(|i| rasters[i].field(stage.blur));
        paths = paths
            .into_par_iter()
            .map(|path| {
                let mut x = path.x[..PLACES].to_vec();
                x.extend(law::with_waves(&path.x[PLACES..], stage.waves));
                let (x, value) = Cost::new(&wish, &basis, [&fields[0], &fields[1]])
                    .under(problem.control)
                    .improved(&x, stage.rounds);
                Path { x, value, ..path }
            })
            .collect();
        paths.sort_by(|a, b| a.value.total_cmp(&b.value));
        paths = distinct(paths, stage.kept);
        let done = 0.6 + 0.4 * (index + 1) as f64 / plan.stages.len() as f64;
        problem.control.progress(StageName::Wanted, done);
    }
    let before = measure(&wish, &found);
    let mut ends: Vec<(f64, Fit)> = paths
        .par_iter()
        .filter_map(|path| {
            let fit = delivered(problem, &wish, &drawings, path, &found).ok()?;
            let after = measure(&wish, &fit);
            let is_warped = path.is_warped;
            let refinement = Some(Refinement { before, after, starts: count, is_warped });
            Some((after, Fit { refinement, ..fit }))
        })
        .collect();
    let unchanged = Refinement { before, after: before, starts: count, is_warped: false };
    ends.push((before, Fit { refinement: Some(unchanged), ..found }));
    ends.sort_by(|a, b| a.0.total_cmp(&b.0));
    ends.into_iter().map(|e| e.1).collect()
}

fn wish(problem: &Problem<'_>) -> Wish {
    Wish {
        ratio: problem.ratio,
        balance: problem.balance,
        torque: TORQUE * problem.weight,
        most: problem.limits.max_derivative.unwrap_or(f64::INFINITY),
        steepest: problem.limits.max_lean.tan(),
        held: [Side::Driver, Side::Follower].map(|side| problem.fixed.axis(side).is_some()),
    }
}

/// The best few that differ.
fn distinct(paths: Vec<Path>, kept: usize) -> Vec<Path> {
    let mut out: Vec<Path> = Vec::new();
    for path in paths {
        let twin = out.iter().any(|o| {
            let apart = o.x.iter().zip(&path.x).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
            apart < TWINS
        });
        if path.value.is_finite() && !twin {
            out.push(path);
        }
        if out.len() == kept {
            break;
        }
    }
    out
}

fn starts(
    problem: &Problem<'_>,
    wish: &Wish,
    drawings: &[Drawing; 2],
    candidates: &[Candidate],
    plan: &Plan,
) -> Vec<Path> {
    let waves = START_WAVES;
    let thin = (thinned(problem.driver), thinned(problem.follower));
    let rough = problem.resampled((&thin.0, &thin.1), START_SAMPLES);
    let placed = |centers: (Point, Point), angle: f64, law: &[f64], is_warped: bool| {
        let (d, f) = (drawings[0].inward(centers.0), drawings[1].inward(centers.1));
        let mut x = vec![d.x, d.y, 0.0, f.x, f.y, angle];
        x.extend(Basis::new(law.len(), waves).coefficients(law));
        Path { x, value: f64::INFINITY, is_warped }
    };
    let mut paths: Vec<Path> = candidates
        .par_iter()
        .filter_map(|c| {
            problem.control.check().ok()?;
            let (motion, angle) = placement::motion(&rough, c).ok()?;
            Some(placed((c.driver, c.follower), angle, motion.samples(), false))
        })
        .collect();
    if plan.centers > 0 {
        let centers = [
            centers(&thin.0, wish.held[0], plan, candidates.iter().map(|c| c.driver)),
            centers(&thin.1, wish.held[1], plan, candidates.iter().map(|c| c.follower)),
        ];
        let warped =
            warp::alignments(&rough, wish, [&centers[0], &centers[1]], plan.stride, plan.warps);
        paths.extend(warped.iter().map(|a| placed((a.driver, a.follower), a.angle, &a.law, true)));
    }
    paths
}

/// A few centres spread over a drawing and the first few of the search, for warped alignments; that of the search alone where it is
/// held.
fn centers(
    points: &[Point],
    held: bool,
    plan: &Plan,
    found: impl Iterator<Item = Point>,
) -> Vec<Point> {
    if held {
        return found.take(1).collect();
    }
    let (mut grid, spacing) = interior_grid(points, plan.centers);
    for center in found.take(FOUND_CENTERS) {
        if grid.iter().all(|g| (g - center).norm() > CENTERS_APART * spacing) {
            grid.push(center);
        }
    }
    grid
}

fn measure(wish: &Wish, fit: &Fit) -> f64 {
    wish.balance * (1.0 - fit.driver.iou)
        + (1.0 - wish.balance) * (1.0 - fit.follower.iou)
        + wish.torque * fit.transmission.max_derivative()
}

/// The end of a path as a fit: driver's drawing upright, limits kept.
fn delivered(
    problem: &Problem<'_>,
    wish: &Wish,
    drawings: &[Drawing; 2],
    path: &Path,
    found: &Fit,
) -> Result<Fit, FitError> {
    problem.control.check()?;
    let (x, coefficients) = path.x.split_at(PLACES);
    let folds = problem.folds();
    let series = law::sampled(coefficients, 0.0, wish.mean(), problem.samples);
    let before = Transmission::from_derivative(&series, folds.0, folds.1)?;
    // Starting at driver angle -angle stands the driver's drawing upright.
    let start = -x[2];
    let raw = law::sampled(coefficients, start / wish.period(), wish.mean(), problem.samples);
    let (law, limited) = apply(&raw, folds, problem.limits)?;
    let transmission = Transmission::from_derivative(&law, folds.0, folds.1)?;
    let centrodes = Centrodes { transmission, center_distance: 1.0 };
    let count = policy::PLACEMENT_SAMPLES;
    let curves = [
        centrodes.driver_curve(count * folds.0 as usize),
        centrodes.follower_curve(count * folds.1 as usize),
    ];
    let fitted = |i: usize, side: Side, angle: f64| -> Result<FittedGear, FitError> {
        let moved = drawings[i].outward(Point::new(x[3 * i], x[3 * i + 1]));
        let center = problem.fixed.axis(side).unwrap_or(moved);
        let lost_area = problem.law(side, center)?.lost_area;
        let scale = geometry::area(&curves[i]).sqrt() / drawings[i].size;
        let placement = Similarity { center, angle, scale };
        let input = if i == 0 { problem.driver } else { problem.follower };
        Ok(FittedGear::laid(placement, (&curves[i], input), lost_area))
    };
    let driver = fitted(0, Side::Driver, 0.0)?;
    let follower = fitted(1, Side::Follower, x[5] - before.psi(start))?;
    let objective = judged(problem, &driver, &follower, &limited)?;
    Ok(Fit {
        transmission: centrodes.transmission,
        raw,
        objective,
        limited,
        driver,
        follower,
        pairs_scored: found.pairs_scored,
        refinement: None,
    })
}

/// E of the delivered law, with the E_s of Eq. 12 that both drawings have about the delivered axes at their best shift.
fn judged(
    problem: &Problem<'_>,
    driver: &FittedGear,
    follower: &FittedGear,
    limited: &LimitCost,
) -> Result<Objective, FitError> {
    let aligner = Aligner::new(problem.samples, problem.windows());
    let shift = |short_side: Side, long_side: Side| {
        let center = |side| {
            if side == Side::Driver { driver.center_in_input } else { follower.center_in_input }
        };
        let (short, _) = problem.whole_turn(short_side, center(short_side)).ok()?;
        let (long, _) = problem.whole_turn(long_side, center(long_side)).ok()?;
        let long = aligner.long(long, 1.0 / problem.ratio.value(), true);
        Some(aligner.best(&aligner.short(short), &long, 1, &mut aligner.scratch()).shift)
    };
    let shift = match problem.short_side() {
        Side::Driver => shift(Side::Driver, Side::Follower),
        Side::Follower => shift(Side::Follower, Side::Driver),
    };
    let candidate = Candidate {
        driver: driver.center_in_input,
        follower: follower.center_in_input,
        shift: shift.unwrap_or(0) as f64 * problem.step(),
    };
    let Objective { shape, folding_cost, lost_cost, .. } = problem.score(&candidate)?.objective;
    Ok(problem.objective(shape, (folding_cost, lost_cost), limited))
}

#[cfg(test)]
mod tests;
