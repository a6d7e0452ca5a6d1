//! A first look at strength: Lewis bending stress of every tooth, power and efficiency.
//!
//! Static and for one tooth that carries the whole load at its tip, as in W. Lewis's formula `stress = W / (b m Y)`
//! (Shigley, *Mechanical Engineering Design*, section 14-1): no dynamic factor, no stress concentration, no wear.

mod tooth;

pub use tooth::{FormFactor, form_factors};

use std::f64::consts::{PI, TAU};

use crate::gear::Side;
use crate::geometry::Point;
use crate::pitch::Centrodes;
use crate::policy;
use crate::teeth::Profile;

/// What the pair carries, and what it is like. Lengths in mm, torque in N mm, angles in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// Torque that holds the follower back.
    pub torque: f64,
    /// Speed of the driver, turns a minute.
    pub rpm: f64,
    /// Friction between the flanks.
    pub friction: f64,
}

impl Default for Load {
    fn default() -> Self {
        Self {
            torque: policy::DEFAULT_LOAD,
            rpm: policy::DEFAULT_RPM,
            friction: policy::DEFAULT_FRICTION,
        }
    }
}

/// Teeth that are loaded.
#[derive(Clone, Copy, Debug)]
pub struct Loaded<'a> {
    /// How the gears roll.
    pub centrodes: &'a Centrodes,
    /// Finished outlines of driver and follower.
    pub profiles: [&'a Profile; 2],
    /// Module, mm.
    pub module: f64,
    /// Thickness of both gears, mm.
    pub thickness: f64,
    /// Pressure angle of most flanks.
    pub pressure_angle: f64,
    /// Mean number of teeth in contact.
    pub contact_ratio: f64,
    /// What they carry.
    pub load: Load,
}

/// One tooth under the load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToothStress {
    /// The gear.
    pub side: Side,
    /// Number of the tooth on its gear, counter-clockwise, from zero.
    pub index: usize,
    /// Middle of its tip in the gear's frame, mm.
    pub tip: Point,
    /// Driver angle at which it is at the pitch point, radians.
    pub driver_angle: f64,
    /// Force along the pitch curve, N.
    pub force: f64,
    /// Lewis form factor Y, measured on the outline.
    pub form_factor: f64,
    /// Bending stress at its root, MPa.
    pub stress: f64,
}

/// What a load does to a pair.
#[derive(Clone, Debug, PartialEq)]
pub struct Strength {
    /// The load.
    pub load: Load,
    /// Teeth of the driver, then of the follower, each in order.
    pub teeth: Vec<ToothStress>,
    /// Mean power that the follower gives, W.
    pub power: f64,
    /// Share of the driver's work that reaches the follower, estimated.
    pub efficiency: f64,
}

impl Strength {
    /// The tooth of greatest stress; none when no tooth could be measured.
    #[must_use]
    pub fn weakest(&self) -> Option<&ToothStress> {
        self.teeth.iter().max_by(|a, b| a.stress.total_cmp(&b.stress))
    }
}

/// Stress in every tooth, power and efficiency.
///
/// The force on a tooth is that at the pitch point: with lean lambda, the normal force `T / (r_F cos(alpha + |lambda|))`
/// balances the follower's torque, and its part along the pitch curve is cos(alpha) of it. The loss by friction is that
/// of spur gears (Niemann and Winter, *Maschinenelemente*, vol. 2): teeth slide by `(1 + psi')` times their distance from the
/// pitch point, on average `p_b / 2 (1 - e + e^2 / 2)` with base pitch p_b and contact ratio e.
#[must_use]
pub fn strength(loaded: &Loaded<'_>) -> Strength {
    let Loaded { centrodes, module, pressure_angle, load, .. } = *loaded;
    // Cosine of the angle between the force and the way its point moves; a pair that binds has none.
    let arm = |phi: f64| {
        (pressure_angle + centrodes.lean(phi).abs()).cos().max(policy::LEAST_FORCE_COSINE)
    };
    let force =
        |phi: f64| load.torque * pressure_angle.cos() / (centrodes.follower_radius(phi) * arm(phi));
    let mut teeth = Vec::new();
    for (side, profile) in Side::BOTH.into_iter().zip(loaded.profiles) {
        let places = pitch_places(centrodes, side);
        let factors = form_factors(profile, module);
        teeth.extend(factors.iter().map(|factor| {
            let tip = factor.tip;
            let nearest = places
                .iter()
                .min_by(|a, b| (a.1 - tip).norm().total_cmp(&(b.1 - tip).norm()))
                .map_or(0.0, |p| p.0);
            let force = force(nearest);
            ToothStress {
                side,
                index: factor.index,
                tip,
                driver_angle: nearest,
                force,
                form_factor: factor.value,
                stress: force / (loaded.thickness * module * factor.value),
            }
        }));
    }
    let e = loaded.contact_ratio.clamp(1.0, 2.0);
    let slide = 0.5 * PI * module * pressure_angle.cos() * (1.0 - e + 0.5 * e * e);
    let motion = &centrodes.transmission;
    let n = policy::PITCH_CURVE_POINTS;
    let step = motion.driver_period() / n as f64;
    // Work for an even torque on the follower goes with psi'.
    let (mut given, mut taken) = (0.0, 0.0);
    for i in 0..n {
        let phi = i as f64 * step;
        let p = motion.derivative(phi);
        let at = centrodes.pitch_point(phi);
        let lost = load.friction * at.relative_turn() * slide / (at.radii().driver * arm(phi));
        given += p;
        taken += p * (1.0 + lost);
    }
    let follower_speed = load.rpm * TAU / 60.0 / motion.ratio();
    Strength {
        load,
        teeth,
        // N mm to N m.
        power: load.torque * 1e-3 * follower_speed,
        efficiency: given / taken,
    }
}

/// Driver angles and pitch points of one gear, in its frame, over a whole cycle of both.
fn pitch_places(centrodes: &Centrodes, side: Side) -> Vec<(f64, Point)> {
    let motion = &centrodes.transmission;
    let (turns, fold) = match side {
        Side::Driver => {
            (motion.driver_period() * f64::from(motion.driver_fold()), motion.driver_fold())
        }
        Side::Follower => (centrodes.follower_turn(), motion.follower_fold()),
    };
    let n = policy::PITCH_CURVE_POINTS * fold as usize;
    (0..n)
        .map(|i| turns * i as f64 / n as f64)
        .map(|phi| match side {
            Side::Driver => (phi, centrodes.driver_point(phi)),
            Side::Follower => (phi, centrodes.follower_point(phi)),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pitch::Transmission;
    use crate::teeth::{TeethOptions, ToothedPair, involute_pair};

    fn pair(teeth: u32, law: impl Fn(f64) -> f64) -> (Centrodes, ToothedPair) {
        let samples: Vec<f64> = (0..512).map(|i| law(TAU * f64::from(i) / 512.0)).collect();
        let transmission = Transmission::from_derivative(&samples, 1, 1).unwrap();
        let centrodes = Centrodes { transmission, center_distance: 2.0 * f64::from(teeth) };
        let options = TeethOptions { driver_teeth: teeth, ..TeethOptions::default() };
        let made = involute_pair(&centrodes, &options).unwrap();
        (centrodes, made)
    }

    fn loaded<'a>(centrodes: &'a Centrodes, pair: &'a ToothedPair) -> Loaded<'a> {
        Loaded {
            centrodes,
            profiles: [&pair.driver, &pair.follower],
            module: pair.module,
            thickness: 10.0,
            pressure_angle: 20_f64.to_radians(),
            contact_ratio: 1.6,
            load: Load { torque: 1000.0, rpm: 60.0, friction: 0.1 },
        }
    }

    /// The tabulated factors are of teeth with the fillet of their day; ours is swept by a sharp tip with a quarter
    /// module of room, so the three may differ by 6 per cent.
    #[test]
    fn form_factors_are_those_of_the_table() {
        for (teeth, tabulated) in [(20, 0.322), (40, 0.389), (100, 0.446)] {
            let (_, pair) = pair(teeth, |_| 1.0);
            for profile in [&pair.driver, &pair.follower] {
                let factors = form_factors(profile, pair.module);
                assert_eq!(factors.len(), teeth as usize);
                for factor in factors {
                    assert!((factor.value / tabulated - 1.0).abs() < 0.06, "{teeth}: {factor:?}");
                }
            }
        }
    }

    #[test]
    fn round_gears_carry_as_the_formula_says() {
        let (centrodes, pair) = pair(40, |_| 1.0);
        let found = strength(&loaded(&centrodes, &pair));
        // Module 2, radius 40 mm: 25 N at the pitch circle.
        let weakest = found.weakest().unwrap();
        assert!((weakest.force - 25.0).abs() < 1e-6, "{weakest:?}");
        let exact = 25.0 / (10.0 * 2.0 * weakest.form_factor);
        assert!((weakest.stress - exact).abs() < 1e-9);
        // 1 N m at 60 turns a minute.
        assert!((found.power - TAU).abs() < 1e-9);
        let lost = 0.1 * PI * (2.0 / 40.0) * (1.0 - 1.6 + 1.28);
        assert!((1.0 / found.efficiency - 1.0 - lost).abs() < 1e-4, "{}", found.efficiency);
    }

    #[test]
    fn the_weakest_tooth_of_an_oval_sits_where_the_force_is_greatest() {
        let (centrodes, pair) = pair(40, |phi| 1.0 + 0.4 * phi.cos());
        let found = strength(&loaded(&centrodes, &pair));
        assert_eq!(found.teeth.len(), 80);
        let weakest = found.weakest().unwrap();
        // The follower's arm is shortest at driver angle 0.
        let off = weakest.driver_angle.min(TAU - weakest.driver_angle);
        assert!(off < 1.0, "{weakest:?}");
        assert!(found.teeth.iter().all(|t| t.stress.is_finite() && t.stress > 0.0));
        assert!((0.8..1.0).contains(&found.efficiency));
    }
}
