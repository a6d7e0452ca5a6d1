//! Gears for a motion given as a formula, without any drawing.
//!
//! usage: cargo run --example motion_law -- LAW [--teeth N] [--distance MM] [--chords MODULES] [--output FILE]
//!
//! LAW is `circle`, `ellipse` (about its focus, eccentricity 0.3), `lobes` (psi' = 1 + 0.3 cos 2 phi) or `half`
//! (two driver turns for one of the follower, psi' = 0.5 (1 + 0.3 cos phi)). The file has the fields of
//! `design.json` that describe gears and motion, and psi' as it was sampled.

use centrode::control::Control;
use std::f64::consts::TAU;

use anyhow::{Context, bail};
use centrode::gear::Motion;
use centrode::geometry::Point;
use centrode::meshing::{ContactInput, ContactOptions, analyse};
use centrode::pitch::{Centrodes, Transmission};
use centrode::teeth::{TeethOptions, involute_pair};
use serde_json::json;

/// Samples of psi' over one driver turn; the spline through them is then exact to 1e-10.
const SAMPLES: usize = 2048;

fn main() -> anyhow::Result<()> {
    let mut words = std::env::args().skip(1);
    let name = words.next().context("name a law: circle, ellipse, lobes or half")?;
    let mut options = TeethOptions::default();
    let (mut center_distance, mut output) = (80.0, None);
    while let Some(word) = words.next() {
        let value = words.next().with_context(|| format!("give a value after {word}"))?;
        match word.as_str() {
            "--teeth" => options.driver_teeth = value.parse()?,
            "--distance" => center_distance = value.parse()?,
            "--chords" => options.chord_tolerance = value.parse()?,
            "--output" => output = Some(value),
            _ => bail!("{word} is no option; use --teeth, --distance, --chords or --output"),
        }
    }

    let (law, follower_fold) = law(&name)?;
    let samples: Vec<f64> = (0..SAMPLES).map(|i| law(TAU * i as f64 / SAMPLES as f64)).collect();
    let transmission = Transmission::from_derivative(&samples, 1, follower_fold)?;
    let centrodes = Centrodes { transmission, center_distance };

    let teeth = options.driver_teeth;
    let pair = involute_pair(&centrodes, &options)?;

    let motion = &centrodes.transmission;
    let input = ContactInput {
        driver: &pair.driver.points,
        follower: &pair.follower.points,
        center_distance,
        module: pair.module,
        motion,
        control: Control::unwatched(),
    };
    let contact = analyse(&input, &ContactOptions::default())?.summary;
    let error = contact.transmission_error.context("the gears never touch")?;
    let worst = contact.max_interference.map_or(0.0, |w| w.value / pair.module);
    eprintln!(
        "{name}: {teeth} teeth, module {:.3} mm, transmission error {:.1e} degrees peak to peak, \
         interference {worst:.1e} module, contact lost in {} of 1440 poses",
        pair.module,
        error.peak_to_peak.to_degrees(),
        contact.lost_poses,
    );

    if let Some(file) = output {
        let plain = |points: &[Point]| points.iter().map(|p| [p.x, p.y]).collect::<Vec<_>>();
        let cycle = motion.cycle();
        let angles: Vec<f64> = (0..=SAMPLES).map(|i| cycle * i as f64 / SAMPLES as f64).collect();
        let record = json!({
            "units": "mm",
            "ratio": motion.ratio(),
            "center_distance": center_distance,
            "module": pair.module,
            "driver": {
                "teeth": teeth,
                "pitch_curve": plain(&centrodes.driver_curve(720)),
                "outline": plain(&pair.driver.points),
            },
            "follower": {
                "teeth": teeth * follower_fold,
                "pitch_curve": plain(&centrodes.follower_curve(720)),
                "outline": plain(&pair.follower.points),
            },
            "motion": {
                "driver_angle": angles,
                "follower_angle": angles.iter().map(|&phi| motion.psi(phi)).collect::<Vec<_>>(),
            },
            "law": { "derivative": motion.samples(), "folds": [1, follower_fold] },
        });
        std::fs::write(&file, record.to_string()).with_context(|| format!("writing {file}"))?;
    }
    Ok(())
}

/// psi' as a function of the driver angle, radians.
type Derivative = fn(f64) -> f64;

/// The law of that name, and the follower's order of symmetry.
fn law(name: &str) -> anyhow::Result<(Derivative, u32)> {
    const ECCENTRICITY: f64 = 0.3;
    Ok(match name {
        "circle" => (|_| 1.0, 1),
        "ellipse" => (
            |phi| {
                let e = ECCENTRICITY;
                (1.0 - e * e) / (1.0 + 2.0 * e * phi.cos() + e * e)
            },
            1,
        ),
        "lobes" => (|phi| 1.0 + 0.3 * (2.0 * phi).cos(), 1),
        "half" => (|phi| 0.5 * (1.0 + 0.3 * phi.cos()), 2),
        _ => bail!("{name} is no law; name circle, ellipse, lobes or half"),
    })
}
