//! A uniform grid over the edges of one gear: where is the boundary, how far
//! is it at least, what is inside, and where does a turning point meet it.

use crate::geometry::{self, Point, Vector, cross};
use crate::policy;

/// Where a circle about an axis crosses the boundary.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    /// Signed angle about the axis from the query point, radians.
    pub(super) angle: f64,
    /// The edge that is crossed starts at this point of the polygon.
    pub(super) edge: usize,
    /// Where it is crossed, in the polygon's frame.
    pub(super) at: Point,
    /// Whether the counter-clockwise way round the axis enters the material here.
    pub(super) entering: bool,
}

/// Edges of a counter-clockwise polygon in a uniform grid.
#[derive(Debug)]
pub(super) struct EdgeIndex {
    points: Vec<Point>,
    low: Point,
    cell: f64,
    columns: usize,
    rows: usize,
    starts: Vec<u32>,
    edges: Vec<u32>,
    /// Cells, in chessboard steps, to the nearest one that holds an edge (saturated).
    steps: Vec<u8>,
    /// A distance that the boundary keeps from the centre of each cell, mm.
    center_clear: Vec<f32>,
    /// Whether the centre of the cell is inside the polygon.
    center_inside: Vec<bool>,
}

impl EdgeIndex {
    /// Lays the grid; the polygon has at least three points, all finite.
    pub(super) fn new(points: Vec<Point>) -> Self {
        let (low, high) = geometry::bounds(&points);
        let size = high - low;
        let mean_edge = geometry::perimeter(&points) / points.len() as f64;
        let cell = (policy::CONTACT_CELL_EDGES * mean_edge)
            .max((size.x * size.y / policy::CONTACT_MAX_CELLS).sqrt());
        // An odd offset keeps cell centres off the straight lines of a drawing.
        let low = low - Vector::repeat(cell * (1.0 + 0.5 * policy::GOLDEN_FRACTION));
        let columns = ((high.x - low.x) / cell) as usize + 2;
        let rows = ((high.y - low.y) / cell) as usize + 2;
        let mut index = Self {
            points,
            low,
            cell,
            columns,
            rows,
            starts: Vec::new(),
            edges: Vec::new(),
            steps: vec![u8::MAX; columns * rows],
            center_clear: Vec::new(),
            center_inside: vec![false; columns * rows],
        };
        index.file_edges();
        index.measure_steps();
        index.measure_clear();
        index.mark_inside();
        index
    }

    pub(super) fn edge(&self, i: usize) -> (Point, Point) {
        let next = if i + 1 == self.points.len() { 0 } else { i + 1 };
        (self.points[i], self.points[next])
    }

    fn center(&self, column: usize, row: usize) -> Point {
        self.low + Vector::new(column as f64 + 0.5, row as f64 + 0.5) * self.cell
    }

    fn clamped(&self, p: Point) -> (usize, usize) {
        let c = (p - self.low) / self.cell;
        ((c.x as usize).min(self.columns - 1), (c.y as usize).min(self.rows - 1))
    }

    fn file_edges(&mut self) {
        // A cell is taken when its circumscribed circle reaches the line of the edge.
        let reach = self.cell * std::f64::consts::FRAC_1_SQRT_2 * 1.001;
        let mut filed: Vec<(u32, u32)> = Vec::with_capacity(3 * self.points.len());
        for i in 0..self.points.len() {
            let (a, b) = self.edge(i);
            let (low, high) = geometry::bounds(&[a, b]);
            let ((c0, r0), (c1, r1)) = (self.clamped(low), self.clamped(high));
            let along = (b - a).try_normalize(0.0).unwrap_or_else(Vector::x);
            for row in r0..=r1 {
                for column in c0..=c1 {
                    if cross(along, self.center(column, row) - a).abs() <= reach {
                        filed.push(((row * self.columns + column) as u32, i as u32));
                    }
                }
            }
        }
        filed.sort_unstable();
        self.starts = vec![0; self.columns * self.rows + 1];
        for &(cell, _) in &filed {
            self.starts[cell as usize + 1] += 1;
            self.steps[cell as usize] = 0;
        }
        for cell in 0..self.columns * self.rows {
            self.starts[cell + 1] += self.starts[cell];
        }
        self.edges = filed.into_iter().map(|(_, edge)| edge).collect();
    }

    fn measure_steps(&mut self) {
        let (w, h) = (self.columns, self.rows);
        let nearer = |steps: &mut [u8], at: usize, from: usize| {
            steps[at] = steps[at].min(steps[from].saturating_add(1));
        };
        for row in 0..h {
            for column in 0..w {
                let at = row * w + column;
                if column > 0 {
                    nearer(&mut self.steps, at, at - 1);
                }
                if row > 0 {
                    for c in column.saturating_sub(1)..=(column + 1).min(w - 1) {
                        nearer(&mut self.steps, at, at - w - column + c);
                    }
                }
            }
        }
        for row in (0..h).rev() {
            for column in (0..w).rev() {
                let at = row * w + column;
                if column + 1 < w {
                    nearer(&mut self.steps, at, at + 1);
                }
                if row + 1 < h {
                    for c in column.saturating_sub(1)..=(column + 1).min(w - 1) {
                        nearer(&mut self.steps, at, at + w - column + c);
                    }
                }
            }
        }
    }

    /// Exact near the boundary, where most questions are asked; else what the steps tell.
    fn measure_clear(&mut self) {
        let clear = |at: usize| {
            let steps = self.steps[at];
            if steps > 1 {
                return ((f64::from(steps) - 0.5) * self.cell) as f32;
            }
            let distance = self.distance(self.center(at % self.columns, at / self.columns), 0.0);
            (distance as f32).next_down()
        };
        self.center_clear = (0..self.steps.len()).map(clear).collect();
    }

    fn mark_inside(&mut self) {
        let mut crossings: Vec<Vec<f64>> = vec![Vec::new(); self.rows];
        for i in 0..self.points.len() {
            let (a, b) = self.edge(i);
            let (low, high) = (a.y.min(b.y), a.y.max(b.y));
            let (_, first) = self.clamped(Point::new(a.x, low));
            let (_, last) = self.clamped(Point::new(a.x, high));
            for (row, met) in crossings.iter_mut().enumerate().take(last + 1).skip(first) {
                let y = self.low.y + (row as f64 + 0.5) * self.cell;
                if (a.y > y) != (b.y > y) {
                    met.push(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
                }
            }
        }
        for (row, mut met) in crossings.into_iter().enumerate() {
            met.sort_by(f64::total_cmp);
            let mut passed = 0;
            for column in 0..self.columns {
                let x = self.low.x + (column as f64 + 0.5) * self.cell;
                while passed < met.len() && met[passed] < x {
                    passed += 1;
                }
                self.center_inside[row * self.columns + column] = passed % 2 == 1;
            }
        }
    }

    fn cell_of(&self, p: Point) -> Option<usize> {
        let c = (p - self.low) / self.cell;
        let inside = c.x >= 0.0 && c.y >= 0.0;
        let (column, row) = (c.x as usize, c.y as usize);
        (inside && column < self.columns && row < self.rows).then(|| row * self.columns + column)
    }

    /// A distance that the boundary certainly keeps from `p` (0 when it may be near).
    pub(super) fn clear_distance(&self, p: Point) -> f64 {
        match self.cell_of(p) {
            Some(cell) => {
                let center = self.center(cell % self.columns, cell / self.columns);
                (f64::from(self.center_clear[cell]) - (p - center).norm()).max(0.0)
            }
            None => {
                let high =
                    self.low + Vector::new(self.columns as f64, self.rows as f64) * self.cell;
                let dx = (self.low.x - p.x).max(p.x - high.x).max(0.0);
                let dy = (self.low.y - p.y).max(p.y - high.y).max(0.0);
                (dx * dx + dy * dy).sqrt()
            }
        }
    }

    /// Whether `p` is inside the polygon. Exact but for points on the boundary.
    pub(super) fn inside(&self, p: Point) -> bool {
        let Some(cell) = self.cell_of(p) else { return false };
        let center = self.center(cell % self.columns, cell / self.columns);
        let way = center - p;
        if way.norm() < f64::from(self.center_clear[cell]) {
            return self.center_inside[cell];
        }
        let met = self.edges_in(cell).filter(|&edge| {
            let (a, b) = self.edge(edge);
            let along = b - a;
            (cross(way, a - p) > 0.0) != (cross(way, b - p) > 0.0)
                && (cross(along, p - a) > 0.0) != (cross(along, center - a) > 0.0)
        });
        self.center_inside[cell] != (met.count() % 2 == 1)
    }

    fn edges_in(&self, cell: usize) -> impl Iterator<Item = usize> {
        let range = self.starts[cell] as usize..self.starts[cell + 1] as usize;
        self.edges[range].iter().map(|&edge| edge as usize)
    }

    /// Distance from `p` to the boundary, or any smaller one as soon as it is at most `enough`.
    pub(super) fn distance(&self, p: Point, enough: f64) -> f64 {
        let (column, row) = self.clamped(p);
        let nearest = usize::from(self.steps[row * self.columns + column]);
        let mut best = f64::INFINITY;
        for ring in nearest..self.columns.max(self.rows) {
            if best <= enough.max((ring as f64 - 1.0) * self.cell) {
                break;
            }
            for r in row.saturating_sub(ring)..=(row + ring).min(self.rows - 1) {
                let on_rim = r + ring == row || r == row + ring;
                let stride = if on_rim { 1 } else { 2 * ring.max(1) };
                let first = if on_rim || column >= ring {
                    column.saturating_sub(ring)
                } else {
                    column + ring
                };
                for c in (first..=(column + ring).min(self.columns - 1)).step_by(stride) {
                    for edge in self.edges_in(r * self.columns + c) {
                        let (a, b) = self.edge(edge);
                        best = best.min(distance_to_segment(p, a, b));
                    }
                }
            }
        }
        best
    }

    /// The first crossing that `p` meets when it turns about `axis`, counter-clockwise for
    /// `direction` 1 and clockwise for -1, through at most `limit` radians (below a half turn).
    /// A crossing at `p` itself belongs to the counter-clockwise way.
    pub(super) fn first_crossing(
        &self,
        p: Point,
        axis: Point,
        direction: f64,
        limit: f64,
    ) -> Option<Crossing> {
        let arm = p - axis;
        let radius = arm.norm();
        if radius == 0.0 {
            return None;
        }
        let stride = self.cell / radius;
        let mut best: Option<Crossing> = None;
        let (mut turned, mut from) = (0.0, p);
        while turned <= limit {
            let clear = self.clear_distance(from) / radius;
            let step = clear.max(stride).min(limit - turned + 1e-3 * stride);
            let (sin, cos) = (direction * (turned + step)).sin_cos();
            let to = axis + Vector::new(cos * arm.x - sin * arm.y, sin * arm.x + cos * arm.y);
            if clear < step {
                self.cross_cells(from, to, p, axis, direction, &mut best);
            }
            turned += step;
            if best.is_some_and(|b| b.angle.abs() <= turned) {
                break;
            }
            from = to;
        }
        best.filter(|b| b.angle.abs() <= limit)
    }

    /// Tests the cells that a short arc between two points may touch.
    fn cross_cells(
        &self,
        from: Point,
        to: Point,
        p: Point,
        axis: Point,
        direction: f64,
        best: &mut Option<Crossing>,
    ) {
        // Up to a quarter turn the sagitta of an arc stays below a quarter of its chord.
        let pad = Vector::repeat(0.25 * (to - from).norm());
        let (low, high) = geometry::bounds(&[from, to]);
        let (low, high) = (low - pad, high + pad);
        if high.x < self.low.x || high.y < self.low.y {
            return;
        }
        let ((c0, r0), (c1, r1)) = (self.clamped(low), self.clamped(high));
        for row in r0..=r1 {
            for column in c0..=c1 {
                for edge in self.edges_in(row * self.columns + column) {
                    self.cross_edge(edge, p, axis, direction, best);
                }
            }
        }
    }

    fn cross_edge(
        &self,
        edge: usize,
        p: Point,
        axis: Point,
        direction: f64,
        best: &mut Option<Crossing>,
    ) {
        let arm = p - axis;
        let square = arm.norm_squared();
        let (a, b) = self.edge(edge);
        let (a, b) = (a - axis, b - axis);
        let along = b - a;
        let (a2, b2, length2) = (a.norm_squared(), b.norm_squared(), along.norm_squared());
        if a2.max(b2) < square {
            return;
        }
        let slope = a.dot(&along);
        let foot = -slope / length2;
        let foot2 = a2 - slope * slope / length2;
        // Radius falls from a to the foot and rises from the foot to b; half-open in radius, so
        // that a circle through a vertex crosses one of its two edges, both, or none.
        let falls_to = if foot >= 1.0 { b2 } else { foot2 };
        let rises_from = if foot <= 0.0 { a2 } else { foot2 };
        let leaving = foot > 0.0 && a2 >= square && falls_to < square;
        let entering = foot < 1.0 && rises_from < square && b2 >= square;
        for entering in [false, true].into_iter().zip([leaving, entering]).filter(|x| x.1) {
            let entering = entering.0;
            let root = (slope * slope - length2 * (a2 - square)).max(0.0).sqrt();
            let root = if entering { root } else { -root };
            let t = ((root - slope) / length2).clamp(0.0, 1.0);
            let at = a + along * t;
            let angle = cross(arm, at).atan2(arm.dot(&at));
            let onward = if direction > 0.0 { angle >= 0.0 } else { angle < 0.0 };
            if onward && best.is_none_or(|b| angle.abs() < b.angle.abs()) {
                *best = Some(Crossing { angle, edge, at: axis + at, entering });
            }
        }
    }
}

fn distance_to_segment(p: Point, a: Point, b: Point) -> f64 {
    let along = b - a;
    let t = ((p - a).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
    (a + along * t - p).norm()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{contains, rotate};
    use std::f64::consts::TAU;

    fn star() -> Vec<Point> {
        (0..400)
            .map(|i| f64::from(i) * TAU / 400.0)
            .map(|t| rotate(Point::new(20.0 + 6.0 * (7.0 * t).sin(), 0.0), t))
            .collect()
    }

    fn probes() -> impl Iterator<Item = Point> {
        (0..2000).map(|i| {
            let t = f64::from(i) * policy::GOLDEN_FRACTION;
            rotate(Point::new(30.0 * (f64::from(i) / 2000.0).sqrt(), 0.0), TAU * t)
        })
    }

    #[test]
    fn inside_and_distances_agree_with_brute_force() {
        let index = EdgeIndex::new(star());
        for p in probes() {
            assert_eq!(index.inside(p), contains(&star(), p), "{p}");
            let exact = (0..400)
                .map(|i| index.edge(i))
                .map(|(a, b)| distance_to_segment(p, a, b))
                .fold(f64::INFINITY, f64::min);
            assert!(index.clear_distance(p) <= exact, "{p}");
            assert!((index.distance(p, 0.0) - exact).abs() < 1e-12, "{p}");
        }
    }

    #[test]
    fn a_turning_point_meets_the_boundary_where_sampling_says() {
        let index = EdgeIndex::new(star());
        let axis = Point::new(35.0, 3.0);
        for p in probes().step_by(20) {
            let was = contains(&star(), p);
            for direction in [1.0, -1.0] {
                let turn =
                    |angle: f64| axis + (rotate(Point::from(p - axis), angle) - Point::origin());
                let step = 1e-3;
                let sampled = (1..300)
                    .map(|i| f64::from(i) * step)
                    .find(|&angle| contains(&star(), turn(direction * angle)) != was);
                let met = index.first_crossing(p, axis, direction, 300.0 * step);
                if let Some(angle) = sampled {
                    let met = met.expect("a crossing that sampling saw");
                    assert!(direction * met.angle <= angle + 1e-9);
                    assert_eq!(met.entering, (direction > 0.0) != was);
                    assert!((turn(met.angle) - met.at).norm() < 1e-9);
                }
                if let Some(met) = met {
                    let middle = 0.5 * met.angle;
                    assert_eq!(contains(&star(), turn(middle)), was);
                }
            }
        }
    }
}
