//! What `--version` says of this build.

use std::sync::LazyLock;

static FACTS: LazyLock<String> = LazyLock::new(|| {
    let kernel = if cfg!(feature = "pure-rust") {
        "Manifold, Rust port (feature pure-rust)"
    } else if cfg!(feature = "manifold-cpp") {
        "Manifold, C++ (feature manifold-cpp)"
    } else {
        "none"
    };
    let profile = if cfg!(debug_assertions) { "debug" } else { "release" };
    format!(
        "{}\nsolids:  {kernel}\ntarget:  {}-{}\nprofile: {profile}",
        env!("CARGO_PKG_VERSION"),
        std::env::consts::ARCH,
        std::env::consts::OS,
    )
});

/// The version, and what the program was built from; neither dates nor paths.
pub(crate) fn build_facts() -> &'static str {
    &FACTS
}
