//! Booleans and offsets of polygons through `i_overlay`, on its 64-bit integer grid: points move by
//! less than 1e-12 of the size of the input.

use super::{Point, area, signed_area};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::simplify::SimplifyShape;
use i_overlay::float::single::SingleFloatOverlay;
use i_overlay::mesh::float::outline::offset::OutlineOffset;
use i_overlay::mesh::float::style::{LineJoin, OutlineStyle};

/// A face: its outer boundary, counter-clockwise, then its holes, clockwise.
pub type Face = Vec<Vec<Point>>;

/// `subject` minus the region that `tools` wind round: counter-clockwise boundaries, which may
/// overlap, and clockwise holes in them.
#[must_use]
pub fn difference(subject: &[Point], tools: &[Vec<Point>]) -> Vec<Face> {
    let tools: Vec<_> = tools.iter().map(|t| plain(t)).collect();
    faces(vec![plain(subject)].overlay_as::<i64>(
        &tools,
        OverlayRule::Difference,
        FillRule::NonZero,
    ))
}

/// The region covered by any of the counter-clockwise polygons.
#[must_use]
pub fn union(parts: &[Vec<Point>]) -> Vec<Face> {
    let parts: Vec<_> = parts.iter().map(|t| plain(t)).collect();
    faces(parts.simplify_shape_as::<i64>(FillRule::NonZero))
}

/// The region that a closed curve winds round in the positive sense.
#[must_use]
pub fn positive_part(points: &[Point]) -> Vec<Face> {
    faces(plain(points).simplify_shape_as::<i64>(FillRule::Positive))
}

/// The region that closed curves together wind round in the positive sense.
#[must_use]
pub fn positive_parts(rings: &[Vec<Point>]) -> Vec<Face> {
    let rings: Vec<_> = rings.iter().map(|r| plain(r)).collect();
    faces(rings.simplify_shape_as::<i64>(FillRule::Positive))
}

/// What of a region lies in another, each given by its boundaries: counter-clockwise round areas, clockwise round holes.
#[must_use]
pub fn common(region: &[Vec<Point>], other: &[Vec<Point>]) -> Vec<Face> {
    overlaid(region, other, OverlayRule::Intersect)
}

/// What of a region lies outside of another, given likewise.
#[must_use]
pub fn without(region: &[Vec<Point>], other: &[Vec<Point>]) -> Vec<Face> {
    overlaid(region, other, OverlayRule::Difference)
}

fn overlaid(a: &[Vec<Point>], b: &[Vec<Point>], rule: OverlayRule) -> Vec<Face> {
    let [a, b] = [a, b].map(|rings| rings.iter().map(|r| plain(r)).collect::<Vec<_>>());
    faces(a.overlay_as::<i64>(&b, rule, FillRule::NonZero))
}

/// Faces grown by `distance`, or made smaller where it is negative; corners as with [`offset`].
#[must_use]
pub fn grown(region: &[Face], distance: f64, chord_angle: f64) -> Vec<Face> {
    let style = OutlineStyle::new(distance).line_join(LineJoin::Round(chord_angle));
    let shapes: Vec<Vec<_>> =
        region.iter().map(|face| face.iter().map(|ring| plain(ring)).collect()).collect();
    faces(shapes.outline_as::<i64>(&style))
}

/// The face with the largest outer boundary.
#[must_use]
pub fn largest(faces: Vec<Face>) -> Option<Face> {
    faces.into_iter().max_by(|a, b| area(&a[0]).total_cmp(&area(&b[0])))
}

/// Offsets a counter-clockwise polygon by `distance` (inward when negative). Corners that the offset
/// pulls apart are rounded with chords of `chord_angle` radians; the others stay sharp.
#[must_use]
pub fn offset(points: &[Point], distance: f64, chord_angle: f64) -> Vec<Face> {
    let style = OutlineStyle::new(distance).line_join(LineJoin::Round(chord_angle));
    faces(plain(points).outline_as::<i64>(&style))
}

fn plain(points: &[Point]) -> Vec<[f64; 2]> {
    points.iter().map(|p| [p.x, p.y]).collect()
}

fn faces(shapes: Vec<Vec<Vec<[f64; 2]>>>) -> Vec<Face> {
    let ring = |ring: Vec<[f64; 2]>| ring.into_iter().map(|[x, y]| Point::new(x, y)).collect();
    let face = |face: Vec<Vec<[f64; 2]>>| face.into_iter().map(ring).collect::<Face>();
    shapes
        .into_iter()
        .map(face)
        .filter(|f| f.first().is_some_and(|outer| signed_area(outer) != 0.0))
        .collect()
}
