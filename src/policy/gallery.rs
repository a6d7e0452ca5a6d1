//! Scenes and galleries.

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
