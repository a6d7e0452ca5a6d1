//! Two drawings become gears: where their axes lie, how they turn, how much of the drawings is kept.
//!
//! usage: cargo run --example fit_two_shapes

use centrode::diagnose::Severity;
use centrode::fit::Ratio;
use centrode::input::{LoadOptions, load};
use centrode::pipeline::{DesignOptions, design};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A path to an SVG, an image or a list of points would do as well.
    let driver = load("egg", &LoadOptions::default())?;
    let follower = load("drop", &LoadOptions::default())?;

    let made = design(&driver, &follower, &DesignOptions::new(Ratio::ONE))?;

    for (i, name) in made.names.iter().enumerate() {
        let (Some(place), Some(likeness)) = (made.drawings[i], made.likeness[i]) else { continue };
        let axis = place.center_in_input;
        println!(
            "{name}: {} teeth, axis at ({:.1}, {:.1}) of the drawing, {:.0} % alike",
            made.teeth[i],
            axis.x,
            axis.y,
            100.0 * likeness
        );
    }
    if !made.is_sound() {
        return Err(made.told(Severity::Fault).join("; ").into());
    }
    Ok(())
}
