//! Motions, mates, fixed choices.

/// Samples of psi' in one period of a motion that is given as a formula: the spline through them is exact to 1e-10 for
/// laws of a few waves.
pub const LAW_SAMPLES: usize = 2048;
/// Longest formula, characters: more than anybody types; bounds the work of the parser.
pub const FORMULA_LENGTH: usize = 1000;
/// Deepest nesting of brackets in a formula; the parser recurses once a level.
pub const FORMULA_DEPTH: usize = 50;
/// Relative difference by which psi' may fail to repeat before it is refused: ten times what rounding does
/// to a formula of a hundred terms would be 1e-12, and a table rounded to six digits 1e-6.
pub const LAW_REPEATS_WITHIN: f64 = 1e-5;
/// Samples that may fail to repeat: those at the steps of a motion that has some.
pub const LAW_STEPS: usize = 8;
/// Distance of a function from the curve through its samples, in shares of its range, that counts as a miss.
pub const LAW_MISS: f64 = 0.05;
/// Share of the samples next to which a function may be missed: kinks and steps are few.
pub const LAW_MISSES: f64 = 0.02;
/// Most waves of psi' in a turn of the driver: eight teeth for each of the finest gear that is made.
pub const LAW_WAVES: usize = 125;
/// Range of psi' over its mean below which nothing counts as a wave.
pub const LAW_FLAT: f64 = 1e-3;
/// Share of the range on both sides of its middle that a wave must pass.
pub const LAW_TREMBLE: f64 = 0.1;
/// Relative difference of the mean of psi' from n/m that is taken for rounding and scaled away: constants typed with four
/// digits.
pub const LAW_CLOSES_WITHIN: f64 = 2e-4;
/// Least psi' of a motion over its mean: below it the driver's pitch curve is thinner at its waist than a
/// tenth of a percent of the centre distance.
pub const LAW_LEAST: f64 = 1e-3;
/// Step of the differences that turn psi into psi', radians: the five-point rule then errs by 1e-12 for laws of a few waves.
pub const LAW_DIFFERENCE: f64 = 1e-3;
/// Rows of a table of a motion.
pub const LAW_ROWS: (usize, usize) = (8, 100_000);
/// Longest table of a motion, bytes.
pub const LAW_TABLE_BYTES: usize = 10_000_000;
/// Shortest and longest segment of a motion, shares of its period: what closes the gears needs room too.
pub const LAW_SEGMENT: (f64, f64) = (0.01, 0.95);
/// Greatest height of the bump in ln psi' that closes a segment: psi' changes by e to this power, far beyond any gear.
pub const LAW_CLOSING_MOST: f64 = 64.0;
/// Halvings of the bracket of that height; the last is below the rounding of the sum.
pub const LAW_CLOSING_HALVINGS: usize = 60;
/// Pitches of teeth kept on either side of those that pass the pitch point within a segment: contact reaches about one
/// pitch beyond it.
pub const SECTOR_MARGIN: f64 = 1.5;
/// Steps along the pitch curve from the segment to its cut, and places at which a tangent of the hub is looked at.
pub const SECTOR_STEPS: usize = 64;
/// Share of a turn from which on a gear is left whole.
pub const SECTOR_MOST_TURN: f64 = 0.9;
/// Radius of the hub of a sector over that of its bore.
pub const SECTOR_HUB_BORES: f64 = 2.0;
/// Least wall between its bore and the edge of its hub, mm: five printed lines.
pub const SECTOR_HUB_WALL: f64 = 2.0;
/// Its largest radius over that of the largest circle within the whole gear.
pub const SECTOR_HUB_MOST: f64 = 0.98;
/// Rounds in which a fixed orientation is approached; three suffice for laws that bend little.
pub const ORIENTATION_ROUNDS: usize = 12;
/// Angle to which a fixed orientation is kept, radians: far below what can be seen.
pub const ORIENTATION_WITHIN: f64 = 1e-7;
/// Samples of a period in the search for a mate's axis.
pub const MATE_SCAN_SAMPLES: usize = 256;
/// Axes of the grid that are refined when a shape is mated.
pub const MATE_STARTS: usize = 8;
/// Evaluations of one such refinement: two coordinates.
pub const MATE_EVALUATIONS: usize = 60;
/// Values of phi + psi at which a law is made symmetric, over its period of two turns.
pub const SYMMETRIC_SUMS: usize = 2048;
/// Sines of a symmetric law, in two turns; the last are damped to nothing.
pub const SYMMETRIC_WAVES: usize = 512;
/// Sine that is damped by a factor e: 100 waves a turn, 3.6 degrees, less than half a tooth of the finest pair chosen.
pub const SYMMETRIC_DAMPING: f64 = 200.0;
/// Samples of a symmetric law: the spline through 100 waves a turn then errs by 1e-10 of the centre distance.
pub const SYMMETRIC_SAMPLES: usize = 8192;
/// Rounds in which a symmetric law is brought within its bounds.
pub const SYMMETRIC_ROUNDS: usize = 6;
