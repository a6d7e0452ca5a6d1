//! Pictures, plots and the page that shows a design to a person.
//!
//! Everything here turns an [`Assembly`](crate::assembly::Assembly) and plain
//! data into a `String`; writing it to a file is the caller's affair. No
//! function panics: values that are not finite are left out of the drawing.

mod alternatives;
mod contacts;
mod data;
mod page;
mod picture;
mod plot;
mod rings;
mod sheet;
mod text;
mod thin;

pub use alternatives::Alternatives;
pub use contacts::contact_frames;
pub use data::{
    ContactFrame, Limit, Note, NoteKind, Plot, ReportData, Row, Section, Series, Touch,
};
pub use page::report_html;
pub use picture::{PictureOptions, pair_svg};
pub use sheet::contact_sheet_svg;
pub(crate) use thin::thin_ring;

#[cfg(test)]
mod fixture;
