//! Even sampling along the boundary and periodic cubic smoothing.

use super::Outline;
use crate::geometry::{self, Point};
use crate::policy;
use realfft::RealFftPlanner;
use std::f64::consts::TAU;

/// How strongly a drawing is smoothed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Smoothing {
    /// Radius [`policy::SMOOTH_RADIUS_AUTO`] of the perimeter, less where the shape would lose
    /// thin parts ([`policy::SMOOTH_LIKENESS`]).
    #[default]
    Auto,
    /// Strength from 0 (the drawing as it is) to 1 (radius [`policy::SMOOTH_RADIUS_FULL`] of
    /// the perimeter: only the coarsest form remains). Values outside count as the nearer end.
    Fixed(f64),
}

/// `count` points at equal distances along the boundary, counter-clockwise, the first on the
/// first vertex. Corners between samples are cut.
#[must_use]
pub fn resample(outline: &Outline, count: usize) -> Vec<Point> {
    let points = outline.points();
    let step = geometry::perimeter(points) / count as f64;
    let mut samples = Vec::with_capacity(count);
    let mut walked = 0.0;
    for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
        let length = (b - a).norm();
        while samples.len() < count {
            let along = samples.len() as f64 * step - walked;
            if along >= length {
                break;
            }
            samples.push(a + (b - a) * (along / length));
        }
        walked += length;
    }
    samples.resize(count, points[0]);
    samples
}

/// The outline under a periodic cubic smoothing spline, as `samples` evenly spaced vertices.
///
/// The spline minimises, over all periodic curves, the squared distance to even samples of the
/// boundary plus rho^4 times its squared second derivative, so that a wave of wavelength
/// 2 pi rho is halved, longer ones stay and shorter ones vanish with the fourth power. As the
/// samples are even the system is circulant and is solved exactly by one Fourier transform.
///
/// The strength is lowered until the result is simple and, if automatic, keeps its likeness.
/// At strength 0, or if nothing helps, the outline is returned as it is.
#[must_use]
pub fn smooth(outline: &Outline, smoothing: Smoothing, samples: usize) -> Outline {
    let (mut radius, likeness) = match smoothing {
        Smoothing::Auto => (policy::SMOOTH_RADIUS_AUTO, policy::SMOOTH_LIKENESS),
        Smoothing::Fixed(strength) if strength > 0.0 => {
            (strength.min(1.0) * policy::SMOOTH_RADIUS_FULL, 0.0)
        }
        Smoothing::Fixed(_) => return outline.clone(),
    };
    let fine = resample(outline, samples * policy::SMOOTH_OVERSAMPLING);
    let (weaken, tries) = policy::SMOOTH_WEAKENING;
    for _ in 0..tries {
        let curve = Outline::new(spline(&fine, radius * fine.len() as f64));
        let even = curve.and_then(|curve| Outline::new(resample(&curve, samples)));
        if let Ok(smoothed) = even
            && geometry::intersection_over_union(smoothed.points(), outline.points()) >= likeness
        {
            return smoothed;
        }
        radius *= weaken;
    }
    outline.clone()
}

/// Values at the knots of the smoothing spline through even samples; `radius` in sample steps.
fn spline(points: &[Point], radius: f64) -> Vec<Point> {
    let x = spline_values(points.iter().map(|p| p.x).collect(), radius);
    let y = spline_values(points.iter().map(|p| p.y).collect(), radius);
    x.into_iter().zip(y).map(|(x, y)| Point::new(x, y)).collect()
}

fn spline_values(mut values: Vec<f64>, radius: f64) -> Vec<f64> {
    let n = values.len();
    let mut planner = RealFftPlanner::new();
    let (forward, inverse) = (planner.plan_fft_forward(n), planner.plan_fft_inverse(n));
    let mut spectrum = forward.make_output_vec();
    // The transforms fail only on buffers of the wrong length or a constant with an imaginary
    // part; neither can come from a real transform of the same length.
    if forward.process(&mut values, &mut spectrum).is_err() {
        return values;
    }
    let weight = radius.powi(4);
    for (k, value) in spectrum.iter_mut().enumerate() {
        let cos = (TAU * k as f64 / n as f64).cos();
        let second_difference = 2.0 - 2.0 * cos;
        let knot_weight = (2.0 + cos) / 3.0;
        *value /= n as f64 * (1.0 + weight * second_difference * second_difference / knot_weight);
    }
    if inverse.process(&mut spectrum, &mut values).is_err() {
        values.fill(0.0);
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::rotate;

    fn polar(n: usize, radius: impl Fn(f64) -> f64) -> Outline {
        let at = |i: usize| {
            let angle = TAU * i as f64 / n as f64;
            rotate(Point::new(radius(angle), 0.0), angle)
        };
        Outline::new((0..n).map(at).collect()).unwrap()
    }

    fn square() -> Outline {
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        Outline::new(corners.map(|(x, y)| Point::new(x, y)).to_vec()).unwrap()
    }

    #[test]
    fn samples_are_even_along_the_boundary() {
        let samples = resample(&square(), 8);
        for (i, p) in samples.iter().enumerate() {
            let next = samples[(i + 1) % 8];
            assert!(((next - p).norm() - 0.5).abs() < 1e-12, "{samples:?}");
        }
    }

    #[test]
    fn a_wave_at_the_radius_is_halved() {
        // On n even samples, wave number k and radius n / (2 pi k) make the factor 1/2.
        let (n, k) = (4096, 32);
        let wave = (0..n).map(|i| (TAU * (k * i) as f64 / n as f64).sin()).collect::<Vec<_>>();
        let halved = spline_values(wave.clone(), n as f64 / (TAU * k as f64));
        for (a, b) in wave.iter().zip(halved) {
            assert!((0.5 * a - b).abs() < 1e-5, "{a} {b}");
        }
    }

    #[test]
    fn the_spline_solves_the_smoothing_equations() {
        // Natural system of a smoothing spline: g + w Q c = y and R c = Q' g, both circulant,
        // with R = (1, 4, 1) / 6 and Q the second difference.
        let n = 64;
        let y: Vec<f64> = (0..n).map(|i| f64::from((i * i * 7) % 23)).collect();
        let radius: f64 = 1.7;
        let g = spline_values(y.clone(), radius);
        let n = n as usize;
        let bent = |v: &[f64], i: usize| v[(i + 1) % n] - 2.0 * v[i] + v[(i + n - 1) % n];
        let tries: Vec<f64> = (0..n).map(|i| (y[i] - g[i]) / radius.powi(4)).collect();
        for i in 0..n {
            // Q c = tries and R c = Q' g give R tries = Q Q' g.
            let left = (tries[(i + 1) % n] + 4.0 * tries[i] + tries[(i + n - 1) % n]) / 6.0;
            let fourth: Vec<f64> = (0..n).map(|j| bent(&g, j)).collect();
            assert!((left - bent(&fourth, i)).abs() < 1e-9);
        }
    }

    #[test]
    fn a_circle_stays_and_noise_goes() {
        let circle = polar(2048, |_| 1.0);
        let smoothed = smooth(&circle, Smoothing::Auto, 1024);
        assert_eq!(smoothed.points().len(), 1024);
        let off = |o: &Outline| {
            o.points().iter().map(|p| (p.coords.norm() - 1.0).abs()).fold(0.0, f64::max)
        };
        assert!(off(&smoothed) < 1e-4, "{}", off(&smoothed));
        let noisy = polar(2048, |angle| 1.0 + 0.004 * (150.0 * angle).sin());
        assert!(off(&smooth(&noisy, Smoothing::Auto, 1024)) < 2e-4);
    }

    #[test]
    fn strength_is_monotone_and_zero_changes_nothing() {
        assert_eq!(smooth(&square(), Smoothing::Fixed(0.0), 512), square());
        assert_eq!(smooth(&square(), Smoothing::Fixed(f64::NAN), 512), square());
        let likeness = |strength: f64| {
            let smoothed = smooth(&square(), Smoothing::Fixed(strength), 512);
            geometry::intersection_over_union(smoothed.points(), square().points())
        };
        let grades: Vec<f64> = [0.02, 0.1, 0.5, 1.0].map(likeness).to_vec();
        assert!(grades.windows(2).all(|w| w[0] > w[1]), "{grades:?}");
        assert!(grades[1] > 0.985 && grades[3] < 0.97, "{grades:?}");
    }

    #[test]
    fn thin_parts_weaken_automatic_smoothing() {
        // A star whose arms taper to points.
        let star = polar(4096, |angle| 0.15 + (0.5 + 0.5 * (7.0 * angle).cos()).powi(6));
        let smoothed = smooth(&star, Smoothing::Auto, 2048);
        let kept = geometry::intersection_over_union(smoothed.points(), star.points());
        assert!(kept >= policy::SMOOTH_LIKENESS, "{kept}");
    }
}
