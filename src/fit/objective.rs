//! The objective E of Eq. 11 for one choice of centres and shift.

use std::f64::consts::{PI, TAU};

use super::laws::{Law, directions};
use super::limits::{LimitCost, Limits, apply};
use super::sketch::{Sketch, Sketched};
use super::{FitError, Ratio};
use crate::control::Control;
use crate::gear::Side;
use crate::geometry::{Point, Vector};
use crate::pitch::PolarError;

/// Rotation centres in the drawings' own coordinates, and the driver angle at which the long gear's window starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Candidate {
    pub(super) driver: Point,
    pub(super) follower: Point,
    pub(super) shift: f64,
}

/// Choices that a search may not change.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fixed {
    /// Axis of the driver, in its drawing's coordinates.
    pub driver_axis: Option<Point>,
    /// Axis of the follower, in its drawing's coordinates.
    pub follower_axis: Option<Point>,
    /// How far the follower's drawing is turned (radians, counter-clockwise) while the driver's stands upright,
    /// on average over the cycle.
    pub orientation: Option<f64>,
}

impl Fixed {
    pub(super) fn is_finite(&self) -> bool {
        let known = |p: Option<Point>| p.is_none_or(|p| p.x.is_finite() && p.y.is_finite());
        known(self.driver_axis)
            && known(self.follower_axis)
            && self.orientation.is_none_or(f64::is_finite)
    }

    pub(super) fn axis(&self, side: Side) -> Option<Point> {
        match side {
            Side::Driver => self.driver_axis,
            Side::Follower => self.follower_axis,
        }
    }
}

/// Two shapes and all that judging a pair of centres needs, at one resolution.
pub(super) struct Problem<'a> {
    pub(super) driver: &'a [Point],
    pub(super) follower: &'a [Point],
    pub(super) ratio: Ratio,
    pub(super) limits: &'a Limits,
    pub(super) weight: f64,
    /// Weight of the driver's law in Eq. 14.
    pub(super) balance: f64,
    /// Weight of the area that cannot be seen from a centre.
    pub(super) star_weight: f64,
    /// Samples of one period.
    pub(super) samples: usize,
    pub(super) fixed: Fixed,
    /// Whose search it is.
    pub(super) control: &'a Control,
    driver_rays: Vec<Vector>,
    follower_rays: Vec<Vector>,
}

/// What a candidate is worth. `total` is what searches minimise.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Objective {
    /// E: `shape + weight * torque + limiting_cost + folding_cost + lost_cost`. For K = 1 and where no limit bites it is Eq. 11.
    pub total: f64,
    /// E_s, Delta of Eq. 12 and 13: integral of the squared difference of both shapes' laws over the driver's turn.
    pub shape: f64,
    /// E_tau: greatest psi' of the law as delivered, limits kept.
    pub torque: f64,
    /// omega.
    pub weight: f64,
    /// Further change of shape by the limits, in the measure of E_s (see [`LimitCost::shape`]).
    pub limiting_cost: f64,
    /// Change of the long gear's shape by repeating one window round it, in the measure of E_s; 0 for K = 1 and for
    /// shapes that have the symmetry. Eq. 12 sees only the window.
    pub folding_cost: f64,
    /// What the parts that cannot be seen from the axes count: the star weight times the mean of both shares of area that
    /// rays from the axes fill in, weighted by the balance. 0 for shapes that are star-shaped about their axes.
    pub lost_cost: f64,
}

/// A candidate's law before limits.
struct Blended {
    law: Vec<f64>,
    delta: f64,
    folding: f64,
    lost: f64,
    lost_area: (f64, f64),
    follower_law: Law,
}

/// A candidate worked out.
pub(super) struct Scored {
    pub(super) objective: Objective,
    /// Eq. 14 before limits.
    pub(super) blend: Vec<f64>,
    pub(super) limited: Vec<f64>,
    pub(super) cost: LimitCost,
    pub(super) follower_law: Law,
    pub(super) lost_area: (f64, f64),
}

impl<'a> Problem<'a> {
    pub(super) fn new(
        (driver, follower): (&'a [Point], &'a [Point]),
        ratio: Ratio,
        limits: &'a Limits,
        (weight, balance, star_weight): (f64, f64, f64),
        samples: usize,
    ) -> Self {
        let rays = |fold: u32| directions(samples * fold as usize);
        Self {
            driver,
            follower,
            ratio,
            limits,
            weight,
            balance,
            star_weight,
            samples,
            fixed: Fixed::default(),
            control: Control::unwatched(),
            driver_rays: rays(ratio.driver_fold()),
            follower_rays: rays(ratio.follower_fold()),
        }
    }

    /// The same at another resolution, on (perhaps simplified) outlines.
    pub(super) fn resampled(
        &self,
        shapes: (&'a [Point], &'a [Point]),
        samples: usize,
    ) -> Problem<'a> {
        Problem::new(shapes, self.ratio, self.limits, self.weights(), samples)
            .with_fixed(self.fixed)
            .with_control(self.control)
    }

    /// The same under other limits.
    pub(super) fn with_limits<'b>(&self, limits: &'b Limits) -> Problem<'b>
    where
        'a: 'b,
    {
        let shapes: (&'b [Point], &'b [Point]) = (self.driver, self.follower);
        Problem::new(shapes, self.ratio, limits, self.weights(), self.samples)
            .with_fixed(self.fixed)
            .with_control(self.control)
    }

    /// The same with choices that are not to be searched.
    pub(super) fn with_fixed(mut self, fixed: Fixed) -> Self {
        self.fixed = fixed;
        self
    }

    /// The same under a control: once that is cancelled every candidate is infinitely bad.
    pub(super) fn with_control(mut self, control: &'a Control) -> Self {
        self.control = control;
        self
    }

    /// The candidate with whatever is fixed put in its place.
    pub(super) fn pinned(&self, candidate: Candidate) -> Candidate {
        let fixed = &self.fixed;
        let follower = fixed.follower_axis.unwrap_or(candidate.follower);
        Candidate {
            driver: fixed.driver_axis.unwrap_or(candidate.driver),
            follower,
            shift: self.fixed_shift(follower).unwrap_or(candidate.shift),
        }
    }

    /// The shift that lets the follower's drawing begin at the fixed orientation, if there is one.
    pub(super) fn fixed_shift(&self, follower: Point) -> Option<f64> {
        let angle = self.fixed.orientation?;
        let moment = self.law(Side::Follower, follower).ok()?.moment_of(PI - angle);
        Some(match self.short_side() {
            Side::Driver => moment,
            Side::Follower => (-moment).rem_euclid(TAU),
        })
    }

    /// The same as a whole number of samples of the long gear's turn.
    pub(super) fn fixed_shift_samples(&self, follower: Point) -> Option<usize> {
        let whole = self.samples * self.windows();
        let steps = (self.fixed_shift(follower)? / self.step()).round();
        Some(steps.max(0.0) as usize % whole)
    }

    fn weights(&self) -> (f64, f64, f64) {
        (self.weight, self.balance, self.star_weight)
    }

    /// What the loss of a share of one drawing's area counts.
    pub(super) fn lost_cost(&self, side: Side, lost_area: f64) -> f64 {
        let share = if side == Side::Driver { self.balance } else { 1.0 - self.balance };
        self.star_weight * share * lost_area
    }

    /// Periods in the long gear's turn.
    pub(super) fn windows(&self) -> usize {
        self.ratio.driver_fold().max(self.ratio.follower_fold()) as usize
    }

    /// Which gear turns once a period.
    pub(super) fn short_side(&self) -> Side {
        if self.ratio.driver_fold() == 1 { Side::Driver } else { Side::Follower }
    }

    /// The short gear and the long one.
    pub(super) fn sides(&self) -> (Side, Side) {
        match self.short_side() {
            Side::Driver => (Side::Driver, Side::Follower),
            Side::Follower => (Side::Follower, Side::Driver),
        }
    }

    /// Driver angle of one sample step.
    pub(super) fn step(&self) -> f64 {
        TAU / f64::from(self.ratio.driver_fold()) / self.samples as f64
    }

    pub(super) fn folds(&self) -> (u32, u32) {
        (self.ratio.driver_fold(), self.ratio.follower_fold())
    }

    pub(super) fn law(&self, side: Side, center: Point) -> Result<Law, PolarError> {
        let (points, rays) = match side {
            Side::Driver => (self.driver, &self.driver_rays),
            Side::Follower => (self.follower, &self.follower_rays),
        };
        Law::new(points, center, rays, side, self.ratio)
    }

    /// Samples of psi' over the gear's whole turn, and the share of area that the centre loses.
    pub(super) fn whole_turn(
        &self,
        side: Side,
        center: Point,
    ) -> Result<(Vec<f64>, f64), PolarError> {
        let fold = if side == self.short_side() { 1 } else { self.windows() };
        let n = self.samples * fold;
        let law = self.law(side, center)?;
        Ok((law.sample(0.0, n, n), law.lost_area))
    }

    /// Eq. 14 on samples of the short law and the (scaled) window of the long one.
    pub(super) fn blend(&self, short: &[f64], window: impl Iterator<Item = f64>) -> Vec<f64> {
        let share =
            if self.short_side() == Side::Driver { self.balance } else { 1.0 - self.balance };
        short.iter().zip(window).map(|(a, b)| share * a + (1.0 - share) * b).collect()
    }

    /// Works a candidate out.
    pub(super) fn score(&self, candidate: &Candidate) -> Result<Scored, FitError> {
        let blended = self.blended(candidate)?;
        let (limited, cost) = apply(&blended.law, self.folds(), self.limits)?;
        Ok(Scored {
            objective: self.objective(blended.delta, (blended.folding, blended.lost), &cost),
            blend: blended.law,
            limited,
            cost,
            lost_area: blended.lost_area,
            follower_law: blended.follower_law,
        })
    }

    /// About E of a candidate, the limits' cost to first order; infinite for one that makes no pair.
    pub(super) fn sketched(&self, candidate: &Candidate) -> f64 {
        if self.control.is_cancelled() {
            return f64::INFINITY;
        }
        let Ok(blended) = self.blended(candidate) else {
            return f64::INFINITY;
        };
        let Sketched { shape, torque } =
            Sketch::new(self.folds(), self.limits, self.samples).of(&blended.law);
        blended.delta + blended.folding + blended.lost + shape + self.weight * torque
    }

    fn blended(&self, candidate: &Candidate) -> Result<Blended, FitError> {
        let driver = self.law(Side::Driver, candidate.driver)?;
        let follower = self.law(Side::Follower, candidate.follower)?;
        let n = self.samples;
        let whole = n * self.windows();
        let mean = 1.0 / self.ratio.value();
        let (short, long) = if self.short_side() == Side::Driver {
            (&driver, &follower)
        } else {
            (&follower, &driver)
        };
        let short = closed(short.sample(0.0, n, n), mean);
        let turn = long.sample(candidate.shift, whole, whole);
        let window = closed(turn[..n].to_vec(), mean);
        let folding = folding_cost(&turn, &window);
        let delta =
            short.iter().zip(&window).map(|(a, b)| (a - b) * (a - b)).sum::<f64>() * TAU / n as f64;
        let blend = self.blend(&short, window.into_iter());
        let lost = self.lost_cost(Side::Driver, driver.lost_area)
            + self.lost_cost(Side::Follower, follower.lost_area);
        Ok(Blended {
            law: blend,
            delta,
            folding,
            lost,
            lost_area: (driver.lost_area, follower.lost_area),
            follower_law: follower,
        })
    }

    /// E of a candidate; infinite for one that makes no pair.
    pub(super) fn total(&self, candidate: &Candidate) -> f64 {
        if self.control.is_cancelled() {
            return f64::INFINITY;
        }
        self.score(candidate).map_or(f64::INFINITY, |s| s.objective.total)
    }

    pub(super) fn objective(
        &self,
        shape: f64,
        (folding_cost, lost_cost): (f64, f64),
        cost: &LimitCost,
    ) -> Objective {
        let torque = cost.derivative.1;
        let total = shape + self.weight * torque + cost.shape + folding_cost + lost_cost;
        Objective {
            total,
            shape,
            torque,
            weight: self.weight,
            limiting_cost: cost.shape,
            folding_cost,
            lost_cost,
        }
    }
}

/// The samples scaled to a mean.
fn closed(mut samples: Vec<f64>, mean: f64) -> Vec<f64> {
    let scale = mean * samples.len() as f64 / samples.iter().sum::<f64>();
    samples.iter_mut().for_each(|v| *v *= scale);
    samples
}

/// Mean over the windows of the integral (over the driver's turn) of the squared difference between the long gear's own law and
/// `window` repeated.
pub(super) fn folding_cost(turn: &[f64], window: &[f64]) -> f64 {
    if turn.len() == window.len() {
        return 0.0;
    }
    let sum: f64 = turn.iter().zip(window.iter().cycle()).map(|(a, b)| (a - b) * (a - b)).sum();
    sum * TAU / turn.len() as f64
}

/// Greatest value of a list.
pub(super) fn greatest(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}
