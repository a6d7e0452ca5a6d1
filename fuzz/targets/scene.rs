//! A scene, read with some keys of each kind.
#![no_main]

use centrode::scene::{Key, Kind, command_of, read, write};
use centrode_fuzz::remedied;
use libfuzzer_sys::fuzz_target;

fn keys() -> Vec<Key> {
    let key = |name: &str, table: Option<&str>, kind, default: Option<&str>| Key {
        name: name.to_owned(),
        table: table.map(str::to_owned),
        kind,
        help: format!("What {name} does"),
        default: default.map(str::to_owned),
    };
    vec![
        key("driver", None, Kind::One, None),
        key("follower", None, Kind::One, None),
        key("ratio", None, Kind::One, Some("1")),
        key("output", None, Kind::One, None),
        key("max-lean", Some("fit"), Kind::One, Some("55")),
        key("max-torque", Some("fit"), Kind::One, None),
        key("strict", Some("teeth"), Kind::Flag, None),
        key("teeth", Some("teeth"), Kind::One, None),
        key("export", Some("export"), Kind::Many, None),
    ]
}

fuzz_target!(|text: &str| {
    if let Err(error) = command_of(text, ["design", "mate", "motion", "train"].into_iter()) {
        remedied(&error);
    }
    match read(text, &keys()) {
        Err(error) => remedied(&error),
        Ok(said) => {
            // What is written reads back the same.
            let again = write("design", &keys(), &said);
            assert_eq!(read(&again, &keys()).as_ref(), Ok(&said), "{again}");
        }
    }
});
