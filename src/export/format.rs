//! The names of the formats.

use std::fmt;
use std::str::FromStr;

/// What can be written of a design.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Format {
    /// [`super::Glb`].
    Glb,
    /// [`super::Obj`].
    Obj,
    /// [`super::Stl`].
    Stl,
    /// [`super::ThreeMf`].
    ThreeMf,
    /// [`super::Step`].
    Step,
    /// [`super::Dxf`].
    Dxf,
    /// The picture `pair.svg` and [`super::LaserSvg`].
    Svg,
    /// [`super::Mjcf`].
    Mjcf,
    /// [`super::Animation`]; only written when asked for.
    Gif,
    /// The page `report.html`.
    Html,
    /// The record `design.json`, which every run writes.
    Json,
}

impl Format {
    /// All formats, in the order in which they are written.
    pub const ALL: [Self; 11] = [
        Self::Glb,
        Self::Obj,
        Self::Stl,
        Self::ThreeMf,
        Self::Step,
        Self::Dxf,
        Self::Svg,
        Self::Mjcf,
        Self::Gif,
        Self::Html,
        Self::Json,
    ];

    /// Its name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Glb => "glb",
            Self::Obj => "obj",
            Self::Stl => "stl",
            Self::ThreeMf => "3mf",
            Self::Step => "step",
            Self::Dxf => "dxf",
            Self::Svg => "svg",
            Self::Mjcf => "mjcf",
            Self::Gif => "gif",
            Self::Html => "html",
            Self::Json => "json",
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A format that does not exist.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no format {name:?}; choose from {}", Format::ALL.map(Format::name).join(", "))]
pub struct UnknownFormat {
    /// What was asked for.
    pub name: String,
}

impl FromStr for Format {
    type Err = UnknownFormat;

    fn from_str(text: &str) -> Result<Self, UnknownFormat> {
        let wanted = text.trim().to_ascii_lowercase();
        let wanted = if wanted == "stp" { "step" } else { wanted.as_str() };
        let found = Self::ALL.into_iter().find(|f| f.name() == wanted);
        found.ok_or_else(|| UnknownFormat { name: text.trim().to_owned() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_back_and_others_are_told_what_exists() {
        for format in Format::ALL {
            assert_eq!(format.name().to_uppercase().parse(), Ok(format));
        }
        assert_eq!(" stp ".parse(), Ok(Format::Step));
        let error = "iges".parse::<Format>().unwrap_err().to_string();
        assert!(error.contains("iges") && error.contains("step, dxf"), "{error}");
    }
}
