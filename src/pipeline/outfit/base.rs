//! What the gears stand and turn on: plates with pins, screws, bearings, or the holes of a Lego beam.

use super::stand;
use super::{Base, Hold, Mount, Outfit, OutfitError};
use crate::assembly::{Assembly, Fixture, PlacedGear, Pocket, Post, Stance};
use crate::geometry::{self, Point, Vector};
use crate::policy;
use crate::solid::hardware::{Bearing, Clearance, Screw};
use crate::solid::{circle, hole, pin_radius};
use std::f64::consts::TAU;

/// Play a side of a nut or head in its trap, mm: it drops in and does not turn.
const TRAP_PLAY: f64 = 0.15;
/// How much deeper a trap is than a nut is high, mm.
const TRAP_ROOM: f64 = 0.3;
/// Plate above a trap, mm: five layers that a screw pulls on.
const TRAP_ROOF: f64 = 2.0;
/// Play a side of a bearing in its seat, mm: pressed in by hand.
const SEAT_PLAY: f64 = 0.05;
/// Plate under a bearing, mm.
const SEAT_FLOOR: f64 = 1.2;
/// Share of a bearing's ring (outside less shaft) that the floor of its seat holds: the outer race only.
const SEAT_LIP: f64 = 0.12;
/// Share of the same that a spacer may cover: the inner race only.
const SPACER_SHARE: f64 = 0.175;
/// Wall of a spacer between a bearing and its gear, mm.
const SPACER_WALL: f64 = 1.5;
/// Play a side of a spacer on its shaft, mm.
const SPACER_PLAY: f64 = 0.15;
/// How much wider than its screw or shaft a bore may be, mm: beyond it the gear wobbles out of mesh.
const LOOSEST_BORE: f64 = 1.2;
/// Width of a plate beyond the axes, in reaches of the farthest tooth: what stands on it never tips it over.
const PLATE_SHARE: f64 = 0.5;
/// Wall between a mounting hole and the plate's edge or a shoulder, mm.
const MOUNT_WALL: f64 = 4.0;

/// The parts asked for, below the gears.
pub(super) fn parts(assembly: &Assembly, outfit: &Outfit) -> Result<Vec<Fixture>, OutfitError> {
    match outfit.base {
        Base::None => Ok(Vec::new()),
        Base::Lego => Ok(vec![lego(assembly, outfit)?]),
        Base::Pins | Base::Screw { .. } | Base::Bearing(_) => standing(assembly, outfit),
    }
}

/// A plate, what holds each gear on it, and what the plate stands on.
fn standing(assembly: &Assembly, outfit: &Outfit) -> Result<Vec<Fixture>, OutfitError> {
    let seat = match outfit.base {
        Base::Screw { screw, hold } => Seat::screw(screw, hold)?,
        Base::Bearing(bearing) => Seat::bearing(bearing),
        _ => Seat::default(),
    };
    let thickness = thickness(outfit, seat.least)?;
    let gap = policy::SHOULDER_HEIGHT;
    let mut plate = Fixture {
        name: "base".to_owned(),
        outline: Vec::new(),
        holes: Vec::new(),
        thickness,
        posts: Vec::new(),
        pockets: Vec::new(),
        stance: Stance::flat(-(thickness + gap)),
    };
    let mut more = Vec::new();
    let mut widest = 0.0_f64;
    for placed in &assembly.gears {
        let foot = match seat.shaft {
            None => pin(&mut plate, placed, assembly.thickness, outfit, &mut more)?,
            Some(shaft) => {
                passes(placed, shaft, outfit.base)?;
                seat.cut(&mut plate, placed, &mut more)
            }
        };
        widest = widest.max(foot);
    }
    let reach = assembly.gears.iter().flat_map(|g| &g.gear.outline);
    let reach = reach.map(|p| p.coords.norm()).fold(0.0, f64::max);
    let mut corner = widest + policy::BASE_MARGIN;
    let mut edge = corner.max(PLATE_SHARE * reach);
    let mount = match outfit.mount {
        Mount::None => None,
        Mount::Screws(screw) => Some(0.5 * screw.hole(Clearance::Medium)),
        Mount::Feet => Some(stand::FOOT_HOLE),
    };
    if let Some(radius) = mount {
        corner = radius + MOUNT_WALL;
        edge = edge.max(corner + radius + MOUNT_WALL + widest);
    }
    let (low, high) = bounds(&assembly.gears);
    let edges = Vector::new(edge, edge);
    let (mut low, high) = (low - edges, high + edges);
    if outfit.upright {
        corner = corner.min(stand::CORNER);
        low.y = low.y.min(bounds(&assembly.gears).0.y - reach - stand::ROOM_BELOW);
    }
    plate.outline = rounded_box(low, high, corner);
    if let Some(radius) = mount {
        let round = hole(radius, policy::BORE_CHORD_TOLERANCE);
        let inner = Vector::new(corner, corner);
        let (l, h) = (low + inner, high - inner);
        let corners = [l, Point::new(h.x, l.y), h, Point::new(l.x, h.y)];
        plate.holes.extend(corners.map(|at| moved(&round, at)));
        if outfit.mount == Mount::Feet {
            more.extend(stand::feet(&corners, plate.stance, thickness));
        }
    }
    if outfit.upright {
        more.extend(stand::upright(&mut plate, low, high)?);
    }
    more.insert(0, plate);
    Ok(more)
}

/// The thickness asked for, or what the base needs and no less than is stiff.
fn thickness(outfit: &Outfit, least: f64) -> Result<f64, OutfitError> {
    match outfit.base_thickness {
        None => Ok(policy::BASE_THICKNESS.max(least)),
        Some(asked) if asked + 1e-9 < least => Err(OutfitError::BadSize {
            what: "the thickness of the base",
            value: asked,
            remedy: format!("this base takes --base-thickness {least:.1}mm or more"),
        }),
        Some(asked) => Ok(asked),
    }
}

/// A round pin with a shoulder that the gear rests on, and its cap; the radius of the shoulder. Bores that are not round
/// turn on the thickest round pin that goes into them.
fn pin(
    plate: &mut Fixture,
    placed: &PlacedGear,
    height: f64,
    outfit: &Outfit,
    more: &mut Vec<Fixture>,
) -> Result<f64, OutfitError> {
    let play = outfit.play().unwrap_or(policy::SLIDE_FIT);
    let bore = bore_of(placed, "a pin")?;
    let radius = pin_radius(bore) - play;
    if radius < policy::THINNEST_PIN {
        let least = 2.0 * (policy::THINNEST_PIN + play);
        let remedy =
            format!("a pin needs a bore with room for {least:.1} mm across; give a larger --bore");
        let (what, value) = ("the width of the pin", 2.0 * radius);
        return Err(OutfitError::BadSize { what, value, remedy });
    }
    let shoulder = radius + policy::SHOULDER_WIDTH;
    let hub = placed.gear.fittings.hub.map_or(0.0, |h| h.height);
    let (bottom, gap) = (plate.thickness, policy::SHOULDER_HEIGHT);
    let rest = bottom + gap + placed.level;
    let over = if outfit.caps { stand::CAP_REACH } else { policy::PIN_OVERHANG };
    let post = |radius, from, to| Post {
        ring: moved(&circle(radius, policy::BORE_CHORD_TOLERANCE), placed.axis),
        hole: None,
        from,
        to,
    };
    plate.posts.push(post(shoulder, bottom, rest));
    plate.posts.push(post(radius, rest, rest + height + hub + over));
    if outfit.caps {
        more.push(stand::cap(placed, radius, placed.level + height + hub));
    }
    Ok(shoulder)
}

/// What a plate holds each gear's screw or shaft with.
#[derive(Default)]
struct Seat {
    /// Diameter of what goes through the gear; none for pins.
    shaft: Option<f64>,
    /// Radius of the hole through the plate.
    hole: f64,
    /// A trap below: its corners about the axis, and its depth.
    trap: Option<(Vec<Point>, f64)>,
    /// The bearing above.
    bearing: Option<Bearing>,
    /// Thinnest plate.
    least: f64,
}

impl Seat {
    fn screw(screw: Screw, hold: Hold) -> Result<Self, OutfitError> {
        let mut seat = Self {
            shaft: Some(screw.diameter),
            hole: 0.5 * screw.hole(Clearance::Fine),
            ..Self::default()
        };
        match hold {
            Hold::Through => {}
            Hold::Nut => {
                let radius =
                    (0.5 * screw.across_flats + TRAP_PLAY) / (std::f64::consts::PI / 6.0).cos();
                let corner =
                    |i| geometry::rotate(Point::new(radius, 0.0), TAU * f64::from(i) / 6.0);
                let depth = screw.nut_height + TRAP_ROOM;
                seat.trap = Some(((0..6).map(corner).collect(), depth));
                seat.least = depth + TRAP_ROOF;
            }
            Hold::Insert => {
                let [hole, depth] = screw.insert.ok_or_else(|| OutfitError::BadSize {
                    what: "the screw of the threaded insert",
                    value: screw.diameter,
                    remedy: "give insert:M2 to insert:M8".to_owned(),
                })?;
                seat.hole = 0.5 * hole;
                seat.least = depth - policy::SHOULDER_HEIGHT;
            }
        }
        Ok(seat)
    }

    fn bearing(bearing: Bearing) -> Self {
        let ring = bearing.outside - bearing.shaft;
        Self {
            shaft: Some(bearing.shaft),
            hole: 0.5 * bearing.outside - SEAT_LIP * ring,
            trap: None,
            bearing: Some(bearing),
            least: bearing.width + SEAT_FLOOR,
        }
    }

    /// Cuts the plate under a gear; the radius that is taken there.
    fn cut(&self, plate: &mut Fixture, placed: &PlacedGear, more: &mut Vec<Fixture>) -> f64 {
        let round = |radius| circle(radius, policy::BORE_CHORD_TOLERANCE);
        let (number, thickness) = (plate.holes.len(), plate.thickness);
        plate.holes.push(moved(&hole(self.hole, policy::BORE_CHORD_TOLERANCE), placed.axis));
        let number_of_hole = Some(number);
        if let Some(bearing) = self.bearing {
            let radius = 0.5 * bearing.outside + SEAT_PLAY;
            plate.pockets.push(Pocket {
                ring: moved(&hole(radius, policy::BORE_CHORD_TOLERANCE), placed.axis),
                hole: number_of_hole,
                from: thickness - bearing.width,
                to: thickness,
            });
            more.push(spacer(placed, bearing));
            return radius;
        }
        let shoulder = self.hole + policy::SHOULDER_WIDTH;
        plate.posts.push(Post {
            ring: moved(&round(shoulder), placed.axis),
            hole: number_of_hole,
            from: thickness,
            to: thickness + policy::SHOULDER_HEIGHT + placed.level,
        });
        let Some((ring, depth)) = &self.trap else { return shoulder };
        let ring = moved(ring, placed.axis);
        plate.pockets.push(Pocket { ring, hole: number_of_hole, from: 0.0, to: *depth });
        shoulder
            .max(self.trap.iter().flat_map(|t| &t.0).map(|p| p.coords.norm()).fold(0.0, f64::max))
    }
}

/// The ring that keeps a gear off the plate and rests on the inner race only.
fn spacer(placed: &PlacedGear, bearing: Bearing) -> Fixture {
    let inner = 0.5 * bearing.shaft;
    let race = inner + SPACER_SHARE * (bearing.outside - bearing.shaft);
    let fine = policy::BORE_CHORD_TOLERANCE;
    Fixture {
        name: format!("{}-spacer", placed.gear.name),
        outline: circle((inner + SPACER_WALL).min(race), fine),
        holes: vec![hole(inner + SPACER_PLAY, fine)],
        thickness: policy::SHOULDER_HEIGHT + placed.level,
        posts: Vec::new(),
        pockets: Vec::new(),
        stance: Stance::at(placed.axis, -policy::SHOULDER_HEIGHT),
    }
}

fn bore_of<'a>(placed: &'a PlacedGear, what: &'static str) -> Result<&'a [Point], OutfitError> {
    let none = || OutfitError::NoBore { gear: placed.gear.name.clone(), what };
    placed.gear.bore.as_deref().ok_or_else(none)
}

/// Passes a bore that a screw or shaft goes through without wobbling.
fn passes(placed: &PlacedGear, shaft: f64, base: Base) -> Result<(), OutfitError> {
    let wide = 2.0 * pin_radius(bore_of(placed, "a screw or shaft")?);
    if (shaft..shaft + LOOSEST_BORE).contains(&(wide + 1e-9)) {
        return Ok(());
    }
    let remedy = match base {
        Base::Screw { screw, .. } => format!("give --bore {}", screw.name),
        _ => format!("this base has shafts of {shaft} mm; give --bore {shaft}mm --fit slide"),
    };
    Err(OutfitError::BadSize { what: "the width of the bore", value: wide, remedy })
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
    let (thickness, gap) = (thickness(outfit, 0.0)?, policy::SHOULDER_HEIGHT);
    let play = outfit.play().unwrap_or(policy::LEGO_AXLE_PLAY);
    let round = hole(0.5 * policy::LEGO_AXLE_SPAN + play, policy::BORE_CHORD_TOLERANCE);
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
    let margin = Vector::new(1.5 * stud, 1.5 * stud);
    Ok(Fixture {
        name: "base".to_owned(),
        outline: rounded_box(low - margin, high + margin, 0.5 * stud),
        holes,
        thickness,
        posts,
        pockets: Vec::new(),
        stance: Stance::flat(-(thickness + gap)),
    })
}

pub(super) fn moved(ring: &[Point], to: Point) -> Vec<Point> {
    ring.iter().map(|p| p + to.coords).collect()
}

fn bounds(gears: &[PlacedGear]) -> (Point, Point) {
    let axes: Vec<Point> = gears.iter().map(|g| g.axis).collect();
    geometry::bounds(&axes)
}

/// A box with its corners rounded by `radius`; its sides lie on the box, and sides without length are left out.
fn rounded_box(low: Point, high: Point, radius: f64) -> Vec<Point> {
    let steps = circle(radius, policy::BORE_CHORD_TOLERANCE).len().div_ceil(4);
    let inner = Vector::new(radius, radius);
    let (l, h) = (low + inner, high - inner);
    let corners = [h, Point::new(l.x, h.y), l, Point::new(h.x, l.y)];
    let mut ring: Vec<Point> = Vec::with_capacity(4 * (steps + 1));
    for (turn, corner) in corners.into_iter().enumerate() {
        for k in 0..=steps {
            let angle = 0.25 * TAU * (turn as f64 + k as f64 / steps as f64);
            let p = corner + geometry::rotate(Point::new(radius, 0.0), angle).coords;
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
