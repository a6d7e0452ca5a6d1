//! The built-in shapes, drawn under `scenes/shapes/` and embedded in the binary.

macro_rules! embed {
    ($($name:literal)*) => {
        &[$(($name, include_str!(concat!("../../scenes/shapes/", $name, ".svg")))),*]
    };
}

/// Names and drawings. To add a shape, put `name.svg` into the folder and its name here.
const SHAPES: &[(&str, &str)] = embed! {
    "heart"
    "dove"
    "fish"
    "butterfly"
    "starfish"
    "square"
    "ellipse"
    "triangle"
    "drop"
    "leaf"
    "flower"
    "bell"
    "candy"
    "bone"
    "dog"
    "cat"
    "hat"
    "pot"
    "shoe"
    "guitar"
    "hand"
    "tree"
    "airplane"
    "maple-leaf"
    "acorn"
    "apple"
    "bear"
    "boy"
    "cloud"
    "clover"
    "club"
    "crown"
    "duck"
    "egg"
    "elephant"
    "fighter"
    "fir"
    "girl"
    "key"
    "moon"
    "mushroom"
    "pear"
    "penguin"
    "rabbit"
    "rocket"
    "snowman"
    "spade"
    "star"
    "sunnydoll"
    "teapot"
    "turtle"
    "whale"
};

/// Names of the built-in shapes, in the order in which they are listed.
pub fn names() -> impl Iterator<Item = &'static str> {
    SHAPES.iter().map(|(name, _)| *name)
}

/// The SVG text of a built-in shape.
#[must_use]
pub fn svg(name: &str) -> Option<&'static str> {
    SHAPES.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

/// The built-in name that differs from `name` in the fewest letters, if it is similar at all.
#[must_use]
pub fn nearest(name: &str) -> Option<&'static str> {
    let wanted: Vec<char> = name.to_lowercase().chars().take(64).collect();
    // Of two names as near, the one of like length: letters are swapped more often than lost.
    let rated = names()
        .map(|known| (edit_distance(&wanted, known), known.len().abs_diff(wanted.len()), known));
    let (distance, _, best) = rated.min()?;
    (distance <= 1 + best.len() / 3).then_some(best)
}

/// Letters to insert, delete or replace to turn one word into the other.
fn edit_distance(a: &[char], b: &str) -> usize {
    let mut row: Vec<usize> = (0..=a.len()).collect();
    for (i, letter) in b.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for j in 0..a.len() {
            let replaced = diagonal + usize::from(a[j] != letter);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[a.len()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry;
    use crate::input::from_svg;
    use crate::policy;

    #[test]
    fn every_shape_is_a_sound_outline() {
        for name in names() {
            let outline = from_svg(svg(name).unwrap().as_bytes(), policy::FLATTEN_TOLERANCE);
            assert!(outline.is_ok(), "{name}: {outline:?}");
        }
    }

    #[test]
    fn inner_drawing_leaves_the_outline_as_it_is() {
        let mut with_inner = 0;
        for name in names() {
            let whole = svg(name).unwrap();
            let silhouette = whole.find("/>").map(|end| format!("{}/></svg>", &whole[..end]));
            let read = |text: &str| from_svg(text.as_bytes(), policy::FLATTEN_TOLERANCE).unwrap();
            let (whole, bare) = (read(whole), read(&silhouette.unwrap()));
            let shared = geometry::intersection_over_union(whole.points(), bare.points());
            assert!(shared > 1.0 - 1e-6, "{name}: {shared}");
            with_inner += usize::from(svg(name).unwrap().contains("white"));
        }
        assert!(with_inner > 30, "{with_inner}");
    }

    #[test]
    fn names_are_unique_and_suggested() {
        let mut all: Vec<_> = names().collect();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), names().count());
        assert_eq!(nearest("Haert"), Some("heart"));
        assert_eq!(nearest("sqare"), Some("square"));
        assert_eq!(nearest("zyxwvutsr"), None);
        assert_eq!(svg("no such shape"), None);
        assert_eq!(edit_distance(&['k', 'i', 't', 't', 'e', 'n'], "sitting"), 3);
    }
}
