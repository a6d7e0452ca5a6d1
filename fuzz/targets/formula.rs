//! A motion as people type it: a formula, a preset, a ratio.
#![no_main]

use centrode::fit::Ratio;
use centrode::law::{Formula, LawOptions, Preset, Quantity, from_function};
use centrode_fuzz::{moves, remedied};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Err(error) = text.parse::<Ratio>() {
        remedied(&error);
    }
    let ratios = [(1, 1), (2, 1), (1, 2), (3, 2)].map(|(m, n)| Ratio::rational(m, n));
    match text.parse::<Preset>() {
        Err(error) => remedied(&error),
        Ok(preset) => {
            for ratio in ratios.iter().flatten() {
                match preset.transmission(&LawOptions { ratio: *ratio, ..LawOptions::default() }) {
                    Ok(made) => moves(&made),
                    Err(error) => remedied(&error),
                }
            }
        }
    }
    match Formula::parse(text) {
        Err(error) => remedied(&error),
        Ok(formula) => {
            for angle in [0.0, -0.3, 1.0, 3.0, 6.5, 1e9, f64::NAN] {
                let _ = formula.at(angle);
            }
            let quantity =
                [Quantity::Speed, Quantity::Angle, Quantity::DriverRadius][text.len() % 3];
            for ratio in ratios.iter().flatten() {
                let options = LawOptions { ratio: *ratio, quantity, normalise: true };
                match from_function(|phi| formula.at(phi), &options) {
                    Ok(made) => moves(&made),
                    Err(error) => remedied(&error),
                }
            }
        }
    }
});
