//! A drawing as SVG, and a finished gear as SVG.
#![no_main]

use centrode::gear::Side;
use centrode::input::{LoadOptions, shape_from_bytes, toothed_from_bytes};
use centrode_fuzz::{remedied, sound, sound_shape};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let options = LoadOptions { samples: 64, ..LoadOptions::default() };
    match shape_from_bytes(data, "a.svg", &options) {
        Ok(shape) => sound_shape(&shape),
        Err(error) => remedied(&error),
    }
    match toothed_from_bytes(data, "a.svg", None, Side::Driver) {
        Ok(gear) => sound(&gear.outline),
        Err(error) => remedied(&error),
    }
});
