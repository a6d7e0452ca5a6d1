//! Solids and bores.

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
