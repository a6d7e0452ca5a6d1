//! A train's file, beside two designs that it may name.
#![no_main]

use std::path::PathBuf;
use std::sync::LazyLock;

use centrode::schema::{train_from_toml};
use centrode_fuzz::{finite, folder, remedied, told};
use libfuzzer_sys::fuzz_target;

/// The file's place; `a` and `b` beside it are designs.
static PLACE: LazyLock<PathBuf> = LazyLock::new(|| {
    for (name, text) in [
        ("a", include_str!("../seeds/design_json/round.json")),
        ("b", include_str!("../seeds/design_json/bare.json")),
    ] {
        let place = folder().join(name);
        std::fs::create_dir_all(&place).expect("a temporary folder can be written to");
        std::fs::write(place.join("design.json"), text).expect("and so can files in it");
    }
    folder().join("train.toml")
});

fuzz_target!(|text: &str| {
    match train_from_toml(text, &PLACE) {
        Err(error) => told(&error),
        Ok(plan) => match plan.assemble() {
            Err(error) => remedied(&error),
            Ok(train) => {
                assert!(train.module > 0.0);
                for placed in &train.assembly.gears {
                    finite(&placed.gear.outline);
                    finite(&[placed.axis]);
                    assert!(placed.angle.iter().all(|a| a.is_finite()));
                }
            }
        },
    }
});
