//! The work of one tab: a state in, stages out, each as soon as it stands.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use centrode::control::{Control, StageName};
use centrode::fit::{self, Fit, FitError, FitOptions, Fitter, Fixed, LimitError, Ratio};
use centrode::geometry::{self, Point};
use centrode::input::{LoadOptions, Shape};
use centrode::pipeline::{
    Design, DesignOptions, PipelineError, Request, Scale, Session, ToothCount,
};
use centrode::pitch::{Centrodes, Transmission};
use centrode::teeth::{self, TeethOptions};
use serde_json::{Value, json};

use super::drawings::{DrawingError, Drawings};
use super::protocol::{DrawingRef, Remedy, Stage, State, Told};
use super::{wire, words};
use crate::cli::plan::{Blamed, Origin, Plan, plan};

/// Teeth that a picture is drawn with while their number is still being chosen.
const TEETH_AT_FIRST: u32 = 40;
/// Points of a pitch curve whose extent is measured.
const EXTENT_POINTS: usize = 360;

/// Whatever stops the work on a state.
#[derive(Debug)]
pub(super) enum Stopped {
    /// A newer state is there.
    Newer,
    /// A drawing must be sent again.
    Missing(String),
    /// It cannot be made.
    Refused { option: Option<String>, text: String, remedy: Option<Remedy> },
}

impl From<Blamed> for Stopped {
    fn from(blamed: Blamed) -> Self {
        Self::Refused { option: blamed.option, text: blamed.text, remedy: None }
    }
}

impl From<DrawingError> for Stopped {
    fn from(error: DrawingError) -> Self {
        match error {
            DrawingError::Missing(id) => Self::Missing(id),
            DrawingError::Load(error) => {
                Self::Refused { option: None, text: error.to_string(), remedy: None }
            }
        }
    }
}

impl From<PipelineError> for Stopped {
    fn from(error: PipelineError) -> Self {
        let text = error.to_string();
        let (option, remedy) = match &error {
            PipelineError::Option { name, .. } => (option_named(name), None),
            PipelineError::Fit(error) => blamed_of_fit(error),
            PipelineError::Limit(error) => blamed_of_limit(error),
            PipelineError::Outfit(_) => (Some("outfit"), None),
            PipelineError::Solid(_) => (Some("bore"), None),
            _ => (None, None),
        };
        Self::Refused { option: option.map(str::to_owned), text, remedy }
    }
}

impl From<FitError> for Stopped {
    fn from(error: FitError) -> Self {
        PipelineError::Fit(error).into()
    }
}

fn blamed_of_fit(error: &FitError) -> (Option<&'static str>, Option<Remedy>) {
    match error {
        FitError::Balance { .. } => (Some("balance"), None),
        FitError::Weight { .. } => (Some("torque-weight"), None),
        FitError::StarWeight { .. } => (Some("star-weight"), None),
        FitError::Rational { .. } => (Some("ratio"), None),
        FitError::Symmetric { .. } => (Some("symmetric"), None),
        FitError::Limit(error) => blamed_of_limit(error),
        _ => (None, None),
    }
}

fn blamed_of_limit(error: &LimitError) -> (Option<&'static str>, Option<Remedy>) {
    match error {
        LimitError::TorqueBelowMean { mean, .. } => {
            let value = format!("{:.2}", mean * 1.2);
            (Some("max-torque"), Some(Remedy { option: "max-torque".to_owned(), value }))
        }
        LimitError::LeanOutOfRange { .. } => (Some("max-lean"), None),
        _ => (None, None),
    }
}

fn option_named(name: &str) -> Option<&'static str> {
    Some(match name {
        "the centre distance" => "center-distance",
        "the size" => "size",
        "the thickness" => "thickness",
        "the load" => "load",
        "the speed" => "rpm",
        "the friction" => "friction",
        "the clearance" => "clearance",
        "the backlash" => "backlash",
        "the root clearance" => "root-clearance",
        "the chord tolerance" => "chord-tolerance",
        "the pressure angle" => "pressure-angle",
        "the addendum" => "addendum",
        "the number of teeth" | "the number of driver teeth" | "the number of follower teeth" => {
            "teeth"
        }
        _ => return None,
    })
}

/// What a tab remembers from one state to the next.
#[derive(Debug, Default)]
pub(super) struct Engine {
    shapes: Vec<(DrawingRef, LoadOptions, Arc<Shape>)>,
    fitted: Option<Known>,
    teeth: Option<u32>,
    told: Option<Vec<(DrawingRef, LoadOptions)>>,
    /// Keeps what it found of the last shapes.
    fitter: Fitter,
    /// Keeps the stages of the last requests.
    session: Session,
    /// What the other pairs were found for that the page shows.
    offered: Option<Offered>,
}

/// What other pairs were found for: drawings, ratio, options.
type Offered = (Vec<(DrawingRef, LoadOptions)>, Ratio, FitOptions);

/// Pairs kept for whoever takes their files away.
const FINISHED_KEPT: usize = 12;

/// The pairs that were proven last.
#[derive(Debug, Default)]
pub(super) struct Finished(Mutex<VecDeque<(State, Arc<Design>)>>);

impl Finished {
    fn keep(&self, state: &State, made: Arc<Design>) {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.retain(|(known, _)| known != state);
        kept.push_front((state.clone(), made));
        kept.truncate(FINISHED_KEPT);
    }

    fn find(&self, state: &State) -> Option<Arc<Design>> {
        let kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.iter().find(|(known, _)| known == state).map(|(_, made)| Arc::clone(made))
    }
}

/// A fit and what it was made from.
#[derive(Debug)]
struct Known {
    drawings: [DrawingRef; 2],
    load: LoadOptions,
    ratio: Ratio,
    options: FitOptions,
    fit: Fit,
}

/// Where news goes; false when nobody wants them any more.
pub(super) type Tell<'a> = &'a mut dyn FnMut(Told) -> bool;

/// Pairs to choose from.
const OFFERED: usize = 8;
/// Shapes that a tab keeps read.
const SHAPES_KEPT: usize = 8;

impl Engine {
    /// Makes a state, telling each stage, until it stands or `control` is cancelled.
    pub(super) fn make(
        &mut self,
        (drawings, finished): (&Drawings, &Finished),
        (generation, state, live): (u64, &State, bool),
        control: &Control,
        tell: Tell<'_>,
    ) {
        let outcome =
            self.stages((drawings, finished), state, live, control, &mut |stage, ms, data| {
                tell(Told::Stage { generation, stage, ms, data })
            });
        let told = match outcome {
            Ok(()) | Err(Stopped::Newer) => return,
            // Whatever the reason given, nobody asks for it any more.
            Err(_) if control.is_cancelled() => return,
            Err(Stopped::Missing(id)) => Told::Missing { generation, ids: vec![id] },
            Err(Stopped::Refused { option, text, remedy }) => {
                Told::Refused { generation, option, text, remedy }
            }
        };
        tell(told);
    }

    fn stages(
        &mut self,
        (drawings, finished): (&Drawings, &Finished),
        state: &State,
        live: bool,
        control: &Control,
        tell: &mut dyn FnMut(Stage, f64, Value) -> bool,
    ) -> Result<(), Stopped> {
        let start = Instant::now();
        let mut say = |stage, data| {
            let ms = 1e3 * start.elapsed().as_secs_f64();
            if tell(stage, ms, data) && !control.is_cancelled() {
                Ok(())
            } else {
                Err(Stopped::Newer)
            }
        };
        let plan = plan(&words::of(state, "out"))?;
        let wanted = wanted(state, &plan.origin)?;
        let shapes = self.shapes(drawings, &wanted, &plan.load)?;
        let seen = [shapes.first(), shapes.get(1)].map(|s| s.map(AsRef::as_ref));
        let now: Vec<_> = wanted.iter().map(|d| (d.clone(), plan.load)).collect();
        if self.told.as_ref() != Some(&now) {
            say(Stage::Read, wire::read(seen))?;
            self.told = Some(now);
        }
        let request = requested(&plan, &shapes)?;
        let sized = self.sized((&plan, &request), &wanted, seen, (live, control), &mut say)?;
        if live {
            let count = self.count(&plan.options, &sized);
            if let Some((pair, teeth)) = teeth_of(&sized, &plan.options, count, control) {
                say(Stage::Toothed, wire::toothed(&pair, teeth))?;
            }
            return Ok(());
        }
        let first = self.session.run(&request, StageName::Toothed, control)?;
        if let (Some(sized), Some(toothed)) = (&first.sized, &first.toothed) {
            let teeth = [sized.teeth.driver, sized.teeth.follower];
            say(Stage::Toothed, wire::toothed(&toothed.pair, teeth))?;
        }
        // Without runs first: all but the runs is kept for the second time.
        if !plan.options.runs.is_empty() {
            let quick = DesignOptions { runs: Vec::new(), ..plan.options.clone() };
            let made = self.design(&request.clone().with(quick), control)?;
            say(Stage::Analysed, wire::analysed(&made))?;
        }
        let made = self.design(&request, control)?;
        self.teeth = Some(made.teeth[0]);
        let data = wire::proven(&made);
        finished.keep(state, Arc::new(made));
        say(Stage::Proven, data)?;
        self.offer(&plan, seen, control, &mut say)
    }

    /// The whole pair, from what the session has.
    fn design(&mut self, request: &Request, control: &Control) -> Result<Design, Stopped> {
        let stages = self.session.run(request, StageName::Outfitted, control)?;
        Design::of(&stages).ok_or(Stopped::Newer)
    }

    /// Other pairs of the same drawings, unless the page has them.
    fn offer(
        &mut self,
        plan: &Plan,
        seen: [Option<&Shape>; 2],
        control: &Control,
        say: &mut dyn FnMut(Stage, Value) -> Result<(), Stopped>,
    ) -> Result<(), Stopped> {
        let (Origin::Two, [Some(driver), Some(follower)]) = (&plan.origin, seen) else {
            self.offered = None;
            return say(Stage::Alternatives, json!({ "pairs": [] }));
        };
        let options = &plan.options;
        let free = FitOptions { choose: None, ..options.fit.clone() };
        let now = (self.told.clone().unwrap_or_default(), options.ratio, free);
        if options.fit.symmetric || self.offered.as_ref() == Some(&now) {
            return Ok(());
        }
        let fits = self.fitter.alternatives(
            &driver.outline,
            &follower.outline,
            options.ratio,
            &now.2,
            OFFERED,
            control,
        )?;
        self.offered = Some(now);
        say(Stage::Alternatives, wire::alternatives(&fits, [driver, follower]))
    }

    /// The finished pair of a state, made now unless it was made last.
    pub(super) fn finished(
        &mut self,
        (drawings, finished): (&Drawings, &Finished),
        state: &State,
        plan: &Plan,
    ) -> Result<Arc<Design>, Stopped> {
        if let Some(made) = finished.find(state) {
            return Ok(made);
        }
        let wanted = wanted(state, &plan.origin)?;
        let shapes = self.shapes(drawings, &wanted, &plan.load)?;
        Ok(Arc::new(requested(plan, &shapes)?.design(Control::unwatched())?))
    }

    fn shapes(
        &mut self,
        drawings: &Drawings,
        wanted: &[DrawingRef],
        options: &LoadOptions,
    ) -> Result<Vec<Arc<Shape>>, Stopped> {
        let mut shapes = Vec::new();
        for drawing in wanted {
            let known = self.shapes.iter().find(|(d, o, _)| d == drawing && o == options);
            let shape = match known {
                Some((_, _, shape)) => Arc::clone(shape),
                None => {
                    let shape = Arc::new(drawings.shape(drawing, options)?);
                    if self.shapes.len() >= SHAPES_KEPT {
                        self.shapes.remove(0);
                    }
                    self.shapes.push((drawing.clone(), *options, Arc::clone(&shape)));
                    shape
                }
            };
            shapes.push(shape);
        }
        Ok(shapes)
    }

    /// Pitch curves: at once from what is known, then from the full search.
    fn sized(
        &mut self,
        (plan, request): (&Plan, &Request),
        wanted: &[DrawingRef],
        seen: [Option<&Shape>; 2],
        (live, control): (bool, &Control),
        say: &mut dyn FnMut(Stage, Value) -> Result<(), Stopped>,
    ) -> Result<Centrodes, Stopped> {
        let options = &plan.options;
        match (&plan.origin, seen) {
            (Origin::Two, [Some(driver), Some(follower)]) => {
                let drawings = [wanted[0].clone(), wanted[1].clone()];
                let known = self.fitted.as_ref().filter(|k| {
                    k.drawings == drawings
                        && k.load == plan.load
                        && k.ratio == options.ratio
                        && k.options == options.fit
                });
                let mut tell = |fit: &Fit, coarse| {
                    let centrodes = scaled(fit.transmission.clone(), options.scale);
                    let fitted = wire::Fitted {
                        shapes: seen,
                        drawings: [Some(fit.driver), Some(fit.follower)],
                        fit: Some(fit),
                    };
                    say(Stage::Sized, wire::sized(&centrodes, &fitted, coarse))?;
                    Ok::<_, Stopped>(centrodes)
                };
                if let Some(known) = known {
                    return tell(&known.fit, false);
                }
                let last = self
                    .fitted
                    .as_ref()
                    .filter(|k| {
                        k.drawings == drawings && k.load == plan.load && k.ratio == options.ratio
                    })
                    .map(|k| (k.fit.driver, k.fit.follower));
                // While something is dragged the follower's drawing keeps its turn: the gears follow the hand.
                let turn = last.filter(|_| live && !options.fit.symmetric);
                let orientation =
                    options.fit.fixed.orientation.or(turn.map(|(_, f)| f.placement.angle));
                let all_fixed = options.fit.fixed.driver_axis.is_some()
                    && options.fit.fixed.follower_axis.is_some();
                if !all_fixed {
                    let coarse = FitOptions { refine: false, choose: None, ..options.fit.clone() };
                    let coarse = match last {
                        // Where the axes are now is where they stay while something is dragged.
                        Some((driver, follower)) if !coarse.symmetric => FitOptions {
                            fixed: Fixed {
                                driver_axis: coarse
                                    .fixed
                                    .driver_axis
                                    .or(Some(driver.center_in_input)),
                                follower_axis: coarse
                                    .fixed
                                    .follower_axis
                                    .or(Some(follower.center_in_input)),
                                orientation,
                            },
                            ..coarse
                        },
                        _ => FitOptions { search: fit::Search::Coarse, ..coarse },
                    };
                    if let Ok(fit) = self.fitter.fit(
                        &driver.outline,
                        &follower.outline,
                        options.ratio,
                        &coarse,
                        control,
                    ) {
                        let centrodes = tell(&fit, true)?;
                        if live {
                            return Ok(centrodes);
                        }
                    }
                }
                if live {
                    let fixed = Fixed { orientation, ..options.fit.fixed };
                    let held =
                        FitOptions { refine: false, choose: None, fixed, ..options.fit.clone() };
                    let (ratio, fitter) = (options.ratio, &mut self.fitter);
                    let fit =
                        fitter.fit(&driver.outline, &follower.outline, ratio, &held, control)?;
                    return tell(&fit, true);
                }
                let stages = self.session.run(request, StageName::Wanted, control)?;
                let fit = stages.wanted.fit.clone().ok_or_else(nothing_given)?;
                let centrodes = tell(&fit, false)?;
                self.fitted = Some(Known {
                    drawings,
                    load: plan.load,
                    ratio: options.ratio,
                    options: options.fit.clone(),
                    fit,
                });
                Ok(centrodes)
            }
            (Origin::One, [Some(shape), _]) => {
                let mated = fit::mate(&shape.outline, options.ratio, &options.fit, control)?;
                let centrodes = scaled(mated.transmission, options.scale);
                let fitted =
                    wire::Fitted { shapes: seen, drawings: [Some(mated.driver), None], fit: None };
                say(Stage::Sized, wire::sized(&centrodes, &fitted, false))?;
                Ok(centrodes)
            }
            (Origin::Motion(transmission, _), _) => {
                let centrodes = scaled(transmission.clone(), options.scale);
                let fitted = wire::Fitted { shapes: [None; 2], drawings: [None; 2], fit: None };
                say(Stage::Sized, wire::sized(&centrodes, &fitted, false))?;
                Ok(centrodes)
            }
            _ => Err(nothing_given()),
        }
    }

    fn count(&self, options: &DesignOptions, sized: &Centrodes) -> u32 {
        let fold = sized.transmission.driver_fold();
        let count = match options.teeth {
            ToothCount::Teeth(count) => count,
            ToothCount::Module(module) => {
                (sized.perimeter().0 / (std::f64::consts::PI * module)).round() as u32
            }
            ToothCount::Auto => self.teeth.unwrap_or(TEETH_AT_FIRST),
        };
        (count / fold).max(1) * fold
    }
}

fn nothing_given() -> Stopped {
    Stopped::Refused { option: None, text: "choose two drawings".to_owned(), remedy: None }
}

/// The drawings that the state names.
fn wanted(state: &State, origin: &Origin) -> Result<Vec<DrawingRef>, Stopped> {
    let wanted: Vec<_> = match origin {
        Origin::Two => [&state.driver, &state.follower].into_iter().flatten().cloned().collect(),
        Origin::One => state.driver.iter().cloned().collect(),
        Origin::Motion(..) => return Ok(Vec::new()),
    };
    let needed = if matches!(origin, Origin::Two) { 2 } else { 1 };
    if wanted.len() == needed { Ok(wanted) } else { Err(nothing_given()) }
}

/// All that a plan asks for of its drawings.
fn requested(plan: &Plan, shapes: &[Arc<Shape>]) -> Result<Request, Stopped> {
    let request = match (&plan.origin, shapes) {
        (Origin::Two, [driver, follower]) => {
            Request::two_shapes(Arc::clone(driver), Arc::clone(follower))
        }
        (Origin::One, [shape, ..]) => Request::one_shape(Arc::clone(shape)),
        (Origin::Motion(transmission, names), _) => {
            Request::motion(transmission.clone(), names.clone())
        }
        _ => return Err(nothing_given()),
    };
    Ok(request.with(plan.options.clone()))
}

fn scaled(transmission: Transmission, scale: Scale) -> Centrodes {
    match scale {
        Scale::CenterDistance(center_distance) => Centrodes { transmission, center_distance },
        Scale::Extent(extent) => {
            let unit = Centrodes { transmission, center_distance: 1.0 };
            let mut points = unit.driver_curve(EXTENT_POINTS);
            let follower = unit.follower_curve(EXTENT_POINTS);
            points.extend(follower.iter().map(|p| Point::new(p.x + 1.0, p.y)));
            let (low, high) = geometry::bounds(&points);
            Centrodes { center_distance: extent / (high - low).max(), ..unit }
        }
    }
}

/// Teeth for the eye, before they are judged.
fn teeth_of(
    sized: &Centrodes,
    options: &DesignOptions,
    count: u32,
    control: &Control,
) -> Option<(teeth::ToothedPair, [u32; 2])> {
    let t = &sized.transmission;
    let wanted = TeethOptions {
        driver_teeth: count,
        pressure_angle: options.pressure_angle,
        addendum: options.addendum,
        backlash: options.backlash,
        control: control.clone(),
        ..TeethOptions::default()
    };
    let pair = teeth::involute_pair(sized, &wanted).ok()?;
    Some((pair, [count, count * t.follower_fold() / t.driver_fold()]))
}
