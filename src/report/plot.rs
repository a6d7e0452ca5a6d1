//! Small line plots as inline SVG, coloured by the page's style sheet.

use super::data::Plot;
use super::text::{Grid, escape, plain};
use super::thin::thin_curve;
use crate::geometry::Point;
use crate::policy::PLOT_POINTS;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Size of the drawing, in its own units (pixels at the usual width).
const WIDTH: f64 = 420.0;
const HEIGHT: f64 = 236.0;
/// Left, top, width and height of the plotting field.
const FIELD: [f64; 4] = [44.0, 26.0, 364.0, 168.0];
/// Colours the style sheet knows; more series begin again.
const COLORS: usize = 6;
/// Fraction of the range left free above and below the curves.
const HEADROOM: f64 = 0.06;
/// The same where the name of a limit must find room.
const LIMIT_HEADROOM: f64 = 0.12;

/// A plot with its scales fixed: x in degrees if it follows the driver.
pub(super) struct Scaled<'a> {
    plot: &'a Plot,
    curves: Vec<Vec<(f64, f64)>>,
    x: (f64, f64),
    y: (f64, f64),
}

impl<'a> Scaled<'a> {
    pub(super) fn new(plot: &'a Plot) -> Self {
        let shown = |x: f64| if plot.follows_driver { x.to_degrees() } else { x };
        let curves: Vec<Vec<_>> = plot
            .series
            .iter()
            .map(|s| {
                let points: Vec<_> = s.points.iter().map(|&(x, y)| (shown(x), y)).collect();
                thin_curve(&points, PLOT_POINTS)
            })
            .collect();
        let x = range(curves.iter().flatten().map(|p| p.0));
        let limits = plot.limits.iter().map(|l| l.value);
        let (low, high) = range(curves.iter().flatten().map(|p| p.1).chain(limits));
        let headroom = if plot.limits.is_empty() { HEADROOM } else { LIMIT_HEADROOM };
        let room = headroom * (high - low);
        Self { plot, curves, x, y: (low - room, high + room) }
    }

    fn place(&self, (x, y): (f64, f64)) -> Point {
        let [left, top, width, height] = FIELD;
        Point::new(
            left + width * (x - self.x.0) / (self.x.1 - self.x.0),
            top + height * (self.y.1 - y) / (self.y.1 - self.y.0),
        )
    }

    /// What the page's script needs to move the cursor.
    pub(super) fn json(&self) -> Value {
        let series: Vec<Value> = self
            .plot
            .series
            .iter()
            .zip(&self.curves)
            .map(|(s, curve)| {
                let points: Vec<_> =
                    curve.iter().map(|p| json!([rounded(p.0), rounded(p.1)])).collect();
                json!({ "name": s.name, "points": points })
            })
            .collect();
        json!({
            "title": self.plot.title, "x_label": self.plot.x_label, "y_label": self.plot.y_label,
            "follows_driver": self.plot.follows_driver, "series": series,
            "limits": self.plot.limits.iter().map(|l| json!({ "label": l.label, "value": l.value }))
                .collect::<Vec<_>>(),
            "field": FIELD, "x": [self.x.0, self.x.1], "y": [self.y.0, self.y.1],
        })
    }

    /// The plot as a figure; `index` is its place in the page's data.
    pub(super) fn html(&self, index: usize) -> String {
        let follows = if self.plot.follows_driver { " follows" } else { "" };
        let title = escape(&self.plot.title);
        let mut out = format!(
            "<figure class=\"card plot{follows}\" data-plot=\"{index}\">\n<figcaption><h3>{title}</h3>\n<ul>"
        );
        for (i, series) in self.plot.series.iter().enumerate() {
            let _ = write!(
                out,
                "<li class=\"s{}\"><i></i>{} <output></output></li>",
                i % COLORS,
                escape(&series.name)
            );
        }
        let _ = write!(
            out,
            "</ul></figcaption>\n<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"{title}\">\n"
        );
        self.axes(&mut out);
        self.limits(&mut out);
        let grid = Grid::for_extent(WIDTH, 4);
        for (i, curve) in self.curves.iter().enumerate() {
            let points: Vec<Point> = curve.iter().map(|&p| self.place(p)).collect();
            let _ = writeln!(
                out,
                "<path class=\"curve s{}\" d=\"{}\"/>",
                i % COLORS,
                grid.line(&points)
            );
        }
        if self.plot.follows_driver {
            let [left, top, _, height] = FIELD;
            let _ = write!(out, "<g class=\"cursor\"><path d=\"M{left} {top}v{height}\"/>");
            for i in 0..self.curves.len() {
                let _ = write!(out, "<circle class=\"s{}\" r=\"4\"/>", i % COLORS);
            }
            out.push_str("</g>\n");
        }
        out + "</svg>\n</figure>\n"
    }

    fn axes(&self, out: &mut String) {
        let [left, top, width, height] = FIELD;
        let n = |v: f64| plain(v, 1);
        let x_step = if self.plot.follows_driver {
            degree_step(self.x.1 - self.x.0)
        } else {
            step(self.x.1 - self.x.0, 7.0)
        };
        let y_step = step(self.y.1 - self.y.0, 5.0);
        out.push_str("<g class=\"axes\">\n");
        for v in ticks(self.y, y_step) {
            let y = self.place((self.x.0, v)).y;
            let _ = writeln!(
                out,
                "<path d=\"M{left} {}h{width}\"/><text x=\"{}\" y=\"{}\" class=\"y\">{}</text>",
                n(y),
                n(left - 6.0),
                n(y + 4.0),
                tick_text(v, y_step)
            );
        }
        for v in ticks(self.x, x_step) {
            let x = self.place((v, self.y.0)).x;
            let _ = writeln!(
                out,
                "<path d=\"M{} {}v4\"/><text x=\"{}\" y=\"{}\" class=\"x\">{}</text>",
                n(x),
                n(top + height),
                n(x),
                n(top + height + 17.0),
                tick_text(v, x_step)
            );
        }
        let _ = writeln!(
            out,
            "<path class=\"base\" d=\"M{left} {}h{width}\"/>\n\
             <text class=\"label\" x=\"4\" y=\"14\">{}</text>\n\
             <text class=\"label end\" x=\"{}\" y=\"{}\">{}</text>\n</g>",
            n(top + height),
            escape(&self.plot.y_label),
            n(left + width),
            n(HEIGHT - 7.0),
            escape(&self.plot.x_label)
        );
    }

    fn limits(&self, out: &mut String) {
        let [left, _, width, _] = FIELD;
        for limit in self.plot.limits.iter().filter(|l| l.value.is_finite()) {
            let y = self.place((self.x.0, limit.value)).y;
            let _ = writeln!(
                out,
                "<g class=\"limit\"><path d=\"M{left} {}h{width}\"/><text x=\"{}\" y=\"{}\">{}</text></g>",
                plain(y, 1),
                plain(left + width, 1),
                plain(y - 5.0, 1),
                escape(&limit.label)
            );
        }
    }
}

/// Enough digits for a read-out, few enough for a small page.
fn rounded(v: f64) -> f64 {
    format!("{v:.5e}").parse().unwrap_or(v)
}

/// The range of the finite values, never empty.
fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    let (low, high) =
        values.filter(|v| v.is_finite()).fold(start, |(low, high), v| (low.min(v), high.max(v)));
    if low > high {
        return (0.0, 1.0);
    }
    // A curve that is flat but for rounding shall look flat.
    let least = 1e-9 * low.abs().max(high.abs()).max(1e-12);
    if high - low > least {
        return (low, high);
    }
    let half = if low == 0.0 { 1.0 } else { 0.1 * low.abs() };
    (low - half, high + half)
}

/// A step of 1, 2 or 5 times a power of ten that cuts `span` into about `pieces`.
fn step(span: f64, pieces: f64) -> f64 {
    let raw = span / pieces;
    let power = 10f64.powf(raw.log10().floor());
    let lead = [1.0, 2.0, 5.0].into_iter().find(|m| m * power >= raw * 0.999);
    lead.unwrap_or(10.0) * power
}

/// A step in degrees that people expect: parts of a right angle, then whole turns.
fn degree_step(span: f64) -> f64 {
    let steps = [15.0, 30.0, 45.0, 60.0, 90.0, 180.0, 360.0];
    let fitting = steps.into_iter().find(|s| span / s <= 8.5);
    match fitting {
        Some(s) if span > 60.0 => s,
        Some(_) => step(span, 6.0),
        None => 360.0 * step(span / 360.0, 6.0).max(1.0),
    }
}

fn ticks((low, high): (f64, f64), step: f64) -> Vec<f64> {
    let first = (low / step - 1e-6).ceil();
    // The steps above make at most ten; the bound guards against ranges beyond f64's digits.
    (0..20).map(|i| (first + f64::from(i)) * step).filter(|v| *v <= high + 1e-6 * step).collect()
}

fn tick_text(v: f64, step: f64) -> String {
    if v != 0.0 && !(1e-4..1e6).contains(&step) {
        return escape(&format!("{v:.1e}").replace('-', "−"));
    }
    let decimals = (-(step.log10() + 1e-9).floor()).clamp(0.0, 6.0) as usize;
    plain(v, decimals).replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_fall_on_round_numbers() {
        assert_eq!(degree_step(360.0), 45.0);
        assert_eq!(degree_step(720.0), 90.0);
        assert_eq!(degree_step(3600.0), 720.0);
        assert_eq!(step(2.9, 5.0), 1.0);
        let shown: Vec<_> =
            ticks((-0.07, 0.06), 0.02).iter().map(|v| tick_text(*v, 0.02)).collect();
        assert_eq!(shown, ["−0.06", "−0.04", "−0.02", "0", "0.02", "0.04", "0.06"]);
    }

    #[test]
    fn flat_empty_and_broken_curves_have_a_range() {
        for points in
            [vec![], vec![(0.0, 2.0), (1.0, 2.0)], vec![(f64::NAN, 1.0), (1.0, f64::INFINITY)]]
        {
            let plot = Plot::over_driver_angle("t", "y").series("s", points).limit("l", f64::NAN);
            let scaled = Scaled::new(&plot);
            assert!(scaled.x.0 < scaled.x.1 && scaled.y.0 < scaled.y.1);
            let html = scaled.html(0);
            assert!(!html.contains("NaN") && !html.contains("inf"), "{html}");
        }
    }

    #[test]
    fn the_scales_map_the_field_corner_to_corner() {
        let plot = Plot::over_driver_angle("t", "y")
            .series("s", vec![(0.0, 0.0), (std::f64::consts::TAU, 1.0)]);
        let scaled = Scaled::new(&plot);
        let end = scaled.place((360.0, 1.0));
        assert!((end.x - 408.0).abs() < 1e-9);
        assert!((end.y - (26.0 + 168.0 * 0.06 / 1.12)).abs() < 1e-9);
    }
}
