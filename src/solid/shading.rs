//! Normals for pictures: smooth along flanks, split at edges.

use super::Mesh;
use super::mesh::{Sets, dot, length, minus};
use crate::policy;

/// Normals of a mesh, split where it bends sharply.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shading {
    /// Unit normals; each belongs to one vertex of the mesh.
    pub normals: Vec<[f64; 3]>,
    /// The mesh vertex of each normal.
    pub vertices: Vec<u32>,
    /// For each triangle the index into `normals` of its three corners.
    pub corners: Vec<[u32; 3]>,
}

/// Normals that vary smoothly over edges bending less than `crease` radians and break at the others.
///
/// At each vertex the triangles of one smooth patch share the mean of their normals weighted by
/// their angle there, so the result does not depend on the triangulation of flat faces.
/// The mesh must be closed ([`super::check`]); of any other only the facets' own normals come back.
#[must_use]
pub fn shade(mesh: &Mesh, crease: f64) -> Shading {
    let opposite = mesh.opposites().unwrap_or_default();
    let facets = facet_normals(mesh, &opposite);
    let mut patches = Sets::new(3 * mesh.triangles.len());
    for (h, &o) in opposite.iter().enumerate().filter(|&(h, &o)| h < o) {
        if dot(facets[h / 3], facets[o / 3]) >= crease.cos() {
            // The half-edge h starts where o ends.
            patches.join(h, next(o));
            patches.join(next(h), o);
        }
    }
    let mut sums = vec![[0.0; 3]; 3 * mesh.triangles.len()];
    for (t, &triangle) in mesh.triangles.iter().enumerate() {
        for k in 0..3 {
            let weight = corner_angle(mesh.corners(triangle), k);
            let sum = &mut sums[patches.find(3 * t + k)];
            (0..3).for_each(|i| sum[i] += weight * facets[t][i]);
        }
    }
    let mut shading = Shading::default();
    let mut index = vec![u32::MAX; sums.len()];
    for (t, &triangle) in mesh.triangles.iter().enumerate() {
        let corners = [0, 1, 2].map(|k| {
            let patch = patches.find(3 * t + k);
            if index[patch] == u32::MAX {
                index[patch] = shading.normals.len() as u32;
                shading.normals.push(unit(sums[patch]).unwrap_or(facets[t]));
                shading.vertices.push(triangle[k]);
            }
            index[patch]
        });
        shading.corners.push(corners);
    }
    shading
}

fn next(h: usize) -> usize {
    h / 3 * 3 + (h + 1) % 3
}

fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let size = length(v);
    (size > f64::MIN_POSITIVE).then(|| v.map(|c| c / size))
}

fn corner_angle(corners: [[f64; 3]; 3], k: usize) -> f64 {
    let (a, b) = (minus(corners[(k + 1) % 3], corners[k]), minus(corners[(k + 2) % 3], corners[k]));
    let cosine = dot(a, b) / (length(a) * length(b));
    if cosine.is_nan() { 0.0 } else { cosine.clamp(-1.0, 1.0).acos() }
}

/// Unit normals of the triangles. One too thin to have a direction takes that of the neighbour
/// across its longest edge, which lies on the same face.
fn facet_normals(mesh: &Mesh, opposite: &[usize]) -> Vec<[f64; 3]> {
    let size = mesh.positions.iter().flatten().fold(0.0_f64, |m, c| m.max(c.abs()));
    let longest = |t: usize| {
        let p = mesh.corners(mesh.triangles[t]);
        let span = |k: usize| length(minus(p[(k + 1) % 3], p[k]));
        let k = (0..3).max_by(|&i, &j| span(i).total_cmp(&span(j))).unwrap_or(0);
        (3 * t + k, span(k))
    };
    let own: Vec<Option<[f64; 3]>> = (0..mesh.triangles.len())
        .map(|t| {
            let normal = mesh.area_normal(mesh.triangles[t]);
            let thick = length(normal) > policy::SOLID_SLIVER * size * longest(t).1;
            if thick { unit(normal) } else { None }
        })
        .collect();
    (0..mesh.triangles.len())
        .map(|first| {
            let mut t = first;
            // Slivers come in short chains; a ring of them has no direction to find.
            for _ in 0..mesh.triangles.len() {
                match (own[t], opposite.get(longest(t).0)) {
                    (Some(normal), _) => return normal,
                    (None, Some(&o)) if o / 3 != first => t = o / 3,
                    (None, _) => break,
                }
            }
            [0.0, 0.0, 1.0]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::gear::tests::wavy;
    use super::super::{Bore, gear_solid};
    use super::*;

    #[test]
    fn caps_are_flat_and_flanks_smooth() {
        let gear = wavy("driver", 800, Bore::None);
        let mesh = gear_solid(&gear, 6.0).unwrap();
        let shading = shade(&mesh, policy::CREASE_ANGLE);
        // Each vertex lies on one cap and on the flank: two normals, no more.
        assert_eq!(shading.normals.len(), 2 * mesh.positions.len());
        for normal in &shading.normals {
            assert!((length(*normal) - 1.0).abs() < 1e-12);
            assert!(normal[2].abs() == 1.0 || normal[2].abs() < 1e-6, "{normal:?}");
        }
        // On r = a + b cos n t the outward normal leans by atan(r'/r) from the radius.
        for (normal, &v) in shading.normals.iter().zip(&shading.vertices) {
            if normal[2].abs() < 0.5 {
                let [x, y, _] = mesh.positions[v as usize];
                let (t, r) = (y.atan2(x), x.hypot(y));
                let lean = (-16.0 * 2.5 * (16.0 * t).sin() / r).atan();
                let expected = [(t - lean).cos(), (t - lean).sin(), 0.0];
                assert!(dot(*normal, expected) > 0.02_f64.cos(), "{normal:?} {expected:?}");
            }
        }
    }

    #[test]
    fn a_cube_keeps_all_its_edges() {
        let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let square = square.map(|(x, y)| crate::geometry::Point::new(x, y));
        let mesh = super::super::Solid::extrude(&square, &[], 1.0).mesh();
        let shading = shade(&mesh, policy::CREASE_ANGLE);
        assert_eq!(shading.normals.len(), 24);
        assert!(shading.normals.iter().all(|n| n.iter().filter(|c| c.abs() == 1.0).count() == 1));
    }
}
