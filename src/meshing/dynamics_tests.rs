use super::*;
use crate::meshing::spur::Spur;
use crate::meshing::write_csv;

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
        motion: &|a| 0.75 * a,
        motion_derivative: &|_| 0.75,
        driver_cycle: TAU,
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
        motion: &|a| a,
        motion_derivative: &|_| 1.0,
        driver_cycle: TAU,
    };
    let input = DynamicsInput { contact: pair, driver_teeth: 8 };
    assert!(matches!(simulate(&input, &options), Err(DynamicsError::Option { name: "load", .. })));
}
