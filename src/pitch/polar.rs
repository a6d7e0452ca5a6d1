//! A shape as a gear sees it: radius over direction about an axis.

use std::f64::consts::TAU;

use super::{Transmission, TransmissionError};
use crate::geometry::{Point, Vector, cross};
use crate::policy;

/// Radius r(theta) of a closed curve about a centre, at `n` even directions from theta = 0, counter-clockwise.
///
/// Where a ray crosses the curve several times the outermost crossing counts;
/// [`Self::lost_area`] tells how much that fills in.
#[derive(Clone, Debug)]
pub struct PolarCurve {
    radii: Vec<f64>,
    lost_area: f64,
}

/// Why a shape has no polar curve about a centre, or a polar curve no mate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PolarError {
    /// Some ray from the centre meets nothing, or the curve runs through the centre.
    #[error("the centre ({x:.4}, {y:.4}) does not lie inside the shape; move it inwards")]
    CenterOutside {
        /// Centre, in the units of the shape.
        x: f64,
        /// Centre, in the units of the shape.
        y: f64,
    },
    /// Fewer directions than a transmission needs.
    #[error("{count} directions are too few; take at least {least}")]
    TooFewDirections {
        /// Directions asked for.
        count: usize,
        /// Directions needed.
        least: usize,
    },
    /// The mating motion is not a transmission.
    #[error(transparent)]
    Transmission(#[from] TransmissionError),
}

impl PolarCurve {
    /// Looks from `center` at the counter-clockwise polygon `points` in `n` directions.
    ///
    /// O(n + vertices) for a star-shaped polygon: each edge visits only the directions it spans.
    ///
    /// # Errors
    /// [`PolarError::CenterOutside`], [`PolarError::TooFewDirections`].
    pub fn about(points: &[Point], center: Point, n: usize) -> Result<Self, PolarError> {
        let least = policy::MIN_TRANSMISSION_SAMPLES;
        if n < least {
            return Err(PolarError::TooFewDirections { count: n, least });
        }
        let directions: Vec<Vector> = (0..n)
            .map(|i| {
                let (s, c) = (TAU * i as f64 / n as f64).sin_cos();
                Vector::new(c, s)
            })
            .collect();
        Self::along(points, center, &directions)
    }

    /// [`Self::about`] with the `n` unit directions given, for callers that look from many centres.
    pub(crate) fn along(
        points: &[Point],
        center: Point,
        directions: &[Vector],
    ) -> Result<Self, PolarError> {
        let outside = PolarError::CenterOutside { x: center.x, y: center.y };
        let n = directions.len();
        let per_radian = n as f64 / TAU;
        let mut radii = vec![0.0_f64; n];
        // Squares of all crossings, those that leave the shape minus those that enter it: twice the shape's own area per radian.
        let mut squares = vec![0.0_f64; n];
        let half = 0.5 * n as f64;
        let mut winding = 0.0;
        let Some(&last) = points.last() else {
            return Err(outside);
        };
        let mut a = last - center;
        let mut a_at = a.y.atan2(a.x) * per_radian;
        for p in points {
            let b = p - center;
            let b_at = b.y.atan2(b.x) * per_radian;
            let mut turn = b_at - a_at;
            if turn > half {
                turn -= n as f64;
            } else if turn < -half {
                turn += n as f64;
            }
            winding += turn;
            // Directions in the half-open span from the lesser to the greater end.
            let (low, high) = if turn >= 0.0 { (a_at, a_at + turn) } else { (a_at + turn, a_at) };
            let edge = b - a;
            let across = cross(a, edge);
            for k in (low.ceil() as i64)..(high.ceil() as i64) {
                let i = k.rem_euclid(n as i64) as usize;
                let r = across / cross(directions[i], edge);
                if r.is_finite() && r > 0.0 {
                    radii[i] = radii[i].max(r);
                    squares[i] += if turn >= 0.0 { r * r } else { -r * r };
                }
            }
            (a, a_at) = (b, b_at);
        }
        let own: f64 = squares.iter().sum();
        let seen: f64 = radii.iter().map(|r| r * r).sum();
        let longest = radii.iter().copied().fold(0.0, f64::max);
        let clear = radii.iter().all(|r| *r > policy::MIN_RELATIVE_RADIUS * longest);
        // The curve goes once round a centre inside it, and not at all round one outside.
        if !(clear && winding > half && own > 0.0 && seen.is_finite()) {
            return Err(outside);
        }
        let lost = (seen - own) / own;
        let lost_area = if lost > policy::STAR_SHAPED_WITHIN { lost } else { 0.0 };
        Ok(Self { radii, lost_area })
    }

    /// Takes radii at even directions from theta = 0, counter-clockwise.
    ///
    /// # Errors
    /// [`PolarError::TooFewDirections`]; [`PolarError::CenterOutside`] for a radius that is not positive and finite.
    pub fn from_radii(radii: Vec<f64>) -> Result<Self, PolarError> {
        let least = policy::MIN_TRANSMISSION_SAMPLES;
        if radii.len() < least {
            return Err(PolarError::TooFewDirections { count: radii.len(), least });
        }
        if radii.iter().any(|r| !(*r > 0.0 && r.is_finite())) {
            return Err(PolarError::CenterOutside { x: 0.0, y: 0.0 });
        }
        Ok(Self { radii, lost_area: 0.0 })
    }

    /// Radii at even directions from theta = 0, counter-clockwise.
    #[must_use]
    pub fn radii(&self) -> &[f64] {
        &self.radii
    }

    /// Area between the outermost crossings and the shape itself, over the shape's area; 0 for a shape that is
    /// star-shaped about the centre.
    #[must_use]
    pub fn lost_area(&self) -> f64 {
        self.lost_area
    }

    /// The centre distance at which this curve, as the driver, makes its mate turn `1 / ratio` as far per turn (Eq. 9).
    #[must_use]
    pub fn center_distance(&self, ratio: f64) -> f64 {
        center_distance(&self.radii, ratio)
    }
}

/// Solves Eq. 9, `mean(r / (L - r)) = 1 / ratio`, for L to machine precision.
///
/// `1 / mean(r / (L - r))` is a harmonic mean of rising lines, hence rising and
/// concave in L: Newton's steps from the left climb to the root and never pass it.
/// Two left bounds are known: `(ratio + 1) mean(r)` (Jensen) and the pole of the
/// greatest radius alone; `(ratio + 1) max(r)` bounds it from the right.
pub(crate) fn center_distance(radii: &[f64], ratio: f64) -> f64 {
    let n = radii.len() as f64;
    let mean = radii.iter().sum::<f64>() / n;
    let longest = radii.iter().copied().fold(0.0, f64::max);
    let high = (ratio + 1.0) * longest;
    let mut l = ((ratio + 1.0) * mean).max(longest * (1.0 + ratio / n)).min(high);
    for _ in 0..policy::MAX_NEWTON_STEPS {
        let (mut sum, mut slope) = (0.0, 0.0);
        for r in radii {
            let inverse = 1.0 / (l - r);
            sum += r * inverse;
            slope += r * inverse * inverse;
        }
        // g = n / sum - ratio, g' = n slope / sum^2.
        let next = (l - (n - ratio * sum) * sum / (n * slope)).min(high);
        if next.is_nan() || next - l <= f64::EPSILON * l {
            return l;
        }
        l = next;
    }
    l
}

impl Transmission {
    /// The motion a shape imposes as the driver: psi' = r / (L - r), closed by Eq. 9 for `follower_fold` = K
    /// (a follower K times as long, K-fold symmetric). Starts with the direction theta = 0 at the pitch point.
    ///
    /// # Errors
    /// [`PolarError::Transmission`] when r is too rough for a positive spline: smooth it or take more directions.
    pub fn from_polar(curve: &PolarCurve, follower_fold: u32) -> Result<Self, PolarError> {
        let l = curve.center_distance(f64::from(follower_fold.max(1)));
        Ok(Self::from_derivative(&driver_law(&curve.radii, l), 1, follower_fold)?)
    }

    /// The motion a shape imposes as the follower of a driver that is `driver_fold`-fold symmetric: Eq. 9 with
    /// the roles changed, inverted. Starts with the direction theta = 0 of the follower at the pitch point.
    ///
    /// # Errors
    /// As [`Self::from_polar`].
    pub fn from_follower(curve: &PolarCurve, driver_fold: u32) -> Result<Self, PolarError> {
        let l = curve.center_distance(f64::from(driver_fold.max(1)));
        let law = follower_law(&curve.radii, l);
        Ok(Self::from_derivative(&law, 1, driver_fold)?.reversed()?)
    }
}

/// psi' of a driver with these radii: its pitch point moves clockwise through its own directions.
pub(crate) fn driver_law(radii: &[f64], center_distance: f64) -> Vec<f64> {
    let n = radii.len();
    (0..n)
        .map(|i| {
            let r = radii[(n - i) % n];
            r / (center_distance - r)
        })
        .collect()
}

/// d phi_D / d phi_F of a follower with these radii: its pitch point moves counter-clockwise through its own directions.
pub(crate) fn follower_law(radii: &[f64], center_distance: f64) -> Vec<f64> {
    radii.iter().map(|r| r / (center_distance - r)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry;
    use crate::pitch::Centrodes;

    fn polar(n: usize, r: impl Fn(f64) -> f64) -> PolarCurve {
        PolarCurve::from_radii((0..n).map(|i| r(TAU * i as f64 / n as f64)).collect()).unwrap()
    }

    fn polygon(n: usize, r: impl Fn(f64) -> f64) -> Vec<Point> {
        (0..n)
            .map(|i| {
                let theta = TAU * i as f64 / n as f64;
                geometry::rotate(Point::new(r(theta), 0.0), theta)
            })
            .collect()
    }

    fn square() -> Vec<Point> {
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| Point::new(x, y)).to_vec()
    }

    #[test]
    fn a_square_seen_from_inside() {
        for center in [Point::origin(), Point::new(0.3, -0.55)] {
            let curve = PolarCurve::about(&square(), center, 97).unwrap();
            for (i, r) in curve.radii().iter().enumerate() {
                let p =
                    center + geometry::rotate(Point::new(*r, 0.0), TAU * i as f64 / 97.0).coords;
                assert!((p.x.abs().max(p.y.abs()) - 1.0).abs() < 1e-12);
            }
            assert_eq!(curve.lost_area(), 0.0);
        }
        let out = PolarCurve::about(&square(), Point::new(1.5, 0.0), 64);
        assert!(matches!(out, Err(PolarError::CenterOutside { .. })));
        assert!(PolarCurve::about(&square(), Point::new(1.0, 0.0), 64).is_err());
        // A point in the bay of a spiral is walled in on every side, yet outside.
        let arm = |r: f64, k: i32| geometry::rotate(Point::new(r, 0.0), 0.1 * f64::from(k));
        let spiral: Vec<Point> = (0..70)
            .map(|k| arm(3.0 + 0.02 * f64::from(k), k))
            .chain((0..70).rev().map(|k| arm(2.0 + 0.02 * f64::from(k), k)))
            .collect();
        assert!(PolarCurve::about(&spiral, Point::origin(), 64).is_err());
    }

    #[test]
    fn a_bay_is_filled_and_measured() {
        // A C of outer half width 2 whose bay opens upwards beside the axis: from the axis in its left
        // lower corner the bay's far wall is seen through the near one.
        let c = [
            (0.0, 0.0),
            (4.0, 0.0),
            (4.0, 4.0),
            (3.0, 4.0),
            (3.0, 1.0),
            (1.0, 1.0),
            (1.0, 4.0),
            (0.0, 4.0),
        ]
        .map(|(x, y)| Point::new(x, y));
        let curve = PolarCurve::about(&c, Point::new(0.5, 0.5), 4096).unwrap();
        let seen: Vec<Point> = (0..4096)
            .map(|i| geometry::rotate(Point::new(curve.radii()[i], 0.0), TAU * i as f64 / 4096.0))
            .collect();
        let lost = geometry::area(&seen) / geometry::area(&c) - 1.0;
        assert!(
            lost > 0.3 && (curve.lost_area() - lost).abs() < 5e-3,
            "{lost} {}",
            curve.lost_area()
        );
    }

    #[test]
    fn circles_mate_with_circles() {
        let curve = PolarCurve::about(&polygon(4096, |_| 3.0), Point::origin(), 256).unwrap();
        assert!((curve.center_distance(4.0) - 15.0).abs() < 1e-4);
        assert!((polar(64, |_| 3.0).center_distance(0.25) - 3.75).abs() < 1e-14);
    }

    #[test]
    fn an_ellipse_about_its_focus_mates_with_its_twin() {
        for e in [0.2, 0.6, 0.8] {
            let r = |theta: f64| (1.0 - e * e) / (1.0 + e * theta.cos());
            let curve = polar(1024, r);
            assert!((curve.center_distance(1.0) - 2.0).abs() < 1e-12);
            let t = Transmission::from_polar(&curve, 1).unwrap();
            for k in 1..31 {
                // tan(psi / 2) = (1 + e) / (1 - e) tan(phi / 2), measured from the far ends.
                let phi = 0.1 * f64::from(k);
                let psi = 2.0 * ((1.0 - e) / (1.0 + e) * (0.5 * phi).tan()).atan();
                assert!((t.psi(phi) - psi).abs() < 1e-7, "{e} {phi} {} {psi}", t.psi(phi));
            }
        }
    }

    #[test]
    fn conic_lobes_mate_with_their_kind() {
        for (lobes, e, ratio) in [(2.0, 0.3, 1.0), (3.0, 0.2, 2.0), (4.0, 0.1, 0.5)] {
            let curve = polar(1024, |theta| 1.0 / (1.0 + e * (lobes * theta).cos()));
            // r / (L - r) = 1 / (L - 1 + L e cos): its mean is 1 / sqrt((L - 1)^2 - L^2 e^2) = 1 / K.
            let (a, k): (f64, f64) = (1.0 - e * e, ratio);
            let exact = (1.0 + (1.0 - a * (1.0 - k * k)).sqrt()) / a;
            assert!((curve.center_distance(ratio) - exact).abs() < 1e-12 * exact);
        }
    }

    #[test]
    fn logarithmic_spiral_lobes_mate_with_their_mirror() {
        // One lobe: r = exp(b |theta|). Equal lobes roll on each other with r1 + r2 = L constant:
        // the greatest radius meets the least.
        let b = 0.25_f64;
        let n = 4096;
        let r = |theta: f64| (b * if theta <= TAU / 2.0 { theta } else { TAU - theta }).exp();
        let curve = polar(n, r);
        let least = 1.0;
        let most = (b * TAU / 2.0).exp();
        let l = curve.center_distance(1.0);
        assert!((l - least - most).abs() < 1e-5, "{l} {}", least + most);
        let t = Transmission::from_polar(&curve, 1).unwrap();
        // On one flank exp(b phi) + exp(b (pi - psi)) = L.
        for k in 1..30 {
            let phi = 0.1 * f64::from(k);
            let psi = TAU / 2.0 - (l - (b * phi).exp()).ln() / b;
            assert!((t.psi(phi) - psi).abs() < 1e-5, "{phi} {} {psi}", t.psi(phi));
        }
    }

    #[test]
    fn the_mate_of_the_mate_is_the_gear() {
        let r = |theta: f64| 1.0 + 0.3 * (theta + 0.4).cos() + 0.1 * (2.0 * theta).sin();
        for k in [1, 3] {
            let curve = polar(2048, r);
            let l = curve.center_distance(f64::from(k));
            let pair = Centrodes {
                transmission: Transmission::from_polar(&curve, k).unwrap(),
                center_distance: l,
            };
            assert!((pair.transmission.psi(TAU) - TAU / f64::from(k)).abs() < 1e-9);
            // Radius of the mate over its own direction, measured from where theta = 0 met it.
            let n = 2048;
            let mate: Vec<f64> = (0..n)
                .map(|i| pair.follower_radius(pair.transmission.inverse(TAU * i as f64 / n as f64)))
                .collect();
            let mate = PolarCurve::from_radii(mate).unwrap();
            assert!((mate.center_distance(1.0 / f64::from(k)) / l - 1.0).abs() < 1e-9);
            if k == 1 {
                let back = Transmission::from_follower(&mate, 1).unwrap();
                for j in 0..40 {
                    let phi = 0.17 * f64::from(j);
                    assert!((back.psi(phi) - pair.transmission.psi(phi)).abs() < 1e-8);
                }
            }
        }
    }
}
