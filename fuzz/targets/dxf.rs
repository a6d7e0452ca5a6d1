//! A finished gear as DXF.
#![no_main]

use centrode::gear::Side;
use centrode::input::toothed_from_bytes;
use centrode_fuzz::{remedied, sound};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    match toothed_from_bytes(data, "a.dxf", None, Side::Driver) {
        Ok(gear) => {
            sound(&gear.outline);
            gear.holes.iter().for_each(sound);
        }
        Err(error) => remedied(&error),
    }
});
