//! Teeth on mating pitch curves.

mod carve;
mod clearance;
mod flank;
mod free;
mod lag;
mod layout;
mod motions;
mod profile;
mod record;
mod rolling;
mod room;
mod root;
mod wave;

pub use motions::LoadedMotion;
pub use profile::{EdgeKind, Profile};
pub use record::{ToothRecord, ToothShape};
pub use wave::{regular_wave_pair, wave_pair};

use crate::control::{Cancelled, Control};
use crate::gear::Side;
use crate::geometry::Point;
use crate::pitch::Centrodes;
use crate::policy;
use layout::{Layout, Rack};
use motions::Motions;
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
    /// Clearance, mm: what each gear gives of its flanks along their normals and of its tips. Involute
    /// flanks are generated with it; waves are not, [`Profile::inset`] gives it to them.
    pub clearance: f64,
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
            clearance: 0.0,
            backlash: 0.0,
            chord_tolerance: 5e-4,
            control: Control::unwatched().clone(),
        }
    }
}

/// Two toothed outlines, conjugate to each other.
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
    /// The motions of the loaded pair that the flanks were made for, the follower behind and ahead, where the
    /// outlines have their clearance. `None` for outlines without clearance.
    pub loaded: Option<[LoadedMotion; 2]>,
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

/// Rounds of laying out flanks and taking from them the lag that they need: each changes the other by little.
const LAG_ROUNDS: usize = 2;

impl TeethOptions {
    fn teeth_per_period(&self, folds: u32) -> Result<usize, TeethError> {
        if self.driver_teeth == 0 || !self.driver_teeth.is_multiple_of(folds) {
            return Err(TeethError::Indivisible { teeth: self.driver_teeth, folds });
        }
        Ok((self.driver_teeth / folds) as usize)
    }
}

/// Builds involute teeth on both gears, with their clearance: flanks from one rack in the motion that the
/// loaded pair makes, roots swept free by the mate's tips, and whatever still collides carved from the
/// follower.
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
        addendum: options.addendum * module - options.clearance,
        root_clearance: options.root_clearance * module,
        clearance: options.clearance,
    };
    let nothing_left = TeethError::NothingLeft { clearance: options.clearance };
    if rack.addendum <= 0.0 {
        return Err(nothing_left);
    }
    let mut motions = Motions::without_clearance(rolling);
    let mut layout = Layout::new(&motions, &rack, teeth);
    let mut loaded = None;
    if options.clearance > 0.0 {
        for _ in 0..LAG_ROUNDS {
            options.control.check()?;
            let motion = |sigma| lag::loaded_motion(&motions, &layout, &rack, sigma);
            let (Some(behind), Some(ahead)) = (motion(-1.0), motion(1.0)) else {
                return Err(nothing_left);
            };
            let both = [behind, ahead];
            motions = motions.with_loaded(&both);
            layout = Layout::new(&motions, &rack, teeth);
            loaded = Some(both);
        }
    }
    let gear = |side: Side, folds| {
        options.control.check()?;
        let tolerance = options.chord_tolerance * module;
        gear_profile(&motions, &layout, &rack, side, folds, options.backlash, tolerance)
            .untangled()
            .ok_or(TeethError::Tangled { gear: side })
    };
    let driver = gear(Side::Driver, folds)?;
    let follower = gear(Side::Follower, centrodes.transmission.follower_fold())?;
    let carved = room::carved(&motions, driver, follower, &rack, teeth, &options.control)?;
    let records = record::records(&motions, &layout, &rack);
    Ok(ToothedPair {
        driver: carved.driver,
        follower: carved.follower,
        module,
        uncovered: layout.uncovered(),
        cuts: carved.cuts,
        records,
        loaded,
    })
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
