//! The searches on the dense grid: every pair at every shift, then, unless it is only to be a coarse answer, continuous refinement.
//!
//! 1. [`Scan::candidates`] gives the best distinct pairs of grid centres.
//! 2. The best few and the winner of the paper's search are refined, centres and shift moving continuously, first at a quarter of
//!    the resolution, then in full. On the way the cost of the limits is sketched.
//! 3. The ends are judged in full. The paper's winner is among them, so this search never ends above it.

use rayon::prelude::*;

use super::grid::thinned;
use super::limits::Limits;
use super::objective::{Candidate, Problem};
use super::scan::Scan;
use super::{paper_search, refine};
use crate::control::StageName;
use crate::geometry::Point;
use crate::policy;

/// Distinct candidates that leave the scan.
pub(super) const KEPT_CANDIDATES: usize = 20;
/// Candidates of a coarse search that are judged in full.
const COARSE_JUDGED: usize = 3;
/// Candidates refined continuously.
const STARTS: usize = 10;
/// First step of the shift in a refinement, samples of the scan.
const SHIFT_STEP: f64 = 2.0;
/// Samples of a first refinement over those of the fit.
const FIRST_SAMPLES: usize = 4;
/// Evaluations of one first refinement.
const FIRST_EVALUATIONS: usize = 140;
/// Ends of it that are refined at full resolution.
const ENDS: usize = 3;
/// First steps of the second refinement over those of the first.
const SECOND_STEPS: f64 = 0.1;
/// Evaluations of one second refinement.
const SECOND_EVALUATIONS: usize = 100;

/// What a search found.
pub(super) struct Found {
    /// The best candidate, then places worth refining; none if no centre serves.
    pub(super) candidates: Vec<Candidate>,
    /// Pairs of centres scored.
    pub(super) pairs: usize,
}

/// The scan's best candidates, those judged in full first.
pub(super) fn coarse(problem: &Problem<'_>, scan: &Scan, count: usize) -> Found {
    let mut seeds = scan.candidates(problem, count);
    let rest = seeds.split_off(seeds.len().min(COARSE_JUDGED));
    let mut candidates = ranked(problem, seeds, COARSE_JUDGED);
    candidates.extend(rest);
    Found { candidates, pairs: scan.pairs() }
}

/// The best centres and shift, then the paper's, then the scan's best `count`.
pub(super) fn global(problem: &Problem<'_>, scan: &Scan, count: usize) -> Found {
    let (paper, paper_pairs) = paper_search::search(problem);
    let paper = paper.first();
    // Rounding corners costs little and hardly depends on the centres, but is slow to work out: only the finalists are judged by it.
    let limits = Limits { max_curvature: None, ..*problem.limits };
    let unrounded = problem.with_limits(&limits);
    problem.control.progress(StageName::Wanted, 0.2);
    let seeds = scan.candidates(&unrounded, count);
    problem.control.progress(StageName::Wanted, 0.3);
    let mut finalists = finalists(&unrounded, scan, paper, &seeds);
    problem.control.progress(StageName::Wanted, 0.5);
    finalists.extend(paper);
    let mut candidates = ranked(problem, finalists, 1);
    candidates.extend(paper);
    candidates.extend(seeds);
    Found { candidates, pairs: paper_pairs + scan.pairs() }
}

/// The best `kept` of some candidates, judged in full.
fn ranked(problem: &Problem<'_>, candidates: Vec<Candidate>, kept: usize) -> Vec<Candidate> {
    sorted(candidates, kept, |c| problem.total(c))
}

fn sorted(
    candidates: Vec<Candidate>,
    kept: usize,
    value: impl Fn(&Candidate) -> f64 + Sync,
) -> Vec<Candidate> {
    let mut scored: Vec<(f64, Candidate)> =
        candidates.into_par_iter().map(|c| (value(&c), c)).collect();
    scored.retain(|s| s.0.is_finite());
    scored.sort_by(|a, b| a.0.total_cmp(&b.0));
    scored.truncate(kept);
    scored.into_iter().map(|s| s.1).collect()
}

/// The best candidates after refinement.
fn finalists(
    problem: &Problem<'_>,
    scan: &Scan,
    paper: Option<&Candidate>,
    seeds: &[Candidate],
) -> Vec<Candidate> {
    let mut starts = sorted(seeds.to_vec(), STARTS, |c| problem.sketched(c));
    starts.extend(paper);
    let spacing = scan.spacing();
    let steps =
        Steps { driver: spacing.0, follower: spacing.1, shift: SHIFT_STEP * scan.step(problem) };
    let thin = (thinned(problem.driver), thinned(problem.follower));
    let samples = (problem.samples / FIRST_SAMPLES).max(policy::FIT_SAMPLES_LEAST);
    let first = problem.resampled((&thin.0, &thin.1), samples);
    let mut ends: Vec<Candidate> =
        starts.par_iter().map(|c| refined(&first, c, &steps, FIRST_EVALUATIONS)).collect();
    ends.extend(&starts);
    let ends = sorted(ends, ENDS, |c| problem.sketched(c));
    let fine = steps.shrunk(SECOND_STEPS);
    let mut all: Vec<Candidate> =
        ends.par_iter().map(|c| refined(problem, c, &fine, SECOND_EVALUATIONS)).collect();
    all.extend(ends);
    ranked(problem, all, ENDS)
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
    let (x, _) = refine::simplex(at, by, evaluations, |x| problem.sketched(&unpack(x)));
    unpack(&x)
}
