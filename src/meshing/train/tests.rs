//! Trains of round gears with involute teeth.

use super::*;
use crate::assembly::{Gear, Layout, PairModel, TrainPlan};
use crate::control::Control;
use crate::gear::Pair;
use crate::geometry::Point;
use crate::meshing::spur::Spur;
use std::f64::consts::TAU;

/// Two spur gears with involute teeth, as a pair.
fn pair() -> PairModel {
    let spur =
        Spur { teeth: 24, module: 2.0, pressure_angle: 20.0_f64.to_radians(), thinning: 0.1 };
    let angles: Vec<f64> = (0..=64).map(|i| TAU * f64::from(i) / 64.0).collect();
    let circle =
        |i: u32| geometry::rotate(Point::new(spur.radius(), 0.0), TAU * f64::from(i) / 720.0);
    let pitch_curve: Vec<Point> = (0..720).map(circle).collect();
    let gear = |name: &str, start: f64| Gear {
        name: name.to_owned(),
        input: pitch_curve.clone(),
        pitch_curve: pitch_curve.clone(),
        outline: spur.outline(start, 24, spur.teeth),
        bore: None,
        fittings: crate::assembly::Fittings::default(),
        teeth: spur.teeth,
    };
    PairModel {
        gears: Pair::new(gear("driver", 0.0), gear("follower", PI + PI / f64::from(spur.teeth))),
        motion: SampledMotion::new(&angles, &angles).unwrap(),
        center_distance: 2.0 * spur.radius(),
        module: spur.module,
    }
}

#[test]
fn play_adds_up_along_a_chain_of_round_gears() {
    let plan = TrainPlan::chain(pair(), 4, Layout::ZigZag(0.4), 8.0).unwrap();
    let train = plan.assemble().unwrap();
    let play = train_play(&train.assembly, 24, Control::unwatched()).unwrap();
    let one = play.meshes[0].play;
    assert!(one[0] > 0.0);
    for (k, mesh) in play.meshes.iter().enumerate() {
        assert_eq!(mesh.lost, 0);
        assert!((mesh.play[1] - one[1]).abs() < 0.02 * one[1], "{k}: {:?} {one:?}", mesh.play);
    }
    let most = play.accumulated[3];
    assert!(most <= 3.0 * one[1] * 1.001 && most >= 3.0 * one[0] * 0.999);
}

#[test]
fn a_chain_of_round_gears_turns_and_its_torque_is_the_load() {
    let plan = TrainPlan::chain(pair(), 3, Layout::Straight, 8.0).unwrap();
    let train = plan.assemble().unwrap();
    let options = DynamicsOptions { friction: 0.0, cycles: 0.25, ..DynamicsOptions::default() };
    let run = simulate_train(&train.assembly, &options, Control::unwatched()).unwrap();
    assert_eq!(run.stopped, None);
    let play = train_play(&train.assembly, 24, Control::unwatched()).unwrap();
    let (faults, _) = judge_train(&train.assembly, &play, std::slice::from_ref(&run), None);
    assert!(faults.is_empty(), "{faults:?}");
    let mean = run.steps.iter().map(|s| s.torque).sum::<f64>() / run.steps.len() as f64;
    assert!((mean / options.load - 1.0).abs() < 0.02, "{mean}");
    assert!((run.efficiency - 1.0).abs() < 0.02, "{}", run.efficiency);
    // Under load each gear lags by half the play of each mesh before it.
    for (gear, lag) in run.steps.last().unwrap().errors.iter().enumerate() {
        assert!((lag + 0.5 * play.accumulated[gear]).abs() < 2e-3, "{gear}: {lag}");
    }
}

#[test]
fn round_gears_may_be_driven_by_their_follower() {
    let options = DynamicsOptions { friction: 0.25, ..DynamicsOptions::default() };
    let report = prove_driven_by_follower(&pair(), &options, Control::unwatched()).unwrap();
    assert!(report.verdict().is_sound(), "{:?}", report.diagnostics);
}

#[test]
fn a_slow_train_is_as_right_as_a_fast_one() {
    let plan = TrainPlan::chain(pair(), 3, Layout::Straight, 8.0).unwrap();
    let train = plan.assemble().unwrap();
    let run = |rpm: f64| {
        let drive = crate::meshing::Drive::Motor(None);
        let options = DynamicsOptions {
            drive,
            friction: 0.1,
            cycles: 0.1,
            rpm,
            ..DynamicsOptions::default()
        };
        simulate_train(&train.assembly, &options, Control::unwatched()).unwrap()
    };
    for rpm in [0.1, 30.0] {
        let run = run(rpm);
        assert_eq!(run.stopped, None);
        for mesh in &run.meshes {
            assert!(mesh.penetration < 0.01, "{rpm}: {mesh:?}");
        }
    }
}
