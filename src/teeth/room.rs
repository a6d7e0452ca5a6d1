//! Room for the mate: what flanks and roots left standing in the driver's way is carved from the
//! follower, for every angle at which the follower may stand.

use super::TeethError;
use super::carve::{self, Carved};
use super::layout::Rack;
use super::motions::Motions;
use super::profile::{EdgeKind, Profile};
use super::rolling::{Instant, Rolling};
use crate::control::Control;
use crate::gear::Side;
use crate::geometry::{self, Vector, cross, quarter_turn};
use crate::outline::simplify;
use crate::policy;

/// Places of the follower between its extremes along which is carved as well, where anything was cut at
/// an extreme.
const BETWEEN: usize = 5;
/// Room that the driver leaves there, as a share of the clearance.
const BETWEEN_ROOM: f64 = 0.25;
/// Walls thinner than twice this, in modules, are taken off after carving, which leaves slivers that hang on
/// by a point.
const SLIVER: f64 = 1e-3;
/// How far tips are lowered after carving, in modules: a tip that only just passes its mate would catch on
/// it under load.
const LOWERED: f64 = 0.02;
/// Sine of the turn between two edges below which they count as in line when tips are lowered.
const LEAST_CORNER: f64 = 0.02;
/// Farthest that a corner moves when tips are lowered, in multiples of that move.
const FARTHEST_MOVE: f64 = 3.0;
/// Distance between what was carved and the chords that are kept, in modules.
const CHORD: f64 = 2e-4;

/// What is left of two gears.
pub(crate) struct Carving {
    pub(crate) driver: Profile,
    pub(crate) follower: Profile,
    /// Pieces of envelope that were cut.
    pub(crate) cuts: usize,
}

/// Carves `follower` with `driver` in every motion of the pair, and lowers the tips of both where anything was
/// cut.
pub(crate) fn carved(
    motions: &Motions,
    driver: Profile,
    follower: Profile,
    rack: &Rack,
    teeth: usize,
    control: &Control,
) -> Result<Carving, TeethError> {
    let tangled = |gear| TeethError::Tangled { gear };
    let module = rack.module;
    let tool = driver.inset(policy::CARVE_SKIN * module).ok_or(tangled(Side::Driver))?;
    let extremes: &[f64] = if motions.has_play() { &[0.0, 1.0] } else { &[0.0] };
    let sweep = Sweep { motions, depth: policy::CARVE_DEPTH * module, teeth, control };
    let mut outline = follower.points.clone();
    let mut cuts = 0;
    for &level in extremes {
        let cut = sweep.carve(&tool.points, &outline, level, policy::CARVE_INSTANTS_PER_TOOTH)?;
        cuts += cut.cuts;
        outline = cut.outline;
    }
    if cuts == 0 {
        return Ok(Carving { driver, follower, cuts });
    }
    if motions.has_play() {
        let wider =
            geometry::offset(&driver.points, BETWEEN_ROOM * rack.clearance, policy::BODY_CHORD);
        let ring = geometry::largest(wider).and_then(|face| face.into_iter().next());
        let tool = simplify(&ring.ok_or(tangled(Side::Driver))?, CHORD * module);
        for k in 1..=BETWEEN {
            let level = k as f64 / (BETWEEN + 1) as f64;
            outline =
                sweep.carve(&tool, &outline, level, policy::CARVE_INSTANTS_PER_TOOTH / 2)?.outline;
        }
        let whole = without_slivers(&outline, SLIVER * module).unwrap_or(outline);
        outline = simplify(&whole, CHORD * module);
    }
    let whole = |profile: Profile| {
        profile
            .without_short_edges(policy::SHORTEST_EDGE * module)
            .repeated(motions.designed().follower_fold(), policy::FOLD_MATCH * module)
            .untangled()
            .ok_or(tangled(Side::Follower))
    };
    let follower = whole(follower.relabelled(outline))?;
    if !motions.has_play() {
        return Ok(Carving { driver, follower, cuts });
    }
    let lower = |profile: &Profile, gear| {
        lowered(profile, LOWERED * module)
            .map(|profile| profile.without_short_edges(policy::SHORTEST_EDGE * module))
            .ok_or(tangled(gear))
    };
    let driver = lower(&driver, Side::Driver)?;
    let follower = lower(&follower, Side::Follower)?;
    Ok(Carving { driver, follower, cuts })
}

/// The profile with its top lands moved inward by `distance` mm; flanks end where they meet them. Where a land runs
/// on into its neighbour without a corner, the neighbour's end is drawn in with it, so that no step is left.
pub(crate) fn lowered(profile: &Profile, distance: f64) -> Option<Profile> {
    let n = profile.points.len();
    let inward = |i: usize| -> Vector {
        quarter_turn((profile.points[(i + 1) % n] - profile.points[i]).normalize())
    };
    let depth = |i: usize| if profile.kinds[i] == EdgeKind::Tip { distance } else { 0.0 };
    let points = (0..n)
        .map(|i| {
            let before = (i + n - 1) % n;
            let (a, b) = (depth(before), depth(i));
            if a == 0.0 && b == 0.0 {
                return profile.points[i];
            }
            let (along_a, along_b) = (inward(before), inward(i));
            let turn = cross(along_a, along_b);
            let by = if turn > LEAST_CORNER {
                // Where both moved edges meet.
                Vector::new(a * along_b.y - b * along_a.y, b * along_a.x - a * along_b.x) / turn
            } else {
                a.max(b) * if b > 0.0 { along_b } else { along_a }
            };
            let (length, most) = (by.norm(), FARTHEST_MOVE * distance);
            profile.points[i] + by * if length > most { most / length } else { 1.0 }
        })
        .collect();
    Profile { points, kinds: profile.kinds.clone() }.untangled()
}

struct Sweep<'a> {
    motions: &'a Motions,
    depth: f64,
    teeth: usize,
    control: &'a Control,
}

impl Sweep<'_> {
    /// Carves once round at one place of the follower between its extremes.
    fn carve(
        &self,
        tool: &[geometry::Point],
        blank: &[geometry::Point],
        level: f64,
        instants_per_tooth: usize,
    ) -> Result<Carved, TeethError> {
        let designed: &Rolling = self.motions.designed();
        let periods = designed.cycle_periods();
        let instants = instants_per_tooth * self.teeth * periods as usize;
        let step = designed.period() * f64::from(periods) / instants as f64;
        // Some instants past the end: where the cycle closes, its pieces must overlap, not just meet.
        let frames: Vec<Instant> = (0..=instants + policy::CARVE_SURROUND)
            .map(|k| self.motions.between(k as f64 * step, level))
            .collect();
        let carved = carve::carve_at(&frames, tool, blank, self.depth, true, self.control);
        self.control.check()?;
        carved.ok_or(TeethError::Tangled { gear: Side::Follower })
    }
}

/// The outline without walls thinner than twice `reach`: moved inward and out again.
fn without_slivers(outline: &[geometry::Point], reach: f64) -> Option<Vec<geometry::Point>> {
    let ring = |faces: Vec<geometry::Face>| geometry::largest(faces)?.into_iter().next();
    let inner = ring(geometry::offset(outline, -reach, policy::BODY_CHORD))?;
    ring(geometry::offset(&inner, reach, policy::BODY_CHORD))
}
