//! From settings to the text of a scene.

use super::{Key, Kind, Setting};

/// The scene of a command with these settings: every key of the command is there, those that are not set as comments with their
/// default.
#[must_use]
pub fn write(command: &str, keys: &[Key], settings: &[Setting]) -> String {
    let mut text = format!("command = {}\n", quoted(command));
    let mut tables: Vec<Option<&str>> = vec![None];
    for key in keys {
        if !tables.contains(&key.table.as_deref()) {
            tables.push(key.table.as_deref());
        }
    }
    for table in tables {
        let within: Vec<&Key> = keys.iter().filter(|k| k.table.as_deref() == table).collect();
        if let Some(name) = table {
            text.push_str(&format!("\n[{name}]\n"));
        }
        for key in within {
            text.push_str(&line(key, settings.iter().find(|s| s.key == key.name)));
        }
    }
    text
}

fn line(key: &Key, setting: Option<&Setting>) -> String {
    let name = &key.name;
    let value = |values: &[String]| match (key.kind, values) {
        (Kind::Flag, _) => "true".to_owned(),
        (_, [one]) => literal(one),
        (_, many) => {
            format!("[{}]", many.iter().map(|v| literal(v)).collect::<Vec<_>>().join(", "))
        }
    };
    match (setting, &key.default) {
        (Some(setting), _) => format!("{name} = {}\n", value(&setting.values)),
        (None, _) if key.kind == Kind::Flag => format!("# {name} = false  # {}\n", key.help),
        (None, Some(default)) => format!("# {name} = {}  # {}\n", literal(default), key.help),
        (None, None) => format!("# {name} =  # {}\n", key.help),
    }
}

/// A number as it is, anything else in quotes.
fn literal(text: &str) -> String {
    let whole = text.parse::<i64>().is_ok_and(|n| n.to_string() == text);
    // As a float it must be recognised, and read back as the same text.
    let float = |v: f64| v.is_finite() && format!("{v:?}") == text && v.to_string() == text;
    // Only where nothing is lost: 007, 1e5 and -0.0 stay as they were typed, for they may be names.
    if whole || text.parse().is_ok_and(float) { text.to_owned() } else { quoted(text) }
}

fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}
