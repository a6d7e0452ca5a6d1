//! The outer contour of the largest region where sampled values are positive.

use crate::geometry::Point;
use crate::policy;

/// Values on a grid of pixels, row by row from the top.
pub(super) struct Field {
    values: Vec<f32>,
    width: usize,
    height: usize,
    covered_width: f64,
}

impl Field {
    /// A field of rows of `width` values. The last column may lie partly outside of the
    /// picture; `covered_width` is the picture's true width in columns.
    pub(super) fn new(values: Vec<f32>, width: usize, covered_width: f64) -> Self {
        let height = values.len() / width;
        Self { values, width, height, covered_width }
    }

    pub(super) fn covered_width(&self) -> f64 {
        self.covered_width
    }

    pub(super) fn negate(&mut self) {
        self.values.iter_mut().for_each(|v| *v = -*v);
    }

    /// Whether more than half of the border is positive.
    pub(super) fn mostly_positive_border(&self) -> bool {
        let border: Vec<f32> = self.border().collect();
        2 * border.iter().filter(|v| **v > 0.0).count() > border.len()
    }

    /// Whether all of the border is positive.
    pub(super) fn wholly_positive_border(&self) -> bool {
        self.border().all(|v| v > 0.0)
    }

    fn border(&self) -> impl Iterator<Item = f32> {
        let (w, h) = (self.width, self.height);
        let rows = (0..w).flat_map(move |x| [(x, 0), (x, h - 1)]);
        let columns = (0..h).flat_map(move |y| [(0, y), (w - 1, y)]);
        rows.chain(columns).map(move |(x, y)| self.values[y * w + x])
    }

    /// The field blurred by a Gaussian of `sigma` pixels, in a frame of ground wide enough
    /// that nothing positive reaches its border; also the width of that frame.
    fn framed_and_blurred(&self, sigma: f64) -> (Self, usize) {
        let reach = (3.0 * sigma).ceil() as usize;
        let frame = reach + 2;
        let (width, height) = (self.width + 2 * frame, self.height + 2 * frame);
        let (sum, count) = self
            .border()
            .filter(|v| *v < 0.0)
            .fold((0.0, 0.0_f64), |(sum, count), v| (sum + f64::from(v), count + 1.0));
        let ground = if count > 0.0 { sum / count } else { -1.0 };
        let mut values = vec![ground as f32; width * height];
        for (y, row) in self.values.chunks_exact(self.width).enumerate() {
            let start = (y + frame) * width + frame;
            values[start..start + self.width].copy_from_slice(row);
        }
        let weight = |i: usize| (-0.5 * (i as f64 / sigma).powi(2)).exp();
        let sum: f64 = weight(0) + 2.0 * (1..=reach).map(weight).sum::<f64>();
        let kernel: Vec<f32> = (0..=reach).map(|i| (weight(i) / sum) as f32).collect();
        let mut across = values.clone();
        for (blurred, row) in across.chunks_exact_mut(width).zip(values.chunks_exact(width)) {
            for x in reach..width - reach {
                let pairs = (1..=reach).map(|i| kernel[i] * (row[x - i] + row[x + i]));
                blurred[x] = kernel[0] * row[x] + pairs.sum::<f32>();
            }
        }
        for y in reach..height - reach {
            for x in 0..width {
                let at = y * width + x;
                let pairs = (1..=reach)
                    .map(|i| kernel[i] * (across[at - i * width] + across[at + i * width]));
                values[at] = kernel[0] * across[at] + pairs.sum::<f32>();
            }
        }
        (Self { values, width, height, covered_width: self.covered_width }, frame)
    }

    /// Index of the first pixel, in reading order, of the largest positive region (pixels
    /// joined by their sides), or none above [`policy::IMAGE_SHAPE_PIXELS`].
    fn largest_region(&self) -> Option<usize> {
        let mut seen: Vec<bool> = self.values.iter().map(|v| *v <= 0.0).collect();
        let mut stack = Vec::new();
        let mut best = (policy::IMAGE_SHAPE_PIXELS - 1, None);
        for start in 0..seen.len() {
            if seen[start] {
                continue;
            }
            seen[start] = true;
            stack.push(start);
            let mut size = 0;
            while let Some(at) = stack.pop() {
                size += 1;
                // The frame keeps regions off the border, so all four neighbours exist.
                for next in [at - 1, at + 1, at - self.width, at + self.width] {
                    if !seen[next] {
                        seen[next] = true;
                        stack.push(next);
                    }
                }
            }
            if size > best.0 {
                best = (size, Some(start));
            }
        }
        best.1
    }

    /// Walks round the region of `start`, its first pixel in reading order, keeping the ground
    /// on one side: marching squares where pixels that meet only by a corner stay apart.
    /// Points lie where the value, taken as linear between pixel centres, is zero.
    fn outer_contour(&self, start: usize) -> Vec<Point> {
        let (w, _) = (self.width as isize, self.height);
        let first = (start as isize, -w);
        let (mut inside, mut outward) = first;
        let mut points = Vec::new();
        let value = |at: isize| f64::from(self.values[at as usize]);
        loop {
            let (a, b) = (value(inside), value(inside + outward));
            let margin = policy::CONTOUR_MARGIN;
            let t = (a / (a - b)).clamp(margin, 1.0 - margin);
            let center = Point::new((inside % w) as f64 + 0.5, (inside / w) as f64 + 0.5);
            let (dx, dy) = if outward.abs() == 1 { (outward, 0) } else { (0, outward / w) };
            points.push(center + t * nalgebra::Vector2::new(dx as f64, dy as f64));

            // A quarter turn of the outward step, clockwise as seen in the picture.
            let along = if outward.abs() == 1 { outward * w } else { -outward / w };
            if value(inside + along) <= 0.0 {
                outward = along;
            } else if value(inside + along + outward) <= 0.0 {
                inside += along;
            } else {
                inside += along + outward;
                outward = -along;
            }
            if (inside, outward) == first || points.len() > 4 * self.values.len() {
                return points;
            }
        }
    }
}

/// The outer contour of the largest positive region of `field` after a Gaussian blur of
/// `blur` pixels, or none if there is no region. The unit is one pixel; x runs from the left
/// edge of the first column, y downwards from the top edge of the first row.
pub(super) fn largest_contour(field: &Field, blur: f64) -> Option<Vec<Point>> {
    let (framed, frame) = field.framed_and_blurred(blur);
    let start = framed.largest_region()?;
    let shift = nalgebra::Vector2::repeat(frame as f64);
    Some(framed.outer_contour(start).into_iter().map(|p| p - shift).collect())
}
