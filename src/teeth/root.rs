//! Root curves: what the tip of the mating tooth sweeps free between two flanks.
//!
//! The mating tooth is given a rounded cap that stands `root_clearance` above its tip and starts in
//! the direction of its flanks, like the rounded tip of a rack. While it passes through the space
//! its envelope is the trochoid that joins the two flanks of the space. The envelope is taken along
//! rays from a point inside the space: on each the farthest reach of the cap over all instants,
//! refined between instants, so that it carries no ripple of the sampling.

use super::flank::Flank;
use super::layout::Rack;
use super::rolling::{Rolling, Side};
use crate::geometry::{Point, Vector};
use crate::policy;

/// The cap on the tooth between flanks `a` (lesser s) and `b` (greater s) of gear `side`, from the
/// corner on `a` to the corner on `b`, in the frame of that gear. With `rise` zero it is the tip itself.
pub(crate) fn cap(
    rolling: &Rolling<'_>,
    [a, b]: &[Flank; 2],
    side: Side,
    rise: f64,
    rounding: f64,
    points_per_corner: usize,
) -> Vec<Point> {
    let corner = |flank: &Flank, inward: f64| {
        let instant = rolling.at(flank.arc_at(side.sign() * flank.reach(side)));
        let p = instant.to_local(side, flank.contact(&instant));
        let (foot, height) = rolling.foot(side, p, flank.u);
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
    rolling: &Rolling<'_>,
    rack: &Rack,
    [a, b]: &[Flank; 2],
    side: Side,
    backlash: f64,
) -> Vec<Point> {
    let mate = side.partner();
    let cap = cap(
        rolling,
        &[*a, *b],
        mate,
        rack.root_clearance,
        policy::CAP_ROUNDING * rack.module,
        policy::CAP_POINTS_PER_CORNER,
    );
    let end = |flank: &Flank, share: f64| {
        flank.thinned(side, backlash).point(rolling, side, mate.sign() * share * flank.reach(mate))
    };
    let (end_a, end_b) = (end(a, 1.0), end(b, 1.0));
    let center =
        Point::from(0.25 * (end_a.coords + end_b.coords + end(a, 0.5).coords + end(b, 0.5).coords));
    let frame = rolling.at(0.5 * (a.u + b.u)).local(side);
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
    let count = policy::ROOT_RAYS;
    // Closer together towards the flanks, where the root leaves them at a small angle.
    let rays: Vec<f64> = (1..=count)
        .map(|i| {
            let t = std::f64::consts::PI * i as f64 / (count + 1) as f64;
            from + (to - from) * 0.5 * (1.0 - t.cos())
        })
        .collect();
    // While the mate's corners are past their last contact on either flank the cap is in the space.
    let mut span = [a, b].map(|f| f.arc_at(mate.sign() * f.reach(mate)));
    span.sort_by(f64::total_cmp);
    let margin = policy::ROOT_MARGIN * rack.pitch;
    let (start, stop) = (span[0] - margin, span[1] + margin);
    let instants = policy::ROOT_INSTANTS;
    let step = (stop - start) / (instants - 1) as f64;
    let cap_at = |s: f64| -> Vec<(f64, f64)> {
        let instant = rolling.at(s);
        cap.iter().map(|&p| polar(instant.to_local(side, instant.to_world(mate, p)))).collect()
    };
    let mut farthest = vec![(0.0_f64, 0_usize); count];
    for k in 0..instants {
        let points = cap_at(start + step * k as f64);
        for edge in points.windows(2) {
            let ends = [edge[0], edge[1]].map(|(x, y)| x.atan2(y));
            let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
            if high - low > std::f64::consts::PI {
                continue;
            }
            let first = rays.partition_point(|&ray| ray < low);
            let end = rays.partition_point(|&ray| ray <= high);
            for i in first..end {
                if let Some(r) = crossing(edge[0], edge[1], rays[i])
                    && r > farthest[i].0
                {
                    farthest[i] = (r, k);
                }
            }
        }
    }
    (0..count)
        .filter(|&i| farthest[i].0 > 0.0)
        .map(|i| {
            let (found, k) = farthest[i];
            let reach = |s: f64| {
                let points = cap_at(s);
                points.windows(2).filter_map(|e| crossing(e[0], e[1], rays[i])).fold(0.0, f64::max)
            };
            let at = start + step * k as f64;
            let r = largest_near(reach, at - step, at + step).max(found)
                + policy::ROOT_RELIEF * rack.module
                + 0.25 * backlash;
            let (sin, cos) = rays[i].sin_cos();
            center + r * (sin * frame.tangent - cos * frame.normal)
        })
        .collect()
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
