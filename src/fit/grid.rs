//! Centres from which a shape is looked at.

use crate::geometry::{self, Point};

/// Centres of the dense grid in each shape: 225 squared is above 50,000 pairs.
pub(super) const GRID_CENTERS: usize = 225;
/// Tries at a spacing that puts enough grid points inside a thin shape.
const ATTEMPTS: usize = 40;
/// Factor on the spacing from one try to the next.
const SHRINK: f64 = 0.97;
/// Most cells of the grid that looks for centres in a thin shape.
const CELLS_MOST: f64 = 100_000.0;
/// Vertices of an outline in scans and first refinements; finer detail does not move a centre.
const VERTICES: usize = 512;

/// At least `count` points of a square grid inside the polygon, and the grid's spacing.
pub(super) fn interior_grid(points: &[Point], count: usize) -> (Vec<Point>, f64) {
    let (low, high) = geometry::bounds(points);
    let size = high - low;
    let mut spacing = (geometry::area(points) / count as f64).sqrt();
    let finest = (size.x * size.y / CELLS_MOST).sqrt();
    let mut grid = Vec::new();
    for _ in 0..ATTEMPTS {
        spacing = spacing.max(finest);
        let (nx, ny) = ((size.x / spacing).ceil().max(1.0), (size.y / spacing).ceil().max(1.0));
        let (dx, dy) = (size.x / nx, size.y / ny);
        grid = (0..(nx * ny) as usize)
            .map(|k| {
                let (i, j) = ((k % nx as usize) as f64, (k / nx as usize) as f64);
                Point::new(low.x + (i + 0.5) * dx, low.y + (j + 0.5) * dy)
            })
            .filter(|p| geometry::contains(points, *p))
            .collect();
        if grid.len() >= count || spacing <= finest {
            break;
        }
        spacing *= SHRINK;
    }
    (grid, spacing)
}

/// At most [`VERTICES`] of the vertices, evenly taken.
pub(super) fn thinned(points: &[Point]) -> Vec<Point> {
    let stride = points.len().div_ceil(VERTICES);
    points.iter().copied().step_by(stride.max(1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_is_full_and_inside() {
        let star: Vec<Point> = (0..10)
            .map(|i| {
                let r = if i % 2 == 0 { 1.0 } else { 0.4 };
                geometry::rotate(Point::new(r, 0.0), std::f64::consts::PI * f64::from(i) / 5.0)
            })
            .collect();
        let (grid, spacing) = interior_grid(&star, GRID_CENTERS);
        assert!(grid.len() >= GRID_CENTERS && grid.len() < 2 * GRID_CENTERS);
        assert!(grid.iter().all(|p| geometry::contains(&star, *p)));
        let covered = grid.len() as f64 * spacing * spacing / geometry::area(&star);
        assert!((covered - 1.0).abs() < 0.2, "{covered}");
    }
}
