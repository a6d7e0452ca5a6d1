//! Runs asked for on the command line, and the tables that hold them.

use std::path::{Path, PathBuf};

use centrode::export::{ExportError, write_atomically};
use centrode::meshing::{Drive, DynamicsOptions, MeshingReport, proving_runs, write_csv};
use centrode::results::table_name;

use super::args::RunArgs;

impl RunArgs {
    /// The runs asked for, of gears of `thickness` mm through `cycles` whole cycles.
    pub(crate) fn runs(&self, thickness: f64, cycles: f64) -> Vec<DynamicsOptions> {
        let options = DynamicsOptions {
            drive: self.motor_torque.map_or(Drive::Led, |limit| Drive::Motor(Some(limit))),
            load: self.load,
            rpm: self.rpm,
            friction: self.friction,
            density: self.density.unwrap_or(self.material),
            thickness,
            cycles,
            ..DynamicsOptions::default()
        };
        proving_runs(&options, self.both)
    }
}

/// Writes one table for each run into `folder`.
pub(crate) fn write_tables(
    folder: &Path,
    proof: &MeshingReport,
) -> Result<Vec<PathBuf>, ExportError> {
    let mut files = Vec::new();
    for run in &proof.runs {
        let path = folder.join(table_name(run));
        write_atomically(&path, |out| write_csv(run, out))?;
        files.push(path);
    }
    Ok(files)
}
