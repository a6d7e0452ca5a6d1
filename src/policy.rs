//! Every numeric tolerance of the program, each with its unit and its reason.
//!
//! Lengths are relative to the thing they guard (gear module, size of a
//! shape), so that a design scales without changing its decisions.

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

/// Interference, in modules, beyond which a pose is given up as jammed: the teeth are through each
/// other, and how far is of no use to anyone.
pub const DEEP_INTERFERENCE: f64 = 0.5;

/// Fractional part of the golden ratio: multiples of it fall on no grid of teeth or samples.
pub const GOLDEN_FRACTION: f64 = 0.618_033_988_749_894_9;
