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
/// Least radius of a shape about a rotation centre over its greatest; below it the centre counts as on the boundary.
pub const MIN_RELATIVE_RADIUS: f64 = 1e-6;
/// Area (relative) that rounding may add to a star-shaped curve without its being called lost.
pub const STAR_SHAPED_WITHIN: f64 = 1e-9;
/// Greatest K or 1/K: beyond it the small gear's features vanish beside the large gear's.
pub const MAX_RATIO: u32 = 100;
/// Default lean bound, radians (60 degrees): steeper flanks bind under friction and swing by clearance.
pub const DEFAULT_MAX_LEAN: f64 = std::f64::consts::FRAC_PI_3;
/// Relative excess over a bound that counts as rounding.
pub const LIMIT_ROUNDING: f64 = 1e-9;
/// Rounds of bounding, each tighter by what the spline exceeded; past them the law is diffused evenly.
pub const LIMIT_ROUNDS: usize = 8;
/// Extra tightening of a round, so that the rounds do not creep up on the bound for ever.
pub const LIMIT_TIGHTENING: f64 = 0.998;
/// Most by which one round tightens a bound.
pub const LIMIT_LARGEST_STEP: f64 = 0.8;
/// Halvings of the search for the least even diffusion: its reach is found to a hundred-thousandth.
pub const LIMIT_BISECTIONS: usize = 20;
/// Binomial smoothing passes over the kinks of a Lipschitz envelope, so that the spline does not overshoot there.
pub const LEAN_SMOOTHING_PASSES: usize = 4;
/// Rounds of local diffusion for one curvature bound.
pub const CURVATURE_ROUNDS: usize = 60;
/// Reach of one diffusion round over the radian length of a curve at the bound: larger rounds off more than it must.
pub const CURVATURE_DIFFUSION: f64 = 0.15;
/// How far diffusion fades out beside a place over the bound, in radian lengths of a curve at the bound.
pub const CURVATURE_SPREAD: f64 = 0.5;
/// Relative distance below the bound at which diffusion begins; without it the last excess would decay for ever.
pub const CURVATURE_MARGIN: f64 = 0.1;
/// Growth of the diffusion from round to round.
pub const CURVATURE_GROWTH: f64 = 1.04;
/// The paper's search: cells along each side of the grid.
pub const PAPER_GRID: usize = 3;
/// The paper's J: pairs whose cells are refined.
pub const PAPER_KEPT: usize = 3;
/// The paper's depth of recursion.
pub const PAPER_DEPTH: usize = 3;
/// The paper's M: shifts tried over the long gear's turn.
pub const PAPER_SHIFTS: usize = 128;
/// Centres of the dense grid in each shape: 225 squared is above 50,000 pairs.
pub const GRID_CENTERS: usize = 225;
/// Tries at a spacing that puts enough grid points inside a thin shape, and the factor between tries.
pub const GRID_ATTEMPTS: usize = 40;
/// See [`GRID_ATTEMPTS`].
pub const GRID_SHRINK: f64 = 0.97;
/// Samples over the long gear's turn in the dense scan: enough to rank centres, not to judge them.
pub const SCAN_SAMPLES: usize = 512;
/// Least samples of one period in the scan of a pair with a high ratio.
pub const SCAN_SAMPLES_LEAST: usize = 64;
/// Vertices of an outline in scan and first refinement; finer detail does not move a centre.
pub const SCAN_VERTICES: usize = 512;
/// Pairs kept for each centre of the short gear in the scan.
pub const KEPT_PER_ROW: usize = 24;
/// Pairs of the scan that are worked out with the limits' cost.
pub const LIMITED_PAIRS: usize = 2048;
/// Distinct candidates that leave the scan.
pub const KEPT_CANDIDATES: usize = 20;
/// Candidates are the same when both centres lie closer than this many grid steps.
pub const DISTINCT_STEPS: f64 = 2.1;
/// Candidates refined continuously.
pub const REFINED_STARTS: usize = 6;
/// First step of the shift in a refinement, samples of the scan.
pub const REFINE_SHIFT: f64 = 2.0;
/// Evaluations of one refinement at half resolution.
pub const REFINE_EVALUATIONS: usize = 120;
/// Refined candidates that are polished at full resolution.
pub const POLISHED: usize = 2;
/// First steps of the polish over those of the refinement.
pub const POLISH_SHRINK: f64 = 0.1;
/// Evaluations of one polish.
pub const POLISH_EVALUATIONS: usize = 80;
/// Most cells of the grid that looks for centres in a thin shape.
pub const GRID_CELLS_MOST: f64 = 100_000.0;
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
/// Gap between Lipschitz envelopes (of ln r) that counts as none.
pub const ENVELOPES_MEET: f64 = 1e-12;
/// Shares of the upper envelope tried on each stretch whose lean is bounded.
pub const ENVELOPE_SHARES: [f64; 7] = [0.2, 0.35, 0.45, 0.5, 0.55, 0.65, 0.8];
