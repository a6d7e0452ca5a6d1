//! What a nozzle can draw of a drawing.

use crate::geometry::{self, Face, Point};

/// Chords of rounded corners, radians of arc.
const CHORD: f64 = 0.2;
/// How far short of half a nozzle areas are tried, so that lines of just its width pass.
const SHORT: f64 = 0.96;
/// Parts that a nozzle loses are lines, and not just corners, from this length on, in nozzles.
const LINE: f64 = 3.0;
/// Specks smaller than this, in nozzles, are dropped rather than widened.
const SPECK: f64 = 0.7;

/// Areas that a nozzle can draw, and what was done for it.
#[derive(Clone, Debug, Default)]
pub(super) struct Drawable {
    pub(super) faces: Vec<Face>,
    /// Lines that were widened.
    pub(super) widened: usize,
    /// Specks that were dropped.
    pub(super) dropped: usize,
}

/// Areas joined where less than a nozzle is between them, their thin lines widened to the nozzle, mm.
pub(super) fn drawable(faces: &[Face], nozzle: f64) -> Drawable {
    let half = 0.5 * nozzle;
    let closed = geometry::grown(&geometry::grown(faces, half, CHORD), -half, CHORD);
    let wide = opened(&closed, nozzle);
    let rest = geometry::without(&rings(&closed), &rings(&wide));
    let mut made = Drawable::default();
    let mut parts = rings(&wide);
    for thin in rest {
        let size = extent(&thin[0]);
        let touches = wide.iter().any(|w| meets(&w[0], &thin[0], 0.2 * nozzle));
        if size > LINE * nozzle || (!touches && size > SPECK * nozzle) {
            made.widened += 1;
            // A long strip is as wide as twice its area over its edge.
            let edge: f64 = thin.iter().map(|r| geometry::perimeter(r)).sum();
            let area: f64 = thin.iter().map(|r| geometry::signed_area(r)).sum();
            let width = 2.0 * area / edge;
            let more = 0.5 * (1.05 * nozzle - width).max(0.1 * nozzle);
            parts.extend(rings(&geometry::grown(&[thin], more, CHORD)));
        } else if !touches {
            made.dropped += 1;
        }
    }
    made.faces = geometry::union(&parts);
    made
}

/// What of areas is as wide as a nozzle, its outward corners rounded by it.
pub(super) fn opened(faces: &[Face], nozzle: f64) -> Vec<Face> {
    let half = 0.5 * SHORT * nozzle;
    geometry::grown(&geometry::grown(faces, -half, CHORD), half, CHORD)
}

/// The boundaries of faces.
pub(super) fn rings(faces: &[Face]) -> Vec<Vec<Point>> {
    faces.iter().flatten().cloned().collect()
}

fn extent(ring: &[Point]) -> f64 {
    let (low, high) = geometry::bounds(ring);
    (high - low).norm()
}

/// Whether a point of the second ring comes as near as that to a point of the first, or lies in it.
fn meets(a: &[Point], b: &[Point], near: f64) -> bool {
    b.iter().any(|p| geometry::contains(a, *p) || a.iter().any(|q| (p - q).norm() < near))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bar(x: f64, width: f64, length: f64) -> Face {
        let ring = [(x, 0.0), (x + width, 0.0), (x + width, length), (x, length)];
        vec![ring.map(|(x, y)| Point::new(x, y)).to_vec()]
    }

    #[test]
    fn thin_lines_are_widened_and_specks_dropped() {
        let made = drawable(&[bar(0.0, 0.1, 8.0), bar(5.0, 2.0, 8.0), bar(12.0, 0.1, 0.1)], 0.4);
        assert_eq!((made.widened, made.dropped, made.faces.len()), (1, 1, 2));
        let line = made.faces.iter().min_by(|a, b| a[0][0].x.total_cmp(&b[0][0].x)).unwrap();
        let (low, high) = geometry::bounds(&line[0]);
        assert!((high.x - low.x - 0.42).abs() < 0.03, "{}", high.x - low.x);
        // What is wide already keeps its size.
        let plain = drawable(&[bar(0.0, 2.0, 8.0)], 0.4);
        assert_eq!((plain.widened, plain.dropped), (0, 0));
        assert!((geometry::area(&plain.faces[0][0]) - 16.0).abs() < 0.05);
    }

    #[test]
    fn a_gap_narrower_than_the_nozzle_is_filled() {
        let apart = |gap: f64| drawable(&[bar(0.0, 2.0, 8.0), bar(2.0 + gap, 2.0, 8.0)], 0.4);
        assert_eq!(apart(0.2).faces.len(), 1);
        assert_eq!(apart(0.6).faces.len(), 2);
    }
}
