//! SVG drawings: what viewers show of them, as one outline or as contours.

mod guard;
mod inner;
mod region;
mod scene;

use super::choose;
use super::contours::{Contour, Contours};
use super::inner::Drawing;
use super::join;
use super::nature::Nature;
use super::note::Note;
use super::source::Source;
use super::text::decoded;
use crate::gear::Side;
use crate::geometry::{self, Point};
use crate::outline::repair::{
    Ring, count_crossings, filled_parts, joined, ring_area, simple, to_points, to_ring,
};
use crate::outline::{Outline, OutlineError, simplify};
use crate::policy;
use i_overlay::core::fill_rule::FillRule;
use scene::{Item, Scene};

/// Why an SVG drawing gives no outline.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SvgError {
    /// Not text.
    #[error("it is not text; save it as plain, uncompressed SVG")]
    NotText,
    /// The XML is malformed.
    #[error("it is not well-formed XML ({reason}); save it again from a drawing program")]
    NotXml {
        /// What the XML reader says, with line and column.
        reason: String,
    },
    /// The root element is not `svg`.
    #[error("its root element is `{root}`, not `svg`; save the drawing as plain SVG")]
    NotSvg {
        /// Name of the root element.
        root: String,
    },
    /// Longer than any drawing of a silhouette.
    #[error("it has {bytes} bytes, more than {limit}; simplify the drawing")]
    TooLong {
        /// Length of the text.
        bytes: usize,
        /// Most that is read.
        limit: usize,
    },
    /// Too many elements, counted with every `use` expanded.
    #[error(
        "with every `use` expanded it has more than {limit} elements or too much path data; \
         keep only the shape itself"
    )]
    TooManyElements {
        /// Most elements that are read.
        limit: u64,
    },
    /// Groups or `use` nested too deeply.
    #[error("its groups or `use` elements are nested more than {limit} deep; ungroup the drawing")]
    TooDeep {
        /// Deepest nesting that is read.
        limit: u32,
    },
    /// A number in path data that no drawing needs. Elliptical arcs are cut into more pieces the larger they are, and the
    /// reader's work grows with the square of these.
    #[error(
        "its path data holds the number {value:e}; keep the drawing within {limit:e} of the origin"
    )]
    Far {
        /// The number.
        value: f64,
        /// The largest that is read, [`crate::policy::OUTLINE_RANGE`].
        limit: f64,
    },
    /// A `use` that leads back to itself.
    #[error("a `use` element refers back to itself through `{id}`; remove it")]
    Circular {
        /// The id at which the circle closes.
        id: String,
    },
    /// Width, height or view box are zero, negative or not finite.
    #[error(
        "its width, height or viewBox is not positive; remove width and height or make them positive, and set \
         viewBox=\"0 0 100 100\" or the like"
    )]
    NoSize,
    /// Coordinates so small that the reader loses its arcs.
    #[error(
        "its shapes are {size:.1e} wide in their own units, less than the {least:e} that arcs need; scale the drawing up"
    )]
    Tiny {
        /// Width or height of the largest shape before transforms.
        size: f64,
        /// The least that is read.
        least: f64,
    },
    /// A clip path that is not applied.
    #[error(
        "its clip path or mask `{value}` is given by CSS in a way that is not read; give the element a clip-path=\"url(#...)\" without `use` in it"
    )]
    Cover {
        /// Its value.
        value: String,
    },
    /// Path data that breaks off, so that nothing is drawn.
    #[error("its path data `{text}` cannot be read; correct it, or save the drawing again")]
    PathData {
        /// The path data, shortened.
        text: String,
    },
    /// No drawn element at all.
    #[error("it draws nothing; add a closed, filled path")]
    Empty,
    /// Only text.
    #[error("it holds only text; convert the text to paths")]
    OnlyText,
    /// Only embedded or linked images.
    #[error("it holds only a raster image; load the image file itself, or trace it to a path")]
    OnlyImages,
    /// Only references to other files, which are never fetched.
    #[error("it only refers to other files, which are never fetched; copy the shape into it")]
    OnlyReferences,
    /// Paths, but none is filled and visible.
    #[error("none of its paths is filled and visible; give the closed path a fill")]
    NothingFilled,
    /// A drawing too far from the origin for the single precision of the reader.
    #[error(
        "it lies {distance:.0} from the origin but is only {size:.3} wide, too far to be read exactly; move it to the origin"
    )]
    FarAway {
        /// Greatest coordinate, in its own units.
        distance: f64,
        /// Diagonal, in its own units.
        size: f64,
    },
    /// No fill, and no line that closes.
    #[error("none of its paths is filled, and its lines give no shape: {reason}")]
    Lines {
        /// Why not.
        reason: String,
    },
    /// There is no such element.
    #[error(
        "it has no visible shape `{part}`; name the id of a path or group, or #1 for the largest shape"
    )]
    NoSuchPart {
        /// What was asked for.
        part: String,
    },
    /// The contour does not make an outline; places are in the units of the drawing, y upwards.
    #[error(transparent)]
    Outline(#[from] OutlineError),
}

/// Reads the largest filled shape of an SVG drawing, as viewers show it.
///
/// Transforms, groups, styles, `use`, clip paths and masks are applied; text, images, markers and filters are ignored, as is
/// what is wholly transparent. Paint of the ground's colour is no shape and takes away what lies under it: white, or the
/// colour that covers the border of the canvas. Contours that overlap or touch (within [`policy::TOUCH_DISTANCE`]) are
/// united, the component with the largest area is kept and its holes are dropped. Filled paths that are open are closed by
/// a straight line. A drawing without any fill is read by its lines. Nothing outside the text is ever read.
///
/// `tolerance` bounds the distance between curves and their chords, relative to the diagonal of the drawing. The result is
/// in the drawing's own units, y upwards from the lower edge of its page: those of a size such as `210mm`, else those of the
/// view box.
///
/// # Errors
/// See [`SvgError`].
pub fn from_svg(text: &[u8], tolerance: f64) -> Result<Outline, SvgError> {
    shape(text, tolerance, None, None).map(|drawing| drawing.outline)
}

/// The shape of a drawing, or the part of it that is named, and what a reader should know.
///
/// # Errors
/// See [`SvgError`].
pub(super) fn shape(
    bytes: &[u8],
    tolerance: f64,
    part: Option<&str>,
    join: Option<f64>,
) -> Result<Drawing, SvgError> {
    let text = decoded(bytes).ok_or(SvgError::NotText)?;
    let mut scene = Scene::read(&text, tolerance.clamp(1e-6, 0.1), part)?;
    let number = part.and_then(|p| p.parse::<usize>().ok()).filter(|n| *n > 0);
    if let Some(part) = part
        && (scene.has_part || number.is_none())
    {
        scene.items.retain(|i| i.in_part);
        if scene.items.is_empty() {
            return Err(SvgError::NoSuchPart { part: crate::wording::quoted(part) });
        }
    }
    let number = number.filter(|_| !scene.has_part);
    if !scene.items.iter().any(|i| i.paint.is_some()) {
        return lines_as_shape(&scene, join);
    }
    let mut notes = Vec::new();
    let filled: Vec<&Item> = scene.items.iter().filter(|i| i.paint.is_some()).collect();
    let all: Vec<&[Point]> =
        filled.iter().flat_map(|i| &i.contours).map(|c| c.points.as_slice()).collect();
    count_crossings(&all)?;
    let shown = region::painted(&filled, &scene.canvas);
    let rings: Vec<Ring> = shown.into_iter().map(|r| to_ring(&r)).collect();
    let parts = filled_parts(&rings, FillRule::NonZero);
    refuse_broken_contours(filled.iter().filter(|i| !i.cut).flat_map(|i| &i.contours), &parts)?;
    let parts = joined(parts, policy::TOUCH_DISTANCE * scene.diagonal);
    let Some(chosen) = parts.get(number.map_or(0, |n| n - 1)) else {
        return Err(match number {
            Some(number) if !parts.is_empty() => SvgError::NoSuchPart { part: number.to_string() },
            _ => OutlineError::NoArea.into(),
        });
    };
    if number.is_none()
        && part.is_none()
        && parts.len() > 1
        && ring_area(&parts[1]) > NOTED_SHARE * ring_area(chosen)
    {
        let (low, high) = geometry::bounds(&to_points(chosen));
        let what = format!(
            "the largest, {:.4} x {:.4} {} from ({:.4}, {:.4})",
            high.x - low.x,
            high.y - low.y,
            scene.unit.name,
            low.x,
            low.y
        );
        notes.push(Note::Taken { what, others: parts.len() - 1 });
    }
    let mut points = to_points(chosen);
    notes.extend(bridges(&filled, &points));
    if points.len() > policy::OUTLINE_VERTICES_KEPT {
        points = simplify(&points, scene.step);
    }
    let outline = simple(points)?;
    let inner = inner::of(&scene, outline.points());
    Ok(Drawing { outline, inner, notes })
}

/// Share of the largest shape from which on a second one is spoken of.
const NOTED_SHARE: f64 = 0.2;
/// Share of the drawing from which on the line that closes a filled path is spoken of.
const NOTED_BRIDGE: f64 = 0.01;

/// The widest of the straight lines by which viewers close open paths, if the shape shows it.
fn bridges(filled: &[&Item], shape: &[Point]) -> Option<Note> {
    let (low, high) = geometry::bounds(shape);
    let size = (high - low).norm();
    let bridged = filled.iter().flat_map(|i| &i.contours).filter_map(|c| c.bridged);
    let visible = bridged.filter(|(a, b)| {
        let middle = nalgebra::center(a, b);
        let near = |(p, q): (&Point, &Point)| distance(middle, *p, *q) < 1e-6 * size;
        (b - a).norm() > NOTED_BRIDGE * size
            && shape.iter().zip(shape.iter().cycle().skip(1)).any(near)
    });
    let widest = visible.max_by(|a, b| (a.1 - a.0).norm().total_cmp(&(b.1 - b.0).norm()));
    widest.map(|(from, to)| Note::ClosedByLine { from, to })
}

fn distance(p: Point, a: Point, b: Point) -> f64 {
    let along = b - a;
    let t = ((p - a).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (a + along * t - p).norm()
}

/// A drawing of lines alone.
fn lines_as_shape(scene: &Scene, join: Option<f64>) -> Result<Drawing, SvgError> {
    let mut contours = lines(scene, scene.items.iter(), join)?;
    let source = Source { path: "", part: None };
    let chosen = choose::shape(&mut contours, source).map_err(|error| SvgError::Lines {
        reason: error.to_string().trim_start_matches(": ").to_owned(),
    })?;
    let outline = simple(chosen.outer.points)?;
    let inner = inner::of(scene, outline.points());
    Ok(Drawing { outline, inner, notes: contours.notes })
}

/// The lines of items, joined where their ends meet.
fn lines<'a>(
    scene: &Scene,
    items: impl Iterator<Item = &'a Item>,
    join: Option<f64>,
) -> Result<Contours, SvgError> {
    let list = items.flat_map(|i| i.contours.iter().cloned()).collect();
    let tolerance = join::tolerance(join, scene.diagonal, scene.unit.mm);
    let (list, joints) =
        join::joined(list, scene.diagonal, tolerance).ok_or(OutlineError::TooIntricate)?;
    let mut notes = Vec::new();
    if joints.places > 0 {
        let join::Joints { places, widest, tolerance } = joints;
        notes.push(Note::Joined { places, widest, tolerance });
    }
    Ok(Contours { list, unit: scene.unit, notes, ..Contours::default() })
}

/// The contours of a finished gear: every visible path by its middle line; filled paths that overlap are united.
///
/// # Errors
/// See [`SvgError`].
pub(super) fn contours(
    bytes: &[u8],
    source: Source<'_>,
    side: Option<Side>,
    join: Option<f64>,
) -> Result<Contours, SvgError> {
    let text = decoded(bytes).ok_or(SvgError::NotText)?;
    let wanted = source.part.or(side.map(Side::name));
    let scene = Scene::read(&text, policy::TOOTHED_CHORD, wanted)?;
    let filled: Vec<&Item> =
        scene.items.iter().filter(|i| i.paint.is_some_and(|p| !p.is_white())).collect();
    let all: Vec<&[Point]> =
        filled.iter().flat_map(|i| &i.contours).map(|c| c.points.as_slice()).collect();
    let overlap = filled.len() > 1 && filled.len() < OVERLAPS && count_crossings(&all)? > 0;
    let mut made = lines(&scene, scene.items.iter(), join)?;
    if overlap && !filled.iter().flat_map(|i| &i.contours).any(|c| Nature::of(c).is_toothed()) {
        // Parts that reach into each other make one contour, which is added to theirs: that of all is the largest.
        for (layer, region) in region::by_layer(&filled, &scene.canvas) {
            let rings = region.into_iter().map(|points| Contour {
                points,
                closed: true,
                layer: layer.clone(),
                ..Contour::default()
            });
            made.list.extend(rings);
        }
    }
    Ok(made)
}

/// Filled paths beyond which overlaps are not looked for: that many are no gear.
const OVERLAPS: usize = 5000;

/// Refuses shapes whose own coordinates, before transforms, are too small for the reader's arcs.
fn refuse_tiny(paths: &[&usvg::Path]) -> Result<(), SvgError> {
    let sides = paths.iter().map(|p| p.data().bounds());
    let size = sides.map(|b| f64::from(b.width().max(b.height()))).fold(0.0, f64::max);
    let least = policy::SVG_LEAST_SIZE;
    // Without any extent they enclose no area, which is said elsewhere.
    if size > 0.0 && size < least { Err(SvgError::Tiny { size, least }) } else { Ok(()) }
}

/// A contour that falls apart into loops must not lose more than a repair may.
fn refuse_broken_contours<'a>(
    contours: impl Iterator<Item = &'a Contour>,
    parts: &[Ring],
) -> Result<(), SvgError> {
    if parts.len() < 2 {
        return Ok(());
    }
    for contour in contours.filter(|c| c.closed) {
        let Some(at) = geometry::first_self_crossing(&contour.points) else {
            continue;
        };
        let loops = filled_parts(&[to_ring(&contour.points)], FillRule::NonZero);
        let total: f64 = loops.iter().map(ring_area).sum();
        let largest = loops.first().map_or(0.0, ring_area);
        let matters = total > (1.0 - policy::REPAIR_AREA_KEPT) * ring_area(&parts[0]);
        if matters && largest < policy::REPAIR_AREA_KEPT * total {
            return Err(OutlineError::SelfCrossing { x: at.x, y: at.y }.into());
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
