//! The core of the Python package: results as arrays and JSON. Everything that is Python's manner is in `centrode/*.py`.
//!
//! Work runs on a thread of its own without the interpreter's lock, so that signals and progress are seen while it
//! lasts; see [`watch::watched`].

mod check;
mod design;
mod shape;
mod watch;

use std::ffi::OsString;

use centrode::cli::{self, plan};
use centrode::export::Format;
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

create_exception!(_core, Refused, PyValueError, "Input that cannot be used.");

/// What was refused, as Python's error: the option to blame, or none, and the sentence.
pub(crate) fn refused(option: Option<&str>, text: impl Into<String>) -> PyErr {
    Refused::new_err((option.map(str::to_owned), text.into()))
}

pub(crate) fn blamed(blamed: plan::Blamed) -> PyErr {
    refused(blamed.option.as_deref(), blamed.text)
}

/// Version of the package.
#[pyfunction]
fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}

/// Names of the built-in shapes.
#[pyfunction]
fn shapes() -> Vec<&'static str> {
    centrode::outline::library::names().collect()
}

/// Options of a command as JSON.
#[pyfunction]
fn options(command: &str) -> PyResult<String> {
    let options = plan::options_of(command).map_err(blamed)?;
    serde_json::to_string(&options).map_err(|e| refused(None, e.to_string()))
}

/// The formats: name, whether each is written when none is named, and its files.
#[pyfunction]
fn formats() -> Vec<(&'static str, bool, Vec<&'static str>)> {
    Format::ALL.iter().map(|f| (f.name(), f.entry().unasked, f.files().collect())).collect()
}

/// Carries out a command line, the program's name first; gives its exit code. Once in a process.
#[pyfunction]
fn main(py: Python<'_>, words: Vec<OsString>) -> u8 {
    py.detach(|| cli::main_of(words))
}

#[pymodule]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("Refused", module.py().get_type::<Refused>())?;
    module.add_function(wrap_pyfunction!(version, module)?)?;
    module.add_function(wrap_pyfunction!(shapes, module)?)?;
    module.add_function(wrap_pyfunction!(options, module)?)?;
    module.add_function(wrap_pyfunction!(formats, module)?)?;
    module.add_function(wrap_pyfunction!(main, module)?)?;
    module.add_function(wrap_pyfunction!(design::make, module)?)?;
    module.add_function(wrap_pyfunction!(design::load, module)?)?;
    module.add_function(wrap_pyfunction!(check::judge, module)?)?;
    module.add_class::<design::Design>()?;
    Ok(())
}
