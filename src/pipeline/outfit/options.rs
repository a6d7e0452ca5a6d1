//! What may be asked for.

use super::{DrawnHoles, FaceChoice};
use crate::geometry::{LetteringError, Point, lettering};
use crate::pipeline::BoreChoice;
use crate::policy;
use crate::solid::hardware::{Bearing, Screw};
use crate::solid::{Bore, BoreName, Fit, NOZZLE, NotAScrew};

/// What the gears carry and stand on. Nothing by default. Lengths in mm.
#[derive(Clone, Debug, PartialEq)]
pub struct Outfit {
    /// How bores, pins and axle holes fit; `None` leaves every kind its own.
    pub fit: Option<Fit>,
    /// A boss on the top face of each gear.
    pub hub: Option<HubChoice>,
    /// A circle of screw holes through each gear.
    pub screws: Option<Screws>,
    /// Holes that save material.
    pub lightening: Lightening,
    /// Lettering on the top faces.
    pub label: Option<Label>,
    /// The inner drawings of the shapes on the top faces.
    pub face: FaceChoice,
    /// What becomes of holes in the drawings.
    pub holes: DrawnHoles,
    /// Marks that point at each other on the line of centres in the first pose; `None`: where a pair is to
    /// be put together by hand, that is with a base or with lettering.
    pub phase_mark: Option<bool>,
    /// Bevel of the bottom edges of outline and bore; 0 for none.
    pub chamfer: f64,
    /// What the gears stand on.
    pub base: Base,
    /// Thickness of its plate; `None`: what it needs, and no less than is stiff.
    pub base_thickness: Option<f64>,
    /// What the plate is held by.
    pub mount: Mount,
    /// Whether the plate stands on its edge, in two feet.
    pub upright: bool,
    /// Whether caps hold the gears on their pins.
    pub caps: bool,
    /// Whether the driver has a knob to turn it by.
    pub knob: bool,
    /// Width of the printer's nozzle that the pair is judged for.
    pub nozzle: f64,
}

impl Default for Outfit {
    fn default() -> Self {
        Self {
            fit: None,
            hub: None,
            screws: None,
            lightening: Lightening::None,
            label: None,
            face: FaceChoice::default(),
            holes: DrawnHoles::default(),
            phase_mark: None,
            chamfer: 0.0,
            base: Base::None,
            base_thickness: None,
            mount: Mount::None,
            upright: false,
            caps: false,
            knob: false,
            nozzle: NOZZLE,
        }
    }
}

/// A hub.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HubChoice {
    /// Its diameter; as much as its bore needs when `None`.
    pub diameter: Option<f64>,
    /// Its height above the gear.
    pub height: f64,
    /// Diameter of a hole for a set screw.
    pub set_screw: Option<f64>,
}

/// A circle of screw holes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screws {
    /// How many.
    pub count: u32,
    /// Their diameter.
    pub diameter: f64,
    /// Radius of the circle; half way between bore or hub and roots when `None`.
    pub circle: Option<f64>,
}

/// Holes that save material.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Lightening {
    /// No holes.
    #[default]
    None,
    /// As many as leave sturdy spokes.
    Auto,
    /// This many spokes with a hole between each two.
    Holes(u32),
}

/// Lettering.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// What is written.
    pub text: LabelText,
    /// Whether it stands out; else it is sunk in.
    pub raised: bool,
    /// Height of the capitals; as large as there is room for when `None`.
    pub height: Option<f64>,
    /// Where it goes.
    pub place: LabelPlace,
}

/// Where lettering goes, as the gear stands in the first pose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LabelPlace {
    /// As near to the axis as there is room.
    #[default]
    Axis,
    /// Above the axis.
    Above,
    /// Below it.
    Below,
    /// Left of it.
    Left,
    /// Right of it.
    Right,
}

/// How far from the axis lettering is sought that is not to be near it, in reaches of the gear.
const LABEL_SHARE: f64 = 0.5;

impl LabelPlace {
    /// All, by their names.
    pub const ALL: [(&'static str, Self); 5] = [
        ("axis", Self::Axis),
        ("above", Self::Above),
        ("below", Self::Below),
        ("left", Self::Left),
        ("right", Self::Right),
    ];

    /// The point that lettering is to be near, on a gear of this reach.
    pub(super) fn point(self, reach: f64) -> Point {
        let far = LABEL_SHARE * reach;
        match self {
            Self::Axis => Point::origin(),
            Self::Above => Point::new(0.0, far),
            Self::Below => Point::new(0.0, -far),
            Self::Left => Point::new(-far, 0.0),
            Self::Right => Point::new(far, 0.0),
        }
    }
}

/// What is written on the gears.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LabelText {
    /// The names of the shapes, where they fit.
    Names,
    /// The same on all gears, or an error.
    Same(String),
    /// One text for each gear, or an error.
    Each(Vec<String>),
}

/// What the gears stand on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Base {
    /// Nothing.
    #[default]
    None,
    /// A plate with a round pin for each gear.
    Pins,
    /// A plate with holes of a Lego beam every 8 mm, for cross axles.
    Lego,
    /// A plate with a screw for each gear, which turns on it.
    Screw {
        /// The screw.
        screw: Screw,
        /// What holds it in the plate.
        hold: Hold,
    },
    /// A plate with a ball bearing for each gear's shaft, and spacers.
    Bearing(Bearing),
}

impl Base {
    /// The bore of gears that turn on it, where one goes with it and none was asked for.
    #[must_use]
    pub fn usual_bore(self, fit: Option<Fit>) -> Option<BoreChoice> {
        Some(match self {
            Self::None | Self::Pins => return None,
            Self::Lego => BoreChoice::Exactly(Bore::Lego { play: policy::LEGO_AXLE_PLAY }),
            Self::Screw { screw, .. } => BoreChoice::Named(BoreName::Screw(screw)),
            Self::Bearing(bearing) => {
                let shaft = Bore::Round { diameter: bearing.shaft };
                // A fit of the user's own is added by the stage that cuts the bore.
                let play = if fit.is_some() { 0.0 } else { policy::SLIDE_FIT };
                BoreChoice::Exactly(shaft.with_play(play))
            }
        })
    }
}

/// What holds a screw in a plate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Hold {
    /// It goes through, from either side.
    #[default]
    Through,
    /// A nut, or its own hexagonal head, in a trap below.
    Nut,
    /// A threaded insert that is melted in.
    Insert,
}

/// What a plate is held by.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Mount {
    /// Nothing.
    #[default]
    None,
    /// Four screws at its corners.
    Screws(Screw),
    /// Four feet that are pushed into it.
    Feet,
}

impl Outfit {
    /// Passes a distance (mm) between axes that what the gears stand on can bear.
    ///
    /// # Errors
    /// [`OutfitError::OffTheGrid`].
    pub fn check_distance(&self, distance: f64) -> Result<(), OutfitError> {
        let studs = (distance / policy::LEGO_STUD).round();
        let off = (distance - policy::LEGO_STUD * studs).abs();
        if self.base == Base::Lego && off > policy::LEGO_GRID_ERROR {
            return Err(OutfitError::OffTheGrid { distance, nearest: studs.max(1.0) as u32 });
        }
        Ok(())
    }

    /// Play on each side of what is no screw hole, mm; `None` leaves every kind its own.
    #[must_use]
    pub fn play(&self) -> Option<f64> {
        self.fit.and_then(|fit| fit.play().ok())
    }

    /// Passes a fit that goes with a bore: classes of clearance holes are for screws.
    ///
    /// # Errors
    /// [`OutfitError::NotAScrew`].
    pub fn check_fit(&self, bore: &BoreChoice) -> Result<(), OutfitError> {
        match (bore, self.fit) {
            (BoreChoice::Named(name), fit) => name.hole(fit).map(|_| ())?,
            (_, Some(fit)) => fit.play().map(|_| ())?,
            _ => {}
        }
        Ok(())
    }

    /// Whether marks for assembly are to be made.
    #[must_use]
    pub fn wants_phase_mark(&self) -> bool {
        self.phase_mark.unwrap_or(self.base != Base::None || self.label.is_some())
    }

    /// Passes sizes that can be made on gears of a thickness, mm.
    ///
    /// # Errors
    /// [`OutfitError::BadSize`], [`OutfitError::Lettering`].
    pub fn check(&self, thickness: f64) -> Result<(), OutfitError> {
        let size = |what, value: f64, most: f64| {
            if value > 0.0 && value <= most {
                Ok(())
            } else {
                let remedy = format!("give a length above 0 and up to {most:.2} mm");
                Err(OutfitError::BadSize { what, value, remedy })
            }
        };
        let most = policy::LARGEST_LENGTH;
        if self.chamfer != 0.0 {
            size("the chamfer", self.chamfer, 0.5 * thickness)?;
        }
        if let Some(fit) = self.play()
            && !(0.0..=policy::LARGEST_PLAY).contains(&fit)
        {
            let remedy = format!("give 0 to {} mm", policy::LARGEST_PLAY);
            return Err(OutfitError::BadSize { what: "the fit", value: fit, remedy });
        }
        if let Some(hub) = &self.hub {
            size("the height of the hub", hub.height, most)?;
            if let Some(diameter) = hub.diameter {
                size("the diameter of the hub", diameter, most)?;
            }
            if let Some(screw) = hub.set_screw {
                let room = hub.height - 2.0 * policy::SET_SCREW_WALL;
                if room <= 0.0 {
                    let least = screw + 2.0 * policy::SET_SCREW_WALL;
                    let remedy = format!("a set screw needs --hub-height {least:.1}mm or more");
                    let what = "the height of the hub";
                    return Err(OutfitError::BadSize { what, value: hub.height, remedy });
                }
                size("the set screw", screw, room)?;
            }
        }
        if let Some(screws) = &self.screws {
            size("the diameter of the screws", screws.diameter, most)?;
            if let Some(radius) = screws.circle {
                size("the radius of the circle of screws", radius, most)?;
            }
            let (_, most) = policy::HOLES_RANGE;
            if !(1..=most).contains(&screws.count) {
                let remedy = format!("give 1 to {most}");
                let value = f64::from(screws.count);
                return Err(OutfitError::BadSize { what: "the number of screws", value, remedy });
            }
        }
        if let Lightening::Holes(count) = self.lightening {
            let (least, most) = policy::HOLES_RANGE;
            if !(least..=most).contains(&count) {
                let (what, remedy) =
                    ("the number of lightening holes", format!("give {least} to {most}, or auto"));
                return Err(OutfitError::BadSize { what, value: f64::from(count), remedy });
            }
        }
        self.face.check(thickness)?;
        if let Some(label) = &self.label {
            if let Some(height) = label.height {
                size("the height of the letters", height, most)?;
            }
            let texts: &[String] = match &label.text {
                LabelText::Names => &[],
                LabelText::Same(text) => std::slice::from_ref(text),
                LabelText::Each(texts) => texts,
            };
            for text in texts {
                lettering(text, 1.0)?;
            }
        }
        if let Some(base) = self.base_thickness {
            size("the thickness of the base", base, most)?;
        }
        let plain = matches!(self.base, Base::None | Base::Lego);
        let needs = |what, base| Err(OutfitError::Needs { what, base });
        match () {
            () if self.caps && self.base != Base::Pins => needs("--caps", "--base pins"),
            () if self.upright && plain => needs("--upright", "--base pins, M5 or 608"),
            () if self.mount != Mount::None && plain => {
                needs("--base-mount", "--base pins, M5 or 608")
            }
            () if self.mount == Mount::Feet && self.upright => {
                needs("--base-mount feet", "a base without --upright")
            }
            () => Ok(()),
        }?;
        Ok(())
    }
}

/// Why a pair cannot be fitted out as asked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum OutfitError {
    /// A size or number out of range.
    #[error("{what} is {value}; {remedy}")]
    BadSize {
        /// What it measures.
        what: &'static str,
        /// What was asked.
        value: f64,
        /// What would be accepted.
        remedy: String,
    },
    /// A part of a gear that has no room.
    #[error("the {gear} has no room for {what} of {asked:.2} mm; {}", up_to(*.largest))]
    NoRoom {
        /// Name of the gear.
        gear: String,
        /// What does not fit.
        what: String,
        /// Its size, mm.
        asked: f64,
        /// The largest that fits, mm; zero when none does.
        largest: f64,
    },
    /// A text that has no room.
    #[error(
        "the {gear} has no room for the text {text:?} in letters {least} mm high; shorten it, or leave lightening, hub or screws out"
    )]
    NoRoomForText {
        /// Name of the gear.
        gear: String,
        /// The text.
        text: String,
        /// Height of the smallest letters that can be printed, mm.
        least: f64,
    },
    /// An option without what it belongs to.
    #[error("{what} needs {base}; give both, or leave {what} out")]
    Needs {
        /// The option.
        what: &'static str,
        /// What it needs.
        base: &'static str,
    },
    /// A fit of screws for a bore that is for none.
    #[error(transparent)]
    NotAScrew(#[from] NotAScrew),
    /// A text that cannot be written.
    #[error(transparent)]
    Lettering(#[from] LetteringError),
    /// A set screw or a pin without a bore.
    #[error("the {gear} has no bore for {what}; give one with --bore, or leave {what} out")]
    NoBore {
        /// Name of the gear.
        gear: String,
        /// What needs it.
        what: &'static str,
    },
    /// Axes that do not meet the holes of a Lego plate.
    #[error(
        "the axes are {distance:.2} mm apart and a Lego plate has a hole every 8 mm; give --center-distance lego:{nearest}"
    )]
    OffTheGrid {
        /// Distance between two axes, mm.
        distance: f64,
        /// Studs of 8 mm that come nearest.
        nearest: u32,
    },
}

fn up_to(largest: f64) -> String {
    if largest > 0.0 {
        format!("the largest that fits is {:.2} mm", (100.0 * largest).floor() / 100.0)
    } else {
        "leave it out or make the gears larger".to_owned()
    }
}
