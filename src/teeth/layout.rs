//! Where the teeth stand and how tall each may be.
//!
//! One period of the motion holds `n` driver teeth, evenly spaced in arc length, tooth 0 centred on
//! the line of centres in the starting pose. Flank `2j` is the lesser-s flank of driver tooth `j`,
//! flank `2j + 1` its greater-s flank; driver tooth `j` lies between flanks `2j` and `2j + 1`,
//! follower tooth `j` between `2j + 1` and `2j + 2`. Both gears use the same flanks, so that
//! whatever is decided for one holds for its mate.

use rayon::prelude::*;

use super::flank::{Flank, longest_reach};
use super::free::keep_free;
use super::motions::Motions;
use crate::gear::Side;
use crate::policy;

/// Flattest pressure angle that a flank is given where the pitch curve slopes, radians (8 degrees). Flatter
/// ones are undercut at once and leave no height.
const FLATTEST: f64 = 8.0 * std::f64::consts::PI / 180.0;
/// Working pressure angle that a flank aims at where the pitch curve slopes, radians (50 degrees): with a
/// friction of 0.25 it is far from binding.
const WORKING: f64 = 50.0 * std::f64::consts::PI / 180.0;
/// Working pressure angle beyond which the end of a flank is given up, radians (65 degrees), where the next
/// flank of its hand carries instead.
const STEEP: f64 = 65.0 * std::f64::consts::PI / 180.0;
/// Overlap with the next flank that is kept then, in pitches.
const OVERLAP: f64 = 0.15;
/// Steps by which such an end is given up, in pitches.
const GIVEN_UP: f64 = 0.02;
/// Pressure angles tried lie no farther apart than this, radians (2.5 degrees).
const ANGLE_STEP: f64 = 2.5 * std::f64::consts::PI / 180.0;
/// Heights of a tooth at which its thickness is looked at; between them it changes by little.
const THICKNESS_STATIONS: usize = 6;

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
    /// What each gear gives of its flanks, along their normals.
    pub(crate) clearance: f64,
}

/// The flanks of one period, ready to be drawn.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    pub(crate) flanks: Vec<Flank>,
    /// Arc length of one period of the designed motion.
    pub(crate) period: f64,
    /// The same of the motion of each hand, lesser-s flanks first.
    periods: [f64; 2],
}

impl Layout {
    /// Lays out `teeth` driver teeth over one period.
    pub(crate) fn new(motions: &Motions, rack: &Rack, teeth: usize) -> Self {
        let flanks: Vec<Flank> = (0..2 * teeth)
            .into_par_iter()
            .map(|q| {
                let sigma = if q % 2 == 0 { -1.0 } else { 1.0 };
                let station = (q / 2) as f64 * rack.pitch + sigma * 0.25 * rack.pitch;
                choose_pressure_angle(motions, rack, station, sigma)
            })
            .collect();
        let periods = [-1.0, 1.0].map(|sigma| motions.of(sigma).period());
        let mut layout = Self { flanks, period: motions.designed().period(), periods };
        layout.blunt(motions, rack);
        layout.give_up_steep_ends(motions, rack);
        layout
    }

    /// Shortens teeth whose flanks would meet below their tip.
    fn blunt(&mut self, motions: &Motions, rack: &Rack) {
        let count = self.flanks.len();
        for side in Side::BOTH {
            let shares: Vec<f64> = self
                .teeth(side)
                .par_iter()
                .map(|tooth| blunting(motions, rack, tooth, side))
                .collect();
            for (j, share) in shares.into_iter().enumerate() {
                let (a, b) = flanks_of(side, j);
                for q in [a, b % count] {
                    self.flanks[q] = self.flanks[q].shortened(side, share);
                }
            }
        }
    }

    /// Gives up the ends of flanks that work too steeply, as far as the next of their hand covers.
    fn give_up_steep_ends(&mut self, motions: &Motions, rack: &Rack) {
        let n = self.flanks.len();
        let (keep, step) = (OVERLAP * rack.pitch, GIVEN_UP * rack.pitch);
        for q in 0..n {
            let flank = self.flanks[q];
            let own = motions.of(flank.sigma);
            let period = self.periods[q % 2];
            let before = self.flanks[(q + n - 2) % n].active().1 - if q < 2 { period } else { 0.0 };
            let after = self.flanks[(q + 2) % n].active().0 + if q + 2 < n { 0.0 } else { period };
            let steep = |s: f64| flank.working_angle(own, s).abs() > STEEP;
            let (mut low, mut high) = flank.active();
            while steep(low) && low + step < (before - keep).min(flank.u) {
                low += step;
            }
            while steep(high) && high - step > (after + keep).max(flank.u) {
                high -= step;
            }
            self.flanks[q] = flank.active_within(low, high);
        }
    }

    /// The same flank one period later.
    pub(crate) fn later(&self, flank: Flank) -> Flank {
        let period = self.periods[usize::from(flank.sigma > 0.0)];
        Flank { u: flank.u + period, station: flank.station + self.period, ..flank }
    }

    /// The two flanks of each tooth of one gear in one period, in order of arc length; the last may
    /// lie in the next period.
    pub(crate) fn teeth(&self, side: Side) -> Vec<[Flank; 2]> {
        let n = self.flanks.len();
        let flank = |q: usize| {
            if q < n { self.flanks[q] } else { self.later(self.flanks[q - n]) }
        };
        (0..n / 2)
            .map(|j| {
                let (a, b) = flanks_of(side, j);
                [flank(a), flank(b)]
            })
            .collect()
    }

    /// Arc lengths in one period, per flank side (lesser, greater), over which no flank touches.
    pub(crate) fn uncovered(&self) -> [f64; 2] {
        [0, 1].map(|start| {
            let mut spans: Vec<(f64, f64)> =
                self.flanks.iter().skip(start).step_by(2).map(Flank::active).collect();
            spans.sort_by(|a, b| a.0.total_cmp(&b.0));
            let first = spans[0].0;
            let mut end = spans.iter().map(|s| s.1 - self.periods[start]).fold(first, f64::max);
            let mut gap = 0.0;
            for (from, to) in spans {
                gap += (from - end).max(0.0);
                end = end.max(to);
            }
            gap
        })
    }
}

/// The flanks on either side of tooth `j` of one gear; the second may be one past the last.
fn flanks_of(side: Side, j: usize) -> (usize, usize) {
    let first = match side {
        Side::Driver => 2 * j,
        Side::Follower => 2 * j + 1,
    };
    (first, first + 1)
}

/// The flattest pressure angle at which the flank stays in contact long enough; the one of longest
/// contact when none does. The flattest tried is the one asked for, or less where the pitch curve slopes
/// against the flank.
fn choose_pressure_angle(motions: &Motions, rack: &Rack, station: f64, sigma: f64) -> Flank {
    let slope = motions.designed().at(station).slope();
    let flattest =
        (WORKING - sigma * slope).clamp(FLATTEST.min(rack.pressure_angle), rack.pressure_angle);
    let span = rack.steepest_pressure_angle - flattest;
    let steps = (span / ANGLE_STEP - 1e-9).ceil().max(0.0) as u32;
    let wanted = policy::WANTED_CONTACT_RATIO * rack.pitch;
    let flank = |alpha: f64| {
        let mut flank = Flank::new(motions, station, sigma, alpha);
        for side in Side::BOTH {
            let reach = longest_reach(motions, &flank, side, rack.addendum);
            flank.set_reach(side, reach);
        }
        flank
    };
    let mut best = keep_free(motions, rack, flank(flattest));
    for i in 1..=steps {
        if best.contact_length() >= wanted {
            break;
        }
        let next = flank(flattest + span * f64::from(i) / f64::from(steps));
        if next.contact_length() > best.contact_length() {
            let next = keep_free(motions, rack, next);
            if next.contact_length() > best.contact_length() {
                best = next;
            }
        }
    }
    best
}

/// By what factor both reaches of a tooth must shrink so that a top land remains, and no place below it
/// is thinner.
fn blunting(motions: &Motions, rack: &Rack, tooth: &[Flank; 2], side: Side) -> f64 {
    let rolling = motions.designed();
    let thickness = |share: f64| {
        let [a, b] = tooth.map(|flank| {
            let delta = side.sign() * share * flank.reach(side);
            rolling.foot(side, flank.point(motions.of(flank.sigma), side, delta), flank.station)
        });
        let middle = rolling.at(0.5 * (a.0 + b.0)).local(side);
        (b.0 - a.0) * (1.0 + middle.curvature * 0.5 * (a.1 + b.1))
    };
    let wanted = policy::SMALLEST_TOP_LAND * rack.module;
    let station = |k: usize| k as f64 / THICKNESS_STATIONS as f64;
    let thin = (1..=THICKNESS_STATIONS).map(station).find(|&share| thickness(share) < wanted);
    let Some(mut bad) = thin else { return 1.0 };
    let mut good = bad - station(1);
    for _ in 0..policy::REACH_BISECTIONS {
        let mid = 0.5 * (good + bad);
        if thickness(mid) >= wanted {
            good = mid;
        } else {
            bad = mid;
        }
    }
    good
}
