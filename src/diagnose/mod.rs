//! Findings as types: what is wrong or worth knowing of a pair, how much it weighs, where it is, and its figures.
//!
//! Every room that judges makes [`Diagnostic`]s; a [`Verdict`] is nothing but the gravest of them. Programs match on the
//! [`Code`]; the sentence for a person, with its remedy, is the diagnostic's [`Display`](std::fmt::Display) and written in
//! one file. Figures are mm, radians, N mm, pitches or shares, as [`Code`] says for each.

mod code;
mod limits;
mod sentences;

pub use code::Code;
pub use limits::Limits;

use std::borrow::Cow;
use std::collections::BTreeMap;

use serde::{Deserialize, Serialize, Serializer};

use crate::control::StageName;
use crate::gear::Side;
use crate::geometry::Point;

/// How much a finding weighs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// What was done, or is good to know.
    Note,
    /// The pair works; something deserves attention.
    Warning,
    /// The pair must not be trusted.
    Fault,
}

/// Where a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Place {
    /// A pose of the pair: driver angle, radians.
    DriverAngle(f64),
    /// One gear.
    Gear(Side),
    /// A tooth, counter-clockwise on its gear from 0.
    Tooth {
        /// The gear.
        gear: Side,
        /// Which of its teeth.
        index: usize,
    },
    /// A point of a gear in its own frame, mm.
    Point {
        /// The gear.
        gear: Side,
        /// Coordinate.
        x: f64,
        /// Coordinate.
        y: f64,
    },
}

impl Place {
    /// A point of a gear.
    #[must_use]
    pub fn point(gear: Side, at: Point) -> Self {
        Self::Point { gear, x: at.x, y: at.y }
    }

    /// The gear that it is on; none for a pose of the pair.
    #[must_use]
    pub fn gear(self) -> Option<Side> {
        match self {
            Self::DriverAngle(_) => None,
            Self::Gear(gear) | Self::Tooth { gear, .. } | Self::Point { gear, .. } => Some(gear),
        }
    }
}

/// One finding.
///
/// ```
/// use centrode::control::StageName;
/// use centrode::diagnose::{Code, Diagnostic, Verdict};
///
/// let found = Diagnostic::fault(Code::Jam, StageName::Proven).at_driver_angle(1.0);
/// assert_eq!(Verdict::of(std::slice::from_ref(&found)), Verdict::Unsound);
/// assert_eq!(found.code.word(), "jam");
/// assert!(found.to_string().contains("57 degrees"));
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Diagnostic {
    /// What it is.
    pub code: Code,
    /// How much it weighs.
    pub severity: Severity,
    /// The stage that found it.
    pub stage: StageName,
    /// Where it is, if it is at one place.
    #[serde(default)]
    pub place: Option<Place>,
    /// The name of a drawing or a gear that the sentence speaks of; empty for most.
    #[serde(default)]
    pub subject: String,
    /// Its figures by name.
    #[serde(default)]
    figures: BTreeMap<Cow<'static, str>, f64>,
}

impl Diagnostic {
    fn new(code: Code, severity: Severity, stage: StageName) -> Self {
        let (place, subject, figures) = (None, String::new(), BTreeMap::new());
        Self { code, severity, stage, place, subject, figures }
    }

    /// Something that was done, or is good to know.
    #[must_use]
    pub fn note(code: Code, stage: StageName) -> Self {
        Self::new(code, Severity::Note, stage)
    }

    /// Something that deserves attention.
    #[must_use]
    pub fn warning(code: Code, stage: StageName) -> Self {
        Self::new(code, Severity::Warning, stage)
    }

    /// Something for which the pair must not be trusted.
    #[must_use]
    pub fn fault(code: Code, stage: StageName) -> Self {
        Self::new(code, Severity::Fault, stage)
    }

    /// The same at a driver angle, radians.
    #[must_use]
    pub fn at_driver_angle(self, angle: f64) -> Self {
        self.at(Place::DriverAngle(angle))
    }

    /// The same at a place.
    #[must_use]
    pub fn at(self, place: Place) -> Self {
        Self { place: Some(place), ..self }
    }

    /// The same about a drawing or a gear of this name.
    #[must_use]
    pub fn about(self, subject: impl Into<String>) -> Self {
        Self { subject: subject.into(), ..self }
    }

    /// The same with a figure. One that is not finite is left out.
    #[must_use]
    pub fn with(mut self, name: &'static str, value: f64) -> Self {
        if value.is_finite() {
            self.figures.insert(Cow::Borrowed(name), value);
        }
        self
    }

    /// A figure by its name.
    #[must_use]
    pub fn figure(&self, name: &str) -> Option<f64> {
        self.figures.get(name).copied()
    }

    /// All figures, by name.
    pub fn figures(&self) -> impl Iterator<Item = (&str, f64)> {
        self.figures.iter().map(|(name, value)| (name.as_ref(), *value))
    }

    /// Driver angle of its place, radians, if it is a pose of the pair.
    #[must_use]
    pub fn driver_angle(&self) -> Option<f64> {
        match self.place {
            Some(Place::DriverAngle(angle)) => Some(angle),
            _ => None,
        }
    }
}

/// What is written of a diagnostic: all of it, and its sentence.
#[derive(Serialize)]
struct Written<'a> {
    code: Code,
    severity: Severity,
    stage: StageName,
    #[serde(skip_serializing_if = "Option::is_none")]
    place: Option<Place>,
    #[serde(skip_serializing_if = "str::is_empty")]
    subject: &'a str,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    figures: &'a BTreeMap<Cow<'static, str>, f64>,
    sentence: String,
}

impl Serialize for Diagnostic {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { code, severity, stage, place, subject, figures } = self;
        let (code, severity, stage, place) = (*code, *severity, *stage, *place);
        let sentence = self.to_string();
        Written { code, severity, stage, place, subject, figures, sentence }.serialize(serializer)
    }
}

/// The outcome: the gravest finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// The pair meshes.
    Good,
    /// It meshes; something deserves attention.
    Warnings,
    /// It does not mesh.
    Unsound,
}

impl Verdict {
    /// The verdict on findings.
    #[must_use]
    pub fn of<'a>(found: impl IntoIterator<Item = &'a Diagnostic>) -> Self {
        match found.into_iter().map(|d| d.severity).max() {
            Some(Severity::Fault) => Self::Unsound,
            Some(Severity::Warning) => Self::Warnings,
            Some(Severity::Note) | None => Self::Good,
        }
    }

    /// Whether the pair may be used.
    #[must_use]
    pub fn is_sound(self) -> bool {
        self != Self::Unsound
    }

    /// One word, as files spell it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::Warnings => "warnings",
            Self::Unsound => "unsound",
        }
    }

    /// A few plain words.
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Self::Good => "meshes",
            Self::Warnings => "meshes with warnings",
            Self::Unsound => "does not mesh",
        }
    }
}

/// Findings of one severity, in order.
pub fn of_severity(found: &[Diagnostic], severity: Severity) -> impl Iterator<Item = &Diagnostic> {
    found.iter().filter(move |d| d.severity == severity)
}

/// The sentences of all findings of one severity.
#[must_use]
pub fn sentences(found: &[Diagnostic], severity: Severity) -> Vec<String> {
    of_severity(found, severity).map(ToString::to_string).collect()
}

/// Keeps the first finding of each code and severity, and of each code only the gravest: runs that fail alike are told
/// once. Notes all stay.
#[must_use]
pub fn once_each(found: Vec<Diagnostic>) -> Vec<Diagnostic> {
    let mut kept: Vec<Diagnostic> = Vec::new();
    for new in found {
        let known = kept.iter().position(|k| {
            k.code == new.code && k.severity != Severity::Note && new.severity != Severity::Note
        });
        match known {
            None => kept.push(new),
            Some(i) if kept[i].severity < new.severity => kept[i] = new,
            Some(_) => {}
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gravest_finding_is_the_verdict() {
        let note = Diagnostic::note(Code::Refined, StageName::Wanted);
        let warning = Diagnostic::warning(Code::Torque, StageName::Proven);
        let fault = Diagnostic::fault(Code::Jam, StageName::Proven);
        assert_eq!(Verdict::of([]), Verdict::Good);
        assert_eq!(Verdict::of([&note]), Verdict::Good);
        assert_eq!(Verdict::of([&note, &warning]), Verdict::Warnings);
        assert_eq!(Verdict::of([&fault, &warning]), Verdict::Unsound);
    }

    #[test]
    fn a_kind_is_told_once_at_its_gravest() {
        let swing = |severity, pitches: f64| {
            Diagnostic::new(Code::TransmissionError, severity, StageName::Proven)
                .with("pitches", pitches)
        };
        let note = Diagnostic::note(Code::CornersRounded, StageName::Sized);
        let found = vec![
            note.clone(),
            swing(Severity::Warning, 0.1),
            swing(Severity::Fault, 0.3),
            swing(Severity::Fault, 0.4),
            note.clone(),
        ];
        let kept = once_each(found);
        assert_eq!(kept, [note.clone(), swing(Severity::Fault, 0.3), note]);
    }

    #[test]
    fn what_is_written_reads_back() {
        let found = Diagnostic::warning(Code::Undercut, StageName::Toothed)
            .at(Place::Tooth { gear: Side::Follower, index: 3 })
            .with("count", 2.0)
            .with("share", 0.8)
            .with("nothing", f64::NAN);
        let text = serde_json::to_string(&found).unwrap();
        assert_eq!(serde_json::from_str::<Diagnostic>(&text).unwrap(), found);
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(value["code"], "undercut");
        assert_eq!(value["place"]["tooth"]["gear"], "follower");
        assert_eq!(value["sentence"], found.to_string());
        assert!(found.figure("nothing").is_none());
    }
}
