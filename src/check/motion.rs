//! The motion a pair is held against.

use super::pair::Pair;
use super::{CheckError, MotionGiven, MotionSource};
use crate::gear::{EvenMotion, Motion, MotionError, SampledMotion, Side};
use crate::input::PairRecord;
use crate::policy;
use std::f64::consts::TAU;

/// Why a list of angles is no motion.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MotionFileError {
    /// Not text, or a line that is not two numbers.
    #[error(
        "line {line} of the motion is not two finite numbers; write driver and follower angle in radians there"
    )]
    BadLine {
        /// Number of the line, from 1.
        line: usize,
    },
    /// Too few samples, or one that does not increase.
    #[error(transparent)]
    Samples(#[from] MotionError),
    /// Part of a turn.
    #[error(
        "the motion covers {turns:.4} turns of the {gear}; give whole turns of the driver that close the follower's too, angles in radians"
    )]
    NotWhole {
        /// Which gear.
        gear: Side,
        /// Turns covered.
        turns: f64,
    },
}

/// Driver and follower angles (radians) from two columns: separated by commas, semicolons, tabs or
/// blanks; a first line without numbers is a heading, what follows `#` is skipped.
///
/// # Errors
/// [`MotionFileError::BadLine`].
pub fn motion_from_columns(text: &str) -> Result<(Vec<f64>, Vec<f64>), MotionFileError> {
    let (mut driver, mut follower) = (Vec::new(), Vec::new());
    let mut heading_allowed = true;
    for (index, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let data = line.split('#').next().unwrap_or_default().trim();
        if data.is_empty() {
            continue;
        }
        let fields: Vec<Option<f64>> = data
            .split([',', ';', '\t', ' '])
            .filter(|f| !f.is_empty())
            .map(|f| f.parse().ok().filter(|v: &f64| v.is_finite()))
            .collect();
        match fields[..] {
            [Some(d), Some(f), ..] => {
                driver.push(d);
                follower.push(f);
            }
            _ if heading_allowed && data.starts_with(|c: char| c.is_alphabetic() || c == '"') => {}
            _ => return Err(MotionFileError::BadLine { line: index + 1 }),
        }
        heading_allowed = false;
    }
    Ok((driver, follower))
}

/// The motion that a pair is judged by, over its cycle.
#[derive(Debug)]
pub(super) struct Known {
    pub(super) motion: Box<dyn Motion>,
    /// The follower's phase, if it comes with the motion.
    pub(super) phase: Option<f64>,
    pub(super) source: MotionSource,
}

impl Known {
    /// Round gears, `ratio` turns of the driver for one of the follower, judged over whole turns of the driver.
    pub(super) fn even(ratio: f64, turns: f64, source: MotionSource) -> Self {
        let motion = EvenMotion { speed: 1.0 / ratio, cycle: TAU * turns };
        Self { motion: Box::new(motion), phase: None, source }
    }

    pub(super) fn sampled(motion: SampledMotion, phase: Option<f64>, source: MotionSource) -> Self {
        Self { motion: Box::new(motion), phase, source }
    }

    /// Turns of the driver for one of the follower.
    pub(super) fn ratio(&self) -> f64 {
        let cycle = self.motion.cycle();
        cycle / (self.motion.psi(cycle) - self.motion.psi(0.0))
    }
}

/// The motion that is given or recorded; `None` when contact has to tell.
pub(super) fn known(
    pair: &Pair,
    record: Option<&PairRecord>,
    given: &MotionGiven,
) -> Result<Option<Known>, CheckError> {
    match (given, record) {
        (MotionGiven::Ratio(ratio), _) => {
            if !(ratio.is_finite() && *ratio > 0.0) {
                return Err(CheckError::NotPositive { name: "ratio", value: *ratio });
            }
            let turns = ratio.max(1.0).ceil().min(f64::from(policy::CHECK_TURNS));
            Ok(Some(Known::even(*ratio, turns, MotionSource::Ratio)))
        }
        (MotionGiven::Sampled { driver, follower }, _) => {
            let motion = SampledMotion::new(driver, follower).map_err(MotionFileError::Samples)?;
            let repeats = repeats(driver, follower)?;
            Ok(Some(Known::sampled(motion.repeated(repeats), None, MotionSource::Samples)))
        }
        (MotionGiven::Unknown, Some(record)) => {
            let (driver, follower) = (&record.driver_angle, &record.follower_angle);
            let motion = SampledMotion::new(driver, follower).map_err(MotionFileError::Samples)?;
            let repeats = repeats(driver, follower)?;
            Ok(Some(Known::sampled(motion.repeated(repeats), Some(0.0), MotionSource::Record)))
        }
        (MotionGiven::Unknown, None) => {
            let turns = pair.cycle_turns();
            if !pair.is_round() && turns > policy::CHECK_TURNS {
                return Err(CheckError::LongCycle {
                    driver: pair.teeth[0].count,
                    follower: pair.teeth[1].count,
                    turns,
                    limit: policy::CHECK_TURNS,
                });
            }
            Ok(None)
        }
    }
}

/// How often samples have to be repeated until the follower is back.
fn repeats(driver: &[f64], follower: &[f64]) -> Result<u32, MotionFileError> {
    let turned = |angles: &[f64]| match (angles.first(), angles.last()) {
        (Some(first), Some(last)) => (last - first) / TAU,
        _ => 0.0,
    };
    let off = |turns: f64| (turns - turns.round()).abs() * TAU;
    let (d, f) = (turned(driver), turned(follower));
    if off(d) > policy::MOTION_CLOSES || d < 0.5 {
        return Err(MotionFileError::NotWhole { gear: Side::Driver, turns: d });
    }
    let most = (f64::from(policy::CHECK_TURNS) / d.round()).max(1.0) as u32;
    (1..=most)
        .find(|n| off(f * f64::from(*n)) <= policy::MOTION_CLOSES * f64::from(*n))
        .ok_or(MotionFileError::NotWhole { gear: Side::Follower, turns: f })
}
