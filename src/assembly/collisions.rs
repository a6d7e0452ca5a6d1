//! Gears of a train that must keep clear of each other.

use super::{Assembly, PlacedGear, TrainError};
use crate::geometry::{self, Point};
use crate::policy;
use rayon::prelude::*;

/// Gears that neither mesh nor share an axle must keep clear of each other all through the cycle.
pub(super) fn check(assembly: &Assembly) -> Result<(), TrainError> {
    let gears = &assembly.gears;
    let reach: Vec<f64> = gears
        .iter()
        .map(|g| g.gear.outline.iter().map(|p| p.coords.norm()).fold(0.0, f64::max))
        .collect();
    let linked = |a: usize, b: usize| {
        assembly.meshes.iter().chain(&assembly.axles).any(|m| *m == [a, b] || *m == [b, a])
    };
    let one_layer =
        |a: usize, b: usize| (gears[a].level - gears[b].level).abs() < assembly.thickness;
    let mut suspects = Vec::new();
    for b in 0..gears.len() {
        for a in 0..b {
            let apart = (gears[a].axis - gears[b].axis).norm();
            if !linked(a, b) && one_layer(a, b) && apart < reach[a] + reach[b] {
                suspects.push([a, b]);
            }
        }
    }
    let last = assembly.driver_angle.len().saturating_sub(1);
    let poses: Vec<usize> =
        (0..policy::COLLISION_POSES).map(|k| k * last / policy::COLLISION_POSES).collect();
    let found = suspects
        .par_iter()
        .filter_map(|&[a, b]| {
            let hit = poses.iter().find(|&&k| {
                let [a, b] = [a, b].map(|i| posed(&gears[i], k));
                overlap(&a, &b)
            });
            hit.map(|&k| (a, b, assembly.driver_angle[k]))
        })
        .min_by(|x, y| (x.0, x.1).cmp(&(y.0, y.1)));
    match found {
        Some((a, b, at)) => {
            let [first, second] = [a, b].map(|i| gears[i].gear.name.clone());
            Err(TrainError::Collision { first, second, at })
        }
        None => Ok(()),
    }
}

fn posed(placed: &PlacedGear, sample: usize) -> Vec<Point> {
    let angle = placed.angle.get(sample).copied().unwrap_or(0.0);
    placed.gear.outline.iter().map(|&p| geometry::rotate(p, angle) + placed.axis.coords).collect()
}

/// Whether two outlines share any ground; boxes first.
fn overlap(a: &[Point], b: &[Point]) -> bool {
    let ((al, ah), (bl, bh)) = (geometry::bounds(a), geometry::bounds(b));
    let apart = ah.x < bl.x || bh.x < al.x || ah.y < bl.y || bh.y < al.y;
    !apart && geometry::intersection_over_union(a, b) > 0.0
}
