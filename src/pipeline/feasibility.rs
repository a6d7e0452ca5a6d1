//! What may break or bind in a pair that otherwise meshes: found, and named with its place.

use super::sized::Sized;
use crate::control::StageName;
use crate::diagnose::{Code, Diagnostic, Place};
use crate::geometry::{self, Point};
use crate::policy;
use crate::teeth::{ToothRecord, ToothShape, ToothedPair};

/// How many teeth of one period became what: `[full, steeper, shortened, blunted]`.
#[must_use]
pub(super) fn tally(records: &[ToothRecord]) -> [usize; 4] {
    [ToothShape::Full, ToothShape::Steeper, ToothShape::Shortened, ToothShape::Blunted]
        .map(|shape| records.iter().filter(|r| r.shape == shape).count())
}

/// Teeth that are too low to count on, and bodies too thin to hold. `dedendum` in mm.
pub(super) fn found(sized: &Sized, pair: &ToothedPair, dedendum: f64) -> Vec<Diagnostic> {
    let stage = StageName::Toothed;
    let mut found = Vec::new();
    if let Some(worst) = pair
        .records
        .iter()
        .filter(|r| r.contact_ratios.iter().any(|c| *c < 1.0))
        .min_by(|a, b| low(a).total_cmp(&low(b)))
    {
        let count = pair.records.iter().filter(|r| low(r) < 1.0).count();
        found.push(
            Diagnostic::warning(Code::Undercut, stage)
                .at(Place::Tooth { gear: worst.side, index: worst.index })
                .with("count", count as f64)
                .with("teeth", pair.records.len() as f64)
                .with("share", low(worst)),
        );
    }
    let wall = policy::THIN_WALL * pair.module;
    for (side, curve) in sized.pitch_curves.as_ref().each() {
        if let Some(place) = thin_place(curve, dedendum + 0.5 * wall) {
            let warning = Diagnostic::warning(Code::ThinBody, stage);
            found.push(warning.at(Place::point(side, place)).with("thickness", wall));
        }
    }
    found
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
