//! The radial hole of a set screw, and how much it takes.

use super::Solid;
use super::bore::circle;
use crate::geometry::Point;

/// The hole of `diameter` along +x from the axis to x = `reach` at height `z`, all mm, with its cross
/// section: x of the points is the world's -z.
pub(super) fn set_screw(diameter: f64, reach: f64, z: f64, tolerance: f64) -> (Solid, Vec<Point>) {
    let section = circle(0.5 * diameter, tolerance);
    let hole = Solid::extrude(&section, &[], reach).laid_along_x().translate(0.0, 0.0, z);
    (hole, section)
}

/// Volume of what such a hole takes out between the rings `inner` and `outer`, both about the axis,
/// mm^3. Exact for polygons.
pub(super) fn taken(section: &[Point], outer: &[Point], inner: &[Point]) -> f64 {
    let half = section.iter().map(|p| p.y).fold(0.0, f64::max);
    let all = section.iter().chain(outer).chain(inner).map(|p| p.y);
    let mut cuts: Vec<f64> = all.filter(|y| y.abs() <= half).collect();
    cuts.sort_by(f64::total_cmp);
    // Between two cuts the width of the section and the length of the hole are straight lines:
    // Gauss' rule with two points is exact for their product.
    let at = |y: f64| width(section, y) * (along(outer, y) - along(inner, y));
    let shift = 0.5 / 3.0_f64.sqrt();
    cuts.windows(2)
        .map(|w| {
            let (middle, span) = (0.5 * (w[0] + w[1]), w[1] - w[0]);
            0.5 * span * (at(middle - shift * span) + at(middle + shift * span))
        })
        .sum()
}

fn crossings(ring: &[Point], y: f64) -> impl Iterator<Item = f64> {
    let ends = ring.iter().zip(ring.iter().cycle().skip(1));
    ends.filter(move |(a, b)| (a.y <= y) != (b.y <= y))
        .map(move |(a, b)| a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y))
}

/// Width of a ring at height `y`.
fn width(ring: &[Point], y: f64) -> f64 {
    let (low, high) = crossings(ring, y)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    (high - low).max(0.0)
}

/// Length of the line at height `y`, x > 0, inside a ring.
fn along(ring: &[Point], y: f64) -> f64 {
    let mut x: Vec<f64> = crossings(ring, y).map(|x| x.max(0.0)).collect();
    x.sort_by(f64::total_cmp);
    x.chunks_exact(2).map(|pair| pair[1] - pair[0]).sum()
}

#[cfg(test)]
mod tests {
    use super::super::Bore;
    use super::*;
    use std::f64::consts::PI;

    fn ring(bore: Bore) -> Vec<Point> {
        bore.polygon(1e-5).unwrap().unwrap()
    }

    #[test]
    fn between_squares_a_hole_takes_a_cylinder() {
        let section = circle(1.5, 1e-5);
        let squares = [12.0, 5.0].map(|side| ring(Bore::Square { side }));
        let volume = taken(&section, &squares[0], &squares[1]);
        assert!((volume / (PI * 2.25 * 3.5) - 1.0).abs() < 1e-4, "{volume}");
    }

    #[test]
    fn between_circles_it_takes_what_the_integral_says() {
        let (r, a, b) = (1.5_f64, 8.0_f64, 3.0_f64);
        let circles = [a, b].map(|r| ring(Bore::Round { diameter: 2.0 * r }));
        let volume = taken(&circle(r, 1e-6), &circles[0], &circles[1]);
        let n = 20_000;
        let exact: f64 = (0..n)
            .map(|i| -r + 2.0 * r * (f64::from(i) + 0.5) / f64::from(n))
            .map(|y| {
                2.0 * (r * r - y * y).sqrt() * ((a * a - y * y).sqrt() - (b * b - y * y).sqrt())
            })
            .sum::<f64>()
            * 2.0
            * r
            / f64::from(n);
        assert!((volume / exact - 1.0).abs() < 1e-4, "{volume} {exact}");
    }
}
