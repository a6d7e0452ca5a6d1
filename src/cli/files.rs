//! The formats a user asked for, written into a folder.

use std::path::{Path, PathBuf};

use anyhow::anyhow;
use centrode::export::{Artifact, ExportError, ExportOptions, Format, Wanted, check_folder, write};

use super::args::ExportArgs;

impl ExportArgs {
    /// What is to be written, and how.
    pub(crate) fn wanted(&self) -> Wanted {
        Wanted {
            named: self.export.clone(),
            also: Some(Format::Gif).filter(|_| self.animate).into_iter().collect(),
            options: ExportOptions {
                curve_tolerance: self.curve_tolerance,
                dxf_polyline: self.dxf_polyline,
                dxf_r12: self.dxf_r12,
                kerf: self.kerf,
                laser_pitch_curves: self.laser_pitch_curves,
                bed: self.bed,
                ..ExportOptions::default()
            },
        }
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

/// Writes a text file whole; returns where it is.
pub(crate) fn write_text(folder: &Path, name: &str, text: &str) -> Result<PathBuf, ExportError> {
    write(vec![Artifact::bytes(name, text)], folder).map(|mut files| files.swap_remove(0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        formats: ExportArgs,
    }

    #[test]
    fn options_that_are_not_given_are_those_of_the_library() {
        let line = Line::parse_from(["centrode"]);
        assert_eq!(line.formats.wanted(), Wanted::default());
        let line = Line::parse_from(["centrode", "--export", "stp,DXF", "--animate"]);
        let wanted = line.formats.wanted();
        assert_eq!(wanted.named, [Format::Step, Format::Dxf]);
        assert!(wanted.wants(Format::Gif) && !wanted.wants(Format::Stl));
    }
}
