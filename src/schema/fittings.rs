//! Fittings and fixtures as `design.json` holds them. Records written before there were any lack them.

use nalgebra::{Isometry3, Quaternion, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use crate::assembly::{Fittings, Fixture, Hub, Mark, Opening, Pocket, Post, Stance};
use crate::geometry::{self, Point};
use crate::policy;

use super::saved::{plain_name, within_reach};

type Ring = Vec<[f64; 2]>;

/// Shortest quaternion whose direction still says a turn.
const SHORTEST_TURN: f64 = 1e-6;

/// What a gear carries.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(default)]
pub(super) struct FittingsRecord {
    openings: Vec<OpeningRecord>,
    hub: Option<HubRecord>,
    marks: Vec<MarkRecord>,
    chamfer: f64,
}

#[derive(Debug, Serialize, Deserialize)]
struct OpeningRecord {
    name: String,
    ring: Ring,
}

#[derive(Debug, Serialize, Deserialize)]
struct HubRecord {
    radius: f64,
    height: f64,
    set_screw: Option<f64>,
}

#[derive(Debug, Serialize, Deserialize)]
struct MarkRecord {
    name: String,
    height: f64,
    face: Vec<Ring>,
}

/// A part beside the gears.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct FixtureRecord {
    name: String,
    /// Height of a part that lies as it is printed.
    z: f64,
    /// Where any other part stands: x, y, z, mm, and a turn as a unit quaternion (x, y, z, w).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    place: Option<[f64; 7]>,
    /// Number of the gear that it turns with.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    turns_with: Option<usize>,
    thickness: f64,
    outline: Ring,
    holes: Vec<Ring>,
    posts: Vec<PostRecord>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pockets: Vec<PocketRecord>,
}

#[derive(Debug, Serialize, Deserialize)]
struct PocketRecord {
    from: f64,
    to: f64,
    ring: Ring,
    hole: Option<usize>,
}

#[derive(Debug, Serialize, Deserialize)]
struct PostRecord {
    from: f64,
    to: f64,
    ring: Ring,
    hole: Option<usize>,
}

fn plain(ring: &[Point]) -> Ring {
    ring.iter().map(|p| [p.x, p.y]).collect()
}

/// A ring that turns as it must: +1 counter-clockwise, -1 clockwise.
fn ring(what: &str, points: Ring, turn: f64) -> Result<Vec<Point>, String> {
    let points: Vec<Point> = points.into_iter().map(|[x, y]| Point::new(x, y)).collect();
    within_reach(&points).map_err(|far| format!("{what} {far}"))?;
    if points.len() > 2 && turn * geometry::signed_area(&points) > 0.0 {
        Ok(points)
    } else {
        Err(format!("{what} is not a closed curve that runs the right way round"))
    }
}

/// Passes as many rings as can be kept apart in reasonable time.
fn few(part: &str, rings: usize) -> Result<(), String> {
    let most = policy::RECORD_RINGS;
    if rings > most {
        Err(format!("{part} has {rings} holes and marks, more than {most}"))
    } else {
        Ok(())
    }
}

impl FittingsRecord {
    pub(super) fn new(fittings: &Fittings) -> Option<Self> {
        if fittings.is_empty() {
            return None;
        }
        let Fittings { openings, hub, marks, chamfer } = fittings;
        let opening = |o: &Opening| OpeningRecord { name: o.name.clone(), ring: plain(&o.ring) };
        let mark = |m: &Mark| MarkRecord {
            name: m.name.clone(),
            height: m.height,
            face: m.face.iter().map(|r| plain(r)).collect(),
        };
        let hub =
            hub.map(|Hub { radius, height, set_screw }| HubRecord { radius, height, set_screw });
        Some(Self {
            openings: openings.iter().map(opening).collect(),
            hub,
            marks: marks.iter().map(mark).collect(),
            chamfer: *chamfer,
        })
    }

    /// # Errors
    /// What is wrong, as half a sentence. Sizes that make no solid are found when one is made.
    pub(super) fn read(self, gear: &str) -> Result<Fittings, String> {
        let names = self.marks.iter().map(|m| &m.name);
        names.chain(self.openings.iter().map(|o| &o.name)).try_for_each(|n| plain_name(n))?;
        let edges = self.marks.iter().map(|m| m.face.len()).sum::<usize>();
        few(&format!("its {gear}"), self.openings.len() + edges.max(self.marks.len()))?;
        if let Some(mark) = self.marks.iter().find(|m| m.face.is_empty()) {
            return Err(format!("{} of its {gear} has no edge", mark.name));
        }
        let heights = self.marks.iter().map(|m| m.height);
        let hub = self.hub.iter().flat_map(|h| [h.radius, h.height, h.set_screw.unwrap_or(0.0)]);
        let mut sizes = heights.chain(hub).chain([self.chamfer]);
        if let Some(size) = sizes.find(|size| size.abs() > policy::RECORD_REACH) {
            return Err(format!("its {gear} carries something of {size:e} mm"));
        }
        let openings = self.openings.into_iter().map(|o| {
            let what = format!("{} of its {gear}", o.name);
            Ok(Opening { ring: ring(&what, o.ring, 1.0)?, name: o.name })
        });
        let marks = self.marks.into_iter().map(|m| {
            let what = format!("{} of its {gear}", m.name);
            let turns = std::iter::once(1.0).chain(std::iter::repeat(-1.0));
            let face = m.face.into_iter().zip(turns).map(|(r, turn)| ring(&what, r, turn));
            Ok(Mark { name: m.name, face: face.collect::<Result<_, String>>()?, height: m.height })
        });
        let hub = self.hub.map(|HubRecord { radius, height, set_screw }| Hub {
            radius,
            height,
            set_screw,
        });
        Ok(Fittings {
            openings: openings.collect::<Result<_, String>>()?,
            hub,
            marks: marks.collect::<Result<_, String>>()?,
            chamfer: self.chamfer,
        })
    }
}

impl FixtureRecord {
    pub(super) fn new(fixture: &Fixture) -> Self {
        let post =
            |p: &Post| PostRecord { from: p.from, to: p.to, ring: plain(&p.ring), hole: p.hole };
        let Stance { place, with } = fixture.stance;
        let flat = fixture.stance.height_of_flat();
        let (at, turn) = (place.translation.vector, place.rotation.coords);
        let pocket = |p: &Pocket| PocketRecord {
            from: p.from,
            to: p.to,
            ring: plain(&p.ring),
            hole: p.hole,
        };
        Self {
            name: fixture.name.clone(),
            z: flat.unwrap_or(at.z),
            place: flat.is_none().then(|| [at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w]),
            turns_with: with,
            pockets: fixture.pockets.iter().map(pocket).collect(),
            thickness: fixture.thickness,
            outline: plain(&fixture.outline),
            holes: fixture.holes.iter().map(|h| plain(h)).collect(),
            posts: fixture.posts.iter().map(post).collect(),
        }
    }

    /// # Errors
    /// What is wrong, as half a sentence.
    pub(super) fn read(self) -> Result<Fixture, String> {
        // The name becomes that of a file.
        let harmless = |c: char| c.is_ascii_alphanumeric() || "-_ ".contains(c);
        if self.name.is_empty() || !self.name.chars().all(harmless) {
            return Err(format!("a fixture is called {:?}", self.name));
        }
        let what = format!("its {}", self.name);
        few(&what, self.holes.len() + self.posts.len() + self.pockets.len())?;
        let heights = self.posts.iter().flat_map(|p| [p.from, p.to]);
        let depths = self.pockets.iter().flat_map(|p| [p.from, p.to]);
        let place = self.place.unwrap_or([0.0, 0.0, self.z, 0.0, 0.0, 0.0, 1.0]);
        let mut sizes = heights.chain(depths).chain([self.z, self.thickness]).chain(place);
        if self.turns_with.is_some_and(|gear| gear > 1) {
            return Err(format!("{what} turns with a gear that there is not"));
        }
        if let Some(size) = sizes.find(|size| size.is_nan() || size.abs() > policy::RECORD_REACH) {
            return Err(format!("{what} has a height of {size:e} mm"));
        }
        let counter_clockwise = |r: Ring| ring(&what, r, 1.0);
        let post = |p: PostRecord| {
            let PostRecord { from, to, ring, hole } = p;
            Ok(Post { ring: counter_clockwise(ring)?, hole, from, to })
        };
        let pocket = |p: PocketRecord| {
            let PocketRecord { from, to, ring, hole } = p;
            Ok(Pocket { ring: counter_clockwise(ring)?, hole, from, to })
        };
        let [x, y, z, i, j, k, w] = place;
        let turn = UnitQuaternion::try_new(Quaternion::new(w, i, j, k), SHORTEST_TURN)
            .ok_or_else(|| format!("{what} has no turn"))?;
        let place = Isometry3::from_parts(Vector3::new(x, y, z).into(), turn);
        Ok(Fixture {
            stance: Stance { place, with: self.turns_with },
            pockets: self.pockets.into_iter().map(pocket).collect::<Result<_, String>>()?,
            outline: counter_clockwise(self.outline)?,
            holes: self.holes.into_iter().map(counter_clockwise).collect::<Result<_, _>>()?,
            thickness: self.thickness,
            posts: self.posts.into_iter().map(post).collect::<Result<_, String>>()?,
            name: self.name,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::circle;

    fn clockwise(radius: f64) -> Vec<Point> {
        circle(radius, 0.1).into_iter().rev().collect()
    }

    #[test]
    fn what_is_written_reads_back_the_same() {
        let fittings = Fittings {
            openings: vec![Opening { name: "screw 1".into(), ring: circle(1.6, 0.1) }],
            hub: Some(Hub { radius: 7.0, height: 5.0, set_screw: Some(2.5) }),
            marks: vec![Mark {
                name: "O".into(),
                face: vec![circle(3.0, 0.1), clockwise(2.0)],
                height: -0.4,
            }],
            chamfer: 0.3,
        };
        let text = serde_json::to_string(&FittingsRecord::new(&fittings)).unwrap();
        let read: FittingsRecord = serde_json::from_str(&text).unwrap();
        assert_eq!(read.read("driver"), Ok(fittings));
        assert!(FittingsRecord::new(&Fittings::default()).is_none());
        let bare: FittingsRecord = serde_json::from_str("{}").unwrap();
        assert_eq!(bare.read("driver"), Ok(Fittings::default()));
    }

    #[test]
    fn damage_is_named() {
        let mark = Mark { name: "O".into(), face: vec![clockwise(3.0)], height: 0.4 };
        let fittings = Fittings { marks: vec![mark], ..Fittings::default() };
        let error = FittingsRecord::new(&fittings).unwrap().read("driver").unwrap_err();
        assert!(error.contains("O of its driver"), "{error}");
        let mut base = Fixture {
            name: "base".into(),
            outline: circle(20.0, 0.1),
            holes: vec![circle(2.0, 0.1)],
            thickness: 4.0,
            posts: vec![Post { ring: circle(4.0, 0.1), hole: Some(0), from: 4.0, to: 5.0 }],
            pockets: vec![Pocket { ring: circle(3.0, 0.1), hole: Some(0), from: 0.0, to: 2.0 }],
            stance: Stance::flat(-5.0),
        };
        assert_eq!(FixtureRecord::new(&base).read().as_ref(), Ok(&base));
        base.stance = Stance::on_edge([1.0, 2.0, 3.0]).turning_with(1);
        let read = FixtureRecord::new(&base).read().unwrap();
        assert!((read.stance.place.inverse() * base.stance.place).rotation.angle() < 1e-12);
        assert_eq!(read.stance.with, Some(1));
        base.name = "../base".into();
        assert!(FixtureRecord::new(&base).read().unwrap_err().contains("../base"));
    }
}
