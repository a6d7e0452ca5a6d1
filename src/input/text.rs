//! Bytes as text, whatever program saved them.

use encoding_rs::{UTF_16BE, UTF_16LE, WINDOWS_1252};
use std::borrow::Cow;

/// Text in UTF-8, in UTF-16 with or without its mark, else in Latin-1 (Windows-1252). `None` for what is no text.
pub(super) fn decoded(bytes: &[u8]) -> Option<Cow<'_, str>> {
    let wide = |encoding: &'static encoding_rs::Encoding, bytes: &'static [u8]| (encoding, bytes);
    for (encoding, mark) in [wide(UTF_16LE, b"\xff\xfe"), wide(UTF_16BE, b"\xfe\xff")] {
        if let Some(rest) = bytes.strip_prefix(mark) {
            return encoding.decode_without_bom_handling_and_without_replacement(rest);
        }
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let head = &bytes[..bytes.len().min(WIDE_HEAD) / 2 * 2];
    let zeros = |offset: usize| head.iter().skip(offset).step_by(2).filter(|b| **b == 0).count();
    if head.len() >= 4 && zeros(0) + zeros(1) > head.len() / 4 {
        let encoding = if zeros(1) > zeros(0) { UTF_16LE } else { UTF_16BE };
        return encoding.decode_without_bom_handling_and_without_replacement(bytes);
    }
    if bytes.contains(&0) {
        return None;
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => Some(Cow::Borrowed(text)),
        Err(_) => Some(WINDOWS_1252.decode_without_bom_handling(bytes).0),
    }
}

/// Bytes in which zeros tell UTF-16 without a mark: a line or two.
const WIDE_HEAD: usize = 256;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_encoding_gives_the_same_text() {
        let text = "Zahnrad Größe 5\n";
        let wide = |swap: bool| -> Vec<u8> {
            text.encode_utf16()
                .flat_map(|u| if swap { u.to_be_bytes() } else { u.to_le_bytes() })
                .collect()
        };
        let latin: Vec<u8> = text.chars().map(|c| c as u8).collect();
        let marked = [b"\xef\xbb\xbf", text.as_bytes()].concat();
        let ways = [
            text.as_bytes().to_vec(),
            marked,
            latin,
            wide(false),
            wide(true),
            [&b"\xff\xfe"[..], &wide(false)].concat(),
            [&b"\xfe\xff"[..], &wide(true)].concat(),
        ];
        for bytes in ways {
            assert_eq!(decoded(&bytes).as_deref(), Some(text), "{bytes:?}");
        }
        assert_eq!(decoded(b"abcdefghij\0klmnopqrst"), None);
        assert_eq!(decoded(b"\xff\xfe1,2"), None);
    }
}
