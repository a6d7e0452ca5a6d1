use std::f64::consts::TAU;

use super::cost::{Cost, PLACES, Wish};
use super::field::Raster;
use super::law::Basis;
use super::*;
use crate::control::Control;
use crate::fit::{FitOptions, Limits, Ratio, Search, fit};
use crate::geometry::rotate;
use crate::outline::Outline;

fn polar_shape(n: usize, r: impl Fn(f64) -> f64) -> Outline {
    let points = (0..n).map(|i| {
        let theta = TAU * i as f64 / n as f64;
        rotate(Point::new(r(theta), 0.0), theta)
    });
    Outline::new(points.collect()).unwrap()
}

fn egg() -> Outline {
    polar_shape(300, |t| {
        1.0 + 0.25 * t.cos() + 0.08 * (2.0 * t + 0.7).sin() + 0.05 * (3.0 * t).cos()
    })
}

fn clover() -> Outline {
    polar_shape(400, |t| 2.0 + 0.6 * (3.0 * t).cos() + 0.3 * t.sin())
}

/// A bean: not star-shaped about most of its points.
fn bean() -> Outline {
    let point = |i: usize| {
        let t = TAU * f64::from(i as u32) / 300.0;
        let (x, y) = (1.6 * t.cos(), 0.5 * t.sin());
        Point::new(x, y + 0.55 * x * x)
    };
    Outline::new((0..300).map(point).collect()).unwrap()
}

fn options(refine: bool) -> FitOptions {
    FitOptions { search: Search::Paper, samples: 256, refine, ..FitOptions::default() }
}

#[test]
fn the_gradient_is_that_of_the_value() {
    for (text, balance) in [("1", 0.5), ("2", 0.3), ("1/3", 0.8)] {
        let wish = Wish {
            ratio: text.parse::<Ratio>().unwrap(),
            balance,
            torque: 0.05,
            most: 1.1,
            steepest: 0.3,
            held: [false; 2],
        };
        let drawings = [Drawing::new(egg().points()), Drawing::new(bean().points())];
        let fields = [0, 1].map(|i| Raster::new(&drawings[i].points).field(2.0));
        let basis = Basis::new(96, 5);
        let cost = Cost::new(&wish, &basis, [&fields[0], &fields[1]]);
        let mut x = vec![0.05, -0.08, 0.4, 0.11, -0.03, 2.0];
        x.extend((0..10).map(|k| 0.2 / f64::from(k + 1) * (f64::from(3 * k) + 1.0).sin()));
        let (_, gradient) = cost.both(&x);
        for k in 0..x.len() {
            let h = 1e-5;
            let at = |by: f64| {
                let mut y = x.clone();
                y[k] += by;
                cost.both(&y).0
            };
            let slope = (at(h) - at(-h)) / (2.0 * h);
            let slack = 1e-5 * (1.0 + slope.abs());
            assert!((slope - gradient[k]).abs() < slack, "{text} {k}: {slope} {}", gradient[k]);
        }
        assert!(gradient[..PLACES].iter().all(|g| g.abs() > 1e-6));
    }
}

#[test]
fn refined_pairs_are_better_and_keep_their_bounds() {
    let pairs = [
        (egg(), clover(), "1"),
        (clover(), bean(), "1"),
        (egg(), clover(), "2"),
        (clover(), egg(), "1/3"),
    ];
    for (driver, follower, text) in pairs {
        let ratio: Ratio = text.parse().unwrap();
        let limits = Limits {
            max_derivative: Some(1.7 / ratio.value()),
            max_lean: 0.7,
            ..Limits::default()
        };
        let with = |refine| FitOptions { limits, ..options(refine) };
        let plain = fit(&driver, &follower, ratio, &with(false), Control::unwatched()).unwrap();
        let refined = fit(&driver, &follower, ratio, &with(true), Control::unwatched()).unwrap();
        let done = refined.refinement.unwrap();
        assert!(done.after <= done.before && plain.refinement.is_none());
        let unlike = |f: &Fit| 2.0 - f.driver.iou - f.follower.iou;
        assert!(
            unlike(&refined) < 0.9 * unlike(&plain),
            "{text} {} {}",
            unlike(&plain),
            unlike(&refined)
        );
        let t = &refined.transmission;
        assert!(t.max_derivative() <= 1.7 / ratio.value() * (1.0 + 1e-8));
        let pair = Centrodes { transmission: t.clone(), center_distance: 1.0 };
        assert!(pair.max_lean() <= 0.7 * (1.0 + 1e-8));
        // Symmetry is exact: a period on, the same law and the same angle on.
        let period = TAU / f64::from(ratio.driver_fold());
        for i in 0..20 {
            let phi = 0.31 * f64::from(i);
            assert!(
                (t.psi(phi + period) - t.psi(phi) - TAU / f64::from(ratio.follower_fold())).abs()
                    < 1e-9
            );
            assert!((t.derivative(phi + period) - t.derivative(phi)).abs() < 1e-9);
        }
        // What is reported is what the placements give.
        let curve = pair.follower_curve(1024 * ratio.follower_fold() as usize);
        let placed: Vec<Point> =
            follower.points().iter().map(|p| refined.follower.placement.apply(*p)).collect();
        let iou = geometry::intersection_over_union(&curve, &placed);
        assert!((iou - refined.follower.iou).abs() < 1e-9);
    }
}

#[test]
fn circles_stay_circles() {
    let circle = polar_shape(200, |_| 40.0);
    let done = fit(&circle, &circle, Ratio::ONE, &options(true), Control::unwatched()).unwrap();
    assert!(done.transmission.max_derivative() < 1.01, "{}", done.transmission.max_derivative());
    assert!(done.driver.iou > 0.99 && done.follower.iou > 0.99);
}

#[test]
fn the_balance_says_whose_likeness_counts() {
    let at = |balance| {
        fit(
            &egg(),
            &clover(),
            Ratio::ONE,
            &FitOptions { balance, weight: 0.0, ..options(true) },
            Control::unwatched(),
        )
        .unwrap()
    };
    let (driver, both, follower) = (at(1.0), at(0.5), at(0.0));
    assert!(driver.driver.iou > 0.99 && follower.follower.iou > 0.99);
    assert!(driver.driver.iou > both.driver.iou && follower.follower.iou > both.follower.iou);
    assert!(both.driver.iou + both.follower.iou > driver.driver.iou + driver.follower.iou);
}
