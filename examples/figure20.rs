//! The experiment of the paper's Figure 20: on the same pitch curves, waves of one height, waves with the heights
//! of Eq. 17, and involute teeth.
//!
//! usage: cargo run --example figure20 -- DRIVER FOLLOWER TEETH LEAN
//!
//! LEAN bounds the lean of the pitch curves, degrees. One line of JSON for each style; contact with and without
//! clearance.

use anyhow::Context;
use centrode::control::Control;
use centrode::geometry::Point;
use centrode::input::{LoadOptions, load};
use centrode::meshing::{ContactInput, ContactOptions, ContactSummary, analyse};
use centrode::pipeline::{DesignOptions, ToothCount, design};
use centrode::pitch::Centrodes;
use centrode::teeth::{TeethOptions, ToothedPair, involute_pair, regular_wave_pair, wave_pair};
use serde_json::json;

/// Inward offset of every face for the second analysis, mm.
const CLEARANCE: f64 = 0.1;

fn main() -> anyhow::Result<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [driver, follower, teeth, lean] = words.as_slice() else {
        anyhow::bail!("give two shapes, the driver's teeth and the greatest lean in degrees");
    };
    let shapes = [load(driver, &LoadOptions::default())?, load(follower, &LoadOptions::default())?];
    let mut options = DesignOptions::new("1".parse()?);
    options.teeth = ToothCount::Teeth(teeth.parse()?);
    options.fit.limits.max_lean = lean.parse::<f64>()?.to_radians();
    // The pitch curves stay as they are, whatever teeth they carry.
    options.repair = false;
    let made = design(&shapes[0], &shapes[1], &options)?;
    let centrodes = &made.centrodes;
    let teeth_options = TeethOptions { driver_teeth: made.teeth[0], ..TeethOptions::default() };

    let styles = [
        ("regular wave", regular_wave_pair(centrodes, &teeth_options)),
        ("wave, Eq. 17", wave_pair(centrodes, &teeth_options)),
        ("involute", involute_pair(centrodes, &teeth_options)),
    ];
    for (style, pair) in styles {
        let line = match pair.map_err(anyhow::Error::from).and_then(|p| measured(centrodes, &p)) {
            Ok(figures) => {
                json!({ "style": style, "lean": centrodes.max_lean(), "figures": figures })
            }
            Err(error) => json!({ "style": style, "refused": error.to_string() }),
        };
        println!("{line}");
    }
    Ok(())
}

fn measured(centrodes: &Centrodes, pair: &ToothedPair) -> anyhow::Result<serde_json::Value> {
    let exact = contact(centrodes, pair.module, [&pair.driver.points, &pair.follower.points])?;
    let offset = |profile: &centrode::teeth::Profile| {
        profile.inset(CLEARANCE).context("nothing is left after the clearance")
    };
    let finished = [offset(&pair.driver)?, offset(&pair.follower)?];
    let loose = contact(centrodes, pair.module, [&finished[0].points, &finished[1].points])?;
    let error = exact.transmission_error_pitch.as_ref();
    let loose_error = loose.transmission_error_pitch.as_ref();
    Ok(json!({
        "median_deviation": error.map(|e| e.median_deviation),
        "p99": error.map(|e| e.p99_deviation),
        "lost": exact.lost_poses,
        "interference": exact.max_interference.map_or(0.0, |w| w.value / pair.module),
        "loose_p99": loose_error.map(|e| e.p99_deviation),
        "loose_lost": loose.lost_poses,
        "loose_lost_degrees": loose.lost_angle.to_degrees(),
        "loose_interference": loose.max_interference.map_or(0.0, |w| w.value / pair.module),
    }))
}

fn contact(
    centrodes: &Centrodes,
    module: f64,
    [driver, follower]: [&[Point]; 2],
) -> anyhow::Result<ContactSummary> {
    let motion = &centrodes.transmission;
    let input = ContactInput {
        driver,
        follower,
        center_distance: centrodes.center_distance,
        module,
        motion,
        control: Control::unwatched(),
    };
    Ok(analyse(&input, &ContactOptions::default())?.summary)
}
