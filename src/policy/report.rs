//! Pictures and the page.

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
