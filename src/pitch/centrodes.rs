//! The two pitch curves that roll on each other.

use std::f64::consts::{PI, TAU};

use super::Transmission;
use crate::gear::{Gearing, PitchPoint};
use crate::geometry::{Point, rotate};

/// Both pitch curves of a pair: a transmission function and a centre distance determine them.
///
/// Arguments `phi` are driver angles in radians. The driver's pitch point lies at the local angle `-phi` of the driver,
/// the follower's at `pi + psi(phi)` of the follower; lengths are in the unit of `center_distance`.
#[derive(Clone, Debug)]
pub struct Centrodes {
    /// How the follower moves.
    pub transmission: Transmission,
    /// Distance between the axes, L.
    pub center_distance: f64,
}

/// Nodes and weights of the four-point Gauss rule on -1..1, exact for polynomials up to degree seven.
const GAUSS: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    (-0.339_981_043_584_856_3, 0.652_145_154_862_546_1),
    (0.339_981_043_584_856_3, 0.652_145_154_862_546_1),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
];

impl Centrodes {
    /// The pitch point and the pitch curves there.
    #[must_use]
    pub fn pitch_point(&self, phi: f64) -> PitchPoint {
        let t = &self.transmission;
        let speed = [t.derivative(phi), t.second_derivative(phi), t.third_derivative(phi)];
        Gearing::External.at(self.center_distance, speed)
    }

    /// Distance from the driver's axis to the pitch point.
    #[must_use]
    pub fn driver_radius(&self, phi: f64) -> f64 {
        Gearing::External.radii(self.center_distance, self.transmission.derivative(phi)).driver
    }

    /// Distance from the follower's axis to the pitch point.
    #[must_use]
    pub fn follower_radius(&self, phi: f64) -> f64 {
        Gearing::External.radii(self.center_distance, self.transmission.derivative(phi)).follower
    }

    /// The pitch point in the driver's frame.
    #[must_use]
    pub fn driver_point(&self, phi: f64) -> Point {
        rotate(Point::new(self.driver_radius(phi), 0.0), -phi)
    }

    /// The pitch point in the follower's frame.
    #[must_use]
    pub fn follower_point(&self, phi: f64) -> Point {
        rotate(Point::new(self.follower_radius(phi), 0.0), PI + self.transmission.psi(phi))
    }

    /// Signed angle between the pitch normal and the radius, radians: `atan(d ln r_D / d phi)`.
    ///
    /// Its size is the same on both gears.
    #[must_use]
    pub fn lean(&self, phi: f64) -> f64 {
        self.slope(phi).atan()
    }

    fn slope(&self, phi: f64) -> f64 {
        self.pitch_point(phi).slope()
    }

    /// Greatest lean without its sign, over the knots of psi' and the middles between them.
    #[must_use]
    pub fn max_lean(&self) -> f64 {
        let n = 2 * self.transmission.samples().len();
        let step = self.transmission.driver_period() / n as f64;
        (0..n).map(|i| self.slope(i as f64 * step).abs()).fold(0.0, f64::max).atan()
    }

    /// Signed curvatures of the driver's and the follower's pitch curve at the pitch point, positive where the gear is
    /// convex, in 1 / length. From the derivatives of psi, not from differences.
    #[must_use]
    pub fn curvatures(&self, phi: f64) -> (f64, f64) {
        let curvatures = self.pitch_point(phi).curvatures();
        (curvatures.driver, curvatures.follower)
    }

    /// Length of pitch curve that passes the pitch point for each radian of the driver; equal on both gears.
    #[must_use]
    pub fn arc_speed(&self, phi: f64) -> f64 {
        self.pitch_point(phi).arc_speed()
    }

    /// The driver's whole pitch curve in its own frame: `n` points, counter-clockwise, at even driver angles from local angle 0.
    #[must_use]
    pub fn driver_curve(&self, n: usize) -> Vec<Point> {
        (0..n).map(|i| self.driver_point(-TAU * i as f64 / n as f64)).collect()
    }

    /// The follower's whole pitch curve in its own frame: `n` points, counter-clockwise, at even *driver* angles, from local
    /// angle pi. Point i meets the driver at driver angle `i / n` of [`Self::follower_turn`].
    #[must_use]
    pub fn follower_curve(&self, n: usize) -> Vec<Point> {
        let turn = self.follower_turn();
        (0..n).map(|i| self.follower_point(turn * i as f64 / n as f64)).collect()
    }

    /// Driver angle in which the follower makes one whole turn, `2 pi K`.
    #[must_use]
    pub fn follower_turn(&self) -> f64 {
        f64::from(self.transmission.follower_fold()) * self.transmission.driver_period()
    }

    /// Length of the pitch curve that passes between two driver angles; `from <= to`.
    ///
    /// Four-point Gauss quadrature between knots of psi'.
    #[must_use]
    pub fn arc_length(&self, from: f64, to: f64) -> f64 {
        let knot = self.transmission.driver_period() / self.transmission.samples().len() as f64;
        let pieces = ((to - from) / knot).ceil().max(1.0);
        let half = 0.5 * (to - from) / pieces;
        (0..pieces as usize)
            .map(|i| {
                let middle = from + (2.0 * i as f64 + 1.0) * half;
                GAUSS.iter().map(|(x, w)| w * self.arc_speed(middle + half * x)).sum::<f64>()
            })
            .sum::<f64>()
            * half
    }

    /// Perimeters of the driver's and the follower's pitch curve.
    #[must_use]
    pub fn perimeter(&self) -> (f64, f64) {
        let period = self.arc_length(0.0, self.transmission.driver_period());
        let fold = |k: u32| f64::from(k) * period;
        (fold(self.transmission.driver_fold()), fold(self.transmission.follower_fold()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry;

    fn pair(law: impl Fn(f64) -> f64, n: usize, folds: (u32, u32), l: f64) -> Centrodes {
        let period = TAU / f64::from(folds.0);
        let samples: Vec<f64> = (0..n).map(|i| law(period * i as f64 / n as f64)).collect();
        let transmission = Transmission::from_derivative(&samples, folds.0, folds.1).unwrap();
        Centrodes { transmission, center_distance: l }
    }

    /// psi' of an ellipse of half axis 1 turning about its focus against an equal one.
    fn ellipse(e: f64) -> impl Fn(f64) -> f64 {
        move |phi| (1.0 - e * e) / (1.0 + 2.0 * e * phi.cos() + e * e)
    }

    #[test]
    fn circles() {
        let c = pair(|_| 1.0, 32, (1, 3), 8.0);
        assert!((c.driver_radius(1.0) - 2.0).abs() < 1e-14);
        assert!((c.follower_radius(1.0) - 6.0).abs() < 1e-14);
        let (kd, kf) = c.curvatures(0.7);
        assert!((kd - 0.5).abs() < 1e-12 && (kf - 1.0 / 6.0).abs() < 1e-12);
        let (pd, pf) = c.perimeter();
        assert!((pd - 2.0 * TAU).abs() < 1e-11 && (pf - 6.0 * TAU).abs() < 1e-11);
        assert!(c.lean(2.0).abs() < 1e-12);
    }

    #[test]
    fn the_ellipse_about_its_focus_meets_its_twin() {
        let e = 0.6;
        let c = pair(ellipse(e), 1024, (1, 1), 2.0);
        let b2 = 1.0 - e * e;
        for k in 0..50 {
            let phi = 0.1257 * f64::from(k);
            let r = b2 / (1.0 + e * phi.cos());
            assert!((c.driver_radius(phi) - r).abs() < 1e-9);
            // The follower is the same ellipse, its other focus on the far side.
            let f = c.follower_point(phi);
            let other = Point::new(-2.0 * e, 0.0);
            assert!((f.coords.norm() + (f - other).norm() - 2.0).abs() < 1e-8, "{phi}");
            // Curvature of an ellipse at r and 2 - r from its foci.
            let (kd, kf) = c.curvatures(phi);
            let exact = b2.sqrt() / (r * (2.0 - r)).powf(1.5);
            assert!((kd - exact).abs() < 1e-4 && (kf - exact).abs() < 1e-4, "{kd} {kf} {exact}");
            let lean = (e * phi.sin() / (1.0 + e * phi.cos())).atan();
            assert!((c.lean(phi) - lean).abs() < 1e-5);
        }
    }

    #[test]
    fn curves_are_counter_clockwise_and_roll_without_slip() {
        let c = pair(|phi| 1.0 + 0.3 * (2.0 * phi + 1.0).sin(), 256, (1, 2), 30.0);
        let (d, f) = (c.driver_curve(4000), c.follower_curve(4000));
        let (pd, pf) = c.perimeter();
        assert!(geometry::signed_area(&d) > 0.0 && geometry::signed_area(&f) > 0.0);
        assert!((geometry::perimeter(&d) / pd - 1.0).abs() < 1e-5);
        assert!((geometry::perimeter(&f) / pf - 1.0).abs() < 1e-5);
        assert!((pf / pd - 2.0).abs() < 1e-12);
        // Placed in the world the two pitch points are one and move alike.
        for phi in [0.0, 0.4, 3.0, 5.5] {
            let psi = c.transmission.psi(phi);
            let a = rotate(c.driver_point(phi), phi);
            let b = rotate(c.follower_point(phi), -psi) + geometry::Vector::new(30.0, 0.0);
            assert!((a - b).norm() < 1e-12);
        }
    }
}
