//! Wavefront OBJ: all parts in one file, standing in mesh.

use super::contours::color;
use super::{Artifact, Encode, EncodeError, Entry, Parts};
use crate::policy;
use crate::solid::{Mesh, shade};
use nalgebra::{Isometry3, Point3, Vector3};
use obj_exporter::{Geometry, ObjSet, Object, Primitive, Shape, Vertex};
use std::fmt::Write as _;

/// `pair.obj`: one object per part in the first pose of the motion, mm, six decimals, with normals; `pair.mtl`: a material
/// for each, in the part's colour.
#[derive(Clone, Copy, Debug, Default)]
pub struct Obj;

/// See [`Entry`].
pub(super) const ENTRY: Entry = Entry {
    name: "obj",
    files: &[(&["pair.obj", MATERIALS], "modelling programs; a material a part")],
    solid: true,
    encoders: |_| vec![Box::new(Obj)],
    ..Entry::PLAIN
};

impl Encode for Obj {
    fn encode<'a>(&'a self, parts: Parts<'a>) -> Result<Vec<Artifact<'a>>, EncodeError> {
        let solids = Artifact::stream("pair.obj", move |out| {
            let set = ObjSet { material_library: None, objects: objects(parts) };
            let mut plain = Vec::new();
            obj_exporter::export(&set, &mut plain)?;
            // The crate leaves materials out: the library goes before everything, each name after its object's.
            writeln!(out, "mtllib {MATERIALS}")?;
            for line in plain.split_inclusive(|byte| *byte == b'\n') {
                out.write_all(line)?;
                if let Some(name) = line.strip_prefix(b"o ") {
                    writeln!(out, "usemtl {}", word(String::from_utf8_lossy(name).trim()))?;
                }
            }
            Ok(())
        });
        Ok(vec![solids, Artifact::bytes(MATERIALS, materials(parts))])
    }
}

/// The file of materials that the objects name.
const MATERIALS: &str = "pair.mtl";

/// Names in these files end at a blank.
fn word(name: &str) -> String {
    name.replace(char::is_whitespace, "_")
}

/// A matt material for each part.
fn materials(parts: Parts<'_>) -> String {
    let gears = parts.iter().enumerate().map(|(i, (g, _))| (&g.gear.name, color(i)));
    let fixtures = parts.fixtures().map(|(f, _)| (&f.name, policy::FIXTURE_COLOR));
    let mut text = String::from("# Materials of pair.obj\n");
    for (name, rgb) in gears.chain(fixtures) {
        let [r, g, b] = rgb.map(|c| f64::from(c) / 255.0);
        let _ = write!(
            text,
            "\nnewmtl {}\nKd {r:.4} {g:.4} {b:.4}\nKa 0 0 0\nKs 0.04 0.04 0.04\nNs 40\nd 1\nillum 2\n",
            word(name)
        );
    }
    text
}

fn objects(parts: Parts<'_>) -> Vec<Object> {
    let vertex = |[x, y, z]: [f64; 3]| Vertex { x, y, z };
    let object = |name: &str, mesh: &Mesh, place: Isometry3<f64>| {
        let shading = shade(mesh, policy::CREASE_ANGLE);
        let moved = |p: &[f64; 3]| vertex((place * Point3::from(*p)).into());
        let turned = |n: &[f64; 3]| vertex((place.rotation * Vector3::from(*n)).into());
        let faces = mesh.triangles.iter().zip(&shading.corners).map(|(t, n)| {
            let [a, b, c] = [0, 1, 2].map(|k| (t[k] as usize, None, Some(n[k] as usize)));
            Shape {
                primitive: Primitive::Triangle(a, b, c),
                groups: Vec::new(),
                smoothing_groups: Vec::new(),
            }
        });
        Object {
            name: name.to_owned(),
            vertices: mesh.positions.iter().map(moved).collect(),
            tex_vertices: Vec::new(),
            normals: shading.normals.iter().map(turned).collect(),
            geometry: vec![Geometry { material_name: None, shapes: faces.collect() }],
        }
    };
    let assembly = parts.assembly;
    let gears = parts
        .iter()
        .enumerate()
        .map(|(i, (placed, mesh))| object(&placed.gear.name, mesh, assembly.first_pose(i)));
    let fixtures = parts.fixtures().map(|(f, mesh)| object(&f.name, mesh, assembly.pose_of(f)));
    gears.chain(fixtures).collect()
}

#[cfg(test)]
mod tests {
    use super::super::tests::wavy_pair;
    use super::*;
    use crate::solid::{Expected, check};

    #[test]
    fn both_gears_read_back_sound_and_in_place() {
        let (assembly, meshes) = wavy_pair();
        let folder = tempfile::tempdir().unwrap();
        let parts = Parts { assembly: &assembly, meshes: &meshes };
        let path = Obj.write(parts, folder.path()).unwrap().remove(0);
        let text = std::fs::read_to_string(path).unwrap();
        let mut read: Vec<(String, Mesh)> = Vec::new();
        let mut before = 0;
        for line in text.lines() {
            let mut words = line.split_whitespace();
            let kind = words.next().unwrap_or_default();
            let rest: Vec<&str> = words.collect();
            match kind {
                "o" => {
                    before += read.last().map_or(0, |(_, m)| m.positions.len());
                    read.push((rest[0].to_owned(), Mesh::default()));
                }
                "v" => {
                    let p = [0, 1, 2].map(|k| rest[k].parse::<f64>().unwrap());
                    read.last_mut().unwrap().1.positions.push(p);
                }
                "f" => {
                    let index = |k: usize| {
                        let (v, _) = rest[k].split_once("//").unwrap();
                        (v.parse::<usize>().unwrap() - 1 - before) as u32
                    };
                    read.last_mut().unwrap().1.triangles.push([0, 1, 2].map(index));
                }
                _ => {}
            }
        }
        assert_eq!(read.len(), 2);
        // Every material that is used is in the library that is named.
        let library = std::fs::read_to_string(folder.path().join("pair.mtl")).unwrap();
        assert!(text.contains("mtllib pair.mtl"));
        for used in text.lines().filter_map(|l| l.strip_prefix("usemtl ")) {
            assert!(library.contains(&format!("newmtl {}\n", used.trim())), "{used}");
        }
        assert_eq!(text.matches("usemtl").count(), 2);
        for (((name, mesh), original), placed) in read.iter().zip(&meshes).zip(&assembly.gears) {
            assert_eq!(*name, placed.gear.name);
            let expected = Expected { volume: original.volume(), genus: 1 };
            assert_eq!(check(mesh, expected), Ok(()));
            let low = mesh.positions.iter().map(|p| p[0]).fold(f64::INFINITY, f64::min);
            assert!((low - (placed.axis.x - 42.5)).abs() < 0.2, "{low}");
        }
    }
}
