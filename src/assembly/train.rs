//! Gear trains: pairs put together on many axles, chains and branching trees.
//!
//! A pair knows how its follower turns with its driver when the line of their centres points along +x (psi of the paper,
//! Eq. 1). Put at a line of centres that points along `beta`, the whole pair is turned by `beta`:
//! `driver = beta + phi`, `follower = beta - psi(phi)`. A gear with several neighbours obeys this in each of its
//! meshes, so motion is handed on by psi, and by its inverse where a follower drives a driver's twin.

use super::{Assembly, Gear, PairModel, PlacedGear, collisions};
use crate::gear::Side;
use crate::geometry::{self, Point, Vector};
use crate::policy;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// How a gear hangs on one that is already there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Link {
    /// It meshes with it; the line of centres from that gear to this one points along `direction`, radians.
    Mesh {
        /// World direction, radians, counter-clockwise from +x.
        direction: f64,
    },
    /// It is fixed on the same axle, its lower face `rise` mm above that of the other, turned against it by `turn` radians.
    Axle {
        /// Height above the other gear's lower face, mm; negative below.
        rise: f64,
        /// World rotation of this gear less the other's, radians.
        turn: f64,
    },
}

/// A gear of a train.
#[derive(Clone, Debug, PartialEq)]
pub struct TrainGear {
    /// Its name in every file.
    pub name: String,
    /// The pair it is one of, by number.
    pub pair: usize,
    /// Which of the two.
    pub side: Side,
    /// The gear it hangs on, of lesser number, and how; none for the first.
    pub link: Option<(usize, Link)>,
}

/// What a train is made of.
#[derive(Clone, Debug)]
pub struct TrainPlan {
    /// The pairs.
    pub pairs: Vec<PairModel>,
    /// The gears; the first is turned.
    pub gears: Vec<TrainGear>,
    /// Gears that also mesh although neither hangs on the other: what closes a ring.
    pub closing: Vec<[usize; 2]>,
    /// Thickness of every gear, mm.
    pub thickness: f64,
}

/// How the lines of centres of a chain turn from mesh to mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Layout {
    /// All along +x.
    Straight,
    /// Up and down by this angle in turn, radians.
    ZigZag(f64),
    /// Each turned on by this angle against the one before, radians.
    Arc(f64),
    /// Back to the first gear, which the last one meshes with. The corners' turns differ from each other by twice this
    /// angle in turn, radians.
    Ring(f64),
}

/// Why gears make no train.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TrainError {
    /// Fewer than two gears, or more than can be handled.
    #[error("a train of {count} gears cannot be made; give 2 to {}", policy::TRAIN_MOST_GEARS)]
    Count {
        /// Gears asked for.
        count: usize,
    },
    /// A gear hangs on one that does not come before it, or belongs to no pair.
    #[error(
        "gear {name} refers to a gear or pair that is not listed before it; list gears from the first one outwards"
    )]
    Unknown {
        /// The gear.
        name: String,
    },
    /// Two gears that should mesh are not of one pair.
    #[error(
        "{first} and {second} are not the two gears of one pair, so they cannot mesh; let a driver mesh with a follower of its own pair"
    )]
    NotAPair {
        /// One.
        first: String,
        /// The other.
        second: String,
    },
    /// Two gears are in each other's way.
    #[error("{first} and {second} would collide when the driver stands at {:.0} degrees; bend the train otherwise, or put one of them in another layer", at.to_degrees())]
    Collision {
        /// One.
        first: String,
        /// The other.
        second: String,
        /// Driver angle, radians.
        at: f64,
    },
    /// A ring of an odd number, or of too few gears.
    #[error("a ring of {count} gears cannot turn; give an even number from 4 on")]
    RingCount {
        /// Gears asked for.
        count: usize,
    },
    /// The last gear of a ring asks the first to turn otherwise than it does.
    #[error("the ring does not close: the last gear would have the first stand up to {:.2} degrees from where it is (at most {:.2} are taken up by play); use pairs with a shorter period or another number of gears, or leave the chain open", off.to_degrees(), allowed.to_degrees())]
    Open {
        /// Greatest distance of the first gear's angle from itself, handed round, radians.
        off: f64,
        /// What would be accepted, radians.
        allowed: f64,
    },
    /// The laws of the meshes add up to a motion that no teeth bear.
    #[error("{gear} would turn {speed:.0} times as fast as the first gear when that stands at {:.0} degrees; use fewer gears, bend the train (--layout auto), or take a pair whose speed changes less", at.to_degrees())]
    TooFast {
        /// The gear.
        gear: String,
        /// Its greatest speed over that of the first gear.
        speed: f64,
        /// Driver angle there, radians.
        at: f64,
    },
    /// The motion does not repeat within the cycles that are looked through.
    #[error(
        "the train does not come back to its first pose within {} turns of its driver; use pairs of simpler ratios",
        policy::TRAIN_MOST_CYCLES
    )]
    NeverRepeats,
}

/// A train: the assembly and what is known of it beyond.
#[derive(Clone, Debug)]
pub struct Train {
    /// The gears on their axles with one whole cycle of their motion. Every gear's frame is turned so that its angle
    /// is zero in the first pose.
    pub assembly: Assembly,
    /// Module of the finest pair, mm.
    pub module: f64,
}

impl TrainPlan {
    /// `count` gears in a row, of one pair: driver, follower, driver's twin, and so on.
    ///
    /// # Errors
    /// [`TrainError::Count`], [`TrainError::RingCount`].
    pub fn chain(
        pair: PairModel,
        count: usize,
        layout: Layout,
        thickness: f64,
    ) -> Result<Self, TrainError> {
        if !(2..=policy::TRAIN_MOST_GEARS).contains(&count) {
            return Err(TrainError::Count { count });
        }
        let ring = matches!(layout, Layout::Ring(_));
        if ring && (count < 4 || count % 2 == 1) {
            return Err(TrainError::RingCount { count });
        }
        let mut direction = 0.0;
        let gears = (0..count)
            .map(|i| {
                let side = if i % 2 == 0 { Side::Driver } else { Side::Follower };
                if i > 0 {
                    direction = match layout {
                        Layout::Straight => 0.0,
                        Layout::ZigZag(bend) if i % 2 == 1 => bend,
                        Layout::ZigZag(bend) => -bend,
                        Layout::Arc(_) | Layout::Ring(_) if i == 1 => 0.0,
                        Layout::Arc(bend) => direction + bend,
                        Layout::Ring(skew) => {
                            let skew = if i % 2 == 0 { skew } else { -skew };
                            direction + TAU / count as f64 + skew
                        }
                    };
                }
                TrainGear {
                    name: format!("gear{:02}", i + 1),
                    pair: 0,
                    side,
                    link: (i > 0).then(|| (i - 1, Link::Mesh { direction })),
                }
            })
            .collect();
        let closing = if ring { vec![[0, count - 1]] } else { Vec::new() };
        Ok(Self { pairs: vec![pair], gears, closing, thickness })
    }

    /// Puts the gears on their axles and works out how each turns; no two may collide, and rings must close.
    ///
    /// # Errors
    /// See [`TrainError`].
    pub fn assemble(&self) -> Result<Train, TrainError> {
        let train = self.placed()?;
        self.judge(&train)?;
        Ok(train)
    }

    /// Looks for collisions of a train that stands, and for rings that do not close.
    ///
    /// # Errors
    /// [`TrainError::Collision`], [`TrainError::Open`].
    pub fn judge(&self, train: &Train) -> Result<(), TrainError> {
        self.check_rings(&train.assembly)?;
        collisions::check(&train.assembly)
    }

    /// The gears on their axles, whether or not they collide: for looking at.
    ///
    /// # Errors
    /// See [`TrainError`]; not [`TrainError::Collision`] or [`TrainError::Open`].
    pub fn placed(&self) -> Result<Train, TrainError> {
        self.check()?;
        let axes = self.axes();
        let (cycle, per_cycle) = self.cycle(&axes)?;
        let count = policy::MOTION_SAMPLES * per_cycle;
        let driver_angle: Vec<f64> = (0..=count).map(|i| cycle * i as f64 / count as f64).collect();
        let starts = self.rotations(&axes, 0.0);
        let mut angles = vec![Vec::with_capacity(driver_angle.len()); self.gears.len()];
        for &phi in &driver_angle {
            for ((angle, rotation), start) in
                angles.iter_mut().zip(self.rotations(&axes, phi)).zip(&starts)
            {
                angle.push(rotation - start);
            }
        }
        self.check_speeds(&driver_angle, &angles)?;
        let mut meshes = Vec::new();
        let mut fixed = Vec::new();
        for (i, gear) in self.gears.iter().enumerate() {
            match gear.link {
                Some((on, Link::Mesh { .. })) => meshes.push([on, i]),
                Some((on, Link::Axle { .. })) => fixed.push([on, i]),
                None => {}
            }
        }
        meshes.extend(&self.closing);
        let gears = self
            .gears
            .iter()
            .zip(axes.iter().zip(starts))
            .zip(angles)
            .map(|((gear, (&(axis, level), start)), angle)| {
                let model = &self.pairs[gear.pair].gears[gear.side];
                let gear = turned(model, start, gear.name.clone());
                PlacedGear { gear, axis, level, angle }
            })
            .collect();
        let assembly = Assembly {
            gears,
            driver_angle,
            thickness: self.thickness,
            meshes,
            axles: fixed,
            fixtures: Vec::new(),
        };
        let module = self.pairs.iter().map(|p| p.module).fold(f64::INFINITY, f64::min);
        Ok(Train { assembly, module })
    }

    /// The first mesh of each pair in which its follower drives its driver: the pair's number and the two gears.
    #[must_use]
    pub fn driven_by_followers(&self) -> Vec<(usize, [usize; 2])> {
        let mut found: Vec<(usize, [usize; 2])> = Vec::new();
        for (i, gear) in self.gears.iter().enumerate() {
            if let Some((on, Link::Mesh { .. })) = gear.link
                && gear.side == Side::Driver
                && found.iter().all(|f| f.0 != gear.pair)
            {
                found.push((gear.pair, [on, i]));
            }
        }
        found
    }

    fn check(&self) -> Result<(), TrainError> {
        let count = self.gears.len();
        if !(2..=policy::TRAIN_MOST_GEARS).contains(&count) {
            return Err(TrainError::Count { count });
        }
        for (i, gear) in self.gears.iter().enumerate() {
            let unknown = || TrainError::Unknown { name: gear.name.clone() };
            if gear.pair >= self.pairs.len() || gear.link.is_some() != (i > 0) {
                return Err(unknown());
            }
            let Some((on, link)) = gear.link else { continue };
            let other = self.gears.get(on).filter(|_| on < i).ok_or_else(unknown)?;
            if matches!(link, Link::Mesh { .. }) {
                self.one_pair(other, gear)?;
            }
        }
        for &[a, b] in &self.closing {
            match (self.gears.get(a), self.gears.get(b)) {
                (Some(a), Some(b)) => self.one_pair(a, b)?,
                _ => return Err(TrainError::Unknown { name: format!("number {}", a.max(b) + 1) }),
            }
        }
        Ok(())
    }

    fn one_pair(&self, a: &TrainGear, b: &TrainGear) -> Result<(), TrainError> {
        if a.pair == b.pair && a.side == b.side.partner() {
            return Ok(());
        }
        Err(TrainError::NotAPair { first: a.name.clone(), second: b.name.clone() })
    }

    /// Place of each axis and height of each lower face, mm.
    pub(super) fn axes(&self) -> Vec<(Point, f64)> {
        let mut axes: Vec<(Point, f64)> = Vec::with_capacity(self.gears.len());
        for gear in &self.gears {
            axes.push(match gear.link {
                None => (Point::origin(), 0.0),
                Some((on, Link::Mesh { direction })) => {
                    let (sin, cos) = direction.sin_cos();
                    let step = self.pairs[gear.pair].center_distance * Vector::new(cos, sin);
                    (axes[on].0 + step, axes[on].1)
                }
                Some((on, Link::Axle { rise, .. })) => (axes[on].0, axes[on].1 + rise),
            });
        }
        axes
    }

    /// World rotation of every gear's model frame when the first has turned by `phi` from the first pose, in which its
    /// first mesh stands as its pair was designed to begin.
    pub(super) fn rotations(&self, axes: &[(Point, f64)], phi: f64) -> Vec<f64> {
        let mut angles: Vec<f64> = Vec::with_capacity(self.gears.len());
        for (i, gear) in self.gears.iter().enumerate() {
            let angle = match gear.link {
                None => self.start(axes) + phi,
                Some((on, Link::Axle { turn, .. })) => angles[on] + turn,
                Some((on, Link::Mesh { .. })) => self.handed_on(axes, [on, i], angles[on]),
            };
            angles.push(angle);
        }
        angles
    }

    /// The first gear's rotation in the first pose.
    fn start(&self, axes: &[(Point, f64)]) -> f64 {
        let first = self
            .gears
            .iter()
            .position(|g| matches!(g.link, Some((on, Link::Mesh { .. })) if on == 0));
        let direction = first.map_or(0.0, |i| toward(axes, [0, i]));
        match self.gears[0].side {
            Side::Driver => direction,
            Side::Follower => direction + PI - self.pairs[self.gears[0].pair].motion.psi(0.0),
        }
    }

    /// Rotation of `to` that meshes with the rotation `angle` of `from`.
    fn handed_on(&self, axes: &[(Point, f64)], [from, to]: [usize; 2], angle: f64) -> f64 {
        let motion = &self.pairs[self.gears[to].pair].motion;
        let direction = toward(axes, [from, to]);
        match self.gears[to].side {
            Side::Follower => direction - motion.psi(angle - direction),
            // Seen from the driver, the line of centres points the other way.
            Side::Driver => {
                let line = direction + PI;
                line + motion.inverse(line - angle)
            }
        }
    }

    /// Driver angle after which every gear stands as at first, and how many cycles of the first pair that is.
    pub(super) fn cycle(&self, axes: &[(Point, f64)]) -> Result<(f64, usize), TrainError> {
        let one = self.pairs[self.gears[0].pair].motion.cycle();
        let one = match self.gears[0].side {
            Side::Driver => one,
            Side::Follower => self.pairs[self.gears[0].pair].motion.psi(one),
        };
        let starts = self.rotations(axes, 0.0);
        (1..=policy::TRAIN_MOST_CYCLES)
            .find(|&n| {
                let ends = self.rotations(axes, one * n as f64);
                ends.iter().zip(&starts).all(|(end, start)| {
                    let turns = (end - start) / TAU;
                    (turns - turns.round()).abs() < policy::TRAIN_REPEAT
                })
            })
            .map(|n| (one * n as f64, n))
            .ok_or(TrainError::NeverRepeats)
    }

    /// No gear may pass more than [`policy::TRAIN_TEETH_PER_SAMPLE`] of its teeth from one motion sample to the next.
    fn check_speeds(&self, driver_angle: &[f64], angles: &[Vec<f64>]) -> Result<(), TrainError> {
        for (gear, angle) in self.gears.iter().zip(angles) {
            let teeth = self.pairs[gear.pair].gears[gear.side].teeth.max(1);
            let fastest = (1..angle.len())
                .map(|k| (k, (angle[k] - angle[k - 1]).abs()))
                .max_by(|a, b| a.1.total_cmp(&b.1));
            let Some((k, step)) = fastest else { continue };
            // Written so that an angle that is no number is refused too.
            let told = step <= policy::TRAIN_TEETH_PER_SAMPLE * TAU / f64::from(teeth);
            if !told {
                return Err(TrainError::TooFast {
                    gear: gear.name.clone(),
                    speed: step / (driver_angle[k] - driver_angle[k - 1]),
                    at: driver_angle[k],
                });
            }
        }
        Ok(())
    }

    /// What a mesh that closes a ring asks of its second gear must be what that gear does.
    fn check_rings(&self, assembly: &Assembly) -> Result<(), TrainError> {
        for &[first, last] in &self.closing {
            let off = self.opening(assembly, [first, last]);
            let gear = &self.gears[last];
            let pitch = TAU / f64::from(self.pairs[gear.pair].gears[gear.side].teeth);
            let allowed = policy::RING_SHARE_OF_PITCH * pitch;
            if off > allowed {
                return Err(TrainError::Open { off, allowed });
            }
        }
        Ok(())
    }

    /// How far the gears of a closing mesh stand from meshing, at most, radians of the second one.
    fn opening(&self, assembly: &Assembly, [first, last]: [usize; 2]) -> f64 {
        let axes: Vec<(Point, f64)> = assembly.gears.iter().map(|g| (g.axis, g.level)).collect();
        let gear = &self.gears[last];
        let model = &self.pairs[gear.pair].gears[gear.side];
        let same = TAU / f64::from(symmetry(model));
        let stride = (assembly.driver_angle.len() / policy::RING_SAMPLES).max(1);
        assembly
            .driver_angle
            .iter()
            .step_by(stride)
            .map(|&phi| {
                let rotations = self.rotations(&axes, phi);
                let off = self.handed_on(&axes, [first, last], rotations[first]) - rotations[last];
                (off - same * (off / same).round()).abs()
            })
            .fold(0.0, f64::max)
    }

    /// The chain bent into the ring that comes nearest to closing.
    ///
    /// # Errors
    /// As for [`TrainPlan::chain`].
    pub fn ring(pair: &PairModel, count: usize, thickness: f64) -> Result<Self, TrainError> {
        let made = |skew: f64| Self::chain(pair.clone(), count, Layout::Ring(skew), thickness);
        let even = TAU / count as f64;
        // Sharper corners push the gears beside them into each other.
        let most = even.min(policy::RING_SHARPEST_TURN - even).max(0.0);
        let (mut middle, mut reach) = (0.0, most);
        // A second look between the neighbours of the best finds the place exactly enough.
        for _ in 0..2 {
            let step = 2.0 * reach / (policy::RING_TRIES - 1) as f64;
            let skews: Vec<f64> = (0..policy::RING_TRIES)
                .map(|i| (middle - reach + step * i as f64).clamp(-most, most))
                .collect();
            let best = skews
                .par_iter()
                .map(|&skew| Ok((made(skew)?.openness(), skew)))
                .collect::<Result<Vec<_>, TrainError>>()?
                .into_iter()
                .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.abs().total_cmp(&b.1.abs())));
            middle = best.map_or(middle, |b| b.1);
            reach = step;
        }
        made(middle)
    }

    /// Greatest opening of the closing meshes, radians.
    fn openness(&self) -> f64 {
        let axes = self.axes();
        let Ok((cycle, _)) = self.cycle(&axes) else { return f64::INFINITY };
        let angles: Vec<f64> = (0..policy::RING_SAMPLES)
            .map(|i| cycle * i as f64 / policy::RING_SAMPLES as f64)
            .collect();
        let place = |&(axis, level): &(Point, f64), gear: &TrainGear| PlacedGear {
            gear: self.pairs[gear.pair].gears[gear.side].clone(),
            axis,
            level,
            angle: Vec::new(),
        };
        let bare = Assembly {
            gears: axes.iter().zip(&self.gears).map(|(a, g)| place(a, g)).collect(),
            driver_angle: angles,
            thickness: self.thickness,
            meshes: Vec::new(),
            axles: Vec::new(),
            fixtures: Vec::new(),
        };
        self.closing.iter().map(|&mesh| self.opening(&bare, mesh)).fold(0.0, f64::max)
    }
}

/// Direction from one axis to another, radians.
pub(super) fn toward(axes: &[(Point, f64)], [from, to]: [usize; 2]) -> f64 {
    let line = axes[to].0 - axes[from].0;
    line.y.atan2(line.x)
}

/// The gear in a frame in which it need not be turned for the first pose.
fn turned(gear: &Gear, angle: f64, name: String) -> Gear {
    let turn = |points: &[Point]| points.iter().map(|&p| geometry::rotate(p, angle)).collect();
    Gear {
        name,
        outline: turn(&gear.outline),
        bore: gear.bore.as_deref().map(turn),
        pitch_curve: turn(&gear.pitch_curve),
        input: turn(&gear.input),
        fittings: gear.fittings.clone().turned(angle),
        ..gear.clone()
    }
}

/// The greatest number of equal parts that the outline's turn is made of, a divisor of its teeth.
fn symmetry(gear: &Gear) -> u32 {
    let outline = &gear.outline;
    let reach = outline.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
    let stride = (outline.len() / policy::SYMMETRY_PROBES).max(1);
    let repeats = |parts: u32| {
        let turn = TAU / f64::from(parts);
        outline.iter().step_by(stride).all(|&p| {
            let q = geometry::rotate(p, turn);
            let n = outline.len();
            (0..n).any(|i| {
                let (a, b) = (outline[i], outline[(i + 1) % n]);
                let along = b - a;
                let t = ((q - a).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
                (a + along * t - q).norm() < policy::SYMMETRY_TOLERANCE * reach
            })
        })
    };
    let teeth = gear.teeth.max(1);
    (1..=teeth)
        .rev()
        .filter(|parts| teeth.is_multiple_of(*parts))
        .find(|&parts| repeats(parts))
        .unwrap_or(1)
}

#[cfg(test)]
#[path = "train_tests.rs"]
mod tests;
