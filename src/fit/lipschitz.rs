//! Curves of bounded slope near a given one, on a ring of samples.

use crate::policy;

/// The least curve above `y` (`side` 1) or the greatest below it (`side` -1) that rises or falls by no more than `rise` a sample.
pub(super) fn envelope(y: &[f64], rise: f64, side: f64) -> Vec<f64> {
    let n = y.len();
    let mut e: Vec<f64> = y.iter().map(|v| side * v).collect();
    // Twice round each way, since a peak may reach across the seam.
    for i in 0..2 * n {
        e[(i + 1) % n] = e[(i + 1) % n].max(e[i % n] - rise);
    }
    for i in (0..2 * n).rev() {
        e[i % n] = e[i % n].max(e[(i + 1) % n] - rise);
    }
    e.iter().map(|v| side * v).collect()
}

/// A curve between the envelopes: on every stretch where they part, the mixture that changes psi' least.
///
/// Stretches meet where the envelopes do, so each may choose alone and the slope bound still holds.
pub(super) fn between(upper: &[f64], lower: &[f64], law: &[f64]) -> Vec<f64> {
    let n = law.len();
    let parted = |i: usize| upper[i % n] - lower[i % n] > policy::ENVELOPES_MEET;
    let mixed = |i: usize, share: f64| lower[i] + share * (upper[i] - lower[i]);
    let change = |from: usize, to: usize, share: f64| -> f64 {
        (from..to)
            .map(|i| {
                let r = mixed(i % n, share).exp();
                let d = r / (1.0 - r) - law[i % n];
                d * d
            })
            .sum()
    };
    let mut y: Vec<f64> = (0..n).map(|i| mixed(i, 0.5)).collect();
    let first = (0..n).find(|i| !parted(*i)).unwrap_or(0);
    let mut i = first;
    while i < first + n {
        if !parted(i) {
            i += 1;
            continue;
        }
        let end = (i..first + n).find(|j| !parted(*j)).unwrap_or(first + n);
        let cost = policy::ENVELOPE_SHARES.map(|share| (change(i, end, share), share));
        let best = cost.iter().min_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.5, |c| c.1);
        for k in i..end {
            y[k % n] = mixed(k % n, best);
        }
        i = end;
    }
    y
}

pub(super) fn smoothed(y: &[f64]) -> Vec<f64> {
    let n = y.len();
    (0..n).map(|i| 0.5 * y[i] + 0.25 * (y[(i + 1) % n] + y[(i + n - 1) % n])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_between_envelopes_keeps_the_slope_and_leaves_the_rest() {
        let n = 90;
        let law: Vec<f64> =
            (0..n).map(|i| if (30..34).contains(&i) || i > 85 { 3.0 } else { 0.8 }).collect();
        let y: Vec<f64> = law.iter().map(|p: &f64| (p / (1.0 + p)).ln()).collect();
        let (upper, lower) = (envelope(&y, 0.05, 1.0), envelope(&y, 0.05, -1.0));
        let kept = between(&upper, &lower, &law);
        for i in 0..n {
            assert!(lower[i] <= y[i] && y[i] <= upper[i]);
            assert!((kept[(i + 1) % n] - kept[i]).abs() <= 0.05 + 1e-12);
        }
        assert!((55..65).all(|i| kept[i] == y[i]));
        // Never dearer than the plain mean of the envelopes.
        let change = |c: &dyn Fn(usize) -> f64| -> f64 {
            (0..n).map(|i| (c(i).exp() / (1.0 - c(i).exp()) - law[i]).powi(2)).sum()
        };
        assert!(change(&|i| kept[i]) <= change(&|i| 0.5 * (upper[i] + lower[i])));
    }
}
