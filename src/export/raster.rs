//! Pixels of the gears in one pose: for moving pictures.

use crate::assembly::{Assembly, PlacedGear};
use crate::geometry::{Point, bounds, rotate};
use crate::policy;
use tiny_skia::{Color, FillRule, Paint, PathBuilder, Pixmap, Stroke, Transform};

/// The sheet behind the gears, sRGB.
pub(super) const SHEET: [u8; 3] = [255, 255, 255];
/// The mark on each axis and the dot that shows how far a gear has turned, sRGB.
pub(super) const MARK: [u8; 3] = [232, 112, 42];

/// A view of the gears that takes in every pose.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    low: Point,
    scale: f64,
    /// Width and height, pixels.
    pub(super) size: [u32; 2],
}

impl View {
    /// The view whose longer side is `pixels`, or none for an assembly without extent.
    pub(super) fn of_all_poses(assembly: &Assembly, pixels: u32) -> Option<Self> {
        let mut corners = Vec::new();
        for placed in &assembly.gears {
            let reach = placed.gear.outline.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
            let margin = (1.0 + policy::RASTER_MARGIN) * reach;
            for sign in [-1.0, 1.0] {
                corners.push(placed.axis + sign * crate::geometry::Vector::new(margin, margin));
            }
        }
        if corners.is_empty() {
            return None;
        }
        let (low, high) = bounds(&corners);
        let extent = high - low;
        let longer = extent.x.max(extent.y);
        if !(longer > 0.0 && longer.is_finite()) {
            return None;
        }
        let scale = f64::from(pixels) / longer;
        let size = [extent.x, extent.y].map(|side| ((side * scale).round() as u32).max(1));
        Some(Self { low: Point::new(low.x, high.y), scale, size })
    }

    fn pixel(&self, p: Point) -> (f32, f32) {
        let at = |v: f64| (v * self.scale) as f32;
        (at(p.x - self.low.x), at(self.low.y - p.y))
    }

    /// The gears at the angles given, one for each, over the sheet.
    pub(super) fn draw(&self, assembly: &Assembly, angles: &[f64]) -> Option<Pixmap> {
        let mut picture = Pixmap::new(self.size[0], self.size[1])?;
        picture.fill(color(SHEET));
        for (i, (placed, &angle)) in assembly.gears.iter().zip(angles).enumerate() {
            self.gear(&mut picture, placed, angle, super::contours::color(i));
        }
        Some(picture)
    }

    fn gear(&self, picture: &mut Pixmap, placed: &PlacedGear, angle: f64, fill: [u8; 3]) {
        let gear = &placed.gear;
        let mut path = PathBuilder::new();
        for ring in std::iter::once(&gear.outline).chain(&gear.bore) {
            for (k, &p) in ring.iter().enumerate() {
                let (x, y) = self.pixel(rotate(p, angle) + placed.axis.coords);
                if k == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
            }
            path.close();
        }
        let mut paint = Paint { anti_alias: true, ..Paint::default() };
        paint.set_color(color(fill));
        let Some(path) = path.finish() else { return };
        picture.fill_path(&path, &paint, FillRule::EvenOdd, Transform::identity(), None);
        // A spoke from the axis along the gear's own x: eyes follow it where an outline looks alike.
        let reach = gear.outline.iter().map(|p| p.coords.norm()).fold(f64::INFINITY, f64::min);
        let inner = gear.bore.iter().flatten().map(|p| p.coords.norm()).fold(0.0, f64::max);
        let spoke = [inner.max(policy::RASTER_SPOKE[0] * reach), policy::RASTER_SPOKE[1] * reach];
        if spoke[0] < spoke[1] {
            let mut line = PathBuilder::new();
            let [from, to] =
                spoke.map(|r| self.pixel(rotate(Point::new(r, 0.0), angle) + placed.axis.coords));
            line.move_to(from.0, from.1);
            line.line_to(to.0, to.1);
            paint.set_color(color(MARK));
            let stroke = Stroke { width: policy::RASTER_SPOKE_WIDTH as f32, ..Stroke::default() };
            if let Some(line) = line.finish() {
                picture.stroke_path(&line, &paint, &stroke, Transform::identity(), None);
            }
        }
    }
}

fn color([r, g, b]: [u8; 3]) -> Color {
    Color::from_rgba8(r, g, b, u8::MAX)
}

#[cfg(test)]
mod tests {
    use super::super::tests::wavy_pair;
    use super::*;

    #[test]
    fn the_share_of_coloured_pixels_is_the_gears_area() {
        let (assembly, _) = wavy_pair();
        let view = View::of_all_poses(&assembly, 400).unwrap();
        let picture = view.draw(&assembly, &[0.3, -0.2]).unwrap();
        let coloured =
            picture.pixels().iter().filter(|p| [p.red(), p.green(), p.blue()] != SHEET).count()
                as f64;
        let millimetres = coloured / view.scale.powi(2);
        let area: f64 = assembly.gears.iter().map(|g| crate::geometry::area(&g.gear.outline)).sum();
        // The wavy gears overlap by some teeth, and bores stay white.
        assert!((millimetres / area - 1.0).abs() < 0.06, "{millimetres} {area}");
        assert_eq!(view.size[0], 400);
    }
}
