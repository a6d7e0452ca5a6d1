//! Parts beside the gears as they are cut from a sheet.

use crate::assembly::Fixture;
use crate::geometry::{self, Point};

/// A part is a plate, and not a knob or a cap, when it is this many times wider than thick.
const PLATE_WIDTH: f64 = 3.0;

/// The contours of a plate: its edge and its holes, counter-clockwise, in its own frame.
#[derive(Clone, Debug)]
pub(super) struct Flat<'a> {
    pub(super) outline: &'a [Point],
    /// Holes, and the seats of what stands on it: dowels go where a printed plate has pins.
    pub(super) holes: Vec<&'a [Point]>,
}

/// The part as it is cut, or none for one that is no plate.
pub(super) fn flat(fixture: &Fixture) -> Option<Flat<'_>> {
    let (low, high) = geometry::bounds(&fixture.outline);
    let size = high - low;
    if size.x.min(size.y) < PLATE_WIDTH * fixture.thickness {
        return None;
    }
    let carries = |from: &crate::assembly::Post| {
        fixture.posts.iter().any(|p| p.from == from.to && geometry::contains(&from.ring, p.ring[0]))
    };
    let pins = fixture.posts.iter().filter(|p| p.hole.is_none() && !carries(p));
    let holes = fixture.holes.iter().map(Vec::as_slice);
    Some(Flat {
        outline: &fixture.outline,
        holes: holes.chain(pins.map(|p| p.ring.as_slice())).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::super::tests::base;
    use super::*;
    use crate::assembly::Post;
    use crate::solid::circle;

    #[test]
    fn pins_are_cut_as_holes_and_shoulders_are_left_out() {
        let mut plate = base();
        let post = |r, from, to| Post { ring: circle(r, 0.01), hole: None, from, to };
        plate.posts = vec![post(5.0, 4.0, 5.0), post(2.0, 5.0, 12.0)];
        let cut = flat(&plate).unwrap();
        assert_eq!(cut.holes, [plate.posts[1].ring.as_slice()]);
        plate.outline = circle(6.0, 0.01);
        plate.thickness = 16.0;
        assert!(flat(&plate).is_none());
    }
}
