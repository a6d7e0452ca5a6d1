//! Where a gear's axis is.

use super::CheckError;
use crate::gear::Side;
use crate::geometry::{self, Point};
use crate::input::Toothed;

/// How an axis was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisSource {
    /// It was given.
    Given,
    /// The centre of the gear's bore: of its round part, where it has a flat, a key or a set screw.
    Bore,
    /// The origin of the drawing.
    Origin,
    /// The centre of a round gear's tips.
    Outline,
}

impl AxisSource {
    /// A stable word for programs.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Given => "given",
            Self::Bore => "bore",
            Self::Origin => "origin",
            Self::Outline => "outline",
        }
    }
}

/// Distances below this share of a gear's radius count as none: a bore is drilled, and drawn, with less care than teeth.
const NEAR: f64 = 0.02;
/// Stray of the tips of a round gear from a circle, as a share of its radius.
const ROUND_TIPS: f64 = 0.01;
/// Places along a hole at which its boundary is looked at.
const PLACES: usize = 720;
/// Stray of the round part of a bore from a circle, as a share of its radius.
const ROUND_PART: f64 = 3e-3;
/// Share of the boundary that must be round for the circle to be the axis; less is a hexagon, a square or a cross, of which
/// the centre of area is.
const ROUND_SHARE: f64 = 0.4;

/// An axis, how it was found, and what a reader should know of it.
pub(super) type Found = (Point, AxisSource, Option<String>);

/// The axis in the frame of the file, mm: what was given, else the bore's centre, else that of round tips, else the origin.
///
/// # Errors
/// [`CheckError::AxisOutside`] and [`CheckError::NoAxis`].
pub(super) fn axis(gear: &Toothed, side: Side, given: Option<Point>) -> Result<Found, CheckError> {
    if let Some(axis) = given {
        return if gear.outline.contains(axis) {
            Ok((axis, AxisSource::Given, None))
        } else {
            Err(CheckError::AxisOutside { gear: side, x: axis.x, y: axis.y })
        };
    }
    if gear.record.is_some() {
        let origin = Point::origin();
        return if gear.outline.contains(origin) {
            Ok((origin, AxisSource::Origin, None))
        } else {
            Err(CheckError::AxisOutside { gear: side, x: 0.0, y: 0.0 })
        };
    }
    let center = geometry::centroid(gear.outline.points());
    let radius = (gear.outline.area() / std::f64::consts::PI).sqrt();
    let near = |a: Point, b: Point| (a - b).norm() <= NEAR * radius;
    let bores: Vec<Point> = gear.holes.iter().map(|h| middle(h.points())).collect();
    let tips = round_tips(gear.outline.points(), center);
    let at_origin = gear.outline.contains(Point::origin());
    let about_origin = || {
        let holds = gear.holes.iter().position(|hole| hole.contains(Point::origin()));
        holds.map(|i| bores[i])
    };
    if let Some(tips) = tips {
        if let Some(bore) = bores.iter().find(|b| near(**b, tips)) {
            return Ok((*bore, AxisSource::Bore, None));
        }
        // A round gear on an axis of its own says so by a bore about the origin.
        if let Some(bore) = about_origin() {
            return Ok((bore, AxisSource::Bore, None));
        }
        if let [bore] = bores[..] {
            let word = format!(
                "the {side}'s only hole, at ({:.3}, {:.3}), is {:.3} mm off the centre of its tips, so it was not taken for the bore; if it is, give --{side}-axis {:.3},{:.3}",
                bore.x,
                bore.y,
                (bore - tips).norm(),
                bore.x,
                bore.y
            );
            if at_origin && near(Point::origin(), tips) {
                return Ok((Point::origin(), AxisSource::Origin, Some(word)));
            }
            return Ok((tips, AxisSource::Outline, Some(word)));
        }
        if at_origin && near(Point::origin(), tips) {
            return Ok((Point::origin(), AxisSource::Origin, None));
        }
        if bores.is_empty() && at_origin {
            return Ok((Point::origin(), AxisSource::Origin, None));
        }
        return Ok((tips, AxisSource::Outline, None));
    }
    let bore = if let [bore] = bores[..] { Some(bore) } else { about_origin() };
    match bore {
        Some(bore) => Ok((bore, AxisSource::Bore, None)),
        None if at_origin => Ok((Point::origin(), AxisSource::Origin, None)),
        None => Err(CheckError::NoAxis { gear: side, holes: gear.holes.len() }),
    }
}

/// The centre of the circle through the tips of a round gear.
fn round_tips(points: &[Point], center: Point) -> Option<Point> {
    let mut at = center;
    let mut radius = 0.0;
    for _ in 0..4 {
        // The outermost point in each of many directions, where it is a tip.
        let mut farthest = [None::<(f64, Point)>; TIP_SECTORS];
        for &p in points {
            let arm = p - at;
            let turn = (arm.y.atan2(arm.x) / std::f64::consts::TAU).rem_euclid(1.0);
            let sector = &mut farthest[((turn * TIP_SECTORS as f64) as usize).min(TIP_SECTORS - 1)];
            if sector.is_none_or(|(r, _)| arm.norm() > r) {
                *sector = Some((arm.norm(), p));
            }
        }
        let tips: Vec<Point> = farthest.into_iter().flatten().map(|(_, p)| p).collect();
        if tips.len() < TIP_SECTORS {
            return None;
        }
        (at, radius) = circle_through(&tips)?;
        if tips.iter().any(|p| ((p - at).norm() - radius).abs() > ROUND_TIPS * radius)
            && radius > 0.0
        {
            // Sectors between two tips of a gear with few teeth hold none.
            let strays =
                tips.iter().filter(|p| ((*p - at).norm() - radius).abs() > ROUND_TIPS * radius);
            if strays.count() * 4 > tips.len() {
                return None;
            }
        }
    }
    (radius > 0.0).then_some(at)
}

/// Directions in which the tips of a gear are looked for.
const TIP_SECTORS: usize = 8;

/// The circle that fits points best in the algebraic sense (Kasa 1976): its centre and radius.
fn circle_through(points: &[Point]) -> Option<(Point, f64)> {
    let middle = points.iter().fold(geometry::Vector::zeros(), |sum, p| sum + p.coords)
        / points.len().max(1) as f64;
    let mut normal = nalgebra::Matrix3::<f64>::zeros();
    let mut right = nalgebra::Vector3::<f64>::zeros();
    for p in points {
        let q = p.coords - middle;
        let row = nalgebra::Vector3::new(2.0 * q.x, 2.0 * q.y, 1.0);
        normal += row * row.transpose();
        right += row * q.norm_squared();
    }
    let [x, y, c] = normal.lu().solve(&right)?.into();
    let squared = c + x * x + y * y;
    (squared > 0.0).then(|| (Point::from(middle + geometry::Vector::new(x, y)), squared.sqrt()))
}

/// The centre of the round part of a hole, or that of its area.
fn middle(hole: &[Point]) -> Point {
    let total = geometry::perimeter(hole);
    let mut places = Vec::with_capacity(PLACES);
    let mut walked = 0.0;
    for (a, b) in hole.iter().zip(hole.iter().cycle().skip(1)) {
        let length = (b - a).norm();
        // Middles of chords lie within the circle, their ends on it.
        while (places.len() as f64 + 0.5) * total / PLACES as f64 <= walked + length
            && places.len() < PLACES
        {
            let along = ((places.len() as f64 + 0.5) * total / PLACES as f64 - walked) / length;
            places.push(if along < 0.5 { *a } else { *b });
        }
        walked += length;
    }
    let n = places.len();
    let mut best: (usize, Vec<Point>) = (0, Vec::new());
    for i in (0..n).step_by(n.div_ceil(60).max(1)) {
        for reach in [n / 12, n / 6, n / 4] {
            let three = [places[i], places[(i + reach) % n], places[(i + 2 * reach) % n]];
            let Some((center, radius)) = circle_through(&three) else { continue };
            let on: Vec<Point> = places
                .iter()
                .copied()
                .filter(|p| ((p - center).norm() - radius).abs() <= ROUND_PART * radius)
                .collect();
            if on.len() > best.0 {
                best = (on.len(), on);
            }
        }
    }
    if best.0 as f64 >= ROUND_SHARE * n as f64
        && let Some((center, radius)) = circle_through(&best.1)
    {
        return circle_through(&round_vertices(hole, center, radius)).map_or(center, |(c, _)| c);
    }
    geometry::centroid(hole)
}

/// The vertices of a hole that its round part is drawn with: ends of flats and keys, where the boundary turns off the circle,
/// lie on it only by the drawing's chords and would pull the centre towards them.
fn round_vertices(hole: &[Point], center: Point, radius: f64) -> Vec<Point> {
    let n = hole.len();
    let on: Vec<bool> =
        hole.iter().map(|p| ((p - center).norm() - radius).abs() <= ROUND_PART * radius).collect();
    // A chord of the circle keeps to it in its middle, the side of a flat or a key does not.
    let chord = |i: usize| {
        let middle = nalgebra::center(&hole[i], &hole[(i + 1) % n]);
        on[i] && on[(i + 1) % n] && ((middle - center).norm() - radius).abs() <= CHORD_BOW * radius
    };
    (0..n).filter(|&i| chord((i + n - 1) % n) && chord(i)).map(|i| hole[i]).collect()
}

/// Bow of the chords that a round part is drawn with, as a share of its radius: those of a circle of twelve chords.
const CHORD_BOW: f64 = 0.035;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::Bore;

    #[test]
    fn bores_of_every_kind_show_their_axis() {
        let bores = [
            Bore::Round { diameter: 5.0 },
            Bore::D { diameter: 5.0, flat: 4.5 },
            Bore::D { diameter: 8.0, flat: 5.5 },
            Bore::Hex { across: 6.0 },
            Bore::Square { side: 4.0 },
            Bore::with_standard_key(8.0).unwrap(),
            Bore::Keyway { diameter: 10.0, width: 3.0, depth: 3.0 },
            Bore::Lego { play: 0.0 },
        ];
        for bore in bores {
            let hole = bore.polygon(0.01).unwrap().unwrap();
            let shift = geometry::Vector::new(31.0, -7.0);
            let moved: Vec<Point> = hole.iter().map(|p| p + shift).collect();
            let off = (middle(&moved) - Point::from(shift)).norm();
            assert!(off < 1e-9, "{bore:?}: {off}");
        }
    }
}
