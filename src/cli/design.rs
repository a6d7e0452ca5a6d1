//! `centrode design`: from the command line to a folder of files.

use std::path::{Path, PathBuf};
use std::time::Instant;

use centrode::design::{
    BoreChoice, Design, DesignOptions, RECORD_NAME, Record, Scale, TeethStyle, ToothCount, design,
};
use centrode::export::{ExportError, Format, Parts, Staging, write_json};
use centrode::fit::{FitOptions, Limits, Ratio, Search};
use centrode::outline::{LoadOptions, Shape, Smoothing, load};
use centrode::report::report_html;
use centrode::solid::{Mesh, assembly_solids};

use super::args::{CarverArg, DesignArgs, ExportArgs, SearchArg, StyleArg};
use super::files::{write_parts, write_text};
use super::progress::Progress;
use super::{Outcome, report};

pub(crate) fn run(args: &DesignArgs) -> anyhow::Result<Outcome> {
    let start = Instant::now();
    let options = options(args)?;
    let progress = Progress::new();
    progress.doing("reading the shapes");
    let [driver, follower] = read(args)?;
    progress.doing(format!("fitting {} to {}", driver.name, follower.name));
    let made = design(&driver, &follower, &options)?;
    if !made.is_sound() && !args.teeth.force {
        progress.done();
        eprintln!("error: {}", unsound(&made, args));
        return Ok(Outcome::NotSound);
    }
    progress.doing("making solids");
    let meshes = assembly_solids(&made.assembly)?;
    progress.doing("writing files");
    let files = write(&made, &meshes, args)?;
    progress.done();
    report::summary(&made, &files, &args.output, start.elapsed(), args.json)?;
    Ok(if made.is_sound() { Outcome::Good } else { Outcome::NotSound })
}

fn options(args: &DesignArgs) -> anyhow::Result<DesignOptions> {
    let ratio: Ratio = args.ratio.parse()?;
    let defaults = DesignOptions::new(ratio);
    Ok(DesignOptions {
        fit: FitOptions {
            search: match args.fit.search {
                SearchArg::Global => Search::Global,
                SearchArg::Paper => Search::Paper,
            },
            balance: args.fit.balance,
            weight: args.fit.torque_weight,
            limits: Limits {
                max_derivative: args.fit.max_torque,
                max_lean: args.fit.max_lean,
                max_curvature: None,
            },
            star_weight: args.fit.star_weight,
            refine: args.fit.refine
                || (!args.fit.no_refine && args.fit.search == SearchArg::Global),
            ..defaults.fit
        },
        teeth: match (args.teeth.teeth, args.teeth.module) {
            (Some(count), _) => ToothCount::Teeth(count),
            (None, Some(module)) => ToothCount::Module(module),
            (None, None) => ToothCount::Auto,
        },
        style: match args.teeth.teeth_style {
            StyleArg::Involute => TeethStyle::Involute,
            StyleArg::Wave => TeethStyle::Wave,
            StyleArg::RegularWave => TeethStyle::RegularWave,
        },
        carve_with_solids: args.teeth.carve_with == CarverArg::Manifold,
        pressure_angle: args.teeth.pressure_angle,
        addendum: args.teeth.addendum,
        clearance: args.teeth.clearance,
        backlash: args.teeth.backlash,
        root_clearance: args.teeth.root_clearance,
        chord_tolerance: args.teeth.chord_tolerance.unwrap_or(defaults.chord_tolerance),
        scale: match args.size.size {
            Some(extent) => Scale::Extent(extent),
            None => Scale::CenterDistance(args.size.center_distance),
        },
        thickness: args.size.thickness,
        bore: match args.size.bore {
            Some(bore) => BoreChoice::Exactly(bore),
            None => defaults.bore,
        },
        repair: !args.teeth.strict,
        runs: if args.no_simulate {
            Vec::new()
        } else {
            args.run.runs(args.size.thickness, centrode::policy::DESIGN_CYCLES)
        },
        ..defaults
    })
}

fn read(args: &DesignArgs) -> anyhow::Result<[Shape; 2]> {
    let options = LoadOptions {
        threshold: args.shape.threshold,
        smoothing: args.shape.smoothing.map_or(Smoothing::Auto, Smoothing::Fixed),
        ..LoadOptions::default()
    };
    Ok([load(&args.driver, &options)?, load(&args.follower, &options)?])
}

fn unsound(made: &Design, args: &DesignArgs) -> String {
    let hint = if args.teeth.strict {
        "without --strict gentler settings are tried"
    } else {
        "--force writes the files all the same"
    };
    let [driver, follower] = &made.names;
    format!(
        "{driver} and {follower} do not make a sound pair, so nothing was written: {} ({hint})",
        made.faults.join("; ")
    )
}

fn write(made: &Design, meshes: &[Mesh], args: &DesignArgs) -> anyhow::Result<Vec<PathBuf>> {
    let staging = Staging::new(&args.output)?;
    let files = write_into(staging.path(), made, meshes, &args.formats)
        .map_err(|error| staging.told_of_the_final_place(error))?;
    Ok(staging.publish(&files)?)
}

fn write_into(
    folder: &Path,
    made: &Design,
    meshes: &[Mesh],
    formats: &ExportArgs,
) -> Result<Vec<PathBuf>, ExportError> {
    let parts = Parts { assembly: &made.assembly, meshes };
    let mut files = write_parts(folder, parts, formats)?;
    if formats.wants(Format::Html) {
        let page = report_html(&made.assembly, &report::page(made));
        files.push(write_text(folder, "report.html", &page)?);
    }
    if let Some(proof) = &made.proof {
        files.extend(super::proof::write_tables(folder, proof)?);
    }
    // Always and last, so that a folder with a record is a folder that is complete.
    let path = folder.join(RECORD_NAME);
    write_json(&path, &Record::new(made))?;
    files.push(path);
    Ok(files)
}
