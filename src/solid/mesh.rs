/// A triangle mesh in mm, triangles counter-clockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Corner positions, mm.
    pub positions: Vec<[f64; 3]>,
    /// Indices into `positions`, three per triangle.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Corners of a triangle, by position.
    #[must_use]
    pub fn corners(&self, triangle: [u32; 3]) -> [[f64; 3]; 3] {
        triangle.map(|i| self.positions[i as usize])
    }

    /// Signed volume, mm^3: positive when the triangles of a closed mesh face outward.
    #[must_use]
    pub fn volume(&self) -> f64 {
        let signed = |&t: &[u32; 3]| {
            let [a, b, c] = self.corners(t);
            dot(a, cross(b, c)) / 6.0
        };
        self.triangles.iter().map(signed).sum()
    }

    /// Normal of a triangle with the length of twice its area.
    #[must_use]
    pub fn area_normal(&self, triangle: [u32; 3]) -> [f64; 3] {
        let [a, b, c] = self.corners(triangle);
        cross(minus(b, a), minus(c, a))
    }

    /// For each half-edge `3 t + k` (from corner k of triangle t to the next) the half-edge of the
    /// neighbour that runs the other way, or the half-edge that has no such single partner.
    pub(super) fn opposites(&self) -> Result<Vec<usize>, usize> {
        let ends = |h: usize| (self.triangles[h / 3][h % 3], self.triangles[h / 3][(h + 1) % 3]);
        let mut order: Vec<(u32, u32, usize)> = (0..3 * self.triangles.len())
            .map(|h| {
                let (a, b) = ends(h);
                (a.min(b), a.max(b), h)
            })
            .collect();
        order.sort_unstable();
        let mut opposite = vec![usize::MAX; order.len()];
        let mut at = 0;
        while at < order.len() {
            let (low, high, first) = order[at];
            let same = order[at..].iter().take_while(|&&(a, b, _)| (a, b) == (low, high)).count();
            let second = order.get(at + 1).map_or(first, |&(_, _, h)| h);
            if same != 2 || low == high || ends(first) == ends(second) {
                return Err(first);
            }
            opposite[first] = second;
            opposite[second] = first;
            at += 2;
        }
        Ok(opposite)
    }
}

pub(super) fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// Disjoint sets over 0..n, for bodies and for shaded patches.
pub(super) struct Sets(Vec<usize>);

impl Sets {
    pub(super) fn new(n: usize) -> Self {
        Self((0..n).collect())
    }

    pub(super) fn find(&mut self, mut i: usize) -> usize {
        while self.0[i] != i {
            self.0[i] = self.0[self.0[i]];
            i = self.0[i];
        }
        i
    }

    pub(super) fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b)] = a.min(b);
    }
}
