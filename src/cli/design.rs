//! `centrode design`: from the command line to a folder of files.

use std::time::Instant;

use centrode::design::{DesignOptions, design};
use centrode::fit::{FitOptions, Fixed, Limits, Ratio, Search};

use super::Outcome;
use super::args::{DesignArgs, SearchArg};
use super::files::Inputs;
use super::progress::Progress;

pub(crate) fn run(args: &DesignArgs) -> anyhow::Result<Outcome> {
    let start = Instant::now();
    let options = options(args)?;
    let progress = Progress::new();
    progress.doing("reading the shapes");
    let (driver, follower) = (args.shape.read(&args.driver)?, args.shape.read(&args.follower)?);
    let paths = [args.driver.as_str(), &args.follower];
    args.shape.warn_of_no_image(paths, &progress);
    let inputs = Inputs { paths: &paths, what: "drawing" };
    args.pair.making().check_place(inputs)?;
    progress.doing(format!("fitting {} to {}", driver.name, follower.name));
    let made = design(&driver, &follower, &options)?;
    args.pair.making().deliver(&made, inputs, &progress, start)
}

pub(super) fn options(args: &DesignArgs) -> anyhow::Result<DesignOptions> {
    let ratio: Ratio = args.ratio.parse()?;
    let making = args.pair.making().options(ratio);
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
            fixed: Fixed {
                driver_axis: args.fit.driver_axis,
                follower_axis: args.fit.follower_axis,
                orientation: args.fit.orientation,
            },
            symmetric: args.fit.symmetric,
            star_weight: args.fit.star_weight,
            refine: args.fit.refine
                || (!args.fit.no_refine && args.fit.search == SearchArg::Global),
            ..making.fit
        },
        ..making
    })
}
