//! What is kept of designs and trains in files: the record `design.json`, written and read back, and trains in TOML.

mod fittings;
mod record;
mod saved;
mod settings;
mod stages;
mod train_file;
mod typed;
pub mod words;

pub use record::{RECORD_VERSION, Record, run_record};
pub use saved::{RECORD_NAME, SavedDesign, SavedError};
pub use settings::{default_length, default_text};
pub use train_file::{TrainFileError, read_train, train_from_toml};
