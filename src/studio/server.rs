//! What is asked over HTTP and what is answered.

use std::sync::Arc;
use std::time::Duration;

use axum::Json;
use axum::body::{Body, Bytes};
use axum::extract::ws::WebSocketUpgrade;
use axum::extract::{DefaultBodyLimit, Query, Request, State as Shared};
use axum::http::{HeaderValue, Method, StatusCode, Uri, header};
use axum::middleware::{Next, from_fn_with_state};
use axum::response::{IntoResponse, Response};
use axum::routing::{any, get, post};
use axum::{Router, middleware};
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use serde::Deserialize;
use serde_json::json;
use tokio::net::TcpListener;
use tokio::sync::Semaphore;

use super::guard::{HEADERS, Refusal};
use super::{App, assets, away, controls, drawings, protocol, records, tab, train, wire};
use centrode::outline::library;

/// Connections at a time; more wait in the system's queue.
const CONNECTIONS: usize = 200;
/// Time in which the headers of a request must be here.
const HEADER_TIME: Duration = Duration::from_secs(10);
/// Time in which an upload must be here.
const BODY_TIME: Duration = Duration::from_secs(60);

/// Serves until the task is dropped.
pub(super) async fn serve(listener: TcpListener, app: Arc<App>) {
    let service = TowerToHyperService::new(router(app));
    let places = Arc::new(Semaphore::new(CONNECTIONS));
    loop {
        let Ok(place) = Arc::clone(&places).acquire_owned().await else { return };
        // A failed accept concerns that connection, or passes.
        let Ok((stream, _)) = listener.accept().await else {
            tokio::time::sleep(Duration::from_millis(20)).await;
            continue;
        };
        // Small answers should not wait for more.
        let _ = stream.set_nodelay(true);
        let service = service.clone();
        tokio::spawn(async move {
            let connection = hyper::server::conn::http1::Builder::new()
                .timer(TokioTimer::new())
                .header_read_timeout(HEADER_TIME)
                .serve_connection(TokioIo::new(stream), service)
                .with_upgrades();
            // What the other end breaks off is its own business.
            let _ = connection.await;
            drop(place);
        });
    }
}

fn router(app: Arc<App>) -> Router {
    let inside = Router::new()
        .route("/api/begin", get(begin))
        .route("/api/drawing", post(drawing).get(drawing_again))
        .route("/api/mirror", post(mirror))
        .route("/api/export", post(away::export))
        .route("/api/train", post(train::train))
        .route("/api/open", post(open))
        .route("/api/texts", post(away::texts))
        .route("/api/socket", any(socket))
        .fallback(page)
        .layer(middleware::from_fn(in_time))
        .layer(DefaultBodyLimit::max(drawings::LARGEST))
        .with_state(Arc::clone(&app));
    // A layer runs after its own router has chosen: the token comes off before the inner one sees the path.
    Router::new().fallback_service(inside).layer(from_fn_with_state(app, admitted))
}

/// Refuses foreigners, and takes the token off the path of everybody else.
async fn admitted(Shared(app): Shared<Arc<App>>, request: Request, next: Next) -> Response {
    let mut answer = match app.guard.admit(request.headers(), request.uri().path()) {
        Ok(rest) => {
            let target = match request.uri().query() {
                Some(query) => format!("/{rest}?{query}"),
                None => format!("/{rest}"),
            };
            match target.parse::<Uri>() {
                Ok(uri) => {
                    let mut request = request;
                    *request.uri_mut() = uri;
                    next.run(request).await
                }
                Err(_) => StatusCode::BAD_REQUEST.into_response(),
            }
        }
        Err(Refusal::Token) => {
            (StatusCode::NOT_FOUND, "not found; open the address that centrode studio printed\n")
                .into_response()
        }
        Err(Refusal::Host | Refusal::Origin) => {
            (StatusCode::FORBIDDEN, "refused\n").into_response()
        }
    };
    for (name, value) in HEADERS {
        answer.headers_mut().insert(name, HeaderValue::from_static(value));
    }
    answer
}

/// Gives up on bodies that do not arrive.
async fn in_time(request: Request, next: Next) -> Response {
    if request.method() != Method::POST {
        return next.run(request).await;
    }
    let (parts, body) = request.into_parts();
    let whole = axum::body::to_bytes(body, drawings::LARGEST);
    match tokio::time::timeout(BODY_TIME, whole).await {
        Ok(Ok(bytes)) => next.run(Request::from_parts(parts, Body::from(bytes))).await,
        Ok(Err(_)) => StatusCode::PAYLOAD_TOO_LARGE.into_response(),
        Err(_) => StatusCode::REQUEST_TIMEOUT.into_response(),
    }
}

/// A file of the page, or the drawing of a built-in shape.
async fn page(request: Request) -> Response {
    if request.method() != Method::GET {
        return StatusCode::METHOD_NOT_ALLOWED.into_response();
    }
    let path = request.uri().path().trim_start_matches('/');
    if let Some(name) = path.strip_prefix("shapes/").and_then(|p| p.strip_suffix(".svg"))
        && let Some(svg) = library::svg(name)
    {
        return ([(header::CONTENT_TYPE, "image/svg+xml")], svg).into_response();
    }
    match assets::find(path) {
        Some((content, kind)) => ([(header::CONTENT_TYPE, kind)], content).into_response(),
        None => StatusCode::NOT_FOUND.into_response(),
    }
}

/// All that the page must know at first.
async fn begin(Shared(app): Shared<Arc<App>>) -> Response {
    let command = <crate::cli::Cli as clap::CommandFactory>::command();
    let of = |way| controls::of(way, &command);
    Json(json!({
        "version": env!("CARGO_PKG_VERSION"),
        "shapes": library::names().collect::<Vec<_>>(),
        "given": app.given,
        "folder": app.output,
        "formats": wire::formats(),
        "largest_drawing": drawings::LARGEST,
        "controls": {
            "design": of(protocol::Way::Design),
            "mate": of(protocol::Way::Mate),
            "motion": of(protocol::Way::Motion),
        },
    }))
    .into_response()
}

#[derive(Debug, Deserialize)]
struct Named {
    name: String,
}

/// Takes a drawing.
async fn drawing(
    Shared(app): Shared<Arc<App>>,
    Query(Named { name }): Query<Named>,
    bytes: Bytes,
) -> Response {
    // Only the last part of a path, and no more of it than a file's name may have.
    let name: String =
        name.rsplit(['/', '\\']).next().unwrap_or_default().chars().take(200).collect();
    let kept = tokio::task::spawn_blocking(move || {
        let id = app.drawings.keep(&name, &bytes);
        let wanted = protocol::DrawingRef { name, id: Some(id.clone()) };
        match app.drawings.shape(&wanted, &centrode::input::LoadOptions::default()) {
            Ok(_) => Ok(id),
            Err(error) => Err(error.to_string()),
        }
    });
    match kept.await {
        Ok(Ok(id)) => Json(json!({ "id": id })).into_response(),
        Ok(Err(text)) => {
            (StatusCode::UNPROCESSABLE_ENTITY, Json(json!({ "text": text }))).into_response()
        }
        Err(_) => StatusCode::UNPROCESSABLE_ENTITY.into_response(),
    }
}

#[derive(Debug, Deserialize)]
struct Kept {
    id: String,
}

/// Gives a drawing back, so that the page can keep it.
async fn drawing_again(Shared(app): Shared<Arc<App>>, Query(Kept { id }): Query<Kept>) -> Response {
    match app.drawings.bytes(&id) {
        Some(bytes) => {
            ([(header::CONTENT_TYPE, "application/octet-stream")], bytes.to_vec()).into_response()
        }
        None => StatusCode::NOT_FOUND.into_response(),
    }
}

/// Keeps the mirror image of a drawing as points; says what it is called.
async fn mirror(
    Shared(app): Shared<Arc<App>>,
    Json(drawing): Json<protocol::DrawingRef>,
) -> Response {
    match tokio::task::spawn_blocking(move || app.drawings.mirrored(&drawing)).await {
        Ok(Ok(mirrored)) => Json(json!(mirrored)).into_response(),
        Ok(Err(error)) => {
            (StatusCode::UNPROCESSABLE_ENTITY, Json(json!({ "text": error.to_string() })))
                .into_response()
        }
        Err(_) => StatusCode::UNPROCESSABLE_ENTITY.into_response(),
    }
}

/// Reads a scene or the record of a design; answers with the state it describes.
async fn open(Shared(app): Shared<Arc<App>>, text: String) -> Response {
    let read = tokio::task::spawn_blocking(move || {
        if text.trim_start().starts_with('{') {
            return records::opened(&text, &app.drawings);
        }
        super::words::opened(&text).map_err(|error| crate::cli::told(&error))
    });
    match read.await {
        Ok(Ok(state)) => Json(json!(state)).into_response(),
        Ok(Err(text)) => away::refused(&text),
        Err(_) => StatusCode::UNPROCESSABLE_ENTITY.into_response(),
    }
}

/// The socket of a tab.
async fn socket(Shared(app): Shared<Arc<App>>, upgrade: WebSocketUpgrade) -> Response {
    let Ok(place) = Arc::clone(&app.tabs).try_acquire_owned() else {
        return StatusCode::TOO_MANY_REQUESTS.into_response();
    };
    upgrade
        .max_message_size(protocol::LONGEST_MESSAGE)
        .max_frame_size(protocol::LONGEST_MESSAGE)
        .on_upgrade(move |socket| async move {
            tab::serve(socket, app).await;
            drop(place);
        })
}
