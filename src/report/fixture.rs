//! A pair whose motion is known in closed form, for the tests of this room:
//! two equal ellipses turning about a focus each, with waves for teeth.

use super::{Note, NoteKind, Plot, ReportData, Section};
use crate::assembly::{Assembly, Fittings, Gear, PlacedGear};
use crate::diagnose::Verdict;
use crate::geometry::{Point, quarter_turn};
use std::f64::consts::{PI, TAU};

const ECCENTRICITY: f64 = 0.5;
const SEMI_AXIS: f64 = 40.0;
const TEETH: u32 = 36;
const WAVE: f64 = 1.8;

/// r_D = a (1 - e^2) / (1 - e cos phi), L = 2a, tan(psi/2) = (1 + e)/(1 - e) tan(phi/2).
pub(super) fn ellipses() -> Assembly {
    let samples = 1440;
    let phi: Vec<f64> = (0..=samples).map(|i| TAU * f64::from(i) / f64::from(samples)).collect();
    let psi: Vec<f64> = phi.iter().map(|&p| transmission(p)).collect();
    let fine: Vec<f64> = (0..2880).map(|i| TAU * f64::from(i) / 2880.0).collect();
    let mut driver: Vec<Point> = fine.iter().map(|&p| polar(radius(p), -p)).collect();
    driver.reverse();
    let follower: Vec<Point> =
        fine.iter().map(|&p| polar(2.0 * SEMI_AXIS - radius(p), PI + transmission(p))).collect();
    let gear = |name: &str, pitch_curve: Vec<Point>, phase: f64, bumps: f64| Gear {
        name: name.into(),
        outline: wavy(&pitch_curve, phase),
        bore: Some((0..48).map(|i| polar(2.5, TAU * f64::from(i) / 48.0)).collect()),
        input: pitch_curve
            .iter()
            .map(|p| p * (1.0 + 0.06 * (bumps * p.y.atan2(p.x)).sin()))
            .collect(),
        pitch_curve,
        teeth: TEETH,
        fittings: Fittings::default(),
    };
    Assembly {
        gears: vec![
            PlacedGear {
                gear: gear("driver", driver, 0.0, 5.0),
                axis: Point::origin(),
                level: 0.0,
                angle: phi.clone(),
            },
            PlacedGear {
                gear: gear("follower", follower, PI, 3.0),
                axis: Point::new(2.0 * SEMI_AXIS, 0.0),
                level: 0.0,
                angle: psi.iter().map(|p| -p).collect(),
            },
        ],
        driver_angle: phi,
        thickness: 6.0,
        meshes: vec![[0, 1]],
        axles: Vec::new(),
        fixtures: Vec::new(),
    }
}

fn radius(phi: f64) -> f64 {
    SEMI_AXIS * (1.0 - ECCENTRICITY * ECCENTRICITY) / (1.0 - ECCENTRICITY * phi.cos())
}

fn transmission(phi: f64) -> f64 {
    let gain = (1.0 + ECCENTRICITY) / (1.0 - ECCENTRICITY);
    let turns = (phi / TAU).round();
    2.0 * (gain * (0.5 * (phi - TAU * turns)).tan()).atan() + TAU * turns
}

fn slope(phi: f64) -> f64 {
    radius(phi) / (2.0 * SEMI_AXIS - radius(phi))
}

fn polar(r: f64, angle: f64) -> Point {
    Point::new(r * angle.cos(), r * angle.sin())
}

/// Waves along the outward normal, evenly spaced in arc length.
fn wavy(ring: &[Point], phase: f64) -> Vec<Point> {
    let length = crate::geometry::perimeter(ring);
    let n = ring.len();
    let mut s = 0.0;
    let mut out = Vec::with_capacity(n);
    for i in 0..n {
        let (before, here, after) = (ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]);
        let outward = -quarter_turn((after - before).normalize());
        let wave = (TAU * f64::from(TEETH) * s / length + phase).cos();
        out.push(here + outward * WAVE * wave);
        s += (after - here).norm();
    }
    out
}

/// A report with every kind of content.
pub(super) fn report() -> ReportData {
    let phi: Vec<f64> = (0..=2000).map(|i| TAU * f64::from(i) / 2000.0).collect();
    let over = |f: &dyn Fn(f64) -> f64| phi.iter().map(|&p| (p, f(p))).collect::<Vec<_>>();
    ReportData {
        title: "ellipse and ellipse".into(),
        command: "centrode design ellipse ellipse --center-distance 80mm -o out/ellipses".into(),
        made_by: "centrode 0.1.0".into(),
        verdict: Verdict::Warnings,
        summary: "The gears mesh through a whole turn; two things deserve a look before printing."
            .into(),
        sections: vec![
            Section::new("Pair")
                .row("Centre distance", "80 mm")
                .row("Module", "2.12 mm")
                .row("Teeth", "36 : 36")
                .noted_row("Thickness", "6 mm", "bore 5 mm in both gears"),
            Section::new("Likeness")
                .noted_row(
                    "Driver",
                    "94.1 %",
                    "pitch curve against drawing, intersection over union",
                )
                .row("Follower", "91.7 %")
                .row("Objective E", "0.0831"),
            Section::new("Motion")
                .row("Fastest follower, ψ′", "3.000")
                .row("Slowest follower, ψ′", "0.333")
                .noted_row("Steepest lean", "30.0°", "limit 60°"),
            Section::new("Mesh")
                .row("Deepest overlap", "0.4 µm")
                .row("Free play", "0.21° to 0.48°")
                .row("Contact lost", "never"),
        ],
        plots: vec![
            Plot::over_driver_angle("Follower angle ψ", "follower angle, °")
                .series("ψ", over(&|p| transmission(p).to_degrees()))
                .series("even motion", over(&|p| p.to_degrees())),
            Plot::over_driver_angle("Speed ratio ψ′", "follower speed / driver speed")
                .series("ψ′", over(&slope))
                .limit("torque bound", 3.2),
            Plot::over_driver_angle("Transmission error", "error, °")
                .series("forward", over(&|p| 0.02 * (36.0 * p).sin() * slope(p)))
                .series("backward", over(&|p| -0.05 + 0.015 * (36.0 * p).cos())),
        ],
        contacts: Vec::new(),
        notes: vec![
            Note::new(
                NoteKind::Warning,
                "Teeth 7 to 9 of the driver are cut short by a cusp: their flanks carry for 60 % of a pitch.",
            ),
            Note::new(
                NoteKind::Warning,
                "The follower's drawing has 3.2 % of its area behind an overhang; the gear fills it.",
            ),
            Note::new(
                NoteKind::Step,
                "Found both centres in 61,440 pairs of centres, then refined them.",
            ),
            Note::new(NoteKind::Step, "Carved the follower at 1440 poses."),
        ],
    }
}
