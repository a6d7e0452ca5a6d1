//! The default search: a dense grid in both shapes, every pair at every shift, then continuous refinement.
//!
//! 1. Every grid centre's law is computed and transformed once.
//! 2. Every pair is aligned (Eq. 12 at all shifts by one inverse transform). A pair whose Delta + omega / K, a lower bound
//!    of E since max psi' >= 1 / K, exceeds the best so far goes no further.
//! 3. The most promising are worked out with the limits' cost; the best distinct ones are judged again at full
//!    resolution and refined: centres and shift move continuously.
//! 4. The winner of the paper's search enters the refinement too, so this search never ends above it.

use rayon::prelude::*;

use super::align::{Aligner, LongSpectrum, ShortSpectrum};
use super::limits::{Limits, apply};
use super::objective::{Candidate, Problem, greatest};
use super::{paper_search, refine};
use crate::control::StageName;
use crate::gear::Side;
use crate::geometry::{self, Point};
use crate::policy;

/// A pair of grid centres at its best shift.
#[derive(Clone, Copy, Debug)]
struct Pair {
    short: u32,
    long: u32,
    shift: u32,
    /// Delta with the costs of folding and of what the centres lose.
    delta: f64,
    /// E without limits.
    estimate: f64,
}

/// The best centres and shift, then places worth refining, and the number of pairs scored; none if no centre serves.
pub(super) fn search(problem: &Problem<'_>) -> (Vec<Candidate>, usize) {
    let (paper, paper_pairs) = paper_search::search(problem);
    let paper = paper.first();
    // Rounding corners costs little and hardly depends on the centres, but is slow to work out: only the finalists are judged by it.
    let limits = Limits { max_curvature: None, ..*problem.limits };
    let unrounded = problem.with_limits(&limits);
    problem.control.progress(StageName::Wanted, 0.1);
    let (mut finalists, seeds, scan_pairs) = finalists(&unrounded, paper);
    problem.control.progress(StageName::Wanted, 0.5);
    finalists.extend(paper);
    let judged: Vec<(f64, Candidate)> =
        finalists.par_iter().map(|c| (problem.total(c), *c)).collect();
    let best = judged.into_iter().filter(|e| e.0.is_finite()).min_by(|a, b| a.0.total_cmp(&b.0));
    let mut found: Vec<Candidate> = best.map(|(_, c)| c).into_iter().collect();
    found.extend(paper);
    found.extend(seeds);
    (found, paper_pairs + scan_pairs)
}

/// The best candidates after refinement, the scan's best, and the pairs scored on the way.
fn finalists(
    problem: &Problem<'_>,
    paper: Option<&Candidate>,
) -> (Vec<Candidate>, Vec<Candidate>, usize) {
    let thin = (thinned(problem.driver), thinned(problem.follower));
    let coarse_samples = (policy::SCAN_SAMPLES / problem.windows())
        .clamp(policy::SCAN_SAMPLES_LEAST, policy::SCAN_SAMPLES / 2);
    let coarse = problem.resampled((&thin.0, &thin.1), coarse_samples.next_power_of_two());
    let (seeds, scan_pairs, spacing) = scan(&coarse);
    problem.control.progress(StageName::Wanted, 0.3);
    let ranked = |candidates: Vec<Candidate>, kept: usize| {
        let mut scored: Vec<(f64, Candidate)> =
            candidates.into_par_iter().map(|c| (problem.total(&c), c)).collect();
        scored.retain(|s| s.0.is_finite());
        scored.sort_by(|a, b| a.0.total_cmp(&b.0));
        scored.truncate(kept);
        scored.into_iter().map(|s| s.1).collect::<Vec<_>>()
    };
    let mut starts = ranked(seeds.clone(), policy::REFINED_STARTS);
    starts.extend(paper);
    let steps = Steps {
        driver: spacing.0,
        follower: spacing.1,
        shift: policy::REFINE_SHIFT * coarse.step(),
    };
    let medium =
        problem.resampled((&thin.0, &thin.1), (problem.samples / 2).max(policy::FIT_SAMPLES_LEAST));
    let mut ends: Vec<Candidate> = starts
        .par_iter()
        .map(|c| refined(&medium, c, &steps, policy::REFINE_EVALUATIONS))
        .collect();
    ends.extend(&starts);
    let ends = ranked(ends, policy::POLISHED);
    let fine = steps.shrunk(policy::POLISH_SHRINK);
    let mut all: Vec<Candidate> =
        ends.par_iter().map(|c| refined(problem, c, &fine, policy::POLISH_EVALUATIONS)).collect();
    all.extend(ends);
    (ranked(all, policy::POLISHED), seeds, scan_pairs)
}

/// First steps of a refinement, drawing units and radians.
struct Steps {
    driver: f64,
    follower: f64,
    shift: f64,
}

impl Steps {
    fn shrunk(&self, by: f64) -> Self {
        Self { driver: self.driver * by, follower: self.follower * by, shift: self.shift * by }
    }
}

fn refined(
    problem: &Problem<'_>,
    start: &Candidate,
    steps: &Steps,
    evaluations: usize,
) -> Candidate {
    let unpack = |x: &[f64; 5]| {
        problem.pinned(Candidate {
            driver: Point::new(x[0], x[1]),
            follower: Point::new(x[2], x[3]),
            shift: x[4],
        })
    };
    let (d, f) = (start.driver, start.follower);
    let at = [d.x, d.y, f.x, f.y, start.shift];
    let by = [steps.driver, steps.driver, steps.follower, steps.follower, steps.shift];
    let (x, _) = refine::simplex(at, by, evaluations, |x| problem.total(&unpack(x)));
    unpack(&x)
}

/// The best distinct candidates of the dense grid, the number of pairs, and the grids' spacings (driver, follower).
fn scan(problem: &Problem<'_>) -> (Vec<Candidate>, usize, (f64, f64)) {
    let aligner = Aligner::new(problem.samples, problem.windows());
    let mean = 1.0 / problem.ratio.value();
    let (short_side, long_side) = match problem.short_side() {
        Side::Driver => (Side::Driver, Side::Follower),
        Side::Follower => (Side::Follower, Side::Driver),
    };
    let points = |side| if side == Side::Driver { problem.driver } else { problem.follower };
    let grid = |side| {
        let (grid, spacing) = interior_grid(points(side), policy::GRID_CENTERS);
        (problem.fixed.axis(side).map_or(grid, |axis| vec![axis]), spacing)
    };
    let (short_grid, short_spacing) = grid(short_side);
    let (long_grid, long_spacing) = grid(long_side);
    let shorts: Vec<(Point, ShortSpectrum, f64)> = short_grid
        .into_par_iter()
        .filter_map(|c| {
            problem.control.check().ok()?;
            let (law, lost) = problem.whole_turn(short_side, c).ok()?;
            Some((c, aligner.short(law), problem.lost_cost(short_side, lost)))
        })
        .collect();
    let longs: Vec<(Point, LongSpectrum, f64)> = long_grid
        .into_par_iter()
        .filter_map(|c| {
            problem.control.check().ok()?;
            let (law, lost) = problem.whole_turn(long_side, c).ok()?;
            Some((c, aligner.long(law, mean, true), problem.lost_cost(long_side, lost)))
        })
        .collect();
    let followers: Vec<Point> = match short_side {
        Side::Driver => longs.iter().map(|l| l.0).collect(),
        Side::Follower => shorts.iter().map(|s| s.0).collect(),
    };
    let shifts: Vec<Option<usize>> =
        followers.par_iter().map(|f| problem.fixed_shift_samples(*f)).collect();
    let mut pairs: Vec<Pair> = shorts
        .par_iter()
        .enumerate()
        .map_init(
            || aligner.scratch(),
            |scratch, (i, (_, short, short_lost))| {
                let mut row: Vec<Pair> = Vec::new();
                for (j, (_, long, long_lost)) in longs.iter().enumerate() {
                    if problem.control.is_cancelled() {
                        break;
                    }
                    let follower = if short_side == Side::Driver { j } else { i };
                    let at = match shifts[follower] {
                        Some(shift) => aligner.at(short, long, shift),
                        None => aligner.best(short, long, 1, scratch),
                    };
                    let delta = at.delta + short_lost + long_lost;
                    let bound = delta + problem.weight * mean;
                    if row
                        .last()
                        .is_some_and(|r| row.len() >= policy::KEPT_PER_ROW && bound >= r.estimate)
                    {
                        continue;
                    }
                    let blend =
                        problem.blend(&short.law, long.window(at.shift, problem.samples, mean));
                    let estimate = delta + problem.weight * greatest(&blend);
                    let place = row.partition_point(|r| r.estimate <= estimate);
                    let pair = Pair {
                        short: i as u32,
                        long: j as u32,
                        shift: at.shift as u32,
                        delta,
                        estimate,
                    };
                    row.insert(place, pair);
                    row.truncate(policy::KEPT_PER_ROW);
                }
                row
            },
        )
        .flatten_iter()
        .collect();
    pairs.sort_by(|a, b| {
        a.estimate.total_cmp(&b.estimate).then((a.short, a.long).cmp(&(b.short, b.long)))
    });
    pairs.truncate(policy::LIMITED_PAIRS);
    let mut judged: Vec<(f64, &Pair)> = Vec::new();
    for chunk in pairs.chunks(policy::LIMITED_PAIRS / 8) {
        let worst = judged.get(policy::KEPT_PER_ROW).map_or(f64::INFINITY, |j| j.0);
        let scored: Vec<(f64, &Pair)> = chunk
            .par_iter()
            .filter(|p| p.delta + problem.weight * mean < worst)
            .filter_map(|p| {
                problem.control.check().ok()?;
                let window =
                    longs[p.long as usize].1.window(p.shift as usize, problem.samples, mean);
                let blend = problem.blend(&shorts[p.short as usize].1.law, window);
                let (_, cost) = apply(&blend, problem.folds(), problem.limits).ok()?;
                Some((problem.objective(p.delta, (0.0, 0.0), &cost).total, p))
            })
            .collect();
        judged.extend(scored);
        judged.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    let mut kept: Vec<(Point, Point, usize)> = Vec::new();
    for (_, pair) in judged {
        let (short, long) = (shorts[pair.short as usize].0, longs[pair.long as usize].0);
        let apart = policy::DISTINCT_STEPS;
        let known = kept.iter().any(|(s, l, _)| {
            (s - short).norm() < apart * short_spacing && (l - long).norm() < apart * long_spacing
        });
        if !known {
            kept.push((short, long, pair.shift as usize));
        }
        if kept.len() == policy::KEPT_CANDIDATES {
            break;
        }
    }
    let candidates = kept.into_iter().map(|(short, long, shift)| {
        let shift = shift as f64 * problem.step();
        problem.pinned(match short_side {
            Side::Driver => Candidate { driver: short, follower: long, shift },
            Side::Follower => Candidate { driver: long, follower: short, shift },
        })
    });
    let spacing = match short_side {
        Side::Driver => (short_spacing, long_spacing),
        Side::Follower => (long_spacing, short_spacing),
    };
    (candidates.collect(), shorts.len() * longs.len(), spacing)
}

/// At least `count` points of a square grid inside the polygon, and the grid's spacing.
pub(super) fn interior_grid(points: &[Point], count: usize) -> (Vec<Point>, f64) {
    let (low, high) = geometry::bounds(points);
    let size = high - low;
    let mut spacing = (geometry::area(points) / count as f64).sqrt();
    let finest = (size.x * size.y / policy::GRID_CELLS_MOST).sqrt();
    let mut grid = Vec::new();
    for _ in 0..policy::GRID_ATTEMPTS {
        spacing = spacing.max(finest);
        let (nx, ny) = ((size.x / spacing).ceil().max(1.0), (size.y / spacing).ceil().max(1.0));
        let (dx, dy) = (size.x / nx, size.y / ny);
        grid = (0..(nx * ny) as usize)
            .map(|k| {
                let (i, j) = ((k % nx as usize) as f64, (k / nx as usize) as f64);
                Point::new(low.x + (i + 0.5) * dx, low.y + (j + 0.5) * dy)
            })
            .filter(|p| geometry::contains(points, *p))
            .collect();
        if grid.len() >= count || spacing <= finest {
            break;
        }
        spacing *= policy::GRID_SHRINK;
    }
    (grid, spacing)
}

/// At most [`policy::SCAN_VERTICES`] of the vertices, evenly taken.
pub(super) fn thinned(points: &[Point]) -> Vec<Point> {
    let stride = points.len().div_ceil(policy::SCAN_VERTICES);
    points.iter().copied().step_by(stride.max(1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_is_full_and_inside() {
        let star: Vec<Point> = (0..10)
            .map(|i| {
                let r = if i % 2 == 0 { 1.0 } else { 0.4 };
                geometry::rotate(Point::new(r, 0.0), std::f64::consts::PI * f64::from(i) / 5.0)
            })
            .collect();
        let (grid, spacing) = interior_grid(&star, policy::GRID_CENTERS);
        assert!(grid.len() >= policy::GRID_CENTERS && grid.len() < 2 * policy::GRID_CENTERS);
        assert!(grid.iter().all(|p| geometry::contains(&star, *p)));
        let covered = grid.len() as f64 * spacing * spacing / geometry::area(&star);
        assert!((covered - 1.0).abs() < 0.2, "{covered}");
    }
}
