//! One tab of the browser: its socket, its thread, and the newest state that it wants.

use std::sync::{Arc, Condvar, Mutex, PoisonError};

use axum::extract::ws::{Message, WebSocket};
use tokio::sync::mpsc;

use centrode::control::Control;

use super::App;
use super::engine::Engine;
use super::protocol::{Asked, State, Told};

/// News that wait for the browser; a full queue holds the work up, not the memory.
const QUEUE: usize = 16;

/// The newest state wanted, until the thread takes it.
#[derive(Debug, Default)]
struct Desk {
    wanted: Option<(u64, State, bool)>,
    /// That of the state being made.
    control: Control,
    is_closed: bool,
}

#[derive(Debug, Default)]
struct Mailbox {
    desk: Mutex<Desk>,
    changed: Condvar,
}

impl Mailbox {
    fn put(&self, wanted: (u64, State, bool)) {
        let mut desk = self.lock();
        desk.wanted = Some(wanted);
        desk.control.cancel();
        drop(desk);
        self.changed.notify_one();
    }

    fn close(&self) {
        let mut desk = self.lock();
        desk.is_closed = true;
        desk.control.cancel();
        drop(desk);
        self.changed.notify_one();
    }

    /// Waits for a state, and says when a newer one is there; none when the tab is closed.
    fn take(&self) -> Option<((u64, State, bool), Control)> {
        let mut desk = self.lock();
        loop {
            if desk.is_closed {
                return None;
            }
            if let Some(wanted) = desk.wanted.take() {
                desk.control = Control::new();
                return Some((wanted, desk.control.clone()));
            }
            desk = self.changed.wait(desk).unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Desk> {
        self.desk.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Serves a tab until its socket closes.
pub(super) async fn serve(mut socket: WebSocket, app: Arc<App>) {
    let (send, mut news) = mpsc::channel::<Told>(QUEUE);
    let mailbox = Arc::new(Mailbox::default());
    let worker = {
        let (mailbox, app) = (Arc::clone(&mailbox), Arc::clone(&app));
        std::thread::Builder::new().name("tab".to_owned()).spawn(move || {
            let mut engine = Engine::default();
            while let Some(((generation, state, live), control)) = mailbox.take() {
                let mut tell = |told: Told| send.blocking_send(told).is_ok();
                engine.make(
                    (&app.drawings, &app.finished),
                    (generation, &state, live),
                    &control,
                    &mut tell,
                );
            }
        })
    };
    if worker.is_err() {
        return;
    }
    loop {
        tokio::select! {
            told = news.recv() => {
                let Some(told) = told else { break };
                if socket.send(Message::Text(told.text().into())).await.is_err() {
                    break;
                }
            }
            message = socket.recv() => match message {
                Some(Ok(Message::Text(text))) => match Asked::read(&text) {
                    Ok(Asked::Make { generation, state, live }) => mailbox.put((generation, state, live)),
                    Err(error) => {
                        let told = Told::Bad { text: error.to_string() };
                        if socket.send(Message::Text(told.text().into())).await.is_err() {
                            break;
                        }
                    }
                },
                Some(Ok(Message::Binary(_))) => {}
                Some(Ok(Message::Ping(_) | Message::Pong(_))) => {}
                Some(Ok(Message::Close(_)) | Err(_)) | None => break,
            },
        }
    }
    mailbox.close();
}
