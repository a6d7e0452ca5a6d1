//! `centrode design`: from the command line to a folder of files.

use std::ffi::OsString;
use std::io::Write as _;

use centrode::export::{Staging, check_folder, check_inputs, write_json};
use centrode::fit::{FitOptions, Fixed, Limits, Ratio, Search, alternatives};
use centrode::input::Shape;
use centrode::pipeline::{DesignOptions, Request};
use centrode::report::Alternatives;

use super::Outcome;
use super::args::{DesignArgs, SearchArg};
use super::files::{Inputs, write_text};
use super::making::Asked;
use super::mirror::mirrored;
use super::progress::Progress;

/// Names of what `--alternatives` writes.
const CHOICES: [&str; 2] = ["alternatives.html", "alternatives.json"];

pub(crate) fn run(args: &DesignArgs, words: &[OsString]) -> anyhow::Result<Outcome> {
    let asked = Asked::now(words);
    let mut options = options(args)?;
    let progress = Progress::new();
    progress.doing("reading the shapes");
    let shapes =
        [args.shape.read(&args.driver, &progress)?, args.shape.read(&args.follower, &progress)?];
    let paths = [args.driver.as_str(), &args.follower];
    args.shape.warn_of_no_image(paths, &progress);
    let inputs = Inputs { paths: &paths, what: "drawing" };
    let [driver, follower] = mirrored(shapes, args.fit.mirror, &mut options, &progress.control())?;
    if let Some(count) = args.fit.alternatives {
        return choices(
            args,
            [&driver, &follower],
            usize::from(count),
            &options,
            inputs,
            &progress,
        );
    }
    args.pair.making().check_place(inputs)?;
    progress.doing(format!("fitting {} to {}", driver.name, follower.name));
    let request = Request::two_shapes(driver, follower).with(options);
    let made = request.design(&progress.control())?;
    args.pair.making().deliver(&made, inputs, &progress, &asked)
}

/// Writes the page and the data of the pairs there are to choose from.
fn choices(
    args: &DesignArgs,
    [driver, follower]: [&Shape; 2],
    count: usize,
    options: &DesignOptions,
    inputs: Inputs<'_>,
    progress: &Progress,
) -> anyhow::Result<Outcome> {
    let folder = &args.pair.output;
    check_folder(folder)?;
    check_inputs(inputs.paths, inputs.what, folder, &CHOICES)?;
    progress.doing(format!("fitting {} to {}", driver.name, follower.name));
    let shapes = [&driver.outline, &follower.outline];
    let fits = alternatives(
        shapes[0],
        shapes[1],
        options.ratio,
        &options.fit,
        count,
        &progress.control(),
    )?;
    let page = Alternatives {
        names: [&driver.name, &follower.name],
        shapes,
        fits: &fits,
        made_by: concat!("centrode ", env!("CARGO_PKG_VERSION")),
    };
    let staging = Staging::new(folder)?;
    let data = staging.path().join(CHOICES[1]);
    write_json(&data, &page.json())?;
    let files = [write_text(staging.path(), CHOICES[0], &page.html())?, data];
    let files = staging.publish_beside(&files, inputs.paths, inputs.what)?;
    progress.done();
    let mut out = std::io::stdout().lock();
    if args.pair.json {
        let mut value = page.json();
        value["files"] = serde_json::json!(files);
        writeln!(out, "{value}")?;
        return Ok(Outcome::Good);
    }
    for (i, fit) in fits.iter().enumerate() {
        writeln!(
            out,
            "{:2}  {} {:.0} %, {} {:.0} %, torque up to {:.2}",
            i + 1,
            driver.name,
            100.0 * fit.driver.iou,
            follower.name,
            100.0 * fit.follower.iou,
            fit.transmission.max_derivative()
        )?;
    }
    if fits.len() < count {
        writeln!(out, "These shapes make no more pairs that differ.")?;
    }
    writeln!(out, "See {}; make one with --choose and its number.", files[0].display())?;
    Ok(Outcome::Good)
}

pub(super) fn options(args: &DesignArgs) -> anyhow::Result<DesignOptions> {
    let ratio: Ratio = args.ratio.parse()?;
    let making = args.pair.making().options(ratio);
    Ok(DesignOptions {
        fit: FitOptions {
            search: match args.fit.search {
                SearchArg::Global => Search::Global,
                SearchArg::Coarse => Search::Coarse,
                SearchArg::Paper => Search::Paper,
            },
            balance: args.fit.balance,
            weight: args.fit.torque_weight,
            limits: Limits {
                max_derivative: args.fit.max_torque,
                max_lean: args.fit.max_lean,
                max_curvature: None,
            },
            fixed: Fixed {
                driver_axis: args.fit.driver_axis,
                follower_axis: args.fit.follower_axis,
                orientation: args.fit.orientation,
            },
            symmetric: args.fit.symmetric,
            star_weight: args.fit.star_weight,
            refine: args.fit.refine || (!args.fit.no_refine && args.fit.search != SearchArg::Paper),
            effort: args.fit.effort,
            choose: args.fit.choose.map(usize::from),
            ..making.fit
        },
        ..making
    })
}
