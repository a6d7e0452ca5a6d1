//! Every numeric tolerance of the program, each with its unit and its reason.
//!
//! Lengths are relative to the thing they guard (gear module, size of a
//! shape), so that a design scales without changing its decisions.

// Pitch and fit.

/// Samples a transmission function needs at least: fewer cannot carry even one bump each way.
pub const MIN_TRANSMISSION_SAMPLES: usize = 8;
/// Least psi' over its mean. Below it a gear's radius is less than a thousandth of the other's: it passes through its own axis.
pub const MIN_RELATIVE_SPEED: f64 = 1e-3;
/// Cap on safeguarded Newton steps; bisection alone reaches rounding in 53.
pub const MAX_NEWTON_STEPS: usize = 60;

// ---- Teeth ---------------------------------------------------------------------------------

/// Fewest intervals of the arc-length table over one period. Five-point quadrature on each is
/// exact to rounding for curves that bend on the scale of a tooth.
pub const ROLLING_INTERVALS: usize = 512;
/// Newton steps from the table's linear guess to the driver angle; each squares the error.
pub const ROLLING_NEWTON_STEPS: usize = 2;
/// Newton steps of a perpendicular foot; it starts within a fraction of a tooth.
pub const FOOT_NEWTON_STEPS: usize = 8;
/// A foot is found when it moves by less than this fraction of the pitch curve.
pub const FOOT_TOLERANCE: f64 = 1e-11;
/// Newton's denominator 1 + curvature x distance is kept above this, so that a point near the
/// evolute slows down instead of jumping.
pub const FOOT_MIN_STRETCH: f64 = 0.2;
/// Halvings of a flank before its chord tolerance may stop it: a symmetric bulge cannot hide.
pub const FLANK_MIN_DEPTH: u32 = 2;
/// Halvings at most, that is 1024 chords a flank, whatever the tolerance.
pub const FLANK_MAX_DEPTH: u32 = 10;
/// A flank ends before its speed falls to this fraction of that on a straight rack: at zero is its
/// cusp, and near it the flank is too curved to carry load.
pub const FLANK_SLOWEST: f64 = 0.04;
/// Steps per addendum when looking for the end of contact; a tooth's curvature is smooth on it.
pub const REACH_STEPS_PER_ADDENDUM: f64 = 6.0;
/// Longest reach searched, in addenda. At 14.5 degrees a rack touches over 4.1 addenda.
pub const REACH_LIMIT: f64 = 5.0;
/// Halvings of the last step: 2^-30 of it is below rounding of the outline.
pub const REACH_BISECTIONS: usize = 30;
/// Intervals between the wanted and the steepest pressure angle that a flank may choose from.
pub const PRESSURE_ANGLE_STEPS: u32 = 4;
/// Contact ratio at which a flank stops asking for a steeper pressure angle. One is the least that
/// hands motion over; the surplus covers what clearance takes from the tips.
pub const WANTED_CONTACT_RATIO: f64 = 1.15;
/// Top land left on a pointed tooth, in modules.
pub const SMALLEST_TOP_LAND: f64 = 0.12;
/// Chords across a tip or root land between its rounded corners.
pub const LAND_CHORDS: usize = 6;
/// Points on each rounded corner of a generating cap; more change the root by under 1e-3 module.
pub const CAP_POINTS_PER_CORNER: usize = 6;
/// Rounding of a generating cap's corners, in modules: the tip radius of ISO 53's basic rack.
pub const CAP_ROUNDING: f64 = 0.38;
/// Cosine below which a flank is taken as lying along the pitch curve when a cap continues it.
pub const CAP_LEAST_RISE: f64 = 0.2;
/// Steepest inward slope with which a cap continues a flank.
pub const CAP_STEEPEST: f64 = 2.0;
/// Share of a tip's half land that the sloping sides of its cap may use up.
pub const CAP_LAND_USED: f64 = 0.7;
/// Rays on which a root curve is found: one every few degrees of its turn.
pub const ROOT_RAYS: usize = 21;
/// Instants at which the cap is placed before refinement.
pub const ROOT_INSTANTS: usize = 25;
/// Extra rolling on both ends of the cap's passage, in pitches: the corner must have turned away.
pub const ROOT_MARGIN: f64 = 0.05;
/// Roots are drawn deeper than the envelope by this, in modules: more than their chords cut off, so
/// that a tip corner passes without touching.
pub const ROOT_RELIEF: f64 = 2e-3;
/// Golden-section steps between instants; each shrinks the bracket by 0.618.
pub const ROOT_REFINEMENTS: usize = 12;
/// A space that opens by less than this angle (radians) from its middle has no root to speak of.
pub const ROOT_LEAST_ANGLE: f64 = 0.2;
/// Shortest edge of a delivered outline, in modules; shorter ones only trouble readers.
pub const SHORTEST_EDGE: f64 = 2e-4;
/// Inward corners that turn by more than this (radians) are rounded by an inset; the chords of a
/// sampled curve turn less.
pub const INSET_ROUND_FROM: f64 = 0.25;
/// Chord of such a rounding, radians of its arc.
pub const INSET_ROUND_CHORD: f64 = 0.15;
/// Least 1 + cos of the turn at an outward corner: sharper corners are blunted, not stretched.
pub const INSET_SHARPEST: f64 = 0.05;
/// Groups of neighbouring envelope pieces united before they are cut from the blank together.
pub const CARVE_CHUNKS: usize = 128;
/// Instants of carving per driver tooth: corner paths between them are chords, 1e-4 module off at most.
pub const CARVE_INSTANTS_PER_TOOTH: usize = 32;
/// Reach of an envelope piece into the tool, in modules: less than half the thinnest top land.
pub const CARVE_DEPTH: f64 = 0.05;
/// The driver is shrunk by this before it may carve a follower that already has conjugate flanks, in
/// modules: above the chord error of the flanks, so that touching is not taken for collision.
pub const CARVE_SKIN: f64 = 5e-4;
// Contact analysis (`meshing`).

/// Poses of one contact analysis, over a whole cycle. Twenty and more a tooth on gears of 64
/// teeth; fewer can step over a contact that is lost for a moment.
pub const CONTACT_POSES: usize = 1440;

/// Surfaces closer than this, in modules, count as touching when teeth in contact are counted.
/// It must exceed the chord error of the outlines (0.002 module), or faceted flanks count as
/// apart; every increase also lengthens the measured contact ratio a little.
pub const CONTACT_DISTANCE: f64 = 0.002;

/// Touching points closer than this, in modules, belong to one pair of teeth. Contacts of two
/// pairs lie one base pitch apart, 2.7 modules at a pressure angle of 30 degrees.
pub const SAME_TOOTH_DISTANCE: f64 = 1.0;

/// How far the follower is turned in search of a contact, as a share of its local angular pitch.
/// Beyond half a pitch the next tooth would be met, and a lost contact would look like a long one.
pub const CONTACT_SEARCH_PITCH: f64 = 0.5;

/// Longest stretch of an outline without a tested point, in modules. Flanks are sampled far more
/// finely; this keeps two long straight edges from crossing unseen between their ends.
pub const CONTACT_PROBE_SPACING: f64 = 0.25;

/// Cell of the contact grid in mean edge lengths: smaller cells cost memory, larger ones tests.
pub const CONTACT_CELL_EDGES: f64 = 2.0;

/// Most cells of one contact grid (6 MB); beyond it cells grow and only speed is lost.
pub const CONTACT_MAX_CELLS: f64 = 1e6;

/// Consecutive points tested as one against the distance field before each is tested alone.
pub const CONTACT_BLOCK: usize = 8;

/// Fractional part of the golden ratio: multiples of it fall on no grid of teeth or samples.
pub const GOLDEN_FRACTION: f64 = 0.618_033_988_749_894_9;
