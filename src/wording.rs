//! Text that comes from a file, as it may stand in a message.

use crate::policy;

/// One line without control characters, which could steer a terminal, shortened to [`policy::QUOTED_LENGTH`]
/// characters.
pub(crate) fn quoted(text: &str) -> String {
    let printable: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let words: Vec<&str> = printable.split_whitespace().collect();
    let line = words.join(" ");
    let most = policy::QUOTED_LENGTH;
    match line.char_indices().nth(most) {
        None => line,
        Some((end, _)) => format!("{}...", &line[..end]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_quoted_is_one_short_plain_line() {
        assert_eq!(quoted("a\tb\r\n \u{1b}[31mc\0"), "a b [31mc");
        let long = quoted(&"é".repeat(1000));
        assert_eq!(long.chars().count(), policy::QUOTED_LENGTH + 3);
        assert!(long.ends_with("..."));
    }
}
