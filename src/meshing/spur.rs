//! Standard involute spur gears in closed form, for tests only.

use crate::geometry::{Point, rotate};
use std::f64::consts::{PI, TAU};

/// A spur gear of module `m`, addendum m, dedendum 1.25 m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spur {
    pub(super) teeth: u32,
    pub(super) module: f64,
    pub(super) pressure_angle: f64,
    /// Taken from the tooth thickness at the pitch circle, mm.
    pub(super) thinning: f64,
}

impl Spur {
    pub(super) fn radius(&self) -> f64 {
        0.5 * self.module * f64::from(self.teeth)
    }

    pub(super) fn base(&self) -> f64 {
        self.radius() * self.pressure_angle.cos()
    }

    pub(super) fn tip(&self) -> f64 {
        self.radius() + self.module
    }

    /// The outline, `points` on each flank. Tooth 0 is centred at angle `start`; teeth from
    /// `skip` on are missing, down to the root circle.
    pub(super) fn outline(&self, start: f64, points: usize, present: u32) -> Vec<Point> {
        let root = self.radius() - 1.25 * self.module;
        let begin = self.base().max(root);
        let half = (0.5 * PI * self.module - self.thinning) / (2.0 * self.radius());
        let involute = |angle: f64| angle.tan() - angle;
        let mut flank = vec![(root, half + involute(self.pressure_angle))];
        let roll = |r: f64| (self.base() / r).min(1.0).acos().tan();
        let (first, last) = (roll(begin), roll(self.tip()));
        for i in 0..points {
            let t = first + (last - first) * i as f64 / (points - 1) as f64;
            let r = self.base() * t.hypot(1.0);
            flank.push((r, half + involute(self.pressure_angle) - involute(t.atan())));
        }
        let mut outline = Vec::new();
        for tooth in 0..self.teeth {
            let center = start + TAU * f64::from(tooth) / f64::from(self.teeth);
            let at = |r: f64, angle: f64| rotate(Point::new(r, 0.0), center + angle);
            if tooth < present {
                outline.extend(flank.iter().map(|&(r, a)| at(r, -a)));
                outline.extend(flank.iter().rev().map(|&(r, a)| at(r, a)));
            } else {
                outline.extend([-1.0, 1.0].map(|side| at(root, side * flank[0].1)));
            }
        }
        outline
    }
}
