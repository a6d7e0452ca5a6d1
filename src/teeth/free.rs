//! How much of two conjugate flanks keeps out of each other's way.
//!
//! Where the bend of a pitch curve changes sign within a tooth its flanks are S-shaped: they touch
//! rightly where they are conjugate and cross elsewhere. The driver's flank is moved past the follower's
//! and of every two places that run into each other the one whose loss shortens contact less is given up.

use super::flank::Flank;
use super::layout::Rack;
use super::motions::Motions;
use crate::gear::Side;
use crate::geometry::{Point, Vector, cross};

/// Places along a flank that are looked at.
const PLACES: usize = 25;
/// Instants at which they are.
const INSTANTS: usize = 50;
/// Rolling before and after contact during which flanks are near each other, in pitches.
const MARGIN: f64 = 0.3;
/// Depth from which places run into each other, in modules: above the errors of sampling.
const DEPTH: f64 = 1e-3;
/// Depth beyond which a place is on the other side of the mating tooth, in modules.
const OTHER_SIDE: f64 = 0.5;

/// The flank with its contact shortened until neither gear's part of it runs into the other's.
pub(crate) fn keep_free(motions: &Motions, rack: &Rack, flank: Flank) -> Flank {
    let length = flank.contact_length();
    if length <= 0.0 {
        return flank;
    }
    let delta = |i: usize| length * i as f64 / (PLACES - 1) as f64 - flank.follower_reach;
    let crossing = crossings(motions, rack, &flank, &delta);
    let zero = (0..PLACES).find(|&i| delta(i) >= 0.0).unwrap_or(0);
    let (mut low, mut high) = (0, PLACES - 1);
    for (i, j) in crossing {
        let inside = |x: usize| low <= x && x <= high;
        if !(inside(i) && inside(j)) {
            continue;
        }
        let lost = |x: usize| if x >= zero { high + 1 - x } else { x + 1 - low };
        let out = if lost(i) <= lost(j) { i } else { j };
        if out >= zero.max(1) {
            high = out - 1;
        } else {
            low = out + 1;
        }
        if low >= high {
            break;
        }
    }
    Flank {
        driver_reach: flank.driver_reach.min(delta(high).max(0.0)),
        follower_reach: flank.follower_reach.min((-delta(low.min(PLACES - 1))).max(0.0)),
        ..flank
    }
}

/// Places of the driver's and the follower's flank that run into each other.
fn crossings(
    motions: &Motions,
    rack: &Rack,
    flank: &Flank,
    delta: &dyn Fn(usize) -> f64,
) -> Vec<(usize, usize)> {
    let own = motions.of(flank.sigma);
    let mut driver = [Point::origin(); PLACES];
    let mut follower = [Point::origin(); PLACES];
    let mut into_follower = [Vector::zeros(); PLACES];
    for i in 0..PLACES {
        let at = own.at(flank.arc_at(delta(i)));
        let contact = flank.contact(&at);
        let (sin, cos) = flank.alpha.sin_cos();
        let normal = flank.sigma * cos * at.tangent + sin * at.normal;
        driver[i] = at.to_local(Side::Driver, contact);
        follower[i] = at.to_local(Side::Follower, contact);
        into_follower[i] = at.to_local(Side::Follower, contact + normal) - follower[i];
    }
    let neighbours = |j: usize| (follower[j.saturating_sub(1)], follower[(j + 1).min(PLACES - 1)]);
    // The curve leaves the tangent at a place by no more than this before the next one.
    let sag: Vec<f64> = (0..PLACES)
        .map(|j| {
            let (before, after) = neighbours(j);
            let chord = after - before;
            cross(chord, follower[j] - before).abs() / chord.norm().max(f64::MIN_POSITIVE)
        })
        .collect();
    let mut found = Vec::new();
    let margin = MARGIN * rack.pitch;
    let (from, to) = (delta(0) - margin, delta(PLACES - 1) + margin);
    for k in 0..INSTANTS {
        let at = own.at(flank.arc_at(from + (to - from) * k as f64 / (INSTANTS - 1) as f64));
        for (i, p) in driver.iter().enumerate() {
            let q = at.to_local(Side::Follower, at.to_world(Side::Driver, *p));
            let far = |j: &usize| (q - follower[*j]).norm_squared();
            let Some(j) = (0..PLACES).min_by(|a, b| far(a).total_cmp(&far(b))) else { continue };
            let depth = (q - follower[j]).dot(&into_follower[j]);
            if depth <= DEPTH * rack.module + sag[j] || depth >= OTHER_SIDE * rack.module {
                continue;
            }
            // Past the ends of the follower's flank is its root or air.
            let (before, after) = neighbours(j);
            if far(&j) - depth * depth < (after - before).norm_squared() {
                found.push((i, j));
            }
        }
    }
    found
}
