//! Reading finished gears, and checking them.

/// Distance between a curve of a finished gear and its chords, over the diagonal of the drawing: 1 um
/// on a gear of 100 mm, below what contact analysis resolves.
pub const TOOTHED_CHORD: f64 = 1e-5;
/// Most vertices of a finished gear that are read; more than two million are no outline.
pub const TOOTHED_VERTICES: usize = 4_000_000;
/// Ends of lines and arcs this close belong together, over the diagonal of the drawing.
pub const CHAIN_GAP: f64 = 1e-4;
/// Chords of a spline between two knots.
pub const SPLINE_CHORDS: usize = 16;
/// How far from half the thickness a solid is cut, as a share of it: vertices often lie exactly there.
pub const SLICE_OFFSET: f64 = 1.234e-4;
/// How far the follower is turned in search of a gap's sides, in its pitches.
pub const GAP_REACH: f64 = 0.6;
/// Rounds in which a squeezed gap settles.
pub const GAP_ROUNDS: usize = 6;
/// Change in pitches below which it has settled.
pub const GAP_SETTLED: f64 = 1e-5;
/// Points at even distances along an outline whose teeth are counted (a power of two for the
/// transform): 20 a tooth on a gear of 400.
pub const COUNT_SAMPLES: usize = 8192;
/// Fewest and most teeth that are counted.
pub const COUNT_RANGE: (usize, usize) = (4, 512);
/// Blur that turns a toothed outline into its middle line, in teeth: leaves 3 % of the teeth.
pub const COUNT_BLUR: f64 = 0.42;
/// A tooth must rise above and sink below the middle line by this share of the mean to be counted.
pub const COUNT_HYSTERESIS: f64 = 0.3;
/// Median stray of the middle line's radius, as a share, up to which a gear counts as round.
pub const ROUND_STRAY: f64 = 0.008;
/// Distance of neighbouring teeth, in typical ones, from which a stretch counts as toothless.
pub const TOOTHLESS_FROM: f64 = 2.5;
/// Share by which the length of a toothless stretch tells its teeth wrongly: cut straight across
/// a bend it is shorter than the roots were.
pub const TOOTHLESS_DOUBT: f64 = 0.08;
/// Directions at which the radius of a middle line is kept.
pub const RADIUS_SAMPLES: usize = 2048;
/// Places on a follower's pitch at which a gap for the driver's teeth is looked for.
pub const PHASE_STEPS: f64 = 4.0;
/// Poses at which every candidate phase is tried when the motion is given.
pub const PHASE_POSES: usize = 24;
/// Poses to a driver tooth at which the chosen phase is settled, and most of them.
pub const SETTLE_POSES: (f64, usize) = (3.0, 768);
/// Places on a pitch at which overlap is measured when the gears are too large for each other.
pub const LEAST_OVERLAP_STEPS: f64 = 20.0;
/// Stray from the candidate, in pitches, that speaks against it.
pub const PHASE_STRAY: f64 = 0.25;
/// Steps to a driver tooth when motion is traced by contact.
pub const TRACE_STEPS: f64 = 8.0;
/// Steps without a gap after which a candidate's trace is given up: two teeth.
pub const TRACE_PATIENCE: usize = 16;
/// Stray from the expected angle, in pitches, up to which a traced gap is believed.
pub const TRACE_STRAY: f64 = 0.3;
/// Gaps wider than this many pitches tell nothing of the motion.
pub const TRACE_WIDEST: f64 = 0.8;
/// Pitches by which a gap may be wider than the typical one and still be believed: backlash of good
/// pairs varies by less, a missing tooth opens more.
pub const TRACE_WIDE: f64 = 0.06;
/// Half the window, in driver teeth, over which the traced motion is smoothed.
pub const TRACE_WINDOW: f64 = 1.3;
/// Share of a gap on either side that the smoothed motion keeps off the flanks.
pub const TRACE_MARGIN: f64 = 0.1;
/// Share of a trace that must be believed to make a motion.
pub const TRACE_SHARE: f64 = 0.5;
/// Longest cycle that is checked, driver turns: longer ones take minutes.
pub const CHECK_TURNS: u32 = 16;
/// How nearly a motion given by samples must cover whole turns, radians.
pub const MOTION_CLOSES: f64 = 2e-3;
/// Cycles that `check` runs as rigid bodies.
pub const CHECK_CYCLES: f64 = 1.0;
/// Intervals of the motion in a report.
pub const CHECK_SAMPLES: usize = 256;
/// How far two recorded distances of axes may differ, relative, and count as one: rounding of written decimals.
pub const DISTANCES_AGREE: f64 = 1e-9;
