//! Entities of a DXF drawing that are curves, and references to blocks.

use super::DxfError;
use super::map::Map;
use super::tags::Tag;
use crate::geometry::{Point, Vector};
use std::f64::consts::TAU;

/// What is drawn by one entity, in the system of its block.
#[derive(Clone, Debug)]
pub(super) struct Entity {
    pub(super) layer: String,
    /// Line type by name; empty for that of the layer.
    pub(super) line_type: String,
    pub(super) curve: Curve,
}

#[derive(Clone, Debug)]
pub(super) enum Curve {
    /// Vertices, each with the bulge of the stretch behind it: the tangent of a quarter of its turn.
    Polyline {
        vertices: Vec<(Point, f64)>,
        closed: bool,
    },
    Conic(Conic),
    Spline(Spline),
    Insert(Insert),
}

/// Centre + cos t u + sin t v, over `sweep` from `start`, radians.
#[derive(Clone, Copy, Debug)]
pub(super) struct Conic {
    pub(super) center: Point,
    pub(super) u: Vector,
    pub(super) v: Vector,
    pub(super) start: f64,
    pub(super) sweep: f64,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Spline {
    pub(super) degree: usize,
    pub(super) knots: Vec<f64>,
    pub(super) weights: Vec<f64>,
    pub(super) control: Vec<Point>,
    pub(super) fit: Vec<Point>,
    pub(super) closed: bool,
}

#[derive(Clone, Debug)]
pub(super) struct Insert {
    pub(super) block: String,
    /// Extrusion of the reference.
    pub(super) frame: Map,
    pub(super) at: Point,
    pub(super) scale: [f64; 2],
    pub(super) turn: f64,
    pub(super) columns: [i64; 2],
    pub(super) spacing: [f64; 2],
}

/// What is common to all entities, and the numbers of one.
struct Reader<'a, 'b> {
    tags: &'a [Tag<'b>],
}

impl Reader<'_, '_> {
    fn find(&self, code: i32) -> Option<&Tag<'_>> {
        self.tags.iter().find(|t| t.code == code)
    }

    fn number(&self, code: i32, default: f64) -> Result<f64, DxfError> {
        self.find(code).map_or(Ok(default), Tag::number)
    }

    fn whole(&self, code: i32) -> Result<i64, DxfError> {
        self.find(code).map_or(Ok(0), Tag::whole)
    }

    fn text(&self, code: i32) -> String {
        self.find(code).map_or(String::new(), |t| t.text().trim().to_owned())
    }

    fn point(&self, code: i32) -> Result<Point, DxfError> {
        Ok(Point::new(self.number(code, 0.0)?, self.number(code + 10, 0.0)?))
    }

    fn list(&self, code: i32) -> Result<Vec<f64>, DxfError> {
        self.tags.iter().filter(|t| t.code == code).map(Tag::number).collect()
    }

    /// Points of which x stands in `code` and y in the group ten above.
    fn points(&self, code: i32) -> Result<Vec<Point>, DxfError> {
        let mut points: Vec<Point> = Vec::new();
        for tag in self.tags {
            if tag.code == code {
                points.push(Point::new(tag.number()?, 0.0));
            } else if tag.code == code + 10
                && let Some(last) = points.last_mut()
            {
                last.y = tag.number()?;
            }
        }
        Ok(points)
    }

    fn normal(&self) -> Result<[f64; 3], DxfError> {
        Ok([self.number(210, 0.0)?, self.number(220, 0.0)?, self.number(230, 1.0)?])
    }
}

/// The entity in a group of tags after its name; `None` for what is no curve, is invisible, lies in paper space, or is
/// tilted out of the plane. Vertices of an old polyline follow in `vertices`.
pub(super) fn entity(
    kind: &str,
    tags: &[Tag<'_>],
    vertices: &[Vec<Tag<'_>>],
) -> Result<Option<Entity>, DxfError> {
    let read = Reader { tags };
    if read.whole(60)? == 1 || read.whole(67)? == 1 {
        return Ok(None);
    }
    let flat = Map::of_extrusion(read.normal()?);
    let in_plane = || flat.unwrap_or(Map::IDENTITY);
    // What the extrusion turns is given in the entity's own system, the others in the world's.
    let turned = !matches!(kind, "LINE" | "SPLINE" | "ELLIPSE");
    if turned && flat.is_none() {
        return Ok(None);
    }
    let curve = match kind {
        "LINE" => {
            let (a, b) = (read.point(10)?, read.point(11)?);
            Curve::Polyline { vertices: vec![(a, 0.0), (b, 0.0)], closed: false }
        }
        "CIRCLE" | "ARC" => {
            let radius = read.number(40, 0.0)?;
            let (start, end) = (read.number(50, 0.0)?, read.number(51, 360.0)?);
            let sweep = (end - start).rem_euclid(360.0).to_radians();
            let whole = kind == "CIRCLE" || sweep < 1e-9;
            let map = in_plane();
            Curve::Conic(Conic {
                center: map.point(read.point(10)?),
                u: map.vector(Vector::new(radius, 0.0)),
                v: map.vector(Vector::new(0.0, radius)),
                start: if whole { 0.0 } else { start.to_radians() },
                sweep: if whole { TAU } else { sweep },
            })
        }
        "ELLIPSE" => {
            let major = read.point(11)?.coords;
            let ratio = read.number(40, 1.0)?;
            let sense = if read.normal()?[2] < 0.0 { -1.0 } else { 1.0 };
            let (start, end) = (read.number(41, 0.0)?, read.number(42, TAU)?);
            let sweep = (end - start).rem_euclid(TAU);
            let whole = !(1e-9..TAU - 1e-9).contains(&sweep);
            Curve::Conic(Conic {
                center: read.point(10)?,
                u: major,
                v: sense * ratio * Vector::new(-major.y, major.x),
                start: if whole { 0.0 } else { start },
                sweep: if whole { TAU } else { sweep },
            })
        }
        "LWPOLYLINE" => {
            let mut list: Vec<(Point, f64)> = Vec::new();
            for tag in tags {
                match (tag.code, list.last_mut()) {
                    (10, _) => list.push((Point::new(tag.number()?, 0.0), 0.0)),
                    (20, Some(last)) => last.0.y = tag.number()?,
                    (42, Some(last)) => last.1 = tag.number()?,
                    _ => {}
                }
            }
            Curve::Polyline {
                vertices: mapped(list, &read, in_plane())?,
                closed: read.whole(70)? & 1 != 0,
            }
        }
        "POLYLINE" => {
            let flags = read.whole(70)?;
            // Meshes are no curves.
            if flags & (16 | 64) != 0 {
                return Ok(None);
            }
            let mut list = Vec::new();
            for tags in vertices {
                let read = Reader { tags };
                // Corners of the frame of a curve that was fitted.
                if read.whole(70)? & 16 == 0 {
                    list.push((read.point(10)?, read.number(42, 0.0)?));
                }
            }
            let list = if flags & 8 != 0 { list } else { mapped(list, &read, in_plane())? };
            Curve::Polyline { vertices: list, closed: flags & 1 != 0 }
        }
        "SPLINE" => Curve::Spline(Spline {
            degree: usize::try_from(read.whole(71)?).unwrap_or(0),
            knots: read.list(40)?,
            weights: read.list(41)?,
            control: read.points(10)?,
            fit: read.points(11)?,
            closed: read.whole(70)? & 3 != 0,
        }),
        "INSERT" => Curve::Insert(Insert {
            block: read.text(2).to_uppercase(),
            frame: in_plane(),
            at: read.point(10)?,
            scale: [read.number(41, 1.0)?, read.number(42, 1.0)?],
            turn: read.number(50, 0.0)?.to_radians(),
            columns: [read.whole(70)?.max(1), read.whole(71)?.max(1)],
            spacing: [read.number(44, 0.0)?, read.number(45, 0.0)?],
        }),
        _ => return Ok(None),
    };
    Ok(Some(Entity { layer: read.text(8), line_type: read.text(6).to_uppercase(), curve }))
}

/// Vertices in the world's system: seen from behind, arcs turn the other way.
fn mapped(
    list: Vec<(Point, f64)>,
    read: &Reader<'_, '_>,
    map: Map,
) -> Result<Vec<(Point, f64)>, DxfError> {
    let sense = if read.normal()?[2] < 0.0 { -1.0 } else { 1.0 };
    Ok(list.into_iter().map(|(p, bulge)| (map.point(p), sense * bulge)).collect())
}
