//! STL for slicers: binary, one file per part.

use super::{Artifact, Encode, EncodeError, Entry, Parts};
use crate::solid::Mesh;

/// `<part>.stl` for each gear and each fixture, such as `base.stl`, in the part's own frame, mm (STL itself has no unit).
#[derive(Clone, Copy, Debug, Default)]
pub struct Stl;

/// See [`Entry`].
pub(super) const ENTRY: Entry = Entry {
    name: "stl",
    files: &[(&["driver.stl", "follower.stl"], "slicers; `base.stl` with `--base`")],
    solid: true,
    encoders: |_| vec![Box::new(Stl)],
    ..Entry::PLAIN
};

impl Encode for Stl {
    fn encode<'a>(&'a self, parts: Parts<'a>) -> Result<Vec<Artifact<'a>>, EncodeError> {
        let gears = parts.iter().map(|(placed, mesh)| (&placed.gear.name, mesh));
        let fixtures = parts.fixtures().map(|(fixture, mesh)| (&fixture.name, mesh));
        let artifact = |(name, mesh): (&'a String, &'a Mesh)| {
            Artifact::stream(format!("{name}.stl"), move |mut out| {
                let facets: Vec<stl_io::Triangle> = mesh
                    .triangles
                    .iter()
                    .map(|&t| stl_io::Triangle {
                        normal: stl_io::Normal::new(unit(mesh.area_normal(t))),
                        vertices: mesh.corners(t).map(|p| stl_io::Vertex::new(p.map(|c| c as f32))),
                    })
                    .collect();
                stl_io::write_stl(&mut out, facets.iter())
            })
        };
        Ok(gears.chain(fixtures).map(artifact).collect())
    }
}

/// Zero for a triangle without area, which the format allows: readers then use the corners.
fn unit(v: [f64; 3]) -> [f32; 3] {
    let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
    if length > 0.0 { v.map(|c| (c / length) as f32) } else { [0.0; 3] }
}

#[cfg(test)]
mod tests {
    use super::super::tests::wavy_pair;
    use super::*;
    use crate::solid::{Expected, check};

    #[test]
    fn what_is_read_back_is_the_sound_solid() {
        let (assembly, meshes) = wavy_pair();
        let folder = tempfile::tempdir().unwrap();
        let parts = Parts { assembly: &assembly, meshes: &meshes };
        for (path, mesh) in Stl.write(parts, folder.path()).unwrap().iter().zip(&meshes) {
            // The reader joins equal corners; closed after that means closed for a slicer.
            let read = stl_io::read_stl(&mut std::fs::File::open(path).unwrap()).unwrap();
            let again = Mesh {
                positions: read.vertices.iter().map(|v| v.0.map(f64::from)).collect(),
                triangles: read.faces.iter().map(|f| f.vertices.map(|i| i as u32)).collect(),
            };
            assert_eq!(again.positions.len(), mesh.positions.len());
            let expected = Expected { volume: mesh.volume(), genus: 1 };
            assert_eq!(check(&again, expected), Ok(()));
        }
    }
}
