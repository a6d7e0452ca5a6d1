use super::*;
use image::{GrayImage, ImageFormat, Luma, Rgb, RgbImage};
use std::f64::consts::PI;

fn encoded(picture: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.into().write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// A disc of radius 40 about (60.3, 50.7) from the lower left corner, without grey edges.
fn disc(shape: u8, ground: u8) -> GrayImage {
    GrayImage::from_fn(120, 100, |x, y| {
        let (dx, dy) = (f64::from(x) + 0.5 - 60.3, 99.5 - f64::from(y) - 50.7);
        Luma([if dx.hypot(dy) < 40.0 { shape } else { ground }])
    })
}

fn assert_is_the_disc(outline: &Outline, tolerance: f64) {
    let center = Point::new(60.3, 50.7);
    assert!((outline.centroid() - center).norm() < tolerance, "{}", outline.centroid());
    let off = outline.points().iter().map(|p| ((p - center).norm() - 40.0).abs());
    let worst = off.fold(0.0, f64::max);
    assert!(worst < 2.0 * tolerance, "{worst}");
    assert!((outline.area() / (1600.0 * PI) - 1.0).abs() < 0.01, "{}", outline.area());
}

#[test]
fn a_black_and_white_disc_is_found_without_stairs() {
    for (shape, ground) in [(0, 255), (255, 0), (90, 140), (200, 20)] {
        let outline = from_image(&encoded(disc(shape, ground), ImageFormat::Png), None).unwrap();
        assert_is_the_disc(&outline, 0.2);
        let points = outline.points();
        // Stairs would turn by up to 90 degrees; the disc turns by 1.4 degrees a pixel.
        let turn = |i: usize| {
            let at = |k: usize| points[(i + k) % points.len()];
            let (u, v) = (at(6) - at(0), at(12) - at(6));
            crate::geometry::cross(u, v).atan2(u.dot(&v))
        };
        let sharpest = (0..points.len()).map(turn).fold(0.0, f64::max);
        assert!(sharpest < 0.35, "{sharpest}");
    }
}

#[test]
fn every_format_and_an_alpha_channel_give_the_disc() {
    use ImageFormat::{Bmp, Jpeg, Png, Tiff, WebP};
    for format in [Png, Jpeg, Tiff, Bmp, WebP] {
        let colour = DynamicImage::from(disc(10, 240)).to_rgb8();
        assert_is_the_disc(&from_image(&encoded(colour, format), None).unwrap(), 0.3);
    }
    let mask = disc(255, 0);
    let veiled =
        image::GrayAlphaImage::from_fn(120, 100, |x, y| LumaA([77, mask.get_pixel(x, y)[0]]));
    assert_is_the_disc(&from_image(&encoded(veiled, Png), None).unwrap(), 0.2);
    let opaque =
        image::GrayAlphaImage::from_fn(120, 100, |x, y| LumaA([mask.get_pixel(x, y)[0], 255]));
    assert_is_the_disc(&from_image(&encoded(opaque, Png), None).unwrap(), 0.2);
}

/// A picture of brightness and opacity, 120 by 100.
fn veiled(pixel: impl Fn(u32, u32) -> [u8; 2]) -> Vec<u8> {
    let picture = GrayAlphaImage::from_fn(120, 100, |x, y| LumaA(pixel(x, y)));
    encoded(picture, ImageFormat::Png)
}

/// Whether a pixel lies in one of four corners cut off, together 2.6 % of 120 by 100.
fn corner(x: u32, y: u32) -> bool {
    x.min(119 - x) + y.min(99 - y) < 12
}

#[test]
fn a_card_with_transparent_corners_is_read_by_what_is_drawn_on_it() {
    for (shape, ground) in [(20, 240), (240, 20)] {
        let drawn = disc(shape, ground);
        let hidden = if ground > 128 { 0 } else { ground };
        let card =
            veiled(|x, y| if corner(x, y) { [hidden, 0] } else { [drawn.get_pixel(x, y)[0], 255] });
        assert_is_the_disc(&from_image(&card, None).unwrap(), 0.3);
    }
    // All of one colour: the card itself is the shape, though it covers most of the border.
    let plain = veiled(|x, y| [77, if corner(x, y) { 0 } else { 255 }]);
    let area = from_image(&plain, None).unwrap().area();
    assert!((area / 11_688.0 - 1.0).abs() < 0.01, "{area}");
}

#[test]
fn a_few_transparent_pixels_do_not_matter() {
    let drawn = disc(0, 255);
    let stray = veiled(|x, y| [drawn.get_pixel(x, y)[0], if (x, y) == (3, 4) { 0 } else { 255 }]);
    assert_is_the_disc(&from_image(&stray, None).unwrap(), 0.2);
}

#[test]
fn faint_shapes_and_stencils_are_found_by_their_opacity() {
    let mask = disc(1, 0);
    let inside = |x, y| mask.get_pixel(x, y)[0] == 1;
    let faint = veiled(|x, y| [0, if inside(x, y) { 100 } else { 0 }]);
    assert_is_the_disc(&from_image(&faint, None).unwrap(), 0.2);
    let stencil = veiled(|x, y| [200, if inside(x, y) { 0 } else { 255 }]);
    assert_is_the_disc(&from_image(&stencil, None).unwrap(), 0.2);
    let even = veiled(|x, y| [if inside(x, y) { 0 } else { 255 }, 100]);
    assert_is_the_disc(&from_image(&even, None).unwrap(), 0.2);
}

#[test]
fn specks_are_refused_without_a_word_of_a_threshold() {
    let specks =
        GrayImage::from_fn(60, 60, |x, y| Luma([if (x, y) == (20, 30) { 0 } else { 255 }]));
    let error = from_image(&encoded(specks, ImageFormat::Png), None).unwrap_err();
    assert_eq!(error, ImageError::OnlySpecks { pixels: policy::IMAGE_SHAPE_PIXELS });
    let said = error.to_string();
    assert!(said.contains("; use") && !said.contains("threshold"), "{said}");
}

#[test]
fn holes_are_filled_and_specks_left_out() {
    let mut picture = disc(0, 255);
    for (x, y) in (50..70).flat_map(|x| (40..60).map(move |y| (x, y))) {
        picture.put_pixel(x, y, Luma([255]));
    }
    for (x, y) in (2..10).flat_map(|x| (2..10).map(move |y| (x, y))) {
        picture.put_pixel(x, y, Luma([0]));
    }
    assert_is_the_disc(&from_image(&encoded(picture, ImageFormat::Png), None).unwrap(), 0.2);
}

#[test]
fn the_threshold_moves_the_contour_down_a_ramp() {
    // Brightness 2 x on the left half, a light ground: the contour lies where 2 x = threshold.
    let ramp = GrayImage::from_fn(160, 60, |x, y| {
        let inside = (10..50).contains(&y) && (10..120).contains(&x);
        Luma([if inside { 2 * x as u8 } else { 255 }])
    });
    let right = |threshold| {
        let outline =
            from_image(&encoded(ramp.clone(), ImageFormat::Png), Some(threshold)).unwrap();
        outline.bounds().1.x
    };
    for threshold in [100, 160] {
        let expected = 0.5 * (f64::from(threshold) - 0.5) + 0.5;
        assert!((right(threshold) - expected).abs() < 0.1, "{}", right(threshold));
    }
    let error = from_image(&encoded(ramp, ImageFormat::Png), Some(1)).unwrap_err();
    assert_eq!(error, ImageError::NoShape { threshold: 1 });
}

#[test]
fn a_shape_cut_off_by_the_border_is_closed_along_it() {
    let half = GrayImage::from_fn(100, 100, |x, y| {
        Luma([if x < 30 && (20..80).contains(&y) { 0 } else { 255 }])
    });
    let outline = from_image(&encoded(half, ImageFormat::Png), None).unwrap();
    let (low, high) = outline.bounds();
    assert!(low.x.abs() < 0.3 && (high.x - 30.0).abs() < 0.3, "{low} {high}");
    assert!((outline.area() - 1800.0).abs() < 10.0);
}

#[test]
fn large_images_are_averaged_down_in_the_same_units() {
    let big = GrayImage::from_fn(3001, 2003, |x, y| {
        let (dx, dy) = (f64::from(x) + 0.5 - 1400.0, 2002.5 - f64::from(y) - 900.0);
        Luma([if dx.hypot(dy) < 800.0 { 0 } else { 255 }])
    });
    let outline = from_image(&encoded(big, ImageFormat::Png), None).unwrap();
    let center = Point::new(1400.0, 900.0);
    let worst = outline.points().iter().map(|p| ((p - center).norm() - 800.0).abs());
    let worst = worst.fold(0.0, f64::max);
    assert!(worst < 0.8, "{worst}");
}

#[test]
fn images_without_a_shape_are_refused() {
    let of = |picture: RgbImage| from_image(&encoded(picture, ImageFormat::Png), None).unwrap_err();
    let plain = |w, h, v| RgbImage::from_pixel(w, h, Rgb([v; 3]));
    assert_eq!(
        of(plain(1, 1, 0)),
        ImageError::TooSmall { width: 1, height: 1, side: policy::IMAGE_SIDE }
    );
    assert_eq!(of(plain(300, 200, 255)), ImageError::OneColour);
    assert_eq!(of(plain(300, 200, 0)), ImageError::OneColour);
    let faint = RgbImage::from_fn(64, 64, |x, y| Rgb([250 + ((x * 7 + y * 3) % 6) as u8; 3]));
    assert_eq!(of(faint), ImageError::OneColour);
}

#[test]
fn other_and_damaged_files_are_refused() {
    for bytes in [&b""[..], b"hello", b"GIF89a..", b"\x00\x00\x00"] {
        assert_eq!(from_image(bytes, None).unwrap_err(), ImageError::NotAnImage);
    }
    let whole = encoded(disc(0, 255), ImageFormat::Png);
    for length in [9, 20, 40, whole.len() / 2] {
        let error = from_image(&whole[..length], None).unwrap_err();
        assert!(matches!(error, ImageError::Damaged { .. }), "{length}: {error:?}");
        assert!(!error.to_string().contains(char::is_control), "{error}");
    }
}

#[test]
fn the_size_is_refused_before_decoding() {
    // Headers alone, without pixels: anything that decoded would fail differently.
    let mut png = encoded(GrayImage::new(16, 16), ImageFormat::Png);
    png[16..20].copy_from_slice(&20_000_u32.to_be_bytes());
    png[20..24].copy_from_slice(&20_000_u32.to_be_bytes());
    let crc = crc32(&png[12..29]);
    png[29..33].copy_from_slice(&crc.to_be_bytes());
    let error = from_image(&png, None).unwrap_err();
    let expected =
        ImageError::TooLarge { width: 20_000, height: 20_000, limit: policy::IMAGE_PIXELS };
    assert_eq!(error, expected);
}

/// The checksum of PNG chunks.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |c, _| (c >> 1) ^ (0xedb8_8320 & (c & 1).wrapping_neg()))
    })
}

/// A disc of brightness 60, in the light that `light` (0 to 1) throws on it and its ground of 230, with some noise.
fn lit(light: impl Fn(f64, f64) -> f64) -> Vec<u8> {
    let mask = disc(60, 230);
    let picture = GrayImage::from_fn(120, 100, |x, y| {
        let noise = f64::from((x * 7919 + y * 104_729) % 7) - 3.0;
        let even = f64::from(mask.get_pixel(x, y)[0]);
        Luma([(even * light(f64::from(x) / 119.0, f64::from(y) / 99.0) + noise) as u8])
    });
    encoded(picture, ImageFormat::Png)
}

#[test]
fn light_that_falls_off_is_taken_out_and_said() {
    let Drawing { outline, notes, .. } = shape(&lit(|_, _| 1.0), None).unwrap();
    assert_is_the_disc(&outline, 0.4);
    assert_eq!(notes, []);
    for light in [
        |x: f64, _: f64| 1.0 - 0.75 * x,
        |x: f64, y: f64| 1.0 - 0.35 * x - 0.35 * y,
        |x: f64, y: f64| 1.0 - 0.7 * (x * x + y * y) / 2.0,
    ] {
        let Drawing { outline, notes, .. } = shape(&lit(light), None).unwrap();
        assert_is_the_disc(&outline, 1.0);
        assert!(notes.contains(&Note::Uneven), "{notes:?}");
    }
}

#[test]
fn a_picture_without_a_valley_or_cut_by_its_border_is_doubted() {
    let ramp = GrayImage::from_fn(120, 100, |x, y| {
        let (dx, dy) = (f64::from(x) - 60.0, f64::from(y) - 50.0);
        Luma([(4.0 * dx.hypot(dy)).min(255.0) as u8])
    });
    let Drawing { notes, .. } = shape(&encoded(ramp, ImageFormat::Png), None).unwrap();
    assert!(notes.contains(&Note::Faint), "{notes:?}");
    let cut = |left: u32| {
        let picture = GrayImage::from_fn(200, 200, |x, y| {
            let (dx, dy) = (f64::from(x + left) + 0.5 - 100.0, f64::from(y) + 0.5 - 100.0);
            Luma([if dx.hypot(dy) < 100.0 { 0 } else { 255 }])
        });
        shape(&encoded(picture, ImageFormat::Png), None).unwrap().notes
    };
    assert_eq!((cut(0), cut(60)), (vec![], vec![Note::CutByBorder]));
}
