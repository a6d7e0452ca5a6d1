//! The drawings that pages have given, kept in memory.

use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::{Arc, Mutex, PoisonError};

use centrode::input::{InputError, LoadOptions, Shape, load, shape_from_bytes};
use centrode::outline::library;

use super::protocol::DrawingRef;

/// Largest drawing that is taken, bytes.
pub(super) const LARGEST: usize = centrode::policy::INPUT_BYTES as usize;
/// Bytes of all drawings together; beyond it the oldest go. Pages keep their own and send them again.
const KEPT: usize = 96 << 20;

/// A drawing as it was given.
#[derive(Debug)]
struct Kept {
    name: String,
    bytes: Arc<[u8]>,
    /// Rises with every use.
    used: u64,
}

#[derive(Debug, Default)]
struct Shelf {
    kept: HashMap<String, Kept>,
    clock: u64,
}

/// The drawings of all tabs, by a hash of their content.
#[derive(Debug, Default)]
pub(super) struct Drawings(Mutex<Shelf>);

/// Why a drawing cannot be had.
#[derive(Debug, thiserror::Error)]
pub(super) enum DrawingError {
    /// The page must send it again.
    #[error("the drawing is no longer kept; open it again")]
    Missing(String),
    /// It cannot be read.
    #[error(transparent)]
    Load(#[from] InputError),
}

impl Drawings {
    /// Keeps a drawing; returns its id.
    pub(super) fn keep(&self, name: &str, bytes: &[u8]) -> String {
        let mut hasher = DefaultHasher::new();
        (name, bytes).hash(&mut hasher);
        let first = hasher.finish();
        (first, bytes.len()).hash(&mut hasher);
        let id = format!("{first:016x}{:016x}", hasher.finish());
        let mut shelf = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        shelf.clock += 1;
        let used = shelf.clock;
        shelf.kept.insert(id.clone(), Kept { name: name.to_owned(), bytes: bytes.into(), used });
        let mut total: usize = shelf.kept.values().map(|k| k.bytes.len()).sum();
        while total > KEPT && shelf.kept.len() > 1 {
            let oldest = shelf.kept.iter().min_by_key(|(_, k)| k.used).map(|(id, _)| id.clone());
            let Some(gone) = oldest.and_then(|id| shelf.kept.remove(&id)) else { break };
            total -= gone.bytes.len();
        }
        id
    }

    /// The bytes of a drawing that was given.
    pub(super) fn bytes(&self, id: &str) -> Option<Arc<[u8]>> {
        let shelf = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        shelf.kept.get(id).map(|k| Arc::clone(&k.bytes))
    }

    /// Keeps a drawing's mirror image about an upright line, as points.
    pub(super) fn mirrored(&self, drawing: &DrawingRef) -> Result<DrawingRef, DrawingError> {
        let shape = self.shape(drawing, &LoadOptions::default())?;
        let (low, high) = shape.raw.bounds();
        let points = shape.raw.points().iter().rev();
        let lines: String =
            points.map(|p| format!("{:?},{:?}\n", low.x + high.x - p.x, p.y)).collect();
        let name = match shape.name.strip_suffix("-mirrored") {
            Some(before) => format!("{before}.csv"),
            None => format!("{}-mirrored.csv", shape.name),
        };
        let id = self.keep(&name, lines.as_bytes());
        Ok(DrawingRef { name, id: Some(id) })
    }

    /// Reads a drawing that is built in or kept. Never opens a file.
    pub(super) fn shape(
        &self,
        drawing: &DrawingRef,
        options: &LoadOptions,
    ) -> Result<Shape, DrawingError> {
        let Some(id) = &drawing.id else {
            if library::svg(&drawing.name).is_none() {
                let name = drawing.name.chars().take(60).collect();
                let hint = library::nearest(&drawing.name)
                    .map(|known| format!(", did you mean `{known}`"))
                    .unwrap_or_default();
                return Err(InputError::Unknown { name, hint }.into());
            }
            let text = library::svg(&drawing.name).unwrap_or_default();
            let mut shape = shape_from_bytes(text.as_bytes(), "built-in.svg", options)?;
            shape.name.clone_from(&drawing.name);
            return Ok(shape);
        };
        let (name, bytes) = {
            let mut shelf = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            shelf.clock += 1;
            let clock = shelf.clock;
            let Some(kept) = shelf.kept.get_mut(id) else {
                return Err(DrawingError::Missing(id.clone()));
            };
            kept.used = clock;
            (kept.name.clone(), Arc::clone(&kept.bytes))
        };
        Ok(shape_from_bytes(&bytes, &name, options)?)
    }
}

/// A drawing that the command line names, read now: the only files that are ever opened.
pub(super) fn from_file(path: &std::path::Path) -> anyhow::Result<(String, Vec<u8>)> {
    // What cannot be read is said before the page opens.
    load(&path.to_string_lossy(), &LoadOptions::default())?;
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    Ok((name, std::fs::read(path)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(name: &str, id: Option<String>) -> DrawingRef {
        DrawingRef { name: name.to_owned(), id }
    }

    #[test]
    fn a_kept_drawing_is_read_under_its_own_name() {
        let drawings = Drawings::default();
        let id = drawings.keep("box.csv", b"0,0\n4,0\n4,3\n0,3\n");
        assert_eq!(id, drawings.keep("box.csv", b"0,0\n4,0\n4,3\n0,3\n"));
        let shape = drawings.shape(&named("x", Some(id)), &LoadOptions::default()).unwrap();
        assert_eq!(shape.name, "box");
    }

    #[test]
    fn no_file_is_opened_by_its_name() {
        let drawings = Drawings::default();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("box.csv");
        std::fs::write(&path, "0,0\n4,0\n4,3\n0,3\n").unwrap();
        for name in [path.to_str().unwrap(), "/etc/passwd", "../box.csv", "heart.svg"] {
            let error = drawings.shape(&named(name, None), &LoadOptions::default()).unwrap_err();
            assert!(matches!(error, DrawingError::Load(InputError::Unknown { .. })), "{error}");
        }
        let unknown = drawings.shape(&named("heart", Some("no".into())), &LoadOptions::default());
        assert!(matches!(unknown, Err(DrawingError::Missing(_))));
    }

    #[test]
    fn built_in_shapes_are_those_of_the_command_line() {
        let drawings = Drawings::default();
        let options = LoadOptions::default();
        assert_eq!(
            drawings.shape(&named("heart", None), &options).unwrap(),
            load("heart", &options).unwrap()
        );
    }

    #[test]
    fn a_drawing_mirrored_twice_is_itself() {
        let drawings = Drawings::default();
        let options = LoadOptions::default();
        let once = drawings.mirrored(&named("dove", None)).unwrap();
        assert_eq!(once.name, "dove-mirrored.csv");
        let twice = drawings.mirrored(&once).unwrap();
        let [first, last] =
            [named("dove", None), twice].map(|d| drawings.shape(&d, &options).unwrap());
        assert!((first.raw.area() - last.raw.area()).abs() < 1e-9 * first.raw.area());
        assert!((first.raw.centroid() - last.raw.centroid()).norm() < 1e-6);
        let mirrored = drawings.shape(&once, &options).unwrap();
        let (low, high) = first.raw.bounds();
        let turned = low.x + high.x - mirrored.raw.centroid().x;
        assert!((turned - first.raw.centroid().x).abs() < 1e-6);
    }

    #[test]
    fn the_oldest_go_when_there_are_too_many() {
        let drawings = Drawings::default();
        let large = vec![b'#'; KEPT / 3 + 1];
        let ids: Vec<String> = (0..4).map(|i| drawings.keep(&format!("{i}.csv"), &large)).collect();
        let shelf = drawings.0.lock().unwrap();
        assert!(!shelf.kept.contains_key(&ids[0]) && shelf.kept.contains_key(&ids[3]));
        assert!(shelf.kept.values().map(|k| k.bytes.len()).sum::<usize>() <= KEPT);
    }
}
