//! Bores, hubs, holes, lettering and the base plate.

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
