//! What the page sends and what it is told. JSON both ways, one message a text frame.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// Longest message that is read, bytes: a state with a motion drawn point by point is a few kilobytes.
pub(super) const LONGEST_MESSAGE: usize = 1 << 20;
/// Options that one state may name; all commands together have fewer.
const MOST_OPTIONS: usize = 200;
/// Longest value of an option, bytes.
const LONGEST_VALUE: usize = 4096;

/// A drawing: built in, or given by its id.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DrawingRef {
    /// Its name as the command line would have it: a built-in name, or the name of the file.
    pub(super) name: String,
    /// Where the server keeps it; none for a built-in shape.
    #[serde(default)]
    pub(super) id: Option<String>,
}

/// Where a pair comes from; the names of the commands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Way {
    /// From two drawings.
    #[default]
    Design,
    /// From one drawing.
    Mate,
    /// From a wanted motion.
    Motion,
}

impl Way {
    pub(super) fn command(self) -> &'static str {
        match self {
            Self::Design => "design",
            Self::Mate => "mate",
            Self::Motion => "motion",
        }
    }
}

/// Everything that a person has chosen.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct State {
    pub(super) way: Way,
    pub(super) driver: Option<DrawingRef>,
    pub(super) follower: Option<DrawingRef>,
    /// The wanted motion, as a formula.
    pub(super) law: Option<String>,
    /// Options by the names that they have on the command line; a flag has the value `true`.
    pub(super) options: BTreeMap<String, String>,
}

/// From the page.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum Asked {
    /// Make this, in place of whatever is being made.
    Make {
        generation: u64,
        state: State,
        /// Whether something is being dragged: then only what follows under the hand is made.
        #[serde(default)]
        live: bool,
    },
}

/// Why a message is not taken.
#[derive(Debug, thiserror::Error)]
pub(super) enum BadMessage {
    #[error("the message is not understood ({0}); reload the page")]
    Json(#[from] serde_json::Error),
    #[error("the message names {0} options; reload the page")]
    Options(usize),
    #[error("the value of {0} is too long; give fewer letters")]
    Value(String),
}

impl Asked {
    /// Reads a message and checks its size.
    pub(super) fn read(text: &str) -> Result<Self, BadMessage> {
        let asked: Self = serde_json::from_str(text)?;
        let Self::Make { state, .. } = &asked;
        state.check()?;
        Ok(asked)
    }
}

impl State {
    /// Refuses what no page would send.
    pub(super) fn check(&self) -> Result<(), BadMessage> {
        if self.options.len() > MOST_OPTIONS {
            return Err(BadMessage::Options(self.options.len()));
        }
        let law = self.law.iter().map(|law| ("the motion", law));
        let drawings = [&self.driver, &self.follower].into_iter().flatten();
        let drawings = drawings.map(|d| ("a drawing's name", &d.name));
        let options = self.options.iter().map(|(key, value)| (key.as_str(), value));
        for (key, value) in law.chain(drawings).chain(options) {
            if value.len() > LONGEST_VALUE || key.len() > LONGEST_VALUE {
                return Err(BadMessage::Value(key.chars().take(40).collect()));
            }
        }
        Ok(())
    }
}

/// How far the work on a state has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Stage {
    /// The drawings are read.
    Read,
    /// Pitch curves at their size.
    Sized,
    /// Outlines with teeth.
    Toothed,
    /// Contact through a cycle.
    Analysed,
    /// Runs as rigid bodies; all that is to be said.
    Proven,
    /// Other pairs that the same drawings make.
    Alternatives,
}

/// To the page.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub(super) enum Told {
    /// What a stage gave.
    Stage { generation: u64, stage: Stage, ms: f64, data: serde_json::Value },
    /// The state cannot be made; `option` names the control to blame, where one is.
    Refused { generation: u64, option: Option<String>, text: String, remedy: Option<Remedy> },
    /// Drawings that the server does not have; the page sends them again.
    Missing { generation: u64, ids: Vec<String> },
    /// A message was not understood.
    Bad { text: String },
}

/// A change of one setting that may help.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Remedy {
    pub(super) option: String,
    pub(super) value: String,
}

impl Told {
    pub(super) fn text(&self) -> String {
        serde_json::to_string(self).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_state_is_read() {
        let text = r#"{"type":"make","generation":3,"live":true,"state":{"way":"design",
            "driver":{"name":"heart"},"follower":{"name":"cat.svg","id":"ab"},"options":{"teeth":"48"}}}"#;
        let Asked::Make { generation, state, live } = Asked::read(text).unwrap();
        assert!(generation == 3 && live && state.options["teeth"] == "48");
        assert_eq!(state.follower.unwrap().id.as_deref(), Some("ab"));
    }

    #[test]
    fn what_no_page_sends_is_refused() {
        let long = format!(
            r#"{{"type":"make","generation":1,"state":{{"options":{{"teeth":"{}"}}}}}}"#,
            "9".repeat(5000)
        );
        for text in
            ["", "{}", "[]", r#"{"type":"quit"}"#, r#"{"type":"make","generation":-1}"#, &long]
        {
            assert!(Asked::read(text).is_err(), "{text:.60}");
        }
    }

    proptest! {
        #[test]
        fn no_message_breaks_the_reader(text in ".{0,400}") {
            let _ = Asked::read(&text);
        }

        #[test]
        fn a_message_cut_anywhere_is_refused(cut in 0usize..120) {
            let whole = r#"{"type":"make","generation":1,"state":{"driver":{"name":"heart"},"follower":{"name":"dove"},"options":{"teeth":"4"}}}"#;
            let cut = cut.min(whole.len() - 1);
            prop_assert!(Asked::read(&whole[..cut]).is_err());
        }
    }
}
