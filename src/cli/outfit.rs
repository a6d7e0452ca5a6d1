//! Options for hubs, holes, lettering and the base plate.

use centrode::pipeline::BoreChoice;
use centrode::pipeline::outfit::{
    Base, DrawnHoles, FaceChoice, FaceFit, FaceStyle, HubChoice, Label, LabelPlace, Lightening,
    Mount, Outfit, Screws,
};
use centrode::policy;
use centrode::schema::words;
use centrode::schema::{default_length, default_text};
use centrode::solid::Fit;
use clap::{Args, ValueEnum};

use super::units;

/// What the gears carry and stand on.
#[derive(Debug, Args)]
#[command(next_help_heading = "Axles, hubs and base")]
pub(crate) struct OutfitArgs {
    /// Hole for what goes through: a screw (M2 to M12), a bearing (608, 625, ...), a motor (nema17); or by its sizes: round:5 (or 5mm), d:5, d:5x4.5, hex:6, square:4, keyway:8, keyway:8x2x1, lego, none [default: 5mm, or less where there is no room]
    #[arg(long, value_name = "BORE", value_parser = units::bore, allow_hyphen_values = true)]
    pub(crate) bore: Option<BoreChoice>,
    /// Play on each side of bores and pins: tight, slide, loose, or a length; for screws also fine, medium, coarse (ISO 273) [default: none; fine for screws, 0.05mm for bearings and motors, 0.1mm for lego]
    #[arg(long, value_name = "FIT", value_parser = units::fit, allow_hyphen_values = true)]
    pub(crate) fit: Option<Fit>,
    /// Hub on the top face, this wide [default with a hub: as much as its bore needs]
    #[arg(long, value_name = "LENGTH", value_parser = units::positive_length, allow_hyphen_values = true)]
    pub(crate) hub_diameter: Option<f64>,
    /// Hub on the top face, this high [default with a hub: 6mm]
    #[arg(long, value_name = "LENGTH", value_parser = units::positive_length, allow_hyphen_values = true)]
    pub(crate) hub_height: Option<f64>,
    /// Radial hole through the hub for a set screw, this wide: 2.5mm to cut a thread for M3
    #[arg(long, value_name = "LENGTH", value_parser = units::positive_length, allow_hyphen_values = true)]
    pub(crate) set_screw: Option<f64>,
    /// Screw holes in a circle round the axis
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub(crate) screws: Option<u32>,
    /// Width of the screw holes [default: 3.2mm, for M3]
    #[arg(long, value_name = "LENGTH", value_parser = units::positive_length, requires = "screws", allow_hyphen_values = true)]
    pub(crate) screw_diameter: Option<f64>,
    /// Radius of their circle [default: half way between bore or hub and roots]
    #[arg(long, value_name = "LENGTH", value_parser = units::positive_length, requires = "screws", allow_hyphen_values = true)]
    pub(crate) screw_circle: Option<f64>,
    /// Holes that save material and leave a rim and spokes: their number, or auto
    #[arg(long, value_name = "N", value_parser = units::lightening, allow_hyphen_values = true)]
    pub(crate) lightening: Option<Lightening>,
    /// Raised letters: the shapes' names, or --emboss=TEXT, or --emboss=DRIVER,FOLLOWER
    #[arg(long, value_name = "TEXT", num_args = 0..=1, require_equals = true, default_missing_value = "", conflicts_with = "engrave")]
    pub(crate) emboss: Option<String>,
    /// The same, sunk into the face
    #[arg(long, value_name = "TEXT", num_args = 0..=1, require_equals = true, default_missing_value = "")]
    pub(crate) engrave: Option<String>,
    /// Height of the letters' capitals [default: as large as there is room for, up to 7mm]
    #[arg(long, value_name = "LENGTH", value_parser = units::positive_length, allow_hyphen_values = true)]
    pub(crate) letter_height: Option<f64>,
    /// Where the letters go: near the axis, or above, below, left or right of it
    #[arg(long, default_value = default_text("letters-at"), value_name = "PLACE", value_parser = units::label_place)]
    pub(crate) letters_at: LabelPlace,
    /// The inner drawing of the shapes on the gears' faces, where they have one
    #[arg(long, value_enum, default_value_t = FaceArg::None)]
    pub(crate) face: FaceArg,
    /// Depth of the inner drawing, or its height [default: 0.4mm, raised 0.6mm]
    #[arg(long, value_name = "LENGTH", value_parser = units::positive_length, allow_hyphen_values = true)]
    pub(crate) face_depth: Option<f64>,
    /// How the inner drawing lies on the gear: moved along with its outline, or undistorted and clipped
    #[arg(long, value_enum, default_value_t = FaceFitArg::Follow)]
    pub(crate) face_fit: FaceFitArg,
    /// Holes of the drawings, such as the counters of letters: holes of the gears where walls stay, or filled in
    #[arg(long, value_enum, default_value_t = HolesArg::Keep)]
    pub(crate) holes: HolesArg,
    /// Arrowheads 0.4 mm deep that meet when the gears are put together right; auto: with letters or a base
    #[arg(long, value_enum, default_value_t = MarkArg::Auto)]
    pub(crate) phase_mark: MarkArg,
    /// Bevel of the bottom edges of teeth and bore, against the elephant's foot of a first layer
    #[arg(long, default_value = default_length("chamfer"), value_name = "LENGTH", value_parser = units::length_or_zero, allow_hyphen_values = true)]
    pub(crate) chamfer: f64,
    /// Base plate, by what the gears turn on: pins; a screw such as M5 (nut:M5 with its nut or head sunk in, insert:M5 in a threaded insert); a ball bearing such as 608; lego for cross axles; or none
    #[arg(long, default_value = default_text("base"), value_name = "BASE", value_parser = units::base)]
    pub(crate) base: Base,
    /// Thickness of the base plate [default: 4mm, or as much as its screws, inserts or bearings need]
    #[arg(long, value_name = "LENGTH", value_parser = units::positive_length, allow_hyphen_values = true)]
    pub(crate) base_thickness: Option<f64>,
    /// What the base plate is held by: four holes for screws such as M4 at its corners, or feet that are pushed into it
    #[arg(long, value_name = "SCREW|feet", value_parser = units::mount)]
    pub(crate) base_mount: Option<Mount>,
    /// Stand the base plate on its edge, in two feet
    #[arg(long)]
    pub(crate) upright: bool,
    /// Caps that hold the gears on the pins of the base
    #[arg(long)]
    pub(crate) caps: bool,
    /// A knob on the driver to turn it by
    #[arg(long)]
    pub(crate) knob: bool,
    /// Nozzle of the printer: tips, roots, walls, letters and gaps that it cannot draw are named
    #[arg(long, default_value = default_length("nozzle"), value_name = "LENGTH", value_parser = units::nozzle, allow_hyphen_values = true)]
    pub(crate) nozzle: f64,
}

/// When phase marks are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum MarkArg {
    /// With letters or a base
    Auto,
    /// Always
    On,
    /// Never
    Off,
}

/// What becomes of the inner drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum FaceArg {
    /// Left out
    None,
    /// Sunk into the face
    Engrave,
    /// Raised on the face
    Raise,
    /// Cut through where walls stay
    Cut,
}

/// How the inner drawing lies on the gear.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum FaceFitArg {
    /// Moved along with the outline
    Follow,
    /// Undistorted, clipped to the face
    Keep,
}

/// What becomes of holes of the drawings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum HolesArg {
    /// Holes of the gears where walls stay
    Keep,
    /// Filled in
    Fill,
}

impl OutfitArgs {
    /// The bore asked for; unless one is, that of what the gears turn on.
    pub(crate) fn bore(&self) -> Option<BoreChoice> {
        self.bore.or_else(|| self.base.usual_bore(self.fit))
    }

    /// As the library takes it.
    pub(crate) fn outfit(&self) -> Outfit {
        let hub = self.hub_diameter.or(self.hub_height).or(self.set_screw);
        let label = |text: &Option<String>, raised| {
            let (height, place) = (self.letter_height, self.letters_at);
            text.as_deref().map(|text| Label { text: words::written(text), raised, height, place })
        };
        Outfit {
            fit: self.fit,
            hub: hub.map(|_| HubChoice {
                diameter: self.hub_diameter,
                height: self.hub_height.unwrap_or(policy::HUB_HEIGHT),
                set_screw: self.set_screw,
            }),
            screws: self.screws.map(|count| Screws {
                count,
                diameter: self.screw_diameter.unwrap_or(policy::SCREW_DIAMETER),
                circle: self.screw_circle,
            }),
            lightening: self.lightening.unwrap_or_default(),
            label: label(&self.emboss, true).or_else(|| label(&self.engrave, false)),
            face: FaceChoice {
                style: match self.face {
                    FaceArg::None => FaceStyle::None,
                    FaceArg::Engrave => FaceStyle::Engrave,
                    FaceArg::Raise => FaceStyle::Raise,
                    FaceArg::Cut => FaceStyle::Cut,
                },
                depth: self.face_depth,
                fit: match self.face_fit {
                    FaceFitArg::Follow => FaceFit::Follow,
                    FaceFitArg::Keep => FaceFit::Keep,
                },
            },
            holes: match self.holes {
                HolesArg::Keep => DrawnHoles::Keep,
                HolesArg::Fill => DrawnHoles::Fill,
            },
            phase_mark: match self.phase_mark {
                MarkArg::Auto => None,
                MarkArg::On => Some(true),
                MarkArg::Off => Some(false),
            },
            chamfer: self.chamfer,
            base: self.base,
            base_thickness: self.base_thickness,
            mount: self.base_mount.unwrap_or_default(),
            upright: self.upright,
            caps: self.caps,
            knob: self.knob,
            nozzle: self.nozzle,
        }
    }
}
