//! How far work has come.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

use super::Control;

/// The stages of a design, in their order.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize,
)]
#[serde(rename_all = "lowercase")]
pub enum StageName {
    /// The wanted motion: two shapes fitted, one shape placed on its axis, or a motion as given.
    Wanted,
    /// The pitch curves at their size, with a number of teeth.
    Sized,
    /// The outlines of both gears.
    Toothed,
    /// Their contact analysed over one cycle.
    Analysed,
    /// Rigid-body runs made and judged.
    Proven,
    /// Bores, hubs, lettering and base plate.
    Outfitted,
}

impl StageName {
    /// All stages, first to last.
    pub const ALL: [Self; 6] =
        [Self::Wanted, Self::Sized, Self::Toothed, Self::Analysed, Self::Proven, Self::Outfitted];

    /// One word, as files spell it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Wanted => "wanted",
            Self::Sized => "sized",
            Self::Toothed => "toothed",
            Self::Analysed => "analysed",
            Self::Proven => "proven",
            Self::Outfitted => "outfitted",
        }
    }
}

impl std::fmt::Display for StageName {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.word())
    }
}

/// How far one stage has come. A stage that is made again, after a repair, starts again from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// The stage that is being made.
    pub stage: StageName,
    /// Share of it that is done, 0 to 1; an estimate.
    pub done: f64,
}

impl Control {
    /// Tells the listener, if there is one.
    pub fn progress(&self, stage: StageName, done: f64) {
        if let Some(listener) = &self.listener {
            listener(Progress { stage, done });
        }
    }

    /// Controls for `count` equal parts of one stage that are worked on side by side: their progress adds up, and all stop
    /// with this one.
    #[must_use]
    pub fn split(&self, count: usize) -> Vec<Self> {
        let Some(listener) = &self.listener else { return vec![self.clone(); count] };
        let shares: Arc<Vec<AtomicU64>> = Arc::new((0..count).map(|_| AtomicU64::new(0)).collect());
        (0..count)
            .map(|i| {
                let (listener, shares) = (listener.clone(), shares.clone());
                self.clone().with_progress(move |p| {
                    shares[i].store(p.done.to_bits(), Ordering::Relaxed);
                    let sum: f64 =
                        shares.iter().map(|s| f64::from_bits(s.load(Ordering::Relaxed))).sum();
                    listener(Progress { done: sum / shares.len() as f64, ..p });
                })
            })
            .collect()
    }

    /// Counts `total` like pieces of work and tells the listener whenever another percent is done.
    pub(crate) fn meter(&self, stage: StageName, total: usize) -> Meter<'_> {
        Meter { control: self, stage, total: total.max(1), done: AtomicUsize::new(0) }
    }
}

/// See [`Control::meter`].
pub(crate) struct Meter<'a> {
    control: &'a Control,
    stage: StageName,
    total: usize,
    done: AtomicUsize,
}

impl Meter<'_> {
    /// Counts `more` pieces.
    pub(crate) fn add(&self, more: usize) {
        if self.control.listener.is_none() {
            return;
        }
        let before = self.done.fetch_add(more, Ordering::Relaxed);
        let percent = |done: usize| 100 * done / self.total;
        if percent(before + more) > percent(before) {
            self.control.progress(self.stage, (before + more) as f64 / self.total as f64);
        }
    }
}
