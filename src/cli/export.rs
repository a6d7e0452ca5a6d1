//! `centrode export`: more formats of a design that was made before.

use anyhow::Context;
use centrode::export::{Format, Parts, Staging, check_folder};
use centrode::pipeline::Design;
use centrode::report::report_html;
use centrode::results::design_page;
use centrode::schema::SavedDesign;
use centrode::solid::assembly_solids;

use super::Outcome;
use super::args::ExportCommand;
use super::files::write_text;
use super::progress::Progress;

pub(crate) fn run(args: &ExportCommand) -> anyhow::Result<Outcome> {
    let saved = SavedDesign::read(&args.design)?;
    let assembly = saved.assembly();
    let folder = match &args.output {
        Some(folder) => folder.clone(),
        None if args.design.is_dir() => args.design.clone(),
        None => args.design.parent().unwrap_or(&args.design).to_owned(),
    };
    // A bare file name has an empty parent.
    let folder = if folder.as_os_str().is_empty() { ".".into() } else { folder };
    check_folder(&folder)?;
    let page = args.formats.export.contains(&Format::Html).then(|| page(&saved)).transpose()?;
    let meshes = assembly_solids(&assembly)?;
    let staging = Staging::new(&folder)?;
    let parts = Parts { assembly: &assembly, meshes: &meshes };
    let mut files = args
        .formats
        .wanted()
        .write(parts, staging.path())
        .map_err(|error| staging.told_of_the_final_place(error))?;
    if let Some(page) = page {
        files.push(write_text(staging.path(), "report.html", &page)?);
    }
    for file in staging.publish(&files)? {
        println!("{}", file.display());
    }
    Ok(Outcome::Good)
}

/// The page as it was when the pair was designed: its runs are made again.
fn page(saved: &SavedDesign) -> anyhow::Result<String> {
    let progress = Progress::new();
    progress.doing("running the gears");
    let control = progress.control();
    let stages = saved.stages(&control)?.context(
        "this record is of version 0, which does not hold what the page shows; run `centrode design` again, or leave html out",
    )?;
    let runs = stages.asked.options.runs.clone();
    let stages = if runs.is_empty() { Some(stages) } else { stages.run_again(runs, &control)? };
    let made = stages.as_ref().and_then(Design::of).context("the record holds no finished pair")?;
    progress.done();
    Ok(report_html(&made.assembly, &design_page(&made, String::new())))
}
