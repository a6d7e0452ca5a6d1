//! Motions with a name.

use std::str::FromStr;

use super::{LawError, LawOptions, Quantity, from_function};
use crate::pitch::Transmission;

/// A motion with a name. At a ratio of m:n each repeats n times in a turn of the driver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Preset {
    /// Round gears.
    Constant,
    /// The driver's pitch curve is an ellipse of this eccentricity about its focus (with n lobes, its n-lobed kin); at 1:1
    /// its mate is the same ellipse.
    Ellipse(f64),
    /// The driver's pitch curve is a circle whose axis lies off its middle by this share of its radius.
    Eccentric(f64),
    /// The follower nearly rests once a period: its least speed is this share of its mean.
    Dwell(f64),
    /// Half a turn of the follower takes this many times as long as the other half.
    QuickReturn(f64),
    /// psi' swings between two values this many times a period, as between oval gears.
    Oval {
        /// Least and greatest psi'.
        range: [f64; 2],
        /// Times a period.
        lobes: u32,
    },
}

/// What a person may write for a preset, an example, and what it does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PresetHelp {
    /// How it is written.
    pub form: &'static str,
    /// One that works at 1:1.
    pub example: &'static str,
    /// What the gears do.
    pub does: &'static str,
}

/// All presets.
pub const PRESETS: [PresetHelp; 7] = [
    help("constant", "constant", "round gears: the follower turns evenly"),
    help(
        "ellipse:E",
        "ellipse:0.5",
        "an ellipse of eccentricity E (0 to 0.9) about its focus; its mate is the same: psi' from (1-E)/(1+E) to (1+E)/(1-E)",
    ),
    help(
        "eccentric:E",
        "eccentric:0.4",
        "a round gear whose axis lies off its middle by E radii (0 to 0.9), and the mate that follows it",
    ),
    help(
        "oval:LEAST..MOST",
        "oval:0.5..2",
        "psi' swings between two values, the mean ratio between them, twice a turn; oval:LEAST..MOSTxLOBES more often",
    ),
    help(
        "dwell:LEAST",
        "dwell:0.1",
        "the follower nearly rests once a turn, as behind a Geneva wheel: its least speed is LEAST (0.01 to 1) of its mean",
    ),
    help(
        "quick-return:TIMES",
        "quick-return:2",
        "half a turn of the follower takes TIMES (1 to 10) as long as the other half",
    ),
    help(
        "quick-return:FORWARD/RETURN",
        "quick-return:240/120",
        "the same by the driver's angles in degrees, which add up to 360",
    ),
];

const fn help(form: &'static str, example: &'static str, does: &'static str) -> PresetHelp {
    PresetHelp { form, example, does }
}

/// Most lobes of an oval: beyond it teeth cannot follow.
const MOST_LOBES: u32 = 12;
/// Halvings in the search for an oval's shape: to the last bits.
const SHAPE_STEPS: usize = 60;
/// Sharpest shape of an oval, an exponent: beyond it psi' rests at one end.
const SHARPEST: f64 = 40.0;
/// Samples of a period that an oval's mean is taken over.
const SHAPE_SAMPLES: u32 = 4096;

impl Preset {
    /// The motion at a ratio; [`LawOptions::quantity`] does not matter.
    ///
    /// # Errors
    /// [`LawError`] when psi' becomes too small.
    pub fn transmission(&self, options: &LawOptions) -> Result<Transmission, LawError> {
        let n = f64::from(options.ratio.driver_fold());
        let mean = options.mean();
        let with = |quantity| LawOptions { quantity, normalise: false, ..*options };
        let (speed, radius) = (with(Quantity::Speed), with(Quantity::DriverRadius));
        match *self {
            Self::Constant => from_function(|_| mean, &speed),
            Self::Ellipse(e) => from_function(|t| 1.0 / (1.0 + e * (n * t).cos()), &radius),
            Self::Eccentric(e) => from_function(
                |t| {
                    let (s, c) = (n * t).sin_cos();
                    e * c + (1.0 - e * e * s * s).sqrt()
                },
                &radius,
            ),
            // The fourth power of a sine averages 3/8 and is flat where it vanishes.
            Self::Dwell(least) => from_function(
                |phi| mean * (least + (1.0 - least) * 8.0 / 3.0 * (0.5 * n * phi).sin().powi(4)),
                &speed,
            ),
            // tan(psi / 2) = a tan(phi / 2): psi from -90 to 90 degrees while phi runs through 4 atan(1 / a).
            Self::QuickReturn(times) => {
                let a = (0.5 * std::f64::consts::PI / (1.0 + times)).tan().recip();
                from_function(
                    |phi| {
                        let (s, c) = (0.5 * n * phi).sin_cos();
                        mean * a / (c * c + a * a * s * s)
                    },
                    &speed,
                )
            }
            Self::Oval { range: [least, most], lobes } => {
                let share = (mean - least) / (most - least);
                let shape = (share > 0.0 && share < 1.0).then(|| Swing::of_mean(share)).flatten();
                let Some(shape) = shape else {
                    let given = format!("oval:{least}..{most}");
                    let why = format!(
                        "the mean of psi' is {mean:.3} here and has to lie well between both ends"
                    );
                    return Err(LawError::Preset { given, why });
                };
                let turns = n * f64::from(lobes);
                from_function(|phi| least + (most - least) * shape.at(turns * phi), &speed)
            }
        }
    }

    /// What the pair is called in files.
    #[must_use]
    pub fn names(&self) -> [String; 2] {
        match self {
            Self::Constant => ["round driver", "round follower"],
            Self::Ellipse(_) => ["ellipse", "mate of the ellipse"],
            Self::Eccentric(_) => ["eccentric circle", "mate of the eccentric circle"],
            Self::Dwell(_) => ["dwell driver", "dwell follower"],
            Self::QuickReturn(_) => ["quick-return driver", "quick-return follower"],
            Self::Oval { .. } => ["oval driver", "oval follower"],
        }
        .map(str::to_owned)
    }
}

/// A smooth swing from 0 to 1 and back: a power of a raised cosine, or one less that of the opposite one.
struct Swing {
    power: f64,
    mirrored: bool,
}

impl Swing {
    /// The swing of a mean between 0 and 1; none for one that would rest at an end.
    fn of_mean(mean: f64) -> Option<Self> {
        // Powers below 1 have cusps: where the mean is above a half the other side is used.
        let mirrored = mean > 0.5;
        let wanted = if mirrored { 1.0 - mean } else { mean };
        let average = |power: f64| {
            let raised = |k| {
                let t = std::f64::consts::TAU * (f64::from(k) + 0.5) / f64::from(SHAPE_SAMPLES);
                (0.5 - 0.5 * t.cos()).powf(power)
            };
            (0..SHAPE_SAMPLES).map(raised).sum::<f64>() / f64::from(SHAPE_SAMPLES)
        };
        let (mut low, mut high) = (1.0, SHARPEST);
        if wanted < average(high) {
            return None;
        }
        for _ in 0..SHAPE_STEPS {
            let middle = 0.5 * (low + high);
            *(if average(middle) > wanted { &mut low } else { &mut high }) = middle;
        }
        Some(Self { power: 0.5 * (low + high), mirrored })
    }

    fn at(&self, t: f64) -> f64 {
        let raised = |c: f64| (0.5 - 0.5 * c).powf(self.power);
        if self.mirrored { 1.0 - raised(-t.cos()) } else { raised(t.cos()) }
    }
}

impl FromStr for Preset {
    type Err = LawError;

    fn from_str(text: &str) -> Result<Self, LawError> {
        let refuse = |why: String| LawError::Preset { given: text.to_owned(), why };
        let (name, number) = match text.split_once(':') {
            Some((name, number)) => (name.trim(), Some(number.trim())),
            None => (text.trim(), None),
        };
        // The numbers each takes, both ends allowed.
        let range = |least: f64, most: f64| {
            let given =
                number.ok_or_else(|| refuse(format!("{name} needs a number after a colon")))?;
            given
                .parse()
                .ok()
                .filter(|v| (least..=most).contains(v))
                .ok_or_else(|| refuse(format!("{name} takes {least} to {most}")))
        };
        match name {
            "constant" if number.is_none() => Ok(Self::Constant),
            "constant" => Err(refuse("constant takes no number".to_owned())),
            "ellipse" => range(0.0, 0.9).map(Self::Ellipse),
            "eccentric" => range(0.0, 0.9).map(Self::Eccentric),
            "dwell" => range(0.01, 1.0).map(Self::Dwell),
            "quick-return" => match number.and_then(|n| n.split_once('/')) {
                None => range(1.0, 10.0).map(Self::QuickReturn),
                Some((forward, back)) => {
                    let angle = |t: &str| t.trim().parse::<f64>().ok().filter(|a| *a > 0.0);
                    let both = angle(forward).zip(angle(back));
                    let whole = both.filter(|(f, b)| (f + b - 360.0).abs() < 1e-6);
                    let times = whole.map(|(f, b)| f.max(b) / f.min(b)).filter(|t| *t <= 10.0);
                    times.map(Self::QuickReturn).ok_or_else(|| {
                        refuse("the two angles are to add up to 360 degrees, one at most ten times the other".to_owned())
                    })
                }
            },
            "oval" => {
                let given = number.unwrap_or_default();
                let (ends, lobes) = given.split_once('x').unwrap_or((given, "2"));
                let ends = ends.split_once("..").and_then(|(a, b)| {
                    let [a, b] = [a, b].map(|t| t.trim().parse::<f64>().ok());
                    a.zip(b).filter(|(a, b)| *a > 0.0 && b > a && b.is_finite())
                });
                let lobes = lobes.trim().parse().ok().filter(|n| (1..=MOST_LOBES).contains(n));
                let made = ends.zip(lobes);
                made.map(|((least, most), lobes)| Self::Oval { range: [least, most], lobes })
                    .ok_or_else(|| {
                        refuse(format!(
                            "oval takes two values above 0, the smaller first, and up to {MOST_LOBES} lobes, such as oval:0.5..2x3"
                        ))
                    })
            }
            _ => Err(refuse("there is no preset of that name".to_owned())),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use super::*;
    use crate::fit::Ratio;
    use crate::pitch::Centrodes;

    fn made(text: &str, ratio: (u32, u32)) -> Transmission {
        let ratio = Ratio::rational(ratio.0, ratio.1).unwrap();
        let options = LawOptions { ratio, ..LawOptions::default() };
        text.parse::<Preset>().unwrap().transmission(&options).unwrap()
    }

    #[test]
    fn every_preset_closes_at_every_kind_of_ratio() {
        for text in PRESETS.map(|p| p.example) {
            for (m, n) in [(1, 1), (3, 1), (1, 2), (3, 2)] {
                // The range of an oval is that of psi' itself.
                let mean = f64::from(n) / f64::from(m);
                let oval = format!("oval:{}..{}", 0.5 * mean, 2.0 * mean);
                let text = if text.starts_with("oval") { &oval } else { text };
                let t = made(text, (m, n));
                let turned = t.psi(TAU * f64::from(m)) / TAU;
                assert!((turned - f64::from(n)).abs() < 1e-9, "{text} {m}:{n} {turned}");
            }
        }
    }

    #[test]
    fn presets_are_what_they_are_called() {
        let e = 0.5;
        let t = made("ellipse:0.5", (1, 1));
        for k in 0..30 {
            let phi = 0.2 * f64::from(k);
            let exact = (1.0 - e * e) / (1.0 + 2.0 * e * phi.cos() + e * e);
            assert!((t.derivative(phi) - exact).abs() < 1e-8);
        }
        let pair = Centrodes { transmission: made("eccentric:0.4", (2, 1)), center_distance: 1.0 };
        let curve = pair.driver_curve(400);
        let middle = crate::geometry::centroid(&curve);
        let radius = (curve[0] - middle).norm();
        assert!(curve.iter().all(|p| ((p - middle).norm() / radius - 1.0).abs() < 1e-4));
        assert!((middle.coords.norm() / radius - 0.4).abs() < 1e-4);
        let t = made("dwell:0.1", (1, 1));
        assert!((t.min_derivative() - 0.1).abs() < 1e-9 && t.derivative(0.0) < 0.1 + 1e-9);
        let t = made("quick-return:3", (1, 1));
        let quick = t.inverse(0.5 * PI) - t.inverse(-0.5 * PI);
        assert!(((TAU - quick) / quick - 3.0).abs() < 1e-9);
        assert_eq!(made("quick-return:270/90", (1, 1)).derivative(1.0), t.derivative(1.0));
        for (text, least, most) in [("oval:0.5..2", 0.5, 2.0), ("oval:0.3..1.2x3", 0.3, 1.2)] {
            let t = made(text, (1, 1));
            assert!((t.min_derivative() - least).abs() < 1e-4, "{text} {}", t.min_derivative());
            assert!((t.max_derivative() - most).abs() < 1e-4, "{text} {}", t.max_derivative());
            let lobes = if text.ends_with("x3") { 3.0 } else { 2.0 };
            assert!((t.derivative(0.4) - t.derivative(0.4 + TAU / lobes)).abs() < 1e-6);
        }
    }

    #[test]
    fn other_words_are_refused() {
        for text in [
            "",
            "ellipse",
            "ellipse:1",
            "ellipse:x",
            "dwell:0",
            "constant:2",
            "cam:1",
            "oval:2..1",
            "oval:0.5..2x0",
            "quick-return:200/100",
        ] {
            let error = text.parse::<Preset>().unwrap_err().to_string();
            assert!(error.contains("quick-return:2"), "{error}");
        }
    }
}
