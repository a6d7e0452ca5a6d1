//! Files that hold a drawing or a finished gear: SVG, DXF, silhouette images, points, `design.json`, and slices of solids.

mod contour;
mod drawing;
mod points;
mod silhouette;
mod svg;
mod svg_guard;
mod text;
mod toothed;

pub use drawing::{LoadError, LoadOptions, Shape, load, shape_from_bytes};
pub(crate) use points::split_fields;
pub use points::{PointsError, from_columns, from_json};
pub use silhouette::{ImageError, from_image};
pub use svg::{SvgError, from_svg};
pub use text::TextError;
pub use toothed::{PairRecord, Thinned, Toothed, ToothedError, load_toothed, toothed_from_bytes};
