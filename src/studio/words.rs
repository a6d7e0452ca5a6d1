//! A state as the words of a command line.

use super::protocol::{DrawingRef, State, Way};

/// Options whose text is that of the shapes' names when none follows.
const LETTERS: [&str; 2] = ["emboss", "engrave"];
const NAMES: &str = "names";

/// The words that make a state, with `output` as the folder.
pub(super) fn of(state: &State, output: &str) -> Vec<String> {
    let mut words = vec!["centrode".to_owned(), state.way.command().to_owned()];
    words.push(format!("--output={output}"));
    for (key, value) in &state.options {
        let is_flag = value == "true" || (LETTERS.contains(&key.as_str()) && value == NAMES);
        // A value of its own word cannot be taken for another option.
        words.push(if is_flag { format!("--{key}") } else { format!("--{key}={value}") });
    }
    words.push("--".to_owned());
    let name = |drawing: &Option<DrawingRef>| drawing.as_ref().map(|d| d.name.clone());
    match state.way {
        Way::Design => words.extend(name(&state.driver).into_iter().chain(name(&state.follower))),
        Way::Mate => words.extend(name(&state.driver)),
        Way::Motion => words.extend(state.law.clone()),
    }
    words
}

/// The same as a person would write it: drawings first.
pub(super) fn typed(state: &State, output: &str) -> Vec<String> {
    let words = of(state, output);
    let Some(at) = words.iter().position(|w| w == "--") else { return words };
    let (options, places) = words.split_at(at);
    let places = &places[1..];
    if places.iter().any(|p| p.starts_with('-')) {
        return words;
    }
    let (head, options) = options.split_at(2);
    head.iter().chain(places).chain(options).cloned().collect()
}

/// The state that a scene describes.
pub(super) fn opened(text: &str) -> anyhow::Result<State> {
    let (command, places, options) = crate::cli::studio::opened(text)?;
    let mut places = places.into_iter();
    let mut state = State { options: options.into_iter().collect(), ..State::default() };
    state.options.remove("output");
    let drawing = |name: String| DrawingRef { name, id: None };
    match command.as_str() {
        "design" => {
            state.driver = places.next().map(drawing);
            state.follower = places.next().map(drawing);
        }
        "mate" => {
            state.way = Way::Mate;
            state.driver = places.next().map(drawing);
        }
        "motion" => {
            state.way = Way::Motion;
            state.law = places.next();
        }
        _ => anyhow::bail!(
            "this scene is of `centrode {command}`; open one of design, mate or motion"
        ),
    }
    Ok(state)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_saved_scene_opens_as_the_state_it_was_saved_from() {
        let mut state = State { way: Way::Design, ..State::default() };
        let named = |name: &str| Some(DrawingRef { name: name.to_owned(), id: None });
        (state.driver, state.follower) = (named("heart"), named("dove"));
        for (key, value) in
            [("teeth", "48"), ("balance", "0.4"), ("strict", "true"), ("driver-axis", "10,20")]
        {
            state.options.insert(key.to_owned(), value.to_owned());
        }
        let text = crate::cli::studio::scene_text(&of(&state, "out")).unwrap();
        assert_eq!(opened(&text).unwrap(), state);
        let motion = State {
            way: Way::Motion,
            law: Some("1 + 0.3*cos(2*phi)".to_owned()),
            ..State::default()
        };
        let text = crate::cli::studio::scene_text(&of(&motion, "out")).unwrap();
        assert_eq!(opened(&text).unwrap(), motion);
        assert!(opened("command = \"train\"").is_err() && opened("nothing").is_err());
    }

    #[test]
    fn words_carry_values_that_look_like_options() {
        let mut state = State { way: Way::Design, ..State::default() };
        let named = |name: &str| Some(DrawingRef { name: name.to_owned(), id: None });
        (state.driver, state.follower) = (named("heart"), named("--quiet"));
        state.options.insert("orientation".to_owned(), "-40".to_owned());
        state.options.insert("strict".to_owned(), "true".to_owned());
        let expected = [
            "centrode",
            "design",
            "--output=out",
            "--orientation=-40",
            "--strict",
            "--",
            "heart",
            "--quiet",
        ];
        assert_eq!(of(&state, "out"), expected);
        assert_eq!(typed(&state, "out"), expected);
        state.follower = named("dove");
        assert_eq!(typed(&state, "out")[..4], ["centrode", "design", "heart", "dove"]);
    }
}
