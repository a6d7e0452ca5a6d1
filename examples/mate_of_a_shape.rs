//! One drawing becomes a gear, and the gear that runs with it is computed.
//!
//! usage: cargo run --example mate_of_a_shape

use centrode::fit::Ratio;
use centrode::input::{LoadOptions, load};
use centrode::pipeline::{DesignOptions, Scale, mate};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let heart = load("heart", &LoadOptions::default())?;
    // The mate turns once for two turns of the heart; axes 100 mm apart.
    let options = DesignOptions {
        scale: Scale::CenterDistance(100.0),
        ..DesignOptions::new(Ratio::integer(2)?)
    };

    let made = mate(&heart, &options)?;

    let motion = &made.centrodes.transmission;
    println!(
        "{} with {} teeth turns {} with {}; the torque needed varies from {:.2} to {:.2} of the load",
        made.names[0],
        made.teeth[0],
        made.names[1],
        made.teeth[1],
        motion.min_derivative(),
        motion.max_derivative()
    );
    Ok(())
}
