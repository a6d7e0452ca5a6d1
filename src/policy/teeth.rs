//! Teeth.

// Teeth.

/// Fewest intervals of the arc-length table over one period. A quintic on each is exact to 1e-12 of
/// a radian for curves that bend on the scale of a tooth; more only take time to build.
pub const ROLLING_INTERVALS: usize = 4096;
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
/// Contact ratio at which a flank stops asking for a steeper pressure angle. One is the least that
/// hands motion over; the surplus covers what carving takes.
pub const WANTED_CONTACT_RATIO: f64 = 1.15;
/// Top land left on a pointed tooth, in modules.
pub const SMALLEST_TOP_LAND: f64 = 0.12;
/// Chords across a tip or root land between its rounded corners.
pub const LAND_CHORDS: usize = 6;
/// Points on each rounded corner of a generating cap; more change the root by under 3e-4 module.
pub const CAP_POINTS_PER_CORNER: usize = 12;
/// Rounding of a generating cap's corners, in modules: the tip radius of ISO 53's basic rack.
pub const CAP_ROUNDING: f64 = 0.38;
/// Cosine below which a flank is taken as lying along the pitch curve when a cap continues it.
pub const CAP_LEAST_RISE: f64 = 0.2;
/// Steepest inward slope with which a cap continues a flank.
pub const CAP_STEEPEST: f64 = 2.0;
/// Share of a tip's half land that the sloping sides of its cap may use up.
pub const CAP_LAND_USED: f64 = 0.7;
/// Rays on which a root is found before its chords are judged in their middles: enough that none hides a double bend.
pub const ROOT_FIRST_RAYS: usize = 13;
/// Greatest distance of a root's chord from the root, in modules: roots carry nothing, but drawings and
/// solids made of true curves should agree with the outline in their area.
pub const ROOT_CHORD: f64 = 1.5e-3;
/// Times the angle between two first rays is halved at most.
pub const ROOT_HALVINGS: u32 = 3;
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
/// Neighbouring corners of the tool that are first looked at together.
pub const CARVE_BLOCK: usize = 16;
/// Sectors of the blank in which its greatest radius is kept for that look.
pub const CARVE_SECTORS: usize = 128;
/// Reach of an envelope piece into the tool, in modules: less than half the thinnest top land.
pub const CARVE_DEPTH: f64 = 0.05;
/// The driver is shrunk by this before it may carve a follower that already has conjugate flanks, in
/// modules: above the chord error of the flanks, so that touching is not taken for collision.
pub const CARVE_SKIN: f64 = 6e-4;
