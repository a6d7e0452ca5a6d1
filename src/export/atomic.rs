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
    /// Something else is where the folder should be.
    #[error("{} is {what}, not a folder; choose another folder with -o", path.display())]
    NotAFolder {
        /// The path, or the part of it that is in the way.
        path: PathBuf,
        /// What is there.
        what: &'static str,
    },
    /// A file that is read would be lost.
    #[error("{} is a {what} that this run reads and would be overwritten; choose another folder with -o", path.display())]
    Overwrites {
        /// The file that is read.
        path: PathBuf,
        /// What it is.
        what: &'static str,
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
    check_folder(folder)?;
    fs::create_dir_all(folder).map_err(|e| ExportError::from_io(folder, e))
}

/// Whether `folder` is a folder or can become one, as far as can be told without making anything.
///
/// # Errors
/// [`ExportError::NotAFolder`], naming what is in the way.
pub fn check_folder(folder: &Path) -> Result<(), ExportError> {
    let there = |p: &&Path| !p.as_os_str().is_empty() && p.symlink_metadata().is_ok();
    let Some(found) = folder.ancestors().find(there) else { return Ok(()) };
    let what = match found.metadata() {
        Ok(kind) if kind.is_dir() => return Ok(()),
        Ok(_) => "a file",
        Err(error) if error.kind() == ErrorKind::NotFound => "a link to nothing",
        // Whatever else is wrong, the system says so when the folder is made.
        Err(_) => return Ok(()),
    };
    Err(ExportError::NotAFolder { path: found.to_owned(), what })
}

/// Whether files called `names` in `folder` leave `inputs` alone, which may not exist.
///
/// # Errors
/// [`ExportError::Overwrites`], naming the input; `what` says what the inputs are.
pub fn check_inputs<P: AsRef<Path>, N: AsRef<Path>>(
    inputs: &[P],
    what: &'static str,
    folder: &Path,
    names: &[N],
) -> Result<(), ExportError> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let overwritten = |input: &Path| {
        input.is_file() && names.iter().any(|name| same_file(input, &folder.join(name)))
    };
    match inputs.iter().map(AsRef::as_ref).find(|input| overwritten(input)) {
        None => Ok(()),
        Some(path) => Err(ExportError::Overwrites { path: path.to_owned(), what }),
    }
}

/// Whether two paths lead to one file, or to one link in one folder.
fn same_file(a: &Path, b: &Path) -> bool {
    let same = |a: &Path, b: &Path| matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b);
    let parent = |p: &Path| match p.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
        _ => PathBuf::from("."),
    };
    same(a, b) || (a.file_name() == b.file_name() && same(&parent(a), &parent(b)))
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
    fn what_is_in_the_way_of_a_folder_is_found_before_it_is_made() {
        let top = tempfile::tempdir().unwrap();
        let file = top.path().join("plain");
        fs::write(&file, "").unwrap();
        for place in [file.clone(), file.join("out/deeper")] {
            let error = check_folder(&place).unwrap_err().to_string();
            assert!(error.contains("plain is a file, not a folder; choose another"), "{error}");
        }
        check_folder(top.path()).unwrap();
        check_folder(&top.path().join("new/deeper")).unwrap();
        check_folder(Path::new("no-such-folder")).unwrap();
        assert_eq!(fs::read_dir(top.path()).unwrap().count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_and_links_to_nothing_named() {
        let top = tempfile::tempdir().unwrap();
        let link = |name: &str, to: &str| {
            let path = top.path().join(name);
            std::os::unix::fs::symlink(top.path().join(to), &path).unwrap();
            path
        };
        let error = check_folder(&link("dangling", "nowhere")).unwrap_err().to_string();
        assert!(error.contains("dangling is a link to nothing, not a folder; "), "{error}");
        check_folder(&link("good", ".")).unwrap();
        fs::write(top.path().join("a.svg"), "").unwrap();
        let drawing = link("linked.svg", "a.svg");
        let through = top.path().join("good");
        let spoils = |name: &str| check_inputs(&[&drawing], "drawing", &through, &[name]).is_err();
        assert!(spoils("linked.svg") && spoils("a.svg") && !spoils("b.svg"));
    }

    #[test]
    fn inputs_are_not_overwritten() {
        let top = tempfile::tempdir().unwrap();
        let drawing = top.path().join("pair.svg");
        fs::write(&drawing, "").unwrap();
        let inputs = [drawing, PathBuf::from("heart")];
        let round = top.path().join("new/..");
        let error = check_inputs(&inputs, "drawing", top.path(), &["a.svg", "pair.svg"]);
        let said = error.unwrap_err().to_string();
        assert!(said.contains("pair.svg is a drawing that this run reads"), "{said}");
        check_inputs(&inputs, "drawing", top.path(), &["design.json"]).unwrap();
        check_inputs(&inputs, "drawing", &top.path().join("new"), &["pair.svg"]).unwrap();
        fs::create_dir(top.path().join("new")).unwrap();
        check_inputs(&inputs, "drawing", &round, &["pair.svg"]).unwrap_err();
    }

    #[test]
    fn a_folder_that_is_a_file_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("plain");
        fs::write(&file, "").unwrap();
        let error = write_atomically(&file.join("a.stl"), |_| Ok(())).unwrap_err();
        assert!(matches!(&error, ExportError::NotWritable { .. }));
        assert!(error.to_string().contains("plain") && error.to_string().contains("choose a"));
        let error = prepare_folder(&file.join("out")).unwrap_err();
        assert!(matches!(&error, ExportError::NotAFolder { .. }));
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
