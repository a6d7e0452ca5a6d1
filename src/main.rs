//! The `centrode` command.
fn main() {}
