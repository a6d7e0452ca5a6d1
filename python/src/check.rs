//! Verdicts on finished gears.

use centrode::check::{MotionGiven, check};
use centrode::cli::plan::{CheckPlan, check_plan, check_record};
use centrode::diagnose::Limits;
use centrode::gear::{Pair, Side};
use centrode::input::load_gears;
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;

use crate::shape::Given;
use crate::watch::{Watch, watched};
use crate::{blamed, refused};

/// The verdict on two gears as `centrode check --json` prints it, and the text of all its findings. `gears` are paths or
/// arrays with their names, `limits` TOML, `motion` driver and follower angles.
#[pyfunction]
#[pyo3(name = "check", signature = (gears, words, limits=None, motion=None, progress=None, threads=None))]
pub(crate) fn judge(
    py: Python<'_>,
    gears: [(Bound<'_, PyAny>, String); 2],
    words: Vec<String>,
    limits: Option<&str>,
    motion: Option<(PyReadonlyArray1<'_, f64>, PyReadonlyArray1<'_, f64>)>,
    progress: Option<&Bound<'_, PyAny>>,
    threads: Option<usize>,
) -> PyResult<String> {
    let given = [Given::of(&gears[0].0, &gears[0].1)?, Given::of(&gears[1].0, &gears[1].1)?];
    let mut line = vec!["centrode".to_owned(), "check".to_owned()];
    line.extend(words);
    // A name may begin with a hyphen.
    line.push("--".to_owned());
    line.extend(given.iter().map(Given::word));
    let CheckPlan { join, mut options, .. } = check_plan(&line).map_err(blamed)?;
    if let Some(text) = limits {
        options.limits = Limits::from_toml(text).map_err(|why| refused(Some("limits"), why))?;
    }
    if let Some((driver, follower)) = motion {
        let all = |a: PyReadonlyArray1<'_, f64>| a.as_array().to_vec();
        options.motion = MotionGiven::Sampled { driver: all(driver), follower: all(follower) };
    }
    let report = watched(py, Watch { progress, threads }, |control| {
        options.control = control.clone();
        let Pair { driver, follower } = match &given {
            [Given::Named(driver), Given::Named(follower)] => {
                load_gears(Pair::new(driver.as_str(), follower.as_str()), join)
            }
            [driver, follower] => driver.toothed(Side::Driver).and_then(|driver| {
                Ok(Pair { driver, follower: follower.toothed(Side::Follower)? })
            }),
        }
        .map_err(|e| e.to_string())?;
        check(&driver, &follower, &options).map_err(|e| e.to_string())
    })?;
    check_record(&report.map_err(|text| refused(None, text))?).map_err(blamed)
}
