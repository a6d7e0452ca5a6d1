//! MJCF: a scene in which MuJoCo turns the gears by their teeth alone.

mod text;

use super::{Artifact, Encode, EncodeError, Entry, Parts};
use crate::assembly::{Assembly, PlacedGear};
use crate::gear::SampledMotion;
use crate::geometry::{Point, Vector, cross, perimeter};
use crate::meshing::convex_partition;
use crate::policy;
use std::f64::consts::{PI, TAU};
use std::io::{self, ErrorKind};

/// `scene.xml`: a hinge per gear, convex prisms that touch only those of the gears it meshes with,
/// a drive on the first gear and a load on the last. Gears on a shared axle are refused. Self-contained; it turns without
/// control. The designed motion is not in it: what turns the other gears is contact.
///
/// Units: time s, torque N mm, angles radians; lengths such that a module is [`policy::MJCF_MODULE`]
/// (`mm_per_unit` in the file says how long that is). World frame as everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mjcf {
    /// Torque that holds the last gear back, N mm; positive.
    pub load: f64,
    /// Speed of the driver, turns a minute; positive.
    pub rpm: f64,
    /// Coulomb friction between the flanks, zero or more.
    pub friction: f64,
    /// Density of the gears, kg/m^3; positive.
    pub density: f64,
    /// Steps while the driver turns by one tooth.
    pub steps_per_tooth: u32,
    /// Reach of a convex piece's hull over a dent, in modules.
    pub hull_tolerance: f64,
}

impl Default for Mjcf {
    fn default() -> Self {
        Self {
            load: policy::DEFAULT_LOAD,
            rpm: policy::DEFAULT_RPM,
            friction: policy::DEFAULT_FRICTION,
            density: policy::DEFAULT_DENSITY,
            steps_per_tooth: policy::MJCF_STEPS_PER_TOOTH,
            hull_tolerance: policy::HULL_TOLERANCE,
        }
    }
}

/// See [`Entry`].
pub(super) const ENTRY: Entry = Entry {
    name: "mjcf",
    files: &[(
        &["scene.xml"],
        "MuJoCo: the pair as rigid bodies that turn each other by their teeth (see `scenes/mujoco/`)",
    )],
    // A scene holds no shared axles and no sectors.
    holds: |assembly| assembly.axles.is_empty() && !assembly.swings(),
    encoders: |options| vec![Box::new(options.scene)],
    ..Entry::PLAIN
};

impl Encode for Mjcf {
    fn encode<'a>(&'a self, parts: Parts<'a>) -> Result<Vec<Artifact<'a>>, EncodeError> {
        let text = self.scene(parts.assembly).map_err(|why| EncodeError::new("scene.xml", why))?;
        Ok(vec![Artifact::bytes("scene.xml", text)])
    }
}

/// A scene in numbers, in the units of the file.
struct Scene<'a> {
    options: &'a Mjcf,
    mm_per_unit: f64,
    thickness: f64,
    /// Speed of the driver, radians a second.
    speed: f64,
    timestep: f64,
    /// Inertia of the last gear x speed^2 x greatest |psi''| over the load.
    kappa: f64,
    bodies: Vec<Body<'a>>,
    /// Gears that touch, by number.
    meshes: &'a [[usize; 2]],
}

struct Body<'a> {
    placed: &'a PlacedGear,
    axis: Point,
    pieces: Vec<Vec<Point>>,
    /// About the axis, N mm s^2.
    inertia: f64,
    /// Where the mass sits, from the axis.
    off_axis: f64,
    /// Radius of the axle that is drawn.
    axle: f64,
    /// Tip of the pointer that is drawn.
    pointer: Vector,
    /// World speed at the first pose over the driver's.
    speed_ratio: f64,
}

/// How a gear turns with the driver.
struct Turning {
    /// Sense of the world rotation, 1 or -1.
    sense: f64,
    motion: SampledMotion,
    /// Mean speed over the driver's.
    mean: f64,
    /// Greatest |psi''|, at least [`policy::LEAST_ACCELERATION`] of the mean ratio.
    curve: f64,
}

impl Mjcf {
    /// The file as text.
    ///
    /// # Errors
    /// [`ErrorKind::InvalidData`] for fewer than two gears, an outline without convex pieces, a motion
    /// that is none; [`ErrorKind::InvalidInput`] for options out of range.
    pub fn scene(&self, assembly: &Assembly) -> io::Result<String> {
        self.check()?;
        if assembly.gears.len() < 2 {
            let why = format!("it has {} gears, a scene needs two", assembly.gears.len());
            return Err(io::Error::new(ErrorKind::InvalidData, why));
        }
        if !assembly.axles.is_empty() {
            let why = "it has gears on a shared axle, which a scene does not hold; leave mjcf out";
            return Err(io::Error::new(ErrorKind::InvalidData, why));
        }
        if assembly.swings() {
            let why = "its gears are sectors that swing, which its motor cannot do; leave mjcf out";
            return Err(io::Error::new(ErrorKind::InvalidData, why));
        }
        Ok(text::text(&self.measure(assembly)?))
    }

    fn check(&self) -> io::Result<()> {
        let positive = [
            ("load", self.load),
            ("speed", self.rpm),
            ("density", self.density),
            ("number of steps a tooth", f64::from(self.steps_per_tooth)),
        ];
        let zero_or_more = [("friction", self.friction), ("hull tolerance", self.hull_tolerance)];
        let bad = positive
            .into_iter()
            .find(|(_, v)| !(*v > 0.0 && v.is_finite()))
            .or_else(|| zero_or_more.into_iter().find(|(_, v)| !(*v >= 0.0 && v.is_finite())));
        match bad {
            Some((name, value)) => {
                let why = format!("the {name} is {value}, it must be above zero");
                Err(io::Error::new(ErrorKind::InvalidInput, why))
            }
            None => Ok(()),
        }
    }

    fn measure<'a>(&'a self, assembly: &'a Assembly) -> io::Result<Scene<'a>> {
        let gears = &assembly.gears;
        let driver = &gears[0].gear;
        let module = perimeter(&driver.pitch_curve) / (PI * f64::from(driver.teeth));
        let mm_per_unit = module / policy::MJCF_MODULE;
        if !(mm_per_unit > 0.0 && mm_per_unit.is_finite()) {
            return Err(invalid("its driver has no pitch curve or no teeth"));
        }
        let speed = self.rpm * TAU / 60.0;
        let turnings = gears
            .iter()
            .map(|g| turning(&assembly.driver_angle, &g.angle))
            .collect::<io::Result<Vec<_>>>()?;
        let last = &turnings[gears.len() - 1];
        let mut inertias: Vec<f64> = gears
            .iter()
            .zip(&turnings)
            .map(|(g, t)| {
                // A flywheel for gears that the least step of a contact would throw: the same as in
                // the simulation beside this one, so that both can be compared.
                let torque = self.load * last.mean / t.mean;
                let least = policy::LEAST_KAPPA * torque / (t.curve * speed * speed);
                self.inertia(&g.gear.outline, assembly.thickness).max(least)
            })
            .collect();
        inertias[0] = inertias[0].max(inertias[1]);
        let bodies = gears
            .iter()
            .enumerate()
            .map(|(i, placed)| {
                let neighbour = if i == 0 { &gears[1] } else { &gears[i - 1] };
                let axis = placed.axis / mm_per_unit;
                let away = (neighbour.axis - placed.axis) / mm_per_unit;
                Ok(Body {
                    placed,
                    axis,
                    pieces: self.pieces(placed, mm_per_unit)?,
                    inertia: inertias[i],
                    off_axis: 0.5 * away.norm(),
                    axle: axle(placed, mm_per_unit),
                    pointer: pointer(placed, away) / mm_per_unit,
                    speed_ratio: turnings[i].sense * turnings[i].motion.derivative(0.0),
                })
            })
            .collect::<io::Result<Vec<_>>>()?;
        let tooth = TAU / f64::from(driver.teeth);
        Ok(Scene {
            options: self,
            mm_per_unit,
            thickness: assembly.thickness / mm_per_unit,
            speed,
            timestep: tooth / f64::from(self.steps_per_tooth) / speed,
            kappa: inertias[gears.len() - 1] * speed * speed * last.curve / self.load,
            bodies,
            meshes: &assembly.meshes,
        })
    }

    /// Moment of inertia of a gear about its axis, N mm s^2.
    fn inertia(&self, outline: &[Point], thickness: f64) -> f64 {
        let edges = outline.iter().zip(outline.iter().cycle().skip(1));
        let polar: f64 = edges
            .map(|(a, b)| {
                let (a, b): (Vector, Vector) = (a.coords, b.coords);
                cross(a, b) * (a.norm_squared() + a.dot(&b) + b.norm_squared()) / 12.0
            })
            .sum();
        // kg/m^3 to t/mm^3, so that t mm^2 is N mm s^2.
        self.density * 1e-12 * thickness * polar.abs()
    }

    /// Convex pieces of the outline in units of the file.
    fn pieces(&self, placed: &PlacedGear, mm_per_unit: f64) -> io::Result<Vec<Vec<Point>>> {
        let gear = &placed.gear;
        let scaled: Vec<Point> = gear.outline.iter().map(|p| p / mm_per_unit).collect();
        convex_partition(&scaled, self.hull_tolerance * policy::MJCF_MODULE)
            .map_err(|e| io::Error::new(ErrorKind::InvalidData, format!("{}: {e}", gear.name)))
    }
}

fn invalid(why: &str) -> io::Error {
    io::Error::new(ErrorKind::InvalidData, why)
}

fn turning(driver: &[f64], angle: &[f64]) -> io::Result<Turning> {
    let sense = if angle.last().is_some_and(|&a| a < 0.0) { -1.0 } else { 1.0 };
    let along: Vec<f64> = angle.iter().map(|a| sense * a).collect();
    let motion = SampledMotion::new(driver, &along)
        .map_err(|e| io::Error::new(ErrorKind::InvalidData, e.to_string()))?;
    let cycle = motion.cycle();
    let mean = (along[along.len() - 1] - along[0]) / cycle;
    let h = TAU / policy::ACCELERATION_SAMPLES as f64;
    let count = (cycle / h).ceil().min(policy::MOST_STEPS as f64) as usize;
    let curve = (0..count)
        .map(|i| i as f64 * h)
        .map(|a| (motion.derivative(a + h) - motion.derivative(a - h)).abs() / (2.0 * h))
        .fold(policy::LEAST_ACCELERATION * mean, f64::max);
    Ok(Turning { sense, motion, mean, curve })
}

/// Mean radius of the bore, or half a module.
fn axle(placed: &PlacedGear, mm_per_unit: f64) -> f64 {
    let ring = placed.gear.bore.as_deref().unwrap_or_default();
    if ring.is_empty() {
        return 0.5 * policy::MJCF_MODULE;
    }
    ring.iter().map(|p| p.coords.norm()).sum::<f64>() / ring.len() as f64 / mm_per_unit
}

/// Most of the way from the axis to the pitch curve, in a direction; mm, gear's frame.
fn pointer(placed: &PlacedGear, direction: Vector) -> Vector {
    let lean = |p: &Point| direction.dot(&p.coords) / p.coords.norm().max(f64::MIN_POSITIVE);
    let ahead = placed.gear.pitch_curve.iter().max_by(|a, b| lean(a).total_cmp(&lean(b)));
    ahead.map_or_else(Vector::zeros, |p| p.coords * text::POINTER_LENGTH)
}

#[cfg(test)]
mod tests {
    use super::super::tests::wavy_pair;
    use super::*;
    use crate::geometry::area;

    #[test]
    fn pieces_neighbours_and_sensors_are_in_the_scene() {
        let (assembly, _) = wavy_pair();
        let options = Mjcf::default();
        let text = options.scene(&assembly).unwrap();
        let scene = options.measure(&assembly).unwrap();
        let count = scene.bodies.iter().map(|b| b.pieces.len()).sum::<usize>();
        assert_eq!(text.matches("<mesh ").count(), count);
        assert_eq!(text.matches("type=\"mesh\" mesh=").count(), count);
        assert_eq!(text.matches("<joint ").count(), 2 + 1, "a default and one for each gear");
        for wanted in [
            "name=\"driver-follower/driver\"",
            "name=\"driver-follower/follower\"",
            "name=\"driver-follower/driver_torque\"",
        ] {
            assert!(text.contains(wanted), "{wanted}");
        }
        // Names that others may have too stand nowhere alone.
        for name in text.split(" name=\"").skip(1) {
            assert!(name.starts_with("driver-follower/"), "{name:.40}");
        }
        for class in text.split(" class=\"").skip(1) {
            assert!(class.starts_with("driver-follower/"), "{class:.40}");
        }
    }

    #[test]
    fn gears_of_a_train_touch_their_neighbours_only_and_the_last_is_loaded() {
        let (mut assembly, _) = wavy_pair();
        let mut third = assembly.gears[0].clone();
        third.gear.name = "third".to_owned();
        third.axis = Point::new(160.0, 0.0);
        assembly.gears.push(third);
        assembly.meshes.push([1, 2]);
        let text = Mjcf { load: 70.0, ..Mjcf::default() }.scene(&assembly).unwrap();
        let attribute = |line: &str, name: &str| -> u64 {
            let rest = line.split(&format!("{name}=\"")).nth(1).unwrap();
            rest.split('"').next().unwrap().parse().unwrap()
        };
        let flags: Vec<[u64; 2]> = text
            .lines()
            .filter(|l| {
                l.contains("/gear") && l.contains("<default class=") && l.contains("contype")
            })
            .map(|l| ["contype", "conaffinity"].map(|name| attribute(l, name)))
            .collect();
        let touch =
            |i: usize, k: usize| flags[i][0] & flags[k][1] != 0 || flags[k][0] & flags[i][1] != 0;
        let touching = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)].map(|(i, k)| touch(i, k));
        assert_eq!(touching, [false, true, false, false, true, false]);
        // The third turns counter-clockwise again, so its load pulls clockwise.
        assert!(
            text.contains(
                "joint=\"driver-follower-third/third\" gaintype=\"fixed\" gainprm=\"-1\""
            )
        );
        assert!(text.contains("biasprm=\"-70 0 0\""));
    }

    #[test]
    fn a_disc_has_the_inertia_of_the_textbook() {
        let disc: Vec<Point> = (0..4096)
            .map(|i| TAU * f64::from(i) / 4096.0)
            .map(|a| Point::new(20.0 * a.cos(), 20.0 * a.sin()))
            .collect();
        let options = Mjcf { density: 1000.0, ..Mjcf::default() };
        // m r^2 / 2 with m = 1e-9 t/mm^3 x area x 10 mm.
        let expected = 0.5 * 400.0 * 1e-9 * area(&disc) * 10.0;
        assert!((options.inertia(&disc, 10.0) / expected - 1.0).abs() < 1e-5);
    }

    #[test]
    fn light_gears_are_given_the_least_kappa() {
        let (assembly, _) = wavy_pair();
        let light = Mjcf { density: 1e-6, ..Mjcf::default() };
        let heavy = Mjcf { density: 1e9, ..Mjcf::default() };
        let kappa = |m: &Mjcf| m.measure(&assembly).unwrap().kappa;
        assert!((kappa(&light) / policy::LEAST_KAPPA - 1.0).abs() < 1e-9);
        assert!(kappa(&heavy) > 10.0);
    }

    #[test]
    fn one_gear_and_bad_options_are_refused() {
        let (mut assembly, _) = wavy_pair();
        for options in [
            Mjcf { load: -1.0, ..Mjcf::default() },
            Mjcf { rpm: f64::NAN, ..Mjcf::default() },
            Mjcf { friction: -0.1, ..Mjcf::default() },
        ] {
            assert_eq!(options.scene(&assembly).unwrap_err().kind(), ErrorKind::InvalidInput);
        }
        assembly.gears.pop();
        let refused = Mjcf::default().scene(&assembly).unwrap_err();
        assert_eq!(refused.kind(), ErrorKind::InvalidData);
    }
}
