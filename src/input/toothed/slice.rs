//! Contours of solids cut at half their thickness, across z.

use super::{Asked, Ring, ToothedError};
use crate::geometry::Point;
use crate::policy;
use crate::wording::quoted;
use std::collections::HashMap;
use std::io::Cursor;

/// Vertices and triangles of a mesh.
#[derive(Default)]
struct Mesh {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[usize; 3]>,
}

pub(super) fn of_stl(bytes: &[u8], asked: &Asked<'_>) -> Result<Vec<Ring>, ToothedError> {
    let read = stl_io::read_stl(&mut Cursor::new(bytes))
        .map_err(|e| malformed(asked, "STL", e.to_string()))?;
    let vertices = read.vertices.iter().map(|v| [0, 1, 2].map(|i| f64::from(v[i]))).collect();
    let triangles = read.faces.iter().map(|f| f.vertices).collect();
    sliced(&Mesh { vertices, triangles }, asked)
}

fn malformed(asked: &Asked<'_>, format: &'static str, reason: String) -> ToothedError {
    ToothedError::Malformed { path: asked.path(), format, reason: quoted(&reason) }
}

/// An OBJ; with objects `driver` and `follower` the one asked for, else all of it.
pub(super) fn of_obj(bytes: &[u8], asked: &Asked<'_>) -> Result<Vec<Ring>, ToothedError> {
    let text = std::str::from_utf8(bytes)
        .map_err(|_| malformed(asked, "OBJ", "it is not text".to_owned()))?;
    let mut vertices: Vec<[f64; 3]> = Vec::new();
    let mut objects: Vec<(String, Vec<[usize; 3]>)> = vec![(String::new(), Vec::new())];
    for (number, line) in text.lines().enumerate() {
        let bad = || malformed(asked, "OBJ", format!("line {} is not understood", number + 1));
        let mut fields = line.split_whitespace();
        match fields.next() {
            Some("v") => {
                let mut next = || fields.next()?.parse::<f64>().ok().filter(|v| v.is_finite());
                let vertex = next().zip(next()).zip(next()).map(|((x, y), z)| [x, y, z]);
                vertices.push(vertex.ok_or_else(bad)?);
            }
            Some("o" | "g") => objects.push((fields.collect::<Vec<_>>().join(" "), Vec::new())),
            Some("f") => {
                let corners = fields
                    .map(|f| {
                        let index: i64 = f.split('/').next()?.parse().ok()?;
                        let first = if index < 0 { vertices.len() as i64 } else { -1 };
                        let index = usize::try_from(first.checked_add(index)?).ok();
                        index.filter(|i| *i < vertices.len())
                    })
                    .collect::<Option<Vec<usize>>>()
                    .filter(|c| c.len() > 2)
                    .ok_or_else(bad)?;
                let fan = corners[1..].windows(2).map(|w| [corners[0], w[0], w[1]]);
                if let Some(object) = objects.last_mut() {
                    object.1.extend(fan);
                }
            }
            _ => {}
        }
    }
    let named = |name: &str| objects.iter().any(|(n, _)| n == name);
    let wanted = match asked.part {
        Some(part) if !named(part) => return Err(asked.no_such_part(part)),
        Some(part) => Some(part),
        None => Some(asked.side.name()).filter(|name| named(name)),
    };
    let triangles = objects
        .iter()
        .filter(|(name, _)| wanted.is_none_or(|w| w == name))
        .flat_map(|(_, triangles)| triangles.iter().copied())
        .collect();
    sliced(&welded(&vertices, triangles), asked)
}

/// Vertices at the same place become one.
fn welded(vertices: &[[f64; 3]], triangles: Vec<[usize; 3]>) -> Mesh {
    let mut known: HashMap<[u64; 3], usize> = HashMap::new();
    let mut mesh = Mesh::default();
    let place: Vec<usize> = vertices
        .iter()
        .map(|v| {
            // Adding zero makes the two zeros one.
            *known.entry(v.map(|c| (c + 0.0).to_bits())).or_insert_with(|| {
                mesh.vertices.push(*v);
                mesh.vertices.len() - 1
            })
        })
        .collect();
    mesh.triangles = triangles.into_iter().map(|t| t.map(|i| place[i])).collect();
    mesh
}

/// Follows the cut from edge to edge of the mesh.
fn sliced(mesh: &Mesh, asked: &Asked<'_>) -> Result<Vec<Ring>, ToothedError> {
    // Also those that the cut does not meet: half the thickness is wrong then.
    let limit = policy::OUTLINE_RANGE.1;
    if let Some(&[x, y, z]) = mesh.vertices.iter().find(|v| !v.iter().all(|c| c.abs() <= limit)) {
        return Err(ToothedError::Vertex { path: asked.path(), x, y, z, limit });
    }
    let heights = || mesh.triangles.iter().flatten().map(|&i| mesh.vertices[i][2]);
    let (low, high) =
        heights().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), z| (l.min(z), h.max(z)));
    if high.partial_cmp(&low) != Some(std::cmp::Ordering::Greater) {
        return Err(ToothedError::NoContour { path: asked.path() });
    }
    let level = low + (0.5 + policy::SLICE_OFFSET) * (high - low);
    let above = |i: usize| mesh.vertices[i][2] > level;
    // Each triangle that is cut joins two cut edges; the order keeps results the same every time.
    let mut joined: HashMap<(usize, usize), Vec<(usize, usize)>> = HashMap::new();
    let mut order = Vec::new();
    for &[a, b, c] in &mesh.triangles {
        let cut: Vec<(usize, usize)> = [(a, b), (b, c), (c, a)]
            .into_iter()
            .filter(|&(i, j)| above(i) != above(j))
            .map(|(i, j)| (i.min(j), i.max(j)))
            .collect();
        if let [p, q] = cut[..] {
            order.push(p);
            joined.entry(p).or_default().push(q);
            joined.entry(q).or_default().push(p);
        }
    }
    if joined.values().any(|n| n.len() != 2) {
        return Err(ToothedError::OpenMesh { path: asked.path() });
    }
    let at = |(i, j): (usize, usize)| {
        let (a, b) = (mesh.vertices[i], mesh.vertices[j]);
        let t = (level - a[2]) / (b[2] - a[2]);
        Point::new(a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]))
    };
    let mut rings = Vec::new();
    for start in order {
        let mut points = Vec::new();
        let mut here = start;
        while let Some(next) = joined.get_mut(&here).and_then(Vec::pop) {
            points.push(at(here));
            if let Some(back) = joined.get_mut(&next)
                && let Some(i) = back.iter().position(|e| *e == here)
            {
                back.swap_remove(i);
            }
            here = next;
        }
        if points.len() > 2 {
            rings.push(Ring { points, closed: true });
        }
    }
    Ok(rings)
}
