//! OBJ files.

use super::stl::Welder;
use super::{Mesh, SolidFileError};
use crate::gear::Side;
use crate::input::text::decoded;

/// The mesh of an OBJ file: of the object or group that is named, of the one called after the side, else of all. The
/// flag tells whether a name chose.
///
/// # Errors
/// [`SolidFileError::Malformed`].
pub(in crate::input) fn read(
    bytes: &[u8],
    part: Option<&str>,
    side: Option<Side>,
) -> Result<(Mesh, bool), SolidFileError> {
    let malformed = |reason: String| SolidFileError::Malformed { format: "OBJ", reason };
    let text = decoded(bytes).ok_or_else(|| malformed("it is not text".to_owned()))?;
    let mut welder = Welder::default();
    let mut places: Vec<usize> = Vec::new();
    let mut objects: Vec<(String, Vec<[usize; 3]>)> = vec![(String::new(), Vec::new())];
    for (number, line) in text.lines().enumerate() {
        let bad = || malformed(format!("line {} is not understood", number + 1));
        let mut fields = line.split_whitespace();
        match fields.next() {
            Some("v") => {
                let mut next = || fields.next()?.parse::<f64>().ok().filter(|v| v.is_finite());
                let vertex = next().zip(next()).zip(next()).map(|((x, y), z)| [x, y, z]);
                places.push(welder.vertex(vertex.ok_or_else(bad)?));
            }
            Some("o" | "g") => objects.push((fields.collect::<Vec<_>>().join(" "), Vec::new())),
            Some("f") => {
                let corners = fields
                    .map(|f| {
                        let index: i64 = f.split('/').next()?.parse().ok()?;
                        let first = if index < 0 { places.len() as i64 } else { -1 };
                        let index = usize::try_from(first.checked_add(index)?).ok();
                        index.and_then(|i| places.get(i).copied())
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
    let named = |name: &str| objects.iter().any(|(n, t)| n == name && !t.is_empty());
    let wanted = part.or(side.map(Side::name)).filter(|name| named(name));
    let mut mesh = welder.mesh;
    mesh.triangles = objects
        .iter()
        .filter(|(name, _)| wanted.is_none_or(|w| w == name))
        .flat_map(|(_, triangles)| triangles.iter().copied())
        .collect();
    Ok((mesh, wanted.is_some()))
}
