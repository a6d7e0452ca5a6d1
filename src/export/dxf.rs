//! DXF for CAD programs, lasers and mills: one closed path per contour.

use super::contours::{Contour, contour};
use super::{Export, ExportError, Parts, write_atomically};
use crate::assembly::{Assembly, PlacedGear};
use crate::geometry::Point;
use crate::policy;
use dxf::entities::{Circle, Entity, EntityType, LwPolyline, ModelPoint, Polyline, Vertex};
use dxf::enums::{AcadVersion, DrawingUnits, Units};
use dxf::tables::Layer;
use dxf::{Color, Drawing, LwPolylineVertex};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// `pair.dxf` with all gears in mesh, and `<gear>.dxf` with each alone, its axis at the origin; mm.
///
/// One closed polyline with bulges per contour, round bores as circles. Layers: one per gear, named
/// like it, `bores`, `pitch curves`, `centres`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dxf {
    /// Straight segments instead of arcs, for programs that read nothing else.
    pub polyline: bool,
    /// AutoCAD R12 with POLYLINE and VERTEX, for old machines; otherwise R2000 with LWPOLYLINE.
    pub r12: bool,
    /// Greatest distance between a vertex of the outline and the arcs, mm.
    pub tolerance: f64,
}

impl Default for Dxf {
    fn default() -> Self {
        Self { polyline: false, r12: false, tolerance: policy::EXPORT_TOLERANCE }
    }
}

const BORES: &str = "bores";
const PITCH_CURVES: &str = "pitch curves";
const CENTRES: &str = "centres";

impl Export for Dxf {
    fn file_names(&self, assembly: &Assembly) -> Vec<String> {
        let alone = assembly.gears.iter().map(|g| format!("{}.dxf", g.gear.name));
        std::iter::once("pair.dxf".to_owned()).chain(alone).collect()
    }

    fn write(&self, parts: Parts<'_>, folder: &Path) -> Result<Vec<PathBuf>, ExportError> {
        let paths: Vec<PathBuf> =
            self.file_names(parts.assembly).iter().map(|name| folder.join(name)).collect();
        let encode = |path: &Path, why: String| ExportError::Encode { path: path.to_owned(), why };
        let drawn: Vec<Drawn> = parts
            .assembly
            .gears
            .iter()
            .map(|g| self.drawn(g).map_err(|why| encode(&paths[0], why)))
            .collect::<Result<_, _>>()?;
        let gears = &parts.assembly.gears;
        let mut drawings = vec![self.drawing(gears.iter().zip(&drawn), true)];
        drawings.extend(gears.iter().zip(&drawn).map(|g| self.drawing([g].into_iter(), false)));
        for (path, drawing) in paths.iter().zip(&drawings) {
            write_atomically(path, |out| {
                drawing.save(out).map_err(|e| match e {
                    dxf::DxfError::IoError(e) => e,
                    other => io::Error::new(ErrorKind::InvalidData, other.to_string()),
                })
            })?;
        }
        Ok(paths)
    }
}

/// The contours of one gear in its own frame.
struct Drawn {
    outline: Contour,
    bore: Option<Contour>,
    pitch_curve: Contour,
}

impl Dxf {
    fn drawn(&self, placed: &PlacedGear) -> Result<Drawn, String> {
        let gear = &placed.gear;
        let bore = |b: &Vec<Point>| contour(b, self.tolerance, true, self.polyline);
        let coarse = policy::DRAWN_CURVE_TOLERANCE.max(self.tolerance);
        Ok(Drawn {
            outline: contour(&gear.outline, self.tolerance, false, self.polyline)?,
            bore: gear.bore.as_ref().map(bore).transpose()?,
            pitch_curve: contour(&gear.pitch_curve, coarse, false, self.polyline)?,
        })
    }

    fn drawing<'a>(
        &self,
        gears: impl Iterator<Item = (&'a PlacedGear, &'a Drawn)>,
        in_place: bool,
    ) -> Drawing {
        let mut drawing = Drawing::new();
        let header = &mut drawing.header;
        header.version = if self.r12 { AcadVersion::R12 } else { AcadVersion::R2000 };
        header.default_drawing_units = Units::Millimeters;
        header.drawing_units = DrawingUnits::Metric;
        // The same design gives the same bytes, whenever it is written.
        header.creation_date = Default::default();
        header.creation_date_universal = Default::default();
        header.update_date = Default::default();
        header.update_date_universal = Default::default();
        header.fingerprint_guid = Default::default();
        header.version_guid = Default::default();
        for (name, color) in [(BORES, 1), (PITCH_CURVES, 8), (CENTRES, 3)] {
            layer(&mut drawing, name, color);
        }
        for (number, (placed, drawn)) in gears.enumerate() {
            let name = placed.gear.name.as_str();
            layer(&mut drawing, name, if number.is_multiple_of(2) { 5 } else { 4 });
            let angle = placed.angle.first().copied().unwrap_or(0.0);
            let (angle, axis) =
                if in_place { (angle, placed.axis) } else { (0.0, Point::origin()) };
            let mut add = |what: &Contour, layer| {
                self.add(&mut drawing, &what.placed(angle, axis), layer);
            };
            add(&drawn.outline, name);
            if let Some(bore) = &drawn.bore {
                add(bore, BORES);
            }
            add(&drawn.pitch_curve, PITCH_CURVES);
            let point = EntityType::ModelPoint(ModelPoint::new(flat(axis)));
            put(&mut drawing, point, CENTRES);
        }
        drawing
    }

    fn add(&self, drawing: &mut Drawing, contour: &Contour, layer: &str) {
        let entity = match contour {
            Contour::Round { center, radius } => {
                EntityType::Circle(Circle::new(flat(*center), *radius))
            }
            Contour::Path(path) if self.r12 => {
                let mut line = Polyline::default();
                line.set_is_closed(true);
                for arc in path.arcs() {
                    let corner =
                        Vertex { location: flat(arc.from), bulge: arc.bulge, ..Vertex::default() };
                    line.add_vertex(drawing, corner);
                }
                EntityType::Polyline(line)
            }
            Contour::Path(path) => {
                let corner = |a: &crate::geometry::curves::Arc| LwPolylineVertex {
                    x: a.from.x,
                    y: a.from.y,
                    bulge: a.bulge,
                    ..LwPolylineVertex::default()
                };
                let mut line = LwPolyline {
                    vertices: path.arcs().iter().map(corner).collect(),
                    ..LwPolyline::default()
                };
                line.set_is_closed(true);
                EntityType::LwPolyline(line)
            }
        };
        put(drawing, entity, layer);
    }
}

fn layer(drawing: &mut Drawing, name: &str, color: u8) {
    drawing.add_layer(Layer {
        name: name.to_owned(),
        color: Color::from_index(color),
        ..Layer::default()
    });
}

fn put(drawing: &mut Drawing, what: EntityType, layer: &str) {
    let mut entity = Entity::new(what);
    layer.clone_into(&mut entity.common.layer);
    drawing.add_entity(entity);
}

fn flat(p: Point) -> dxf::Point {
    dxf::Point::new(p.x, p.y, 0.0)
}

#[cfg(test)]
mod tests {
    use super::super::tests::wavy_pair;
    use super::*;
    use crate::geometry::curves::Arc;

    fn read(path: &Path) -> Drawing {
        Drawing::load_file(path).unwrap()
    }

    /// The arcs of every closed polyline on a layer.
    fn paths(drawing: &Drawing, layer: &str) -> Vec<Vec<Arc>> {
        let arcs = |corners: Vec<(Point, f64)>| {
            let n = corners.len();
            let arc = |i: usize| Arc {
                from: corners[i].0,
                to: corners[(i + 1) % n].0,
                bulge: corners[i].1,
            };
            (0..n).map(arc).collect()
        };
        drawing
            .entities()
            .filter(|e| e.common.layer == layer)
            .filter_map(|e| match &e.specific {
                EntityType::LwPolyline(l) => {
                    assert!(l.is_closed());
                    Some(arcs(l.vertices.iter().map(|v| (Point::new(v.x, v.y), v.bulge)).collect()))
                }
                EntityType::Polyline(l) => {
                    assert!(l.is_closed());
                    let corner = |v: &Vertex| (Point::new(v.location.x, v.location.y), v.bulge);
                    Some(arcs(l.vertices().map(corner).collect()))
                }
                _ => None,
            })
            .collect()
    }

    #[test]
    fn outlines_read_back_within_the_tolerance_in_every_dialect() {
        let (assembly, meshes) = wavy_pair();
        let parts = Parts { assembly: &assembly, meshes: &meshes };
        for (polyline, r12) in [(false, false), (false, true), (true, false), (true, true)] {
            let folder = tempfile::tempdir().unwrap();
            let format = Dxf { polyline, r12, ..Dxf::default() };
            let written = format.write(parts, folder.path()).unwrap();
            let pair = read(&written[0]);
            for (placed, file) in assembly.gears.iter().zip(&written[1..]) {
                let name = &placed.gear.name;
                let (in_mesh, alone) = (paths(&pair, name), paths(&read(file), name));
                assert_eq!((in_mesh.len(), alone.len()), (1, 1));
                assert_eq!(alone[0].iter().all(|a| a.bulge == 0.0), polyline);
                for (arcs, shift) in [(&in_mesh[0], placed.axis), (&alone[0], Point::origin())] {
                    for p in &placed.gear.outline {
                        let p = p + shift.coords;
                        let off = arcs.iter().map(|a| a.distance(p)).fold(f64::INFINITY, f64::min);
                        assert!(off <= 1.01 * policy::EXPORT_TOLERANCE, "{off}");
                    }
                }
            }
            assert_eq!(paths(&pair, PITCH_CURVES).len(), 2);
        }
    }

    #[test]
    fn a_round_bore_is_a_circle_of_the_diameter_asked_for() {
        let (assembly, meshes) = wavy_pair();
        let folder = tempfile::tempdir().unwrap();
        let parts = Parts { assembly: &assembly, meshes: &meshes };
        let written = Dxf::default().write(parts, folder.path()).unwrap();
        let pair = read(&written[0]);
        let circles: Vec<f64> = pair
            .entities()
            .filter_map(|e| match &e.specific {
                EntityType::Circle(c) if e.common.layer == BORES => Some(c.radius),
                _ => None,
            })
            .collect();
        assert!(matches!(circles[..], [r] if (r - 2.5).abs() < 1e-9), "{circles:?}");
        assert_eq!(paths(&pair, BORES).len(), 1, "the cross of the other gear");
    }

    #[test]
    fn the_same_design_gives_the_same_bytes() {
        let (assembly, meshes) = wavy_pair();
        let parts = Parts { assembly: &assembly, meshes: &meshes };
        let bytes = || {
            let folder = tempfile::tempdir().unwrap();
            let written = Dxf::default().write(parts, folder.path()).unwrap();
            std::fs::read(&written[0]).unwrap()
        };
        assert_eq!(bytes(), bytes());
    }

    #[test]
    fn an_outline_that_crosses_itself_makes_no_file() {
        let (mut assembly, meshes) = wavy_pair();
        assembly.gears[0].gear.outline.swap(10, 90);
        let folder = tempfile::tempdir().unwrap();
        let parts = Parts { assembly: &assembly, meshes: &meshes };
        let error = Dxf::default().write(parts, folder.path()).unwrap_err();
        assert!(matches!(&error, ExportError::Encode { .. }), "{error}");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
