//! STEP for CAD programs: exact solids with curved faces in an assembly.
//!
//! ISO 10303-21 after the schema AP214: every gear is a product with one solid, a prism between two planes; its
//! sides are planes, cylinders, and cubic curves pulled straight up. The assembly places the products.

mod entities;
mod prism;

use super::contours::{color, halves, traced};
use super::{Artifact, Encode, EncodeError, Entry, Parts};
use crate::assembly::{Assembly, Fixture, Gear, Post};
use crate::geometry::curves::{Arc, Stretch, round_hole};
use crate::geometry::{self, Point};
use crate::policy;
use entities::{Entities, Id, text};
use nalgebra::{Isometry3, Vector3};
use prism::{Figure, Level, Stack, Through};
use std::io::Write;

/// `pair.step`: one product per part with its name and colour, placed in mesh, mm. A gear has its bore, its other holes,
/// its hub, letters and marks; bevels and holes for set screws are left to the solids.
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

/// See [`Entry`].
pub(super) const ENTRY: Entry = Entry {
    name: "step",
    files: &[(
        &["pair.step"],
        "CAD: true curves, one product a part, placed as an assembly, with base, hub, letters and marks",
    )],
    aliases: &["stp"],
    encoders: |options| vec![Box::new(Step { tolerance: options.curve_tolerance })],
    ..Entry::PLAIN
};

impl Encode for Step {
    fn encode<'a>(&'a self, parts: Parts<'a>) -> Result<Vec<Artifact<'a>>, EncodeError> {
        let entities =
            self.entities(parts.assembly).map_err(|why| EncodeError::new("pair.step", why))?;
        Ok(vec![Artifact::stream("pair.step", move |out| file(&entities, out))])
    }
}

fn file(entities: &Entities, mut out: impl Write) -> std::io::Result<()> {
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
    entities.write(&mut out)?;
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
        let mut add = |e: &mut Entities, name: &str, stack: &Stack, color, pose| {
            let name = text(name);
            let solid = prism::solid(e, &name, stack)?;
            let shape = e.add(format!(
                "ADVANCED_BREP_SHAPE_REPRESENTATION({name},({home},{solid}),{})",
                common.space
            ));
            let definition = product(e, &common, &name, shape);
            styled.push(style(e, solid, color));
            let place = place(e, &pose);
            placed.push((name, definition, shape, place));
            Ok::<(), String>(())
        };
        for (number, gear) in assembly.gears.iter().enumerate() {
            let stack = self.gear(&gear.gear, assembly.thickness)?;
            let pose = assembly.first_pose(number);
            add(&mut e, &gear.gear.name, &stack, color(number), pose)?;
        }
        for fixture in &assembly.fixtures {
            let stack = self.fixture(fixture)?;
            let pose = assembly.pose_of(fixture);
            add(&mut e, &fixture.name, &stack, policy::FIXTURE_COLOR, pose)?;
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

    /// A gear with what it carries.
    fn gear(&self, gear: &Gear, thickness: f64) -> Result<Stack, String> {
        let fittings = &gear.fittings;
        let mut steps = Vec::new();
        let mut top = Level::Top;
        if let Some(hub) = fittings.hub {
            let circle = halves(Point::origin(), hub.radius).map(Stretch::Arc).to_vec();
            top = Level::Step(0);
            steps.push(Figure { on: Level::Top, rings: vec![circle], to: thickness + hub.height });
        }
        // Letters are drawn with few chords: their edges stay as they are.
        steps.extend(fittings.marks.iter().map(|mark| Figure {
            on: Level::Top,
            rings: mark.face.iter().map(|ring| straight(ring)).collect(),
            to: thickness + mark.height,
        }));
        let mut holes = Vec::new();
        for opening in &fittings.openings {
            let ring = self.hole(&opening.ring)?;
            holes.push(Through { ring, from: Level::Bottom, to: Level::Top });
        }
        if let Some(bore) = &gear.bore {
            holes.push(Through { ring: self.hole(bore)?, from: Level::Bottom, to: top });
        }
        Ok(Stack { outline: self.ring(&gear.outline, false)?, height: thickness, steps, holes })
    }

    /// A part beside the gears: a plate with posts, holes and pockets.
    fn fixture(&self, fixture: &Fixture) -> Result<Stack, String> {
        let height = fixture.thickness;
        let mut steps: Vec<Figure> = Vec::new();
        // Upper face that something stands on or is sunk into.
        let upper = |at: f64, ring: &[Point]| {
            let below = |p: &Post| p.to == at && geometry::contains(&p.ring, ring[0]);
            fixture.posts.iter().position(below).map_or(Level::Top, Level::Step)
        };
        for post in &fixture.posts {
            let rings = vec![self.ring(&post.ring, true)?];
            steps.push(Figure { on: upper(post.from, &post.ring), rings, to: post.to });
        }
        for pocket in &fixture.pockets {
            let rings = vec![self.ring(&pocket.ring, true)?];
            let below = pocket.from == 0.0;
            let (on, to) = if below {
                (Level::Bottom, pocket.to)
            } else {
                (upper(pocket.to, &pocket.ring), pocket.from)
            };
            steps.push(Figure { on, rings, to });
        }
        let mut holes = Vec::new();
        for (i, hole) in fixture.holes.iter().enumerate() {
            let (mut from, mut to) = (Level::Bottom, Level::Top);
            let highest = fixture.posts.iter().enumerate().filter(|(_, p)| p.hole == Some(i));
            if let Some((post, _)) = highest.max_by(|a, b| a.1.to.total_cmp(&b.1.to)) {
                to = Level::Step(post);
            }
            for (k, pocket) in fixture.pockets.iter().enumerate() {
                if pocket.hole == Some(i) {
                    let end = Level::Step(fixture.posts.len() + k);
                    *(if pocket.from == 0.0 { &mut from } else { &mut to }) = end;
                }
            }
            holes.push(Through { ring: self.hole(hole)?, from, to });
        }
        Ok(Stack { outline: self.ring(&fixture.outline, true)?, height, steps, holes })
    }

    /// The stretches of a hole, clockwise.
    fn hole(&self, points: &[Point]) -> Result<Vec<Stretch>, String> {
        Ok(self.ring(points, true)?.iter().rev().map(prism::reversed).collect())
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

/// The edges of a ring as they are.
fn straight(points: &[Point]) -> Vec<Stretch> {
    let ends = points.iter().zip(points.iter().cycle().skip(1));
    ends.map(|(a, b)| Stretch::Line(Arc::line(*a, *b))).collect()
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

/// A frame as a pose moves it.
fn place(e: &mut Entities, pose: &Isometry3<f64>) -> Id {
    let axis = |v: Vector3<f64>| (pose.rotation * v).into();
    let at: [f64; 3] = pose.translation.vector.into();
    e.frame(at, axis(Vector3::z()), axis(Vector3::x()))
}

#[cfg(test)]
mod tests {
    use super::super::tests::wavy_pair;
    use super::*;
    use std::collections::HashMap;

    fn written() -> String {
        written_of(&wavy_pair().0)
    }

    fn written_of(assembly: &Assembly) -> String {
        let folder = tempfile::tempdir().unwrap();
        let parts = Parts { assembly, meshes: &[] };
        let path = Step::default().write(parts, folder.path()).unwrap().remove(0);
        std::fs::read_to_string(path).unwrap()
    }

    #[test]
    fn every_edge_is_used_once_each_way() {
        let text = written();
        let (edges, inner_loops) = (closed(&text), 4);
        let count = |what: &str| text.lines().filter(|l| l.contains(what)).count();
        // Euler: a ring with a hole through it has V - E + F = 0 once the two cap loops are counted.
        assert_eq!(count("=FACE_BOUND("), inner_loops);
        assert_eq!(count("=VERTEX_POINT(") + count("=ADVANCED_FACE("), edges + inner_loops);
        assert_eq!(count("=MANIFOLD_SOLID_BREP("), 2);
        assert_eq!(
            count("=CYLINDRICAL_SURFACE("),
            2 + 4,
            "both halves of the round bore and the four fillets of the cross"
        );
    }

    /// Passes shells in which every edge is used once each way; how many edges.
    fn closed(text: &str) -> usize {
        let mut uses: HashMap<&str, [u32; 2]> = HashMap::new();
        for line in text.lines().filter(|l| l.contains("=ORIENTED_EDGE(")) {
            let inside = line.split_once("*,*,").unwrap().1;
            let (edge, sense) = inside.split_once(',').unwrap();
            uses.entry(edge).or_default()[usize::from(sense.starts_with(".T."))] += 1;
        }
        let edges = text.lines().filter(|l| l.contains("=EDGE_CURVE(")).count();
        assert_eq!(uses.len(), edges);
        assert!(uses.values().all(|&u| u == [1, 1]));
        edges
    }

    #[test]
    fn steps_holes_pockets_and_letters_close_too() {
        use crate::assembly::{Hub, Mark, Pocket, Stance};
        let ring = |x: f64, r: f64| -> Vec<Point> {
            crate::solid::circle(r, 0.01).iter().map(|p| Point::new(p.x + x, p.y)).collect()
        };
        let back = |x, r| ring(x, r).into_iter().rev().collect();
        let (mut assembly, _) = wavy_pair();
        let fittings = &mut assembly.gears[0].gear.fittings;
        fittings.hub = Some(Hub { radius: 8.0, height: 4.0, set_screw: None });
        for (x, height) in [(18.0, 0.6), (-18.0, -0.4)] {
            let face = vec![ring(x, 4.0), back(x, 2.0)];
            fittings.marks.push(Mark { name: "O".to_owned(), face, height });
        }
        let post = |x, r, hole, from, to| Post { ring: ring(x, r), hole, from, to };
        assembly.fixtures.push(Fixture {
            holes: vec![ring(40.0, 2.0)],
            posts: vec![
                post(0.0, 5.0, None, 4.0, 5.0),
                post(0.0, 2.0, None, 5.0, 9.0),
                post(40.0, 6.0, Some(0), 4.0, 5.0),
            ],
            pockets: vec![
                Pocket { ring: ring(40.0, 3.0), hole: Some(0), from: 0.0, to: 2.0 },
                Pocket { ring: ring(40.0, 4.0), hole: Some(0), from: 3.0, to: 5.0 },
                Pocket { ring: ring(70.0, 4.0), hole: None, from: 3.0, to: 4.0 },
            ],
            stance: Stance::on_edge([1.0, 2.0, 3.0]).turning_with(1),
            ..super::super::tests::base()
        });
        let text = written_of(&assembly);
        let edges = closed(&text);
        let count = |what: &str| text.lines().filter(|l| l.contains(what)).count();
        assert_eq!(count("=MANIFOLD_SOLID_BREP("), 3);
        // Inner loops: two caps and the hub's end of the first gear with its foot and two letters, and the letters' ends;
        // two caps of the second; of the plate those of a post, the pin on it, the post about the hole, the hole's two
        // ends, and the three pockets.
        let inner = (1 + 1 + 1 + 2 + 2) + 2 + (1 + 1 + 1 + 2 + 3);
        assert_eq!(count("=FACE_BOUND("), inner);
        // V - E + F - inner loops = 2 (bodies - holes).
        assert_eq!(count("=VERTEX_POINT(") + count("=ADVANCED_FACE("), edges + inner);
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
