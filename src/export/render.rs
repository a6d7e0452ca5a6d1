//! A small picture of solids as they lie: what a file manager shows of a package.

use crate::solid::Mesh;
use nalgebra::{Isometry3, Point3, Rotation3, Vector3};
use tiny_skia::{Pixmap, PremultipliedColorU8};

/// A solid in the picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shown<'a> {
    pub(super) mesh: &'a Mesh,
    /// What takes its frame to the scene's.
    pub(super) place: Isometry3<f64>,
    /// sRGB.
    pub(super) color: [u8; 3],
}

/// How far the eye is above the horizon, radians: high enough to show outlines, low enough to show heights.
const ELEVATION: f64 = 0.95;
/// How far the scene is turned about z, radians.
const AZIMUTH: f64 = -0.35;
/// Where the light comes from, in the picture's frame: x right, y up, z to the eye.
const LIGHT: [f64; 3] = [-0.35, 0.5, 0.8];
/// Share of the light that comes from everywhere.
const AMBIENT: f64 = 0.35;
/// Margin about the scene, a share of the picture.
const MARGIN: f64 = 0.04;
/// Samples along each side of a pixel.
const SAMPLES: u32 = 3;

/// The solids from above and a little to one side on white as a PNG, its sides `pixels`; none when there is nothing to
/// draw.
pub(super) fn picture(shown: &[Shown<'_>], pixels: u32) -> Option<Vec<u8>> {
    let raster = Raster::of(shown, pixels * SAMPLES)?;
    raster.shrunk(pixels)?.encode_png().ok()
}

/// Samples of colour with their depth.
struct Raster {
    side: u32,
    colors: Vec<[u8; 3]>,
}

impl Raster {
    fn of(shown: &[Shown<'_>], side: u32) -> Option<Self> {
        let eye =
            Rotation3::from_axis_angle(&Vector3::x_axis(), ELEVATION - std::f64::consts::FRAC_PI_2)
                * Rotation3::from_axis_angle(&Vector3::z_axis(), AZIMUTH);
        let seen: Vec<(Vec<Point3<f64>>, &Shown<'_>)> = shown
            .iter()
            .map(|s| {
                let points = s.mesh.positions.iter().map(|p| eye * (s.place * Point3::from(*p)));
                (points.collect(), s)
            })
            .collect();
        let mut points = seen.iter().flat_map(|(points, _)| points);
        let first = points.next()?;
        let (low, high) = points.fold((*first, *first), |(low, high), p| (low.inf(p), high.sup(p)));
        let size = high - low;
        let longer = size.x.max(size.y);
        if !(longer > 0.0 && longer.is_finite()) {
            return None;
        }
        let scale = (1.0 - 2.0 * MARGIN) * f64::from(side) / longer;
        let middle = low + 0.5 * size;
        let half = 0.5 * f64::from(side);
        let mut raster = Self { side, colors: vec![[255; 3]; (side * side) as usize] };
        let mut depth = vec![f64::NEG_INFINITY; raster.colors.len()];
        let light = Vector3::from(LIGHT).normalize();
        for (points, s) in &seen {
            for t in &s.mesh.triangles {
                let corners = t.map(|i| points[i as usize]);
                let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
                if normal.z <= 0.0 {
                    continue;
                }
                let lit = normal.normalize().dot(&light).max(0.0);
                let shade = AMBIENT + (1.0 - AMBIENT) * lit;
                let color = s.color.map(|c| (f64::from(c) * shade).round() as u8);
                let at = corners.map(|p| {
                    [half + scale * (p.x - middle.x), half - scale * (p.y - middle.y), p.z]
                });
                raster.fill(&mut depth, at, color);
            }
        }
        Some(raster)
    }

    /// One triangle; x right and y down in samples, z towards the eye.
    fn fill(&mut self, depth: &mut [f64], [a, b, c]: [[f64; 3]; 3], color: [u8; 3]) {
        let side = f64::from(self.side);
        let range = |k: usize| {
            let low = a[k].min(b[k]).min(c[k]).floor().clamp(0.0, side) as u32;
            let high = a[k].max(b[k]).max(c[k]).ceil().clamp(0.0, side) as u32;
            low..high
        };
        let double = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if double == 0.0 {
            return;
        }
        for y in range(1) {
            for x in range(0) {
                let p = [f64::from(x) + 0.5, f64::from(y) + 0.5];
                let part = |u: [f64; 3], v: [f64; 3]| {
                    ((u[0] - p[0]) * (v[1] - p[1]) - (u[1] - p[1]) * (v[0] - p[0])) / double
                };
                let [wa, wb, wc] = [part(b, c), part(c, a), part(a, b)];
                if wa < 0.0 || wb < 0.0 || wc < 0.0 {
                    continue;
                }
                let z = wa * a[2] + wb * b[2] + wc * c[2];
                let i = (y * self.side + x) as usize;
                if z > depth[i] {
                    depth[i] = z;
                    self.colors[i] = color;
                }
            }
        }
    }

    /// The mean of the samples of each pixel.
    fn shrunk(&self, pixels: u32) -> Option<Pixmap> {
        let mut map = Pixmap::new(pixels, pixels)?;
        for (i, pixel) in map.pixels_mut().iter_mut().enumerate() {
            let (x, y) = (i as u32 % pixels, i as u32 / pixels);
            let mut sum = [0_u32; 3];
            for k in 0..SAMPLES * SAMPLES {
                let at = (y * SAMPLES + k / SAMPLES) * self.side + x * SAMPLES + k % SAMPLES;
                let color = self.colors[at as usize];
                (0..3).for_each(|c| sum[c] += u32::from(color[c]));
            }
            let [r, g, b] = sum.map(|s| (s / (SAMPLES * SAMPLES)) as u8);
            *pixel = PremultipliedColorU8::from_rgba(r, g, b, u8::MAX)?;
        }
        Some(map)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::wavy_pair;
    use super::*;

    #[test]
    fn every_solid_shows_in_its_colour_and_nearer_ones_hide_others() {
        let (_, meshes) = wavy_pair();
        let (red, blue) = ([255, 0, 0], [0, 0, 255]);
        let at = |x, z, color| Shown {
            mesh: &meshes[0],
            place: Isometry3::translation(x, 0.0, z),
            color,
        };
        let count = |shown: &[Shown<'_>]| {
            let raster = Raster::of(shown, 300).unwrap();
            let of = |k: usize| {
                raster.colors.iter().filter(|c| c[k] > 0 && c[(k + 2) % 4 % 3] == 0).count()
            };
            [of(0), of(2)]
        };
        let [reds, blues] = count(&[at(0.0, 0.0, red), at(90.0, 0.0, blue)]);
        assert!(reds > 3000 && reds.abs_diff(blues) < reds / 10, "{reds} {blues}");
        // The upper one of two in one place hides nearly all of the other.
        let [reds, blues] = count(&[at(0.0, 7.0, red), at(0.0, 0.0, blue)]);
        assert!(reds > 3 * blues, "{reds} {blues}");
        assert_eq!(&picture(&[at(0.0, 0.0, red)], 64).unwrap()[1..4], b"PNG");
        assert!(picture(&[], 64).is_none());
    }
}
