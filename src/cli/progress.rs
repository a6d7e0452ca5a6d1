//! What the program is doing, on standard error, only when that is a terminal.

use centrode::control::{Control, StageName};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::sync::OnceLock;
use std::time::Duration;

/// How often the spinner moves.
const TICK: Duration = Duration::from_millis(80);

/// Set once, from the command line, before anything is said.
static QUIET: OnceLock<()> = OnceLock::new();

/// From now on nothing is said but errors.
pub(crate) fn silence() {
    let _ = QUIET.set(());
}

/// Whether only errors may be said.
pub(crate) fn is_silent() -> bool {
    QUIET.get().is_some()
}

/// A line that says what is being done.
#[derive(Clone, Debug)]
pub(crate) struct Progress(ProgressBar);

impl Progress {
    /// A spinner, or silence when nobody watches.
    pub(crate) fn new() -> Self {
        if is_silent() || !std::io::stderr().is_terminal() {
            return Self(ProgressBar::hidden());
        }
        let bar = ProgressBar::new_spinner();
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}") {
            bar.set_style(style);
        }
        bar.enable_steady_tick(TICK);
        Self(bar)
    }

    /// Says what comes next.
    pub(crate) fn doing(&self, what: impl Into<String>) {
        self.0.set_message(what.into());
    }

    /// A control under which the stages of a design say how far they are.
    pub(crate) fn control(&self) -> Control {
        let shown = self.clone();
        Control::new().with_progress(move |p| {
            let doing = match p.stage {
                StageName::Wanted => "fitting",
                StageName::Sized => "sizing the pitch curves",
                StageName::Toothed => "laying teeth on the pitch curves",
                StageName::Analysed => "analysing the contact",
                StageName::Proven => "running the gears",
                StageName::Outfitted => "fitting out the gears",
            };
            shown.doing(format!("{doing}, {:.0} %", 100.0 * p.done));
        })
    }

    /// Says something that stays, unless only errors may be said.
    pub(crate) fn warn(&self, what: &str) {
        if !is_silent() {
            self.0.suspend(|| eprintln!("warning: {what}"));
        }
    }

    /// Takes the line away.
    pub(crate) fn done(&self) {
        self.0.finish_and_clear();
    }
}

/// A bar that counts pairs.
#[derive(Debug)]
pub(crate) struct Bar(ProgressBar);

impl Bar {
    /// A bar of `total` steps, or silence when nobody watches.
    pub(crate) fn new(total: u64) -> Self {
        if !std::io::stderr().is_terminal() {
            return Self(ProgressBar::hidden());
        }
        let bar = ProgressBar::new(total);
        let template = "{bar:32} {pos} of {len}, {eta} left  {msg}";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.enable_steady_tick(TICK);
        Self(bar)
    }

    /// Says what is being made.
    pub(crate) fn doing(&self, what: impl Into<String>) {
        self.0.set_message(what.into());
    }

    /// One more is done.
    pub(crate) fn step(&self) {
        self.0.inc(1);
    }

    /// Takes the line away.
    pub(crate) fn done(&self) {
        self.0.finish_and_clear();
    }
}
