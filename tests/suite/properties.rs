//! Whatever is drawn, a design is a pair that works or an error that says why.
//!
//! The same cases every time; `PROPTEST_CASES=200 PROPTEST_RNG_SEED=7 cargo test --release properties` draws others.

use centrode::assembly::PlacedGear;
use centrode::fit::{Ratio, Search};
use centrode::geometry::{self, Point};
use centrode::input::{Inner, Shape};
use centrode::outline::{Outline, repaired};
use centrode::pipeline::{Design, DesignOptions, ToothCount, design};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::f64::consts::TAU;

/// Vertices of a drawn blob.
const VERTICES: usize = 256;
/// Poses of a cycle at which the gears are laid on each other.
const POSES: usize = 24;
/// Share of a pair's area that may be covered twice: what its own analysis allows of interference, over whole
/// tooth heights of a few teeth.
const SHARED: f64 = 1e-4;

fn shape(name: &str, outline: Outline) -> Shape {
    Shape {
        name: name.to_owned(),
        raw: outline.clone(),
        outline,
        inner: Inner::default(),
        notes: Vec::new(),
    }
}

/// A star-shaped blob: a circle with waves of falling height.
fn blob() -> impl Strategy<Value = Shape> {
    prop::collection::vec((-1.0..1.0_f64, 0.0..TAU), 6).prop_map(|waves| {
        let radius = |angle: f64| {
            let wave = |(i, (height, phase)): (usize, &(f64, f64))| {
                let order = (i + 1) as f64;
                0.3 * height / order * (order * angle + phase).cos()
            };
            1.0 + waves.iter().enumerate().map(wave).sum::<f64>()
        };
        let vertex = |i| {
            let angle = TAU * i as f64 / VERTICES as f64;
            // Heights sum to at most 0.735: the radius stays positive.
            geometry::rotate(Point::new(radius(angle), 0.0), angle)
        };
        shape("blob", Outline::new((0..VERTICES).map(vertex).collect()).unwrap())
    })
}

/// A bent sausage: an arc of up to 330 degrees, thickened; no point sees all of a long one.
fn hook() -> impl Strategy<Value = Shape> {
    (0.5..5.75_f64, 0.1..0.6_f64, 0.1..0.6_f64).prop_map(|(turn, first, last)| {
        let side = |sign: f64| {
            move |i: usize| {
                let share = i as f64 / (VERTICES / 2 - 1) as f64;
                let half = 0.5 * (first + (last - first) * share);
                geometry::rotate(Point::new(1.0 + sign * half, 0.0), turn * share)
            }
        };
        let there = (0..VERTICES / 2).map(side(1.0));
        let back = (0..VERTICES / 2).rev().map(side(-1.0));
        shape("hook", Outline::new(there.chain(back).collect()).unwrap())
    })
}

/// Corners anywhere, as somebody scribbles them; where lines cross the largest region counts.
fn scribble() -> impl Strategy<Value = Shape> {
    prop::collection::vec((-1.0..1.0_f64, -1.0..1.0_f64), 3..16).prop_filter_map(
        "no area",
        |corners| {
            let corners = corners.into_iter().map(|(x, y)| Point::new(x, y)).collect();
            Some(shape("scribble", repaired(corners).ok()?))
        },
    )
}

fn drawing() -> impl Strategy<Value = Shape> {
    prop_oneof![2 => blob(), 1 => hook(), 1 => scribble()]
}

fn ratio() -> impl Strategy<Value = Ratio> {
    prop::sample::select(vec!["1/3", "1/2", "1", "2", "3", "4"])
        .prop_map(|text| text.parse().unwrap())
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: std::env::var("PROPTEST_CASES").map_or(16, |n| n.parse().unwrap()),
        max_shrink_iters: 8,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(std::env::var("PROPTEST_RNG_SEED").map_or(1, |n| n.parse().unwrap())),
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_design_works_or_says_why_not(
        driver in drawing(),
        follower in drawing(),
        ratio in ratio(),
        teeth in 8..=160_u32,
        clearance in 0.0..0.5_f64,
        pressure_angle in 14.0..30.0_f64,
    ) {
        let mut options = DesignOptions::new(ratio);
        options.fit.search = Search::Paper;
        options.teeth = ToothCount::Teeth(teeth);
        options.clearance = clearance;
        options.pressure_angle = pressure_angle.to_radians();
        match design(&driver, &follower, &options) {
            Err(error) => prop_assert!(error.to_string().contains(';'), "no remedy: {error}"),
            Ok(made) => judged(&made)?,
        }
    }
}

/// Nothing in a pair is not a number, its gears are simple, and when it calls itself sound it holds contact and
/// does not lie on its mate.
fn judged(made: &Design) -> Result<(), TestCaseError> {
    let total = made.objective().map(|o| o.total);
    let numbers = [total, Some(made.centrodes.center_distance), Some(made.pair.module)];
    prop_assert!(numbers.iter().chain(&made.likeness).all(|v| v.is_some_and(f64::is_finite)));
    for placed in &made.assembly.gears {
        let ring = &placed.gear.outline;
        prop_assert!(placed.angle.iter().all(|a| a.is_finite()));
        prop_assert!(ring.iter().all(|p| p.x.is_finite() && p.y.is_finite()));
        prop_assert!(geometry::signed_area(ring) > 0.0);
        prop_assert_eq!(geometry::first_self_crossing(ring), None);
    }
    if !made.is_sound() {
        return Ok(());
    }
    prop_assert_eq!(made.contact.summary.lost_poses, 0, "sound with contact lost");
    let [driver, follower] = &made.assembly.gears[..] else { panic!("a pair has two gears") };
    let last = made.assembly.driver_angle.len() - 1;
    for sample in (0..POSES).map(|k| k * last / POSES) {
        let posed = |placed: &PlacedGear| -> Vec<Point> {
            let turn = |p: &Point| geometry::rotate(*p, placed.angle[sample]) + placed.axis.coords;
            placed.gear.outline.iter().map(turn).collect()
        };
        let shared = geometry::intersection_over_union(&posed(driver), &posed(follower));
        prop_assert!(shared < SHARED, "{shared:e} of the pair is covered twice at sample {sample}");
    }
    Ok(())
}
