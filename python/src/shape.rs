//! Drawings and gears as Python hands them over.

use centrode::gear::Side;
use centrode::input::{
    InputError, LoadOptions, Shape, Toothed, load, load_toothed, shape_from_bytes,
    toothed_from_bytes,
};
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;

/// A path or built-in name, or the points themselves.
pub(crate) enum Given {
    /// As the command line takes it.
    Named(String),
    /// A table of points with a name.
    Points(Vec<u8>, String),
}

impl Given {
    /// What `value` is: a string, or an N x 2 array of numbers that is called `name`.
    pub(crate) fn of(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Self> {
        if let Ok(text) = value.extract::<String>() {
            return Ok(Self::Named(text));
        }
        let points: PyReadonlyArray2<'_, f64> = value.extract()?;
        let mut table = Vec::new();
        for row in points.as_array().rows() {
            // As few digits as read back to the same number.
            table.extend_from_slice(format!("{:?},{:?}\n", row[0], row[1]).as_bytes());
        }
        Ok(Self::Points(table, name.to_owned()))
    }

    /// Its place on a command line.
    pub(crate) fn word(&self) -> String {
        match self {
            Self::Named(text) => text.clone(),
            Self::Points(_, name) => format!("{name}.csv"),
        }
    }

    /// The drawing.
    pub(crate) fn drawing(&self, options: &LoadOptions) -> Result<Shape, InputError> {
        match self {
            Self::Named(source) => load(source, options),
            Self::Points(table, name) => shape_from_bytes(table, &format!("{name}.csv"), options),
        }
    }

    /// The finished gear.
    pub(crate) fn toothed(&self, side: Side) -> Result<Toothed, InputError> {
        match self {
            Self::Named(source) => load_toothed(source, side),
            Self::Points(table, name) => {
                toothed_from_bytes(table, &format!("{name}.csv"), None, side)
            }
        }
    }
}
