//! Where the teeth stand and how tall each may be.
//!
//! One period of the motion holds `n` driver teeth, evenly spaced in arc length, tooth 0 centred on
//! the line of centres in the starting pose. Flank `2j` is the lesser-s flank of driver tooth `j`,
//! flank `2j + 1` its greater-s flank; driver tooth `j` lies between flanks `2j` and `2j + 1`,
//! follower tooth `j` between `2j + 1` and `2j + 2`. Both gears use the same flanks, so that
//! whatever is decided for one holds for its mate.

use rayon::prelude::*;

use super::flank::{Flank, longest_reach};
use super::rolling::Rolling;
use crate::gear::Side;
use crate::policy;

/// What the rack looks like. Lengths in mm, angles in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rack {
    pub(crate) pitch: f64,
    pub(crate) module: f64,
    pub(crate) pressure_angle: f64,
    /// Steepest pressure angle a flank may be given where the curve bends fast.
    pub(crate) steepest_pressure_angle: f64,
    pub(crate) addendum: f64,
    pub(crate) root_clearance: f64,
}

/// The flanks of one period, ready to be drawn.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    pub(crate) flanks: Vec<Flank>,
    /// Arc length of one period.
    pub(crate) period: f64,
}

impl Layout {
    /// Lays out `teeth` driver teeth over one period.
    pub(crate) fn new(rolling: &Rolling<'_>, rack: &Rack, teeth: usize) -> Self {
        let mut flanks: Vec<Flank> = (0..2 * teeth)
            .into_par_iter()
            .map(|q| {
                let sigma = if q % 2 == 0 { -1.0 } else { 1.0 };
                let u = (q / 2) as f64 * rack.pitch + sigma * 0.25 * rack.pitch;
                choose_pressure_angle(rolling, rack, u, sigma)
            })
            .collect();
        let period = rolling.period();
        for side in Side::BOTH {
            let shortened: Vec<(usize, usize, f64)> = teeth_of(side, teeth)
                .into_par_iter()
                .map(|(a, b)| (a, b, blunting(rolling, rack, &tooth(&flanks, period, a, b), side)))
                .collect();
            for (a, b, factor) in shortened {
                for q in [a, b % (2 * teeth)] {
                    let reach = factor * flanks[q].reach(side);
                    flanks[q].set_reach(side, reach);
                }
            }
        }
        Self { flanks, period }
    }

    /// The two flanks of each tooth of one gear in one period, in order of arc length; the last may
    /// lie in the next period.
    pub(crate) fn teeth(&self, side: Side) -> Vec<[Flank; 2]> {
        teeth_of(side, self.flanks.len() / 2)
            .into_iter()
            .map(|(a, b)| tooth(&self.flanks, self.period, a, b))
            .collect()
    }

    /// Arc lengths in one period, per flank side (lesser, greater), over which no flank touches.
    pub(crate) fn uncovered(&self) -> [f64; 2] {
        [0, 1].map(|start| {
            let mut spans: Vec<(f64, f64)> =
                self.flanks.iter().skip(start).step_by(2).map(Flank::active).collect();
            spans.sort_by(|a, b| a.0.total_cmp(&b.0));
            let first = spans[0].0;
            let mut end = spans.iter().map(|s| s.1 - self.period).fold(first, f64::max);
            let mut gap = 0.0;
            for (from, to) in spans {
                gap += (from - end).max(0.0);
                end = end.max(to);
            }
            gap
        })
    }
}

fn teeth_of(side: Side, teeth: usize) -> Vec<(usize, usize)> {
    let first = match side {
        Side::Driver => 0,
        Side::Follower => 1,
    };
    (0..teeth).map(|j| (2 * j + first, 2 * j + first + 1)).collect()
}

fn tooth(flanks: &[Flank], period: f64, a: usize, b: usize) -> [Flank; 2] {
    [a, b].map(|q| {
        let mut flank = flanks[q % flanks.len()];
        flank.u += period * (q / flanks.len()) as f64;
        flank
    })
}

/// The flattest pressure angle at which the flank stays in contact long enough; the one of longest
/// contact when none does.
fn choose_pressure_angle(rolling: &Rolling<'_>, rack: &Rack, u: f64, sigma: f64) -> Flank {
    let steps = policy::PRESSURE_ANGLE_STEPS;
    let span = rack.steepest_pressure_angle - rack.pressure_angle;
    let count = if span > 0.0 { steps } else { 0 };
    let mut best: Option<Flank> = None;
    for i in 0..=count {
        let alpha = rack.pressure_angle + span * f64::from(i) / f64::from(steps);
        let mut flank = Flank::new(u, sigma, alpha);
        for side in Side::BOTH {
            let reach = longest_reach(rolling, &flank, side, rack.addendum);
            flank.set_reach(side, reach);
        }
        if flank.contact_length() >= policy::WANTED_CONTACT_RATIO * rack.pitch {
            return flank;
        }
        if best.is_none_or(|b| flank.contact_length() > b.contact_length()) {
            best = Some(flank);
        }
    }
    best.unwrap_or_else(|| Flank::new(u, sigma, rack.pressure_angle))
}

/// By what factor both reaches of a tooth must shrink so that a top land remains.
fn blunting(rolling: &Rolling<'_>, rack: &Rack, tooth: &[Flank; 2], side: Side) -> f64 {
    let land = |factor: f64| {
        let [a, b] = tooth.map(|flank| {
            let delta = side.sign() * factor * flank.reach(side);
            rolling.foot(side, flank.point(rolling, side, delta), flank.u)
        });
        let middle = rolling.at(0.5 * (a.0 + b.0)).local(side);
        (b.0 - a.0) * (1.0 + middle.curvature * 0.5 * (a.1 + b.1))
    };
    let wanted = policy::SMALLEST_TOP_LAND * rack.module;
    if land(1.0) >= wanted {
        return 1.0;
    }
    let (mut good, mut bad) = (0.0, 1.0);
    for _ in 0..policy::REACH_BISECTIONS {
        let mid = 0.5 * (good + bad);
        if land(mid) >= wanted {
            good = mid;
        } else {
            bad = mid;
        }
    }
    good
}
