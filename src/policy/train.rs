//! Gear trains.

/// Most gears of a train: collisions are sought among all pairs of them.
pub const TRAIN_MOST_GEARS: usize = 128;
/// Cycles of the first pair after which a train must have come back to its first pose.
pub const TRAIN_MOST_CYCLES: usize = 64;
/// Share of a turn by which a gear may miss its first pose and still have come back to it: rounding of many
/// compositions of psi, each exact to about 1e-12.
pub const TRAIN_REPEAT: f64 = 1e-7;
/// Most teeth that pass from one motion sample to the next: files and drawings tell the motion by its samples. The driver
/// of a common pair is 30 times slower, and so much torque would it take.
pub const TRAIN_TEETH_PER_SAMPLE: f64 = 1.0;
/// Poses at which gears that do not mesh are tested for collision: every second degree and more finely than any tooth
/// passes by another.
pub const COLLISION_POSES: usize = 240;
/// Share of a pitch that the play of a pair takes up where a ring closes: a tenth of the usual play of two pitches in a hundred.
pub const RING_SHARE_OF_PITCH: f64 = 0.002;
/// Sharpest turn from one line of centres to the next in a ring, radians (100 degrees): beyond it the gears on both sides of
/// a corner come closer than one and a quarter of their distance from it.
pub const RING_SHARPEST_TURN: f64 = 100.0 * std::f64::consts::PI / 180.0;
/// Poses at which the closing of a ring is measured.
pub const RING_SAMPLES: usize = 96;
/// Shapes of ring that are tried, from one extreme of its corners' difference to the other.
pub const RING_TRIES: usize = 721;
/// Vertices that are compared when the symmetry of an outline is sought.
pub const SYMMETRY_PROBES: usize = 48;
/// Distance of an outline from itself, turned, that counts as none, as a share of its reach.
pub const SYMMETRY_TOLERANCE: f64 = 1e-4;
/// Halvings and Newton steps that find where psi takes a value; a dozen reach rounding.
pub const INVERSE_STEPS: usize = 60;
/// Steps while the driver of a train turns by one tooth: half those of a pair, for torque is averaged anyway.
pub const TRAIN_STEPS_PER_TOOTH: u32 = 64;
/// Teeth that pass before a train is recorded, for each of its meshes: shocks of closing run along it.
pub const TRAIN_LEAD_IN_PER_MESH: f64 = 0.25;
/// Longest run without load in one mesh of a train, in pitches, that fails. Gears between others are thrown about within
/// their play where the law bends, more than a single follower is.
pub const TRAIN_WORST_FREE_RUN: f64 = 0.3;
/// Share of poses without contact in a mesh that fails.
pub const WORST_LOST_SHARE: f64 = 0.01;
/// Poses at which the play of each mesh of a train is measured.
pub const TRAIN_PLAY_POSES: usize = 180;
/// Points of each curve of a train on its page.
pub const TRAIN_PLOT_POINTS: usize = 720;
