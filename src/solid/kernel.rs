//! The one file that names the Manifold kernels: the C++ library by default,
//! its pure-Rust port when the feature `pure-rust` is on (also beside the other).

use super::Mesh;
use crate::geometry::{self, Point};

#[cfg(not(any(feature = "manifold-cpp", feature = "pure-rust")))]
compile_error!("solids need a kernel: turn on the feature `manifold-cpp` or `pure-rust`");

/// A solid held by the Manifold kernel. Empty where the kernel refused its input.
///
/// Coordinates in mm. Does not cross threads with the C++ kernel.
pub struct Solid(backend::Manifold);

impl std::fmt::Debug for Solid {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Solid").field("empty", &self.is_empty()).finish_non_exhaustive()
    }
}

impl Solid {
    /// The prism over `outer` less `holes` from z = 0 to `height` (mm), whichever way the rings run.
    ///
    /// Coordinates must be finite, rings simple, holes inside and apart; the kernel does not say
    /// when they are not, so [`super::check`] what comes out.
    #[must_use]
    pub fn extrude(outer: &[Point], holes: &[Vec<Point>], height: f64) -> Self {
        let mut rings = vec![turned(outer, true)];
        rings.extend(holes.iter().map(|hole| turned(hole, false)));
        Self(backend::extrude(&rings, height))
    }

    /// The solid inside a closed mesh, whose coordinates are taken in single precision; empty where the
    /// kernel finds the mesh unsound.
    #[must_use]
    pub fn from_mesh(mesh: &Mesh) -> Self {
        Self(backend::from_mesh(mesh))
    }

    /// Both solids as one.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self(self.0.union(&other.0))
    }

    /// All solids as one, joined two by two in their order (neighbours first) so that no
    /// intermediate result is cut more than log2(n) times; empty for no solids.
    #[must_use]
    pub fn union_all(mut solids: Vec<Self>) -> Self {
        while solids.len() > 1 {
            let mut rest = solids.into_iter();
            let mut joined = Vec::with_capacity(rest.len().div_ceil(2));
            while let Some(first) = rest.next() {
                joined.push(match rest.next() {
                    Some(second) => first.union(&second).settled(),
                    None => first,
                });
            }
            solids = joined;
        }
        solids.pop().unwrap_or_else(|| Self(backend::Manifold::empty()))
    }

    /// This solid less the other.
    #[must_use]
    pub fn subtract(&self, other: &Self) -> Self {
        Self(self.0.difference(&other.0))
    }

    /// What both solids share.
    #[must_use]
    pub fn intersect(&self, other: &Self) -> Self {
        Self(self.0.intersection(&other.0))
    }

    /// Moved by `x`, `y`, `z`, mm.
    #[must_use]
    pub fn translate(&self, x: f64, y: f64, z: f64) -> Self {
        Self(backend::translate(&self.0, x, y, z))
    }

    /// Turned about the z axis by `angle` radians, counter-clockwise.
    #[must_use]
    pub fn rotate_z(&self, angle: f64) -> Self {
        Self(self.0.rotate(0.0, 0.0, angle.to_degrees()))
    }

    /// Laid down: what pointed along z points along x, what along x now along -z.
    #[must_use]
    pub fn laid_along_x(&self) -> Self {
        Self(self.0.rotate(0.0, 90.0, 0.0))
    }

    /// Whether there is nothing in it.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The surface. Positions carry single precision from the C++ kernel.
    #[must_use]
    pub fn mesh(&self) -> Mesh {
        backend::mesh(&self.0)
    }

    /// The rings in which the plane z = `height` cuts the solid, in double precision:
    /// counter-clockwise round material, clockwise round holes.
    #[must_use]
    pub fn slice(&self, height: f64) -> Vec<Vec<Point>> {
        // The C++ kernel crashes when it slices nothing.
        if self.is_empty() {
            return Vec::new();
        }
        backend::slice(&self.0, height)
    }

    /// Makes a lazy kernel do its work now: a question about the result is the only way to ask.
    #[must_use]
    pub fn settled(self) -> Self {
        let _ = self.is_empty();
        self
    }
}

fn turned(ring: &[Point], counter_clockwise: bool) -> Vec<Point> {
    let mut ring = ring.to_vec();
    if (geometry::signed_area(&ring) > 0.0) != counter_clockwise {
        ring.reverse();
    }
    ring
}

#[cfg(not(feature = "pure-rust"))]
mod backend {
    use super::{Mesh, Point};
    pub(super) use manifold_rs::Manifold;

    pub(super) fn extrude(rings: &[Vec<Point>], height: f64) -> Manifold {
        let flat: Vec<Vec<f64>> =
            rings.iter().map(|ring| ring.iter().flat_map(|p| [p.x, p.y]).collect()).collect();
        let slices: Vec<&[f64]> = flat.iter().map(Vec::as_slice).collect();
        Manifold::extrude(&slices, height, 0, 0.0, 1.0, 1.0)
    }

    pub(super) fn translate(solid: &Manifold, x: f64, y: f64, z: f64) -> Manifold {
        solid.translate(x, y, z)
    }

    pub(super) fn from_mesh(mesh: &Mesh) -> Manifold {
        let positions: Vec<f32> = mesh.positions.iter().flatten().map(|&c| c as f32).collect();
        let triangles: Vec<u32> = mesh.triangles.iter().flatten().copied().collect();
        manifold_rs::Mesh::new(&positions, &triangles).to_manifold()
    }

    pub(super) fn mesh(solid: &Manifold) -> Mesh {
        let mesh = solid.to_mesh();
        let stride = (mesh.num_props() as usize).max(3);
        Mesh {
            positions: mesh
                .vertices()
                .chunks_exact(stride)
                .map(|v| [v[0], v[1], v[2]].map(f64::from))
                .collect(),
            triangles: mesh.indices().chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
        }
    }

    pub(super) fn slice(solid: &Manifold, height: f64) -> Vec<Vec<Point>> {
        let rings = solid.slice(height);
        (0..rings.size())
            .map(|i| {
                rings.get_as_slice(i).chunks_exact(2).map(|p| Point::new(p[0], p[1])).collect()
            })
            .collect()
    }
}

#[cfg(feature = "pure-rust")]
mod backend {
    use super::{Mesh, Point};
    use manifold_rust::linalg::{Vec2, Vec3};
    pub(super) use manifold_rust::manifold::Manifold;
    use manifold_rust::types::MeshGL64;

    pub(super) fn extrude(rings: &[Vec<Point>], height: f64) -> Manifold {
        let rings =
            rings.iter().map(|ring| ring.iter().map(|p| Vec2::new(p.x, p.y)).collect()).collect();
        Manifold::extrude(&rings, height, 0, 0.0, Vec2::new(1.0, 1.0))
    }

    pub(super) fn translate(solid: &Manifold, x: f64, y: f64, z: f64) -> Manifold {
        solid.translate(Vec3::new(x, y, z))
    }

    pub(super) fn from_mesh(mesh: &Mesh) -> Manifold {
        let single = |&c: &f64| f64::from(c as f32);
        Manifold::from_mesh_gl64(&MeshGL64 {
            num_prop: 3,
            vert_properties: mesh.positions.iter().flatten().map(single).collect(),
            tri_verts: mesh.triangles.iter().flatten().map(|&i| u64::from(i)).collect(),
            ..MeshGL64::default()
        })
    }

    pub(super) fn mesh(solid: &Manifold) -> Mesh {
        let mesh = solid.get_mesh_gl64(0);
        let stride = (mesh.num_prop as usize).max(3);
        Mesh {
            positions: mesh
                .vert_properties
                .chunks_exact(stride)
                .map(|v| [v[0], v[1], v[2]])
                .collect(),
            triangles: mesh
                .tri_verts
                .chunks_exact(3)
                .map(|t| [t[0] as u32, t[1] as u32, t[2] as u32])
                .collect(),
        }
    }

    pub(super) fn slice(solid: &Manifold, height: f64) -> Vec<Vec<Point>> {
        // `Manifold::slice` would snap the rings to a grid of 1e-8.
        let rings = solid.as_impl().slice(height);
        rings.iter().map(|ring| ring.iter().map(|p| Point::new(p.x, p.y)).collect()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(half: f64) -> Vec<Point> {
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(x, y)| Point::new(half * x, half * y))
            .to_vec()
    }

    #[test]
    fn prisms_have_the_volume_of_their_base_times_height() {
        let mut clockwise = square(2.0);
        clockwise.reverse();
        let solid = Solid::extrude(&clockwise, &[square(1.0)], 3.0);
        assert!((solid.mesh().volume() - 36.0).abs() < 1e-9);
        assert!(Solid::extrude(&square(2.0), &[], -1.0).is_empty());
    }

    #[test]
    fn booleans_and_moves_agree_with_the_measures_of_cubes() {
        let cube = Solid::extrude(&square(1.0), &[], 2.0);
        let moved = cube.translate(1.0, 1.0, 1.0);
        let volume = |s: Solid| s.mesh().volume();
        assert!((volume(cube.union(&moved)) - 15.0).abs() < 1e-6);
        assert!((volume(cube.intersect(&moved)) - 1.0).abs() < 1e-6);
        assert!((volume(cube.subtract(&moved)) - 7.0).abs() < 1e-6);
        let turned = cube.rotate_z(std::f64::consts::FRAC_PI_4);
        let octagon = 8.0 * (2.0_f64.sqrt() - 1.0); // regular, of inradius 1
        assert!((volume(cube.intersect(&turned)) - 2.0 * octagon).abs() < 1e-6);
    }

    #[test]
    fn a_slice_gives_material_and_hole_back() {
        let rings = Solid::extrude(&square(2.0), &[square(1.0)], 3.0).slice(1.5);
        let mut areas: Vec<f64> = rings.iter().map(|r| geometry::signed_area(r)).collect();
        areas.sort_by(f64::total_cmp);
        assert_eq!(areas.len(), 2);
        assert!((areas[0] + 4.0).abs() < 1e-9 && (areas[1] - 16.0).abs() < 1e-9);
        let nothing = Solid::union_all(Vec::new());
        assert!(nothing.slice(1.0).is_empty() && nothing.mesh().triangles.is_empty());
        let solid = Solid::extrude(&square(2.0), &[], 3.0);
        assert!(solid.slice(7.0).is_empty());
    }

    #[test]
    fn a_union_of_many_joins_all() {
        let cube = Solid::extrude(&square(0.5), &[], 1.0);
        let row = (0..7).map(|i| cube.translate(f64::from(i) * 0.5, 0.0, 0.0)).collect();
        assert!((Solid::union_all(row).mesh().volume() - 4.0).abs() < 1e-6);
        assert!(Solid::union_all(Vec::new()).is_empty());
    }
}
