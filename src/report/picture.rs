//! A still picture of the gears in mesh, as SVG in millimetres.

use super::text::{Grid, escape, plain};
use crate::assembly::{Assembly, PlacedGear};
use crate::geometry::{self, Point};
use crate::policy::PICTURE_DIGITS;
use std::fmt::Write as _;

/// Fill, outline and ink of the driver and of what it drives; a train alternates them.
/// Over light gears, and over dark ones.
const MARK_INKS: [&str; 2] = ["#000", "#fff"];
const GEAR_STYLES: [(&str, &str); 2] = [("#8fc3ea", "#4f8fc2"), ("#1f4e8c", "#12315a")];
const PITCH_INK: &str = "#e8702a";
const GHOST_INK: &str = "#8a94a1";
const TEXT_INK: &str = "#56616e";

/// What a picture shows.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureOptions {
    /// The pose: index into [`Assembly::driver_angle`]; beyond the end means the last.
    pub sample: usize,
    /// The input shapes, as ghosts behind the gears.
    pub input: bool,
    /// The pitch curves, dashed.
    pub pitch_curves: bool,
    /// Axis crosses and the line of centres.
    pub axes: bool,
    /// Names, teeth and centre distance.
    pub legend: bool,
    /// A white sheet behind everything; otherwise transparent.
    pub white_sheet: bool,
}

impl Default for PictureOptions {
    fn default() -> Self {
        Self {
            sample: 0,
            input: true,
            pitch_curves: true,
            axes: true,
            legend: true,
            white_sheet: true,
        }
    }
}

/// A gear as it lies in the picture: world position with y turned downwards, mm.
struct Posed<'a> {
    placed: &'a PlacedGear,
    outline: Vec<Point>,
    bore: Vec<Point>,
    openings: Vec<Vec<Point>>,
    /// What is raised or sunk on the face.
    marks: Vec<Vec<Point>>,
    pitch_curve: Vec<Point>,
    input: Vec<Point>,
    axis: Point,
}

impl<'a> Posed<'a> {
    fn new(placed: &'a PlacedGear, sample: usize) -> Self {
        let angle = placed.angle.get(sample).or(placed.angle.last()).copied().unwrap_or(0.0);
        let flip = |p: Point| Point::new(p.x, -p.y);
        let place = |points: &[Point]| -> Vec<Point> {
            let world = points.iter().map(|&p| geometry::rotate(p, angle) + placed.axis.coords);
            world.filter(|p| p.x.is_finite() && p.y.is_finite()).map(flip).collect()
        };
        let gear = &placed.gear;
        Self {
            placed,
            outline: place(&gear.outline),
            bore: place(gear.bore.as_deref().unwrap_or_default()),
            openings: gear.fittings.openings.iter().map(|o| place(&o.ring)).collect(),
            marks: gear.fittings.marks.iter().flat_map(|m| &m.face).map(|r| place(r)).collect(),
            pitch_curve: place(&gear.pitch_curve),
            input: place(&gear.input),
            axis: flip(placed.axis),
        }
    }
}

/// The gears in one pose of their motion, 1:1 in millimetres, as a complete SVG document.
///
/// The driver is light blue, the follower dark blue. Coordinates are rounded to about a
/// millionth of the picture's size.
#[must_use]
pub fn pair_svg(assembly: &Assembly, options: &PictureOptions) -> String {
    let gears: Vec<Posed> =
        assembly.gears.iter().map(|placed| Posed::new(placed, options.sample)).collect();
    let mut seen: Vec<Point> = Vec::new();
    for gear in &gears {
        seen.extend(&gear.outline);
        if options.input {
            seen.extend(&gear.input);
        }
    }
    let (mut low, mut high) = geometry::bounds(&seen);
    if seen.is_empty() {
        (low, high) = (Point::origin(), Point::new(1.0, 1.0));
    }
    let extent = (high.x - low.x).max(high.y - low.y);
    let sheet = Sheet { grid: Grid::for_extent(extent, PICTURE_DIGITS), unit: extent / 100.0 };

    let mut body = String::new();
    if options.input {
        sheet.ghosts(&gears, &mut body);
    }
    sheet.bodies(&gears, &mut body);
    if options.pitch_curves {
        sheet.pitch_curves(&gears, &mut body);
    }
    if options.axes {
        sheet.axes(&gears, &mut body);
    }
    if options.legend {
        high.y = sheet.legend(&gears, options, (low, high), &mut body);
    }

    let margin = 3.0 * sheet.unit;
    let n = |v: f64| sheet.grid.number(v);
    let (x, y) = (n(low.x - margin), n(low.y - margin));
    let (w, h) = (n(high.x - low.x + 2.0 * margin), n(high.y - low.y + 2.0 * margin));
    let names: Vec<_> = assembly.gears.iter().map(|g| escape(&g.gear.name)).collect();
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}mm\" height=\"{h}mm\" \
         viewBox=\"{x} {y} {w} {h}\">\n<title>{}</title>\n",
        names.join(" and ")
    );
    if options.white_sheet {
        let _ =
            writeln!(svg, "<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" fill=\"#fff\"/>");
    }
    svg + &body + "</svg>\n"
}

/// The measures of one picture; `unit` is a hundredth of the gears' larger extent, mm.
struct Sheet {
    grid: Grid,
    unit: f64,
}

impl Sheet {
    fn u(&self, units: f64) -> String {
        self.grid.number(units * self.unit)
    }

    fn ghosts(&self, gears: &[Posed], out: &mut String) {
        let _ = writeln!(
            out,
            "<g id=\"input\" fill-rule=\"evenodd\" fill=\"{GHOST_INK}\" fill-opacity=\".3\" stroke=\"{GHOST_INK}\" \
             stroke-width=\"{}\" stroke-linejoin=\"round\">",
            self.u(0.25)
        );
        for gear in gears {
            let (input, bore) = (self.grid.ring(&gear.input), self.grid.ring(&gear.bore));
            let _ = writeln!(out, "<path d=\"{input}{bore}\"/>");
        }
        out.push_str("</g>\n");
    }

    fn bodies(&self, gears: &[Posed], out: &mut String) {
        let _ = writeln!(
            out,
            "<g id=\"gears\" fill-rule=\"evenodd\" stroke-width=\"{}\" stroke-linejoin=\"round\">",
            self.u(0.15)
        );
        let styles = GEAR_STYLES.iter().zip(MARK_INKS).cycle();
        for (gear, ((fill, edge), ink)) in gears.iter().zip(styles) {
            let outline = self.grid.ring(&gear.outline);
            let holes = gear.openings.iter().chain([&gear.bore]);
            let bore: String = holes.map(|ring| self.grid.ring(ring)).collect();
            let _ = writeln!(
                out,
                "<path fill=\"{fill}\" stroke=\"{edge}\" d=\"{outline}{bore}\"><title>{}</title></path>",
                escape(&gear.placed.gear.name)
            );
            if !gear.marks.is_empty() {
                let marks: String = gear.marks.iter().map(|ring| self.grid.ring(ring)).collect();
                let _ = writeln!(out, "<path fill=\"{ink}\" fill-opacity=\".35\" d=\"{marks}\"/>");
            }
        }
        out.push_str("</g>\n");
    }

    fn pitch_curves(&self, gears: &[Posed], out: &mut String) {
        let _ = writeln!(
            out,
            "<g id=\"pitch-curves\" fill=\"none\" stroke=\"{PITCH_INK}\" stroke-width=\"{}\" \
             stroke-dasharray=\"{} {}\">",
            self.u(0.2),
            self.u(1.0),
            self.u(0.6)
        );
        for gear in gears {
            let _ = writeln!(out, "<path d=\"{}\"/>", self.grid.ring(&gear.pitch_curve));
        }
        out.push_str("</g>\n");
    }

    /// Crosses over a white halo, so that they show on bores and on bodies.
    fn axes(&self, gears: &[Posed], out: &mut String) {
        let centers: Vec<Point> = gears.iter().map(|gear| gear.axis).collect();
        let n = |v: f64| self.grid.number(v);
        let mut marks = String::new();
        for c in &centers {
            let (x, y) = (n(c.x - 1.6 * self.unit), n(c.y - 1.6 * self.unit));
            let arms = self.u(3.2);
            let _ = write!(marks, "M{x} {}h{arms}M{} {y}v{arms}", n(c.y), n(c.x));
        }
        let line = self.grid.line(&centers);
        let _ = writeln!(
            out,
            "<g id=\"axes\" fill=\"none\">\n\
             <path stroke=\"#fff\" stroke-opacity=\".35\" stroke-width=\"{}\" d=\"{line}\"/>\n\
             <path stroke=\"#3a4552\" stroke-opacity=\".75\" stroke-width=\"{}\" \
             stroke-dasharray=\"{} {} {} {}\" d=\"{line}\"/>\n\
             <path stroke=\"#fff\" stroke-width=\"{}\" stroke-linecap=\"round\" d=\"{marks}\"/>\n\
             <path stroke=\"#1d2732\" stroke-width=\"{}\" d=\"{marks}\"/>\n</g>",
            self.u(0.45),
            self.u(0.15),
            self.u(2.4),
            self.u(0.5),
            self.u(0.4),
            self.u(0.5),
            self.u(0.65),
            self.u(0.25),
        );
    }

    /// The dimension of the centre distance and a key below the gears; returns the new lower edge.
    fn legend(
        &self,
        gears: &[Posed],
        options: &PictureOptions,
        (low, high): (Point, Point),
        out: &mut String,
    ) -> f64 {
        let n = |v: f64| self.grid.number(v);
        let mut y = high.y;
        let _ = writeln!(
            out,
            "<g id=\"legend\" font-family=\"system-ui, Helvetica, Arial, sans-serif\" \
             font-size=\"{}\" fill=\"{TEXT_INK}\">",
            self.u(2.2)
        );
        if let [first, second] = gears {
            y += 5.0 * self.unit;
            let (a, b) = (first.axis, second.axis);
            let distance = plain((b - a).norm(), 4);
            let (tick, head) = (self.unit, 0.45 * self.unit);
            let arrow = |x: f64, way: f64| {
                let (back, up) = (n(x + way * 1.6 * self.unit), n(y - head));
                format!("M{} {}L{back} {up}V{}z", n(x), n(y), n(y + head))
            };
            let way = (b.x - a.x).signum();
            let _ = writeln!(
                out,
                "<path fill=\"none\" stroke=\"{TEXT_INK}\" stroke-width=\"{}\" \
                 d=\"M{} {}v{}M{} {}v{}M{} {}H{}\"/>\n<path d=\"{}{}\"/>\n\
                 <text x=\"{}\" y=\"{}\" text-anchor=\"middle\">centre distance {distance} mm</text>",
                self.u(0.15),
                n(a.x),
                n(y - tick),
                n(2.0 * tick),
                n(b.x),
                n(y - tick),
                n(2.0 * tick),
                n(a.x),
                n(y),
                n(b.x),
                arrow(a.x, way),
                arrow(b.x, -way),
                n(0.5 * (a.x + b.x)),
                n(y - 0.9 * self.unit),
            );
        }
        y += 5.0 * self.unit;
        let mut x = low.x;
        for (swatch, label) in self.key(gears, options) {
            // About half an em a letter, a swatch, and a gap.
            let width = (3.4 + 1.15 * label.chars().count() as f64 + 2.5) * self.unit;
            if x > low.x && x + width > high.x + 3.0 * self.unit {
                (x, y) = (low.x, y + 3.6 * self.unit);
            }
            let _ = writeln!(
                out,
                "<g transform=\"translate({} {})\">{swatch}<text x=\"{}\">{}</text></g>",
                n(x),
                n(y),
                self.u(3.4),
                escape(&label)
            );
            x += width;
        }
        out.push_str("</g>\n");
        y
    }

    fn key(&self, gears: &[Posed], options: &PictureOptions) -> Vec<(String, String)> {
        let size = self.u(2.4);
        let top = self.u(-2.0);
        let middle = self.u(-0.8);
        let mut key = Vec::new();
        for (gear, (fill, edge)) in gears.iter().zip(GEAR_STYLES.iter().cycle()) {
            let gear = &gear.placed.gear;
            key.push((
                format!(
                    "<rect y=\"{top}\" width=\"{size}\" height=\"{size}\" fill=\"{fill}\" \
                     stroke=\"{edge}\" stroke-width=\"{}\"/>",
                    self.u(0.15)
                ),
                format!("{}, {} teeth", gear.name, gear.teeth),
            ));
        }
        if options.input && gears.iter().any(|g| !g.input.is_empty()) {
            key.push((
                format!(
                    "<rect y=\"{top}\" width=\"{size}\" height=\"{size}\" fill=\"{GHOST_INK}\" \
                     fill-opacity=\".3\" stroke=\"{GHOST_INK}\" stroke-width=\"{}\"/>",
                    self.u(0.25)
                ),
                "input shapes".into(),
            ));
        }
        if options.pitch_curves {
            key.push((
                format!(
                    "<path fill=\"none\" stroke=\"{PITCH_INK}\" stroke-width=\"{}\" \
                     stroke-dasharray=\"{} {}\" d=\"M0 {middle}h{size}\"/>",
                    self.u(0.3),
                    self.u(0.8),
                    self.u(0.4)
                ),
                "pitch curves".into(),
            ));
        }
        key
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture;
    use super::*;

    fn parse(svg: &str) -> usvg::Tree {
        usvg::Tree::from_str(svg, &usvg::Options::default()).expect("well-formed SVG")
    }

    #[test]
    fn the_picture_parses_and_is_full_size() {
        let svg = pair_svg(&fixture::ellipses(), &PictureOptions::default());
        let tree = parse(&svg);
        // Two ellipses of 80 mm, end to end over a centre distance of 80 mm, and their teeth.
        let mm = tree.size().width() * 25.4 / 96.0;
        assert!((120.0..180.0).contains(&mm), "{mm}");
        let gears = tree.node_by_id("gears").expect("the gears are there");
        let width = gears.abs_bounding_box().width() * 25.4 / 96.0;
        assert!((width - 163.6).abs() < 0.5, "{width}");
    }

    #[test]
    fn a_pose_turns_the_gears_about_their_axes() {
        let assembly = fixture::ellipses();
        let quarter = assembly.driver_angle.len() / 4;
        let posed = Posed::new(&assembly.gears[0], quarter);
        let (low, _) = geometry::bounds(&posed.outline);
        // A quarter turn counter-clockwise points the long end up, which is -y here.
        assert!((low.y + 61.8).abs() < 0.5, "{low}");
    }

    #[test]
    fn hostile_names_stay_text() {
        let mut assembly = fixture::ellipses();
        assembly.gears[0].gear.name = "</title><script>alert(1)</script>&\u{0}".into();
        let svg = pair_svg(&assembly, &PictureOptions::default());
        parse(&svg);
        assert!(!svg.contains("<script"));
    }

    #[test]
    fn the_same_input_gives_the_same_picture() {
        let options = PictureOptions { sample: 7, ..PictureOptions::default() };
        assert_eq!(
            pair_svg(&fixture::ellipses(), &options),
            pair_svg(&fixture::ellipses(), &options)
        );
    }

    #[test]
    fn empty_and_broken_assemblies_still_parse() {
        let mut assembly = fixture::ellipses();
        assembly.gears[0].gear.outline[0].x = f64::NAN;
        assembly.gears[1].gear.outline.clear();
        assembly.gears[1].axis.x = f64::INFINITY;
        assembly.gears[1].angle.clear();
        parse(&pair_svg(&assembly, &PictureOptions::default()));
        assembly.gears.clear();
        parse(&pair_svg(&assembly, &PictureOptions::default()));
    }
}
