//! Contours of DXF drawings: polylines with bulges, chains of lines and arcs, circles, splines.

use super::chain::chained;
use super::{Asked, Ring, ToothedError, spline};
use crate::geometry::{self, Point, Vector};
use crate::outline::{OutlineError, check_coordinates};
use crate::policy;
use crate::wording::quoted;
use dxf::entities::EntityType;
use dxf::enums::Units;
use std::f64::consts::TAU;

pub(super) fn rings(bytes: &[u8], asked: &Asked<'_>) -> Result<Vec<Ring>, ToothedError> {
    let drawing = dxf::Drawing::load(&mut &bytes[..]).map_err(|e| ToothedError::Malformed {
        path: asked.path(),
        format: "DXF",
        reason: quoted(&e.to_string()),
    })?;
    let scale = match drawing.header.default_drawing_units {
        Units::Unitless | Units::Millimeters => 1.0,
        Units::Centimeters => 10.0,
        Units::Meters => 1000.0,
        Units::Microns => 1e-3,
        Units::Inches => 25.4,
        Units::Feet => 304.8,
        other => {
            return Err(ToothedError::Unit { path: asked.path(), unit: format!("{other:?}") });
        }
    };
    let wanted = wanted_layer(&drawing, asked)?;
    let refused = |error| ToothedError::Outline { path: asked.path(), error };
    let mut skeletons: Vec<(&str, Vec<Piece>)> = Vec::new();
    for entity in drawing.entities() {
        let made = pieces(&entity.specific)
            .map_err(|kind| ToothedError::Entity { path: asked.path(), kind })?;
        check_coordinates(&made.iter().flat_map(Piece::marks).collect::<Vec<_>>())
            .map_err(refused)?;
        skeletons.push((&entity.common.layer, made));
    }
    let extent = |of: &mut dyn Iterator<Item = &Piece>| {
        geometry::bounds(&of.flat_map(Piece::marks).collect::<Vec<_>>())
    };
    let is_wanted = |layer: &str| wanted.is_none_or(|w| w == layer);
    let on_layer = skeletons.iter().filter(|(layer, _)| is_wanted(layer));
    let (low, high) = extent(&mut on_layer.flat_map(|(_, made)| made));
    let diagonal = (high - low).norm();
    if !(diagonal.is_finite() && diagonal > 0.0) {
        return Err(ToothedError::NoContour { path: asked.path() });
    }
    // Of other layers what lies about the gear stays: bores may be there.
    skeletons.retain(|(layer, made)| {
        let (from, to) = extent(&mut made.iter());
        is_wanted(layer) || (from >= low && to <= high)
    });
    let chord = policy::TOOTHED_CHORD * diagonal;
    let mut rings = Vec::new();
    let mut open = Vec::new();
    let mut vertices = 0;
    for (_, skeleton) in skeletons {
        let mut points: Vec<Point> = Vec::new();
        for piece in skeleton {
            let more = piece.flattened(chord);
            let repeated = usize::from(!points.is_empty());
            vertices += more.len();
            if vertices > policy::TOOTHED_VERTICES {
                return Err(refused(OutlineError::TooIntricate));
            }
            points.extend(more.into_iter().skip(repeated));
        }
        if points.len() > 3 && points.first() == points.last() {
            points.pop();
            rings.push(Ring { points, closed: true });
        } else if points.len() > 1 {
            open.push(points);
        }
    }
    let joined = chained(open, policy::CHAIN_GAP * diagonal);
    rings.extend(joined.ok_or_else(|| refused(OutlineError::TooIntricate))?);
    for ring in &mut rings {
        ring.points.iter_mut().for_each(|p| p.coords *= scale);
    }
    Ok(rings)
}

/// The layer of the gear that is asked for, if there is one of its name.
fn wanted_layer<'a>(
    drawing: &dxf::Drawing,
    asked: &Asked<'a>,
) -> Result<Option<&'a str>, ToothedError> {
    let exists = |name: &str| drawing.entities().any(|e| e.common.layer == name);
    match asked.part {
        Some(part) if !exists(part) => Err(asked.no_such_part(part)),
        Some(part) => Ok(Some(part)),
        None => Ok(Some(asked.side.name()).filter(|name| exists(name))),
    }
}

/// A stretch of a curve, in the unit of the drawing.
enum Piece {
    Line(Point, Point),
    /// Centre, radius, where it starts (radians) and how far it turns, counter-clockwise positive.
    Arc {
        center: Point,
        radius: f64,
        start: f64,
        sweep: f64,
        ends: [Point; 2],
    },
    Points(Vec<Point>),
}

impl Piece {
    fn arc(center: Point, radius: f64, start: f64, sweep: f64) -> Self {
        let at = |a: f64| center + Vector::new(radius * a.cos(), radius * a.sin());
        let end = if sweep.abs() >= TAU { at(start) } else { at(start + sweep) };
        Self::Arc { center, radius, start, sweep, ends: [at(start), end] }
    }

    /// From `a` to `b`; `bulge` is the tangent of a quarter of the turn.
    fn bulged(a: Point, b: Point, bulge: f64) -> Self {
        let chord = b - a;
        if bulge.abs() < 1e-12 || chord.norm() == 0.0 {
            return Self::Line(a, b);
        }
        let sweep = 4.0 * bulge.atan();
        let height = 0.25 * (1.0 / bulge - bulge);
        let center = nalgebra::center(&a, &b) + geometry::quarter_turn(chord) * height;
        let arm = a - center;
        let start = arm.y.atan2(arm.x);
        Self::Arc { center, radius: arm.norm(), start, sweep, ends: [a, b] }
    }

    /// Points that show how large the drawing is.
    fn marks(&self) -> Vec<Point> {
        match self {
            Self::Line(a, b) => vec![*a, *b],
            Self::Points(points) => points.clone(),
            Self::Arc { .. } => self.flattened(f64::INFINITY),
        }
    }

    /// The curve as chords within `tolerance`, its ends included.
    fn flattened(&self, tolerance: f64) -> Vec<Point> {
        match self {
            Self::Line(a, b) => vec![*a, *b],
            Self::Points(points) => points.clone(),
            Self::Arc { center, radius, start, sweep, ends } => {
                let chord = (8.0 * tolerance / radius).sqrt().clamp(1e-3, 1.0);
                let count = (sweep.abs() / chord).ceil().max(1.0) as usize;
                let at = |i: usize| {
                    let a = start + sweep * i as f64 / count as f64;
                    center + Vector::new(radius * a.cos(), radius * a.sin())
                };
                let inner = (1..count).map(at);
                std::iter::once(ends[0]).chain(inner).chain(std::iter::once(ends[1])).collect()
            }
        }
    }
}

/// The stretches of one entity; what is no curve (text, dimensions) has none.
fn pieces(entity: &EntityType) -> Result<Vec<Piece>, &'static str> {
    let flat = |p: &dxf::Point| Point::new(p.x, p.y);
    Ok(match entity {
        EntityType::LwPolyline(line) => {
            let mirrored = line.extrusion_direction.z < 0.0;
            let vertices: Vec<(Point, f64)> =
                line.vertices.iter().map(|v| (Point::new(v.x, v.y), v.bulge)).collect();
            mirrored_if(mirrored, bulged(&vertices, line.is_closed()))?
        }
        EntityType::Polyline(line) => {
            let vertices: Vec<(Point, f64)> =
                line.vertices().map(|v| (flat(&v.location), v.bulge)).collect();
            mirrored_if(line.normal.z < 0.0, bulged(&vertices, line.is_closed()))?
        }
        EntityType::Line(line) => vec![Piece::Line(flat(&line.p1), flat(&line.p2))],
        EntityType::Arc(arc) => {
            let start = arc.start_angle.to_radians();
            let sweep = (arc.end_angle - arc.start_angle).rem_euclid(360.0).to_radians();
            let sweep = if sweep == 0.0 { TAU } else { sweep };
            let made = vec![Piece::arc(flat(&arc.center), arc.radius, start, sweep)];
            mirrored_if(arc.normal.z < 0.0, made)?
        }
        EntityType::Circle(circle) => {
            vec![Piece::arc(flat(&circle.center), circle.radius, 0.0, TAU)]
        }
        EntityType::Spline(curve) => {
            let control: Vec<Point> = curve.control_points.iter().map(flat).collect();
            let degree = usize::try_from(curve.degree_of_curve).unwrap_or(0);
            let per_span = policy::SPLINE_CHORDS;
            let made = spline::points(
                degree,
                &curve.knot_values,
                &control,
                &curve.weight_values,
                per_span,
            );
            vec![Piece::Points(made.ok_or("a spline whose knots do not fit its points")?)]
        }
        EntityType::Ellipse(_) => return Err("an ellipse"),
        EntityType::Insert(_) => return Err("a block reference"),
        _ => Vec::new(),
    })
}

fn bulged(vertices: &[(Point, f64)], closed: bool) -> Vec<Piece> {
    let count = vertices.len();
    let last = if closed { count } else { count.saturating_sub(1) };
    (0..last)
        .map(|i| Piece::bulged(vertices[i].0, vertices[(i + 1) % count].0, vertices[i].1))
        .collect()
}

fn mirrored_if(mirrored: bool, made: Vec<Piece>) -> Result<Vec<Piece>, &'static str> {
    if mirrored { Err("a curve drawn from behind (its normal points down)") } else { Ok(made) }
}
