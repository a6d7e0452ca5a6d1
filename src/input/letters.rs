//! Letters as shapes: `text:A`.

use super::inner::{Drawing, Inner};
use crate::geometry::{self, LetteringError, Point, lettering};
use crate::outline::Outline;

/// Begins the name of a shape that is a text.
pub(super) const PREFIX: &str = "text:";

/// Height of the capitals, in the shape's own unit: any will do.
const HEIGHT: f64 = 100.0;

/// Why a text is no shape.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LettersError {
    /// It cannot be written.
    #[error(transparent)]
    Lettering(#[from] LetteringError),
    /// Its letters hang together nowhere.
    #[error(
        "the text {text:?} has {pieces} pieces and a gear is one; give one letter such as text:A"
    )]
    Pieces {
        /// The text.
        text: String,
        /// How many.
        pieces: usize,
    },
    /// Its edge is no outline.
    #[error("the text {text:?} has no outline; give another letter")]
    NoOutline {
        /// The text.
        text: String,
    },
}

/// A letter, or letters that hang together, with the holes in it.
///
/// # Errors
/// See [`LettersError`].
pub(super) fn shape(text: &str) -> Result<Drawing, LettersError> {
    let made = lettering(text, HEIGHT)?;
    // A dot over an i or a j is a piece too, and so are both lines of an equals sign.
    let [face] = made.faces.as_slice() else {
        return Err(LettersError::Pieces { text: text.to_owned(), pieces: made.faces.len() });
    };
    let none = || LettersError::NoOutline { text: text.to_owned() };
    let edge = face.first().filter(|ring| geometry::area(ring) > 0.0).ok_or_else(none)?;
    let outline = Outline::new(edge.clone()).map_err(|_| none())?;
    let turned = |ring: &Vec<Point>| ring.iter().rev().copied().collect();
    let holes = face[1..].iter().map(turned).collect();
    Ok(Drawing { inner: Inner { holes, ..Inner::default() }, ..outline.into() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_letter_is_a_shape_and_several_are_not() {
        let drawing = shape("A").unwrap();
        let outline = &drawing.outline;
        let (low, high) = geometry::bounds(outline.points());
        assert!((high.y - low.y - HEIGHT).abs() < 0.1);
        // Its counter is filled in, and a hole.
        let middle = nalgebra::center(&low, &high);
        assert!(geometry::contains(outline.points(), middle));
        assert!(
            drawing.inner.holes.len() == 1 && geometry::contains(&drawing.inner.holes[0], middle)
        );
        assert_eq!(shape("B").unwrap().inner.holes.len(), 2);
        assert!(matches!(shape("AB"), Err(LettersError::Pieces { pieces: 2, .. })));
        assert!(matches!(shape(" "), Err(LettersError::Lettering(_))));
    }
}
