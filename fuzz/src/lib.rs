//! What every target holds the program to, beside not crashing.

use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use centrode::fit::Ratio;
use centrode::geometry::{self, Point};
use centrode::input::Shape;
use centrode::outline::Outline;
use centrode::pitch::{Centrodes, Transmission};

/// Longest refusal, characters: a formula of the greatest length, every character of it escaped, still fits.
const LONGEST: usize = 12_000;

/// A folder of this process for what is written, under the system's folder for temporary files.
pub fn folder() -> &'static Path {
    static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
        let folder = std::env::temp_dir().join(format!("centrode-fuzz-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a temporary folder can be made");
        folder
    });
    &FOLDER
}

/// A refusal is one line that can be printed.
pub fn told(error: &impl Display) {
    let text = error.to_string();
    assert!(!text.trim().is_empty(), "a refusal says nothing");
    assert!(!text.contains(['\n', '\r', '\0', '\u{1b}']), "not one plain line: {text:?}");
    assert!(
        text.len() < LONGEST,
        "{} bytes: {:?}",
        text.len(),
        text.chars().take(200).collect::<String>()
    );
}

/// A refusal that names the remedy after a semicolon.
pub fn remedied(error: &impl Display) {
    told(error);
    assert!(error.to_string().contains(';'), "no remedy: {error}");
}

/// An outline is closed, simple, counter-clockwise and finite.
pub fn sound(outline: &Outline) {
    finite(outline.points());
    assert!(geometry::signed_area(outline.points()) > 0.0);
    let again = Outline::new(outline.points().to_vec());
    assert_eq!(again.as_ref(), Ok(outline), "not what its type promises");
}

/// Every coordinate is a number.
pub fn finite(points: &[Point]) {
    assert!(points.iter().all(|p| p.x.is_finite() && p.y.is_finite()), "a coordinate is no number");
}

/// Drawing and smoothed outline are sound.
pub fn sound_shape(shape: &Shape) {
    sound(&shape.raw);
    sound(&shape.outline);
}

/// psi rises, closes after a period and has pitch curves made of numbers.
pub fn moves(transmission: &Transmission) {
    let period = transmission.driver_period();
    let rise = std::f64::consts::TAU / f64::from(transmission.follower_fold());
    assert!((transmission.psi(period) - transmission.psi(0.0) - rise).abs() < 1e-6 * rise);
    let mut last = transmission.psi(-0.1);
    for k in 0..32 {
        let phi = f64::from(k) * period / 32.0;
        let (psi, speed) = (transmission.psi(phi), transmission.derivative(phi));
        assert!(
            psi > last && speed > 0.0 && speed.is_finite(),
            "psi {psi} after {last}, psi' {speed}"
        );
        assert!((transmission.inverse(psi) - phi).abs() < 1e-6);
        last = psi;
    }
    let centrodes = Centrodes { transmission: transmission.clone(), center_distance: 80.0 };
    finite(&centrodes.driver_curve(64));
    finite(&centrodes.follower_curve(64));
}

/// Numbers out of the input, zeros once it is used up.
#[derive(Clone, Debug)]
pub struct Numbers<'a>(&'a [u8]);

impl<'a> Numbers<'a> {
    /// All of `data`.
    #[must_use]
    pub fn new(data: &'a [u8]) -> Self {
        Self(data)
    }

    /// The next byte.
    pub fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first
    }

    /// A whole number of the range, both ends included.
    pub fn within(&mut self, least: u32, most: u32) -> u32 {
        least + u32::from(self.byte()) % (most - least + 1)
    }

    /// A number from `least` to `most` in 65,536 steps.
    pub fn between(&mut self, least: f64, most: f64) -> f64 {
        let step = u16::from_be_bytes([self.byte(), self.byte()]);
        least + (most - least) * f64::from(step) / 65535.0
    }

    /// One of the ratios that drawings are fitted at.
    pub fn ratio(&mut self) -> Ratio {
        let known = ["1", "2", "1/2", "3", "1/3", "4", "1/4"];
        known[self.byte() as usize % known.len()].parse().unwrap_or(Ratio::ONE)
    }

    /// A polygon of 3 to 40 vertices: round its centre in order of direction (star-shaped), or
    /// each vertex wherever it falls.
    pub fn polygon(&mut self) -> Vec<Point> {
        let (star, count) = (self.byte() % 4 != 3, self.within(3, 40));
        (0..count)
            .map(|i| {
                if star {
                    let angle = std::f64::consts::TAU * f64::from(i) / f64::from(count);
                    geometry::rotate(Point::new(self.between(0.02, 1.0), 0.0), angle)
                } else {
                    Point::new(self.between(-1.0, 1.0), self.between(-1.0, 1.0))
                }
            })
            .collect()
    }

    /// What is left.
    #[must_use]
    pub fn rest(&self) -> &'a [u8] {
        self.0
    }
}
