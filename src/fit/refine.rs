//! Downhill simplex search (Nelder and Mead) for objectives with kinks.

/// The best point and value found from `start` with about `evaluations` calls of `f`.
///
/// The first simplex reaches `steps[i]` along each axis. Points may be infinitely bad; the start should not be. The
/// result is never worse than the start.
pub(super) fn simplex<const N: usize>(
    start: [f64; N],
    steps: [f64; N],
    evaluations: usize,
    mut f: impl FnMut(&[f64; N]) -> f64,
) -> ([f64; N], f64) {
    let mut corners: Vec<([f64; N], f64)> = vec![(start, f(&start))];
    for i in 0..N {
        let mut x = start;
        x[i] += steps[i];
        let mut value = f(&x);
        if !value.is_finite() {
            x[i] = start[i] - steps[i];
            value = f(&x);
        }
        corners.push((x, value));
    }
    let mut used = N + 1;
    let towards = |from: &[f64; N], to: &[f64; N], t: f64| -> [f64; N] {
        std::array::from_fn(|i| from[i] + t * (to[i] - from[i]))
    };
    while used < evaluations {
        corners.sort_by(|a, b| a.1.total_cmp(&b.1));
        let middle: [f64; N] =
            std::array::from_fn(|i| corners[..N].iter().map(|c| c.0[i]).sum::<f64>() / N as f64);
        let (worst, worst_value) = corners[N];
        let (best_value, second) = (corners[0].1, corners[N - 1].1);
        let reflected = towards(&worst, &middle, 2.0);
        let value = f(&reflected);
        used += 1;
        if value < best_value {
            let further = towards(&worst, &middle, 3.0);
            let further_value = f(&further);
            used += 1;
            corners[N] =
                if further_value < value { (further, further_value) } else { (reflected, value) };
        } else if value < second {
            corners[N] = (reflected, value);
        } else {
            let t = if value < worst_value { 1.5 } else { 0.5 };
            let nearer = towards(&worst, &middle, t);
            let nearer_value = f(&nearer);
            used += 1;
            if nearer_value < worst_value.min(value) {
                corners[N] = (nearer, nearer_value);
            } else {
                let best = corners[0].0;
                for corner in &mut corners[1..] {
                    corner.0 = towards(&best, &corner.0, 0.5);
                    corner.1 = f(&corner.0);
                }
                used += N;
            }
        }
    }
    corners.sort_by(|a, b| a.1.total_cmp(&b.1));
    corners[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bottom_of_a_valley_is_found() {
        let valley = |x: &[f64; 2]| (1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2);
        let (x, value) = simplex([-1.2, 1.0], [0.3, 0.3], 400, valley);
        assert!(value < 1e-8 && (x[0] - 1.0).abs() < 1e-3, "{x:?}");
    }

    #[test]
    fn walls_are_respected() {
        let f = |x: &[f64; 1]| if x[0] > 0.5 { f64::INFINITY } else { -x[0] };
        let (x, _) = simplex([0.0], [0.9], 80, f);
        assert!(x[0] <= 0.5 && x[0] > 0.49);
    }
}
