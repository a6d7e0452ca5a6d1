//! Alignment by dynamic programming: for two given centres, the motion that covers both drawings best.
//!
//! One shift turns a law against the other; features that sit at other angles never meet. Here every rising path through
//! the square of both angles is a motion: a step of di and dj cells has psi' = dj / di (times 1/K), hence both pitch radii,
//! and costs the area by which they miss the drawings' radii on its way. The cheapest closed path is found from every few
//! follower angles and for every pair of a few centres, so this is a search of its own in the refinement's measure.

use std::f64::consts::{PI, TAU};

use rayon::prelude::*;

use super::cost::Wish;
use crate::fit::laws::directions;
use crate::fit::objective::Problem;
use crate::gear::Gearing;
use crate::geometry::Point;
use crate::pitch::{PolarCurve, center_distance};

/// Cells of each angle's period; a step spans up to five.
const CELLS: usize = 48;
/// A path strays from the even motion by a period over this at most.
const BAND: usize = 3;
/// Passes of smoothing over a path's steps.
const SMOOTHING: usize = 2;

/// Steps of a path: cells of the driver's and of the follower's angle, without common divisor.
const STEPS: [(usize, usize); 15] = [
    (1, 1),
    (1, 2),
    (2, 1),
    (1, 3),
    (3, 1),
    (2, 3),
    (3, 2),
    (1, 4),
    (4, 1),
    (3, 4),
    (4, 3),
    (2, 5),
    (5, 2),
    (3, 5),
    (5, 3),
];

/// A motion for two centres.
#[derive(Clone, Debug)]
pub(super) struct Alignment {
    pub(super) driver: Point,
    pub(super) follower: Point,
    /// Turn of the follower's drawing; the driver's stands upright.
    pub(super) angle: f64,
    /// psi' at even driver angles of one period.
    pub(super) law: Vec<f64>,
    /// Share of area missed, in the balance asked for.
    cost: f32,
}

/// What each kind of step costs one gear about one centre, by the cell where it *ends*. The follower's go twice round.
struct Seat {
    center: Point,
    costs: Vec<Vec<f32>>,
}

/// The best motions over all pairs of the centres given, at most `kept`; paths start from every `stride`-th follower cell.
pub(super) fn alignments(
    problem: &Problem<'_>,
    wish: &Wish,
    centers: [&[Point]; 2],
    stride: usize,
    kept: usize,
) -> Vec<Alignment> {
    let n = CELLS;
    let steps: Vec<(usize, usize)> = STEPS
        .into_iter()
        .filter(|(di, dj)| di == dj || wish.mean() * *dj as f64 / *di as f64 <= wish.most)
        .collect();
    let seats = [0, 1].map(|gear| {
        centers[gear]
            .par_iter()
            .filter_map(|c| seat(problem, wish, &steps, gear, *c, n))
            .collect::<Vec<Seat>>()
    });
    let pairs: Vec<(&Seat, &Seat)> =
        seats[0].iter().flat_map(|d| seats[1].iter().map(move |f| (d, f))).collect();
    let window = TAU / f64::from(wish.ratio.follower_fold());
    let mut found: Vec<Alignment> = pairs
        .par_iter()
        .map_init(Vec::new, |table, (driver, follower)| {
            let mut best: Option<(f32, usize)> = None;
            for from in (0..n).step_by(stride).take_while(|_| !problem.control.is_cancelled()) {
                let cost = fill(table, &steps, &driver.costs, &follower.costs, from);
                if cost < best.map_or(f32::INFINITY, |b| b.0) {
                    best = Some((cost, from));
                }
            }
            let (cost, from) = best?;
            fill(table, &steps, &driver.costs, &follower.costs, from);
            let cells = walked_back(table, &steps, &driver.costs, &follower.costs, from)?;
            let law = cells.iter().map(|c| c * wish.mean()).collect();
            let angle = PI - window * from as f64 / n as f64;
            Some(Alignment { driver: driver.center, follower: follower.center, angle, law, cost })
        })
        .flatten()
        .collect();
    found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    found.truncate(kept);
    found
}

fn seat(
    problem: &Problem<'_>,
    wish: &Wish,
    steps: &[(usize, usize)],
    gear: usize,
    center: Point,
    n: usize,
) -> Option<Seat> {
    let k = wish.ratio.value();
    let (points, fold, ratio, share) = if gear == 0 {
        (problem.driver, wish.ratio.driver_fold(), k, wish.balance)
    } else {
        (problem.follower, wish.ratio.follower_fold(), 1.0 / k, 1.0 - wish.balance)
    };
    let whole = 2 * n * fold as usize;
    let curve = PolarCurve::along(points, center, &directions(whole)).ok()?;
    let l = center_distance(curve.radii(), ratio);
    // Squared pitch radii for a centre distance of 1, at half cells of the whole turn.
    let squares: Vec<f64> = curve.radii().iter().map(|r| (r / l).powi(2)).collect();
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    let costs = steps
        .iter()
        .map(|&(di, dj)| {
            let speed = wish.mean() * dj as f64 / di as f64;
            let radii = Gearing::External.radii(1.0, speed);
            let (radius, cells) = if gear == 0 { (radii.driver, di) } else { (radii.follower, dj) };
            let scale = share * cells as f64 / (mean * (n * fold as usize) as f64);
            // The follower's go twice round, so that a path from any cell reads on.
            let ends = if gear == 0 { n + 1 } else { 2 * n + 1 };
            (0..ends)
                .map(|end| {
                    // Middle of the step, half cells; the driver's own direction at the pitch point falls as it turns.
                    let middle = (2 * end + 2 * n - cells) % (2 * n);
                    let at = if gear == 0 { whole - middle } else { middle };
                    let missed = (0..fold as usize)
                        .map(|w| (squares[(at + 2 * n * w) % whole] - radius * radius).abs());
                    (scale * missed.sum::<f64>()) as f32
                })
                .collect()
        })
        .collect();
    Some(Seat { center, costs })
}

/// The cost of the cheapest path from follower cell `from` at driver cell 0 once round both. The table then holds that of every
/// cell: rows of driver cells, columns of cells past `from`.
fn fill(
    table: &mut Vec<f32>,
    steps: &[(usize, usize)],
    driver: &[Vec<f32>],
    follower: &[Vec<f32>],
    from: usize,
) -> f32 {
    let (n, side, band) = (CELLS, CELLS + 1, CELLS / BAND);
    table.clear();
    table.resize(side * side, f32::INFINITY);
    table[0] = 0.0;
    for i in 1..side {
        let (before, row) = table.split_at_mut(i * side);
        let row = &mut row[..side];
        let (low, high) = (i.saturating_sub(band), (i + band).min(n));
        for (k, &(di, dj)) in steps.iter().enumerate().filter(|(_, s)| s.0 <= i) {
            let low = low.max(dj);
            if low > high {
                continue;
            }
            let start = &before[(i - di) * side..][low - dj..=high - dj];
            let costs = &follower[k][from + low..=from + high];
            let own = driver[k][i];
            for ((to, s), c) in row[low..=high].iter_mut().zip(start).zip(costs) {
                let at = s + (own + c);
                *to = if at < *to { at } else { *to };
            }
        }
    }
    table[side * side - 1]
}

/// dj / di at every driver cell of the path that [`fill`] found, smoothed.
fn walked_back(
    table: &[f32],
    steps: &[(usize, usize)],
    driver: &[Vec<f32>],
    follower: &[Vec<f32>],
    from: usize,
) -> Option<Vec<f64>> {
    let (n, side) = (CELLS, CELLS + 1);
    let mut law = vec![1.0; n];
    let (mut i, mut j) = (n, n);
    while i > 0 && j > 0 {
        let here = table[i * side + j];
        // The step whose cost makes up what is here, computed as it was.
        let (k, _) = steps.iter().enumerate().find(|(k, s)| {
            s.0 <= i
                && s.1 <= j
                && table[(i - s.0) * side + j - s.1] + (driver[*k][i] + follower[*k][from + j])
                    == here
        })?;
        let (di, dj) = steps[k];
        law[i - di..i].fill(dj as f64 / di as f64);
        (i, j) = (i - di, j - dj);
    }
    for _ in 0..SMOOTHING {
        let old = law.clone();
        for k in 0..n {
            law[k] = 0.5 * old[k] + 0.25 * (old[(k + 1) % n] + old[(k + n - 1) % n]);
        }
    }
    Some(law)
}
