//! Which threads work: the control's own, or the library's. The global pool of rayon belongs to the program.

use std::sync::{Arc, LazyLock};

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

use super::Control;

/// One thread a processor, made when it is first needed; none where the system refuses threads.
static OWN: LazyLock<Option<ThreadPool>> = LazyLock::new(|| named(0).ok());

fn named(count: usize) -> Result<ThreadPool, ThreadPoolBuildError> {
    ThreadPoolBuilder::new().num_threads(count).thread_name(|i| format!("centrode-{i}")).build()
}

impl Control {
    /// The same control with `count` threads of its own (one a processor for 0); work under it and under its clones shares
    /// them.
    ///
    /// # Errors
    /// [`ThreadPoolBuildError`] when the system gives no more threads.
    pub fn with_threads(self, count: usize) -> Result<Self, ThreadPoolBuildError> {
        Ok(Self { threads: Some(Arc::new(named(count)?)), ..self })
    }

    /// Carries `work` out on the threads of this control, or on those of the library. Work that already runs on threads
    /// of a pool stays there unless this control has its own.
    pub fn run<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        match (&self.threads, rayon::current_thread_index()) {
            (Some(own), _) => own.install(work),
            (None, Some(_)) => work(),
            (None, None) => match &*OWN {
                Some(pool) => pool.install(work),
                None => work(),
            },
        }
    }
}
