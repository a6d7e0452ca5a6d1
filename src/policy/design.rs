//! Design: size, attempts and repairs.

/// Steepest lean of a pitch curve by default, radians. With a pressure angle of 20 degrees the
/// force then stays within 75 degrees of the motion; friction binds soon after.
pub const DESIGN_MAX_LEAN: f64 = 55.0_f64.to_radians();
/// Taken from the lean bound at each repair, radians.
pub const LEAN_REPAIR: f64 = 5.0 * std::f64::consts::PI / 180.0;
/// Taken from the lean bound, radians (5 and 15 degrees), for the pairs that are tried when the first one fails as rigid bodies:
/// a little often helps, and where it does not a little more seldom does.
pub const PROOF_REPAIRS: [f64; 2] = [LEAN_REPAIR, 3.0 * LEAN_REPAIR];
/// Tooth counts that are tried, smallest first.
pub const TOOTH_COUNTS: [u32; 7] = [24, 32, 40, 48, 56, 64, 72];
/// Fewest and most teeth on either gear.
pub const TEETH_RANGE: (u32, u32) = (6, 1000);
/// Distances between a flank and its chords that are taken, modules: finer ones cost minutes and megabytes for nothing that can
/// be made or measured, coarser ones leave no tooth.
pub const CHORD_TOLERANCE_RANGE: (f64, f64) = (4e-6, 0.1);
/// Motion samples per period of the motion in every file.
pub const MOTION_SAMPLES: usize = 1024;
/// Points on a pitch curve in every file.
pub const PITCH_CURVE_POINTS: usize = 720;
/// Largest centre distance, extent, clearance or thickness accepted, mm: ten metres.
pub const LARGEST_LENGTH: f64 = 10_000.0;
/// Distance between a round bore and its chords, mm.
pub const BORE_CHORD_TOLERANCE: f64 = 0.005;
/// Wall between bore and outline below which a bore is refused, mm: two printed lines.
pub const BORE_WALL: f64 = 0.8;
/// Height of a regular wave tooth from root to tip, in addenda: that of the involute teeth's addendum
/// and as much dedendum.
pub const WAVE_HEIGHT: f64 = 1.6;
/// rho of Eq. 17, in modules.
pub const WAVE_TOLERANCE: f64 = 0.1;
/// Tallest wave tooth, in modules: Eq. 17 grows without bound with the lean.
pub const WAVE_TALLEST: f64 = 3.0;
/// Points on one wave: chords within 0.005 module.
pub const WAVE_POINTS_PER_TOOTH: usize = 32;
/// The paper's search: cells along each side of the grid.
pub const PAPER_GRID: usize = 3;
/// The paper's J: pairs whose cells are refined.
pub const PAPER_KEPT: usize = 3;
/// The paper's depth of recursion.
pub const PAPER_DEPTH: usize = 3;
/// The paper's M: shifts tried over the long gear's turn.
pub const PAPER_SHIFTS: usize = 128;
/// omega of the paper.
pub const DEFAULT_TORQUE_WEIGHT: f64 = 0.2;
/// N of the paper.
pub const DEFAULT_FIT_SAMPLES: usize = 1024;
/// Least samples of one period in a fit; the curvature of fewer means nothing.
pub const FIT_SAMPLES_LEAST: usize = 64;
/// Most samples over the long gear's turn: a quarter million already takes seconds.
pub const FIT_SAMPLES_MOST: usize = 1 << 18;
/// Directions compared when a drawing is placed on its pitch curve (one period).
pub const PLACEMENT_SAMPLES: usize = 1024;
/// How far, radians, a follower's drawing may swing from the angle of the fit to overlay its pitch curve best.
pub const PLACEMENT_SWING: f64 = 0.25;
