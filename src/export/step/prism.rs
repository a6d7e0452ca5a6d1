//! The solid between two planes whose sides stand on closed rings.

use super::entities::{Entities, Id, real};
use crate::geometry::curves::{Arc, Stretch};
use crate::geometry::{Point, quarter_turn};

/// The stretch walked the other way.
pub(super) fn reversed(stretch: &Stretch) -> Stretch {
    let back = |a: &Arc| Arc { from: a.to, to: a.from, bulge: -a.bulge };
    match stretch {
        Stretch::Line(arc) => Stretch::Line(back(arc)),
        Stretch::Arc(arc) => Stretch::Arc(back(arc)),
        Stretch::Cubic(path) => Stretch::Cubic(path.reversed()),
    }
}

/// One ring's edges: at the bottom, at the top, and upright at the start of each stretch.
struct Edges {
    bottom: Vec<Id>,
    top: Vec<Id>,
    upright: Vec<Id>,
    /// Curves of the bottom edges.
    curves: Vec<Id>,
}

/// What stands on what: every ring with the material on its left, the outer one counter-clockwise, holes
/// clockwise. Heights in mm.
pub(super) struct Stack {
    /// The outline.
    pub(super) outline: Vec<Stretch>,
    /// Holes through the body.
    pub(super) openings: Vec<Vec<Stretch>>,
    /// The hole through body and hub.
    pub(super) bore: Option<Vec<Stretch>>,
    /// Height of the body.
    pub(super) height: f64,
    /// What stands on the body, counter-clockwise, and the height of its top.
    pub(super) hub: Option<(Vec<Stretch>, f64)>,
}

/// The solid of a stack, from z = 0 on. Edges are shared by the faces that meet in them.
///
/// # Errors
/// Half a sentence when a ring does not close.
pub(super) fn solid(e: &mut Entities, name: &str, stack: &Stack) -> Result<Id, String> {
    let mut faces = Vec::new();
    let top = stack.hub.as_ref().map_or(stack.height, |hub| hub.1);
    let outline = wall(e, &stack.outline, [0.0, stack.height], &mut faces)?;
    let mut openings = Vec::new();
    for ring in &stack.openings {
        openings.push(wall(e, ring, [0.0, stack.height], &mut faces)?);
    }
    let bore = match &stack.bore {
        Some(ring) => Some(wall(e, ring, [0.0, top], &mut faces)?),
        None => None,
    };
    let hub = match &stack.hub {
        Some((ring, top)) => Some(wall(e, ring, [stack.height, *top], &mut faces)?),
        None => None,
    };
    // From below a ring runs the other way.
    let below = |edges: &Edges| edges.bottom.iter().rev().map(|&i| (i, false)).collect::<Vec<_>>();
    let above = |edges: &Edges| edges.top.iter().map(|&i| (i, true)).collect::<Vec<_>>();
    let mut underside = vec![below(&outline)];
    underside.extend(openings.iter().chain(&bore).map(below));
    let mut face = vec![above(&outline)];
    face.extend(openings.iter().map(above));
    match &hub {
        // The foot of the hub is a hole in the face that it stands on.
        Some(hub) => face.push(below(hub)),
        None => face.extend(bore.iter().map(above)),
    }
    let mut levels = vec![(0.0, false, underside), (stack.height, true, face)];
    if let Some(hub) = &hub {
        levels.push((top, true, std::iter::once(hub).chain(&bore).map(above).collect()));
    }
    for (z, up, loops) in levels {
        let bounds: Vec<Id> = loops
            .iter()
            .enumerate()
            .map(|(i, around)| {
                let bound = if i == 0 { "FACE_OUTER_BOUND" } else { "FACE_BOUND" };
                bounded(e, bound, around)
            })
            .collect();
        let frame = e.frame([0.0, 0.0, z], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
        let plane = e.add(format!("PLANE('',{frame})"));
        faces.push(e.add(format!("ADVANCED_FACE('',({}),{plane},{})", list(&bounds), flag(up))));
    }
    let shell = e.add(format!("CLOSED_SHELL('',({}))", list(&faces)));
    Ok(e.add(format!("MANIFOLD_SOLID_BREP({name},{shell})")))
}

/// The upright faces over a ring between two heights, and the ring's edges.
fn wall(
    e: &mut Entities,
    ring: &[Stretch],
    heights: [f64; 2],
    faces: &mut Vec<Id>,
) -> Result<Edges, String> {
    if ring.len() < 2 {
        return Err("a ring has fewer than two edges".to_owned());
    }
    let edges = edges(e, ring, heights);
    for (i, stretch) in ring.iter().enumerate() {
        let next = (i + 1) % ring.len();
        let around = [
            (edges.bottom[i], true),
            (edges.upright[next], true),
            (edges.top[i], false),
            (edges.upright[i], false),
        ];
        let bound = bounded(e, "FACE_OUTER_BOUND", &around);
        let (surface, sense) = side(e, stretch, edges.curves[i]);
        faces.push(e.add(format!("ADVANCED_FACE('',({bound}),{surface},{})", flag(sense))));
    }
    Ok(edges)
}

fn flag(yes: bool) -> &'static str {
    if yes { ".T." } else { ".F." }
}

fn list(ids: &[Id]) -> String {
    ids.iter().map(Id::to_string).collect::<Vec<_>>().join(",")
}

fn bounded(e: &mut Entities, bound: &str, edges: &[(Id, bool)]) -> Id {
    let oriented: Vec<Id> = edges
        .iter()
        .map(|&(edge, along)| e.add(format!("ORIENTED_EDGE('',*,*,{edge},{})", flag(along))))
        .collect();
    let around = e.add(format!("EDGE_LOOP('',({}))", list(&oriented)));
    e.add(format!("{bound}('',{around},.T.)"))
}

fn edges(e: &mut Entities, ring: &[Stretch], heights: [f64; 2]) -> Edges {
    let at = |p: Point, z: f64| [p.x, p.y, z];
    let vertices: Vec<[Id; 2]> =
        ring.iter().map(|s| heights.map(|z| e.vertex(at(s.from(), z)))).collect();
    let upright = ring
        .iter()
        .zip(&vertices)
        .map(|(s, [low, high])| {
            let line = e.line(at(s.from(), heights[0]), [0.0, 0.0, 1.0]);
            e.add(format!("EDGE_CURVE('',{low},{high},{line},.T.)"))
        })
        .collect();
    let (mut bottom, mut top, mut curves) = (Vec::new(), Vec::new(), Vec::new());
    for (i, stretch) in ring.iter().enumerate() {
        let next = (i + 1) % ring.len();
        for (level, z) in heights.into_iter().enumerate() {
            let (curve, along) = curve(e, stretch, z);
            let (from, to) = (vertices[i][level], vertices[next][level]);
            let edge = e.add(format!("EDGE_CURVE('',{from},{to},{curve},{})", flag(along)));
            if level == 0 {
                bottom.push(edge);
                curves.push(curve);
            } else {
                top.push(edge);
            }
        }
    }
    Edges { bottom, top, upright, curves }
}

/// The curve under a stretch at height `z`, and whether it runs the same way.
fn curve(e: &mut Entities, stretch: &Stretch, z: f64) -> (Id, bool) {
    match stretch {
        Stretch::Line(arc) => {
            let d = (arc.to - arc.from).normalize();
            (e.line([arc.from.x, arc.from.y, z], [d.x, d.y, 0.0]), true)
        }
        Stretch::Arc(arc) => {
            let frame = circle_frame(e, arc, z);
            let circle = e.add(format!("CIRCLE('',{frame},{})", real(arc.radius())));
            (circle, arc.bulge > 0.0)
        }
        Stretch::Cubic(path) => {
            let points: Vec<Id> =
                path.control_points().iter().map(|p| e.point([p.x, p.y, z])).collect();
            let last = path.knots.len() - 1;
            let times: Vec<&str> =
                (0..=last).map(|i| if i == 0 || i == last { "4" } else { "2" }).collect();
            let knots: Vec<String> = path.knots.iter().map(|k| real(k - path.knots[0])).collect();
            let curve = e.add(format!(
                "B_SPLINE_CURVE_WITH_KNOTS('',3,({}),.UNSPECIFIED.,.F.,.F.,({}),({}),.UNSPECIFIED.)",
                list(&points),
                times.join(","),
                knots.join(",")
            ));
            (curve, true)
        }
    }
}

fn circle_frame(e: &mut Entities, arc: &Arc, z: f64) -> Id {
    let center = arc.center();
    let out = (arc.from - center).normalize();
    e.frame([center.x, center.y, z], [0.0, 0.0, 1.0], [out.x, out.y, 0.0])
}

/// The surface over a stretch, and whether its normal points out of the material.
fn side(e: &mut Entities, stretch: &Stretch, bottom: Id) -> (Id, bool) {
    match stretch {
        Stretch::Line(arc) => {
            let along = (arc.to - arc.from).normalize();
            let out = -quarter_turn(along);
            let frame = e.frame(
                [arc.from.x, arc.from.y, 0.0],
                [out.x, out.y, 0.0],
                [along.x, along.y, 0.0],
            );
            (e.add(format!("PLANE('',{frame})")), true)
        }
        Stretch::Arc(arc) => {
            let frame = circle_frame(e, arc, 0.0);
            let radius = real(arc.radius());
            (e.add(format!("CYLINDRICAL_SURFACE('',{frame},{radius})")), arc.bulge > 0.0)
        }
        Stretch::Cubic(_) => {
            let up = e.direction([0.0, 0.0, 1.0]);
            let vector = e.add(format!("VECTOR('',{up},1.)"));
            (e.add(format!("SURFACE_OF_LINEAR_EXTRUSION('',{bottom},{vector})")), true)
        }
    }
}
