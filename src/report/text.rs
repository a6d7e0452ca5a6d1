//! Text that is safe to place in a document: escaped names, short numbers, path data.

use crate::geometry::Point;
use std::fmt::Write as _;

/// Escapes `text` for an element's content or a quoted attribute, in HTML and in XML.
/// Control characters, which XML forbids, become the replacement character.
pub(super) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\t' | '\n' => out.push(c),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

/// JSON for a `<script>` block: no character in it can end the block.
pub(super) fn json_for_script(value: &serde_json::Value) -> String {
    let mut out = String::new();
    for c in value.to_string().chars() {
        match c {
            '<' | '>' | '&' | '\u{2028}' | '\u{2029}' => {
                // Writing to a String cannot fail.
                let _ = write!(out, "\\u{:04x}", u32::from(c));
            }
            c => out.push(c),
        }
    }
    out
}

/// A number as a person reads it: at most `decimals` places, no trailing zeros.
pub(super) fn plain(value: f64, decimals: usize) -> String {
    if !value.is_finite() {
        return "–".into();
    }
    let fixed = format!("{value:.decimals$}");
    let short = match fixed.contains('.') {
        true => fixed.trim_end_matches('0').trim_end_matches('.'),
        false => &fixed,
    };
    if short == "-0" { "0".into() } else { short.to_owned() }
}

/// A decimal grid that coordinates are rounded to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    decimals: u32,
}

impl Grid {
    /// The coarsest decimal grid that divides `extent` into at least 10^`digits` steps.
    pub(super) fn for_extent(extent: f64, digits: i32) -> Self {
        let whole = if extent.is_finite() && extent > 0.0 { extent.log10().floor() } else { 0.0 };
        // Beyond nine places the integers below could leave their range.
        let decimals = (f64::from(digits) - whole).clamp(0.0, 9.0);
        Self { decimals: decimals as u32 }
    }

    fn snap(self, value: f64) -> i64 {
        if value.is_finite() {
            (value * 10f64.powi(self.decimals as i32)).round() as i64
        } else {
            0
        }
    }

    fn write(self, n: i64, out: &mut String) {
        let unit = 10u64.pow(self.decimals);
        let (whole, part) = (n.unsigned_abs() / unit, n.unsigned_abs() % unit);
        if n < 0 {
            out.push('-');
        }
        if whole > 0 || part == 0 {
            let _ = write!(out, "{whole}");
        }
        if part > 0 {
            let digits = format!("{part:0width$}", width = self.decimals as usize);
            out.push('.');
            out.push_str(digits.trim_end_matches('0'));
        }
    }

    /// The value on the grid nearest to `value`; zero for what is not finite.
    pub(super) fn rounded(self, value: f64) -> f64 {
        self.snap(value) as f64 / 10f64.powi(self.decimals as i32)
    }

    /// `value` on the grid, in as few characters as it needs.
    pub(super) fn number(self, value: f64) -> String {
        let mut out = String::new();
        self.write(self.snap(value), &mut out);
        out
    }

    /// Path data of a closed ring, in relative steps between grid points, so that
    /// rounding never adds up. Empty for fewer than two finite points.
    pub(super) fn ring(self, points: &[Point]) -> String {
        let open = self.line(points);
        if open.is_empty() { open } else { open + "z" }
    }

    /// Path data of an open line through `points`; see [`Grid::ring`].
    pub(super) fn line(self, points: &[Point]) -> String {
        let finite = points.iter().filter(|p| p.x.is_finite() && p.y.is_finite());
        let mut snapped: Vec<_> = finite.map(|p| (self.snap(p.x), self.snap(p.y))).collect();
        snapped.dedup();
        if snapped.len() < 2 {
            return String::new();
        }
        let mut out = String::with_capacity(10 * snapped.len());
        out.push('M');
        let (mut x, mut y) = (0, 0);
        for (i, &(next_x, next_y)) in snapped.iter().enumerate() {
            match i {
                0 => {}
                1 => out.push('l'),
                _ => separate(next_x < x, &mut out),
            }
            self.write(next_x.saturating_sub(x), &mut out);
            separate(next_y < y, &mut out);
            self.write(next_y.saturating_sub(y), &mut out);
            (x, y) = (next_x, next_y);
        }
        out
    }
}

/// A minus sign already separates two numbers.
fn separate(negative: bool, out: &mut String) {
    if !negative {
        out.push(' ');
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_take_no_more_characters_than_they_need() {
        let grid = Grid { decimals: 4 };
        let texts = [12.0, -0.5, 0.00004, 7.12345, -20.0001, f64::NAN].map(|v| grid.number(v));
        assert_eq!(texts, ["12", "-.5", "0", "7.1235", "-20.0001", "0"]);
        assert_eq!(plain(80.0, 3), "80");
        assert_eq!(plain(-0.0001, 2), "0");
        assert_eq!(plain(120.0, 0), "120");
    }

    #[test]
    fn relative_steps_return_to_the_grid_point() {
        let third = 1.0 / 3.0;
        let points: Vec<_> = (0..=3000).map(|i| Point::new(i as f64 * third, 0.0)).collect();
        let path = Grid { decimals: 2 }.line(&points);
        let steps = path.trim_start_matches('M').replace('l', " ");
        let x: f64 = steps.split(' ').step_by(2).filter_map(|s| s.parse::<f64>().ok()).sum();
        assert!((x - 1000.0).abs() < 1e-9, "{x}");
    }

    #[test]
    fn grids_follow_the_size_of_the_drawing() {
        assert_eq!(Grid::for_extent(160.0, 6).decimals, 4);
        assert_eq!(Grid::for_extent(8.0, 6).decimals, 6);
        assert_eq!(Grid::for_extent(f64::NAN, 6).decimals, 6);
        assert_eq!(Grid::for_extent(1e-30, 6).decimals, 9);
    }

    #[test]
    fn nothing_escapes() {
        assert_eq!(escape("<a b='\"'>&\u{1}"), "&lt;a b=&#39;&quot;&#39;&gt;&amp;\u{fffd}");
        let value = serde_json::json!("</script><!-- & \u{2028}");
        let text = json_for_script(&value);
        assert!(!text.contains(['<', '>', '&', '\u{2028}']));
        assert_eq!(serde_json::from_str::<serde_json::Value>(&text).ok(), Some(value));
    }
}
