//! Contours of SVG drawings, filled or only stroked, at their true size.

use super::super::svg::{flatten, refuse_tiny};
use super::super::{SvgError, svg_guard};
use super::{Asked, Ring, ToothedError};
use crate::gear::Side;
use crate::geometry::Point;
use crate::outline::OutlineError;
use crate::policy;
use crate::wording::quoted;

/// Every path counts by its middle line, whatever its paint.
const STYLE: &str = "\
    * { marker: none !important; mask: none !important; filter: none !important; \
        clip-path: none !important; stroke: none !important; fill: black !important } \
    pattern use { display: none !important }";

/// Millimetres in one unit of a canvas with a physical size: 96 units to the inch.
const CANVAS_UNIT: f64 = 25.4 / 96.0;

pub(super) fn rings(bytes: &[u8], asked: &Asked<'_>) -> Result<Vec<Ring>, ToothedError> {
    let failed = |error| ToothedError::Svg { path: asked.path(), error };
    let document = svg_guard::checked(bytes).map_err(failed)?;
    let options = usvg::Options {
        style_sheet: Some(STYLE.to_owned()),
        image_href_resolver: usvg::ImageHrefResolver {
            resolve_data: Box::new(|_, _, _| None),
            resolve_string: Box::new(|_, _| None),
        },
        ..usvg::Options::default()
    };
    let tree = usvg::Tree::from_xmltree(&document, &options).map_err(|error| {
        failed(match error {
            usvg::Error::InvalidSize => SvgError::NoSize,
            other => SvgError::NotXml { reason: quoted(&other.to_string()) },
        })
    })?;
    let scale = scale(document.root_element(), f64::from(tree.size().width()));
    let height = f64::from(tree.size().height());
    let mut paths = Vec::new();
    collect(tree.root(), wanted_gear(&document, asked)?, &mut paths);
    refuse_tiny(&paths).map_err(failed)?;
    let corners: Vec<Point> = paths
        .iter()
        .map(|p| p.abs_bounding_box())
        .flat_map(|b| [(b.left(), b.top()), (b.right(), b.bottom())])
        .map(|(x, y)| Point::new(f64::from(x), f64::from(y)))
        .collect();
    let (low, high) = crate::geometry::bounds(&corners);
    let step = policy::TOOTHED_CHORD * (high - low).norm();
    let mut rings = Vec::new();
    let mut vertices = 0;
    for path in paths {
        for contour in flatten(path, step) {
            vertices += contour.points.len();
            if vertices > policy::TOOTHED_VERTICES {
                return Err(failed(OutlineError::TooIntricate.into()));
            }
            let upwards = |p: &Point| Point::new(scale * p.x, scale * (height - p.y));
            let points = contour.points.iter().map(upwards).collect();
            rings.push(Ring { points, closed: contour.closed });
        }
    }
    Ok(rings)
}

/// The gear that is asked for, where groups are named after gears, as in `laser.svg`; none where all is one gear.
fn wanted_gear<'a>(
    document: &usvg::roxmltree::Document<'_>,
    asked: &Asked<'a>,
) -> Result<Option<&'a str>, ToothedError> {
    let exists = |gear: &str| {
        let mut groups = document.descendants().filter(|n| n.tag_name().name() == "g");
        groups.any(|n| n.attribute("id").is_some_and(|id| belongs(id, gear)))
    };
    let both = || Side::BOTH.iter().all(|side| exists(side.name()));
    match asked.part {
        Some(part) if !exists(part) => Err(asked.no_such_part(part)),
        Some(part) => Ok(Some(part)),
        None => Ok(Some(asked.side.name()).filter(|_| both())),
    }
}

/// Whether a group called `id` is the gear or a layer of it, such as `driver-cut-outlines` of `driver`.
fn belongs(id: &str, gear: &str) -> bool {
    id.strip_prefix(gear).is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
}

/// The visible paths, of the wanted gear alone if there is one.
fn collect<'a>(group: &'a usvg::Group, wanted: Option<&str>, paths: &mut Vec<&'a usvg::Path>) {
    for node in group.children() {
        match node {
            usvg::Node::Group(inner) => {
                collect(inner, wanted.filter(|gear| !belongs(inner.id(), gear)), paths);
            }
            usvg::Node::Path(path) if path.is_visible() && wanted.is_none() => paths.push(path),
            _ => {}
        }
    }
}

/// Millimetres in a unit of the canvas: by the physical size, else a unit of the view box is 1 mm.
fn scale(root: usvg::roxmltree::Node<'_, '_>, canvas_width: f64) -> f64 {
    let physical = |name| {
        let value = root.attribute(name).unwrap_or_default().trim();
        ["mm", "cm", "in", "pt", "pc", "Q"].iter().any(|unit| value.ends_with(unit))
    };
    if physical("width") || physical("height") {
        return CANVAS_UNIT;
    }
    let view = root.attribute("viewBox").and_then(|v| {
        let numbers = v.split([',', ' ', '\t', '\n']).filter(|f| !f.is_empty());
        numbers.map(str::parse::<f64>).nth(2)?.ok()
    });
    match view {
        Some(width) if width > 0.0 && canvas_width > 0.0 => width / canvas_width,
        _ => 1.0,
    }
}
