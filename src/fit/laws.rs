//! The law psi' that each shape would impose alone, on grids that can be compared.
//!
//! The gear whose whole turn is one period of the pair is *short* (the driver
//! when K >= 1); the other is *long*: its turn takes `windows` periods, and one
//! window of them is compared and blended with the short gear's law.

use std::f64::consts::TAU;

use super::Ratio;
use crate::gear::Side;
use crate::geometry::{Point, Vector};
use crate::pitch::{PolarCurve, PolarError, center_distance, driver_law, follower_law};

/// Unit vectors at even directions.
pub(super) fn directions(n: usize) -> Vec<Vector> {
    (0..n)
        .map(|i| {
            let (s, c) = (TAU * i as f64 / n as f64).sin_cos();
            Vector::new(c, s)
        })
        .collect()
}

/// The law of one shape about one centre, over the gear's whole turn.
///
/// Between its samples a law is linear in the gear's own angle, so it is positive wherever its radii are.
#[derive(Clone, Debug)]
pub(super) struct Law {
    side: Side,
    /// Driver: psi' at even driver angles. Follower: d phi_D / d phi_F at even follower angles.
    own: Vec<f64>,
    /// Driver angle of one own turn.
    turn: f64,
    pub(super) lost_area: f64,
}

impl Law {
    /// Looks at `points` from `center`; `directions.len()` samples over the gear's turn.
    pub(super) fn new(
        points: &[Point],
        center: Point,
        directions: &[Vector],
        side: Side,
        ratio: Ratio,
    ) -> Result<Self, PolarError> {
        let curve = PolarCurve::along(points, center, directions)?;
        let (own, turn) = match side {
            Side::Driver => {
                (driver_law(curve.radii(), center_distance(curve.radii(), ratio.value())), TAU)
            }
            Side::Follower => {
                let l = center_distance(curve.radii(), 1.0 / ratio.value());
                (follower_law(curve.radii(), l), TAU * ratio.value())
            }
        };
        Ok(Self { side, own, turn, lost_area: curve.lost_area() })
    }

    /// psi' at the `n` driver angles `start + i turn / per_turn`.
    pub(super) fn sample(&self, start: f64, n: usize, per_turn: usize) -> Vec<f64> {
        let mut walk = self.walk(start);
        let step = self.turn / per_turn as f64;
        (0..n).map(|i| walk.at(i as f64 * step).0).collect()
    }

    /// The gear's own direction (counter-clockwise in the drawing) at the pitch point, at the same driver angles.
    pub(super) fn directions_at(&self, start: f64, n: usize, per_turn: usize) -> Vec<f64> {
        let mut walk = self.walk(start);
        let step = self.turn / per_turn as f64;
        (0..n).map(|i| walk.at(i as f64 * step).1).collect()
    }

    /// Driver angle, within one own turn, at which the own direction `direction` is at the pitch point.
    pub(super) fn moment_of(&self, direction: f64) -> f64 {
        if self.side == Side::Driver {
            return (-direction).rem_euclid(TAU);
        }
        let n = self.own.len();
        let step = TAU / n as f64;
        let u = direction.rem_euclid(TAU) / step;
        let whole = (u as usize).min(n - 1);
        let t = u - whole as f64;
        let ends = |i: usize| (self.own[i], self.own[(i + 1) % n]);
        let before: f64 = (0..whole).map(ends).map(|(a, b)| 0.5 * (a + b)).sum();
        let (a, b) = ends(whole);
        step * (before + t * (a + 0.5 * t * (b - a)))
    }

    fn walk(&self, start: f64) -> Walk<'_> {
        let turns = (start / self.turn).floor();
        Walk { law: self, start: start - turns * self.turn, i: 0, wraps: 0.0, before: 0.0 }
    }
}

/// A position in a law that only moves forward.
struct Walk<'a> {
    law: &'a Law,
    start: f64,
    i: usize,
    wraps: f64,
    /// Driver angle at the start of interval i.
    before: f64,
}

impl Walk<'_> {
    /// psi' and the own direction at driver angle `start + ahead`; `ahead` must not fall from call to call.
    fn at(&mut self, ahead: f64) -> (f64, f64) {
        let law = self.law;
        let n = law.own.len();
        let x = self.start + ahead;
        let own_step = TAU / n as f64;
        if law.side == Side::Driver {
            let u = x / own_step;
            let i = u.floor();
            let t = u - i;
            let i = i as usize % n;
            let (a, b) = (law.own[i], law.own[(i + 1) % n]);
            return (a + t * (b - a), -x);
        }
        loop {
            let (a, b) = (law.own[self.i], law.own[(self.i + 1) % n]);
            let width = 0.5 * own_step * (a + b);
            let rest = (x - self.before) / own_step;
            if x > self.before + width {
                self.before += width;
                self.i += 1;
                if self.i == n {
                    self.i = 0;
                    self.wraps += 1.0;
                }
                continue;
            }
            let rest = rest.max(0.0);
            // The own angle t with a t + (b - a) t^2 / 2 = rest; there the law is `root`.
            let root = (a * a + 2.0 * (b - a) * rest).max(0.0).sqrt();
            let t = 2.0 * rest / (a + root);
            return (1.0 / root, (self.i as f64 + t) * own_step + self.wraps * TAU);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry;
    use crate::pitch::Transmission;

    fn egg() -> Vec<Point> {
        (0..700)
            .map(|i| {
                let theta = TAU * f64::from(i) / 700.0;
                geometry::rotate(
                    Point::new(1.0 + 0.3 * theta.cos() + 0.1 * (2.0 * theta).sin(), 0.0),
                    theta,
                )
            })
            .collect()
    }

    #[test]
    fn laws_agree_with_the_exact_kinematics() {
        let rays = directions(2048);
        let curve = PolarCurve::about(&egg(), Point::origin(), 2048).unwrap();
        let law =
            Law::new(&egg(), Point::origin(), &rays, Side::Driver, Ratio::integer(2).unwrap())
                .unwrap();
        let exact = Transmission::from_polar(&curve, 2).unwrap();
        for (i, v) in law.sample(0.3, 900, 777).iter().enumerate() {
            assert!((v - exact.derivative(0.3 + TAU * i as f64 / 777.0)).abs() < 1e-4);
        }
        let law =
            Law::new(&egg(), Point::origin(), &rays, Side::Follower, Ratio::reciprocal(3).unwrap())
                .unwrap();
        let exact = Transmission::from_follower(&curve, 3).unwrap();
        let step = TAU / 3.0 / 500.0;
        let ways = law.directions_at(-5.0, 800, 500);
        for (i, v) in law.sample(-5.0, 800, 500).iter().enumerate() {
            let phi = -5.0 + step * i as f64;
            assert!((v - exact.derivative(phi)).abs() < 1e-3);
            let turned = (ways[i] - exact.psi(phi)).rem_euclid(TAU);
            assert!(turned.min(TAU - turned) < 1e-5);
        }
        let moment = law.moment_of(ways[300]);
        let off = (moment - (-5.0 + step * 300.0)).rem_euclid(TAU / 3.0);
        assert!(off.min(TAU / 3.0 - off) < 1e-9, "{off}");
    }
}
