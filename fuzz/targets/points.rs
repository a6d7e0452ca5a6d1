//! Points of a drawing, of a finished gear and of a motion, as columns and as JSON.
#![no_main]

use centrode::check::motion_from_columns;
use centrode::gear::Side;
use centrode::input::{LoadOptions, shape_from_bytes, toothed_from_bytes};
use centrode_fuzz::{remedied, sound, sound_shape, told};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let options = LoadOptions { samples: 64, ..LoadOptions::default() };
    match shape_from_bytes(data, "a.csv", &options) {
        Ok(shape) => sound_shape(&shape),
        Err(error) => remedied(&error),
    }
    match toothed_from_bytes(data, "a", Some("driver"), Side::Follower) {
        Ok(gear) => sound(&gear.outline),
        Err(error) => remedied(&error),
    }
    match toothed_from_bytes(data, "a.csv", None, Side::Follower) {
        Ok(gear) => gear.holes.iter().for_each(sound),
        Err(error) => remedied(&error),
    }
    if let Ok(text) = std::str::from_utf8(data)
        && let Err(error) = motion_from_columns(text)
    {
        told(&error);
    }
});
