//! How much work a refinement makes.

/// One pass of the refinement.
#[derive(Clone, Copy, Debug)]
pub(in crate::fit) struct Stage {
    /// Waves of ln psi'. 24 carry features of half a tooth of a gear of 48.
    pub(super) waves: usize,
    /// Points of a pitch curve, over the longer gear's turn.
    pub(super) places: usize,
    /// Blur of the drawings, in cells of their fields: features come within reach of each other.
    pub(super) blur: f64,
    /// Rounds of L-BFGS.
    pub(super) rounds: u64,
    /// Different ends that go on.
    pub(super) kept: usize,
}

/// The starts of a refinement and its passes, from many rough starts to a few sharp ends.
#[derive(Clone, Copy, Debug)]
pub(in crate::fit) struct Plan {
    /// Candidates of the search to start from.
    pub(in crate::fit) candidates: usize,
    /// Centres spread over each drawing between which motions are warped, at least; none for no warped starts.
    pub(super) centers: usize,
    /// Cells between the follower angles from which paths start.
    pub(super) stride: usize,
    /// Warped alignments to start from.
    pub(super) warps: usize,
    pub(super) stages: [Stage; 3],
}

/// Centres, stride and warped starts, and ends kept after each pass, by effort.
const EFFORTS: [(usize, [usize; 3], [usize; 3]); 5] = [
    (12, [5, 8, 6], [3, 2, 1]),
    (22, [9, 4, 16], [6, 3, 2]),
    (40, [25, 2, 64], [24, 9, 4]),
    (80, [49, 1, 256], [96, 30, 8]),
    (160, [121, 1, 1024], [384, 96, 16]),
];

impl Plan {
    /// For an effort from 1 to 5 and so many different results; `coarse` for a quick answer from the search's best alone.
    pub(in crate::fit) fn new(effort: u8, count: usize, coarse: bool) -> Self {
        let at = usize::from(effort.clamp(1, 5) - 1);
        let (candidates, [centers, stride, warps], kept) = EFFORTS[at];
        // Ends of one start are often those of another: a few more than are wanted go on.
        let kept = if count > 1 {
            let wanted = [4 * count, 3 * count, 2 * count];
            [0, 1, 2].map(|i| kept[i].max(wanted[i]))
        } else {
            kept
        };
        let stage = |waves, places, blur, rounds, kept| Stage { waves, places, blur, rounds, kept };
        let stages = [
            stage(8, 96, 6.0, 20, kept[0]),
            stage(16, 192, 2.0, 30, kept[1]),
            stage(24, 384, 0.5, 60, kept[2]),
        ];
        if coarse {
            return Self { candidates: 4, centers: 0, stride, warps: 0, stages };
        }
        Self { candidates, centers, stride, warps: warps.max(4 * (count - 1)), stages }
    }
}
