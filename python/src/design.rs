//! A finished pair, seen from Python.

use std::path::PathBuf;

use centrode::cli::plan::{self, Origin, Plan};
use centrode::control::Control;
use centrode::export::{Parts, Staging, write_atomically};
use centrode::geometry::Point;
use centrode::meshing::{Direction, Drive, Dynamics, Step};
use centrode::pipeline;
use centrode::schema::{RECORD_NAME, Record, SavedDesign, run_record};
use centrode::solid::assembly_solids;
use centrode::teeth::EdgeKind;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::shape::Given;
use crate::watch::{Watch, watched};
use crate::{blamed, refused};

/// A finished pair: made here, or read from its record.
#[pyclass(frozen, module = "centrode._core")]
pub(crate) struct Design {
    saved: SavedDesign,
    record: String,
    made: Option<Made>,
}

/// A pair that was made here, and the command line that makes the same.
struct Made {
    design: pipeline::Design,
    words: Vec<String>,
}

impl Design {
    fn of(design: pipeline::Design, words: Vec<String>) -> Result<Self, String> {
        // As `centrode design` writes it.
        let record = serde_json::to_string(&Record::new(&design)).map_err(|e| e.to_string())?;
        let saved = SavedDesign::from_json(&record)?;
        Ok(Self { saved, record, made: Some(Made { design, words }) })
    }
}

/// Makes a pair. `command` is `design`, `mate` or `motion`; `shapes` what it is made from (paths, names or arrays, with
/// their names); `words` are the options as the command line has them.
#[pyfunction]
#[pyo3(signature = (command, shapes, words, progress=None, threads=None))]
pub(crate) fn make(
    py: Python<'_>,
    command: &str,
    shapes: Vec<(Bound<'_, PyAny>, String)>,
    words: Vec<String>,
    progress: Option<&Bound<'_, PyAny>>,
    threads: Option<usize>,
) -> PyResult<Design> {
    let given =
        shapes.iter().map(|(value, name)| Given::of(value, name)).collect::<PyResult<Vec<_>>>()?;
    let mut line = vec!["centrode".to_owned(), command.to_owned()];
    line.extend(given.iter().map(Given::word));
    line.extend(words);
    let asked = plan::plan(&with_output(&line, "out")).map_err(blamed)?;
    if asked.lists_alternatives() {
        let text = "alternatives are listed by `centrode design` alone; leave it out";
        return Err(refused(Some("alternatives"), text));
    }
    let made = watched(py, Watch { progress, threads }, |control| {
        let design = designed(&asked, &given, control)?;
        Design::of(design, line).map_err(|text| (None, text))
    })?;
    made.map_err(|(option, text)| refused(option.as_deref(), text))
}

fn designed(
    asked: &Plan,
    given: &[Given],
    control: &Control,
) -> Result<pipeline::Design, (Option<String>, String)> {
    let shapes: &[Given] = if matches!(asked.origin, Origin::Motion(..)) { &[] } else { given };
    let mut read = Vec::new();
    for shape in shapes {
        read.push(shape.drawing(&asked.load).map_err(|e| (None, e.to_string()))?);
    }
    let request = asked.request(read, control).map_err(|b| (b.option, b.text))?;
    request.design(control).map_err(|e| (None, e.to_string()))
}

/// Reads a `design.json`, or that in a folder.
#[pyfunction]
pub(crate) fn load(py: Python<'_>, path: PathBuf) -> PyResult<Design> {
    py.detach(|| {
        let saved = SavedDesign::read(&path).map_err(|e| e.to_string())?;
        let file = if path.is_dir() { path.join(RECORD_NAME) } else { path };
        let record = std::fs::read_to_string(&file)
            .map_err(|e| format!("{} cannot be read ({e}); check the path", file.display()))?;
        Ok(Design { saved, record, made: None })
    })
    .map_err(|text: String| refused(None, text))
}

fn with_output(line: &[String], folder: &str) -> Vec<String> {
    line.iter().cloned().chain([format!("--output={folder}")]).collect()
}

fn side(name: &str) -> PyResult<usize> {
    match name {
        "driver" => Ok(0),
        "follower" => Ok(1),
        _ => Err(refused(None, format!("there is no gear {name:?}; take driver or follower"))),
    }
}

/// Points as rows.
fn rows<'py>(py: Python<'py>, points: &[Point]) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let flat: Vec<f64> = points.iter().flat_map(|p| [p.x, p.y]).collect();
    flat.into_pyarray(py).reshape([points.len(), 2])
}

/// Driver angles, follower angles, psi'.
type Cycle<'py> =
    (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, Option<Bound<'py, PyArray1<f64>>>);

/// An outline without clearance, and what each of its edges is.
type Edges<'py> = (Bound<'py, PyArray2<f64>>, Vec<&'static str>);

#[pymethods]
impl Design {
    /// `design.json`.
    #[getter]
    fn record(&self) -> &str {
        &self.record
    }

    /// The command line that makes the same pair, without the folder.
    #[getter]
    fn command(&self) -> Option<String> {
        self.made.as_ref().map(|made| plan::command_text(&made.words))
    }

    /// `outline`, `pitch_curve`, `input` or `bore` of a gear, as rows; none for a bore that there is not.
    fn points<'py>(
        &self,
        py: Python<'py>,
        gear: &str,
        what: &str,
    ) -> PyResult<Option<Bound<'py, PyArray2<f64>>>> {
        let gear = &self.saved.gears[side(gear)?];
        let points = match what {
            "outline" => Some(&gear.outline),
            "pitch_curve" => Some(&gear.pitch_curve),
            "input" => Some(&gear.input),
            _ => gear.bore.as_ref(),
        };
        points.map(|points| rows(py, points)).transpose()
    }

    /// The teeth as they were generated; none of a pair that was read.
    fn edges<'py>(&self, py: Python<'py>, gear: &str) -> PyResult<Option<Edges<'py>>> {
        let Some(Made { design, .. }) = &self.made else { return Ok(None) };
        let pair = &design.pair;
        let profile = if side(gear)? == 0 { &pair.driver } else { &pair.follower };
        let word = |kind: &EdgeKind| match kind {
            EdgeKind::Flank => "flank",
            EdgeKind::Tip => "tip",
            EdgeKind::Root => "root",
        };
        let kinds = profile.kinds.iter().map(word).collect();
        Ok(Some((rows(py, &profile.points)?, kinds)))
    }

    /// One cycle of the motion, or one way of a pair that swings, which has no psi' here.
    fn motion<'py>(&self, py: Python<'py>) -> Cycle<'py> {
        let driver = self.saved.driver_angle.clone();
        let speed = match &self.made {
            Some(made) => {
                let transmission = &made.design.centrodes.transmission;
                Some(driver.iter().map(|&phi| transmission.derivative(phi)).collect::<Vec<f64>>())
            }
            None => self
                .saved
                .motion()
                .ok()
                .map(|motion| driver.iter().map(|&phi| motion.derivative(phi)).collect()),
        };
        let follower = self.saved.follower_angle.clone();
        (driver.into_pyarray(py), follower.into_pyarray(py), speed.map(|s| s.into_pyarray(py)))
    }

    /// The page `report.html`; none of a pair that was read.
    fn page(&self, py: Python<'_>) -> Option<String> {
        let made = self.made.as_ref()?;
        Some(py.detach(|| plan::page(&made.design, &made.words)))
    }

    /// Writes files into a folder, as the command would; gives their paths. `formats` are options such as `--export=step`.
    #[pyo3(signature = (folder, formats, progress=None))]
    fn export(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        formats: Vec<String>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Vec<PathBuf>> {
        let written = watched(py, Watch { progress, threads: None }, |_| match &self.made {
            Some(made) => {
                let mut line = with_output(&made.words, &folder.to_string_lossy());
                line.extend(formats);
                let asked = plan::plan(&line).map_err(|b| (b.option, b.text))?;
                let (staging, files) = asked
                    .files(&made.design, &made.words, &folder)
                    .map_err(|b| (b.option, b.text))?;
                staging.publish(&files).map_err(|e| (None, e.to_string()))
            }
            None => self.export_saved(&folder, formats),
        })?;
        written.map_err(|(option, text)| refused(option.as_deref(), text))
    }

    /// Runs the pair as the words of `centrode simulate` say: for each run its record and its arrays by name, and the
    /// verdict with its findings.
    #[pyo3(signature = (words, progress=None, threads=None))]
    fn simulate<'py>(
        &self,
        py: Python<'py>,
        words: Vec<String>,
        progress: Option<&Bound<'py, PyAny>>,
        threads: Option<usize>,
    ) -> PyResult<(Vec<Bound<'py, PyDict>>, &'static str, String)> {
        let line: Vec<String> = ["centrode", "simulate", "design.json"]
            .map(str::to_owned)
            .into_iter()
            .chain(words)
            .collect();
        let report = watched(py, Watch { progress, threads }, |control| {
            plan::simulated(&line, &self.saved, control)
        })?
        .map_err(blamed)?;
        let runs = report.runs.iter().map(|run| arrays(py, run)).collect::<PyResult<_>>()?;
        let found =
            serde_json::to_string(&report.diagnostics).map_err(|e| refused(None, e.to_string()))?;
        Ok((runs, report.verdict().word(), found))
    }
}

impl Design {
    fn export_saved(
        &self,
        folder: &std::path::Path,
        formats: Vec<String>,
    ) -> Result<Vec<PathBuf>, (Option<String>, String)> {
        let told = |text: String| (None, text);
        let line: Vec<String> = ["centrode", "export", "design.json"]
            .map(str::to_owned)
            .into_iter()
            .chain(formats)
            .collect();
        let wanted = plan::wanted(&line).map_err(|b| (b.option, b.text))?;
        let assembly = self.saved.assembly();
        let meshes = assembly_solids(&assembly).map_err(|e| told(e.to_string()))?;
        let staging = Staging::new(folder).map_err(|e| told(e.to_string()))?;
        let parts = Parts { assembly: &assembly, meshes: &meshes };
        let mut files = wanted
            .write(parts, staging.path())
            .map_err(|e| told(staging.told_of_the_final_place(e).to_string()))?;
        let record = staging.path().join(RECORD_NAME);
        write_atomically(&record, |out| std::io::Write::write_all(out, self.record.as_bytes()))
            .map_err(|e| told(e.to_string()))?;
        files.push(record);
        staging.publish(&files).map_err(|e| told(e.to_string()))
    }
}

/// A run's record as JSON under `record`, and what it is like step by step.
fn arrays<'py>(py: Python<'py>, run: &Dynamics) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    all.set_item("record", run_record(run).to_string())?;
    let drive = if matches!(run.options.drive, Drive::Led) { "constant speed" } else { "motor" };
    all.set_item("drive", drive)?;
    all.set_item("backward", run.options.direction == Direction::Backward)?;
    let numbers: [(&str, fn(&Step) -> f64); 9] = [
        ("driver_angle", |s| s.driver_angle),
        ("follower_angle", |s| s.follower_angle),
        ("psi", |s| s.psi),
        ("driver_torque", |s| s.driver_torque),
        ("windowed_torque", |s| s.windowed_torque),
        ("ideal_torque", |s| s.ideal_torque),
        ("penetration", |s| s.penetration),
        ("work_in", |s| s.work_in),
        ("work_out", |s| s.work_out),
    ];
    for (name, of) in numbers {
        let values: Vec<f64> = run.steps.iter().map(of).collect();
        all.set_item(name, values.into_pyarray(py))?;
    }
    let contacts: Vec<u32> = run.steps.iter().map(|s| s.contacts).collect();
    all.set_item("contacts", contacts.into_pyarray(py))?;
    Ok(all)
}
