//! Two pitch curves rolling on each other, addressed by the rolled arc length.
//!
//! Arc length `s` (mm) grows with the driver angle and is the same on both
//! gears. In the driver's own frame it runs clockwise, in the follower's
//! counter-clockwise. All frames follow `Centrodes`: world x axis along the
//! line of centres, driver axis at the origin, follower axis at (L, 0).
//!
//! The follower of a loaded pair starts behind (or ahead of) its designed angle: a rolling has an
//! `offset`, the follower's angle at driver angle 0.

use crate::gear::{Gearing, Side};
use crate::geometry::{Point, Vector, quarter_turn};
use crate::pitch::Centrodes;
use crate::policy;

/// One instant of rolling, in world coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Instant {
    /// Rolled arc length, mm.
    pub(crate) s: f64,
    /// Sine and cosine of the driver angle.
    driver_turn: (f64, f64),
    /// Sine and cosine of the follower angle.
    follower_turn: (f64, f64),
    /// The pitch point.
    pub(crate) pitch: Point,
    /// Common unit tangent of both pitch curves, towards growing `s`.
    pub(crate) tangent: Vector,
    /// Unit normal from driver to follower.
    pub(crate) normal: Vector,
    /// Curvatures of the driver's and the follower's pitch curve, convex positive, 1/mm.
    pub(crate) curvatures: (f64, f64),
    center_distance: f64,
}

impl Instant {
    /// The gears at driver angle `phi` and follower angle `psi`, the follower turning `speed` times as
    /// fast: any motion, not the rolling one. The pitch point is the instant centre; there is no arc
    /// length and no curvature.
    pub(crate) fn of_motion(phi: f64, psi: f64, speed: f64, center_distance: f64) -> Self {
        Self {
            s: 0.0,
            driver_turn: phi.sin_cos(),
            follower_turn: psi.sin_cos(),
            pitch: Point::new(Gearing::External.at(center_distance, [speed, 0.0, 0.0]).x(), 0.0),
            tangent: Vector::new(0.0, -1.0),
            normal: Vector::new(1.0, 0.0),
            curvatures: (0.0, 0.0),
            center_distance,
        }
    }

    /// The same instant counted as rolled arc length `s`, mm.
    pub(crate) fn counted(self, s: f64) -> Self {
        Self { s, ..self }
    }

    /// Slope of the pitch curves: signed angle from the perpendicular to the line of centres to the
    /// common tangent, radians. A flank of hand `sigma` works at `alpha + sigma slope`.
    pub(crate) fn slope(&self) -> f64 {
        self.tangent.x.atan2(-self.tangent.y)
    }

    /// A world point in the frame of one gear.
    pub(crate) fn to_local(self, side: Side, p: Point) -> Point {
        match side {
            Side::Driver => {
                let (s, c) = self.driver_turn;
                Point::new(c * p.x + s * p.y, -s * p.x + c * p.y)
            }
            Side::Follower => {
                let (s, c) = self.follower_turn;
                let x = p.x - self.center_distance;
                Point::new(c * x - s * p.y, s * x + c * p.y)
            }
        }
    }

    /// A point of one gear's frame in the world.
    pub(crate) fn to_world(self, side: Side, p: Point) -> Point {
        match side {
            Side::Driver => {
                let (s, c) = self.driver_turn;
                Point::new(c * p.x - s * p.y, s * p.x + c * p.y)
            }
            Side::Follower => {
                let (s, c) = self.follower_turn;
                Point::new(self.center_distance + c * p.x + s * p.y, -s * p.x + c * p.y)
            }
        }
    }

    /// Pitch point, tangent, outward normal and curvature of one gear in its own frame.
    pub(crate) fn local(self, side: Side) -> CurveFrame {
        let at = self.to_local(side, self.pitch);
        let tangent = self.to_local(side, self.pitch + self.tangent) - at;
        let (normal, curvature) = match side {
            Side::Driver => (quarter_turn(tangent), self.curvatures.0),
            Side::Follower => (-quarter_turn(tangent), self.curvatures.1),
        };
        CurveFrame { at, tangent, normal, curvature }
    }
}

/// A point of a pitch curve with its moving frame, in the gear's own frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CurveFrame {
    pub(crate) at: Point,
    pub(crate) tangent: Vector,
    pub(crate) normal: Vector,
    pub(crate) curvature: f64,
}

/// Arc length as a function of driver angle, and back, over the periodic motion.
///
/// The table's knots lie at even driver angles, on the knots of psi' and between them, so that the
/// motion is smooth on each interval; there the driver angle is a quintic in the arc length that
/// takes the exact value, slope and bend at both ends.
#[derive(Clone, Debug)]
pub(crate) struct Rolling {
    centrodes: Centrodes,
    /// Follower angle at driver angle 0, radians.
    offset: f64,
    knots: Vec<Knot>,
    /// For even arc lengths, the last knot at or before each.
    hints: Vec<u32>,
}

/// The driver angle and its derivatives by arc length at one arc length.
#[derive(Clone, Copy, Debug)]
struct Knot {
    s: f64,
    angle: f64,
    slope: f64,
    bend: f64,
}

impl Knot {
    fn new(centrodes: &Centrodes, s: f64, angle: f64) -> Self {
        let pitch_point = centrodes.pitch_point(angle);
        let speed = pitch_point.arc_speed();
        let slope = 1.0 / speed;
        Self { s, angle, slope, bend: -slope * slope * slope * pitch_point.arc_acceleration() }
    }
}

/// Nodes and weights of five-point Gauss-Legendre quadrature on [-1, 1].
const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

impl Rolling {
    /// The designed motion: the follower starts at angle 0.
    pub(crate) fn new(centrodes: &Centrodes) -> Self {
        Self::with_offset(centrodes.clone(), 0.0)
    }

    /// Pitch curves whose follower starts at `offset` radians.
    pub(crate) fn with_offset(centrodes: Centrodes, offset: f64) -> Self {
        let samples = centrodes.transmission.samples().len();
        let intervals = samples * policy::ROLLING_INTERVALS.div_ceil(samples).max(1);
        let step = centrodes.transmission.driver_period() / intervals as f64;
        let mut knots = Vec::with_capacity(intervals + 1);
        let mut total = 0.0;
        knots.push(Knot::new(&centrodes, 0.0, 0.0));
        for i in 1..=intervals {
            let (from, to) = ((i - 1) as f64 * step, i as f64 * step);
            total += arc_between(&centrodes, from, to);
            knots.push(Knot::new(&centrodes, total, to));
        }
        let mut last = 0;
        let hints = (0..intervals)
            .map(|i| {
                let s = total * i as f64 / intervals as f64;
                while last + 1 < intervals && knots[last + 1].s <= s {
                    last += 1;
                }
                last as u32
            })
            .collect();
        Self { centrodes, offset, knots, hints }
    }

    /// The pitch curves that roll.
    pub(crate) fn centrodes(&self) -> &Centrodes {
        &self.centrodes
    }

    /// Follower angle at driver angle `phi`, radians.
    pub(crate) fn follower_angle(&self, phi: f64) -> f64 {
        self.centrodes.transmission.psi(phi) + self.offset
    }

    /// Arc length of one period of the motion, mm.
    pub(crate) fn period(&self) -> f64 {
        self.knots[self.knots.len() - 1].s
    }

    /// Periods of the motion in one turn of the follower.
    pub(crate) fn follower_fold(&self) -> u32 {
        self.centrodes.transmission.follower_fold()
    }

    /// Periods of the motion in one whole cycle of both gears.
    pub(crate) fn cycle_periods(&self) -> u32 {
        self.centrodes.transmission.cycle_periods()
    }

    /// Driver angle at arc length `s`, any real.
    pub(crate) fn driver_angle(&self, s: f64) -> f64 {
        let turns = (s / self.period()).floor();
        let rest = s - turns * self.period();
        let hint = (rest / self.period() * self.hints.len() as f64) as usize;
        let mut i = self.hints[hint.min(self.hints.len() - 1)] as usize;
        while i + 2 < self.knots.len() && self.knots[i + 1].s <= rest {
            i += 1;
        }
        while i > 0 && self.knots[i].s > rest {
            i -= 1;
        }
        turns * self.centrodes.transmission.driver_period()
            + between(&self.knots[i], &self.knots[i + 1], rest)
    }

    /// Arc length rolled at driver angle `phi`, any real.
    pub(crate) fn arc(&self, phi: f64) -> f64 {
        let period = self.centrodes.transmission.driver_period();
        let turns = (phi / period).floor();
        let rest = phi - turns * period;
        let last = self.knots.len() - 2;
        let knot = &self.knots[((rest / period * (last + 1) as f64) as usize).min(last)];
        turns * self.period() + knot.s + arc_between(&self.centrodes, knot.angle, rest)
    }

    /// The instant at which arc length `s` has been rolled.
    pub(crate) fn at(&self, s: f64) -> Instant {
        let phi = self.driver_angle(s);
        let c = &self.centrodes;
        let psi = self.follower_angle(phi);
        let r = c.driver_radius(phi);
        let (sin_lean, cos_lean) = c.lean(phi).sin_cos();
        let tangent = Vector::new(sin_lean, -cos_lean);
        Instant {
            s,
            driver_turn: phi.sin_cos(),
            follower_turn: psi.sin_cos(),
            pitch: Point::new(r, 0.0),
            tangent,
            normal: quarter_turn(tangent),
            curvatures: c.curvatures(phi),
            center_distance: c.center_distance,
        }
    }

    /// Foot of the perpendicular from `p` (frame of `side`) on that gear's pitch curve near arc
    /// length `guess`: the foot's arc length and the signed distance, outward positive.
    pub(crate) fn foot(&self, side: Side, p: Point, guess: f64) -> (f64, f64) {
        let mut s = guess;
        let mut distance = 0.0;
        for _ in 0..policy::FOOT_NEWTON_STEPS {
            let frame = self.at(s).local(side);
            let d = p - frame.at;
            distance = d.dot(&frame.normal);
            let stretch = (1.0 + frame.curvature * distance).max(policy::FOOT_MIN_STRETCH);
            let move_by = d.dot(&frame.tangent) / stretch;
            s += move_by;
            if move_by.abs() < policy::FOOT_TOLERANCE * self.period() {
                break;
            }
        }
        (s, distance)
    }
}

/// The driver angle at arc length `s` between two knots.
fn between(a: &Knot, b: &Knot, s: f64) -> f64 {
    let h = b.s - a.s;
    let t = (s - a.s) / h;
    // What the quadratic through the first knot leaves at the second: value, slope, bend.
    let d0 = b.angle - (a.angle + h * (a.slope + 0.5 * h * a.bend));
    let d1 = h * (b.slope - a.slope - h * a.bend);
    let d2 = h * h * (b.bend - a.bend);
    let c3 = 10.0 * d0 - 4.0 * d1 + 0.5 * d2;
    let c4 = -15.0 * d0 + 7.0 * d1 - d2;
    let c5 = 6.0 * d0 - 3.0 * d1 + 0.5 * d2;
    a.angle + t * (h * a.slope + t * (0.5 * h * h * a.bend + t * (c3 + t * (c4 + t * c5))))
}

fn arc_between(centrodes: &Centrodes, from: f64, to: f64) -> f64 {
    let (mid, half) = (0.5 * (from + to), 0.5 * (to - from));
    GAUSS.iter().map(|(x, w)| w * centrodes.arc_speed(mid + half * x)).sum::<f64>() * half
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pitch::Transmission;
    use std::f64::consts::TAU;

    fn centrodes(samples: usize) -> Centrodes {
        let law = |i: usize| {
            let t = TAU * i as f64 / samples as f64;
            (0.5 * (2.0 * t).cos() + 0.3 * (5.0 * t).sin() + 0.1 * (9.0 * t).cos()).exp()
        };
        let values: Vec<f64> = (0..samples).map(law).collect();
        let transmission = Transmission::from_derivative(&values, 1, 1).unwrap();
        Centrodes { transmission, center_distance: 80.0 }
    }

    #[test]
    fn arc_length_and_driver_angle_are_inverse() {
        for samples in [512, 1024, 3000] {
            let centrodes = centrodes(samples);
            let rolling = Rolling::new(&centrodes);
            // On every knot of psi', off nearly every other knot of the table.
            let steps = 7 * samples as i32;
            let at = |i: i32| TAU * f64::from(i) / f64::from(steps);
            let mut arc = 0.0;
            for i in 0..steps {
                assert!((rolling.arc(at(i)) - arc).abs() < 1e-9, "{samples} {i}");
                let found = rolling.driver_angle(arc + rolling.period()) - TAU;
                assert!((found - at(i)).abs() < 1e-11, "{samples} {i}: {:e}", found - at(i));
                arc += arc_between(&centrodes, at(i), at(i + 1));
            }
        }
    }

    #[test]
    fn circles_roll_evenly() {
        let transmission = Transmission::from_derivative(&[0.5; 16], 2, 1).unwrap();
        let centrodes = Centrodes { transmission, center_distance: 90.0 };
        let rolling = Rolling::new(&centrodes);
        for i in -50..50 {
            let s = 7.3 * f64::from(i);
            assert!((rolling.driver_angle(s) - s / 60.0).abs() < 1e-12);
        }
    }
}
