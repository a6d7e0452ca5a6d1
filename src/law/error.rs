//! Why something is no motion.

use super::Quantity;
use crate::pitch::{PolarError, TransmissionError};

/// A factor farther from one than this closes nothing that was meant.
const FACTOR_SAID: f64 = 1e3;
/// A bound below this is rounding; zero is said instead.
const LEAST_SAID: f64 = 1e-9;

/// Why a formula, a table or a function is no motion. Angles in radians.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LawError {
    /// A formula longer than is read.
    #[error("the formula has {length} characters, more than {most}; shorten it, or give a table")]
    TooLong {
        /// Its length.
        length: usize,
        /// The longest that is read.
        most: usize,
    },
    /// Brackets nested deeper than is read.
    #[error(
        "the brackets of the formula are nested {depth} deep, more than {most}; write it flatter"
    )]
    TooDeep {
        /// Its depth.
        depth: usize,
        /// The deepest that is read.
        most: usize,
    },
    /// A character that has no place in a formula.
    #[error(
        "{character:?} has no place in a formula; write it with numbers, phi, + - * / ^ and brackets"
    )]
    Character {
        /// The character.
        character: char,
    },
    /// A name that is neither the variable, a constant nor a function.
    #[error(
        "the formula has an unknown name {name:?}; use phi, pi, e, or a function such as sin, cos, sqrt, exp, abs, min, max"
    )]
    UnknownName {
        /// The name.
        name: String,
    },
    /// A number with a name or bracket directly behind it.
    #[error("the formula has {written:?} without a sign between; write 2*phi instead of 2phi")]
    NoSign {
        /// The number and what follows.
        written: String,
    },
    /// The parser does not understand it.
    #[error("the formula {text:?} cannot be read ({reason}); write it like 1 + 0.3*cos(2*phi)")]
    Unreadable {
        /// The formula.
        text: String,
        /// What the parser says.
        reason: String,
    },
    /// Not a number, or infinite, somewhere.
    #[error("{} is no finite number at {:.1} degrees of the driver; correct it there", named(*.quantity), .at.to_degrees())]
    NotFinite {
        /// What was given.
        quantity: Quantity,
        /// Where.
        at: f64,
    },
    /// The follower would stop or turn back, or a radius vanishes.
    #[error("{} falls to {value:.4} at {:.1} degrees of the driver, where {}; keep it above {}", named(*.quantity), .at.to_degrees(), stops(*.quantity), bound(*.least))]
    NotPositive {
        /// What was given.
        quantity: Quantity,
        /// Its least value.
        value: f64,
        /// Where.
        at: f64,
        /// The least that is taken.
        least: f64,
    },
    /// A gear would not be a closed curve.
    #[error("{} does not repeat: it is {:.5} at {:.1} degrees of the driver and {:.5} where it should be the same again; {}", named(*.quantity), .values.0, .at.to_degrees(), .values.1, repeat(*.folds, *.turns))]
    NotPeriodic {
        /// What was given.
        quantity: Quantity,
        /// Times it must repeat in a turn of the driver.
        folds: u32,
        /// Turns of driver and follower, in lowest terms.
        turns: (u32, u32),
        /// Where it differs.
        at: f64,
        /// What it is there, and a period or more later.
        values: (f64, f64),
    },
    /// The follower does not come round when the driver does.
    #[error("{} averages {mean:.6} instead of {wanted:.6}, so the follower ends a turn of the driver {:.1} degrees {} where it should; {}", named(*.quantity), 360.0 * (.mean - .wanted).abs(), if .mean > .wanted { "past" } else { "short of" }, close(*.mean, *.wanted, *.turns))]
    NotClosed {
        /// What was given.
        quantity: Quantity,
        /// Mean of psi'.
        mean: f64,
        /// What it must be.
        wanted: f64,
        /// Turns of driver and follower, in lowest terms.
        turns: (u32, u32),
    },
    /// Faster than the samples it is known by.
    #[error("{} changes too fast to be followed, first at {:.1} degrees of the driver; use slower waves (phi is in radians), or give a table", named(*.quantity), .at.to_degrees())]
    TooFast {
        /// What was given.
        quantity: Quantity,
        /// Where.
        at: f64,
    },
    /// More waves than there are teeth to follow them.
    #[error("{} has {count} waves in a turn of the driver, more than {most}; no teeth follow so many, use slower waves (phi is in radians)", named(*.quantity))]
    TooManyWaves {
        /// What was given.
        quantity: Quantity,
        /// Waves in a turn of the driver.
        count: usize,
        /// The most that are taken.
        most: usize,
    },
    /// A line of a table is not two numbers.
    #[error(
        "line {line} of the table (`{text}`) is not two finite numbers; write the angle and the value there, or put # before it"
    )]
    TableLine {
        /// Number of the line, from 1.
        line: usize,
        /// The line, shortened.
        text: String,
    },
    /// Too few or too many rows.
    #[error("the table has {rows} rows; give {least} to {most}")]
    TableRows {
        /// Rows found.
        rows: usize,
        /// Least taken.
        least: usize,
        /// Most taken.
        most: usize,
    },
    /// Longer than is read.
    #[error("the table has {bytes} bytes, more than {most}; thin it out")]
    TableTooLong {
        /// Its length.
        bytes: usize,
        /// Most that is read.
        most: usize,
    },
    /// Not text.
    #[error("the table is no plain text; save it as UTF-8, one angle and one value on each line")]
    TableNotText,
    /// Angles that do not rise.
    #[error(
        "the angle on line {line} of the table does not rise; sort the rows and drop repeated ones"
    )]
    TableNotRising {
        /// Number of the line, from 1.
        line: usize,
    },
    /// Angles over more or less than one period.
    #[error("the table runs over {given:.4} {unit} instead of one period of {wanted:.4}; {remedy}")]
    TableSpan {
        /// Span found.
        given: f64,
        /// Span of one period.
        wanted: f64,
        /// Unit of both.
        unit: &'static str,
        /// What to do.
        remedy: &'static str,
    },
    /// A segment that is no part of a period.
    #[error(
        "the segment is {:.1} degrees of the driver long; make it {:.1} to {:.1}, the rest of the period is for closing the gears",
        .length.to_degrees(), .least.to_degrees(), .most.to_degrees()
    )]
    SegmentLength {
        /// Its length.
        length: f64,
        /// Shortest that is taken.
        least: f64,
        /// Longest that is taken.
        most: f64,
    },
    /// A segment in which the follower turns nearly as far as in a whole period, or farther.
    #[error(
        "the segment turns the follower by {:.1} degrees of the {:.1} that a period comes to, which leaves too little to close the gears; shorten the segment, or ask for a smaller ratio",
        .gain.to_degrees(), .whole.to_degrees()
    )]
    SegmentGain {
        /// What the follower turns in the segment.
        gain: f64,
        /// What it must turn in a period.
        whole: f64,
    },
    /// A segment of a pitch curve given by radii.
    #[error(
        "a pitch curve cannot be given in part, for its centre distance follows from the whole; give psi' or psi over the segment"
    )]
    SegmentOfRadius,
    /// A segment that a table does not cover.
    #[error(
        "the segment from {:.1} to {:.1} degrees leaves the table, which covers {:.1} to {:.1} degrees; stay inside, or add rows",
        .wanted.0.to_degrees(), .wanted.1.to_degrees(), .given.0.to_degrees(), .given.1.to_degrees()
    )]
    SegmentOutside {
        /// The segment.
        wanted: (f64, f64),
        /// What the table covers.
        given: (f64, f64),
    },
    /// No such preset, or a number it does not take.
    #[error(
        "{given:?} is no preset; write constant, ellipse:0.5, eccentric:0.4, oval:0.5..2, dwell:0.1 or quick-return:2 ({why})"
    )]
    Preset {
        /// What was given.
        given: String,
        /// What is wrong.
        why: String,
    },
    /// Radii that make no pitch curve.
    #[error(transparent)]
    Polar(#[from] PolarError),
    /// The spline through the samples is no motion.
    #[error(transparent)]
    Transmission(#[from] TransmissionError),
}

fn named(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Speed => "psi'",
        Quantity::Angle => "the derivative of psi",
        Quantity::DriverRadius => "the radius",
    }
}

/// A bound worth reading: a law whose mean is next to nothing has one that is only rounding.
fn bound(least: f64) -> String {
    if least < LEAST_SAID { "0".to_owned() } else { format!("{least:.2e}") }
}

fn stops(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Speed | Quantity::Angle => "the follower would stop or turn back",
        Quantity::DriverRadius => "the pitch curve would run through its axis",
    }
}

fn repeat(folds: u32, turns: (u32, u32)) -> String {
    if folds == 1 {
        return "both gears are closed only if it repeats after each turn of the driver, as sin and cos of whole multiples of phi do"
            .to_owned();
    }
    format!(
        "at {}:{} both gears are closed only if it repeats {folds} times in a turn of the driver, as functions of {folds}*phi do",
        turns.0, turns.1
    )
}

fn close(mean: f64, wanted: f64, turns: (u32, u32)) -> String {
    // Farther off than any ratio: something else is wrong.
    if !(1.0 / FACTOR_SAID..=FACTOR_SAID).contains(&(wanted / mean)) {
        return "check its sign and its unit".to_owned();
    }
    format!(
        "multiply it by {:.6} (or give --normalise), or ask for another ratio than {}:{}",
        wanted / mean,
        turns.0,
        turns.1
    )
}
