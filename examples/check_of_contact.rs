//! Teeth on pitch curves of your own, and whether they hand the motion on without a gap.
//!
//! usage: cargo run --example check_of_contact

use centrode::control::Control;
use centrode::law::{LawOptions, Preset};
use centrode::meshing::{ContactInput, ContactOptions, analyse};
use centrode::pitch::Centrodes;
use centrode::teeth::{TeethOptions, involute_pair};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let transmission = Preset::QuickReturn(2.0).transmission(&LawOptions::default())?;
    let centrodes = Centrodes { transmission, center_distance: 60.0 };
    let pair = involute_pair(&centrodes, &TeethOptions::default())?;

    let contact = analyse(
        &ContactInput {
            driver: &pair.driver.points,
            follower: &pair.follower.points,
            center_distance: centrodes.center_distance,
            module: pair.module,
            motion: &centrodes.transmission,
            control: Control::unwatched(),
        },
        &ContactOptions::default(),
    )?;

    let found = &contact.summary;
    println!(
        "contact lost at {} of {} poses, {:.2} pairs of teeth at work",
        found.lost_poses,
        contact.poses.len(),
        found.contact_ratio
    );
    if found.lost_poses > 0 {
        return Err("the teeth let go".into());
    }
    Ok(())
}
