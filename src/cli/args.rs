//! The command line, as clap reads it.

use std::ffi::OsString;
use std::path::PathBuf;

use centrode::export::Format;
use centrode::fit::Ratio;
use centrode::gallery::Shard;
use centrode::geometry::Point;
use centrode::law::Preset;
use centrode::policy;
use centrode::schema::{default_length, default_text};
use clap::{Args, Parser, Subcommand, ValueEnum, ValueHint};

use super::outfit::OutfitArgs;
use super::units;

/// Turns two drawings into a pair of gears that mesh.
#[derive(Debug, Parser)]
#[command(version, long_version = super::version::build_facts(), about, max_term_width = 100)]
pub(crate) struct Cli {
    /// Print nothing but errors, and JSON where asked for
    #[arg(short, long, global = true, help_heading = "Everywhere")]
    pub(crate) quiet: bool,
    /// Threads to work with [default: one a processor]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024), help_heading = "Everywhere")]
    pub(crate) threads: Option<u16>,
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Command,
    /// Also write this run as a scene that `centrode run` carries out
    #[arg(long, global = true, value_name = "FILE.toml", display_order = 900)]
    pub(crate) save_scene: Option<PathBuf>,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Make a pair of gears from two shapes
    Design(Box<DesignArgs>),
    /// Make a pair of gears that turn as a formula, a table or a preset says
    Motion(Box<MotionArgs>),
    /// Make a gear of one shape, and the gear that runs with it
    Mate(Box<MateArgs>),
    /// Judge two gears, whoever made them: exit code 0 when they mesh, 1 when not, 2 for bad input
    Check(Box<super::check::CheckArgs>),
    /// Run a saved design again as rigid bodies, with other load, friction or direction
    Simulate(Box<SimulateArgs>),
    /// Write more formats of a pair that `design` made before
    Export(ExportCommand),
    /// Design in the browser: a page on this machine on which the gears follow every change
    #[cfg(feature = "studio")]
    Studio(super::studio::StudioArgs),
    /// Put many gears on their axles: a pair repeated, or a tree from a file
    Train(Box<super::train::TrainArgs>),
    /// List the built-in shapes
    Shapes(ShapesArgs),
    /// Make gears of many pairs of shapes, and a page on which all of them turn
    Gallery(Box<GalleryArgs>),
    /// Carry out a scene: a TOML file with the options of a command
    Run(SceneArgs),
    /// Print the completions of a shell
    Completions(CompletionsArgs),
    /// Print the manual page, or write one for each command
    Man(ManArgs),
}

/// Options of `centrode run`.
#[derive(Debug, Args)]
pub(crate) struct SceneArgs {
    /// The scene; paths in it are seen from its own folder
    #[arg(value_name = "FILE.toml")]
    pub(crate) scene: PathBuf,
    /// Folder for the files [default: the scene's, else out/ and the scene's name]
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
    /// Options that take the place of the scene's
    #[arg(last = true, value_name = "OPTIONS")]
    pub(crate) more: Vec<OsString>,
}

/// Options of `centrode gallery`.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub(crate) struct GalleryArgs {
    /// Join the galleries of several parts into one
    #[command(subcommand)]
    pub(crate) step: Option<GalleryStep>,
    /// Folders of drawings, drawings, built-in names, or `all` built-in shapes: each is paired with itself and those after it
    #[arg(value_name = "SHAPES", value_hint = ValueHint::FilePath)]
    pub(crate) from: Vec<String>,
    /// The same, separated by commas
    #[arg(long, value_name = "SHAPES", value_delimiter = ',', value_hint = ValueHint::FilePath)]
    pub(crate) shapes: Vec<String>,
    /// A file that lists pairs, one on a line: DRIVER FOLLOWER, and K where it differs; paths seen from the file, in quotes where they have blanks
    #[arg(long, value_name = "FILE")]
    pub(crate) pairs: Option<PathBuf>,
    /// Pair every shape with every other in both roles
    #[arg(long)]
    pub(crate) both_roles: bool,
    /// Folder for the gallery; a run that was stopped goes on where it was
    #[arg(short, long, value_name = "FOLDER", required = true)]
    pub(crate) output: Option<PathBuf>,
    /// Ratios, separated by commas: whole numbers or 1/whole
    #[arg(
        short = 'k',
        long,
        default_value = "1",
        value_name = "K",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    pub(crate) ratio: Vec<String>,
    /// Do part I of N only; `centrode gallery merge` joins the parts
    #[arg(long, value_name = "I/N", value_parser = units::shard)]
    pub(crate) shard: Option<Shard>,
    /// Make the pitch curves only: no teeth, no verdict
    #[arg(long, conflicts_with_all = ["simulate", "thorough"])]
    pub(crate) no_teeth: bool,
    /// Judge every pair as `design` does, at three times as many poses
    #[arg(long)]
    pub(crate) thorough: bool,
    /// Run every pair as rigid bodies too; implies --thorough
    #[arg(long, help_heading = "Simulation")]
    pub(crate) simulate: bool,
    #[command(flatten)]
    pub(crate) shape: ShapeArgs,
    #[command(flatten)]
    pub(crate) fit: FitArgs,
    #[command(flatten)]
    pub(crate) teeth: TeethArgs,
    #[command(flatten)]
    pub(crate) size: SizeArgs,
    #[command(flatten)]
    pub(crate) outfit: OutfitArgs,
    #[command(flatten)]
    pub(crate) formats: ExportArgs,
    #[command(flatten)]
    pub(crate) run: RunArgs,
}

/// What else `centrode gallery` does.
#[derive(Debug, Subcommand)]
pub(crate) enum GalleryStep {
    /// Join the galleries of several parts into one
    Merge(MergeArgs),
}

/// Options of `centrode gallery merge`.
#[derive(Debug, Args)]
pub(crate) struct MergeArgs {
    /// Folders that `centrode gallery` wrote
    #[arg(value_name = "FOLDER", required = true)]
    pub(crate) parts: Vec<PathBuf>,
    /// Folder for the whole
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: PathBuf,
}

/// Options of `centrode export`.
#[derive(Debug, Args)]
pub(crate) struct ExportCommand {
    /// Folder that `centrode design` wrote, or its design.json
    #[arg(value_name = "DESIGN")]
    pub(crate) design: PathBuf,
    /// Folder for the files [default: that of the design]
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) formats: ExportArgs,
}

fn formats_help() -> String {
    let asked: Vec<&str> =
        Format::ALL.iter().filter(|f| !f.entry().unasked).map(|f| f.name()).collect();
    format!(
        "Formats, separated by commas: {} [default: all but {}]",
        Format::names(),
        asked.join(" and ")
    )
}

/// What is written.
#[derive(Debug, Args)]
#[command(next_help_heading = "Files")]
pub(crate) struct ExportArgs {
    // The formats are listed by the registry.
    #[arg(long, value_name = "FORMATS", value_delimiter = ',', help = formats_help())]
    pub(crate) export: Vec<Format>,
    /// Also write the turning gears as moving pictures, turning.gif and turning.svg
    #[arg(long)]
    pub(crate) animate: bool,
    /// Greatest distance of the curves in STEP, DXF and laser.svg from the outline's vertices, 0.00001 to 0.05 mm
    #[arg(long, default_value = "0.002mm", value_name = "LENGTH", value_parser = units::curve_tolerance, allow_hyphen_values = true)]
    pub(crate) curve_tolerance: f64,
    /// DXF with straight segments only, for programs that do not read arcs
    #[arg(long)]
    pub(crate) dxf_polyline: bool,
    /// DXF in the dialect of AutoCAD R12, for old machines
    #[arg(long)]
    pub(crate) dxf_r12: bool,
    /// Bed of the printer, width x depth: plate.3mf has all parts flat on it, and more plates where one is full
    #[arg(long, default_value = "200x200", value_name = "WxD", value_parser = units::bed)]
    pub(crate) bed: [f64; 2],
    /// Width that the laser burns away, up to 5 mm: in laser.svg parts grow and bores shrink by half of it
    #[arg(long, default_value = "0mm", value_name = "LENGTH", value_parser = units::kerf, allow_hyphen_values = true)]
    pub(crate) kerf: f64,
    /// Engrave the pitch curves in laser.svg
    #[arg(long)]
    pub(crate) laser_pitch_curves: bool,
}

/// Options of `centrode shapes`.
#[derive(Debug, Args)]
pub(crate) struct ShapesArgs {
    /// Also draw all of them on one sheet, into this SVG file
    #[arg(long, value_name = "FILE.svg")]
    pub(crate) sheet: Option<PathBuf>,
    /// Print the names as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Options of `centrode completions`.
#[derive(Debug, Args)]
pub(crate) struct CompletionsArgs {
    /// bash, elvish, fish, powershell or zsh
    #[arg(value_name = "SHELL")]
    pub(crate) shell: clap_complete::Shell,
}

/// Options of `centrode man`.
#[derive(Debug, Args)]
pub(crate) struct ManArgs {
    /// Folder for one page a command [default: the main page on standard output]
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
}

/// Options of `centrode motion`.
#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("given").required(true).args(["law", "centrode", "preset"]))]
pub(crate) struct MotionArgs {
    /// psi' as a formula of the driver's angle phi (radians), or a table of two columns (.csv, .tsv, .txt)
    #[arg(value_name = "LAW")]
    pub(crate) law: Option<String>,
    /// LAW is psi, the follower's angle, instead of its derivative
    #[arg(long, conflicts_with_all = ["centrode", "preset"])]
    pub(crate) psi: bool,
    /// Radius of the driver's pitch curve by direction phi, in any unit: a formula or a table
    #[arg(long, value_name = "RADIUS")]
    pub(crate) centrode: Option<String>,
    /// constant, ellipse:E (about its focus), eccentric:E, oval:LEAST..MOST, dwell:LEAST, quick-return:TIMES or FORWARD/RETURN; --help-presets explains them
    #[arg(long, value_name = "NAME")]
    pub(crate) preset: Option<Preset>,
    /// Explain the presets
    #[arg(long, exclusive = true)]
    pub(crate) help_presets: bool,
    /// Turns of the driver for one turn of the follower, or of both, such as 2, 1/3 or 3:2
    #[arg(short = 'k', long, default_value = "1", value_name = "M:N", value_parser = units::turns, allow_hyphen_values = true)]
    pub(crate) ratio: Ratio,
    /// Scale psi' until it closes instead of refusing a law that does not
    #[arg(long, conflicts_with_all = ["centrode", "preset"])]
    pub(crate) normalise: bool,
    /// Begin of the part of a turn for which LAW is wanted, degrees of the driver; the rest closes the gears smoothly
    #[arg(long, value_name = "DEGREES", value_parser = units::degrees, allow_hyphen_values = true, requires = "to", conflicts_with_all = ["centrode", "preset", "normalise"])]
    pub(crate) from: Option<f64>,
    /// End of that part, degrees of the driver
    #[arg(long, value_name = "DEGREES", value_parser = units::degrees, allow_hyphen_values = true, requires = "from")]
    pub(crate) to: Option<f64>,
    /// Cut both gears to the teeth that mesh in that part; they swing there and back
    #[arg(long, requires = "to")]
    pub(crate) sector: bool,
    #[command(flatten)]
    pub(crate) pair: PairArgs,
}

/// Options of `centrode mate`.
#[derive(Debug, Args)]
pub(crate) struct MateArgs {
    /// Shape of the driver: an SVG, a silhouette image, a point file, a built-in name, or a letter such as text:A
    #[arg(value_name = "SHAPE")]
    pub(crate) shape: String,
    /// Turns of the driver for one turn of its mate, or of both, such as 2, 1/3 or 3:2
    #[arg(short = 'k', long, default_value = "1", value_name = "M:N", value_parser = units::turns, allow_hyphen_values = true)]
    pub(crate) ratio: Ratio,
    /// Axis, in the coordinates of the drawing, y upwards [default: the best one]
    #[arg(long, value_name = "X,Y", value_parser = units::point, allow_hyphen_values = true)]
    pub(crate) axis: Option<Point>,
    #[command(flatten)]
    pub(crate) reading: ShapeArgs,
    /// Weight of the driver torque against likeness (omega)
    #[arg(long, default_value = default_text("torque-weight"), value_name = "OMEGA", value_parser = units::zero_or_more, allow_hyphen_values = true, help_heading = "Fitting")]
    pub(crate) torque_weight: f64,
    /// Largest driver torque allowed, in multiples of the mate's [default: no limit]
    #[arg(long, value_name = "FACTOR", value_parser = units::positive, allow_hyphen_values = true, help_heading = "Fitting")]
    pub(crate) max_torque: Option<f64>,
    /// Steepest lean of the pitch curve against its radius, degrees
    #[arg(long, default_value = default_text("max-lean"), value_name = "DEGREES", value_parser = units::degrees, allow_hyphen_values = true, help_heading = "Fitting")]
    pub(crate) max_lean: f64,
    #[command(flatten)]
    pub(crate) pair: PairArgs,
}

/// What every command that makes a pair can be told besides where the pair comes from.
#[derive(Debug, Args)]
pub(crate) struct PairArgs {
    /// Folder for the files
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: PathBuf,
    /// Print the summary as JSON on standard output
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) teeth: TeethArgs,
    #[command(flatten)]
    pub(crate) size: SizeArgs,
    #[command(flatten)]
    pub(crate) outfit: OutfitArgs,
    #[command(flatten)]
    pub(crate) formats: ExportArgs,
    /// Do not run the pair as rigid bodies
    #[arg(long, help_heading = "Simulation")]
    pub(crate) no_simulate: bool,
    #[command(flatten)]
    pub(crate) run: RunArgs,
}

/// Options of `centrode design`.
#[derive(Debug, Args)]
pub(crate) struct DesignArgs {
    /// Shape of the driver: an SVG, a silhouette image, a point file, a built-in name, or a letter such as text:A
    #[arg(value_name = "DRIVER", value_hint = ValueHint::FilePath)]
    pub(crate) driver: String,
    /// Shape of the follower, likewise
    #[arg(value_name = "FOLLOWER", value_hint = ValueHint::FilePath)]
    pub(crate) follower: String,
    /// Turns of the driver for one turn of the follower: a whole number or 1/whole
    #[arg(short = 'k', long, default_value = "1", value_name = "K", allow_hyphen_values = true)]
    pub(crate) ratio: String,
    // First, for its own arguments would go under the heading of whatever is flattened before them.
    #[command(flatten)]
    pub(crate) pair: PairArgs,
    #[command(flatten)]
    pub(crate) shape: ShapeArgs,
    #[command(flatten)]
    pub(crate) fit: FitArgs,
}

/// How a pair is run as rigid bodies.
#[derive(Debug, Args)]
#[command(next_help_heading = "Simulation")]
pub(crate) struct RunArgs {
    /// Torque that holds the follower back, N mm
    #[arg(long, default_value = default_text("load"), value_name = "NMM", value_parser = units::positive, allow_hyphen_values = true)]
    pub(crate) load: f64,
    /// Speed of the driver, turns a minute
    #[arg(long, default_value = default_text("rpm"), value_name = "RPM", value_parser = units::positive, allow_hyphen_values = true)]
    pub(crate) rpm: f64,
    /// Friction between the flanks in the run by motor, 0 to 2; the measuring run has none
    #[arg(long, default_value = default_text("friction"), value_name = "MU", value_parser = units::zero_or_more, allow_hyphen_values = true)]
    pub(crate) friction: f64,
    /// What the gears are made of: pla, petg, abs, nylon, pom, resin, plywood, acrylic, aluminium, steel
    #[arg(long, default_value = "pla", value_name = "NAME", value_parser = units::material, conflicts_with = "density")]
    pub(crate) material: f64,
    /// Density instead of a material, kg/m^3
    #[arg(long, value_name = "DENSITY", value_parser = units::positive, allow_hyphen_values = true)]
    pub(crate) density: Option<f64>,
    /// Torque limit of the motor that looks for jams, N mm [default: 5 times what the load asks for]
    #[arg(long, value_name = "NMM", value_parser = units::positive, allow_hyphen_values = true)]
    pub(crate) motor_torque: Option<f64>,
    /// Run the driver both ways round
    #[arg(long)]
    pub(crate) both: bool,
}

/// Options of `centrode simulate`.
#[derive(Debug, Args)]
pub(crate) struct SimulateArgs {
    /// Folder that `centrode design` wrote, or its design.json
    #[arg(value_name = "DESIGN")]
    pub(crate) design: PathBuf,
    /// Whole cycles of both gears
    #[arg(long, default_value_t = policy::SIMULATED_CYCLES, value_name = "CYCLES", value_parser = units::whole_cycles, allow_hyphen_values = true)]
    pub(crate) cycles: f64,
    /// Print the verdict and the figures as JSON on standard output
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) run: RunArgs,
}

/// How the drawings are read.
#[derive(Debug, Args)]
#[command(next_help_heading = "Reading the shapes")]
pub(crate) struct ShapeArgs {
    /// Smoothing of the outlines, 0 (none) to 1 [default: automatic]
    #[arg(long, value_name = "0..1", value_parser = units::fraction, allow_hyphen_values = true)]
    pub(crate) smoothing: Option<f64>,
    /// Grey level that parts shape from background in images, 0 to 255 [default: automatic]
    #[arg(long, value_name = "LEVEL")]
    pub(crate) threshold: Option<u8>,
    /// Widest gap between ends of lines that is joined [default: 0.05 mm, or 1e-4 of the drawing if that is more]
    #[arg(long, value_name = "LENGTH", value_parser = units::length_or_zero, allow_hyphen_values = true)]
    pub(crate) join: Option<f64>,
}

/// How the gears are fitted to the drawings.
#[derive(Debug, Args)]
#[command(next_help_heading = "Fitting")]
pub(crate) struct FitArgs {
    /// How to look for the axes: every place (global), the same for a first answer only (coarse), or the paper's coarse grid (paper)
    #[arg(long, value_enum, default_value_t = SearchArg::Global)]
    pub(crate) search: SearchArg,
    /// Weight of the driver torque against likeness (omega)
    #[arg(long, default_value = default_text("torque-weight"), value_name = "OMEGA", value_parser = units::zero_or_more, allow_hyphen_values = true)]
    pub(crate) torque_weight: f64,
    /// Whose likeness matters more: 1 keeps the driver, 0 the follower (t)
    #[arg(long, default_value = default_text("balance"), value_name = "T", value_parser = units::fraction, allow_hyphen_values = true)]
    pub(crate) balance: f64,
    /// Largest driver torque allowed, in multiples of the follower's [default: no limit]
    #[arg(long, value_name = "FACTOR", value_parser = units::positive, allow_hyphen_values = true)]
    pub(crate) max_torque: Option<f64>,
    /// Steepest lean of the pitch curve against its radius, degrees
    #[arg(long, default_value = default_text("max-lean"), value_name = "DEGREES", value_parser = units::degrees, allow_hyphen_values = true)]
    pub(crate) max_lean: f64,
    /// Axis of the driver, in the coordinates of its drawing, y upwards [default: searched]
    #[arg(long, value_name = "X,Y", value_parser = units::point, allow_hyphen_values = true)]
    pub(crate) driver_axis: Option<Point>,
    /// Axis of the follower, in the coordinates of its drawing, y upwards [default: searched]
    #[arg(long, value_name = "X,Y", value_parser = units::point, allow_hyphen_values = true)]
    pub(crate) follower_axis: Option<Point>,
    /// Turn of the follower's drawing, counter-clockwise, while the driver's is upright [default: searched]
    #[arg(long, value_name = "DEGREES", value_parser = units::degrees, allow_hyphen_values = true)]
    pub(crate) orientation: Option<f64>,
    /// Both gears have exactly the same pitch curve: for one shape named twice, at ratio 1
    #[arg(long, conflicts_with_all = ["follower_axis", "orientation"])]
    pub(crate) symmetric: bool,
    /// Move motion, axes and drawings on together after the search until the pitch curves cover the drawings best (default with the global search)
    #[arg(long, overrides_with = "no_refine")]
    pub(crate) refine: bool,
    /// Keep the blend of both laws that the search gives, as the paper does
    #[arg(long, overrides_with = "refine")]
    pub(crate) no_refine: bool,
    /// How many starts the refinement makes; each step takes about four times as long
    #[arg(long, default_value = default_text("effort"), value_name = "1..5", value_parser = clap::value_parser!(u8).range(1..=5))]
    pub(crate) effort: u8,
    /// Shapes to turn over first; auto turns the follower over where that makes a clearly better pair
    #[arg(long, value_enum, default_value_t = MirrorArg::None)]
    pub(crate) mirror: MirrorArg,
    /// Write the N best different pairs to choose from (alternatives.html, alternatives.json), and no gears
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=12), conflicts_with_all = ["choose", "symmetric"])]
    pub(crate) alternatives: Option<u8>,
    /// Make pair I of those that --alternatives shows
    #[arg(long, value_name = "I", value_parser = clap::value_parser!(u8).range(1..=12), conflicts_with = "symmetric")]
    pub(crate) choose: Option<u8>,
    /// Weight in E of the area that cannot be seen from the axes
    #[arg(long, default_value = default_text("star-weight"), value_name = "WEIGHT", value_parser = units::zero_or_more, allow_hyphen_values = true)]
    pub(crate) star_weight: f64,
}

/// What the teeth are like.
#[derive(Debug, Args)]
#[command(next_help_heading = "Teeth")]
pub(crate) struct TeethArgs {
    /// Teeth of the driver [default: chosen from size and curvature]
    #[arg(long, value_name = "N", conflicts_with = "module", allow_negative_numbers = true)]
    pub(crate) teeth: Option<u32>,
    /// Module: teeth are this times pi apart [default: chosen]
    #[arg(long, value_name = "LENGTH", value_parser = units::positive_length, allow_hyphen_values = true)]
    pub(crate) module: Option<f64>,
    /// Involute flanks that touch without error, or the waves of the paper (with or without Eq. 17)
    #[arg(long, value_enum, default_value_t = StyleArg::Involute)]
    pub(crate) teeth_style: StyleArg,
    /// Pressure angle, degrees; steeper ones are used where the curve bends fast
    #[arg(long, default_value = default_text("pressure-angle"), value_name = "DEGREES", value_parser = units::degrees, allow_hyphen_values = true)]
    pub(crate) pressure_angle: f64,
    /// Height of a tooth above the pitch curve, in modules
    #[arg(long, default_value = default_text("addendum"), value_name = "MODULES", value_parser = units::positive, allow_hyphen_values = true)]
    pub(crate) addendum: f64,
    /// Gap left on every face of each gear
    #[arg(long, default_value = default_length("clearance"), value_name = "LENGTH", value_parser = units::length_or_zero, allow_hyphen_values = true)]
    pub(crate) clearance: f64,
    /// Backlash along the pitch curve: thins the flanks only
    #[arg(long, default_value = default_length("backlash"), value_name = "LENGTH", value_parser = units::length_or_zero, allow_hyphen_values = true)]
    pub(crate) backlash: f64,
    /// Extra depth of the roots below a mating tip [default: 0.25 module]
    #[arg(long, value_name = "LENGTH", value_parser = units::length_or_zero, allow_hyphen_values = true)]
    pub(crate) root_clearance: Option<f64>,
    /// Largest distance between a flank and its chords, in modules [default: 0.0005]
    #[arg(long, value_name = "MODULES", value_parser = units::positive, allow_hyphen_values = true)]
    pub(crate) chord_tolerance: Option<f64>,
    /// Cut the follower with the exact sweep, or literally as solids with Manifold (slow)
    #[arg(long, value_enum, default_value_t = CarverArg::Sweep)]
    pub(crate) carve_with: CarverArg,
    /// Deliver nothing when a first attempt is not sound, instead of trying gentler settings
    #[arg(long)]
    pub(crate) strict: bool,
    /// Write the files even when the pair is not sound (exit code 1); with --strict those of the first attempt
    #[arg(long)]
    pub(crate) force: bool,
}

/// How large things are.
#[derive(Debug, Args)]
#[command(next_help_heading = "Size")]
pub(crate) struct SizeArgs {
    /// Distance between the axes, or lego:N for N studs of 8 mm
    #[arg(long, default_value = default_length("center-distance"), value_name = "LENGTH", value_parser = units::center_distance, allow_hyphen_values = true)]
    pub(crate) center_distance: f64,
    /// Largest extent of the pair, instead of the distance between the axes
    #[arg(long, value_name = "LENGTH", value_parser = units::positive_length, conflicts_with = "center_distance", allow_hyphen_values = true)]
    pub(crate) size: Option<f64>,
    /// Thickness of the gears
    #[arg(long, default_value = default_length("thickness"), value_name = "LENGTH", value_parser = units::positive_length, allow_hyphen_values = true)]
    pub(crate) thickness: f64,
}

/// How to look for the axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SearchArg {
    /// Dense search with refinement
    Global,
    /// Dense search alone: a tenth of a second
    Coarse,
    /// Recursive 3x3 grid of the paper
    Paper,
}

/// Which shapes are turned over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum MirrorArg {
    /// Neither
    None,
    /// The driver's
    Driver,
    /// The follower's
    Follower,
    /// Both: the same pair seen from behind
    Both,
    /// The follower's, if the pair is clearly better for it
    Auto,
}

/// Style of teeth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum StyleArg {
    /// Generalised involutes
    Involute,
    /// Waves with the heights of Eq. 17
    Wave,
    /// Waves all of one height
    RegularWave,
}

/// What carves the follower.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum CarverArg {
    /// The exact envelope of the driver's motion
    Sweep,
    /// A disc minus the driver at many instants, as solids
    Manifold,
}
