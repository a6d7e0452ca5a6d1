//! `centrode train`: many gears, from a saved pair or from a file.

use std::io::Write;
use std::path::PathBuf;

use anyhow::{Context, anyhow, bail};
use centrode::assembly::{
    Assembly, Bent, BentChain, Layout, PairModel, Train, TrainError, TrainPlan,
};
use centrode::control::Control;
use centrode::diagnose::{Severity, Verdict};
use centrode::export::{ExportError, Format, Mjcf, Parts, Staging, check_folder, write_json};
use centrode::meshing::{
    Drive, DynamicsOptions, TrainPlay, TrainRun, judge_train, prove_driven_by_follower,
    quiet_speed, simulate_train_all, train_play,
};
use centrode::policy;
use centrode::report::{Note, NoteKind, Plot, ReportData, Section, report_html};
use centrode::schema::{SavedDesign, read_train};
use centrode::solid::assembly_solids;
use clap::{Args, Parser, ValueEnum};
use serde_json::json;

use super::args::{Cli, Command, ExportArgs, RunArgs};
use super::files::write_text;
use super::progress::Progress;
use super::{Outcome, units};

/// Options of `centrode train`.
#[derive(Debug, Args)]
pub(crate) struct TrainArgs {
    /// Folder that `centrode design` wrote, whose pair is repeated, or a train's TOML file
    #[arg(value_name = "DESIGN|FILE.toml")]
    plan: PathBuf,
    /// Folder for the files
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    /// How often the pair is repeated: 6 makes twelve gears, each meshing with the next
    #[arg(long, default_value_t = 2, value_name = "N", conflicts_with = "gears")]
    repeat: usize,
    /// Number of gears instead, where it should be odd
    #[arg(long, value_name = "N")]
    gears: Option<usize>,
    /// How the chain runs
    #[arg(long, value_enum, default_value_t = LayoutArg::Auto)]
    layout: LayoutArg,
    /// Bend from mesh to mesh, degrees [default: the one at which the gears turn most evenly without a collision]
    #[arg(long, value_name = "DEGREES", value_parser = units::degrees, allow_hyphen_values = true)]
    bend: Option<f64>,
    /// Whole cycles that are simulated
    #[arg(long, default_value_t = policy::SIMULATED_CYCLES, value_name = "CYCLES", value_parser = units::cycles, help_heading = "Simulation")]
    cycles: f64,
    /// Do not run the train as rigid bodies
    #[arg(long, help_heading = "Simulation")]
    no_simulate: bool,
    /// Write the files even when the train is not sound (exit code 1)
    #[arg(long)]
    force: bool,
    /// Print the summary as JSON on standard output
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    formats: ExportArgs,
    #[command(flatten)]
    run: RunArgs,
}

/// How a chain runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum LayoutArg {
    /// Up and down or round a bend, whichever lets the gears turn more evenly
    Auto,
    /// In one line
    Straight,
    /// Up and down
    Zigzag,
    /// Round a bend
    Arc,
    /// Back to the first gear, where the motion allows it
    Ring,
}

/// A train and what was found out about it.
struct Made {
    train: Train,
    play: TrainPlay,
    runs: Vec<TrainRun>,
    faults: Vec<String>,
    warnings: Vec<String>,
}

pub(crate) fn run(args: &TrainArgs) -> anyhow::Result<Outcome> {
    let progress = Progress::new();
    let made = made(args, &progress)?;
    if !made.faults.is_empty() && !args.force {
        progress.done();
        eprintln!("error: {} (--force writes the files all the same)", not_sound(&made));
        return Ok(Outcome::NotSound);
    }
    progress.doing("writing files");
    let staging = Staging::new(&args.output)?;
    let files = write(&staging, &made, args)?;
    let files = staging.publish_beside(&files, &[&args.plan], "plan")?;
    progress.done();
    summary(&made, &files, args)?;
    Ok(if made.faults.is_empty() { Outcome::Good } else { Outcome::NotSound })
}

fn not_sound(made: &Made) -> String {
    format!("the train is not sound, so nothing was written: {}", made.faults.join("; "))
}

/// The files that the words of a `centrode train` command would write, in a hidden folder inside its output folder.
pub(crate) fn files(words: &[String]) -> anyhow::Result<(Staging, Vec<PathBuf>)> {
    let Command::Train(args) = Cli::try_parse_from(words)?.command else {
        bail!("this command makes no train");
    };
    let made = made(&args, &Progress::new())?;
    if !made.faults.is_empty() {
        bail!("{}", not_sound(&made));
    }
    let staging = Staging::new(&args.output)?;
    let files = write(&staging, &made, &args)?;
    Ok((staging, files))
}

/// The train that is asked for, put together, measured and run.
fn made(args: &TrainArgs, progress: &Progress) -> anyhow::Result<Made> {
    progress.doing("putting the gears on their axles");
    let (plan, train) = assembled(args)?;
    check_folder(&args.output)?;
    let assembly = &train.assembly;
    progress.doing("measuring the play of every mesh");
    let control = Control::unwatched();
    let play = train_play(assembly, policy::TRAIN_PLAY_POSES, control)?;
    let (mut runs, mut reversed, mut quiet) = (Vec::new(), Vec::new(), None);
    if !args.no_simulate {
        let options = run_options(args, assembly.thickness);
        progress.doing("running each pair with its follower driving");
        reversed = driven_by_followers(&plan, &options[1])?;
        if reversed.is_empty() || args.force {
            progress.doing(format!("running {} gears", assembly.gears.len()));
            runs = simulate_train_all(assembly, &options, control)?;
            if let Some(motor) = runs.last() {
                quiet = quiet_speed(assembly, motor, control)?;
            }
        }
    }
    let (mut faults, warnings) = judge_train(assembly, &play, &runs, quiet);
    faults.splice(0..0, reversed);
    Ok(Made { play, runs, faults, warnings, train })
}

/// What the train is made of, and its gears on their axles.
fn assembled(args: &TrainArgs) -> anyhow::Result<(TrainPlan, Train)> {
    if args.bend.is_some() && matches!(args.layout, LayoutArg::Straight | LayoutArg::Auto) {
        bail!("--bend needs to know what is bent; add --layout zigzag, arc or ring");
    }
    if args.plan.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml")) {
        let plan = read_train(&args.plan)?;
        let train = plan.assemble()?;
        return Ok((plan, train));
    }
    let saved = SavedDesign::read(&args.plan)?;
    let pair = saved.pair_model()?;
    let Some(count) = args.gears.or(args.repeat.checked_mul(2)) else {
        bail!("{} pairs are too many; give up to {}", args.repeat, policy::TRAIN_MOST_GEARS / 2);
    };
    let made = |layout| TrainPlan::chain(pair.clone(), count, layout, saved.thickness);
    let bent = |layouts: &[Bent]| {
        let chain = TrainPlan::bent(&pair, count, layouts, saved.thickness)?;
        Ok((chain.plan, chain.train))
    };
    let plan = match (args.layout, args.bend) {
        (LayoutArg::Auto, _) => return bent(&[Layout::ZigZag, Layout::Arc]),
        (LayoutArg::Zigzag, None) => return bent(&[Layout::ZigZag]),
        (LayoutArg::Arc, None) => return bent(&[Layout::Arc]),
        (LayoutArg::Ring, None) => TrainPlan::ring(&pair, count, saved.thickness)?,
        (LayoutArg::Straight, _) => made(Layout::Straight)?,
        (LayoutArg::Zigzag, Some(bend)) => made(Layout::ZigZag(bend))?,
        (LayoutArg::Arc, Some(bend)) => made(Layout::Arc(bend))?,
        (LayoutArg::Ring, Some(skew)) => made(Layout::Ring(skew))?,
    };
    match plan.assemble() {
        Ok(train) => Ok((plan, train)),
        Err(error @ (TrainError::Collision { .. } | TrainError::TooFast { .. }))
            if args.layout != LayoutArg::Ring =>
        {
            Err(with_the_best_bend(error, &pair, count, saved.thickness))
        }
        Err(error) => Err(error.into()),
    }
}

/// Why a chain was refused, and the bend that serves it best, if one does.
fn with_the_best_bend(
    error: TrainError,
    pair: &PairModel,
    count: usize,
    thickness: f64,
) -> anyhow::Error {
    match TrainPlan::bent(pair, count, &[Layout::ZigZag, Layout::Arc], thickness) {
        Ok(BentChain { layout, ratio, .. }) => anyhow!(
            "{error}; best is {}, at which one gear turns up to {ratio:.1} times as fast as one that drives it",
            options_of(layout)
        ),
        Err(_) => error.into(),
    }
}

fn options_of(layout: Layout) -> String {
    match layout {
        Layout::Straight => "--layout straight".to_owned(),
        Layout::ZigZag(bend) => format!("--layout zigzag --bend {:.0}", bend.to_degrees()),
        Layout::Arc(bend) => format!("--layout arc --bend {:.2}", bend.to_degrees()),
        Layout::Ring(skew) => format!("--layout ring --bend {:.3}", skew.to_degrees()),
    }
}

/// What is wrong with pairs whose follower has to drive in the train: one sentence each.
fn driven_by_followers(plan: &TrainPlan, options: &DynamicsOptions) -> anyhow::Result<Vec<String>> {
    let mut faults = Vec::new();
    for (pair, [on, gear]) in plan.driven_by_followers() {
        let report = prove_driven_by_follower(&plan.pairs[pair], options, Control::unwatched())?;
        let found = report.diagnostics.iter().find(|d| d.severity == Severity::Fault);
        if let Some(fault) = found {
            let name = |i: usize| plan.gears[i].name.as_str();
            faults.push(format!(
                "{} cannot drive {}, for with its follower driving the pair fails, by the follower's angle: {fault}",
                name(on),
                name(gear)
            ));
        }
    }
    Ok(faults)
}

/// A measuring run, led and without friction, and one by motor with it.
fn run_options(args: &TrainArgs, thickness: f64) -> Vec<DynamicsOptions> {
    let options = DynamicsOptions {
        load: args.run.load,
        rpm: args.run.rpm,
        density: args.run.density.unwrap_or(args.run.material),
        thickness,
        cycles: args.cycles,
        ..DynamicsOptions::default()
    };
    vec![
        DynamicsOptions { drive: Drive::Led, friction: 0.0, ..options },
        DynamicsOptions {
            drive: Drive::Motor(args.run.motor_torque),
            friction: args.run.friction,
            cycles: args.cycles.min(policy::DESIGN_CYCLES),
            ..options
        },
    ]
}

fn write(staging: &Staging, made: &Made, args: &TrainArgs) -> anyhow::Result<Vec<PathBuf>> {
    let assembly = &made.train.assembly;
    let meshes = assembly_solids(assembly)?;
    let parts = Parts { assembly, meshes: &meshes };
    let folder = staging.path();
    let told = |error: ExportError| staging.told_of_the_final_place(error);
    let mut wanted = args.formats.wanted();
    wanted.options.scene = Mjcf {
        load: args.run.load,
        rpm: args.run.rpm,
        friction: args.run.friction,
        density: args.run.density.unwrap_or(args.run.material),
        ..Mjcf::default()
    };
    let mut files = wanted.write(parts, folder).map_err(told)?;
    if wanted.wants(Format::Html) {
        files.push(
            write_text(folder, "report.html", &report_html(assembly, &page(made))).map_err(told)?,
        );
    }
    files.push(write_text(folder, "motion.csv", &motion_csv(assembly)).map_err(told)?);
    if let Some(run) = made.runs.first() {
        files.push(write_text(folder, "simulation.csv", &run_csv(assembly, run)).map_err(told)?);
    }
    let path = folder.join("train.json");
    write_json(&path, &record(made)).map_err(told)?;
    files.push(path);
    Ok(files)
}

/// World rotation of every gear over the driver's, the composed transmission functions.
fn motion_csv(assembly: &Assembly) -> String {
    let names: Vec<&str> = assembly.gears.iter().map(|g| g.gear.name.as_str()).collect();
    let mut text = format!("driver_angle,{}\n", names.join(","));
    for (k, phi) in assembly.driver_angle.iter().enumerate() {
        let angles: Vec<String> =
            assembly.gears.iter().map(|g| format!("{:.12}", g.angle[k])).collect();
        text.push_str(&format!("{phi:.12},{}\n", angles.join(",")));
    }
    text
}

fn run_csv(assembly: &Assembly, run: &TrainRun) -> String {
    let names: Vec<String> =
        assembly.gears.iter().map(|g| format!("{}_error", g.gear.name)).collect();
    let mut text = format!("driver_angle,driver_torque,driver_torque_ideal,{}\n", names.join(","));
    for step in &run.steps {
        let errors: Vec<String> = step.errors.iter().map(|e| format!("{e:.6e}")).collect();
        text.push_str(&format!(
            "{:.9},{:.6e},{:.6e},{}\n",
            step.driver_angle,
            step.torque,
            step.ideal_torque,
            errors.join(",")
        ));
    }
    text
}

fn run_title(run: &TrainRun) -> String {
    match run.options.drive {
        Drive::Led => "led, no friction".to_owned(),
        Drive::Motor(_) => format!("by motor, friction {:.2}", run.options.friction),
    }
}

fn record(made: &Made) -> serde_json::Value {
    let assembly = &made.train.assembly;
    let gears: Vec<_> = assembly
        .gears
        .iter()
        .enumerate()
        .map(|(i, g)| {
            json!({
                "name": g.gear.name,
                "teeth": g.gear.teeth,
                "axis": [g.axis.x, g.axis.y],
                "level": g.level,
                "outline": g.gear.outline.iter().map(|p| [p.x, p.y]).collect::<Vec<_>>(),
                "bore": g.gear.bore.as_ref().map(|b| b.iter().map(|p| [p.x, p.y]).collect::<Vec<_>>()),
                "angle": g.angle,
                "accumulated_play": made.play.accumulated[i],
            })
        })
        .collect();
    json!({
        "centrode": env!("CARGO_PKG_VERSION"),
        "units": "mm",
        "thickness": assembly.thickness,
        "gears": gears,
        "meshes": assembly.meshes,
        "axles": assembly.axles,
        "driver_angle": assembly.driver_angle,
        "meshing": verdict(made),
    })
}

fn verdict(made: &Made) -> serde_json::Value {
    json!({
        "sound": made.faults.is_empty(),
        "faults": made.faults,
        "warnings": made.warnings,
        "play": made.play.meshes.iter().map(|m| json!({
            "gears": m.gears, "play": m.play, "lost_poses": m.lost, "poses": m.poses,
            "interference": m.interference,
        })).collect::<Vec<_>>(),
        "runs": made.runs.iter().map(|r| json!({
            "run": run_title(r),
            "load": r.options.load,
            "cycles": r.options.cycles,
            "steps": r.steps.len(),
            "swing": r.swing,
            "efficiency": r.efficiency,
            "greatest_torque": r.steps.iter().map(|s| s.torque).fold(0.0, f64::max),
            "greatest_ideal_torque": r.steps.iter().map(|s| s.ideal_torque).fold(0.0, f64::max),
            "meshes": r.meshes.iter().map(|m| json!({
                "gears": m.gears, "free_run": m.free_run, "penetration": m.penetration, "contacts": m.contacts,
            })).collect::<Vec<_>>(),
            "stopped": r.stopped.map(|s| format!("{s:?}")),
        })).collect::<Vec<_>>(),
    })
}

fn summary(made: &Made, files: &[PathBuf], args: &TrainArgs) -> anyhow::Result<()> {
    let mut out = std::io::stdout().lock();
    if args.json {
        let mut value = verdict(made);
        value["files"] = json!(files);
        writeln!(out, "{value}").context("cannot write to standard output")?;
        return Ok(());
    }
    let gears = &made.train.assembly.gears;
    let mut lines = vec![format!(
        "{} gears, {}; play at the last gear up to {:.2} degrees",
        gears.len(),
        match made.train.assembly.meshes.len() {
            1 => "1 mesh".to_owned(),
            count => format!("{count} meshes"),
        },
        made.play.accumulated.last().copied().unwrap_or(0.0).to_degrees()
    )];
    for run in &made.runs {
        let most = run.steps.iter().map(|s| s.torque).fold(0.0, f64::max);
        lines.push(format!(
            "simulated {}: last gear swings {:.2} degrees about its law, torque up to {most:.0} N mm, {:.1} % of the work arrives",
            run_title(run),
            run.swing.last().copied().unwrap_or(0.0).to_degrees(),
            100.0 * run.efficiency
        ));
    }
    lines.extend(made.warnings.iter().map(|w| format!("warning: {w}")));
    lines.extend(made.faults.iter().map(|w| format!("not sound: {w}")));
    lines.push(format!("{} files in {}", files.len(), args.output.display()));
    writeln!(out, "{}", lines.join("\n")).context("cannot write to standard output")
}

fn page(made: &Made) -> ReportData {
    let assembly = &made.train.assembly;
    let count = assembly.gears.len();
    let degrees = |v: f64| format!("{:.2}°", v.to_degrees());
    let mut gears = Section::new("Train")
        .row("Gears", count.to_string())
        .row("Meshes", assembly.meshes.len().to_string())
        .row("Thickness", format!("{:.2} mm", assembly.thickness));
    if let Some(last) = made.play.accumulated.last() {
        gears = gears.noted_row(
            "Play at the last gear",
            degrees(*last),
            "at most, with the first gear held",
        );
    }
    let mut sections = vec![gears];
    for run in &made.runs {
        let worst = run.meshes.iter().map(|m| m.free_run).fold(0.0, f64::max);
        let most = run.steps.iter().map(|s| s.torque).fold(0.0, f64::max);
        sections.push(
            Section::new(format!("Simulation, {}", run_title(run)))
                .row("Load on each last gear", format!("{:.1} N mm", run.options.load))
                .row("Steps", run.steps.len().to_string())
                .noted_row(
                    "Swing of the last gear",
                    degrees(run.swing.last().copied().unwrap_or(0.0)),
                    "about the composed transmission function",
                )
                .row("Greatest driver torque", format!("{most:.1} N mm"))
                .row("Longest run without load in a mesh", format!("{worst:.3} of a pitch"))
                .row("Work that reaches the load", format!("{:.1} %", 100.0 * run.efficiency)),
        );
    }
    let mut composed = Plot::over_driver_angle(
        "Composed transmission functions",
        "turn of each gear less the driver's, °",
    );
    let stride = assembly.driver_angle.len().div_ceil(policy::TRAIN_PLOT_POINTS).max(1);
    for placed in assembly.gears.iter().skip(1) {
        let mean = placed.angle.last().copied().unwrap_or(0.0)
            / assembly.driver_angle.last().copied().unwrap_or(1.0);
        let points = assembly.driver_angle.iter().zip(&placed.angle).step_by(stride);
        let curve =
            points.map(|(&phi, &a)| (phi, (placed.sense() * (a - mean * phi)).to_degrees()));
        composed = composed.series(placed.gear.name.clone(), curve.collect());
    }
    let mut plots = vec![composed];
    if !made.runs.is_empty() {
        let mut torque = Plot::over_driver_angle("Driver torque", "N mm");
        let curve = |run: &TrainRun, value: &dyn Fn(&centrode::meshing::TrainStep) -> f64| {
            let stride = run.steps.len().div_ceil(policy::TRAIN_PLOT_POINTS).max(1);
            let mut last = f64::NEG_INFINITY;
            let points = run.steps.iter().step_by(stride).map(|s| (s.driver_angle, value(s)));
            points
                .filter(|p| {
                    let rises = p.0 >= last;
                    last = last.max(p.0);
                    rises
                })
                .collect::<Vec<_>>()
        };
        if let Some(run) = made.runs.first() {
            torque = torque.series("composed psi' times the load", curve(run, &|s| s.ideal_torque));
        }
        for run in &made.runs {
            torque = torque.series(run_title(run), curve(run, &|s| s.torque));
        }
        plots.push(torque);
    }
    let notes = made.warnings.iter().map(|w| Note::new(NoteKind::Warning, w.as_str()));
    let faults = made.faults.iter().map(|w| Note::new(NoteKind::Fault, w.as_str()));
    ReportData {
        title: format!("A train of {count} gears"),
        command: String::new(),
        made_by: concat!("centrode ", env!("CARGO_PKG_VERSION")).to_owned(),
        verdict: match (made.faults.is_empty(), made.warnings.is_empty()) {
            (false, _) => Verdict::Unsound,
            (true, true) => Verdict::Good,
            (true, false) => Verdict::Warnings,
        },
        summary: if made.faults.is_empty() {
            "Every mesh keeps its contact through the whole cycle.".to_owned()
        } else {
            centrode::results::in_sentences(&made.faults)
        },
        sections,
        plots,
        contacts: Vec::new(),
        notes: notes.chain(faults).collect(),
    }
}
