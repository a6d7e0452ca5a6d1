//! What a refinement makes small, with its gradient.
//!
//! J = t d_D + (1 - t) d_F + kappa omega max psi' + penalties, d = 1 - I / (2 - I): with pitch curve and drawing of area 1
//! each, I is the area they share and d is one minus intersection over union. I is the line integral of the drawing's
//! [`Field`] along the pitch curve; max psi' is a soft maximum; the penalties grow with the square of what lies over the
//! bounds on psi' and on the lean, and with the bend of ln psi'.

use std::cell::RefCell;
use std::f64::consts::{PI, TAU};

use argmin::core::{CostFunction, Error, Executor, Gradient, State};
use argmin::solver::linesearch::MoreThuenteLineSearch;
use argmin::solver::quasinewton::LBFGS;

use super::field::Field;
use super::law::{Basis, Sensitivity, Series};
use crate::control::Control;
use crate::fit::Ratio;
use crate::gear::Gearing;
use crate::geometry::{Point, Vector};

/// Sharpness of the soft maximum of psi', over the mean of psi'.
const SOFT_MAXIMUM: f64 = 30.0;
/// Weight of the squares of what exceeds the bounds on psi' (over its mean) and on the tangent of the lean.
const PENALTY: f64 = 4.0;
/// Weight of the square of ln psi's bend: between equal likenesses the smoother law is taken.
const STIFFNESS: f64 = 1e-7;
/// Steps that L-BFGS remembers.
const MEMORY: usize = 12;
/// Change of value and length of the gradient at which L-BFGS stops.
const TOLERANCE: f64 = 1e-6;
/// Numbers before the coefficients of the law: centre (x, y) and angle of the driver's drawing, then the follower's.
pub(super) const PLACES: usize = 6;

/// What is asked of a pair, the same at every resolution.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wish {
    pub(super) ratio: Ratio,
    /// Weight of the driver's likeness.
    pub(super) balance: f64,
    /// kappa omega.
    pub(super) torque: f64,
    /// Greatest psi' allowed.
    pub(super) most: f64,
    /// Greatest tangent of the lean allowed.
    pub(super) steepest: f64,
    /// Whether the driver's and the follower's axis stay where they are.
    pub(super) held: [bool; 2],
}

impl Wish {
    pub(super) fn mean(&self) -> f64 {
        1.0 / self.ratio.value()
    }

    pub(super) fn period(&self) -> f64 {
        TAU / f64::from(self.ratio.driver_fold())
    }
}

/// A point with its value and gradient.
type Known = (Vec<f64>, f64, Vec<f64>);

/// The cost at one resolution.
pub(super) struct Cost<'a> {
    pub(super) wish: &'a Wish,
    pub(super) basis: &'a Basis,
    /// Of the driver's and the follower's drawing.
    pub(super) fields: [&'a Field; 2],
    /// The last point asked for: the optimiser wants value and gradient one after the other.
    last: RefCell<Option<Known>>,
    control: &'a Control,
}

impl<'a> Cost<'a> {
    pub(super) fn new(wish: &'a Wish, basis: &'a Basis, fields: [&'a Field; 2]) -> Self {
        let control = Control::unwatched();
        Self { wish, basis, fields, last: RefCell::new(None), control }
    }

    /// The same, to be given up once `control` is cancelled.
    pub(super) fn under(self, control: &'a Control) -> Self {
        Self { control, ..self }
    }

    /// J and its gradient.
    pub(super) fn both(&self, x: &[f64]) -> (f64, Vec<f64>) {
        let (wish, n) = (self.wish, self.basis.places);
        let (mean, period) = (wish.mean(), wish.period());
        let series = self.basis.series(&x[PLACES..], mean, period);
        let mut gradient = vec![0.0; x.len()];
        let mut by = Sensitivity { speed: vec![0.0; n], slope: vec![0.0; n], turn: vec![0.0; n] };
        let mut value = 0.0;
        let (fd, ff) = (wish.ratio.driver_fold(), wish.ratio.follower_fold());
        if wish.balance > 0.0 {
            // Clockwise in the driver's own angle.
            let gear = Turned { field: self.fields[0], fold: fd, sense: -1.0, share: wish.balance };
            let radii = series.speed.iter().map(|&p| Gearing::External.radii(1.0, p).driver);
            let angles = (0..n).map(|i| -period * i as f64 / n as f64);
            let (j, g) = gear.unlikeness(&x[..3], radii.zip(angles), &mut gradient[..3]);
            value += j;
            for (i, (radius, _)) in g.iter().enumerate() {
                by.speed[i] += radius * steepness(series.speed[i]);
            }
        }
        if wish.balance < 1.0 {
            let share = 1.0 - wish.balance;
            let gear = Turned { field: self.fields[1], fold: ff, sense: 1.0, share };
            let radii = series.speed.iter().map(|&p| Gearing::External.radii(1.0, p).follower);
            let angles = series.turn.iter().map(|psi| PI + psi);
            let (j, g) = gear.unlikeness(&x[3..6], radii.zip(angles), &mut gradient[3..6]);
            value += j;
            for (i, (radius, angle)) in g.iter().enumerate() {
                by.speed[i] -= radius * steepness(series.speed[i]);
                by.turn[i] += angle;
            }
        }
        value += self.torque(&series, &mut by);
        value += self.bounds(&series, &mut by);
        self.basis.pull_back(&series, &by, mean, period, &mut gradient[PLACES..]);
        for gear in [0, 1].into_iter().filter(|gear| wish.held[*gear]) {
            gradient[3 * gear..][..2].fill(0.0);
        }
        let waves = self.basis.waves;
        for (k, c) in x[PLACES..].iter().enumerate() {
            let stiffness = STIFFNESS * ((k % waves + 1) as f64).powi(4);
            value += 0.5 * stiffness * c * c;
            gradient[PLACES + k] += stiffness * c;
        }
        (value, gradient)
    }

    /// kappa omega times a soft maximum of psi'.
    fn torque(&self, series: &Series, by: &mut Sensitivity) -> f64 {
        if self.wish.torque == 0.0 {
            return 0.0;
        }
        let sharpness = SOFT_MAXIMUM / self.wish.mean();
        let most = series.speed.iter().copied().fold(0.0, f64::max);
        let shares: Vec<f64> =
            series.speed.iter().map(|p| (sharpness * (p - most)).exp()).collect();
        let total: f64 = shares.iter().sum();
        for (g, s) in by.speed.iter_mut().zip(&shares) {
            *g += self.wish.torque * s / total;
        }
        self.wish.torque * (most + (total / shares.len() as f64).ln() / sharpness)
    }

    fn bounds(&self, series: &Series, by: &mut Sensitivity) -> f64 {
        let n = self.basis.places as f64;
        let weight = PENALTY / n;
        let mut value = 0.0;
        for i in 0..self.basis.places {
            let (p, v) = (series.speed[i], series.slope[i]);
            let over = (p - self.wish.most) / self.wish.mean();
            if over > 0.0 {
                value += weight * over * over;
                by.speed[i] += 2.0 * weight * over / self.wish.mean();
            }
            // v = d ln psi' / d phi, of which d ln r_D / d phi is the share r_F of L.
            let share = Gearing::External.radii(1.0, p).follower;
            let lean = v * share;
            let over = lean.abs() - self.wish.steepest;
            if over > 0.0 {
                value += weight * over * over;
                let by_lean = 2.0 * weight * over * lean.signum();
                by.slope[i] += by_lean * share;
                by.speed[i] -= by_lean * lean * share;
            }
        }
        value
    }

    /// The best point found from `start` in at most `rounds` rounds of L-BFGS; never worse than the start.
    pub(super) fn improved(self, start: &[f64], rounds: u64) -> (Vec<f64>, f64) {
        let start = start.to_vec();
        let value = self.both(&start).0;
        let search = MoreThuenteLineSearch::new();
        let solver = LBFGS::new(search, MEMORY)
            .with_tolerance_grad(TOLERANCE)
            .and_then(|s| s.with_tolerance_cost(TOLERANCE));
        let Ok(solver) = solver else {
            return (start, value);
        };
        let run = Executor::new(self, solver)
            .configure(|state| state.param(start.clone()).max_iters(rounds))
            .timer(false)
            .run();
        // A line search that finds nothing better ends the run with an error; the start stands.
        match run {
            Ok(done) => {
                let state = done.state();
                let cost = state.get_best_cost();
                match state.get_best_param() {
                    Some(x) if cost < value => (x.clone(), cost),
                    _ => (start, value),
                }
            }
            Err(_) => (start, value),
        }
    }

    fn cached(&self, x: &[f64]) -> (f64, Vec<f64>) {
        if let Some((at, value, gradient)) = &*self.last.borrow()
            && at == x
        {
            return (*value, gradient.clone());
        }
        let (value, gradient) = self.both(x);
        *self.last.borrow_mut() = Some((x.to_vec(), value, gradient.clone()));
        (value, gradient)
    }
}

impl CostFunction for Cost<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, x: &Vec<f64>) -> Result<f64, Error> {
        self.control.check()?;
        Ok(self.cached(x).0)
    }
}

impl Gradient for Cost<'_> {
    type Param = Vec<f64>;
    type Gradient = Vec<f64>;

    fn gradient(&self, x: &Vec<f64>) -> Result<Vec<f64>, Error> {
        self.control.check()?;
        Ok(self.cached(x).1)
    }
}

/// One gear's pitch curve over one period, to be repeated `fold` times, seen in its drawing.
struct Turned<'a> {
    field: &'a Field,
    fold: u32,
    /// -1 if the points run clockwise.
    sense: f64,
    share: f64,
}

impl Turned<'_> {
    /// `share` times d and its derivatives: by centre and angle of the drawing (added to `placed`) and by radius and angle of
    /// every point of one period.
    fn unlikeness(
        &self,
        place: &[f64],
        polar: impl Iterator<Item = (f64, f64)>,
        placed: &mut [f64],
    ) -> (f64, Vec<(f64, f64)>) {
        let one: Vec<(f64, f64)> = polar.collect();
        let n = one.len();
        let fold = self.fold as usize;
        let count = n * fold;
        // Turned back by the drawing's angle: points about the axis in the drawing's directions.
        let window = self.sense * TAU / fold as f64;
        let points: Vec<Vector> = (0..count)
            .map(|k| {
                let (r, angle) = one[k % n];
                let (sin, cos) = (angle + window * (k / n) as f64 - place[2]).sin_cos();
                Vector::new(r * cos, r * sin)
            })
            .collect();
        let around = |k: usize| (points[(k + count - 1) % count], points[(k + 1) % count]);
        let doubled: f64 = (0..count)
            .map(|k| {
                let (before, after) = around(k);
                points[k].x * (after.y - before.y)
            })
            .sum();
        // Curve and drawing have one area, 1 in the drawing's unit.
        let area = 0.5 * self.sense * doubled;
        let scale = 1.0 / area.sqrt();
        let center = Point::new(place[0], place[1]);
        let fields: Vec<[f64; 3]> =
            points.iter().map(|q| self.field.at(center + scale * q)).collect();
        let height = |k: usize| {
            let (before, after) = around(k);
            scale * (after.y - before.y)
        };
        let shared: f64 =
            0.5 * self.sense * (0..count).map(|k| fields[k][0] * height(k)).sum::<f64>();
        let rest = 2.0 - shared;
        let unlike = 1.0 - shared / rest;
        let by_shared = -self.share * 2.0 / (rest * rest);
        let half = 0.5 * self.sense * by_shared;
        // By the points in the drawing.
        let by: Vec<Vector> = (0..count)
            .map(|k| {
                let (before, after) =
                    (fields[(k + count - 1) % count][0], fields[(k + 1) % count][0]);
                let h = height(k);
                Vector::new(half * fields[k][1] * h, half * (fields[k][2] * h + before - after))
            })
            .collect();
        let mut by_scale = 0.0;
        for (q, g) in points.iter().zip(&by) {
            placed[0] += g.x;
            placed[1] += g.y;
            placed[2] += scale * (g.x * q.y - g.y * q.x);
            by_scale += g.dot(q);
        }
        // d scale = -scale / (2 area) d area, and d area by a point is half the chord across it, turned.
        let by_area = -by_scale * scale / (2.0 * area);
        let mut out = vec![(0.0, 0.0); n];
        for k in 0..count {
            let (before, after) = around(k);
            let across = 0.5 * self.sense * by_area;
            let g = Vector::new(
                scale * by[k].x + across * (after.y - before.y),
                scale * by[k].y + across * (before.x - after.x),
            );
            let q = points[k];
            let o = &mut out[k % n];
            o.0 += g.dot(&q) / one[k % n].0;
            o.1 += g.y * q.x - g.x * q.y;
        }
        (self.share * unlike, out)
    }
}

/// Derivative of the driver's pitch radius by psi', for a centre distance of 1; the follower's is its negative.
fn steepness(speed: f64) -> f64 {
    Gearing::External.radii(1.0, speed).follower.powi(2)
}
