//! Contours out of JSON: a list of points, an outline with holes, or a `design.json`.

use super::InputError;
use super::contours::{Contour, Contours};
use super::source::Source;
use super::table::{json, list_of_points};
use crate::gear::Side;
use crate::input::PointsError;
use crate::policy;
use crate::wording::quoted;
use serde_json::Value;

/// What a `design.json` tells of a pair.
#[derive(Clone, Debug, PartialEq)]
pub struct PairRecord {
    /// The file.
    pub path: String,
    /// Distance of the axes, mm.
    pub center_distance: f64,
    /// Teeth of driver and follower, on one turn each.
    pub teeth: Option<[u32; 2]>,
    /// Driver angles of one whole cycle, radians.
    pub driver_angle: Vec<f64>,
    /// Follower angles (psi) at these, radians.
    pub follower_angle: Vec<f64>,
}

/// Reads `[[x, y], ...]`, `{"points": ...}`, `{"outline": ..., "bore": ..., "holes": [...]}` or a
/// record with such an object under `driver` and `follower`. With a `side` the outline of a finished gear is wanted,
/// without one the shape it was made from.
///
/// # Errors
/// [`InputError::Points`], [`InputError::NoSuchPart`]; [`InputError::Several`] for the shape of a record that is not
/// named.
pub(super) fn contours(
    bytes: &[u8],
    source: Source<'_>,
    side: Option<Side>,
) -> Result<Contours, InputError> {
    let failed = |error| InputError::Points { path: source.path(), error };
    let document = json(bytes, policy::POINT_FILE_BYTES).map_err(failed)?;
    let part = source.part.or(side.map(Side::name));
    let both = Side::BOTH.iter().all(|s| document.get(s.name()).is_some());
    let (gear, record) = match part.and_then(|p| document.get(p)) {
        Some(gear) => (gear, record(&document, source.path)),
        None => match source.part {
            Some(part) => {
                let known = if both {
                    "name driver or follower".to_owned()
                } else {
                    format!("leave #{} out", quoted(part))
                };
                return Err(InputError::NoSuchPart {
                    path: source.path(),
                    part: quoted(part),
                    known,
                });
            }
            None if both => {
                return Err(InputError::Several {
                    path: source.path(),
                    count: 2,
                    list: "driver, follower".to_owned(),
                    example: "driver".to_owned(),
                });
            }
            None => (&document, None),
        },
    };
    let list = |value: &Value| value.as_array().map(|l| list_of_points(l));
    let drawn = gear.get("input").filter(|_| side.is_none());
    let named = || list(drawn.or(gear.get("points")).or(gear.get("outline"))?);
    let outer = list(gear).or_else(named);
    let outer = outer.ok_or(PointsError::NoList).map_err(failed)?.map_err(failed)?;
    let bore = gear.get("bore").and_then(list);
    let holes = gear.get("holes").and_then(Value::as_array).into_iter().flatten();
    let inner: Vec<_> =
        bore.into_iter().chain(holes.filter_map(list)).collect::<Result<_, _>>().map_err(failed)?;
    let list = std::iter::once(outer).chain(inner).map(Contour::listed).collect();
    Ok(Contours { list, record, told: true, ..Contours::default() })
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
