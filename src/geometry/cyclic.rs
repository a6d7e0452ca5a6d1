//! Tridiagonal systems closed into a ring.

/// Solves `lower[i] x[i-1] + diagonal[i] x[i] + upper[i] x[i+1] = rhs[i]`, indices around a ring of at least three.
///
/// Elimination with the corners moved to a rank-one correction (Sherman and Morrison); meant for
/// diagonally dominant rows, where it needs no pivoting.
pub(crate) fn solve_cyclic(
    lower: &[f64],
    diagonal: &[f64],
    upper: &[f64],
    rhs: &[f64],
) -> Vec<f64> {
    let n = rhs.len();
    let corner = -diagonal[0];
    let (last_corner, first_corner) = (upper[n - 1], lower[0]);
    let mut x = vec![0.0; n];
    let mut z = vec![0.0; n];
    let mut factor = vec![0.0; n];
    let middle = |i: usize| match i {
        0 => diagonal[0] - corner,
        i if i == n - 1 => diagonal[i] - last_corner * first_corner / corner,
        _ => diagonal[i],
    };
    factor[0] = upper[0] / middle(0);
    x[0] = rhs[0] / middle(0);
    z[0] = corner / middle(0);
    for i in 1..n {
        let pivot = 1.0 / (middle(i) - lower[i] * factor[i - 1]);
        factor[i] = upper[i] * pivot;
        x[i] = (rhs[i] - lower[i] * x[i - 1]) * pivot;
        let z_rhs = if i == n - 1 { last_corner } else { 0.0 };
        z[i] = (z_rhs - lower[i] * z[i - 1]) * pivot;
    }
    for i in (0..n - 1).rev() {
        x[i] -= factor[i] * x[i + 1];
        z[i] -= factor[i] * z[i + 1];
    }
    let reach = first_corner / corner;
    let share = (x[0] + x[n - 1] * reach) / (1.0 + z[0] + z[n - 1] * reach);
    x.iter().zip(&z).map(|(x, z)| x - share * z).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ring_is_solved() {
        let n = 17;
        let wave = |i: usize, k: f64| (k * i as f64).sin();
        let lower: Vec<f64> = (0..n).map(|i| wave(i, 1.3)).collect();
        let upper: Vec<f64> = (0..n).map(|i| wave(i, 2.1)).collect();
        let diagonal: Vec<f64> = (0..n).map(|i| 2.5 + wave(i, 0.7)).collect();
        let rhs: Vec<f64> = (0..n).map(|i| wave(i, 5.0)).collect();
        let x = solve_cyclic(&lower, &diagonal, &upper, &rhs);
        for i in 0..n {
            let row =
                lower[i] * x[(i + n - 1) % n] + diagonal[i] * x[i] + upper[i] * x[(i + 1) % n];
            assert!((row - rhs[i]).abs() < 1e-12);
        }
    }
}
