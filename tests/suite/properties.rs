//! Whatever is drawn, a design is a pair that works or an error that says why.

use centrode::design::{DesignOptions, ToothCount, design};
use centrode::fit::{Ratio, Search};
use centrode::geometry::{self, Point};
use centrode::outline::{Outline, Shape};
use proptest::prelude::*;
use std::f64::consts::TAU;

/// Vertices of a drawn blob.
const VERTICES: usize = 256;

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
        let outline = Outline::new((0..VERTICES).map(vertex).collect()).unwrap();
        Shape { name: "blob".to_owned(), raw: outline.clone(), outline }
    })
}

fn ratio() -> impl Strategy<Value = Ratio> {
    let [half, two] = [Ratio::reciprocal(2), Ratio::integer(2)].map(Result::unwrap);
    prop::sample::select(vec![half, Ratio::ONE, two])
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 12,
        max_shrink_iters: 8,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_design_works_or_says_why_not(
        driver in blob(),
        follower in blob(),
        ratio in ratio(),
        teeth in (6..=32_u32).prop_map(|half| 2 * half),
    ) {
        let mut options = DesignOptions::new(ratio);
        options.fit.search = Search::Paper;
        options.teeth = ToothCount::Teeth(teeth);
        match design(&driver, &follower, &options) {
            Err(error) => prop_assert!(error.to_string().contains(';'), "no remedy: {error}"),
            Ok(made) => {
                prop_assert_eq!(made.teeth[0], teeth);
                let total = made.objective().map(|o| o.total);
                let numbers = [total, Some(made.centrodes.center_distance)];
                prop_assert!(numbers.iter().chain(&made.likeness).all(|v| v.is_some_and(f64::is_finite)));
                for placed in &made.assembly.gears {
                    let ring = &placed.gear.outline;
                    prop_assert!(placed.angle.iter().all(|a| a.is_finite()));
                    prop_assert!(ring.iter().all(|p| p.x.is_finite() && p.y.is_finite()));
                    prop_assert!(geometry::signed_area(ring) > 0.0);
                    prop_assert_eq!(geometry::first_self_crossing(ring), None);
                }
                let lost = made.contact.summary.lost_poses;
                prop_assert!(!made.is_sound() || lost == 0, "sound with contact lost");
                prop_assert!(made.faults.iter().all(|f| f.contains(';')), "{:?}", made.faults);
            }
        }
    }
}
