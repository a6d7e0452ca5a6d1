//! What may break or bind in a pair that otherwise meshes: found, and named with its place.

use crate::gear::Side;
use crate::geometry::{self, Point};
use crate::pitch::Centrodes;
use crate::policy;
use crate::teeth::{ToothRecord, ToothShape, ToothedPair};

/// How many teeth of one period became what: `[full, steeper, shortened, blunted]`.
#[must_use]
pub(super) fn tally(records: &[ToothRecord]) -> [usize; 4] {
    [ToothShape::Full, ToothShape::Steeper, ToothShape::Shortened, ToothShape::Blunted]
        .map(|shape| records.iter().filter(|r| r.shape == shape).count())
}

/// Teeth that are too low to count on, and bodies too thin to hold.
pub(super) fn warnings(centrodes: &Centrodes, pair: &ToothedPair, dedendum: f64) -> Vec<String> {
    let mut warnings = Vec::new();
    if let Some(worst) = pair
        .records
        .iter()
        .filter(|r| r.contact_ratios.iter().any(|c| *c < 1.0))
        .min_by(|a, b| low(a).total_cmp(&low(b)))
    {
        let count = pair.records.iter().filter(|r| low(r) < 1.0).count();
        warnings.push(format!(
            "{count} of {} teeth are undercut so far that they hand over before the next one takes hold, worst tooth {} of the {} ({:.2} of a pitch)",
            pair.records.len(),
            worst.index,
            worst.side,
            low(worst)
        ));
    }
    let curves = [
        (Side::Driver, centrodes.driver_curve(policy::PITCH_CURVE_POINTS)),
        (Side::Follower, centrodes.follower_curve(policy::PITCH_CURVE_POINTS)),
    ];
    for (side, curve) in curves {
        if let Some(place) = thin_place(&curve, dedendum + 0.5 * policy::THIN_WALL * pair.module) {
            warnings.push(format!(
                "the body of the {side} is thinner than {:.2} mm between its roots near ({:.1}, {:.1})",
                policy::THIN_WALL * pair.module,
                place.x,
                place.y
            ));
        }
    }
    warnings
}

fn low(record: &ToothRecord) -> f64 {
    record.contact_ratios[0].min(record.contact_ratios[1])
}

/// Where a body falls apart when `depth` is taken from its rim: between the parts, or its middle when
/// nothing is left.
fn thin_place(curve: &[Point], depth: f64) -> Option<Point> {
    let faces = geometry::offset(curve, -depth, policy::BODY_CHORD);
    let [first, second] = match faces.as_slice() {
        [_] => return None,
        [] => return Some(geometry::centroid(curve)),
        [first, second, ..] => [&first[0], &second[0]],
    };
    let gap = |p: &Point| second.iter().map(|q| (p - q).norm()).fold(f64::INFINITY, f64::min);
    first.iter().copied().min_by(|a, b| gap(a).total_cmp(&gap(b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_waist_is_found_where_it_is() {
        let waisted: Vec<Point> = (0..360)
            .map(|i| {
                let t = f64::from(i).to_radians();
                let r = 10.0 + 8.0 * (2.0 * t).cos();
                Point::new(r * t.cos(), r * t.sin())
            })
            .collect();
        assert_eq!(thin_place(&waisted, 0.5), None);
        let place = thin_place(&waisted, 3.0).unwrap();
        assert!(place.x.abs() < 6.0 && place.y.abs() < 3.0, "{place}");
        assert_eq!(thin_place(&waisted, 30.0), Some(geometry::centroid(&waisted)));
    }
}
