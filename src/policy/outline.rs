//! Reading, repairing and smoothing drawings.

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

/// Least width or height of the largest shape of an SVG in its own units. The reader makes lines of arcs with radii below
/// 1e-5: here those are corners of a hundredth of the shape, which smoothing would take away; below it ellipses become
/// rhombi.
pub const SVG_LEAST_SIZE: f64 = 1e-3;

/// Smallest diagonal and largest coordinate of an outline, in its unit. Beyond them squares of
/// lengths lose digits and the boolean library gives up.
pub const OUTLINE_RANGE: (f64, f64) = (1e-9, 1e9);

/// Most vertices an outline may be given; more is a scan or a mistake and is refused.
pub const OUTLINE_VERTICES: usize = 200_000;

/// Fewest rows of points whose first column may be taken for their numbers, if it counts up by one: three could be a
/// triangle that does so by chance.
pub const COUNTED_ROWS: usize = 4;

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

/// Least share of an image's pixels that is transparent, for transparency to tell the shape from the ground, and that each
/// of two colours of a card must have: less are stray pixels.
pub const IMAGE_CLEAR_SHARE: f64 = 0.01;

/// Share of an image's pixels from which on an opaque part of two colours is a card with something drawn on it, not a shape:
/// the corners of a square rounded by a third of its side are a tenth of it.
pub const IMAGE_CARD_SHARE: f64 = 0.9;

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
