//! Root curves: what the tip of the mating tooth sweeps free between two flanks.
//!
//! The mating tooth is given a rounded cap that stands `root_clearance` above its tip and starts in
//! the direction of its flanks, like the rounded tip of a rack. While it passes through the space
//! its envelope is the trochoid that joins the two flanks of the space. The envelope is taken along
//! rays from a point inside the space: on each the farthest reach of the cap over all instants,
//! refined between instants, so that it carries no ripple of the sampling. With clearance the mate may
//! stand anywhere between the two motions of the loaded pair: the cap passes at three levels, and what its
//! points pass on their way from level to level is free as well.

use super::flank::Flank;
use super::layout::Rack;
use super::motions::Motions;
use crate::gear::Side;
use crate::geometry::{Point, Vector, cross};
use crate::policy;

/// Places of the follower between its two extremes at which a cap passes; with two alone ridges would
/// stay between them.
const LEVELS: [f64; 3] = [0.0, 0.5, 1.0];

/// The cap on the tooth between flanks `a` (lesser s) and `b` (greater s) of gear `side`, from the
/// corner on `a` to the corner on `b`, in the frame of that gear. With `rise` zero it is the tip itself.
pub(crate) fn cap(
    motions: &Motions,
    [a, b]: &[Flank; 2],
    side: Side,
    rise: f64,
    rounding: f64,
    points_per_corner: usize,
) -> Vec<Point> {
    let rolling = motions.designed();
    let corner = |flank: &Flank, inward: f64| {
        let own = motions.of(flank.sigma);
        let instant = own.at(flank.arc_at(side.sign() * flank.reach(side)));
        let p = instant.to_local(side, flank.contact(&instant));
        let (foot, height) = rolling.foot(side, p, flank.station);
        let (sin, cos) = flank.alpha.sin_cos();
        let up = side.sign() * (cos * instant.normal - flank.sigma * sin * instant.tangent);
        let up = instant.to_local(side, instant.pitch + up) - instant.to_local(side, instant.pitch);
        let frame = rolling.at(foot).local(side);
        let leaning =
            inward * up.dot(&frame.tangent) / up.dot(&frame.normal).max(policy::CAP_LEAST_RISE);
        let stretch = (1.0 + frame.curvature * height).max(policy::FOOT_MIN_STRETCH);
        (foot, height, leaning.clamp(0.0, policy::CAP_STEEPEST), stretch)
    };
    let (foot_a, height_a, lean_a, stretch_a) = corner(a, 1.0);
    let (foot_b, height_b, lean_b, stretch_b) = corner(b, -1.0);
    let half_land = 0.5 * (foot_b - foot_a).max(0.0);
    // The rise that the land leaves room for: the two sides must not meet below the top.
    let room =
        |lean: f64, stretch: f64| policy::CAP_LAND_USED * half_land * stretch / lean.max(1e-12);
    let rise = rise.min(room(lean_a, stretch_a)).min(room(lean_b, stretch_b));
    let side_points = |foot: f64, lean: f64, stretch: f64, direction: f64| -> Vec<(f64, f64)> {
        let width = (half_land * stretch - rise * lean).min(rounding);
        (0..=points_per_corner)
            .map(|k| {
                let angle = std::f64::consts::FRAC_PI_2 * k as f64 / points_per_corner as f64;
                let (sin, cos) = angle.sin_cos();
                let inward = rise * sin * lean + width * (1.0 - cos);
                (foot + direction * inward / stretch, rise * sin)
            })
            .collect()
    };
    let mut path = side_points(foot_a, lean_a, stretch_a, 1.0);
    let closing = side_points(foot_b, lean_b, stretch_b, -1.0);
    let (from, to) = (path[points_per_corner], closing[points_per_corner]);
    for k in 1..policy::LAND_CHORDS {
        let t = k as f64 / policy::LAND_CHORDS as f64;
        path.push((from.0 + t * (to.0 - from.0), rise));
    }
    path.extend(closing.into_iter().rev());
    path.into_iter()
        .map(|(s, above)| {
            let t = if foot_b > foot_a { (s - foot_a) / (foot_b - foot_a) } else { 0.5 };
            let frame = rolling.at(s).local(side);
            frame.at + (height_a + t * (height_b - height_a) + above) * frame.normal
        })
        .collect()
}

/// The root of a space of gear `side` between its flanks `a` and `b`: points from the root end of
/// `a` to the root end of `b`, both excluded, in the frame of that gear. The root moves
/// with flanks that are thinned by `backlash`.
pub(crate) fn root_curve(
    motions: &Motions,
    rack: &Rack,
    [a, b]: &[Flank; 2],
    side: Side,
    backlash: f64,
) -> Vec<Point> {
    let rolling = motions.designed();
    let mate = side.partner();
    let cap = cap(
        motions,
        &[*a, *b],
        mate,
        rack.root_clearance,
        policy::CAP_ROUNDING * rack.module,
        policy::CAP_POINTS_PER_CORNER,
    );
    let end = |flank: &Flank, share: f64| {
        let delta = mate.sign() * share * flank.reach(mate);
        flank.thinned(side, backlash).point(motions.of(flank.sigma), side, delta)
    };
    let (end_a, end_b) = (end(a, 1.0), end(b, 1.0));
    let center =
        Point::from(0.25 * (end_a.coords + end_b.coords + end(a, 0.5).coords + end(b, 0.5).coords));
    let frame = rolling.at(0.5 * (a.station + b.station)).local(side);
    let polar = |p: Point| {
        let d: Vector = p - center;
        (d.dot(&frame.tangent), -d.dot(&frame.normal))
    };
    let angle = |p: Point| {
        let (x, y) = polar(p);
        x.atan2(y)
    };
    let (from, to) = (angle(end_a), angle(end_b));
    if to - from < policy::ROOT_LEAST_ANGLE {
        return Vec::new();
    }
    // While the mate's corners are past their last contact on either flank the cap is in the space.
    let mut span = [a, b].map(|f| {
        let own = motions.of(f.sigma);
        rolling.arc(own.driver_angle(f.arc_at(mate.sign() * f.reach(mate))))
    });
    span.sort_by(f64::total_cmp);
    let margin = policy::ROOT_MARGIN * rack.pitch;
    let (start, stop) = (span[0] - margin, span[1] + margin);
    let instants = policy::ROOT_INSTANTS;
    let step = (stop - start) / (instants - 1) as f64;
    let levels: &[f64] = if motions.has_play() { &LEVELS } else { &[0.0] };
    let cap_at = |level: f64, s: f64| -> Vec<(f64, f64)> {
        let instant = motions.between(s, level);
        cap.iter().map(|&p| polar(instant.to_local(side, instant.to_world(mate, p)))).collect()
    };
    let caps: Vec<Vec<_>> = levels
        .iter()
        .map(|&level| (0..instants).map(|k| cap_at(level, start + step * k as f64)).collect())
        .collect();
    let farthest = |cap: &[(f64, f64)], ray: f64| {
        cap.windows(2).filter_map(|e| crossing(e[0], e[1], ray)).fold(0.0, f64::max)
    };
    // What the points of the cap pass on their way from one level to the next.
    let passed = |ray: f64| {
        let steps = caps.windows(2).flat_map(|pair| pair[0].iter().zip(&pair[1]));
        let paths = steps.flat_map(|(cap, next): (&Vec<_>, &Vec<_>)| cap.iter().zip(next));
        paths.filter_map(|(from, to)| crossing(*from, *to, ray)).fold(0.0, f64::max)
    };
    let relief = policy::ROOT_RELIEF * rack.module + 0.25 * backlash;
    let on_ray = |ray: f64| -> Option<Point> {
        let found = levels.iter().zip(&caps).flat_map(|(level, caps)| {
            caps.iter().enumerate().map(move |(k, cap)| (*level, k, farthest(cap, ray)))
        });
        let (level, k, found) = found.max_by(|x, y| x.2.total_cmp(&y.2))?;
        if found <= 0.0 {
            return None;
        }
        let at = start + step * k as f64;
        let r = largest_near(|s| farthest(&cap_at(level, s), ray), at - step, at + step);
        let r = r.max(found).max(passed(ray));
        let (sin, cos) = ray.sin_cos();
        Some(center + (r + relief) * (sin * frame.tangent - cos * frame.normal))
    };
    let first = policy::ROOT_FIRST_RAYS;
    // Closer together towards the flanks, where the root leaves them at a small angle.
    let rays = (1..=first).filter_map(|i| {
        let t = std::f64::consts::PI * i as f64 / (first + 1) as f64;
        let ray = from + (to - from) * 0.5 * (1.0 - t.cos());
        on_ray(ray).map(|p| (ray, p))
    });
    let ends = [(from, end_a), (to, end_b)];
    let rays: Vec<(f64, Point)> =
        std::iter::once(ends[0]).chain(rays).chain(std::iter::once(ends[1])).collect();
    let tolerance = policy::ROOT_CHORD * rack.module;
    let mut points = Vec::new();
    for pair in rays.windows(2) {
        refine(&on_ray, [pair[0], pair[1]], tolerance, policy::ROOT_HALVINGS, &mut points);
        points.push(pair[1].1);
    }
    points.pop();
    points
}

/// Adds points between two rays, in order, until each chord keeps within `tolerance` of the root at its
/// middle ray or the halvings are used up.
fn refine(
    on_ray: &impl Fn(f64) -> Option<Point>,
    [a, b]: [(f64, Point); 2],
    tolerance: f64,
    halvings: u32,
    points: &mut Vec<Point>,
) {
    let ray = 0.5 * (a.0 + b.0);
    let Some(p) = on_ray(ray) else { return };
    let chord = b.1 - a.1;
    if halvings == 0 || cross(chord, p - a.1).abs() <= tolerance * chord.norm() {
        return;
    }
    refine(on_ray, [a, (ray, p)], tolerance, halvings - 1, points);
    points.push(p);
    refine(on_ray, [(ray, p), b], tolerance, halvings - 1, points);
}

/// Distance along the ray of the given angle (from the y axis) to the segment, if it is crossed.
fn crossing(a: (f64, f64), b: (f64, f64), angle: f64) -> Option<f64> {
    let (sin, cos) = angle.sin_cos();
    // Coordinates across and along the ray.
    let across = |p: (f64, f64)| p.0 * cos - p.1 * sin;
    let along = |p: (f64, f64)| p.0 * sin + p.1 * cos;
    let (ca, cb) = (across(a), across(b));
    if (ca > 0.0) == (cb > 0.0) {
        return None;
    }
    let t = ca / (ca - cb);
    let r = along(a) + t * (along(b) - along(a));
    (r > 0.0).then_some(r)
}

/// Golden-section search for the largest value of `f` between `low` and `high`.
fn largest_near(f: impl Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let (mut low, mut high) = (low, high);
    let (mut x1, mut x2) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
    let (mut f1, mut f2) = (f(x1), f(x2));
    for _ in 0..policy::ROOT_REFINEMENTS {
        if f1 > f2 {
            (high, x2, f2) = (x2, x1, f1);
            x1 = high - GOLDEN * (high - low);
            f1 = f(x1);
        } else {
            (low, x1, f1) = (x1, x2, f2);
            x2 = low + GOLDEN * (high - low);
            f2 = f(x2);
        }
    }
    f1.max(f2)
}
