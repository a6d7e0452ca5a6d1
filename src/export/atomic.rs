//! Files that appear whole or not at all.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Why a file could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// The folder cannot be made or written to.
    #[error("cannot write {} ({source}); choose a folder you may write to with -o", path.display())]
    NotWritable {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The disk, or the share of it you may use, is full.
    #[error("no space left to write {}; free some or choose another disk with -o", path.display())]
    DiskFull {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The data does not go into the format.
    #[error("cannot put the design into {} ({why}); leave this format out and report the drawing", path.display())]
    Encode {
        /// The file.
        path: PathBuf,
        /// What the encoder said.
        why: String,
    },
}

impl ExportError {
    pub(super) fn from_io(path: &Path, source: io::Error) -> Self {
        let path = path.to_owned();
        match source.kind() {
            ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge => {
                Self::DiskFull { path, source }
            }
            ErrorKind::InvalidData | ErrorKind::InvalidInput => {
                Self::Encode { path, why: source.to_string() }
            }
            _ => Self::NotWritable { path, source },
        }
    }
}

/// Makes the folder and those above it, if they are missing.
///
/// # Errors
/// [`ExportError`], naming the folder.
pub fn prepare_folder(folder: &Path) -> Result<(), ExportError> {
    fs::create_dir_all(folder).map_err(|e| ExportError::from_io(folder, e))
}

/// Writes `path` through a temporary file beside it, renamed when complete: readers see the old
/// file or the whole new one, and a failure leaves nothing behind.
///
/// # Errors
/// [`ExportError`], naming the file; an [`ErrorKind::InvalidData`] out of `write` becomes
/// [`ExportError::Encode`].
pub fn write_atomically(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<(), ExportError> {
    let temporary = Temporary::beside(path);
    let finish = || -> io::Result<()> {
        let file = OpenOptions::new().write(true).create_new(true).open(&temporary.0)?;
        let mut out = BufWriter::new(file);
        write(&mut out)?;
        out.flush()?;
        drop(out);
        fs::rename(&temporary.0, path)
    };
    finish().map_err(|e| ExportError::from_io(path, e))
}

/// Removed when dropped, also by a panic; after the rename there is nothing to remove.
struct Temporary(PathBuf);

impl Temporary {
    fn beside(path: &Path) -> Self {
        let mut name = std::ffi::OsString::from(".");
        name.push(path.file_name().unwrap_or_default());
        name.push(format!(".{}.part", std::process::id()));
        let temporary = path.with_file_name(name);
        // One left by a killed process of the same number would block `create_new`.
        let _ = fs::remove_file(&temporary);
        Self(temporary)
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_new_content_replaces_the_old() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        for text in ["first, and longer", "second"] {
            write_atomically(&path, |out| out.write_all(text.as_bytes())).unwrap();
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_full_disk_leaves_the_old_file_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        fs::write(&path, "old").unwrap();
        let error = write_atomically(&path, |out| {
            out.write_all(&[b'x'; 100_000])?;
            Err(ErrorKind::StorageFull.into())
        })
        .unwrap_err();
        assert!(matches!(&error, ExportError::DiskFull { .. }));
        assert!(error.to_string().contains("a.txt") && error.to_string().contains("-o"));
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_folder_that_is_a_file_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("plain");
        fs::write(&file, "").unwrap();
        for error in [
            write_atomically(&file.join("a.stl"), |_| Ok(())).unwrap_err(),
            prepare_folder(&file.join("out")).unwrap_err(),
        ] {
            assert!(matches!(&error, ExportError::NotWritable { .. }));
            assert!(error.to_string().contains("plain") && error.to_string().contains("choose a"));
        }
    }

    #[test]
    fn what_cannot_be_encoded_is_not_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.json");
        let bad = |_: &mut _| Err(io::Error::new(ErrorKind::InvalidData, "NaN"));
        assert!(matches!(write_atomically(&path, bad), Err(ExportError::Encode { .. })));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
