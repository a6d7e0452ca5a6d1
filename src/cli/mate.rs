//! `centrode mate`: a gear of one shape, and the gear that runs with it.

use std::ffi::OsString;

use anyhow::Context;
use centrode::fit::{FitOptions, Fixed, Limits};
use centrode::pipeline::{DesignOptions, Request};

use super::Outcome;
use super::args::MateArgs;
use super::files::Inputs;
use super::making::Asked;
use super::progress::Progress;

pub(crate) fn run(args: &MateArgs, words: &[OsString]) -> anyhow::Result<Outcome> {
    let asked = Asked::now(words);
    let progress = Progress::new();
    progress.doing("reading the shape");
    let shape = args.reading.read(&args.shape, &progress)?;
    let making = args.pair.making();
    let paths = [args.shape.as_str()];
    args.reading.warn_of_no_image(paths, &progress);
    let inputs = Inputs { paths: &paths, what: "drawing" };
    making.check_place(inputs)?;
    let options = options(args);
    progress.doing(format!("making the mate of {}", shape.name));
    let (low, high) = shape.outline.bounds();
    let name = shape.name.clone();
    let request = Request::one_shape(shape).with(options);
    let made = request.design(&progress.control()).with_context(|| {
        format!("{} (drawn from {:.4},{:.4} to {:.4},{:.4})", name, low.x, low.y, high.x, high.y)
    })?;
    making.deliver(&made, inputs, &progress, &asked)
}

/// As the library takes them.
pub(super) fn options(args: &MateArgs) -> DesignOptions {
    let options = args.pair.making().options(args.ratio);
    DesignOptions {
        fit: FitOptions {
            weight: args.torque_weight,
            limits: Limits {
                max_derivative: args.max_torque,
                max_lean: args.max_lean,
                max_curvature: None,
            },
            fixed: Fixed { driver_axis: args.axis, ..Fixed::default() },
            ..options.fit
        },
        ..options
    }
}
