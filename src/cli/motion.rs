//! `centrode motion`: gears from a wanted motion.

use std::ffi::OsString;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use anyhow::{Context, anyhow, bail};
use centrode::law::{Formula, LawOptions, Quantity, Segment, Table, from_function, from_segment};
use centrode::pipeline::{DesignOptions, Request};
use centrode::pitch::Transmission;
use centrode::policy;

use super::Outcome;
use super::args::MotionArgs;
use super::files::Inputs;
use super::making::Asked;
use super::progress::Progress;

/// Extensions of tables.
const TABLES: [&str; 3] = ["csv", "tsv", "txt"];

pub(crate) fn run(args: &MotionArgs, words: &[OsString]) -> anyhow::Result<Outcome> {
    let asked = Asked::now(words);
    let progress = Progress::new();
    let (transmission, names) = motion(args)?;
    let making = args.pair.making();
    let said = args.law.iter().chain(&args.centrode).map(String::as_str);
    let paths: Vec<&str> = said.filter(|text| is_table(Path::new(text))).collect();
    let inputs = Inputs { paths: &paths, what: "table" };
    making.check_place(inputs)?;
    let options = options(args);
    progress.doing("laying teeth on the pitch curves");
    let request = Request::motion(transmission, names).with(options);
    let made = request.design(&progress.control())?;
    making.deliver(&made, inputs, &progress, &asked)
}

/// As the library takes them.
pub(super) fn options(args: &MotionArgs) -> DesignOptions {
    let sector = segment(args).filter(|_| args.sector);
    DesignOptions { sector, ..args.pair.making().options(args.ratio) }
}

/// Whether the motion stands in a file.
pub(super) fn reads_a_table(args: &MotionArgs) -> bool {
    args.law.iter().chain(&args.centrode).any(|text| is_table(Path::new(text)))
}

fn segment(args: &MotionArgs) -> Option<Segment> {
    args.from.zip(args.to).map(|(from, to)| Segment { from, to })
}

/// The motion, and what the gears are called.
pub(super) fn motion(args: &MotionArgs) -> anyhow::Result<(Transmission, [String; 2])> {
    let with = |quantity| LawOptions { ratio: args.ratio, quantity, normalise: args.normalise };
    let (text, quantity, sign) = match (&args.law, &args.centrode, &args.preset) {
        (Some(law), ..) if args.psi => (law, Quantity::Angle, "psi"),
        (Some(law), ..) => (law, Quantity::Speed, "psi'"),
        (None, Some(radius), _) => (radius, Quantity::DriverRadius, "r"),
        (None, None, Some(preset)) => {
            return Ok((preset.transmission(&with(Quantity::Speed))?, preset.names()));
        }
        (None, None, None) => {
            bail!("no motion is given; write a formula such as '1 + 0.3*cos(2*phi)', or --preset")
        }
    };
    let options = with(quantity);
    let segment = segment(args);
    let path = Path::new(text);
    if is_table(path) {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let made = Table::parse(&read(path)?, quantity)
            .and_then(|table| match segment {
                Some(segment) => table.segment_transmission(segment, &options),
                None => table.transmission(&options),
            })
            .with_context(|| path.display().to_string())?;
        return Ok((made, [stem, "its follower".to_owned()]));
    }
    let formula = Formula::parse(text)?;
    let made = match segment {
        Some(segment) => from_segment(|phi| formula.at(phi), segment, &options)?,
        None => from_function(|phi| formula.at(phi), &options)?,
    };
    Ok((made, [format!("{sign} = {}", text.trim()), "its follower".to_owned()]))
}

fn is_table(path: &Path) -> bool {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    TABLES.contains(&extension.as_str())
}

/// A table's bytes, and at most one more than is taken.
fn read(path: &Path) -> anyhow::Result<Vec<u8>> {
    if path.is_dir() {
        bail!("{}: this is a folder; name a table in it", path.display());
    }
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(policy::LAW_TABLE_BYTES as u64 + 1).read_to_end(&mut bytes))
        .map_err(|error| {
            anyhow!("{}: the table cannot be read ({error}); check the path", path.display())
        })?;
    Ok(bytes)
}
