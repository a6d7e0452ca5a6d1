//! The finished pair, with all that is known of it, for files, pages and programs.

use std::sync::Arc;

use super::outfitted::Outfitted;
use super::session::{Session, Stages};
use super::{DesignOptions, Drawn, PipelineError, Request, Revision, Source};
use crate::assembly::Assembly;
use crate::control::{Control, StageName};
use crate::diagnose::{Diagnostic, Severity, Verdict, sentences};
use crate::fit::{Fit, FittedGear, Objective};
use crate::input::Shape;
use crate::meshing::{ContactAnalysis, MeshingReport};
use crate::pitch::{Centrodes, Transmission};
use crate::strength::Strength;
use crate::teeth::ToothedPair;

/// A finished pair of gears and everything that is known of it. Lengths in mm, angles in radians.
#[derive(Clone, Debug)]
pub struct Design {
    /// Names of the two gears: of their shapes, or what their motion is called.
    pub names: [String; 2],
    /// What was asked.
    pub options: DesignOptions,
    /// What was used: the number of teeth that was chosen, and the bounds that repairs led to.
    pub used: DesignOptions,
    /// The repairs that were tried.
    pub revisions: Vec<Revision>,
    /// The fit of two shapes before its curves were rounded for teeth; lengths for centre distance 1.
    /// None for a pair made from a motion or from one shape.
    pub fit: Option<Fit>,
    /// Where each gear's drawing lies in it, for centre distance 1; none for a gear without a drawing.
    pub drawings: [Option<FittedGear>; 2],
    /// The pitch curves that carry the teeth.
    pub centrodes: Centrodes,
    /// Teeth of driver and follower.
    pub teeth: [u32; 2],
    /// The toothed gears as they were generated.
    pub pair: ToothedPair,
    /// The gears with clearance and bores, on their axes, with one cycle of motion.
    pub assembly: Assembly,
    /// Likeness of pitch curve and drawing, driver and follower: area of intersection over union. None for a gear
    /// without a drawing.
    pub likeness: [Option<f64>; 2],
    /// Contact without clearance: the error of the teeth themselves.
    pub exact_contact: ContactAnalysis,
    /// Contact of the finished gears.
    pub contact: ContactAnalysis,
    /// Bending of the teeth, power and efficiency under [`DesignOptions::load`].
    pub strength: Strength,
    /// The rigid-body runs and their verdict, if they were made.
    pub proof: Option<MeshingReport>,
    /// What was done to make the pair work, what deserves attention, and why it must not be trusted.
    pub diagnostics: Vec<Diagnostic>,
    /// The stages themselves.
    pub stages: Stages,
}

impl Design {
    /// The pair of finished stages; none before [`StageName::Outfitted`].
    #[must_use]
    pub fn of(stages: &Stages) -> Option<Self> {
        let outfitted: &Arc<Outfitted> = stages.outfitted.as_ref()?;
        let proven = &outfitted.proven;
        let analysed = &proven.analysed;
        let toothed = &analysed.toothed;
        let sized = &toothed.sized;
        let wanted = &sized.wanted;
        let drawn = |d: &Option<Drawn>| d.as_ref().map(|d| d.gear);
        Some(Self {
            names: wanted.names.clone(),
            options: DesignOptions { ratio: stages.used.ratio, ..stages.asked.options.clone() },
            used: stages.used.clone(),
            revisions: stages.revisions.clone(),
            fit: wanted.fit.clone(),
            drawings: [drawn(&wanted.drawings.driver), drawn(&wanted.drawings.follower)],
            centrodes: sized.centrodes.clone(),
            teeth: [sized.teeth.driver, sized.teeth.follower],
            pair: toothed.pair.clone(),
            assembly: outfitted.assembly.clone(),
            likeness: [sized.likeness.driver, sized.likeness.follower],
            exact_contact: analysed.exact.clone(),
            contact: analysed.contact.clone(),
            strength: outfitted.strength.clone(),
            proof: proven.report.clone(),
            diagnostics: stages.diagnostics(),
            stages: stages.clone(),
        })
    }

    /// The verdict on the pair.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        Verdict::of(&self.diagnostics)
    }

    /// Whether the pair may be used.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.verdict().is_sound()
    }

    /// The sentences of what was found, of one severity.
    #[must_use]
    pub fn told(&self, severity: Severity) -> Vec<String> {
        sentences(&self.diagnostics, severity)
    }

    /// How many teeth of one period, both gears together, are full, steeper, shortened, blunted.
    #[must_use]
    pub fn tooth_tally(&self) -> [usize; 4] {
        super::feasibility::tally(&self.pair.records)
    }

    /// E and its parts, of a pair that was fitted to two shapes.
    #[must_use]
    pub fn objective(&self) -> Option<&Objective> {
        self.fit.as_ref().map(|fit| &fit.objective)
    }
}

impl Request {
    /// Makes all of it, with a session of its own.
    ///
    /// # Errors
    /// See [`PipelineError`]. A pair that is made but fails its own analysis is returned: its
    /// [`Design::diagnostics`] say why.
    pub fn design(&self, control: &Control) -> Result<Design, PipelineError> {
        let stages = Session::new().run(self, StageName::Outfitted, control)?;
        Design::of(&stages).ok_or(PipelineError::Cancelled(crate::control::Cancelled))
    }
}

/// Designs a pair of gears from two shapes.
///
/// # Errors
/// As [`Request::design`].
pub fn design(
    driver: &Shape,
    follower: &Shape,
    options: &DesignOptions,
) -> Result<Design, PipelineError> {
    let request = Request::two_shapes(driver.clone(), follower.clone());
    request.with(options.clone()).design(Control::unwatched())
}

/// Designs a pair of gears that moves as `transmission` says, at the size that `options` give.
///
/// The motion is kept as it is: bounds on slope and curvature come in only where no teeth follow it, and
/// [`Code::MotionChanged`](crate::diagnose::Code::MotionChanged) then says by how much it was changed.
/// [`DesignOptions::ratio`] is taken from the motion; what `options` say of fitting is otherwise not used. `drawings` are
/// shown behind the gears and measured for likeness, where there are any.
///
/// # Errors
/// As [`Request::design`].
///
/// ```
/// use centrode::law::{LawOptions, Preset};
/// use centrode::pipeline::{DesignOptions, from_motion};
///
/// let motion = Preset::Ellipse(0.3).transmission(&LawOptions::default())?;
/// let names = ["ellipse", "its twin"].map(str::to_owned);
/// let made = from_motion(motion, names, [None, None], &DesignOptions::default())?;
/// assert!(made.is_sound());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn from_motion(
    transmission: Transmission,
    names: [String; 2],
    drawings: [Option<Drawn>; 2],
    options: &DesignOptions,
) -> Result<Design, PipelineError> {
    let source = Source::Motion { transmission, names, drawings: Box::new(drawings) };
    Request { source, options: options.clone() }.design(Control::unwatched())
}

/// Designs a gear from one shape, and computes its mate.
///
/// The shape turns about [`Fixed::driver_axis`](crate::fit::Fixed::driver_axis), or about the point inside it that costs
/// least: bounds on slope and torque, greatest torque, and parts hidden from the axis.
///
/// # Errors
/// As [`Request::design`].
pub fn mate(shape: &Shape, options: &DesignOptions) -> Result<Design, PipelineError> {
    Request::one_shape(shape.clone()).with(options.clone()).design(Control::unwatched())
}
