//! The plate that the gears stand and turn on.

use super::{Base, Outfit, OutfitError};
use crate::assembly::{Assembly, Fixture, PlacedGear, Post};
use crate::geometry::{self, Point, Vector};
use crate::policy;
use crate::solid::{circle, pin_radius};

/// The plate asked for, below the gears.
pub(super) fn plate(assembly: &Assembly, outfit: &Outfit) -> Result<Option<Fixture>, OutfitError> {
    match outfit.base {
        Base::None => Ok(None),
        Base::Pins => pins(assembly, outfit).map(Some),
        Base::Lego => lego(assembly, outfit).map(Some),
    }
}

/// A round pin for each gear, with a shoulder that the gear rests on. Bores that are not round turn on the
/// thickest round pin that goes into them.
fn pins(assembly: &Assembly, outfit: &Outfit) -> Result<Fixture, OutfitError> {
    let (thickness, gap) = (outfit.base_thickness, policy::SHOULDER_HEIGHT);
    let play = outfit.play().unwrap_or(policy::SLIDE_FIT);
    let mut posts = Vec::new();
    let mut widest = 0.0_f64;
    for placed in &assembly.gears {
        let gear = &placed.gear;
        let none = || OutfitError::NoBore { gear: gear.name.clone(), what: "a pin" };
        let bore = gear.bore.as_ref().ok_or_else(none)?;
        let radius = pin_radius(bore) - play;
        if radius < policy::THINNEST_PIN {
            let bore = 2.0 * (policy::THINNEST_PIN + play);
            let remedy = format!(
                "a pin needs a bore with room for {bore:.1} mm across; give a larger --bore"
            );
            let (what, value) = ("the width of the pin", 2.0 * radius);
            return Err(OutfitError::BadSize { what, value, remedy });
        }
        let shoulder = radius + policy::SHOULDER_WIDTH;
        widest = widest.max(shoulder);
        let hub = gear.fittings.hub.map_or(0.0, |h| h.height);
        let top = thickness + gap + assembly.thickness + hub + policy::PIN_OVERHANG;
        let fine = policy::BORE_CHORD_TOLERANCE;
        let post = |radius, from, to| Post {
            ring: moved(&circle(radius, fine), placed.axis),
            hole: None,
            from,
            to,
        };
        posts.push(post(shoulder, thickness, thickness + gap));
        posts.push(post(radius, thickness + gap, top));
    }
    let edge = widest + policy::BASE_MARGIN;
    Ok(Fixture {
        name: "base".to_owned(),
        outline: rounded_box(&assembly.gears, Vector::new(edge, edge), edge),
        holes: Vec::new(),
        thickness,
        posts,
        z: -(thickness + gap),
    })
}

/// Three rows of holes as in a Lego beam, one of them through all axes, and a ring about each axle that
/// the gear rests on.
fn lego(assembly: &Assembly, outfit: &Outfit) -> Result<Fixture, OutfitError> {
    let stud = policy::LEGO_STUD;
    let axes: Vec<Vector> = {
        let first = assembly.gears.first().map_or_else(Point::origin, |g| g.axis);
        assembly.gears.iter().map(|g| g.axis - first).collect()
    };
    for axis in &axes {
        outfit.check_distance(axis.x.abs())?;
        outfit.check_distance(axis.y.abs())?;
    }
    let (thickness, gap) = (outfit.base_thickness, policy::SHOULDER_HEIGHT);
    let play = outfit.play().unwrap_or(policy::LEGO_AXLE_PLAY);
    let round = circle(0.5 * policy::LEGO_AXLE_SPAN + play, policy::BORE_CHORD_TOLERANCE);
    let (low, high) = bounds(&assembly.gears);
    let columns = ((high.x - low.x) / stud).round() as i32;
    let rows = ((high.y - low.y) / stud).round() as i32;
    let mut holes = Vec::new();
    for row in -1..=rows + 1 {
        for column in -1..=columns + 1 {
            let at = low + stud * Vector::new(f64::from(column), f64::from(row));
            holes.push(moved(&round, at));
        }
    }
    let ring = circle(policy::LEGO_SHOULDER, policy::BORE_CHORD_TOLERANCE);
    let at = |axis: Point| {
        let [column, row] = [(axis - low).x, (axis - low).y].map(|v| (v / stud).round() as usize);
        (row + 1) * (columns as usize + 3) + column + 1
    };
    let posts = assembly
        .gears
        .iter()
        .map(|g| Post {
            ring: moved(&ring, g.axis),
            hole: Some(at(g.axis)),
            from: thickness,
            to: thickness + gap,
        })
        .collect();
    let margin = 1.5 * stud;
    Ok(Fixture {
        name: "base".to_owned(),
        outline: rounded_box(&assembly.gears, Vector::new(margin, margin), 0.5 * stud),
        holes,
        thickness,
        posts,
        z: -(thickness + gap),
    })
}

fn moved(ring: &[Point], to: Point) -> Vec<Point> {
    ring.iter().map(|p| p + to.coords).collect()
}

fn bounds(gears: &[PlacedGear]) -> (Point, Point) {
    let axes: Vec<Point> = gears.iter().map(|g| g.axis).collect();
    geometry::bounds(&axes)
}

/// The box round all axes, `margin` wider on every side, its corners rounded by `radius`.
fn rounded_box(gears: &[PlacedGear], margin: Vector, radius: f64) -> Vec<Point> {
    let (low, high) = bounds(gears);
    let (low, high) = (low - margin, high + margin);
    let quarter: Vec<Point> = circle(radius, policy::BORE_CHORD_TOLERANCE);
    let corner = |p: &Point, right: bool, top: bool| {
        let x = if right { high.x - radius } else { low.x + radius };
        let y = if top { high.y - radius } else { low.y + radius };
        Point::new(x + p.x, y + p.y)
    };
    let mut ring: Vec<Point> = Vec::with_capacity(quarter.len() + 4);
    for (right, top, from) in
        [(true, true, 0.0), (false, true, 0.25), (false, false, 0.5), (true, false, 0.75)]
    {
        let n = quarter.len();
        let start = (from * n as f64).round() as usize;
        let end = ((from + 0.25) * n as f64).round() as usize;
        for k in start..=end {
            let p = corner(&quarter[k % n], right, top);
            if ring.last().is_none_or(|q| (q - p).norm() > policy::BORE_CHORD_TOLERANCE) {
                ring.push(p);
            }
        }
    }
    // A stadium's first and last corner are one.
    while ring.len() > 3 && (ring[ring.len() - 1] - ring[0]).norm() < policy::BORE_CHORD_TOLERANCE {
        ring.pop();
    }
    ring
}
