//! Our own judgement of a mesh: the default kernel reports no status.

use super::Mesh;
use super::mesh::Sets;
use crate::policy;

/// What a sound mesh must measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// Volume, mm^3, as base area times thickness.
    pub volume: f64,
    /// Holes through the body: 0 for a plain gear, 1 with a bore.
    pub genus: i64,
}

/// The first thing wrong with a mesh.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Fault {
    /// There is no triangle.
    #[error("the kernel returned an empty mesh")]
    Empty,
    /// A coordinate is NaN or infinite, or an index points past the last vertex.
    #[error("vertex {vertex} has no finite position")]
    BadVertex {
        /// Index of the vertex.
        vertex: usize,
    },
    /// An edge does not have exactly two triangles that run it in opposite directions:
    /// the surface is open, doubled or turned over there.
    #[error("the surface is open or turned over at ({x:.3}, {y:.3}, {z:.3}) mm")]
    OpenEdge {
        /// Start of the edge, mm.
        x: f64,
        /// Start of the edge, mm.
        y: f64,
        /// Start of the edge, mm.
        z: f64,
    },
    /// Two sheets of the surface touch in one vertex.
    #[error("the surface touches itself at ({x:.3}, {y:.3}, {z:.3}) mm")]
    PinchedVertex {
        /// Where, mm.
        x: f64,
        /// Where, mm.
        y: f64,
        /// Where, mm.
        z: f64,
    },
    /// More than one body.
    #[error("somewhere it is too thin to hold together, and it has {bodies} bodies")]
    NotOneBody {
        /// Bodies found.
        bodies: usize,
    },
    /// The Euler number tells of more or fewer holes than the gear has.
    #[error("it has {found} holes instead of {expected}")]
    WrongGenus {
        /// Holes found.
        found: i64,
        /// Holes expected.
        expected: i64,
    },
    /// The volume is not base area times thickness (negative: turned inside out).
    #[error("its volume is {found:.4} mm^3 instead of {expected:.4} mm^3")]
    WrongVolume {
        /// Volume of the mesh, mm^3.
        found: f64,
        /// Volume expected, mm^3.
        expected: f64,
    },
}

/// Passes a mesh that is closed, consistently oriented with normals outward, two-manifold, one
/// body, of the expected genus, and of the expected volume within
/// [`policy::SOLID_VOLUME_ERROR`] (relative).
///
/// # Errors
/// The first [`Fault`] found, in the order of the enum.
pub fn check(mesh: &Mesh, expected: Expected) -> Result<(), Fault> {
    if mesh.triangles.is_empty() {
        return Err(Fault::Empty);
    }
    let count = mesh.positions.len();
    if let Some(vertex) = mesh.positions.iter().position(|p| p.iter().any(|c| !c.is_finite())) {
        return Err(Fault::BadVertex { vertex });
    }
    if let Some(&index) = mesh.triangles.iter().flatten().find(|&&i| i as usize >= count) {
        return Err(Fault::BadVertex { vertex: index as usize });
    }
    let opposite = mesh.opposites().map_err(|h| {
        let [x, y, z] = mesh.positions[mesh.triangles[h / 3][h % 3] as usize];
        Fault::OpenEdge { x, y, z }
    })?;
    let used = one_fan_per_vertex(mesh, &opposite)?;

    let mut sets = Sets::new(mesh.triangles.len());
    for (h, &o) in opposite.iter().enumerate() {
        sets.join(h / 3, o / 3);
    }
    let bodies = (0..mesh.triangles.len()).filter(|&t| sets.find(t) == t).count();
    if bodies != 1 {
        return Err(Fault::NotOneBody { bodies });
    }
    let edges = opposite.len() / 2;
    let euler = used as i64 - edges as i64 + mesh.triangles.len() as i64;
    let genus = (2 - euler) / 2;
    if genus != expected.genus {
        return Err(Fault::WrongGenus { found: genus, expected: expected.genus });
    }
    let volume = mesh.volume();
    if (volume - expected.volume).abs() > policy::SOLID_VOLUME_ERROR * expected.volume {
        return Err(Fault::WrongVolume { found: volume, expected: expected.volume });
    }
    Ok(())
}

/// Walks round each vertex once: all its triangles must be met. Returns how many vertices are used.
fn one_fan_per_vertex(mesh: &Mesh, opposite: &[usize]) -> Result<usize, Fault> {
    let mut around = vec![0_usize; mesh.positions.len()];
    let mut start = vec![usize::MAX; mesh.positions.len()];
    for (h, &vertex) in mesh.triangles.iter().flatten().enumerate() {
        around[vertex as usize] += 1;
        start[vertex as usize] = h;
    }
    for (vertex, &first) in start.iter().enumerate().filter(|&(_, &h)| h != usize::MAX) {
        let mut met = 0;
        let mut h = first;
        loop {
            met += 1;
            let previous = h / 3 * 3 + (h + 2) % 3;
            h = opposite[previous];
            if h == first {
                break;
            }
        }
        if met != around[vertex] {
            let [x, y, z] = mesh.positions[vertex];
            return Err(Fault::PinchedVertex { x, y, z });
        }
    }
    Ok(start.iter().filter(|&&h| h != usize::MAX).count())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The tetrahedron of the origin and the unit points; volume 1/6.
    fn tetrahedron() -> Mesh {
        Mesh {
            positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        }
    }

    const SIXTH: Expected = Expected { volume: 1.0 / 6.0, genus: 0 };

    /// `mesh` and a second tetrahedron that shares `shared` of its vertices' indices.
    fn twice(share_apex: bool) -> Mesh {
        let mut mesh = tetrahedron();
        let other = tetrahedron();
        mesh.positions.extend(other.positions.iter().map(|p| p.map(|c| -c)));
        let apex = |i: u32| if share_apex && i == 0 { 0 } else { i + 4 };
        // Mirrored through the origin, so the triangles must run the other way round.
        mesh.triangles.extend(other.triangles.iter().map(|&[a, b, c]| [apex(a), apex(c), apex(b)]));
        mesh
    }

    #[test]
    fn a_tetrahedron_is_sound() {
        assert_eq!(check(&tetrahedron(), SIXTH), Ok(()));
    }

    #[test]
    fn each_fault_is_found() {
        assert_eq!(check(&Mesh::default(), SIXTH), Err(Fault::Empty));

        let mut open = tetrahedron();
        open.triangles.pop();
        assert!(matches!(check(&open, SIXTH), Err(Fault::OpenEdge { .. })));

        let mut one_turned = tetrahedron();
        one_turned.triangles[2].reverse();
        assert!(matches!(check(&one_turned, SIXTH), Err(Fault::OpenEdge { .. })));

        let mut doubled = tetrahedron();
        doubled.triangles.extend(tetrahedron().triangles);
        assert!(matches!(check(&doubled, SIXTH), Err(Fault::OpenEdge { .. })));

        let mut inside_out = tetrahedron();
        inside_out.triangles.iter_mut().for_each(|t| t.reverse());
        assert!(matches!(check(&inside_out, SIXTH), Err(Fault::WrongVolume { .. })));

        let mut wild = tetrahedron();
        wild.positions[2][1] = f64::NAN;
        assert_eq!(check(&wild, SIXTH), Err(Fault::BadVertex { vertex: 2 }));
        let mut dangling = tetrahedron();
        dangling.triangles[0][0] = 9;
        assert_eq!(check(&dangling, SIXTH), Err(Fault::BadVertex { vertex: 9 }));

        let third = Expected { volume: 1.0 / 3.0, genus: 0 };
        assert_eq!(check(&twice(false), third), Err(Fault::NotOneBody { bodies: 2 }));
        assert!(matches!(check(&twice(true), third), Err(Fault::PinchedVertex { .. })));

        let bored = Expected { genus: 1, ..SIXTH };
        assert_eq!(check(&tetrahedron(), bored), Err(Fault::WrongGenus { found: 0, expected: 1 }));
    }
}
