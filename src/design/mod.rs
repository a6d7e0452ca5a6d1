//! The pipeline: two shapes, one shape, or a motion in, a finished pair of gears out.

mod attempt;
mod feasibility;
mod fittings_record;
mod options;
pub mod outfit;
mod record;
mod saved;
mod sector;
mod settings;
mod source;
mod train_file;

pub use options::{BoreChoice, DesignError, DesignOptions, Scale, TeethStyle, ToothCount};
pub use record::{Record, run_record};
pub use saved::{RECORD_NAME, SavedDesign, SavedError};
pub use source::Drawn;
pub use train_file::{TrainFileError, read_train, train_from_toml};

use crate::assembly::{Assembly, Gear, PlacedGear};
use crate::control::StageName;
use crate::diagnose::{Code, Diagnostic, Limits, Severity};
use crate::fit::{self, Fit, FittedGear, Objective, Ratio};
use crate::geometry::{self, Point};
use crate::input::Shape;
use crate::meshing::{
    ContactAnalysis, ContactInput, DynamicsError, DynamicsInput, DynamicsOptions, MeshingReport,
    judge_contact, prove,
};
use crate::pitch::{Centrodes, Transmission};
use crate::policy;
use crate::solid::Bore;
use crate::strength::Strength;
use crate::teeth::ToothedPair;
use attempt::Attempt;
use settings::Settings;
use source::Source;

/// A finished pair of gears and everything that is known of it. Lengths in mm, angles in radians.
#[derive(Clone, Debug)]
pub struct Design {
    /// Names of the two gears: of their shapes, or what their motion is called.
    pub names: [String; 2],
    /// What the design was told.
    pub options: DesignOptions,
    /// The fit of two shapes before its curves were rounded for teeth; lengths for centre distance 1.
    /// None for a pair made from a motion or from one shape.
    pub fit: Option<Fit>,
    /// Where each gear's drawing lies in it, for centre distance 1; none for a gear without a drawing.
    pub drawings: [Option<FittedGear>; 2],
    /// The pitch curves that carry the teeth.
    pub centrodes: Centrodes,
    /// Teeth of driver and follower.
    pub teeth: [u32; 2],
    /// The toothed gears before clearance.
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
    /// The rigid-body runs and their verdict, once made.
    pub proof: Option<MeshingReport>,
    /// What was done to make the pair work, in order.
    pub steps: Vec<String>,
    /// What deserves attention.
    pub warnings: Vec<String>,
    /// Why the pair must not be trusted; empty when it is sound.
    pub faults: Vec<String>,
    /// Whether its play and swing, or its runs, have been judged.
    pub(crate) is_proved: bool,
}

impl Design {
    /// Whether the pair passed its own analysis.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.faults.is_empty()
    }

    /// Runs the finished pair as rigid bodies in each of the ways given; what that finds is added to
    /// the faults and warnings.
    ///
    /// # Errors
    /// See [`DynamicsError`].
    pub fn simulate(&mut self, runs: &[DynamicsOptions]) -> Result<(), DynamicsError> {
        if runs.is_empty() {
            return Ok(());
        }
        let proof = self.in_mesh(|contact| {
            let input = DynamicsInput { contact, driver_teeth: self.teeth[0] };
            prove(&input, self.contact.clone(), runs, &Limits::default())
        });
        let Some(proof) = proof.transpose()? else { return Ok(()) };
        // The contact analysis has been judged already, by stricter limits.
        let proven = |d: &&Diagnostic| d.stage == StageName::Proven;
        for found in proof.diagnostics.iter().filter(proven) {
            match found.severity {
                Severity::Fault => self.faults.push(found.to_string()),
                Severity::Warning => self.warnings.push(found.to_string()),
                Severity::Note => self.steps.push(found.to_string()),
            }
        }
        self.proof = Some(proof);
        Ok(())
    }

    /// What `with` makes of the finished gears in mesh; none unless they are a pair.
    fn in_mesh<T>(&self, with: impl FnOnce(ContactInput<'_>) -> T) -> Option<T> {
        let [driver, follower] = &self.assembly.gears[..] else { return None };
        Some(with(ContactInput {
            driver: &driver.gear.outline,
            follower: &follower.gear.outline,
            center_distance: self.centrodes.center_distance,
            module: self.pair.module,
            motion: &self.centrodes.transmission,
            control: &self.options.control,
        }))
    }

    /// Proves the finished pair: by the runs asked for, or without any by the swing of its contact analysis.
    fn proved(&mut self) -> Result<(), DynamicsError> {
        if !self.is_sound() {
            return Ok(());
        }
        self.is_proved = true;
        self.judge_play();
        if !self.is_sound() {
            return Ok(());
        }
        if !self.options.runs.is_empty() {
            let runs = self.options.runs.clone();
            return self.simulate(&runs);
        }
        if !self.options.quick {
            self.judge_swing();
        }
        Ok(())
    }

    /// Play so wide that little of each tooth is left to hold.
    fn judge_play(&mut self) {
        let held = self.contact.poses.iter().filter(|p| !p.lost && !p.lost_reversed);
        let widest = held
            .map(|p| ((p.play_behind + p.play_ahead) / p.pitch_angle, p.driver_angle))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((share, at)) = widest.filter(|w| w.0 > policy::NOTED_PLAY) else { return };
        let said = format!(
            "the play reaches {:.0} % of a pitch at {:.0} degrees of driver turn; give less clearance, less lean or fewer teeth",
            100.0 * share,
            at.to_degrees()
        );
        if share > policy::WORST_PLAY {
            self.faults.push(said);
        } else {
            self.warnings.push(said);
        }
    }

    /// Holds the finished gears, with their clearance, to the limits that a run holds them to.
    fn judge_swing(&mut self) {
        let limits = Limits::default();
        for found in judge_contact(&self.contact, None, self.pair.module, self.teeth[0], &limits) {
            match (found.code, found.severity) {
                (Code::TransmissionError, Severity::Fault) => self.faults.push(found.to_string()),
                (Code::TransmissionError, _) => self.warnings.push(found.to_string()),
                _ => {}
            }
        }
    }

    /// Whether teeth that mesh failed their proof and may be made otherwise.
    fn can_be_repaired(&self) -> bool {
        self.options.repair && self.is_proved && !self.is_sound()
    }

    /// How many teeth of one period, both gears together, are full, steeper, shortened, blunted.
    #[must_use]
    pub fn tooth_tally(&self) -> [usize; 4] {
        feasibility::tally(&self.pair.records)
    }

    /// E and its parts, of a pair that was fitted to two shapes.
    #[must_use]
    pub fn objective(&self) -> Option<&Objective> {
        self.fit.as_ref().map(|fit| &fit.objective)
    }
}

/// Designs a pair of gears from two shapes.
///
/// # Errors
/// See [`DesignError`]. A pair that is made but fails its own analysis is returned with
/// [`Design::faults`].
pub fn design(
    driver: &Shape,
    follower: &Shape,
    options: &DesignOptions,
) -> Result<Design, DesignError> {
    check(options)?;
    options.outfit.check(options.thickness)?;
    if let BoreChoice::Exactly(bore) = options.bore {
        bore.polygon(policy::BORE_CHORD_TOLERANCE)?;
    }
    options.outfit.check_fit(&options.bore)?;
    if let Scale::CenterDistance(distance) = options.scale {
        options.outfit.check_distance(distance)?;
    }
    let made = |max_lean: f64| -> Result<Design, DesignError> {
        let limits = fit::Limits { max_lean, ..options.fit.limits };
        let options = DesignOptions {
            fit: fit::FitOptions { limits, ..options.fit.clone() },
            ..options.clone()
        };
        let fit = fit::fit(
            &driver.outline,
            &follower.outline,
            options.ratio,
            &options.fit,
            &options.control,
        )?;
        let source = Source::fitted([driver, follower], fit, options.fit.symmetric);
        let mut made = tried(&source, &options)?.made;
        made.proved()?;
        Ok(made)
    };
    let asked = options.fit.limits.max_lean;
    let mut best = made(asked)?;
    // Another motion with less lean, sought as the first was.
    for less in policy::PROOF_REPAIRS {
        if !best.can_be_repaired() {
            break;
        }
        let max_lean = asked - less;
        let said = lean_held(max_lean, &best.faults);
        if let Ok(mut next) = made(max_lean)
            && next.is_sound()
        {
            next.steps.push(said);
            next.options = options.clone();
            best = next;
        }
    }
    fitted_out(best, options)
}

/// Designs a pair of gears that moves as `transmission` says, at the size that `options` give.
///
/// The motion is kept as it is: bounds on lean and curvature come in only where no teeth follow it, and
/// [`Design::steps`] then says by how much it was changed. [`DesignOptions::ratio`] is taken from the motion;
/// what `options` say of fitting is otherwise not used. `drawings` are shown behind the gears and measured for
/// likeness, where there are any.
///
/// # Errors
/// As [`design`].
///
/// ```
/// use centrode::design::{DesignOptions, from_motion};
/// use centrode::law::{LawOptions, Preset};
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
    drawings: [Option<Drawn<'_>>; 2],
    options: &DesignOptions,
) -> Result<Design, DesignError> {
    let source = Source::motion(transmission, names, drawings);
    source::check(&source)?;
    let ratio =
        Ratio::of_folds(source.transmission.driver_fold(), source.transmission.follower_fold());
    let options = DesignOptions { ratio, ..options.clone() };
    check(&options)?;
    made_from(&source, &options)
}

/// Designs a gear from one shape, and computes its mate.
///
/// The shape turns about [`fit::Fixed::driver_axis`], or about the point inside it that costs least: bounds on lean
/// and torque, greatest torque, and parts hidden from the axis.
///
/// # Errors
/// As [`design`].
pub fn mate(shape: &Shape, options: &DesignOptions) -> Result<Design, DesignError> {
    check(options)?;
    let mated = fit::mate(&shape.outline, options.ratio, &options.fit, &options.control)?;
    made_from(&Source::mated(shape, mated), options)
}

/// A pair before its proof, and the settings it was made with.
struct Tried {
    made: Design,
    settings: Settings,
}

/// Teeth, analysis, repairs.
fn tried(source: &Source<'_>, options: &DesignOptions) -> Result<Tried, DesignError> {
    let mut steps = Vec::new();
    let mut settings = Settings::first(source, options)?;
    let mut best = Attempt::make(source, options, settings)?;
    if options.repair {
        for _ in 0..policy::REPAIRS {
            if best.is_good() {
                best = best.confirmed(options)?;
                if best.is_good() {
                    break;
                }
            }
            let (next, said) = settings.gentler(best.max_lean());
            settings = next;
            // What cannot be made is no reason to give up what has been.
            let Ok(attempt) = Attempt::make(source, options, settings) else { continue };
            if attempt.badness() < best.badness() {
                steps.push(format!(
                    "{said}: transmission error {:.2} % of a pitch instead of {:.2} %",
                    100.0 * attempt.error_share(),
                    100.0 * best.error_share()
                ));
                best = attempt;
            }
        }
    }
    let settings = best.settings();
    let made = best.confirmed(options)?.finish(source, options, steps)?;
    Ok(Tried { made, settings })
}

/// Teeth, analysis, repairs, proof: a motion that fails as rigid bodies is held to less lean.
fn made_from(source: &Source<'_>, options: &DesignOptions) -> Result<Design, DesignError> {
    let Tried { made: mut best, settings } = tried(source, options)?;
    best.proved()?;
    let steps = best.steps.clone();
    for less in policy::PROOF_REPAIRS {
        if !best.can_be_repaired() {
            break;
        }
        let gentler = settings.with_less_lean(less);
        let attempt = Attempt::make(source, options, gentler).and_then(|a| a.confirmed(options));
        // Where no teeth fit at all the first pair is what there is.
        let Ok(attempt) = attempt else { continue };
        let said = lean_held(gentler.max_lean(), &best.faults);
        let steps = steps.iter().cloned().chain([said]).collect();
        let Ok(mut next) = attempt.finish(source, options, steps) else { continue };
        next.proved()?;
        if next.is_sound() {
            best = next;
        }
    }
    fitted_out(best, options)
}

fn lean_held(max_lean: f64, faults: &[String]) -> String {
    format!(
        "lean held to {:.0} degrees, for the first pair failed when it was proved: {}",
        max_lean.to_degrees(),
        faults.join("; ")
    )
}

fn fitted_out(mut made: Design, options: &DesignOptions) -> Result<Design, DesignError> {
    if let Some(segment) = options.sector {
        sector::cut(&mut made, segment)?;
    }
    let said = outfit::fit_out(&mut made.assembly, &options.outfit, &made.names, made.pair.module)?;
    made.warnings.extend(said);
    Ok(made)
}

fn check(options: &DesignOptions) -> Result<(), DesignError> {
    let refuse = |name, value, remedy: String| Err(DesignError::Option { name, value, remedy });
    let length = |name, value: f64| {
        if value > 0.0 && value <= policy::LARGEST_LENGTH {
            Ok(())
        } else {
            refuse(
                name,
                value,
                format!("give a length above 0 and up to {} mm", policy::LARGEST_LENGTH),
            )
        }
    };
    match options.scale {
        Scale::CenterDistance(value) => length("the centre distance", value)?,
        Scale::Extent(value) => length("the size", value)?,
    }
    length("the thickness", options.thickness)?;
    let load = &options.load;
    for (name, value) in
        [("the load", load.torque), ("the speed", load.rpm), ("the friction", load.friction)]
    {
        if !(value >= 0.0 && value.is_finite()) {
            return refuse(name, value, "give a number of 0 or more".to_owned());
        }
    }
    for (name, value) in [
        ("the clearance", options.clearance),
        ("the backlash", options.backlash),
        ("the root clearance", options.root_clearance.unwrap_or(0.0)),
    ] {
        if !(0.0..=policy::LARGEST_LENGTH).contains(&value) {
            return refuse(name, value, "give a length of 0 or more".to_owned());
        }
    }
    let (least, most) = policy::CHORD_TOLERANCE_RANGE;
    if !(least..=most).contains(&options.chord_tolerance) {
        let remedy = format!("give {least:e} to {most} modules");
        return refuse("the chord tolerance", options.chord_tolerance, remedy);
    }
    let degrees = options.pressure_angle.to_degrees();
    if !(10.0..=35.0).contains(&degrees) {
        return refuse("the pressure angle", degrees, "give 10 to 35 degrees".to_owned());
    }
    if !(0.2..=1.5).contains(&options.addendum) {
        return refuse("the addendum", options.addendum, "give 0.2 to 1.5 modules".to_owned());
    }
    if let ToothCount::Teeth(count) = options.teeth {
        let (least, most) = policy::TEETH_RANGE;
        if !(least..=most).contains(&count) {
            let remedy = format!("give {least} to {most} teeth");
            return refuse("the number of teeth", f64::from(count), remedy);
        }
    }
    Ok(())
}

/// The drawing as it lies on its gear: the fitted pose, scaled to the area of the pitch curve.
fn placed_input(shape: &Shape, gear: &FittedGear, pitch_curve: &[Point]) -> Vec<Point> {
    let placed: Vec<Point> = shape.raw.points().iter().map(|p| gear.placement.apply(*p)).collect();
    let scale = (geometry::area(pitch_curve) / geometry::area(&placed)).sqrt();
    placed.into_iter().map(|p| p * scale).collect()
}

fn bore_for(
    options: &DesignOptions,
    outline: &[Point],
    warnings: &mut Vec<String>,
    name: &str,
) -> Result<Option<Vec<Point>>, DesignError> {
    let tolerance = policy::BORE_CHORD_TOLERANCE;
    let with_play = |bore: Bore| options.outfit.play().map_or(bore, |play| bore.with_play(play));
    match options.bore {
        BoreChoice::Exactly(bore) => {
            Ok(with_play(bore).fitted(outline, policy::BORE_WALL, tolerance)?)
        }
        BoreChoice::Named(name) => {
            let bore = name.hole(options.outfit.fit).map_err(outfit::OutfitError::from)?;
            Ok(bore.fitted(outline, policy::BORE_WALL, tolerance)?)
        }
        BoreChoice::AtMost(diameter) => {
            for share in [1.0, 0.8, 0.6, 0.4] {
                let bore = with_play(Bore::Round { diameter: share * diameter });
                if let Ok(hole) = bore.fitted(outline, policy::BORE_WALL, tolerance) {
                    if share < 1.0 {
                        warnings.push(format!(
                            "the bore of the {name} is {:.1} mm: a wider one leaves too thin a wall",
                            share * diameter
                        ));
                    }
                    return Ok(hole);
                }
            }
            warnings.push(format!("the {name} has no bore: there is no room for one at its axis"));
            Ok(None)
        }
    }
}

/// One gear on its axis.
fn placed_gear(gear: Gear, axis: Point, angle: Vec<f64>) -> PlacedGear {
    PlacedGear { gear, axis, level: 0.0, angle }
}
