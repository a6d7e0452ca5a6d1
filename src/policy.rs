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
/// Intervals between the wanted and the steepest pressure angle that a flank may choose from.
pub const PRESSURE_ANGLE_STEPS: u32 = 4;
/// Contact ratio at which a flank stops asking for a steeper pressure angle. One is the least that
/// hands motion over; the surplus covers what clearance takes from the tips.
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
// --- outline: reading, repairing and smoothing drawings ---

/// Largest input file, bytes. Drawings are kilobytes, photographs a few megabytes; beyond this
/// something else was picked by mistake.
pub const INPUT_BYTES: u64 = 64 << 20;

/// Largest point file, bytes: room for [`OUTLINE_VERTICES`] lines of 80 characters.
pub const POINT_FILE_BYTES: usize = 16 << 20;

/// Largest SVG text, bytes. An SVG grows when it is read; this keeps its tree below a few hundred MB.
pub const SVG_BYTES: usize = 16 << 20;

/// Most attributes of one XML element: the parser compares each with all others.
pub const SVG_ATTRIBUTES: usize = 1000;

/// Most elements of an SVG after every `use` has been expanded. Larger means slow reading and
/// nothing a gear could show; a handful of nested `use` lines can ask for billions.
pub const SVG_ELEMENTS: u64 = 100_000;

/// Most bytes of path data after every `use` has been expanded, for the same reason.
pub const SVG_PATH_BYTES: u64 = 32 << 20;

/// Deepest nesting of SVG groups and `use`. Editors stay below 30; the reader recurses, so a
/// hostile depth would exhaust the stack.
pub const SVG_DEPTH: u32 = 128;

/// Most pairs of style rule and element that are tried while styling an SVG (about a second).
pub const SVG_STYLE_TESTS: u64 = 20_000_000;

/// Greatest distance of a flattened curve from the true one, relative to the diagonal of the
/// drawing: 5 um on a gear of 100 mm. Coarser shows as facets, finer only costs vertices.
pub const FLATTEN_TOLERANCE: f64 = 5e-5;

/// Parts of a drawing nearer than this to each other count as touching, relative to the
/// diagonal. SVG coordinates pass through f32, so edges drawn as shared differ by some 1e-6;
/// larger values would bridge gaps that were drawn on purpose.
pub const TOUCH_DISTANCE: f64 = 1e-4;

/// Ends of a path nearer than this, relative to its length, count as closed: a pen lifted one
/// step short of its start. Wider gaps are refused because the missing side can only be guessed.
pub const OPEN_PATH_GAP: f64 = 0.01;

/// How far a rectangle's sides may fall short of the canvas, relative to it, and still be
/// taken for its background.
pub const BACKGROUND_SLACK: f64 = 0.01;

/// Smallest diagonal and largest coordinate of an outline, in its unit. Beyond them squares of
/// lengths lose digits and the boolean library gives up.
pub const OUTLINE_RANGE: (f64, f64) = (1e-9, 1e9);

/// Most vertices an outline may be given; more is a scan or a mistake and is refused.
pub const OUTLINE_VERTICES: usize = 200_000;

/// Above this many vertices an outline is simplified: gears use about 2,000.
pub const OUTLINE_VERTICES_KEPT: usize = 20_000;

/// First and last tolerance, relative to the bounding box's shorter side, at which an outline with too many
/// vertices is simplified; it doubles in between. The last is about the smallest printed detail.
pub const SIMPLIFY_TOLERANCE: (f64, f64) = (1e-5, 1e-3);

/// A self-crossing outline is repaired when its largest part keeps at least this share of the
/// filled area: small loops at corners and pen slips go, a figure of eight is refused.
pub const REPAIR_AREA_KEPT: f64 = 0.98;

/// Most crossings that are resolved; a drawing with more is noise and would take gigabytes.
pub const CROSSINGS: usize = 20_000;

/// Most pairs of edges compared while looking for crossings (about a second).
pub const CROSSING_TESTS: u64 = 400_000_000;

/// Vertices nearer than this, relative to the diagonal, are merged before an outline from a
/// boolean is checked again: its integer grid has steps of about 1e-9.
pub const WELD_DISTANCE: f64 = 1e-8;

/// Largest image, pixels. A silhouette needs one; at four bytes this is 160 MB while decoding.
pub const IMAGE_PIXELS: u64 = 40_000_000;

/// Most memory an image decoder may take, bytes: eight bytes a pixel and its own buffers. Floating-point TIFFs of the most
/// pixels take more and are refused, so that reading stays below 500 MB.
pub const IMAGE_ALLOCATION: u64 = 400 << 20;

/// Images above this many pixels are averaged down before tracing: the contour then still has
/// several times more points than an outline keeps.
pub const IMAGE_PIXELS_TRACED: u64 = 4_000_000;

/// Smallest image side, pixels. Below it there is no shape to follow.
pub const IMAGE_SIDE: u32 = 8;

/// Least difference between the darkest and the lightest pixel, of 255. A blank scan with
/// compression noise stays below it.
pub const IMAGE_CONTRAST: u8 = 16;

/// Smallest silhouette, pixels of the traced image; less is a speck.
pub const IMAGE_SHAPE_PIXELS: usize = 24;

/// Standard deviation of the blur before tracing, pixels. Black-and-white images have no grey
/// edge to interpolate; one pixel of blur makes one. More rounds off details.
pub const IMAGE_BLUR: f64 = 1.0;

/// Contour points keep this distance from pixel centres, in pixels, so that no two coincide.
pub const CONTOUR_MARGIN: f64 = 1e-3;

/// Vertices of a smoothed outline, evenly spaced; the paper's range of N ends here.
pub const SMOOTH_SAMPLES: usize = 2048;

/// Samples taken per kept vertex before smoothing, so that detail finer than a vertex averages
/// out instead of folding back as noise.
pub const SMOOTH_OVERSAMPLING: usize = 4;

/// Automatic smoothing radius relative to the perimeter: waves longer than 2 pi times this keep
/// more than half their height. About the pixel noise of a silhouette 200 pixels across, and
/// below the size of a tooth, so what goes could not be seen behind the teeth.
pub const SMOOTH_RADIUS_AUTO: f64 = 0.005;

/// Smoothing radius relative to the perimeter at strength 1. There a square is nearly a disc.
pub const SMOOTH_RADIUS_FULL: f64 = 0.05;

/// Automatic smoothing is weakened until intersection over union with the drawing is at least this.
pub const SMOOTH_LIKENESS: f64 = 0.985;

/// Factor of one weakening, and how often it is tried before smoothing is given up.
pub const SMOOTH_WEAKENING: (f64, usize) = (0.7, 12);
// Solids

/// Largest error of a solid's volume, relative to base area x thickness.
///
/// The default kernel hands its meshes back in single precision, which alone costs about 1e-7 of
/// each coordinate; a missing tooth flank or a doubled wall costs 1e-4 and more. Tighter refuses
/// sound gears of many fine teeth, looser lets a lost sliver pass.
pub const SOLID_VOLUME_ERROR: f64 = 2e-5;

/// Triangles thinner than this part of the mesh's largest coordinate have no direction of their
/// own: single precision moves their corners about as far. Their normal is taken from the
/// neighbour across the longest edge. Larger would flatten real flank facets.
pub const SOLID_SLIVER: f64 = 1e-6;

/// Edges that bend by less than this (radians; 30 degrees) are shaded smoothly: a flank sampled to
/// a chord tolerance bends by a few degrees per edge, a tooth tip by much more.
pub const CREASE_ANGLE: f64 = std::f64::consts::PI / 6.0;

/// How far a cutting prism sticks out of each face of what it cuts, relative to the thickness.
/// Any amount keeps faces of cutter and stock from coinciding; a quarter is simply visible.
pub const CUTTER_OVERHANG: f64 = 0.25;

/// Thinnest wall between bore and outline that still counts as one body, relative to the gear's
/// largest radius. Only guards the boolean; what can be printed is for the caller to ask
/// ([`crate::solid::fits`]).
pub const SOLID_LEAST_WALL: f64 = 1e-5;

/// Span of the cross of a Lego axle, mm.
pub const LEGO_AXLE_SPAN: f64 = 4.8;

/// Width of each arm of a Lego axle's cross, mm.
pub const LEGO_AXLE_ARM: f64 = 1.8;

/// Radius that clears the fillet in the inner corners of a Lego axle, mm. Without it a printed
/// hole pinches the axle at four corners.
pub const LEGO_AXLE_FILLET: f64 = 0.3;

/// Default play of a Lego axle in its hole, mm per side: a snug fit off an ordinary printer.
pub const LEGO_AXLE_PLAY: f64 = 0.1;
// report: pictures and the page.

/// Decimal digits of a picture's extent that its coordinates resolve: 1e-4 mm on a
/// 100 mm drawing. Fewer show as facets when the file is cut; more only make it larger.
pub const PICTURE_DIGITS: i32 = 6;

/// Decimal digits of the gears' extent that the page resolves: 1 um on a 100 mm pair,
/// a tenth of a pixel in the close-up.
pub const PAGE_DIGITS: i32 = 5;

/// Outline points on the page, over all curves of all gears; finer outlines are thinned
/// for the page only. Keeps it under 1 MB, which opens and turns smoothly.
pub const PAGE_POINTS: usize = 60_000;

/// Motion samples the page interpolates, over all gears: one a degree would do for the eye.
pub const PAGE_MOTION_NUMBERS: usize = 12_000;

/// Points of one plotted curve: about two to a pixel of the widest plot.
pub const PLOT_POINTS: usize = 800;

/// Width of the page's close-up, in circular pitches: a few teeth either side of the contact.
pub const CLOSE_UP_PITCHES: f64 = 6.0;
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

// ---- Design --------------------------------------------------------------------------------

/// Steepest lean of a pitch curve by default, radians. With a pressure angle of 20 degrees the
/// force then stays within 75 degrees of the motion; friction binds soon after.
pub const DESIGN_MAX_LEAN: f64 = 55.0 * std::f64::consts::PI / 180.0;
/// Largest curvature of a pitch curve times the module, first choice. At a constant curvature flanks
/// of 30 degrees hand motion on up to 0.40; a corner that is that sharp over less than a pitch may be sharper,
/// and what this leaves is found by the contact analysis and repaired.
pub const CURVATURE_TIMES_MODULE: f64 = 0.5;
/// Factor on that bound at each repair.
pub const CURVATURE_REPAIR: f64 = 0.75;
/// Taken from the lean bound at each repair, radians.
pub const LEAN_REPAIR: f64 = 5.0 * std::f64::consts::PI / 180.0;
/// Repairs tried at most, so that the work stays bounded.
pub const REPAIRS: usize = 4;
/// Tooth counts that are tried, smallest first.
pub const TOOTH_COUNTS: [u32; 7] = [24, 32, 40, 48, 56, 64, 72];
/// Change of shape (in the measure of E_s) by rounding corners below which fewer teeth are taken.
pub const ROUNDING_ACCEPTED: f64 = 0.03;
/// Smallest module chosen without being asked, mm: below it a common printer fails.
pub const SMALLEST_CHOSEN_MODULE: f64 = 1.2;
/// Fewest and most teeth on either gear.
pub const TEETH_RANGE: (u32, u32) = (6, 1000);
/// Motion samples per period of the motion in every file.
pub const MOTION_SAMPLES: usize = 1024;
/// Points on a pitch curve in every file.
pub const PITCH_CURVE_POINTS: usize = 720;
/// 99th percentile of the transmission error without clearance, in pitches, that a pair should keep.
pub const GOOD_TRANSMISSION_ERROR: f64 = 0.02;
/// The same above which a pair is not sound.
pub const WORST_TRANSMISSION_ERROR: f64 = 0.25;
/// Interference of the finished gears above which a pair is not sound, in modules; without clearance what
/// chords and carving leave by design is allowed on top.
pub const WORST_INTERFERENCE: f64 = 1e-4;
/// Pressure angle plus friction above which a drive is likely to bind, radians (a warning).
pub const STEEP_PRESSURE_ANGLE: f64 = 70.0 * std::f64::consts::PI / 180.0;
/// Largest centre distance, extent, clearance or thickness accepted, mm: ten metres.
pub const LARGEST_LENGTH: f64 = 10_000.0;
/// Distance between a round bore and its chords, mm.
pub const BORE_CHORD_TOLERANCE: f64 = 0.005;
/// Wall between bore and outline below which a bore is refused, mm: two printed lines.
pub const BORE_WALL: f64 = 0.8;
/// Lean below which reducing it gains less than it costs in likeness, radians.
pub const LEAN_WORTH_REDUCING: f64 = 40.0 * std::f64::consts::PI / 180.0;
/// Change of shape (in the measure of E_s) that a person wants to hear of.
pub const LIMIT_WORTH_SAYING: f64 = 0.005;
/// Height of a regular wave tooth from root to tip, in addenda: that of the involute teeth's addendum
/// and as much dedendum.
pub const WAVE_HEIGHT: f64 = 1.6;
/// rho of Eq. 17, in modules.
pub const WAVE_TOLERANCE: f64 = 0.1;
/// Tallest wave tooth, in modules: Eq. 17 grows without bound with the lean.
pub const WAVE_TALLEST: f64 = 3.0;
/// Points on one wave: chords within 0.005 module.
pub const WAVE_POINTS_PER_TOOTH: usize = 32;
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

// Files

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

// ---- Rounding of pitch curves ----------------------------------------------------------------

/// Standard deviation of the blur where nothing is too sharp, samples: it takes the kinks of the
/// lean bound away and nothing that can be seen.
pub const BLUR_LEAST: f64 = 1.0;
/// Widest blur, as a share of one period.
pub const BLUR_MOST: f64 = 0.06;
/// Rounds in which the blur may widen. With the growth below they reach from the least to the widest.
pub const BLUR_ROUNDS: usize = 40;
/// Least and largest factor by which a blur widens in one round.
pub const BLUR_GROWTH: (f64, f64) = (1.12, 1.6);
/// Change of a blur's standard deviation from sample to sample at most; faster changes make kinks.
pub const BLUR_WIDTH_SLOPE: f64 = 0.25;
/// Smoothing passes over the widths, so that the blur sets in gently.
pub const BLUR_WIDTH_PASSES: usize = 8;
/// Standard deviations at which the Gaussian is cut off: what is left out is below 1e-4.
pub const BLUR_REACH: f64 = 3.7;
/// Driver poses per period when the follower is carved as solids: the paper's N.
pub const SOLID_CARVING_POSES: u32 = 1024;
/// Height in modules by which a tooth may fall short and still count as full.
pub const HEIGHT_GIVEN_UP: f64 = 0.02;
/// Pressure angles closer than this (radians) count as the same.
pub const SAME_ANGLE: f64 = 1e-6;
/// Thinnest wall between opposite sides of a gear's body that goes without a warning, in modules.
pub const THIN_WALL: f64 = 0.5;
/// Chord of the rounded corners of the body in that check, radians of arc.
pub const BODY_CHORD: f64 = 0.3;

// ---- Meshing: convex parts --------------------------------------------------------------

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

// ---- Meshing: dynamics and verdict --------------------------------------------------------------

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
/// The same before a warning.
pub const NOTED_FREE_RUN: f64 = 0.03;
/// Windowed torque off psi' tau by more than this, in load torques without friction, fails.
pub const WORST_TORQUE_EXCESS: f64 = 1.0;
/// Penetration, in modules, that fails.
pub const WORST_PENETRATION: f64 = 0.05;
/// Net turn of the follower off psi, in its pitches, that fails: it has skipped a tooth.
pub const WORST_NET_TURN: f64 = 0.5;
/// Distance of the follower from the exact contact, radians (0.2 degrees), that fails.
pub const WORST_TRACKING: f64 = 0.2 * std::f64::consts::PI / 180.0;
/// See [`WORST_SWING`].
pub const NOTED_SWING: f64 = 0.08;
/// Driver angle without quasi-static contact, in driver pitches, that fails.
pub const WORST_LOST_ARC: f64 = 0.1;
/// Overlap of the outlines at the designed pose, in modules, that fails: past it they do not fit.
pub const WORST_OVERLAP: f64 = 0.01;
/// Share of the driver's work that must reach the load before a warning.
pub const NOTED_EFFICIENCY: f64 = 0.6;
/// Distance within which a contact belongs to a place of the outline, in modules: contacts lie on convex
/// pieces, which leave the outline by [`HULL_TOLERANCE`] at most, and in a step's overlap.
pub const SURFACE_REACH: f64 = 0.02;
/// Side of the cells in which a place of the outline is looked up, in modules.
pub const SURFACE_CELL: f64 = 0.1;
/// How far a contact's normal may lie off the normals of the outline there, radians: above the turn
/// between neighbouring chords, below that between a flank and the inner side of a piece.
pub const SURFACE_ANGLE: f64 = 10.0 * std::f64::consts::PI / 180.0;

// ---- Teeth: relief for play -------------------------------------------------------------------------

/// Fastest that the lag of a loaded follower may change, as a share of its speed: the driver's torque
/// changes by this share meanwhile, and the pitch point moves so little that flanks stay conjugate.
pub const RELIEF_RATE: f64 = 0.03;
/// Sudden loss of lag, in pitches of the follower, that is worth a cut; smaller ones are facets.
pub const RELIEF_FROM: f64 = 2e-3;
/// How far top lands are lowered after relief, in modules: a tip that touched its mate would still catch.
pub const RELIEF_TIP: f64 = 0.02;
/// Distance between what was carved and the chords that are kept, in modules.
pub const RELIEF_CHORD: f64 = 2e-4;
/// Carving instants between two poses of the contact analysis.
pub const RELIEF_SUBSTEPS: i64 = 2;
/// Least speed ratio at which the instant centre of the lagging motion is taken; a follower that
/// falls back faster than it is driven has none between the axes.
pub const RELIEF_LEAST_SPEED: f64 = 0.01;
/// Sine of the turn between two edges below which they count as in line when tips are moved.
pub const RELIEF_CORNER: f64 = 0.02;
/// Farthest that a corner moves when tips are moved, in multiples of that move.
pub const RELIEF_REACH: f64 = 3.0;
/// Rounds of contact analysis and relief.
pub const RELIEF_ROUNDS: usize = 3;

// ---- Files: MuJoCo scenes -----------------------------------------------------------------------

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

// ---- Reading finished gears, and checking them ---------------------------------------------------

/// Distance between a curve of a finished gear and its chords, over the diagonal of the drawing: 1 um
/// on a gear of 100 mm, below what contact analysis resolves.
pub const TOOTHED_CHORD: f64 = 1e-5;
/// Most vertices of a finished gear that are read; more than two million are no outline.
pub const TOOTHED_VERTICES: usize = 4_000_000;
/// Ends of lines and arcs this close belong together, over the diagonal of the drawing.
pub const CHAIN_GAP: f64 = 1e-4;
/// A list of points is open when its ends are apart by this many of its longest edges.
pub const OPEN_LIST_GAP: f64 = 3.0;
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

// ---- Curves of exported outlines (`geometry::curves`) and CAD formats -------------------------

/// Greatest distance between an exported curve and the vertices of the outline it stands for, mm: a tenth of
/// what a good laser or printer can tell apart.
pub const EXPORT_TOLERANCE: f64 = 0.002;
/// Smallest tolerance that may be asked for, mm; below it rounding of six written decimals shows.
pub const LEAST_EXPORT_TOLERANCE: f64 = 1e-5;
/// Vertices that turn by more than this (radians, 17 degrees) are true corners; sampled curves, also
/// those that clearance has rounded ([`INSET_ROUND_FROM`]), turn less.
pub const CORNER_TURN: f64 = 0.3;
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
/// Stroke of lines to cut, mm: laser programs cut what is thinner than 0.025 mm.
pub const HAIRLINE: f64 = 0.01;
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
// Contacts on the page.

/// Moments a tooth at which a run's contacts are kept for drawing: between two of them a contact
/// moves along its flank by less than a third of a module.
pub const TOUCHES_PER_TOOTH: u32 = 8;
/// Moments of contact on the page; longer cycles show fewer a tooth. Keeps them under 150 kB.
pub const PAGE_CONTACT_FRAMES: usize = 2_500;
/// Decimals of the driver angle (radians) and of forces (0 to 1) of a contact on the page: a
/// tenth of a pixel on a 100 mm pair.
pub const PAGE_CONTACT_DIGITS: i32 = 4;
/// Share of a run's forces that are drawn in full; the rest are cut off. In steep pairs up to
/// one step in twenty has a spike, of up to 100,000 times the usual force.
pub const PAGE_USUAL_FORCES: f64 = 0.9;
/// Length of the greatest usual force on the page, in widths of the view.
pub const PAGE_FORCE_LENGTH: f64 = 0.1;
/// Pairs with less and less lean that are tried when the first one fails as rigid bodies.
pub const PROOF_REPAIRS: usize = 2;
/// Walls thinner than twice this, in modules, are taken off a follower after relief: carving leaves
/// slivers that hang on by a point.
pub const RELIEF_SLIVER: f64 = 1e-3;

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

// Gear trains.

/// Most gears of a train: collisions are sought among all pairs of them.
pub const TRAIN_MOST_GEARS: usize = 128;
/// Cycles of the first pair after which a train must have come back to its first pose.
pub const TRAIN_MOST_CYCLES: usize = 64;
/// Share of a turn by which a gear may miss its first pose and still have come back to it: rounding of many
/// compositions of psi, each exact to about 1e-12.
pub const TRAIN_REPEAT: f64 = 1e-7;
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
/// Bends of a chain, degrees, that are tried in turn until no two gears collide.
pub const TRAIN_BENDS: [f64; 7] = [40.0, 30.0, 20.0, 15.0, 10.0, 5.0, 0.0];
/// Points of each curve of a train on its page.
pub const TRAIN_PLOT_POINTS: usize = 720;
// Scenes and galleries.

/// Likeness (normalised Damerau-Levenshtein, 0 to 1) from which on a known name is suggested for an unknown one; below it
/// the suggestion would puzzle rather than help.
pub const LIKE_A_NAME: f64 = 0.5;
/// Greatest distance of an outline on a gallery's page from the true one, in centre distances: a third of a pixel at the
/// usual size of a picture.
pub const GALLERY_THIN: f64 = 0.0025;
/// The same for the drawing and the pitch curve behind it.
pub const GALLERY_THIN_INPUT: f64 = 0.006;
/// Steps of a centre distance on a gallery's page: coordinates are whole numbers of them.
pub const GALLERY_GRID: f64 = 500.0;
/// Samples of psi over one period on a gallery's page.
pub const GALLERY_MOTION: usize = 64;
/// Greatest number of pairs in one gallery.
pub const GALLERY_PAIRS: usize = 200_000;
// Motions, mates, fixed choices

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
// Bores, hubs, holes, lettering and the base plate.

/// Parallel keys by DIN 6885-1: shafts up to this diameter, width of the key, depth of the groove in the hub, mm.
pub const KEYWAYS: [(f64, f64, f64); 13] = [
    (8.0, 2.0, 1.0),
    (10.0, 3.0, 1.4),
    (12.0, 4.0, 1.8),
    (17.0, 5.0, 2.3),
    (22.0, 6.0, 2.8),
    (30.0, 8.0, 3.3),
    (38.0, 10.0, 3.3),
    (44.0, 12.0, 3.3),
    (50.0, 14.0, 3.8),
    (58.0, 16.0, 4.3),
    (65.0, 18.0, 4.4),
    (75.0, 20.0, 4.9),
    (85.0, 22.0, 5.4),
];
/// Thinnest shaft in that table, mm.
pub const THINNEST_KEYED_SHAFT: f64 = 6.0;
/// Halvings in the search for the largest bore of a kind: to a millionth of the one asked for.
pub const LARGEST_BORE_STEPS: usize = 20;
/// Bores narrower than this are none, mm: a nozzle of 0.4 mm closes them.
pub const SMALLEST_BORE: f64 = 0.5;
/// Flat of a D bore when only the diameter is given, in diameters: the common 5 mm motor shaft has 4.5.
pub const D_FLAT: f64 = 0.9;
/// Play a side of a press fit, mm: what ordinary printers draw holes too narrow.
pub const TIGHT_FIT: f64 = 0.05;
/// Play a side of a shaft that slides in by hand, mm.
pub const SLIDE_FIT: f64 = 0.15;
/// Play a side of a shaft that turns freely, mm.
pub const LOOSE_FIT: f64 = 0.3;
/// Chords of the corners that a bevel's offset rounds, radians of arc.
pub const BEVEL_CHORD: f64 = 0.2;
/// How far vertices of a bevel's inner edges may be moved, mm: below what any printer shows.
pub const BEVEL_TOLERANCE: f64 = 1e-3;
/// How deep a post reaches into what it stands on, of the height of its foot: any amount joins them.
pub const POST_ROOT: f64 = 0.25;
/// Chords of one curve of a letter: fonts draw an O with eight curves or more, so these are 48 corners.
pub const LETTER_CHORDS: u32 = 6;
/// Chords of the corners of holes and of rooms for marks, radians of arc.
pub const OPENING_CHORD: f64 = 0.1;
/// How far vertices of holes may be moved to spare some, mm: below what any printer shows.
pub const OPENING_TOLERANCE: f64 = 0.01;
/// Wall of a hub around its bore, mm: five lines of a 0.4 mm nozzle and a little.
pub const HUB_WALL: f64 = 2.5;
/// Wall of a hub with a set screw, mm: the thread of an M3 screw holds on its own diameter.
pub const SET_SCREW_THREAD: f64 = 3.5;
/// Material above and below a set screw, mm.
pub const SET_SCREW_WALL: f64 = 0.8;
/// Height of a hub when only its diameter or its set screw is given, mm.
pub const HUB_HEIGHT: f64 = 6.0;
/// Widest play a side, mm: beyond it a shaft rattles rather than fits.
pub const LARGEST_PLAY: f64 = 2.0;
/// Fewest and most lightening holes; the most for screws too.
pub const HOLES_RANGE: (u32, u32) = (2, 24);
/// Rim left under the roots, mm, on gears so fine that modules would leave less.
pub const LIGHTENING_RIM: f64 = 2.0;
/// Rim left under the roots in modules: 1.2 tooth heights of 2.25 modules, at which standards (AGMA 2101)
/// still count a gear as solid.
pub const LIGHTENING_RIM_MODULES: f64 = 2.7;
/// Half the thickness of a tooth, in modules, and a little: pi/4 is 0.785.
pub const TOOTH_HALF_THICKNESS: f64 = 1.0;
/// Spokes, and walls between lightening holes and what else there is, mm.
pub const LIGHTENING_WALL: f64 = 4.0;
/// Length of rim that one spoke carries when their number is chosen, mm.
pub const LIGHTENING_SPACING: f64 = 35.0;
/// Fewest and most holes that are chosen.
pub const LIGHTENING_CHOICE: (u32, u32) = (3, 8);
/// Radius of the corners of lightening holes, mm: sharp ones crack.
pub const LIGHTENING_FILLET: f64 = 1.5;
/// Smaller holes than this are not worth cutting, mm^2.
pub const LIGHTENING_LEAST_AREA: f64 = 20.0;
/// Depth of what is sunk into a face, mm: two layers of a printer.
pub const ENGRAVING_DEPTH: f64 = 0.4;
/// Height of what is raised on a face, mm: three layers.
pub const EMBOSSING_HEIGHT: f64 = 0.6;
/// Length of a phase mark, in modules and its bounds in mm; its width in lengths.
pub const MARK_LENGTH: f64 = 1.6;
/// Shortest phase mark, mm: less does not print.
pub const MARK_LEAST: f64 = 1.2;
/// Longest phase mark, mm.
pub const MARK_MOST: f64 = 5.0;
/// Width of a phase mark in lengths.
pub const MARK_WIDTH: f64 = 0.8;
/// Wall between a phase mark and the nearest edge, mm: two lines of a 0.4 mm nozzle.
pub const MARK_WALL: f64 = 0.8;
/// Steps in which a place for a phase mark is looked for, mm.
pub const MARK_STEP: f64 = 0.25;
/// Points along each side at which the place of a phase mark is tested.
pub const MARK_SAMPLES: u32 = 8;
/// Wall between lettering and edges, mm. More than a cell of the grid that places are looked for on, for
/// gears up to 200 mm.
pub const LABEL_WALL: f64 = 1.2;
/// Cells of that grid along the longer side.
pub const LABEL_CELLS: usize = 180;
/// Highest capitals, mm.
pub const LETTERS_MOST: f64 = 7.0;
/// Lowest capitals that a 0.4 mm nozzle draws, mm: their strokes are a tenth.
pub const LETTERS_LEAST: f64 = 2.8;
/// Each size that is tried, in those before it.
pub const LETTERS_STEP: f64 = 0.93;
/// Thickness of a base plate, mm: stiff over 100 mm, and printed in minutes.
pub const BASE_THICKNESS: f64 = 4.0;
/// Height of the ring that keeps a gear off its plate, mm.
pub const SHOULDER_HEIGHT: f64 = 1.0;
/// How much wider than its pin that ring is on each side, mm.
pub const SHOULDER_WIDTH: f64 = 2.0;
/// How far a pin sticks out above its gear, mm.
pub const PIN_OVERHANG: f64 = 1.0;
/// Thinnest radius of a pin, mm: thinner ones break when a gear is pulled off.
pub const THINNEST_PIN: f64 = 1.0;
/// Plate around a shoulder, mm.
pub const BASE_MARGIN: f64 = 6.0;
/// Distance between the holes of a Lego beam, mm.
pub const LEGO_STUD: f64 = 8.0;
/// How far axes may lie off its holes, mm: a tenth of the play of an axle.
pub const LEGO_GRID_ERROR: f64 = 0.01;
/// Radius of the ring about an axle on a Lego plate, mm: as on a beam, clear of the next hole.
pub const LEGO_SHOULDER: f64 = 3.6;
/// Screw holes when no width is given, mm: an M3 screw goes through, by DIN 273 fine.
pub const SCREW_DIAMETER: f64 = 3.2;
/// sRGB of base plates in files.
pub const FIXTURE_COLOR: [u8; 3] = [176, 176, 170];
/// How far beyond a tooth's half thickness a rim is rounded, in modules: scallops from root to root then
/// stay below a fiftieth of a module.
pub const LIGHTENING_SMOOTHING: f64 = 2.5;
/// How far the outermost point of a gear may stray between two keys of an animation, mm: a twentieth of the gap
/// that the default clearance leaves, so that no pose in between overlaps.
pub const ANIMATION_ARC_ERROR: f64 = 0.01;
/// Samples where symmetric laws are only compared.
pub const SYMMETRIC_SAMPLES_JUDGED: usize = 1024;
/// Axes that are worked out when both gears must be one curve.
pub const SYMMETRIC_STARTS: usize = 4;

// Strength

/// Least cosine between the force on a tooth and the way its point moves (85 degrees): steeper pairs bind, and a force
/// without bounds would say nothing.
pub const LEAST_FORCE_COSINE: f64 = 0.087;
/// Sections of a tooth that are tried for the weakest; the factor changes by the square of a step.
pub const LEWIS_SECTIONS: u32 = 200;
/// Sections nearer to the vertex of the parabola than this bear no bending, in modules.
pub const LEWIS_LEAST_DEPTH: f64 = 0.05;
/// Depth, in half tips, over which the direction of a flank at its tip is taken: longer than the least edges.
pub const LEWIS_FLANK_STEP: f64 = 0.05;
// Refinement of a fit (`fit::polish`).

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

// Bounds on files that are read back.

/// Longest record of a design, bytes: ten times what a pair of 1,000 teeth takes. A list of small numbers takes 16
/// times its text in memory.
pub const RECORD_BYTES: u64 = 16 << 20;
/// Longest file of a train, bytes: [`TRAIN_MOST_GEARS`] gears take a hundredth of it.
pub const TRAIN_FILE_BYTES: u64 = 1 << 20;
/// Farthest that a point of a saved part may lie from its axis, mm: ten times [`LARGEST_LENGTH`].
pub const RECORD_REACH: f64 = 10.0 * LARGEST_LENGTH;
/// Most samples of a saved motion: a thousand periods of [`MOTION_SAMPLES`].
pub const RECORD_SAMPLES: usize = 1 << 20;
/// Least step of a saved motion, radians: a follower at a thousandth of a speed that is a hundredth of the driver's
/// still steps a hundred times as far.
pub const RECORD_LEAST_STEP: f64 = 1e-10;
/// Factor between a saved module and that of its driver's teeth, at most: the work of contact analysis grows as the
/// module falls.
pub const RECORD_MODULE_OFF: f64 = 10.0;
/// Longest name in a record, bytes: those of files end at 255.
pub const RECORD_NAME_BYTES: usize = 1024;
/// Most rings of one saved part, holes or marks: pairs of them are compared.
pub const RECORD_RINGS: usize = 2000;
/// Most modules in the length of an outline whose contact is analysed, which sets its work: a gear of 1,000 teeth
/// has 10,000.
pub const CONTACT_MOST_MODULES: f64 = 1e6;
/// Fewest and most teeth of a gear under check, whoever says so: the most that a design has.
pub const TEETH_BELIEVED: (u32, u32) = (COUNT_RANGE.0 as u32, TEETH_RANGE.1);
/// Characters of a file's text that a message repeats at most: three lines of a terminal.
pub const QUOTED_LENGTH: usize = 240;
/// Pairs of ends that are compared while lines of a drawing are joined (under a second): a gear of a million lines
/// needs a tenth of it.
pub const CHAIN_TESTS: usize = 50_000_000;
/// Highest degree of a spline: drawing programs stop at 25, and the work grows with its square.
pub const SPLINE_DEGREE: usize = 25;
/// Holes of a finished gear that are looked at: they only tell where its axis is.
pub const TOOTHED_HOLES: usize = 256;
