//! `centrode gallery`: many pairs, one folder each, and the tables and the page of all.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use anyhow::{Context, anyhow, bail};
use centrode::control::Control;
use centrode::diagnose::Severity;
use centrode::export::{
    Encode, Format, Parts, Picture, check_folder, check_inputs, prepare_folder, write_atomically,
    write_json,
};
use centrode::fit::{Ratio, fit};
use centrode::gallery::{
    Figures, Job, Row, TABLES, Thumbnail, all_pairs, gallery_html, sorted, to_csv, to_json,
    told_apart,
};
use centrode::geometry::{Point, intersection_over_union};
use centrode::input::{LoadOptions, Shape};
use centrode::outline::Smoothing;
use centrode::pipeline::{Design, DesignOptions, design};
use centrode::pitch::Centrodes;
use centrode::policy;
use centrode::report::report_html;
use centrode::results::design_page;
use centrode::schema::{RECORD_NAME, Record};
use centrode::solid::assembly_solids;
use clap::{CommandFactory, Parser};
use rayon::prelude::*;

use super::args::{Cli, Command, DesignArgs, GalleryArgs, GalleryStep, MergeArgs};
use super::files::write_text;
use super::gallery_shapes::{Gathered, gather};
use super::progress::{Bar, Progress};
use super::scene::given_settings;
use super::{Outcome, report};

/// The record of a pair for the gallery; a folder that has one is complete.
const ROW: &str = "row.json";

pub(crate) fn run(args: &GalleryArgs, words: &[OsString]) -> anyhow::Result<Outcome> {
    if let Some(GalleryStep::Merge(merge)) = &args.step {
        return join(merge);
    }
    let output = args.output.as_deref().context("no folder is named; give one with -o")?;
    let ratios: Vec<Ratio> =
        args.ratio.iter().map(|k| Ok(k.parse()?)).collect::<anyhow::Result<_>>()?;
    let template = design_args(words)?;
    // Options that make no sense should be said before the first shape is read.
    let base = super::design::options(&template)?;
    let reading = LoadOptions {
        threshold: args.shape.threshold,
        smoothing: args.shape.smoothing.map_or(Smoothing::Auto, Smoothing::Fixed),
        join: args.shape.join,
        ..LoadOptions::default()
    };
    let from: Vec<&str> = args.from.iter().chain(&args.shapes).map(String::as_str).collect();
    let Gathered { shapes, listed, complaints, sources } =
        gather(&from, args.pairs.as_deref(), &reading)?;
    let mut jobs = if from.is_empty() {
        Vec::new()
    } else {
        let among = listed.as_ref().map_or(shapes.len(), |l| l.first_shape);
        all_pairs(among, args.both_roles, &ratios)
    };
    for pair in listed.iter().flat_map(|l| &l.pairs) {
        let own: &[Ratio] = pair.ratio.as_ref().map_or(&ratios, std::slice::from_ref);
        let (driver, follower) = (pair.driver, pair.follower);
        jobs.extend(own.iter().map(|&ratio| Job { driver, follower, ratio }));
    }
    let mut once: Vec<Job> = Vec::with_capacity(jobs.len());
    let mut known = std::collections::HashSet::new();
    for job in jobs {
        if known.insert((job.driver, job.follower, job.ratio.to_string())) {
            once.push(job);
        }
    }
    for complaint in &complaints {
        eprintln!("warning: {complaint} (skipped)");
    }
    if once.is_empty() {
        bail!("no pair is left to make; name at least one shape that can be read");
    }
    if once.len() > policy::GALLERY_PAIRS {
        bail!(
            "{} pairs are more than the {} of one gallery; name fewer shapes",
            once.len(),
            policy::GALLERY_PAIRS
        );
    }
    let names = told_apart(&shapes.iter().map(|s| s.name.clone()).collect::<Vec<_>>());
    let mine: Vec<Job> = once
        .into_iter()
        .enumerate()
        .filter(|(i, _)| args.shard.is_none_or(|s| s.has(*i)))
        .map(|(_, job)| job)
        .collect();
    let progress = Progress::new();
    args.shape.warn_of_no_image(sources.iter().map(String::as_str), &progress);
    progress.done();
    check_folder(output)?;
    let mut inputs: Vec<&Path> = sources.iter().map(Path::new).collect();
    inputs.extend(args.pairs.as_deref());
    check_inputs(&inputs, "file", output, &TABLES)?;
    inputs.retain(|input| lies_in(input, output));
    let own: Vec<&str> = if args.formats.export.is_empty() {
        vec![ROW, RECORD_NAME, "pair.svg"]
    } else {
        args.formats.wanted().files_of_a_pair().into_iter().chain([ROW]).collect()
    };
    for job in mine.iter().filter(|_| !inputs.is_empty()) {
        check_inputs(&inputs, "file", &output.join(job.folder(&names)), &own)?;
    }
    prepare_folder(output)?;
    let maker = Maker { args, base, shapes: &shapes, names: &names, output, words };
    let bar = Bar::new(mine.len() as u64);
    let broken = Mutex::new(None);
    let rows: Vec<Row> = mine
        .par_iter()
        .filter_map(|job| {
            if broken.lock().is_ok_and(|b| b.is_some()) {
                return None;
            }
            bar.doing(job.folder(&names));
            let row = maker.row(job);
            bar.step();
            // Only what must stop everything, such as a full disk, comes here.
            row.map_err(|e| broken.lock().map(|mut b| b.get_or_insert(e).to_string()).ok()).ok()
        })
        .collect();
    bar.done();
    if let Some(error) = broken.into_inner().ok().flatten() {
        return Err(error.context("the gallery stopped; run the same command to go on"));
    }
    finish(output, rows, !complaints.is_empty())
}

/// `centrode gallery merge`.
fn join(args: &MergeArgs) -> anyhow::Result<Outcome> {
    check_folder(&args.output)?;
    let mut rows: Vec<Row> = Vec::new();
    let mut folders: Vec<(PathBuf, String)> = Vec::new();
    for part in &args.parts {
        let entries = fs::read_dir(part).with_context(|| {
            format!("{}: cannot read the gallery; check the path", part.display())
        })?;
        let before = rows.len();
        for entry in entries {
            let folder = entry?.path();
            let Some(row) = read_row(&folder) else { continue };
            match rows.iter().find(|r| r.folder == row.folder) {
                Some(same) if same.fingerprint != row.fingerprint => bail!(
                    "{} was made with other options or shapes than the same pair of another part; make both alike",
                    folder.display()
                ),
                Some(_) => {}
                None => {
                    folders.push((folder, row.folder.clone()));
                    rows.push(row);
                }
            }
        }
        if rows.len() == before && !part.join("gallery.csv").exists() {
            bail!(
                "{}: there is no pair here; name a folder that `centrode gallery` wrote",
                part.display()
            );
        }
    }
    prepare_folder(&args.output)?;
    for (from, name) in &folders {
        let to = args.output.join(name);
        if same_folder(from, &to) {
            continue;
        }
        prepare_folder(&to)?;
        let mut files: Vec<PathBuf> = fs::read_dir(from)?
            .filter_map(|e| Some(e.ok()?.path()))
            .filter(|p| p.is_file())
            .collect();
        // The row last: it says that the folder is complete.
        files.sort_by_key(|p| p.file_name().is_some_and(|n| n == ROW));
        for file in files {
            let target = to.join(file.file_name().unwrap_or_default());
            let content = fs::read(&file)
                .with_context(|| format!("{}: cannot be read; check the part", file.display()))?;
            write_atomically(&target, |out| std::io::Write::write_all(out, &content))?;
        }
    }
    finish(&args.output, rows, false)
}

fn lies_in(file: &Path, folder: &Path) -> bool {
    match (file.canonicalize(), folder.canonicalize()) {
        (Ok(file), Ok(folder)) => file.starts_with(folder),
        _ => false,
    }
}

fn same_folder(a: &Path, b: &Path) -> bool {
    match (a.canonicalize(), b.canonicalize()) {
        (Ok(a), Ok(b)) => a == b,
        _ => false,
    }
}

/// Writes the tables and the page and says how it went.
fn finish(output: &Path, rows: Vec<Row>, complained: bool) -> anyhow::Result<Outcome> {
    let rows = sorted(rows);
    write_text(output, "gallery.csv", &to_csv(&rows))?;
    write_json(&output.join("gallery.json"), &to_json(&rows))?;
    write_text(output, "index.html", &gallery_html(&rows))?;
    let count = |verdict: &str| rows.iter().filter(|r| r.verdict == verdict).count();
    let verdicts = ["good", "warnings", "unjudged", "unsound", "refused"];
    let said: Vec<String> =
        verdicts.iter().filter(|v| count(v) > 0).map(|v| format!("{} {v}", count(v))).collect();
    println!("{} pairs: {}", rows.len(), said.join(", "));
    println!("open {}", output.join("index.html").display());
    Ok(if complained { Outcome::NotSound } else { Outcome::Good })
}

/// The options of every pair, as `centrode design` reads them from the gallery's own words.
fn design_args(words: &[OsString]) -> anyhow::Result<DesignArgs> {
    let top = Cli::command();
    let matches = Cli::command().try_get_matches_from(words)?;
    let missing = || anyhow!("the options of the pairs are missing");
    let (Some((name, given)), Some(known)) = (matches.subcommand(), top.find_subcommand("design"))
    else {
        return Err(missing());
    };
    let gallery = top.find_subcommand(name).with_context(missing)?;
    let mut line: Vec<String> = vec!["centrode".into(), "design".into()];
    for setting in given_settings(gallery, given) {
        let own = ["ratio", "output", "json", "driver", "follower"];
        let shared = known.get_arguments().any(|a| a.get_long() == Some(setting.key.as_str()));
        if !shared || own.contains(&setting.key.as_str()) {
            continue;
        }
        if setting.values.is_empty() {
            line.push(format!("--{}", setting.key));
        } else {
            line.push(format!("--{}={}", setting.key, setting.values.join(",")));
        }
    }
    if !given.get_flag("simulate") {
        line.push("--no-simulate".into());
    }
    line.extend(["--output=.", "--", "driver", "follower"].map(String::from));
    match Cli::try_parse_from(line)?.command {
        Command::Design(args) => Ok(*args),
        _ => Err(missing()),
    }
}

fn read_row(folder: &Path) -> Option<Row> {
    serde_json::from_slice(&fs::read(folder.join(ROW)).ok()?).ok()
}

/// All that making one pair needs.
struct Maker<'a> {
    args: &'a GalleryArgs,
    base: DesignOptions,
    shapes: &'a [Shape],
    names: &'a [String],
    output: &'a Path,
    /// The command line.
    words: &'a [OsString],
}

/// A pair that was made, and what follows from it.
struct Made {
    row: Row,
    design: Option<Box<Design>>,
}

impl Maker<'_> {
    /// The row of a pair: read where it is complete, else made.
    fn row(&self, job: &Job) -> anyhow::Result<Row> {
        let folder = self.output.join(job.folder(self.names));
        let fingerprint = self.fingerprint(job);
        if let Some(row) = read_row(&folder).filter(|r| r.fingerprint == fingerprint) {
            return Ok(row);
        }
        prepare_folder(&folder)?;
        tidy(&folder);
        let made = self.made(job, fingerprint);
        if let Some(design) = &made.design {
            self.write(&folder, design)?;
        }
        write_json(&folder.join(ROW), &made.row)?;
        Ok(made.row)
    }

    fn options(&self, job: &Job) -> DesignOptions {
        let quick = !(self.args.thorough || self.args.simulate);
        DesignOptions { ratio: job.ratio, quick, ..self.base.clone() }
    }

    fn made(&self, job: &Job, fingerprint: String) -> Made {
        let [driver, follower] = [job.driver, job.follower].map(|i| &self.shapes[i]);
        let mut row = Row {
            folder: job.folder(self.names),
            driver: self.names[job.driver].clone(),
            follower: self.names[job.follower].clone(),
            ratio: job.ratio.to_string(),
            verdict: "refused".to_owned(),
            figures: None,
            remarks: Vec::new(),
            fingerprint,
            thumbnail: None,
        };
        let options = self.options(job);
        if self.args.no_teeth {
            match without_teeth(driver, follower, &options) {
                Ok((figures, thumbnail)) => {
                    row.verdict = "unjudged".to_owned();
                    (row.figures, row.thumbnail) = (Some(figures), Some(thumbnail));
                }
                Err(error) => row.remarks.push(error.to_string()),
            }
            return Made { row, design: None };
        }
        // One pair that breaks the program must not take the others with it.
        let attempt = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            design(driver, follower, &options)
        }));
        match attempt {
            Ok(Ok(made)) => {
                row.verdict = made.verdict().word().to_owned();
                row.figures = Some(Figures::of(&made));
                row.remarks = made.told(Severity::Fault);
                row.remarks.extend(made.told(Severity::Warning));
                row.thumbnail =
                    Some(Thumbnail::of_pair(&made.assembly, &made.centrodes, job.ratio));
                Made { row, design: Some(Box::new(made)) }
            }
            Ok(Err(error)) => {
                row.remarks.push(error.to_string());
                Made { row, design: None }
            }
            Err(_) => {
                row.remarks.push("the program failed on this pair; please report it".to_owned());
                Made { row, design: None }
            }
        }
    }

    /// The files of a pair: its record and picture, or the formats asked for.
    fn write(&self, folder: &Path, made: &Design) -> anyhow::Result<()> {
        let wanted = self.args.formats.wanted();
        if wanted.named.is_empty() {
            let parts = Parts { assembly: &made.assembly, meshes: &[] };
            Picture.write(parts, folder)?;
        } else {
            let meshes =
                if wanted.wants_solids() { assembly_solids(&made.assembly)? } else { Vec::new() };
            wanted.write(Parts { assembly: &made.assembly, meshes: &meshes }, folder)?;
            if wanted.wants(Format::Html) {
                let page =
                    report_html(&made.assembly, &design_page(made, report::shown(self.words)));
                write_text(folder, "report.html", &page)?;
            }
        }
        if let Some(proof) = &made.proof {
            super::proof::write_tables(folder, proof)?;
        }
        write_json(&folder.join(RECORD_NAME), &Record::new(made))?;
        Ok(())
    }

    /// Stands for all that the pair depends on.
    fn fingerprint(&self, job: &Job) -> String {
        let mut hash = Fnv::new();
        let formats = &self.args.formats;
        hash.text(env!("CARGO_PKG_VERSION"));
        hash.text(&format!("{:?} {formats:?} {}", self.options(job), self.args.no_teeth));
        for index in [job.driver, job.follower] {
            for point in
                self.shapes[index].outline.points().iter().chain(self.shapes[index].raw.points())
            {
                hash.number(point.x);
                hash.number(point.y);
            }
        }
        format!("{:016x}", hash.0)
    }
}

/// The fit alone, with its pitch curves for outlines.
fn without_teeth(
    driver: &Shape,
    follower: &Shape,
    options: &DesignOptions,
) -> anyhow::Result<(Figures, Thumbnail)> {
    let fitted =
        fit(&driver.outline, &follower.outline, options.ratio, &options.fit, Control::unwatched())?;
    let centrodes = Centrodes { transmission: fitted.transmission.clone(), center_distance: 1.0 };
    let curves = [
        centrodes.driver_curve(policy::PITCH_CURVE_POINTS),
        centrodes.follower_curve(policy::PITCH_CURVE_POINTS),
    ];
    let inputs = [(driver, &fitted.driver), (follower, &fitted.follower)].map(|(shape, gear)| {
        let points = shape.raw.points();
        points.iter().map(|p| gear.placement.apply(*p)).collect::<Vec<Point>>()
    });
    let objective = &fitted.objective;
    let figures = Figures {
        e: objective.shape + objective.weight * objective.torque,
        shape: objective.shape,
        total: objective.total,
        torque: centrodes.transmission.max_derivative(),
        iou: [0, 1].map(|i| intersection_over_union(&curves[i], &inputs[i])),
        teeth: None,
        module: None,
        lean: centrodes.max_lean(),
        transmission_error: None,
        lost_poses: None,
        vertices: None,
    };
    let rings = [0, 1].map(|i| [curves[i].as_slice(), inputs[i].as_slice()]);
    Ok((figures, Thumbnail::new(&rings, &centrodes, options.ratio)))
}

/// Takes away what a killed run left half written.
fn tidy(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        if name.starts_with('.') && name.ends_with(".part") {
            // What stays does no harm.
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// The hash FNV-1a, 64 bits: the same on every machine.
struct Fnv(u64);

impl Fnv {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn byte(&mut self, byte: u8) {
        self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    }

    fn text(&mut self, text: &str) {
        text.bytes().for_each(|b| self.byte(b));
    }

    fn number(&mut self, value: f64) {
        value.to_bits().to_le_bytes().into_iter().for_each(|b| self.byte(b));
    }
}
