//! One pair, many times over: a train in which every gear turns the next.
//!
//! usage: cargo run --example train_of_gears

use centrode::assembly::{Layout, PairModel, TrainPlan};
use centrode::control::Control;
use centrode::gear::Pair;
use centrode::law::{LawOptions, Preset};
use centrode::meshing::train_play;
use centrode::pipeline::{DesignOptions, from_motion};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let motion = Preset::Ellipse(0.2).transmission(&LawOptions::default())?;
    let names = ["ellipse", "its twin"].map(str::to_owned);
    let made = from_motion(motion, names, [None, None], &DesignOptions::default())?;

    let [driver, follower] = &made.assembly.gears[..] else { return Err("no pair".into()) };
    let pair = PairModel {
        gears: Pair::new(driver.gear.clone(), follower.gear.clone()),
        motion: made.assembly.motion()?,
        center_distance: made.centrodes.center_distance,
        module: made.pair.module,
    };
    let bend = Layout::ZigZag(40_f64.to_radians());
    let train = TrainPlan::chain(pair, 5, bend, made.assembly.thickness)?.assemble()?;

    let play = train_play(&train.assembly, 90, Control::unwatched())?;
    for (placed, play) in train.assembly.gears.iter().zip(&play.accumulated) {
        println!(
            "{} at ({:.0}, {:.0}) mm, play up to {:.2} degrees",
            placed.gear.name,
            placed.axis.x,
            placed.axis.y,
            play.to_degrees()
        );
    }
    Ok(())
}
