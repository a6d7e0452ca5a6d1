//! Contours of solids (STL, OBJ), cut where their teeth are.

mod obj;
mod slice;
mod stl;

use super::contours::{Contour, Contours};
use super::nature::Nature;
use super::note::Note;
use super::source::Source;
use crate::geometry::{self, Point};
use crate::outline::OutlineError;
use crate::policy;
pub(super) use obj::read as obj;
use slice::sliced;
pub(super) use stl::read as stl;

/// Why a solid gives no contour.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SolidFileError {
    /// A file that cannot be read.
    #[error("it is no {format} that can be read ({reason}); save it again")]
    Malformed {
        /// `STL` or `OBJ`.
        format: &'static str,
        /// What is wrong, with the line.
        reason: String,
    },
    /// No triangle, or all in one plane.
    #[error("the solid has no thickness; save a solid, not a surface")]
    Flat,
    /// A mesh that is not closed where it is cut.
    #[error("the mesh is not closed at half its thickness; repair it")]
    Open,
    /// Layers with different teeth.
    #[error("the solid has gears of several sizes in layers ({list}); name one, such as {path}#1")]
    Layers {
        /// The path as given.
        path: String,
        /// Each layer with its number, heights and teeth.
        list: String,
    },
    /// There is no such layer.
    #[error("the solid has no layer {number} of teeth ({list}); name one that it has")]
    NoLayer {
        /// What was asked for.
        number: usize,
        /// Each layer with its number, heights and teeth.
        list: String,
    },
    /// A vertex of a mesh that is not finite or too far away.
    #[error(
        "a vertex of the mesh lies at ({x:e}, {y:e}, {z:e}), not within {limit:e} of the origin; repair the mesh"
    )]
    Vertex {
        /// Where, mm.
        x: f64,
        /// Where, mm.
        y: f64,
        /// Where, mm.
        z: f64,
        /// The largest coordinate that is accepted, [`policy::OUTLINE_RANGE`].
        limit: f64,
    },
    /// The cut does not make contours.
    #[error(transparent)]
    Outline(#[from] OutlineError),
}

/// Vertices and triangles of a mesh.
#[derive(Clone, Debug, Default)]
pub(super) struct Mesh {
    pub(super) vertices: Vec<[f64; 3]>,
    pub(super) triangles: Vec<[usize; 3]>,
}

/// Layers between the heights of vertices that are looked at, the thickest first.
const LAYERS: usize = 16;
/// Thinnest layer that is looked at, as a share of the height.
const LAYER_LEAST: f64 = 0.01;
/// Teeth counts of two layers that differ by no more than this share are those of one gear.
const SAME_TEETH: f64 = 0.1;
/// A direction in which the solid is thinner than this share of the others is that of its axis.
const THIN: f64 = 0.6;

/// A cut with teeth.
struct Cut {
    from: f64,
    to: f64,
    teeth: usize,
    list: Vec<Contour>,
}

/// The contours of the cut through the teeth; where there are none, at half the height.
///
/// The direction in which the solid is clearly thin is looked along first, then z, y and x, as modelling programs save solids
/// that stand.
///
/// # Errors
/// See [`SolidFileError`].
pub(super) fn contours(mesh: &Mesh, source: Source<'_>) -> Result<Contours, SolidFileError> {
    let limit = policy::OUTLINE_RANGE.1;
    if let Some(&[x, y, z]) = mesh.vertices.iter().find(|v| !v.iter().all(|c| c.abs() <= limit)) {
        return Err(SolidFileError::Vertex { x, y, z, limit });
    }
    let number = source.part.and_then(|p| p.parse::<usize>().ok());
    let size = size(mesh);
    let thin = |i: usize| (0..3).all(|j| j == i || size[i] < THIN * size[j]);
    let thin = ['x', 'y', 'z'].into_iter().enumerate().find(|(i, _)| thin(*i)).map(|(_, a)| a);
    // Cut across its axis a wheel shows its rim, whose teeth are no gear's.
    let others = ['z', 'y', 'x'].into_iter().filter(|a| Some(*a) != thin);
    for axis in thin.into_iter().chain(others) {
        let turned = turned(mesh, axis);
        let mut cuts = toothed(&turned)?;
        if cuts.is_empty() {
            continue;
        }
        cuts.sort_by(|a, b| a.from.total_cmp(&b.from));
        let mut gears: Vec<Cut> = Vec::new();
        for cut in cuts {
            let near = |g: &&mut Cut| {
                g.teeth.abs_diff(cut.teeth) as f64 <= SAME_TEETH * g.teeth.max(cut.teeth) as f64
            };
            match gears.iter_mut().find(near) {
                Some(known) if known.to - known.from < cut.to - cut.from => *known = cut,
                Some(_) => {}
                None => gears.push(cut),
            }
        }
        let list = || -> String {
            let named = |(i, c): (usize, &Cut)| {
                format!("#{}: {} teeth at {axis} = {:.3} to {:.3}", i + 1, c.teeth, c.from, c.to)
            };
            gears.iter().enumerate().map(named).collect::<Vec<_>>().join(", ")
        };
        let index = match number {
            // One gear a layer: the number counts gears that lie side by side.
            Some(_) if gears.len() == 1 => 0,
            Some(number) if number == 0 || number > gears.len() => {
                return Err(SolidFileError::NoLayer { number, list: list() });
            }
            Some(number) => number - 1,
            None if gears.len() > 1 => {
                return Err(SolidFileError::Layers { path: source.path(), list: list() });
            }
            None => 0,
        };
        let part_used = gears.len() > 1;
        let cut = gears.swap_remove(index);
        let mut notes = Vec::new();
        if axis != 'z' {
            notes.push(Note::Turned { axis });
        } else if cut.to - cut.from < 0.98 * size[2] {
            notes.push(Note::Layer { from: cut.from, to: cut.to });
        }
        return Ok(Contours { list: cut.list, notes, part_used, ..Contours::default() });
    }
    // No teeth anywhere: along the direction in which it is clearly thin, else along z.
    let axis = thin.unwrap_or('z');
    let turned = turned(mesh, axis);
    let (low, high) = heights(&turned).ok_or(SolidFileError::Flat)?;
    let level = low + (0.5 + policy::SLICE_OFFSET) * (high - low);
    let notes = if axis == 'z' { Vec::new() } else { vec![Note::Turned { axis }] };
    Ok(Contours { list: sliced(&turned, level)?, notes, ..Contours::default() })
}

/// The mesh with one of its axes pointing up, handedness kept.
fn turned(mesh: &Mesh, axis: char) -> Mesh {
    let turn = |&[x, y, z]: &[f64; 3]| match axis {
        'y' => [x, -z, y],
        'x' => [y, z, x],
        _ => [x, y, z],
    };
    Mesh { vertices: mesh.vertices.iter().map(turn).collect(), triangles: mesh.triangles.clone() }
}

fn size(mesh: &Mesh) -> [f64; 3] {
    let used = || mesh.triangles.iter().flatten().map(|&i| mesh.vertices[i]);
    [0, 1, 2].map(|k| {
        let (low, high) =
            used().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v[k]), h.max(v[k])));
        (high - low).max(0.0)
    })
}

/// Least and greatest height, if they differ.
fn heights(mesh: &Mesh) -> Option<(f64, f64)> {
    let used = mesh.triangles.iter().flatten().map(|&i| mesh.vertices[i][2]);
    let (low, high) =
        used.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), z| (l.min(z), h.max(z)));
    (high > low).then_some((low, high))
}

/// Cuts that show teeth, in layers between the heights of vertices.
fn toothed(mesh: &Mesh) -> Result<Vec<Cut>, SolidFileError> {
    let (low, high) = heights(mesh).ok_or(SolidFileError::Flat)?;
    let height = high - low;
    let mut levels: Vec<f64> =
        mesh.triangles.iter().flatten().map(|&i| mesh.vertices[i][2]).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup_by(|a, b| (*a - *b).abs() < 1e-6 * height);
    let mut layers: Vec<(f64, f64)> = levels
        .windows(2)
        .map(|w| (w[0], w[1]))
        .filter(|(a, b)| b - a >= LAYER_LEAST * height)
        .collect();
    layers.sort_by(|a, b| (b.1 - b.0).total_cmp(&(a.1 - a.0)));
    layers.truncate(LAYERS);
    // Teeth along a helix have vertices at every height.
    let covered: f64 = layers.iter().map(|(a, b)| b - a).sum();
    if covered < 0.5 * height {
        let step = height / LAYERS as f64;
        layers =
            (0..LAYERS).map(|i| (low + step * i as f64, low + step * (i + 1) as f64)).collect();
    }
    let mut cuts = Vec::new();
    for (from, to) in layers {
        let level = from + (0.5 + policy::SLICE_OFFSET) * (to - from);
        // Where a layer is not closed another may be.
        let Ok(list) = sliced(mesh, level) else { continue };
        let widest = list.iter().max_by(|a, b| a.extent().total_cmp(&b.extent()));
        let teeth = list.iter().filter_map(|c| match Nature::of(c) {
            Nature::Toothed(n) if widest.is_some_and(|w| c.extent() > 0.2 * w.extent()) => {
                Some((n, c.extent()))
            }
            _ => None,
        });
        if let Some((teeth, _)) = teeth.max_by(|a, b| a.1.total_cmp(&b.1)) {
            cuts.push(Cut { from, to, teeth, list });
        }
    }
    Ok(cuts)
}

/// The region that all rings wind round, as rings; those that do not overlap stay as they are.
fn united(rings: Vec<Vec<Point>>) -> Result<Vec<Vec<Point>>, SolidFileError> {
    let signed: f64 = rings.iter().map(|r| geometry::signed_area(r)).sum();
    let mut rings = rings;
    // A mesh that is inside out.
    if signed < 0.0 {
        rings.iter_mut().for_each(|r| r.reverse());
    }
    if rings.len() < 2 {
        return Ok(rings);
    }
    let parts: Vec<&[Point]> = rings.iter().map(Vec::as_slice).collect();
    crate::outline::repair::count_crossings(&parts)?;
    let union: Vec<Vec<Point>> = geometry::positive_parts(&rings).into_iter().flatten().collect();
    let covered: f64 = union.iter().map(|r| geometry::signed_area(r)).sum();
    let same = (covered - signed.abs()).abs() <= 1e-7 * covered;
    Ok(if same { rings } else { union })
}
