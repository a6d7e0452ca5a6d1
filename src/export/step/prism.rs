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

/// A level face of a stack: where things stand on it or are sunk into it, and where holes end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Level {
    /// The underside of the body.
    Bottom,
    /// The top of the body.
    Top,
    /// The far end of a step, by its number.
    Step(usize),
}

/// A figure raised on a level face or sunk into it.
pub(super) struct Figure {
    /// The face.
    pub(super) on: Level,
    /// The figure's edge counter-clockwise, then its holes clockwise.
    pub(super) rings: Vec<Vec<Stretch>>,
    /// Height of its far end, mm: above an upper face it is raised, else sunk.
    pub(super) to: f64,
}

/// A hole between two level faces, clockwise.
pub(super) struct Through {
    pub(super) ring: Vec<Stretch>,
    pub(super) from: Level,
    pub(super) to: Level,
}

/// A body between two planes with steps and holes, from z = 0 on; mm.
pub(super) struct Stack {
    /// Its edge, counter-clockwise.
    pub(super) outline: Vec<Stretch>,
    /// Height of the body.
    pub(super) height: f64,
    /// Steps, each after the one that it stands on.
    pub(super) steps: Vec<Figure>,
    /// Holes.
    pub(super) holes: Vec<Through>,
}

/// A level face in the making.
struct Floor {
    z: f64,
    up: bool,
    /// The outer loop, then those of what interrupts it.
    loops: Vec<Vec<(Id, bool)>>,
}

impl Floor {
    fn at(z: f64, up: bool) -> Self {
        Self { z, up, loops: Vec::new() }
    }
}

/// The solid of a stack. Edges are shared by the faces that meet in them: a wall runs along its lower edges and back along
/// its upper ones, so the face at its foot takes the lower ones backwards and the face at its top the upper ones forwards,
/// whichever side of the wall the material is on.
///
/// # Errors
/// Half a sentence when a ring does not close or a step stands on nothing.
pub(super) fn solid(e: &mut Entities, name: &str, stack: &Stack) -> Result<Id, String> {
    let foot = |edges: &Edges| edges.bottom.iter().rev().map(|&i| (i, false)).collect::<Vec<_>>();
    let top = |edges: &Edges| edges.top.iter().map(|&i| (i, true)).collect::<Vec<_>>();
    let mut faces = Vec::new();
    let mut floors = vec![Floor::at(0.0, false), Floor::at(stack.height, true)];
    let outline = wall(e, &stack.outline, [0.0, stack.height], &mut faces)?;
    floors[0].loops.push(foot(&outline));
    floors[1].loops.push(top(&outline));
    let mut islands = Vec::new();
    for step in &stack.steps {
        let on = number(step.on);
        let (z, up) = floors.get(on).map(|f| (f.z, f.up)).ok_or("a step stands on nothing")?;
        let raised = up && step.to > z;
        let mut end = Floor::at(step.to, up);
        for (i, ring) in step.rings.iter().enumerate() {
            let heights = [z.min(step.to), z.max(step.to)];
            let edges = if raised {
                wall(e, ring, heights, &mut faces)?
            } else {
                let back: Vec<Stretch> = ring.iter().rev().map(reversed).collect();
                wall(e, &back, heights, &mut faces)?
            };
            let (near, far) =
                if step.to > z { (foot(&edges), top(&edges)) } else { (top(&edges), foot(&edges)) };
            end.loops.push(far);
            if i == 0 {
                floors[on].loops.push(near);
            } else {
                // What is left of the face inside a hole of the figure.
                islands.push(Floor { z, up, loops: vec![near] });
            }
        }
        floors.push(end);
    }
    for hole in &stack.holes {
        let (from, to) = (number(hole.from), number(hole.to));
        let heights = [from, to].map(|i| floors.get(i).map(|f| f.z));
        let [Some(low), Some(high)] = heights else { return Err("a hole ends nowhere".to_owned()) };
        let edges = wall(e, &hole.ring, [low, high], &mut faces)?;
        floors[from].loops.push(foot(&edges));
        floors[to].loops.push(top(&edges));
    }
    for Floor { z, up, loops } in floors.into_iter().chain(islands) {
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

fn number(level: Level) -> usize {
    match level {
        Level::Bottom => 0,
        Level::Top => 1,
        Level::Step(i) => i + 2,
    }
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
