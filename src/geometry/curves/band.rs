//! Least squares on a chain or ring of unknown pairs, by a banded Cholesky factor.

use crate::geometry::Vector;

/// Two blocks of two unknowns each side of the diagonal: a ring folded flat needs both.
const BAND: usize = 5;

/// Normal equations whose unknowns, two per node, couple only within a node and with its neighbours.
pub(super) struct Chain {
    nodes: usize,
    ring: bool,
    /// `rows[i][k]` is the entry in column `i - k`.
    rows: Vec<[f64; BAND + 1]>,
    right: Vec<Vector>,
}

impl Chain {
    pub(super) fn new(nodes: usize, ring: bool) -> Self {
        Self {
            nodes,
            ring,
            rows: vec![[0.0; BAND + 1]; 2 * nodes],
            right: vec![Vector::zeros(); 2 * nodes],
        }
    }

    /// Place of unknown `which` (0 or 1) of a node: a ring is folded, so that neighbours stay close.
    fn place(&self, node: usize, which: usize) -> usize {
        let node = node % self.nodes;
        let slot = match (self.ring, 2 * node < self.nodes) {
            (false, _) => node,
            (true, true) => 2 * node,
            (true, false) => 2 * (self.nodes - node) - 1,
        };
        2 * slot + which
    }

    /// Adds `weight * (row . x - value)^2` for the four unknowns of `node` and the next.
    pub(super) fn observe(&mut self, node: usize, row: [f64; 4], value: Vector, weight: f64) {
        let places = [
            self.place(node, 0),
            self.place(node, 1),
            self.place(node + 1, 0),
            self.place(node + 1, 1),
        ];
        for (i, &p) in places.iter().enumerate() {
            self.right[p] += weight * row[i] * value;
            for (j, &q) in places.iter().enumerate() {
                if q <= p {
                    self.rows[p][p - q] += weight * row[i] * row[j];
                }
            }
        }
    }

    /// Adds a quadratic form of the four unknowns of `node` and the next.
    pub(super) fn stiffen(&mut self, node: usize, form: [[f64; 4]; 4]) {
        let places = [
            self.place(node, 0),
            self.place(node, 1),
            self.place(node + 1, 0),
            self.place(node + 1, 1),
        ];
        for (i, &p) in places.iter().enumerate() {
            for (j, &q) in places.iter().enumerate() {
                if q <= p {
                    self.rows[p][p - q] += form[i][j];
                }
            }
        }
    }

    /// Fixes the first unknown of a node.
    pub(super) fn fix(&mut self, node: usize, value: Vector) {
        let p = self.place(node, 0);
        for k in 1..=BAND.min(p) {
            self.right[p - k] -= self.rows[p][k] * value;
            self.rows[p][k] = 0.0;
        }
        for k in 1..=BAND {
            if p + k < self.rows.len() {
                self.right[p + k] -= self.rows[p + k][k] * value;
                self.rows[p + k][k] = 0.0;
            }
        }
        self.rows[p][0] = 1.0;
        self.right[p] = value;
    }

    /// Both unknowns of every node, or none when the equations do not determine them.
    pub(super) fn solve(mut self) -> Option<Vec<[Vector; 2]>> {
        let n = self.rows.len();
        for i in 0..n {
            for k in (0..=BAND.min(i)).rev() {
                let j = i - k;
                let mut sum = self.rows[i][k];
                for m in (k + 1)..=BAND.min(i) {
                    if m - k <= BAND && j + k >= m {
                        sum -= self.rows[i][m] * self.rows[j][m - k];
                    }
                }
                if k == 0 {
                    if !(sum > 0.0 && sum.is_finite()) {
                        return None;
                    }
                    self.rows[i][0] = sum.sqrt();
                } else {
                    self.rows[i][k] = sum / self.rows[j][0];
                }
            }
        }
        for i in 0..n {
            let mut sum = self.right[i];
            for k in 1..=BAND.min(i) {
                sum -= self.rows[i][k] * self.right[i - k];
            }
            self.right[i] = sum / self.rows[i][0];
        }
        for i in (0..n).rev() {
            let mut sum = self.right[i];
            for k in 1..=BAND.min(n - 1 - i) {
                sum -= self.rows[i + k][k] * self.right[i + k];
            }
            self.right[i] = sum / self.rows[i][0];
        }
        let pair = |node| [0, 1].map(|which| self.right[self.place(node, which)]);
        Some((0..self.nodes).map(pair).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_consistent_ring_and_chain_are_solved_exactly() {
        for ring in [false, true] {
            for nodes in [3_usize, 4, 7, 10] {
                let truth: Vec<[Vector; 2]> = (0..nodes)
                    .map(|i| {
                        let t = i as f64;
                        [Vector::new(t.sin(), t * t), Vector::new(1.0 - t, t.cos())]
                    })
                    .collect();
                let mut chain = Chain::new(nodes, ring);
                let last = if ring { nodes } else { nodes - 1 };
                for i in 0..last {
                    for k in 0..5_u32 {
                        let row = [1.0, 0.3, -0.7, 0.2]
                            .map(|c: f64| (c + f64::from(k)).sin() + 0.1 * (i as f64 + c));
                        let next = truth[(i + 1) % nodes];
                        let value = row[0] * truth[i][0]
                            + row[1] * truth[i][1]
                            + row[2] * next[0]
                            + row[3] * next[1];
                        chain.observe(i, row, value, 1.0);
                    }
                }
                if !ring {
                    chain.fix(0, truth[0][0]);
                }
                let found = chain.solve().unwrap();
                for (a, b) in found.iter().flatten().zip(truth.iter().flatten()) {
                    assert!((a - b).norm() < 1e-6, "{ring} {nodes} {a} {b}");
                }
            }
        }
    }

    #[test]
    fn what_nothing_determines_is_refused() {
        assert!(Chain::new(3, false).solve().is_none());
    }
}
