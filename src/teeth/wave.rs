//! The paper's teeth (section 5.3): a wave along the driver's pitch curve, the follower carved.

use super::carve::carve;
use super::profile::{EdgeKind, Profile};
use super::rolling::Rolling;
use super::{TeethError, TeethOptions, ToothedPair};
use crate::gear::Side;
use crate::geometry::{Point, rotate};
use crate::pitch::Centrodes;
use crate::policy;

/// Wave teeth with heights by Eq. 17, `h = s/2 tan(lean) + rho`, never lower than a regular tooth; the
/// follower is what the moving driver leaves of a blank (section 3.3 (iii)).
///
/// # Errors
/// See [`TeethError`].
pub fn wave_pair(centrodes: &Centrodes, options: &TeethOptions) -> Result<ToothedPair, TeethError> {
    carved_waves(centrodes, options, &|lean, module| {
        0.5 * std::f64::consts::PI * module * lean.abs().tan() + policy::WAVE_TOLERANCE * module
    })
}

/// Wave teeth of one height, whatever the lean: the paper's regular teeth, which Eq. 17 improves on.
///
/// # Errors
/// See [`TeethError`].
pub fn regular_wave_pair(
    centrodes: &Centrodes,
    options: &TeethOptions,
) -> Result<ToothedPair, TeethError> {
    carved_waves(centrodes, options, &|_, _| 0.0)
}

/// Waves as high as `wanted` (mm) for a lean (radians) and a module (mm), within the bounds on any wave.
fn carved_waves(
    centrodes: &Centrodes,
    options: &TeethOptions,
    wanted: &(dyn Fn(f64, f64) -> f64 + Sync),
) -> Result<ToothedPair, TeethError> {
    let made = options.control.run(|| waves(centrodes, options, wanted));
    options.control.check()?;
    made
}

fn waves(
    centrodes: &Centrodes,
    options: &TeethOptions,
    wanted: &(dyn Fn(f64, f64) -> f64 + Sync),
) -> Result<ToothedPair, TeethError> {
    let rolling = Rolling::new(centrodes);
    let folds = centrodes.transmission.driver_fold();
    let teeth = options.teeth_per_period(folds)?;
    let pitch = rolling.period() / teeth as f64;
    let module = pitch / std::f64::consts::PI;
    let heights: Vec<f64> = (0..teeth)
        .map(|j| {
            let lean = centrodes.lean(rolling.driver_angle(j as f64 * pitch));
            let regular = policy::WAVE_HEIGHT * options.addendum * module;
            wanted(lean, module).min(policy::WAVE_TALLEST * module).max(regular)
        })
        .collect();
    // Height at any arc length: a smooth blend between the teeth on either side.
    let height = |s: f64| {
        let at = s / pitch;
        let (j, t) = (at.floor(), at - at.floor());
        let pick = |k: f64| heights[(k as i64).rem_euclid(teeth as i64) as usize];
        let t = 0.5 * (1.0 - (std::f64::consts::PI * t).cos());
        pick(j) + t * (pick(j + 1.0) - pick(j))
    };
    let steps = policy::WAVE_POINTS_PER_TOOTH;
    let wave = |side: Side, folds: u32, shape: &dyn Fn(f64) -> f64| -> Vec<Point> {
        let one: Vec<Point> = (0..teeth * steps)
            .map(|i| {
                let s = i as f64 * pitch / steps as f64;
                let frame = rolling.at(s).local(side);
                frame.at + shape(s) * frame.normal
            })
            .collect();
        let turn = -side.sign() * std::f64::consts::TAU / f64::from(folds);
        let mut all: Vec<Point> = (0..folds)
            .flat_map(|k| one.iter().map(move |p| rotate(*p, turn * f64::from(k))))
            .collect();
        if side == Side::Driver {
            all.reverse();
        }
        all
    };
    let phase = |s: f64| (std::f64::consts::TAU * s / pitch).cos();
    let driver = wave(Side::Driver, folds, &|s| 0.5 * height(s) * phase(s));
    let follower_fold = centrodes.transmission.follower_fold();
    let blank = wave(Side::Follower, follower_fold, &|s| 0.5 * height(s));
    let label = |points: Vec<Point>| {
        let kinds = vec![EdgeKind::Flank; points.len()];
        Profile { points, kinds }
    };
    let driver = label(driver).untangled().ok_or(TeethError::Tangled { gear: Side::Driver })?;
    let blank = label(blank).untangled().ok_or(TeethError::Tangled { gear: Side::Follower })?;
    let carved = carve(
        &rolling,
        &driver.points,
        &blank.points,
        (
            rolling.period() * f64::from(centrodes.transmission.cycle_periods()),
            policy::CARVE_INSTANTS_PER_TOOTH
                * teeth
                * centrodes.transmission.cycle_periods() as usize,
        ),
        policy::CARVE_DEPTH * module,
        false,
        &options.control,
    )?
    .ok_or(TeethError::Tangled { gear: Side::Follower })?;
    let cuts = carved.cuts;
    let follower = label(carved.outline).without_short_edges(policy::SHORTEST_EDGE * module);
    Ok(ToothedPair {
        driver,
        follower,
        module,
        uncovered: [0.0; 2],
        cuts,
        records: Vec::new(),
        loaded: None,
    })
}
