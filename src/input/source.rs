//! Files by path: the one place in this room that reads them.

use super::InputError;
use crate::outline::library;
use crate::policy;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// A path, and what stands behind its `#`: a layer, a group, an object or a number.
#[derive(Clone, Copy, Debug)]
pub(super) struct Source<'a> {
    pub(super) path: &'a str,
    pub(super) part: Option<&'a str>,
}

impl<'a> Source<'a> {
    pub(super) fn new(source: &'a str) -> Self {
        match source.rsplit_once('#') {
            Some((path, part)) if !Path::new(source).exists() => Self { path, part: Some(part) },
            _ => Self { path: source, part: None },
        }
    }

    pub(super) fn path(&self) -> String {
        self.path.to_owned()
    }
}

/// Refuses a file without content, or with too much.
pub(super) fn bounded(bytes: &[u8], source: &str) -> Result<(), InputError> {
    let limit = policy::INPUT_BYTES;
    match bytes.len() as u64 {
        0 => Err(InputError::Empty { path: source.to_owned() }),
        length if length > limit => Err(InputError::TooLarge { path: source.to_owned(), limit }),
        _ => Ok(()),
    }
}

/// The content of a file, of bounded length.
pub(super) fn read_file(source: &str) -> Result<Vec<u8>, InputError> {
    let path = || source.to_owned();
    let place = Path::new(source);
    let unreadable = |error: std::io::Error| match error.kind() {
        std::io::ErrorKind::NotFound if source.contains(['/', '\\', '.']) => {
            InputError::Missing { path: path() }
        }
        std::io::ErrorKind::NotFound => {
            let hint = library::nearest(source).map(|known| format!(", did you mean `{known}`"));
            InputError::Unknown { name: path(), hint: hint.unwrap_or_default() }
        }
        _ => InputError::Unreadable { path: path(), reason: error.to_string() },
    };
    // Before it is opened: a pipe that nobody writes to would wait for ever.
    let kind = std::fs::metadata(place).map_err(unreadable)?.file_type();
    if kind.is_dir() {
        return Err(InputError::Folder { path: path() });
    }
    if !kind.is_file() {
        return Err(InputError::NoRegularFile { path: path() });
    }
    let file = File::open(place).map_err(unreadable)?;
    let mut bytes = Vec::new();
    file.take(policy::INPUT_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    bounded(&bytes, source)?;
    Ok(bytes)
}
