//! Outlines of finished gears, read exactly as they are: no smoothing, no repair. From SVG, DXF,
//! points as CSV or JSON, a `design.json`, or a slice of STL or OBJ at half its thickness.

mod chain;
mod drawing;
mod dxf;
mod json;
mod slice;
mod spline;

use super::drawing::{bounded, read_file};
use super::{LoadError, PointsError, SvgError, points};
use crate::gear::Side;
use crate::geometry::curves::without_barbs;
use crate::geometry::{self, Point};
use crate::outline::{Outline, OutlineError, check_coordinates, simplify};
use crate::policy;
use std::path::Path;

/// A finished gear, mm, y upwards, in the frame of its file.
#[derive(Clone, Debug, PartialEq)]
pub struct Toothed {
    /// The outer boundary.
    pub outline: Outline,
    /// Its holes, each counter-clockwise, the largest first; of very many the widest [`policy::TOOTHED_HOLES`].
    pub holes: Vec<Outline>,
    /// How the boundary was thinned, if it had too many vertices or crossed itself by a hair.
    pub thinned: Option<Thinned>,
    /// What a `design.json` tells of the pair; its gears have their axes at the origin.
    pub record: Option<PairRecord>,
}

/// How a boundary was thinned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thinned {
    /// Vertices in the file.
    pub from: usize,
    /// Vertices kept.
    pub to: usize,
    /// Distance within which every vertex left out lies from what is left, mm.
    pub tolerance: f64,
}

/// What a `design.json` tells of a pair.
#[derive(Clone, Debug, PartialEq)]
pub struct PairRecord {
    /// The file.
    pub path: String,
    /// Distance of the axes, mm.
    pub center_distance: f64,
    /// Teeth of driver and follower, on one turn each.
    pub teeth: Option<[u32; 2]>,
    /// Driver angles of one whole cycle, radians.
    pub driver_angle: Vec<f64>,
    /// Follower angles (psi) at these, radians.
    pub follower_angle: Vec<f64>,
}

/// Why a file gives no gear. Every message is one sentence with the file and the remedy.
#[derive(Debug, thiserror::Error)]
pub enum ToothedError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] LoadError),
    /// A mistake in an SVG drawing.
    #[error("{path}: {error}")]
    Svg {
        /// The path as given.
        path: String,
        /// What is wrong.
        error: SvgError,
    },
    /// A mistake in a list of points.
    #[error("{path}: {error}")]
    Points {
        /// The path as given.
        path: String,
        /// What is wrong.
        error: PointsError,
    },
    /// A DXF drawing or a mesh that cannot be read.
    #[error("{path}: it is no {format} that can be read ({reason}); save it again")]
    Malformed {
        /// The path as given.
        path: String,
        /// `DXF`, `STL` or `OBJ`.
        format: &'static str,
        /// What the reader says.
        reason: String,
    },
    /// What is none of the formats.
    #[error("{path}: this is no outline of a gear; give SVG, DXF, CSV, JSON, STL or OBJ")]
    Unrecognised {
        /// The path as given.
        path: String,
    },
    /// The part after `#` is not in the file.
    #[error("{path}: it has no part `{part}`; name one that it has, or leave `#{part}` out")]
    NoSuchPart {
        /// The path as given.
        path: String,
        /// What was asked for.
        part: String,
    },
    /// Nothing closed in the file.
    #[error("{path}: it holds no closed contour; draw the gear as one closed line")]
    NoContour {
        /// The path as given.
        path: String,
    },
    /// The largest contour is open.
    #[error(
        "{path}: the outline is open by {gap:.4} mm between ({from_x:.4}, {from_y:.4}) and ({to_x:.4}, {to_y:.4}); close it there"
    )]
    Open {
        /// The path as given.
        path: String,
        /// Distance of the ends, mm.
        gap: f64,
        /// One end, mm.
        from_x: f64,
        /// One end, mm.
        from_y: f64,
        /// The other end, mm.
        to_x: f64,
        /// The other end, mm.
        to_y: f64,
    },
    /// A mesh that is not closed at half its thickness.
    #[error("{path}: the mesh is not closed at half its thickness; repair it")]
    OpenMesh {
        /// The path as given.
        path: String,
    },
    /// A vertex of a mesh that is not finite or too far away.
    #[error(
        "{path}: a vertex of the mesh lies at ({x:e}, {y:e}, {z:e}), not within {limit:e} of the origin; repair the mesh"
    )]
    Vertex {
        /// The path as given.
        path: String,
        /// Where, mm.
        x: f64,
        /// Where, mm.
        y: f64,
        /// Where, mm.
        z: f64,
        /// The largest coordinate that is accepted, [`policy::OUTLINE_RANGE`].
        limit: f64,
    },
    /// A unit that is not a length for gears.
    #[error("{path}: its drawing unit is `{unit}`; save it in millimetres")]
    Unit {
        /// The path as given.
        path: String,
        /// The unit.
        unit: String,
    },
    /// An entity that is not read.
    #[error("{path}: it holds {kind}, which is not read; turn it into lines, arcs or polylines")]
    Entity {
        /// The path as given.
        path: String,
        /// What it is.
        kind: &'static str,
    },
    /// The contour does not make an outline.
    #[error("{path}: {error}")]
    Outline {
        /// The path as given.
        path: String,
        /// What is wrong.
        error: OutlineError,
    },
}

/// A contour as a file gives it, mm, y upwards, without a repeated last point.
#[derive(Clone, Debug, PartialEq)]
struct Ring {
    points: Vec<Point>,
    closed: bool,
}

/// Reads a finished gear.
///
/// `source` is a path, or a folder that holds a `design.json`. Where a file holds both gears of a
/// pair (a `design.json`, an OBJ with objects or a DXF with layers `driver` and `follower`), `side`
/// picks one, or `#driver`, `#follower` behind the path does. The largest closed contour is the gear, contours in
/// it are holes. Units: SVG with a size in mm, cm, in and the like has that scale, without one
/// a unit of its view box is 1 mm; DXF by its header, mm without one; all else mm. Curves are
/// flattened to [`policy::TOOTHED_CHORD`]; outlines of more than
/// [`policy::OUTLINE_VERTICES_KEPT`] vertices, or that cross themselves by less than that chord,
/// are thinned within the stated tolerance.
///
/// # Errors
/// See [`ToothedError`].
pub fn load_toothed(source: &str, side: Side) -> Result<Toothed, ToothedError> {
    let (path, part) = match source.rsplit_once('#') {
        Some((path, part)) if !Path::new(source).exists() => (path, Some(part)),
        _ => (source, None),
    };
    let inside = Path::new(path).join("design.json");
    let file = if inside.is_file() { inside.to_string_lossy().into_owned() } else { path.into() };
    let bytes = read_file(&file).map_err(|error| match error {
        LoadError::Unknown { name, .. } => LoadError::Missing { path: name },
        other => other,
    })?;
    read(&bytes, &Asked { path: &file, part, side })
}

/// The finished gear in the bytes of a file: [`load_toothed`] for what is in memory.
///
/// `file_name` is named in messages, and its extension tells the format. `part` is what follows `#` there.
///
/// # Errors
/// As [`load_toothed`], less what concerns files.
pub fn toothed_from_bytes(
    bytes: &[u8],
    file_name: &str,
    part: Option<&str>,
    side: Side,
) -> Result<Toothed, ToothedError> {
    bounded(bytes, file_name)?;
    read(bytes, &Asked { path: file_name, part, side })
}

fn read(bytes: &[u8], asked: &Asked<'_>) -> Result<Toothed, ToothedError> {
    let (rings, record) = match kind(bytes, asked.path) {
        Some(Kind::Svg) => (drawing::rings(bytes, asked)?, None),
        Some(Kind::Dxf) => (dxf::rings(bytes, asked)?, None),
        Some(Kind::Stl) => (slice::of_stl(bytes, asked)?, None),
        Some(Kind::Obj) => (slice::of_obj(bytes, asked)?, None),
        Some(Kind::Json) => json::rings(bytes, asked)?,
        Some(Kind::Columns) => {
            let points = points::columns(bytes, policy::INPUT_BYTES as usize)
                .map_err(|error| ToothedError::Points { path: asked.path(), error })?;
            (vec![implicitly_closed(points)], None)
        }
        None => return Err(ToothedError::Unrecognised { path: asked.path() }),
    };
    let mut gear = assemble(rings, asked.path)?;
    gear.record = record;
    Ok(gear)
}

/// What was asked for.
struct Asked<'a> {
    path: &'a str,
    part: Option<&'a str>,
    side: Side,
}

impl Asked<'_> {
    fn path(&self) -> String {
        self.path.to_owned()
    }

    fn no_such_part(&self, part: &str) -> ToothedError {
        ToothedError::NoSuchPart { path: self.path(), part: part.to_owned() }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Svg,
    Dxf,
    Stl,
    Obj,
    Json,
    Columns,
}

fn kind(bytes: &[u8], path: &str) -> Option<Kind> {
    let extension = Path::new(path).extension().unwrap_or_default().to_string_lossy();
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    match (extension.to_lowercase().as_str(), text.first()) {
        ("svg", _) | (_, Some(b'<')) => Some(Kind::Svg),
        ("dxf", _) => Some(Kind::Dxf),
        ("stl", _) => Some(Kind::Stl),
        ("obj", _) => Some(Kind::Obj),
        ("json", _) | (_, Some(b'{' | b'[')) => Some(Kind::Json),
        ("csv" | "txt" | "xy" | "dat", _) => Some(Kind::Columns),
        (_, Some(b'0'..=b'9' | b'+' | b'-' | b'.' | b'#')) => Some(Kind::Columns),
        _ => None,
    }
}

/// A list of points closes by itself, unless its closing chord is far longer than any other.
fn implicitly_closed(mut points: Vec<Point>) -> Ring {
    points.dedup();
    let gap = match (points.first(), points.last()) {
        (Some(first), Some(last)) => (last - first).norm(),
        _ => 0.0,
    };
    let longest = points.windows(2).map(|w| (w[1] - w[0]).norm()).fold(0.0, f64::max);
    Ring { points, closed: gap <= policy::OPEN_LIST_GAP * longest }
}

/// The gear among contours.
fn assemble(rings: Vec<Ring>, path: &str) -> Result<Toothed, ToothedError> {
    let failed = |error| ToothedError::Outline { path: path.to_owned(), error };
    if rings.iter().map(|r| r.points.len()).sum::<usize>() > policy::TOOTHED_VERTICES {
        let count = rings.iter().map(|r| r.points.len()).sum();
        return Err(failed(OutlineError::TooManyPoints { count, limit: policy::TOOTHED_VERTICES }));
    }
    for ring in &rings {
        check_coordinates(&ring.points).map_err(failed)?;
    }
    let extent = |ring: &Ring| {
        let (low, high) = geometry::bounds(&ring.points);
        (high - low).norm()
    };
    let mut rings = rings;
    rings.retain(|r| r.points.len() > 1);
    rings.sort_by(|a, b| extent(b).total_cmp(&extent(a)));
    let Some(first) = rings.first() else {
        return Err(ToothedError::NoContour { path: path.to_owned() });
    };
    if !first.closed
        && let (Some(from), Some(to)) = (first.points.first(), first.points.last())
    {
        return Err(ToothedError::Open {
            path: path.to_owned(),
            gap: (to - from).norm(),
            from_x: from.x,
            from_y: from.y,
            to_x: to.x,
            to_y: to.y,
        });
    }
    let mut rings = rings.into_iter().filter(|r| r.closed);
    let boundary = rings.next().map(|r| r.points).unwrap_or_default();
    let (boundary, thinned) = thinned(boundary).map_err(failed)?;
    let (outline, thinned) = match Outline::new(boundary.clone()) {
        Ok(outline) => (outline, thinned),
        Err(error) => untangled(&boundary).ok_or_else(|| failed(error))?,
    };
    // A contour that encloses no area or crosses the gear's boundary, as a pitch curve does, is no
    // hole; decorations are no business of ours.
    let mut holes: Vec<Outline> = rings
        .take(policy::TOOTHED_HOLES)
        .filter_map(|r| Outline::new(thinned_hole(r.points)).ok())
        .filter(|hole| hole.points().iter().all(|p| outline.contains(*p)))
        .collect();
    holes.sort_by(|a, b| b.area().total_cmp(&a.area()));
    Ok(Toothed { outline, holes, thinned, record: None })
}

fn thinned(points: Vec<Point>) -> Result<(Vec<Point>, Option<Thinned>), OutlineError> {
    let from = points.len();
    if from <= policy::OUTLINE_VERTICES_KEPT {
        return Ok((points, None));
    }
    let (low, high) = geometry::bounds(&points);
    let side = (high - low).min();
    let (mut share, last) = policy::SIMPLIFY_TOLERANCE;
    while share <= last {
        let tolerance = share * side;
        let fewer = simplify(&points, tolerance);
        if fewer.len() <= policy::OUTLINE_VERTICES_KEPT {
            let thinned = Thinned { from, to: fewer.len(), tolerance };
            return Ok((fewer, Some(thinned)));
        }
        share *= 2.0;
    }
    Err(OutlineError::TooIntricate)
}

/// A boundary that crosses itself by less than what matters: rounded numbers cross over folds that
/// enclose no area.
fn untangled(points: &[Point]) -> Option<(Outline, Option<Thinned>)> {
    let (low, high) = geometry::bounds(points);
    let tolerance = policy::TOOTHED_CHORD * (high - low).norm();
    let outline = without_barbs(simplify(points, tolerance), tolerance);
    let outline = Outline::new(outline).ok()?;
    let thinned = Thinned { from: points.len(), to: outline.points().len(), tolerance };
    Some((outline, Some(thinned)))
}

/// Holes only tell where the axis is.
fn thinned_hole(points: Vec<Point>) -> Vec<Point> {
    if points.len() <= policy::OUTLINE_VERTICES_KEPT {
        return points;
    }
    let (low, high) = geometry::bounds(&points);
    simplify(&points, policy::SIMPLIFY_TOLERANCE.1 * (high - low).min())
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
