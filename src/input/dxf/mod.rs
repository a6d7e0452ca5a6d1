//! Contours of DXF drawings: what is visible in model space, as programs really write it.

mod entity;
mod flatten;
mod map;
mod spline;
mod tags;

use super::contours::{Contour, Contours, Unit};
use super::join;
use super::note::Note;
use crate::geometry::{self, Point, Vector};
use crate::outline::{OutlineError, check_coordinates};
use crate::policy;
use entity::{Curve, Entity, Insert, entity};
use flatten::{Piece, piece};
use map::Map;
use std::collections::{BTreeSet, HashMap};
use tags::{Tag, Tags, text_of};

/// Why a DXF drawing gives no contours.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DxfError {
    /// Neither text nor a binary DXF.
    #[error("it is no DXF text and no binary DXF; save it again as DXF")]
    NotText,
    /// A line that should be a group code.
    #[error("line {line} (`{text}`) is no DXF group code; save the drawing again as DXF")]
    NotACode {
        /// Number of the line, from 1.
        line: usize,
        /// The line.
        text: String,
    },
    /// A value that should be a number.
    #[error("line {line} (`{text}`) is no finite number; save the drawing again as DXF")]
    NotANumber {
        /// Number of the line, from 1.
        line: usize,
        /// The value.
        text: String,
    },
    /// The file ends within a section.
    #[error("it breaks off after line {line}; save the drawing again as DXF")]
    Cut {
        /// The last line, or group of a binary file.
        line: usize,
    },
    /// A unit that is not a length for gears.
    #[error("its drawing unit is `{unit}`; save it in millimetres")]
    Unit {
        /// The unit.
        unit: &'static str,
    },
    /// Blocks that hold each other, or too many copies.
    #[error(
        "its blocks expand to more than {limit} curves or hold each other; explode the blocks that matter and leave the rest out"
    )]
    Blocks {
        /// Most curves that are read.
        limit: usize,
    },
    /// A spline that no program draws.
    #[error(
        "it holds a spline whose knots, weights and points do not belong together; turn it into a polyline"
    )]
    Spline,
    /// Nothing visible is a curve.
    #[error(
        "nothing visible in its model space is a curve{found}; draw the outline with lines, arcs, polylines or splines"
    )]
    NoCurves {
        /// ` (it holds HATCH and TEXT)`, or what else there is.
        found: String,
    },
    /// The curves do not make a drawing.
    #[error(transparent)]
    Outline(#[from] OutlineError),
}

/// Most curves after every block was expanded.
const CURVES: usize = 400_000;
/// Deepest nesting of blocks.
const BLOCK_DEPTH: usize = 24;
/// Names that programs give to line types that are not drawn through.
const DASHED: [&str; 10] = [
    "CENTER", "DASH", "HIDDEN", "PHANTOM", "DOT", "DIVIDE", "BORDER", "ACAD_ISO", "STRICH", "MITTE",
];

#[derive(Default)]
struct Drawing {
    layers: HashMap<String, Layer>,
    /// Line types with gaps, by name.
    dashed: BTreeSet<String>,
    blocks: HashMap<String, (Point, Vec<Entity>)>,
    entities: Vec<Entity>,
    unit: Option<i64>,
    /// Kinds of entity that are no curves.
    ignored: BTreeSet<String>,
    hidden: usize,
}

#[derive(Default)]
struct Layer {
    off: bool,
    frozen: bool,
    line_type: String,
}

/// Reads the visible curves of model space, joined where their ends meet within `join` (mm; by default
/// [`join::tolerance`]).
///
/// # Errors
/// See [`DxfError`].
pub(super) fn contours(bytes: &[u8], join: Option<f64>) -> Result<Contours, DxfError> {
    let text = text_of(bytes)?;
    let drawing = Drawing::read(Tags::new(bytes, text.as_deref()))?;
    let unit = unit(drawing.unit.unwrap_or(0))?;
    let mut pieces: Vec<(Piece, String, bool)> = Vec::new();
    let top = Place { map: Map::IDENTITY, layer: "", depth: 0 };
    drawing.expand(&drawing.entities, top, &mut pieces)?;
    for (piece, ..) in &pieces {
        check_coordinates(&piece.marks())?;
    }
    let marks: Vec<Point> = pieces.iter().flat_map(|(p, ..)| p.marks()).collect();
    let (low, high) = geometry::bounds(&marks);
    let diagonal = (high - low).norm();
    if !(diagonal.is_finite() && diagonal > 0.0) {
        return Err(DxfError::NoCurves { found: drawing.found() });
    }
    drop(marks);
    let mut list = Vec::with_capacity(pieces.len());
    let mut vertices = 0;
    for (piece, layer, dashed) in pieces {
        let size = {
            let (low, high) = geometry::bounds(&piece.marks());
            (high - low).norm()
        };
        // Small things far from a large frame are drawn as finely as if they stood alone.
        let chord = policy::TOOTHED_CHORD * diagonal.min(CLOSER * size).max(1e-3 * diagonal);
        let (mut points, closed) = piece.flattened(chord);
        vertices += points.len();
        if vertices > policy::TOOTHED_VERTICES {
            return Err(OutlineError::TooIntricate.into());
        }
        points.dedup();
        let closed = closed || (points.len() > 3 && points.first() == points.last());
        while closed && points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        if points.len() > 1 {
            list.push(Contour { points, closed, layer, dashed, bridged: None });
        }
    }
    let tolerance = join::tolerance(join, diagonal, unit.mm);
    let (list, joints) =
        join::joined(list, diagonal, tolerance).ok_or(OutlineError::TooIntricate)?;
    let mut notes = Vec::new();
    if joints.places > 0 {
        let join::Joints { places, widest, tolerance } = joints;
        notes.push(Note::Joined { places, widest, tolerance });
    }
    Ok(Contours { list, unit, notes, ..Contours::default() })
}

/// Times its own size in which a curve's chords are as fine as the drawing's.
const CLOSER: f64 = 20.0;

/// Where entities of a block are put.
#[derive(Clone, Copy)]
struct Place<'a> {
    map: Map,
    /// Layer of the reference, which the block's layer 0 takes.
    layer: &'a str,
    depth: usize,
}

impl Drawing {
    fn read(tags: Tags<'_>) -> Result<Self, DxfError> {
        let mut drawing = Self::default();
        let mut section = String::new();
        let mut table_entry: Option<(String, Vec<Tag<'_>>)> = None;
        let mut block: Option<(String, Point, Vec<Entity>)> = None;
        let mut open: Option<(String, Vec<Tag<'_>>)> = None;
        let mut line = 0;
        let mut variable = String::new();
        let mut ended = false;
        let mut polyline: Option<(Vec<Tag<'_>>, Vec<Vec<Tag<'_>>>)> = None;
        let mut naming = false;
        for tag in tags {
            let tag = tag?;
            line = tag.line;
            if naming && tag.code == 2 {
                section = tag.text().to_ascii_uppercase();
                naming = false;
                continue;
            }
            if tag.code != 0 {
                match (section.as_str(), &mut open, &mut table_entry) {
                    ("HEADER", ..) if tag.code == 9 => variable = tag.text().to_owned(),
                    ("HEADER", ..) if variable == "$INSUNITS" && tag.code == 70 => {
                        drawing.unit = Some(tag.whole()?);
                    }
                    ("TABLES", _, Some((_, list))) => list.push(tag),
                    ("ENTITIES" | "BLOCKS", Some((_, list)), _) => list.push(tag),
                    _ => {}
                }
                continue;
            }
            // A new entity ends the last one.
            if let Some((kind, list)) = open.take() {
                drawing.close(&kind, list, &mut block, &mut polyline)?;
            }
            if let Some((kind, list)) = table_entry.take() {
                drawing.table(&kind, &list)?;
            }
            match tag.text() {
                "SECTION" => naming = true,
                "ENDSEC" => section.clear(),
                "EOF" => {
                    ended = true;
                    break;
                }
                name if section == "TABLES" => table_entry = Some((name.to_owned(), Vec::new())),
                name if section == "ENTITIES" || section == "BLOCKS" => {
                    open = Some((name.to_owned(), Vec::new()));
                }
                _ => {}
            }
        }
        if !ended && !section.is_empty() {
            return Err(DxfError::Cut { line });
        }
        Ok(drawing)
    }

    /// Takes in an entity whose groups are complete.
    fn close<'t>(
        &mut self,
        kind: &str,
        list: Vec<Tag<'t>>,
        block: &mut Option<(String, Point, Vec<Entity>)>,
        polyline: &mut Option<(Vec<Tag<'t>>, Vec<Vec<Tag<'t>>>)>,
    ) -> Result<(), DxfError> {
        match kind {
            "BLOCK" => {
                let text = |code| list.iter().find(|t| t.code == code).map_or("", |t| t.text());
                let number =
                    |code| list.iter().find(|t| t.code == code).map_or(Ok(0.0), Tag::number);
                *block = Some((
                    text(2).trim().to_uppercase(),
                    Point::new(number(10)?, number(20)?),
                    Vec::new(),
                ));
            }
            "ENDBLK" => {
                if let Some((name, base, entities)) = block.take() {
                    self.blocks.insert(name, (base, entities));
                }
            }
            "POLYLINE" => *polyline = Some((list, Vec::new())),
            "VERTEX" => {
                if let Some((_, vertices)) = polyline {
                    vertices.push(list);
                }
            }
            "SEQEND" => {
                if let Some((head, vertices)) = polyline.take() {
                    self.add("POLYLINE", &head, &vertices, block)?;
                }
            }
            kind => self.add(kind, &list, &[], block)?,
        }
        Ok(())
    }

    fn add(
        &mut self,
        kind: &str,
        tags: &[Tag<'_>],
        vertices: &[Vec<Tag<'_>>],
        block: &mut Option<(String, Point, Vec<Entity>)>,
    ) -> Result<(), DxfError> {
        const CURVES: [&str; 8] =
            ["LINE", "CIRCLE", "ARC", "ELLIPSE", "LWPOLYLINE", "POLYLINE", "SPLINE", "INSERT"];
        if !CURVES.contains(&kind) {
            if block.is_none() && self.ignored.len() < 8 && kind != "VIEWPORT" {
                self.ignored.insert(crate::wording::quoted(kind));
            }
            return Ok(());
        }
        match entity(kind, tags, vertices)? {
            Some(made) => match block {
                Some((.., entities)) => entities.push(made),
                None => self.entities.push(made),
            },
            None => self.hidden += 1,
        }
        Ok(())
    }

    fn table(&mut self, kind: &str, tags: &[Tag<'_>]) -> Result<(), DxfError> {
        let find = |code| tags.iter().find(|t| t.code == code);
        let name = find(2).map_or("", |t| t.text()).trim().to_uppercase();
        match kind {
            "LAYER" => {
                let whole = |code| find(code).map_or(Ok(0), Tag::whole);
                let layer = Layer {
                    off: whole(62)? < 0 || name == "DEFPOINTS",
                    frozen: whole(70)? & 1 != 0,
                    line_type: find(6).map_or("", |t| t.text()).trim().to_uppercase(),
                };
                self.layers.insert(name, layer);
            }
            "LTYPE" if find(73).map_or(Ok(0), Tag::whole)? > 0 => {
                self.dashed.insert(name);
            }
            _ => {}
        }
        Ok(())
    }

    /// The visible curves among entities, blocks expanded.
    fn expand(
        &self,
        entities: &[Entity],
        place: Place<'_>,
        pieces: &mut Vec<(Piece, String, bool)>,
    ) -> Result<(), DxfError> {
        let too_many = DxfError::Blocks { limit: CURVES };
        if place.depth > BLOCK_DEPTH {
            return Err(too_many);
        }
        for entity in entities {
            let layer =
                if place.depth > 0 && entity.layer == "0" { place.layer } else { &entity.layer };
            let known = self.layers.get(&layer.to_uppercase());
            if let Curve::Insert(insert) = &entity.curve {
                if !known.is_some_and(|l| l.frozen) {
                    self.insert(insert, layer, place, pieces)?;
                }
                continue;
            }
            if known.is_some_and(|l| l.off || l.frozen) {
                continue;
            }
            let line_type = match entity.line_type.as_str() {
                "" | "BYLAYER" | "BYBLOCK" => known.map_or("", |l| l.line_type.as_str()),
                own => own,
            };
            let dashed =
                self.dashed.contains(line_type) || DASHED.iter().any(|d| line_type.starts_with(d));
            if pieces.len() >= CURVES {
                return Err(too_many);
            }
            let piece = piece(&entity.curve, &place.map).ok_or(DxfError::Spline)?;
            pieces.push((piece, layer.to_owned(), dashed));
        }
        Ok(())
    }

    fn insert(
        &self,
        insert: &Insert,
        layer: &str,
        place: Place<'_>,
        pieces: &mut Vec<(Piece, String, bool)>,
    ) -> Result<(), DxfError> {
        let Some((base, entities)) = self.blocks.get(&insert.block) else { return Ok(()) };
        if entities.is_empty() {
            return Ok(());
        }
        let [columns, rows] = insert.columns;
        if columns.saturating_mul(rows) > CURVES as i64 {
            return Err(DxfError::Blocks { limit: CURVES });
        }
        let own = Map::of_insert(*base, insert.scale, insert.turn, insert.at);
        let (sine, cosine) = insert.turn.sin_cos();
        for row in 0..rows {
            for column in 0..columns {
                let (x, y) = (column as f64 * insert.spacing[0], row as f64 * insert.spacing[1]);
                let shift = Vector::new(cosine * x - sine * y, sine * x + cosine * y);
                let map = place.map.after(&insert.frame.after(&own.moved(shift)));
                self.expand(entities, Place { map, layer, depth: place.depth + 1 }, pieces)?;
            }
        }
        Ok(())
    }

    /// What there is instead of curves.
    fn found(&self) -> String {
        let mut kinds: Vec<String> = self.ignored.iter().cloned().collect();
        if !self.entities.is_empty() || self.hidden > 0 {
            kinds.push(
                "curves on hidden layers, in paper space or tilted out of the xy plane".to_owned(),
            );
        }
        if kinds.is_empty() { String::new() } else { format!(" (it holds {})", kinds.join(", ")) }
    }
}

/// The unit by its number in `$INSUNITS`.
fn unit(number: i64) -> Result<Unit, DxfError> {
    let unit = |name, mm| Ok(Unit { name, mm });
    match number {
        0 | 4 => unit("mm", 1.0),
        1 => unit("inch", 25.4),
        2 | 21 => unit("foot", 304.8),
        5 => unit("cm", 10.0),
        6 => unit("m", 1000.0),
        8 => unit("microinch", 25.4e-6),
        9 => unit("mil", 25.4e-3),
        10 | 23 => unit("yard", 914.4),
        13 => unit("micrometre", 1e-3),
        14 => unit("dm", 100.0),
        22 => unit("inch", 25.4),
        3 | 24 => Err(DxfError::Unit { unit: "Miles" }),
        7 => Err(DxfError::Unit { unit: "Kilometers" }),
        11 => Err(DxfError::Unit { unit: "Angstroms" }),
        12 => Err(DxfError::Unit { unit: "Nanometers" }),
        15..=20 => Err(DxfError::Unit { unit: "beyond what is made" }),
        // What is no unit says nothing.
        _ => unit("mm", 1.0),
    }
}
