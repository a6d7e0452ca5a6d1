//! The command line, as clap reads it.

use std::path::PathBuf;

use centrode::export::Format;
use centrode::geometry::Point;
use centrode::policy;
use centrode::solid::Bore;
use clap::{Args, Parser, Subcommand, ValueEnum};

use super::units;

/// Turns two drawings into a pair of gears that mesh.
#[derive(Debug, Parser)]
#[command(version, about, max_term_width = 100)]
pub(crate) struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Make a pair of gears from two shapes
    Design(Box<DesignArgs>),
    /// Judge two gears, whoever made them: exit code 0 when they mesh, 1 when not, 2 for bad input
    Check(Box<CheckArgs>),
    /// Run a saved design again as rigid bodies, with other load, friction or direction
    Simulate(Box<SimulateArgs>),
    /// Write more formats of a pair that `design` made before
    Export(ExportCommand),
    /// List the built-in shapes
    Shapes(ShapesArgs),
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

/// What is written.
#[derive(Debug, Args)]
#[command(next_help_heading = "Files")]
pub(crate) struct ExportArgs {
    /// Formats, separated by commas: glb, obj, stl, 3mf, step, dxf, svg, mjcf, gif, html, json [default: all but gif]
    #[arg(long, value_name = "FORMATS", value_delimiter = ',')]
    pub(crate) export: Vec<Format>,
    /// Also write the turning gears as moving pictures, turning.gif and turning.svg
    #[arg(long)]
    pub(crate) animate: bool,
    /// Greatest distance of the curves in STEP, DXF and laser.svg from the outline's vertices
    #[arg(long, default_value = "0.002mm", value_name = "LENGTH", value_parser = units::positive_length, allow_hyphen_values = true)]
    pub(crate) curve_tolerance: f64,
    /// DXF with straight segments only, for programs that do not read arcs
    #[arg(long)]
    pub(crate) dxf_polyline: bool,
    /// DXF in the dialect of AutoCAD R12, for old machines
    #[arg(long)]
    pub(crate) dxf_r12: bool,
    /// Width that the laser burns away: in laser.svg parts grow and bores shrink by half of it
    #[arg(long, default_value = "0mm", value_name = "LENGTH", value_parser = units::length_or_zero, allow_hyphen_values = true)]
    pub(crate) kerf: f64,
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

/// Options of `centrode check`.
#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    /// Outline of the driver: SVG, DXF, CSV, JSON, STL or OBJ, or a folder with a design.json
    #[arg(value_name = "DRIVER")]
    pub(crate) driver: String,
    /// Outline of the follower, likewise; from a design.json the follower is taken
    #[arg(value_name = "FOLLOWER")]
    pub(crate) follower: String,
    /// Distance between the axes [default: that of the design.json]
    #[arg(short = 'L', long, value_name = "LENGTH", value_parser = units::center_distance, allow_hyphen_values = true)]
    pub(crate) center_distance: Option<f64>,
    /// An even motion: turns of the driver for one turn of the follower
    #[arg(short = 'k', long, value_name = "K", value_parser = units::ratio, conflicts_with = "motion", allow_hyphen_values = true)]
    pub(crate) ratio: Option<f64>,
    /// The motion as two columns, driver and follower angle in radians [default: from contact]
    #[arg(long, value_name = "FILE.csv")]
    pub(crate) motion: Option<PathBuf>,
    /// Axis of the driver in its file, mm [default: its bore, else the origin]
    #[arg(long, value_name = "X,Y", value_parser = units::point, allow_hyphen_values = true)]
    pub(crate) driver_axis: Option<Point>,
    /// Axis of the follower in its file, mm
    #[arg(long, value_name = "X,Y", value_parser = units::point, allow_hyphen_values = true)]
    pub(crate) follower_axis: Option<Point>,
    /// Teeth of driver and follower [default: counted]
    #[arg(long, value_name = "N,M", value_parser = units::two_counts, allow_hyphen_values = true)]
    pub(crate) teeth: Option<[u32; 2]>,
    /// Turn of the follower's drawing, clockwise, at driver angle 0, degrees [default: found]
    #[arg(long, value_name = "DEGREES", value_parser = units::degrees, allow_hyphen_values = true)]
    pub(crate) phase: Option<f64>,
    /// Judge by contact alone, without a rigid-body run
    #[arg(long)]
    pub(crate) no_simulate: bool,
    /// Run the driver both ways round
    #[arg(long, conflicts_with = "no_simulate")]
    pub(crate) both: bool,
    /// Torque that holds the follower back, N mm
    #[arg(long, default_value_t = policy::DEFAULT_LOAD, value_name = "NMM", value_parser = units::positive, allow_hyphen_values = true)]
    pub(crate) load: f64,
    /// Speed of the driver, turns a minute
    #[arg(long, default_value_t = policy::DEFAULT_RPM, value_name = "RPM", value_parser = units::positive, allow_hyphen_values = true)]
    pub(crate) rpm: f64,
    /// Friction between the flanks, 0 to 2; torque is judged without
    #[arg(long, default_value_t = 0.0, value_name = "MU", value_parser = units::zero_or_more, allow_hyphen_values = true)]
    pub(crate) friction: f64,
    /// Thickness of the gears
    #[arg(long, default_value = "8mm", value_name = "LENGTH", value_parser = units::positive_length, allow_hyphen_values = true)]
    pub(crate) thickness: f64,
    /// Print the verdict as JSON on standard output
    #[arg(long)]
    pub(crate) json: bool,
}

/// Options of `centrode design`.
#[derive(Debug, Args)]
pub(crate) struct DesignArgs {
    /// Shape of the driver: an SVG, a silhouette image, a point file, or a built-in name
    #[arg(value_name = "DRIVER")]
    pub(crate) driver: String,
    /// Shape of the follower, likewise
    #[arg(value_name = "FOLLOWER")]
    pub(crate) follower: String,
    /// Folder for the files
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: PathBuf,
    /// Turns of the driver for one turn of the follower: a whole number or 1/whole
    #[arg(short = 'k', long, default_value = "1", value_name = "K", allow_hyphen_values = true)]
    pub(crate) ratio: String,
    /// Print the summary as JSON on standard output
    #[arg(long)]
    pub(crate) json: bool,

    #[command(flatten)]
    pub(crate) shape: ShapeArgs,
    #[command(flatten)]
    pub(crate) fit: FitArgs,
    #[command(flatten)]
    pub(crate) teeth: TeethArgs,
    #[command(flatten)]
    pub(crate) size: SizeArgs,
    #[command(flatten)]
    pub(crate) formats: ExportArgs,
    /// Do not run the pair as rigid bodies
    #[arg(long, help_heading = "Simulation")]
    pub(crate) no_simulate: bool,
    #[command(flatten)]
    pub(crate) run: RunArgs,
}

/// How a pair is run as rigid bodies.
#[derive(Debug, Args)]
#[command(next_help_heading = "Simulation")]
pub(crate) struct RunArgs {
    /// Torque that holds the follower back, N mm
    #[arg(long, default_value_t = policy::DEFAULT_LOAD, value_name = "NMM", value_parser = units::positive, allow_hyphen_values = true)]
    pub(crate) load: f64,
    /// Speed of the driver, turns a minute
    #[arg(long, default_value_t = policy::DEFAULT_RPM, value_name = "RPM", value_parser = units::positive, allow_hyphen_values = true)]
    pub(crate) rpm: f64,
    /// Friction between the flanks in the run by motor, 0 to 2; the measuring run has none
    #[arg(long, default_value_t = policy::DEFAULT_FRICTION, value_name = "MU", value_parser = units::zero_or_more, allow_hyphen_values = true)]
    pub(crate) friction: f64,
    /// What the gears are made of: pla, petg, abs, nylon, pom, resin, plywood, acrylic, aluminium, steel
    #[arg(long, default_value = "pla", value_name = "NAME", value_parser = units::material)]
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
    #[arg(long, default_value_t = policy::SIMULATED_CYCLES, value_name = "CYCLES", value_parser = units::positive, allow_hyphen_values = true)]
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
}

/// How the gears are fitted to the drawings.
#[derive(Debug, Args)]
#[command(next_help_heading = "Fitting")]
pub(crate) struct FitArgs {
    /// How to look for the axes: every place (global) or the paper's coarse grid (paper)
    #[arg(long, value_enum, default_value_t = SearchArg::Global)]
    pub(crate) search: SearchArg,
    /// Weight of the driver torque against likeness (omega)
    #[arg(long, default_value = "0.2", value_name = "OMEGA", value_parser = units::zero_or_more, allow_hyphen_values = true)]
    pub(crate) torque_weight: f64,
    /// Whose likeness matters more: 1 keeps the driver, 0 the follower (t)
    #[arg(long, default_value = "0.5", value_name = "T", value_parser = units::fraction, allow_hyphen_values = true)]
    pub(crate) balance: f64,
    /// Largest driver torque allowed, in multiples of the follower's [default: no limit]
    #[arg(long, value_name = "FACTOR", value_parser = units::positive, allow_hyphen_values = true)]
    pub(crate) max_torque: Option<f64>,
    /// Steepest lean of the pitch curve against its radius, degrees
    #[arg(long, default_value = "55", value_name = "DEGREES", value_parser = units::degrees, allow_hyphen_values = true)]
    pub(crate) max_lean: f64,
    /// Move motion, axes and drawings on together after the search until the pitch curves cover the drawings best (default with the global search)
    #[arg(long, overrides_with = "no_refine")]
    pub(crate) refine: bool,
    /// Keep the blend of both laws that the search gives, as the paper does
    #[arg(long, overrides_with = "refine")]
    pub(crate) no_refine: bool,
    /// Weight in E of the area that cannot be seen from the axes
    #[arg(long, default_value = "2", value_name = "WEIGHT", value_parser = units::zero_or_more, allow_hyphen_values = true)]
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
    #[arg(long, default_value = "20", value_name = "DEGREES", value_parser = units::degrees, allow_hyphen_values = true)]
    pub(crate) pressure_angle: f64,
    /// Height of a tooth above the pitch curve, in modules
    #[arg(long, default_value = "1", value_name = "MODULES", value_parser = units::positive, allow_hyphen_values = true)]
    pub(crate) addendum: f64,
    /// Gap left on every face of each gear
    #[arg(long, default_value = "0.1mm", value_name = "LENGTH", value_parser = units::length_or_zero, allow_hyphen_values = true)]
    pub(crate) clearance: f64,
    /// Backlash along the pitch curve: thins the flanks only
    #[arg(long, default_value = "0mm", value_name = "LENGTH", value_parser = units::length_or_zero, allow_hyphen_values = true)]
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
    /// Write the files even when the pair is not sound (exit code 1)
    #[arg(long, conflicts_with = "strict")]
    pub(crate) force: bool,
}

/// How large things are.
#[derive(Debug, Args)]
#[command(next_help_heading = "Size")]
pub(crate) struct SizeArgs {
    /// Distance between the axes, or lego:N for N studs of 8 mm
    #[arg(long, default_value = "80mm", value_name = "LENGTH", value_parser = units::center_distance, allow_hyphen_values = true)]
    pub(crate) center_distance: f64,
    /// Largest extent of the pair, instead of the distance between the axes
    #[arg(long, value_name = "LENGTH", value_parser = units::positive_length, conflicts_with = "center_distance", allow_hyphen_values = true)]
    pub(crate) size: Option<f64>,
    /// Thickness of the gears
    #[arg(long, default_value = "8mm", value_name = "LENGTH", value_parser = units::positive_length, allow_hyphen_values = true)]
    pub(crate) thickness: f64,
    /// Hole for the axle: a diameter, lego, or none [default: 5mm, or less where there is no room]
    #[arg(long, value_name = "BORE", value_parser = units::bore, allow_hyphen_values = true)]
    pub(crate) bore: Option<Bore>,
}

/// How to look for the axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SearchArg {
    /// Dense search with refinement
    Global,
    /// Recursive 3x3 grid of the paper
    Paper,
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
