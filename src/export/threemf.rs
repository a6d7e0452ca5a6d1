//! 3MF for slicers: units, names, colours and places that STL cannot hold.

use super::contours::color;
use super::raster::thumbnail;
use super::xml::escaped;
use super::{Export, ExportError, Parts, write_atomically};
use crate::assembly::Assembly;
use crate::geometry::{Point, rotate};
use crate::policy;
use crate::solid::Mesh;
use std::fmt::Write as _;
use std::io::{self, Seek, Write};
use std::path::{Path, PathBuf};
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

impl Export for ThreeMf {
    fn file_names(&self, _: &Assembly) -> Vec<String> {
        vec!["pair.3mf".to_owned()]
    }

    fn write(&self, parts: Parts<'_>, folder: &Path) -> Result<Vec<PathBuf>, ExportError> {
        let path = folder.join("pair.3mf");
        write_atomically(&path, |out| package(parts, out))?;
        Ok(vec![path])
    }
}

fn package(parts: Parts<'_>, out: impl Write + Seek) -> io::Result<()> {
    let mut zip = ZipWriter::new(out);
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(DateTime::default());
    for (name, text) in [("[Content_Types].xml", TYPES), ("_rels/.rels", RELATIONS)] {
        zip.start_file(name, options)?;
        zip.write_all(text.as_bytes())?;
    }
    zip.start_file("3D/3dmodel.model", options)?;
    zip.write_all(model(parts).as_bytes())?;
    let picture = thumbnail(parts.assembly, policy::THUMBNAIL_PIXELS);
    zip.start_file("Metadata/thumbnail.png", options)?;
    zip.write_all(&picture.ok_or_else(|| io::Error::other("there is nothing to draw"))?)?;
    zip.finish()?;
    Ok(())
}

fn model(parts: Parts<'_>) -> String {
    let mut xml = String::from(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" xml:lang=\"en-US\" \
         xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n",
    );
    let gears: Vec<&str> = parts.iter().map(|(g, _)| g.gear.name.as_str()).collect();
    let names: Vec<&str> =
        gears.iter().copied().chain(parts.fixtures().map(|(f, _)| f.name.as_str())).collect();
    let teeth: Vec<String> =
        parts.iter().map(|(g, _)| format!("{}: {} teeth", g.gear.name, g.gear.teeth)).collect();
    let version = concat!("centrode ", env!("CARGO_PKG_VERSION"));
    for (name, value) in [
        ("Title", format!("Non-circular gears: {}", gears.join(" and "))),
        ("Application", version.to_owned()),
        ("Description", teeth.join(", ")),
    ] {
        let _ = writeln!(xml, " <metadata name=\"{name}\">{}</metadata>", escaped(&value));
    }
    xml.push_str(" <resources>\n  <basematerials id=\"1\">\n");
    for (i, name) in names.iter().enumerate() {
        let [r, g, b] = if i < gears.len() { color(i) } else { policy::FIXTURE_COLOR };
        let name = escaped(name);
        let _ = writeln!(xml, "   <base name=\"{name}\" displaycolor=\"#{r:02X}{g:02X}{b:02X}\"/>");
    }
    xml.push_str("  </basematerials>\n");
    let meshes = parts.iter().map(|(_, mesh)| mesh).chain(parts.fixtures().map(|(_, mesh)| mesh));
    for (i, (name, mesh)) in names.iter().zip(meshes).enumerate() {
        object(&mut xml, i, &escaped(name), mesh);
    }
    xml.push_str(" </resources>\n <build>\n");
    let corner = low_corner(parts);
    for (i, (placed, _)) in parts.iter().enumerate() {
        let (sin, cos) = start(placed).sin_cos();
        let place = placed.axis - Point::new(corner[0], corner[1]);
        let _ = writeln!(
            xml,
            "  <item objectid=\"{}\" transform=\"{cos} {sin} 0 {} {cos} 0 0 0 1 {:.6} {:.6} {:.6}\"/>",
            i + 2,
            0.0 - sin,
            place.x,
            place.y,
            placed.level - corner[2]
        );
    }
    for (i, (fixture, _)) in parts.fixtures().enumerate() {
        let _ = writeln!(
            xml,
            "  <item objectid=\"{}\" transform=\"1 0 0 0 1 0 0 0 1 {:.6} {:.6} {:.6}\"/>",
            gears.len() + i + 2,
            0.0 - corner[0],
            0.0 - corner[1],
            fixture.z - corner[2]
        );
    }
    xml.push_str(" </build>\n</model>\n");
    xml
}

fn start(placed: &crate::assembly::PlacedGear) -> f64 {
    placed.angle.first().copied().unwrap_or(0.0)
}

/// Lower left corner of everything as it stands.
fn low_corner(parts: Parts<'_>) -> [f64; 3] {
    let mut low = [f64::INFINITY, f64::INFINITY, 0.0];
    let mut reach = |x: f64, y: f64, z: f64| {
        low = [low[0].min(x), low[1].min(y), low[2].min(z)];
    };
    for (placed, mesh) in parts.iter() {
        for p in &mesh.positions {
            let q = rotate(Point::new(p[0], p[1]), start(placed)) + placed.axis.coords;
            reach(q.x, q.y, p[2]);
        }
    }
    for (fixture, mesh) in parts.fixtures() {
        mesh.positions.iter().for_each(|p| reach(p[0], p[1], p[2] + fixture.z));
    }
    low
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
        model(parts)
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
