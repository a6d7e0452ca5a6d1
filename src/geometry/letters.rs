//! Lettering: text as faces with an area, from the fonts that come with the program.

use super::{Face, Point, area, bounds, union};
use crate::policy;
use ttf_parser::{Face as Font, OutlineBuilder};

/// A line of text whose capitals are as high as asked, its baseline on y = 0, starting at x = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Lettering {
    /// The letters' faces from left to right; letters that overlap are one face.
    pub faces: Vec<Face>,
    /// Lower left corner of all faces.
    pub low: Point,
    /// Upper right corner.
    pub high: Point,
}

/// Why a text cannot be lettered.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LetteringError {
    /// No font has the character.
    #[error("no font here has the character {letter:?}; leave it out or write it otherwise")]
    NoSuchLetter {
        /// The character.
        letter: char,
    },
    /// Nothing but blanks.
    #[error("the text {text:?} has no letters; give at least one")]
    Blank {
        /// The text.
        text: String,
    },
}

/// Whether a character can be lettered.
#[must_use]
pub fn has_letter(letter: char) -> bool {
    fonts().any(|font| font.glyph_index(letter).is_some())
}

/// The text with capitals `height` high, in that unit. Each curve of the font is drawn with
/// [`policy::LETTER_CHORDS`] chords.
///
/// # Errors
/// See [`LetteringError`].
pub fn lettering(text: &str, height: f64) -> Result<Lettering, LetteringError> {
    let fonts: Vec<Font<'_>> = fonts().collect();
    let mut contours = Vec::new();
    let mut x = 0.0;
    for letter in text.chars() {
        let found = fonts.iter().find_map(|font| font.glyph_index(letter).map(|id| (font, id)));
        let (font, glyph) = found.ok_or(LetteringError::NoSuchLetter { letter })?;
        let capital = font.capital_height().filter(|h| *h > 0);
        let capital = capital.map_or(0.7 * f64::from(font.units_per_em()), f64::from);
        let mut pen = Pen { scale: height / capital, x, rings: Vec::new() };
        let _ = font.outline_glyph(glyph, &mut pen);
        x += pen.scale * f64::from(font.glyph_hor_advance(glyph).unwrap_or_default());
        let mut rings: Vec<_> = pen.rings.into_iter().filter(|ring| ring.len() > 2).collect();
        if letter == '0' {
            // The dot or bar in it, which tells it from an O, would be an island of its own.
            rings.sort_by(|a, b| area(b).total_cmp(&area(a)));
            rings.truncate(2);
        }
        contours.extend(rings);
    }
    // Contours wind one way round ink and the other way round holes, whichever that is.
    let faces = union(&contours);
    let corners: Vec<Point> = faces.iter().flatten().flatten().copied().collect();
    if corners.is_empty() {
        return Err(LetteringError::Blank { text: text.to_owned() });
    }
    let (low, high) = bounds(&corners);
    Ok(Lettering { faces, low, high })
}

/// The fonts in the order in which they are asked for a character. Hack comes first: its strokes are even
/// and wide enough to print.
fn fonts() -> impl Iterator<Item = Font<'static>> {
    [epaint_default_fonts::HACK_REGULAR, epaint_default_fonts::UBUNTU_LIGHT]
        .into_iter()
        .filter_map(|data| Font::parse(data, 0).ok())
}

/// Takes a glyph's curves as chords.
struct Pen {
    scale: f64,
    x: f64,
    rings: Vec<Vec<Point>>,
}

impl Pen {
    fn at(&self, x: f32, y: f32) -> Point {
        Point::new(self.x + self.scale * f64::from(x), self.scale * f64::from(y))
    }

    fn add(&mut self, p: Point) {
        if let Some(ring) = self.rings.last_mut() {
            ring.push(p);
        }
    }

    fn last(&self) -> Point {
        self.rings.last().and_then(|r| r.last()).copied().unwrap_or_else(Point::origin)
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        let start = self.at(x, y);
        self.rings.push(vec![start]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let to = self.at(x, y);
        self.add(to);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (a, b, c) = (self.last(), self.at(x1, y1), self.at(x, y));
        let steps = policy::LETTER_CHORDS;
        for i in 1..=steps {
            let t = f64::from(i) / f64::from(steps);
            self.add(a + (b - a) * (2.0 * t * (1.0 - t)) + (c - a) * (t * t));
        }
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let (a, b, c, d) = (self.last(), self.at(x1, y1), self.at(x2, y2), self.at(x, y));
        let steps = policy::LETTER_CHORDS;
        for i in 1..=steps {
            let t = f64::from(i) / f64::from(steps);
            let s = 1.0 - t;
            let bend = (b - a) * (3.0 * s * s * t) + (c - a) * (3.0 * s * t * t);
            self.add(a + bend + (d - a) * (t * t * t));
        }
    }

    fn close(&mut self) {}
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{contains, signed_area};

    #[test]
    fn capitals_have_the_height_and_letters_their_holes() {
        let made = lettering("HOB", 5.0).unwrap();
        assert_eq!(made.faces.len(), 3);
        let rings: Vec<usize> = made.faces.iter().map(Vec::len).collect();
        let mut sorted: Vec<(f64, usize)> =
            made.faces.iter().zip(rings).map(|(f, n)| (bounds(&f[0]).0.x, n)).collect();
        sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
        assert_eq!(sorted.iter().map(|s| s.1).collect::<Vec<_>>(), [1, 2, 3]);
        for face in &made.faces {
            assert!(signed_area(&face[0]) > 0.0);
            assert!(face[1..].iter().all(|hole| signed_area(hole) < 0.0));
        }
        let h = made.faces.iter().min_by(|a, b| a[0][0].x.total_cmp(&b[0][0].x)).unwrap();
        let (low, high) = bounds(&h[0]);
        assert!((high.y - low.y - 5.0).abs() < 1e-3, "{} {}", low.y, high.y);
    }

    #[test]
    fn letters_are_not_mirrored() {
        // The bar of an L lies at the lower right, its stem on the left.
        let made = lettering("L", 10.0).unwrap();
        let ink = |x: f64, y: f64| {
            let (w, h) = (made.high.x - made.low.x, made.high.y - made.low.y);
            contains(&made.faces[0][0], Point::new(made.low.x + x * w, made.low.y + y * h))
        };
        assert!(ink(0.05, 0.9) && ink(0.9, 0.04) && !ink(0.9, 0.9));
    }

    #[test]
    fn what_no_font_has_is_named() {
        assert!(has_letter('ß') && has_letter('é') && has_letter('Ж') && !has_letter('\u{7}'));
        let error = lettering("ab\u{7}", 5.0).unwrap_err();
        assert_eq!(error, LetteringError::NoSuchLetter { letter: '\u{7}' });
        assert!(matches!(lettering("  ", 5.0), Err(LetteringError::Blank { .. })));
    }
}
