//! 3MF for slicers: units, names, colours and places that STL cannot hold.

use super::contours::color;
use super::render::{Shown, picture};
use super::xml::escaped;
use super::{Artifact, Encode, EncodeError, Entry, Parts, Plate};
use crate::assembly::Assembly;
use crate::policy;
use crate::solid::Mesh;
use nalgebra::{Isometry3, Point3, Translation3, Vector3};
use std::fmt::Write as _;
use std::io::{self, Seek, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

/// `pair.3mf`: one named, coloured object per part in millimetres, standing in mesh, moved as a whole
/// so that nothing lies at negative coordinates; a small picture for file managers.
#[derive(Clone, Copy, Debug, Default)]
pub struct ThreeMf;

const TYPES: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="png" ContentType="image/png"/><Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>
"#;
const RELATIONS: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/><Relationship Target="/Metadata/thumbnail.png" Id="rel1" Type="http://schemas.openxmlformats.org/package/2006/relationships/metadata/thumbnail"/></Relationships>
"#;

/// See [`Entry`].
pub(super) const ENTRY: Entry = Entry {
    name: "3mf",
    files: &[
        (&["pair.3mf"], "slicers, in millimetres, with names, colours and a small picture"),
        (
            &["plate.3mf"],
            "printers: every part flat on the bed (`--bed 220x220`), side by side; `plate-2.3mf` where one is full",
        ),
    ],
    solid: true,
    encoders: |options| vec![Box::new(ThreeMf), Box::new(Plate { bed: options.bed })],
    ..Entry::PLAIN
};

impl Encode for ThreeMf {
    fn encode<'a>(&'a self, parts: Parts<'a>) -> Result<Vec<Artifact<'a>>, EncodeError> {
        Ok(vec![Artifact::stream("pair.3mf", move |out| {
            package(parts.assembly, &standing(parts), out)
        })])
    }
}

/// A part in a package.
#[derive(Clone, Copy, Debug)]
pub(super) struct Item<'a> {
    pub(super) name: &'a str,
    pub(super) color: [u8; 3],
    pub(super) mesh: &'a Mesh,
    /// What takes its frame to the package's, mm.
    pub(super) place: Isometry3<f64>,
}

/// All parts with their names and colours, each in its own frame.
pub(super) fn items(parts: Parts<'_>) -> Vec<Item<'_>> {
    let place = Isometry3::identity();
    let gears = parts.iter().enumerate().map(|(i, (placed, mesh))| Item {
        name: &placed.gear.name,
        color: color(i),
        mesh,
        place,
    });
    let fixtures = parts.fixtures().map(|(fixture, mesh)| Item {
        name: &fixture.name,
        color: policy::FIXTURE_COLOR,
        mesh,
        place,
    });
    gears.chain(fixtures).collect()
}

/// The parts in mesh, moved as a whole so that nothing lies at negative coordinates.
fn standing(parts: Parts<'_>) -> Vec<Item<'_>> {
    let assembly = parts.assembly;
    let gears = (0..assembly.gears.len()).map(|i| assembly.first_pose(i));
    let poses = gears.chain(assembly.fixtures.iter().map(|f| assembly.pose_of(f)));
    let mut items: Vec<Item<'_>> =
        items(parts).into_iter().zip(poses).map(|(item, place)| Item { place, ..item }).collect();
    let corner = low_corner(&items);
    let shift = Translation3::new(-corner.x, -corner.y, -corner.z);
    items.iter_mut().for_each(|item| item.place = shift * item.place);
    items
}

/// The package: a model with the items, and a picture of them as they lie in it.
pub(super) fn package(
    assembly: &Assembly,
    items: &[Item<'_>],
    out: impl Write + Seek,
) -> io::Result<()> {
    let mut zip = ZipWriter::new(out);
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(DateTime::default());
    for (name, text) in [("[Content_Types].xml", TYPES), ("_rels/.rels", RELATIONS)] {
        zip.start_file(name, options)?;
        zip.write_all(text.as_bytes())?;
    }
    zip.start_file("3D/3dmodel.model", options)?;
    zip.write_all(model(assembly, items).as_bytes())?;
    let shown: Vec<Shown<'_>> =
        items.iter().map(|i| Shown { mesh: i.mesh, place: i.place, color: i.color }).collect();
    zip.start_file("Metadata/thumbnail.png", options)?;
    let picture = picture(&shown, policy::THUMBNAIL_PIXELS);
    zip.write_all(&picture.ok_or_else(|| io::Error::other("there is nothing to draw"))?)?;
    zip.finish()?;
    Ok(())
}

fn model(assembly: &Assembly, items: &[Item<'_>]) -> String {
    let mut xml = String::from(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" xml:lang=\"en-US\" \
         xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n",
    );
    let gears: Vec<&str> = assembly.gears.iter().map(|g| g.gear.name.as_str()).collect();
    let teeth: Vec<String> =
        assembly.gears.iter().map(|g| format!("{}: {} teeth", g.gear.name, g.gear.teeth)).collect();
    let version = concat!("centrode ", env!("CARGO_PKG_VERSION"));
    for (name, value) in [
        ("Title", format!("Non-circular gears: {}", gears.join(" and "))),
        ("Application", version.to_owned()),
        ("Description", teeth.join(", ")),
    ] {
        let _ = writeln!(xml, " <metadata name=\"{name}\">{}</metadata>", escaped(&value));
    }
    xml.push_str(" <resources>\n  <basematerials id=\"1\">\n");
    for Item { name, color: [r, g, b], .. } in items {
        let name = escaped(name);
        let _ = writeln!(xml, "   <base name=\"{name}\" displaycolor=\"#{r:02X}{g:02X}{b:02X}\"/>");
    }
    xml.push_str("  </basematerials>\n");
    for (i, item) in items.iter().enumerate() {
        object(&mut xml, i, &escaped(item.name), item.mesh);
    }
    xml.push_str(" </resources>\n <build>\n");
    for (i, item) in items.iter().enumerate() {
        // The format multiplies rows from the left: the columns of our matrix, one after the other.
        let matrix = item.place.to_homogeneous();
        let numbers: Vec<String> = (0..4)
            .flat_map(|column| (0..3).map(move |row| (row, column)))
            .map(|at| number(matrix[at]))
            .collect();
        let _ =
            writeln!(xml, "  <item objectid=\"{}\" transform=\"{}\"/>", i + 2, numbers.join(" "));
    }
    xml.push_str(" </build>\n</model>\n");
    xml
}

/// A number without a negative zero.
fn number(value: f64) -> String {
    let text = format!("{value:.9}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Lower left corner of everything as it lies.
pub(super) fn low_corner(items: &[Item<'_>]) -> Vector3<f64> {
    let points = items.iter().flat_map(|item| {
        item.mesh.positions.iter().map(|p| (item.place * Point3::from(*p)).coords)
    });
    points.reduce(|low, p| low.inf(&p)).unwrap_or_else(Vector3::zeros)
}

fn object(xml: &mut String, number: usize, name: &str, mesh: &Mesh) {
    let _ = writeln!(
        xml,
        "  <object id=\"{}\" type=\"model\" name=\"{name}\" partnumber=\"{name}\" pid=\"1\" \
         pindex=\"{number}\">\n   <mesh>\n    <vertices>",
        number + 2
    );
    for [x, y, z] in &mesh.positions {
        let _ = writeln!(xml, "     <vertex x=\"{x:.6}\" y=\"{y:.6}\" z=\"{z:.6}\"/>");
    }
    xml.push_str("    </vertices>\n    <triangles>\n");
    for [a, b, c] in &mesh.triangles {
        let _ = writeln!(xml, "     <triangle v1=\"{a}\" v2=\"{b}\" v3=\"{c}\"/>");
    }
    xml.push_str("    </triangles>\n   </mesh>\n  </object>\n");
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::tests::wavy_pair;
    use super::*;
    use crate::solid::{Expected, check};
    use std::io::Read;

    fn numbers(line: &str) -> Vec<f64> {
        line.split('"').skip(1).step_by(2).map(|n| n.parse().unwrap()).collect()
    }

    /// The transforms of all items.
    pub(in super::super) fn places(parts: Parts<'_>) -> Vec<Vec<f64>> {
        model(parts.assembly, &standing(parts))
            .lines()
            .filter_map(|l| l.split_once("transform=\"").map(|(_, t)| t))
            .map(|t| t.trim_end_matches("\"/>").split(' ').map(|n| n.parse().unwrap()).collect())
            .collect()
    }

    #[test]
    fn both_objects_read_back_sound_named_and_in_place() {
        let (mut assembly, meshes) = wavy_pair();
        assembly.gears[1].gear.name = "a \"<&>\" b".to_owned();
        let folder = tempfile::tempdir().unwrap();
        let parts = Parts { assembly: &assembly, meshes: &meshes };
        let path = ThreeMf.write(parts, folder.path()).unwrap().remove(0);
        let mut zip = zip::ZipArchive::new(std::fs::File::open(path).unwrap()).unwrap();
        let mut text = String::new();
        zip.by_name("3D/3dmodel.model").unwrap().read_to_string(&mut text).unwrap();
        assert!(text.contains("unit=\"millimeter\"") && text.contains("name=\"a &quot;&lt;&amp;"));
        let mut picture = Vec::new();
        zip.by_name("Metadata/thumbnail.png").unwrap().read_to_end(&mut picture).unwrap();
        assert!(image::load_from_memory(&picture).unwrap().width() <= policy::THUMBNAIL_PIXELS);
        for (part, original) in text.split("<mesh>").skip(1).zip(&meshes) {
            let (part, _) = part.split_once("</mesh>").unwrap();
            let lines = |tag: &'static str| part.lines().filter(move |l| l.contains(tag));
            let mesh = Mesh {
                positions: lines("<vertex ")
                    .map(|l| <[f64; 3]>::try_from(numbers(l)).unwrap())
                    .collect(),
                triangles: lines("<triangle ")
                    .map(|l| <[f64; 3]>::try_from(numbers(l)).unwrap().map(|n| n as u32))
                    .collect(),
            };
            let expected = Expected { volume: original.volume(), genus: 1 };
            assert_eq!(check(&mesh, expected), Ok(()));
        }
        let places: Vec<Vec<f64>> = text
            .lines()
            .filter_map(|l| l.split_once("transform=\"").map(|(_, t)| t))
            .map(|t| t.trim_end_matches("\"/>").split(' ').map(|n| n.parse().unwrap()).collect())
            .collect();
        assert!((places[1][9] - places[0][9] - 80.0).abs() < 1e-6);
        // The driver reaches 42.5 mm to the left of its axis, nearly.
        assert!((places[0][9] - 42.5).abs() < 0.05, "{places:?}");
    }
}
