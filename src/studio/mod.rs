//! `centrode studio`: a page on this machine on which a pair of gears follows every change.
//!
//! The server is bound to loopback, answers only its own page (`guard`), reads no file but those that the command
//! line names (`drawings`) and writes none outside the output folder (`away`). A tab sends whole states
//! (`protocol`); a thread of its own makes the newest one (`tab`, `engine`).

mod assets;
mod away;
mod controls;
mod drawings;
mod engine;
#[cfg(test)]
mod example;
mod findings;
mod guard;
mod protocol;
mod records;
mod server;
mod tab;
mod train;
mod wire;
mod words;

use std::net::{Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;

use anyhow::{Context, anyhow};
use centrode::outline::library;
use tokio::net::TcpListener;
use tokio::sync::Semaphore;

use crate::cli::studio::StudioArgs;
use drawings::Drawings;
use engine::Finished;
use guard::Guard;
use protocol::DrawingRef;

/// The port that is tried first, and how many after it.
const PORT: u16 = 4827;
const PORTS: u16 = 20;
/// Tabs at a time: each has a thread and keeps a pair.
const TABS: usize = 24;
/// Where files go unless the command line says.
const FOLDER: &str = "out";
/// Holds the token between two runs of the studio in one folder, so that a page that is open finds it again.
const TOKEN_FILE: &str = ".centrode-studio";

/// Reads a message of one of the kinds that the server takes, as it would, and does not carry it out: for the fuzz target.
///
/// # Errors
/// What the page would be told.
pub fn read_message(kind: u8, text: &str) -> Result<(), String> {
    fn order<T: serde::de::DeserializeOwned>(text: &str) -> Result<T, String> {
        serde_json::from_str(text).map_err(|e| protocol::BadMessage::from(e).to_string())
    }
    let said = |error: protocol::BadMessage| error.to_string();
    let state = match kind % 6 {
        0 => match protocol::Asked::read(text).map_err(said)? {
            protocol::Asked::Make { state, .. } => state,
        },
        1 => {
            let order: away::Order = order(text)?;
            order.check().map_err(said)?;
            order.state().clone()
        }
        2 => {
            let order: train::Order = order(text)?;
            order.check().map_err(said)?;
            order.state().clone()
        }
        3 => words::opened(text).map_err(|e| crate::cli::told(&e))?,
        4 => records::opened(text, &Drawings::default())?,
        _ => order::<protocol::State>(text)?,
    };
    state.check().map_err(said)?;
    let words = words::typed(&state, FOLDER);
    crate::cli::plan::plan(&words).map_err(|blamed| blamed.text)?;
    Ok(())
}

/// What all requests share.
#[derive(Debug)]
struct App {
    guard: Guard,
    drawings: Drawings,
    /// Drawings that the command line names.
    given: Vec<DrawingRef>,
    output: PathBuf,
    tabs: Arc<Semaphore>,
    /// The pairs that were proven last, for whoever takes their files away.
    finished: Finished,
    /// Files are made for one page at a time: solids take all processors anyway.
    exports: Semaphore,
}

/// Serves the page until it is interrupted.
pub(crate) fn run(args: &StudioArgs) -> anyhow::Result<()> {
    let output = args.output.clone().unwrap_or_else(|| PathBuf::from(FOLDER));
    centrode::export::check_folder(&output)?;
    if args.output.is_some() {
        centrode::export::prepare_folder(&output)?;
    }
    let drawings = Drawings::default();
    let given = args.files.iter().map(|f| given(f, &drawings)).collect::<anyhow::Result<_>>()?;
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .worker_threads(2)
        .enable_all()
        .build()
        .context("the server cannot be started")?;
    runtime.block_on(async {
        let listener = listen(args.port).await?;
        let port = listener.local_addr()?.port();
        let guard = Guard::new(token(&output)?, port);
        let app = Arc::new(App {
            guard,
            drawings,
            given,
            output: output.clone(),
            finished: Finished::default(),
            tabs: Arc::new(Semaphore::new(TABS)),
            exports: Semaphore::new(1),
        });
        let address = app.guard.address();
        println!("{address}");
        eprintln!("Centrode Studio is at the address above; Ctrl-C ends it");
        if !args.no_open {
            open(&address);
        }
        tokio::select! {
            () = server::serve(listener, Arc::clone(&app)) => {}
            _ = tokio::signal::ctrl_c() => {}
        }
        Ok::<_, anyhow::Error>(())
    })?;
    // Work that is under way is of no use to anybody.
    runtime.shutdown_background();
    Ok(())
}

/// A drawing of the command line: a file, read now, or a built-in name.
fn given(source: &str, drawings: &Drawings) -> anyhow::Result<DrawingRef> {
    let path = Path::new(source);
    if library::svg(source).is_some() && !path.is_file() {
        return Ok(DrawingRef { name: source.to_owned(), id: None });
    }
    let (name, bytes) = drawings::from_file(path)?;
    let id = Some(drawings.keep(&name, &bytes));
    Ok(DrawingRef { name, id })
}

async fn listen(port: Option<u16>) -> anyhow::Result<TcpListener> {
    let at = |port| TcpListener::bind(SocketAddr::from((Ipv4Addr::LOCALHOST, port)));
    if let Some(port) = port {
        return at(port).await.map_err(|e| {
            anyhow!("port {port} cannot be used ({e}); name another with --port, or leave it out")
        });
    }
    for port in PORT..PORT + PORTS {
        if let Ok(listener) = at(port).await {
            return Ok(listener);
        }
    }
    at(0).await.context("no port of this machine can be used")
}

/// The token of an earlier run in the same folder, or a new one. Kept where a folder is there to keep it in.
fn token(output: &Path) -> anyhow::Result<String> {
    let path = output.join(TOKEN_FILE);
    if let Ok(text) = std::fs::read_to_string(&path)
        && guard::is_token(text.trim())
    {
        return Ok(text.trim().to_owned());
    }
    let token = guard::random_token()?;
    keep_token(output, &token);
    Ok(token)
}

/// Keeps the token in the output folder, if there is one yet. Without it a page has to be opened anew, and nothing else.
fn keep_token(output: &Path, token: &str) {
    if output.is_dir() {
        let mut options = std::fs::OpenOptions::new();
        options.write(true).create(true).truncate(true);
        #[cfg(unix)]
        std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
        let _ = options
            .open(output.join(TOKEN_FILE))
            .and_then(|mut file| std::io::Write::write_all(&mut file, token.as_bytes()));
    }
}

/// Opens the page in the browser of this desktop, if there is one.
fn open(address: &str) {
    let desktop = |name| std::env::var_os(name).is_some_and(|v| !v.is_empty());
    let opener: &[&str] = if cfg!(target_os = "macos") {
        &["open"]
    } else if cfg!(windows) {
        &["cmd", "/C", "start", ""]
    } else if desktop("DISPLAY") || desktop("WAYLAND_DISPLAY") {
        &["xdg-open"]
    } else {
        return;
    };
    let quiet = Stdio::null;
    // The address is printed; whoever has no browser opens it by hand.
    let _ = Command::new(opener[0])
        .args(&opener[1..])
        .arg(address)
        .stdin(quiet())
        .stdout(quiet())
        .stderr(quiet())
        .spawn();
}
