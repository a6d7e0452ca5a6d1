//! What an encoder makes: files by name and content, not yet anywhere.

use super::{ExportError, Parts, write_atomically};
use std::fmt;
use std::io::{self, Cursor, Seek, Write};
use std::path::{Path, PathBuf};

/// Where an encoder's bytes go: a file, or memory.
pub trait Destination: Write + Seek {}

impl<T: Write + Seek> Destination for T {}

/// One file of a format: its name without folder, and what is in it.
pub struct Artifact<'a> {
    /// Its name, without folder.
    pub name: String,
    content: Content<'a>,
}

type Streamed<'a> = dyn FnOnce(&mut dyn Destination) -> io::Result<()> + 'a;

enum Content<'a> {
    Bytes(Vec<u8>),
    Stream(Box<Streamed<'a>>),
}

impl fmt::Debug for Artifact<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Artifact").field("name", &self.name).finish_non_exhaustive()
    }
}

impl<'a> Artifact<'a> {
    /// A file whose bytes are there.
    pub fn bytes(name: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        Self { name: name.into(), content: Content::Bytes(bytes.into()) }
    }

    /// A file that `write` makes as it is written, for what is large.
    pub fn stream(
        name: impl Into<String>,
        write: impl FnOnce(&mut dyn Destination) -> io::Result<()> + 'a,
    ) -> Self {
        Self { name: name.into(), content: Content::Stream(Box::new(write)) }
    }

    /// Puts the content there.
    ///
    /// # Errors
    /// What the destination says; [`io::ErrorKind::InvalidData`] where the format cannot hold the design.
    pub fn write_to(self, out: &mut dyn Destination) -> io::Result<()> {
        match self.content {
            Content::Bytes(bytes) => out.write_all(&bytes),
            Content::Stream(write) => write(out),
        }
    }

    /// The content in memory.
    ///
    /// # Errors
    /// As [`Artifact::write_to`].
    pub fn into_bytes(self) -> io::Result<Vec<u8>> {
        if let Content::Bytes(bytes) = self.content {
            return Ok(bytes);
        }
        let mut out = Cursor::new(Vec::new());
        self.write_to(&mut out)?;
        Ok(out.into_inner())
    }
}

/// Why a format cannot hold a design.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cannot put the design into {file} ({why})")]
pub struct EncodeError {
    /// The file, without folder.
    pub file: String,
    /// What is in the way.
    pub why: String,
}

impl EncodeError {
    /// Of `file`, for this reason.
    pub fn new(file: &str, why: impl fmt::Display) -> Self {
        Self { file: file.to_owned(), why: why.to_string() }
    }
}

/// A file format. It makes files in memory; [`write()`] puts them into a folder.
pub trait Encode {
    /// The files of this design, in the order in which they are written.
    ///
    /// # Errors
    /// [`EncodeError`], naming the file.
    fn encode<'a>(&'a self, parts: Parts<'a>) -> Result<Vec<Artifact<'a>>, EncodeError>;

    /// Writes the files into `folder`, which exists, and returns where they are.
    ///
    /// # Errors
    /// [`ExportError`], naming the file; files finished before it stay.
    fn write(&self, parts: Parts<'_>, folder: &Path) -> Result<Vec<PathBuf>, ExportError> {
        let artifacts = self
            .encode(parts)
            .map_err(|e| ExportError::Encode { path: folder.join(e.file), why: e.why })?;
        write(artifacts, folder)
    }
}

/// Writes files into `folder`, which exists, each whole or not at all, and returns where they are.
///
/// # Errors
/// [`ExportError`], naming the file; files finished before it stay.
pub fn write(artifacts: Vec<Artifact<'_>>, folder: &Path) -> Result<Vec<PathBuf>, ExportError> {
    artifacts
        .into_iter()
        .map(|artifact| {
            let path = folder.join(&artifact.name);
            write_atomically(&path, |out| artifact.write_to(out))?;
            Ok(path)
        })
        .collect()
}
