//! A train as a file: saved pairs, and how their gears hang on each other.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::saved::bounded_text;
use super::{SavedDesign, SavedError};
use crate::assembly::{Link, PairModel, TrainGear, TrainPlan};
use crate::gear::{MotionError, Side};
use crate::policy;
use crate::wording::quoted;

/// Why a train's file cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum TrainFileError {
    /// There is no such file, or it may not be read.
    #[error("cannot read {} ({source}); give a folder that `centrode design` wrote, or a train's TOML file", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file does not say what a train needs.
    #[error("{}: {why}", path.display())]
    NotATrain {
        /// The file.
        path: PathBuf,
        /// What is wrong and what to do.
        why: String,
    },
    /// A design that it names cannot be used.
    #[error(transparent)]
    Design(#[from] SavedError),
    /// The motion of a design is none.
    #[error("{}: {source}", path.display())]
    Motion {
        /// The design.
        path: PathBuf,
        /// What is wrong.
        source: MotionError,
    },
}

impl SavedDesign {
    /// The pair as a train is made of it.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn pair_model(&self) -> Result<PairModel, MotionError> {
        Ok(PairModel {
            gears: self.gears.clone().into(),
            motion: self.motion()?,
            center_distance: self.center_distance,
            module: self.module,
        })
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    pairs: BTreeMap<String, FilePair>,
    gears: Vec<FileGear>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FilePair {
    /// Folder of a design, or its record; from the file's own folder.
    design: PathBuf,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileGear {
    name: String,
    pair: String,
    role: Side,
    /// The gear it meshes with.
    on: Option<String>,
    /// Direction of the line of centres from that gear, degrees.
    #[serde(default)]
    direction: f64,
    /// The gear on whose axle it is fixed.
    axle: Option<String>,
    /// Height above that gear, mm.
    #[serde(default)]
    rise: f64,
    /// Turn against that gear, degrees.
    #[serde(default)]
    turn: f64,
}

/// Reads a train's TOML file and the designs that it names.
///
/// # Errors
/// See [`TrainFileError`].
pub fn read_train(path: &Path) -> Result<TrainPlan, TrainFileError> {
    let text = bounded_text(path, policy::TRAIN_FILE_BYTES)
        .map_err(|source| TrainFileError::Unreadable { path: path.to_owned(), source })?;
    train_from_toml(&text, path)
}

/// The train in the text of its file, which stands or would stand at `path`: the designs that it names are looked for
/// from there.
///
/// # Errors
/// As [`read_train`].
pub fn train_from_toml(text: &str, path: &Path) -> Result<TrainPlan, TrainFileError> {
    let wrong = |why: String| TrainFileError::NotATrain { path: path.to_owned(), why };
    let file: File = toml::from_str(text).map_err(|e| wrong(in_one_line(&e.to_string())))?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut pairs = Vec::new();
    let mut thickness = f64::INFINITY;
    let mut names: Vec<&str> = Vec::new();
    for (name, pair) in &file.pairs {
        let place = folder.join(&pair.design);
        let saved = SavedDesign::read(&place)?;
        let model = saved.pair_model();
        pairs.push(model.map_err(|source| TrainFileError::Motion { path: place, source })?);
        thickness = thickness.min(saved.thickness);
        names.push(name);
    }
    let mut gears: Vec<TrainGear> = Vec::new();
    for gear in &file.gears {
        let before = |wanted: &str| {
            gears.iter().position(|g| g.name == wanted).ok_or_else(|| {
                wrong(format!(
                    "gear {:?} refers to {wanted:?}, which is not listed before it; list gears from the first one outwards",
                    gear.name
                ))
            })
        };
        if gears.iter().any(|g| g.name == gear.name) {
            return Err(wrong(format!(
                "two gears are named {:?}; give each its own name",
                gear.name
            )));
        }
        let plain = |c: char| c.is_alphanumeric() || "-_".contains(c);
        if gear.name.is_empty() || !gear.name.chars().all(plain) {
            return Err(wrong(format!(
                "a gear is named {:?}; files are named after gears, so use letters, digits, - and _",
                gear.name
            )));
        }
        let most = policy::RECORD_REACH;
        if ![gear.direction, gear.rise, gear.turn].iter().all(|v| v.abs() <= most) {
            return Err(wrong(format!(
                "gear {:?} has a number beyond {most}, or one that is none; give plain numbers",
                gear.name
            )));
        }
        let link = match (&gear.on, &gear.axle) {
            (None, None) => None,
            (Some(on), None) => {
                Some((before(on)?, Link::Mesh { direction: gear.direction.to_radians() }))
            }
            (None, Some(axle)) => {
                Some((before(axle)?, Link::Axle { rise: gear.rise, turn: gear.turn.to_radians() }))
            }
            (Some(_), Some(_)) => {
                return Err(wrong(format!(
                    "gear {:?} has both `on` and `axle`; keep the one that drives it",
                    gear.name
                )));
            }
        };
        let pair = names.iter().position(|n| *n == gear.pair).ok_or_else(|| {
            wrong(format!(
                "gear {:?} is of pair {:?}, which is not there; name one of: {}",
                gear.name,
                gear.pair,
                names.join(", ")
            ))
        })?;
        gears.push(TrainGear { name: gear.name.clone(), pair, side: gear.role, link });
    }
    Ok(TrainPlan { pairs, gears, closing: Vec::new(), thickness })
}

/// The parser's message without its drawing of the line.
fn in_one_line(said: &str) -> String {
    let lines: Vec<&str> = said
        .lines()
        .map(str::trim)
        .filter(|l| !l.is_empty() && !l.starts_with('|') && !l.contains(" | "))
        .collect();
    quoted(&lines.join(": "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn refused(text: &str) -> String {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("train.toml");
        fs::write(&path, text).unwrap();
        read_train(&path).unwrap_err().to_string()
    }

    #[test]
    fn what_is_wrong_is_named() {
        assert!(refused("pairs = 3").contains("train.toml"));
        let unknown =
            refused("[pairs]\n[[gears]]\nname = \"a\"\npair = \"p\"\nrole = \"driver\"\nrol = 2\n");
        assert!(unknown.contains("rol") && !unknown.contains('\n'), "{unknown}");
        let pair = refused("[pairs]\n[[gears]]\nname = \"a\"\npair = \"p\"\nrole = \"driver\"\n");
        assert!(pair.contains("\"p\""), "{pair}");
        let missing = refused("gears = []\n[pairs.x]\ndesign = \"nowhere\"\n");
        assert!(missing.contains("nowhere"), "{missing}");
        let odd = refused("[pairs]\n[[gears]]\nname = \"a/b\"\npair = \"p\"\nrole = \"driver\"\n");
        assert!(odd.contains("a/b"), "{odd}");
    }
}
