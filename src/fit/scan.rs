//! The dense scan: every pair of grid centres at every shift.
//!
//! What two shapes look like from each other's centres depends on neither weights, balance nor limits. [`Scan::new`] works that
//! out once; [`Scan::candidates`] ranks it under whatever is asked, so a search that is only asked otherwise starts from here.
//!
//! 1. Every grid centre's law is computed and transformed, at two resolutions.
//! 2. Every pair is aligned (Eq. 12 at all shifts by one inverse transform) at the lower one, in single precision.
//! 3. For each centre of the short gear the best few pairs are kept. Delta + omega / K is a lower bound of E, since
//!    max psi' >= 1 / K; a pair whose bound is above those kept is not looked at.
//! 4. The most promising are aligned at the higher resolution and judged with what the limits would cost.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::align::{Aligner, LongSpectrum, NarrowLong, NarrowShort, Ranker, ShortSpectrum};
use super::grid::{interior_grid, thinned};
use super::objective::{Candidate, Problem};
use super::sketch::Sketch;
use crate::gear::Side;
use crate::geometry::Point;

/// Samples over the long gear's turn: enough to rank centres, not to judge them.
const SAMPLES: usize = 512;
/// Least samples of one period, for pairs with a high ratio.
const SAMPLES_LEAST: usize = 64;
/// Samples of the lower resolution over those of the higher.
const THINNING: usize = 4;
/// Pairs kept for each centre of the short gear.
const KEPT_PER_ROW: usize = 24;
/// Pairs that are aligned at the higher resolution and judged with the limits' cost.
const JUDGED_PAIRS: usize = 2048;
/// Parts in which they are judged: what the first are worth spares work on the others.
const JUDGED_PARTS: usize = 8;
/// Candidates are the same when both centres lie closer than this many grid steps.
const DISTINCT_STEPS: f64 = 2.1;

/// A grid centre with its law, transformed at both resolutions.
#[derive(Debug)]
struct Seat<F, N> {
    center: Point,
    lost_area: f64,
    fine: F,
    rough: N,
    /// The law at the lower resolution.
    thin: Vec<f64>,
}

type ShortSeat = Seat<ShortSpectrum, NarrowShort>;
type LongSeat = Seat<LongSpectrum, NarrowLong>;

/// Two shapes looked at from every pair of their grids' centres.
#[derive(Debug)]
pub(super) struct Scan {
    shorts: Vec<ShortSeat>,
    longs: Vec<LongSeat>,
    /// Delta and shift (rough samples) of each pair, row by row of the short gear's centres.
    aligned: Vec<(f32, u32)>,
    /// Shift, fine samples, that each centre of the follower must have.
    shifts: Vec<Option<usize>>,
    short_side: Side,
    samples: usize,
    windows: usize,
    /// Of the short gear's grid and the long one's.
    spacing: (f64, f64),
}

/// A pair on its way through the ranking.
#[derive(Clone, Copy, Debug)]
struct Pair {
    short: usize,
    long: usize,
    estimate: f64,
}

impl Scan {
    /// Looks at the shapes of `problem` from grids of about `centers` points each.
    pub(super) fn new(problem: &Problem<'_>, centers: usize) -> Self {
        let thin = (thinned(problem.driver), thinned(problem.follower));
        let windows = problem.windows();
        let samples = (SAMPLES / windows).clamp(SAMPLES_LEAST, SAMPLES / 2).next_power_of_two();
        let problem = &problem.resampled((&thin.0, &thin.1), samples);
        let (aligner, rough) = aligners(samples, windows);
        let mean = 1.0 / problem.ratio.value();
        let (short_side, long_side) = problem.sides();
        let points = |side| if side == Side::Driver { problem.driver } else { problem.follower };
        let grid = |side| {
            let (grid, spacing) = interior_grid(points(side), centers);
            (problem.fixed.axis(side).map_or(grid, |axis| vec![axis]), spacing)
        };
        let (short_grid, short_spacing) = grid(short_side);
        let (long_grid, long_spacing) = grid(long_side);
        let shorts: Vec<ShortSeat> = short_grid
            .into_par_iter()
            .filter_map(|center| {
                problem.control.check().ok()?;
                let (law, lost_area) = problem.whole_turn(short_side, center).ok()?;
                let thin = averaged(&law);
                let rough = rough.short(thin.clone()).narrow();
                Some(Seat { center, lost_area, fine: aligner.short(law), rough, thin })
            })
            .collect();
        let longs: Vec<LongSeat> = long_grid
            .into_par_iter()
            .filter_map(|center| {
                problem.control.check().ok()?;
                let (law, lost_area) = problem.whole_turn(long_side, center).ok()?;
                let thin = averaged(&law);
                let rough = rough.long(thin.clone(), mean, true).narrow();
                Some(Seat { center, lost_area, fine: aligner.long(law, mean, true), rough, thin })
            })
            .collect();
        let followers: Vec<Point> = match short_side {
            Side::Driver => longs.iter().map(|l| l.center).collect(),
            Side::Follower => shorts.iter().map(|s| s.center).collect(),
        };
        let shifts: Vec<Option<usize>> =
            followers.par_iter().map(|f| problem.fixed_shift_samples(*f)).collect();
        let ranker = Ranker::new(samples / THINNING, windows);
        let aligned = shorts
            .par_iter()
            .enumerate()
            .map_init(
                || ranker.scratch(),
                |scratch, (i, short)| {
                    let live = longs.iter().take_while(|_| !problem.control.is_cancelled());
                    let row = live.enumerate().map(|(j, long)| {
                        let follower = if short_side == Side::Driver { j } else { i };
                        let fixed = shifts[follower].map(|s| s / THINNING);
                        ranker.best(&short.rough, &long.rough, fixed, scratch)
                    });
                    row.collect::<Vec<_>>()
                },
            )
            .flatten_iter()
            .collect();
        let spacing = (short_spacing, long_spacing);
        Self { shorts, longs, aligned, shifts, short_side, samples, windows, spacing }
    }

    /// Pairs of centres that were looked at.
    pub(super) fn pairs(&self) -> usize {
        self.aligned.len()
    }

    /// Spacings of the grids, driver's and follower's.
    pub(super) fn spacing(&self) -> (f64, f64) {
        match self.short_side {
            Side::Driver => self.spacing,
            Side::Follower => (self.spacing.1, self.spacing.0),
        }
    }

    /// Driver angle of a sample.
    pub(super) fn step(&self, problem: &Problem<'_>) -> f64 {
        TAU / f64::from(problem.ratio.driver_fold()) / self.samples as f64
    }

    /// The best distinct candidates under the weights and limits of `problem`, at most `count`.
    pub(super) fn candidates(&self, problem: &Problem<'_>, count: usize) -> Vec<Candidate> {
        let (aligner, _) = aligners(self.samples, self.windows);
        let sketch = Sketch::new(problem.folds(), problem.limits, self.samples);
        let mut pairs = self.ranked(problem);
        pairs.truncate(JUDGED_PAIRS);
        let mean = 1.0 / problem.ratio.value();
        let mut judged: Vec<(f64, &Pair, usize)> = Vec::new();
        for part in pairs.chunks(JUDGED_PAIRS / JUDGED_PARTS) {
            let worst = judged.get(KEPT_PER_ROW.max(count)).map_or(f64::INFINITY, |j| j.0);
            let scored: Vec<(f64, &Pair, usize)> = part
                .par_iter()
                .map_init(
                    || aligner.scratch(),
                    |scratch, pair| {
                        problem.control.check().ok()?;
                        let (short, long) = (&self.shorts[pair.short], &self.longs[pair.long]);
                        let at = match self.fixed_shift(pair) {
                            Some(shift) => aligner.at(&short.fine, &long.fine, shift),
                            None => aligner.best(&short.fine, &long.fine, 1, scratch),
                        };
                        let delta = at.delta + self.lost_cost(problem, pair);
                        if delta + problem.weight * mean >= worst {
                            return None;
                        }
                        let window = long.fine.window(at.shift, self.samples, mean);
                        let law = problem.blend(&short.fine.law, window);
                        let cost = sketch.of(&law);
                        Some((delta + cost.shape + problem.weight * cost.torque, pair, at.shift))
                    },
                )
                .flatten()
                .collect();
            judged.extend(scored);
            judged.sort_by(|a, b| {
                a.0.total_cmp(&b.0).then((a.1.short, a.1.long).cmp(&(b.1.short, b.1.long)))
            });
        }
        let mut kept: Vec<(Point, Point, usize)> = Vec::new();
        for (_, pair, shift) in judged {
            let (short, long) = (self.shorts[pair.short].center, self.longs[pair.long].center);
            let known = kept.iter().any(|(s, l, _)| {
                (s - short).norm() < DISTINCT_STEPS * self.spacing.0
                    && (l - long).norm() < DISTINCT_STEPS * self.spacing.1
            });
            if !known {
                kept.push((short, long, shift));
            }
            if kept.len() == count {
                break;
            }
        }
        let step = self.step(problem);
        let candidates = kept.into_iter().map(|(short, long, shift)| {
            let shift = shift as f64 * step;
            problem.pinned(match self.short_side {
                Side::Driver => Candidate { driver: short, follower: long, shift },
                Side::Follower => Candidate { driver: long, follower: short, shift },
            })
        });
        candidates.collect()
    }

    /// The best few pairs of every row by what the lower resolution says, best first.
    fn ranked(&self, problem: &Problem<'_>) -> Vec<Pair> {
        let mean = 1.0 / problem.ratio.value();
        let n = self.samples / THINNING;
        let whole = n * self.windows;
        let share = match self.short_side {
            Side::Driver => problem.balance,
            Side::Follower => 1.0 - problem.balance,
        };
        let mut pairs: Vec<Pair> = self
            .shorts
            .par_iter()
            .enumerate()
            .map_init(Vec::new, |window: &mut Vec<f64>, (i, short)| {
                let mut row: Vec<Pair> = Vec::new();
                for (j, long) in self.longs.iter().enumerate() {
                    let (delta, shift) = self.aligned[i * self.longs.len() + j];
                    let mut pair = Pair { short: i, long: j, estimate: 0.0 };
                    let delta = f64::from(delta) + self.lost_cost(problem, &pair);
                    let full = row.len() >= KEPT_PER_ROW;
                    let bound = delta + problem.weight * mean;
                    if full && row.last().is_some_and(|r| bound >= r.estimate) {
                        continue;
                    }
                    window.clear();
                    window.extend((0..n).map(|k| long.thin[(shift as usize + k) % whole]));
                    let scale = (1.0 - share) * n as f64 * mean / window.iter().sum::<f64>();
                    let blend = short.thin.iter().zip(&*window);
                    let most = blend.fold(0.0_f64, |m, (a, b)| m.max(share * a + scale * b));
                    pair.estimate = delta + problem.weight * most;
                    let place = row.partition_point(|r| r.estimate <= pair.estimate);
                    row.insert(place, pair);
                    row.truncate(KEPT_PER_ROW);
                }
                row
            })
            .flatten_iter()
            .collect();
        pairs.sort_by(|a, b| {
            a.estimate.total_cmp(&b.estimate).then((a.short, a.long).cmp(&(b.short, b.long)))
        });
        pairs
    }

    fn fixed_shift(&self, pair: &Pair) -> Option<usize> {
        self.shifts[if self.short_side == Side::Driver { pair.long } else { pair.short }]
    }

    fn lost_cost(&self, problem: &Problem<'_>, pair: &Pair) -> f64 {
        let lost = (self.shorts[pair.short].lost_area, self.longs[pair.long].lost_area);
        let (driver, follower) = match self.short_side {
            Side::Driver => lost,
            Side::Follower => (lost.1, lost.0),
        };
        problem.lost_cost(Side::Driver, driver) + problem.lost_cost(Side::Follower, follower)
    }
}

/// For laws of `samples` a period, and for the same thinned.
fn aligners(samples: usize, windows: usize) -> (Aligner, Aligner) {
    (Aligner::new(samples, windows), Aligner::new(samples / THINNING, windows))
}

/// Means of [`THINNING`] neighbours.
fn averaged(law: &[f64]) -> Vec<f64> {
    law.chunks_exact(THINNING).map(|c| c.iter().sum::<f64>() / THINNING as f64).collect()
}
