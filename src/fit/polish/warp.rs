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
use crate::geometry::Point;
use crate::pitch::{PolarCurve, center_distance};
use crate::policy;

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
    cost: f64,
}

/// What each kind of step costs one gear about one centre, by where its middle lies (in half cells).
struct Seat {
    center: Point,
    costs: Vec<Vec<f64>>,
}

/// The best motions over all pairs of the centres given, at most [`policy::WARP_KEPT`].
pub(super) fn alignments(
    problem: &Problem<'_>,
    wish: &Wish,
    centers: [&[Point]; 2],
) -> Vec<Alignment> {
    let n = policy::WARP_CELLS;
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
        .filter_map(|(driver, follower)| {
            let best = (0..n)
                .step_by(policy::WARP_STRIDE)
                .take_while(|_| !problem.control.is_cancelled())
                .filter_map(|from| {
                    let (cost, law) = path(&steps, &driver.costs, &follower.costs, n, from)?;
                    Some((cost, from, law))
                })
                .min_by(|a, b| a.0.total_cmp(&b.0))?;
            let (cost, from, cells) = best;
            let law = cells.iter().map(|c| c * wish.mean()).collect();
            let angle = PI - window * from as f64 / n as f64;
            Some(Alignment { driver: driver.center, follower: follower.center, angle, law, cost })
        })
        .collect();
    found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    found.truncate(policy::WARP_KEPT);
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
            let (radius, cells) =
                if gear == 0 { (speed / (1.0 + speed), di) } else { (1.0 / (1.0 + speed), dj) };
            let scale = share * cells as f64 / (mean * (n * fold as usize) as f64);
            (0..2 * n)
                .map(|i| {
                    // The driver's own direction at the pitch point falls as it turns.
                    let at = if gear == 0 { whole - i } else { i };
                    let missed = (0..fold as usize)
                        .map(|w| (squares[(at + 2 * n * w) % whole] - radius * radius).abs());
                    scale * missed.sum::<f64>()
                })
                .collect()
        })
        .collect();
    Some(Seat { center, costs })
}

/// The cheapest path from follower cell `from` at driver cell 0 once round both: its cost and smoothed dj / di.
fn path(
    steps: &[(usize, usize)],
    driver: &[Vec<f64>],
    follower: &[Vec<f64>],
    n: usize,
    from: usize,
) -> Option<(f64, Vec<f64>)> {
    let band = n / policy::WARP_BAND;
    let side = n + 1;
    let mut cost = vec![f64::INFINITY; side * side];
    let mut way = vec![u8::MAX; side * side];
    cost[0] = 0.0;
    for i in 0..n {
        for j in i.saturating_sub(band)..=(i + band).min(n - 1) {
            let here = cost[i * side + j];
            if !here.is_finite() {
                continue;
            }
            for (k, &(di, dj)) in steps.iter().enumerate() {
                let (to_i, to_j) = (i + di, j + dj);
                if to_i > n || to_j > n {
                    continue;
                }
                let (at_i, mut at_j) = (2 * i + di, 2 * (from + j) + dj);
                while at_j >= 2 * n {
                    at_j -= 2 * n;
                }
                let at = here + driver[k][at_i] + follower[k][at_j];
                let cell = to_i * side + to_j;
                if at < cost[cell] {
                    cost[cell] = at;
                    way[cell] = k as u8;
                }
            }
        }
    }
    let total = cost[side * side - 1];
    if !total.is_finite() {
        return None;
    }
    let mut law = vec![1.0; n];
    let (mut i, mut j) = (n, n);
    while i > 0 && j > 0 {
        let (di, dj) = *steps.get(way[i * side + j] as usize)?;
        law[i - di..i].fill(dj as f64 / di as f64);
        (i, j) = (i - di, j - dj);
    }
    for _ in 0..policy::WARP_SMOOTHING {
        let old = law.clone();
        for k in 0..n {
            law[k] = 0.5 * old[k] + 0.25 * (old[(k + 1) % n] + old[(k + n - 1) % n]);
        }
    }
    Some((total, law))
}
