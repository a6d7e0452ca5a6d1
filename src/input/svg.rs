//! Outlines from SVG drawings: the largest filled shape, strokes and text ignored.

use super::svg_guard;
use crate::geometry::{self, Point};
use crate::outline::repair::{
    Ring, count_crossings, filled_parts, joined, ring_area, simple, to_points, to_ring,
};
use crate::outline::{Outline, OutlineError, check_coordinates, simplify};
use crate::policy;
use crate::wording::quoted;
use i_overlay::core::fill_rule::FillRule;
use usvg::tiny_skia_path::PathSegment;

/// Why an SVG drawing gives no outline.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SvgError {
    /// Not text in UTF-8.
    #[error("it is not UTF-8 text; save it as plain, uncompressed SVG")]
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
    /// Filled paths, but none is closed.
    #[error(
        "its path is open between ({start_x:.4}, {start_y:.4}) and ({end_x:.4}, {end_y:.4}); \
         close it there (end its data with Z, or make a polyline a polygon)"
    )]
    OpenPath {
        /// Where the largest open contour starts, in the units of the drawing, y downwards.
        start_x: f64,
        /// See `start_x`.
        start_y: f64,
        /// Where it ends.
        end_x: f64,
        /// See `end_x`.
        end_y: f64,
    },
    /// The contour does not make an outline; places are in the units of the drawing, y downwards.
    #[error(transparent)]
    Outline(#[from] OutlineError),
}

/// Reads the largest closed, filled shape of an SVG drawing.
///
/// Transforms, groups, styles and `use` are applied; strokes, text, images, markers, masks and
/// clip paths are ignored, as are what is wholly transparent and a rectangle, with corners rounded or not, that covers the
/// canvas beside other shapes.
/// Contours that overlap or touch (within [`policy::TOUCH_DISTANCE`]) are united, the component
/// with the largest area is kept and its holes are dropped. Contours that are not closed are
/// left out unless their ends nearly meet. Nothing outside the text is ever read.
///
/// `tolerance` bounds the distance between curves and their chords, relative to the diagonal
/// of the filled paths. The result is in user units of the drawing's canvas with y upwards.
///
/// # Errors
/// See [`SvgError`].
pub fn from_svg(text: &[u8], tolerance: f64) -> Result<Outline, SvgError> {
    let document = svg_guard::checked(text)?;
    let options = usvg::Options {
        style_sheet: Some(svg_guard::STYLE.to_owned()),
        image_href_resolver: usvg::ImageHrefResolver {
            resolve_data: Box::new(|_, _, _| None),
            resolve_string: Box::new(|_, _| None),
        },
        ..usvg::Options::default()
    };
    let tree = usvg::Tree::from_xmltree(&document, &options).map_err(|error| match error {
        usvg::Error::InvalidSize => SvgError::NoSize,
        usvg::Error::ElementsLimitReached => {
            SvgError::TooManyElements { limit: policy::SVG_ELEMENTS }
        }
        other => SvgError::NotXml { reason: quoted(&other.to_string()) },
    })?;
    let mut paths = Vec::new();
    collect_filled(tree.root(), &mut paths);
    if paths.is_empty() {
        return Err(svg_guard::why_nothing_is_filled(&document));
    }
    let canvas = Point::new(f64::from(tree.size().width()), f64::from(tree.size().height()));
    outline_of(&paths, canvas, tolerance)
}

fn collect_filled<'a>(group: &'a usvg::Group, paths: &mut Vec<&'a usvg::Path>) {
    for node in group.children() {
        match node {
            usvg::Node::Group(inner) if inner.opacity().get() > 0.0 => collect_filled(inner, paths),
            usvg::Node::Path(path) => {
                let painted = path.fill().is_some_and(|fill| fill.opacity().get() > 0.0);
                if path.is_visible() && painted {
                    paths.push(path);
                }
            }
            _ => {}
        }
    }
}

/// One subpath, flattened; y still downwards.
pub(super) struct Contour {
    pub(super) points: Vec<Point>,
    pub(super) closed: bool,
}

fn outline_of(paths: &[&usvg::Path], canvas: Point, tolerance: f64) -> Result<Outline, SvgError> {
    let corners: Vec<Point> = paths
        .iter()
        .flat_map(|p| {
            let b = p.abs_bounding_box();
            [(b.left(), b.top()), (b.right(), b.bottom())]
        })
        .map(|(x, y)| Point::new(f64::from(x), f64::from(y)))
        .collect();
    check_coordinates(&corners)?;
    refuse_tiny(paths)?;
    let (low, high) = geometry::bounds(&corners);
    let diagonal = (high - low).norm();
    if diagonal < policy::OUTLINE_RANGE.0 {
        return Err(OutlineError::NoArea.into());
    }
    let step = tolerance.clamp(1e-6, 0.1) * diagonal;

    let mut vertices = 0;
    let mut flattened = Vec::with_capacity(paths.len());
    for path in paths {
        let contours = flatten(path, step);
        vertices += contours.iter().map(|c| c.points.len()).sum::<usize>();
        if vertices > policy::OUTLINE_VERTICES {
            return Err(OutlineError::TooIntricate.into());
        }
        flattened.push((path, contours));
    }
    let backgrounds = |c: &[Contour]| c.len() == 1 && covers(&c[0].points, canvas);
    let mut shown: Vec<_> = flattened.iter().filter(|(_, c)| !backgrounds(c)).collect();
    if shown.is_empty() {
        shown = flattened.iter().collect();
    }

    let all: Vec<&[Point]> =
        shown.iter().flat_map(|(_, c)| c).map(|c| c.points.as_slice()).collect();
    count_crossings(&all)?;
    let mut filled = Vec::new();
    for (path, contours) in &shown {
        let rule = match path.fill().map(usvg::Fill::rule) {
            Some(usvg::FillRule::EvenOdd) => FillRule::EvenOdd,
            _ => FillRule::NonZero,
        };
        let closed: Vec<Ring> =
            contours.iter().filter(|c| c.closed).map(|c| to_ring(&c.points)).collect();
        filled.extend(filled_parts(&closed, rule));
    }
    let parts = filled_parts(&filled, FillRule::NonZero);
    refuse_broken_contours(shown.iter().flat_map(|(_, c)| c), &parts)?;
    let parts = joined(parts, policy::TOUCH_DISTANCE * diagonal);
    let Some(largest) = parts.first() else {
        return Err(nothing_closed(shown.iter().flat_map(|(_, c)| c)));
    };
    let mut points = to_points(largest);
    if points.len() > policy::OUTLINE_VERTICES_KEPT {
        points = simplify(&points, step);
    }
    let upwards = points.into_iter().map(|p| Point::new(p.x, canvas.y - p.y)).collect();
    Ok(simple(upwards)?)
}

/// Refuses shapes whose own coordinates, before transforms, are too small for the reader's arcs.
pub(super) fn refuse_tiny(paths: &[&usvg::Path]) -> Result<(), SvgError> {
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

fn nothing_closed<'a>(contours: impl Iterator<Item = &'a Contour>) -> SvgError {
    let open = contours.filter(|c| !c.closed && c.points.len() > 1);
    let longest = open
        .max_by(|a, b| geometry::perimeter(&a.points).total_cmp(&geometry::perimeter(&b.points)));
    match longest.and_then(|c| Some((c.points.first()?, c.points.last()?))) {
        Some((start, end)) => {
            SvgError::OpenPath { start_x: start.x, start_y: start.y, end_x: end.x, end_y: end.y }
        }
        None => OutlineError::NoArea.into(),
    }
}

/// Whether the contour is an upright rectangle over the whole canvas, but for its corners.
fn covers(points: &[Point], canvas: Point) -> bool {
    let (low, high) = geometry::bounds(points);
    let box_area = (high.x - low.x) * (high.y - low.y);
    let slack = policy::BACKGROUND_SLACK * canvas.coords;
    geometry::area(points) > policy::BACKGROUND_SHARE * box_area
        && low.x <= slack.x
        && low.y <= slack.y
        && high.x >= canvas.x - slack.x
        && high.y >= canvas.y - slack.y
}

/// The subpaths of a path, chords within `tolerance`, in the units of the canvas.
pub(super) fn flatten(path: &usvg::Path, tolerance: f64) -> Vec<Contour> {
    let map = path.abs_transform();
    let at = |p: usvg::tiny_skia_path::Point| {
        let mut p = p;
        map.map_point(&mut p);
        Point::new(f64::from(p.x), f64::from(p.y))
    };
    let mut contours = Vec::new();
    let mut points: Vec<Point> = Vec::new();
    for segment in path.data().segments() {
        match segment {
            PathSegment::MoveTo(p) => {
                push_contour(&mut contours, std::mem::take(&mut points), false);
                points.push(at(p));
            }
            PathSegment::LineTo(p) => points.push(at(p)),
            PathSegment::QuadTo(b, c) => {
                let a = points.last().copied().unwrap_or(at(b));
                let (b, c) = (at(b), at(c));
                let control = [a, a + (b - a) * (2.0 / 3.0), c + (b - c) * (2.0 / 3.0), c];
                flatten_cubic(control, tolerance, &mut points);
            }
            PathSegment::CubicTo(b, c, d) => {
                let a = points.last().copied().unwrap_or(at(b));
                flatten_cubic([a, at(b), at(c), at(d)], tolerance, &mut points);
            }
            PathSegment::Close => {
                let start = points.first().copied();
                push_contour(&mut contours, std::mem::take(&mut points), true);
                points.extend(start);
            }
        }
    }
    push_contour(&mut contours, points, false);
    contours
}

fn push_contour(contours: &mut Vec<Contour>, mut points: Vec<Point>, closed: bool) {
    points.dedup();
    let gap = match (points.first(), points.last()) {
        (Some(first), Some(last)) if points.len() > 2 => (last - first).norm(),
        _ => return,
    };
    let length = geometry::perimeter(&points) - gap;
    let closed = closed || gap <= policy::OPEN_PATH_GAP * length;
    if points.first() == points.last() {
        points.pop();
    }
    contours.push(Contour { points, closed });
}

/// Appends a cubic Bezier curve without its start, chords within `tolerance`.
///
/// With d the largest second difference of the control points, n even steps leave at most
/// 6 d / (8 n^2) between curve and chord.
fn flatten_cubic(control: [Point; 4], tolerance: f64, points: &mut Vec<Point>) {
    let [a, b, c, d] = control;
    let bend = ((a - b) + (c - b)).norm().max(((b - c) + (d - c)).norm());
    let steps = (0.75 * bend / tolerance).sqrt().ceil().clamp(1.0, 4096.0) as usize;
    for i in 1..steps {
        let t = i as f64 / steps as f64;
        let s = 1.0 - t;
        let (wa, wb, wc, wd) = (s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t);
        points.push(Point::from(wa * a.coords + wb * b.coords + wc * c.coords + wd * d.coords));
    }
    points.push(d);
}

#[cfg(test)]
#[path = "svg_tests.rs"]
mod tests;
