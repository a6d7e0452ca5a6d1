//! STL files, binary or text, whatever their first bytes say.

use super::{Mesh, SolidFileError};
use crate::input::text::decoded;
use crate::wording::quoted;
use std::collections::HashMap;

/// The mesh of an STL file.
///
/// # Errors
/// [`SolidFileError::Malformed`].
pub(in crate::input) fn read(bytes: &[u8]) -> Result<Mesh, SolidFileError> {
    let count = bytes.get(80..84).map(|b| u64::from(u32::from_le_bytes([b[0], b[1], b[2], b[3]])));
    // The length decides: exporters write binary files that begin with `solid`.
    if let Some(count) = count
        && count > 0
        && (bytes.len() as u64 == 84 + 50 * count
            || !bytes.trim_ascii_start().starts_with(b"solid"))
    {
        return binary(&bytes[84..], count);
    }
    text(bytes)
}

fn malformed(reason: String) -> SolidFileError {
    SolidFileError::Malformed { format: "STL", reason }
}

fn binary(bytes: &[u8], count: u64) -> Result<Mesh, SolidFileError> {
    if (bytes.len() as u64) < 50 * count {
        let there = bytes.len() / 50;
        return Err(malformed(format!("it breaks off after {there} of {count} triangles")));
    }
    let mut welder = Welder::default();
    for triangle in bytes.chunks_exact(50).take(count as usize) {
        let number = |at: usize| {
            let raw = [triangle[at], triangle[at + 1], triangle[at + 2], triangle[at + 3]];
            f64::from(f32::from_le_bytes(raw))
        };
        let corner = |i: usize| [0, 1, 2].map(|k| number(12 + 12 * i + 4 * k));
        welder.add([corner(0), corner(1), corner(2)]);
    }
    Ok(welder.mesh)
}

fn text(bytes: &[u8]) -> Result<Mesh, SolidFileError> {
    let text =
        decoded(bytes).ok_or_else(|| malformed("it is neither binary nor text".to_owned()))?;
    let mut welder = Welder::default();
    let mut corners = Vec::with_capacity(3);
    for (number, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        match words.next().map(str::to_ascii_lowercase).as_deref() {
            Some("vertex") => {
                let mut next = || words.next()?.parse::<f64>().ok();
                let Some(((x, y), z)) = next().zip(next()).zip(next()) else {
                    return Err(malformed(format!("line {} is not understood", number + 1)));
                };
                // Binary files hold single precision; corners that were one must stay one.
                corners.push([x, y, z].map(|c| f64::from(c as f32)));
            }
            Some("endloop" | "endfacet") => {
                for i in 2..corners.len() {
                    welder.add([corners[0], corners[i - 1], corners[i]]);
                }
                corners.clear();
            }
            Some("solid" | "facet" | "outer" | "endsolid") | None => {}
            Some(other) if welder.mesh.triangles.is_empty() && corners.is_empty() => {
                return Err(malformed(format!(
                    "line {} begins with {}",
                    number + 1,
                    quoted(other)
                )));
            }
            // A comment or a colour that some program writes.
            Some(_) => {}
        }
    }
    if welder.mesh.triangles.is_empty() {
        return Err(malformed("it holds no facets".to_owned()));
    }
    Ok(welder.mesh)
}

/// Makes one vertex of those at the same place.
#[derive(Default)]
pub(super) struct Welder {
    known: HashMap<[u64; 3], usize>,
    pub(super) mesh: Mesh,
}

impl Welder {
    pub(super) fn vertex(&mut self, v: [f64; 3]) -> usize {
        // Adding zero makes the two zeros one.
        *self.known.entry(v.map(|c| (c + 0.0).to_bits())).or_insert_with(|| {
            self.mesh.vertices.push(v);
            self.mesh.vertices.len() - 1
        })
    }

    fn add(&mut self, corners: [[f64; 3]; 3]) {
        let triangle = corners.map(|c| self.vertex(c));
        self.mesh.triangles.push(triangle);
    }
}
