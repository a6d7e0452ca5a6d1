//! Alignment by dynamic programming: the motion about two given centres that covers both drawings best.
//!
//! One shift turns a law against the other; features that sit at other angles never meet. Here every rising path through
//! the square of both angles is a motion: a step of di and dj cells has psi' = dj / di (times 1/K), hence both pitch radii,
//! and costs the area by which they miss the drawings' radii on its way. The cheapest closed path is found from many
//! follower angles.

use std::f64::consts::{PI, TAU};

use super::cost::Wish;
use crate::fit::laws::directions;
use crate::fit::objective::{Candidate, Problem};
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

/// The cost of one kind of step, by where its middle lies (in half cells).
struct Step {
    cells: (usize, usize),
    speed: f64,
    driver: Vec<f64>,
    follower: Vec<f64>,
}

/// The best few motions about a candidate's centres: the turn of the follower's drawing, and psi' at even driver angles
/// of one period from where the driver's drawing stands upright.
pub(super) fn alignments(
    problem: &Problem<'_>,
    wish: &Wish,
    candidate: &Candidate,
) -> Vec<(f64, Vec<f64>)> {
    let n = policy::WARP_CELLS;
    let steps = steps(problem, wish, candidate, n);
    let mut found: Vec<(f64, usize, Vec<f64>)> = (0..n)
        .step_by(policy::WARP_STRIDE)
        .filter_map(|from| path(&steps, n, from).map(|(cost, law)| (cost, from, law)))
        .collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut kept: Vec<(usize, Vec<f64>)> = Vec::new();
    for (_, from, law) in found {
        let near = |k: &(usize, Vec<f64>)| {
            let apart = k.0.abs_diff(from);
            apart.min(n - apart) <= policy::WARP_APART
        };
        if !kept.iter().any(near) {
            kept.push((from, law));
        }
        if kept.len() == policy::WARP_KEPT {
            break;
        }
    }
    let window = TAU / f64::from(wish.ratio.follower_fold());
    kept.into_iter().map(|(from, law)| (PI - window * from as f64 / n as f64, law)).collect()
}

fn steps(problem: &Problem<'_>, wish: &Wish, candidate: &Candidate, n: usize) -> Vec<Step> {
    let ratio = wish.ratio;
    let (fd, ff) = (ratio.driver_fold() as usize, ratio.follower_fold() as usize);
    // Squared pitch radii for a centre distance of 1, at half cells of the whole turn, with the area.
    let squares = |points, center, fold: usize, ratio: f64| {
        let curve = PolarCurve::along(points, center, &directions(2 * n * fold)).ok()?;
        let l = center_distance(curve.radii(), ratio);
        let squares: Vec<f64> = curve.radii().iter().map(|r| (r / l).powi(2)).collect();
        let mean = squares.iter().sum::<f64>() / squares.len() as f64;
        Some((squares, mean))
    };
    let Some((driver, driver_mean)) = squares(problem.driver, candidate.driver, fd, ratio.value())
    else {
        return Vec::new();
    };
    let Some((follower, follower_mean)) =
        squares(problem.follower, candidate.follower, ff, 1.0 / ratio.value())
    else {
        return Vec::new();
    };
    let miss = |squares: &[f64], fold: usize, at: usize, radius: f64| {
        let windows =
            (0..fold).map(|w| (squares[(at + 2 * n * w) % squares.len()] - radius * radius).abs());
        windows.sum::<f64>() / fold as f64
    };
    let share = wish.balance;
    STEPS
        .iter()
        .map(|&(di, dj)| {
            let speed = wish.mean() * dj as f64 / di as f64;
            let (rd, rf) = (speed / (1.0 + speed), 1.0 / (1.0 + speed));
            // The driver's own direction falls as it turns.
            let driver = (0..2 * n)
                .map(|i| {
                    let at = (2 * n * fd - i) % (2 * n * fd);
                    share * di as f64 * miss(&driver, fd, at, rd) / driver_mean
                })
                .collect();
            let follower = (0..2 * n)
                .map(|j| (1.0 - share) * dj as f64 * miss(&follower, ff, j, rf) / follower_mean)
                .collect();
            Step { cells: (di, dj), speed, driver, follower }
        })
        .filter(|s| s.speed <= wish.most.max(wish.mean() * (1.0 + 1e-9)))
        .collect()
}

/// The cheapest path from follower cell `from` at driver cell 0 once round both, with its smoothed psi'.
fn path(steps: &[Step], n: usize, from: usize) -> Option<(f64, Vec<f64>)> {
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
            for (k, step) in steps.iter().enumerate() {
                let (di, dj) = step.cells;
                let (to_i, to_j) = (i + di, j + dj);
                if to_i > n || to_j > n {
                    continue;
                }
                let at = here
                    + step.driver[(2 * i + di) % (2 * n)]
                    + step.follower[(2 * (from + j) + dj) % (2 * n)];
                let cell = &mut cost[to_i * side + to_j];
                if at < *cell {
                    *cell = at;
                    way[to_i * side + to_j] = k as u8;
                }
            }
        }
    }
    let total = cost[side * side - 1];
    if !total.is_finite() {
        return None;
    }
    let mut law = vec![0.0; n];
    let (mut i, mut j) = (n, n);
    while i > 0 && j > 0 {
        let step = steps.get(way[i * side + j] as usize)?;
        let (di, dj) = step.cells;
        law[i - di..i].fill(step.speed);
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
