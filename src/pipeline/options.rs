//! What a design can be told, and why it may fail.

use super::outfit::{Outfit, OutfitError};
use crate::control::Cancelled;
use crate::diagnose::Limits;
use crate::fit::{FitError, FitOptions, LimitError, Ratio};
use crate::law::Segment;
use crate::meshing::ContactError;
use crate::meshing::{DynamicsError, DynamicsOptions};
use crate::pitch::TransmissionError;
use crate::solid::{Bore, BoreName, SolidError};
use crate::strength::Load;
use crate::teeth::TeethError;

/// How many teeth the driver gets.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum ToothCount {
    /// Chosen from the size and the curvature of the pitch curves.
    #[default]
    Auto,
    /// This many.
    Teeth(u32),
    /// As many as come closest to this module, mm.
    Module(f64),
}

/// The shape of the teeth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TeethStyle {
    /// Generalised involutes on both gears.
    #[default]
    Involute,
    /// The paper's waves (section 5.3) with heights by Eq. 17, the follower carved.
    Wave,
    /// The paper's waves, all of one height, the follower carved: what Eq. 17 is measured against.
    RegularWave,
}

/// How large the pair is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// Distance of the axes, mm.
    CenterDistance(f64),
    /// Largest extent of the pair in its first pose, mm.
    Extent(f64),
}

/// The hole for the axle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BoreChoice {
    /// A round hole of this diameter (mm), or a smaller one or none where the gear has no room for it.
    AtMost(f64),
    /// Exactly this one, or an error.
    Exactly(Bore),
    /// For what goes through, with the fit of [`Outfit::fit`]; or an error.
    Named(BoreName),
}

/// Everything a design can be told. Lengths in mm, angles in radians.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignOptions {
    /// Turns of the driver for one of the follower.
    pub ratio: Ratio,
    /// How the gears are fitted to the shapes.
    pub fit: FitOptions,
    /// Number of driver teeth.
    pub teeth: ToothCount,
    /// Shape of the teeth.
    pub style: TeethStyle,
    /// Pressure angle where the pitch curve allows it.
    pub pressure_angle: f64,
    /// Height of the teeth above the pitch curve, in modules.
    pub addendum: f64,
    /// Inward offset of every face of each gear.
    pub clearance: f64,
    /// Backlash along the pitch curve.
    pub backlash: f64,
    /// Room below a mating tip; a quarter of the module when `None`.
    pub root_clearance: Option<f64>,
    /// Largest distance between a flank and its chords, in modules.
    pub chord_tolerance: f64,
    /// Size of the pair.
    pub scale: Scale,
    /// Thickness of the gears.
    pub thickness: f64,
    /// Hole for the axle.
    pub bore: BoreChoice,
    /// What else the gears carry, and what they stand on.
    pub outfit: Outfit,
    /// Carve the follower literally, as solids (paper, Figure 7), instead of along the exact envelope.
    pub carve_with_solids: bool,
    /// Whether gentler settings may be tried when the first pair is not good.
    pub repair: bool,
    /// Rigid-body runs that the finished pair must pass; none by default. With `repair`, gentler
    /// settings are tried when it does not.
    pub runs: Vec<DynamicsOptions>,
    /// Judge the pair at the poses of a trial only: faster, for galleries.
    pub quick: bool,
    /// Cut the gears to the teeth that mesh while the driver turns through this segment, and let the pair swing through
    /// it. The pair is designed, analysed and run as whole gears first; the contact of the sectors is judged by itself.
    pub sector: Option<Segment>,
    /// Load for the look at strength; the runs have their own.
    pub load: Load,
    /// Where the pair fails.
    pub limits: Limits,
}

impl DesignOptions {
    /// The defaults for a ratio.
    #[must_use]
    pub fn new(ratio: Ratio) -> Self {
        let teeth = crate::teeth::TeethOptions::default();
        let mut fit = FitOptions::default();
        fit.limits.max_lean = crate::policy::DESIGN_MAX_LEAN;
        Self {
            ratio,
            fit,
            teeth: ToothCount::Auto,
            style: TeethStyle::Involute,
            pressure_angle: teeth.pressure_angle,
            addendum: teeth.addendum,
            clearance: 0.1,
            backlash: 0.0,
            root_clearance: None,
            chord_tolerance: teeth.chord_tolerance,
            scale: Scale::CenterDistance(80.0),
            thickness: 8.0,
            bore: BoreChoice::AtMost(5.0),
            outfit: Outfit::default(),
            carve_with_solids: false,
            repair: true,
            runs: Vec::new(),
            quick: false,
            sector: None,
            load: Load::default(),
            limits: Limits::of_design(),
        }
    }
}

impl Default for DesignOptions {
    /// The defaults for a pair that turns equally often.
    fn default() -> Self {
        Self::new(Ratio::ONE)
    }
}

/// Why shapes or a motion did not become gears.
#[derive(Debug, thiserror::Error)]
pub enum PipelineError {
    /// The work was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// An option lies outside its range.
    #[error("{name} is {value}; {remedy}")]
    Option {
        /// The option.
        name: &'static str,
        /// What was given.
        value: f64,
        /// What would be accepted.
        remedy: String,
    },
    /// The pair cannot be run as rigid bodies.
    #[error(transparent)]
    Dynamics(#[from] DynamicsError),
    /// No motion fits the shapes.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The bounds on the pitch curves cannot be kept.
    #[error(transparent)]
    Limit(#[from] LimitError),
    /// The motion is not one.
    #[error(transparent)]
    Transmission(#[from] TransmissionError),
    /// No teeth could be made.
    #[error(transparent)]
    Teeth(#[from] TeethError),
    /// Contact could not be analysed.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// The gears cannot carry what they should.
    #[error(transparent)]
    Outfit(#[from] OutfitError),
    /// A solid could not be made.
    #[error(transparent)]
    Solid(#[from] SolidError),
}

impl PipelineError {
    /// Whether the work was stopped by its [`crate::control::Control`], in whatever stage.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        matches!(
            self,
            Self::Cancelled(_)
                | Self::Fit(FitError::Cancelled(_))
                | Self::Teeth(TeethError::Cancelled(_))
                | Self::Contact(ContactError::Cancelled(_))
                | Self::Dynamics(
                    DynamicsError::Cancelled(_)
                        | DynamicsError::Contact(ContactError::Cancelled(_))
                )
        )
    }
}
