//! How far two pairs differ, as things in the hand.

use std::f64::consts::TAU;

use super::Fit;
use crate::pitch::Centrodes;

/// Directions in which pitch curves are compared.
const DIRECTIONS: usize = 256;

/// Both pitch curves of a pair as squared radii at even directions.
pub(super) struct Outlined([Vec<f64>; 2]);

impl Outlined {
    pub(super) fn new(fit: &Fit) -> Self {
        let transmission = fit.transmission.clone();
        let pair = Centrodes { transmission, center_distance: 1.0 };
        let angles = (0..DIRECTIONS).map(|i| TAU * i as f64 / DIRECTIONS as f64);
        let driver = angles.clone().map(|a| pair.driver_radius(-a).powi(2));
        let follower = angles.map(|a| pair.follower_radius(pair.transmission.inverse(a)).powi(2));
        Self([driver.collect(), follower.collect()])
    }

    /// See [`difference`].
    pub(super) fn apart(&self, other: &Self) -> f64 {
        let alike = |gear: usize| alike(&self.0[gear], &other.0[gear]);
        1.0 - 0.5 * (alike(0) + alike(1))
    }
}

/// How far the gears of two pairs differ, 0 to 1: the mean over both gears of one minus intersection over union of their pitch
/// curves, at one centre distance, each laid over the other about its axis at the turn where they share most.
///
/// Pairs whose axes are mirror images in a symmetric drawing, or turned by its symmetry, are the same gears and differ by 0.
/// An axis moved by a tenth of a drawing's width makes about 0.1.
#[must_use]
pub fn difference(a: &Fit, b: &Fit) -> f64 {
    Outlined::new(a).apart(&Outlined::new(b))
}

/// Greatest intersection over union of two star-shaped curves, one turned about the common centre.
fn alike(a: &[f64], b: &[f64]) -> f64 {
    let n = a.len();
    let total: f64 = a.iter().chain(b).sum();
    let twice: Vec<f64> = b.iter().chain(b).copied().collect();
    let shared = (0..n)
        .map(|k| a.iter().zip(&twice[k..]).map(|(x, y)| if x < y { x } else { y }).sum::<f64>())
        .fold(0.0, f64::max);
    shared / (total - shared)
}
