//! Group codes and values of a DXF file, as text or binary.

use super::DxfError;
use crate::input::text::decoded;
use crate::wording::quoted;
use std::borrow::Cow;

/// First bytes of a binary DXF.
const SENTINEL: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";

/// One group.
#[derive(Clone, Debug)]
pub(super) struct Tag<'a> {
    pub(super) code: i32,
    value: Value<'a>,
    /// Line of the value, from 1; in a binary file the number of the group.
    pub(super) line: usize,
}

#[derive(Clone, Debug)]
enum Value<'a> {
    Text(Cow<'a, str>),
    Number(f64),
}

impl Tag<'_> {
    pub(super) fn text(&self) -> &str {
        match &self.value {
            Value::Text(text) => text,
            Value::Number(_) => "",
        }
    }

    /// A finite number.
    pub(super) fn number(&self) -> Result<f64, DxfError> {
        let value = match &self.value {
            Value::Number(value) => Some(*value),
            Value::Text(text) => text.trim().parse().ok(),
        };
        value
            .filter(|v| v.is_finite())
            .ok_or_else(|| DxfError::NotANumber { line: self.line, text: quoted(self.text()) })
    }

    pub(super) fn whole(&self) -> Result<i64, DxfError> {
        Ok(self.number()?.clamp(-1e15, 1e15) as i64)
    }
}

/// The text of a DXF that is no binary one.
pub(super) fn text_of(bytes: &[u8]) -> Result<Option<Cow<'_, str>>, DxfError> {
    if bytes.starts_with(SENTINEL) {
        return Ok(None);
    }
    let text = decoded(bytes).ok_or(DxfError::NotText)?;
    // Names of layers are in the code page of the machine that wrote the file.
    if std::str::from_utf8(bytes).is_err()
        && let Some(page) = code_page(&text)
    {
        return Ok(Some(page.decode_without_bom_handling(bytes).0.into_owned().into()));
    }
    Ok(Some(text))
}

fn code_page(text: &str) -> Option<&'static encoding_rs::Encoding> {
    let after = text.split_once("$DWGCODEPAGE")?.1;
    let name = after.lines().nth(2)?.trim().to_ascii_lowercase();
    let label = match name.trim_start_matches("ansi_") {
        "932" => "shift_jis".to_owned(),
        "936" => "gbk".to_owned(),
        "949" => "euc-kr".to_owned(),
        "950" => "big5".to_owned(),
        number if name.starts_with("ansi_") => format!("windows-{number}"),
        _ => return None,
    };
    encoding_rs::Encoding::for_label(label.as_bytes())
}

/// The groups one after another; ends at the end of the file or after the first error.
pub(super) enum Tags<'a> {
    Text { lines: std::str::Split<'a, char>, line: usize },
    Binary { bytes: &'a [u8], wide: bool, count: usize },
}

impl<'a> Tags<'a> {
    pub(super) fn new(bytes: &'a [u8], text: Option<&'a str>) -> Self {
        match text {
            Some(text) => {
                // Old Macintosh files end their lines with a carriage return alone.
                let end = if text.contains('\n') { '\n' } else { '\r' };
                Self::Text { lines: text.split(end), line: 0 }
            }
            None => {
                let bytes = bytes.strip_prefix(SENTINEL).unwrap_or(bytes);
                // Since release 13 codes have two bytes: the first group is 0, `SECTION`.
                Self::Binary { bytes, wide: bytes.get(1) == Some(&0), count: 0 }
            }
        }
    }
}

impl<'a> Iterator for Tags<'a> {
    type Item = Result<Tag<'a>, DxfError>;

    fn next(&mut self) -> Option<Self::Item> {
        match self {
            Self::Text { lines, line } => {
                let mut code = lines.next()?.trim();
                *line += 1;
                // A blank line behind the end of file.
                while code.is_empty() {
                    code = lines.next()?.trim();
                    *line += 1;
                }
                let Ok(number) = code.parse() else {
                    let text = quoted(&code.chars().take(40).collect::<String>());
                    return Some(Err(DxfError::NotACode { line: *line, text }));
                };
                let value = lines.next()?.trim_end_matches('\r');
                *line += 1;
                let value = Value::Text(Cow::Borrowed(if number < 10 || number == 100 {
                    value.trim()
                } else {
                    value
                }));
                Some(Ok(Tag { code: number, value, line: *line }))
            }
            Self::Binary { bytes, wide, count } => {
                if bytes.is_empty() {
                    return None;
                }
                *count += 1;
                let (code, value) = match binary(bytes, *wide) {
                    Some(group) => group,
                    None => {
                        *bytes = &[];
                        return Some(Err(DxfError::Cut { line: *count }));
                    }
                };
                Some(Ok(Tag { code, value, line: *count }))
            }
        }
    }
}

fn take<'a>(bytes: &mut &'a [u8], count: usize) -> Option<&'a [u8]> {
    let (head, rest) = bytes.split_at_checked(count)?;
    *bytes = rest;
    Some(head)
}

fn little(bytes: &[u8]) -> i64 {
    let mut value = bytes.iter().rev().fold(0_u64, |v, b| (v << 8) | u64::from(*b));
    // The sign goes on to the left.
    if bytes.len() < 8 && bytes.last().is_some_and(|b| b & 0x80 != 0) {
        value |= u64::MAX << (8 * bytes.len());
    }
    value as i64
}

/// One group of a binary file.
fn binary<'a>(bytes: &mut &'a [u8], wide: bool) -> Option<(i32, Value<'a>)> {
    let code = if wide {
        little(take(bytes, 2)?)
    } else {
        match take(bytes, 1)?[0] {
            255 => little(take(bytes, 2)?),
            code => i64::from(code),
        }
    };
    let code = i32::try_from(code).ok()?;
    let whole = |bytes: &mut &'a [u8], size| Some(Value::Number(little(take(bytes, size)?) as f64));
    let value = match code {
        10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => {
            let raw = take(bytes, 8)?;
            Value::Number(f64::from_le_bytes(raw.try_into().ok()?))
        }
        60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => whole(bytes, 2)?,
        90..=99 | 420..=429 | 440..=459 | 1071 => whole(bytes, 4)?,
        160..=169 => whole(bytes, 8)?,
        290..=299 => whole(bytes, 1)?,
        310..=319 | 1004 => {
            let length = usize::from(take(bytes, 1)?[0]);
            take(bytes, length)?;
            Value::Text(Cow::Borrowed(""))
        }
        _ => {
            let end = bytes.iter().position(|b| *b == 0)?;
            let text = take(bytes, end)?;
            take(bytes, 1)?;
            Value::Text(decoded(text).unwrap_or(Cow::Borrowed("")))
        }
    };
    Some((code, value))
}
