//! Every numeric tolerance of the program, each with its unit and its reason.
//!
//! Lengths are relative to the thing they guard (gear module, size of a
//! shape), so that a design scales without changing its decisions.

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
