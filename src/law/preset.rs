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
}

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
        }
        .map(str::to_owned)
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
            "quick-return" => range(1.0, 10.0).map(Self::QuickReturn),
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
        for text in ["constant", "ellipse:0.4", "eccentric:0.3", "dwell:0.2", "quick-return:2"] {
            for (m, n) in [(1, 1), (3, 1), (1, 2), (3, 2)] {
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
    }

    #[test]
    fn other_words_are_refused() {
        for text in ["", "ellipse", "ellipse:1", "ellipse:x", "dwell:0", "constant:2", "cam:1"] {
            let error = text.parse::<Preset>().unwrap_err().to_string();
            assert!(error.contains("quick-return:2"), "{error}");
        }
    }
}
