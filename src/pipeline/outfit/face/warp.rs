//! How an inner drawing moves along with the outline of its gear.

use crate::geometry::{self, Point, Vector};
use crate::outline::{Outline, resample};
use std::f64::consts::TAU;

/// Points of the edge that carry the map: on a gear of 100 mm one in less than a millimetre.
const STATIONS: usize = 360;
/// Share of even spacing along the edge that is mixed into the directions, so that edges which run towards the axis, or back,
/// are not drawn together into one point.
const EVEN: f64 = 0.02;
/// Points nearer to a station than this, in radii, lie on it.
const AT_STATION: f64 = 1e-9;

/// A smooth map of the plane that takes the edge of a drawing to the edge of a face, point by point, about their common
/// axis at the origin: the displacements of the edge, carried inwards by mean value coordinates (Floater, Computer Aided
/// Geometric Design 20, 2003), which reproduce them exactly on the edge.
#[derive(Clone, Debug)]
pub(super) struct Warp {
    edge: Vec<Point>,
    shifts: Vec<Vector>,
}

impl Warp {
    /// From the edge of a drawing to that of a face, both counter-clockwise about the origin; none where either leaves the
    /// origin outside.
    pub(super) fn new(drawing: &[Point], face: &[Point]) -> Option<Self> {
        let inside = |ring: &[Point]| ring.len() > 2 && geometry::contains(ring, Point::origin());
        if !inside(drawing) || !inside(face) {
            return None;
        }
        let mut edge = resample(&Outline::new(drawing.to_vec()).ok()?, STATIONS);
        // The outermost point is seen from outside, so its direction is sure.
        let far = |p: &Point| p.coords.norm();
        let first = (0..edge.len()).max_by(|&i, &j| far(&edge[i]).total_cmp(&far(&edge[j])))?;
        edge.rotate_left(first);
        let directions = increasing(&edge);
        let shifts = edge.iter().zip(&directions).map(|(p, &angle)| reached(face, angle) - p);
        let shifts = shifts.collect();
        Some(Self { edge, shifts })
    }

    /// Where a point goes.
    pub(super) fn apply(&self, p: &Point) -> Point {
        let n = self.edge.len();
        let arms: Vec<(Vector, f64)> = self.edge.iter().map(|q| (q - p, (q - p).norm())).collect();
        let mut sum = Vector::zeros();
        let mut weights = 0.0;
        for i in 0..n {
            let (a, length) = arms[i];
            if length < AT_STATION {
                return p + self.shifts[i];
            }
            let (b, next) = arms[(i + 1) % n];
            let (sine, cosine) = (geometry::cross(a, b), a.dot(&b));
            let reach = length * next + cosine;
            if reach <= AT_STATION * length * next {
                // On the edge itself, between two stations.
                let t = length / (length + next);
                return p + self.shifts[i] * (1.0 - t) + self.shifts[(i + 1) % n] * t;
            }
            // Half the tangent of an angle between two arms counts for both its ends.
            let half = sine / reach;
            let (w, v) = (half / length, half / next);
            sum += self.shifts[i] * w + self.shifts[(i + 1) % n] * v;
            weights += w + v;
        }
        if weights.abs() > 0.0 { p + sum / weights } else { *p }
    }
}

/// Directions in which points of an edge lie as seen from the origin, radians, made to increase by one turn: where the edge
/// turns back, the mean of what it passes twice.
fn increasing(edge: &[Point]) -> Vec<f64> {
    let mut angle = edge[0].y.atan2(edge[0].x);
    let start = angle;
    let mut pooled: Vec<(f64, usize)> = Vec::with_capacity(edge.len());
    for (i, p) in edge.iter().enumerate() {
        if i > 0 {
            let before = edge[i - 1];
            angle += geometry::cross(before.coords, p.coords).atan2(before.coords.dot(&p.coords));
        }
        let mut block = (angle.clamp(start, start + TAU), 1);
        // Pool adjacent violators: the increasing sequence that is nearest in squares.
        while let Some(&(mean, count)) = pooled.last().filter(|last| last.0 > block.0) {
            pooled.pop();
            let all = count + block.1;
            block.0 = (mean * count as f64 + block.0 * block.1 as f64) / all as f64;
            block.1 = all;
        }
        pooled.push(block);
    }
    let flat = pooled.into_iter().flat_map(|(mean, count)| std::iter::repeat_n(mean, count));
    let even = |i: usize| start + TAU * i as f64 / edge.len() as f64;
    flat.enumerate().map(|(i, angle)| (1.0 - EVEN) * angle + EVEN * even(i)).collect()
}

/// The outermost point of a ring in a direction from the origin.
fn reached(ring: &[Point], angle: f64) -> Point {
    let ray = Vector::new(angle.cos(), angle.sin());
    let edges = ring.iter().zip(ring.iter().cycle().skip(1));
    let crossings = edges.filter_map(|(a, b)| {
        let (u, v) = (geometry::cross(ray, a.coords), geometry::cross(ray, b.coords));
        let crosses = (u > 0.0) != (v > 0.0);
        crosses.then(|| (a.coords + (b - a) * (u / (u - v))).dot(&ray))
    });
    Point::from(ray * crossings.fold(0.0, f64::max))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::circle;

    #[test]
    fn the_edge_goes_exactly_to_the_edge_and_the_inside_moves_smoothly() {
        let drawing = circle(10.0, 1e-4);
        let face: Vec<Point> = drawing.iter().map(|p| Point::new(1.2 * p.x, 0.8 * p.y)).collect();
        let warp = Warp::new(&drawing, &face).unwrap();
        let on_face = |p: Point| ((p.x / 12.0).powi(2) + (p.y / 8.0).powi(2)).sqrt();
        for q in &warp.edge {
            assert!((on_face(warp.apply(q)) - 1.0).abs() < 1e-3);
        }
        // Between two stations too, and just inside of the edge.
        let between = nalgebra::center(&warp.edge[3], &warp.edge[4]);
        assert!((on_face(warp.apply(&between)) - 1.0).abs() < 2e-3);
        let near = Point::from(between.coords * (1.0 - 1e-6));
        assert!((warp.apply(&near) - warp.apply(&between)).norm() < 1e-3);
        assert!((warp.apply(&Point::origin()).coords).norm() < 0.05);
    }

    #[test]
    fn a_drawing_that_is_its_gear_stays_where_it_is() {
        let ring = circle(10.0, 1e-4);
        let warp = Warp::new(&ring, &ring).unwrap();
        for p in [Point::new(3.0, 4.0), Point::new(-9.0, 1.0), Point::origin()] {
            assert!((warp.apply(&p) - p).norm() < 1e-2, "{p}");
        }
        let away: Vec<Point> = ring.iter().map(|p| Point::new(p.x + 20.0, p.y)).collect();
        assert!(Warp::new(&away, &ring).is_none());
    }

    #[test]
    fn an_edge_that_turns_back_is_not_turned_over() {
        // A hook: seen from the axis its edge passes some directions three times.
        let hook = [
            (-8.0, -8.0),
            (8.0, -8.0),
            (8.0, 9.0),
            (-3.0, 9.0),
            (-3.0, 6.0),
            (5.0, 6.0),
            (5.0, 3.0),
            (-8.0, 3.0),
        ];
        let hook: Vec<Point> = hook.map(|(x, y)| Point::new(x, y)).to_vec();
        let mut edge = resample(&Outline::new(hook).unwrap(), 200);
        let far = (0..200).max_by(|&i, &j| edge[i].coords.norm().total_cmp(&edge[j].coords.norm()));
        edge.rotate_left(far.unwrap());
        let directions = increasing(&edge);
        assert!(directions.windows(2).all(|w| w[1] > w[0]));
        assert!(directions.last().unwrap() - directions[0] < TAU);
    }
}
