//! Refinement of a fit.

/// Cells of the field of a drawing along the longer side of its box: a cell is a quarter of a tooth of a common gear.
pub const FIELD_CELLS: usize = 160;
/// Empty cells round the drawing: the widest blur reaches no further.
pub const FIELD_MARGIN: usize = 24;
/// Lines of a cell on which the drawing's cover is measured; along a line it is exact.
pub const FIELD_LINES: usize = 4;
/// Weight of omega max psi' beside the share of area that differs: kappa. At 0.25 likeness hardly gains and torque falls by a
/// third; at 0.04 the torque stays about what it was.
pub const POLISH_TORQUE: f64 = 0.04;
/// Sharpness of the soft maximum of psi', over the mean of psi'.
pub const POLISH_SOFT_MAXIMUM: f64 = 30.0;
/// Weight of the squares of what exceeds the bounds on psi' (over its mean) and on the tangent of the lean.
pub const POLISH_PENALTY: f64 = 4.0;
/// Weight of the square of ln psi's bend: between equal likenesses the smoother law is taken.
pub const POLISH_STIFFNESS: f64 = 1e-7;
/// Steps that L-BFGS remembers.
pub const POLISH_MEMORY: usize = 12;
/// Change of value and length of the gradient at which L-BFGS stops.
pub const POLISH_TOLERANCE: f64 = 1e-6;
/// One pass of the refinement.
#[derive(Clone, Copy, Debug)]
pub struct PolishStage {
    /// Waves of ln psi'. 24 carry features of half a tooth of a gear of 48.
    pub waves: usize,
    /// Points of a pitch curve, over the longer gear's turn.
    pub places: usize,
    /// Blur of the drawings, in cells of their fields: features come within reach of each other.
    pub blur: f64,
    /// Rounds of L-BFGS.
    pub rounds: u64,
    /// Different ends that go on.
    pub kept: usize,
}
/// The passes of the refinement, from many rough starts to a few sharp ends.
pub const POLISH_STAGES: [PolishStage; 3] = [
    PolishStage { waves: 8, places: 96, blur: 6.0, rounds: 20, kept: 6 },
    PolishStage { waves: 16, places: 192, blur: 2.0, rounds: 30, kept: 3 },
    PolishStage { waves: 24, places: 384, blur: 0.5, rounds: 60, kept: 2 },
];
/// Waves of a start's law.
pub const POLISH_START_WAVES: usize = 8;
/// Ends nearer to each other than this (lengths over the drawing's, radians, shares) are one.
pub const POLISH_TWINS: f64 = 0.02;
/// Samples of the law of a start: it keeps only a few waves.
pub const POLISH_START_SAMPLES: usize = 128;
/// Cells of each angle's period in a warped alignment; a step spans up to five.
pub const WARP_CELLS: usize = 48;
/// Cells between the follower angles from which paths start.
pub const WARP_STRIDE: usize = 4;
/// A path strays from the even motion by a period over this at most.
pub const WARP_BAND: usize = 3;
/// Centres spread over each drawing between which motions are warped, at least.
pub const WARP_CENTERS: usize = 9;
/// Centres of the search that join them.
pub const WARP_CANDIDATES: usize = 4;
/// A found centre nearer than this to one of those spread, over their spacing, adds nothing.
pub const WARP_APART: f64 = 0.3;
/// Warped alignments from which a refinement starts.
pub const WARP_KEPT: usize = 16;
/// Passes of smoothing over a path's steps.
pub const WARP_SMOOTHING: usize = 2;
/// Default weight in E of the area that cannot be seen from an axis, as a share of the drawing's.
pub const DEFAULT_STAR_WEIGHT: f64 = 2.0;
/// Share of a drawing's area that must be lost before the loss is worth a warning.
pub const LOST_AREA_WORTH_SAYING: f64 = 0.005;
