//! A pair for the tests of the studio.

use std::f64::consts::TAU;

use centrode::control::Control;
use centrode::pipeline::{Design, DesignOptions, Request, ToothCount};
use centrode::pitch::Transmission;

/// 24 teeth by a motion that repeats twice a turn, not run as rigid bodies.
pub(super) fn pair() -> Design {
    let speeds: Vec<f64> = (0..64).map(|i| 1.0 + 0.2 * (TAU * f64::from(i) / 64.0).cos()).collect();
    let law = Transmission::from_derivative(&speeds, 2, 2).unwrap();
    let options = DesignOptions {
        teeth: ToothCount::Teeth(24),
        runs: Vec::new(),
        ..DesignOptions::default()
    };
    let names = ["a".to_owned(), "b".to_owned()];
    Request::motion(law, names).with(options).design(Control::unwatched()).unwrap()
}
