//! What a report says: plain data, filled in by whoever ran the design.

use serde::Serialize;

use crate::diagnose::{Code, Diagnostic, Place, Severity, Verdict};

/// Everything the page shows besides the gears themselves.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReportData {
    /// Heading of the page, such as `heart and dove`.
    pub title: String,
    /// The command that makes this design again; empty to leave it out.
    pub command: String,
    /// The program and its version, for the foot of the page.
    pub made_by: String,
    /// How the run ended.
    pub verdict: Verdict,
    /// One sentence that explains the verdict.
    pub summary: String,
    /// Tables of numbers, in the order shown.
    pub sections: Vec<Section>,
    /// Plots, in the order shown.
    pub plots: Vec<Plot>,
    /// Contacts drawn on the turning gears, by rising driver angle; empty where none are known.
    pub contacts: Vec<ContactFrame>,
    /// Warnings and steps, in the order they happened.
    pub notes: Vec<Note>,
}

/// Where the teeth touch at one driver angle.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ContactFrame {
    /// Driver angle, radians, within one cycle.
    pub driver_angle: f64,
    /// One for each pair of teeth that carries load; none where contact is lost.
    pub touches: Vec<Touch>,
}

/// A contact and its force.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Touch {
    /// World position, mm.
    pub x: f64,
    /// World position, mm.
    pub y: f64,
    /// Force on the follower over the greatest usual one of the run, 0 to 1 long.
    pub force: [f64; 2],
}

/// A headed table of numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Section {
    /// Heading of the table.
    pub title: String,
    /// Its rows.
    pub rows: Vec<Row>,
}

impl Section {
    /// A section without rows yet.
    #[must_use]
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), rows: Vec::new() }
    }

    /// Adds a row.
    #[must_use]
    pub fn row(mut self, label: impl Into<String>, value: impl Into<String>) -> Self {
        self.rows.push(Row { label: label.into(), value: value.into(), note: None });
        self
    }

    /// Adds a row with an explanation.
    #[must_use]
    pub fn noted_row(
        mut self,
        label: impl Into<String>,
        value: impl Into<String>,
        note: impl Into<String>,
    ) -> Self {
        self.rows.push(Row { label: label.into(), value: value.into(), note: Some(note.into()) });
        self
    }
}

/// One number, or one fact, with its name.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// What it is.
    pub label: String,
    /// Its value as a person reads it, with the unit.
    pub value: String,
    /// What the value means or is compared with.
    pub note: Option<String>,
}

/// How much attention a note asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum NoteKind {
    /// Something the program did.
    Step,
    /// Something that was given up or may matter.
    Warning,
    /// Something that makes the pair unsound.
    Fault,
}

/// A plain sentence about the run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Note {
    /// How much attention it asks for.
    pub kind: NoteKind,
    /// The sentence.
    pub text: String,
    /// The kind of finding that it tells of, if it tells of one.
    pub code: Option<Code>,
    /// Where that is.
    pub place: Option<Place>,
}

impl Note {
    /// A note of the given kind.
    #[must_use]
    pub fn new(kind: NoteKind, text: impl Into<String>) -> Self {
        Self { kind, text: text.into(), code: None, place: None }
    }
}

impl From<&Diagnostic> for Note {
    fn from(found: &Diagnostic) -> Self {
        let kind = match found.severity {
            Severity::Note => NoteKind::Step,
            Severity::Warning => NoteKind::Warning,
            Severity::Fault => NoteKind::Fault,
        };
        let (code, place) = (Some(found.code), found.place);
        Self { kind, text: found.to_string(), code, place }
    }
}

/// Curves over one axis.
///
/// In a plot that follows the driver, x is the driver's angle in radians; the
/// page shows it in degrees and moves a cursor along it as the gears turn.
/// In any other plot x is shown as it is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plot {
    /// Heading of the plot.
    pub title: String,
    /// What x is, with its unit as shown.
    pub x_label: String,
    /// What y is, with its unit.
    pub y_label: String,
    /// Whether x is the driver's angle, radians.
    pub follows_driver: bool,
    /// The curves; x must not decrease along each.
    pub series: Vec<Series>,
    /// Values of y worth a line across the plot.
    pub limits: Vec<Limit>,
}

impl Plot {
    /// An empty plot over the driver's angle.
    #[must_use]
    pub fn over_driver_angle(title: impl Into<String>, y_label: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            x_label: "driver angle, °".into(),
            y_label: y_label.into(),
            follows_driver: true,
            series: Vec::new(),
            limits: Vec::new(),
        }
    }

    /// Adds a curve.
    #[must_use]
    pub fn series(mut self, name: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        self.series.push(Series { name: name.into(), points });
        self
    }

    /// Adds a line across the plot at `value` of y.
    #[must_use]
    pub fn limit(mut self, label: impl Into<String>, value: f64) -> Self {
        self.limits.push(Limit { label: label.into(), value });
        self
    }
}

/// One curve of a plot.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Series {
    /// Its name in the legend.
    pub name: String,
    /// Its points (x, y).
    pub points: Vec<(f64, f64)>,
}

/// A line across a plot.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Limit {
    /// What the line marks.
    pub label: String,
    /// Where on the y axis.
    pub value: f64,
}
