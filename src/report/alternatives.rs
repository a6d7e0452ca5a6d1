//! Alternatives side by side: a page of small turning pictures, and the same as data.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use serde_json::{Value, json};

use super::page::POLICY;
use super::text::{Grid, escape, json_for_script, plain};
use super::thin::thin_ring;
use crate::fit::{Fit, Similarity, difference};
use crate::geometry::Point;
use crate::outline::Outline;
use crate::pitch::Centrodes;

const STYLE: &str = include_str!("alternatives.css");
const SCRIPT: &str = include_str!("alternatives.js");

/// Points of a pitch curve in a small picture.
const CURVE_POINTS: usize = 240;
/// Chords of a small picture leave its curves by at most this, centre distances.
const TOLERANCE: f64 = 1e-3;
/// Steps of the extent of a picture that coordinates are rounded to, decimal digits.
const DIGITS: i32 = 4;
/// Samples of psi for one turn of the driver; between them it is drawn as linear.
const SAMPLES_A_TURN: usize = 90;
/// Room round the gears of a picture, centre distances.
const MARGIN: f64 = 0.04;

/// Pairs to choose from.
#[derive(Clone, Copy, Debug)]
pub struct Alternatives<'a> {
    /// Names of the two shapes.
    pub names: [&'a str; 2],
    /// The two drawings.
    pub shapes: [&'a Outline; 2],
    /// The pairs, best first.
    pub fits: &'a [Fit],
    /// The program and its version.
    pub made_by: &'a str,
}

impl Alternatives<'_> {
    /// Title of the page.
    fn title(&self) -> String {
        format!("{} and {}: {} pairs", self.names[0], self.names[1], self.fits.len())
    }

    /// One self-contained page: each pair turning, with its likeness and torque. Needs no network and no other file; without
    /// scripts it shows the first pose.
    #[must_use]
    pub fn html(&self) -> String {
        let title = escape(&self.title());
        let mut out = String::new();
        let _ = write!(
            out,
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta name=\"color-scheme\" content=\"light dark\">\n\
             <link rel=\"icon\" href=\"data:,\">\n<title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
             <header><h1>{title}</h1><p>Best first. Take one with <code>--choose</code> and its number.</p></header>\n<ol>\n"
        );
        let mut motions = Vec::new();
        for (i, fit) in self.fits.iter().enumerate() {
            let transmission = fit.transmission.clone();
            let pair = Centrodes { transmission, center_distance: 1.0 };
            self.card(i + 1, fit, &pair, &mut out);
            motions.push(turns(&pair));
        }
        let _ = write!(
            out,
            "</ol>\n<footer><p>{}</p></footer>\n<script type=\"application/json\" id=\"motions\">{}</script>\n\
             <script>\n{SCRIPT}</script>\n</body>\n</html>\n",
            escape(self.made_by),
            json_for_script(&json!(motions))
        );
        out
    }

    fn card(&self, number: usize, fit: &Fit, pair: &Centrodes, out: &mut String) {
        let reach = |radii: &dyn Fn(f64) -> f64| {
            (0..CURVE_POINTS)
                .map(|i| radii(pair.follower_turn() * i as f64 / CURVE_POINTS as f64))
                .fold(0.0, f64::max)
        };
        // Wherever the pair stands, it stays inside.
        let (driver, follower) =
            (reach(&|a| pair.driver_radius(a)), reach(&|a| pair.follower_radius(a)));
        let high = driver.max(follower) + MARGIN;
        let (left, width) = (-driver - MARGIN, driver + 1.0 + follower + 2.0 * MARGIN);
        let grid = Grid::for_extent(width, DIGITS);
        let _ = write!(
            out,
            "<li><figure><svg viewBox=\"{} {} {} {}\" role=\"img\" aria-label=\"pair {number}\">",
            plain(left, 4),
            plain(-high, 4),
            plain(width, 4),
            plain(2.0 * high, 4)
        );
        let placements = [fit.driver.placement, fit.follower.placement];
        let folds = [pair.transmission.driver_fold(), pair.transmission.follower_fold()];
        let curves = [
            pair.driver_curve(CURVE_POINTS * folds[0] as usize),
            pair.follower_curve(CURVE_POINTS * folds[1] as usize),
        ];
        for gear in 0..2 {
            let drawing = placed(self.shapes[gear], &placements[gear]);
            let _ = write!(
                out,
                "<g transform=\"translate({gear} 0) scale(1 -1)\"><g class=\"gear g{gear}\"><path class=\"curve\" d=\"{}\"/>\
                 <path class=\"drawing\" d=\"{}\"/></g><circle r=\".015\"/></g>",
                grid.ring(&thin_ring(&curves[gear], TOLERANCE)),
                grid.ring(&thin_ring(&drawing, TOLERANCE))
            );
        }
        let likeness = |gear: usize| plain(100.0 * [fit.driver.iou, fit.follower.iou][gear], 0);
        let _ = writeln!(
            out,
            "</svg><figcaption><b>{number}</b> <span>{} {} %</span> <span>{} {} %</span> <span>torque up to {}</span></figcaption></figure></li>",
            escape(self.names[0]),
            likeness(0),
            escape(self.names[1]),
            likeness(1),
            plain(fit.transmission.max_derivative(), 2)
        );
    }

    /// What the page shows, as data: angles in radians, points in the coordinates of the drawings, `torque` the greatest torque
    /// of the driver over the follower's, `difference` from the pair before it that is most like it.
    #[must_use]
    pub fn json(&self) -> Value {
        let rows: Vec<Value> = self.fits.iter().enumerate().map(|(i, f)| self.row(i, f)).collect();
        json!({ "made_by": self.made_by, "shapes": self.names, "alternatives": rows })
    }

    fn row(&self, at: usize, fit: &Fit) -> Value {
        let pair = Centrodes { transmission: fit.transmission.clone(), center_distance: 1.0 };
        let least = self.fits[..at].iter().map(|f| difference(f, fit)).reduce(f64::min);
        let gear = |g: &crate::fit::FittedGear| {
            let c = g.center_in_input;
            json!({ "likeness": g.iou, "axis": [c.x, c.y], "lost_area": g.lost_area })
        };
        json!({
            "choose": at + 1,
            "driver": gear(&fit.driver),
            "follower": gear(&fit.follower),
            "orientation": fit.follower.placement.angle,
            "likeness": 0.5 * (fit.driver.iou + fit.follower.iou),
            "torque": fit.transmission.max_derivative(),
            "max_lean": pair.max_lean(),
            "objective": fit.objective.total,
            "measure": fit.refinement.map(|r| r.after),
            "difference": least,
        })
    }
}

fn placed(outline: &Outline, placement: &Similarity) -> Vec<Point> {
    outline.points().iter().map(|p| placement.apply(*p)).collect()
}

/// Driver turns after which a pair stands as it stood, and the follower's turns at even driver angles up to there.
fn turns(pair: &Centrodes) -> Value {
    let t = &pair.transmission;
    // Both gears have turned a whole number of times.
    let turns = t.follower_fold();
    let count = SAMPLES_A_TURN * turns as usize;
    let at = |i: usize| t.psi(TAU * f64::from(turns) * i as f64 / count as f64) / TAU;
    let rounded = |x: f64| (x * 1e5).round() / 1e5;
    json!({ "turns": turns, "psi": (0..=count).map(|i| rounded(at(i))).collect::<Vec<f64>>() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::Control;
    use crate::fit::{FitOptions, Ratio, Search, alternatives};
    use crate::geometry::rotate;

    #[test]
    fn every_alternative_has_its_picture_and_its_row() {
        let ring = |r: fn(f64) -> f64| {
            let points = (0..200).map(|i| TAU * f64::from(i) / 200.0);
            Outline::new(points.map(|a| rotate(Point::new(r(a), 0.0), a)).collect()).unwrap()
        };
        let (a, b) = (
            ring(|t| 1.0 + 0.3 * t.cos() + 0.1 * (2.0 * t).sin()),
            ring(|t| 2.0 + 0.5 * (3.0 * t).cos() + 0.4 * t.sin()),
        );
        let options = FitOptions { search: Search::Coarse, samples: 128, ..FitOptions::default() };
        let ratio = Ratio::integer(2).unwrap();
        let fits = alternatives(&a, &b, ratio, &options, 4, Control::unwatched()).unwrap();
        assert!(fits.len() > 1);
        let page = Alternatives {
            names: ["a <b>", "c"],
            shapes: [&a, &b],
            fits: &fits,
            made_by: "a test",
        };
        let html = page.html();
        assert_eq!(html.matches("<figure>").count(), fits.len());
        assert!(html.contains("a &lt;b&gt;") && !html.contains("a <b>"));
        let data = page.json();
        let rows = data["alternatives"].as_array().unwrap();
        assert_eq!(rows.len(), fits.len());
        assert!(rows[0]["difference"].is_null());
        assert!(rows[1..].iter().all(|r| r["difference"].as_f64().unwrap() >= 0.08));
    }
}
