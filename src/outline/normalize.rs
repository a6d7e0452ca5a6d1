//! A common size and place for shapes that are to be compared.

use super::Outline;
use crate::geometry::Point;

/// A move and an even change of size, without rotation: `p` goes to `scale * (p - center)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Similarity {
    /// The point that goes to the origin, in the unit of the source.
    pub center: Point,
    /// New length of a unit length; positive.
    pub scale: f64,
}

impl Similarity {
    /// Takes a point of the source to its image.
    #[must_use]
    pub fn apply(&self, p: Point) -> Point {
        Point::from(self.scale * (p - self.center))
    }

    /// Takes an image back to the source.
    #[must_use]
    pub fn invert(&self, p: Point) -> Point {
        self.center + p.coords / self.scale
    }
}

/// The outline with its centre of area at the origin and area 1, and the map that brought it there.
///
/// [`Similarity::invert`] takes places found on the normalised shape, such as a rotation centre,
/// back to the units of the input.
#[must_use]
pub fn normalized(outline: &Outline) -> (Outline, Similarity) {
    let map = Similarity { center: outline.centroid(), scale: outline.area().sqrt().recip() };
    (outline.map(|&p| map.apply(p)), map)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn area_is_one_about_the_origin_and_the_map_inverts(
            x in -1e4..1e4_f64, y in -1e4..1e4_f64, w in 1e-2..1e3_f64, h in 1e-2..1e3_f64,
        ) {
            let corners = [(x, y), (x + w, y), (x + w, y + h), (x, y + h)];
            let outline = Outline::new(corners.map(|(x, y)| Point::new(x, y)).to_vec());
            prop_assume!(outline.is_ok());
            let outline = outline.unwrap();
            let (unit, map) = normalized(&outline);
            prop_assert!((unit.area() - 1.0).abs() < 1e-9);
            prop_assert!(unit.centroid().coords.norm() < 1e-5);
            for (p, q) in unit.points().iter().zip(outline.points()) {
                prop_assert!((map.invert(*p) - q).norm() < 1e-9 * (1.0 + q.coords.norm()));
            }
        }
    }
}
