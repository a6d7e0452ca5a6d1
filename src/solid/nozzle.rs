//! What of a pair a printer's nozzle cannot draw, and what to change.
//!
//! A nozzle draws lines of its own width: material thinner than that is left out or comes out too thick, and a gap
//! narrower than that closes.

use crate::assembly::{Assembly, Gear};
use crate::geometry::{self, Point};
use std::fmt;

/// The usual nozzle, mm.
pub const NOZZLE: f64 = 0.4;

/// Lines side by side that make a wall: one of them alone breaks along its layers.
const WALL_LINES: f64 = 2.0;
/// Nozzles in a module: below it a tooth is two lines thick at its pitch curve.
const MODULE_LINES: f64 = 2.5;
/// Gap a face that a printer needs, in nozzles: what outlines come out too thick by.
const GAP_LINES: f64 = 0.25;
/// Lines across a pin that does not snap.
const PIN_LINES: f64 = 6.0;
/// How much of a tip or root may be lost, in nozzles: square corners lose a fifth.
const LOSS: f64 = 0.5;
/// Chords of the corners that an offset rounds, radians of arc.
const CHORD: f64 = 0.2;

/// Something that will not print as drawn. Lengths in mm.
#[derive(Clone, Debug, PartialEq)]
pub enum PrintFinding {
    /// Teeth too fine for the nozzle.
    Module {
        /// The module.
        module: f64,
        /// The least for this nozzle.
        least: f64,
    },
    /// Gears that will rub where the printer draws outlines a little too thick.
    Gap {
        /// Gap left on each face.
        clearance: f64,
        /// The least for this nozzle.
        least: f64,
    },
    /// Tips of teeth that are thinner than a line.
    Tips {
        /// Name of the gear.
        gear: String,
        /// How many places.
        places: usize,
        /// Where the worst is, in the gear's frame.
        at: Point,
        /// How much is lost there.
        lost: f64,
    },
    /// Roots or slots narrower than a line.
    Roots {
        /// Name of the gear.
        gear: String,
        /// How many places.
        places: usize,
        /// Where the worst is, in the gear's frame.
        at: Point,
        /// How much is filled there.
        filled: f64,
    },
    /// A wall of fewer than two lines.
    Wall {
        /// Name of the part.
        part: String,
        /// What it is between.
        between: String,
        /// Its thickness.
        wall: f64,
        /// The least for this nozzle.
        least: f64,
    },
    /// Letters with strokes thinner than a line.
    Letters {
        /// Name of the gear.
        gear: String,
        /// Width of the thinnest stroke.
        stroke: f64,
        /// Height of letters that would print, relative to these.
        larger: f64,
    },
    /// A pin of few lines.
    Pin {
        /// Name of the part.
        part: String,
        /// Its diameter.
        diameter: f64,
        /// The least for this nozzle.
        least: f64,
    },
}

impl fmt::Display for PrintFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Module { module, least } => write!(
                f,
                "a module of {module:.2} mm is too fine; give fewer --teeth or a larger --center-distance, for a module of {least:.2} mm or more"
            ),
            Self::Gap { clearance, least } => write!(
                f,
                "a gap of {clearance:.2} mm a face will rub; give --clearance {least:.2}mm, or print with a horizontal expansion of -{:.2} mm",
                least - clearance
            ),
            Self::Tips { gear, places, at, lost } => write!(
                f,
                "{places} tips of the {gear} are thinner than a line and end {lost:.2} mm short, the worst at ({:.1}, {:.1}) mm; give fewer --teeth or a smaller --addendum",
                at.x, at.y
            ),
            Self::Roots { gear, places, at, filled } => write!(
                f,
                "{places} gaps of the {gear} are narrower than a line and close by {filled:.2} mm, the worst at ({:.1}, {:.1}) mm; give fewer --teeth or more --root-clearance",
                at.x, at.y
            ),
            Self::Wall { part, between, wall, least } => write!(
                f,
                "the wall of the {part} between {between} is {wall:.2} mm, less than two lines; make room for {least:.2} mm with a smaller --bore, hole or hub"
            ),
            Self::Letters { gear, stroke, larger } => write!(
                f,
                "strokes of the letters on the {gear} are {stroke:.2} mm, thinner than a line; shorten the text, or make the letters {larger:.1} times as high with --letter-height"
            ),
            Self::Pin { part, diameter, least } => write!(
                f,
                "a pin of the {part} is {diameter:.2} mm thick and will snap; give a larger --bore for a pin of {least:.1} mm, or --base with a screw such as M4"
            ),
        }
    }
}

/// What of the finished gears and of what they stand on a nozzle of this width (mm) cannot draw. `clearance` is the gap
/// left on each face, mm.
#[must_use]
pub fn print_findings(
    assembly: &Assembly,
    module: f64,
    clearance: f64,
    nozzle: f64,
) -> Vec<PrintFinding> {
    let mut found = Vec::new();
    let least = MODULE_LINES * nozzle;
    if module < least {
        found.push(PrintFinding::Module { module, least });
    }
    let least = GAP_LINES * nozzle;
    if clearance < least - 1e-9 {
        found.push(PrintFinding::Gap { clearance, least });
    }
    for placed in &assembly.gears {
        of_a_gear(&placed.gear, nozzle, &mut found);
    }
    for fixture in &assembly.fixtures {
        let carries = |post: &crate::assembly::Post| {
            fixture
                .posts
                .iter()
                .any(|p| p.from == post.to && geometry::contains(&post.ring, p.ring[0]))
        };
        let pins = fixture.posts.iter().filter(|p| p.hole.is_none() && !carries(p));
        let width = |ring: &[Point]| {
            let (low, high) = geometry::bounds(ring);
            (high.x - low.x).min(high.y - low.y)
        };
        let least = PIN_LINES * nozzle;
        let thin = pins.map(|p| width(&p.ring)).filter(|d| *d < least);
        if let Some(diameter) = thin.min_by(f64::total_cmp) {
            let part = fixture.name.clone();
            found.push(PrintFinding::Pin { part, diameter, least });
        }
    }
    found
}

fn of_a_gear(gear: &Gear, nozzle: f64, found: &mut Vec<PrintFinding>) {
    let name = &gear.name;
    if let Some(Lost { places, at, depth }) = lost(&gear.outline, 0.5 * nozzle, LOSS * nozzle) {
        found.push(PrintFinding::Tips { gear: name.clone(), places, at, lost: depth });
    }
    if let Some(Lost { places, at, depth }) = lost(&gear.outline, -0.5 * nozzle, LOSS * nozzle) {
        found.push(PrintFinding::Roots { gear: name.clone(), places, at, filled: depth });
    }
    let least = WALL_LINES * nozzle;
    let fittings = &gear.fittings;
    let hub = fittings.hub.map(|h| super::circle(h.radius, crate::policy::BORE_CHORD_TOLERANCE));
    let mut holes: Vec<(&str, &[Point])> =
        fittings.openings.iter().map(|o| (o.name.as_str(), o.ring.as_slice())).collect();
    if let Some(bore) = &gear.bore {
        holes.push(("bore", bore));
        if let Some(hub) = &hub {
            wall(name, ["bore", "the hub's edge"], bore, hub, least, found);
        }
    }
    for (i, (what, ring)) in holes.iter().enumerate() {
        wall(name, [what, "the teeth"], ring, &gear.outline, least, found);
        for (other, second) in &holes[..i] {
            wall(name, [what, other], ring, second, least, found);
        }
    }
    // A stroke's area is its width times its length, and its edge twice its length.
    let stroke = |mark: &crate::assembly::Mark| {
        let (outer, inner) = mark.face.split_first()?;
        let area = geometry::area(outer) - inner.iter().map(|h| geometry::area(h)).sum::<f64>();
        let edge: f64 = mark.face.iter().map(|r| geometry::perimeter(r)).sum();
        Some(2.0 * area / edge)
    };
    let letters = fittings.marks.iter().filter(|m| m.name.starts_with("letter"));
    if let Some(stroke) = letters.filter_map(stroke).min_by(f64::total_cmp)
        && stroke < nozzle
    {
        let larger = nozzle / stroke;
        found.push(PrintFinding::Letters { gear: name.clone(), stroke, larger });
    }
}

fn wall(
    part: &str,
    between: [&str; 2],
    a: &[Point],
    b: &[Point],
    least: f64,
    found: &mut Vec<PrintFinding>,
) {
    let wall = super::wall::distance_between(a, b);
    if wall < least - 1e-9 {
        let between = between.join(" and ");
        found.push(PrintFinding::Wall { part: part.to_owned(), between, wall, least });
    }
}

/// Parts of a ring that a round tool does not reach.
struct Lost {
    places: usize,
    at: Point,
    depth: f64,
}

/// What a disc of radius |`tool`| leaves of a ring, from inside or, for a negative radius, from outside; places that miss
/// more than `allowed` count.
fn lost(ring: &[Point], tool: f64, allowed: f64) -> Option<Lost> {
    let drawn: Vec<Vec<Point>> = geometry::offset(ring, -tool, CHORD)
        .iter()
        .flat_map(|face| geometry::offset(&face[0], tool, CHORD))
        .filter_map(|face| face.into_iter().next())
        .collect();
    let pieces = if tool > 0.0 {
        geometry::difference(ring, &drawn)
    } else {
        let ring = [ring.to_vec()];
        drawn.iter().flat_map(|filled| geometry::difference(filled, &ring)).collect()
    };
    let edges = super::wall::Edges::new(&drawn);
    let far = |piece: &geometry::Face| {
        let depth = |p: &Point| (edges.distance_to(*p), *p);
        piece[0].iter().map(depth).max_by(|a, b| a.0.total_cmp(&b.0))
    };
    let deep: Vec<(f64, Point)> =
        pieces.iter().filter_map(far).filter(|(depth, _)| *depth > allowed).collect();
    let (depth, at) = deep.iter().copied().max_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(Lost { places: deep.len(), at, depth })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assembly::{Fittings, Hub, Mark, Opening};
    use crate::solid::Bore;
    use crate::solid::{circle, tests::wavy};

    /// A square of 20 mm about the origin with a spike or a slot of some width on its right.
    fn square(width: f64, length: f64) -> Vec<Point> {
        let h = 0.5 * width;
        let at = 10.0 + length;
        [
            (-10.0, -10.0),
            (10.0, -10.0),
            (10.0, -h),
            (at, -h),
            (at, h),
            (10.0, h),
            (10.0, 10.0),
            (-10.0, 10.0),
        ]
        .map(|(x, y)| Point::new(x, y))
        .to_vec()
    }

    #[test]
    fn what_is_thinner_than_a_line_is_lost_and_what_is_wider_is_not() {
        let found = |ring: &[Point], tool| lost(ring, tool, 0.2).map(|l| (l.places, l.depth));
        for length in [3.0_f64, -3.0] {
            let tool = 0.2 * length.signum();
            let (places, depth) = found(&square(0.3, length), tool).unwrap();
            assert!(places == 1 && (depth - 3.0).abs() < 0.15, "{places} {depth}");
            assert_eq!(found(&square(0.5, length), tool), None);
        }
    }

    #[test]
    fn every_part_is_measured() {
        let mut gear = wavy("driver", 640, Bore::Round { diameter: 5.0 });
        let ring = |x: f64, r: f64| -> Vec<Point> {
            circle(r, 0.005).iter().map(|p| Point::new(p.x + x, p.y)).collect()
        };
        let bar = |w: f64| {
            [(10.0, 15.0), (16.0, 15.0), (16.0, 15.0 + w), (10.0, 15.0 + w)]
                .map(|(x, y)| Point::new(x, y))
                .to_vec()
        };
        gear.fittings = Fittings {
            openings: vec![
                Opening { name: "screw 1".into(), ring: ring(10.0, 2.0) },
                Opening { name: "screw 2".into(), ring: ring(14.5, 2.0) },
            ],
            hub: Some(Hub { radius: 3.2, height: 4.0, set_screw: None }),
            marks: vec![Mark { name: "letter 1".into(), face: vec![bar(0.3)], height: 0.6 }],
            chamfer: 0.0,
        };
        let mut found = Vec::new();
        of_a_gear(&gear, 0.4, &mut found);
        let walls: Vec<f64> = found
            .iter()
            .filter_map(
                |f| if let PrintFinding::Wall { wall, .. } = f { Some(*wall) } else { None },
            )
            .collect();
        assert!(walls.len() == 2 && (walls[0] - 0.7).abs() < 0.02 && (walls[1] - 0.5).abs() < 0.02);
        let stroke = found.iter().find_map(|f| match f {
            PrintFinding::Letters { stroke, .. } => Some(*stroke),
            _ => None,
        });
        assert!(stroke.is_some_and(|s| (s - 0.2857).abs() < 0.001), "{stroke:?}");
        found.clear();
        gear.fittings.openings.pop();
        gear.fittings.marks[0].face = vec![bar(0.8)];
        gear.fittings.hub = None;
        of_a_gear(&gear, 0.4, &mut found);
        assert_eq!(found, Vec::new());
    }
}
