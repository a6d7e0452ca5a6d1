//! Teeth on mating pitch curves.

mod carve;
mod clearance;
mod flank;
mod layout;
mod profile;
mod rolling;
mod root;

pub use profile::{EdgeKind, Profile};
pub use rolling::Side;

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
            chord_tolerance: 2e-4,
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
}

/// Builds involute teeth on both gears.
#[must_use]
pub fn involute_pair(centrodes: &Centrodes, options: &TeethOptions) -> Option<ToothedPair> {
    let rolling = Rolling::new(centrodes);
    let folds = centrodes.transmission.driver_fold();
    let teeth = (options.driver_teeth / folds) as usize;
    let pitch = rolling.period() / teeth as f64;
    let module = pitch / std::f64::consts::PI;
    let rack = Rack {
        pitch,
        module,
        pressure_angle: options.pressure_angle,
        steepest_pressure_angle: options.steepest_pressure_angle,
        addendum: options.addendum * module,
        root_clearance: options.root_clearance * module,
    };
    let layout = Layout::new(&rolling, &rack, teeth);
    let tolerance = options.chord_tolerance * module;
    let [driver, follower] =
        [(Side::Driver, folds), (Side::Follower, centrodes.transmission.follower_fold())].map(
            |(side, folds)| {
                gear_profile(&rolling, &layout, &rack, side, folds, options.backlash, tolerance)
            },
        );
    let (driver, follower) = (driver.untangled()?, follower.untangled()?);
    // What the flanks and roots left standing in each other's way is carved from the follower.
    let tool = driver.inset(policy::CARVE_SKIN * module)?;
    let carved = carve::carve(
        &rolling,
        &tool.points,
        &follower.points,
        rolling.period() * f64::from(cycle_periods(centrodes)),
        policy::CARVE_INSTANTS_PER_TOOTH * options.driver_teeth as usize,
        policy::CARVE_DEPTH * module,
        true,
    )?;
    let cuts = carved.cuts;
    let follower = if cuts == 0 {
        follower
    } else {
        follower.relabelled(carved.outline).without_short_edges(policy::SHORTEST_EDGE * module)
    };
    Some(ToothedPair { driver, follower, module, uncovered: layout.uncovered(), cuts })
}

/// Periods of the motion after which both gears are back where they began.
fn cycle_periods(centrodes: &Centrodes) -> u32 {
    let (a, b) = (centrodes.transmission.driver_fold(), centrodes.transmission.follower_fold());
    let gcd = |mut a: u32, mut b: u32| {
        while b != 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    a / gcd(a, b) * b
}
