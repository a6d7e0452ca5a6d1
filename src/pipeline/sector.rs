//! Gears for a part of a turn: teeth stay where they mesh within it, the rest is cut away down to a hub, and the
//! pair swings there and back.

use super::PipelineError;
use super::analysed::Analysed;
use super::outfit::{Outfit, clear_radius};
use crate::assembly::{Assembly, Gear};
use crate::control::{Control, StageName};
use crate::diagnose::{Code, Diagnostic, Place};
use crate::gear::Side;
use crate::geometry::{self, Point};
use crate::law::Segment;
use crate::meshing::{ContactInput, ContactOptions, poses_at};
use crate::pitch::Centrodes;
use crate::policy;
use std::f64::consts::{PI, TAU};

/// Cuts both gears of a finished pair to the teeth that mesh while the driver turns through `segment`, and lets them
/// swing through it: motion and gears begin anew where it begins. A gear that needs nearly all of its turn stays
/// whole. The contact of what is left is judged over the segment.
///
/// # Errors
/// See [`crate::meshing::ContactError`].
pub(super) fn cut(
    assembly: &mut Assembly,
    analysed: &Analysed,
    (segment, outfit): (Segment, &Outfit),
    control: &Control,
) -> Result<Vec<Diagnostic>, PipelineError> {
    let sized = &analysed.toothed.sized;
    let centrodes = &sized.centrodes;
    let pitch = PI * sized.module;
    let kept = Kept::of(centrodes, segment, pitch);
    let transmission = &centrodes.transmission;
    let mut found = Vec::new();
    // Room for what the gear has to carry; see `outfit::hub`.
    let asked = |bore: f64| {
        outfit.hub.map_or(0.0, |hub| {
            let wall = policy::HUB_WALL.max(policy::SET_SCREW_THREAD);
            let raised = hub.diameter.map_or(bore + outfit.chamfer + wall, |d| 0.5 * d);
            raised + policy::BORE_WALL
        })
    };
    for (side, placed) in Side::BOTH.into_iter().zip(&mut assembly.gears) {
        let gear = &mut placed.gear;
        let note = |code| Diagnostic::note(code, StageName::Outfitted).at(Place::Gear(side));
        let Some(cut) = sector(side, gear, centrodes, &kept, &asked) else {
            found.push(note(Code::SectorWhole));
            continue;
        };
        let teeth = (centrodes.arc_length(cut.between[0], cut.between[1]) / pitch).round();
        found.push(
            note(Code::SectorCut)
                .with("teeth", teeth)
                .with("of", f64::from(gear.teeth))
                .with("from", segment.from)
                .with("to", segment.to),
        );
        gear.outline = cut.outline;
    }
    found.push(judge(assembly, analysed, segment, control)?);
    // From here on both gears lie as they do where the segment begins.
    let start = [segment.from, -transmission.psi(segment.from)];
    for (placed, angle) in assembly.gears.iter_mut().zip(start) {
        let gear = &mut placed.gear;
        let rings = [&mut gear.outline, &mut gear.pitch_curve, &mut gear.input];
        for ring in rings.into_iter().chain(&mut gear.bore) {
            ring.iter_mut().for_each(|p| *p = geometry::rotate(*p, angle));
        }
    }
    let way = policy::MOTION_SAMPLES / 2;
    let there = |i: usize| segment.length() * i.min(2 * way - i) as f64 / way as f64;
    let driver: Vec<f64> = (0..=2 * way).map(there).collect();
    assembly.driver_angle =
        (0..=2 * way).map(|i| segment.length() * i as f64 / way as f64).collect();
    for placed in &mut assembly.gears {
        placed.angle = driver.clone();
    }
    if let Some(follower) = assembly.gears.get_mut(1) {
        let turned = |x: &f64| transmission.psi(segment.from) - transmission.psi(segment.from + x);
        follower.angle = driver.iter().map(turned).collect();
    }
    Ok(found)
}

/// Contact of the gears as they are now, over the segment.
fn judge(
    assembly: &Assembly,
    analysed: &Analysed,
    segment: Segment,
    control: &Control,
) -> Result<Diagnostic, PipelineError> {
    let stage = StageName::Outfitted;
    let count = policy::CONTACT_POSES;
    let angles: Vec<f64> =
        (0..=count).map(|i| segment.from + segment.length() * i as f64 / count as f64).collect();
    let toothed = &analysed.toothed;
    let poses = match &assembly.gears[..] {
        [driver, follower] => {
            let input = ContactInput {
                driver: &driver.gear.outline,
                follower: &follower.gear.outline,
                ..toothed.in_mesh(toothed.finished.as_ref(), control)
            };
            poses_at(&input, &ContactOptions::default(), &angles)?
        }
        _ => Vec::new(),
    };
    let known = analysed.contact.summary.max_interference.map_or(0.0, |w| w.value);
    let allowed = known + analysed.limits.overlap * toothed.sized.module;
    let bad = poses.iter().find(|p| p.lost || p.lost_reversed || p.interference > allowed);
    Ok(match bad {
        Some(pose) => {
            Diagnostic::fault(Code::SectorContact, stage).at_driver_angle(pose.driver_angle)
        }
        None => Diagnostic::note(Code::SectorKeepsContact, stage).with("poses", poses.len() as f64),
    })
}

/// Driver angle at which a point of the gear, in its own frame, faces the mate, the nearest to `near`; and how far
/// the point lies outside the pitch curve, mm.
fn faces(side: Side, p: Point, centrodes: &Centrodes, near: f64) -> (f64, f64) {
    let transmission = &centrodes.transmission;
    let direction = p.y.atan2(p.x);
    let closest = |angle: f64, to: f64| angle - TAU * ((angle - to) / TAU).round();
    let (phi, radius) = match side {
        Side::Driver => {
            let phi = closest(-direction, near);
            (phi, centrodes.driver_radius(phi))
        }
        Side::Follower => {
            let phi = transmission.inverse(closest(direction - PI, transmission.psi(near)));
            (phi, centrodes.follower_radius(phi))
        }
    };
    (phi, p.coords.norm() - radius)
}

/// Driver angles at which the teeth pass the pitch point that are kept, and up to which the cut may lie.
struct Kept {
    inner: [f64; 2],
    outer: [f64; 2],
}

impl Kept {
    fn of(centrodes: &Centrodes, segment: Segment, pitch: f64) -> Self {
        let along = |from: f64, arc: f64| {
            let piece = arc / policy::SECTOR_STEPS as f64;
            (0..policy::SECTOR_STEPS).fold(from, |phi, _| phi + piece / centrodes.arc_speed(phi))
        };
        let margin = policy::SECTOR_MARGIN * pitch;
        let inner = [along(segment.from, -margin), along(segment.to, margin)];
        Self { inner, outer: [along(inner[0], -pitch), along(inner[1], pitch)] }
    }

    fn middle(&self) -> f64 {
        0.5 * (self.inner[0] + self.inner[1])
    }
}

struct Sector {
    outline: Vec<Point>,
    /// Driver angles at which its ends pass the pitch point.
    between: [f64; 2],
}

/// The kept teeth, cut off at the deepest points of the tooth spaces beyond them, on a hub; none when the gear needs
/// nearly its whole turn. `asked` is the least radius of the hub for what a bore of given radius asks for, mm.
fn sector(
    side: Side,
    gear: &Gear,
    centrodes: &Centrodes,
    kept: &Kept,
    asked: &dyn Fn(f64) -> f64,
) -> Option<Sector> {
    let transmission = &centrodes.transmission;
    let turn = match side {
        Side::Driver => kept.outer[1] - kept.outer[0],
        Side::Follower => transmission.psi(kept.outer[1]) - transmission.psi(kept.outer[0]),
    };
    if turn > policy::SECTOR_MOST_TURN * TAU {
        return None;
    }
    let outline = &gear.outline;
    let at: Vec<(f64, f64)> =
        outline.iter().map(|p| faces(side, *p, centrodes, kept.middle())).collect();
    let deepest = |from: f64, to: f64| {
        let between = (0..at.len()).filter(|&i| (from..=to).contains(&at[i].0));
        between.min_by(|&a, &b| at[a].1.total_cmp(&at[b].1))
    };
    let low = deepest(kept.outer[0], kept.inner[0])?;
    let high = deepest(kept.inner[1], kept.outer[1])?;
    // Counter-clockwise the driver's own angles fall with phi, the follower's rise.
    let (first, last) = match side {
        Side::Driver => (high, low),
        Side::Follower => (low, high),
    };
    let count = (last + outline.len() - first) % outline.len();
    let mut ring: Vec<Point> = (0..=count).map(|k| outline[(first + k) % outline.len()]).collect();
    let bore = gear.bore.iter().flatten().map(|p| p.coords.norm()).fold(0.0, f64::max);
    let wanted =
        (policy::SECTOR_HUB_BORES * bore).max(bore + policy::SECTOR_HUB_WALL).max(asked(bore));
    let hub = wanted.min(policy::SECTOR_HUB_MOST * clear_radius(outline));
    ring.extend(back(&ring, outline, hub)?);
    let sound =
        geometry::first_self_crossing(&ring).is_none() && geometry::signed_area(&ring) > 0.0;
    sound.then_some(Sector { outline: ring, between: [at[low].0, at[high].0] })
}

/// The way from the last kept point round the hub to the first: along tangents of the hub where these run in the gear and
/// leave room for each other, straight towards the axis elsewhere.
fn back(ring: &[Point], outline: &[Point], hub: f64) -> Option<Vec<Point>> {
    let (first, last) = (*ring.first()?, *ring.last()?);
    let angle = |p: Point| p.y.atan2(p.x);
    let open = (angle(first) - angle(last)).rem_euclid(TAU);
    let swing = |p: Point| (hub / p.coords.norm()).min(1.0).acos();
    let on_hub = |a: f64| geometry::rotate(Point::new(hub, 0.0), a);
    let inside = |from: Point, to: Point| {
        let n = policy::SECTOR_STEPS;
        (1..n).all(|k| geometry::contains(outline, from + (to - from) * (k as f64 / n as f64)))
    };
    let (a, b) = (angle(last) + swing(last), angle(last) + open - swing(first));
    let tangents = a < b && inside(last, on_hub(a)) && inside(first, on_hub(b));
    let (from, to) = if tangents { (a, b) } else { (angle(last), angle(last) + open) };
    let step = 2.0 * (1.0 - policy::BORE_CHORD_TOLERANCE / hub).clamp(-1.0, 1.0).acos();
    let pieces = ((to - from) / step).ceil().max(1.0) as usize;
    let arc: Vec<Point> =
        (0..=pieces).map(|k| on_hub(from + (to - from) * k as f64 / pieces as f64)).collect();
    // Straight ways in pieces as long as those of the hub: files that draw true curves then see that they are straight.
    let straight = |a: Point, b: Point| {
        let count = ((b - a).norm() / (step * hub)).ceil().max(1.0) as usize;
        (1..count).map(move |k| a + (b - a) * (k as f64 / count as f64))
    };
    let there = straight(last, arc[0]);
    let home = straight(arc[arc.len() - 1], first);
    Some(there.chain(arc.iter().copied()).chain(home).collect())
}
