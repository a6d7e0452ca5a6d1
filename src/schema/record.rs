//! `design.json`: what every run writes and other programs may rely on.

use serde::{Deserialize, Deserializer, Serialize};
use serde_json::Value;

use super::fittings::{FittingsRecord, FixtureRecord};
use super::stages::StagesRecord;
use crate::assembly::{Assembly, PlacedGear};
use crate::diagnose::{Diagnostic, Severity, Verdict};
use crate::gear::Side;
use crate::geometry::Point;
use crate::meshing::{Direction, Drive, Dynamics, WorstPlace};
use crate::pipeline::{Design, DesignOptions};
use crate::policy;
use crate::strength::Strength;

/// Version of the record. 0, where a record has none: options were spelled otherwise.
pub const RECORD_VERSION: u32 = 1;

/// What lengths are in.
pub(super) const UNITS: &str = "mm";

/// The record of one design; field order is the order in the file. Lengths mm, angles radians.
///
/// What is only told to other programs is written and not read back; version 0 had no `settings` that can be read, no
/// `used` and no `stages`.
#[derive(Debug, Serialize, Deserialize)]
pub struct Record {
    #[serde(default)]
    centrode: String,
    #[serde(default)]
    pub(super) version: u32,
    pub(super) units: String,
    #[serde(default = "plain_names")]
    pub(super) names: [String; 2],
    pub(super) ratio: f64,
    pub(super) center_distance: f64,
    pub(super) module: f64,
    #[serde(default = "plain_thickness")]
    pub(super) thickness: f64,
    pub(super) driver: GearRecord,
    pub(super) follower: GearRecord,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) fixtures: Vec<FixtureRecord>,
    pub(super) motion: Motion,
    /// Of pairs that were fitted to two shapes.
    #[serde(skip_deserializing, skip_serializing_if = "Option::is_none")]
    objective: Option<ObjectiveRecord>,
    #[serde(skip_deserializing, skip_serializing_if = "Resemblance::is_empty")]
    resemblance: Resemblance,
    /// Of pairs that were not.
    #[serde(skip_deserializing, skip_serializing_if = "Option::is_none")]
    law: Option<Law>,
    #[serde(skip_deserializing)]
    meshing: Option<Meshing>,
    #[serde(skip_deserializing)]
    strength: Option<StrengthRecord>,
    /// What was asked, spelled as the command line spells it.
    #[serde(default, deserialize_with = "known")]
    pub(super) settings: Option<DesignOptions>,
    /// What was used: the number of teeth that was chosen, and the bounds that repairs led to.
    #[serde(default, deserialize_with = "known")]
    pub(super) used: Option<DesignOptions>,
    /// What the stages were made from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) stages: Option<StagesRecord>,
}

/// Options as this version spells them; none for those of version 0.
fn known<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<DesignOptions>, D::Error> {
    Ok(serde_json::from_value(Value::deserialize(deserializer)?).ok())
}

fn plain_names() -> [String; 2] {
    Side::BOTH.map(|side| side.name().to_owned())
}

fn plain_thickness() -> f64 {
    policy::DEFAULT_THICKNESS
}

#[derive(Debug, Serialize, Deserialize)]
pub(super) struct GearRecord {
    pub(super) teeth: u32,
    pub(super) pitch_curve: Vec<[f64; 2]>,
    pub(super) outline: Vec<[f64; 2]>,
    pub(super) bore: Option<Vec<[f64; 2]>>,
    #[serde(default)]
    pub(super) input: Vec<[f64; 2]>,
    /// Null for a gear that has no drawing, whose `input` is then empty.
    #[serde(skip_deserializing)]
    rotation_center_in_input: Option<[f64; 2]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) fittings: Option<FittingsRecord>,
}

#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Motion {
    pub(super) driver_angle: Vec<f64>,
    pub(super) follower_angle: Vec<f64>,
    /// Whether the pair goes back the same way instead of round and round.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(super) swings: bool,
}

#[derive(Debug, Serialize)]
#[allow(
    non_snake_case,
    reason = "E is the name of the objective in the paper and in the file format"
)]
struct ObjectiveRecord {
    E: f64,
    shape: f64,
    torque: f64,
    weight: f64,
    /// What the bounds on torque and lean changed, in the measure of `shape`.
    limiting_cost: f64,
    /// What repeating one window round the larger gear changed, in the same measure.
    folding_cost: f64,
    /// What the area that cannot be seen from the axes counts.
    lost_cost: f64,
    /// What the search made small: all of the above.
    total: f64,
}

/// Left out for a gear that has no drawing.
#[derive(Debug, Default, Serialize)]
struct Resemblance {
    #[serde(skip_serializing_if = "Option::is_none")]
    driver_iou: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    follower_iou: Option<f64>,
    /// Area that cannot be seen from the axis, over the drawing's.
    #[serde(skip_serializing_if = "Option::is_none")]
    driver_lost_area: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    follower_lost_area: Option<f64>,
    /// `t (1 - IoU_D) + (1 - t) (1 - IoU_F) + kappa omega max psi'` before and after the refinement, if there was one.
    #[serde(skip_serializing_if = "Option::is_none")]
    refinement: Option<[f64; 2]>,
}

impl Resemblance {
    fn is_empty(&self) -> bool {
        self.driver_iou.is_none() && self.follower_iou.is_none()
    }
}

/// The motion as the gears have it.
#[derive(Debug, Serialize)]
struct Law {
    /// psi' at even driver angles over one period, from driver angle 0.
    derivative: Vec<f64>,
    /// Periods in a turn of the driver and of the follower.
    folds: [u32; 2],
}

#[derive(Debug, Serialize)]
struct Meshing {
    verdict: Verdict,
    diagnostics: Vec<Diagnostic>,
    /// The sentences of the diagnostics, by severity.
    faults: Vec<String>,
    warnings: Vec<String>,
    steps: Vec<String>,
    /// Without clearance, as fractions of a pitch.
    transmission_error_median_deviation: Option<f64>,
    transmission_error_p99: Option<f64>,
    transmission_error_peak_to_peak: Option<f64>,
    /// Of the finished gears.
    lost_poses: usize,
    poses: usize,
    contact_ratio: f64,
    max_interference: f64,
    min_angular_backlash: Option<f64>,
    max_angular_backlash: Option<f64>,
    max_pressure_angle: Option<f64>,
    max_lean: f64,
    /// What the rigid-body runs gave, if there were any.
    runs: Vec<serde_json::Value>,
}

/// Bending by Lewis's formula for one tooth that carries all at its tip. Torque in N mm, stress in MPa, power in W.
#[derive(Debug, Serialize)]
struct StrengthRecord {
    load: f64,
    rpm: f64,
    friction: f64,
    power: f64,
    /// Estimated; the runs give a measured one.
    efficiency: f64,
    weakest_tooth: Option<ToothRecord>,
}

#[derive(Debug, Serialize)]
struct ToothRecord {
    gear: Side,
    /// Counter-clockwise on its gear, from zero.
    index: usize,
    tip: [f64; 2],
    /// At which it is at the pitch point.
    driver_angle: f64,
    force: f64,
    form_factor: f64,
    stress: f64,
}

impl StrengthRecord {
    fn new(strength: &Strength) -> Self {
        Self {
            load: strength.load.torque,
            rpm: strength.load.rpm,
            friction: strength.load.friction,
            power: strength.power,
            efficiency: strength.efficiency,
            weakest_tooth: strength.weakest().map(|tooth| ToothRecord {
                gear: tooth.side,
                index: tooth.index,
                tip: [tooth.tip.x, tooth.tip.y],
                driver_angle: tooth.driver_angle,
                force: tooth.force,
                form_factor: tooth.form_factor,
                stress: tooth.stress,
            }),
        }
    }
}

impl Motion {
    /// One whole cycle, or one way of a pair that swings.
    fn new(assembly: &Assembly) -> Self {
        let swings = assembly.swings();
        let samples = assembly.driver_angle.len();
        let count = if swings { samples / 2 + 1 } else { samples };
        let follower = assembly.gears[1].angle.iter();
        Self {
            driver_angle: assembly.driver_angle.iter().copied().take(count).collect(),
            follower_angle: follower.map(|a| 0.0 - a).take(count).collect(),
            swings,
        }
    }
}

impl Record {
    /// The record of a design.
    #[must_use]
    pub fn new(design: &Design) -> Self {
        let exact = design.exact_contact.summary.transmission_error_pitch.as_ref();
        let summary = &design.contact.summary;
        let gears = &design.assembly.gears;
        let transmission = &design.centrodes.transmission;
        let center = |i: usize| design.drawings[i].map(|d| d.center_in_input);
        Self {
            centrode: env!("CARGO_PKG_VERSION").to_owned(),
            version: RECORD_VERSION,
            units: UNITS.to_owned(),
            names: design.names.clone(),
            ratio: design.centrodes.transmission.ratio(),
            center_distance: design.centrodes.center_distance,
            module: design.pair.module,
            thickness: design.assembly.thickness,
            driver: gear_record(&gears[0], center(0)),
            follower: gear_record(&gears[1], center(1)),
            fixtures: design.assembly.fixtures.iter().map(FixtureRecord::new).collect(),
            motion: Motion::new(&design.assembly),
            objective: design.objective().map(|objective| ObjectiveRecord {
                E: objective.shape + objective.weight * objective.torque,
                shape: objective.shape,
                torque: objective.torque,
                weight: objective.weight,
                limiting_cost: objective.limiting_cost,
                folding_cost: objective.folding_cost,
                lost_cost: objective.lost_cost,
                total: objective.total,
            }),
            resemblance: Resemblance {
                driver_iou: design.likeness[0],
                follower_iou: design.likeness[1],
                driver_lost_area: design.drawings[0].map(|d| d.lost_area),
                follower_lost_area: design.drawings[1].map(|d| d.lost_area),
                refinement: design
                    .fit
                    .as_ref()
                    .and_then(|f| f.refinement)
                    .map(|r| [r.before, r.after]),
            },
            law: design.fit.is_none().then(|| Law {
                derivative: transmission.samples().to_vec(),
                folds: [transmission.driver_fold(), transmission.follower_fold()],
            }),
            meshing: Some(Meshing {
                verdict: design.verdict(),
                diagnostics: design.diagnostics.clone(),
                faults: design.told(Severity::Fault),
                warnings: design.told(Severity::Warning),
                steps: design.told(Severity::Note),
                transmission_error_median_deviation: exact.map(|e| e.median_deviation),
                transmission_error_p99: exact.map(|e| e.p99_deviation),
                transmission_error_peak_to_peak: exact.map(|e| e.peak_to_peak),
                lost_poses: summary.lost_poses,
                poses: design.contact.poses.len(),
                contact_ratio: summary.contact_ratio,
                max_interference: summary.max_interference.as_ref().map_or(0.0, |w| w.value),
                min_angular_backlash: summary.min_backlash.as_ref().map(|w| w.value),
                max_angular_backlash: summary.max_backlash.as_ref().map(|w| w.value),
                max_pressure_angle: summary.max_pressure_angle.as_ref().map(|w| w.value),
                max_lean: design.centrodes.max_lean(),
                runs: design.proof.iter().flat_map(|p| p.runs.iter().map(run_record)).collect(),
            }),
            strength: Some(StrengthRecord::new(&design.strength)),
            settings: Some(design.options.clone()),
            used: Some(design.used.clone()),
            stages: StagesRecord::new(&design.stages),
        }
    }
}

fn gear_record(placed: &PlacedGear, center: Option<Point>) -> GearRecord {
    let plain = |points: &[Point]| points.iter().map(|p| [p.x, p.y]).collect::<Vec<_>>();
    let gear = &placed.gear;
    GearRecord {
        teeth: gear.teeth,
        pitch_curve: plain(&gear.pitch_curve),
        outline: plain(&gear.outline),
        bore: gear.bore.as_deref().map(plain),
        input: plain(&gear.input),
        rotation_center_in_input: center.map(|c| [c.x, c.y]),
        fittings: FittingsRecord::new(&gear.fittings),
    }
}

/// The figures of a run for programs. Angles in radians, torque in N mm, lengths in mm.
#[must_use]
pub fn run_record(run: &Dynamics) -> serde_json::Value {
    let s = &run.summary;
    let placed = |w: Option<WorstPlace>| {
        w.map(|w| serde_json::json!({ "value": w.value, "driver_angle": w.driver_angle }))
    };
    serde_json::json!({
        "drive": if matches!(run.options.drive, Drive::Motor(_)) { "motor" } else { "led" },
        "direction": if run.options.direction == Direction::Backward { "backward" } else { "forward" },
        "load": run.options.load,
        "rpm": run.options.rpm,
        "friction": run.options.friction,
        "steps": run.steps.len(),
        "transmission_error_peak_to_peak": s.swing_angle,
        "transmission_error_pitch": s.swing,
        "tracking_rms": s.tracking_rms,
        "tracking_worst": placed(s.tracking_worst),
        "torque_rms_loads": s.torque_rms,
        "torque_excess_loads": placed(s.torque_excess),
        "greatest_torque": placed(s.greatest_torque),
        "penetration": placed(s.penetration),
        "free_run_pitches": placed(s.free_run),
        "net_turn_pitches": s.net_turn,
        "contact_ratio": s.contact_ratio,
        "efficiency": s.efficiency,
    })
}
