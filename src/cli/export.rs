//! `centrode export`: more formats of a design that was made before.

use anyhow::bail;
use centrode::export::{Format, Parts, Staging, check_folder};
use centrode::schema::SavedDesign;
use centrode::solid::assembly_solids;

use super::Outcome;
use super::args::ExportCommand;

pub(crate) fn run(args: &ExportCommand) -> anyhow::Result<Outcome> {
    if args.formats.export.contains(&Format::Html) {
        bail!(
            "only `centrode design` writes html, for it needs more than the record; leave html out"
        );
    }
    let assembly = SavedDesign::read(&args.design)?.assembly();
    let folder = match &args.output {
        Some(folder) => folder.clone(),
        None if args.design.is_dir() => args.design.clone(),
        None => args.design.parent().unwrap_or(&args.design).to_owned(),
    };
    // A bare file name has an empty parent.
    let folder = if folder.as_os_str().is_empty() { ".".into() } else { folder };
    check_folder(&folder)?;
    let meshes = assembly_solids(&assembly)?;
    let staging = Staging::new(&folder)?;
    let parts = Parts { assembly: &assembly, meshes: &meshes };
    let files = args
        .formats
        .wanted()
        .write(parts, staging.path())
        .map_err(|error| staging.told_of_the_final_place(error))?;
    for file in staging.publish(&files)? {
        println!("{}", file.display());
    }
    Ok(Outcome::Good)
}
