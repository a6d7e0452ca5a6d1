//! The record of a pair, and what is made of it: its motion, drawings, solids, and the pair as a check reads it.
#![no_main]

use centrode::assembly::{Layout, TrainPlan};
use centrode::check::{CheckOptions, check};
use centrode::design::SavedDesign;
use centrode::export::{
    Animation, Dxf, Export, Glb, LaserSvg, Mjcf, Obj, Parts, Step, Stl, ThreeMf,
};
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
    let flat: [&dyn Export; 4] =
        [&Step::default(), &Dxf::default(), &LaserSvg::default(), &Mjcf::default()];
    let animation = Animation { pixels: 48, ..Animation::default() };
    let solid: [&dyn Export; 5] = [&Stl, &Obj, &Glb::default(), &ThreeMf, &animation];
    // Pictures take longer than all else together.
    let drawn = 3 + 2 * usize::from(text.len() % 16 == 0);
    let formats =
        flat.into_iter().chain(solid.into_iter().take(drawn).filter(|_| !meshes.is_empty()));
    let folder = centrode_fuzz::folder();
    for format in formats {
        if let Err(error) = format.write(parts, folder) {
            told(&error);
        }
    }
});
