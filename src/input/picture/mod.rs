//! Outlines from silhouette images.

mod contour;
mod light;

use super::inner::Drawing;
use super::note::Note;
use crate::geometry::Point;
use crate::outline::{Outline, OutlineError, repaired};
use crate::policy;
use crate::wording::quoted;
use contour::{Field, largest_contour};
use image::{
    DynamicImage, GrayAlphaImage, ImageDecoder, ImageError as DecodeError, ImageReader, LumaA,
};
use std::io::Cursor;

/// Why an image gives no outline.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ImageError {
    /// Not a PNG, JPEG, TIFF, BMP or WebP image.
    #[error("it is not a PNG, JPEG, TIFF, BMP or WebP image; convert it to PNG")]
    NotAnImage,
    /// The image file is damaged or of an unknown kind.
    #[error("the image cannot be decoded ({reason}); save it again as PNG")]
    Damaged {
        /// What the decoder says.
        reason: String,
    },
    /// More pixels than are decoded.
    #[error("the image has {width} x {height} pixels, more than {limit} in all; scale it down")]
    TooLarge {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Most pixels that are decoded.
        limit: u64,
    },
    /// Too few pixels for a shape.
    #[error("the image has {width} x {height} pixels; use one of at least {side} on each side")]
    TooSmall {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Fewest pixels on a side.
        side: u32,
    },
    /// All pixels have nearly one brightness.
    #[error("the image is all of one colour; use a dark shape on a light ground or the reverse")]
    OneColour,
    /// All there is are specks.
    #[error("no shape in the image has {pixels} pixels or more; use a larger picture of it")]
    OnlySpecks {
        /// Pixels of the smallest silhouette.
        pixels: usize,
    },
    /// Nothing lies on the far side of the threshold that was given.
    #[error("threshold {threshold} leaves no shape in the image; try another or leave it out")]
    NoShape {
        /// The threshold given.
        threshold: u8,
    },
    /// The contour does not make an outline.
    #[error(transparent)]
    Outline(#[from] OutlineError),
}

/// Reads the largest silhouette of a PNG, JPEG, TIFF, BMP or WebP image, with its holes filled.
///
/// Where a share of [`policy::IMAGE_CLEAR_SHARE`] or more is transparent (less than half as opaque as the most opaque pixel),
/// what is opaque is the shape; only if the whole border is opaque, as around a stencil, is it the hole. A picture whose
/// opaque part has two colours and is nearly all of it, a card with rounded corners, is read like one without
/// transparency, as if it lay on white: by brightness, where `threshold` (pixels darker than it on one side) or, without one,
/// Otsu's separates the shape from the ground, which is what most of the image's border is.
/// After a blur of [`policy::IMAGE_BLUR`] pixels
/// the contour is interpolated between pixel centres, so it has no pixel stairs; a shape cut
/// off by the border is closed along it. The unit is one pixel, y upwards from the lower edge.
/// Images above [`policy::IMAGE_PIXELS_TRACED`] are averaged down first.
///
/// # Errors
/// See [`ImageError`]. The size is checked from the header, before anything is decoded.
pub fn from_image(bytes: &[u8], threshold: Option<u8>) -> Result<Outline, ImageError> {
    shape(bytes, threshold).map(|drawing| drawing.outline)
}

/// The silhouette, and what a reader should know.
///
/// # Errors
/// See [`ImageError`].
pub(super) fn shape(bytes: &[u8], threshold: Option<u8>) -> Result<Drawing, ImageError> {
    let (grey, clear_level) = samples(&decoded(bytes)?);
    let (dark, light) = grey.range();
    if light.saturating_sub(dark) < policy::IMAGE_CONTRAST {
        return Err(ImageError::OneColour);
    }
    let mut notes = Vec::new();
    let (grey, level) = match (threshold, clear_level) {
        (Some(value), _) => (grey, f64::from(value) - 0.5),
        (None, Some(level)) => (grey, level),
        (None, None) => thresholded(grey, &mut notes),
    };
    let mut field = grey.averaged(level);
    let reversed = match clear_level {
        Some(_) => field.wholly_positive_border(),
        None => field.mostly_positive_border(),
    };
    if reversed {
        field.negate();
    }
    let scale = f64::from(grey.width) / field.covered_width();
    let contour = largest_contour(&field, policy::IMAGE_BLUR).ok_or(match threshold {
        Some(threshold) => ImageError::NoShape { threshold },
        None => ImageError::OnlySpecks { pixels: policy::IMAGE_SHAPE_PIXELS },
    })?;
    if clear_level.is_none()
        && cut_by_border(&contour, field.covered_width(), f64::from(grey.height) / scale)
    {
        notes.push(Note::CutByBorder);
    }
    let height = f64::from(grey.height);
    let points = contour.iter().map(|p| Point::new(scale * p.x, height - scale * p.y)).collect();
    Ok(Drawing { notes, ..repaired(points)?.into() })
}

/// The picture and the brightness that separates shape from ground in it: with the light on its ground taken out where that
/// is uneven and helps.
fn thresholded(grey: Samples, notes: &mut Vec<Note>) -> (Samples, f64) {
    let plain = otsu(&grey.histogram());
    let doubt = undecided(&grey.histogram(), plain);
    let contrast = f64::from(grey.range().1 - grey.range().0);
    if let Some((even, variation)) = light::evened(&grey) {
        let level = otsu(&even.histogram());
        let left = undecided(&even.histogram(), level);
        let clearer = doubt > DOUBT && left < 0.5 * doubt;
        if clearer || (variation > UNEVEN * contrast && left <= doubt) {
            notes.push(Note::Uneven);
            if left > DOUBT {
                notes.push(Note::Faint);
            }
            return (even, level);
        }
    }
    if doubt > DOUBT {
        notes.push(Note::Faint);
    }
    (grey, plain)
}

/// Share of the pixels near the threshold from which on a picture has no valley there: grey edges alone have less.
const DOUBT: f64 = 0.04;
/// Width of the band about the threshold, each side, over the distance of the mean of the shape from that of the ground.
const DOUBT_BAND: f64 = 0.1;
/// Variation of the light on the ground, over the contrast of the picture, from which on it is uneven.
const UNEVEN: f64 = 0.25;
/// Part of the contour along one side of the picture that counts as cut off, over the size of the shape, and over the square
/// root of that size in pixels: a round shape that only touches the side lies within half a pixel of it for two of these.
const CUT: (f64, f64) = (0.05, 4.0);

/// Share of the pixels whose brightness is near the threshold.
fn undecided(histogram: &[u64; 256], level: f64) -> f64 {
    let mean = |dark: bool| {
        let of = histogram.iter().enumerate().filter(|(v, _)| ((*v as f64) < level) == dark);
        let (sum, count) =
            of.fold((0.0, 0_u64), |(s, c), (v, n)| (s + (v as f64) * *n as f64, c + n));
        sum / count.max(1) as f64
    };
    let band = DOUBT_BAND * (mean(false) - mean(true));
    let near = histogram.iter().enumerate().filter(|(v, _)| (*v as f64 - level).abs() <= band);
    near.map(|(_, n)| *n).sum::<u64>() as f64 / histogram.iter().sum::<u64>().max(1) as f64
}

/// Whether the contour, in pixels, runs along a side of the picture rather than touching it.
fn cut_by_border(contour: &[Point], width: f64, height: f64) -> bool {
    let (low, high) = crate::geometry::bounds(contour);
    let size = (high - low).max();
    let least = (CUT.0 * size).max(CUT.1 * size.sqrt());
    let at = |p: &Point| [p.x < 0.5, p.x > width - 0.5, p.y < 0.5, p.y > height - 0.5];
    (0..4).any(|side| {
        let along = contour.windows(2).filter(|w| at(&w[0])[side] && at(&w[1])[side]);
        along.map(|w| (w[1] - w[0]).norm()).sum::<f64>() > least
    })
}

fn decoded(bytes: &[u8]) -> Result<DynamicImage, ImageError> {
    let damaged = |error: DecodeError| ImageError::Damaged { reason: quoted(&error.to_string()) };
    let open = || {
        let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().ok()?;
        reader.format().map(|_| reader)
    };
    let (width, height) = match open().ok_or(ImageError::NotAnImage)?.into_dimensions() {
        Err(DecodeError::Unsupported(_)) => return Err(ImageError::NotAnImage),
        dimensions => dimensions.map_err(damaged)?,
    };
    if u64::from(width) * u64::from(height) > policy::IMAGE_PIXELS {
        return Err(ImageError::TooLarge { width, height, limit: policy::IMAGE_PIXELS });
    }
    if width.min(height) < policy::IMAGE_SIDE {
        return Err(ImageError::TooSmall { width, height, side: policy::IMAGE_SIDE });
    }
    let mut reader = open().ok_or(ImageError::NotAnImage)?;
    let mut limits = image::Limits::default();
    limits.max_alloc = Some(policy::IMAGE_ALLOCATION);
    reader.limits(limits);
    let mut decoder = reader.into_decoder().map_err(damaged)?;
    let orientation = decoder.orientation();
    let mut picture = DynamicImage::from_decoder(decoder).map_err(damaged)?;
    if let Ok(orientation) = orientation {
        picture.apply_orientation(orientation);
    }
    Ok(picture)
}

/// One byte a pixel, low where the silhouette usually is.
struct Samples {
    values: Vec<u8>,
    width: u32,
    height: u32,
}

/// The picture's opacity, reversed so that opaque is low, and the level that halves the greatest, if opacity decides what
/// the shape is; else its brightness on a white ground.
fn samples(picture: &DynamicImage) -> (Samples, Option<f64>) {
    let (width, height) = (picture.width(), picture.height());
    let of = |values| Samples { values, width, height };
    if !picture.color().has_alpha() {
        return (of(picture.to_luma8().into_raw()), None);
    }
    let both = picture.to_luma_alpha8();
    let most = both.pixels().map(|p| p.0[1]).max().unwrap_or(0);
    if most == 0 {
        // Opacity was never filled in.
        return (of(both.pixels().map(|p| p.0[0]).collect()), None);
    }
    if opacity_decides(&both, most) {
        let values = both.pixels().map(|p| 255 - p.0[1]).collect();
        return (of(values), Some(255.0 - 0.5 * f64::from(most)));
    }
    let on_white = |p: &LumaA<u8>| {
        let [grey, opacity] = p.0.map(u32::from);
        let most = u32::from(most);
        255 - (((255 - grey) * opacity + most / 2) / most) as u8
    };
    (of(both.pixels().map(on_white).collect()), None)
}

/// Whether enough is transparent for a ground, and what is opaque is no picture of its own.
fn opacity_decides(both: &GrayAlphaImage, most: u8) -> bool {
    let mut brightness = [0_u64; 256];
    for pixel in both.pixels().filter(|p| 2 * u16::from(p.0[1]) >= u16::from(most)) {
        brightness[usize::from(pixel.0[0])] += 1;
    }
    let pixels = f64::from(both.width()) * f64::from(both.height());
    let opaque: u64 = brightness.iter().sum();
    let fair = policy::IMAGE_CLEAR_SHARE * pixels;
    if pixels - (opaque as f64) < fair {
        return false;
    }
    let present = || (0..256).filter(|v| brightness[*v] > 0);
    let (low, high) = (present().min().unwrap_or(0), present().max().unwrap_or(0));
    let dark: u64 = brightness[..(low + high).div_ceil(2)].iter().sum();
    let two_colours =
        high - low >= usize::from(policy::IMAGE_CONTRAST) && dark.min(opaque - dark) as f64 >= fair;
    !two_colours || (opaque as f64) < policy::IMAGE_CARD_SHARE * pixels
}

impl Samples {
    fn range(&self) -> (u8, u8) {
        self.values.iter().fold((255, 0), |(low, high), &v| (low.min(v), high.max(v)))
    }

    fn histogram(&self) -> [u64; 256] {
        let mut counts = [0; 256];
        for &value in &self.values {
            counts[usize::from(value)] += 1;
        }
        counts
    }

    /// `level` minus brightness, averaged over squares so that at most
    /// [`policy::IMAGE_PIXELS_TRACED`] remain; positive where dark.
    fn averaged(&self, level: f64) -> Field {
        let pixels = u64::from(self.width) * u64::from(self.height);
        let side = (pixels as f64 / policy::IMAGE_PIXELS_TRACED as f64).sqrt().ceil().max(1.0);
        let (side, width, height) = (side as usize, self.width as usize, self.height as usize);
        let (columns, rows) = (width.div_ceil(side), height.div_ceil(side));
        let mut values = Vec::with_capacity(columns * rows);
        for row in 0..rows {
            for column in 0..columns {
                let (mut sum, mut count) = (0_u32, 0_u32);
                for y in row * side..((row + 1) * side).min(height) {
                    let start = y * width + column * side;
                    let end = y * width + ((column + 1) * side).min(width);
                    sum += self.values[start..end].iter().map(|&v| u32::from(v)).sum::<u32>();
                    count += (end - start) as u32;
                }
                values.push((level - f64::from(sum) / f64::from(count)) as f32);
            }
        }
        Field::new(values, columns, width as f64 / side as f64)
    }
}

/// The brightness that separates the two classes of a histogram best (Otsu 1979): their
/// variance about their own means is least. Halfway between the classes where values between
/// them do not occur.
fn otsu(histogram: &[u64; 256]) -> f64 {
    let total: u64 = histogram.iter().sum();
    let weighted = |(value, &count): (usize, &u64)| value as f64 * count as f64;
    let sum: f64 = histogram.iter().enumerate().map(weighted).sum();
    let (mut below, mut sum_below) = (0_u64, 0.0);
    let (mut best, mut first, mut last) = (-1.0, 0, 0);
    for (value, count) in histogram.iter().enumerate().take(255) {
        below += count;
        sum_below += weighted((value, count));
        let above = total - below;
        if below == 0 || above == 0 {
            continue;
        }
        let apart = sum_below / below as f64 - (sum - sum_below) / above as f64;
        let between = below as f64 * above as f64 * apart * apart;
        if between > best {
            (best, first, last) = (between, value, value);
        } else if between == best {
            last = value;
        }
    }
    0.5 * (first + last) as f64 + 0.5
}

#[cfg(test)]
mod tests;
