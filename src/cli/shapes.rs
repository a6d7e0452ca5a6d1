//! `centrode shapes`: the built-in library.

use anyhow::Context;
use centrode::export::write_atomically;
use centrode::input::{LoadOptions, load};
use centrode::outline::library;
use centrode::report::contact_sheet_svg;
use std::io::Write;

use super::Outcome;
use super::args::ShapesArgs;
use super::files::{check_file, told_of};

/// Shapes in a row of the contact sheet.
const COLUMNS: usize = 8;

pub(crate) fn run(args: &ShapesArgs) -> anyhow::Result<Outcome> {
    let all: Vec<&str> = library::names().collect();
    if let Some(path) = &args.sheet {
        let told = |error| told_of("--sheet", error);
        check_file(path).map_err(told)?;
        let shapes = all
            .iter()
            .map(|name| Ok((*name, load(name, &LoadOptions::default())?.raw)))
            .collect::<anyhow::Result<Vec<_>>>()?;
        let listed: Vec<_> = shapes.iter().map(|(name, outline)| (*name, outline)).collect();
        let svg = contact_sheet_svg(&listed, COLUMNS);
        write_atomically(path, |out| out.write_all(svg.as_bytes())).map_err(told)?;
    }
    let text = if args.json { serde_json::to_string(&all)? } else { all.join("\n") };
    let mut out = std::io::stdout().lock();
    writeln!(out, "{text}").context("cannot write to standard output")?;
    Ok(Outcome::Good)
}
