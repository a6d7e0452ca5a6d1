//! SVG for laser cutters: millimetres, hairlines, layers in the order of work, room for the kerf.

use super::contours::{Contour, contour};
use super::flat::{Flat, flat};
use super::xml::escaped;
use super::{Artifact, Encode, EncodeError, Entry, Parts, Picture};
use crate::assembly::{Assembly, Fixture, Gear};
use crate::geometry::curves::Arc;
use crate::geometry::{self, Point, Vector};
use crate::policy;
use std::fmt::Write as _;

/// `laser.svg`: the parts side by side, never overlapping, with the marks (and the pitch curves, if asked for) to engrave in
/// blue, then the holes and last the outlines to cut in red, each in its own layer: a beam that follows the file cuts inside
/// out, so that no part moves before it is done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaserSvg {
    /// Width that the beam burns away, mm: outlines move outward and bores inward by half of it.
    pub kerf: f64,
    /// Greatest distance between a vertex of the outline and the arcs, mm.
    pub tolerance: f64,
    /// Whether the pitch curves are engraved.
    pub pitch_curves: bool,
}

impl Default for LaserSvg {
    fn default() -> Self {
        Self { kerf: 0.0, tolerance: policy::EXPORT_TOLERANCE, pitch_curves: false }
    }
}

/// See [`Entry`].
pub(super) const ENTRY: Entry = Entry {
    name: "svg",
    files: &[
        (&["pair.svg"], "the picture, 1:1 in millimetres"),
        (
            &["laser.svg"],
            "laser cutters: hairlines in millimetres, cut and engrave layers inside out, `--kerf`, `--laser-pitch-curves`",
        ),
    ],
    encoders: |options| {
        let laser = LaserSvg {
            kerf: options.kerf,
            tolerance: options.curve_tolerance,
            pitch_curves: options.laser_pitch_curves,
        };
        vec![Box::new(Picture), Box::new(laser)]
    },
    ..Entry::PLAIN
};

impl Encode for LaserSvg {
    fn encode<'a>(&'a self, parts: Parts<'a>) -> Result<Vec<Artifact<'a>>, EncodeError> {
        let text = self.sheet(parts.assembly).map_err(|why| EncodeError::new("laser.svg", why))?;
        Ok(vec![Artifact::bytes("laser.svg", text)])
    }
}

/// What the beam does to one part, in the part's frame.
struct Work {
    name: String,
    outline: Contour,
    bore: Option<Contour>,
    openings: Vec<Contour>,
    /// What is engraved, as SVG: what is sunk into or raised on the face, and the axis of a gear without a bore.
    engraved: String,
    low: Point,
    high: Point,
}

impl LaserSvg {
    fn sheet(&self, assembly: &Assembly) -> Result<String, String> {
        let gears = assembly.gears.iter().map(|g| self.work(&g.gear));
        let plates = assembly.fixtures.iter().filter_map(|f| Some(self.plate(f, &flat(f)?)));
        let works: Vec<Work> = gears.chain(plates).collect::<Result<_, _>>()?;
        let gap = policy::SHEET_GAP;
        let mut shifts = Vec::new();
        let (mut right, mut height) = (gap, 0.0_f64);
        for work in &works {
            // Down the page: the sheet's y is turned when it is written.
            shifts.push(Vector::new(right - work.low.x, -gap - work.high.y));
            right += work.high.x - work.low.x + gap;
            height = height.max(work.high.y - work.low.y + 2.0 * gap);
        }
        let mut svg = String::new();
        let names: Vec<&str> = assembly.gears.iter().map(|g| g.gear.name.as_str()).collect();
        let _ = write!(
            svg,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" \
             xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" \
             width=\"{right:.3}mm\" height=\"{height:.3}mm\" viewBox=\"0 0 {right:.3} {height:.3}\" \
             fill=\"none\" stroke-width=\"{}\">\n<title>{}</title>\n<desc>1 unit = 1 mm; kerf {} mm\
             </desc>\n",
            policy::HAIRLINE,
            escaped(&names.join(" and ")),
            self.kerf
        );
        let mut layer = |name: &str, color: &str, pick: &dyn Fn(&Work) -> String| {
            let _ = writeln!(
                svg,
                "<g id=\"{name}\" inkscape:groupmode=\"layer\" inkscape:label=\"{name}\" \
                 stroke=\"{color}\">"
            );
            for (work, shift) in works.iter().zip(&shifts) {
                let drawn = pick(work);
                if !drawn.is_empty() {
                    let _ = writeln!(
                        svg,
                        "<g id=\"{}-{name}\" transform=\"translate({:.4} {:.4})\">{drawn}</g>",
                        escaped(&work.name),
                        shift.x,
                        0.0 - shift.y
                    );
                }
            }
            svg.push_str("</g>\n");
        };
        layer("engrave", "#0000ff", &|w| w.engraved.clone());
        layer("cut-bores", "#ff0000", &|w| w.openings.iter().chain(&w.bore).map(drawn).collect());
        layer("cut-outlines", "#ff0000", &|w| drawn(&w.outline));
        svg.push_str("</svg>\n");
        Ok(svg)
    }

    /// A contour of a hole, smaller by the kerf.
    fn hole(&self, ring: &[Point], what: &str) -> Result<Contour, String> {
        let half = 0.5 * self.kerf;
        let narrow = || format!("the kerf closes {what}");
        Ok(match contour(ring, self.tolerance, true, false)? {
            Contour::Round { radius, .. } if radius <= half => return Err(narrow()),
            Contour::Round { center, radius } => Contour::Round { center, radius: radius - half },
            path @ Contour::Path(_) if half == 0.0 => path,
            Contour::Path(_) => {
                let smaller = moved(ring, -half).ok_or_else(narrow)?;
                contour(&smaller, self.tolerance, true, false)?
            }
        })
    }

    /// A plate beside the gears.
    fn plate(&self, fixture: &Fixture, cut: &Flat<'_>) -> Result<Work, String> {
        let what = format!("a hole of the {}", fixture.name);
        let holes = cut.holes.iter().map(|ring| self.hole(ring, &what));
        let outline = moved(cut.outline, 0.5 * self.kerf)
            .ok_or_else(|| format!("half a kerf closes gaps of the {}", fixture.name))?;
        let (low, high) = geometry::bounds(&outline);
        Ok(Work {
            name: fixture.name.clone(),
            outline: contour(&outline, self.tolerance, true, false)?,
            bore: None,
            openings: holes.collect::<Result<_, _>>()?,
            engraved: String::new(),
            low,
            high,
        })
    }

    fn work(&self, gear: &Gear) -> Result<Work, String> {
        if !(0.0..=policy::LARGEST_KERF).contains(&self.kerf) {
            return Err(format!(
                "a kerf of {:e} mm is out of range, give 0 to {} mm",
                self.kerf,
                policy::LARGEST_KERF
            ));
        }
        let half = 0.5 * self.kerf;
        let outline = moved(&gear.outline, half)
            .ok_or_else(|| format!("half a kerf closes gaps of the {}", gear.name))?;
        let hole = |ring: &[Point], name: &str| {
            self.hole(ring, &format!("the {name} of the {}", gear.name))
        };
        let bore = gear.bore.as_ref().map(|ring| hole(ring, "bore")).transpose()?;
        let openings = &gear.fittings.openings;
        let openings = openings.iter().map(|o| hole(&o.ring, &o.name)).collect::<Result<_, _>>()?;
        let marks = gear.fittings.marks.iter().flat_map(|m| &m.face);
        let mut engraved: String = marks.map(|ring| polyline(ring)).collect();
        if self.pitch_curves {
            let coarse = policy::DRAWN_CURVE_TOLERANCE.max(self.tolerance);
            engraved += &drawn(&contour(&gear.pitch_curve, coarse, false, false)?);
        }
        if bore.is_none() {
            engraved += &cross();
        }
        let (low, high) = geometry::bounds(&outline);
        Ok(Work {
            name: gear.name.clone(),
            outline: contour(&outline, self.tolerance, false, false)?,
            bore,
            openings,
            engraved,
            low,
            high,
        })
    }
}

/// The ring offset outward, when it stays one ring.
fn moved(ring: &[Point], distance: f64) -> Option<Vec<Point>> {
    if distance == 0.0 {
        return Some(ring.to_vec());
    }
    let mut faces = geometry::offset(ring, distance, policy::KERF_CHORD);
    match (faces.pop(), faces.is_empty()) {
        (Some(mut face), true) if face.len() == 1 => face.pop(),
        _ => None,
    }
}

/// A ring as an SVG element, y turned downwards.
fn polyline(ring: &[Point]) -> String {
    let mut d = String::new();
    for (i, p) in ring.iter().enumerate() {
        let _ = write!(d, "{}{:.4} {:.4}", if i == 0 { "M " } else { " L " }, p.x, 0.0 - p.y);
    }
    format!("<path d=\"{d} Z\"/>")
}

/// Marks the axis of a gear without a bore.
fn cross() -> String {
    let s = policy::AXIS_MARK;
    format!("<path d=\"M {} 0 H {s} M 0 {} V {s}\"/>", -s, -s)
}

/// The contour as an SVG element, y turned downwards.
fn drawn(contour: &Contour) -> String {
    match contour {
        Contour::Round { center, radius } => {
            format!(
                "<circle cx=\"{:.5}\" cy=\"{:.5}\" r=\"{radius:.5}\"/>",
                center.x,
                0.0 - center.y
            )
        }
        Contour::Path(path) => {
            let mut d = String::new();
            for (i, arc) in path.arcs().iter().enumerate() {
                if i == 0 {
                    let _ = write!(d, "M {:.5} {:.5}", arc.from.x, 0.0 - arc.from.y);
                }
                segment(&mut d, arc);
            }
            format!("<path d=\"{d} Z\"/>")
        }
    }
}

fn segment(d: &mut String, arc: &Arc) {
    let (x, y) = (arc.to.x, 0.0 - arc.to.y);
    if arc.bulge == 0.0 {
        let _ = write!(d, " L {x:.5} {y:.5}");
    } else {
        let radius = arc.radius();
        let large = u8::from(arc.angle().abs() > std::f64::consts::PI);
        // Counter-clockwise to the eye is against the sense of SVG's downward axes.
        let sweep = u8::from(arc.bulge < 0.0);
        let _ = write!(d, " A {radius:.5} {radius:.5} 0 {large} {sweep} {x:.5} {y:.5}");
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::wavy_pair;
    use super::*;

    fn sheet(kerf: f64) -> Result<String, String> {
        LaserSvg { kerf, ..LaserSvg::default() }.sheet(&wavy_pair().0)
    }

    #[test]
    fn the_sheet_is_millimetres_in_layers_in_the_order_of_work() {
        let text = sheet(0.0).unwrap();
        let tree = usvg::Tree::from_str(&text, &usvg::Options::default()).unwrap();
        // 96 dpi: 25.4 mm are 96 px. Two gears 85 mm wide and three gaps.
        let millimetres = |px: f32| f64::from(px) * 25.4 / 96.0;
        assert!((millimetres(tree.size().width()) - 185.0).abs() < 0.2);
        assert!((millimetres(tree.size().height()) - 95.0).abs() < 0.2);
        let at = |what: &str| text.find(what).unwrap();
        assert!(at("engrave") < at("cut-bores") && at("cut-bores") < at("cut-outlines"));
        assert_eq!(text.matches("<circle").count(), 1);
    }

    #[test]
    fn the_kerf_widens_outlines_and_narrows_bores() {
        let (assembly, _) = wavy_pair();
        let gear = &assembly.gears[0].gear;
        let area = |kerf| {
            let work = LaserSvg { kerf, ..LaserSvg::default() }.work(gear).unwrap();
            let area = |arcs: Vec<Arc>| -> f64 {
                let chord = |a: &Arc| 0.5 * geometry::cross(a.from.coords, a.to.coords);
                arcs.iter().map(|a| chord(a) + a.segment_area()).sum()
            };
            (area(work.outline.arcs()), area(work.bore.unwrap().arcs()))
        };
        let (plain, kerfed) = (area(0.0), area(0.2));
        let perimeter = geometry::perimeter(&gear.outline);
        assert!((kerfed.0 - plain.0 - 0.1 * perimeter).abs() < 0.5, "{plain:?} {kerfed:?}");
        assert!((plain.1 - std::f64::consts::PI * 6.25).abs() < 1e-9);
        assert!((kerfed.1 - std::f64::consts::PI * 2.4 * 2.4).abs() < 1e-9);
    }

    #[test]
    fn openings_are_cut_before_outlines_and_marks_engraved() {
        let (mut assembly, _) = wavy_pair();
        let ring = |x: f64| -> Vec<Point> {
            crate::solid::circle(3.0, 0.005).iter().map(|p| Point::new(p.x + x, p.y)).collect()
        };
        let fittings = &mut assembly.gears[0].gear.fittings;
        let name = "screw 1".to_owned();
        fittings.openings.push(crate::assembly::Opening { name: name.clone(), ring: ring(15.0) });
        let face = vec![ring(-15.0)];
        fittings.marks.push(crate::assembly::Mark { name, face, height: -0.4 });
        let plain = LaserSvg::default().sheet(&assembly).unwrap();
        let layer = |name: &str| plain.split(&format!("id=\"{name}\"")).nth(1).unwrap().to_owned();
        assert!(layer("cut-bores").split("cut-outlines").next().unwrap().contains("r=\"2.99"));
        assert!(layer("engrave").split("cut-bores").next().unwrap().contains("M -12.0"));
        let gear = &mut assembly.gears[0].gear;
        gear.bore = None;
        gear.fittings.openings[0].ring = crate::solid::circle(1.5, 0.005);
        let wide = LaserSvg { kerf: 4.0, ..LaserSvg::default() };
        assert!(wide.work(gear).err().is_some_and(|said| said.contains("screw 1")));
    }

    #[test]
    fn pitch_curves_are_engraved_on_request_and_plates_are_cut() {
        let (mut assembly, _) = wavy_pair();
        let layer = |text: &str| {
            let engrave = text.split("id=\"engrave\"").nth(1).unwrap();
            engrave.split("id=\"cut-bores\"").next().unwrap().matches("<path").count()
        };
        let plain = LaserSvg::default();
        assert_eq!(layer(&plain.sheet(&assembly).unwrap()), 0);
        let with = LaserSvg { pitch_curves: true, ..plain };
        assert_eq!(layer(&with.sheet(&assembly).unwrap()), 2);
        assembly.fixtures.push(super::super::tests::base());
        let text = plain.sheet(&assembly).unwrap();
        assert!(text.contains("base-cut-outlines"));
    }

    #[test]
    fn a_kerf_that_closes_a_bore_is_refused() {
        assert!(sheet(4.9).unwrap_err().contains("bore"));
        for kerf in [-0.1, f64::NAN, 6.0] {
            assert!(sheet(kerf).unwrap_err().contains("kerf"), "{kerf}");
        }
    }
}
