//! Stages as the page is told of them. Rings are flat lists x, y, x, y in mm; angles are radians.

use centrode::assembly::Assembly;
use centrode::export::Format;
use centrode::fit::{Fit, FittedGear};
use centrode::gear::Motion;
use centrode::geometry::{self, Point};
use centrode::input::Shape;
use centrode::meshing::{Direction, Drive, Dynamics, MeshingReport};
use centrode::pipeline::Design;
use centrode::pitch::Centrodes;
use centrode::report::contact_frames;
use centrode::teeth::ToothedPair;
use serde_json::{Value, json};

use super::findings;

/// Points of a drawing on the page.
const DRAWING_POINTS: usize = 600;
/// Points of a pitch curve on the page.
const PITCH_POINTS: usize = 360;
/// Samples of a curve over one cycle.
const SAMPLES: usize = 720;
/// Contacts drawn over one cycle, frames.
const FRAMES: usize = 720;
/// Points of a plot of a run.
const RUN_POINTS: usize = 900;
/// Points of a curve in a small picture.
const SMALL_POINTS: usize = 120;
/// Decimals of lengths: a tenth of a micrometre.
const FINE: f64 = 1e4;

/// A number with few digits; zero for what is none.
pub(super) fn rounded(value: f64, fine: f64) -> f64 {
    let value = (value * fine).round() / fine;
    if value.is_finite() { value + 0.0 } else { 0.0 }
}

/// A closed curve.
fn ring(points: &[Point]) -> Value {
    let flat = points.iter().flat_map(|p| [rounded(p.x, FINE), rounded(p.y, FINE)]);
    Value::from(flat.collect::<Vec<f64>>())
}

/// A point as two numbers.
pub(super) fn point(p: Point) -> Value {
    json!([rounded(p.x, 1e6), rounded(p.y, 1e6)])
}

fn thinned(points: &[Point]) -> Vec<Point> {
    let stride = points.len().div_ceil(DRAWING_POINTS).max(1);
    points.iter().step_by(stride).copied().collect()
}

/// What has been read.
pub(super) fn read(shapes: [Option<&Shape>; 2]) -> Value {
    let one = |shape: Option<&Shape>| {
        shape.map(|s| {
            let (low, high) = s.raw.bounds();
            json!({
                "name": s.name,
                "raw": ring(&thinned(s.raw.points())),
                "smooth": ring(&thinned(s.outline.points())),
                "bounds": [low.x, low.y, high.x, high.y],
            })
        })
    };
    json!({ "drawings": shapes.map(one) })
}

/// A function over the cycle, [`SAMPLES`] + 1 values.
fn sampled(cycle: f64, f: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..=SAMPLES).map(|i| rounded(f(cycle * i as f64 / SAMPLES as f64), 1e6)).collect()
}

fn placed(shape: &Shape, gear: &FittedGear, pitch: &[Point]) -> Vec<Point> {
    let placed: Vec<Point> =
        thinned(shape.raw.points()).iter().map(|p| gear.placement.apply(*p)).collect();
    let scale = (geometry::area(pitch) / geometry::area(&placed)).sqrt();
    placed.into_iter().map(|p| p * scale).collect()
}

/// What the drawings and the fit say beside the motion.
pub(super) struct Fitted<'a> {
    pub(super) shapes: [Option<&'a Shape>; 2],
    pub(super) drawings: [Option<FittedGear>; 2],
    pub(super) fit: Option<&'a Fit>,
}

/// The pitch curves that carry the teeth of a finished pair; its drawings are already in their place.
fn sized_for_good(made: &Design) -> Value {
    let fitted = Fitted { shapes: [None; 2], drawings: made.drawings, fit: made.fit.as_ref() };
    let mut value = sized(&made.centrodes, &fitted, false);
    for (i, placed) in made.assembly.gears.iter().enumerate().take(2) {
        let Some(gear) = made.drawings[i] else { continue };
        value["drawings"][i] = drawing(
            &ring(&thinned(&placed.gear.input)),
            &gear,
            made.likeness[i].unwrap_or(gear.iou),
        );
    }
    value
}

fn drawing(ring: &Value, gear: &FittedGear, likeness: f64) -> Value {
    json!({
        "ring": ring,
        "axis": point(gear.center_in_input),
        "turn": rounded(gear.placement.angle, 1e6),
        "likeness": likeness,
        "lost": gear.lost_area,
    })
}

/// Pitch curves and motion at the size asked for. `coarse` says that a better search is under way.
pub(super) fn sized(centrodes: &Centrodes, fitted: &Fitted<'_>, coarse: bool) -> Value {
    let t = &centrodes.transmission;
    let cycle = t.cycle();
    let pitch = [centrodes.driver_curve(PITCH_POINTS), centrodes.follower_curve(PITCH_POINTS)];
    let drawn = |i: usize| {
        let (shape, gear) = (fitted.shapes[i]?, fitted.drawings[i]?);
        Some(drawing(&ring(&placed(shape, &gear, &pitch[i])), &gear, gear.iou))
    };
    json!({
        "coarse": coarse,
        "distance": centrodes.center_distance,
        "folds": [t.driver_fold(), t.follower_fold()],
        "cycle": cycle,
        "psi": sampled(cycle, |phi| t.psi(phi)),
        "speed": sampled(cycle, |phi| t.derivative(phi)),
        "slope": sampled(cycle, |phi| centrodes.lean(phi)),
        "pitch": [ring(&pitch[0]), ring(&pitch[1])],
        "drawings": [drawn(0), drawn(1)],
        "torque": t.max_derivative(),
        "steepest": centrodes.max_lean(),
        "objective": fitted.fit.map(|f| json!({"total": f.objective.total, "shape": f.objective.shape})),
    })
}

/// Other pairs to choose from, small.
pub(super) fn alternatives(fits: &[Fit], shapes: [&Shape; 2]) -> Value {
    let small = |points: &[Point]| {
        let stride = points.len().div_ceil(SMALL_POINTS).max(1);
        ring(&points.iter().step_by(stride).copied().collect::<Vec<_>>())
    };
    let one = |fit: &Fit| {
        let t = &fit.transmission;
        let centrodes = Centrodes { transmission: t.clone(), center_distance: 1.0 };
        let pitch = [
            centrodes.driver_curve(SMALL_POINTS),
            centrodes.follower_curve(SMALL_POINTS * t.follower_fold() as usize),
        ];
        let gears = [&fit.driver, &fit.follower];
        let ghosts = [0, 1].map(|i| small(&placed(shapes[i], gears[i], &pitch[i])));
        json!({
            "likeness": gears.map(|g| g.iou),
            "torque": t.max_derivative(),
            "cycle": t.cycle(),
            "psi": (0..=SMALL_POINTS).map(|i| rounded(t.psi(t.cycle() * i as f64 / SMALL_POINTS as f64), 1e5)).collect::<Vec<_>>(),
            "pitch": [ring(&pitch[0]), ring(&pitch[1])],
            "ghosts": ghosts,
        })
    };
    json!({ "pairs": fits.iter().map(one).collect::<Vec<_>>() })
}

/// Outlines before their analysis.
pub(super) fn toothed(pair: &ToothedPair, teeth: [u32; 2]) -> Value {
    json!({
        "teeth": teeth,
        "module": pair.module,
        "outlines": [ring(&pair.driver.points), ring(&pair.follower.points)],
        "bores": [null_ring(None), null_ring(None)],
    })
}

fn null_ring(points: Option<&[Point]>) -> Value {
    points.map_or(Value::Null, ring)
}

/// Outlines, bores and what the gears carry.
pub(super) fn finished(made: &Design) -> Value {
    let gears = &made.assembly.gears;
    let rings = |f: &dyn Fn(&centrode::assembly::Gear) -> Value| -> Vec<Value> {
        gears.iter().map(|g| f(&g.gear)).collect()
    };
    json!({
        "teeth": made.teeth,
        "module": made.pair.module,
        "outlines": rings(&|g| ring(&g.outline)),
        "bores": rings(&|g| null_ring(g.bore.as_deref())),
    })
}

/// Contact through a cycle, the figures, and what was found.
pub(super) fn analysed(made: &Design) -> Value {
    let poses = &made.contact.poses;
    let stride = poses.len().div_ceil(FRAMES).max(1);
    let at: Vec<f64> = poses.iter().step_by(stride).map(|p| rounded(p.driver_angle, 1e5)).collect();
    let curve = |f: &dyn Fn(&centrode::meshing::ContactPose) -> f64| -> Vec<f64> {
        poses.iter().step_by(stride).map(|p| rounded(f(p), 1e7)).collect()
    };
    let frames: Vec<Vec<f64>> = poses
        .iter()
        .step_by(stride)
        .filter(|p| !p.lost)
        .map(|p| {
            let touches = p.contacts.iter().flat_map(|c| {
                [c.point.x, c.point.y, c.normal.x, c.normal.y].map(|v| rounded(v, 1e3))
            });
            std::iter::once(rounded(p.driver_angle, 1e5)).chain(touches).collect()
        })
        .collect();
    let summary = &made.contact.summary;
    let exact = made.exact_contact.summary.transmission_error_pitch.as_ref();
    let weakest = made.strength.weakest();
    json!({
        "sized": sized_for_good(made),
        "gears": finished(made),
        "at": at,
        "error": curve(&|p| if p.lost { 0.0 } else { p.transmission_error }),
        "backlash": curve(&|p| if p.lost || p.lost_reversed { 0.0 } else { p.play_behind + p.play_ahead }),
        "touching": curve(&|p| p.contacts.len() as f64),
        "contacts": frames,
        "figures": {
            "likeness": made.likeness,
            "torque": made.centrodes.transmission.max_derivative(),
            "slope": made.centrodes.max_lean(),
            "contact_ratio": summary.contact_ratio,
            "lost": summary.lost_poses,
            "poses": poses.len(),
            "error_p99": exact.map(|e| e.p99_deviation),
            "pressure": summary.max_pressure_angle.as_ref().map(|w| w.value),
            "backlash": [summary.min_backlash.as_ref().map(|w| w.value), summary.max_backlash.as_ref().map(|w| w.value)],
            "stress": weakest.map(|t| t.stress),
            "efficiency": made.strength.efficiency,
            "thickness": made.assembly.thickness,
        },
        "verdict": findings::verdict(made),
        "findings": findings::all(made),
    })
}

/// The runs, and the last word on the pair.
pub(super) fn proven(made: &Design) -> Value {
    let mut value = analysed(made);
    value["runs"] = made.proof.as_ref().map_or_else(Vec::new, |p| runs(p, &made.assembly)).into();
    value
}

fn runs(proof: &MeshingReport, assembly: &Assembly) -> Vec<Value> {
    let cycle = assembly.driver_angle.last().copied().unwrap_or_default();
    proof.runs.iter().map(|r| run(r, cycle)).collect()
}

fn run(run: &Dynamics, cycle: f64) -> Value {
    let stride = run.steps.len().div_ceil(RUN_POINTS).max(1);
    let curve = |f: &dyn Fn(&centrode::meshing::Step) -> f64| -> Vec<f64> {
        run.steps.iter().step_by(stride).map(|s| rounded(f(s), 1e6)).collect()
    };
    let s = &run.summary;
    json!({
        "motor": matches!(run.options.drive, Drive::Motor(_)),
        "backward": run.options.direction == Direction::Backward,
        "load": run.options.load,
        "rpm": run.options.rpm,
        "friction": run.options.friction,
        "driver": curve(&|s| s.driver_angle),
        "follower": curve(&|s| s.follower_angle),
        "torque": curve(&|s| s.windowed_torque),
        "ideal": curve(&|s| s.ideal_torque),
        "error": curve(&|s| s.transmission_error()),
        "frames": contact_frames(run, cycle).iter().map(|f| {
            let touches = f.touches.iter().flat_map(|t| [t.x, t.y, t.force[0], t.force[1]]);
            std::iter::once(f.driver_angle).chain(touches).map(|v| rounded(v, 1e3)).collect::<Vec<_>>()
        }).collect::<Vec<_>>(),
        "swing": s.swing,
        "swing_angle": s.swing_angle,
        "tracking": s.tracking_rms,
        "efficiency": s.efficiency,
        "greatest_torque": s.greatest_torque.map(|w| w.value),
    })
}

/// The formats there are.
pub(super) fn formats() -> Vec<&'static str> {
    Format::ALL.iter().map(|f| f.name()).collect()
}
