//! A silhouette as PNG, JPEG, TIFF or BMP.
#![no_main]

use centrode::input::from_image;
use centrode_fuzz::{remedied, sound};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let threshold = (data.len() % 4 == 3).then_some((data.len() % 251) as u8);
    match from_image(data, threshold) {
        Ok(outline) => sound(&outline),
        Err(error) => remedied(&error),
    }
});
