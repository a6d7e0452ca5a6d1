//! What a drawing shows inside its silhouette.

use super::note::Note;
use crate::geometry::{self, Face, Point};
use crate::outline::Outline;

/// The inner drawing of a shape, in the frame of its outline as drawn; empty where there is none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Inner {
    /// What is drawn in other colours than the body's, apart from each other.
    pub patches: Vec<Patch>,
    /// Where nothing is drawn at all, such as the counters of letters; edges counter-clockwise.
    pub holes: Vec<Vec<Point>>,
    /// Lines without a width; those that close repeat their first point.
    pub lines: Vec<Vec<Point>>,
}

/// What is drawn in one colour.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// Its colour, sRGB.
    pub color: [u8; 3],
    /// Its areas.
    pub faces: Vec<Face>,
}

impl Inner {
    /// Whether there is nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.patches.is_empty() && self.holes.is_empty() && self.lines.is_empty()
    }

    /// The same in another frame, or seen from behind.
    #[must_use]
    pub fn mapped(&self, map: impl Fn(&Point) -> Point) -> Self {
        let turned = |ring: &Vec<Point>, counter_clockwise: bool| {
            let mut ring: Vec<Point> = ring.iter().map(&map).collect();
            if (geometry::signed_area(&ring) > 0.0) != counter_clockwise {
                ring.reverse();
            }
            ring
        };
        let face = |face: &Face| -> Face {
            face.iter().enumerate().map(|(i, ring)| turned(ring, i == 0)).collect()
        };
        let patch = |p: &Patch| Patch { color: p.color, faces: p.faces.iter().map(face).collect() };
        Self {
            patches: self.patches.iter().map(patch).collect(),
            holes: self.holes.iter().map(|ring| turned(ring, true)).collect(),
            lines: self.lines.iter().map(|l| l.iter().map(&map).collect()).collect(),
        }
    }
}

/// What a reader makes of a drawing.
#[derive(Clone, Debug)]
pub(super) struct Drawing {
    /// The edge of the silhouette.
    pub(super) outline: Outline,
    /// What is drawn inside.
    pub(super) inner: Inner,
    /// What a person should know.
    pub(super) notes: Vec<Note>,
}

impl From<Outline> for Drawing {
    fn from(outline: Outline) -> Self {
        Self { outline, inner: Inner::default(), notes: Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mirrored_drawing_winds_as_it_must() {
        let square = |r: f64| -> Vec<Point> {
            [(-r, -r), (r, -r), (r, r), (-r, r)].map(|(x, y)| Point::new(x + 9.0, y)).to_vec()
        };
        let hole: Vec<Point> = square(1.0).into_iter().rev().collect();
        let patch = Patch { color: [9; 3], faces: vec![vec![square(2.0), hole]] };
        let inner = Inner { patches: vec![patch], holes: vec![square(0.5)], lines: Vec::new() };
        let over = inner.mapped(|p| Point::new(-p.x, p.y));
        let face = &over.patches[0].faces[0];
        assert!(geometry::signed_area(&face[0]) > 0.0 && geometry::signed_area(&face[1]) < 0.0);
        assert!(geometry::signed_area(&over.holes[0]) > 0.0 && over.holes[0][0].x < 0.0);
        assert_ne!(over, inner);
        assert!(!over.is_empty() && Inner::default().is_empty());
    }
}
