//! A drawing as a smooth field: how much of it lies at a point, and the integral of that along x.
//!
//! The area a curve shares with the drawing is then a line integral along the curve (Green), with a gradient that is
//! continuous and holds for any drawing, star-shaped about the axis or not.

use crate::geometry::{self, Point};

/// Cells of the field of a drawing along the longer side of its box: a cell is a quarter of a tooth of a common gear.
const CELLS: usize = 160;
/// Empty cells round the drawing: the widest blur reaches no further.
const MARGIN: usize = 24;
/// Lines of a cell on which the drawing's cover is measured; along a line it is exact.
const LINES: usize = 4;
/// Standard deviations at which a blur is cut off: what is left out is below 1e-4.
const BLUR_REACH: f64 = 3.7;

/// The indicator of a polygon of area 1, blurred, on a square grid of spline coefficients.
#[derive(Clone, Debug)]
pub(super) struct Field {
    low: Point,
    cell: f64,
    columns: usize,
    rows: usize,
    /// Running sums along each row, times the cell.
    sums: Vec<f64>,
}

/// Share of each cell that the polygon covers.
#[derive(Clone, Debug)]
pub(super) struct Raster {
    low: Point,
    cell: f64,
    columns: usize,
    rows: usize,
    covered: Vec<f64>,
}

impl Raster {
    /// Draws a polygon; the longer side of its box takes [`CELLS`] cells.
    pub(super) fn new(points: &[Point]) -> Self {
        let (low, high) = geometry::bounds(points);
        let size = high - low;
        let cell = size.max() / CELLS as f64;
        let margin = MARGIN;
        let count = |length: f64| (length / cell).ceil() as usize + 2 * margin;
        let (columns, rows) = (count(size.x), count(size.y));
        let low = Point::new(low.x - margin as f64 * cell, low.y - margin as f64 * cell);
        let lines = LINES;
        let mut crossings: Vec<Vec<f64>> = vec![Vec::new(); rows * lines];
        let line = cell / lines as f64;
        for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
            let at = |y: f64| (y - low.y) / line - 0.5;
            let (first, last) = (at(a.y.min(b.y)).ceil().max(0.0), at(a.y.max(b.y)).ceil());
            for k in first as usize..(last.max(0.0) as usize).min(crossings.len()) {
                let y = low.y + (k as f64 + 0.5) * line;
                let t = (y - a.y) / (b.y - a.y);
                crossings[k].push((a.x + t * (b.x - a.x) - low.x) / cell);
            }
        }
        let mut covered = vec![0.0; columns * rows];
        for (k, line) in crossings.iter_mut().enumerate() {
            line.sort_by(f64::total_cmp);
            let row = &mut covered[k / lines * columns..][..columns];
            for pair in line.chunks_exact(2) {
                let (from, to) = (pair[0], pair[1]);
                let (first, last) = (from as usize, (to as usize).min(columns - 1));
                for (i, cell) in row.iter_mut().enumerate().take(last + 1).skip(first) {
                    let shared = (to.min(i as f64 + 1.0) - from.max(i as f64)).max(0.0);
                    *cell += shared / lines as f64;
                }
            }
        }
        Self { low, cell, columns, rows, covered }
    }

    /// The field under a Gaussian of standard deviation `blur` cells (0 for none), scaled to the integral 1.
    pub(super) fn field(&self, blur: f64) -> Field {
        let (columns, rows) = (self.columns, self.rows);
        let mut values = self.covered.clone();
        if blur > 0.0 {
            let reach = (BLUR_REACH * blur).ceil() as usize;
            let kernel: Vec<f64> =
                (0..=reach).map(|k| (-0.5 * (k as f64 / blur).powi(2)).exp()).collect();
            values = blurred(&values, columns, rows, &kernel);
            values = blurred(&transposed(&values, columns, rows), rows, columns, &kernel);
            values = transposed(&values, rows, columns);
        }
        let total = values.iter().sum::<f64>() * self.cell * self.cell;
        for row in values.chunks_exact_mut(columns) {
            let mut sum = 0.0;
            for v in row {
                sum += *v * self.cell / total;
                *v = sum;
            }
        }
        // Coefficients sit in the middle of their cells.
        let half = 0.5 * self.cell;
        let low = Point::new(self.low.x + half, self.low.y + half);
        Field { low, cell: self.cell, columns, rows, sums: values }
    }
}

impl Field {
    /// The integral of the field along y = p.y from the left up to p, and its derivatives by x (the field itself) and y.
    pub(super) fn at(&self, p: Point) -> [f64; 3] {
        let (u, v) = ((p.x - self.low.x) / self.cell - 0.5, (p.y - self.low.y) / self.cell);
        let (i, j) = (u.floor(), v.floor());
        if !(j > -4.0 && j < self.rows as f64 + 4.0 && i > -4.0) {
            return [0.0; 3];
        }
        let (wx, dx) = weights(u - i);
        let (wy, dy) = weights(v - j);
        let i = i.min(self.columns as f64 + 4.0) as i64;
        let mut out = [0.0; 3];
        for b in 0..4 {
            let row = j as i64 + b as i64 - 1;
            if row < 0 || row >= self.rows as i64 {
                continue;
            }
            let row = &self.sums[row as usize * self.columns..][..self.columns];
            let (mut value, mut slope) = (0.0, 0.0);
            for a in 0..4 {
                let column = i + a as i64 - 1;
                if column < 0 {
                    continue;
                }
                let sum = row[(column as usize).min(self.columns - 1)];
                value += wx[a] * sum;
                slope += dx[a] * sum;
            }
            out[0] += wy[b] * value;
            out[1] += wy[b] * slope;
            out[2] += dy[b] * value;
        }
        [out[0], out[1] / self.cell, out[2] / self.cell]
    }
}

/// The four cubic B-splines that reach position t of an interval, and their slopes.
fn weights(t: f64) -> ([f64; 4], [f64; 4]) {
    let s = 1.0 - t;
    let (t2, t3) = (t * t, t * t * t);
    (
        [
            s * s * s / 6.0,
            (3.0 * t3 - 6.0 * t2 + 4.0) / 6.0,
            (-3.0 * t3 + 3.0 * t2 + 3.0 * t + 1.0) / 6.0,
            t3 / 6.0,
        ],
        [-0.5 * s * s, 1.5 * t2 - 2.0 * t, -1.5 * t2 + t + 0.5, 0.5 * t2],
    )
}

/// Rows under a symmetric kernel given by its middle and right half; beyond the grid all is 0.
fn blurred(values: &[f64], columns: usize, rows: usize, kernel: &[f64]) -> Vec<f64> {
    let total = kernel[0] + 2.0 * kernel[1..].iter().sum::<f64>();
    let mut out = vec![0.0; values.len()];
    for (from, to) in values.chunks_exact(columns).zip(out.chunks_exact_mut(columns)).take(rows) {
        for (i, v) in from.iter().enumerate().filter(|(_, v)| **v != 0.0) {
            let v = v / total;
            to[i] += v * kernel[0];
            for (k, w) in kernel.iter().enumerate().skip(1) {
                if i >= k {
                    to[i - k] += v * w;
                }
                if i + k < columns {
                    to[i + k] += v * w;
                }
            }
        }
    }
    out
}

fn transposed(values: &[f64], columns: usize, rows: usize) -> Vec<f64> {
    (0..columns * rows).map(|k| values[k % rows * columns + k / rows]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn square() -> Vec<Point> {
        [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)].map(|(x, y)| Point::new(x, y)).to_vec()
    }

    fn shared_with_disc(field: &Field, center: Point, r: f64) -> f64 {
        let n = 2000;
        let at = |i: usize| {
            let (s, c) = (TAU * i as f64 / n as f64).sin_cos();
            Point::new(center.x + r * c, center.y + r * s)
        };
        (0..n).map(|i| field.at(at(i))[0] * 0.5 * (at(i + 1).y - at(i + n - 1).y)).sum()
    }

    #[test]
    fn line_integrals_give_shared_areas() {
        let raster = Raster::new(&square());
        for (blur, slack) in [(0.0, 5e-4), (2.0, 1e-3)] {
            let field = raster.field(blur);
            let inside = shared_with_disc(&field, Point::new(0.1, 0.0), 0.3);
            assert!((inside - 0.09 * TAU / 2.0).abs() < slack, "{inside}");
            let about = shared_with_disc(&field, Point::new(0.1, 0.2), 3.0);
            assert!((about - 1.0).abs() < slack, "{about}");
            let half = shared_with_disc(&field, Point::new(0.5, 0.1), 0.3);
            assert!((half - 0.045 * TAU / 2.0).abs() < 10.0 * slack, "{half}");
        }
    }

    #[test]
    fn slopes_are_those_of_the_values() {
        let field = Raster::new(&square()).field(3.0);
        let h = 1e-6;
        for (x, y) in [(0.49, 0.2), (-0.5, -0.51), (0.0, 0.48), (0.9, 0.1), (3.0, 0.3), (0.51, 0.5)]
        {
            let value = |dx: f64, dy: f64| field.at(Point::new(x + dx, y + dy))[0];
            let [_, dx, dy] = field.at(Point::new(x, y));
            assert!((dx - (value(h, 0.0) - value(-h, 0.0)) / (2.0 * h)).abs() < 1e-6);
            assert!((dy - (value(0.0, h) - value(0.0, -h)) / (2.0 * h)).abs() < 1e-6);
        }
    }
}
