//! Relief for the play that clearance opens.
//!
//! Clearance lets the follower fall behind the motion it was carved by, until a flank holds it. That
//! lag differs from flank to flank, and a tip that clears its mate in the designed pose may not clear
//! it in the lagging one: there the lag would have to shrink at once, which no force can make it do,
//! and the pair catches. The cure is to carve the follower once more along the motion that the loaded
//! pair should have: as measured, but with a lag that changes by no more than [`policy::RELIEF_RATE`]
//! of the follower's speed. Both flanks are treated, each with its own play.

use super::carve::carve_at;
use super::profile::{EdgeKind, Profile};
use super::rolling::Instant;
use crate::control::Control;
use crate::geometry::{self, Point, Vector, cross, quarter_turn};
use crate::outline::simplify;
use crate::pitch::Centrodes;
use crate::policy;

/// A follower after relief.
#[derive(Clone, Debug)]
pub struct Relieved {
    /// The follower in its frame.
    pub follower: Profile,
    /// Places of the cycle at which something was carved.
    pub places: usize,
    /// Greatest sudden loss of lag that was found, in pitches of the follower.
    pub worst: f64,
}

/// Carves from `follower` what would catch when it lags or leads by its play.
///
/// `behind` and `ahead` are the follower's play in radians at evenly spaced driver angles over one
/// cycle of `cycle` radians, beginning at 0; `pitch` is a pitch of the follower in radians; profiles
/// have their clearance. `None` where nothing would catch, or nothing sound was left.
#[must_use]
pub fn relieved(
    centrodes: &Centrodes,
    driver: &Profile,
    follower: &Profile,
    module: f64,
    cycle: f64,
    [behind, ahead]: [&[f64]; 2],
    pitch: f64,
) -> Option<Relieved> {
    let count = behind.len();
    if count < 3 || ahead.len() != count {
        return None;
    }
    let h = cycle / count as f64;
    let t = &centrodes.transmission;
    let speed: Vec<f64> = (0..count).map(|i| t.derivative(i as f64 * h)).collect();
    let mut outline = follower.points.clone();
    let (mut places, mut worst) = (0, 0.0_f64);
    for (plays, sense) in [(behind, 1.0), (ahead, -1.0)] {
        let wanted = changing_slowly(plays, &speed, h);
        let short = |i: i64| {
            let i = i.rem_euclid(count as i64) as usize;
            (wanted[i] - plays[i]) / pitch
        };
        for (from, to) in arcs(count, &short) {
            let deepest = (from..=to).map(short).fold(0.0, f64::max);
            worst = worst.max(deepest);
            let at = |k: i64| {
                // In substeps of the samples.
                let steps = policy::RELIEF_SUBSTEPS;
                let (i, rest) = (k.div_euclid(steps), k.rem_euclid(steps) as f64 / steps as f64);
                let [a, b] = [i, i + 1].map(|i| wanted[i.rem_euclid(count as i64) as usize]);
                let phi = (i as f64 + rest) * h;
                Instant::of_motion(
                    phi,
                    t.psi(phi) - sense * (a + rest * (b - a)),
                    (t.derivative(phi) - sense * (b - a) / h).max(policy::RELIEF_LEAST_SPEED),
                    centrodes.center_distance,
                )
            };
            let steps = policy::RELIEF_SUBSTEPS;
            let frames: Vec<Instant> = (from * steps..=to * steps).map(at).collect();
            let carved = carve_at(
                &frames,
                &driver.points,
                &outline,
                policy::CARVE_DEPTH * module,
                true,
                Control::unwatched(),
            )?;
            places += usize::from(carved.cuts > 0);
            outline = carved.outline;
        }
    }
    if places == 0 {
        return None;
    }
    let outline = without_slivers(&outline, policy::RELIEF_SLIVER * module)?;
    let follower = follower
        .relabelled(simplify(&outline, policy::RELIEF_CHORD * module))
        .without_short_edges(policy::SHORTEST_EDGE * module)
        .repeated(t.follower_fold(), policy::FOLD_MATCH * module)
        .untangled()?;
    Some(Relieved { follower, places, worst })
}

/// The outline without walls thinner than twice `reach`: moved inward and out again.
fn without_slivers(outline: &[Point], reach: f64) -> Option<Vec<Point>> {
    let ring = |faces: Vec<Vec<Vec<Point>>>| geometry::largest(faces)?.into_iter().next();
    let inner = ring(geometry::offset(outline, -reach, policy::BODY_CHORD))?;
    ring(geometry::offset(&inner, reach, policy::BODY_CHORD))
}

/// The least play at or above `plays` that changes no faster than [`policy::RELIEF_RATE`] of the
/// follower's speed.
fn changing_slowly(plays: &[f64], speed: &[f64], h: f64) -> Vec<f64> {
    let n = plays.len();
    let mut wanted = plays.to_vec();
    // Twice round: what begins before the cycle's end reaches into its beginning.
    for k in 0..2 * n {
        let (last, here) = (k % n, (k + 1) % n);
        let least = wanted[last] - policy::RELIEF_RATE * speed[here] * h;
        wanted[here] = wanted[here].max(least);
    }
    for k in (0..2 * n).rev() {
        let (here, next) = (k % n, (k + 1) % n);
        let least = wanted[next] - policy::RELIEF_RATE * speed[here] * h;
        wanted[here] = wanted[here].max(least);
    }
    wanted
}

/// Stretches of samples that fall short by more than [`policy::RELIEF_FROM`] somewhere, with all that
/// belongs to them; ends may lie outside the cycle.
fn arcs(count: usize, short: &dyn Fn(i64) -> f64) -> Vec<(i64, i64)> {
    let n = count as i64;
    let Some(start) = (0..n).find(|&i| short(i) <= 0.0) else { return Vec::new() };
    let mut found = Vec::new();
    let mut begun: Option<(i64, f64)> = None;
    for i in start..=start + n {
        let s = short(i);
        match &mut begun {
            None if s > 0.0 => begun = Some((i, s)),
            Some((_, deepest)) if s > 0.0 => *deepest = deepest.max(s),
            Some((from, deepest)) => {
                if *deepest > policy::RELIEF_FROM {
                    found.push((*from - 1, i));
                }
                begun = None;
            }
            None => {}
        }
    }
    found
}

impl Profile {
    /// The profile with its top lands moved inward by `distance` mm, so that tips which just passed
    /// their mate have room; flanks end where they meet them. `None` when nothing sound is left.
    #[must_use]
    pub fn with_tips_lowered(&self, distance: f64) -> Option<Self> {
        let n = self.points.len();
        let inward = |i: usize| -> Vector {
            quarter_turn((self.points[(i + 1) % n] - self.points[i]).normalize())
        };
        let lowered = |i: usize| if self.kinds[i] == EdgeKind::Tip { distance } else { 0.0 };
        let points = (0..n)
            .map(|i| {
                let before = (i + n - 1) % n;
                let (a, b) = (inward(before), inward(i));
                let (da, db) = (lowered(before), lowered(i));
                if da == 0.0 && db == 0.0 {
                    return self.points[i];
                }
                let turn = cross(a, b);
                // Where both moved edges meet; straight in where they are nearly in line.
                let by = if turn.abs() > policy::RELIEF_CORNER {
                    Vector::new(da * b.y - db * a.y, db * a.x - da * b.x) / turn
                } else {
                    da.max(db) * b
                };
                let (length, most) = (by.norm(), policy::RELIEF_REACH * distance);
                self.points[i] + by * if length > most { most / length } else { 1.0 }
            })
            .collect();
        Self { points, kinds: self.kinds.clone() }.untangled()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn play_changes_slowly_and_never_below_what_is_there() {
        let mut plays = vec![0.1; 100];
        plays[40..50].fill(0.02);
        plays[99] = 0.1001;
        let speed = vec![1.0; 100];
        let h = 0.01;
        let wanted = changing_slowly(&plays, &speed, h);
        let at = |i: i64| wanted[i.rem_euclid(100) as usize];
        for i in 0..100 {
            assert!((at(i + 1) - at(i)).abs() <= policy::RELIEF_RATE * h + 1e-12, "{i}");
            assert!(at(i) >= plays[i as usize]);
        }
        assert_eq!([at(39), at(50), at(-1)], [0.1, 0.1, 0.1001]);
        let short = |i: i64| at(i) - plays[i.rem_euclid(100) as usize];
        assert_eq!(arcs(100, &short), vec![(39, 50)]);
    }

    #[test]
    fn lowered_tips_leave_the_flanks_in_line() {
        let tooth = [(0.0, 0.0), (4.0, 0.0), (3.0, 2.0), (1.0, 2.0)];
        let profile = Profile {
            points: tooth.iter().map(|&(x, y)| Point::new(x, y)).collect(),
            kinds: vec![EdgeKind::Root, EdgeKind::Flank, EdgeKind::Tip, EdgeKind::Flank],
        };
        let lowered = profile.with_tips_lowered(0.2).unwrap().points;
        assert_eq!(lowered[0], profile.points[0]);
        assert!((lowered[2] - Point::new(3.1, 1.8)).norm() < 1e-12, "{}", lowered[2]);
        assert!((lowered[3] - Point::new(0.9, 1.8)).norm() < 1e-12, "{}", lowered[3]);
    }
}
