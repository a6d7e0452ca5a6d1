//! Contact analysis of two outlines from any source.
//!
//! usage: cargo run --example contact_of_outlines -- FILE
//!
//! FILE is JSON with `center_distance`, `module`, `driver.outline`, `follower.outline` (frames of `design.json`) and
//! `law`: `derivative`, samples of psi' over one period, and `folds`, the orders of symmetry. Prints JSON.

use anyhow::Context;
use centrode::control::Control;
use centrode::geometry::Point;
use centrode::meshing::{ContactInput, ContactOptions, analyse};
use centrode::pitch::Transmission;
use serde_json::{Value, json};

fn main() -> anyhow::Result<()> {
    let file = std::env::args().nth(1).context("give a JSON file with outlines and a law")?;
    let record: Value = serde_json::from_str(&std::fs::read_to_string(&file)?)?;
    let outline = |gear: &str| -> anyhow::Result<Vec<Point>> {
        let points: Vec<[f64; 2]> = serde_json::from_value(record[gear]["outline"].clone())?;
        Ok(points.into_iter().map(Point::from).collect())
    };
    let (driver, follower) = (outline("driver")?, outline("follower")?);
    let samples: Vec<f64> = serde_json::from_value(record["law"]["derivative"].clone())?;
    let [driver_fold, follower_fold]: [u32; 2] =
        serde_json::from_value(record["law"]["folds"].clone())?;
    let number = |key: &str| record[key].as_f64().with_context(|| format!("no number for {key}"));

    let motion = Transmission::from_derivative(&samples, driver_fold, follower_fold)?;
    let input = ContactInput {
        driver: &driver,
        follower: &follower,
        center_distance: number("center_distance")?,
        module: number("module")?,
        motion: &motion,
        control: Control::unwatched(),
    };
    let summary = analyse(&input, &ContactOptions::default())?.summary;
    let degrees = summary.transmission_error.as_ref();
    let pitches = summary.transmission_error_pitch.as_ref();
    println!(
        "{}",
        json!({
            "error_median_deviation_degrees": degrees.map(|e| e.median_deviation.to_degrees()),
            "error_p99_degrees": degrees.map(|e| e.p99_deviation.to_degrees()),
            "error_peak_to_peak_degrees": degrees.map(|e| e.peak_to_peak.to_degrees()),
            "error_median_deviation_pitch": pitches.map(|e| e.median_deviation),
            "error_p99_pitch": pitches.map(|e| e.p99_deviation),
            "lost_poses": summary.lost_poses,
            "contact_ratio": summary.contact_ratio,
            "interference_mm": summary.max_interference.map_or(0.0, |w| w.value),
        })
    );
    Ok(())
}
