//! Which way the follower has to be turned so that the teeth interlock.

use super::pair::Pair;
use super::teeth::median;
use crate::gear::Motion;
use crate::policy;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Follower angles in (-pi, pi] at which the teeth interlock at a driver angle, those nearest 0
/// first.
pub(super) fn candidates(pair: &Pair, driver_angle: f64) -> Vec<f64> {
    let mut guesses = Vec::new();
    let mut angle = -PI;
    while angle < PI {
        guesses.push(angle);
        angle += pair.pitch(driver_angle, angle) / policy::PHASE_STEPS;
    }
    let mut centers: Vec<f64> = guesses
        .par_iter()
        .filter_map(|&guess| Some(pair.gap(driver_angle, guess)?.center()))
        .map(|angle| PI - (PI - angle).rem_euclid(TAU))
        .collect();
    centers.sort_by(|a, b| a.abs().total_cmp(&b.abs()).then(a.total_cmp(b)));
    let mut kept: Vec<f64> = Vec::new();
    for center in centers {
        let near = 0.25 * pair.pitch(driver_angle, center);
        let apart = |k: &f64| ((center - k + PI).rem_euclid(TAU) - PI).abs();
        if kept.iter().all(|k| apart(k) > near) {
            kept.push(center);
        }
    }
    kept
}

/// How well a phase suits a motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fitted {
    /// The phase, radians.
    pub(super) phase: f64,
    /// Share of the poses at which the teeth interlock near it.
    pub(super) share: f64,
}

/// The phase for a given motion: among the angles at which the teeth interlock at some driver angle
/// the one that goes on to do so. `None` when they never interlock.
pub(super) fn for_motion(pair: &Pair, motion: &dyn Motion) -> Option<Fitted> {
    let cycle = motion.cycle();
    let poses = |count: usize| -> Vec<f64> {
        (0..count).map(|i| (i as f64 * policy::GOLDEN_FRACTION).fract() * cycle).collect()
    };
    // A damaged place may hold no candidate; others do.
    let found = poses(8).into_iter().find_map(|at| {
        let found = candidates(pair, at);
        let back = |angle: f64| PI - (PI - angle + motion.psi(at)).rem_euclid(TAU);
        (!found.is_empty()).then(|| found.into_iter().map(back).collect::<Vec<_>>())
    });
    let Some(candidates) = found else {
        // Gears too large for each other: where they are least so, for the report to tell.
        let phase = least_overlap(pair, motion, &poses(8))?;
        return Some(Fitted { phase, share: 0.0 });
    };
    let coarse = poses(policy::PHASE_POSES);
    let tried: Vec<Fitted> =
        candidates.par_iter().map(|&phase| fitted(pair, motion, phase, &coarse)).collect();
    let best = tried.iter().map(|f| f.share).fold(0.0, f64::max);
    let chosen = tried
        .iter()
        .filter(|f| f.share >= best)
        .min_by(|a, b| a.phase.abs().total_cmp(&b.phase.abs()))?;
    let (per_tooth, most) = policy::SETTLE_POSES;
    let teeth = f64::from(pair.teeth[0].count) * cycle / TAU;
    let count = ((per_tooth * teeth) as usize).clamp(policy::PHASE_POSES, most);
    Some(fitted(pair, motion, chosen.phase, &poses(count)))
}

/// The phase of least overlap over some poses, if it stays below [`policy::DEEP_INTERFERENCE`].
fn least_overlap(pair: &Pair, motion: &dyn Motion, poses: &[f64]) -> Option<f64> {
    let limit = policy::DEEP_INTERFERENCE * pair.module;
    let mut guesses = Vec::new();
    // One gap is as good as another on round gears.
    let end = if pair.is_round() { -PI + TAU / f64::from(pair.teeth[1].count) } else { PI };
    let mut angle = -PI;
    while angle < end {
        guesses.push(angle);
        angle += pair.pitch(0.0, angle) / policy::LEAST_OVERLAP_STEPS;
    }
    let overlap = |&phase: &f64| -> Option<(f64, f64)> {
        let mut worst = 0.0_f64;
        for &at in poses {
            worst = worst.max(pair.depth(at, phase + motion.psi(at)));
            if worst > limit {
                return None;
            }
        }
        Some((worst, phase))
    };
    let tried: Vec<(f64, f64)> = guesses.par_iter().filter_map(overlap).collect();
    tried.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, phase)| phase)
}

/// Moves a phase to the middle of what all poses leave free, or to the middle of their middles where
/// they contradict each other.
fn fitted(pair: &Pair, motion: &dyn Motion, phase: f64, poses: &[f64]) -> Fitted {
    let gaps: Vec<[f64; 3]> = poses
        .par_iter()
        .filter_map(|&at| {
            let psi = motion.psi(at);
            let gap = pair.gap(at, phase + psi)?;
            let stray = (gap.center() - psi - phase).abs() / pair.pitch(at, phase + psi);
            let believed = stray <= policy::PHASE_STRAY;
            believed.then(|| [gap.from - psi, gap.to - psi, gap.center() - psi])
        })
        .collect();
    let share = gaps.len() as f64 / poses.len().max(1) as f64;
    let from = gaps.iter().map(|g| g[0]).fold(f64::NEG_INFINITY, f64::max);
    let to = gaps.iter().map(|g| g[1]).fold(f64::INFINITY, f64::min);
    let middle = if from <= to {
        Some(0.5 * (from + to)).filter(|m| m.is_finite())
    } else {
        median(gaps.iter().map(|g| g[2]).collect())
    };
    Fitted { phase: middle.unwrap_or(phase), share }
}
