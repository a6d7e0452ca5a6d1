//! DXF for CAD programs, lasers and mills: one closed path per contour.

mod r12;
mod r2000;

use super::contours::{Contour, contour};
use super::flat::flat;
use super::{Artifact, Encode, EncodeError, Entry, Parts};
use crate::assembly::{Fixture, PlacedGear};
use crate::geometry::Point;
use crate::policy;

/// `pair.dxf` with all gears in mesh, and `<gear>.dxf` with each alone, its axis at the origin; the same for plates
/// beside the gears, such as `base.dxf`; mm.
///
/// One closed polyline with bulges per contour, round bores as circles. Layers: one per part, named
/// like it, `bores`, `openings` (other holes), `pitch-curves`, `centres`.
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

/// The file with all parts in mesh.
const ALL: &str = "pair.dxf";
const BORES: &str = "bores";
const OPENINGS: &str = "openings";
const PITCH_CURVES: &str = "pitch-curves";
const CENTRES: &str = "centres";

/// See [`Entry`].
pub(super) const ENTRY: Entry = Entry {
    name: "dxf",
    files: &[(
        &["pair.dxf", "driver.dxf", "follower.dxf"],
        "CAD and laser cutters: closed contours with true arcs (`--dxf-polyline`, `--dxf-r12`); `base.dxf` with `--base`",
    )],
    encoders: |options| {
        vec![Box::new(Dxf {
            polyline: options.dxf_polyline,
            r12: options.dxf_r12,
            tolerance: options.curve_tolerance,
        })]
    },
    ..Entry::PLAIN
};

impl Encode for Dxf {
    fn encode<'a>(&'a self, parts: Parts<'a>) -> Result<Vec<Artifact<'a>>, EncodeError> {
        let failed = |why: String| EncodeError::new(ALL, why);
        let gears = &parts.assembly.gears;
        let drawn: Vec<Drawn> =
            gears.iter().map(|g| self.drawn(g)).collect::<Result<_, _>>().map_err(failed)?;
        let plates: Vec<(&str, Plate)> = parts
            .assembly
            .fixtures
            .iter()
            .filter_map(|f| Some(self.plate(f).transpose()?.map(|plate| (f.name.as_str(), plate))))
            .collect::<Result<_, _>>()
            .map_err(failed)?;
        let mut all = Self::sheet(gears.iter().zip(&drawn), true);
        for (_, plate) in &plates {
            // What stands on edge has no place in a picture from above.
            if let Some(shift) = plate.shift {
                plate.draw(&mut all, shift);
            }
        }
        let mut sheets = vec![(ALL.to_owned(), all)];
        sheets.extend(gears.iter().zip(&drawn).map(|(placed, drawn)| {
            let sheet = Self::sheet(std::iter::once((placed, drawn)), false);
            (format!("{}.dxf", placed.gear.name), sheet)
        }));
        sheets.extend(plates.iter().map(|(name, plate)| {
            let mut sheet = Sheet::empty();
            plate.draw(&mut sheet, Point::origin());
            (format!("{name}.dxf"), sheet)
        }));
        let artifact = |(name, sheet): (String, Sheet)| {
            let text = if self.r12 { r12::text(&sheet) } else { r2000::text(&sheet) };
            let text = text.map_err(|why| EncodeError::new(&name, why))?;
            Ok(Artifact::bytes(name, text))
        };
        sheets.into_iter().map(artifact).collect()
    }
}

/// The contours of a plate in its own frame.
struct Plate {
    layer: String,
    outline: Contour,
    holes: Vec<Contour>,
    /// Where it lies in the world; none for one that does not lie flat.
    shift: Option<Point>,
}

impl Plate {
    fn draw(&self, sheet: &mut Sheet, shift: Point) {
        sheet.layers.push((self.layer.clone(), 9));
        let mut add = |what: &Contour, layer: &str| {
            sheet.items.push((layer.to_owned(), Item::Contour(what.placed(0.0, shift))));
        };
        add(&self.outline, &self.layer);
        // In the layer of the plate, so that it can be cut or hidden as a whole.
        self.holes.iter().for_each(|hole| add(hole, &self.layer));
    }
}

/// The contours of one gear in its own frame.
struct Drawn {
    outline: Contour,
    bore: Option<Contour>,
    /// Holes besides the bore.
    openings: Vec<Contour>,
    pitch_curve: Contour,
}

impl Dxf {
    fn drawn(&self, placed: &PlacedGear) -> Result<Drawn, String> {
        let gear = &placed.gear;
        let bore = |b: &Vec<Point>| contour(b, self.tolerance, true, self.polyline);
        let openings = gear.fittings.openings.iter();
        let coarse = policy::DRAWN_CURVE_TOLERANCE.max(self.tolerance);
        Ok(Drawn {
            outline: contour(&gear.outline, self.tolerance, false, self.polyline)?,
            bore: gear.bore.as_ref().map(bore).transpose()?,
            openings: openings.map(|o| bore(&o.ring)).collect::<Result<_, _>>()?,
            pitch_curve: contour(&gear.pitch_curve, coarse, false, self.polyline)?,
        })
    }

    fn plate(&self, fixture: &Fixture) -> Result<Option<Plate>, String> {
        let Some(cut) = flat(fixture) else { return Ok(None) };
        let drawn = |ring: &[Point]| contour(ring, self.tolerance, true, self.polyline);
        let place = fixture.stance.place;
        let shift = (place.rotation.angle() == 0.0 && fixture.stance.with.is_none())
            .then(|| Point::new(place.translation.x, place.translation.y));
        Ok(Some(Plate {
            layer: plain(&fixture.name),
            outline: drawn(cut.outline)?,
            holes: cut.holes.into_iter().map(drawn).collect::<Result<_, _>>()?,
            shift,
        }))
    }

    /// The gears in mesh, or one alone with its axis at the origin.
    fn sheet<'a>(gears: impl Iterator<Item = (&'a PlacedGear, &'a Drawn)>, in_mesh: bool) -> Sheet {
        let mut sheet = Sheet::empty();
        for (number, (placed, drawn)) in gears.enumerate() {
            let layer = plain(&placed.gear.name);
            sheet.layers.push((layer.clone(), if number.is_multiple_of(2) { 5 } else { 4 }));
            let angle = placed.angle.first().copied().unwrap_or(0.0);
            let (angle, axis) = if in_mesh { (angle, placed.axis) } else { (0.0, Point::origin()) };
            let mut add = |what: &Contour, layer: &str| {
                sheet.items.push((layer.to_owned(), Item::Contour(what.placed(angle, axis))));
            };
            add(&drawn.outline, &layer);
            if let Some(bore) = &drawn.bore {
                add(bore, BORES);
            }
            for opening in &drawn.openings {
                add(opening, OPENINGS);
            }
            add(&drawn.pitch_curve, PITCH_CURVES);
            sheet.items.push((CENTRES.to_owned(), Item::Point(axis)));
        }
        sheet
    }
}

/// What is drawn, in either dialect.
struct Sheet {
    /// Names and colour numbers.
    layers: Vec<(String, u8)>,
    /// Each on a layer.
    items: Vec<(String, Item)>,
}

impl Sheet {
    fn empty() -> Self {
        let layers = [(BORES, 1), (OPENINGS, 6), (PITCH_CURVES, 8), (CENTRES, 3)];
        Self {
            layers: layers.map(|(name, color)| (name.to_owned(), color)).to_vec(),
            items: Vec::new(),
        }
    }
}

enum Item {
    Contour(Contour),
    Point(Point),
}

/// A name that every dialect takes for a layer.
fn plain(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' }).collect()
}

#[cfg(test)]
mod tests {
    use super::super::tests::wavy_pair;
    use super::*;
    use crate::export::ExportError;
    use crate::geometry::curves::Arc;
    use dxf::Drawing;
    use dxf::entities::{EntityType, Vertex};
    use std::path::Path;

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
