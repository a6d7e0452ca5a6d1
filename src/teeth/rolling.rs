//! Two pitch curves rolling on each other, addressed by the rolled arc length.
//!
//! Arc length `s` (mm) grows with the driver angle and is the same on both
//! gears. In the driver's own frame it runs clockwise, in the follower's
//! counter-clockwise. All frames follow `Centrodes`: world x axis along the
//! line of centres, driver axis at the origin, follower axis at (L, 0).

use crate::geometry::{Point, Vector, quarter_turn};
use crate::pitch::Centrodes;
use crate::policy;

/// Which gear of the pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The gear that is turned.
    Driver,
    /// The gear that answers.
    Follower,
}

impl Side {
    /// The other gear.
    #[must_use]
    pub fn partner(self) -> Self {
        match self {
            Self::Driver => Self::Follower,
            Self::Follower => Self::Driver,
        }
    }

    /// +1 for the driver, whose outward normal the rack height is measured along; -1 for the follower.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::Driver => 1.0,
            Self::Follower => -1.0,
        }
    }
}

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
#[derive(Debug)]
pub(crate) struct Rolling<'a> {
    centrodes: &'a Centrodes,
    /// Arc length at uniform knots of the driver angle over one period.
    knots: Vec<f64>,
    step: f64,
}

/// Nodes and weights of five-point Gauss-Legendre quadrature on [-1, 1].
const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

impl<'a> Rolling<'a> {
    pub(crate) fn new(centrodes: &'a Centrodes) -> Self {
        let intervals = centrodes.transmission.samples().len().max(policy::ROLLING_INTERVALS);
        let step = centrodes.transmission.driver_period() / intervals as f64;
        let mut knots = Vec::with_capacity(intervals + 1);
        let mut total = 0.0;
        knots.push(0.0);
        for i in 0..intervals {
            total += arc_between(centrodes, i as f64 * step, (i + 1) as f64 * step);
            knots.push(total);
        }
        Self { centrodes, knots, step }
    }

    /// Arc length of one period of the motion, mm.
    pub(crate) fn period(&self) -> f64 {
        self.knots[self.knots.len() - 1]
    }

    /// Periods of the motion in one whole cycle of both gears.
    pub(crate) fn cycle_periods(&self) -> u32 {
        super::cycle_periods(&self.centrodes.transmission)
    }

    /// Driver angle at arc length `s`, any real.
    pub(crate) fn driver_angle(&self, s: f64) -> f64 {
        let turns = (s / self.period()).floor();
        let rest = s - turns * self.period();
        let i = self.knots.partition_point(|&k| k <= rest).clamp(1, self.knots.len() - 1) - 1;
        let start = i as f64 * self.step;
        let mut angle =
            start + self.step * (rest - self.knots[i]) / (self.knots[i + 1] - self.knots[i]);
        for _ in 0..policy::ROLLING_NEWTON_STEPS {
            let error = self.knots[i] + arc_between(self.centrodes, start, angle) - rest;
            angle -= error / self.centrodes.arc_speed(angle);
        }
        turns * self.centrodes.transmission.driver_period() + angle
    }

    /// The instant at which arc length `s` has been rolled.
    pub(crate) fn at(&self, s: f64) -> Instant {
        let phi = self.driver_angle(s);
        let c = self.centrodes;
        let psi = c.transmission.psi(phi);
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

fn arc_between(centrodes: &Centrodes, from: f64, to: f64) -> f64 {
    let (mid, half) = (0.5 * (from + to), 0.5 * (to - from));
    GAUSS.iter().map(|(x, w)| w * centrodes.arc_speed(mid + half * x)).sum::<f64>() * half
}
