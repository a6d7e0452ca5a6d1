//! Bores as people say them: by what goes through, not by the size of the hole.

use super::Bore;
use super::hardware::{BEARINGS, Bearing, Clearance, MOTORS, Motor, SCREWS, Screw};
use std::fmt;
use std::str::FromStr;

/// Play a side of a bearing in its printed seat, mm: it goes in under a vice and stays.
const PRESS_PLAY: f64 = 0.05;
/// Play a side of a motor's shaft, mm: printed holes come out narrow, and a loose flat knocks.
const MOTOR_PLAY: f64 = 0.05;

/// What a bore is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BoreName {
    /// A screw goes through, and the gear turns on it.
    Screw(Screw),
    /// A ball bearing is pressed in.
    Bearing(Bearing),
    /// It sits on the shaft of a motor.
    Motor(Motor),
}

/// How closely a bore fits what goes through it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fit {
    /// Play on each side, mm.
    Play(f64),
    /// The clearance hole of a screw.
    Clearance(Clearance),
}

/// Why a fit does not go with a bore.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{class} is a fit of screws (ISO 273); give a bore such as M5, or tight, slide, loose or a length"
)]
pub struct NotAScrew {
    class: &'static str,
}

impl Fit {
    /// Play a side for what is no screw, mm.
    ///
    /// # Errors
    /// [`NotAScrew`] for a class of clearance holes.
    pub fn play(self) -> Result<f64, NotAScrew> {
        match self {
            Self::Play(play) => Ok(play),
            Self::Clearance(class) => Err(NotAScrew { class: class.name() }),
        }
    }
}

impl BoreName {
    /// The hole, play included: by `fit`, or by what is usual for its kind (a fine clearance hole, a press fit).
    ///
    /// # Errors
    /// [`NotAScrew`] for a class of clearance holes on a bearing or motor.
    pub fn hole(self, fit: Option<Fit>) -> Result<Bore, NotAScrew> {
        let or = |usual: f64| fit.map_or(Ok(usual), Fit::play);
        Ok(match (self, fit) {
            (Self::Screw(s), Some(Fit::Play(play))) => {
                Bore::Round { diameter: s.diameter + 2.0 * play }
            }
            (Self::Screw(s), Some(Fit::Clearance(class))) => {
                Bore::Round { diameter: s.hole(class) }
            }
            (Self::Screw(s), None) => Bore::Round { diameter: s.hole(Clearance::default()) },
            (Self::Bearing(b), _) => Bore::Round { diameter: b.outside }.with_play(or(PRESS_PLAY)?),
            (Self::Motor(m), _) => {
                Bore::D { diameter: m.shaft, flat: m.flat }.with_play(or(MOTOR_PLAY)?)
            }
        })
    }

    /// The bore in words: what goes through, how wide the hole is, and by what fit.
    #[must_use]
    pub fn told(self, fit: Option<Fit>) -> String {
        let usual = match self {
            Self::Bearing(_) => PRESS_PLAY,
            _ => MOTOR_PLAY,
        };
        let play = match fit {
            Some(Fit::Play(play)) => play,
            _ => usual,
        };
        match (self, fit) {
            (Self::Screw(s), Some(Fit::Play(play))) => format!(
                "{self}: a hole of {:.2} mm, {play} mm wider a side than the screw",
                s.diameter + 2.0 * play
            ),
            (Self::Screw(s), fit) => {
                let class = match fit {
                    Some(Fit::Clearance(class)) => class,
                    _ => Clearance::default(),
                };
                format!("{self}: a hole of {} mm, ISO 273 {}", s.hole(class), class.name())
            }
            (Self::Bearing(b), _) => format!(
                "{self}: a seat of {:.2} mm for a ball bearing {} mm outside, {} mm wide, on a shaft of {} mm; {play} mm play a side",
                b.outside + 2.0 * play,
                b.outside,
                b.width,
                b.shaft
            ),
            (Self::Motor(m), _) => format!(
                "{self}: a D of {:.2} mm with {:.2} mm across the flat for a shaft of {} mm; {play} mm play a side",
                m.shaft + 2.0 * play,
                m.flat + 2.0 * play,
                m.shaft
            ),
        }
    }

    /// All names, for messages and help.
    #[must_use]
    pub fn all() -> Vec<&'static str> {
        let screws = SCREWS.iter().map(|s| s.name);
        screws.chain(BEARINGS.iter().map(|b| b.name)).chain(MOTORS.iter().map(|m| m.name)).collect()
    }
}

impl fmt::Display for BoreName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Screw(s) => s.name,
            Self::Bearing(b) => b.name,
            Self::Motor(m) => m.name,
        })
    }
}

/// No screw, bearing or motor of that name is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no screw, bearing or motor of that name is known")]
pub struct NoSuchBore;

impl FromStr for BoreName {
    type Err = NoSuchBore;

    fn from_str(text: &str) -> Result<Self, NoSuchBore> {
        Screw::named(text)
            .map(Self::Screw)
            .or_else(|| Bearing::named(text).map(Self::Bearing))
            .or_else(|| Motor::named(text).map(Self::Motor))
            .ok_or(NoSuchBore)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holes_are_those_of_the_standards() {
        let hole = |name: &str, fit| name.parse::<BoreName>().unwrap().hole(fit);
        let class = |c| Some(Fit::Clearance(c));
        let round = |diameter| Ok(Bore::Round { diameter });
        assert_eq!(hole("M5", None), round(5.3));
        assert_eq!(hole("m5", class(Clearance::Medium)), round(5.5));
        assert_eq!(hole("M8", class(Clearance::Coarse)), round(10.0));
        assert_eq!(hole("M5", Some(Fit::Play(0.25))), round(5.5));
        assert_eq!(hole("608", None), round(22.1));
        assert_eq!(hole("nema17", Some(Fit::Play(0.0))), Ok(Bore::D { diameter: 5.0, flat: 4.5 }));
        assert!(hole("608", class(Clearance::Fine)).is_err());
    }

    #[test]
    fn what_is_told_is_what_is_made() {
        for name in BoreName::all() {
            let bore: BoreName = name.parse().unwrap();
            for fit in [None, Some(Fit::Play(0.2)), Some(Fit::Clearance(Clearance::Medium))] {
                let Ok(hole) = bore.hole(fit) else { continue };
                let size = hole.kind().1.unwrap();
                let said = bore.told(fit);
                assert!(said.starts_with(name), "{said}");
                let sizes = [format!("{size:.2} mm"), format!("{size} mm")];
                assert!(sizes.iter().any(|s| said.contains(s)), "{said} {size}");
            }
        }
        assert!("M7".parse::<BoreName>().is_err() && "".parse::<BoreName>().is_err());
    }
}
