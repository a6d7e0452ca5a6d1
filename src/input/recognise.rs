//! What a file is: by its content, and only where that does not tell by its extension.

use super::text;
use std::path::Path;

/// A format that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Svg,
    Dxf,
    Picture,
    Table,
    Json,
    Stl,
    Obj,
}

/// The format, or what else the file is if that is known.
pub(super) fn recognised(bytes: &[u8], path: &str) -> Result<Format, Option<&'static str>> {
    let extension =
        Path::new(path).extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let starts = |mark: &[u8]| bytes.starts_with(mark);
    if starts(b"AutoCAD Binary DXF") {
        return Ok(Format::Dxf);
    }
    if is_binary_stl(bytes) {
        return Ok(Format::Stl);
    }
    for (mark, name) in OTHERS {
        if starts(mark) {
            return Err(Some(name));
        }
    }
    if let Ok(format) = image::guess_format(bytes) {
        use image::ImageFormat as I;
        return match format {
            I::Png | I::Jpeg | I::Tiff | I::Bmp | I::WebP => Ok(Format::Picture),
            I::Gif => Err(Some("a GIF picture")),
            _ => Err(Some("a picture of another kind")),
        };
    }
    let by_extension = match extension.as_str() {
        "svg" => Ok(Format::Svg),
        "dxf" => Ok(Format::Dxf),
        "png" | "jpg" | "jpeg" | "tif" | "tiff" | "bmp" | "webp" => Ok(Format::Picture),
        "json" => Ok(Format::Json),
        "stl" => Ok(Format::Stl),
        "obj" => Ok(Format::Obj),
        "csv" | "tsv" | "txt" | "dat" | "xy" | "asc" => Ok(Format::Table),
        "step" | "stp" => Err(Some("a STEP solid")),
        "3mf" => Err(Some("a 3MF solid")),
        _ => Err(None),
    };
    let Some(text) = text::decoded(bytes) else { return by_extension };
    let text = text.trim_start();
    let mut lines = text.lines().map(str::trim).filter(|l| !l.is_empty());
    let (first, second) = (lines.next().unwrap_or_default(), lines.next().unwrap_or_default());
    if text.starts_with('<') {
        return Ok(Format::Svg);
    }
    if text.starts_with(['{', '[']) {
        return Ok(Format::Json);
    }
    if first.starts_with("ISO-10303-21") {
        return Err(Some("a STEP solid"));
    }
    if (first == "0" && second.eq_ignore_ascii_case("SECTION"))
        || (first == "999" && extension == "dxf")
    {
        return Ok(Format::Dxf);
    }
    if first.starts_with("solid") && text.contains("facet") {
        return Ok(Format::Stl);
    }
    by_extension.or_else(|known| match text.chars().next() {
        _ if known.is_some() => Err(known),
        Some('0'..='9' | '+' | '-' | '.' | '#' | '"') => Ok(Format::Table),
        _ => Err(None),
    })
}

/// First bytes of what is often tried and not read, and what to call it.
const OTHERS: [(&[u8], &str); 8] = [
    (b"%PDF", "a PDF page"),
    (b"%!PS", "a PostScript page"),
    (b"AC10", "a DWG drawing"),
    (b"PK\x03\x04", "a ZIP archive, such as a 3MF solid"),
    (b"\x1f\x8b", "a compressed file"),
    (b"ISO-10303-21", "a STEP solid"),
    (b"glTF", "a GLB scene"),
    (b"\xd0\xcf\x11\xe0", "an Office document"),
];

/// Whether the length is that of a binary STL with as many triangles as it says, whatever its first bytes.
fn is_binary_stl(bytes: &[u8]) -> bool {
    let count = bytes.get(80..84).map(|b| u64::from(u32::from_le_bytes([b[0], b[1], b[2], b[3]])));
    count.is_some_and(|n| n > 0 && bytes.len() as u64 == 84 + 50 * n)
}
