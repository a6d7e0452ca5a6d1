//! The cut of a mesh across z.

use super::{Mesh, SolidFileError, united};
use crate::geometry::Point;
use crate::input::contours::Contour;
use crate::input::join;
use std::collections::HashMap;

/// Widest crack in a mesh that is closed, over the width of the cut.
const CRACK: f64 = 1e-4;

/// The contours at a height that is that of no vertex. Shells that overlap are united.
///
/// # Errors
/// [`SolidFileError::Open`] where the mesh is not closed there.
pub(super) fn sliced(mesh: &Mesh, level: f64) -> Result<Vec<Contour>, SolidFileError> {
    type Edge = (usize, usize);
    let above = |i: usize| mesh.vertices[i][2] > level;
    // Each triangle that is cut leads from the edge where its boundary goes down to the one where it goes up, which
    // has the solid on the left; the order keeps results the same every time.
    let mut onwards: HashMap<Edge, Vec<Edge>> = HashMap::new();
    let mut order = Vec::new();
    for &[a, b, c] in &mesh.triangles {
        let (mut down, mut up) = (None, None);
        for (i, j) in [(a, b), (b, c), (c, a)] {
            match (above(i), above(j)) {
                (true, false) => down = Some((i.min(j), i.max(j))),
                (false, true) => up = Some((i.min(j), i.max(j))),
                _ => {}
            }
        }
        if let Some((down, up)) = down.zip(up) {
            order.push(down);
            onwards.entry(down).or_default().push(up);
        }
    }
    let at = |(i, j): Edge| {
        let (a, b) = (mesh.vertices[i], mesh.vertices[j]);
        let t = (level - a[2]) / (b[2] - a[2]);
        Point::new(a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]))
    };
    let mut rings: Vec<Vec<Point>> = Vec::new();
    let mut open: Vec<Contour> = Vec::new();
    for start in order {
        let mut points = Vec::new();
        let mut here = start;
        while let Some(next) = onwards.get_mut(&here).and_then(Vec::pop) {
            points.push(at(here));
            here = next;
            if here == start {
                break;
            }
        }
        if points.is_empty() {
            continue;
        }
        if here == start {
            points.dedup();
            if points.len() > 2 {
                rings.push(points);
            }
        } else {
            points.push(at(here));
            open.push(Contour { points, ..Contour::default() });
        }
    }
    if !open.is_empty() {
        // Corners that were one before the file was rounded, or triangles of either sense.
        let all: Vec<Point> = open.iter().flat_map(|c| c.points.iter().copied()).collect();
        let (low, high) = crate::geometry::bounds(&all);
        let size = (high - low).norm();
        let (joined, _) = join::joined(open, size, CRACK * size).ok_or(SolidFileError::Open)?;
        for contour in joined {
            if !contour.closed && contour.extent() > CRACK * size {
                return Err(SolidFileError::Open);
            }
            if contour.closed {
                rings.push(contour.points);
            }
        }
    }
    let closed = |points| Contour { points, closed: true, ..Contour::default() };
    Ok(united(rings)?.into_iter().map(closed).collect())
}
