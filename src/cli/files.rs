//! The formats a user asked for, written into a folder.

use std::path::{Path, PathBuf};

use anyhow::anyhow;
use centrode::design::RECORD_NAME;
use centrode::export::{
    Animation, Dxf, Export, ExportError, Format, Glb, LaserSvg, Mjcf, Obj, Parts, Plate, Step, Stl,
    ThreeMf, check_folder, write_atomically,
};
use centrode::policy;
use centrode::report::{PictureOptions, pair_svg};

use super::args::ExportArgs;
use super::units;

impl ExportArgs {
    /// Whether a format is wanted; all but the moving picture are when none is named.
    pub(crate) fn wants(&self, format: Format) -> bool {
        match format {
            Format::Gif => self.animate || self.export.contains(&format),
            _ => self.export.is_empty() || self.export.contains(&format),
        }
    }

    /// Names of the files that every pair gets in these formats.
    pub(crate) fn names_of_a_pair(&self) -> Vec<&'static str> {
        let of = |format| -> &[&'static str] {
            match format {
                Format::Glb => &["pair.glb"],
                Format::Obj => &["pair.obj"],
                Format::Stl => &["driver.stl", "follower.stl"],
                Format::ThreeMf => &["pair.3mf", "plate.3mf"],
                Format::Step => &["pair.step"],
                Format::Dxf => &["pair.dxf", "driver.dxf", "follower.dxf"],
                Format::Svg => &["laser.svg", "pair.svg"],
                Format::Mjcf => &["scene.xml"],
                Format::Gif => &["turning.gif", "turning.svg"],
                Format::Html => &["report.html"],
                Format::Json => &[],
            }
        };
        let wanted = Format::ALL.into_iter().filter(|f| self.wants(*f)).flat_map(of);
        wanted.copied().chain([RECORD_NAME]).collect()
    }
}

/// Files that a run reads.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inputs<'a> {
    /// Where they are; built-in names may be among them.
    pub(crate) paths: &'a [&'a str],
    /// What one is called.
    pub(crate) what: &'static str,
}

/// A kerf that a cutter may have, mm.
pub(crate) fn kerf(text: &str) -> Result<f64, String> {
    let most = policy::LARGEST_KERF;
    match units::length_or_zero(text)? {
        value if value <= most => Ok(value),
        _ => Err(format!("'{text}' is wider than any cutter's; give 0mm to {most}mm")),
    }
}

/// A distance that curves in files may keep from the outline, mm.
pub(crate) fn curve_tolerance(text: &str) -> Result<f64, String> {
    let (least, most) = (policy::LEAST_EXPORT_TOLERANCE, policy::LARGEST_EXPORT_TOLERANCE);
    match units::positive_length(text)? {
        value if (least..=most).contains(&value) => Ok(value),
        _ => Err(format!("'{text}' is no tolerance that fits gears; give {least}mm to {most}mm")),
    }
}

/// The error in the words of an option that names a file; that of a folder is -o.
pub(crate) fn told_of(option: &str, error: ExportError) -> anyhow::Error {
    match error {
        ExportError::NotWritable { path, source } => anyhow!(
            "cannot write {} ({source}); name a place you may write to with {option}",
            path.display()
        ),
        ExportError::NotAFolder { path, what } => {
            anyhow!("{} is {what}, not a folder; name another place with {option}", path.display())
        }
        ExportError::Overwrites { path, what } => anyhow!(
            "{} is a {what} that this run reads and would be overwritten; name another place with {option}",
            path.display()
        ),
        ExportError::DiskFull { path, .. } => anyhow!(
            "no space left to write {}; free some or name a place on another disk with {option}",
            path.display()
        ),
        other @ ExportError::Encode { .. } => other.into(),
    }
}

/// Whether a file may be written at `path`, as far as can be told before there is one.
pub(crate) fn check_file(path: &Path) -> Result<(), ExportError> {
    if path.is_dir() {
        let source = std::io::Error::new(std::io::ErrorKind::IsADirectory, "it is a folder");
        return Err(ExportError::NotWritable { path: path.to_owned(), source });
    }
    path.parent().map_or(Ok(()), check_folder)
}

/// Writes the wanted formats that an assembly alone can fill; returns the files. `scene` says how a MuJoCo scene is run.
pub(crate) fn write_parts(
    folder: &Path,
    parts: Parts<'_>,
    args: &ExportArgs,
    scene: &Mjcf,
) -> Result<Vec<PathBuf>, ExportError> {
    let tolerance = args.curve_tolerance;
    let dxf = Dxf { polyline: args.dxf_polyline, r12: args.dxf_r12, tolerance };
    let plate = Plate { bed: args.bed };
    let formats: [(Format, &dyn Export); 10] = [
        (Format::Glb, &Glb::default()),
        (Format::Stl, &Stl),
        (Format::Obj, &Obj),
        (Format::ThreeMf, &ThreeMf),
        (Format::ThreeMf, &plate),
        (Format::Step, &Step { tolerance }),
        (Format::Dxf, &dxf),
        (Format::Mjcf, scene),
        (
            Format::Svg,
            &LaserSvg { kerf: args.kerf, tolerance, pitch_curves: args.laser_pitch_curves },
        ),
        (Format::Gif, &Animation::default()),
    ];
    let mut files = Vec::new();
    for (format, writer) in formats {
        // A MuJoCo scene holds no shared axles and no sectors; it is refused only where it was asked for by name.
        let possible = format != Format::Mjcf
            || (parts.assembly.axles.is_empty() && !parts.assembly.swings())
            || args.export.contains(&format);
        if args.wants(format) && possible {
            files.extend(writer.write(parts, folder)?);
        }
    }
    if args.wants(Format::Svg) {
        let picture = pair_svg(parts.assembly, &PictureOptions::default());
        files.push(write_text(folder, "pair.svg", &picture)?);
    }
    Ok(files)
}

/// Writes a text file whole; returns where it is.
pub(crate) fn write_text(folder: &Path, name: &str, text: &str) -> Result<PathBuf, ExportError> {
    let path = folder.join(name);
    write_atomically(&path, |out| std::io::Write::write_all(out, text.as_bytes()))?;
    Ok(path)
}
