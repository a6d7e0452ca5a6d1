//! Generalised involutes: the flanks that a straight rack flank generates on both pitch curves.
//!
//! While the rack rolls, its flank of pressure angle `alpha` that crosses the pitch line at arc
//! length `u` touches both gears at
//! `C(s) = P(s) + (u - s) cos(alpha) (T cos(alpha) + sigma N sin(alpha))`,
//! with `T`, `N` the common tangent and the normal towards the follower, `sigma` = +1 for the flank
//! on the driver tooth's greater-s side and -1 for the other. The contact normal always passes
//! through the pitch point, which is the law of gearing, so the two traces of `C` in the gears'
//! frames are conjugate for any pitch curve (Litvin and Fuentes, "Gear Geometry and Applied
//! Theory"; Baesel, arXiv:1905.02642).
//!
//! The driver's trace moves with speed `sin(alpha) + delta kappa_D cos(alpha)`, the follower's with
//! `sin(alpha) - delta kappa_F cos(alpha)`, where `delta = sigma (u - s)`: positive above the
//! driver's pitch curve, negative below. Where either vanishes that flank has a cusp (undercut).

use super::motions::Motions;
use super::rolling::{Instant, Rolling};
use crate::gear::Side;
use crate::geometry::Point;
use crate::policy;

/// A rack flank and how far along it the two gears may touch.
///
/// It belongs to the motion that the pair makes while flanks of its hand carry ([`Motions::of`]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Flank {
    /// Arc length of its motion where the flank crosses the pitch curves, mm.
    pub(crate) u: f64,
    /// Arc length of the designed motion where it would cross without clearance, mm.
    pub(crate) station: f64,
    /// +1 on the driver tooth's greater-s side, -1 on the lesser.
    pub(crate) sigma: f64,
    /// Pressure angle, radians.
    pub(crate) alpha: f64,
    /// Rolled length over which the driver's addendum is in contact, mm.
    pub(crate) driver_reach: f64,
    /// Rolled length over which the follower's addendum is in contact, mm.
    pub(crate) follower_reach: f64,
}

impl Flank {
    /// A flank at `station` that may not touch anywhere yet. Of the room that the motion of its hand leaves
    /// to the designed one each gear gives half.
    pub(crate) fn new(motions: &Motions, station: f64, sigma: f64, alpha: f64) -> Self {
        let phi = motions.designed().driver_angle(station);
        let own = motions.of(sigma);
        let centrodes = own.centrodes();
        let working = alpha + sigma * centrodes.lean(phi);
        let arm = centrodes.follower_radius(phi) * working.cos().max(0.0);
        let given = 0.5 * motions.lead(sigma, phi).abs() * arm / alpha.cos();
        let u = if motions.has_play() { own.arc(phi) - sigma * given } else { station };
        Self { u, station, sigma, alpha, driver_reach: 0.0, follower_reach: 0.0 }
    }

    /// The flank with the addendum of one gear in contact over `share` of its reach only.
    pub(crate) fn shortened(mut self, side: Side, share: f64) -> Self {
        self.set_reach(side, share * self.reach(side));
        self
    }

    /// Reach of the addendum of one gear.
    pub(crate) fn reach(&self, side: Side) -> f64 {
        match side {
            Side::Driver => self.driver_reach,
            Side::Follower => self.follower_reach,
        }
    }

    /// Sets the reach of the addendum of one gear.
    pub(crate) fn set_reach(&mut self, side: Side, reach: f64) {
        match side {
            Side::Driver => self.driver_reach = reach,
            Side::Follower => self.follower_reach = reach,
        }
    }

    /// The flank on one gear, moved into it by its quarter of the backlash.
    pub(crate) fn thinned(&self, side: Side, backlash: f64) -> Self {
        Self { u: self.u - 0.25 * backlash * self.sigma * side.sign(), ..*self }
    }

    /// Length of contact in rolled arc length, mm.
    pub(crate) fn contact_length(&self) -> f64 {
        self.driver_reach + self.follower_reach
    }

    /// The interval of arc length in which this flank touches.
    pub(crate) fn active(&self) -> (f64, f64) {
        let ends =
            (self.u - self.sigma * self.driver_reach, self.u + self.sigma * self.follower_reach);
        (ends.0.min(ends.1), ends.0.max(ends.1))
    }

    /// The flank with its contact held to an interval of arc length.
    pub(crate) fn active_within(mut self, low: f64, high: f64) -> Self {
        let (below, above) = (self.u - low, high - self.u);
        let (driver, follower) = if self.sigma < 0.0 { (above, below) } else { (below, above) };
        self.driver_reach = self.driver_reach.min(driver.max(0.0));
        self.follower_reach = self.follower_reach.min(follower.max(0.0));
        self
    }

    /// Working pressure angle at arc length `s` of the flank's own motion, radians: between the contact
    /// normal and the perpendicular to the line of centres.
    pub(crate) fn working_angle(&self, own: &Rolling, s: f64) -> f64 {
        self.alpha + self.sigma * own.at(s).slope()
    }

    /// Arc length at which the flank touches with `delta` (positive above the driver's pitch curve).
    pub(crate) fn arc_at(&self, delta: f64) -> f64 {
        self.u - self.sigma * delta
    }

    /// The contact point in the world when `instant.s` has been rolled.
    pub(crate) fn contact(&self, instant: &Instant) -> Point {
        let (sin, cos) = self.alpha.sin_cos();
        let along = (self.u - instant.s) * cos;
        instant.pitch + along * (cos * instant.tangent + self.sigma * sin * instant.normal)
    }

    /// Signed speeds of the contact point along the driver's and the follower's flank, per rolled length.
    pub(crate) fn speeds(&self, instant: &Instant) -> (f64, f64) {
        let (sin, cos) = self.alpha.sin_cos();
        let delta = self.sigma * (self.u - instant.s);
        let (driver, follower) = instant.curvatures;
        (sin + delta * driver * cos, sin - delta * follower * cos)
    }

    /// The point of this flank on one gear, in that gear's frame, for a given `delta`.
    pub(crate) fn point(&self, rolling: &Rolling, side: Side, delta: f64) -> Point {
        let instant = rolling.at(self.arc_at(delta));
        instant.to_local(side, self.contact(&instant))
    }

    /// The flank of one gear from `from` to `to` (values of `delta`), ends included, sampled so that
    /// its chords deviate from it by less than `tolerance` mm. Each point comes with its arc length.
    pub(crate) fn sample(
        &self,
        rolling: &Rolling,
        side: Side,
        (from, to): (f64, f64),
        tolerance: f64,
    ) -> Vec<Point> {
        let mut points = vec![self.point(rolling, side, from)];
        let last = self.point(rolling, side, to);
        self.refine(rolling, side, (from, points[0]), (to, last), tolerance, 0, &mut points);
        points.push(last);
        points
    }

    #[expect(clippy::too_many_arguments, reason = "the state of one recursion, used nowhere else")]
    fn refine(
        &self,
        rolling: &Rolling,
        side: Side,
        (d0, p0): (f64, Point),
        (d1, p1): (f64, Point),
        tolerance: f64,
        depth: u32,
        points: &mut Vec<Point>,
    ) {
        let dm = 0.5 * (d0 + d1);
        let pm = self.point(rolling, side, dm);
        let straight = distance_to_chord(pm, p0, p1) < tolerance;
        if depth >= policy::FLANK_MAX_DEPTH || (depth >= policy::FLANK_MIN_DEPTH && straight) {
            return;
        }
        self.refine(rolling, side, (d0, p0), (dm, pm), tolerance, depth + 1, points);
        points.push(pm);
        self.refine(rolling, side, (dm, pm), (d1, p1), tolerance, depth + 1, points);
    }
}

fn distance_to_chord(p: Point, a: Point, b: Point) -> f64 {
    let d = b - a;
    let length = d.norm();
    if length == 0.0 {
        return (p - a).norm();
    }
    ((p.x - a.x) * d.y - (p.y - a.y) * d.x).abs() / length
}

/// How far from the pitch point contact may go on the addendum of `side`: until either flank nears
/// its cusp or the point stands `addendum` mm above the designed pitch curve (on the curve of its own
/// motion the two corners of a tooth would be of different heights).
pub(crate) fn longest_reach(motions: &Motions, flank: &Flank, side: Side, addendum: f64) -> f64 {
    let rolling = motions.of(flank.sigma);
    let step = addendum / policy::REACH_STEPS_PER_ADDENDUM;
    let slowest = policy::FLANK_SLOWEST * flank.alpha.sin();
    let sound = |reach: f64| {
        let instant = rolling.at(flank.arc_at(side.sign() * reach));
        let (driver, follower) = flank.speeds(&instant);
        if driver < slowest || follower < slowest {
            return false;
        }
        let p = instant.to_local(side, flank.contact(&instant));
        motions.designed().foot(side, p, flank.station).1 <= addendum
    };
    let limit = addendum * policy::REACH_LIMIT;
    let mut good = 0.0;
    while good < limit && sound(good + step) {
        good += step;
    }
    if good == 0.0 && !sound(0.0) {
        return 0.0;
    }
    let mut bad = good + step;
    for _ in 0..policy::REACH_BISECTIONS {
        let mid = 0.5 * (good + bad);
        if sound(mid) {
            good = mid;
        } else {
            bad = mid;
        }
    }
    good
}
