//! Every option of a design, spelled as the command line spells it.
//!
//! [`DesignOptions`] is written and read by way of [`Settings`]: lengths are mm, angles degrees, names words. What is left
//! out has the default of the command line, which takes what it shows as defaults from here ([`default_text`]).

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::typed::{Typed, deg, mm, text};
use super::words;
use crate::diagnose::Limits;
use crate::fit::{FitOptions, Fixed, Search};
use crate::geometry::Point;
use crate::law::Segment;
use crate::meshing::{Direction, Drive, DynamicsOptions, proving_runs};
use crate::pipeline::outfit::{
    DrawnHoles, FaceChoice, FaceFit, FaceStyle, HubChoice, Label, Lightening, Outfit, Screws,
};
use crate::pipeline::{DesignOptions, Scale, TeethStyle, ToothCount};
use crate::policy;
use crate::strength::Load;

/// The keys in the order of the command line's help.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
struct Settings {
    ratio: Typed,
    search: SearchWord,
    torque_weight: f64,
    balance: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    max_torque: Option<f64>,
    max_lean: Typed,
    /// Greatest curvature of a pitch curve times the driver's perimeter: no option of the command line, but a bound that the
    /// teeth ask for, which stands among what was used.
    #[serde(skip_serializing_if = "Option::is_none")]
    max_curvature: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    driver_axis: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    follower_axis: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    orientation: Option<Typed>,
    symmetric: bool,
    refine: bool,
    effort: u8,
    #[serde(skip_serializing_if = "Option::is_none")]
    choose: Option<usize>,
    star_weight: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    teeth: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    module: Option<Typed>,
    teeth_style: StyleWord,
    pressure_angle: Typed,
    addendum: f64,
    clearance: Typed,
    backlash: Typed,
    #[serde(skip_serializing_if = "Option::is_none")]
    root_clearance: Option<Typed>,
    chord_tolerance: f64,
    carve_with: CarverWord,
    strict: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    center_distance: Option<Typed>,
    #[serde(skip_serializing_if = "Option::is_none")]
    size: Option<Typed>,
    thickness: Typed,
    #[serde(skip_serializing_if = "Option::is_none")]
    bore: Option<Typed>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fit: Option<Typed>,
    #[serde(skip_serializing_if = "Option::is_none")]
    hub_diameter: Option<Typed>,
    #[serde(skip_serializing_if = "Option::is_none")]
    hub_height: Option<Typed>,
    #[serde(skip_serializing_if = "Option::is_none")]
    set_screw: Option<Typed>,
    #[serde(skip_serializing_if = "Option::is_none")]
    screws: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    screw_diameter: Option<Typed>,
    #[serde(skip_serializing_if = "Option::is_none")]
    screw_circle: Option<Typed>,
    #[serde(skip_serializing_if = "Option::is_none")]
    lightening: Option<Typed>,
    #[serde(skip_serializing_if = "Option::is_none")]
    emboss: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    engrave: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    letter_height: Option<Typed>,
    letters_at: String,
    face: FaceStyle,
    #[serde(skip_serializing_if = "Option::is_none")]
    face_depth: Option<Typed>,
    face_fit: FaceFit,
    holes: DrawnHoles,
    phase_mark: MarkWord,
    chamfer: Typed,
    base: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    base_thickness: Option<Typed>,
    #[serde(skip_serializing_if = "Option::is_none")]
    base_mount: Option<String>,
    upright: bool,
    caps: bool,
    knob: bool,
    nozzle: Typed,
    #[serde(skip_serializing_if = "Option::is_none")]
    from: Option<Typed>,
    #[serde(skip_serializing_if = "Option::is_none")]
    to: Option<Typed>,
    sector: bool,
    no_simulate: bool,
    load: f64,
    rpm: f64,
    friction: f64,
    /// Read in place of the density, never written.
    #[serde(skip_serializing)]
    material: Option<String>,
    density: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    motor_torque: Option<f64>,
    both: bool,
    /// Whole cycles of the runs.
    cycles: f64,
    /// Judged at few poses; of galleries.
    quick: bool,
    limits: Limits,
}

macro_rules! word {
    ($name:ident of $what:ty { $($word:ident = $value:path),* $(,)? }) => {
        #[derive(Clone, Copy, Debug, Serialize, Deserialize)]
        #[serde(rename_all = "kebab-case")]
        enum $name {
            $($word,)*
        }

        impl From<$what> for $name {
            fn from(value: $what) -> Self {
                match value {
                    $($value => Self::$word,)*
                }
            }
        }

        impl From<$name> for $what {
            fn from(word: $name) -> Self {
                match word {
                    $($name::$word => $value,)*
                }
            }
        }
    };
}

word!(SearchWord of Search {
    Paper = Search::Paper,
    Coarse = Search::Coarse,
    Global = Search::Global,
});
word!(StyleWord of TeethStyle {
    Involute = TeethStyle::Involute,
    Wave = TeethStyle::Wave,
    RegularWave = TeethStyle::RegularWave,
});

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum CarverWord {
    Sweep,
    Manifold,
}

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum MarkWord {
    Auto,
    On,
    Off,
}

impl Default for Settings {
    /// The defaults of the command line: the pair is run.
    fn default() -> Self {
        Self { no_simulate: false, ..Self::of(&DesignOptions::default()) }
    }
}

fn point_text(p: Point) -> String {
    format!("{},{}", p.x, p.y)
}

impl Settings {
    fn of(options: &DesignOptions) -> Self {
        let FitOptions { search, balance, weight, limits, fixed, .. } = &options.fit;
        let outfit = &options.outfit;
        let (hub, screws, label) = (outfit.hub, outfit.screws, outfit.label.as_ref());
        let written = |raised: bool| {
            label.filter(|l| l.raised == raised).map(|l| words::written_text(&l.text))
        };
        let run = options.runs.first();
        let motor = options.runs.iter().find_map(|r| match r.drive {
            Drive::Motor(limit) => limit,
            Drive::Led => None,
        });
        let (center_distance, size) = match options.scale {
            Scale::CenterDistance(distance) => (Some(mm(distance)), None),
            Scale::Extent(extent) => (None, Some(mm(extent))),
        };
        let (teeth, module) = match options.teeth {
            ToothCount::Auto => (None, None),
            ToothCount::Teeth(count) => (Some(count), None),
            ToothCount::Module(module) => (None, Some(mm(module))),
        };
        Self {
            ratio: text(options.ratio),
            search: (*search).into(),
            torque_weight: *weight,
            balance: *balance,
            max_torque: limits.max_derivative,
            max_lean: deg(limits.max_lean),
            max_curvature: limits.max_curvature,
            driver_axis: fixed.driver_axis.map(point_text),
            follower_axis: fixed.follower_axis.map(point_text),
            orientation: fixed.orientation.map(deg),
            symmetric: options.fit.symmetric,
            refine: options.fit.refine,
            effort: options.fit.effort,
            choose: options.fit.choose,
            star_weight: options.fit.star_weight,
            teeth,
            module,
            teeth_style: options.style.into(),
            pressure_angle: deg(options.pressure_angle),
            addendum: options.addendum,
            clearance: mm(options.clearance),
            backlash: mm(options.backlash),
            root_clearance: options.root_clearance.map(mm),
            chord_tolerance: options.chord_tolerance,
            carve_with: match options.carve_with_solids {
                true => CarverWord::Manifold,
                false => CarverWord::Sweep,
            },
            strict: !options.repair,
            center_distance,
            size,
            thickness: mm(options.thickness),
            bore: words::bore_text(&options.bore).map(Typed::Text),
            fit: outfit.fit.map(|fit| Typed::Text(words::fit_text(fit))),
            hub_diameter: hub.and_then(|h| h.diameter).map(mm),
            hub_height: hub.map(|h| mm(h.height)),
            set_screw: hub.and_then(|h| h.set_screw).map(mm),
            screws: screws.map(|s| s.count),
            screw_diameter: screws.map(|s| mm(s.diameter)),
            screw_circle: screws.and_then(|s| s.circle).map(mm),
            lightening: match outfit.lightening {
                Lightening::None => None,
                Lightening::Auto => Some(text("auto")),
                Lightening::Holes(count) => Some(Typed::Number(f64::from(count))),
            },
            emboss: written(true),
            engrave: written(false),
            letter_height: label.and_then(|l| l.height).map(mm),
            letters_at: words::label_place_text(label.map(|l| l.place).unwrap_or_default())
                .to_owned(),
            face: outfit.face.style,
            face_depth: outfit.face.depth.map(mm),
            face_fit: outfit.face.fit,
            holes: outfit.holes,
            phase_mark: match outfit.phase_mark {
                None => MarkWord::Auto,
                Some(true) => MarkWord::On,
                Some(false) => MarkWord::Off,
            },
            chamfer: mm(outfit.chamfer),
            base: words::base_text(outfit.base),
            base_thickness: outfit.base_thickness.map(mm),
            base_mount: words::mount_text(outfit.mount),
            upright: outfit.upright,
            caps: outfit.caps,
            knob: outfit.knob,
            nozzle: mm(outfit.nozzle),
            from: options.sector.map(|s| deg(s.from)),
            to: options.sector.map(|s| deg(s.to)),
            sector: options.sector.is_some(),
            no_simulate: options.runs.is_empty(),
            load: options.load.torque,
            rpm: options.load.rpm,
            friction: options.load.friction,
            material: None,
            density: run.map_or(policy::DEFAULT_DENSITY, |r| r.density),
            motor_torque: motor,
            both: options.runs.iter().any(|r| r.direction == Direction::Backward),
            cycles: run.map_or(policy::DESIGN_CYCLES, |r| r.cycles),
            quick: options.quick,
            limits: options.limits,
        }
    }

    fn options(self) -> Result<DesignOptions, String> {
        let defaults =
            DesignOptions::new(self.ratio.clone().read(words::turns).map_err(named("ratio"))?);
        let thickness = length("thickness", self.thickness.clone())?;
        let load = Load { torque: self.load, rpm: self.rpm, friction: self.friction };
        let density = self.material.as_deref().map(words::material).transpose();
        let run = DynamicsOptions {
            drive: self.motor_torque.map_or(Drive::Led, |limit| Drive::Motor(Some(limit))),
            load: load.torque,
            rpm: load.rpm,
            friction: load.friction,
            density: density.map_err(named("material"))?.unwrap_or(self.density),
            thickness,
            cycles: self.cycles,
            ..DynamicsOptions::default()
        };
        let ends = (turn("from", self.from.clone())?, turn("to", self.to.clone())?);
        let sector = match ends {
            (Some(from), Some(to)) if self.sector => Some(Segment { from, to }),
            _ if self.sector => return Err("sector: give both from and to, degrees".to_owned()),
            _ => None,
        };
        let size = maybe("size", self.size.clone())?;
        let scale = match (size, maybe("center-distance", self.center_distance.clone())?) {
            (Some(extent), _) => Scale::Extent(extent),
            (None, Some(distance)) => Scale::CenterDistance(distance),
            (None, None) => defaults.scale,
        };
        let outfit = self.outfit()?;
        let bore = self.bore.clone().map(|b| b.read(words::bore).map_err(named("bore")));
        let usual = outfit.base.usual_bore(outfit.fit);
        Ok(DesignOptions {
            fit: FitOptions {
                search: self.search.into(),
                balance: self.balance,
                weight: self.torque_weight,
                limits: crate::fit::Limits {
                    max_derivative: self.max_torque,
                    max_lean: self.max_lean.read(words::degrees).map_err(named("max-lean"))?,
                    max_curvature: self.max_curvature,
                },
                fixed: Fixed {
                    driver_axis: axis("driver-axis", self.driver_axis)?,
                    follower_axis: axis("follower-axis", self.follower_axis)?,
                    orientation: turn("orientation", self.orientation)?,
                },
                symmetric: self.symmetric,
                star_weight: self.star_weight,
                refine: self.refine,
                effort: self.effort,
                choose: self.choose,
                ..defaults.fit
            },
            teeth: match (self.teeth, maybe("module", self.module)?) {
                (Some(count), _) => ToothCount::Teeth(count),
                (None, Some(module)) => ToothCount::Module(module),
                (None, None) => ToothCount::Auto,
            },
            style: self.teeth_style.into(),
            pressure_angle: self
                .pressure_angle
                .read(words::degrees)
                .map_err(named("pressure-angle"))?,
            addendum: self.addendum,
            clearance: length("clearance", self.clearance)?,
            backlash: length("backlash", self.backlash)?,
            root_clearance: maybe("root-clearance", self.root_clearance)?,
            chord_tolerance: self.chord_tolerance,
            scale,
            thickness,
            bore: bore.transpose()?.or(usual).unwrap_or(defaults.bore),
            outfit,
            carve_with_solids: self.carve_with == CarverWord::Manifold,
            repair: !self.strict,
            runs: if self.no_simulate { Vec::new() } else { proving_runs(&run, self.both) },
            quick: self.quick,
            sector,
            load,
            limits: self.limits,
            ratio: defaults.ratio,
        })
    }

    fn outfit(&self) -> Result<Outfit, String> {
        let hub_diameter = maybe("hub-diameter", self.hub_diameter.clone())?;
        let hub_height = maybe("hub-height", self.hub_height.clone())?;
        let set_screw = maybe("set-screw", self.set_screw.clone())?;
        let screw_diameter = maybe("screw-diameter", self.screw_diameter.clone())?;
        let screw_circle = maybe("screw-circle", self.screw_circle.clone())?;
        let height = maybe("letter-height", self.letter_height.clone())?;
        let place = words::label_place(&self.letters_at).map_err(named("letters-at"))?;
        let label = |text: &Option<String>, raised| {
            text.as_deref().map(|text| Label { text: words::written(text), raised, height, place })
        };
        let fit = self.fit.clone().map(|f| f.read(words::fit).map_err(named("fit")));
        let lightening = self.lightening.clone();
        let lightening = lightening.map(|l| l.read(words::lightening).map_err(named("lightening")));
        let mount = self.base_mount.as_deref().map(words::mount).transpose();
        Ok(Outfit {
            fit: fit.transpose()?,
            hub: hub_diameter.or(hub_height).or(set_screw).map(|_| HubChoice {
                diameter: hub_diameter,
                height: hub_height.unwrap_or(policy::HUB_HEIGHT),
                set_screw,
            }),
            screws: self.screws.map(|count| Screws {
                count,
                diameter: screw_diameter.unwrap_or(policy::SCREW_DIAMETER),
                circle: screw_circle,
            }),
            lightening: lightening.transpose()?.unwrap_or_default(),
            label: label(&self.emboss, true).or_else(|| label(&self.engrave, false)),
            face: FaceChoice {
                style: self.face,
                depth: maybe("face-depth", self.face_depth.clone())?,
                fit: self.face_fit,
            },
            holes: self.holes,
            phase_mark: match self.phase_mark {
                MarkWord::Auto => None,
                MarkWord::On => Some(true),
                MarkWord::Off => Some(false),
            },
            chamfer: length("chamfer", self.chamfer.clone())?,
            base: words::base(&self.base).map_err(named("base"))?,
            base_thickness: maybe("base-thickness", self.base_thickness.clone())?,
            mount: mount.map_err(named("base-mount"))?.unwrap_or_default(),
            upright: self.upright,
            caps: self.caps,
            knob: self.knob,
            nozzle: length("nozzle", self.nozzle.clone())?,
        })
    }
}

fn named(key: &'static str) -> impl FnOnce(String) -> String {
    move |why| format!("{key}: {why}")
}

fn length(key: &'static str, value: Typed) -> Result<f64, String> {
    value.read(words::length).map_err(named(key))
}

fn maybe(key: &'static str, value: Option<Typed>) -> Result<Option<f64>, String> {
    let read = |v: Typed| match key {
        "center-distance" => v.read(words::center_distance),
        _ => v.read(words::length),
    };
    value.map(|v| read(v).map_err(named(key))).transpose()
}

fn turn(key: &'static str, value: Option<Typed>) -> Result<Option<f64>, String> {
    value.map(|v| v.read(words::degrees).map_err(named(key))).transpose()
}

fn axis(key: &'static str, value: Option<String>) -> Result<Option<Point>, String> {
    value.map(|v| words::point(&v).map_err(named(key))).transpose()
}

impl Serialize for DesignOptions {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Settings::of(self).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for DesignOptions {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Settings::deserialize(deserializer)?.options().map_err(serde::de::Error::custom)
    }
}

/// The default of a setting that has one, as it would be typed: `max-lean` gives `55`. Empty for what has none.
#[must_use]
pub fn default_text(key: &str) -> &'static str {
    DEFAULTS.get(key).map_or("", |[plain, _]| plain)
}

/// The default of a length, as it would be typed: `clearance` gives `0.1mm`.
#[must_use]
pub fn default_length(key: &str) -> &'static str {
    DEFAULTS.get(key).map_or("", |[_, length]| length)
}

/// By key: plain, and as a length.
static DEFAULTS: LazyLock<BTreeMap<String, [String; 2]>> = LazyLock::new(|| {
    let made = serde_json::to_value(Settings::default()).unwrap_or_default();
    let entries = made.as_object().into_iter().flatten();
    let typed = entries.map(|(key, value)| {
        let text = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        let plain = text.strip_suffix(".0").map(str::to_owned).unwrap_or(text);
        (key.clone(), [plain.clone(), plain + "mm"])
    });
    typed.collect()
});

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::BoreChoice;
    use crate::pipeline::outfit::{Base, LabelPlace, LabelText, Mount};
    use crate::solid::hardware::Screw;

    #[test]
    fn all_options_read_back_as_they_were() {
        let mut options = DesignOptions::new("2".parse().unwrap());
        options.fit.fixed.driver_axis = Some(Point::new(1.5, -2.0));
        options.fit.fixed.orientation = Some(0.5_f64.to_radians());
        options.fit.limits.max_derivative = Some(3.0);
        options.fit.limits.max_curvature = Some(14.25);
        options.fit.effort = 4;
        options.fit.choose = Some(3);
        options.fit.search = Search::Coarse;
        options.teeth = ToothCount::Module(1.5);
        options.style = TeethStyle::RegularWave;
        options.root_clearance = Some(0.3);
        options.scale = Scale::Extent(150.0);
        options.bore = words::bore("d:5x4.5").unwrap();
        options.outfit.hub = Some(HubChoice { diameter: None, height: 6.0, set_screw: Some(2.5) });
        options.outfit.lightening = Lightening::Holes(5);
        options.outfit.label = Some(Label {
            text: LabelText::Each(vec!["a".into(), "b".into()]),
            raised: false,
            height: Some(4.0),
            place: LabelPlace::Above,
        });
        options.outfit.base = words::base("nut:M5").unwrap();
        options.outfit.mount = Mount::Screws(Screw::named("M4").unwrap());
        options.outfit.base_thickness = Some(5.0);
        options.outfit.upright = true;
        options.sector = Some(Segment { from: 10_f64.to_radians(), to: 100_f64.to_radians() });
        options.repair = false;
        options.limits.efficiency = 0.4;
        let run = DynamicsOptions {
            drive: Drive::Motor(Some(900.0)),
            density: 7850.0,
            cycles: 2.0,
            ..DynamicsOptions::default()
        };
        options.runs = proving_runs(&run, true);
        let text = serde_json::to_string(&options).unwrap();
        assert_eq!(serde_json::from_str::<DesignOptions>(&text).unwrap(), options);
    }

    #[test]
    fn what_is_left_out_has_the_default_and_units_may_be_typed() {
        let read = |text: &str| serde_json::from_str::<DesignOptions>(text);
        let plain = read("{}").unwrap();
        assert!(!plain.runs.is_empty(), "the command line runs a pair unless told not to");
        let bare = read(r#"{"no-simulate": true}"#).unwrap();
        assert_eq!(bare, DesignOptions::default());
        let typed =
            r#"{"center-distance": "8cm", "bore": 4, "pressure-angle": "25deg", "ratio": 2}"#;
        let typed = read(typed).unwrap();
        assert_eq!(typed.scale, Scale::CenterDistance(80.0));
        assert_eq!(words::bore_text(&typed.bore).as_deref(), Some("round:4"));
        assert_eq!(typed.pressure_angle, 25_f64.to_radians());
        assert_eq!(typed.ratio, "2".parse().unwrap());
        assert!(matches!(read(r#"{"base": "M5"}"#).unwrap().bore, BoreChoice::Named(_)));
        assert_eq!(read(r#"{"base": "lego"}"#).unwrap().outfit.base, Base::Lego);
        assert_eq!(read(r#"{"material": "steel"}"#).unwrap().runs[0].density, 7850.0);
        let error = read(r#"{"clearance": "wide"}"#).unwrap_err().to_string();
        assert!(error.contains("clearance") && error.contains("80mm"), "{error}");
        assert!(read(r#"{"clearence": 1}"#).unwrap_err().to_string().contains("clearence"));
    }

    #[test]
    fn defaults_are_shown_as_they_are_typed() {
        let shown = ["max-lean", "addendum", "balance", "base"];
        assert_eq!(shown.map(default_text), ["55", "1", "0.5", "none"]);
        assert_eq!(["clearance", "center-distance"].map(default_length), ["0.1mm", "80mm"]);
        assert_eq!(default_text("driver-axis"), "");
    }
}
