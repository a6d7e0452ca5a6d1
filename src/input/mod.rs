//! Files that hold a drawing or a finished gear: SVG, DXF, silhouette images, points, `design.json`, and slices of solids.
//!
//! A file is recognised once (`recognise`), then read by the one reader of its format into contours, each with its layer and
//! its unit; which of them is meant is decided in one place (`choose`), the same for drawings ([`load`]) and for finished
//! gears ([`load_gears`]).

mod choose;
mod contours;
mod dxf;
mod error;
mod inner;
mod join;
mod letters;
mod nature;
mod note;
mod picture;
mod recognise;
mod record;
mod shape;
mod solid;
mod source;
mod svg;
mod table;
mod text;
mod toothed;

pub use dxf::DxfError;
pub use error::InputError;
pub use inner::{Inner, Patch};
pub use letters::LettersError;
pub use note::Note;
pub use picture::{ImageError, from_image};
pub use record::PairRecord;
pub use shape::{LoadOptions, Shape, load, shape_from_bytes};
pub use solid::SolidFileError;
pub use svg::{SvgError, from_svg};
pub(crate) use table::split_fields;
pub use table::{PointsError, from_columns, from_json};
pub use toothed::{Thinned, Toothed, load_gears, load_toothed, toothed_from_bytes};
