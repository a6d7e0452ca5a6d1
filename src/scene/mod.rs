//! Scene files: a run of the program described in TOML.
//!
//! A scene names its command and gives values to the command's options, in the words of the command line and grouped
//! into tables. Which keys exist is not written down here: the caller hands over the command's [`Key`]s, so that a scene and
//! the command line can never disagree.

mod read;
mod write;

pub use read::{command_of, read};
pub use write::write;

/// The command of a scene that names none.
pub const DEFAULT_COMMAND: &str = "design";

/// How a key takes its value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// `true` or `false`.
    Flag,
    /// One text or number.
    One,
    /// One value or a list.
    Many,
}

/// One thing that a scene of some command may say.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Key {
    /// Its name: that of the option, without dashes in front.
    pub name: String,
    /// The table it stands in; none for the top of the file.
    pub table: Option<String>,
    /// How it takes its value.
    pub kind: Kind,
    /// One line of explanation.
    pub help: String,
    /// The value it has when nothing is said, if any.
    pub default: Option<String>,
}

/// A key with what a scene says of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Setting {
    /// Name of the key.
    pub key: String,
    /// Its values as on the command line; none for a flag that is set.
    pub values: Vec<String>,
}

/// Why a scene cannot be carried out.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SceneError {
    /// The text is no TOML.
    #[error("line {line}: {reason}; correct it, or begin again from `--save-scene`")]
    NotToml {
        /// Line of the mistake, from 1.
        line: usize,
        /// What the TOML reader says.
        reason: String,
    },
    /// The scene's command does not exist.
    #[error("there is no command {command:?}; {hint}")]
    UnknownCommand {
        /// What the scene names.
        command: String,
        /// What was meant, perhaps.
        hint: String,
    },
    /// No option has this name.
    #[error("there is no key {key:?} {place}; {hint}")]
    UnknownKey {
        /// The key.
        key: String,
        /// Where it stands.
        place: String,
        /// What was meant, perhaps.
        hint: String,
    },
    /// No table has this name.
    #[error("there is no table [{table}]; {hint}")]
    UnknownTable {
        /// The table.
        table: String,
        /// What was meant, perhaps.
        hint: String,
    },
    /// The key exists, elsewhere.
    #[error("{key:?} does not stand {place}; move it {right}")]
    WrongPlace {
        /// The key.
        key: String,
        /// Where it stands.
        place: String,
        /// Where it should.
        right: String,
    },
    /// The value is of a kind that the key does not take.
    #[error("{key:?} cannot be {found}; give {wanted}")]
    WrongKind {
        /// The key.
        key: String,
        /// What was found.
        found: String,
        /// What is taken.
        wanted: &'static str,
    },
    /// Two spellings of one key.
    #[error("{key:?} is given twice; keep one")]
    Twice {
        /// The key.
        key: String,
    },
}

/// How a place is called in messages.
fn place(table: Option<&str>) -> String {
    table.map_or_else(|| "at the top of the scene".to_owned(), |t| format!("in [{t}]"))
}

/// The candidate most like `name`, if any is like it at all.
#[must_use]
pub fn nearest<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    candidates
        .map(|c| (strsim::normalized_damerau_levenshtein(name, c), c))
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .filter(|(likeness, _)| *likeness >= crate::policy::LIKE_A_NAME)
        .map(|(_, c)| c)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Some keys of a made-up command.
    pub(crate) fn keys() -> Vec<Key> {
        let key = |name: &str, table: Option<&str>, kind, default: Option<&str>| Key {
            name: name.to_owned(),
            table: table.map(str::to_owned),
            kind,
            help: format!("What {name} does"),
            default: default.map(str::to_owned),
        };
        vec![
            key("driver", None, Kind::One, None),
            key("ratio", None, Kind::One, Some("1")),
            key("max-lean", Some("fit"), Kind::One, Some("55")),
            key("max-torque", Some("fit"), Kind::One, None),
            key("strict", Some("teeth"), Kind::Flag, None),
            key("export", Some("export"), Kind::Many, None),
        ]
    }

    #[test]
    fn what_is_written_reads_back() {
        let said = |key: &str, values: &[&str]| Setting {
            key: key.to_owned(),
            values: values.iter().map(|v| (*v).to_owned()).collect(),
        };
        let settings = vec![
            said("driver", &["a \"b\"\\.svg"]),
            said("ratio", &["1/2"]),
            said("max-lean", &["50.5"]),
            said("strict", &[]),
            said("export", &["glb", "stl"]),
        ];
        let text = write("design", &keys(), &settings);
        assert_eq!(command_of(&text, ["design", "check"].into_iter()).unwrap(), "design");
        assert_eq!(read(&text, &keys()).unwrap(), settings);
        assert!(text.contains("max-lean = 50.5") && text.contains("# max-torque ="), "{text}");
        let bare = write("design", &keys(), &[]);
        assert!(bare.contains("# ratio = 1") && read(&bare, &keys()).unwrap().is_empty(), "{bare}");
    }

    #[test]
    fn the_nearest_name_or_none() {
        let names = || ["max-lean", "max-torque", "teeth"].into_iter();
        assert_eq!(nearest("max-lena", names()), Some("max-lean"));
        assert_eq!(nearest("tooth", names()), Some("teeth"));
        assert_eq!(nearest("zzz", names()), None);
    }
}
