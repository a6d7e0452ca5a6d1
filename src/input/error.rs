//! Why a file gives no drawing and no gear.

use super::{DxfError, ImageError, LettersError, PointsError, SolidFileError, SvgError};
use crate::outline::OutlineError;

/// Why a file could not be read. Each message is one sentence with the file, the place and the remedy.
#[derive(Debug, thiserror::Error)]
pub enum InputError {
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
    /// Neither content nor extension tell what the file is, or it is something that is not read.
    #[error(
        "{path}: this is {what}; use SVG, DXF, points as CSV or JSON, STL, OBJ, or for a silhouette PNG, JPEG, TIFF, BMP or WebP"
    )]
    Unrecognised {
        /// The path as given.
        path: String,
        /// What it is, such as `no drawing` or `a PDF page`.
        what: &'static str,
    },
    /// A picture of a finished gear: it has no size.
    #[error(
        "{path}: a picture has no millimetres; give the gear as SVG, DXF, CSV, JSON, STL or OBJ"
    )]
    Picture {
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
    Letters(#[from] LettersError),
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
    /// A mistake in a DXF drawing.
    #[error("{path}: {error}")]
    Dxf {
        /// The path as given.
        path: String,
        /// What is wrong.
        error: DxfError,
    },
    /// A mistake in an STL or OBJ solid.
    #[error("{path}: {error}")]
    Solid {
        /// The path as given.
        path: String,
        /// What is wrong.
        error: SolidFileError,
    },
    /// The part after `#` is not in the file.
    #[error("{path}: it has no part `{part}`; {known}")]
    NoSuchPart {
        /// The path as given.
        path: String,
        /// What was asked for.
        part: String,
        /// What there is.
        known: String,
    },
    /// Nothing closed in the file.
    #[error("{path}: it holds no closed contour; draw the gear as one closed line")]
    NoContour {
        /// The path as given.
        path: String,
    },
    /// The outline is open. Places in the unit of the drawing.
    #[error(
        "{path}: the outline is open by {gap:.4} {unit} between ({from_x:.4}, {from_y:.4}) and ({to_x:.4}, {to_y:.4}){more}; close it there, or give --join a gap that is joined"
    )]
    Open {
        /// The path as given.
        path: String,
        /// Distance of the ends.
        gap: f64,
        /// The unit.
        unit: &'static str,
        /// One end.
        from_x: f64,
        /// One end.
        from_y: f64,
        /// The other end.
        to_x: f64,
        /// The other end.
        to_y: f64,
        /// ` and in 2 other places`, or nothing.
        more: String,
    },
    /// More than one contour could be meant.
    #[error(
        "{path}: it holds {count} contours that could be meant ({list}); name one, such as {path}#{example}"
    )]
    Several {
        /// The path as given.
        path: String,
        /// How many.
        count: usize,
        /// Each with its number, size, place and layer.
        list: String,
        /// What may be written behind `#`.
        example: String,
    },
    /// The teeth point inwards.
    #[error(
        "{path}: this is an inner gear (its teeth point inwards, in a ring {outside:.3} mm wide), and inner gears are not judged; give two gears with outer teeth"
    )]
    InnerGear {
        /// The path as given.
        path: String,
        /// Width of the ring, mm.
        outside: f64,
    },
    /// The contour does not make an outline.
    #[error("{path}: {error}")]
    Outline {
        /// The path as given.
        path: String,
        /// What is wrong.
        error: OutlineError,
    },
}
