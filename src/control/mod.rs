//! What a caller holds over work that takes long: a way to stop it, to hear how far it is, and to say which threads it
//! may use.
//!
//! A [`Control`] is handed to the long-running functions of the library. Cloning is cheap and every clone is the same
//! control: one thread may work under it while another cancels it. Work that is cancelled returns [`Cancelled`] within
//! 50 ms; what it had found is dropped.

mod progress;
mod threads;

pub(crate) use progress::Meter;
pub use progress::{Progress, StageName};

use std::fmt;
use std::sync::Arc;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::ThreadPool;

type Listener = Arc<dyn Fn(Progress) + Send + Sync>;

/// The control of one piece of work: cancel it, hear its progress, choose its threads.
///
/// ```
/// use centrode::control::Control;
///
/// let control = Control::new();
/// let stopper = control.clone();
/// assert!(control.check().is_ok());
/// stopper.cancel();
/// assert!(control.check().is_err());
/// ```
#[derive(Clone)]
pub struct Control {
    cancelled: Option<Arc<AtomicBool>>,
    listener: Option<Listener>,
    threads: Option<Arc<ThreadPool>>,
}

/// The work was stopped by [`Control::cancel`] before it was done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cancelled before it was done; start it again to get a result")]
pub struct Cancelled;

static UNWATCHED: LazyLock<Control> =
    LazyLock::new(|| Control { cancelled: None, listener: None, threads: None });

impl Default for Control {
    fn default() -> Self {
        Self::new()
    }
}

impl fmt::Debug for Control {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Control")
            .field("cancelled", &self.is_cancelled())
            .field("listens", &self.listener.is_some())
            .finish_non_exhaustive()
    }
}

/// All controls count as equal: whoever watches changes nothing in what is made.
impl PartialEq for Control {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Control {
    /// A control that nobody has cancelled, without a listener, on the library's own threads.
    #[must_use]
    pub fn new() -> Self {
        Self { cancelled: Some(Arc::default()), listener: None, threads: None }
    }

    /// The control of work that nobody watches and nobody can stop.
    #[must_use]
    pub fn unwatched() -> &'static Self {
        &UNWATCHED
    }

    /// The same control with a listener for progress in place of the one it had. It is called from any thread, often,
    /// and the work waits for it: it should return at once.
    #[must_use]
    pub fn with_progress(self, listener: impl Fn(Progress) + Send + Sync + 'static) -> Self {
        Self { listener: Some(Arc::new(listener)), ..self }
    }

    /// Asks all work under this control to stop; there is no way back. Does nothing to [`Self::unwatched`].
    pub fn cancel(&self) {
        if let Some(flag) = &self.cancelled {
            flag.store(true, Ordering::Relaxed);
        }
    }

    /// Whether the work should stop.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.cancelled.as_ref().is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    /// Passes work that may go on.
    ///
    /// # Errors
    /// [`Cancelled`] once [`Self::cancel`] was called.
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.is_cancelled() { Err(Cancelled) } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    #[test]
    fn a_clone_cancels_its_original_and_nobody_cancels_the_unwatched() {
        let control = Control::new();
        control.clone().cancel();
        assert_eq!(control.check(), Err(Cancelled));
        Control::unwatched().cancel();
        assert!(Control::unwatched().check().is_ok() && Control::new().check().is_ok());
    }

    #[test]
    fn parts_add_up_to_the_whole_whatever_their_order() {
        let heard = Arc::new(Mutex::new(Vec::new()));
        let sink = heard.clone();
        let control = Control::new().with_progress(move |p| sink.lock().unwrap().push(p.done));
        let parts = control.split(4);
        for (i, done) in [(2, 1.0), (0, 0.5), (0, 1.0), (3, 1.0), (1, 1.0)] {
            parts[i].progress(StageName::Proven, done);
        }
        assert_eq!(*heard.lock().unwrap(), [0.25, 0.375, 0.5, 0.75, 1.0]);
        control.cancel();
        assert!(parts[1].is_cancelled());
    }

    #[test]
    fn a_meter_counts_from_many_threads_and_speaks_at_most_once_a_percent() {
        use rayon::prelude::*;
        let heard = Arc::new(Mutex::new(Vec::new()));
        let sink = heard.clone();
        let control = Control::new().with_progress(move |p| sink.lock().unwrap().push(p.done));
        let meter = control.meter(StageName::Analysed, 5000);
        (0..5000).into_par_iter().for_each(|_| meter.add(1));
        let heard = heard.lock().unwrap();
        assert!(heard.len() <= 101 && heard.contains(&1.0), "{heard:?}");
    }

    #[test]
    fn work_runs_on_the_threads_given() {
        let control = Control::new().with_threads(3).unwrap();
        assert_eq!(control.run(rayon::current_num_threads), 3);
        // Within a pool no other is entered.
        assert_eq!(control.run(|| Control::new().run(rayon::current_num_threads)), 3);
    }
}
