//! Contact analysis, convex parts, dynamics and verdict.

// Contact analysis (`meshing`).

/// Poses of one contact analysis, over a whole cycle. Twenty and more a tooth on gears of 64
/// teeth; fewer can step over a contact that is lost for a moment.
pub const CONTACT_POSES: usize = 1440;
/// Poses at which a pair is judged while settings are still tried: ten a tooth of a common gear.
/// The delivered pair is judged at all of them.
pub const CONTACT_POSES_TRIED: usize = 480;

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
/// Blocks that are first looked at together: about a tooth.
pub const CONTACT_GROUP: usize = 8;

/// Interference, in modules, beyond which a pose is given up as jammed: the teeth are through each
/// other, and how far is of no use to anyone.
pub const DEEP_INTERFERENCE: f64 = 0.5;

/// Fractional part of the golden ratio: multiples of it fall on no grid of teeth or samples.
pub const GOLDEN_FRACTION: f64 = 0.618_033_988_749_894_9;

// Meshing: convex parts.

/// Transmission error peak to peak against psi, in pitches of the follower, that fails, and that warns.
pub const WORST_SWING: f64 = 0.25;
/// Area of intersection over union below which a gear hardly resembles its drawing.
pub const POOR_LIKENESS: f64 = 0.6;
/// Points of a gear that should repeat k-fold match to this, in modules, or the outline is left as it is.
pub const FOLD_MATCH: f64 = 1e-3;
/// Neighbours of a piece of envelope inside the blank that are carved with it, along the tool and in
/// time: enough to cross the blank's boundary.
pub const CARVE_SURROUND: usize = 3;
/// Instants between two at which the whole inside of a tool is cut away.
pub const CARVE_CORE_STRIDE: usize = 4;
/// Share by which the curvature of the delivered spline may pass that of its samples between them; the blur
/// aims this much below the bound.
pub const CURVATURE_RIPPLE: f64 = 0.05;

// Meshing: dynamics and verdict.

/// Reach of a convex piece's hull over a dent, in modules: it moves a contact by at most so much,
/// 0.01 degrees at the rim of a gear of 32 teeth. Smaller only makes more pieces.
pub const HULL_TOLERANCE: f64 = 0.003;
/// Length of a module in the simulated world; rapier's absolute tolerances spoil smaller ones.
pub const WORLD_MODULE: f64 = 2.0;
/// Distance at which a contact is prepared before it closes, in modules.
pub const CONTACT_PREDICTION: f64 = 0.03;
/// Steps while the driver turns by one tooth: 8 track to 0.05 degrees, 4 tunnel.
pub const STEPS_PER_TOOTH: u32 = 128;
/// Most steps of one run; longer ones stop early and say so.
pub const MOST_STEPS: usize = 400_000;
/// Cycles of one run by default: the second shows that the first was no accident.
pub const SIMULATED_CYCLES: f64 = 2.0;
/// Most cycles of one run: what goes wrong goes wrong in the first few.
pub const MOST_CYCLES: f64 = 100.0;
/// Torques (N mm), speeds (turns a minute), densities (kg/m^3) and the like that are taken: far beyond any gear on both
/// sides, and nothing that is worked out from them overflows.
pub const QUANTITY_RANGE: (f64, f64) = (1e-9, 1e9);
/// Teeth of the driver that pass before anything is recorded, so that the load has settled.
pub const LEAD_IN_TEETH: f64 = 1.0;
/// Least kappa = I omega^2 max |psi''| / tau of a run: lighter followers are given a flywheel, for a
/// step must not move them by more than the contact prediction. From 0.05 on, loss of contact is real physics.
pub const LEAST_KAPPA: f64 = 0.01;
/// Least |psi''| that kappa is reckoned with; circular gears have none.
pub const LEAST_ACCELERATION: f64 = 0.5;
/// Samples of psi' over one driver turn in search of its steepest place.
pub const ACCELERATION_SAMPLES: usize = 2048;
/// Torque limit of the motor over the greatest torque that the load asks of it.
pub const MOTOR_RESERVE: f64 = 5.0;
/// Slope of the motor: its torque limit over the slip at which it is reached, as a share of the speed.
pub const MOTOR_SLIP: f64 = 0.01;
/// Share of its speed below which a motor counts as stalled, over one tooth's time.
pub const STALLED: f64 = 0.1;
/// Time a motor is given over that of an even turn.
pub const MOTOR_PATIENCE: f64 = 1.5;
/// Teeth over which torque is averaged; single steps have spikes where facets meet.
pub const TORQUE_WINDOW_TEETH: f64 = 0.25;
/// Places a tooth where the exact contact angle is worked out; between them it runs straight.
pub const CONTACT_ANGLES_PER_TOOTH: u32 = 16;
/// How far ahead of the follower its exact contact is looked for, radians: more than it can be pressed
/// into its mate, less than any backlash.
pub const CONTACT_LEAD: f64 = 2e-4;
/// Corrective speed of overlapping contacts, world lengths per radian of driver turn: a bad
/// contact shall not throw the follower.
pub const CORRECTIVE_SPEED: f64 = 3.0;

/// Load on the follower by default, N mm: a hand crank or a small geared motor.
pub const DEFAULT_LOAD: f64 = 100.0;
/// Speed of the driver by default, turns a minute.
pub const DEFAULT_RPM: f64 = 30.0;
/// Friction of dry printed PLA on itself.
pub const DEFAULT_FRICTION: f64 = 0.25;
/// Density of PLA, kg/m^3.
pub const DEFAULT_DENSITY: f64 = 1240.0;
/// Thickness by default, mm.
pub const DEFAULT_THICKNESS: f64 = 8.0;

/// Longest run of the driver without contact, in its pitches, before a pair fails.
pub const WORST_FREE_RUN: f64 = 0.1;
/// Penetration, in modules, that fails.
pub const WORST_PENETRATION: f64 = 0.05;
/// Net turn of the follower off psi, in its pitches, that fails: it has skipped a tooth.
pub const WORST_NET_TURN: f64 = 0.5;
/// Distance of the follower from the exact contact, radians (0.2 degrees), that fails.
pub const WORST_TRACKING: f64 = 0.2 * std::f64::consts::PI / 180.0;
/// Overlap of the outlines at the designed pose, in modules, that fails: past it they do not fit.
pub const WORST_OVERLAP: f64 = 0.01;
/// Distance within which a contact belongs to a place of the outline, in modules: contacts lie on convex
/// pieces, which leave the outline by [`HULL_TOLERANCE`] at most, and in a step's overlap.
pub const SURFACE_REACH: f64 = 0.02;
/// Side of the cells in which a place of the outline is looked up, in modules.
pub const SURFACE_CELL: f64 = 0.1;
/// How far a contact's normal may lie off the normals of the outline there, radians: above the turn
/// between neighbouring chords, below that between a flank and the inner side of a piece.
pub const SURFACE_ANGLE: f64 = 10.0 * std::f64::consts::PI / 180.0;
