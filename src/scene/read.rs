//! From the text of a scene to settings.

use toml::{Table, Value};

use crate::wording::quoted;

use super::{DEFAULT_COMMAND, Key, Kind, SceneError, Setting, nearest, place};

/// The key that names the command.
const COMMAND: &str = "command";

/// The command that a scene is for, one of `commands`.
///
/// # Errors
/// See [`SceneError`].
pub fn command_of<'a>(
    text: &str,
    commands: impl Iterator<Item = &'a str> + Clone,
) -> Result<&'a str, SceneError> {
    let table = parsed(text)?;
    let wanted = match table.get(COMMAND) {
        None => DEFAULT_COMMAND,
        Some(Value::String(name)) => name,
        Some(other) => {
            return Err(SceneError::WrongKind {
                key: COMMAND.to_owned(),
                found: described(other),
                wanted: "the name of a command, in quotes",
            });
        }
    };
    commands.clone().find(|c| *c == wanted).ok_or_else(|| SceneError::UnknownCommand {
        command: quoted(wanted),
        hint: match nearest(wanted, commands.clone()) {
            Some(name) => format!("the nearest is {name:?}"),
            None => format!("choose from {}", commands.collect::<Vec<_>>().join(", ")),
        },
    })
}

/// What a scene says, in the order of `keys`. Underscores in names count as dashes; a flag that is `false` is left out.
///
/// # Errors
/// See [`SceneError`]: every key that the command does not know is refused.
pub fn read(text: &str, keys: &[Key]) -> Result<Vec<Setting>, SceneError> {
    let mut found: Vec<Setting> = Vec::new();
    for (name, value) in &parsed(text)? {
        match value {
            Value::Table(inner) => {
                let table = spelled(name);
                if !keys.iter().any(|k| k.table.as_deref() == Some(&table)) {
                    return Err(unknown_table(name, &table, keys));
                }
                for (name, value) in inner {
                    found.extend(setting(name, value, Some(&table), keys)?);
                }
            }
            _ if name == COMMAND => {}
            value => found.extend(setting(name, value, None, keys)?),
        }
    }
    let rank = |s: &Setting| keys.iter().position(|k| k.name == s.key);
    found.sort_by_key(rank);
    match found.windows(2).find(|w| w[0].key == w[1].key) {
        Some(pair) => Err(SceneError::Twice { key: pair[0].key.clone() }),
        None => Ok(found),
    }
}

fn parsed(text: &str) -> Result<Table, SceneError> {
    text.trim_start_matches('\u{feff}').parse().map_err(|e: toml::de::Error| {
        let before = e.span().and_then(|s| text.get(..s.start)).unwrap_or_default();
        SceneError::NotToml {
            line: 1 + before.matches('\n').count(),
            reason: quoted(&e.message().replace('\n', ", ")),
        }
    })
}

fn spelled(name: &str) -> String {
    name.replace('_', "-")
}

fn setting(
    name: &str,
    value: &Value,
    table: Option<&str>,
    keys: &[Key],
) -> Result<Option<Setting>, SceneError> {
    let spelled = spelled(name);
    let Some(key) = keys.iter().find(|k| k.name == spelled) else {
        return Err(unknown_key(name, &spelled, table, keys));
    };
    if key.table.as_deref() != table {
        return Err(SceneError::WrongPlace {
            key: quoted(name),
            place: place(table),
            right: match &key.table {
                Some(right) => format!("to [{right}]"),
                None => "to the top, above every table".to_owned(),
            },
        });
    }
    let wrong = |value: &Value, wanted| {
        let key = quoted(name);
        Err(SceneError::WrongKind { key, found: described(value), wanted })
    };
    let values = match (key.kind, value) {
        (Kind::Flag, Value::Boolean(true)) => Vec::new(),
        (Kind::Flag, Value::Boolean(false)) => return Ok(None),
        (Kind::Flag, other) => return wrong(other, "true or false"),
        (Kind::Many, Value::Array(list)) => {
            let mut values = Vec::new();
            for item in list {
                match plain(item) {
                    Some(text) => values.push(text),
                    None => return wrong(item, "a list of texts or numbers"),
                }
            }
            values
        }
        (_, value) => match plain(value) {
            Some(text) => vec![text],
            None => return wrong(value, "a number, or a text in quotes"),
        },
    };
    // An empty list says nothing.
    Ok((key.kind == Kind::Flag || !values.is_empty())
        .then(|| Setting { key: key.name.clone(), values }))
}

/// A value as it would be typed.
fn plain(value: &Value) -> Option<String> {
    match value {
        Value::String(text) => Some(text.clone()),
        Value::Integer(number) => Some(number.to_string()),
        Value::Float(number) => Some(number.to_string()),
        _ => None,
    }
}

fn described(value: &Value) -> String {
    match value {
        Value::Boolean(flag) => flag.to_string(),
        Value::Array(_) => "a list".to_owned(),
        Value::Table(_) => "a table".to_owned(),
        Value::Datetime(_) => "a date".to_owned(),
        other => quoted(&other.to_string()),
    }
}

fn unknown_key(name: &str, spelled: &str, table: Option<&str>, keys: &[Key]) -> SceneError {
    let hint = match nearest(spelled, keys.iter().map(|k| k.name.as_str())) {
        Some(found) => {
            let home = keys.iter().find(|k| k.name == found).and_then(|k| k.table.as_deref());
            if home == table {
                format!("the nearest is {found:?}")
            } else {
                format!("the nearest is {found:?} {}", place(home))
            }
        }
        None => "`--save-scene` of the command writes all that there are".to_owned(),
    };
    SceneError::UnknownKey { key: quoted(name), place: place(table), hint }
}

fn unknown_table(name: &str, spelled: &str, keys: &[Key]) -> SceneError {
    let mut tables: Vec<&str> = keys.iter().filter_map(|k| k.table.as_deref()).collect();
    tables.sort_unstable();
    tables.dedup();
    let hint = match nearest(spelled, tables.iter().copied()) {
        Some(found) => format!("the nearest is [{found}]"),
        None if tables.is_empty() => "this command has none".to_owned(),
        None => format!("choose from {}", tables.join(", ")),
    };
    SceneError::UnknownTable { table: quoted(name), hint }
}

#[cfg(test)]
mod tests {
    use super::super::tests::keys;
    use super::*;

    #[test]
    fn values_of_every_kind_and_spelling() {
        let text = "\u{feff}driver = 'heart'\nratio = 2\nfit.max_lean = 50.0\n[teeth]\nstrict = false\n[export]\nexport = 'glb'";
        let settings = read(text, &keys()).unwrap();
        let said: Vec<(&str, &str)> =
            settings.iter().map(|s| (s.key.as_str(), s.values[0].as_str())).collect();
        assert_eq!(
            said,
            [("driver", "heart"), ("ratio", "2"), ("max-lean", "50"), ("export", "glb")]
        );
    }

    #[test]
    fn mistakes_are_named_with_what_was_meant() {
        for (text, words) in [
            ("drivr = 'heart'", vec!["\"drivr\"", "top of the scene", "nearest is \"driver\""]),
            ("max-lena = 3", vec!["\"max-lena\"", "nearest is \"max-lean\" in [fit]"]),
            ("max-lean = 3", vec!["\"max-lean\"", "move it to [fit]"]),
            ("[fit]\nratio = 3", vec!["\"ratio\"", "in [fit]", "to the top"]),
            ("[fti]\nmax-lean = 3", vec!["[fti]", "nearest is [fit]"]),
            ("[qqqq]\n", vec!["[qqqq]", "export, fit, teeth"]),
            ("[fit]\nmax-lean = true", vec!["cannot be true", "a number"]),
            ("[teeth]\nstrict = 'yes'", vec!["cannot be \"yes\"", "true or false"]),
            ("ratio = [1, 2]", vec!["\"ratio\"", "a list"]),
            ("[fit]\nmax-lean = 3\nmax_lean = 4", vec!["twice"]),
            ("ratio = 1\n\nratio = 2", vec!["line 3", "duplicate"]),
            ("driver = ", vec!["line 1"]),
        ] {
            let said = read(text, &keys()).unwrap_err().to_string();
            for word in words {
                assert!(said.contains(word), "{text:?}: {word:?} is missing in {said}");
            }
        }
    }

    #[test]
    fn commands_are_looked_up() {
        let commands = || ["design", "check", "gallery"].into_iter();
        assert_eq!(command_of("driver = 'heart'", commands()), Ok("design"));
        assert_eq!(command_of("command = 'gallery'", commands()), Ok("gallery"));
        let said = |text| command_of(text, commands()).unwrap_err().to_string();
        assert!(said("command = 'galery'").contains("nearest is \"gallery\""));
        assert!(said("command = 'x'").contains("design, check, gallery"));
        assert!(said("command = 3").contains("name of a command"));
    }
}
