//! What is kept of designs and trains in files: the record `design.json`, written and read back, and trains in TOML.

mod fittings;
mod record;
mod saved;
mod train_file;

pub use record::{Record, run_record};
pub use saved::{RECORD_NAME, SavedDesign, SavedError};
pub use train_file::{TrainFileError, read_train, train_from_toml};
