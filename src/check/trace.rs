//! The motion that contact forces on a follower, when nobody tells it.

use super::pair::Pair;
use super::phase::candidates;
use super::teeth::median;
use crate::gear::SampledMotion;
use crate::policy;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// A motion found by contact.
#[derive(Clone, Debug)]
pub(super) struct Traced {
    /// Follower angle at driver angle 0, radians.
    pub(super) phase: f64,
    /// psi over one whole cycle of both gears.
    pub(super) motion: SampledMotion,
}

/// Where and why no motion could be found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Untraced {
    /// The teeth never interlock at driver angle 0.
    NoStart,
    /// The trace stopped at this driver angle, radians.
    Stopped { at: f64 },
    /// After a whole cycle of the driver the follower is off by so many pitches.
    NotClosed { pitches: f64 },
}

/// One step of a trace.
#[derive(Clone, Copy, Debug)]
struct Sample {
    driver_angle: f64,
    /// Middle of the gap, or where it should be.
    center: f64,
    /// Width of the gap in pitches.
    width: f64,
    believed: bool,
}

struct Trace {
    samples: Vec<Sample>,
    /// Share of the cycle that was believed.
    share: f64,
    /// First stop, driver angle.
    stopped: Option<f64>,
}

/// Traces the motion: the driver is turned in small steps and the middle of the gap is followed;
/// where there is none the middle lines carry on. Then it is smoothed over a tooth.
pub(super) fn traced(pair: &Pair, phase: Option<f64>) -> Result<Traced, Untraced> {
    let starts = phase.map_or_else(|| candidates(pair, 0.0), |p| vec![p]);
    let tries: Vec<(f64, Trace)> =
        starts.par_iter().map(|&start| (start, follow(pair, start, true))).collect();
    let best = tries.iter().map(|(_, t)| t.share).fold(0.0, f64::max);
    let chosen = tries
        .into_iter()
        .filter(|(_, t)| t.share > best - 0.02)
        .min_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
    let (start, first) = chosen.ok_or(Untraced::NoStart)?;
    let mut trace = follow(pair, start, false);
    doubt_wide_gaps(&mut trace.samples);
    if trace.share < policy::TRACE_SHARE {
        let at = first.stopped.or(trace.stopped).unwrap_or(0.0);
        return Err(Untraced::Stopped { at });
    }
    let last = trace.samples[trace.samples.len() - 1];
    let turn = last.center - trace.samples[0].center;
    let whole = TAU * (f64::from(pair.cycle_turns()) / pair.ratio()).round();
    let pitch = TAU / f64::from(pair.teeth[1].count);
    if (turn - whole).abs() > 0.5 * pitch {
        return Err(Untraced::NotClosed { pitches: (turn - whole) / pitch });
    }
    let mut follower = smoothed(pair, &trace.samples, whole);
    kept_clear(pair, &trace.samples, &mut follower, whole);
    let driver: Vec<f64> = trace.samples.iter().map(|s| s.driver_angle).collect();
    let psi: Vec<f64> = follower.iter().map(|f| f - follower[0]).collect();
    let motion = SampledMotion::new(&driver, &psi);
    let motion = motion.map_err(|_| Untraced::Stopped { at: trace.stopped.unwrap_or(0.0) })?;
    Ok(Traced { phase: follower[0], motion })
}

/// Follows the gap through one cycle of both gears.
fn follow(pair: &Pair, start: f64, impatient: bool) -> Trace {
    let cycle = TAU * f64::from(pair.cycle_turns());
    let teeth = f64::from(pair.cycle_turns() * pair.teeth[0].count);
    let steps = (policy::TRACE_STEPS * teeth) as usize;
    let step = cycle / steps as f64;
    let mut samples = Vec::with_capacity(steps + 1);
    let mut center = start;
    let mut missed = 0;
    let mut believed_steps = 0;
    let mut stopped = None;
    for i in 0..=steps {
        let driver_angle = step * i as f64;
        if i > 0 {
            let before = driver_angle - 0.5 * step;
            let [driver, follower] = pair.radii(before, center);
            center += step * driver / follower;
        }
        let pitch = pair.pitch(driver_angle, center);
        let gap = pair.gap(driver_angle, center).filter(|gap| {
            let stray = (gap.center() - center).abs() / pitch;
            // After a stretch without contact the expectation itself has drifted.
            let allowed = policy::TRACE_STRAY + 0.01 * missed.min(10) as f64;
            stray <= allowed && gap.to - gap.from <= policy::TRACE_WIDEST * pitch
        });
        if let Some(gap) = gap {
            center = gap.center();
            missed = 0;
            believed_steps += 1;
        } else {
            missed += 1;
            stopped = stopped.or(Some(driver_angle));
        }
        let width = gap.map_or(0.0, |gap| (gap.to - gap.from) / pitch);
        samples.push(Sample { driver_angle, center, width, believed: gap.is_some() });
        if impatient && missed > policy::TRACE_PATIENCE {
            break;
        }
    }
    Trace { samples, share: f64::from(believed_steps) / (steps + 1) as f64, stopped }
}

/// Where teeth are missing the gap is wide, and its middle is not where the teeth would hold it.
fn doubt_wide_gaps(samples: &mut [Sample]) {
    let widths = samples.iter().filter(|s| s.believed).map(|s| s.width).collect();
    let Some(typical) = median(widths) else { return };
    let widest = typical + policy::TRACE_WIDE;
    samples.iter_mut().filter(|s| s.width > widest).for_each(|s| s.believed = false);
}

/// Local cubic regression over the believed samples, round the cycle; closes by `whole`.
fn smoothed(pair: &Pair, samples: &[Sample], whole: f64) -> Vec<f64> {
    let n = samples.len() - 1;
    let cycle = samples[n].driver_angle - samples[0].driver_angle;
    let mean = whole / cycle;
    let rest = |s: &Sample| s.center - mean * s.driver_angle;
    let step = cycle / n as f64;
    let fit = |i: usize| -> f64 {
        let here = samples[i];
        let radius = pair.radii(here.driver_angle, here.center)[0];
        let mut reach = policy::TRACE_WINDOW * PI * pair.module / radius;
        // Where little is believed the window widens until it sees enough.
        for _ in 0..6 {
            let count = ((reach / step) as usize).clamp(4, n / 2);
            let window: Vec<(f64, f64, f64)> = (i + n - count..=i + n + count)
                .map(|j| (j as f64 - (i + n) as f64, &samples[j % n]))
                .filter(|(_, s)| s.believed)
                .map(|(d, s)| {
                    let t = d / (count + 1) as f64;
                    (t, rest(s), (1.0 - t.abs().powi(3)).powi(3))
                })
                .collect();
            // From one side alone a cubic would run away.
            let ahead = window.iter().filter(|(t, ..)| *t >= 0.0).count();
            if window.len() > count
                && ahead.min(window.len() - ahead) >= count.div_ceil(4)
                && let Some(value) = cubic_at_zero(&window)
            {
                return value;
            }
            reach *= 1.6;
        }
        rest(&here)
    };
    let mut values: Vec<f64> = (0..n).into_par_iter().map(fit).collect();
    values.push(values[0]);
    values.iter().zip(samples).map(|(v, s)| v + mean * s.driver_angle).collect()
}

/// Moves what smoothing has pushed out of a gap back into it: contact would do so too.
fn kept_clear(pair: &Pair, samples: &[Sample], follower: &mut [f64], whole: f64) {
    follower.par_iter_mut().zip(samples).for_each(|(angle, sample)| {
        if let Some(gap) = pair.gap(sample.driver_angle, *angle) {
            let margin = policy::TRACE_MARGIN * (gap.to - gap.from);
            let (least, most) = (gap.from + margin, gap.to - margin);
            *angle = if least < most { angle.clamp(least, most) } else { gap.center() };
        }
    });
    let last = follower.len() - 1;
    follower[last] = follower[0] + whole;
}

/// Value at 0 of the cubic that fits (place, value, weight) best.
fn cubic_at_zero(window: &[(f64, f64, f64)]) -> Option<f64> {
    let mut normal = nalgebra::Matrix4::<f64>::zeros();
    let mut right = nalgebra::Vector4::<f64>::zeros();
    for &(t, value, weight) in window {
        let powers = nalgebra::Vector4::new(1.0, t, t * t, t * t * t);
        normal += weight * powers * powers.transpose();
        right += weight * value * powers;
    }
    Some(normal.cholesky()?.solve(&right)[0])
}
