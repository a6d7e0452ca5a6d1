use super::*;
use crate::control::Control;
use crate::gear::EvenMotion;
use crate::meshing::spur::Spur;
use crate::meshing::write_csv;
use std::f64::consts::PI;

fn run_spurs(options: &DynamicsOptions) -> Dynamics {
    let spur =
        |teeth| Spur { teeth, module: 2.0, pressure_angle: 20_f64.to_radians(), thinning: 0.05 };
    let driver = spur(24).outline(0.0, 30, 24);
    let follower = spur(32).outline(PI + PI / 32.0, 30, 32);
    let contact = ContactInput {
        driver: &driver,
        follower: &follower,
        center_distance: 56.0,
        module: 2.0,
        motion: &EvenMotion { speed: 0.75, cycle: TAU },
        control: Control::unwatched(),
    };
    simulate(&DynamicsInput { contact, driver_teeth: 24 }, options).unwrap()
}

#[test]
fn an_involute_pair_follows_psi_and_balances_its_torque() {
    for direction in [Direction::Forward, Direction::Backward] {
        let options =
            DynamicsOptions { friction: 0.0, cycles: 0.5, direction, ..Default::default() };
        let s = run_spurs(&options).summary;
        assert!(s.swing_angle.to_degrees() < 0.01, "{s:?}");
        assert!(s.torque_rms < 0.02, "{s:?}");
        assert!((s.efficiency - 1.0).abs() < 0.02, "{s:?}");
    }
}

#[test]
fn the_same_run_gives_the_same_bytes() {
    let options = DynamicsOptions { cycles: 0.1, ..Default::default() };
    let [a, b] = [(); 2].map(|()| {
        let mut text = Vec::new();
        write_csv(&run_spurs(&options), &mut text).unwrap();
        text
    });
    assert!(a.len() > 10_000 && a == b);
}

#[test]
fn bad_options_are_refused() {
    let options = DynamicsOptions { load: f64::NAN, ..Default::default() };
    let pair = ContactInput {
        driver: &[],
        follower: &[],
        center_distance: 1.0,
        module: 1.0,
        motion: &EvenMotion { speed: 1.0, cycle: TAU },
        control: Control::unwatched(),
    };
    let input = DynamicsInput { contact: pair, driver_teeth: 8 };
    assert!(matches!(simulate(&input, &options), Err(DynamicsError::Option { name: "load", .. })));
}

#[test]
fn the_forces_between_the_teeth_balance_the_load_along_the_line_of_action() {
    for (direction, sign) in [(Direction::Forward, -1.0), (Direction::Backward, 1.0)] {
        let options =
            DynamicsOptions { friction: 0.0, cycles: 0.5, direction, ..Default::default() };
        let run = run_spurs(&options);
        assert!(run.touches.len() >= 12 * 8, "{}", run.touches.len());
        let axis = Point::new(56.0, 0.0);
        let moments: Vec<f64> = run
            .touches
            .iter()
            .map(|t| t.points.iter().map(|(p, force)| cross(p - axis, *force)).sum())
            .collect();
        let mean = moments.iter().sum::<f64>() / moments.len() as f64;
        assert!((mean / (sign * options.load) - 1.0).abs() < 0.03, "{mean}");
        // Without friction every force lies on the common tangent of the base circles, through the
        // pitch point and 20 degrees off the tangent of the pitch circles.
        let along = Vector::new(20_f64.to_radians().sin(), -sign * 20_f64.to_radians().cos());
        for touches in &run.touches {
            assert!(touches.driver_angle * sign <= 0.0, "{touches:?}");
            for (point, force) in &touches.points {
                assert!(cross(along, force.normalize()).abs() < 1_f64.to_radians(), "{force:?}");
                assert!(along.dot(force) > 0.0, "{force:?}");
                let off = cross(along, point - Point::new(24.0, 0.0));
                assert!(off.abs() < 0.05, "{off} mm at {point:?}");
            }
        }
    }
}
