//! What all commands share that make a pair: options of teeth and size, and the way from a design to a folder.

use std::ffi::OsString;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::time::Instant;

use centrode::diagnose::Severity;
use centrode::export::{
    ExportError, Format, Parts, Staging, check_folder, check_inputs, write_json,
};
use centrode::fit::Ratio;
use centrode::input::{LoadOptions, Shape, load};
use centrode::outline::Smoothing;
use centrode::pipeline::{Design, DesignOptions, Scale, TeethStyle, ToothCount};
use centrode::report::report_html;
use centrode::results::{RUN_TABLES, design_page};
use centrode::schema::{RECORD_NAME, Record};
use centrode::solid::{Mesh, assembly_solids};
use centrode::strength::Load;

use super::args::{
    CarverArg, ExportArgs, PairArgs, RunArgs, ShapeArgs, SizeArgs, StyleArg, TeethArgs,
};
use super::files::{Inputs, write_text};
use super::outfit::OutfitArgs;
use super::progress::Progress;
use super::{Outcome, report};

/// Bytes at the head of a file that tell an image from other drawings.
const IMAGE_HEAD: u64 = 64;

/// The options of a command that makes a pair, wherever the pair comes from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Making<'a> {
    pub(crate) output: &'a Path,
    json: bool,
    teeth: &'a TeethArgs,
    size: &'a SizeArgs,
    outfit: &'a OutfitArgs,
    formats: &'a ExportArgs,
    no_simulate: bool,
    run: &'a RunArgs,
}

/// What a command was asked, and when.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Asked<'a> {
    words: &'a [OsString],
    start: Instant,
}

impl<'a> Asked<'a> {
    /// A command that begins now; `words` is its command line.
    pub(crate) fn now(words: &'a [OsString]) -> Self {
        Self { words, start: Instant::now() }
    }
}

impl PairArgs {
    pub(crate) fn making(&self) -> Making<'_> {
        Making {
            output: &self.output,
            json: self.json,
            teeth: &self.teeth,
            size: &self.size,
            outfit: &self.outfit,
            formats: &self.formats,
            no_simulate: self.no_simulate,
            run: &self.run,
        }
    }
}

impl Making<'_> {
    /// Everything but the fit.
    pub(crate) fn options(&self, ratio: Ratio) -> DesignOptions {
        let defaults = DesignOptions::new(ratio);
        DesignOptions {
            teeth: match (self.teeth.teeth, self.teeth.module) {
                (Some(count), _) => ToothCount::Teeth(count),
                (None, Some(module)) => ToothCount::Module(module),
                (None, None) => ToothCount::Auto,
            },
            style: match self.teeth.teeth_style {
                StyleArg::Involute => TeethStyle::Involute,
                StyleArg::Wave => TeethStyle::Wave,
                StyleArg::RegularWave => TeethStyle::RegularWave,
            },
            carve_with_solids: self.teeth.carve_with == CarverArg::Manifold,
            pressure_angle: self.teeth.pressure_angle,
            addendum: self.teeth.addendum,
            clearance: self.teeth.clearance,
            backlash: self.teeth.backlash,
            root_clearance: self.teeth.root_clearance,
            chord_tolerance: self.teeth.chord_tolerance.unwrap_or(defaults.chord_tolerance),
            scale: match self.size.size {
                Some(extent) => Scale::Extent(extent),
                None => Scale::CenterDistance(self.size.center_distance),
            },
            thickness: self.size.thickness,
            bore: self.outfit.bore().unwrap_or(defaults.bore),
            outfit: self.outfit.outfit(),
            repair: !self.teeth.strict,
            load: Load { torque: self.run.load, rpm: self.run.rpm, friction: self.run.friction },
            runs: if self.no_simulate {
                Vec::new()
            } else {
                self.run.runs(self.size.thickness, centrode::policy::DESIGN_CYCLES)
            },
            ..defaults
        }
    }

    /// Whether the files have a place and leave the run's own inputs alone: told before the pair is made.
    pub(crate) fn check_place(&self, inputs: Inputs<'_>) -> Result<(), ExportError> {
        check_folder(self.output)?;
        let mut names = self.formats.wanted().files_of_a_pair();
        if !self.no_simulate {
            names.extend(RUN_TABLES);
        }
        check_inputs(inputs.paths, inputs.what, self.output, &names)
    }

    /// Writes a finished design and says what it is; an unsound one is refused unless forced.
    pub(crate) fn deliver(
        &self,
        made: &Design,
        inputs: Inputs<'_>,
        progress: &Progress,
        asked: &Asked<'_>,
    ) -> anyhow::Result<Outcome> {
        if !made.is_sound() && !self.teeth.force {
            progress.done();
            eprintln!("error: {}", self.unsound(made));
            return Ok(Outcome::NotSound);
        }
        progress.doing("making solids");
        let meshes = assembly_solids(&made.assembly)?;
        progress.doing("writing files");
        let files = self.write(made, &meshes, inputs, asked)?;
        progress.done();
        report::summary(made, &files, self.output, asked.start.elapsed(), self.json)?;
        Ok(if made.is_sound() { Outcome::Good } else { Outcome::NotSound })
    }

    fn unsound(&self, made: &Design) -> String {
        let hint = if self.teeth.strict {
            "without --strict gentler settings are tried"
        } else {
            "--force writes the files all the same"
        };
        let [driver, follower] = &made.names;
        format!(
            "{driver} and {follower} do not make a sound pair, so nothing was written: {} ({hint})",
            made.told(Severity::Fault).join("; ")
        )
    }

    fn write(
        &self,
        made: &Design,
        meshes: &[Mesh],
        inputs: Inputs<'_>,
        asked: &Asked<'_>,
    ) -> anyhow::Result<Vec<PathBuf>> {
        let staging = Staging::new(self.output)?;
        let files =
            write_into(staging.path(), made, meshes, self.formats, report::shown(asked.words))
                .map_err(|error| staging.told_of_the_final_place(error))?;
        Ok(staging.publish_beside(&files, inputs.paths, inputs.what)?)
    }
}

/// Writes everything asked for of a design into `folder`; `command` makes it again.
pub(super) fn write_into(
    folder: &Path,
    made: &Design,
    meshes: &[Mesh],
    formats: &ExportArgs,
    command: String,
) -> Result<Vec<PathBuf>, ExportError> {
    let parts = Parts { assembly: &made.assembly, meshes };
    let wanted = formats.wanted();
    let mut files = wanted.write(parts, folder)?;
    if wanted.wants(Format::Html) {
        let page = report_html(&made.assembly, &design_page(made, command));
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

impl ShapeArgs {
    /// Reads a drawing.
    pub(crate) fn read(&self, source: &str, progress: &Progress) -> anyhow::Result<Shape> {
        let shape = load(source, &self.options())?;
        for note in &shape.notes {
            progress.warn(&format!("{}: {note}", shape.name));
        }
        Ok(shape)
    }

    /// As the library takes them.
    pub(super) fn options(&self) -> LoadOptions {
        LoadOptions {
            threshold: self.threshold,
            smoothing: self.smoothing.map_or(Smoothing::Auto, Smoothing::Fixed),
            join: self.join,
            ..LoadOptions::default()
        }
    }

    /// Says so when a threshold was given for drawings of which none is an image.
    pub(crate) fn warn_of_no_image<'a>(
        &self,
        sources: impl IntoIterator<Item = &'a str>,
        progress: &Progress,
    ) {
        if self.threshold.is_some() && !sources.into_iter().any(is_image) {
            progress.warn("--threshold changes nothing, for no drawing is an image");
        }
    }
}

fn is_image(source: &str) -> bool {
    let mut head = Vec::new();
    let read = File::open(source).and_then(|f| f.take(IMAGE_HEAD).read_to_end(&mut head));
    read.is_ok() && image::guess_format(&head).is_ok()
}
