//! A small SVG canvas in millimetres, y upwards.

use std::fmt::Write as _;

use centrode::geometry::{Point, Vector, bounds};

pub(crate) const INK: &str = "#3b4450";
pub(crate) const LIGHT: &str = "#b9daf2";
pub(crate) const FAINT: &str = "#d9dee6";
pub(crate) const DARK: &str = "#1f4e8c";
pub(crate) const ORANGE: &str = "#e8702a";
pub(crate) const RED: &str = "#c8102e";

/// A picture under construction. Widths of lines and dots are in hundredths of its width.
pub(crate) struct Canvas {
    low: Point,
    high: Point,
    unit: f64,
    body: String,
    panels: usize,
    /// Middle and reach of what can be seen; beyond it curves are thinned.
    seen: (Point, f64),
}

/// Points kept of a curve outside the picture: one in so many.
const THINNING: usize = 10;

impl Canvas {
    /// A picture of everything in `points`, with a margin in mm.
    pub(crate) fn around(points: &[Point], margin: f64) -> Self {
        let (low, high) = bounds(points);
        let margin = Vector::new(margin, margin);
        Self::spanning(low - margin, high + margin)
    }

    /// A picture of what lies around `center`.
    pub(crate) fn window(center: Point, half_width: f64, half_height: f64) -> Self {
        let half = Vector::new(half_width, half_height);
        Self::spanning(center - half, center + half)
    }

    fn spanning(low: Point, high: Point) -> Self {
        Self {
            low,
            high,
            unit: (high.x - low.x) / 100.0,
            body: String::new(),
            panels: 0,
            seen: (low + 0.5 * (high - low), (high - low).norm()),
        }
    }

    fn path(&self, points: &[Point]) -> String {
        let mut path = String::new();
        for (i, p) in points.iter().enumerate() {
            let letter = if i == 0 { 'M' } else { 'L' };
            let _ = write!(path, "{letter}{:.3} {:.3}", p.x, -p.y);
        }
        path
    }

    fn stroke(&mut self, path: &str, fill: &str, ink: &str, width: f64, more: &str) {
        let width = width * self.unit;
        let _ = writeln!(
            self.body,
            "<path fill=\"{fill}\" stroke=\"{ink}\" stroke-width=\"{width:.3}\"{more} d=\"{path}\"/>"
        );
    }

    /// A closed curve.
    pub(crate) fn ring(&mut self, points: &[Point], fill: &str, ink: &str, width: f64) {
        let (middle, reach) = self.seen;
        let kept: Vec<Point> = points
            .iter()
            .enumerate()
            .filter(|(i, p)| i % THINNING == 0 || (**p - middle).norm() < reach)
            .map(|(_, p)| *p)
            .collect();
        let path = self.path(&kept) + "z";
        self.stroke(&path, fill, ink, width, "");
    }

    /// An open curve.
    pub(crate) fn line(&mut self, points: &[Point], ink: &str, width: f64) {
        let path = self.path(points);
        self.stroke(&path, "none", ink, width, "");
    }

    /// An open curve, dashed.
    pub(crate) fn dashed(&mut self, points: &[Point], ink: &str, width: f64) {
        let path = self.path(points);
        let dashes = format!(" stroke-dasharray=\"{:.3}\"", 0.6 * self.unit);
        self.stroke(&path, "none", ink, width, &dashes);
    }

    /// A filled circle.
    pub(crate) fn dot(&mut self, at: Point, radius: f64, ink: &str) {
        let radius = radius * self.unit;
        let _ = writeln!(
            self.body,
            "<circle cx=\"{:.3}\" cy=\"{:.3}\" r=\"{radius:.3}\" fill=\"{ink}\"/>",
            at.x, -at.y
        );
    }

    /// Words that begin at a point; `a_b` is written with b as a subscript.
    pub(crate) fn text(&mut self, at: Point, words: &str) {
        let size = 2.8 * self.unit;
        let (word, below) = words.split_once('_').unwrap_or((words, ""));
        let _ = write!(
            self.body,
            "<text x=\"{:.3}\" y=\"{:.3}\" font-family=\"sans-serif\" font-size=\"{size:.3}\" fill=\"{INK}\">{word}",
            at.x, -at.y
        );
        if !below.is_empty() {
            let _ = write!(
                self.body,
                "<tspan dy=\"{:.3}\" font-size=\"{:.3}\">{below}</tspan>",
                0.25 * size,
                0.7 * size
            );
        }
        self.body.push_str("</text>\n");
    }

    /// A straight arrow.
    pub(crate) fn arrow(&mut self, from: Point, to: Point, ink: &str) {
        self.line(&[from, to], ink, 0.35);
        self.head(to, (to - from).normalize(), ink);
    }

    /// Part of a circle.
    pub(crate) fn arc(&mut self, center: Point, radius: f64, from: f64, to: f64, ink: &str) {
        let points = arc_points(center, radius, from, to);
        self.line(&points, ink, 0.25);
    }

    /// Part of a circle with a head at its end.
    pub(crate) fn arc_arrow(&mut self, center: Point, radius: f64, from: f64, to: f64, ink: &str) {
        let points = arc_points(center, radius, from, to);
        self.line(&points, ink, 0.25);
        if let [.., before, last] = points.as_slice() {
            self.head(*last, (last - before).normalize(), ink);
        }
    }

    fn head(&mut self, tip: Point, way: Vector, ink: &str) {
        let (back, side) = (1.8 * self.unit * way, 0.7 * self.unit * Vector::new(-way.y, way.x));
        let path = self.path(&[tip, tip - back + side, tip - back - side]) + "z";
        self.stroke(&path, ink, ink, 0.1, "");
    }

    /// Everything until [`Self::end_panel`] is cut to a square.
    pub(crate) fn panel(&mut self, center: Point, half: f64) {
        self.panels += 1;
        self.seen = (center, 1.6 * half);
        let (x, y, size, n) = (center.x - half, -center.y - half, 2.0 * half, self.panels);
        let _ = writeln!(
            self.body,
            "<clipPath id=\"panel{n}\"><rect x=\"{x:.3}\" y=\"{y:.3}\" width=\"{size:.3}\" height=\"{size:.3}\"/></clipPath>\n\
             <g clip-path=\"url(#panel{n})\">"
        );
    }

    /// See [`Self::panel`].
    pub(crate) fn end_panel(&mut self) {
        self.body.push_str("</g>\n");
    }

    /// The SVG document, 800 units wide.
    pub(crate) fn finish(self, title: &str) -> String {
        let (width, height) = (self.high.x - self.low.x, self.high.y - self.low.y);
        let (x, y) = (self.low.x, -self.high.y);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"800\" height=\"{:.0}\" \
             viewBox=\"{x:.3} {y:.3} {width:.3} {height:.3}\">\n<title>{title}</title>\n\
             <rect x=\"{x:.3}\" y=\"{y:.3}\" width=\"{width:.3}\" height=\"{height:.3}\" fill=\"#fff\"/>\n{}</svg>\n",
            800.0 * height / width,
            self.body
        )
    }
}

fn arc_points(center: Point, radius: f64, from: f64, to: f64) -> Vec<Point> {
    (0..=24)
        .map(|i| {
            let angle = from + (to - from) * f64::from(i) / 24.0;
            center + radius * Vector::new(angle.cos(), angle.sin())
        })
        .collect()
}
