//! The turning gears as a moving picture, for a README or a chat.

use super::contours::color;
use super::keys::keys;
use super::raster::{MARK, SHEET, View};
use super::xml::escaped;
use super::{Artifact, Encode, EncodeError, Entry, Parts};
use crate::assembly::Assembly;
use crate::geometry::Point;
use crate::policy;
use rayon::prelude::*;
use std::collections::HashMap;
use std::fmt::Write as _;
use std::io::{self, Write};

/// `turning.gif` and `turning.svg`: one whole cycle, repeated for ever.
///
/// The GIF is for chats and pages that show nothing else; the SVG stays sharp and small, and turns wherever
/// SMIL animation is shown (browsers, README pages).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Animation {
    /// Time the driver takes for one turn, s.
    pub seconds_per_driver_turn: f64,
    /// Longer side of the GIF, pixels.
    pub pixels: u32,
}

impl Default for Animation {
    fn default() -> Self {
        Self {
            seconds_per_driver_turn: policy::SECONDS_PER_DRIVER_TURN,
            pixels: policy::ANIMATION_PIXELS,
        }
    }
}

/// See [`Entry`].
pub(super) const ENTRY: Entry = Entry {
    name: "gif",
    files: &[(
        &["turning.gif", "turning.svg"],
        "the turning pair for a chat or a README (`--animate`, or `--export gif` alone)",
    )],
    unasked: false,
    encoders: |_| vec![Box::new(Animation::default())],
    ..Entry::PLAIN
};

impl Encode for Animation {
    fn encode<'a>(&'a self, parts: Parts<'a>) -> Result<Vec<Artifact<'a>>, EncodeError> {
        let gif = Artifact::stream("turning.gif", |out| self.gif(parts.assembly, out));
        Ok(vec![gif, Artifact::bytes("turning.svg", self.svg(parts.assembly))])
    }
}

impl Animation {
    fn gif(&self, assembly: &Assembly, out: impl Write) -> io::Result<()> {
        let nothing = || io::Error::new(io::ErrorKind::InvalidInput, "there is no gear to draw");
        let view = View::of_all_poses(assembly, self.pixels).ok_or_else(nothing)?;
        let cycle = assembly.driver_angle.last().copied().unwrap_or_default();
        let seconds = self.seconds_per_driver_turn * cycle / std::f64::consts::TAU;
        let frames = ((seconds * policy::GIF_FRAMES_PER_SECOND).round() as usize)
            .clamp(policy::GIF_FRAMES[0], policy::GIF_FRAMES[1]);
        // Hundredths of a second, as the format counts.
        let delay = (100.0 / policy::GIF_FRAMES_PER_SECOND).round() as u16;
        let palette = Palette::new();
        let [width, height] = view.size.map(|side| u16::try_from(side).unwrap_or(u16::MAX));
        let broken = |e: gif::EncodingError| io::Error::other(e.to_string());
        let mut encoder =
            gif::Encoder::new(out, width, height, &palette.bytes()).map_err(broken)?;
        encoder.set_repeat(gif::Repeat::Infinite).map_err(broken)?;
        let drawn: Option<Vec<Vec<u8>>> = (0..frames)
            .into_par_iter()
            .map(|k| {
                let angles = angles_at(assembly, cycle * k as f64 / frames as f64);
                let picture = view.draw(assembly, &angles)?;
                let mut palette = palette.clone();
                let colors = picture.pixels().iter().map(|p| [p.red(), p.green(), p.blue()]);
                Some(colors.map(|c| palette.nearest(c)).collect())
            })
            .collect();
        for indices in drawn.ok_or_else(nothing)? {
            let frame =
                gif::Frame { delay, width, height, buffer: indices.into(), ..Default::default() };
            encoder.write_frame(&frame).map_err(broken)?;
        }
        Ok(())
    }

    /// The gears as SVG in millimetres, each turned by SMIL keys between which it runs straight within
    /// [`policy::ANIMATION_ANGLE_ERROR`].
    fn svg(&self, assembly: &Assembly) -> String {
        let mut corners: Vec<Point> = Vec::new();
        for placed in &assembly.gears {
            let reach = placed.gear.outline.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
            let reach = (1.0 + policy::RASTER_MARGIN) * reach;
            for sign in [-1.0, 1.0] {
                let p = placed.axis + sign * crate::geometry::Vector::new(reach, reach);
                corners.push(Point::new(p.x, -p.y));
            }
        }
        let (low, high) = crate::geometry::bounds(&corners);
        let (w, h) = (high.x - low.x, high.y - low.y);
        let cycle = assembly.driver_angle.last().copied().unwrap_or(1.0);
        let seconds = self.seconds_per_driver_turn * cycle / std::f64::consts::TAU;
        let keys = keys(assembly);
        let times: Vec<String> =
            keys.iter().map(|&k| format!("{:.5}", assembly.driver_angle[k] / cycle)).collect();
        let times = times.join(";");
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w:.3}mm\" height=\"{h:.3}mm\" \
             viewBox=\"{:.3} {:.3} {w:.3} {h:.3}\">\n",
            low.x, low.y
        );
        for (i, placed) in assembly.gears.iter().enumerate() {
            let [r, g, b] = color(i);
            let mut path = String::new();
            for ring in std::iter::once(&placed.gear.outline).chain(&placed.gear.bore) {
                for (k, p) in ring.iter().enumerate() {
                    let letter = if k == 0 { 'M' } else { 'L' };
                    let _ = write!(path, "{letter}{:.3} {:.3}", p.x, 0.0 - p.y);
                }
                path.push('Z');
            }
            // The picture's y points down: a turn counter-clockwise is a negative one.
            let turns: Vec<String> = keys
                .iter()
                .map(|&k| {
                    format!("{:.4}", 0.0 - placed.angle.get(k).copied().unwrap_or(0.0).to_degrees())
                })
                .collect();
            let start = turns.first().map_or("0", String::as_str);
            let _ = writeln!(
                svg,
                "<g transform=\"translate({:.4} {:.4})\"><g transform=\"rotate({start})\"><title>{}</title>\
                 <path fill=\"#{r:02x}{g:02x}{b:02x}\" fill-rule=\"evenodd\" d=\"{path}\"/>\
                 <animateTransform attributeName=\"transform\" type=\"rotate\" dur=\"{seconds:.3}s\" \
                 repeatCount=\"indefinite\" calcMode=\"linear\" keyTimes=\"{times}\" values=\"{}\"/></g></g>",
                placed.axis.x,
                0.0 - placed.axis.y,
                escaped(&placed.gear.name),
                turns.join(";"),
            );
        }
        svg.push_str("</svg>\n");
        svg
    }
}

/// Every gear's angle when the driver stands at `phi`, interpolated between samples.
fn angles_at(assembly: &Assembly, phi: f64) -> Vec<f64> {
    let time = &assembly.driver_angle;
    let to = time.partition_point(|&t| t <= phi).clamp(1, time.len().saturating_sub(1).max(1));
    assembly
        .gears
        .iter()
        .map(|g| match (g.angle.get(to - 1), g.angle.get(to)) {
            (Some(a), Some(b)) => a + (b - a) * (phi - time[to - 1]) / (time[to] - time[to - 1]),
            (a, _) => a.copied().unwrap_or(0.0),
        })
        .collect()
}

/// The colours of a picture and the blends between any two of them, as edges are smoothed.
#[derive(Clone)]
struct Palette {
    colors: Vec<[u8; 3]>,
    known: HashMap<[u8; 3], u8>,
}

impl Palette {
    fn new() -> Self {
        let pure = [SHEET, color(0), color(1), MARK];
        let mut colors = pure.to_vec();
        let steps = policy::GIF_BLENDS;
        for (i, a) in pure.iter().enumerate() {
            for b in &pure[i + 1..] {
                for k in 1..steps {
                    let t = f64::from(k) / f64::from(steps);
                    let mix = |c: usize| {
                        (f64::from(a[c]) * (1.0 - t) + f64::from(b[c]) * t).round() as u8
                    };
                    colors.push([mix(0), mix(1), mix(2)]);
                }
            }
        }
        Self { colors, known: HashMap::new() }
    }

    fn bytes(&self) -> Vec<u8> {
        self.colors.concat()
    }

    fn nearest(&mut self, wanted: [u8; 3]) -> u8 {
        let colors = &self.colors;
        *self.known.entry(wanted).or_insert_with(|| {
            let far = |c: &[u8; 3]| -> i32 {
                c.iter().zip(&wanted).map(|(&a, &b)| (i32::from(a) - i32::from(b)).pow(2)).sum()
            };
            let best = (0..colors.len()).min_by_key(|&i| far(&colors[i]));
            best.and_then(|i| u8::try_from(i).ok()).unwrap_or(0)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::wavy_pair;
    use super::*;

    #[test]
    fn the_gif_runs_for_ever_and_its_gears_move() {
        let (assembly, _) = wavy_pair();
        let animation = Animation { pixels: 120, ..Animation::default() };
        let mut bytes = Vec::new();
        animation.gif(&assembly, &mut bytes).unwrap();
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(&bytes[..]).unwrap();
        let mut frames = Vec::new();
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            frames.push(frame.buffer.to_vec());
        }
        assert_eq!(decoder.repeat(), gif::Repeat::Infinite);
        assert!(frames.len() >= policy::GIF_FRAMES[0]);
        assert!(frames.windows(2).all(|f| f[0] != f[1]));
        assert!(Palette::new().colors.len() <= 256);
    }

    #[test]
    fn the_svg_turns_each_gear_as_the_motion_says() {
        let (assembly, _) = wavy_pair();
        let svg = Animation::default().svg(&assembly);
        let tree = usvg::Tree::from_str(&svg, &usvg::Options::default()).unwrap();
        assert!(tree.size().width() > 100.0);
        let values: Vec<&str> =
            svg.split("values=\"").skip(1).map(|v| v.split('"').next().unwrap()).collect();
        assert_eq!(values.len(), 2);
        for (turns, placed) in values.iter().zip(&assembly.gears) {
            let last: f64 = turns.rsplit(';').next().unwrap().parse().unwrap();
            assert!((last + placed.angle.last().unwrap().to_degrees()).abs() < 1e-3);
        }
    }

    #[test]
    fn poses_between_samples_are_interpolated() {
        let (assembly, _) = wavy_pair();
        let half = 0.5 * (assembly.driver_angle[10] + assembly.driver_angle[11]);
        let found = angles_at(&assembly, half);
        assert!((found[0] - half).abs() < 1e-12);
        let last = *assembly.driver_angle.last().unwrap();
        assert!((angles_at(&assembly, last)[1] - assembly.gears[1].angle[1024]).abs() < 1e-12);
    }
}
