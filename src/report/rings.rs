//! The curves of a gear that a page draws.

use super::thin::thin_ring;
use crate::assembly::Gear;
use crate::geometry::Point;

/// The curves of one gear in its own frame, mm. Points that are not finite are left out.
pub(super) struct Rings {
    pub(super) outline: Vec<Point>,
    /// The bore and every other hole.
    pub(super) holes: Vec<Vec<Point>>,
    /// What is raised or sunk on the face: edges and, within them, holes.
    pub(super) marks: Vec<Vec<Point>>,
    pub(super) pitch_curve: Vec<Point>,
    pub(super) input: Vec<Point>,
}

impl Rings {
    pub(super) fn of(gear: &Gear) -> Self {
        let finite = |ring: &[Point]| -> Vec<Point> {
            ring.iter().filter(|p| p.x.is_finite() && p.y.is_finite()).copied().collect()
        };
        let openings = gear.fittings.openings.iter().map(|o| o.ring.as_slice());
        Self {
            outline: finite(&gear.outline),
            holes: gear.bore.as_deref().into_iter().chain(openings).map(finite).collect(),
            marks: gear.fittings.marks.iter().flat_map(|m| &m.face).map(|r| finite(r)).collect(),
            pitch_curve: finite(&gear.pitch_curve),
            input: finite(&gear.input),
        }
    }

    /// Without points that lie within `tolerance` (mm) of the line through the kept ones.
    pub(super) fn thinned(&self, tolerance: f64) -> Self {
        let thin = |rings: &[Vec<Point>]| rings.iter().map(|r| thin_ring(r, tolerance)).collect();
        Self {
            outline: thin_ring(&self.outline, tolerance),
            holes: thin(&self.holes),
            marks: thin(&self.marks),
            pitch_curve: thin_ring(&self.pitch_curve, tolerance),
            input: thin_ring(&self.input, tolerance),
        }
    }

    pub(super) fn points(&self) -> usize {
        let inner = self.holes.iter().chain(&self.marks).map(Vec::len).sum::<usize>();
        self.outline.len() + inner + self.pitch_curve.len() + self.input.len()
    }

    /// The largest distance from the axis of anything drawn.
    pub(super) fn reach(&self) -> f64 {
        let all = self.outline.iter().chain(&self.pitch_curve).chain(&self.input);
        all.map(|p| p.coords.norm()).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture;
    use super::*;
    use crate::assembly::{Mark, Opening};

    #[test]
    fn holes_and_marks_are_drawn_and_thinned() {
        let ring = |r: f64| -> Vec<Point> {
            (0..90)
                .map(|i| f64::from(i) * 0.07)
                .map(|a| Point::new(r * a.cos(), r * a.sin()))
                .collect()
        };
        let mut gear = fixture::ellipses().gears.swap_remove(0).gear;
        let bare = Rings::of(&gear);
        gear.fittings.openings.push(Opening { name: "eye".into(), ring: ring(1.0) });
        let face = vec![ring(3.0), ring(2.0)];
        gear.fittings.marks.push(Mark { name: "face 1".into(), face, height: 0.6 });
        let rings = Rings::of(&gear);
        assert_eq!(rings.holes.len(), bare.holes.len() + 1);
        assert_eq!(rings.marks.len(), bare.marks.len() + 2);
        assert_eq!(rings.points(), bare.points() + 270);
        let thinned = rings.thinned(0.1);
        assert!(thinned.holes.iter().chain(&thinned.marks).all(|r| r.len() < 30));
    }
}
