//! Draws the pictures of docs/teeth.md.
//!
//! usage: cargo run --example teeth_pictures -- FOLDER

mod canvas;

use std::f64::consts::TAU;

use anyhow::Context;
use canvas::{Canvas, DARK, FAINT, INK, LIGHT, ORANGE, RED};
use centrode::geometry::{Point, Vector, quarter_turn, rotate};
use centrode::input::{LoadOptions, load};
use centrode::pipeline::{Design, DesignOptions, ToothCount, design};
use centrode::pitch::Centrodes;
use centrode::teeth::{
    Profile, TeethOptions, ToothedPair, involute_pair, regular_wave_pair, wave_pair,
};

fn main() -> anyhow::Result<()> {
    let folder = std::env::args().nth(1).context("give a folder for the pictures")?;
    let folder = std::path::Path::new(&folder);
    let heart = designed("heart", "dove", 32, 55.0)?;
    let sharp = designed("drop", "leaf", 24, 55.0)?;
    let steep = designed("dog", "bone", 64, 75.0)?;
    for (name, svg) in [
        ("frames.svg", frames(&heart)),
        ("mesh.svg", mesh(&heart)),
        ("line-of-action.svg", line_of_action(&heart)),
        ("undercut.svg", undercut(&sharp)?),
        ("root.svg", root(&heart)),
        ("figure20.svg", figure20(&steep)?),
    ] {
        std::fs::write(folder.join(name), svg)?;
    }
    Ok(())
}

fn designed(driver: &str, follower: &str, teeth: u32, lean: f64) -> anyhow::Result<Design> {
    let shapes = [load(driver, &LoadOptions::default())?, load(follower, &LoadOptions::default())?];
    let mut options = DesignOptions::new("1".parse()?);
    options.teeth = ToothCount::Teeth(teeth);
    options.fit.limits.max_lean = lean.to_radians();
    options.clearance = 0.0;
    options.repair = false;
    Ok(design(&shapes[0], &shapes[1], &options)?)
}

/// Rolling as the pictures need it: frames at a driver angle, driver angles at an arc length.
struct Rolling<'a> {
    centrodes: &'a Centrodes,
    /// Arc length at even driver angles over one period.
    arcs: Vec<f64>,
}

impl<'a> Rolling<'a> {
    const STEPS: usize = 4096;

    fn new(centrodes: &'a Centrodes) -> Self {
        let step = centrodes.transmission.driver_period() / Self::STEPS as f64;
        let arcs = std::iter::once(0.0)
            .chain((0..Self::STEPS).scan(0.0, |sum, i| {
                *sum += centrodes.arc_length(i as f64 * step, (i + 1) as f64 * step);
                Some(*sum)
            }))
            .collect();
        Self { centrodes, arcs }
    }

    fn period(&self) -> f64 {
        self.arcs[Self::STEPS]
    }

    fn angle(&self, s: f64) -> f64 {
        let turns = (s / self.period()).floor();
        let rest = s - turns * self.period();
        let i = self.arcs.partition_point(|&a| a <= rest).clamp(1, Self::STEPS) - 1;
        let part = (rest - self.arcs[i]) / (self.arcs[i + 1] - self.arcs[i]);
        let step = self.centrodes.transmission.driver_period() / Self::STEPS as f64;
        turns * self.centrodes.transmission.driver_period() + (i as f64 + part) * step
    }

    /// Pitch point, tangent and normal in the world.
    fn world(&self, phi: f64) -> (Point, Vector, Vector) {
        let lean = self.centrodes.lean(phi);
        let tangent = Vector::new(lean.sin(), -lean.cos());
        (Point::new(self.centrodes.driver_radius(phi), 0.0), tangent, quarter_turn(tangent))
    }

    /// The contact of the flank that crosses the pitch curve at `u`, in the driver's frame.
    fn flank(&self, u: f64, sigma: f64, alpha: f64, s: f64) -> Point {
        let phi = self.angle(s);
        let (pitch, tangent, normal) = self.world(phi);
        let along = (u - s) * alpha.cos();
        rotate(pitch + along * (alpha.cos() * tangent + sigma * alpha.sin() * normal), -phi)
    }
}

fn placed(points: &[Point], angle: f64, shift: f64) -> Vec<Point> {
    points.iter().map(|&p| rotate(p, angle) + Vector::new(shift, 0.0)).collect()
}

/// Both gears in the world at a driver angle.
fn posed(design: &Design, pair: [&Profile; 2], phi: f64) -> [Vec<Point>; 2] {
    let c = &design.centrodes;
    [
        placed(&pair[0].points, phi, 0.0),
        placed(&pair[1].points, -c.transmission.psi(phi), c.center_distance),
    ]
}

fn pitch_curves(canvas: &mut Canvas, c: &Centrodes, phi: f64) {
    let follower = placed(&c.follower_curve(720), -c.transmission.psi(phi), c.center_distance);
    canvas.ring(&placed(&c.driver_curve(720), phi, 0.0), "none", ORANGE, 0.3);
    canvas.ring(&follower, "none", ORANGE, 0.3);
}

/// Axes, angles, pitch point, tangent, normal, lean.
fn frames(design: &Design) -> String {
    let c = &design.centrodes;
    let phi = steepest(c);
    let rolling = Rolling::new(c);
    let driver = placed(&c.driver_curve(720), phi, 0.0);
    let follower = placed(&c.follower_curve(720), -c.transmission.psi(phi), c.center_distance);
    let mut canvas = Canvas::around(&[&driver[..], &follower[..]].concat(), 6.0);
    canvas.ring(&driver, LIGHT, DARK, 0.3);
    canvas.ring(&follower, FAINT, DARK, 0.3);
    let (pitch, tangent, normal) = rolling.world(phi);
    let axes = [Point::origin(), Point::new(c.center_distance, 0.0)];
    canvas.line(&axes, INK, 0.25);
    for (axis, name) in axes.into_iter().zip(["O_D", "O_F"]) {
        canvas.dot(axis, 0.9, INK);
        canvas.text(axis + Vector::new(-1.5, -5.0), name);
    }
    let length = 22.0;
    for (way, name) in [(tangent, "T"), (normal, "N")] {
        canvas.arrow(pitch, pitch + length * way, RED);
        canvas.text(pitch + (length + 3.0) * way + Vector::new(-1.0, -1.0), name);
    }
    canvas.arc(pitch, 13.0, 0.0, normal.y.atan2(normal.x), INK);
    let half = 0.5 * normal.y.atan2(normal.x);
    canvas.text(pitch + 15.0 * Vector::new(half.cos(), half.sin()) - Vector::new(0.0, 1.0), "λ");
    canvas.dot(pitch, 0.9, RED);
    canvas.text(pitch + Vector::new(-4.5, 2.0), "P");
    canvas.text(Point::new(0.5 * pitch.x - 2.0, 1.5), "r_D");
    canvas.text(Point::new(0.6 * c.center_distance + 0.4 * pitch.x + 4.0, 1.5), "r_F");
    canvas.arc_arrow(axes[0], 7.0, 0.6, 2.2, INK);
    canvas.text(Point::new(-9.0, 8.0), "φ");
    canvas.arc_arrow(axes[1], 7.0, 2.2, 0.6, INK);
    canvas.text(Point::new(c.center_distance + 5.0, 8.0), "ψ(φ)");
    canvas.finish("Pitch curves, pitch point, tangent, normal and lean")
}

fn steepest(c: &Centrodes) -> f64 {
    let lean = |i: usize| c.lean(i as f64 * TAU / 720.0).abs();
    let at = (0..720).max_by(|&a, &b| lean(a).total_cmp(&lean(b))).unwrap_or(0);
    at as f64 * TAU / 720.0
}

/// Teeth at the pitch point with the contacts found by the analysis; their normals pass through P.
fn mesh(design: &Design) -> String {
    let c = &design.centrodes;
    let poses = &design.exact_contact.poses;
    let touching = |p: &&centrode::meshing::ContactPose| p.contacts.len() >= 2;
    let Some(pose) = poses.iter().filter(touching).nth(3).or(poses.first()) else {
        return String::new();
    };
    let phi = pose.driver_angle;
    let module = design.pair.module;
    let pitch = Point::new(c.driver_radius(phi), 0.0);
    let mut canvas = Canvas::window(pitch, 5.5 * module, 4.0 * module);
    let gears = posed(design, [&design.pair.driver, &design.pair.follower], phi);
    canvas.ring(&gears[0], LIGHT, DARK, 0.12);
    canvas.ring(&gears[1], FAINT, DARK, 0.12);
    pitch_curves(&mut canvas, c, phi);
    canvas.line(&[pitch - Vector::new(99.0, 0.0), pitch + Vector::new(99.0, 0.0)], INK, 0.15);
    for contact in &pose.contacts {
        let far = 1.3 * (pitch - contact.point);
        canvas.line(&[contact.point, contact.point + far], RED, 0.3);
        canvas.dot(contact.point, 0.8, RED);
    }
    canvas.dot(pitch, 0.8, INK);
    canvas.text(pitch + Vector::new(0.3, -0.45) * module, "P");
    canvas.finish("Teeth in mesh: contact normals pass through the pitch point P")
}

/// Every contact of a cycle, relative to the pitch point it belongs to.
fn line_of_action(design: &Design) -> String {
    let module = design.pair.module;
    let mut canvas = Canvas::window(Point::origin(), 3.6 * module, 3.2 * module);
    let wide = 9.0 * module;
    canvas.line(&[Point::new(-wide, 0.0), Point::new(wide, 0.0)], INK, 0.15);
    canvas.line(&[Point::new(0.0, -wide), Point::new(0.0, wide)], INK, 0.15);
    let c = &design.centrodes;
    let rack = 20_f64.to_radians();
    for pose in &design.exact_contact.poses {
        let pitch = Vector::new(c.driver_radius(pose.driver_angle), 0.0);
        for contact in &pose.contacts {
            canvas.dot(contact.point - pitch, 0.16, DARK);
        }
    }
    // The flank pressed when the driver pushes: its line on a circle pair.
    let way = wide * Vector::new(rack.sin(), rack.cos());
    canvas.line(&[Point::from(-way), Point::from(way)], RED, 0.3);
    canvas.dot(Point::origin(), 0.7, RED);
    canvas.text(Point::new(0.25, -0.3) * module, "P");
    canvas.finish("Contact points of a whole cycle relative to the pitch point")
}

/// The flank of the driver that runs into its cusp first, drawn on beyond it.
fn undercut(design: &Design) -> anyhow::Result<String> {
    let c = &design.centrodes;
    let rolling = Rolling::new(c);
    let module = design.pair.module;
    let pitch = std::f64::consts::PI * module;
    let alpha = 20_f64.to_radians();
    // Signed speed of the driver's flank, delta measured outward along the rack.
    let speed = |u: f64, sigma: f64, delta: f64| {
        let (curvature, _) = c.curvatures(rolling.angle(u - sigma * delta));
        alpha.sin() + delta * curvature * alpha.cos()
    };
    let step = 0.02 * module;
    let below = || (1..150).map(|i| -step * f64::from(i));
    // Where the flank runs backwards longest.
    let backwards = |u: f64, sigma: f64| below().filter(|&d| speed(u, sigma, d) < 0.0).count();
    let teeth = (rolling.period() / pitch).round() as usize;
    let (_, u, sigma) = (0..teeth)
        .flat_map(|j| [-1.0, 1.0].map(|sigma| (j as f64 * pitch + sigma * 0.25 * pitch, sigma)))
        .map(|(u, sigma)| (backwards(u, sigma), u, sigma))
        .max_by_key(|found| found.0)
        .context("the gear has no teeth")?;
    let delta =
        below().find(|&d| speed(u, sigma, d) < 0.0).context("no flank of this pair is undercut")?;
    let at = |d: f64| rolling.flank(u, sigma, alpha, u - sigma * d);
    let turn = |p: Point| rotate(p, rolling.angle(u));
    let mut canvas = Canvas::window(turn(at(0.0)), 2.2 * module, 1.7 * module);
    canvas.ring(&placed(&design.pair.driver.points, rolling.angle(u), 0.0), LIGHT, DARK, 0.12);
    canvas.ring(&placed(&c.driver_curve(720), rolling.angle(u), 0.0), "none", ORANGE, 0.2);
    let run = |from: f64, to: f64| -> Vec<Point> {
        (0..=60).map(|i| turn(at(from + (to - from) * f64::from(i) / 60.0))).collect()
    };
    canvas.line(&run(3.2 * module, delta), RED, 0.25);
    canvas.dashed(&run(delta, -3.0 * module), RED, 0.25);
    canvas.dot(turn(at(delta)), 0.5, RED);
    canvas.text(turn(at(delta)) + Vector::new(-0.35, -0.15) * module, "cusp");
    Ok(canvas.finish("A flank and its cusp, at the rack's own pressure angle"))
}

/// The mate's tooth at many instants, in the driver's frame, over one space.
fn root(design: &Design) -> String {
    let c = &design.centrodes;
    let rolling = Rolling::new(c);
    let module = design.pair.module;
    let pitch = std::f64::consts::PI * module;
    let middle = 4.5 * pitch;
    let angle = rolling.angle(middle);
    let center = rotate(c.driver_point(angle), angle);
    let mut canvas = Canvas::window(center, 2.6 * module, 2.2 * module);
    canvas.ring(&placed(&design.pair.driver.points, angle, 0.0), LIGHT, DARK, 0.12);
    for k in -16..=16 {
        let phi = rolling.angle(middle + 1.3 * pitch * f64::from(k) / 16.0);
        let world =
            placed(&design.pair.follower.points, -c.transmission.psi(phi), c.center_distance);
        let seen: Vec<Point> = world.iter().map(|&p| rotate(p, angle - phi)).collect();
        let near = |p: &Point| (p - center).norm() < 3.2 * module;
        for run in seen.split(|p| !near(p)).filter(|run| run.len() > 1) {
            canvas.line(run, INK, 0.05);
        }
    }
    canvas.ring(&placed(&c.driver_curve(720), angle, 0.0), "none", ORANGE, 0.2);
    canvas.finish("The mate's tooth passing through a space")
}

/// Three styles of teeth at the steepest place of the same pitch curves.
fn figure20(design: &Design) -> anyhow::Result<String> {
    let c = &design.centrodes;
    let phi = steepest(c);
    let options = TeethOptions { driver_teeth: design.teeth[0], ..TeethOptions::default() };
    let pairs: [(&str, ToothedPair); 3] = [
        ("regular waves", regular_wave_pair(c, &options)?),
        ("waves, Eq. 17", wave_pair(c, &options)?),
        ("involute", involute_pair(c, &options)?),
    ];
    let module = design.pair.module;
    let pitch = Point::new(c.driver_radius(phi), 0.0);
    let half = 5.0 * module;
    let mut canvas = Canvas::window(pitch + Vector::new(2.0 * 1.05 * half, 0.0), 3.15 * half, half);
    for (i, (name, pair)) in pairs.iter().enumerate() {
        let shift = Vector::new(2.1 * half * i as f64, 0.0);
        let gears = posed(design, [&pair.driver, &pair.follower], phi);
        canvas.panel(pitch + shift, half);
        for (gear, fill) in gears.iter().zip([LIGHT, FAINT]) {
            let moved: Vec<Point> = gear.iter().map(|&p| p + shift).collect();
            canvas.ring(&moved, fill, DARK, 0.12);
        }
        canvas.dot(pitch + shift, 0.4, RED);
        canvas.end_panel();
        canvas.text(pitch + shift + Vector::new(-0.9 * half, -0.93 * half), name);
    }
    Ok(canvas.finish("Three styles of teeth at the steepest place of the same pitch curves"))
}
