//! Opening the record of a design: its drawings and settings as a state.

use std::collections::BTreeMap;

use centrode::outline::library;
use centrode::policy;
use serde::Deserialize;
use serde_json::{Map, Value};

use super::drawings::Drawings;
use super::protocol::{DrawingRef, State, Way};
use super::words;
use crate::cli::plan::plan;

/// What is read of a record; more stands beside it.
#[derive(Debug, Deserialize)]
struct Record {
    names: [String; 2],
    driver: Gear,
    follower: Gear,
    #[serde(default)]
    settings: Map<String, Value>,
}

#[derive(Debug, Deserialize)]
struct Gear {
    /// The drawing in its place on the gear, mm about the axis.
    input: Vec<[f64; 2]>,
    #[serde(default)]
    rotation_center_in_input: Option<[f64; 2]>,
}

/// The state that a record describes. Drawings that are not built in are taken as they lie on the gears.
pub(super) fn opened(text: &str, drawings: &Drawings) -> Result<State, String> {
    if text.len() as u64 > policy::RECORD_BYTES {
        return Err("the file is too long for the record of a design; choose a design.json".into());
    }
    let record: Record = serde_json::from_str(text)
        .map_err(|_| "this is no record of a design; open a design.json".to_owned())?;
    let gears = [&record.driver, &record.follower];
    if gears.iter().any(|g| g.rotation_center_in_input.is_none() || g.input.len() < 3) {
        return Err(
            "this design was not made from two drawings; open the scene that it was made from"
                .into(),
        );
    }
    let mut state = State { way: Way::Design, ..State::default() };
    let named = |i: usize| {
        let name = &record.names[i];
        if library::svg(name).is_some() {
            return DrawingRef { name: name.clone(), id: None };
        }
        let lines: String = gears[i].input.iter().map(|[x, y]| format!("{x:?},{y:?}\n")).collect();
        let plain = name.chars().filter(|c| c.is_alphanumeric() || "-_ ".contains(*c)).take(60);
        let name = format!("{}.csv", plain.collect::<String>());
        let id = Some(drawings.keep(&name, lines.as_bytes()));
        DrawingRef { name, id }
    };
    let held = [named(0), named(1)];
    let understood = |options: &BTreeMap<String, String>| {
        let [driver, follower] = held.clone().map(Some);
        let state = State { driver, follower, options: options.clone(), ..State::default() };
        state.check().ok()?;
        let plan = plan(&words::of(&state, "out")).ok()?;
        Some((plan.load, plan.options))
    };
    for (key, value) in &record.settings {
        let text = match value {
            Value::Bool(true) => "true".to_owned(),
            Value::Number(number) => number.to_string(),
            Value::String(text) => text.clone(),
            _ => continue,
        };
        // What the command line does not know, or what changes nothing, is left at its default.
        let mut more = state.options.clone();
        more.insert(key.clone(), text);
        if understood(&more).is_some_and(|asked| Some(asked) != understood(&state.options)) {
            state.options = more;
        }
    }
    // The search need not find the axes again.
    for (i, key) in ["driver-axis", "follower-axis"].into_iter().enumerate() {
        let at = match (&held[i].id, gears[i].rotation_center_in_input) {
            (None, Some([x, y])) => format!("{x:.4},{y:.4}"),
            _ => "0,0".to_owned(),
        };
        state.options.insert(key.to_owned(), at);
    }
    if held[1].id.is_some() {
        state.options.insert("orientation".to_owned(), "0".to_owned());
    }
    for key in ["choose", "symmetric", "output"] {
        state.options.remove(key);
    }
    [state.driver, state.follower] = held.map(Some);
    Ok(state)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn record(name: &str, center: Option<[f64; 2]>) -> String {
        let gear = json!({
            "input": [[-20.0, -20.0], [20.0, -20.0], [20.0, 20.0], [-20.0, 20.0]],
            "rotation_center_in_input": center,
        });
        json!({
            "names": [name, "dove"], "driver": gear, "follower": gear,
            "settings": { "clearance": 0.2, "strict": true, "max-torque": null, "balance": 0.5, "no-such": 3 },
        })
        .to_string()
    }

    #[test]
    fn a_record_of_two_drawings_opens_with_its_settings_and_axes() {
        let drawings = Drawings::default();
        let state = opened(&record("heart", Some([50.0, 40.0])), &drawings).unwrap();
        assert_eq!(state.driver.unwrap().id, None);
        assert_eq!(state.options["driver-axis"], "50.0000,40.0000");
        assert_eq!((&*state.options["clearance"], &*state.options["strict"]), ("0.2", "true"));
        for key in ["no-such", "balance"] {
            assert!(!state.options.contains_key(key), "{key}");
        }
        // A drawing that is not built in comes from the record.
        let state = opened(&record("my box", Some([1.0, 2.0])), &drawings).unwrap();
        let drawing = state.driver.unwrap();
        assert_eq!((&*drawing.name, &*state.options["driver-axis"]), ("my box.csv", "0,0"));
        let shape = drawings.shape(&drawing, &centrode::input::LoadOptions::default()).unwrap();
        assert!((shape.raw.area() - 1600.0).abs() < 1.0);
    }

    #[test]
    fn what_was_made_from_no_drawing_or_is_none_is_refused() {
        let drawings = Drawings::default();
        for text in [&record("heart", None), "{}", "{", "[1]", "{\"names\": 3}"] {
            assert!(opened(text, &drawings).is_err(), "{text:.40}");
        }
    }
}
