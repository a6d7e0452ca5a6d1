//! Values of settings as a person would type them.

use std::fmt::Display;

use serde::{Deserialize, Serialize, Serializer};

use super::words;

/// A number, or its text as it would be typed.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
pub(super) enum Typed {
    Number(f64),
    Text(String),
}

impl Typed {
    pub(super) fn read<T>(
        self,
        parse: impl FnOnce(&str) -> Result<T, String>,
    ) -> Result<T, String> {
        match self {
            Self::Number(number) => parse(&number.to_string()),
            Self::Text(text) => parse(&text),
        }
    }
}

impl Serialize for Typed {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            // Whole numbers stay whole in files.
            Self::Number(v) if v.fract() == 0.0 && v.abs() < 1e15 => {
                serializer.serialize_i64(*v as i64)
            }
            Self::Number(v) => serializer.serialize_f64(*v),
            Self::Text(text) => serializer.serialize_str(text),
        }
    }
}

pub(super) fn mm(value: f64) -> Typed {
    Typed::Number(value)
}

pub(super) fn deg(value: f64) -> Typed {
    Typed::Number(words::in_degrees(value))
}

pub(super) fn text(value: impl Display) -> Typed {
    Typed::Text(value.to_string())
}
