//! Shapes by path or built-in name: the one place in this room that reads files.

use super::text::{PREFIX, TextError, outline_of};
use super::{ImageError, PointsError, SvgError, from_columns, from_image, from_json, from_svg};
use crate::outline::{Outline, Smoothing, library, smooth};
use crate::policy;
use crate::wording::quoted;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// How a drawing is turned into an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadOptions {
    /// Brightness, 0 to 255, that separates shape from ground in an image; none for Otsu's.
    pub threshold: Option<u8>,
    /// How strongly the outline is smoothed.
    pub smoothing: Smoothing,
    /// Greatest distance of a flattened SVG curve from the true one, relative to the diagonal.
    pub flatten_tolerance: f64,
    /// Vertices of the smoothed outline; at least 16 are made.
    pub samples: usize,
}

impl Default for LoadOptions {
    fn default() -> Self {
        Self {
            threshold: None,
            smoothing: Smoothing::Auto,
            flatten_tolerance: policy::FLATTEN_TOLERANCE,
            samples: policy::SMOOTH_SAMPLES,
        }
    }
}

/// A drawing, ready to be made into a gear.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// The built-in name, or the file's name without its extension.
    pub name: String,
    /// The outline as drawn, in the units of the input, y upwards.
    pub raw: Outline,
    /// The outline after smoothing, in the same frame.
    pub outline: Outline,
}

/// Why a shape could not be loaded. Each message is one sentence with the file, the place and
/// the remedy.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// Neither a file nor a built-in shape.
    #[error("there is no file or built-in shape `{name}`{hint}; `centrode shapes` lists them")]
    Unknown {
        /// What was asked for.
        name: String,
        /// `, did you mean ...`, or nothing.
        hint: String,
    },
    /// No such file.
    #[error("{path}: there is no such file; check the path")]
    Missing {
        /// The path as given.
        path: String,
    },
    /// The path is a folder.
    #[error("{path}: this is a folder; name a drawing in it")]
    Folder {
        /// The path as given.
        path: String,
    },
    /// A pipe or a device.
    #[error("{path}: this is no regular file; name a drawing")]
    NoRegularFile {
        /// The path as given.
        path: String,
    },
    /// The file exists but cannot be read.
    #[error("{path}: {reason}; check that the file may be read")]
    Unreadable {
        /// The path as given.
        path: String,
        /// What the system says.
        reason: String,
    },
    /// The file is longer than any drawing.
    #[error("{path}: the file has more than {limit} bytes; name a drawing, or simplify it")]
    TooLarge {
        /// The path as given.
        path: String,
        /// Most bytes that are read.
        limit: u64,
    },
    /// The file has no content.
    #[error("{path}: the file is empty; save the drawing again")]
    Empty {
        /// The path as given.
        path: String,
    },
    /// Neither content nor extension tell what the file is.
    #[error("{path}: this is no drawing; use SVG, PNG, JPEG, TIFF, BMP, or points as CSV or JSON")]
    Unrecognised {
        /// The path as given.
        path: String,
    },
    /// A mistake in an SVG drawing.
    #[error("{path}: {error}")]
    Svg {
        /// The path or built-in name.
        path: String,
        /// What is wrong.
        error: SvgError,
    },
    /// A text that is no shape.
    #[error(transparent)]
    Text(#[from] TextError),
    /// A mistake in an image.
    #[error("{path}: {error}")]
    Image {
        /// The path as given.
        path: String,
        /// What is wrong.
        error: ImageError,
    },
    /// A mistake in a list of points.
    #[error("{path}: {error}")]
    Points {
        /// The path as given.
        path: String,
        /// What is wrong.
        error: PointsError,
    },
}

/// Loads a drawing and smooths it.
///
/// `source` is a path if such a file exists or if it contains a separator or a dot, otherwise
/// the name of a built-in shape ([`library::names`]), or `text:` and a letter. Files are recognised by their content;
/// the extension decides only where the content does not.
///
/// # Errors
/// See [`LoadError`].
pub fn load(source: &str, options: &LoadOptions) -> Result<Shape, LoadError> {
    if let Some(text) = source.strip_prefix(PREFIX) {
        let raw = outline_of(text)?;
        let outline = smooth(&raw, options.smoothing, options.samples.max(16));
        return Ok(Shape { name: quoted(text), raw, outline });
    }
    let built_in = library::svg(source).filter(|_| !Path::new(source).is_file());
    let (name, raw) = if let Some(text) = built_in {
        let outline = from_svg(text.as_bytes(), options.flatten_tolerance);
        let failed = |error| LoadError::Svg { path: source.to_owned(), error };
        (source.to_owned(), outline.map_err(failed)?)
    } else {
        let stem = Path::new(source).file_stem().unwrap_or_default();
        (quoted(&stem.to_string_lossy()), read_outline(source, options)?)
    };
    let outline = smooth(&raw, options.smoothing, options.samples.max(16));
    Ok(Shape { name, raw, outline })
}

fn read_outline(source: &str, options: &LoadOptions) -> Result<Outline, LoadError> {
    outline_from(&read_file(source)?, source, options)
}

/// The shape in the bytes of a drawing: [`load`] for what is in memory.
///
/// `file_name` names the shape and is named in messages; its extension decides only where the content does not.
///
/// # Errors
/// As [`load`], less what concerns files.
pub fn shape_from_bytes(
    bytes: &[u8],
    file_name: &str,
    options: &LoadOptions,
) -> Result<Shape, LoadError> {
    bounded(bytes, file_name)?;
    let stem = Path::new(file_name).file_stem().unwrap_or_default();
    let name = quoted(&stem.to_string_lossy());
    let raw = outline_from(bytes, file_name, options)?;
    let outline = smooth(&raw, options.smoothing, options.samples.max(16));
    Ok(Shape { name, raw, outline })
}

fn outline_from(bytes: &[u8], source: &str, options: &LoadOptions) -> Result<Outline, LoadError> {
    let path = source.to_owned();
    match kind(bytes, source) {
        Some(Kind::Svg) => from_svg(bytes, options.flatten_tolerance)
            .map_err(|error| LoadError::Svg { path, error }),
        Some(Kind::Image) => {
            from_image(bytes, options.threshold).map_err(|error| LoadError::Image { path, error })
        }
        Some(Kind::Columns) => {
            from_columns(bytes).map_err(|error| LoadError::Points { path, error })
        }
        Some(Kind::Json) => from_json(bytes).map_err(|error| LoadError::Points { path, error }),
        None => Err(LoadError::Unrecognised { path }),
    }
}

/// Refuses a file without content, or with too much.
pub(super) fn bounded(bytes: &[u8], source: &str) -> Result<(), LoadError> {
    let limit = policy::INPUT_BYTES;
    match bytes.len() as u64 {
        0 => Err(LoadError::Empty { path: source.to_owned() }),
        length if length > limit => Err(LoadError::TooLarge { path: source.to_owned(), limit }),
        _ => Ok(()),
    }
}

/// The content of a file, of bounded length.
pub(super) fn read_file(source: &str) -> Result<Vec<u8>, LoadError> {
    let path = || source.to_owned();
    let place = Path::new(source);
    let unreadable = |error: std::io::Error| match error.kind() {
        std::io::ErrorKind::NotFound if source.contains(['/', '\\', '.']) => {
            LoadError::Missing { path: path() }
        }
        std::io::ErrorKind::NotFound => {
            let hint = library::nearest(source).map(|known| format!(", did you mean `{known}`"));
            LoadError::Unknown { name: path(), hint: hint.unwrap_or_default() }
        }
        _ => LoadError::Unreadable { path: path(), reason: error.to_string() },
    };
    // Before it is opened: a pipe that nobody writes to would wait for ever.
    let kind = std::fs::metadata(place).map_err(unreadable)?.file_type();
    if kind.is_dir() {
        return Err(LoadError::Folder { path: path() });
    }
    if !kind.is_file() {
        return Err(LoadError::NoRegularFile { path: path() });
    }
    let file = File::open(place).map_err(unreadable)?;
    let mut bytes = Vec::new();
    file.take(policy::INPUT_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    bounded(&bytes, source)?;
    Ok(bytes)
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Svg,
    Image,
    Columns,
    Json,
}

/// What the content is, or failing that what the extension promises.
fn kind(bytes: &[u8], source: &str) -> Option<Kind> {
    if image::guess_format(bytes).is_ok() {
        return Some(Kind::Image);
    }
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    let extension = Path::new(source).extension().unwrap_or_default().to_string_lossy();
    match (text.first(), extension.to_lowercase().as_str()) {
        // What `check` reads as finished gears is no drawing, though it may begin with a number.
        (_, "dxf" | "stl" | "obj" | "3mf" | "step" | "stp") => None,
        (Some(b'<'), _) | (_, "svg" | "svgz") => Some(Kind::Svg),
        (Some(b'[' | b'{'), _) | (_, "json") => Some(Kind::Json),
        (_, "png" | "jpg" | "jpeg" | "tif" | "tiff" | "bmp") => Some(Kind::Image),
        (_, "csv" | "txt") => Some(Kind::Columns),
        (Some(b'0'..=b'9' | b'+' | b'-' | b'.' | b'#'), _) => Some(Kind::Columns),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::OutlineError;
    use std::path::PathBuf;

    struct Folder(tempfile::TempDir);

    impl Folder {
        fn new() -> Self {
            Self(tempfile::tempdir().unwrap())
        }

        fn with(&self, name: &str, content: impl AsRef<[u8]>) -> String {
            let path: PathBuf = self.0.path().join(name);
            std::fs::write(&path, content).unwrap();
            path.to_string_lossy().into_owned()
        }
    }

    fn failure(source: &str) -> LoadError {
        let error = load(source, &LoadOptions::default()).unwrap_err();
        let message = error.to_string();
        assert!(message.contains(source) && !message.contains('\n'), "{message}");
        assert!(message.contains(';'), "no remedy: {message}");
        error
    }

    const SQUARE: &str = "0,0\n4,0\n4,3\n0,3\n";
    const SVG: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path d="M1 1h4v3h-4z"/></svg>"#;

    #[test]
    fn content_decides_what_a_file_is() {
        let folder = Folder::new();
        let mut bmp = std::io::Cursor::new(Vec::new());
        let dark = |x, y| image::Luma([if x > 9 && y > 9 && x < 50 && y < 40 { 0 } else { 255 }]);
        let picture = image::GrayImage::from_fn(60, 50, dark);
        picture.write_to(&mut bmp, image::ImageFormat::Bmp).unwrap();
        for (name, content) in [
            ("a.svg", SVG.as_bytes()),
            ("b.txt", SVG.as_bytes()),
            ("c.csv", SQUARE.as_bytes()),
            ("d", SQUARE.as_bytes()),
            ("e.txt", b"[[0,0],[4,0],[4,3],[0,3]]"),
            ("f.json", b" {\"points\": [[0,0],[4,0],[4,3],[0,3]]}"),
            ("g.jpg", bmp.get_ref().as_slice()),
        ] {
            let options = LoadOptions { smoothing: Smoothing::Fixed(0.0), ..Default::default() };
            let shape = load(&folder.with(name, content), &options).unwrap();
            assert_eq!(Some(shape.name.as_str()), name.split('.').next());
            assert_eq!(shape.raw, shape.outline);
            let (low, high) = shape.raw.bounds();
            assert!(((high.x - low.x) / (high.y - low.y) - 4.0 / 3.0).abs() < 0.01, "{name}");
        }
    }

    #[test]
    fn built_in_shapes_load_smoothed() {
        for name in library::names() {
            let shape = load(name, &LoadOptions::default()).unwrap();
            assert_eq!(shape.name, name);
            assert_eq!(shape.outline.points().len(), policy::SMOOTH_SAMPLES);
        }
    }

    #[test]
    fn unknown_names_suggest_the_nearest() {
        let error = failure("haert");
        assert!(error.to_string().contains("did you mean `heart`"), "{error}");
        assert!(error.to_string().contains("centrode shapes"));
        assert!(matches!(failure("qqqqqqqqqq"), LoadError::Unknown { .. }));
        assert!(matches!(failure("no/such"), LoadError::Missing { .. }));
        assert!(matches!(failure("heart.svg"), LoadError::Missing { .. }));
    }

    #[test]
    fn files_that_cannot_be_drawings_are_refused() {
        let folder = Folder::new();
        let place = folder.0.path().to_string_lossy().into_owned();
        assert!(matches!(failure(&place), LoadError::Folder { .. }));
        assert!(matches!(failure(&folder.with("a.svg", "")), LoadError::Empty { .. }));
        assert!(matches!(failure(&folder.with("a.doc", "hello")), LoadError::Unrecognised { .. }));
        let sparse = folder.with("big.png", "x");
        let file = File::options().write(true).open(&sparse).unwrap();
        file.set_len(policy::INPUT_BYTES + 1).unwrap();
        assert!(matches!(failure(&sparse), LoadError::TooLarge { .. }));
        let nul = "a\0b.svg";
        assert!(load(nul, &LoadOptions::default()).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn pipes_and_devices_are_refused_without_waiting() {
        assert!(matches!(failure("/dev/null"), LoadError::NoRegularFile { .. }));
        let folder = Folder::new();
        let pipe = folder.0.path().join("pipe.svg").to_string_lossy().into_owned();
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        if made.is_ok_and(|status| status.success()) {
            assert!(matches!(failure(&pipe), LoadError::NoRegularFile { .. }));
        }
    }

    #[test]
    fn each_reader_reports_under_the_name_of_the_file() {
        let folder = Folder::new();
        let svg = |body: &str| {
            format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 9 9'>{body}</svg>")
        };
        assert!(matches!(
            failure(&folder.with("text.svg", svg("<text>a</text>"))),
            LoadError::Svg { error: SvgError::OnlyText, .. }
        ));
        assert!(matches!(
            failure(&folder.with("words.svg", "not a drawing")),
            LoadError::Svg { error: SvgError::NotXml { .. }, .. }
        ));
        assert!(matches!(
            failure(&folder.with("words.png", "not an image")),
            LoadError::Image { error: ImageError::NotAnImage, .. }
        ));
        assert!(matches!(
            failure(&folder.with("nan.csv", "0,0\n1,NaN\n2,2\n")),
            LoadError::Points { error: PointsError::BadLine { line: 2, .. }, .. }
        ));
        assert!(matches!(
            failure(&folder.with("two.csv", "0,0\n1,1\n")),
            LoadError::Points {
                error: PointsError::Outline(OutlineError::TooFewPoints { count: 2 }),
                ..
            }
        ));
        assert!(matches!(
            failure(&folder.with("cross.json", "[[0,0],[2,2],[2,0],[0,2]]")),
            LoadError::Points {
                error: PointsError::Outline(OutlineError::SelfCrossing { .. }),
                ..
            }
        ));
    }
}
