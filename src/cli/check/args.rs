//! Options of `centrode check`.

use std::path::PathBuf;

use centrode::geometry::Point;
use centrode::schema::{default_length, default_text};
use clap::{Args, ValueHint};

use super::super::units;

/// Options of `centrode check`.
#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    /// Outline of the driver: SVG, DXF, CSV, JSON, STL or OBJ, or a folder with a design.json
    #[arg(value_name = "DRIVER", value_hint = ValueHint::FilePath, required_unless_present = "batch")]
    pub(crate) driver: Option<String>,
    /// Outline of the follower, likewise; from a design.json the follower is taken
    #[arg(value_name = "FOLLOWER", value_hint = ValueHint::FilePath, required_unless_present = "batch")]
    pub(crate) follower: Option<String>,
    /// A table of pairs to check, one a row, under a head of `driver`, `follower` and any of the options of one pair (such as `center-distance`); paths are seen from the table
    #[arg(long, value_name = "PAIRS.csv", value_hint = ValueHint::FilePath, conflicts_with_all = ["driver", "follower"])]
    pub(crate) batch: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) facts: PairFacts,
    /// Widest gap between ends of lines that is joined [default: 0.05 mm, or 1e-4 of the drawing if that is more]
    #[arg(long, value_name = "LENGTH", value_parser = units::length_or_zero, allow_hyphen_values = true)]
    pub(crate) join: Option<f64>,
    /// Judge by contact alone, without a rigid-body run
    #[arg(long)]
    pub(crate) no_simulate: bool,
    /// Run the driver both ways round
    #[arg(long, conflicts_with = "no_simulate")]
    pub(crate) both: bool,
    /// Torque that holds the follower back, N mm
    #[arg(long, default_value = default_text("load"), value_name = "NMM", value_parser = units::positive, allow_hyphen_values = true)]
    pub(crate) load: f64,
    /// Speed of the driver, turns a minute
    #[arg(long, default_value = default_text("rpm"), value_name = "RPM", value_parser = units::positive, allow_hyphen_values = true)]
    pub(crate) rpm: f64,
    /// Friction between the flanks, 0 to 2; torque is judged without
    #[arg(long, default_value_t = 0.0, value_name = "MU", value_parser = units::zero_or_more, allow_hyphen_values = true)]
    pub(crate) friction: f64,
    /// Thickness of the gears
    #[arg(long, default_value = default_length("thickness"), value_name = "LENGTH", value_parser = units::positive_length, allow_hyphen_values = true)]
    pub(crate) thickness: f64,
    /// Print the verdict as JSON on standard output
    #[arg(long)]
    pub(crate) json: bool,
    /// Also write the verdicts as a JUnit report, one test case a pair
    #[arg(long, value_name = "FILE.xml", value_hint = ValueHint::FilePath)]
    pub(crate) junit: Option<PathBuf>,
}

/// What is known of one pair, and how it is to be judged.
#[derive(Clone, Debug, Default, Args)]
pub(crate) struct PairFacts {
    /// Distance between the axes [default: that of the design.json, or of both where they agree]
    #[arg(short = 'L', long, value_name = "LENGTH", value_parser = units::center_distance, allow_hyphen_values = true)]
    pub(super) center_distance: Option<f64>,
    /// An even motion: turns of the driver for one turn of the follower
    #[arg(short = 'k', long, value_name = "K", value_parser = units::ratio, conflicts_with = "motion", allow_hyphen_values = true)]
    pub(super) ratio: Option<f64>,
    /// The motion as two columns, driver and follower angle in radians [default: from contact]
    #[arg(long, value_name = "FILE.csv")]
    pub(super) motion: Option<PathBuf>,
    /// Axis of the driver in its file, mm [default: its bore, else the origin]
    #[arg(long, value_name = "X,Y", value_parser = units::point, allow_hyphen_values = true)]
    pub(super) driver_axis: Option<Point>,
    /// Axis of the follower in its file, mm
    #[arg(long, value_name = "X,Y", value_parser = units::point, allow_hyphen_values = true)]
    pub(super) follower_axis: Option<Point>,
    /// Teeth of driver and follower [default: counted]
    #[arg(long, value_name = "N,M", value_parser = units::two_counts, allow_hyphen_values = true)]
    pub(super) teeth: Option<[u32; 2]>,
    /// Turn of the follower's drawing, clockwise, at driver angle 0, degrees [default: found]
    #[arg(long, value_name = "DEGREES", value_parser = units::degrees, allow_hyphen_values = true)]
    pub(super) phase: Option<f64>,
    /// Where a pair fails and where it is warned of, in place of the defaults
    #[arg(long, value_name = "FILE.toml", value_hint = ValueHint::FilePath)]
    pub(super) limits: Option<PathBuf>,
}

impl PairFacts {
    /// The same, with what is left out taken from `other`.
    pub(super) fn or(self, other: &Self) -> Self {
        let other = other.clone();
        let by_ratio = self.ratio.is_some();
        let by_motion = self.motion.is_some();
        Self {
            center_distance: self.center_distance.or(other.center_distance),
            ratio: self.ratio.or(other.ratio.filter(|_| !by_motion)),
            motion: self.motion.or(other.motion.filter(|_| !by_ratio)),
            driver_axis: self.driver_axis.or(other.driver_axis),
            follower_axis: self.follower_axis.or(other.follower_axis),
            teeth: self.teeth.or(other.teeth),
            phase: self.phase.or(other.phase),
            limits: self.limits.or(other.limits),
        }
    }
}
