use super::Pair;

/// Whether the teeth of both gears point outwards, or one gear is a ring about the other.
///
/// The driver's axis is the origin, the follower's lies at (L, 0); the driver turns counter-clockwise. With psi' the speed
/// of the follower over that of the driver, the pitch point (the instant centre of the two gears) divides the line of
/// centres so that `r_D = psi' r_F`, with `r_D + r_F = L` outside and `|r_D - r_F| = L` inside.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Gearing {
    /// Both gears have their teeth outside and turn in opposite senses; the pitch point lies between the axes.
    #[default]
    External,
    /// The slower gear is a ring about the faster one; both turn in the same sense and the pitch point lies beyond the
    /// axis of the faster. psi' must stay on one side of 1: below it the follower is the ring, above it the driver.
    Internal,
}

impl Gearing {
    /// The follower's sense of turn: -1, clockwise, outside; +1, counter-clockwise, inside.
    #[must_use]
    pub const fn follower_sense(self) -> f64 {
        match self {
            Self::External => -1.0,
            Self::Internal => 1.0,
        }
    }

    /// The pitch point and the pitch curves there, for axes `center_distance` apart and psi', psi'' and psi''' by the
    /// driver angle in radians. Lengths come in the unit of `center_distance`.
    #[must_use]
    pub fn at(self, center_distance: f64, [p, p1, p2]: [f64; 3]) -> PitchPoint {
        let sense = -self.follower_sense();
        let q = p + sense;
        let rise = sense * center_distance / (q * q);
        PitchPoint {
            gearing: self,
            center_distance,
            speed: [p, p1],
            place: [center_distance * p / q, rise * p1, rise * (p2 - 2.0 * p1 * p1 / q)],
        }
    }

    /// Distances of the pitch point from both axes, in the unit of `center_distance`.
    #[must_use]
    pub fn radii(self, center_distance: f64, speed: f64) -> Pair<f64> {
        self.at(center_distance, [speed, 0.0, 0.0]).radii()
    }

    /// psi' of a pair whose pitch point lies `driver_radius` from the driver's axis: the inverse of [`Gearing::radii`].
    /// Inside, `ring` tells whether the driver is the ring.
    #[must_use]
    pub fn speed(self, center_distance: f64, driver_radius: f64, ring: bool) -> f64 {
        match (self, ring) {
            (Self::External, _) => driver_radius / (center_distance - driver_radius),
            (Self::Internal, false) => driver_radius / (center_distance + driver_radius),
            (Self::Internal, true) => driver_radius / (driver_radius - center_distance),
        }
    }
}

/// The pitch point at one instant, and how both pitch curves pass it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PitchPoint {
    gearing: Gearing,
    center_distance: f64,
    /// psi' and psi''.
    speed: [f64; 2],
    /// Where the pitch point lies on the line of centres, from the driver's axis towards the follower's, and its first and
    /// second derivative by the driver angle.
    place: [f64; 3],
}

impl PitchPoint {
    /// Where it lies on the line of centres, from the driver's axis towards the follower's.
    #[must_use]
    pub fn x(&self) -> f64 {
        self.place[0]
    }

    /// Its distances from both axes.
    #[must_use]
    pub fn radii(&self) -> Pair<f64> {
        let q = self.speed[0] - self.gearing.follower_sense();
        Pair::new(self.place[0].abs(), (self.center_distance / q).abs())
    }

    /// d ln r_D / d phi: the tangent of the angle between the pitch curves' normal and the line of centres. The same on
    /// both gears but for its sign.
    #[must_use]
    pub fn slope(&self) -> f64 {
        let [p, p1] = self.speed;
        let sense = -self.gearing.follower_sense();
        sense * p1 / (p * (p + sense))
    }

    /// Length of pitch curve that passes the pitch point for each radian of the driver; equal on both gears.
    #[must_use]
    pub fn arc_speed(&self) -> f64 {
        self.place[0].hypot(self.place[1])
    }

    /// Derivative of [`PitchPoint::arc_speed`] by the driver angle.
    #[must_use]
    pub fn arc_acceleration(&self) -> f64 {
        let [x, x1, x2] = self.place;
        x1 * (x + x2) / x.hypot(x1)
    }

    /// Turn of the driver against the follower for each radian of the driver.
    #[must_use]
    pub fn relative_turn(&self) -> f64 {
        1.0 - self.gearing.follower_sense() * self.speed[0]
    }

    /// Signed curvatures of both pitch curves, each run counter-clockwise about its axis, positive where it bulges away
    /// from the axis, in 1 / length. A ring's pitch curve counts as any other: its teeth stand inside.
    #[must_use]
    pub fn curvatures(&self) -> Pair<f64> {
        let [p, p1] = self.speed;
        let [x, x1, x2] = self.place;
        let turn = self.gearing.follower_sense();
        // Signed distances from the axes: a curve seen through its axis keeps its curvature.
        let driver = Polar { r: x, r1: -x1, r2: x2 };
        let y = turn * self.center_distance / (p - turn);
        // The follower's own direction of the pitch point changes by -turn psi'.
        let follower = Polar { r: y, r1: -turn * x1 / p, r2: (x2 - x1 * p1 / p) / (p * p) };
        Pair::new(driver.curvature(), follower.curvature())
    }

    /// How much more sharply the driver's pitch curve bends than the follower's where they touch, in 1 / length.
    #[must_use]
    pub fn relative_curvature(&self) -> f64 {
        let bend = self.curvatures();
        bend.driver - self.gearing.follower_sense() * bend.follower
    }
}

/// Radius of a curve and its derivatives by the direction from its centre.
struct Polar {
    r: f64,
    r1: f64,
    r2: f64,
}

impl Polar {
    fn curvature(&self) -> f64 {
        let speed2 = self.r * self.r + self.r1 * self.r1;
        (self.r * self.r + 2.0 * self.r1 * self.r1 - self.r * self.r2) / (speed2 * speed2.sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Point, Vector, rotate};
    use std::f64::consts::PI;

    const GEARINGS: [(Gearing, f64); 3] =
        [(Gearing::External, 0.4), (Gearing::Internal, 0.4), (Gearing::Internal, 2.5)];

    fn near(a: f64, b: f64, tolerance: f64) {
        assert!((a - b).abs() < tolerance, "{a} is not {b}");
    }

    #[test]
    fn round_gears_outside_and_inside() {
        // (gearing, psi', L, r_D, r_F, place of the pitch point)
        let cases = [
            (Gearing::External, 0.25, 50.0, 10.0, 40.0, 10.0),
            // A pinion of 10 mm in a ring of 40 mm, and the ring driving the pinion.
            (Gearing::Internal, 0.25, 30.0, 10.0, 40.0, -10.0),
            (Gearing::Internal, 4.0, 30.0, 40.0, 10.0, 40.0),
        ];
        for (gearing, speed, l, driver, follower, x) in cases {
            let at = gearing.at(l, [speed, 0.0, 0.0]);
            near(at.x(), x, 1e-12);
            near(at.radii().driver, driver, 1e-12);
            near(at.radii().follower, follower, 1e-12);
            near(at.curvatures().driver, 1.0 / driver, 1e-12);
            near(at.curvatures().follower, 1.0 / follower, 1e-12);
            let relative = match gearing {
                Gearing::External => 1.0 / driver + 1.0 / follower,
                Gearing::Internal => 1.0 / driver - 1.0 / follower,
            };
            near(at.relative_curvature(), relative, 1e-12);
            near(at.arc_speed(), driver, 1e-12);
            near(at.slope(), 0.0, 1e-15);
            near(gearing.speed(l, driver, speed > 1.0), speed, 1e-12);
        }
    }

    /// psi' = mean + 0.1 sin 2 phi and its derivatives; psi.
    fn wave(mean: f64, phi: f64) -> ([f64; 3], f64) {
        let (s, c) = (2.0 * phi).sin_cos();
        ([mean + 0.1 * s, 0.2 * c, -0.4 * s], mean * phi + 0.05 * (1.0 - c))
    }

    /// The pitch point in the frames of driver and follower.
    fn traced(gearing: Gearing, mean: f64, phi: f64) -> Pair<Point> {
        let (speed, psi) = wave(mean, phi);
        let x = gearing.at(7.0, speed).x();
        Pair::new(
            rotate(Point::new(x, 0.0), -phi),
            rotate(Point::new(x - 7.0, 0.0), -gearing.follower_sense() * psi),
        )
    }

    #[test]
    fn both_curves_roll_without_slip() {
        let h = 1e-5;
        for (gearing, mean) in GEARINGS {
            for k in 0..12 {
                let phi = 0.3 + 0.5 * f64::from(k);
                let at = gearing.at(7.0, wave(mean, phi).0);
                let (before, after) =
                    (traced(gearing, mean, phi - h), traced(gearing, mean, phi + h));
                let moved = after.zip(before).map(|(b, a)| (b - a) / (2.0 * h));
                near(moved.driver.norm(), at.arc_speed(), 1e-7);
                near(moved.follower.norm(), at.arc_speed(), 1e-7);
                // Turned back into the world both move alike.
                let world = |v: Vector, angle: f64| rotate(Point::from(v), angle).coords;
                let psi = wave(mean, phi).1;
                let difference = world(moved.driver, phi)
                    - world(moved.follower, gearing.follower_sense() * psi);
                assert!(difference.norm() < 1e-7, "{gearing:?} {phi}");
                let speed = |phi: f64| gearing.at(7.0, wave(mean, phi).0).arc_speed();
                near((speed(phi + h) - speed(phi - h)) / (2.0 * h), at.arc_acceleration(), 1e-7);
            }
        }
    }

    #[test]
    fn curvatures_are_those_of_circles_through_three_places() {
        let h = 1e-3;
        for (gearing, mean) in GEARINGS {
            for k in 0..12 {
                let phi = 0.3 + 0.5 * f64::from(k);
                let curvatures = gearing.at(7.0, wave(mean, phi).0).curvatures();
                let places = [phi - h, phi, phi + h].map(|phi| traced(gearing, mean, phi));
                let through = |of: fn(&Pair<Point>) -> Point| {
                    let [a, b, c] = places.map(|p| of(&p));
                    let (u, v) = (b - a, c - b);
                    let turn = u.x * v.y - u.y * v.x;
                    // Positive where the path bends round the axis.
                    let about = b.x * v.y - b.y * v.x;
                    2.0 * turn / (u.norm() * v.norm() * (c - a).norm()) * about.signum()
                };
                near(curvatures.driver, through(|p| p.driver), 1e-5);
                near(curvatures.follower, through(|p| p.follower), 1e-5);
            }
        }
    }

    #[test]
    fn the_slope_is_that_of_the_radius() {
        let h = 1e-5;
        for (gearing, mean) in GEARINGS {
            for phi in [0.2, 1.1, PI, 4.0] {
                let radius = |phi: f64| gearing.radii(7.0, wave(mean, phi).0[0]);
                let (a, b) = (radius(phi - h), radius(phi + h));
                let slope = gearing.at(7.0, wave(mean, phi).0).slope();
                near((b.driver / a.driver).ln() / (2.0 * h), slope, 1e-8);
            }
        }
    }
}
