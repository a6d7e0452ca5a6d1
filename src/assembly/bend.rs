//! The bend at which the gears of a chain turn most evenly.
//!
//! Each mesh speeds the next gear up where the one before has slowed it down, or makes it worse: that depends on how the
//! lines of centres turn from mesh to mesh. The greatest ratio of the speeds of two gears of which one drives the other
//! is the torque with which a load on the one holds back the other, so a chain is bent where that ratio is least.

use super::train::toward;
use super::{Layout, Link, PairModel, Train, TrainError, TrainPlan};
use crate::gear::Side;
use crate::geometry::Point;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Bends are tried by whole degrees from this to its opposite: beyond it gears meet their next but one.
const SHARPEST: i32 = 60;
/// Poses of a cycle at which speeds are compared while bends are tried.
const POSES: usize = 240;
/// Ratios of speeds closer than this count as the same, and the weaker bend is taken.
const SAME_RATIO: f64 = 1e-6;

/// A layout of a chain by its bend, such as [`Layout::ZigZag`].
pub type Bent = fn(f64) -> Layout;

/// A chain bent as well as can be.
#[derive(Clone, Debug)]
pub struct BentChain {
    /// How it runs.
    pub layout: Layout,
    /// The greatest ratio of the speeds of two of its gears of which one drives the other.
    pub ratio: f64,
    /// The chain.
    pub plan: TrainPlan,
    /// Its gears on their axles.
    pub train: Train,
}

impl TrainPlan {
    /// `count` gears of a pair in a row with the bend, of all `layouts`, at which their speeds differ least among those
    /// at which no two gears collide.
    ///
    /// # Errors
    /// What is wrong with the most even of them, if no bend serves.
    pub fn bent(
        pair: &PairModel,
        count: usize,
        layouts: &[Bent],
        thickness: f64,
    ) -> Result<BentChain, TrainError> {
        let limit = PI / count.max(1) as f64;
        let mut chains = layouts
            .par_iter()
            .flat_map(|&layout| (-SHARPEST..=SHARPEST).into_par_iter().map(move |d| (layout, d)))
            .map(|(layout, degrees)| {
                let bend = f64::from(degrees).to_radians();
                let layout = match layout(bend) {
                    // A chain that turns on must not come round to its own beginning.
                    Layout::Arc(bend) => Layout::Arc(bend.clamp(-limit, limit)),
                    other => other,
                };
                let plan = Self::chain(pair.clone(), count, layout, thickness)?;
                let ratio = plan.greatest_ratio(POSES);
                Ok((ratio, degrees.abs(), layout, plan))
            })
            .collect::<Result<Vec<_>, TrainError>>()?;
        let step = |ratio: f64| (ratio / SAME_RATIO).round();
        chains.sort_by(|a, b| step(a.0).total_cmp(&step(b.0)).then(a.1.cmp(&b.1)));
        let mut refused = None;
        for (ratio, _, layout, plan) in chains {
            match plan.assemble() {
                Ok(train) => return Ok(BentChain { layout, ratio, plan, train }),
                Err(error @ (TrainError::Collision { .. } | TrainError::TooFast { .. })) => {
                    refused.get_or_insert(error);
                }
                Err(error) => return Err(error),
            }
        }
        Err(refused.unwrap_or(TrainError::Count { count }))
    }

    /// The greatest ratio of the speed of a gear to that of one that drives it, or that drives what drives it, over
    /// `poses` poses of a chain's cycle.
    fn greatest_ratio(&self, poses: usize) -> f64 {
        let axes = self.axes();
        let Ok((cycle, _)) = self.cycle(&axes) else { return f64::INFINITY };
        (0..poses)
            .map(|k| {
                let speeds = self.speeds(&axes, cycle * k as f64 / poses as f64);
                let (mut slowest, mut greatest) = (f64::INFINITY, 0.0_f64);
                for speed in speeds {
                    slowest = slowest.min(speed);
                    greatest = greatest.max(speed / slowest);
                }
                greatest
            })
            .fold(0.0, f64::max)
    }

    /// Speed of every gear over the first one's when that has turned by `phi`, without their signs.
    fn speeds(&self, axes: &[(Point, f64)], phi: f64) -> Vec<f64> {
        let angles = self.rotations(axes, phi);
        let mut speeds: Vec<f64> = Vec::with_capacity(self.gears.len());
        for (i, gear) in self.gears.iter().enumerate() {
            let motion = &self.pairs[gear.pair].motion;
            speeds.push(match gear.link {
                None => 1.0,
                Some((on, Link::Axle { .. })) => speeds[on],
                Some((on, Link::Mesh { .. })) => {
                    let direction = toward(axes, [on, i]);
                    match gear.side {
                        Side::Follower => speeds[on] * motion.derivative(angles[on] - direction),
                        Side::Driver => {
                            // From the driver's end of the line of centres its angle is that of its pair.
                            speeds[on] / motion.derivative(angles[i] - direction - PI)
                        }
                    }
                }
            });
        }
        speeds
    }
}
