//! Trains of coarse pitch curves that roll on each other, bend, branch, collide and close.

use super::*;
use crate::gear::{Pair, SampledMotion};

/// A pair whose follower turns by `a + 0.3 (1 - cos a)`; outlines are the pitch curves, coarse.
fn wavy(amplitude: f64, shrink: f64) -> PairModel {
    let n = 256;
    let driver: Vec<f64> = (0..=n).map(|i| TAU * f64::from(i) / f64::from(n)).collect();
    let psi: Vec<f64> = driver.iter().map(|a| a + amplitude * (1.0 - a.cos())).collect();
    let motion = SampledMotion::new(&driver, &psi).unwrap();
    let at = |radius: f64, angle: f64| geometry::rotate(Point::new(shrink * radius, 0.0), angle);
    let ratio = |a: f64| 1.0 + amplitude * a.sin();
    let first: Vec<Point> =
        driver[..256].iter().rev().map(|&a| at(80.0 * ratio(a) / (1.0 + ratio(a)), -a)).collect();
    let second: Vec<Point> = driver[..256]
        .iter()
        .map(|&a| at(80.0 / (1.0 + ratio(a)), PI + a + amplitude * (1.0 - a.cos())))
        .collect();
    let gear = |name: &str, outline: Vec<Point>| Gear {
        name: name.to_owned(),
        pitch_curve: outline.clone(),
        input: outline.clone(),
        outline,
        bore: None,
        fittings: crate::assembly::Fittings::default(),
        teeth: 32,
    };
    PairModel {
        gears: Pair::new(gear("driver", first), gear("follower", second)),
        motion,
        center_distance: 80.0,
        module: 2.5,
    }
}

/// Pitch curves must touch at one point of each line of centres, at every pose.
fn rolls(train: &Train) {
    for &[a, b] in &train.assembly.meshes {
        let gears = [&train.assembly.gears[a], &train.assembly.gears[b]];
        let line = (gears[1].axis - gears[0].axis).normalize();
        for k in (0..train.assembly.driver_angle.len()).step_by(37) {
            let reach = |g: &PlacedGear, toward: Vector| {
                let local = geometry::rotate(Point::from(toward), -g.angle[k]).coords;
                let n = g.gear.outline.len();
                (0..n)
                    .filter_map(|i| {
                        let (p, q) = (g.gear.outline[i], g.gear.outline[(i + 1) % n]);
                        let (u, v) =
                            (geometry::cross(local, p.coords), geometry::cross(local, q.coords));
                        let along = p.coords.dot(&local) > 0.0;
                        (along && (u > 0.0) != (v > 0.0))
                            .then(|| (p + (q - p) * (u / (u - v))).coords.norm())
                    })
                    .fold(0.0, f64::max)
            };
            let both = reach(gears[0], line) + reach(gears[1], -line);
            let apart = (gears[1].axis - gears[0].axis).norm();
            assert!((both - apart).abs() < 0.02, "{both} {apart} at {k}");
        }
    }
}

#[test]
fn pitch_curves_roll_on_each_other_in_every_mesh_of_a_bent_chain() {
    for layout in [Layout::Straight, Layout::ZigZag(0.5), Layout::Arc(0.3)] {
        let plan = TrainPlan::chain(wavy(0.3, 1.0), 7, layout, 8.0).unwrap();
        let train = plan.assemble().unwrap();
        rolls(&train);
        for (i, gear) in train.assembly.gears.iter().enumerate() {
            assert_eq!(gear.angle[0], 0.0);
            assert_eq!(gear.sense(), if i % 2 == 0 { 1.0 } else { -1.0 });
            let turns = gear.angle.last().unwrap() / TAU;
            assert!((turns.abs() - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn branches_and_shared_axles_are_trees() {
    let mut plan = TrainPlan::chain(wavy(0.3, 1.0), 3, Layout::Straight, 8.0).unwrap();
    let gear = |name: &str, side, on, link| TrainGear {
        name: name.to_owned(),
        pair: 0,
        side,
        link: Some((on, link)),
    };
    plan.gears.push(gear("up", Side::Driver, 1, Link::Mesh { direction: 1.5 }));
    plan.gears.push(gear("above", Side::Driver, 2, Link::Axle { rise: 10.0, turn: 0.4 }));
    plan.gears.push(gear("far", Side::Follower, 4, Link::Mesh { direction: -1.0 }));
    let train = plan.assemble().unwrap();
    rolls(&train);
    assert_eq!(train.assembly.axles, vec![[2, 4]]);
    assert_eq!(train.assembly.gears[5].level, 10.0);
    let [below, above] = [2, 4].map(|i| &train.assembly.gears[i].angle);
    assert!(below.iter().zip(above).all(|(a, b)| (a - b).abs() < 1e-12));
}

#[test]
fn gears_that_meet_their_next_but_one_are_found() {
    let plan = TrainPlan::chain(wavy(0.3, 1.0), 4, Layout::Arc(2.6), 8.0).unwrap();
    let error = plan.assemble().unwrap_err();
    assert!(matches!(error, TrainError::Collision { .. }), "{error}");
    assert!(error.to_string().contains("gear01") && error.to_string().contains("gear03"));
}

#[test]
fn round_gears_close_a_ring_and_others_say_by_how_much_not() {
    let round = wavy(0.0, 1.0);
    let train = TrainPlan::ring(&round, 6, 8.0).unwrap().assemble().unwrap();
    assert_eq!(train.assembly.meshes.last(), Some(&[0, 5]));
    let error = TrainPlan::ring(&wavy(0.3, 1.0), 6, 8.0).unwrap().assemble().unwrap_err();
    match error {
        TrainError::Open { off, allowed } => assert!(off > allowed && off <= PI),
        other => panic!("{other}"),
    }
    assert!(matches!(TrainPlan::ring(&round, 5, 8.0), Err(TrainError::RingCount { count: 5 })));
}

#[test]
fn gears_of_one_kind_do_not_mesh() {
    let mut plan = TrainPlan::chain(wavy(0.3, 1.0), 3, Layout::Straight, 8.0).unwrap();
    plan.gears[2].side = Side::Follower;
    assert!(matches!(plan.assemble(), Err(TrainError::NotAPair { .. })));
    plan.gears[2].link = Some((5, Link::Mesh { direction: 0.0 }));
    assert!(matches!(plan.assemble(), Err(TrainError::Unknown { .. })));
}

#[test]
fn a_chain_is_bent_where_its_gears_turn_most_evenly() {
    let pair = wavy(0.3, 0.8);
    let bent = TrainPlan::bent(&pair, 6, &[Layout::ZigZag], 8.0).unwrap();
    // Speeds from the motion itself, by differences.
    let ratio = |train: &Train| {
        let angle = |g: usize, k: usize| train.assembly.gears[g].angle[k];
        let speed = |g: usize, k: usize| (angle(g, k + 1) - angle(g, k)).abs();
        let samples = train.assembly.driver_angle.len() - 1;
        (0..samples)
            .flat_map(|k| (1..6).flat_map(move |b| (0..b).map(move |a| (a, b, k))))
            .map(|(a, b, k)| speed(b, k) / speed(a, k))
            .fold(0.0, f64::max)
    };
    let found = ratio(&bent.train);
    assert!((found / bent.ratio - 1.0).abs() < 0.01, "{found} {}", bent.ratio);
    for degrees in (-60..=60).step_by(5) {
        let layout = Layout::ZigZag(f64::from(degrees).to_radians());
        let plan = TrainPlan::chain(pair.clone(), 6, layout, 8.0).unwrap();
        if let Ok(train) = plan.assemble() {
            assert!(ratio(&train) > 0.99 * found, "{degrees}");
        }
    }
}

#[test]
fn round_gears_stay_straight() {
    let bent = TrainPlan::bent(&wavy(0.0, 0.8), 4, &[Layout::ZigZag, Layout::Arc], 8.0).unwrap();
    assert!((bent.ratio - 1.0).abs() < 1e-6);
    assert!(matches!(bent.layout, Layout::ZigZag(bend) if bend == 0.0));
}

#[test]
fn a_swapped_pair_rolls_and_swapped_again_is_the_pair() {
    let pair = wavy(0.3, 1.0);
    let swapped = pair.swapped().unwrap();
    let plan = TrainPlan::chain(swapped.clone(), 2, Layout::Straight, 8.0).unwrap();
    rolls(&plan.assemble().unwrap());
    let again = swapped.swapped().unwrap();
    assert_eq!(again.gears.driver.outline, pair.gears.driver.outline);
    for k in 0..20 {
        let angle = f64::from(k) * 0.4;
        assert!((again.motion.psi(angle) - pair.motion.psi(angle)).abs() < 1e-6);
    }
}
