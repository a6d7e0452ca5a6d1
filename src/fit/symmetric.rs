//! One shape for both gears, exactly: pairs whose two pitch curves are one curve (paper, Figure 15, top rows).
//!
//! With psi the motion, u = phi + psi(phi) runs through 4 pi in a turn, and q = 1 - 2 r_D / L as a function of u determines
//! the pair: d phi / d u = (1 + q) / 2, d psi / d u = (1 - q) / 2. On the follower the pitch point has 1 - 2 r_F / L = -q.
//! The follower is the driver turned by gamma when what one has at u the other has at 2 c - u, with c = gamma - pi:
//! q(2 c - u) = -q(u). So the law nearest to a shape's own is the odd part of its q about the best c, a series of sines.

use std::f64::consts::{PI, TAU};

use rayon::prelude::*;

use super::grid::{GRID_CENTERS, interior_grid, thinned};
use super::laws::directions;
use super::limits::{LimitCost, apply};
use super::objective::Objective;
use super::placement::{FittedGear, Similarity};
use super::{Fit, FitError, FitOptions, Ratio};
use crate::control::{Control, StageName};
use crate::geometry::{self, Point};
use crate::outline::Outline;
use crate::pitch::{Centrodes, PolarCurve, Transmission, driver_law};
use crate::policy;

/// A motion that is its own inverse up to the pose.
#[derive(Clone, Debug)]
pub struct Symmetric {
    /// psi' at even driver angles over the driver's turn.
    pub samples: Vec<f64>,
    /// The follower's pitch curve is the driver's turned by this angle, radians, counter-clockwise.
    pub turn: f64,
}

/// The motion nearest to `samples` (psi' at even driver angles over a turn, closing at ratio 1) with which both pitch curves are
/// one curve.
///
/// Waves of more than about a hundred to a turn are damped, so that the spline through the result is congruent to 1e-9.
///
/// # Errors
/// [`FitError::Transmission`] for samples that are no law.
pub fn symmetrised(samples: &[f64]) -> Result<Symmetric, FitError> {
    resampled(samples, policy::SYMMETRIC_SAMPLES)
}

/// [`symmetrised`] with `count` samples: fewer where a law is only to be judged.
fn resampled(samples: &[f64], count: usize) -> Result<Symmetric, FitError> {
    let law = Transmission::from_derivative(samples, 1, 1)?;
    let q = by_sum(&law, policy::SYMMETRIC_SUMS);
    let (mirror, _) = best_mirror(&q);
    let series = Series::odd_part(&q, mirror);
    // The driver stays where its own law has it, on average.
    let n = q.len();
    let step = 2.0 * TAU / n as f64;
    let away = (0..n)
        .map(|j| {
            let u = j as f64 * step;
            inverse_sum(&law, u) - series.driver_angle(u)
        })
        .sum::<f64>()
        / n as f64;
    let made: Vec<f64> = (0..count)
        .into_par_iter()
        .map(|i| {
            let q = series.value(series.sum_at(TAU * i as f64 / count as f64 - away));
            (1.0 - q) / (1.0 + q)
        })
        .collect();
    // The made motion's own sum starts from its own angle zero.
    let start = series.sum_at(-away);
    let turn = (PI + series.mirror - start).rem_euclid(TAU);
    Ok(Symmetric { samples: made, turn })
}

/// q at `n` even values of u = phi + psi over its period 4 pi.
fn by_sum(law: &Transmission, n: usize) -> Vec<f64> {
    let step = 2.0 * TAU / n as f64;
    (0..n)
        .map(|j| {
            let p = law.derivative(inverse_sum(law, j as f64 * step));
            (1.0 - p) / (1.0 + p)
        })
        .collect()
}

/// The driver angle at which phi + psi(phi) is `u`.
fn inverse_sum(law: &Transmission, u: f64) -> f64 {
    let (mut low, mut high) = (u - TAU, u + TAU);
    let mut phi = 0.5 * u;
    for _ in 0..policy::MAX_NEWTON_STEPS {
        let residual = phi + law.psi(phi) - u;
        if residual > 0.0 {
            high = phi;
        } else {
            low = phi;
        }
        let newton = phi - residual / (1.0 + law.derivative(phi));
        let next = if newton >= low && newton <= high { newton } else { 0.5 * (low + high) };
        if (next - phi).abs() <= f64::EPSILON * (1.0 + phi.abs()) {
            return next;
        }
        phi = next;
    }
    phi
}

/// The index m with which q[j] and -q[m - j] differ least, and what making them equal changes in the measure of E_s.
fn best_mirror(q: &[f64]) -> (usize, f64) {
    let n = q.len();
    // Squared change of psi' over d phi, for a change of q: 16 / (1 + q)^4 (1 + q) / 2.
    let weight: Vec<f64> = q.iter().map(|q| 8.0 / (1.0 + q).powi(3)).collect();
    let step = 2.0 * TAU / n as f64;
    (0..n)
        .into_par_iter()
        .map(|m| {
            let change: f64 = (0..n)
                .map(|j| {
                    let even = 0.5 * (q[j] + q[(m + n - j) % n]);
                    weight[j] * even * even
                })
                .sum();
            (m, change * step)
        })
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap_or((0, f64::INFINITY))
}

/// q as sines about its mirror c: `sum of b_k sin(k (u - c) / 2)`.
struct Series {
    mirror: f64,
    sines: Vec<f64>,
}

impl Series {
    fn odd_part(q: &[f64], mirror: usize) -> Self {
        let n = q.len();
        let step = 2.0 * TAU / n as f64;
        let mirror = 0.5 * mirror as f64 * step;
        let most = policy::SYMMETRIC_WAVES.min(n / 2 - 1);
        let sines = (1..=most)
            .into_par_iter()
            .map(|k| {
                let wave = |j: usize| (0.5 * k as f64 * (j as f64 * step - mirror)).sin();
                let sum: f64 = (0..n).map(|j| q[j] * wave(j)).sum();
                let damped = (-(k as f64 / policy::SYMMETRIC_DAMPING).powi(4)).exp();
                2.0 * sum / n as f64 * damped
            })
            .collect();
        Self { mirror, sines }
    }

    /// Sum over k of `sines[k] f(k, sin, cos)` at u; sines and cosines by addition.
    fn walk(&self, u: f64, f: impl Fn(f64, f64, f64) -> f64) -> f64 {
        let (s1, c1) = (0.5 * (u - self.mirror)).sin_cos();
        let (mut s, mut c) = (s1, c1);
        let mut total = 0.0;
        for (i, b) in self.sines.iter().enumerate() {
            total += b * f((i + 1) as f64, s, c);
            (s, c) = (s * c1 + c * s1, c * c1 - s * s1);
        }
        total
    }

    fn value(&self, u: f64) -> f64 {
        self.walk(u, |_, s, _| s)
    }

    /// phi at u, up to a constant: half of u and of the integral of q.
    fn driver_angle(&self, u: f64) -> f64 {
        0.5 * u - self.walk(u, |k, _, c| c / k)
    }

    /// The u at which [`Self::driver_angle`] is `phi`.
    fn sum_at(&self, phi: f64) -> f64 {
        let (mut low, mut high) = (2.0 * phi - 2.0 * TAU, 2.0 * phi + 2.0 * TAU);
        let mut u = 2.0 * phi;
        for _ in 0..policy::MAX_NEWTON_STEPS {
            let residual = self.driver_angle(u) - phi;
            if residual > 0.0 {
                high = u;
            } else {
                low = u;
            }
            let newton = u - 2.0 * residual / (1.0 + self.value(u));
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - u).abs() <= 4.0 * f64::EPSILON * (1.0 + u.abs()) {
                return next;
            }
            u = next;
        }
        u
    }
}

/// A candidate axis worked out.
struct Seat {
    raw: Vec<f64>,
    /// Limits kept, nearly symmetric.
    law: Vec<f64>,
    cost: LimitCost,
    shape: f64,
    lost_area: f64,
    total: f64,
}

fn seat(
    points: &[Point],
    axis: Point,
    options: &FitOptions,
    control: &Control,
) -> Result<Seat, FitError> {
    let curve = PolarCurve::along(points, axis, &directions(options.samples))?;
    let raw = driver_law(curve.radii(), curve.center_distance(1.0));
    let whole = Transmission::from_derivative(&raw, 1, 1)?;
    let shape = best_mirror(&by_sum(&whole, policy::MATE_SCAN_SAMPLES)).1;
    // The even part that is taken away may have held the lean down: a few rounds bring it back within its bound.
    let mut limits = options.limits;
    let mut law = raw.clone();
    let mut first = None;
    let mut torque = 0.0;
    for _ in 0..policy::SYMMETRIC_ROUNDS {
        control.check()?;
        let (limited, cost) = apply(&law, (1, 1), &limits)?;
        first.get_or_insert(cost);
        let made = resampled(&limited, policy::SYMMETRIC_SAMPLES_JUDGED)?;
        law = limited;
        let transmission = Transmission::from_derivative(&made.samples, 1, 1)?;
        torque = transmission.max_derivative();
        let lean = Centrodes { transmission, center_distance: 1.0 }.max_lean();
        let over = lean / options.limits.max_lean;
        let torque_over = options.limits.max_derivative.map_or(0.0, |most| torque / most);
        if over <= 1.0 + policy::LIMIT_ROUNDING && torque_over <= 1.0 + policy::LIMIT_ROUNDING {
            break;
        }
        limits.max_lean *= policy::LIMIT_TIGHTENING / over.max(1.0);
        if let Some(most) = &mut limits.max_derivative {
            *most = (*most / torque_over.max(1.0)).max(1.0);
        }
    }
    let cost = first.unwrap_or_default();
    let lost_area = curve.lost_area();
    let total = shape + cost.shape + options.weight * torque;
    Ok(Seat { raw, law, cost, shape, lost_area, total })
}

/// Fits a shape to itself so that both gears have the same pitch curve.
///
/// # Errors
/// [`FitError::Symmetric`] for two shapes, another ratio or a fixed pose; else see [`FitError`].
pub(super) fn fit_to_itself(
    driver: &Outline,
    follower: &Outline,
    ratio: Ratio,
    options: &FitOptions,
    control: &Control,
) -> Result<Fit, FitError> {
    let need = if ratio != Ratio::ONE {
        Some("at a ratio of 1")
    } else if driver != follower {
        Some("if both are made from one shape")
    } else if options.fixed.orientation.is_some() {
        Some("in a pose that is found, not fixed")
    } else {
        None
    };
    match need {
        Some(need) => Err(FitError::Symmetric { need }),
        None => fit_symmetric(driver, options, control),
    }
}

fn fit_symmetric(
    shape: &Outline,
    options: &FitOptions,
    control: &Control,
) -> Result<Fit, FitError> {
    let points = shape.points();
    let thin = thinned(points);
    let (axes, scored) = match options.fixed.driver_axis.or(options.fixed.follower_axis) {
        Some(axis) => (vec![axis], 1),
        None => {
            let rays = directions(policy::MATE_SCAN_SAMPLES);
            let rough = |axis: Point| -> Option<f64> {
                control.check().ok()?;
                let curve = PolarCurve::along(&thin, axis, &rays).ok()?;
                let law = driver_law(curve.radii(), curve.center_distance(1.0));
                let law = Transmission::from_derivative(&law, 1, 1).ok()?;
                let q = by_sum(&law, policy::MATE_SCAN_SAMPLES);
                Some(best_mirror(&q).1 + options.weight * law.max_derivative())
            };
            let (grid, _) = interior_grid(&thin, GRID_CENTERS);
            let scored = grid.len() + 1;
            let mut seats: Vec<(f64, Point)> = grid
                .into_par_iter()
                .chain([geometry::centroid(points)])
                .filter_map(|p| Some((rough(p)?, p)))
                .collect();
            seats.sort_by(|a, b| a.0.total_cmp(&b.0));
            (seats.into_iter().take(policy::SYMMETRIC_STARTS).map(|s| s.1).collect(), scored)
        }
    };
    let mut best: Option<(Point, Seat)> = None;
    let mut refused = FitError::NoCenter;
    let meter = control.meter(StageName::Wanted, axes.len());
    for axis in axes {
        let made = seat(points, axis, options, control);
        control.check()?;
        meter.add(1);
        match made {
            Ok(made) if best.as_ref().is_none_or(|b| made.total < b.1.total) => {
                best = Some((axis, made));
            }
            Ok(_) => {}
            Err(error) => refused = error,
        }
    }
    let (axis, seat) = best.ok_or(refused)?;
    let made = symmetrised(&seat.law)?;
    let transmission = Transmission::from_derivative(&made.samples, 1, 1)?;
    let torque = transmission.max_derivative();
    let centrodes = Centrodes { transmission, center_distance: 1.0 };
    let fitted = |curve: Vec<Point>, angle: f64| {
        let scale = (geometry::area(&curve) / geometry::area(points)).sqrt();
        let placement = Similarity { center: axis, angle, scale };
        FittedGear::laid(placement, (&curve, points), seat.lost_area)
    };
    let count = policy::PLACEMENT_SAMPLES;
    let driver = fitted(centrodes.driver_curve(count), 0.0);
    let follower = fitted(centrodes.follower_curve(count), made.turn);
    let objective = Objective {
        total: seat.shape + seat.cost.shape + options.weight * torque,
        shape: seat.shape,
        torque,
        weight: options.weight,
        limiting_cost: seat.cost.shape,
        folding_cost: 0.0,
        lost_cost: 0.0,
    };
    Ok(Fit {
        transmission: centrodes.transmission,
        raw: seat.raw,
        objective,
        limited: seat.cost,
        driver,
        follower,
        pairs_scored: scored,
        refinement: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::fit;

    fn egg() -> Outline {
        let r =
            |t: f64| 1.0 + 0.2 * t.cos() + 0.08 * (2.0 * t + 0.7).sin() + 0.04 * (5.0 * t).cos();
        let points = (0..800).map(|i| TAU * f64::from(i) / 800.0);
        Outline::new(points.map(|t| geometry::rotate(Point::new(r(t), 0.0), t)).collect()).unwrap()
    }

    /// Greatest difference of the follower's pitch curve and the driver's turned by `turn`.
    fn apart(made: &Transmission, turn: f64) -> f64 {
        let pair = Centrodes { transmission: made.clone(), center_distance: 1.0 };
        (0..997)
            .map(|i| {
                let phi = TAU * f64::from(i) / 997.0;
                let there = pair.driver_radius(turn - PI - made.psi(phi));
                (there - pair.follower_radius(phi)).abs()
            })
            .fold(0.0, f64::max)
    }

    #[test]
    fn both_pitch_curves_are_one() {
        let law: Vec<f64> = (0..512)
            .map(|i| TAU * f64::from(i) / 512.0)
            .map(|phi| 1.0 + 0.4 * (phi + 0.3).cos() + 0.15 * (3.0 * phi).sin())
            .collect();
        let made = symmetrised(&law).unwrap();
        let motion = Transmission::from_derivative(&made.samples, 1, 1).unwrap();
        assert!(apart(&motion, made.turn) < 1e-9, "{}", apart(&motion, made.turn));
        assert!(apart(&motion, made.turn + 0.1) > 1e-3);
    }

    #[test]
    fn a_law_that_is_its_own_inverse_stays() {
        // Ellipses about their foci.
        let e = 0.3;
        let exact = |phi: f64| (1.0 - e * e) / (1.0 + 2.0 * e * phi.cos() + e * e);
        let law: Vec<f64> = (0..1024).map(|i| exact(TAU * f64::from(i) / 1024.0)).collect();
        let made = symmetrised(&law).unwrap();
        let n = made.samples.len() as f64;
        for (i, v) in made.samples.iter().enumerate() {
            assert!((v - exact(TAU * i as f64 / n)).abs() < 1e-3, "{i} {v}");
        }
    }

    #[test]
    fn a_shape_is_fitted_to_itself() {
        let options = FitOptions { symmetric: true, samples: 256, ..FitOptions::default() };
        let made = fit(&egg(), &egg(), Ratio::ONE, &options, Control::unwatched()).unwrap();
        let turn = made.follower.placement.angle;
        assert!(apart(&made.transmission, turn) < 1e-9, "{}", apart(&made.transmission, turn));
        assert!((made.driver.iou - made.follower.iou).abs() < 1e-6);
        assert!(made.driver.iou > 0.9, "{}", made.driver.iou);
        let round = Outline::new(egg().points().iter().map(|p| p * 2.0).collect()).unwrap();
        assert!(matches!(
            fit(&egg(), &round, Ratio::ONE, &options, Control::unwatched()),
            Err(FitError::Symmetric { .. })
        ));
        let two = Ratio::integer(2).unwrap();
        assert!(matches!(
            fit(&egg(), &egg(), two, &options, Control::unwatched()),
            Err(FitError::Symmetric { .. })
        ));
    }
}
