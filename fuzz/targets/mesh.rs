//! A finished gear as STL or OBJ.
#![no_main]

use centrode::gear::Side;
use centrode::input::toothed_from_bytes;
use centrode_fuzz::{remedied, sound};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    for name in ["a.stl", "a.obj"] {
        match toothed_from_bytes(data, name, None, Side::Driver) {
            Ok(gear) => {
                sound(&gear.outline);
                gear.holes.iter().for_each(sound);
            }
            Err(error) => remedied(&error),
        }
    }
});
