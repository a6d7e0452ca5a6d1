//! One shape as the driver; its mate follows by formula (Eq. 7 to 9 of the paper).

use rayon::prelude::*;

use super::grid::{GRID_CENTERS, interior_grid, thinned};
use super::laws::directions;
use super::limits::{LimitCost, Limits, apply};
use super::objective::{folding_cost, greatest};
use super::placement::{FittedGear, Similarity};
use super::{FitError, FitOptions, Ratio, check, refine};
use crate::control::{Control, StageName};
use crate::geometry::{self, Point};
use crate::outline::Outline;
use crate::pitch::{Centrodes, PolarCurve, Transmission, driver_law};
use crate::policy;

/// A shape placed on its axis, with the motion that it imposes on its mate.
#[derive(Clone, Debug)]
pub struct Mated {
    /// The pair's motion, limits kept. At driver angle 0 the drawing stands upright.
    pub transmission: Transmission,
    /// psi' before limits, at the driver angles of [`Transmission::samples`].
    pub raw: Vec<f64>,
    /// What the limits changed.
    pub limited: LimitCost,
    /// The drawing in its gear.
    pub driver: FittedGear,
    /// Cost of the axis: what limits and folding changed in the measure of E_s, the weighted greatest psi', and the
    /// share of area hidden from the axis.
    pub cost: f64,
}

/// One axis worked out.
struct Seat {
    raw: Vec<f64>,
    limited: Vec<f64>,
    change: LimitCost,
    lost_area: f64,
    cost: f64,
}

/// All that judging an axis needs, at one resolution.
struct Task<'a> {
    points: &'a [Point],
    ratio: Ratio,
    limits: &'a Limits,
    weight: f64,
    samples: usize,
    control: &'a Control,
}

impl Task<'_> {
    /// psi' = r / (L - r) with L from Eq. 9; over one period, the mean of all where the driver must repeat itself.
    fn seat(&self, axis: Point) -> Result<Seat, FitError> {
        let folds = (self.ratio.driver_fold(), self.ratio.follower_fold());
        let n = self.samples;
        let rays = directions(n * folds.0 as usize);
        let curve = PolarCurve::along(self.points, axis, &rays)?;
        let whole = driver_law(curve.radii(), curve.center_distance(self.ratio.value()));
        let raw: Vec<f64> = (0..n)
            .map(|i| whole.iter().skip(i).step_by(n).sum::<f64>() / f64::from(folds.0))
            .collect();
        let folding = folding_cost(&whole, &raw);
        let (limited, change) = apply(&raw, folds, self.limits)?;
        let lost_area = curve.lost_area();
        let cost = change.shape + folding + self.weight * greatest(&limited) + lost_area;
        Ok(Seat { raw, limited, change, lost_area, cost })
    }

    fn cost(&self, axis: Point) -> f64 {
        if self.control.is_cancelled() {
            return f64::INFINITY;
        }
        self.seat(axis).map_or(f64::INFINITY, |s| s.cost)
    }
}

/// Makes a shape the driver of a pair, and its mate by formula.
///
/// The axis is [`super::Fixed::driver_axis`], or the point inside the shape that costs least. The centre distance
/// solves Eq. 9. At a ratio of m/n the driver must be n-fold symmetric: the mean of its n parts is taken, and what that changes
/// counts as a cost.
///
/// # Errors
/// See [`FitError`].
pub fn mate(
    driver: &Outline,
    ratio: Ratio,
    options: &FitOptions,
    control: &Control,
) -> Result<Mated, FitError> {
    check(ratio, options)?;
    let made = control.run(|| mated(driver, ratio, options, control));
    control.check()?;
    control.progress(StageName::Wanted, 1.0);
    made
}

fn mated(
    driver: &Outline,
    ratio: Ratio,
    options: &FitOptions,
    control: &Control,
) -> Result<Mated, FitError> {
    let points = driver.points();
    let task = Task {
        points,
        ratio,
        limits: &options.limits,
        weight: options.weight,
        samples: options.samples,
        control,
    };
    let folds = (ratio.driver_fold(), ratio.follower_fold());
    apply(&[1.0; policy::MIN_TRANSMISSION_SAMPLES], folds, &options.limits)?;
    let axis = match options.fixed.driver_axis {
        Some(axis) => axis,
        None => best_axis(&task).ok_or(FitError::NoCenter)?,
    };
    let seat = task.seat(axis)?;
    let transmission = Transmission::from_derivative(&seat.limited, folds.0, folds.1)?;
    let centrodes = Centrodes { transmission, center_distance: 1.0 };
    let curve = centrodes.driver_curve(policy::PLACEMENT_SAMPLES * folds.0 as usize);
    let scale = (geometry::area(&curve) / geometry::area(points)).sqrt();
    let placement = Similarity { center: axis, angle: 0.0, scale };
    Ok(Mated {
        transmission: centrodes.transmission,
        raw: seat.raw,
        limited: seat.change,
        driver: FittedGear::laid(placement, (&curve, points), seat.lost_area),
        cost: seat.cost,
    })
}

/// The best points of a grid, refined; none if no point inside serves.
fn best_axis(task: &Task<'_>) -> Option<Point> {
    let points = thinned(task.points);
    let limits = Limits { max_curvature: None, ..*task.limits };
    let scan = Task {
        points: &points,
        limits: &limits,
        samples: policy::MATE_SCAN_SAMPLES.min(task.samples),
        ..*task
    };
    let (grid, spacing) = interior_grid(&points, GRID_CENTERS);
    let middle = geometry::centroid(&points);
    let mut seats: Vec<(f64, Point)> =
        grid.into_par_iter().chain([middle]).map(|p| (scan.cost(p), p)).collect();
    task.control.progress(StageName::Wanted, 0.5);
    seats.retain(|s| s.0.is_finite());
    seats.sort_by(|a, b| a.0.total_cmp(&b.0));
    seats.truncate(policy::MATE_STARTS);
    let mut ends: Vec<(f64, Point)> = seats
        .par_iter()
        .map(|(_, start)| {
            let steps = [spacing; 2];
            let (x, cost) =
                refine::simplex([start.x, start.y], steps, policy::MATE_EVALUATIONS, |x| {
                    scan.cost(Point::new(x[0], x[1]))
                });
            (cost, Point::new(x[0], x[1]))
        })
        .collect();
    ends.extend(seats);
    ends.sort_by(|a, b| a.0.total_cmp(&b.0));
    ends.into_iter().map(|e| e.1).find(|p| task.cost(*p).is_finite())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::fit::Fixed;

    fn polar(n: usize, r: impl Fn(f64) -> f64) -> Outline {
        let points = (0..n).map(|i| {
            let theta = TAU * i as f64 / n as f64;
            geometry::rotate(Point::new(r(theta), 0.0), theta)
        });
        Outline::new(points.collect()).unwrap()
    }

    fn about(axis: Point) -> FitOptions {
        let fixed = Fixed { driver_axis: Some(axis), ..Fixed::default() };
        FitOptions { fixed, ..FitOptions::default() }
    }

    #[test]
    fn an_ellipse_about_its_focus_mates_with_its_twin() {
        let e = 0.4;
        let ellipse = polar(4000, |t| (1.0 - e * e) / (1.0 + e * t.cos()));
        let mated =
            mate(&ellipse, Ratio::ONE, &about(Point::origin()), Control::unwatched()).unwrap();
        for k in 0..40 {
            let phi = 0.16 * f64::from(k);
            let exact = (1.0 - e * e) / (1.0 + 2.0 * e * phi.cos() + e * e);
            assert!((mated.transmission.derivative(phi) - exact).abs() < 1e-4);
        }
        assert!(mated.driver.iou > 0.999 && mated.limited.shape == 0.0);
    }

    #[test]
    fn the_best_axis_of_a_lobed_wheel_is_its_middle() {
        let wheel = polar(900, |t| 2.0 + 0.4 * (3.0 * t).cos());
        for ratio in [Ratio::ONE, Ratio::rational(2, 3).unwrap()] {
            let mated = mate(&wheel, ratio, &FitOptions::default(), Control::unwatched()).unwrap();
            let off = (mated.driver.center_in_input - Point::origin()).norm();
            assert!(off < 0.05, "{ratio}: {off}");
            assert!((mated.transmission.ratio() - ratio.value()).abs() < 1e-12);
        }
    }

    #[test]
    fn an_axis_outside_is_refused() {
        let wheel = polar(300, |_| 2.0);
        let error = mate(&wheel, Ratio::ONE, &about(Point::new(3.0, 0.0)), Control::unwatched())
            .unwrap_err();
        assert!(error.to_string().contains("(3.0000, 0.0000)"), "{error}");
    }
}
