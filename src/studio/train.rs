//! Trains of the pair that a state makes: how their gears stand while they are put together, and their files.

use std::sync::Arc;

use axum::Json;
use axum::extract::State as Shared;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use serde_json::{Value, json};

use super::App;
use super::away::{self, Place};
use super::engine::{Engine, Stopped};
use super::protocol::{BadMessage, State};
use super::{wire, words};
use crate::cli::plan::plan;
use crate::cli::studio::train_files;
use centrode::assembly::{Bent, Layout, Link, PairModel, Train, TrainError, TrainGear, TrainPlan};
use centrode::export::{Staging, write_json};
use centrode::gear::Side;
use centrode::pipeline::Design;
use centrode::policy;
use centrode::schema::{RECORD_NAME, Record};

/// Angles of a gear that the page is told over one cycle.
const SAMPLES: usize = 1440;
/// Bend of the zig-zag that is shown where no bend serves, radians: something to drag from.
const SHOWN_BEND: f64 = 0.5;
/// The train's own file beside the files of its gears.
const PLAN_NAME: &str = "train.toml";

/// How the gears follow each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Row {
    Auto,
    Straight,
    Zigzag,
    Arc,
    Ring,
    Free,
}

impl Row {
    /// As the command line has it; none for gears put by hand, which need a file.
    fn word(self) -> Option<&'static str> {
        Some(match self {
            Self::Auto => "auto",
            Self::Straight => "straight",
            Self::Zigzag => "zigzag",
            Self::Arc => "arc",
            Self::Ring => "ring",
            Self::Free => return None,
        })
    }
}

/// A gear put by hand.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Hung {
    /// The gear that it meshes with, by number.
    on: usize,
    /// Direction from that gear's axis to its own, degrees.
    direction: f64,
}

/// What is asked for.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Wish {
    layout: Row,
    gears: usize,
    #[serde(default)]
    links: Vec<Hung>,
}

/// A train of the pair of a state.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Order {
    state: State,
    train: Wish,
    #[serde(default)]
    formats: Vec<String>,
    /// Where its files go; without it the page is only told how the gears stand.
    #[serde(default)]
    place: Option<Place>,
}

impl Order {
    /// Refuses what no page would send.
    pub(super) fn check(&self) -> Result<(), BadMessage> {
        self.state.check()?;
        away::few(&self.formats)?;
        match self.train.links.len() {
            0..=policy::TRAIN_MOST_GEARS => Ok(()),
            count => Err(BadMessage::Options(count)),
        }
    }

    /// What it is of.
    pub(super) fn state(&self) -> &State {
        &self.state
    }
}

/// Carries an order out.
pub(super) async fn train(Shared(app): Shared<Arc<App>>, Json(order): Json<Order>) -> Response {
    if let Err(error) = order.check() {
        return away::refused(&error.to_string());
    }
    let turn = match order.place {
        Some(_) => app.exports.acquire().await.ok(),
        None => None,
    };
    let worker = Arc::clone(&app);
    let done = tokio::task::spawn_blocking(move || carried_out(&worker, &order)).await;
    drop(turn);
    match done {
        Ok(Ok(answer)) => answer,
        Ok(Err(text)) => away::refused(&text),
        Err(_) => away::refused("the train could not be made; report this as a bug"),
    }
}

fn carried_out(app: &App, order: &Order) -> Result<Response, String> {
    let given = words::typed(&order.state, &app.output.to_string_lossy());
    let planned = plan(&given).map_err(|b| b.text)?;
    let made = Engine::default()
        .finished((&app.drawings, &app.finished), &order.state, &planned)
        .map_err(|stopped| match stopped {
        Stopped::Refused { text, .. } => text,
        Stopped::Missing(_) | Stopped::Newer => "open the drawing again".to_owned(),
    })?;
    match order.place {
        Some(place) => files(app, order, &made, place),
        None => stands(&made, &order.train).map(|value| Json(value).into_response()),
    }
}

fn model(made: &Design) -> Result<PairModel, String> {
    let [driver, follower] = made.assembly.gears.as_slice() else {
        return Err("this pair has more than two gears; make a plain pair first".to_owned());
    };
    Ok(PairModel {
        gears: [driver.gear.clone(), follower.gear.clone()].into(),
        motion: made.assembly.motion().map_err(|e| e.to_string())?,
        center_distance: made.centrodes.center_distance,
        module: made.pair.module,
    })
}

/// The plan that a wish comes to, and what is wrong with it.
fn planned(
    pair: &PairModel,
    wish: &Wish,
    thickness: f64,
) -> Result<(TrainPlan, Train, Option<TrainError>), TrainError> {
    let chain = |layout| TrainPlan::chain(pair.clone(), wish.gears, layout, thickness);
    let bent = |layouts: &[Bent]| match TrainPlan::bent(pair, wish.gears, layouts, thickness) {
        Ok(best) => Ok((best.plan, best.train, None)),
        Err(error @ (TrainError::Collision { .. } | TrainError::TooFast { .. })) => {
            let plan = chain(Layout::ZigZag(SHOWN_BEND))?;
            let train = plan.placed()?;
            Ok((plan, train, Some(error)))
        }
        Err(error) => Err(error),
    };
    let plan = match wish.layout {
        Row::Auto => return bent(&[Layout::ZigZag, Layout::Arc]),
        Row::Zigzag => return bent(&[Layout::ZigZag]),
        Row::Arc => return bent(&[Layout::Arc]),
        Row::Straight => chain(Layout::Straight)?,
        Row::Ring => TrainPlan::ring(pair, wish.gears, thickness)?,
        Row::Free => hung(pair, &wish.links, thickness),
    };
    let train = plan.placed()?;
    let fault = plan.judge(&train).err();
    Ok((plan, train, fault))
}

/// Gears put by hand.
fn hung(pair: &PairModel, links: &[Hung], thickness: f64) -> TrainPlan {
    let mut gears: Vec<TrainGear> = Vec::new();
    for i in 0..=links.len() {
        let link = i.checked_sub(1).and_then(|k| links.get(k));
        let side = link
            .and_then(|l| gears.get(l.on))
            .map_or(Side::Driver, |on: &TrainGear| on.side.partner());
        gears.push(TrainGear {
            name: name(i),
            pair: 0,
            side,
            link: link.map(|l| (l.on, Link::Mesh { direction: l.direction.to_radians() })),
        });
    }
    TrainPlan { pairs: vec![pair.clone()], gears, closing: Vec::new(), thickness }
}

fn name(number: usize) -> String {
    format!("gear{:02}", number + 1)
}

/// How the gears stand and turn, for the page.
fn stands(made: &Design, wish: &Wish) -> Result<Value, String> {
    let pair = model(made)?;
    if !wish.links.iter().all(|l| l.direction.abs() <= 3600.0) {
        return Err("a direction is no number of degrees; drag the gear again".to_owned());
    }
    let (plan, train, fault) =
        planned(&pair, wish, made.assembly.thickness).map_err(|e| e.to_string())?;
    let clash = match &fault {
        Some(TrainError::Collision { first, second, .. }) => {
            let at = |name: &String| plan.gears.iter().position(|g| g.name == *name);
            at(first).zip(at(second)).map(|(a, b)| [a, b])
        }
        _ => None,
    };
    let at = match &fault {
        Some(TrainError::Collision { at, .. } | TrainError::TooFast { at, .. }) => Some(*at),
        _ => None,
    };
    let assembly = &train.assembly;
    let stride = assembly.driver_angle.len().div_ceil(SAMPLES).max(1);
    let gears: Vec<Value> = assembly
        .gears
        .iter()
        .zip(&plan.gears)
        .map(|(placed, gear)| {
            let model = &pair.gears[gear.side];
            let direction = |points: &[centrode::geometry::Point]| {
                points.first().map_or(0.0, |p| p.y.atan2(p.x))
            };
            json!({
                "name": gear.name,
                "side": gear.side.name(),
                "axis": wire::point(placed.axis),
                // The gear's outline in the page is that of the pair; here it is turned by this much.
                "start": direction(&placed.gear.outline) - direction(&model.outline),
                "angle": placed.angle.iter().step_by(stride).map(|a| wire::rounded(*a, 1e5)).collect::<Vec<_>>(),
            })
        })
        .collect();
    let links: Vec<Value> = plan
        .gears
        .iter()
        .filter_map(|gear| match gear.link {
            Some((on, Link::Mesh { direction })) => {
                Some(json!({ "on": on, "direction": wire::rounded(direction.to_degrees(), 1e3) }))
            }
            _ => None,
        })
        .collect();
    let kept =
        assembly.driver_angle.iter().step_by(stride).next_back().copied().unwrap_or_default();
    Ok(json!({
        "gears": gears,
        "links": links,
        "meshes": assembly.meshes,
        "cycle": kept,
        "fault": fault.map(|f| f.to_string()),
        "clash": clash,
        "at": at,
    }))
}

/// A train's file: its pair in the same folder, and the gears that were put by hand.
fn train_file(plan: &TrainPlan) -> String {
    let mut text = format!("[pairs.pair]\ndesign = \"{RECORD_NAME}\"\n");
    for gear in &plan.gears {
        text.push_str(&format!(
            "\n[[gears]]\nname = \"{}\"\npair = \"pair\"\nrole = \"{}\"\n",
            gear.name,
            gear.side.name()
        ));
        if let Some((on, Link::Mesh { direction })) = gear.link {
            text.push_str(&format!(
                "on = \"{}\"\ndirection = {:?}\n",
                name(on),
                direction.to_degrees()
            ));
        }
    }
    text
}

/// The files of `centrode train`, with the pair that they are made of.
fn files(app: &App, order: &Order, made: &Design, place: Place) -> Result<Response, String> {
    let told = |error: anyhow::Error| crate::cli::told(&error);
    let wish = &order.train;
    // In a folder of its own: a hidden one in the output folder is for the files of the train.
    let own = Staging::new(&app.output.join("train")).map_err(|e| e.to_string())?;
    let record = own.path().join(RECORD_NAME);
    write_json(&record, &Record::new(made)).map_err(|e| e.to_string())?;
    let mut beside = vec![record];
    let mut given = vec!["centrode".to_owned(), "train".to_owned()];
    given.push(format!("--output={}", app.output.to_string_lossy()));
    if !order.formats.is_empty() {
        given.push(format!("--export={}", order.formats.join(",")));
    }
    let path = match wish.layout.word() {
        Some(layout) => {
            given.push(format!("--layout={layout}"));
            given.push(format!("--gears={}", wish.gears));
            own.path().to_owned()
        }
        None => {
            let pair = model(made)?;
            let path = own.path().join(PLAN_NAME);
            std::fs::write(&path, train_file(&hung(&pair, &wish.links, made.assembly.thickness)))
                .map_err(|e| format!("the train's file cannot be written ({e})"))?;
            beside.push(path.clone());
            path
        }
    };
    given.extend(["--".to_owned(), path.to_string_lossy().into_owned()]);
    let (staging, mut files) = train_files(&given).map_err(told)?;
    for path in beside {
        let copy = staging.path().join(path.file_name().unwrap_or_default());
        std::fs::rename(&path, &copy).map_err(|e| format!("the files are gone ({e})"))?;
        files.push(copy);
    }
    away::handed_over(app, staging, &files, place, "train")
}

#[cfg(test)]
mod tests {
    use super::super::example::pair;
    use super::*;

    fn wish(text: &str) -> Wish {
        serde_json::from_str(text).unwrap()
    }

    #[test]
    fn gears_stand_in_a_row_where_they_are_put_and_collisions_are_told() {
        let made = pair();
        let row = stands(&made, &wish(r#"{"layout":"straight","gears":4}"#)).unwrap();
        assert_eq!(row["gears"].as_array().unwrap().len(), 4);
        assert_eq!(row["fault"], Value::Null);
        let x = row["gears"][3]["axis"][0].as_f64().unwrap();
        assert!((x - 3.0 * made.centrodes.center_distance).abs() < 1e-3, "{x}");
        // The third gear comes back to where the first one stands.
        let folded = r#"{"layout":"free","gears":3,"links":[{"on":0,"direction":0},{"on":1,"direction":170}]}"#;
        let folded = stands(&made, &wish(folded)).unwrap();
        assert_eq!(folded["clash"], json!([0, 2]));
        assert!(folded["fault"].is_string());
        let unknown = r#"{"layout":"free","gears":3,"links":[{"on":7,"direction":0}]}"#;
        assert!(stands(&made, &wish(unknown)).is_err());
        assert!(stands(&made, &wish(r#"{"layout":"straight","gears":0}"#)).is_err());
    }

    #[test]
    fn a_train_put_by_hand_reads_back_from_its_file() {
        let made = pair();
        let folder = tempfile::tempdir().unwrap();
        write_json(&folder.path().join(RECORD_NAME), &Record::new(&made)).unwrap();
        let links = [Hung { on: 0, direction: 12.5 }, Hung { on: 0, direction: -140.0 }];
        let plan = hung(&model(&made).unwrap(), &links, made.assembly.thickness);
        let path = folder.path().join(PLAN_NAME);
        std::fs::write(&path, train_file(&plan)).unwrap();
        let read = centrode::schema::read_train(&path).unwrap();
        assert_eq!(read.gears.len(), plan.gears.len());
        for (a, b) in read.gears.iter().zip(&plan.gears) {
            assert_eq!((&a.name, a.side), (&b.name, b.side));
        }
        assert!(read.placed().is_ok());
    }
}
