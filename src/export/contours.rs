//! What the CAD formats draw of a gear: round holes as circles, everything else as traced curves.

use crate::geometry::curves::{Arc, ArcPath, Trace, TraceError, TraceOptions, round_hole};
use crate::geometry::{self, Point};
use crate::policy;

/// A closed contour in millimetres.
#[derive(Clone, Debug)]
pub(super) enum Contour {
    /// A circle.
    Round {
        /// Its centre.
        center: Point,
        /// Its radius.
        radius: f64,
    },
    /// Arcs and lines.
    Path(ArcPath),
}

impl Contour {
    /// The contour moved: turned about the origin, then shifted.
    pub(super) fn placed(&self, angle: f64, shift: Point) -> Self {
        let place = |p: Point| geometry::rotate(p, angle) + shift.coords;
        match self {
            Self::Round { center, radius } => {
                Self::Round { center: place(*center), radius: *radius }
            }
            Self::Path(path) => Self::Path(path.mapped(place)),
        }
    }

    /// Its arcs; a circle is two half circles.
    #[cfg(test)]
    pub(super) fn arcs(&self) -> Vec<Arc> {
        match self {
            Self::Round { center, radius } => halves(*center, *radius).to_vec(),
            Self::Path(path) => path.arcs().to_vec(),
        }
    }
}

/// The two halves of a circle, counter-clockwise.
pub(super) fn halves(center: Point, radius: f64) -> [Arc; 2] {
    let [right, left] = [radius, -radius].map(|x| center + geometry::Vector::new(x, 0.0));
    [Arc { from: right, to: left, bulge: 1.0 }, Arc { from: left, to: right, bulge: 1.0 }]
}

/// The trace of an outline or, with `hole`, of a drawn hole. Where no smooth curve keeps the tolerance the
/// outline's own edges are taken, which deviate by nothing.
///
/// # Errors
/// A tolerance that cannot be kept, or an outline without area.
pub(super) fn traced(points: &[Point], tolerance: f64, hole: bool) -> Result<Trace, String> {
    match Trace::new(points, TraceOptions { tolerance, straight_edges: hole }) {
        Ok(trace) => Ok(trace),
        Err(TraceError::TooFar { .. } | TraceError::Crossing { .. }) => closed(points),
        Err(e @ (TraceError::Tolerance { .. } | TraceError::Empty)) => Err(e.to_string()),
    }
}

fn closed(points: &[Point]) -> Result<Trace, String> {
    match geometry::first_self_crossing(points) {
        Some(p) => Err(format!("its outline crosses itself at ({:.4}, {:.4}) mm", p.x, p.y)),
        None => Ok(Trace::polygon(points)),
    }
}

/// An outline as arcs, or as its own straight edges.
///
/// # Errors
/// As for [`traced`].
pub(super) fn contour(
    points: &[Point],
    tolerance: f64,
    hole: bool,
    straight: bool,
) -> Result<Contour, String> {
    if points.len() < 3
        || geometry::area(points).partial_cmp(&0.0) != Some(std::cmp::Ordering::Greater)
    {
        return Err(TraceError::Empty.to_string());
    }
    if straight {
        closed(points)?;
        return Ok(Contour::Path(ArcPath::polygon(points)));
    }
    if let Some((center, radius)) = round_hole(points)
        && hole
    {
        return Ok(Contour::Round { center, radius });
    }
    let trace = traced(points, tolerance, hole)?;
    match trace.arcs() {
        Ok(path) => Ok(Contour::Path(path)),
        Err(_) => closed(points).map(|_| Contour::Path(ArcPath::polygon(points))),
    }
}

/// Colours of the driver's and the followers' parts in every CAD format, sRGB.
pub(super) fn color(number: usize) -> [u8; 3] {
    if number.is_multiple_of(2) { policy::DRIVER_COLOR } else { policy::FOLLOWER_COLOR }
}
