//! Repairs: what is tried when a pair fails, in which order, and what is taken.
//!
//! 1. Teeth that do not mesh ask for gentler pitch curves: rounder corners, less slope, up to [`GENTLER_TRIES`] times. Of
//!    all attempts the best is taken, so a repair never makes a pair worse.
//! 2. Teeth that mesh but fail their proof (backlash, transmission error, runs) ask for less slope, by
//!    [`LESS_SLOPE`]: a pair of two shapes is fitted anew under the lower bound, a motion or a mate is bent to it. Only
//!    a pair that passes is taken.
//!
//! Every try is told as a [`Revision`], whether it was taken or not.

use std::sync::Arc;

use super::PipelineError;
use super::analysed::{Analysed, is_of_the_teeth};
use super::bounds::{Bounds, SLOPE_REPAIR};
use super::proven::Proven;
use super::request::Source;
use super::session::Work;
use super::wanted::Wanted;
use crate::control::StageName;
use crate::diagnose::{Code, Diagnostic, Severity};

/// Gentler settings tried at most, so that the work stays bounded.
const GENTLER_TRIES: usize = 4;
/// Taken from the bound on the slope, radians (5 and 15 degrees), for the pairs that are tried when the first one fails
/// its proof: a little often helps, and where it does not a little more seldom does.
const LESS_SLOPE: [f64; 2] = [SLOPE_REPAIR, 3.0 * SLOPE_REPAIR];

/// One repair that was tried.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Revision {
    /// What was tried, as a note: [`Code::GentlerTeeth`] or [`Code::LessSlope`].
    pub note: Diagnostic,
    /// What was wrong with the pair before.
    pub why: Vec<Code>,
    /// Bounds that were tried.
    pub bounds: Bounds,
    /// Whether the pair that it gave took the place of the one before.
    pub taken: bool,
}

/// What the repairs led to.
#[derive(Clone, Debug)]
pub(super) struct Settled {
    pub(super) analysed: Arc<Analysed>,
    pub(super) proven: Option<Arc<Proven>>,
    pub(super) revisions: Vec<Revision>,
}

/// The best pair that can be made of a request, analysed at all poses, and proven if `prove` says so.
pub(super) fn settled(work: &mut Work<'_>, prove: bool) -> Result<Settled, PipelineError> {
    let asked = work.options().fit.limits.max_lean;
    let wanted = work.wanted(asked)?;
    let mut revisions = Vec::new();
    let analysed = gentle_enough(work, &wanted, asked, &mut revisions)?;
    if !prove {
        return Ok(Settled { analysed, proven: None, revisions });
    }
    let last_bounds = analysed.toothed.sized.bounds;
    let mut best = work.proven(&analysed)?;
    for less in LESS_SLOPE {
        let why = faults(best.findings());
        if !work.options().repair || why.is_empty() || why.iter().any(|c| is_of_the_teeth(*c)) {
            break;
        }
        let mut inner = Vec::new();
        let next = match &work.request().source {
            Source::TwoShapes { .. } => work
                .wanted(asked - less)
                .and_then(|wanted| gentle_enough(work, &wanted, asked - less, &mut inner)),
            _ => bent(work, &wanted, &best, last_bounds.with_less_slope(less)),
        };
        let next = next.and_then(|analysed| work.proven(&analysed));
        let bounds = match (&next, &work.request().source) {
            (Ok(next), _) => next.analysed.toothed.sized.bounds,
            (Err(_), _) => last_bounds.with_less_slope(less),
        };
        let held = match &work.request().source {
            Source::TwoShapes { .. } => asked - less,
            _ => bounds.max_lean,
        };
        let causes: Vec<&str> = why.iter().map(|c| c.word()).collect();
        let note = Diagnostic::note(Code::LessSlope, StageName::Sized)
            .about(causes.join(", "))
            .with("slope", held);
        let taken = match next {
            Err(error) if error.is_cancelled() => return Err(error),
            // Where no teeth fit at all the first pair is what there is.
            Err(_) => false,
            Ok(next) => {
                let taken = next.is_sound();
                if taken {
                    if matches!(work.request().source, Source::TwoShapes { .. }) {
                        // What was tried with the first fit says nothing of this one.
                        revisions.iter_mut().for_each(|r: &mut Revision| r.taken = false);
                        revisions.append(&mut inner);
                    }
                    best = next;
                }
                taken
            }
        };
        revisions.push(Revision { note, why, bounds, taken });
    }
    Ok(Settled { analysed: best.analysed.clone(), proven: Some(best), revisions })
}

/// Attempts with gentler and gentler bounds until one is good; the best of them.
fn gentle_enough(
    work: &mut Work<'_>,
    wanted: &Arc<Wanted>,
    max_lean: f64,
    revisions: &mut Vec<Revision>,
) -> Result<Arc<Analysed>, PipelineError> {
    let mut bounds = Bounds::first(wanted, max_lean);
    let sized = work.sized(wanted, bounds, None)?;
    let teeth = sized.teeth.driver;
    let toothed = work.toothed(&sized)?;
    let mut best = work.analysed(&toothed, true)?;
    if work.options().repair {
        for _ in 0..GENTLER_TRIES {
            if best.is_good() {
                best = confirmed(work, &best)?;
                if best.is_good() {
                    break;
                }
            }
            let (next, note) = bounds.gentler(best.toothed.sized.centrodes.max_lean());
            bounds = next;
            let attempt = work
                .sized(wanted, bounds, Some(teeth))
                .and_then(|sized| work.toothed(&sized))
                .and_then(|toothed| work.analysed(&toothed, true));
            let attempt = match attempt {
                Err(error) if error.is_cancelled() => return Err(error),
                // What cannot be made is no reason to give up what has been.
                Err(_) => continue,
                Ok(attempt) => attempt,
            };
            let taken = attempt.badness() < best.badness();
            let (before, after) = (best.tooth_error(), attempt.tooth_error());
            let note = note.with("before", before).with("after", after);
            let why = faults_and_errors(&best);
            revisions.push(Revision { note, why, bounds, taken });
            if taken {
                best = attempt;
            }
        }
    }
    confirmed(work, &best)
}

/// One attempt at a motion or a mate with its pitch curves bent to lower bounds.
fn bent(
    work: &mut Work<'_>,
    wanted: &Arc<Wanted>,
    before: &Proven,
    bounds: Bounds,
) -> Result<Arc<Analysed>, PipelineError> {
    let teeth = before.analysed.toothed.sized.teeth.driver;
    let sized = work.sized(wanted, bounds, Some(teeth))?;
    let toothed = work.toothed(&sized)?;
    let tried = work.analysed(&toothed, true)?;
    confirmed(work, &tried)
}

/// The same pair analysed at every pose that a delivered pair is judged by.
fn confirmed(work: &mut Work<'_>, best: &Arc<Analysed>) -> Result<Arc<Analysed>, PipelineError> {
    if work.options().quick { Ok(best.clone()) } else { work.analysed(&best.toothed, false) }
}

fn faults<'a>(found: impl Iterator<Item = &'a Diagnostic>) -> Vec<Code> {
    found.filter(|d| d.severity == Severity::Fault).map(|d| d.code).collect()
}

fn faults_and_errors(analysed: &Analysed) -> Vec<Code> {
    let needs = |d: &&Diagnostic| d.severity == Severity::Fault || d.code == Code::ToothError;
    analysed.diagnostics.iter().filter(needs).map(|d| d.code).collect()
}
