//! Regions of the plane: what is painted, clipped and masked.

use super::scene::{Item, Paint};
use crate::geometry::{self, Point};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::simplify::SimplifyShape;
use i_overlay::float::single::SingleFloatOverlay;

/// Outer boundaries counter-clockwise, holes clockwise; none crosses another.
pub(super) type Region = Vec<Vec<Point>>;

type Plain = Vec<[f64; 2]>;

fn plain(region: &[Vec<Point>]) -> Vec<Plain> {
    region.iter().map(|r| r.iter().map(|p| [p.x, p.y]).collect()).collect()
}

fn points(shapes: Vec<Vec<Plain>>) -> Region {
    let ring = |r: Plain| r.into_iter().map(|[x, y]| Point::new(x, y)).collect();
    shapes.into_iter().flatten().map(ring).collect()
}

/// What closed curves enclose by either rule.
pub(super) fn filled(rings: &[Vec<Point>], even_odd: bool) -> Region {
    let rule = if even_odd { FillRule::EvenOdd } else { FillRule::NonZero };
    points(plain(rings).simplify_shape_as::<i64>(rule))
}

fn overlaid(a: &Region, b: &Region, rule: OverlayRule) -> Region {
    points(plain(a).overlay_as::<i64>(&plain(b), rule, FillRule::NonZero))
}

pub(super) fn united(a: &Region, b: &Region) -> Region {
    overlaid(a, b, OverlayRule::Union)
}

pub(super) fn without(a: &Region, b: &Region) -> Region {
    overlaid(a, b, OverlayRule::Difference)
}

pub(super) fn common(a: &Region, b: &Region) -> Region {
    overlaid(a, b, OverlayRule::Intersect)
}

/// Whether all points lie in a region of one boundary.
pub(super) fn holds(region: &Region, points: &[Point]) -> bool {
    matches!(&region[..], [ring] if points.iter().all(|p| geometry::contains(ring, *p)))
}

/// The area of a path.
pub(super) fn of(item: &Item) -> Region {
    let rings: Vec<Vec<Point>> = item.contours.iter().map(|c| c.points.clone()).collect();
    filled(&rings, item.even_odd)
}

/// Places along each side of the canvas at which the ground is looked at.
const BORDER: usize = 16;
/// How far within the canvas they lie, as a share of it.
const INSET: f64 = 0.004;
/// Share of these places that one colour must cover to be the ground.
const GROUND: f64 = 0.95;
/// Changes between paint and ground that are followed; beyond them ground takes nothing more away.
const LAYERS: usize = 200;

/// What is painted in another colour than the ground. The ground is white, or what covers the border of the canvas; a
/// drawing in which all paint is ground is taken whole.
pub(super) fn painted(items: &[&Item], canvas: &[Point]) -> Region {
    let border = ground(items, canvas);
    let is_ground = |paint: Paint| match border {
        Some(colour) => paint.is_near(colour),
        None => paint.is_white(),
    };
    let mut shown: Region = Vec::new();
    let mut batch: (bool, Region) = (false, Vec::new());
    let mut changes = 0;
    let apply = |shown: &mut Region, (ground, rings): (bool, Region)| {
        if rings.is_empty() || (ground && shown.is_empty()) {
            return;
        }
        let rings = filled(&rings, false);
        *shown = if ground { without(shown, &rings) } else { united(shown, &rings) };
    };
    for item in items {
        let Some(paint) = item.paint else { continue };
        let ground = is_ground(paint);
        if ground != batch.0 {
            changes += 1;
            apply(&mut shown, std::mem::take(&mut batch));
            batch.0 = ground;
        }
        if !(ground && changes > LAYERS) {
            batch.1.extend(of(item));
        }
    }
    apply(&mut shown, batch);
    if !shown.is_empty() {
        return shown;
    }
    let all: Region = items.iter().flat_map(|i| of(i)).collect();
    filled(&all, false)
}

/// The colour that covers the border of the canvas.
fn ground(items: &[&Item], canvas: &[Point]) -> Option<Paint> {
    let center = geometry::centroid(canvas);
    let n = canvas.len();
    let places: Vec<Point> = (0..n)
        .flat_map(|i| {
            let (a, b) = (canvas[i], canvas[(i + 1) % n]);
            (0..BORDER).map(move |k| a + (b - a) * ((k as f64 + 0.5) / BORDER as f64))
        })
        .map(|p| p + (center - p) * (2.0 * INSET))
        .collect();
    let covering = |item: &&&Item, p: Point| {
        let inside = |c: &&crate::input::contours::Contour| geometry::contains(&c.points, p);
        item.contours.iter().filter(inside).count() % 2 == 1
    };
    let top = |p: &Point| items.iter().rev().find(|i| covering(i, *p)).and_then(|i| i.paint);
    let colours: Vec<Paint> = places.iter().filter_map(top).collect();
    let colour = colours.get(colours.len() / 2).copied()?;
    let share = colours.iter().filter(|c| c.is_near(colour)).count() as f64 / places.len() as f64;
    (share >= GROUND).then_some(colour)
}

/// The areas of paths by layer, each united.
pub(super) fn by_layer(items: &[&Item], canvas: &[Point]) -> Vec<(String, Region)> {
    let layer = |i: &Item| i.contours.first().map_or(String::new(), |c| c.layer.clone());
    // Parts of a gear have ids of their own, but gears of a sheet are named.
    let named = |l: &str| crate::gear::Side::BOTH.iter().any(|s| l.starts_with(s.name()));
    let key = |i: &Item| Some(layer(i)).filter(|l| named(l) || i.in_part).unwrap_or_default();
    let mut layers: Vec<String> = items.iter().map(|i| key(i)).collect();
    layers.sort();
    layers.dedup();
    let of_layer = |l: String| {
        let own: Vec<&Item> = items.iter().copied().filter(|i| key(i) == l).collect();
        let region = painted(&own, canvas);
        (l, region)
    };
    layers.into_iter().map(of_layer).collect()
}
