//! A message to the studio's server: the first byte says of which kind, the rest is its text.
#![no_main]

use centrode::studio::read_message;
use centrode_fuzz::told;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Some((&kind, rest)) = data.split_first() else { return };
    let Ok(text) = std::str::from_utf8(rest) else { return };
    // Seeds begin with a digit, so that they can be read.
    if let Err(error) = read_message(kind.wrapping_sub(b'0'), text) {
        told(&error);
    }
});
