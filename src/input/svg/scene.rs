//! The visible paths of an SVG drawing, in its own units with y upwards.

use super::region::{self, Region};
use super::{SvgError, guard, refuse_tiny};
use crate::gear::Side;
use crate::geometry::{self, Point};
use crate::input::contours::{Contour, Unit};
use crate::input::nature::Nature;
use crate::outline::{OutlineError, check_coordinates};
use crate::policy;
use crate::wording::quoted;
use nalgebra::Matrix3;
use usvg::roxmltree::Document;
use usvg::tiny_skia_path::PathSegment;

/// Colour of paint, red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Paint(pub(super) [u8; 3]);

impl Paint {
    /// The colour of paper, or nearly.
    pub(super) fn is_white(self) -> bool {
        self.0.iter().all(|c| *c >= WHITE)
    }

    pub(super) fn is_near(self, other: Self) -> bool {
        self.0.iter().zip(other.0).all(|(a, b)| a.abs_diff(b) <= 8)
    }

    fn luminance(self) -> f64 {
        let [r, g, b] = self.0.map(f64::from);
        (0.2126 * r + 0.7152 * g + 0.0722 * b) / 255.0
    }
}

/// Least value of each component of what passes for white.
const WHITE: u8 = 245;
/// Largest coordinate of a path, over the diagonal of the drawing: single precision leaves 1e-4 of the drawing there.
const FAR: f64 = 2000.0;

/// One path, clipped as viewers show it.
#[derive(Clone, Debug)]
pub(super) struct Item {
    pub(super) contours: Vec<Contour>,
    pub(super) even_odd: bool,
    /// The colour of its area; none for lines.
    pub(super) paint: Option<Paint>,
    /// The colour of its area as it is drawn, also where that is white within a line.
    pub(super) fill: Option<Paint>,
    /// Its line as it is drawn, with its width in the drawing's units.
    pub(super) line: Option<Line>,
    /// White within a line of another colour.
    bordered: bool,
    /// Whether a clip path or mask took something away.
    pub(super) cut: bool,
    pub(super) in_part: bool,
}

/// A line that is drawn.
#[derive(Clone, Debug)]
pub(super) struct Line {
    pub(super) paint: Paint,
    pub(super) width: f64,
    pub(super) area: Region,
}

/// A drawing.
#[derive(Clone, Debug)]
pub(super) struct Scene {
    /// From the lowest to the topmost.
    pub(super) items: Vec<Item>,
    /// The page.
    pub(super) canvas: Vec<Point>,
    pub(super) diagonal: f64,
    /// Greatest distance of a chord from its curve.
    pub(super) step: f64,
    pub(super) unit: Unit,
    /// Whether an element is called as the part that was named.
    pub(super) has_part: bool,
}

/// An affine map of the plane.
type Map = Matrix3<f64>;

fn map_of(t: usvg::Transform) -> Map {
    let [sx, ky, kx, sy, tx, ty] = [t.sx, t.ky, t.kx, t.sy, t.tx, t.ty].map(f64::from);
    Map::new(sx, kx, tx, ky, sy, ty, 0.0, 0.0, 1.0)
}

fn mapped(map: &Map, x: f32, y: f32) -> Point {
    map.transform_point(&Point::new(f64::from(x), f64::from(y)))
}

/// A path before it is flattened.
struct Found<'a> {
    path: &'a usvg::Path,
    map: Map,
    clips: Vec<usize>,
    layer: String,
    in_part: bool,
}

/// What is known of the groups above.
#[derive(Clone)]
struct Above<'a> {
    map: Map,
    clips: Vec<usize>,
    layer: String,
    in_part: bool,
    wanted: Option<&'a str>,
}

struct Walk<'a> {
    found: Vec<Found<'a>>,
    /// Clip paths and masks with their maps.
    clips: Vec<(Cover<'a>, Map)>,
}

#[derive(Clone, Copy)]
enum Cover<'a> {
    Clip(&'a usvg::ClipPath),
    Mask(&'a usvg::Mask),
}

impl Scene {
    /// Reads what is visible. `tolerance` bounds the distance of chords from curves, relative to the diagonal of the drawing;
    /// `part` is the id or label of a group or path that may be wanted.
    ///
    /// # Errors
    /// See [`SvgError`].
    pub(super) fn read(text: &str, tolerance: f64, part: Option<&str>) -> Result<Self, SvgError> {
        let document = guard::checked(text)?;
        let options = usvg::Options {
            style_sheet: Some(guard::style(&document)),
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
        let (page, unit, canvas) = page(&document, &tree);
        let id = part.map(|p| labelled(&document, p).unwrap_or(p));
        let mut walk = Walk { found: Vec::new(), clips: Vec::new() };
        let top = Above {
            map: page,
            clips: Vec::new(),
            layer: String::new(),
            in_part: false,
            wanted: id,
        };
        walk.group(tree.root(), &top);
        if walk.found.is_empty() {
            return Err(guard::why_nothing_is_filled(&document));
        }
        let has_part = walk.found.iter().any(|f| f.in_part);
        let corners: Vec<Point> = walk
            .found
            .iter()
            .flat_map(|f| {
                let b = f.path.data().bounds();
                let xs = [b.left(), b.right()];
                xs.into_iter()
                    .flat_map(move |x| [b.top(), b.bottom()].map(|y| mapped(&f.map, x, y)))
            })
            .collect();
        check_coordinates(&corners)?;
        refuse_tiny(&walk.found.iter().map(|f| f.path).collect::<Vec<_>>())?;
        let (low, high) = geometry::bounds(&corners);
        let diagonal = (high - low).norm();
        if diagonal < policy::OUTLINE_RANGE.0 {
            return Err(OutlineError::NoArea.into());
        }
        refuse_far(&walk.found, diagonal)?;
        let step = tolerance * diagonal;
        let covers: Vec<Region> = walk
            .clips
            .iter()
            .map(|(cover, map)| match cover {
                Cover::Clip(clip) => clip_region(clip, map, step, 0),
                Cover::Mask(mask) => mask_region(mask, map, step, 0),
            })
            .collect();
        let mut vertices = 0;
        let mut items = Vec::with_capacity(walk.found.len());
        for found in &walk.found {
            let item = item(found, step, &covers);
            vertices += item.contours.iter().map(|c| c.points.len()).sum::<usize>();
            if vertices > policy::OUTLINE_VERTICES {
                return Err(OutlineError::TooIntricate.into());
            }
            items.push(item);
        }
        no_frames(&mut items);
        Ok(Self { items, canvas, diagonal, step, unit, has_part })
    }
}

impl<'a> Walk<'a> {
    fn group(&mut self, group: &'a usvg::Group, above: &Above<'_>) {
        let mut here = above.clone();
        here.map *= map_of(group.transform());
        if let Some(clip) = group.clip_path() {
            here.clips.push(self.clips.len());
            self.clips.push((Cover::Clip(clip), here.map));
        }
        if let Some(mask) = group.mask() {
            here.clips.push(self.clips.len());
            self.clips.push((Cover::Mask(mask), here.map));
        }
        here.name(group.id());
        for node in group.children() {
            match node {
                usvg::Node::Group(inner) if inner.opacity().get() > 0.0 => self.group(inner, &here),
                usvg::Node::Path(path)
                    if path.is_visible() && (fill(path).is_some() || stroke(path).is_some()) =>
                {
                    let mut own = here.clone();
                    own.name(path.id());
                    self.found.push(Found {
                        path,
                        map: here.map,
                        clips: own.clips,
                        layer: own.layer,
                        in_part: own.in_part,
                    });
                }
                _ => {}
            }
        }
    }
}

impl Above<'_> {
    /// Goes on into an element of this id: parts and gears keep their names for all in them.
    fn name(&mut self, id: &str) {
        let is =
            |name: &str| id.strip_prefix(name).is_some_and(|r| r.is_empty() || r.starts_with('-'));
        if self.in_part || id.is_empty() {
            return;
        }
        if self.wanted.is_some_and(is) {
            self.in_part = true;
            id.clone_into(&mut self.layer);
        } else if !Side::BOTH.iter().any(|s| self.layer.starts_with(s.name())) {
            id.clone_into(&mut self.layer);
        }
    }
}

fn colour(paint: &usvg::Paint) -> Paint {
    let of = |stops: &[usvg::Stop]| {
        let count = stops.len().max(1) as u32;
        let mean = |pick: fn(usvg::Color) -> u8| {
            (stops.iter().map(|s| u32::from(pick(s.color()))).sum::<u32>() / count) as u8
        };
        Paint([mean(|c| c.red), mean(|c| c.green), mean(|c| c.blue)])
    };
    match paint {
        usvg::Paint::Color(c) => Paint([c.red, c.green, c.blue]),
        usvg::Paint::LinearGradient(g) => of(g.stops()),
        usvg::Paint::RadialGradient(g) => of(g.stops()),
        usvg::Paint::Pattern(_) => Paint([0, 0, 0]),
    }
}

fn fill(path: &usvg::Path) -> Option<Paint> {
    path.fill().filter(|f| f.opacity().get() > 0.0).map(|f| colour(f.paint()))
}

fn stroke(path: &usvg::Path) -> Option<Paint> {
    path.stroke().filter(|s| s.opacity().get() > 0.0).map(|s| colour(s.paint()))
}

fn item(found: &Found<'_>, step: f64, covers: &[Region]) -> Item {
    let path = found.path;
    // White with a line about it is drawn to be seen.
    let line = stroke(path).filter(|s| fill(path).is_some_and(Paint::is_white) && !s.is_white());
    let paint = fill(path).map(|fill| line.unwrap_or(fill));
    let dashed = path.stroke().is_some_and(|s| s.dasharray().is_some()) && paint.is_none();
    let mut contours: Vec<Contour> = flatten(path, &found.map, step);
    for contour in &mut contours {
        contour.layer.clone_from(&found.layer);
        contour.dashed = dashed;
        if paint.is_some() && !contour.closed && contour.points.len() > 2 {
            contour.bridged = contour.points.first().copied().zip(contour.points.last().copied());
            contour.closed = true;
        }
    }
    let even_odd = path.fill().is_some_and(|f| f.rule() == usvg::FillRule::EvenOdd);
    let mut item = Item {
        contours,
        even_odd,
        paint,
        fill: fill(path),
        line: drawn_line(found, step, covers),
        bordered: line.is_some(),
        cut: false,
        in_part: found.in_part,
    };
    for cover in found.clips.iter().map(|clip| &covers[*clip]) {
        let whole = item.contours.iter().all(|c| region::holds(cover, &c.points));
        if !whole && paint.is_some() {
            let rings = region::common(&region::of(&item), cover);
            let closed = |points| Contour {
                points,
                closed: true,
                layer: found.layer.clone(),
                ..Contour::default()
            };
            item.contours = rings.into_iter().map(closed).collect();
            item.even_odd = false;
            item.cut = true;
        }
    }
    item
}

/// What the line of a path covers, clipped.
fn drawn_line(found: &Found<'_>, step: f64, covers: &[Region]) -> Option<Line> {
    let (paint, path) = (stroke(found.path)?, found.path.data());
    let stroke = found.path.stroke()?.to_tiny_skia();
    let scale = found.map.fixed_view::<2, 2>(0, 0).determinant().abs().sqrt();
    // As exact as the curves are: the stroker keeps a quarter of a pixel, of which there are so many to a unit.
    let fine = ((0.25 * scale / step) as f32).clamp(1e-3, 1e6);
    let dashed = stroke.dash.as_ref().and_then(|dash| path.dash(dash, fine));
    let outlined = dashed.as_ref().unwrap_or(path).stroke(&stroke, fine)?;
    let rings: Vec<Vec<Point>> =
        flattened(&outlined, &found.map, step).into_iter().map(|c| c.points).collect();
    let whole = region::filled(&rings, false);
    let area = found.clips.iter().fold(whole, |area, clip| region::common(&area, &covers[*clip]));
    Some(Line { paint, width: scale * f64::from(stroke.width), area })
}

/// Sheets with a border about the drawing are ground.
fn no_frames(items: &mut [Item]) {
    for i in 0..items.len() {
        let [contour] = &items[i].contours[..] else { continue };
        if !items[i].bordered || items.len() > 1000 || Nature::of(contour) != Nature::Box {
            continue;
        }
        let inside = |other: &Item| {
            other.paint.is_some()
                && other.contours.iter().any(|c| {
                    contour.encloses(c)
                        && c.extent() > 0.1 * contour.extent()
                        && c.extent() < 0.999 * contour.extent()
                })
        };
        if items[i + 1..].iter().any(inside) {
            items[i].paint = Some(Paint([255; 3]));
        }
    }
}

fn refuse_far(found: &[Found<'_>], diagonal: f64) -> Result<(), SvgError> {
    for f in found {
        let b = f.path.data().bounds();
        let reach = [b.left(), b.right(), b.top(), b.bottom()];
        let reach = reach.into_iter().map(|c| f64::from(c.abs())).fold(0.0, f64::max);
        let scale = f.map.fixed_view::<2, 2>(0, 0).determinant().abs().sqrt();
        if reach * scale > FAR * diagonal {
            return Err(SvgError::FarAway { distance: reach * scale, size: diagonal });
        }
    }
    Ok(())
}

/// The element that a program shows under this name.
fn labelled<'a>(document: &'a Document<'_>, label: &str) -> Option<&'a str> {
    let named = |n: &usvg::roxmltree::Node<'_, '_>| {
        n.attributes().any(|a| a.name() == "label" && a.value() == label)
    };
    document.descendants().find(named).and_then(|n| n.attribute("id"))
}

/// From the reader's canvas to the drawing's own units, these units, and the page in them.
///
/// Own units are those of a width or height such as `210mm`, else those of the view box. The page is turned over about its
/// middle line, so that y runs upwards from its lower edge.
fn page(document: &Document<'_>, tree: &usvg::Tree) -> (Map, Unit, Vec<Point>) {
    let root = document.root_element();
    let (width, height) = (f64::from(tree.size().width()), f64::from(tree.size().height()));
    let view: Vec<f64> = root
        .attribute("viewBox")
        .unwrap_or_default()
        .split(|c: char| c == ',' || c.is_whitespace())
        .filter_map(|f| f.parse().ok())
        .collect();
    let [left, top, wide, high] = match view[..] {
        [x, y, w, h] if w > 0.0 && h > 0.0 => [x, y, w, h],
        _ => [0.0, 0.0, width, height],
    };
    let stretched =
        root.attribute("preserveAspectRatio").is_some_and(|p| p.trim().starts_with("none"));
    // Canvas units to one of the view box.
    let scale = if stretched { width / wide } else { (width / wide).min(height / high) };
    let (shift_x, shift_y) = (0.5 * (width - scale * wide), 0.5 * (height - scale * high));
    let physical = ["width", "height"].into_iter().find_map(|name| {
        let value = root.attribute(name)?.trim();
        PHYSICAL
            .iter()
            .find(|(suffix, ..)| value.ends_with(suffix))
            .map(|(_, name, mm)| (*name, *mm))
    });
    let (unit, own) = match physical {
        Some((name, mm)) => (Unit { name, mm }, scale * CANVAS_UNIT / mm),
        None => (Unit { name: "units", mm: 1.0 }, 1.0),
    };
    let factor = own / scale;
    let bottom = 2.0 * top + high;
    let map = Map::new(
        factor,
        0.0,
        own * left - factor * shift_x,
        0.0,
        -factor,
        own * (bottom - top) + factor * shift_y,
        0.0,
        0.0,
        1.0,
    );
    let corners = [(0.0, height), (width, height), (width, 0.0), (0.0, 0.0)];
    let canvas = corners.map(|(x, y)| map.transform_point(&Point::new(x, y))).to_vec();
    (map, unit, canvas)
}

/// Millimetres in one unit of the canvas: 96 to the inch.
const CANVAS_UNIT: f64 = 25.4 / 96.0;

/// Suffixes of physical sizes, names of the units, and mm in one.
const PHYSICAL: [(&str, &str, f64); 6] = [
    ("mm", "mm", 1.0),
    ("cm", "cm", 10.0),
    ("in", "inch", 25.4),
    ("pt", "pt", 25.4 / 72.0),
    ("pc", "pc", 25.4 / 6.0),
    ("Q", "Q", 0.25),
];

/// What of the plane a clip path leaves.
fn clip_region(clip: &usvg::ClipPath, map: &Map, step: f64, depth: u32) -> Region {
    let map = map * map_of(clip.transform());
    let mut region = Vec::new();
    areas(clip.root(), &map, step, depth, &mut |area, _| region.extend(area));
    let region = region::filled(&region, false);
    match clip.clip_path() {
        Some(inner) if depth < CLIP_DEPTH => {
            let inner = clip_region(inner, &map, step, depth + 1);
            region::common(&region, &inner)
        }
        _ => region,
    }
}

/// What of the plane a mask leaves: where it is light, or opaque.
fn mask_region(mask: &usvg::Mask, map: &Map, step: f64, depth: u32) -> Region {
    let by_opacity = mask.kind() == usvg::MaskType::Alpha;
    let mut region: Region = Vec::new();
    areas(mask.root(), map, step, depth, &mut |area, light| {
        region = if by_opacity || light >= 0.5 {
            region::united(&region, &area)
        } else {
            region::without(&region, &area)
        };
    });
    let b = mask.rect();
    let rect = [
        (b.left(), b.top()),
        (b.right(), b.top()),
        (b.right(), b.bottom()),
        (b.left(), b.bottom()),
    ];
    let rect = vec![rect.map(|(x, y)| mapped(map, x, y)).to_vec()];
    let region = region::common(&region, &region::filled(&rect, false));
    match mask.mask() {
        Some(inner) if depth < CLIP_DEPTH => {
            region::common(&region, &mask_region(inner, map, step, depth + 1))
        }
        _ => region,
    }
}

/// Nested clip paths and masks that are followed.
const CLIP_DEPTH: u32 = 8;

/// The filled areas of a clip path or mask, each with its lightness.
fn areas(group: &usvg::Group, map: &Map, step: f64, depth: u32, take: &mut dyn FnMut(Region, f64)) {
    let map = map * map_of(group.transform());
    let cover = group
        .clip_path()
        .filter(|_| depth < CLIP_DEPTH)
        .map(|c| clip_region(c, &map, step, depth + 1));
    let mut inner = |area: Region, light: f64| match &cover {
        Some(cover) => take(region::common(&area, cover), light),
        None => take(area, light),
    };
    for node in group.children() {
        match node {
            usvg::Node::Group(group) => {
                let faint = f64::from(group.opacity().get());
                areas(group, &map, step, depth, &mut |area, light| inner(area, light * faint));
            }
            usvg::Node::Path(path) if path.is_visible() => {
                if let Some(paint) = fill(path) {
                    let opacity = path.fill().map_or(1.0, |f| f64::from(f.opacity().get()));
                    let even_odd = path.fill().is_some_and(|f| f.rule() == usvg::FillRule::EvenOdd);
                    let rings: Vec<Vec<Point>> =
                        flatten(path, &map, step).into_iter().map(|c| c.points).collect();
                    inner(region::filled(&rings, even_odd), paint.luminance() * opacity);
                }
            }
            _ => {}
        }
    }
}

/// The subpaths of a path, chords within `tolerance`, mapped.
fn flatten(path: &usvg::Path, map: &Map, tolerance: f64) -> Vec<Contour> {
    flattened(path.data(), map, tolerance)
}

fn flattened(path: &usvg::tiny_skia_path::Path, map: &Map, tolerance: f64) -> Vec<Contour> {
    let at = |p: usvg::tiny_skia_path::Point| mapped(map, p.x, p.y);
    let mut contours = Vec::new();
    let mut points: Vec<Point> = Vec::new();
    for segment in path.segments() {
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
    if points.len() < 2 {
        return;
    }
    let meets = points.len() > 3 && points.first() == points.last();
    if meets {
        points.pop();
    }
    let closed = closed || meets;
    contours.push(Contour { points, closed, ..Contour::default() });
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
