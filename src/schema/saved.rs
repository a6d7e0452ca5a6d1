//! A finished design read back from its record.

use std::f64::consts::{PI, TAU};
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::fittings::FixtureRecord;
use super::record::{GearRecord, Motion, RECORD_VERSION, Record, UNITS};
use super::stages::Kept;
use crate::assembly::{Assembly, Fixture, Gear, PlacedGear};
use crate::control::Control;
use crate::gear::{MotionError, Pair, SampledMotion, Side};
use crate::geometry::{self, Point};
use crate::pipeline::{PipelineError, Stages};
use crate::policy;
use crate::wording::quoted;

/// Name of the record in a design's folder.
pub const RECORD_NAME: &str = "design.json";

/// What `design.json` holds of a pair: enough to draw, export, or turn it. Lengths in mm, angles in
/// radians, each gear in its own frame.
#[derive(Clone, Debug)]
pub struct SavedDesign {
    /// Names of the two shapes, driver first.
    pub names: [String; 2],
    /// Turns of the driver for one turn of the follower.
    pub ratio: f64,
    /// Distance between the axes, mm.
    pub center_distance: f64,
    /// Module, mm.
    pub module: f64,
    /// Thickness of both gears, mm.
    pub thickness: f64,
    /// Driver and follower, named so.
    pub gears: [Gear; 2],
    /// Parts that stand still.
    pub fixtures: Vec<Fixture>,
    /// Driver angle at each motion sample: from zero, increasing, over one whole cycle.
    pub driver_angle: Vec<f64>,
    /// How far the follower has turned, clockwise, at each of these samples.
    pub follower_angle: Vec<f64>,
    /// Whether the pair is cut to sectors, the samples are the way there, and it goes back the same way.
    pub swings: bool,
    /// The stages; none in records of version 0.
    kept: Option<Box<Kept>>,
}

/// Why a record cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum SavedError {
    /// There is no such file, or it may not be read.
    #[error("cannot read {} ({source}); give a folder that `centrode design` wrote, or its design.json", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file is no record of a design, or a damaged one.
    #[error("{} is not the record of a design ({why}); run `centrode design` again to get one", path.display())]
    NotADesign {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        why: String,
    },
}

impl SavedDesign {
    /// Reads a record: the file itself, or the `design.json` in a folder.
    ///
    /// # Errors
    /// [`SavedError`], naming the file.
    pub fn read(path: &Path) -> Result<Self, SavedError> {
        let file = if path.is_dir() { path.join(RECORD_NAME) } else { path.to_owned() };
        match bounded_text(&file, policy::RECORD_BYTES) {
            Ok(text) => {
                Self::from_json(&text).map_err(|why| SavedError::NotADesign { path: file, why })
            }
            Err(e) if e.kind() == io::ErrorKind::InvalidData => {
                Err(SavedError::NotADesign { path: file, why: "it is not text".to_owned() })
            }
            Err(e) if e.kind() == io::ErrorKind::FileTooLarge => {
                Err(SavedError::NotADesign { path: file, why: e.to_string() })
            }
            Err(source) => Err(SavedError::Unreadable { path: file, source }),
        }
    }

    /// Reads a record from its text.
    ///
    /// # Errors
    /// What is missing or wrong, as half a sentence.
    pub fn from_json(text: &str) -> Result<Self, String> {
        let file: Record = serde_json::from_str(text).map_err(|e| quoted(&e.to_string()))?;
        if file.version > RECORD_VERSION {
            return Err(format!(
                "it is of version {}, and this centrode reads up to version {RECORD_VERSION}",
                file.version
            ));
        }
        if file.units != UNITS {
            return Err(format!("its units are {:?} instead of {UNITS:?}", quoted(&file.units)));
        }
        for (name, value, most) in [
            ("ratio", file.ratio, f64::from(policy::MAX_RATIO)),
            ("center_distance", file.center_distance, policy::LARGEST_LENGTH),
            ("module", file.module, policy::LARGEST_LENGTH),
            ("thickness", file.thickness, policy::LARGEST_LENGTH),
        ] {
            if !(value > 0.0 && value <= most) {
                return Err(format!("its {name} is {value:e} instead of above 0 and up to {most}"));
            }
        }
        let motion = &file.motion;
        if motion.driver_angle.len() != motion.follower_angle.len() {
            return Err("its two lists of angles differ in length".to_owned());
        }
        let angles = Pair::new(&motion.driver_angle, &motion.follower_angle);
        for (side, angles) in angles.each() {
            let steps = angles.windows(2).all(|w| w[1] - w[0] >= policy::RECORD_LEAST_STEP);
            if angles.len() < 2 || angles[0] != 0.0 || !steps {
                return Err(format!("its {side} angles do not rise from 0"));
            }
            let (most, last) = (policy::RECORD_SAMPLES, angles[angles.len() - 1]);
            let turns = TAU * f64::from(policy::MAX_RATIO) + 1e-6;
            if angles.len() > most || last > turns {
                return Err(format!(
                    "its {} {side} angles go up to {last:e} radians; {most} and {turns:.1} are the most",
                    angles.len()
                ));
            }
        }
        file.names.iter().try_for_each(|name| plain_name(name))?;
        let gears = [gear(Side::Driver, file.driver)?, gear(Side::Follower, file.follower)?];
        let pitch_curve = geometry::perimeter(&gears[0].pitch_curve);
        let module = pitch_curve / (PI * f64::from(gears[0].teeth));
        let off = policy::RECORD_MODULE_OFF;
        if !(module / off..=module * off).contains(&file.module) {
            return Err(format!(
                "its module is {:e} mm, that of its driver's teeth {module:e} mm",
                file.module
            ));
        }
        agree(&gears, file.ratio, &file.motion)?;
        let mut made = Self {
            names: file.names,
            ratio: file.ratio,
            center_distance: file.center_distance,
            module: file.module,
            thickness: file.thickness,
            gears,
            fixtures: file
                .fixtures
                .into_iter()
                .map(FixtureRecord::read)
                .collect::<Result<_, _>>()?,
            driver_angle: file.motion.driver_angle,
            follower_angle: file.motion.follower_angle,
            swings: file.motion.swings,
            kept: None,
        };
        if file.version > 0 {
            let options = file.settings.zip(file.used);
            let options = options.ok_or("its settings cannot be read")?;
            let stages = file.stages.ok_or("it has no stages")?;
            made.kept = Some(Box::new(stages.read(&made, options)?));
        }
        Ok(made)
    }

    /// The stages, as [`Session`](crate::pipeline::Session) left them, less the runs themselves; contact and strength are
    /// worked out again. None for a record of version 0, which holds the finished pair alone.
    ///
    /// # Errors
    /// [`PipelineError::Contact`] for outlines of which no contact can be worked out, [`PipelineError::Cancelled`].
    pub fn stages(&self, control: &Control) -> Result<Option<Stages>, PipelineError> {
        self.kept.as_ref().map(|kept| kept.stages(self, control)).transpose()
    }

    /// psi of a pair that turns round and round.
    ///
    /// # Errors
    /// [`MotionError`], [`MotionError::Swings`] above all.
    pub fn motion(&self) -> Result<SampledMotion, MotionError> {
        if self.swings {
            return Err(MotionError::Swings);
        }
        SampledMotion::new(&self.driver_angle, &self.follower_angle)
    }

    /// The gears on their axes with their motion, as [`crate::pipeline::design`] left them.
    #[must_use]
    pub fn assembly(&self) -> Assembly {
        let [driver, follower] = self.gears.clone();
        let back = |way: &[f64]| -> Vec<f64> {
            let back = way.iter().rev().skip(1).filter(|_| self.swings);
            way.iter().chain(back).copied().collect()
        };
        let turned = back(&self.follower_angle).into_iter().map(|a| 0.0 - a).collect();
        let rotation = back(&self.driver_angle);
        let reach = self.driver_angle.last().copied().unwrap_or_default();
        let ways = self.driver_angle.len();
        let path = rotation.iter().enumerate();
        let driver_angle = path.map(|(i, a)| if i < ways { *a } else { 2.0 * reach - a }).collect();
        let place = Point::new(self.center_distance, 0.0);
        Assembly {
            gears: vec![
                PlacedGear { gear: driver, axis: Point::origin(), level: 0.0, angle: rotation },
                PlacedGear { gear: follower, axis: place, level: 0.0, angle: turned },
            ],
            driver_angle,
            thickness: self.thickness,
            meshes: vec![[0, 1]],
            axles: Vec::new(),
            fixtures: self.fixtures.clone(),
        }
    }
}

/// The text of a file of at most `limit` bytes; what is longer is [`io::ErrorKind::FileTooLarge`].
pub(super) fn bounded_text(path: &Path, limit: u64) -> io::Result<String> {
    let mut bytes = Vec::new();
    fs::File::open(path)?.take(limit + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit {
        let said = format!("it has more than {limit} bytes");
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, said));
    }
    let not_text = |_| io::Error::new(io::ErrorKind::InvalidData, "it is not text in UTF-8");
    String::from_utf8(bytes).map_err(not_text)
}

/// Passes a record whose ratio, tooth counts and motion tell the same; else says which two do not.
fn agree(gears: &[Gear; 2], ratio: f64, motion: &Motion) -> Result<(), String> {
    let agrees = |other: f64| (other / ratio - 1.0).abs() <= policy::RECORD_RATIO_OFF;
    let teeth = [0, 1].map(|i| gears[i].teeth);
    let of_teeth = f64::from(teeth[1]) / f64::from(teeth[0]);
    if !agrees(of_teeth) {
        return Err(format!(
            "its ratio is {ratio:e}, that of its {} and {} teeth {of_teeth:e}",
            teeth[0], teeth[1]
        ));
    }
    let last = |angles: &[f64]| angles.last().copied().unwrap_or_default();
    let turned = last(&motion.driver_angle) / last(&motion.follower_angle);
    // Gears that swing over a part of a turn do so at the ratio of that part.
    if !motion.swings && !agrees(turned) {
        return Err(format!("its ratio is {ratio:e}, that of its motion {turned:e}"));
    }
    Ok(())
}

fn gear(side: Side, file: GearRecord) -> Result<Gear, String> {
    let most = policy::TEETH_RANGE.1;
    if !(1..=most).contains(&file.teeth) {
        return Err(format!("its {side} has {} teeth instead of 1 to {most}", file.teeth));
    }
    let input: Vec<Point> = file.input.into_iter().map(|[x, y]| Point::new(x, y)).collect();
    within_reach(&input).map_err(|far| format!("the input of its {side} {far}"))?;
    let outline = ring("outline", side, file.outline)?;
    let bore = file.bore.map(|b| ring("bore", side, b)).transpose()?;
    if bore.as_ref().is_some_and(|b| !geometry::contains(b, Point::origin())) {
        return Err(format!("the bore of its {side} is not about the axis"));
    }
    Ok(Gear {
        name: side.name().to_owned(),
        outline,
        bore,
        pitch_curve: ring("pitch curve", side, file.pitch_curve)?,
        input,
        teeth: file.teeth,
        fittings: file.fittings.unwrap_or_default().read(side.name())?,
    })
}

/// A counter-clockwise curve of a gear with an area.
pub(super) fn ring(what: &str, side: Side, points: Vec<[f64; 2]>) -> Result<Vec<Point>, String> {
    let points: Vec<Point> = points.into_iter().map(|[x, y]| Point::new(x, y)).collect();
    within_reach(&points).map_err(|far| format!("the {what} of its {side} {far}"))?;
    if points.len() < 3 || geometry::signed_area(&points) <= 0.0 {
        return Err(format!(
            "the {what} of its {side} is not a counter-clockwise curve with an area"
        ));
    }
    Ok(points)
}

/// Passes a name that can stand in files and messages.
pub(super) fn plain_name(name: &str) -> Result<(), String> {
    if name.len() <= policy::RECORD_NAME_BYTES && !name.contains(char::is_control) {
        return Ok(());
    }
    Err(format!(
        "it holds the name {:?}, which is too long or has control characters",
        quoted(name)
    ))
}

/// Passes points of a part that is no larger than any that is made; else what is wrong, as the end of a sentence.
pub(super) fn within_reach(points: &[Point]) -> Result<(), String> {
    let most = policy::RECORD_REACH;
    let near = |p: &Point| p.x.abs() <= most && p.y.abs() <= most;
    match points.iter().position(|p| !near(p)) {
        None => Ok(()),
        Some(index) => Err(format!("has point {index} more than {most} mm from its axis")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::{LoadOptions, load};
    use crate::pipeline::{Design, DesignOptions, ToothCount, design};
    use serde_json::Value;

    fn square(side: f64) -> Value {
        serde_json::json!([[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]])
    }

    fn sample() -> Value {
        let gear = || {
            serde_json::json!({"teeth": 4, "pitch_curve": square(2.0), "outline": square(3.0),
                "bore": null, "input": []})
        };
        serde_json::json!({"units": "mm", "ratio": 1.0, "center_distance": 5.0, "module": 1.0,
            "driver": gear(), "follower": gear(), "settings": {"repair": true},
            "motion": {"driver_angle": [0.0, 1.0], "follower_angle": [0.0, 1.0]}})
    }

    #[test]
    fn a_written_design_reads_back_to_the_last_bit() {
        let options = LoadOptions { samples: 256, ..LoadOptions::default() };
        let shapes = ["ellipse", "egg"].map(|name| load(name, &options).unwrap());
        let mut settings = DesignOptions::new("1".parse().unwrap());
        settings.teeth = ToothCount::Teeth(20);
        let made = design(&shapes[0], &shapes[1], &settings).unwrap();
        let folder = tempfile::tempdir().unwrap();
        crate::export::write_json(&folder.path().join(RECORD_NAME), &Record::new(&made)).unwrap();
        let read = SavedDesign::read(folder.path()).unwrap();
        assert_eq!(read.assembly(), made.assembly);
        assert_eq!(read.names, made.names);
        assert_eq!((read.ratio, read.module), (1.0, made.pair.module));
        let stages = read.stages(Control::unwatched()).unwrap().unwrap();
        let again = Design::of(&stages).unwrap();
        assert_eq!((&again.options, &again.used), (&made.options, &made.used));
        // Figures of the contact are worked out again and may differ by rounding.
        let found =
            |d: &Design| d.diagnostics.iter().map(|f| (f.code, f.severity)).collect::<Vec<_>>();
        assert_eq!((found(&again), &again.pair.records), (found(&made), &made.pair.records));
        assert_eq!(again.assembly, made.assembly);
        assert_eq!(again.contact.summary.lost_poses, made.contact.summary.lost_poses);
        let error =
            |d: &Design| d.exact_contact.summary.transmission_error_pitch.unwrap().p99_deviation;
        assert!((error(&again) - error(&made)).abs() < 1e-9);
        let written = serde_json::to_value(Record::new(&again)).unwrap();
        assert_eq!(
            written["settings"],
            serde_json::to_value(Record::new(&made)).unwrap()["settings"]
        );
    }

    #[test]
    fn a_bare_record_is_enough() {
        let read = SavedDesign::from_json(&sample().to_string()).unwrap();
        assert_eq!(read.thickness, policy::DEFAULT_THICKNESS);
        assert_eq!(read.names, ["driver", "follower"]);
        assert_eq!(read.assembly().gears[1].angle, [0.0, -1.0]);
    }

    #[test]
    fn damage_is_named() {
        let broken = |path: &str, value: Value| {
            let mut record = sample();
            *record.pointer_mut(path).unwrap() = value;
            SavedDesign::from_json(&record.to_string()).unwrap_err()
        };
        let flat = serde_json::json!([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]);
        assert!(broken("/units", "inch".into()).contains("inch"));
        let mut newer = sample();
        newer["version"] = 99.into();
        assert!(SavedDesign::from_json(&newer.to_string()).unwrap_err().contains("version 99"));
        assert!(broken("/module", (-1.0).into()).contains("module"));
        assert!(broken("/driver/outline", flat).contains("outline of its driver"));
        assert!(broken("/follower/teeth", 0.into()).contains("follower"));
        assert!(broken("/motion/driver_angle", serde_json::json!([0.0, -1.0])).contains("rise"));
        assert!(broken("/motion/driver_angle", serde_json::json!([0.0])).contains("length"));
        assert!(SavedDesign::from_json("{").is_err());
    }

    #[test]
    fn contradictions_are_named() {
        let read = |changes: &[(&str, Value)]| {
            let mut record = sample();
            for (path, value) in changes {
                *record.pointer_mut(path).unwrap() = value.clone();
            }
            SavedDesign::from_json(&record.to_string())
        };
        let half = || ("/motion/follower_angle", serde_json::json!([0.0, 0.5]));
        assert!(read(&[("/ratio", 2.0.into())]).unwrap_err().contains("4 and 4 teeth"));
        assert!(read(&[("/follower/teeth", 8.into())]).unwrap_err().contains("4 and 8 teeth"));
        assert!(read(&[half()]).unwrap_err().contains("that of its motion 2e0"));
        let two = [("/ratio", 2.0.into()), ("/follower/teeth", 8.into()), half()];
        assert_eq!(read(&two).unwrap().ratio, 2.0);
        let mut record = sample();
        record["motion"]["follower_angle"] = serde_json::json!([0.0, 0.5]);
        record["motion"]["swings"] = true.into();
        assert!(SavedDesign::from_json(&record.to_string()).unwrap().swings);
        let beside = serde_json::json!([[1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0]]);
        let about = serde_json::json!([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]);
        let error = read(&[("/follower/bore", beside)]).unwrap_err();
        assert!(error.contains("the bore of its follower is not about the axis"), "{error}");
        assert!(read(&[("/follower/bore", about)]).is_ok());
    }

    #[test]
    fn a_missing_file_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let error = SavedDesign::read(&folder.path().join("none")).unwrap_err().to_string();
        assert!(error.contains("none") && error.contains("centrode design"), "{error}");
        std::fs::write(folder.path().join("a.json"), [0xff, 0xfe]).unwrap();
        let error = SavedDesign::read(&folder.path().join("a.json")).unwrap_err().to_string();
        assert!(error.contains("not text"), "{error}");
    }
}
