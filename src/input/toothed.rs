//! Outlines of finished gears, read exactly as they are: no smoothing, no repair. From SVG, DXF,
//! points as CSV or JSON, a `design.json`, or a slice of STL or OBJ where the teeth are.

use super::contours::{Contour, Contours};
use super::note::Note;
use super::recognise::{Format, recognised};
use super::record::PairRecord;
use super::source::{Source, bounded, read_file};
use super::{InputError, choose, dxf, record, solid, svg, table};
use crate::gear::{Pair, Side};
use crate::geometry;
use crate::geometry::Point;
use crate::geometry::curves::without_barbs;
use crate::outline::{Outline, OutlineError, check_coordinates, simplify};
use crate::policy;
use std::path::Path;

/// A finished gear, mm, y upwards, in the frame of its file.
#[derive(Clone, Debug, PartialEq)]
pub struct Toothed {
    /// The outer boundary.
    pub outline: Outline,
    /// Its holes, each counter-clockwise, the largest first; of very many the widest.
    pub holes: Vec<Outline>,
    /// How the boundary was thinned, if it had too many vertices or crossed itself by a hair.
    pub thinned: Option<Thinned>,
    /// What a `design.json` tells of the pair; its gears have their axes at the origin.
    pub record: Option<PairRecord>,
    /// What a reader should know.
    pub notes: Vec<Note>,
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

/// Reads two finished gears. A file that is given twice and holds two gears is the pair.
///
/// `join` is the widest gap between ends of lines that is joined, mm; 0.05 mm, or 1e-4 of the drawing if that is more, when
/// left out.
///
/// # Errors
/// See [`load_toothed`].
pub fn load_gears(sources: Pair<&str>, join: Option<f64>) -> Result<Pair<Toothed>, InputError> {
    let source = Source::new(sources.driver);
    if sources.driver == sources.follower
        && source.part.is_none()
        && !Path::new(source.path).is_dir()
    {
        let bytes = read_file_of_gear(source.path)?;
        let holds_two = |side| {
            contours(&bytes, source, side, join).is_ok_and(|c| choose::count(&c, source) == 2)
        };
        // Where names in the file tell which gear is which, they choose.
        if holds_two(None) && holds_two(Some(Side::Driver)) {
            return Pair::new((), ()).try_map(|side, ()| {
                let part = if side == Side::Driver { "1" } else { "2" };
                let mut gear = read(&bytes, Source { part: Some(part), ..source }, side, join)?;
                gear.notes.push(Note::BothGears);
                Ok(gear)
            });
        }
        return Pair::new((), ()).try_map(|side, ()| read(&bytes, source, side, join));
    }
    Ok(Pair {
        driver: load_gear(sources.driver, Side::Driver, join)?,
        follower: load_gear(sources.follower, Side::Follower, join)?,
    })
}

/// Reads a finished gear.
///
/// `source` is a path, or a folder that holds a `design.json`. Where a file holds both gears of a
/// pair (a `design.json`, an OBJ with objects or a DXF with layers `driver` and `follower`), `side`
/// picks one, or `#driver`, `#follower` behind the path does; so do the name of any layer, group or object there, and a
/// number. The visible contour that has teeth is the gear, else the largest; contours in
/// it are holes. Units: SVG with a size in mm, cm, in and the like has that scale, without one
/// a unit of its view box is 1 mm; DXF by its header, mm without one; all else mm. Curves are
/// flattened to [`policy::TOOTHED_CHORD`]; outlines of more than
/// [`policy::OUTLINE_VERTICES_KEPT`] vertices, or that cross themselves by less than that chord,
/// are thinned within the stated tolerance.
///
/// # Errors
/// See [`InputError`].
pub fn load_toothed(source: &str, side: Side) -> Result<Toothed, InputError> {
    load_gear(source, side, None)
}

fn load_gear(source: &str, side: Side, join: Option<f64>) -> Result<Toothed, InputError> {
    let source = Source::new(source);
    let inside = Path::new(source.path).join("design.json");
    let file = if inside.is_file() { inside.to_string_lossy().into_owned() } else { source.path() };
    let bytes = read_file_of_gear(&file)?;
    read(&bytes, Source { path: &file, part: source.part }, side, join)
}

fn read_file_of_gear(file: &str) -> Result<Vec<u8>, InputError> {
    read_file(file).map_err(|error| match error {
        InputError::Unknown { name, .. } => InputError::Missing { path: name },
        other => other,
    })
}

/// The finished gear in the bytes of a file: [`load_toothed`] for what is in memory.
///
/// `file_name` is named in messages, and its extension tells the format where the content does not. `part` is what follows
/// `#` there.
///
/// # Errors
/// As [`load_toothed`], less what concerns files.
pub fn toothed_from_bytes(
    bytes: &[u8],
    file_name: &str,
    part: Option<&str>,
    side: Side,
) -> Result<Toothed, InputError> {
    bounded(bytes, file_name)?;
    read(bytes, Source { path: file_name, part }, side, None)
}

fn read(
    bytes: &[u8],
    source: Source<'_>,
    side: Side,
    join: Option<f64>,
) -> Result<Toothed, InputError> {
    let mut made = contours(bytes, source, Some(side), join)?;
    let source = Source { part: source.part.filter(|_| !made.part_used), ..source };
    let count: usize = made.list.iter().map(|c| c.points.len()).sum();
    let failed = |error| InputError::Outline { path: source.path(), error };
    if count > policy::TOOTHED_VERTICES {
        return Err(failed(OutlineError::TooManyPoints { count, limit: policy::TOOTHED_VERTICES }));
    }
    for contour in &made.list {
        check_coordinates(&contour.points).map_err(failed)?;
    }
    let chosen = choose::gear(&mut made, source, side)?;
    let joint = made.notes.iter().find_map(|n| match n {
        Note::Joined { widest, .. } => Some(*widest * made.unit.mm),
        _ => None,
    });
    let scale = made.unit.mm;
    let mm = |c: Contour| -> Vec<Point> { c.points.iter().map(|p| p * scale).collect() };
    let bridged = chosen.outer.bridged;
    let (boundary, thinned) = thinned(mm(chosen.outer)).map_err(failed)?;
    let (outline, thinned) = match Outline::new(boundary.clone()) {
        Ok(outline) => (outline, thinned),
        Err(error) => untangled(&boundary, joint).ok_or_else(|| failed(error))?,
    };
    // A contour that encloses no area is no hole; decorations are no business of ours.
    let mut holes: Vec<Outline> =
        chosen.holes.into_iter().filter_map(|c| Outline::new(thinned_hole(mm(c))).ok()).collect();
    holes.sort_by(|a, b| b.area().total_cmp(&a.area()));
    let mut notes = made.notes;
    if let Some((from, to)) = bridged
        && (to - from).norm() * scale > policy::CHAIN_GAP * outline.perimeter()
    {
        notes.push(Note::ClosedByLine { from, to });
    }
    if made.unit.mm != 1.0 {
        let (low, high) = outline.bounds();
        notes.push(Note::Unit { unit: made.unit.name, width: high.x - low.x });
    }
    Ok(Toothed { outline, holes, thinned, record: made.record, notes })
}

/// The contours of a file that may hold finished gears.
fn contours(
    bytes: &[u8],
    source: Source<'_>,
    side: Option<Side>,
    join: Option<f64>,
) -> Result<Contours, InputError> {
    let path = || source.path();
    let solid = |error| InputError::Solid { path: path(), error };
    match recognised(bytes, source.path) {
        Ok(Format::Svg) => svg::contours(bytes, source, side, join)
            .map_err(|error| InputError::Svg { path: path(), error }),
        Ok(Format::Dxf) => {
            dxf::contours(bytes, join).map_err(|error| InputError::Dxf { path: path(), error })
        }
        Ok(Format::Stl) => {
            solid::contours(&solid::stl(bytes).map_err(solid)?, source).map_err(solid)
        }
        Ok(Format::Obj) => {
            let (mesh, used) = solid::obj(bytes, source.part, side).map_err(solid)?;
            let rest = Source { part: source.part.filter(|_| !used), ..source };
            let mut made = solid::contours(&mesh, rest).map_err(solid)?;
            made.part_used |= used;
            Ok(made)
        }
        Ok(Format::Json) => record::contours(bytes, source, Some(side.unwrap_or(Side::Driver))),
        Ok(Format::Table) => {
            let points = table::columns(bytes, policy::INPUT_BYTES as usize)
                .map_err(|error| InputError::Points { path: path(), error })?;
            Ok(Contours { list: vec![Contour::listed(points)], told: true, ..Contours::default() })
        }
        Ok(Format::Picture) => Err(InputError::Picture { path: path() }),
        Err(what) => Err(InputError::Unrecognised {
            path: path(),
            what: what.unwrap_or("no outline of a gear"),
        }),
    }
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
fn untangled(points: &[Point], joint: Option<f64>) -> Option<(Outline, Option<Thinned>)> {
    let (low, high) = geometry::bounds(points);
    // Ends that were joined may overshoot each other.
    let tolerance = (policy::TOOTHED_CHORD * (high - low).norm()).max(joint.unwrap_or(0.0));
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
