//! Where a gear's axis is.

use super::CheckError;
use crate::gear::Side;
use crate::geometry::Point;
use crate::input::Toothed;

/// How an axis was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisSource {
    /// It was given.
    Given,
    /// The centre of the gear's only hole, or of the one about the origin.
    Bore,
    /// The origin of the drawing.
    Origin,
}

impl AxisSource {
    /// A stable word for programs.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Given => "given",
            Self::Bore => "bore",
            Self::Origin => "origin",
        }
    }
}

/// The axis in the frame of the file, mm: what was given, else the bore's centre, else the origin.
///
/// # Errors
/// [`CheckError::AxisOutside`] and [`CheckError::NoAxis`].
pub(super) fn axis(
    gear: &Toothed,
    side: Side,
    given: Option<Point>,
) -> Result<(Point, AxisSource), CheckError> {
    if let Some(axis) = given {
        return if gear.outline.contains(axis) {
            Ok((axis, AxisSource::Given))
        } else {
            Err(CheckError::AxisOutside { gear: side, x: axis.x, y: axis.y })
        };
    }
    if gear.record.is_some() {
        return inside(gear, side).map(|axis| (axis, AxisSource::Origin));
    }
    let about_origin = || gear.holes.iter().find(|hole| hole.contains(Point::origin()));
    let bore = if gear.holes.len() == 1 { gear.holes.first() } else { about_origin() };
    match bore {
        Some(hole) => Ok((hole.centroid(), AxisSource::Bore)),
        None if gear.outline.contains(Point::origin()) => Ok((Point::origin(), AxisSource::Origin)),
        None => Err(CheckError::NoAxis { gear: side, holes: gear.holes.len() }),
    }
}

fn inside(gear: &Toothed, side: Side) -> Result<Point, CheckError> {
    if gear.outline.contains(Point::origin()) {
        Ok(Point::origin())
    } else {
        Err(CheckError::AxisOutside { gear: side, x: 0.0, y: 0.0 })
    }
}
