//! Pictures that are lit unevenly: the light on the ground, and the picture with that light taken out.

use super::Samples;
use nalgebra::{SMatrix, SVector};

/// Places across and down at which the light is judged.
const GRID: usize = 96;
/// Share of each side that is the picture's rim, where ground is looked for first.
const RIM: f64 = 0.1;
/// Rounds of taking the surface through what lies near it.
const ROUNDS: usize = 8;
/// Stray of the ground from the surface, of 255: noise of photographs, and paper.
const STRAY: f64 = 8.0;
/// Least share of the picture that must be ground.
const LEAST_GROUND: f64 = 0.15;
/// Darkest light, of 255, and over the brightest: below it nothing can be told from the ground.
const DARKEST: (f64, f64) = (16.0, 0.15);
/// The ground of a picture with its light taken out.
const GROUND: f64 = 220.0;

/// Terms of a quadratic surface.
type Terms = SVector<f64, 6>;

fn terms(x: f64, y: f64) -> Terms {
    Terms::from([1.0, x, y, x * x, x * y, y * y])
}

/// The picture as an even light would show it, its ground light, and how much the light varies over it, of 255; nothing where
/// no ground can be found.
///
/// The light is the quadratic surface through the ground, which is what most of the rim is and what lies near the surface.
pub(super) fn evened(grey: &Samples) -> Option<(Samples, f64)> {
    let (width, height) = (grey.width as usize, grey.height as usize);
    let place = |i: usize, n: usize, many: usize| ((2 * i + 1) * n / (2 * many)).min(n - 1);
    let spread = |i: usize, n: usize| (2 * i + 1) as f64 / n as f64 - 1.0;
    let (columns, rows) = (GRID.min(width), GRID.min(height));
    let mut rim = Vec::new();
    let mut all = Vec::with_capacity(columns * rows);
    for (row, column) in (0..rows).flat_map(|r| (0..columns).map(move |c| (r, c))) {
        let (x, y) = (place(column, width, columns), place(row, height, rows));
        let seen = (spread(x, width), spread(y, height), f64::from(grey.values[y * width + x]));
        if seen.0.abs().max(seen.1.abs()) > 1.0 - 2.0 * RIM {
            rim.push(seen);
        }
        all.push(seen);
    }
    // A dark ground is read from the negative.
    let mean = |of: &[(f64, f64, f64)]| of.iter().map(|p| p.2).sum::<f64>() / of.len() as f64;
    let negative = mean(&rim) < mean(&all);
    let value = |v: f64| if negative { 255.0 - v } else { v };
    for seen in rim.iter_mut().chain(all.iter_mut()) {
        seen.2 = value(seen.2);
    }
    let mut ground = rim;
    let mut surface = fitted(&ground)?;
    for round in 0..ROUNDS {
        let from = if round < ROUNDS / 2 { &ground } else { &all };
        let off = |p: &(f64, f64, f64)| (p.2 - surface.dot(&terms(p.0, p.1))).abs();
        let mut strays: Vec<f64> = ground.iter().map(off).collect();
        strays.sort_by(f64::total_cmp);
        let most = (2.5 * strays[strays.len() / 2]).clamp(0.5 * STRAY, 4.0 * STRAY);
        let near: Vec<_> = from.iter().copied().filter(|p| off(p) <= most).collect();
        if near.len() < 2 * Terms::zeros().len() {
            return None;
        }
        surface = fitted(&near)?;
        ground = near;
    }
    let light = |x: usize, y: usize| surface.dot(&terms(spread(x, width), spread(y, height)));
    let lights = all.iter().map(|p| surface.dot(&terms(p.0, p.1)));
    let (low, high) = lights.fold((f64::INFINITY, 0.0_f64), |(l, h), v| (l.min(v), h.max(v)));
    if (ground.len() as f64) < LEAST_GROUND * all.len() as f64
        || low < DARKEST.0.max(DARKEST.1 * high)
    {
        return None;
    }
    let mut values = Vec::with_capacity(grey.values.len());
    for (y, row) in grey.values.chunks_exact(width).enumerate() {
        let even =
            |(x, &v): (usize, &u8)| (GROUND * value(f64::from(v)) / light(x, y)).round() as u8;
        values.extend(row.iter().enumerate().map(even));
    }
    Some((Samples { values, width: grey.width, height: grey.height }, high - low))
}

/// The quadratic surface through samples by least squares.
fn fitted(samples: &[(f64, f64, f64)]) -> Option<Terms> {
    let mut normal = SMatrix::<f64, 6, 6>::identity() * 1e-9;
    let mut right = Terms::zeros();
    for &(x, y, value) in samples {
        let row = terms(x, y);
        normal += row * row.transpose();
        right += row * value;
    }
    normal.cholesky().map(|c| c.solve(&right)).filter(|s| s.iter().all(|v| v.is_finite()))
}
