//! Files of a design: one encoder per format, one registry of them, one way to the disk.
//!
//! An encoder ([`Encode`]) makes [`Artifact`]s of an [`Assembly`] and the checked solid of each of its gears; what it draws
//! of outlines (curves through their vertices) comes from [`crate::geometry::curves`]. [`Format`] lists the formats with
//! all that is known of each. Every file appears whole or not at all ([`write_atomically`]), those of a run all together
//! ([`Staging`]).

mod animation;
mod atomic;
mod contours;
mod dxf;
mod encode;
mod flat;
mod glb;
mod json;
mod keys;
mod laser_svg;
mod mjcf;
mod obj;
mod picture;
mod plate;
mod raster;
mod registry;
mod render;
mod staging;
mod step;
mod stl;
mod threemf;
mod xml;

pub use animation::Animation;
pub use atomic::{ExportError, check_folder, check_inputs, prepare_folder, write_atomically};
pub use dxf::Dxf;
pub use encode::{Artifact, Destination, Encode, EncodeError, write};
pub use glb::Glb;
pub use json::write_json;
pub use laser_svg::LaserSvg;
pub use mjcf::Mjcf;
pub use obj::Obj;
pub use picture::Picture;
pub use plate::Plate;
pub use registry::{Entry, ExportOptions, Format, UnknownFormat, Wanted};
pub use staging::Staging;
pub use step::Step;
pub use stl::Stl;
pub use threemf::ThreeMf;

use crate::assembly::Assembly;
use crate::solid::Mesh;

/// What exporters write.
#[derive(Clone, Copy, Debug)]
pub struct Parts<'a> {
    /// The gears, their places and their motion.
    pub assembly: &'a Assembly,
    /// The solid of each gear, in the gears' order, then of each fixture, each in its own frame, mm.
    pub meshes: &'a [Mesh],
}

impl<'a> Parts<'a> {
    /// Each gear with its solid.
    fn iter(self) -> impl ExactSizeIterator<Item = (&'a crate::assembly::PlacedGear, &'a Mesh)> {
        self.assembly.gears.iter().zip(self.meshes)
    }

    /// Each part that stands still with its solid.
    fn fixtures(self) -> impl ExactSizeIterator<Item = (&'a crate::assembly::Fixture, &'a Mesh)> {
        let rest = self.meshes.get(self.assembly.gears.len()..).unwrap_or_default();
        self.assembly.fixtures.iter().zip(rest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assembly::PlacedGear;
    use crate::geometry::Point;
    use crate::policy;
    use crate::solid::tests::wavy;
    use crate::solid::{Bore, assembly_solids};
    use std::f64::consts::TAU;

    /// Two wavy gears that turn by a law with a wave in it, in 1025 samples.
    pub(super) fn wavy_pair() -> (Assembly, Vec<Mesh>) {
        let driver_angle: Vec<f64> = (0..=1024).map(|i| TAU * f64::from(i) / 1024.0).collect();
        let law = |a: &f64| -(a + 0.4 * (1.0 - a.cos()) + 0.05 * (5.0 * a).sin());
        let follower = driver_angle.iter().map(law).collect();
        let gears = vec![
            PlacedGear {
                gear: wavy("driver", 640, Bore::Round { diameter: 5.0 }),
                axis: Point::origin(),
                level: 0.0,
                angle: driver_angle.clone(),
            },
            PlacedGear {
                gear: wavy("follower", 640, Bore::Lego { play: policy::LEGO_AXLE_PLAY }),
                axis: Point::new(80.0, 0.0),
                level: 0.0,
                angle: follower,
            },
        ];
        let assembly = Assembly {
            gears,
            driver_angle,
            thickness: 6.0,
            meshes: vec![[0, 1]],
            axles: Vec::new(),
            fixtures: Vec::new(),
        };
        let meshes = assembly_solids(&assembly).unwrap();
        (assembly, meshes)
    }

    /// A plain plate, its top 1 mm below the gears.
    pub(super) fn base() -> crate::assembly::Fixture {
        let outline = [(-10.0, -10.0), (90.0, -10.0), (90.0, 10.0), (-10.0, 10.0)];
        crate::assembly::Fixture {
            name: "base".to_owned(),
            outline: outline.map(|(x, y)| Point::new(x, y)).to_vec(),
            holes: Vec::new(),
            thickness: 4.0,
            posts: Vec::new(),
            pockets: Vec::new(),
            stance: crate::assembly::Stance::flat(-5.0),
        }
    }

    #[test]
    fn fixtures_are_in_the_files_of_solids() {
        let (mut assembly, _) = wavy_pair();
        assembly.fixtures.push(base());
        let meshes = assembly_solids(&assembly).unwrap();
        assert!((meshes[2].volume() - 8000.0).abs() < 1e-3);
        let folder = tempfile::tempdir().unwrap();
        let parts = Parts { assembly: &assembly, meshes: &meshes };
        let stl = Stl.write(parts, folder.path()).unwrap();
        assert_eq!(stl[2].file_name().unwrap(), "base.stl");
        assert_eq!(stl[2].metadata().unwrap().len(), 84 + 50 * 12);
        let obj = Obj.write(parts, folder.path()).unwrap().remove(0);
        let text = std::fs::read_to_string(obj).unwrap();
        assert_eq!(text.lines().filter(|l| l.starts_with("o ")).count(), 3);
        let below = text.split("o base").nth(1).unwrap().lines().filter(|l| l.starts_with("v "));
        let heights: Vec<f64> =
            below.map(|l| l.rsplit(' ').next().unwrap().parse().unwrap()).collect();
        assert!(heights.len() == 8 && heights.iter().all(|z| [-5.0, -1.0].contains(z)));
        let places = threemf::tests::places(parts);
        // Lifted so that the plate stands on zero.
        assert_eq!(places.iter().map(|p| p[11]).collect::<Vec<_>>(), [5.0, 5.0, 0.0]);
        assert!((places[2][9] - places[0][9]).abs() < 1e-6);
    }

    #[test]
    fn all_wanted_files_are_written_and_no_temporary_one_stays() {
        let (assembly, meshes) = wavy_pair();
        let folder = tempfile::tempdir().unwrap();
        let parts = Parts { assembly: &assembly, meshes: &meshes };
        let written = Wanted::default().write(parts, folder.path()).unwrap();
        assert!(written.iter().all(|p| p.metadata().unwrap().len() > 100));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), written.len());
    }
}
