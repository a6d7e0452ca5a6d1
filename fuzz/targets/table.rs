//! A motion as a table.
#![no_main]

use centrode::fit::Ratio;
use centrode::law::{LawOptions, Quantity, Table};
use centrode_fuzz::{moves, remedied};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    for quantity in [Quantity::Speed, Quantity::Angle, Quantity::DriverRadius] {
        match Table::parse(data, quantity) {
            Err(error) => remedied(&error),
            Ok(table) => {
                for (m, n, normalise) in [(1, 1, false), (2, 1, true), (1, 2, true), (3, 2, true)] {
                    let ratio = Ratio::rational(m, n).unwrap_or_default();
                    match table.transmission(&LawOptions { ratio, quantity, normalise }) {
                        Ok(made) => moves(&made),
                        Err(error) => remedied(&error),
                    }
                }
            }
        }
    }
});
