//! The play of every mesh of a train, and how it adds up.

use super::{MeshPlay, Motions, TrainPlay, TrainRunError, module_of};
use crate::assembly::{Assembly, PlacedGear};
use crate::control::Control;
use crate::gear::{Motion, SampledMotion};
use crate::geometry::{self, Point};
use crate::meshing::contact::{ContactInput, ContactOptions, poses_at};
use crate::meshing::pose::ContactPose;
use crate::policy;

/// Measures the free play of every mesh at `poses` poses of the train's cycle.
///
/// # Errors
/// [`TrainRunError`].
pub fn train_play(
    assembly: &Assembly,
    poses: usize,
    control: &Control,
) -> Result<TrainPlay, TrainRunError> {
    let motions = Motions::new(assembly)?;
    let cycle = motions.0[0].cycle();
    let angles: Vec<f64> =
        (0..poses).map(|i| ((i as f64 + 0.5) * policy::GOLDEN_FRACTION).fract() * cycle).collect();
    let mut meshes = Vec::new();
    let mut all: Vec<(usize, usize, Vec<ContactPose>)> = Vec::new();
    for &[a, b] in &assembly.meshes {
        let found = mesh_poses(assembly, &motions, [a, b], &angles, control)?;
        let play = |p: &ContactPose| p.play_behind + p.play_ahead;
        let free = || found.iter().filter(|p| !p.lost && !p.lost_reversed).map(play);
        meshes.push(MeshPlay {
            gears: [a, b],
            play: [free().fold(f64::INFINITY, f64::min), free().fold(0.0, f64::max)],
            lost: found.iter().filter(|p| p.lost).count(),
            poses: found.len(),
            interference: found.iter().map(|p| p.interference).fold(0.0, f64::max),
        });
        all.push((a, b, found));
    }
    let mut accumulated = vec![0.0_f64; assembly.gears.len()];
    for (k, &phi) in angles.iter().enumerate() {
        let mut here = vec![0.0; assembly.gears.len()];
        for i in 1..assembly.gears.len() {
            let speed = |j: usize| motions.0[j].derivative(phi);
            if let Some(&[on, _]) = assembly.axles.iter().find(|a| a[1] == i) {
                here[i] = here[on];
            } else if let Some((on, _, found)) = all.iter().find(|m| m.1 == i && m.0 < i) {
                let own = found[k].play_behind + found[k].play_ahead;
                here[i] = here[*on] * speed(i) / speed(*on) + own;
            }
            accumulated[i] = accumulated[i].max(here[i]);
        }
    }
    Ok(TrainPlay { meshes, accumulated })
}

/// How the second gear of a mesh turns with its first, by way of the train's driver.
#[derive(Debug)]
struct MeshMotion<'a> {
    first: &'a SampledMotion,
    second: &'a SampledMotion,
}

impl Motion for MeshMotion<'_> {
    fn psi(&self, angle: f64) -> f64 {
        self.second.psi(self.first.inverse(angle))
    }

    fn derivative(&self, angle: f64) -> f64 {
        let driver_angle = self.first.inverse(angle);
        self.second.derivative(driver_angle) / self.first.derivative(driver_angle)
    }

    fn cycle(&self) -> f64 {
        self.first.psi(self.first.cycle())
    }
}

/// The contact of one mesh, seen as a pair: its line of centres along +x, its first gear turning counter-clockwise.
pub(super) fn mesh_poses(
    assembly: &Assembly,
    motions: &Motions,
    [a, b]: [usize; 2],
    driver_angles: &[f64],
    control: &Control,
) -> Result<Vec<ContactPose>, TrainRunError> {
    let (first, second) = (&assembly.gears[a], &assembly.gears[b]);
    let line = second.axis - first.axis;
    let direction = line.y.atan2(line.x);
    let mirrored = first.sense() < 0.0;
    let seen = |placed: &PlacedGear| -> Vec<Point> {
        let turned = placed.gear.outline.iter().map(|&p| geometry::rotate(p, -direction));
        if mirrored {
            let mut points: Vec<Point> = turned.map(|p| Point::new(p.x, -p.y)).collect();
            points.reverse();
            points
        } else {
            turned.collect()
        }
    };
    let (driver, follower) = (seen(first), seen(second));
    let angles: Vec<f64> = driver_angles.iter().map(|&phi| motions.0[a].psi(phi)).collect();
    let motion = MeshMotion { first: &motions.0[a], second: &motions.0[b] };
    let input = ContactInput {
        driver: &driver,
        follower: &follower,
        center_distance: line.norm(),
        module: module_of(first),
        motion: &motion,
        control,
    };
    poses_at(&input, &ContactOptions::default(), &angles).map_err(|source| TrainRunError::Contact {
        gears: format!("{} and {}", first.gear.name, second.gear.name),
        source,
    })
}
