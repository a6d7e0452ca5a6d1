//! How far the loaded follower lags: enough for the clearance everywhere, and slowly changing.
//!
//! A lag `b` of the follower opens a flank by `b r_F cos(a)`, with `a` its working pressure angle
//! (`alpha + sigma slope`). The clearance asks for `2 c` on the flank that carries, hence for the lag
//! `2 c / (r_F cos a)`. That need jumps from flank to flank; a motion has to be smooth to generate
//! flanks, so it is widened over a pitch to either side, limited in its rate, and averaged over no
//! more than it was widened: the result lies nowhere below the need.

use super::layout::{Layout, Rack};
use super::motions::{LoadedMotion, Motions};
use crate::pitch::Transmission;

/// Least cosine of the working pressure angle that the lag is reckoned with: the full gap up to 60
/// degrees, half of it up to 75. A lower one swings the follower for a few steep flanks.
const LEAST_COSINE: f64 = 0.5;
/// Fastest change of the lag, as a share of the follower's speed: the driver's torque changes by this
/// share meanwhile. Faster is less play, but a less even drive.
const FASTEST_CHANGE: f64 = 0.03;
/// The lag is kept within this share of a pitch (arc at the pitch point) of its greatest, for the
/// follower strays by their difference. Less would add play where none is needed.
const MOST_CHANGE: f64 = 0.05;
/// Half width over which the lag is smoothed, in pitches: less leaves bends that flanks of one tooth
/// height cannot follow.
const SMOOTHING: f64 = 1.0;
/// Passes of the moving average that share that width: three make a curve with two derivatives.
const AVERAGES: usize = 3;

/// The motion in which flanks of hand `sigma` carry with `rack.clearance` on both gears. `None` where no
/// motion lags so far and still turns forwards.
pub(crate) fn loaded_motion(
    motions: &Motions,
    layout: &Layout,
    rack: &Rack,
    sigma: f64,
) -> Option<LoadedMotion> {
    let centrodes = motions.designed().centrodes();
    let t = &centrodes.transmission;
    let speed = t.samples();
    let count = speed.len();
    let step = t.driver_period() / count as f64;
    let pitches = layout.period / rack.pitch;
    let half = (SMOOTHING * count as f64 / (pitches * AVERAGES as f64)).round().max(1.0) as usize;
    let radius: Vec<f64> = (0..count).map(|i| centrodes.follower_radius(i as f64 * step)).collect();
    let mut need = needed(motions, layout, rack, sigma);
    let arc = |(lag, r): (&f64, &f64)| lag * r;
    let greatest = need.iter().zip(&radius).map(arc).fold(0.0, f64::max);
    let least = greatest - MOST_CHANGE * rack.pitch;
    for (need, r) in need.iter_mut().zip(&radius) {
        *need = need.max(least / r);
    }
    let mut lag = limited(&widened(&need, AVERAGES * half), speed, FASTEST_CHANGE * step);
    for _ in 0..AVERAGES {
        lag = averaged(&lag, half);
    }
    let at = |i: usize, by: isize| lag[(i as isize + by).rem_euclid(count as isize) as usize];
    let samples: Vec<f64> = (0..count)
        .map(|i| {
            let slope = (8.0 * (at(i, 1) - at(i, -1)) - (at(i, 2) - at(i, -2))) / (12.0 * step);
            speed[i] + sigma * slope
        })
        .collect();
    let loaded =
        Transmission::from_derivative(&samples, t.driver_fold(), t.follower_fold()).ok()?;
    Some(LoadedMotion::new(loaded, sigma * lag[0]))
}

/// The lag that the flanks of one hand need, radians, at the samples of the motion: that of the flank
/// which needs least among those in contact, for it is the one that carries.
fn needed(motions: &Motions, layout: &Layout, rack: &Rack, sigma: f64) -> Vec<f64> {
    let own = motions.of(sigma);
    let centrodes = own.centrodes();
    let count = motions.designed().centrodes().transmission.samples().len();
    let step = centrodes.transmission.driver_period() / count as f64;
    let mut need = vec![f64::INFINITY; count];
    for flank in layout.flanks.iter().filter(|f| f.sigma == sigma) {
        let (from, to) = flank.active();
        let (from, to) = (own.driver_angle(from), own.driver_angle(to));
        let (first, last) = ((from / step).floor() as i64, (to / step).ceil() as i64);
        for k in first..=last {
            let phi = (k as f64 * step).clamp(from, to);
            let working = flank.alpha + sigma * centrodes.lean(phi);
            let lever = centrodes.follower_radius(phi) * working.cos().max(LEAST_COSINE);
            let need = &mut need[k.rem_euclid(count as i64) as usize];
            *need = need.min(2.0 * rack.clearance / lever);
        }
    }
    // Where nothing touches, what comes before and after decides.
    need.into_iter().map(|n| if n.is_finite() { n } else { 0.0 }).collect()
}

/// The greatest of the values up to `half` samples away, periodic.
fn widened(values: &[f64], half: usize) -> Vec<f64> {
    windows(values, half).map(|window| window.fold(0.0, f64::max)).collect()
}

/// The mean of the values up to `half` samples away, periodic.
fn averaged(values: &[f64], half: usize) -> Vec<f64> {
    let width = (2 * half + 1) as f64;
    windows(values, half).map(|window| window.sum::<f64>() / width).collect()
}

fn windows(values: &[f64], half: usize) -> impl Iterator<Item = impl Iterator<Item = f64>> {
    let n = values.len();
    let before = n - half % n;
    (0..n).map(move |i| (0..=2 * half).map(move |d| values[(i + before + d) % n]))
}

/// The least values at or above `values` that change by no more than `most` times the speed from one
/// sample to the next, periodic.
fn limited(values: &[f64], speed: &[f64], most: f64) -> Vec<f64> {
    let n = values.len();
    let mut lag = values.to_vec();
    // Twice round: what begins before the period's end reaches into its beginning.
    for k in 0..2 * n {
        let (last, here) = (k % n, (k + 1) % n);
        lag[here] = lag[here].max(lag[last] - most * speed[here]);
    }
    for k in (0..2 * n).rev() {
        let (here, next) = (k % n, (k + 1) % n);
        lag[here] = lag[here].max(lag[next] - most * speed[here]);
    }
    lag
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lag_changes_slowly_and_is_nowhere_too_small() {
        let need: Vec<f64> = (0..200_u32).map(|i| if i % 37 < 5 { 0.1 } else { 0.02 }).collect();
        let speed = vec![2.0; 200];
        let half = 4;
        let mut lag = limited(&widened(&need, 3 * half), &speed, 1e-3);
        for _ in 0..3 {
            lag = averaged(&lag, half);
        }
        for i in 0..200 {
            assert!(lag[i] >= need[i] - 1e-12, "{i}: {} {}", lag[i], need[i]);
            assert!((lag[(i + 1) % 200] - lag[i]).abs() <= 2e-3 + 1e-12, "{i}");
        }
    }
}
