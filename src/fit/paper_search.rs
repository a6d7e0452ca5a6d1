//! The paper's search (section 5.2): cells of a 3 x 3 grid, the best few refined again.

use rayon::prelude::*;

use super::align::{Aligner, LongSpectrum, ShortSpectrum};
use super::objective::{Candidate, Problem, greatest};
use crate::gear::Side;
use crate::geometry::{Point, Vector, bounds};
use crate::policy;

/// Part of a drawing's bounding box.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cell {
    low: Point,
    size: Vector,
}

impl Cell {
    fn center(&self) -> Point {
        self.low + 0.5 * self.size
    }

    fn split(&self) -> impl Iterator<Item = Cell> {
        // A cell without extent is an axis that is fixed.
        let n = if self.size == Vector::zeros() { 1 } else { policy::PAPER_GRID };
        let (low, size) = (self.low, self.size / n as f64);
        (0..n * n).map(move |i| {
            let at = Vector::new((i % n) as f64 * size.x, (i / n) as f64 * size.y);
            Cell { low: low + at, size }
        })
    }
}

/// A cell whose centre makes a law, with the law transformed.
struct Seat<T> {
    cell: Cell,
    spectrum: T,
}

/// The best centres and shifts, best first, and the number of pairs scored; none if no grid centre lies in a shape.
pub(super) fn search(problem: &Problem<'_>) -> (Vec<Candidate>, usize) {
    let aligner = Aligner::new(problem.samples, problem.windows());
    let whole = problem.samples * problem.windows();
    let stride = (whole / policy::PAPER_SHIFTS).max(1);
    let mean = 1.0 / problem.ratio.value();
    let (short_side, long_side) = match problem.short_side() {
        Side::Driver => (Side::Driver, Side::Follower),
        Side::Follower => (Side::Follower, Side::Driver),
    };
    let points = |side| if side == Side::Driver { problem.driver } else { problem.follower };
    let box_of = |side| {
        if let Some(low) = problem.fixed.axis(side) {
            return vec![Cell { low, size: Vector::zeros() }];
        }
        let (low, high) = bounds(points(side));
        vec![Cell { low, size: high - low }]
    };
    let mut parents = (box_of(short_side), box_of(long_side));
    let mut best: Vec<(f64, Cell, Cell, usize)> = Vec::new();
    let mut scored = 0;
    for _ in 0..policy::PAPER_DEPTH {
        let shorts: Vec<Seat<ShortSpectrum>> = seats(&parents.0, |c| {
            live(problem)?;
            problem.whole_turn(short_side, c).ok().map(|(law, _)| aligner.short(law))
        });
        let longs: Vec<Seat<LongSpectrum>> = seats(&parents.1, |c| {
            live(problem)?;
            problem.whole_turn(long_side, c).ok().map(|(law, _)| aligner.long(law, mean, false))
        });
        scored += shorts.len() * longs.len();
        let found: Vec<(f64, Cell, Cell, usize)> = shorts
            .par_iter()
            .map_init(
                || aligner.scratch(),
                |scratch, short| {
                    longs
                        .iter()
                        .take_while(|_| live(problem).is_some())
                        .map(|long| {
                            let follower = match short_side {
                                Side::Driver => long.cell.center(),
                                Side::Follower => short.cell.center(),
                            };
                            let at = match problem.fixed_shift_samples(follower) {
                                Some(shift) => aligner.at(&short.spectrum, &long.spectrum, shift),
                                None => {
                                    aligner.best(&short.spectrum, &long.spectrum, stride, scratch)
                                }
                            };
                            let window = long.spectrum.window(at.shift, problem.samples, mean);
                            let torque = greatest(&problem.blend(&short.spectrum.law, window));
                            (at.delta + problem.weight * torque, short.cell, long.cell, at.shift)
                        })
                        .collect::<Vec<_>>()
                },
            )
            .flatten_iter()
            .collect();
        best.extend(found);
        best.sort_by(|a, b| a.0.total_cmp(&b.0));
        best.truncate(policy::PAPER_KEPT);
        if best.is_empty() {
            // No grid centre inside: look closer.
            parents = (
                parents.0.iter().flat_map(Cell::split).collect(),
                parents.1.iter().flat_map(Cell::split).collect(),
            );
        } else {
            parents = (distinct(best.iter().map(|b| b.1)), distinct(best.iter().map(|b| b.2)));
        }
    }
    let candidates = best.iter().map(|(_, short, long, shift)| {
        let shift = *shift as f64 * problem.step();
        let (short, long) = (short.center(), long.center());
        problem.pinned(match short_side {
            Side::Driver => Candidate { driver: short, follower: long, shift },
            Side::Follower => Candidate { driver: long, follower: short, shift },
        })
    });
    (candidates.collect(), scored)
}

/// None once the search is cancelled: what it has found is then dropped.
fn live(problem: &Problem<'_>) -> Option<()> {
    problem.control.check().ok()
}

fn seats<T: Send>(parents: &[Cell], make: impl Fn(Point) -> Option<T> + Sync) -> Vec<Seat<T>> {
    let cells: Vec<Cell> = parents.iter().flat_map(Cell::split).collect();
    cells
        .into_par_iter()
        .filter_map(|cell| make(cell.center()).map(|spectrum| Seat { cell, spectrum }))
        .collect()
}

fn distinct(cells: impl Iterator<Item = Cell>) -> Vec<Cell> {
    let mut kept: Vec<Cell> = Vec::new();
    for cell in cells {
        if !kept.contains(&cell) {
            kept.push(cell);
        }
    }
    kept
}
