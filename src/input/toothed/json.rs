//! Contours out of JSON: a list of points, an outline with holes, or a `design.json`.

use super::super::points::{json, list_of_points};
use super::{Asked, PairRecord, Ring, ToothedError, implicitly_closed};
use crate::input::PointsError;
use crate::policy;
use serde_json::Value;

/// The contours, and what the file tells of a pair.
pub(super) type Contours = (Vec<Ring>, Option<PairRecord>);

/// Reads `[[x, y], ...]`, `{"points": ...}`, `{"outline": ..., "bore": ..., "holes": [...]}` or a
/// record with such an object under `driver` and `follower`.
pub(super) fn rings(bytes: &[u8], asked: &Asked<'_>) -> Result<Contours, ToothedError> {
    let failed = |error| ToothedError::Points { path: asked.path(), error };
    let document = json(bytes, policy::POINT_FILE_BYTES).map_err(failed)?;
    let part = asked.part.unwrap_or(asked.side.name());
    let (gear, record) = match document.get(part) {
        Some(gear) => (gear, record(&document, asked.path)),
        None => match asked.part {
            Some(part) => return Err(asked.no_such_part(part)),
            None => (&document, None),
        },
    };
    let list = |value: &Value| value.as_array().map(|l| list_of_points(l));
    let outer = list(gear).or_else(|| list(gear.get("points").or(gear.get("outline"))?));
    let outer = outer.ok_or(PointsError::NoList).map_err(failed)?.map_err(failed)?;
    let bore = gear.get("bore").and_then(list);
    let holes = gear.get("holes").and_then(Value::as_array).into_iter().flatten();
    let inner: Vec<_> =
        bore.into_iter().chain(holes.filter_map(list)).collect::<Result<_, _>>().map_err(failed)?;
    let rings = std::iter::once(outer).chain(inner).map(implicitly_closed).collect();
    Ok((rings, record))
}

fn record(document: &Value, path: &str) -> Option<PairRecord> {
    let angles = |name: &str| -> Option<Vec<f64>> {
        document.get("motion")?.get(name)?.as_array()?.iter().map(Value::as_f64).collect()
    };
    let teeth = |gear: &str| u32::try_from(document.get(gear)?.get("teeth")?.as_u64()?).ok();
    Some(PairRecord {
        path: path.to_owned(),
        center_distance: document.get("center_distance")?.as_f64()?,
        teeth: teeth("driver").zip(teeth("follower")).map(|(d, f)| [d, f]),
        driver_angle: angles("driver_angle")?,
        follower_angle: angles("follower_angle")?,
    })
}
