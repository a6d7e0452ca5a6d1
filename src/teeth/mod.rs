//! Teeth on mating pitch curves.

mod carve;
mod clearance;
mod flank;
mod layout;
mod profile;
mod record;
mod relief;
mod rolling;
mod root;
mod wave;

pub use profile::{EdgeKind, Profile};
pub use record::{ToothRecord, ToothShape};
pub use relief::{Relieved, relieved};
pub use wave::{regular_wave_pair, wave_pair};

use crate::control::{Cancelled, Control};
use crate::gear::Side;
use crate::geometry::Point;
use crate::pitch::Centrodes;
use crate::policy;
use layout::{Layout, Rack};
use profile::gear_profile;
use rolling::Rolling;

/// How the teeth are to look. Lengths in mm, angles in radians, factors in modules.
#[derive(Clone, Debug, PartialEq)]
pub struct TeethOptions {
    /// Teeth of the driver.
    pub driver_teeth: u32,
    /// Pressure angle of the rack where the pitch curve allows it.
    pub pressure_angle: f64,
    /// Steepest pressure angle a single flank may be given where the curve bends fast.
    pub steepest_pressure_angle: f64,
    /// Addendum in modules.
    pub addendum: f64,
    /// Room below a mating tip, in modules (dedendum less addendum).
    pub root_clearance: f64,
    /// Backlash along the pitch curve, mm: both gears' flanks are thinned by a quarter each.
    pub backlash: f64,
    /// Flank chords keep within this distance of the true curve, in modules.
    pub chord_tolerance: f64,
    /// Who may stop the work.
    pub control: Control,
}

impl Default for TeethOptions {
    fn default() -> Self {
        Self {
            driver_teeth: 32,
            pressure_angle: 20_f64.to_radians(),
            steepest_pressure_angle: 30_f64.to_radians(),
            addendum: 1.0,
            root_clearance: 0.25,
            backlash: 0.0,
            chord_tolerance: 5e-4,
            control: Control::unwatched().clone(),
        }
    }
}

/// Two toothed outlines without clearance, conjugate to each other.
#[derive(Clone, Debug)]
pub struct ToothedPair {
    /// Outline of the driver in its frame.
    pub driver: Profile,
    /// Outline of the follower in its frame.
    pub follower: Profile,
    /// Module: perimeter of the driver's pitch curve over pi times its teeth, mm.
    pub module: f64,
    /// Arc length per period over which no lesser-s or no greater-s flank touches, mm.
    pub uncovered: [f64; 2],
    /// Pieces of envelope that had to be carved from the follower after its flanks and roots were drawn.
    pub cuts: usize,
    /// What became of each tooth of one period of the motion; empty for wave teeth.
    pub records: Vec<ToothRecord>,
}

/// Why no teeth could be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TeethError {
    /// The work was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The teeth do not divide over the symmetry of the driver.
    #[error(
        "{teeth} driver teeth do not divide into {folds} equal parts; give a multiple of {folds}"
    )]
    Indivisible {
        /// Teeth asked for.
        teeth: u32,
        /// Periods of the motion per turn of the driver.
        folds: u32,
    },
    /// The outline of a gear falls apart or crosses itself beyond repair.
    #[error(
        "the teeth of the {gear} run into one another; ask for more teeth, or for a smoother shape or motion"
    )]
    Tangled {
        /// Which gear.
        gear: Side,
    },
    /// The clearance eats up a gear.
    #[error("a clearance of {clearance} mm leaves nothing of a gear; give less, or a larger pair")]
    NothingLeft {
        /// Clearance asked for, mm.
        clearance: f64,
    },
}

impl TeethOptions {
    fn teeth_per_period(&self, folds: u32) -> Result<usize, TeethError> {
        if self.driver_teeth == 0 || !self.driver_teeth.is_multiple_of(folds) {
            return Err(TeethError::Indivisible { teeth: self.driver_teeth, folds });
        }
        Ok((self.driver_teeth / folds) as usize)
    }
}

/// Builds involute teeth on both gears: flanks from one rack, roots swept free by the mate's tips, and
/// whatever still collides carved from the follower.
///
/// # Errors
/// See [`TeethError`].
pub fn involute_pair(
    centrodes: &Centrodes,
    options: &TeethOptions,
) -> Result<ToothedPair, TeethError> {
    let made = options.control.run(|| involutes(centrodes, options));
    options.control.check()?;
    made
}

fn involutes(centrodes: &Centrodes, options: &TeethOptions) -> Result<ToothedPair, TeethError> {
    let rolling = Rolling::new(centrodes);
    let folds = centrodes.transmission.driver_fold();
    let teeth = options.teeth_per_period(folds)?;
    let pitch = rolling.period() / teeth as f64;
    let module = pitch / std::f64::consts::PI;
    let rack = Rack {
        pitch,
        module,
        pressure_angle: options.pressure_angle,
        steepest_pressure_angle: options.steepest_pressure_angle.max(options.pressure_angle),
        addendum: options.addendum * module,
        root_clearance: options.root_clearance * module,
    };
    let layout = Layout::new(&rolling, &rack, teeth);
    options.control.check()?;
    let tolerance = options.chord_tolerance * module;
    let gear = |side, folds| {
        gear_profile(&rolling, &layout, &rack, side, folds, options.backlash, tolerance)
            .untangled()
            .ok_or(TeethError::Tangled { gear: side })
    };
    let driver = gear(Side::Driver, folds)?;
    options.control.check()?;
    let follower = gear(Side::Follower, centrodes.transmission.follower_fold())?;
    let (follower, cuts) =
        carve_rest(&rolling, &driver, follower, module, teeth, &options.control)?;
    let records = record::records(&rolling, &layout, &rack);
    Ok(ToothedPair { driver, follower, module, uncovered: layout.uncovered(), cuts, records })
}

/// Carves from the follower what flanks and roots left standing in the driver's way.
fn carve_rest(
    rolling: &Rolling<'_>,
    driver: &Profile,
    follower: Profile,
    module: f64,
    teeth: usize,
    control: &Control,
) -> Result<(Profile, usize), TeethError> {
    let tangled = |gear| TeethError::Tangled { gear };
    let tool = driver.inset(policy::CARVE_SKIN * module).ok_or(tangled(Side::Driver))?;
    control.check()?;
    let periods = rolling.cycle_periods();
    let carved = carve::carve(
        rolling,
        &tool.points,
        &follower.points,
        (
            rolling.period() * f64::from(periods),
            policy::CARVE_INSTANTS_PER_TOOTH * teeth * periods as usize,
        ),
        policy::CARVE_DEPTH * module,
        true,
        control,
    )?
    .ok_or(tangled(Side::Follower))?;
    if carved.cuts == 0 {
        return Ok((follower, 0));
    }
    let outline = follower
        .relabelled(carved.outline)
        .without_short_edges(policy::SHORTEST_EDGE * module)
        .repeated(rolling.follower_fold(), policy::FOLD_MATCH * module);
    Ok((outline, carved.cuts))
}

/// What the moving driver leaves of a blank (follower's frame, mm): paper, section 3.3 (iii), along the
/// exact envelope of the driver's outline. `None` when the follower's axis is cut away.
#[must_use]
pub fn carved_follower(
    centrodes: &Centrodes,
    driver: &[Point],
    blank: &[Point],
    driver_teeth: u32,
) -> Option<Vec<Point>> {
    let rolling = Rolling::new(centrodes);
    let periods = f64::from(rolling.cycle_periods());
    let teeth_per_period =
        f64::from(driver_teeth) / f64::from(centrodes.transmission.driver_fold());
    let module = rolling.period() / (teeth_per_period * std::f64::consts::PI);
    let instants = policy::CARVE_INSTANTS_PER_TOOTH as f64 * teeth_per_period * periods;
    let carved = carve::carve(
        &rolling,
        driver,
        blank,
        (rolling.period() * periods, instants.ceil() as usize),
        policy::CARVE_DEPTH * module,
        false,
        Control::unwatched(),
    )
    .ok()??;
    Some(carved.outline)
}

#[cfg(test)]
mod tests;
