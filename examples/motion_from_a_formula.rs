//! Gears that turn as a formula says, and the tooth that bends most.
//!
//! usage: cargo run --example motion_from_a_formula -- ["1 + 0.3*cos(2*phi)"]

use centrode::law::{Formula, LawOptions, from_function};
use centrode::pipeline::{DesignOptions, from_motion};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let text = std::env::args().nth(1).unwrap_or_else(|| "1 + 0.3*cos(2*phi)".to_owned());
    let formula = Formula::parse(&text)?;
    let motion = from_function(|phi| formula.at(phi), &LawOptions::default())?;

    let names = [text, "its follower".to_owned()];
    let made = from_motion(motion, names, [None, None], &DesignOptions::default())?;

    println!("{}: {} teeth, {}", made.names[0], made.teeth[0], made.verdict().word());
    if let Some(tooth) = made.strength.weakest() {
        println!(
            "tooth {} bends most: {:.2} MPa for {:.0} N mm",
            tooth.index, tooth.stress, made.strength.load.torque
        );
    }
    Ok(())
}
