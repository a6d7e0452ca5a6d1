//! Settings and results as JSON that people can read and diff.

use super::{ExportError, write_atomically};
use serde::Serialize;
use serde_json::ser::{Formatter, PrettyFormatter};
use std::io::{self, ErrorKind, Write};
use std::path::Path;

/// Writes `value` as UTF-8 JSON in the order of its fields: objects one field to a line, arrays
/// (long lists of points, mostly) on one line, numbers with enough digits to read back the same.
///
/// # Errors
/// [`ExportError`]; a value that JSON cannot hold is [`ExportError::Encode`]. NaN and infinity
/// become null, as JSON has neither.
pub fn write_json<T: Serialize + ?Sized>(path: &Path, value: &T) -> Result<(), ExportError> {
    write_atomically(path, |out| {
        let mut serializer = serde_json::Serializer::with_formatter(&mut *out, Lines::default());
        value.serialize(&mut serializer).map_err(|e| match e.io_error_kind() {
            Some(kind) => kind.into(),
            None => io::Error::new(ErrorKind::InvalidData, e),
        })?;
        out.write_all(b"\n")
    })
}

/// Objects indented, arrays and what is in them on one line.
#[derive(Default)]
struct Lines {
    pretty: PrettyFormatter<'static>,
    arrays: usize,
}

impl Formatter for Lines {
    fn begin_array<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        self.arrays += 1;
        out.write_all(b"[")
    }

    fn end_array<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        self.arrays -= 1;
        out.write_all(b"]")
    }

    fn begin_object<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        if self.arrays > 0 { out.write_all(b"{") } else { self.pretty.begin_object(out) }
    }

    fn end_object<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        if self.arrays > 0 { out.write_all(b"}") } else { self.pretty.end_object(out) }
    }

    fn begin_object_key<W: ?Sized + Write>(&mut self, out: &mut W, first: bool) -> io::Result<()> {
        match (self.arrays > 0, first) {
            (false, _) => self.pretty.begin_object_key(out, first),
            (true, true) => Ok(()),
            (true, false) => out.write_all(b", "),
        }
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        out.write_all(b": ")
    }

    fn end_object_value<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        if self.arrays > 0 { Ok(()) } else { self.pretty.end_object_value(out) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Serialize)]
    struct Sample {
        units: &'static str,
        inner: Inner,
        list: Vec<Inner>,
    }

    #[derive(Serialize)]
    struct Inner {
        points: Vec<[f64; 2]>,
        none: Option<f64>,
    }

    #[test]
    fn fields_take_a_line_each_and_arrays_stay_together() {
        let inner = || Inner { points: vec![[0.1, 1.0 / 3.0], [-2.0, 1e-9]], none: None };
        let sample = Sample { units: "mm", inner: inner(), list: vec![inner()] };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.json");
        write_json(&path, &sample).unwrap();
        let expected = r#"{
  "units": "mm",
  "inner": {
    "points": [[0.1,0.3333333333333333],[-2.0,1e-9]],
    "none": null
  },
  "list": [{"points": [[0.1,0.3333333333333333],[-2.0,1e-9]], "none": null}]
}
"#;
        assert_eq!(std::fs::read_to_string(&path).unwrap(), expected);
    }
}
