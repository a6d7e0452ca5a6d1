//! A pair small enough for a page with hundreds of them.

use serde::{Deserialize, Serialize};

use crate::assembly::Assembly;
use crate::fit::Ratio;
use crate::geometry::Point;
use crate::pitch::Centrodes;
use crate::policy;
use crate::report::thin_ring;

/// Outlines as SVG paths in steps of a grid, [`policy::GALLERY_GRID`] to the centre distance, y upwards, each in its gear's frame;
/// and psi over one period.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Thumbnail {
    /// Outlines of driver and follower.
    pub outlines: [String; 2],
    /// The drawings behind them.
    pub inputs: [String; 2],
    /// Reach of driver and follower, drawings too, from their axes, in steps of the grid.
    pub reach: [u32; 2],
    /// Periods in a whole turn of driver and follower.
    pub folds: [u32; 2],
    /// Follower angles, thousandths of a radian, at even driver angles over one period, both ends included.
    pub motion: Vec<i32>,
}

impl Thumbnail {
    /// Of a finished pair.
    #[must_use]
    pub fn of_pair(assembly: &Assembly, centrodes: &Centrodes, ratio: Ratio) -> Self {
        let rings: Vec<[&[Point]; 2]> = assembly
            .gears
            .iter()
            .map(|g| [g.gear.outline.as_slice(), g.gear.input.as_slice()])
            .collect();
        Self::new(&rings, centrodes, ratio)
    }

    /// Of outlines and drawings in the gears' frames, driver first, at the centre distance of `centrodes`.
    #[must_use]
    pub fn new(rings: &[[&[Point]; 2]], centrodes: &Centrodes, ratio: Ratio) -> Self {
        let step = centrodes.center_distance / policy::GALLERY_GRID;
        let drawn = |gear: usize, part: usize, thin: f64| {
            rings.get(gear).map_or_else(String::new, |r| {
                path(&thin_ring(r[part], thin * centrodes.center_distance), step)
            })
        };
        let reach = |gear: usize| {
            rings.get(gear).map_or(0, |r| {
                let far = r.iter().copied().flatten().map(|p| p.coords.norm()).fold(0.0, f64::max);
                (far / step).ceil() as u32
            })
        };
        let t = &centrodes.transmission;
        let count = policy::GALLERY_MOTION;
        let motion = (0..=count)
            .map(|i| (1e3 * t.psi(t.driver_period() * i as f64 / count as f64)).round() as i32)
            .collect();
        Self {
            outlines: [0, 1].map(|gear| drawn(gear, 0, policy::GALLERY_THIN)),
            inputs: [0, 1].map(|gear| drawn(gear, 1, policy::GALLERY_THIN_INPUT)),
            reach: [reach(0), reach(1)],
            folds: [ratio.driver_fold(), ratio.follower_fold()],
            motion,
        }
    }
}

/// A closed path of whole steps; each point is given by its way from the one before.
fn path(ring: &[Point], step: f64) -> String {
    let whole = |p: &Point| [(p.x / step).round() as i64, (p.y / step).round() as i64];
    let mut text = String::new();
    let mut last = [0, 0];
    for point in ring {
        let at = whole(point);
        let by = [at[0] - last[0], at[1] - last[1]];
        if text.is_empty() {
            text = format!("M{} {}l", by[0], by[1]);
        } else if by != [0, 0] {
            for (i, v) in by.into_iter().enumerate() {
                // A minus parts numbers as well as a space does.
                if v >= 0 && !(i == 0 && text.ends_with('l')) {
                    text.push(' ');
                }
                text.push_str(&v.to_string());
            }
        }
        last = at;
    }
    if !text.is_empty() {
        text.push('z');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_whole_steps_from_point_to_point() {
        let ring = [(1.0, -2.0), (3.04, -2.0), (3.0, 2.0), (3.01, 2.0), (-1.0, 0.0)];
        let ring: Vec<Point> = ring.iter().map(|(x, y)| Point::new(*x, *y)).collect();
        assert_eq!(path(&ring, 0.5), "M2 -4l4 0 0 8-8-4z");
        assert_eq!(path(&[], 0.5), "");
    }
}
