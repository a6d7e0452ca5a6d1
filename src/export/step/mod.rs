//! STEP for CAD programs: exact solids with curved faces in an assembly.
//!
//! ISO 10303-21 after the schema AP214: every gear is a product with one solid, a prism between two planes; its
//! sides are planes, cylinders, and cubic curves pulled straight up. The assembly places the products.

mod entities;
mod prism;

use super::contours::{color, halves, traced};
use super::{Export, ExportError, Parts, write_atomically};
use crate::assembly::{Assembly, Gear, PlacedGear};
use crate::geometry::curves::{Stretch, round_hole};
use crate::geometry::{self, Point};
use crate::policy;
use entities::{Entities, Id, text};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// `pair.step`: one product per gear with its name and colour, placed in mesh, mm. A gear has its bore, its
/// other holes and its hub; marks, bevels and holes for set screws are left to the solids.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Greatest distance between a vertex of the outline and its curve, mm.
    pub tolerance: f64,
}

impl Default for Step {
    fn default() -> Self {
        Self { tolerance: policy::EXPORT_TOLERANCE }
    }
}

impl Export for Step {
    fn file_names(&self, _: &Assembly) -> Vec<String> {
        vec!["pair.step".to_owned()]
    }

    fn write(&self, parts: Parts<'_>, folder: &Path) -> Result<Vec<PathBuf>, ExportError> {
        let path = folder.join("pair.step");
        let entities = self
            .entities(parts.assembly)
            .map_err(|why| ExportError::Encode { path: path.clone(), why })?;
        write_atomically(&path, |out| file(&entities, out))?;
        Ok(vec![path])
    }
}

fn file(entities: &Entities, out: &mut BufWriter<std::fs::File>) -> std::io::Result<()> {
    out.write_all(
        b"ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('Non-circular gears'),'2;1');\n\
          FILE_NAME('pair.step','1970-01-01T00:00:00',(''),(''),",
    )?;
    // No time of writing: the same design gives the same bytes.
    let program = concat!("'centrode ", env!("CARGO_PKG_VERSION"), "'");
    writeln!(out, "{program},{program},'');")?;
    out.write_all(
        b"FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n",
    )?;
    entities.write(out)?;
    out.write_all(b"ENDSEC;\nEND-ISO-10303-21;\n")
}

/// Entities that every product refers to.
struct Common {
    product_context: Id,
    definition_context: Id,
    space: Id,
}

impl Step {
    fn entities(&self, assembly: &Assembly) -> Result<Entities, String> {
        if !(assembly.thickness > 0.0 && assembly.thickness.is_finite()) {
            return Err(format!("a thickness of {} mm makes no solid", assembly.thickness));
        }
        let mut e = Entities::default();
        let common = common(&mut e);
        let home = e.frame([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
        let (mut placed, mut styled) = (Vec::new(), Vec::new());
        for (number, gear) in assembly.gears.iter().enumerate() {
            let solid = self.solid(&mut e, &gear.gear, assembly.thickness)?;
            let name = text(&gear.gear.name);
            let shape = e.add(format!(
                "ADVANCED_BREP_SHAPE_REPRESENTATION({name},({home},{solid}),{})",
                common.space
            ));
            let definition = product(&mut e, &common, &name, shape);
            styled.push(style(&mut e, solid, color(number)));
            let place = place(&mut e, gear);
            placed.push((name, definition, shape, place));
        }
        let items: Vec<String> = std::iter::once(home)
            .chain(placed.iter().map(|p| p.3))
            .map(|id| id.to_string())
            .collect();
        let pair =
            e.add(format!("SHAPE_REPRESENTATION('pair',({}),{})", items.join(","), common.space));
        let whole = product(&mut e, &common, "'pair'", pair);
        for (number, (name, definition, shape, place)) in placed.iter().enumerate() {
            let used = e.add(format!(
                "NEXT_ASSEMBLY_USAGE_OCCURRENCE('{}',{name},'',{whole},{definition},$)",
                number + 1
            ));
            let what = e.add(format!("PRODUCT_DEFINITION_SHAPE('placement','',{used})"));
            let moved = e.add(format!("ITEM_DEFINED_TRANSFORMATION('','',{home},{place})"));
            let relation = e.add(format!(
                "(REPRESENTATION_RELATIONSHIP('','',{shape},{pair})\
                 REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION({moved})\
                 SHAPE_REPRESENTATION_RELATIONSHIP())"
            ));
            e.add(format!("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION({relation},{what})"));
        }
        let styled: Vec<String> = styled.iter().map(Id::to_string).collect();
        e.add(format!(
            "MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',({}),{})",
            styled.join(","),
            common.space
        ));
        Ok(e)
    }

    fn solid(&self, e: &mut Entities, gear: &Gear, thickness: f64) -> Result<Id, String> {
        let hole = |ring: &Vec<Point>| -> Result<Vec<Stretch>, String> {
            Ok(self.ring(ring, true)?.iter().rev().map(prism::reversed).collect())
        };
        let fittings = &gear.fittings;
        let stack = prism::Stack {
            outline: self.ring(&gear.outline, false)?,
            openings: fittings.openings.iter().map(|o| hole(&o.ring)).collect::<Result<_, _>>()?,
            bore: gear.bore.as_ref().map(hole).transpose()?,
            height: thickness,
            hub: fittings.hub.map(|hub| {
                let circle = halves(Point::origin(), hub.radius).map(Stretch::Arc).to_vec();
                (circle, thickness + hub.height)
            }),
        };
        prism::solid(e, &text(&gear.name), &stack)
    }

    /// The stretches of a counter-clockwise ring.
    fn ring(&self, points: &[Point], hole: bool) -> Result<Vec<Stretch>, String> {
        if let Some((center, radius)) = round_hole(points)
            && hole
        {
            return Ok(halves(center, radius).map(Stretch::Arc).to_vec());
        }
        let trace = traced(points, self.tolerance, hole)?;
        let (area, drawn) = (trace.signed_area(), geometry::signed_area(points));
        let most = if hole { policy::STEP_HOLE_AREA_ERROR } else { policy::STEP_AREA_ERROR };
        let off = (area / drawn - 1.0).abs();
        if off.is_nan() || off > most {
            return Err(format!("its curves enclose {area:.4} mm^2 instead of {drawn:.4} mm^2"));
        }
        Ok(trace.stretches().iter().flat_map(parts).collect())
    }
}

/// A long curve in parts of a few spans, so that faces stay handy and no face meets itself.
fn parts(stretch: &Stretch) -> Vec<Stretch> {
    let Stretch::Cubic(path) = stretch else { return vec![stretch.clone()] };
    let spans = path.knots.len() - 1;
    let count = spans.div_ceil(policy::SPANS_PER_FACE);
    let node = |i: usize| i * spans / count;
    (0..count).map(|i| Stretch::Cubic(path.part(node(i), node(i + 1)))).collect()
}

fn common(e: &mut Entities) -> Common {
    let application = e.add(
        "APPLICATION_CONTEXT('core data for automotive mechanical design processes')".to_owned(),
    );
    e.add(format!(
        "APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,{application})"
    ));
    let product_context = e.add(format!("PRODUCT_CONTEXT('',{application},'mechanical')"));
    let definition_context =
        e.add(format!("PRODUCT_DEFINITION_CONTEXT('part definition',{application},'design')"));
    let millimetre = e.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))".to_owned());
    let radian = e.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))".to_owned());
    let steradian = e.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())".to_owned());
    let uncertainty = e.add(format!(
        "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE({:E}),{millimetre},'distance_accuracy_value','')",
        Upper(policy::STEP_UNCERTAINTY)
    ));
    let space = e.add(format!(
        "(GEOMETRIC_REPRESENTATION_CONTEXT(3)\
         GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({uncertainty}))\
         GLOBAL_UNIT_ASSIGNED_CONTEXT(({millimetre},{radian},{steradian}))\
         REPRESENTATION_CONTEXT('',''))"
    ));
    Common { product_context, definition_context, space }
}

/// A number with the decimal point that the format asks for.
struct Upper(f64);

impl std::fmt::UpperExp for Upper {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let plain = format!("{:E}", self.0);
        let (digits, power) = plain.split_once('E').unwrap_or((&plain, "0"));
        let point = if digits.contains('.') { "" } else { "." };
        write!(f, "{digits}{point}E{power}")
    }
}

/// A product whose shape is `shape`; its definition.
fn product(e: &mut Entities, common: &Common, name: &str, shape: Id) -> Id {
    let product = e.add(format!("PRODUCT({name},{name},'',({}))", common.product_context));
    e.add(format!("PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,({product}))"));
    let formation = e.add(format!("PRODUCT_DEFINITION_FORMATION('','',{product})"));
    let definition =
        e.add(format!("PRODUCT_DEFINITION('design','',{formation},{})", common.definition_context));
    let what = e.add(format!("PRODUCT_DEFINITION_SHAPE('','',{definition})"));
    e.add(format!("SHAPE_DEFINITION_REPRESENTATION({what},{shape})"));
    definition
}

fn style(e: &mut Entities, solid: Id, color: [u8; 3]) -> Id {
    let [r, g, b] = color.map(|c| f64::from(c) / 255.0);
    let rgb = e.add(format!("COLOUR_RGB('',{r:.6},{g:.6},{b:.6})"));
    let fill = e.add(format!("FILL_AREA_STYLE_COLOUR('',{rgb})"));
    let area = e.add(format!("FILL_AREA_STYLE('',({fill}))"));
    let surface = e.add(format!("SURFACE_STYLE_FILL_AREA({area})"));
    let side = e.add(format!("SURFACE_SIDE_STYLE('',({surface}))"));
    let usage = e.add(format!("SURFACE_STYLE_USAGE(.BOTH.,{side})"));
    let style = e.add(format!("PRESENTATION_STYLE_ASSIGNMENT(({usage}))"));
    e.add(format!("STYLED_ITEM('color',({style}),{solid})"))
}

/// Where a gear stands in its first pose.
fn place(e: &mut Entities, placed: &PlacedGear) -> Id {
    let (sin, cos) = placed.angle.first().copied().unwrap_or(0.0).sin_cos();
    e.frame([placed.axis.x, placed.axis.y, placed.level], [0.0, 0.0, 1.0], [cos, sin, 0.0])
}

#[cfg(test)]
mod tests {
    use super::super::tests::wavy_pair;
    use super::*;
    use std::collections::HashMap;

    fn written() -> String {
        let (assembly, meshes) = wavy_pair();
        let folder = tempfile::tempdir().unwrap();
        let parts = Parts { assembly: &assembly, meshes: &meshes };
        let path = Step::default().write(parts, folder.path()).unwrap().remove(0);
        std::fs::read_to_string(path).unwrap()
    }

    #[test]
    fn every_edge_is_used_once_each_way() {
        let text = written();
        let mut uses: HashMap<&str, [u32; 2]> = HashMap::new();
        for line in text.lines().filter(|l| l.contains("=ORIENTED_EDGE(")) {
            let inside = line.split_once("*,*,").unwrap().1;
            let (edge, sense) = inside.split_once(',').unwrap();
            uses.entry(edge).or_default()[usize::from(sense.starts_with(".T."))] += 1;
        }
        let edges = text.lines().filter(|l| l.contains("=EDGE_CURVE(")).count();
        assert_eq!(uses.len(), edges);
        assert!(uses.values().all(|&u| u == [1, 1]));
        // Euler: a ring with a hole through it has V - E + F = 0 once the two cap loops are counted.
        let count = |what: &str| text.lines().filter(|l| l.contains(what)).count();
        let inner_loops = count("=FACE_BOUND(");
        assert_eq!(inner_loops, 4);
        assert_eq!(count("=VERTEX_POINT(") + count("=ADVANCED_FACE("), edges + inner_loops);
        assert_eq!(count("=MANIFOLD_SOLID_BREP("), 2);
        assert_eq!(
            count("=CYLINDRICAL_SURFACE("),
            2 + 4,
            "both halves of the round bore and the four fillets of the cross"
        );
    }

    #[test]
    fn references_point_backwards_to_what_exists() {
        for line in written().lines().filter(|l| l.starts_with('#')) {
            let (own, rest) = line[1..].split_once('=').unwrap();
            let own: usize = own.parse().unwrap();
            for used in rest.split('#').skip(1) {
                let digits: String = used.chars().take_while(char::is_ascii_digit).collect();
                assert!(digits.parse::<usize>().unwrap() < own, "{line}");
            }
        }
    }

    #[test]
    fn no_thickness_makes_no_file() {
        let (mut assembly, meshes) = wavy_pair();
        for thickness in [0.0, f64::NAN] {
            assembly.thickness = thickness;
            let folder = tempfile::tempdir().unwrap();
            let parts = Parts { assembly: &assembly, meshes: &meshes };
            let error = Step::default().write(parts, folder.path()).unwrap_err();
            assert!(error.to_string().contains("thickness"), "{error}");
            assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        }
    }
}
