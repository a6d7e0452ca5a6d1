//! Lettering: where it goes and how large it can be.

use super::{Label, LabelText, OutfitError, Taken};
use crate::assembly::{Gear, Mark};
use crate::diagnose::Code;
use crate::geometry::{self, Lettering, Point, has_letter, lettering};
use crate::outline::simplify;
use crate::policy;

/// Writes on gear number `i`. Names lose what no font has and are left out where they do not fit,
/// and why is told.
///
/// # Errors
/// A text of the user's own that has no room or no letters.
pub(super) fn add(
    gear: &mut Gear,
    choice: &Label,
    i: usize,
    names: &[String],
    taken: &mut Taken,
) -> Result<Option<Code>, OutfitError> {
    let (text, own) = match &choice.text {
        LabelText::Names => (names.get(i).unwrap_or(&gear.name).clone(), false),
        LabelText::Same(text) => (text.clone(), true),
        LabelText::Each(texts) => (texts.get(i).cloned().unwrap_or_default(), true),
    };
    let text = if own { text } else { text.chars().filter(|c| has_letter(*c)).collect() };
    let made = match lettering(&text, 1.0) {
        Err(_) if !own => {
            return Ok(Some(Code::NameUnwritable));
        }
        made => made?,
    };
    let reach = gear.outline.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
    let near = choice.place.point(reach);
    let found = Room::of(gear, taken).and_then(|room| room.best(&made, choice.height, near));
    let Some((place, height)) = found else {
        if own || choice.height.is_some() {
            let (gear, least) = (gear.name.clone(), choice.height.unwrap_or(policy::LETTERS_LEAST));
            return Err(OutfitError::NoRoomForText { gear, text, least });
        }
        return Ok(Some(Code::NameHasNoRoom));
    };
    let up = if choice.raised { policy::EMBOSSING_HEIGHT } else { -policy::ENGRAVING_DEPTH };
    let at = |p: &Point| place + (p - made.low) * height;
    for (k, face) in made.faces.iter().enumerate() {
        let face = face.iter().map(|ring| ring.iter().map(at).collect()).collect();
        let name = format!("letter {} of {text:?}", k + 1);
        gear.fittings.marks.push(Mark { name, face, height: up });
    }
    let high = at(&made.high);
    let corners = [(place.x, place.y), (high.x, place.y), (high.x, high.y), (place.x, high.y)];
    taken.rings.push(corners.map(|(x, y)| Point::new(x, y)).to_vec());
    Ok(None)
}

/// Free places on a gear's face as a grid of cells, with sums for rectangles.
struct Room {
    low: Point,
    cell: f64,
    across: usize,
    up: usize,
    /// Cells taken left of and below each corner of the grid.
    sums: Vec<u32>,
}

impl Room {
    fn of(gear: &Gear, taken: &Taken) -> Option<Self> {
        let inner = geometry::offset(&gear.outline, -policy::LABEL_WALL, policy::OPENING_CHORD);
        let room = inner
            .into_iter()
            .map(|f| f[0].clone())
            .find(|r| geometry::contains(r, Point::origin()))?;
        let room = simplify(&room, policy::OPENING_TOLERANCE);
        let barred = taken.grown(policy::LABEL_WALL);
        let (low, high) = geometry::bounds(&room);
        let size = high - low;
        let cell = size.max() / policy::LABEL_CELLS as f64;
        let [across, up] = [size.x, size.y].map(|s| (s / cell).ceil() as usize);
        let mut sums = vec![0; (across + 1) * (up + 1)];
        for y in 0..up {
            // Middles of a row's cells: inside the room and outside of all that is barred.
            let height = low.y + (y as f64 + 0.5) * cell;
            let inside = row(&room, height, low.x, cell, across);
            let barred: Vec<Vec<bool>> =
                barred.iter().map(|r| row(r, height, low.x, cell, across)).collect();
            let mut taken = 0;
            for x in 0..across {
                let free = inside[x] && !barred.iter().any(|r| r[x]);
                taken += u32::from(!free);
                sums[(y + 1) * (across + 1) + x + 1] = sums[y * (across + 1) + x + 1] + taken;
            }
        }
        Some(Self { low, cell, across, up, sums })
    }

    /// Lower left corner and height for the largest letters that fit, or for those of a height, nearest to a point.
    fn best(&self, text: &Lettering, height: Option<f64>, near: Point) -> Option<(Point, f64)> {
        let size = text.high - text.low;
        let least = height.unwrap_or(policy::LETTERS_LEAST);
        let mut height = height.unwrap_or(policy::LETTERS_MOST);
        while height >= least {
            let [w, h] = [size.x, size.y].map(|s| (s * height / self.cell).ceil() as usize);
            let mut found: Option<(f64, Point)> = None;
            for y in 0..(self.up + 1).saturating_sub(h) {
                for x in
                    (0..(self.across + 1).saturating_sub(w)).filter(|&x| self.is_free(x, y, w, h))
                {
                    let corner = Point::new(x as f64, y as f64) * self.cell + self.low.coords;
                    let away = (corner + 0.5 * size * height - near).norm();
                    if found.is_none_or(|(least, _)| away < least) {
                        found = Some((away, corner));
                    }
                }
            }
            if let Some((_, corner)) = found {
                return Some((corner, height));
            }
            height *= policy::LETTERS_STEP;
        }
        None
    }

    fn is_free(&self, x: usize, y: usize, w: usize, h: usize) -> bool {
        let sum = |x: usize, y: usize| self.sums[y * (self.across + 1) + x];
        sum(x + w, y + h) + sum(x, y) == sum(x + w, y) + sum(x, y + h)
    }
}

/// Which middles of `count` cells, `cell` wide from x = `start` on, lie inside a ring at height `y`.
fn row(ring: &[Point], y: f64, start: f64, cell: f64, count: usize) -> Vec<bool> {
    let ends = ring.iter().zip(ring.iter().cycle().skip(1));
    let mut crossings: Vec<f64> = ends
        .filter(|(a, b)| (a.y <= y) != (b.y <= y))
        .map(|(a, b)| a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y))
        .collect();
    crossings.sort_by(f64::total_cmp);
    (0..count)
        .map(|i| start + (i as f64 + 0.5) * cell)
        .map(|x| crossings.partition_point(|c| *c < x) % 2 == 1)
        .collect()
}
