//! The record of a pair, and what is made of it: its motion, drawings, solids, and the pair as a check reads it.
#![no_main]

use centrode::assembly::{Layout, TrainPlan};
use centrode::check::{CheckOptions, check};
use centrode::schema::SavedDesign;
use centrode::export::{Animation, Encode, ExportOptions, Format, Parts};
use centrode::meshing::ContactOptions;
use centrode::gear::Side;
use centrode::input::toothed_from_bytes;
use centrode::solid::assembly_solids;
use centrode_fuzz::{remedied, told};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let gear = |role| toothed_from_bytes(text.as_bytes(), "design.json", None, role);
    match (gear(Side::Driver), gear(Side::Follower)) {
        (Ok(driver), Ok(follower)) => {
            let contact = ContactOptions { poses: 48, ..ContactOptions::default() };
            let options = CheckOptions { contact, ..CheckOptions::default() };
            if let Err(error) = check(&driver, &follower, &options) {
                remedied(&error);
            }
        }
        (Err(error), _) | (_, Err(error)) => remedied(&error),
    }
    let saved = match SavedDesign::from_json(text) {
        Ok(saved) => saved,
        Err(error) => return told(&error),
    };
    match saved.pair_model() {
        Err(error) => remedied(&error),
        Ok(model) => {
            for angle in [0.0, 1.0, -7.5, 100.0] {
                let _ = model.motion.inverse(model.motion.psi(angle));
            }
            let plan = TrainPlan::chain(model, 3, Layout::Straight, saved.thickness);
            if let Err(error) = plan.and_then(|plan| plan.assemble()) {
                remedied(&error);
            }
        }
    }
    let assembly = saved.assembly();
    let meshes = assembly_solids(&assembly).unwrap_or_else(|error| {
        remedied(&error);
        Vec::new()
    });
    let parts = Parts { assembly: &assembly, meshes: &meshes };
    let animation = Animation { pixels: 48, ..Animation::default() };
    // Pictures and packages take longer than all else together.
    let (slow, often) = ([Format::ThreeMf, Format::Gif], text.len() % 16 == 0);
    let encoders = Format::ALL
        .iter()
        .filter(|f| often || !slow.contains(f))
        .filter(|f| !f.entry().solid || !meshes.is_empty())
        .flat_map(|f| match f {
            Format::Gif => vec![Box::new(animation) as Box<dyn Encode>],
            f => f.encoders(&ExportOptions::default()),
        });
    let folder = centrode_fuzz::folder();
    for encoder in encoders {
        if let Err(error) = encoder.write(parts, folder) {
            told(&error);
        }
    }
});
