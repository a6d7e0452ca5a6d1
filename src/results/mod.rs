//! What a person and a program are told of results: lines, figures, tables and pages. Nothing here prints or writes.

mod bare;
mod design;
mod runs;

pub use bare::bare_page;
pub use design::{design_figures, design_lines, design_page};
pub use runs::{
    RUN_TABLES, contacts as run_contacts, lines as run_lines, plots as run_plots,
    sections as run_sections, table_name,
};
