//! A folder whose files appear all together or not at all.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use super::ExportError;

/// A hidden folder inside the output folder: files are written here, then moved to their place.
///
/// Dropped without [`Staging::publish`], it takes everything away that it made, so a full disk half
/// way leaves the output folder as it was, or missing when it was missing.
#[derive(Debug)]
pub struct Staging {
    folder: PathBuf,
    hidden: PathBuf,
    /// Folders that did not exist before, the innermost first.
    made: Vec<PathBuf>,
}

impl Staging {
    /// Makes the output folder, those above it and the hidden one.
    ///
    /// # Errors
    /// [`ExportError`], naming the output folder.
    pub fn new(folder: &Path) -> Result<Self, ExportError> {
        super::check_folder(folder)?;
        let missing = |p: &&Path| !p.as_os_str().is_empty() && p.symlink_metadata().is_err();
        let made = folder.ancestors().take_while(missing).map(Path::to_owned).collect();
        let hidden = folder.join(format!("{HIDDEN}{}{PART}", std::process::id()));
        // From here on dropping it cleans up, however far the making got.
        let staging = Self { folder: folder.to_owned(), hidden, made };
        super::prepare_folder(folder)?;
        sweep(folder);
        fs::create_dir_all(&staging.hidden).map_err(|e| ExportError::from_io(folder, e))?;
        Ok(staging)
    }

    /// Where to write.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.hidden
    }

    /// The error told of the file's final place.
    #[must_use]
    pub fn told_of_the_final_place(&self, mut error: ExportError) -> ExportError {
        let (ExportError::NotWritable { path, .. }
        | ExportError::NotAFolder { path, .. }
        | ExportError::Overwrites { path, .. }
        | ExportError::DiskFull { path, .. }
        | ExportError::Encode { path, .. }) = &mut error;
        if let Ok(name) = path.strip_prefix(&self.hidden) {
            *path = self.folder.join(name);
        }
        error
    }

    /// Moves the files into the output folder, over older ones, in the order given; returns where they
    /// are.
    ///
    /// # Errors
    /// [`ExportError`], naming the file; files moved before it stay.
    pub fn publish(self, files: &[PathBuf]) -> Result<Vec<PathBuf>, ExportError> {
        self.publish_beside::<&Path>(files, &[], "file")
    }

    /// The same, unless one of `inputs` would be overwritten; `what` says what they are.
    ///
    /// # Errors
    /// [`ExportError::Overwrites`] before anything is moved, else as [`Staging::publish`].
    pub fn publish_beside<P: AsRef<Path>>(
        mut self,
        files: &[PathBuf],
        inputs: &[P],
        what: &'static str,
    ) -> Result<Vec<PathBuf>, ExportError> {
        let names: Vec<&OsStr> = files.iter().filter_map(|f| f.file_name()).collect();
        super::check_inputs(inputs, what, &self.folder, &names)?;
        let mut published = Vec::with_capacity(files.len());
        for file in files {
            let target = self.folder.join(file.file_name().unwrap_or_default());
            fs::rename(file, &target).map_err(|e| ExportError::from_io(&target, e))?;
            published.push(target);
        }
        self.made.clear();
        Ok(published)
    }
}

/// Name of the hidden folder: this, the number of the process, and [`PART`].
const HIDDEN: &str = ".centrode.";
const PART: &str = ".part";

/// Takes away what killed runs left. Where the system does not tell which processes are alive, everything is left.
fn sweep(folder: &Path) {
    let processes = Path::new("/proc");
    if !processes.join("self").exists() {
        return;
    }
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let process = name
            .to_str()
            .and_then(|n| n.strip_prefix(HIDDEN)?.strip_suffix(PART)?.parse::<u32>().ok());
        if process.is_some_and(|id| !processes.join(id.to_string()).exists()) {
            // Nothing is lost by leaving it.
            let _ = fs::remove_dir_all(entry.path());
        }
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        // Nothing can be done about, or is lost by, a failure to clean up.
        let _ = fs::remove_dir_all(&self.hidden);
        for folder in &self.made {
            // Refuses a folder that somebody else put something into.
            let _ = fs::remove_dir(folder);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn published_files_replace_older_ones_and_nothing_else_stays() {
        let top = tempfile::tempdir().unwrap();
        fs::write(top.path().join("a.txt"), "old").unwrap();
        let staging = Staging::new(top.path()).unwrap();
        let written = [staging.path().join("a.txt"), staging.path().join("b.txt")];
        for file in &written {
            fs::write(file, "new").unwrap();
        }
        let published = staging.publish(&written).unwrap();
        assert_eq!(published, [top.path().join("a.txt"), top.path().join("b.txt")]);
        assert!(published.iter().all(|p| fs::read_to_string(p).unwrap() == "new"));
        assert_eq!(fs::read_dir(top.path()).unwrap().count(), 2);
    }

    #[test]
    fn unpublished_files_vanish_with_the_folders_made_for_them() {
        let top = tempfile::tempdir().unwrap();
        let staging = Staging::new(&top.path().join("new/deeper")).unwrap();
        fs::write(staging.path().join("a.txt"), "half").unwrap();
        drop(staging);
        assert_eq!(fs::read_dir(top.path()).unwrap().count(), 0);
    }

    #[test]
    fn an_input_is_not_replaced() {
        let top = tempfile::tempdir().unwrap();
        let drawing = top.path().join("b.svg");
        fs::write(&drawing, "drawn").unwrap();
        let staging = Staging::new(top.path()).unwrap();
        let written = [staging.path().join("a.svg"), staging.path().join("b.svg")];
        for file in &written {
            fs::write(file, "new").unwrap();
        }
        let error = staging.publish_beside(&written, &[&drawing], "drawing").unwrap_err();
        assert!(matches!(error, ExportError::Overwrites { .. }), "{error}");
        assert_eq!(fs::read_to_string(&drawing).unwrap(), "drawn");
        assert_eq!(fs::read_dir(top.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_path_below_a_file_is_refused_and_the_file_kept() {
        let top = tempfile::tempdir().unwrap();
        let plain = top.path().join("plain");
        fs::write(&plain, "kept").unwrap();
        let error = Staging::new(&plain.join("out")).unwrap_err();
        assert!(matches!(error, ExportError::NotAFolder { .. }), "{error}");
        assert_eq!(fs::read_to_string(&plain).unwrap(), "kept");
    }
}
