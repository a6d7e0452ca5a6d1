//! Files.

use super::DEFAULT_DENSITY;

// Files.

/// Default time the driver takes for one turn in an animation, s: slow enough to watch teeth mesh.
pub const SECONDS_PER_DRIVER_TURN: f64 = 6.0;

/// How far an animation may be from the motion between its keys, radians (0.01 degrees): 0.01 mm
/// at the rim of an 80 mm gear, well under a pixel. Smaller only makes more keys.
pub const ANIMATION_ANGLE_ERROR: f64 = 0.01 * std::f64::consts::PI / 180.0;

/// Largest turn between two keys, radians (60 degrees). Viewers take the short way round, so it
/// must stay well below a half turn.
pub const ANIMATION_LONGEST_STEP: f64 = std::f64::consts::PI / 3.0;
/// Gap between Lipschitz envelopes (of ln r) that counts as none.
pub const ENVELOPES_MEET: f64 = 1e-12;
/// Shares of the upper envelope tried on each stretch whose lean is bounded.
pub const ENVELOPE_SHARES: [f64; 7] = [0.2, 0.35, 0.45, 0.5, 0.55, 0.65, 0.8];

// Files: MuJoCo scenes.

/// Length of a module in a MuJoCo scene, its units: its collision code has absolute tolerances of 1e-6
/// units, which are to stay far below a module.
pub const MJCF_MODULE: f64 = 2.0;
/// Steps of a MuJoCo scene while the driver turns by one tooth: its contacts give way over two steps
/// and then track to 0.005 degrees.
pub const MJCF_STEPS_PER_TOOTH: u32 = 256;
/// Stiffness of the drive in a MuJoCo scene, loads over speeds of the driver: it slows by a
/// two-hundredth under a torque like the load.
pub const MJCF_DRIVE: f64 = 200.0;
/// Share of a gear's inertia that a MuJoCo scene puts into a mass off the axis. With none the contacts
/// are infinitely hard to it, and runs diverge.
pub const MJCF_OFF_AXIS: f64 = 0.5;
/// Moment of a gear about an axis in its plane over that about its own: at least a half, as in any rigid body.
pub const MJCF_PLANE_INERTIA: f64 = 0.6;
/// Impedance of contacts in a MuJoCo scene, the same at every depth: 1 would be rigid and diverge.
pub const MJCF_IMPEDANCE: f64 = 0.75;
/// MuJoCo's solver stops when accelerations (in driver speeds squared) change by less.
pub const MJCF_TOLERANCE: f64 = 1e-10;

// Curves of exported outlines (`geometry::curves`) and CAD formats.

/// Greatest distance between an exported curve and the vertices of the outline it stands for, mm: a tenth of
/// what a good laser or printer can tell apart.
pub const EXPORT_TOLERANCE: f64 = 0.002;
/// Smallest tolerance that may be asked for, mm; below it rounding of six written decimals shows.
pub const LEAST_EXPORT_TOLERANCE: f64 = 1e-5;
/// Largest tolerance that may be asked for, mm: half of the usual clearance, for curves stray from the middle of a chord
/// by up to twice their tolerance, and no flank may reach beyond the room that was left for it.
pub const LARGEST_EXPORT_TOLERANCE: f64 = 0.05;
/// Vertices that turn by more than this (radians, 17 degrees) are true corners; sampled curves, also
/// those that clearance has rounded ([`super::INSET_ROUND_FROM`]), turn less.
pub const CORNER_TURN: f64 = 0.3;
/// Where one chord is this many times longer than the next ...
pub const BEND_RATIO: f64 = 3.0;
/// ... and a curve through both would leave the longer one by this angle (radians, 4 degrees), the
/// vertex is a corner: chords of that bend would not have been left so long.
pub const BEND_TURN: f64 = 0.07;
/// An edge of a drawn hole this many times longer than both its neighbours is straight as drawn.
pub const STRAIGHT_EDGE_RATIO: f64 = 4.0;
/// Edges shorter than this share of the tolerance carry no direction worth following.
pub const CURVE_SHORTEST: f64 = 1.0;
/// A vertex at which the outline turns back by more than this (radians, 149 degrees) onto itself within the
/// tolerance is a barb: offsets leave such folds without width, and every program that cuts trips over them.
pub const BARB_TURN: f64 = 2.6;
/// Share of the tolerance that the smooth curve under the arcs may use up; the arcs get the rest.
pub const CURVE_SHARE: f64 = 0.5;
/// Turn of one cubic span before fitting, radians: a cubic follows 45 degrees of arc to 4e-6 of its radius.
pub const CUBIC_TURN: f64 = 0.8;
/// Weight of bending against distance in a fit: decides tangents where data does not, and moves a
/// curve by less than a nanometre elsewhere.
pub const CUBIC_STIFFNESS: f64 = 1e-7;
/// Rounds of splitting spans that miss the tolerance; each halves them.
pub const CUBIC_ROUNDS: usize = 12;
/// Sagitta below which an arc is written as a straight line, mm.
pub const STRAIGHT_SAGITTA: f64 = 1e-6;
/// How evenly the corners of a regular polygon must lie on a circle to be a round hole, relative.
pub const ROUND_HOLE_EVENNESS: f64 = 1e-9;
/// sRGB of the driver in CAD files, the light blue of the pictures.
pub const DRIVER_COLOR: [u8; 3] = [148, 201, 238];
/// sRGB of the follower in CAD files.
pub const FOLLOWER_COLOR: [u8; 3] = [49, 85, 147];
/// Tolerance of pitch curves in drawings, mm: nothing is cut along them.
pub const DRAWN_CURVE_TOLERANCE: f64 = 0.01;
/// Length that two points of a STEP file may lie apart and count as one, mm.
pub const STEP_UNCERTAINTY: f64 = 1e-6;
/// Greatest change of a gear's area by its curves, relative: beyond it a STEP file is refused.
pub const STEP_AREA_ERROR: f64 = 1e-3;
/// Most cubic spans of one face of a STEP file: about eight faces a tooth. Readers integrate volumes over longer
/// ones with errors of a thousandth and more.
pub const SPANS_PER_FACE: usize = 4;
/// Stroke of lines to cut, mm: drivers of lasers cut what is no wider than 0.001 inch, and on a screen it can be seen.
pub const HAIRLINE: f64 = 0.0254;
/// Room around and between parts on a laser sheet, mm.
pub const SHEET_GAP: f64 = 5.0;
/// Widest kerf, mm: a laser's is 0.1 to 0.3, a plasma torch's 1 to 3.
pub const LARGEST_KERF: f64 = 5.0;
/// Chord of the corners that an offset by half a kerf rounds, radians of arc.
pub const KERF_CHORD: f64 = 0.1;
/// Half the size of the cross that marks an axis in drawings, mm.
pub const AXIS_MARK: f64 = 1.5;
/// The same for a hole, which may be a coarse polygon: the bow of a few chords weighs more there.
pub const STEP_HOLE_AREA_ERROR: f64 = 0.05;

/// Densities of what gears are made of, kg/m^3: makers' data sheets, rounded.
pub const DENSITIES: [(&str, f64); 10] = [
    ("pla", DEFAULT_DENSITY),
    ("petg", 1270.0),
    ("abs", 1040.0),
    ("nylon", 1140.0),
    ("pom", 1410.0),
    ("resin", 1180.0),
    ("plywood", 650.0),
    ("acrylic", 1190.0),
    ("aluminium", 2700.0),
    ("steel", 7850.0),
];
/// Cycles of the runs that a new design must pass: one led and one by motor.
pub const DESIGN_CYCLES: f64 = 1.0;

// Moving pictures and thumbnails.

/// Longer side of a moving picture, pixels: fits a chat and a README column.
pub const ANIMATION_PIXELS: u32 = 560;
/// Longer side of the picture inside a 3MF file, pixels: what file managers show.
pub const THUMBNAIL_PIXELS: u32 = 256;
/// Frames of a GIF in a second; delays are whole hundredths, and browsers slow down those under 2.
pub const GIF_FRAMES_PER_SECOND: f64 = 25.0;
/// Fewest and most frames of a GIF: enough to move, few enough to send.
pub const GIF_FRAMES: [usize; 2] = [24, 200];
/// Steps of the blend between two colours in a GIF: 4 colours and 6 pairs fill 256 entries.
pub const GIF_BLENDS: u32 = 40;
/// White about the gears in a picture, as a share of each gear's reach.
pub const RASTER_MARGIN: f64 = 0.04;
/// Where the spoke that shows a gear's turn begins and ends, as shares of its least radius.
pub const RASTER_SPOKE: [f64; 2] = [0.45, 0.85];
/// Width of that spoke, pixels.
pub const RASTER_SPOKE_WIDTH: f64 = 3.0;
