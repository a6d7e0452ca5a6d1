//! Work that can be interrupted from Python.

use std::sync::Mutex;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::Duration;

use centrode::control::{Control, Progress};
use pyo3::exceptions::{PyOSError, PyRuntimeError};
use pyo3::prelude::*;

/// How often signals are looked for: an interrupt is seen within this time, and the work stops within 50 ms after.
const LOOK: Duration = Duration::from_millis(25);

/// Who hears of the work, and how many threads it has; one a processor where that is left out.
#[derive(Clone, Copy)]
pub(crate) struct Watch<'a, 'py> {
    /// Called with the stage's name and the share of it that is done.
    pub(crate) progress: Option<&'a Bound<'py, PyAny>>,
    /// Threads of the work.
    pub(crate) threads: Option<usize>,
}

/// Carries `work` out on a thread of its own, without the interpreter's lock. A signal (Ctrl-C), or an exception in
/// `progress`, cancels the work and is raised.
///
/// # Errors
/// What the signal's handler or `progress` raised.
pub(crate) fn watched<T: Send>(
    py: Python<'_>,
    watch: Watch<'_, '_>,
    work: impl FnOnce(&Control) -> T + Send,
) -> PyResult<T> {
    let mut control = Control::new();
    if let Some(count) = watch.threads {
        let made = control.with_threads(count);
        control = made.map_err(|e| PyOSError::new_err(e.to_string()))?;
    }
    let (tell, told) = mpsc::channel::<Progress>();
    if watch.progress.is_some() {
        control = control.with_progress(move |p| {
            // Nobody listens any more once the work was cancelled.
            let _ = tell.send(p);
        });
    }
    let heard = || match (watch.progress, told.try_iter().last()) {
        (Some(call), Some(last)) => call.call1((last.stage.word(), last.done)).map(drop),
        _ => Ok(()),
    };
    let (done, ready) = mpsc::channel();
    // One thread alone waits; the lock is for the compiler.
    let ready = Mutex::new(ready);
    let wait = || match ready.lock() {
        Ok(ready) => ready.recv_timeout(LOOK),
        Err(_) => Err(RecvTimeoutError::Disconnected),
    };
    std::thread::scope(|scope| {
        let stopper = control.clone();
        let worker = scope.spawn(move || {
            let made = work(&control);
            let _ = done.send(made);
        });
        let outcome = loop {
            match py.detach(wait) {
                Ok(made) => break heard().map(|()| made),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => {
                    let text = "the work ended without a result; report this as a bug";
                    break Err(PyRuntimeError::new_err(text));
                }
            }
            if let Err(error) = py.check_signals().and_then(|()| heard()) {
                stopper.cancel();
                break Err(error);
            }
        };
        // Others may run while the work comes to its end; that it panicked is told above.
        py.detach(|| drop(worker.join()));
        outcome
    })
}
