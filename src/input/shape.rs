//! Drawings, to be made into gears.

use super::contours::{Contour, Contours};
use super::inner::{Drawing, Inner};
use super::letters::{self, PREFIX};
use super::nature::Nature;
use super::note::Note;
use super::recognise::{Format, recognised};
use super::source::{Source, bounded, read_file};
use super::{InputError, choose, dxf, picture, record, solid, svg, table};
use crate::outline::{Outline, Smoothing, library, repaired, smooth};
use crate::policy;
use crate::wording::quoted;
use std::path::Path;

/// How a drawing is turned into an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadOptions {
    /// Brightness, 0 to 255, that separates shape from ground in an image; found when left out.
    pub threshold: Option<u8>,
    /// How strongly the outline is smoothed.
    pub smoothing: Smoothing,
    /// Greatest distance of a flattened SVG curve from the true one, relative to the diagonal.
    pub flatten_tolerance: f64,
    /// Vertices of the smoothed outline; at least 16 are made.
    pub samples: usize,
    /// Widest gap between ends of lines that is joined, mm; 0.05 mm, or 1e-4 of the drawing if that is more, when left
    /// out.
    pub join: Option<f64>,
}

impl Default for LoadOptions {
    fn default() -> Self {
        Self {
            threshold: None,
            smoothing: Smoothing::Auto,
            flatten_tolerance: policy::FLATTEN_TOLERANCE,
            samples: policy::SMOOTH_SAMPLES,
            join: None,
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
    /// What is drawn inside the outline, in the same frame.
    pub inner: Inner,
    /// What a reader should know.
    pub notes: Vec<Note>,
}

/// Fewest teeth of a drawing that are spoken of: fewer may be its lobes.
const NOTED_TEETH: usize = 8;

/// Loads a drawing and smooths it.
///
/// `source` is a path if such a file exists or if it contains a separator or a dot, otherwise
/// the name of a built-in shape ([`library::names`]), or `text:` and a letter; behind a `#` may stand which of its shapes is meant: a layer, an id,
/// or a number. Files are recognised by their content; the extension decides only where the content does not.
///
/// # Errors
/// See [`InputError`].
pub fn load(source: &str, options: &LoadOptions) -> Result<Shape, InputError> {
    if let Some(text) = source.strip_prefix(PREFIX) {
        return Ok(smoothed(quoted(text), letters::shape(text)?, options));
    }
    let built_in = library::svg(source).filter(|_| !Path::new(source).is_file());
    if let Some(text) = built_in {
        let failed = |error| InputError::Svg { path: source.to_owned(), error };
        let drawing = svg::shape(text.as_bytes(), options.flatten_tolerance, None, options.join);
        return Ok(smoothed(source.to_owned(), drawing.map_err(failed)?, options));
    }
    let source = Source::new(source);
    let bytes = read_file(source.path)?;
    read(&bytes, source, options)
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
) -> Result<Shape, InputError> {
    bounded(bytes, file_name)?;
    read(bytes, Source { path: file_name, part: None }, options)
}

fn read(bytes: &[u8], source: Source<'_>, options: &LoadOptions) -> Result<Shape, InputError> {
    let stem = Path::new(source.path).file_stem().unwrap_or_default();
    let name = quoted(&stem.to_string_lossy());
    let path = || source.path();
    let format = recognised(bytes, source.path).map_err(|what| InputError::Unrecognised {
        path: path(),
        what: what.unwrap_or("no drawing"),
    })?;
    let mut drawing = match format {
        Format::Svg => svg::shape(bytes, options.flatten_tolerance, source.part, options.join)
            .map_err(|error| InputError::Svg { path: path(), error })?,
        Format::Picture => picture::shape(bytes, options.threshold)
            .map_err(|error| InputError::Image { path: path(), error })?,
        Format::Table => {
            let outline = table::from_columns(bytes);
            outline.map_err(|error| InputError::Points { path: path(), error })?.into()
        }
        Format::Json => of_contours(record::contours(bytes, source, None)?, source)?,
        Format::Dxf => {
            let made = dxf::contours(bytes, options.join);
            of_contours(made.map_err(|error| InputError::Dxf { path: path(), error })?, source)?
        }
        Format::Stl | Format::Obj => {
            let failed = |error| InputError::Solid { path: path(), error };
            let (mesh, used) = match format {
                Format::Stl => (solid::stl(bytes).map_err(failed)?, false),
                _ => solid::obj(bytes, source.part, None).map_err(failed)?,
            };
            let source = Source { part: source.part.filter(|_| !used), ..source };
            let mut made = solid::contours(&mesh, source).map_err(failed)?;
            made.part_used |= used;
            of_contours(made, source)?
        }
    };
    let nature = Nature::of(&super::contours::Contour {
        points: drawing.outline.points().to_vec(),
        closed: true,
        ..super::contours::Contour::default()
    });
    if let Nature::Toothed(teeth) = nature
        && teeth >= NOTED_TEETH
        && format != Format::Picture
    {
        drawing.notes.push(Note::TeethNotKept { teeth });
    }
    Ok(smoothed(name, drawing, options))
}

fn of_contours(mut made: Contours, source: Source<'_>) -> Result<Drawing, InputError> {
    let source = Source { part: source.part.filter(|_| !made.part_used), ..source };
    let chosen = choose::shape(&mut made, source)?;
    let outline = repaired(chosen.outer.points)
        .map_err(|error| InputError::Outline { path: source.path(), error })?;
    let holes = chosen.holes.into_iter().filter(|h| !h.dashed);
    let turned = |h: Contour| match Outline::new(h.points) {
        Ok(edge) => Some(edge.points().to_vec()),
        Err(_) => None,
    };
    let inner = Inner { holes: holes.filter_map(turned).collect(), ..Inner::default() };
    Ok(Drawing { outline, inner, notes: made.notes })
}

fn smoothed(name: String, drawing: Drawing, options: &LoadOptions) -> Shape {
    let Drawing { outline: raw, inner, notes } = drawing;
    let outline = smooth(&raw, options.smoothing, options.samples.max(16));
    Shape { name, raw, outline, inner, notes }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::{ImageError, PointsError, SvgError};
    use crate::outline::OutlineError;
    use std::fs::File;
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

    fn failure(source: &str) -> InputError {
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
        assert!(matches!(failure("qqqqqqqqqq"), InputError::Unknown { .. }));
        assert!(matches!(failure("no/such"), InputError::Missing { .. }));
        assert!(matches!(failure("heart.svg"), InputError::Missing { .. }));
    }

    #[test]
    fn files_that_cannot_be_drawings_are_refused() {
        let folder = Folder::new();
        let place = folder.0.path().to_string_lossy().into_owned();
        assert!(matches!(failure(&place), InputError::Folder { .. }));
        assert!(matches!(failure(&folder.with("a.svg", "")), InputError::Empty { .. }));
        assert!(matches!(failure(&folder.with("a.doc", "hello")), InputError::Unrecognised { .. }));
        let sparse = folder.with("big.png", "x");
        let file = File::options().write(true).open(&sparse).unwrap();
        file.set_len(policy::INPUT_BYTES + 1).unwrap();
        assert!(matches!(failure(&sparse), InputError::TooLarge { .. }));
        let nul = "a\0b.svg";
        assert!(load(nul, &LoadOptions::default()).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn pipes_and_devices_are_refused_without_waiting() {
        assert!(matches!(failure("/dev/null"), InputError::NoRegularFile { .. }));
        let folder = Folder::new();
        let pipe = folder.0.path().join("pipe.svg").to_string_lossy().into_owned();
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        if made.is_ok_and(|status| status.success()) {
            assert!(matches!(failure(&pipe), InputError::NoRegularFile { .. }));
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
            InputError::Svg { error: SvgError::OnlyText, .. }
        ));
        assert!(matches!(
            failure(&folder.with("words.svg", "not a drawing")),
            InputError::Svg { error: SvgError::NotXml { .. }, .. }
        ));
        assert!(matches!(
            failure(&folder.with("words.png", "not an image")),
            InputError::Image { error: ImageError::NotAnImage, .. }
        ));
        assert!(matches!(
            failure(&folder.with("nan.csv", "0,0\n1,NaN\n2,2\n")),
            InputError::Points { error: PointsError::BadLine { line: 2, .. }, .. }
        ));
        assert!(matches!(
            failure(&folder.with("two.csv", "0,0\n1,1\n")),
            InputError::Points {
                error: PointsError::Outline(OutlineError::TooFewPoints { count: 2 }),
                ..
            }
        ));
        assert!(matches!(
            failure(&folder.with("cross.json", "[[0,0],[2,2],[2,0],[0,2]]")),
            InputError::Outline { error: OutlineError::SelfCrossing { .. }, .. }
        ));
    }
}
