//! Files to take away: one, many in a zip, or written to the folder that the command line gave.

use std::collections::BTreeMap;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};

use axum::Json;
use axum::extract::State as Shared;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use serde_json::json;
use std::sync::Arc;
use zip::write::SimpleFileOptions;

use super::engine::{Engine, Stopped};
use super::protocol::{BadMessage, State};
use super::{App, words};
use crate::cli::plan::{command_text, plan};
use crate::cli::studio::scene_text;
use centrode::export::Staging;

/// Bytes that the names of all formats wanted may have together.
const MOST_FORMATS: usize = 400;

/// Where files go.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Place {
    /// Into the browser: the file itself where there is one, else a zip.
    Download,
    /// Into the output folder.
    Folder,
}

/// What is asked for.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Order {
    state: State,
    /// Names of formats; none are all that the command writes by itself.
    #[serde(default)]
    formats: Vec<String>,
    /// One file of them.
    #[serde(default)]
    file: Option<String>,
    place: Place,
}

impl Order {
    /// Refuses what no page would send.
    pub(super) fn check(&self) -> Result<(), BadMessage> {
        self.state.check()?;
        few(&self.formats)
    }

    /// What it is of.
    pub(super) fn state(&self) -> &State {
        &self.state
    }
}

/// Refuses lists of formats that no page would send.
pub(super) fn few(formats: &[String]) -> Result<(), BadMessage> {
    match formats.iter().map(String::len).sum::<usize>() {
        0..=MOST_FORMATS => Ok(()),
        _ => Err(BadMessage::Options(formats.len())),
    }
}

/// Carries an order out.
pub(super) async fn export(Shared(app): Shared<Arc<App>>, Json(order): Json<Order>) -> Response {
    if let Err(error) = order.check() {
        return refused(&error.to_string());
    }
    let Ok(_turn) = app.exports.acquire().await else { return refused("the studio is closing") };
    let worker = Arc::clone(&app);
    match tokio::task::spawn_blocking(move || carried_out(&worker, &order)).await {
        Ok(Ok(answer)) => answer,
        Ok(Err(text)) => refused(&text),
        Err(_) => refused("the files could not be made; report this as a bug"),
    }
}

pub(super) fn refused(text: &str) -> Response {
    (StatusCode::UNPROCESSABLE_ENTITY, Json(json!({ "text": text }))).into_response()
}

fn carried_out(app: &App, order: &Order) -> Result<Response, String> {
    let said = |stopped: Stopped| match stopped {
        Stopped::Refused { text, .. } => text,
        Stopped::Missing(_) | Stopped::Newer => "open the drawing again".to_owned(),
    };
    let folder = app.output.to_string_lossy();
    let mut state = order.state.clone();
    state.options.remove("export");
    let mut given = words::typed(&state, &folder);
    if !order.formats.is_empty() {
        given.push(format!("--export={}", order.formats.join(",")));
    }
    let plan = plan(&given).map_err(|b| b.text)?;
    let made = Engine::default()
        .finished((&app.drawings, &app.finished), &order.state, &plan)
        .map_err(said)?;
    let (staging, files) = plan.files(&made, &given, &app.output).map_err(|b| b.text)?;
    if let Some(wanted) = order.file.as_ref().filter(|_| order.place == Place::Download) {
        let path = files.iter().find(|f| name_of(f) == *wanted);
        let path = path.ok_or_else(|| format!("no format writes {wanted}; choose another"))?;
        return Ok(download(wanted, kind_of(wanted), bytes_of(path)?));
    }
    let title: Vec<String> = made.names.iter().map(|n| plain_name(n)).collect();
    handed_over(app, staging, &files, order.place, &title.join("-"))
}

/// Files that stand in a hidden folder, moved to the output folder or sent as a zip.
pub(super) fn handed_over(
    app: &App,
    staging: Staging,
    files: &[PathBuf],
    place: Place,
    title: &str,
) -> Result<Response, String> {
    if place == Place::Folder {
        let published = staging.publish(files).map_err(|e| e.to_string())?;
        super::keep_token(&app.output, app.guard.token());
        let names: Vec<String> = published.iter().map(|p| name_of(p)).collect();
        let answer = json!({ "folder": app.output, "files": names });
        return Ok(Json(answer).into_response());
    }
    let mut contents = BTreeMap::new();
    for path in files {
        contents.insert(name_of(path), bytes_of(path)?);
    }
    let bytes = zipped(&contents).map_err(|e| format!("the zip cannot be made ({e})"))?;
    Ok(download(&format!("{title}.zip"), "application/zip", bytes))
}

fn bytes_of(path: &Path) -> Result<Vec<u8>, String> {
    std::fs::read(path).map_err(|e| format!("the files are gone ({e})"))
}

fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// Letters, digits and hyphens only.
fn plain_name(name: &str) -> String {
    let kept: String =
        name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).take(40).collect();
    let kept = kept.trim_matches('-');
    if kept.is_empty() { "gear".to_owned() } else { kept.to_owned() }
}

fn zipped(contents: &BTreeMap<String, Vec<u8>>) -> zip::result::ZipResult<Vec<u8>> {
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in contents {
        zip.start_file(name.as_str(), SimpleFileOptions::default())?;
        zip.write_all(bytes)?;
    }
    Ok(zip.finish()?.into_inner())
}

fn kind_of(name: &str) -> &'static str {
    match Path::new(name).extension().and_then(|e| e.to_str()) {
        Some("glb") => "model/gltf-binary",
        Some("svg") => "image/svg+xml",
        Some("html") => "text/html",
        Some("json") => "application/json",
        _ => "application/octet-stream",
    }
}

fn download(name: &str, kind: &'static str, bytes: Vec<u8>) -> Response {
    let disposition = format!("attachment; filename=\"{}\"", name.replace(['"', '\\'], "-"));
    ([(header::CONTENT_TYPE, kind.to_owned()), (header::CONTENT_DISPOSITION, disposition)], bytes)
        .into_response()
}

/// The command line and the scene of a state.
pub(super) async fn texts(Shared(app): Shared<Arc<App>>, Json(state): Json<State>) -> Response {
    if state.check().is_err() {
        return refused("the state is too long; reload the page");
    }
    let given = words::typed(&state, &app.output.to_string_lossy());
    if let Err(blamed) = plan(&given) {
        return refused(&blamed.text);
    }
    let scene = scene_text(&given).unwrap_or_default();
    Json(json!({ "command": command_text(&given), "scene": scene })).into_response()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_zip_holds_what_was_put_in() {
        let contents = BTreeMap::from([("a.txt".to_owned(), b"one".to_vec())]);
        let bytes = zipped(&contents).unwrap();
        let mut zip = zip::ZipArchive::new(Cursor::new(bytes)).unwrap();
        let mut text = String::new();
        std::io::Read::read_to_string(&mut zip.by_name("a.txt").unwrap(), &mut text).unwrap();
        assert_eq!(text, "one");
    }

    #[test]
    fn names_of_downloads_are_plain() {
        assert_eq!(plain_name("psi' = 1 + \"x\"/../"), "psi----1----x");
        assert_eq!(plain_name("///"), "gear");
    }
}
