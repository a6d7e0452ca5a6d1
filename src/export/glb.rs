//! Binary glTF: the gears as they turn, for viewers and Blender.

use super::{Artifact, Encode, EncodeError, Entry, Parts, keys::keys};
use crate::assembly::{Assembly, PlacedGear, Stance};
use crate::geometry::perimeter;
use crate::policy;
use crate::solid::{Mesh, shade};
use gltf_json as json;
use gltf_json::accessor::{ComponentType, GenericComponentType, Type};
use gltf_json::buffer::{Target, View};
use gltf_json::extras::RawValue;
use gltf_json::validation::{Checked::Valid, USize64};
use gltf_json::{Index, Root};
use std::borrow::Cow;
use std::f32::consts::FRAC_1_SQRT_2;
use std::f64::consts::TAU;
use std::io::{self, ErrorKind};

const METRES_PER_MM: f64 = 1e-3;
/// Linear RGB of the driver's and the followers' plastic.
const LIGHT_BLUE: [f32; 4] = [0.29, 0.58, 0.86, 1.0];
const DARK_BLUE: [f32; 4] = [0.03, 0.09, 0.29, 1.0];
/// That of base plates.
const GREY: [f32; 4] = [0.42, 0.42, 0.4, 1.0];
const ROUGHNESS: f32 = 0.55;
/// Sixths of a second are whole numbers of frames at 24 and at 30 a second.
const WHOLE_FRAMES: f64 = 6.0;

/// `pair.glb`: a named node per gear, in metres, y up as glTF wants it, turning through one whole
/// cycle; fixtures stand still as nodes of their own names. The extras of scene and asset hold tool, units, centre
/// distance (mm), ratio, module (mm) and teeth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glb {
    /// Time the driver takes for one turn, s.
    pub seconds_per_driver_turn: f64,
}

impl Default for Glb {
    fn default() -> Self {
        Self { seconds_per_driver_turn: policy::SECONDS_PER_DRIVER_TURN }
    }
}

/// See [`Entry`].
pub(super) const ENTRY: Entry = Entry {
    name: "glb",
    files: &[(
        &["pair.glb"],
        "Blender, browsers: both gears, animated by the transmission function",
    )],
    solid: true,
    encoders: |_| vec![Box::new(Glb::default())],
    ..Entry::PLAIN
};

impl Encode for Glb {
    fn encode<'a>(&'a self, parts: Parts<'a>) -> Result<Vec<Artifact<'a>>, EncodeError> {
        let bytes = self.bytes(parts).map_err(|why| EncodeError::new("pair.glb", why))?;
        Ok(vec![Artifact::bytes("pair.glb", bytes)])
    }
}

impl Glb {
    /// The file in memory.
    ///
    /// # Errors
    /// When the data outgrows the format.
    pub fn bytes(&self, parts: Parts<'_>) -> io::Result<Vec<u8>> {
        let mut scene = Builder::default();
        let mut nodes: Vec<_> =
            parts.iter().enumerate().map(|(i, (gear, mesh))| scene.gear(i, gear, mesh)).collect();
        scene.animate(parts.assembly, &nodes, self.seconds_per_driver_turn / TAU);
        for (fixture, mesh) in parts.fixtures() {
            let Stance { place, with } = fixture.stance;
            let at = place.translation.vector.map(|c| (METRES_PER_MM * c) as f32);
            let turn = place.rotation.coords.map(|c| c as f32);
            let turn = json::scene::UnitQuaternion(turn.into());
            let node = scene.part(&fixture.name, mesh, GREY, at.into(), Some(turn));
            // What turns with a gear hangs on its node.
            match with.and_then(|gear| nodes.get(gear)).copied() {
                Some(gear) => {
                    let carried = &mut scene.root.nodes[gear.value()].children;
                    carried.get_or_insert_default().push(node);
                }
                None => nodes.push(node),
            }
        }
        // A quarter turn about x takes the gears' z up to glTF's y up.
        let pair = scene.root.push(json::Node {
            name: Some("pair".to_owned()),
            children: Some(nodes),
            rotation: Some(json::scene::UnitQuaternion([-FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2])),
            ..Default::default()
        });
        let shown = json::Scene {
            extensions: None,
            extras: Some(RawValue::from_string(about(parts.assembly).to_string())?),
            name: Some("pair".to_owned()),
            nodes: vec![pair],
        };
        scene.root.scene = Some(scene.root.push(shown));
        scene.root.asset = json::Asset {
            generator: Some(concat!("centrode ", env!("CARGO_PKG_VERSION")).to_owned()),
            extras: Some(RawValue::from_string(about(parts.assembly).to_string())?),
            ..Default::default()
        };
        scene.finish()
    }
}

/// What a program that reads the file may want to know of the gears.
fn about(assembly: &Assembly) -> serde_json::Value {
    let distance = match assembly.gears.as_slice() {
        [first, second, ..] => Some((second.axis - first.axis).norm()),
        _ => None,
    };
    let turned = |g: &PlacedGear| g.angle.last().map_or(0.0, |a| a.abs());
    let driver = assembly.gears.first().map_or(0.0, turned);
    let gears: Vec<_> = assembly
        .gears
        .iter()
        .map(|g| {
            serde_json::json!({
                "name": g.gear.name,
                "teeth": g.gear.teeth,
                "axis_mm": [g.axis.x, g.axis.y],
            })
        })
        .collect();
    let module = assembly.gears.first().map(|g| {
        let teeth = std::f64::consts::PI * f64::from(g.gear.teeth);
        perimeter(&g.gear.pitch_curve) / teeth
    });
    let fixtures: Vec<&str> = assembly.fixtures.iter().map(|f| f.name.as_str()).collect();
    serde_json::json!({
        "tool": concat!("centrode ", env!("CARGO_PKG_VERSION")),
        "units": "mm",
        "module_mm": module,
        "thickness_mm": assembly.thickness,
        "fixtures": fixtures,
        "center_distance_mm": distance,
        // Whole turns over a closed cycle: rounded to get rid of the last bits.
        "ratio": assembly.gears.get(1).map(|g| (1e9 * driver / turned(g)).round() / 1e9),
        "gears": gears,
    })
}

#[derive(Default)]
struct Builder {
    root: Root,
    bin: Vec<u8>,
}

impl Builder {
    fn gear(&mut self, number: usize, placed: &PlacedGear, mesh: &Mesh) -> Index<json::Node> {
        let color = if number.is_multiple_of(2) { LIGHT_BLUE } else { DARK_BLUE };
        let place =
            [placed.axis.x, placed.axis.y, placed.level].map(|c| (METRES_PER_MM * c) as f32);
        let start = placed.angle.first().copied().unwrap_or(0.0);
        let turn = json::scene::UnitQuaternion(about_z(start));
        self.part(&placed.gear.name, mesh, color, place, Some(turn))
    }

    /// A node with a mesh and a material of its own.
    fn part(
        &mut self,
        name: &str,
        mesh: &Mesh,
        color: [f32; 4],
        place: [f32; 3],
        turn: Option<json::scene::UnitQuaternion>,
    ) -> Index<json::Node> {
        let shading = shade(mesh, policy::CREASE_ANGLE);
        let positions: Vec<[f32; 3]> = shading
            .vertices
            .iter()
            .map(|&v| mesh.positions[v as usize].map(|c| (METRES_PER_MM * c) as f32))
            .collect();
        let normals: Vec<[f32; 3]> = shading.normals.iter().map(|n| n.map(|c| c as f32)).collect();
        let points = Some(Valid(Target::ArrayBuffer));
        let positions = self.floats(&positions, Type::Vec3, points, true);
        let normals = self.floats(&normals, Type::Vec3, points, false);
        let indices = self.indices(&shading.corners);
        let material = self.material(color, name);
        let mesh = self.root.push(json::Mesh {
            extensions: None,
            extras: None,
            name: Some(name.to_owned()),
            primitives: vec![json::mesh::Primitive {
                attributes: [
                    (Valid(json::mesh::Semantic::Positions), positions),
                    (Valid(json::mesh::Semantic::Normals), normals),
                ]
                .into(),
                extensions: None,
                extras: None,
                indices: Some(indices),
                material: Some(material),
                mode: Valid(json::mesh::Mode::Triangles),
                targets: None,
            }],
            weights: None,
        });
        self.root.push(json::Node {
            name: Some(name.to_owned()),
            mesh: Some(mesh),
            translation: Some(place),
            rotation: turn,
            ..Default::default()
        })
    }

    fn material(&mut self, color: [f32; 4], part: &str) -> Index<json::Material> {
        use json::material::{PbrBaseColorFactor, PbrMetallicRoughness, StrengthFactor};
        self.root.push(json::Material {
            name: Some(format!("{part} plastic")),
            alpha_mode: Valid(json::material::AlphaMode::Opaque),
            pbr_metallic_roughness: PbrMetallicRoughness {
                base_color_factor: PbrBaseColorFactor(color),
                metallic_factor: StrengthFactor(0.0),
                roughness_factor: StrengthFactor(ROUGHNESS),
                ..Default::default()
            },
            ..Default::default()
        })
    }

    /// One rotation channel per gear over the whole cycle. The angles are continuous and the steps
    /// short, so neighbouring quaternions lie on one hemisphere by construction.
    fn animate(&mut self, assembly: &Assembly, nodes: &[Index<json::Node>], seconds: f64) {
        let keys = keys(assembly);
        if keys.len() < 2 || nodes.is_empty() {
            return;
        }
        // Programs count in frames: a clip that ends between two of them stutters where it begins again.
        let cycle = assembly.driver_angle.last().map_or(0.0, |angle| angle * seconds);
        let whole = ((cycle * WHOLE_FRAMES).round().max(1.0)) / WHOLE_FRAMES;
        let seconds = if cycle > 0.0 { seconds * whole / cycle } else { seconds };
        let times: Vec<[f32; 1]> =
            keys.iter().map(|&i| [(assembly.driver_angle[i] * seconds) as f32]).collect();
        let input = self.floats(&times, Type::Scalar, None, true);
        let (mut samplers, mut channels) = (Vec::new(), Vec::new());
        for (placed, &node) in assembly.gears.iter().zip(nodes) {
            let turns: Vec<[f32; 4]> = keys.iter().map(|&i| about_z(placed.angle[i])).collect();
            let output = self.floats(&turns, Type::Vec4, None, false);
            channels.push(json::animation::Channel {
                sampler: Index::new(samplers.len() as u32),
                target: json::animation::Target {
                    extensions: None,
                    extras: None,
                    node,
                    path: Valid(json::animation::Property::Rotation),
                },
                extensions: None,
                extras: None,
            });
            samplers.push(json::animation::Sampler {
                extensions: None,
                extras: None,
                input,
                interpolation: Valid(json::animation::Interpolation::Linear),
                output,
            });
        }
        self.root.push(json::Animation {
            extensions: None,
            extras: None,
            channels,
            name: Some("one cycle".to_owned()),
            samplers,
        });
    }

    fn floats<const N: usize>(
        &mut self,
        rows: &[[f32; N]],
        kind: Type,
        target: Option<json::validation::Checked<Target>>,
        bounded: bool,
    ) -> Index<json::Accessor> {
        let bytes = rows.iter().flatten().flat_map(|c| c.to_le_bytes()).collect();
        let bound = |pick: fn(f32, f32) -> f32| {
            let first = rows.first().copied().unwrap_or([0.0; N]);
            let all = rows.iter().fold(first, |m, r| std::array::from_fn(|i| pick(m[i], r[i])));
            bounded.then(|| json::Value::from(all.to_vec()))
        };
        let (min, max) = (bound(f32::min), bound(f32::max));
        self.accessor(bytes, rows.len(), ComponentType::F32, kind, target, (min, max))
    }

    fn indices(&mut self, triangles: &[[u32; 3]]) -> Index<json::Accessor> {
        let bytes = triangles.iter().flatten().flat_map(|i| i.to_le_bytes()).collect();
        let target = Some(Valid(Target::ElementArrayBuffer));
        let count = 3 * triangles.len();
        self.accessor(bytes, count, ComponentType::U32, Type::Scalar, target, (None, None))
    }

    fn accessor(
        &mut self,
        bytes: Vec<u8>,
        count: usize,
        component: ComponentType,
        kind: Type,
        target: Option<json::validation::Checked<Target>>,
        (min, max): (Option<json::Value>, Option<json::Value>),
    ) -> Index<json::Accessor> {
        // All components are four bytes wide, so every view starts aligned.
        let view = self.root.push(View {
            buffer: Index::new(0),
            byte_length: USize64::from(bytes.len()),
            byte_offset: Some(USize64::from(self.bin.len())),
            byte_stride: None,
            name: None,
            target,
            extensions: None,
            extras: None,
        });
        self.bin.extend(bytes);
        self.root.push(json::Accessor {
            buffer_view: Some(view),
            byte_offset: None,
            count: USize64::from(count),
            component_type: Valid(GenericComponentType(component)),
            extensions: None,
            extras: None,
            type_: Valid(kind),
            min,
            max,
            name: None,
            normalized: false,
            sparse: None,
        })
    }

    fn finish(mut self) -> io::Result<Vec<u8>> {
        self.root.push(json::Buffer {
            byte_length: USize64::from(self.bin.len()),
            name: None,
            uri: None,
            extensions: None,
            extras: None,
        });
        let glb = gltf::binary::Glb {
            header: gltf::binary::Header { magic: *b"glTF", version: 2, length: 0 },
            json: Cow::Owned(self.root.to_vec()?),
            bin: Some(Cow::Owned(self.bin)),
        };
        glb.to_vec().map_err(|e| io::Error::new(ErrorKind::InvalidData, e))
    }
}

/// The unit quaternion (x, y, z, w) of a turn about z by `angle` radians; continuous in the angle.
fn about_z(angle: f64) -> [f32; 4] {
    let (s, c) = (0.5 * angle).sin_cos();
    [0.0, 0.0, s as f32, c as f32]
}

#[cfg(test)]
mod tests {
    use super::super::tests::{base, wavy_pair};
    use super::*;

    /// The rows of a float accessor.
    fn rows(accessor: &gltf::Accessor<'_>, buffers: &[gltf::buffer::Data]) -> Vec<Vec<f32>> {
        let view = accessor.view().unwrap();
        let bytes = &buffers[view.buffer().index()][view.offset()..][..view.length()];
        let numbers: Vec<f32> =
            bytes.chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect();
        let rows: Vec<_> =
            numbers.chunks(accessor.dimensions().multiplicity()).map(<[f32]>::to_vec).collect();
        assert_eq!(rows.len(), accessor.count());
        rows
    }

    #[test]
    fn it_imports_with_nodes_materials_and_motion() {
        let (assembly, meshes) = wavy_pair();
        let parts = Parts { assembly: &assembly, meshes: &meshes };
        let bytes = Glb::default().bytes(parts).unwrap();
        // `import_slice` validates the document too.
        let (document, buffers, _) = gltf::import_slice(&bytes).unwrap();

        let pair = document.scenes().next().unwrap().nodes().next().unwrap();
        let names: Vec<_> = pair.children().map(|n| n.name().unwrap().to_owned()).collect();
        assert_eq!(names, ["driver", "follower"]);
        let up = nalgebra::Quaternion::from(pair.transform().decomposed().1);
        let up = nalgebra::Unit::new_normalize(up) * nalgebra::Vector3::z();
        assert!((up - nalgebra::Vector3::y()).norm() < 1e-6);
        assert_eq!(document.materials().len(), 2);

        for (node, mesh) in pair.children().zip(&meshes) {
            let primitive = node.mesh().unwrap().primitives().next().unwrap();
            assert_eq!(primitive.indices().unwrap().count(), 3 * mesh.triangles.len());
            let normals = rows(&primitive.get(&gltf::Semantic::Normals).unwrap(), &buffers);
            let length = |n: &Vec<f32>| n.iter().map(|c| c * c).sum::<f32>().sqrt();
            assert!(normals.iter().all(|n| (length(n) - 1.0).abs() < 1e-5));
            let positions = rows(&primitive.get(&gltf::Semantic::Positions).unwrap(), &buffers);
            let highest = positions.iter().map(|p| p[2]).fold(0.0, f32::max);
            assert_eq!(highest, 0.006);
        }
    }

    #[test]
    fn its_animation_follows_the_motion_within_a_hundredth_of_a_degree() {
        let (assembly, meshes) = wavy_pair();
        let parts = Parts { assembly: &assembly, meshes: &meshes };
        let bytes = Glb::default().bytes(parts).unwrap();
        let (document, buffers, _) = gltf::import_slice(&bytes).unwrap();
        let animation = document.animations().next().unwrap();
        for (channel, placed) in animation.channels().zip(&assembly.gears) {
            assert_eq!(channel.target().node().name(), Some(placed.gear.name.as_str()));
            let sampler = channel.sampler();
            let times: Vec<f64> =
                rows(&sampler.input(), &buffers).iter().map(|t| f64::from(t[0])).collect();
            let turns = rows(&sampler.output(), &buffers);
            assert!((times.last().unwrap() - 6.0).abs() < 1e-6);
            for (&driver, &angle) in assembly.driver_angle.iter().zip(&placed.angle) {
                let now = (driver / TAU * 6.0).min(*times.last().unwrap());
                let k = times.partition_point(|&t| t < now).clamp(1, times.len() - 1);
                let along = (now - times[k - 1]) / (times[k] - times[k - 1]);
                let [a, b] = [&turns[k - 1], &turns[k]]
                    .map(|q| 2.0 * f64::from(q[2]).atan2(f64::from(q[3])));
                let turn = (b - a + 3.0 * TAU / 2.0).rem_euclid(TAU) - TAU / 2.0;
                let shown = a + along * turn;
                let off = (shown - angle + 2.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
                assert!(off.to_degrees().abs() < 0.0105, "{} at {now}", off.to_degrees());
            }
        }
    }

    #[test]
    fn a_clip_is_whole_frames_long_at_24_and_at_30() {
        let (mut assembly, meshes) = wavy_pair();
        // A part of a turn, as of sectors.
        assembly.driver_angle.iter_mut().for_each(|a| *a *= 0.437);
        let parts = Parts { assembly: &assembly, meshes: &meshes };
        let (document, buffers, _) =
            gltf::import_slice(Glb::default().bytes(parts).unwrap()).unwrap();
        let sampler = document.animations().next().unwrap().channels().next().unwrap().sampler();
        let last = rows(&sampler.input(), &buffers).last().unwrap()[0];
        for rate in [24.0, 30.0] {
            let frames = last * rate;
            assert!((frames - frames.round()).abs() < 1e-4 && frames > 60.0, "{frames}");
        }
    }

    #[test]
    fn a_knob_hangs_on_its_gear() {
        let (mut assembly, mut meshes) = wavy_pair();
        let mut knob = base();
        knob.name = "knob".to_owned();
        knob.stance = Stance::flat(6.0).turning_with(1);
        meshes.push(crate::solid::fixture_solid(&knob).unwrap());
        assembly.fixtures.push(knob);
        let parts = Parts { assembly: &assembly, meshes: &meshes };
        let (document, ..) = gltf::import_slice(Glb::default().bytes(parts).unwrap()).unwrap();
        let gear = document.nodes().find(|n| n.name() == Some("follower")).unwrap();
        assert_eq!(
            gear.children().map(|n| n.name().unwrap().to_owned()).collect::<Vec<_>>(),
            ["knob"]
        );
    }

    #[test]
    fn a_base_stands_still_below_the_gears() {
        let (mut assembly, mut meshes) = wavy_pair();
        assembly.fixtures.push(base());
        meshes.push(crate::solid::fixture_solid(&assembly.fixtures[0]).unwrap());
        let parts = Parts { assembly: &assembly, meshes: &meshes };
        let (document, buffers, _) =
            gltf::import_slice(Glb::default().bytes(parts).unwrap()).unwrap();
        let node = document.nodes().find(|n| n.name() == Some("base")).unwrap();
        assert!(
            document
                .animations()
                .next()
                .unwrap()
                .channels()
                .all(|c| c.target().node().index() != node.index())
        );
        let height = node.transform().decomposed().0[2];
        let primitive = node.mesh().unwrap().primitives().next().unwrap();
        let positions = rows(&primitive.get(&gltf::Semantic::Positions).unwrap(), &buffers);
        let top = positions.iter().map(|p| p[2] + height).fold(f32::MIN, f32::max);
        assert!((top + 0.001).abs() < 1e-7, "{top}");
    }

    #[test]
    fn it_carries_distance_ratio_and_teeth() {
        let (assembly, meshes) = wavy_pair();
        let bytes = Glb::default().bytes(Parts { assembly: &assembly, meshes: &meshes }).unwrap();
        let glb = gltf::binary::Glb::from_slice(&bytes).unwrap();
        let document: serde_json::Value = serde_json::from_slice(&glb.json).unwrap();
        let extras = &document["asset"]["extras"];
        assert_eq!(extras["center_distance_mm"], 80.0);
        assert_eq!(extras["ratio"], 1.0);
        assert_eq!(extras["gears"][1]["teeth"], 16);
        assert_eq!(document["scenes"][0]["extras"], *extras);
        let module = perimeter(&assembly.gears[0].gear.pitch_curve) / (16.0 * TAU / 2.0);
        assert!((extras["module_mm"].as_f64().unwrap() - module).abs() < 1e-9);
    }
}
