//! What an SVG drawing shows inside its silhouette, as viewers paint it: the topmost colour everywhere.

use super::region::{self, Region};
use super::scene::{Item, Paint, Scene};
use crate::geometry::{self, Face, Point};
use crate::input::inner::{Inner, Patch};

/// Changes of colour from one path to the next that are followed; what lies above is left out.
const LAYERS: usize = 400;
/// Areas thinner than this share of the silhouette's size are seams between paths, not drawn.
const SEAM: f64 = 1e-3;
/// A path whose extent is this share of the silhouette's is its edge, and so is the path's line.
const EDGE: f64 = 0.9;
/// How far into the silhouette the line of its edge is left out, in widths: half, and a little.
const EDGE_LINE: f64 = 0.55;
/// A sheet under the drawing covers more than the silhouette by this factor.
const SHEET: f64 = 1.02;
/// Chords of rounded corners, radians of arc.
const CHORD: f64 = 0.3;

/// What is drawn inside an outline of the scene.
pub(super) fn of(scene: &Scene, outline: &[Point]) -> Inner {
    let body: Region = vec![outline.to_vec()];
    let (low, high) = geometry::bounds(outline);
    let size = (high - low).norm();
    let mut layers: Vec<(Paint, Region)> = Vec::new();
    for (paint, rings) in batches(&scene.items, outline).into_iter().take(LAYERS) {
        let rings = region::common(&region::filled(&rings, false), &body);
        if rings.is_empty() {
            continue;
        }
        for (_, other) in &mut layers {
            *other = region::without(other, &rings);
        }
        match layers.iter_mut().find(|(known, _)| known.is_near(paint)) {
            Some((_, same)) => *same = region::united(same, &rings),
            None => layers.push((paint, rings)),
        }
    }
    // The body of a drawing of lines alone has no colour, and nothing in it is a hole.
    let filled = scene.items.iter().any(|i| i.fill.is_some());
    let covered = |layer: &Region| layer.iter().map(|r| geometry::signed_area(r)).sum::<f64>();
    let largest = layers.iter().max_by(|a, b| covered(&a.1).total_cmp(&covered(&b.1)));
    let ground = largest.filter(|_| filled).map(|(paint, _)| *paint);
    let drawn = |face: &Face| {
        let edge: f64 = face.iter().map(|r| geometry::perimeter(r)).sum();
        2.0 * face.iter().map(|r| geometry::signed_area(r)).sum::<f64>() > SEAM * size * edge
    };
    let painted: Region = layers.iter().flat_map(|(_, rings)| rings.iter().cloned()).collect();
    let bare = if filled { geometry::without(&body, &painted) } else { Vec::new() };
    // What is drawn in a hole without touching its edge falls out with it.
    let holes: Vec<Vec<Point>> =
        bare.into_iter().filter(drawn).filter_map(|face| face.into_iter().next()).collect();
    let within = inside_of_edge(&scene.items, outline, size);
    let patches = layers.into_iter().filter(|(paint, _)| Some(*paint) != ground);
    let patches = patches.filter_map(|(paint, rings)| {
        let kept = geometry::common(&region::without(&rings, &holes), &within);
        // Lines may be as thin as they like.
        let faces: Vec<Face> = kept.into_iter().filter(|f| !filled || drawn(f)).collect();
        (!faces.is_empty()).then_some(Patch { color: paint.0, faces })
    });
    Inner { patches: patches.collect(), holes, lines: Vec::new() }
}

/// What is painted from below to above, paths of one colour that follow each other as one.
fn batches(items: &[Item], outline: &[Point]) -> Vec<(Paint, Region)> {
    let (low, high) = geometry::bounds(outline);
    let area = geometry::area(outline);
    let is_sheet = |item: &Item| {
        item.contours.iter().any(|c| {
            let (from, to) = geometry::bounds(&c.points);
            from <= low && to >= high && geometry::area(&c.points) > SHEET * area
        })
    };
    let mut made: Vec<(Paint, Region)> = Vec::new();
    for item in items {
        let fill = item.fill.filter(|_| !is_sheet(item)).map(|paint| (paint, region::of(item)));
        let line = item.line.as_ref().map(|line| (line.paint, line.area.clone()));
        for (paint, rings) in fill.into_iter().chain(line) {
            match made.last_mut() {
                Some((last, batch)) if last.is_near(paint) => batch.extend(rings),
                _ => made.push((paint, rings)),
            }
        }
    }
    made
}

/// The silhouette without the line that is drawn along its edge.
fn inside_of_edge(items: &[Item], outline: &[Point], size: f64) -> Region {
    let is_edge = |item: &&Item| item.contours.iter().any(|c| c.extent() > EDGE * size);
    let lines = items.iter().filter(is_edge).filter_map(|i| i.line.as_ref());
    let width = lines.map(|line| line.width).fold(0.0, f64::max);
    if width == 0.0 {
        return vec![outline.to_vec()];
    }
    geometry::offset(outline, -EDGE_LINE * width, CHORD).into_iter().flatten().collect()
}
