//! Outlines from lists of points: text columns and JSON.

mod cells;
mod sides;

use super::text::decoded;
use crate::geometry::Point;
use crate::outline::{Outline, OutlineError, repaired};
use crate::policy;
use crate::wording::quoted;
use cells::Cell;
pub(crate) use cells::split_fields;
use serde_json::Value;
use std::borrow::Cow;

/// Why a list of points could not be read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PointsError {
    /// The file is not text.
    #[error("it is not plain text; save the points as text, one x and y on each line")]
    NotText,
    /// The file is longer than any outline.
    #[error("it has {bytes} bytes, more than {limit}; thin out the points")]
    TooLong {
        /// Length of the text.
        bytes: usize,
        /// Most that is read.
        limit: usize,
    },
    /// A line does not start with two finite numbers.
    #[error(
        "line {line} (`{text}`) is not two finite numbers; write x and y there or put # before it"
    )]
    BadLine {
        /// Number of the line, from 1.
        line: usize,
        /// The line, shortened.
        text: String,
    },
    /// Commas stand for decimal points and between the columns alike.
    #[error(
        "line {line} (`{text}`) and all others have four whole numbers, as if commas were decimal points too; separate the columns by semicolons"
    )]
    DecimalCommas {
        /// Number of the first such line, from 1.
        line: usize,
        /// The line, shortened.
        text: String,
    },
    /// A header over three columns of numbers or more without x or without y.
    #[error(
        "line {line} (`{text}`) does not say which of its columns are x and y; call them x and y there"
    )]
    NoXy {
        /// Number of the line, from 1.
        line: usize,
        /// The line, shortened.
        text: String,
    },
    /// The JSON text is malformed.
    #[error(
        "line {line}, column {column}: {reason}; write [[x, y], ...] or {{\"points\": [[x, y], ...]}}"
    )]
    BadJson {
        /// Line of the mistake, from 1.
        line: usize,
        /// Column of the mistake, from 1.
        column: usize,
        /// What the JSON reader says.
        reason: String,
    },
    /// The JSON text holds something else than a list of points.
    #[error("no list of points; write [[x, y], ...] or {{\"points\": [[x, y], ...]}}")]
    NoList,
    /// An entry of the JSON list is not a point.
    #[error("point {number} is not two numbers; write it as [x, y]")]
    BadPoint {
        /// Number of the point, from 1.
        number: usize,
    },
    /// The points do not make an outline.
    #[error(transparent)]
    Outline(#[from] OutlineError),
}

/// Reads columns of numbers: x and y on each line, closed implicitly.
///
/// Columns are separated by commas, semicolons, tabs or blanks, or by what a first line `sep=;` says; fields may be quoted. In
/// lines with semicolons or tabs, in quotes, and between blanks where each number has one inside, a comma is a decimal point.
/// Empty lines and whatever follows `#` are skipped. Numbers may have a unit of length behind them, or in the heading.
///
/// Lines before the first numbers are headings; if one names columns `x` and `y`, those are taken: the first word of a name
/// counts, in capitals or not, so `X [mm]` is one of them. Other names are refused over three columns of numbers and more.
/// Without names, a first column of words, and one that counts up by one from row to row (in [`policy::COUNTED_ROWS`] rows or
/// more), number the points; of three columns of which one never changes the other two are taken; otherwise the first two.
/// Lists of two sides, as those of airfoils, are put together. A repeated last point is dropped.
///
/// # Errors
/// See [`PointsError`]; messages name the line.
pub fn from_columns(text: &[u8]) -> Result<Outline, PointsError> {
    Ok(repaired(columns(text, policy::POINT_FILE_BYTES)?)?)
}

/// A line of the table.
struct Row {
    line: usize,
    text: String,
    cells: Vec<Cell>,
    /// A blank line before it.
    apart: bool,
}

/// The points of such columns as they stand, mm where units are given, from at most `limit` bytes.
pub(super) fn columns(text: &[u8], limit: usize) -> Result<Vec<Point>, PointsError> {
    let text = plain_text(text, limit)?;
    let mut rows: Vec<Row> = Vec::new();
    let mut named = None;
    let mut scale = 1.0;
    // A heading that does not name x and y.
    let mut nameless = None;
    let mut headings = 0;
    let mut separator = None;
    let mut apart = false;
    for (index, line) in text.lines().enumerate() {
        let data = line.split('#').next().unwrap_or_default().trim();
        if data.is_empty() || data.starts_with(['%', '!']) || data.starts_with("//") {
            apart |= data.is_empty();
            continue;
        }
        if rows.is_empty()
            && let Some(mark) = data.to_ascii_lowercase().strip_prefix("sep=")
        {
            separator = mark.chars().next();
            continue;
        }
        let fields = match separator {
            Some(mark) => cells::split_by(data, mark),
            None => split_fields(data),
        };
        let row =
            Row { line: index + 1, text: shortened(data), cells: cells::cells(&fields), apart };
        apart = false;
        if rows.is_empty()
            && headings < HEADINGS
            && named.is_none()
            && cells::is_heading(&row.cells, headings == 0)
        {
            headings += 1;
            scale = cells::unit_of_heading(&fields).unwrap_or(scale);
            named = named_columns(&fields);
            if named.is_none() {
                nameless = Some((row.line, row.text));
            }
            continue;
        }
        if rows.is_empty() && named.is_some() && row.cells.iter().all(Cell::is_unit) {
            scale = row.cells.iter().find_map(Cell::unit).unwrap_or(scale);
            continue;
        }
        rows.push(row);
    }
    if named.is_none()
        && cells::chosen(&rows_of(&rows)).is_none()
        && let Some(outline) = sides::two_columns_of_heights(&rows_of(&rows))
    {
        return Ok(outline);
    }
    if let Some((line, text)) = nameless
        && rows.first().is_some_and(|r| r.cells.iter().filter(|c| c.number().is_some()).count() > 2)
        && cells::chosen(&rows_of(&rows)).is_none()
    {
        return Err(PointsError::NoXy { line, text });
    }
    if rows.iter().all(|r| is_torn(&r.text))
        && separator.is_none()
        && named.is_none()
        && let Some(first) = rows.first()
    {
        return Err(PointsError::DecimalCommas { line: first.line, text: first.text.clone() });
    }
    let (x, y) = named.or_else(|| cells::chosen(&rows_of(&rows))).unwrap_or((0, 1));
    let mut points = Vec::with_capacity(rows.len());
    let mut breaks = Vec::new();
    for row in &rows {
        let column = |i: usize| row.cells.get(i).and_then(Cell::number);
        let Some((x, y)) = column(x).zip(column(y)) else {
            return Err(PointsError::BadLine { line: row.line, text: row.text.clone() });
        };
        if row.apart && !points.is_empty() {
            breaks.push(points.len());
        }
        points.push(Point::new(scale * x, scale * y));
    }
    Ok(sides::put_together(points, &breaks))
}

/// Most lines of headings before the first numbers.
const HEADINGS: usize = 8;

fn rows_of(rows: &[Row]) -> Vec<&[Cell]> {
    rows.iter().map(|r| r.cells.as_slice()).collect()
}

fn shortened(data: &str) -> String {
    quoted(&data.chars().take(40).collect::<String>())
}

/// Where a header names x and y: the first word of a name counts, and words in brackets alone are units.
fn named_columns(header: &[String]) -> Option<(usize, usize)> {
    let names = header.iter().filter(|field| !field.starts_with(['[', '(']));
    let first_words: Vec<&str> = names
        .map(|name| {
            let name = name.trim_start_matches(|c: char| !c.is_alphanumeric());
            name.split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default()
        })
        .collect();
    let named = |name| first_words.iter().position(|word| word.eq_ignore_ascii_case(name));
    named("x").zip(named("y"))
}

/// Whether a line is four whole numbers between commas, the second and fourth without sign.
fn is_torn(line: &str) -> bool {
    let digits = |f: &str| !f.is_empty() && f.bytes().all(|b| b.is_ascii_digit());
    let fields: Vec<&str> = line.split(',').map(str::trim).collect();
    matches!(fields[..], [a, b, c, d] if digits(a.trim_start_matches('-')) && digits(b) && digits(c.trim_start_matches('-')) && digits(d))
}

/// Reads JSON: `[[x, y], ...]` or `{"points": [[x, y], ...]}`, closed implicitly.
///
/// A point may also be `{"x": x, "y": y}`. A repeated last point is dropped.
///
/// # Errors
/// See [`PointsError`]; messages name the line or the point.
pub fn from_json(text: &[u8]) -> Result<Outline, PointsError> {
    let document = json(text, policy::POINT_FILE_BYTES)?;
    let list = document.as_array().or_else(|| document.get("points")?.as_array());
    Ok(repaired(list_of_points(list.ok_or(PointsError::NoList)?)?)?)
}

/// A JSON text of at most `limit` bytes.
pub(super) fn json(text: &[u8], limit: usize) -> Result<Value, PointsError> {
    serde_json::from_str(&plain_text(text, limit)?).map_err(|e| PointsError::BadJson {
        line: e.line(),
        column: e.column(),
        reason: quoted(e.to_string().split(" at line ").next().unwrap_or_default()),
    })
}

/// The points of a JSON list as they stand.
pub(super) fn list_of_points(list: &[Value]) -> Result<Vec<Point>, PointsError> {
    let coordinate = |p: &Value, i: usize, name: &str| p.get(i).or(p.get(name))?.as_f64();
    let points = list.iter().enumerate().map(|(i, p)| {
        let x = coordinate(p, 0, "x");
        let point = x.zip(coordinate(p, 1, "y")).map(|(x, y)| Point::new(x, y));
        point.ok_or(PointsError::BadPoint { number: i + 1 })
    });
    points.collect()
}

fn plain_text(bytes: &[u8], limit: usize) -> Result<Cow<'_, str>, PointsError> {
    if bytes.len() > limit {
        return Err(PointsError::TooLong { bytes: bytes.len(), limit });
    }
    decoded(bytes).ok_or(PointsError::NotText)
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT_SQUARE: [(f64, f64); 4] = [(0.0, 0.0), (1.5, 0.0), (1.5, 1.0), (0.0, 1.0)];

    fn square() -> Vec<Point> {
        UNIT_SQUARE.iter().map(|&(x, y)| Point::new(x, y)).collect()
    }

    #[test]
    fn every_way_of_writing_columns_gives_the_same_square() {
        let ways = [
            "0,0\n1.5,0\n1.5,1\n0,1\n0,0\n",
            "x;y\n0;0\n1,5;0\n1,5;1\n0;1",
            "# a square\n0 0\r\n1.5\t0 # corner\r\n\r\n1.5 1\r\n0 1\r\n",
            "0,0\t0,0\n1,5\t0,0\n1,5\t1\n0\t1,0",
            "0,0 0,0\n1,50 0,0\n1,5 1,0\n0,0 1,0\n",
            "\u{feff}name, Y, X\n1, 0, 0\n2, 0, 1.5\n3, 1, 1.5\n4, 1, 0\n",
        ];
        for text in ways {
            let outline = from_columns(text.as_bytes()).unwrap();
            assert_eq!(outline.points(), square(), "{text}");
        }
    }

    #[test]
    fn columns_of_numbers_and_units_in_headers_do_not_mislead() {
        let ways = [
            "id,X [mm],Y [mm]\n1,0,0\n2,1.5,0\n3,1.5,1\n4,0,1\n",
            "nr;\"x_mm\";\"y_mm\"\n1;0;0\n2;1,5;0\n3;1,5;1\n4;0;1\n",
            "X (mm) Y (mm)\n0 0\n1.5 0\n1.5 1\n0 1\n",
            "The outline of a gear\n0 0\n1.5 0\n1.5 1\n0 1\n",
            "1,0,0\n2,1.5,0\n3,1.5,1\n4,0,1\n",
            "0\t0\t0\n1\t1.5\t0\n2\t1.5\t1\n3\t0\t1\n4\t0\t0\n",
        ];
        for text in ways {
            let outline = from_columns(text.as_bytes()).unwrap();
            assert_eq!(outline.points(), square(), "{text}");
        }
        let nameless = from_columns(b"# gear\nid,east,north\n1,0,0\n2,3,0\n3,3,2\n").unwrap_err();
        assert!(matches!(nameless, PointsError::NoXy { line: 2, .. }), "{nameless:?}");
        assert!(nameless.to_string().contains("; call"), "{nameless}");
        // The first column does not count, or not for long enough.
        for text in ["0,0,7\n1,0,7\n2,1,7\n1,1,7\n", "0,0,1\n1,0,2\n2,1,4\n"] {
            let first = from_columns(text.as_bytes()).unwrap().points()[0];
            assert_eq!(first, Point::new(0.0, 0.0), "{text}");
        }
    }

    #[test]
    fn every_way_of_writing_json_gives_the_same_square() {
        let ways = [
            "[[0,0],[1.5,0],[1.5,1],[0,1],[0,0]]",
            r#"{"name": "square", "points": [[0,0],[1.5,0],[1.5,1],[0,1]]}"#,
            r#"[{"x":0,"y":0},{"x":1.5,"y":0},{"x":1.5,"y":1},{"x":0,"y":1}]"#,
        ];
        for text in ways {
            assert_eq!(from_json(text.as_bytes()).unwrap().points(), square(), "{text}");
        }
    }

    #[test]
    fn mistakes_name_their_line() {
        let bad = |text: &str| match from_columns(text.as_bytes()) {
            Err(PointsError::BadLine { line, .. }) => line,
            other => panic!("{text}: {other:?}"),
        };
        assert_eq!(bad("0,0\n1,0\nNaN,1\n0,1"), 3);
        assert_eq!(bad("# c\n\n0,0\n1,inf\n"), 4);
        assert_eq!(bad("x,y\n0,0\nhello\n"), 3);
        assert_eq!(bad("x,y\nx,y\n0,0\n"), 2);
        assert_eq!(bad("0 0\n1\n2 2\n"), 2);
        let torn = from_columns(b"0,00,0,00\n1,50,0,00\n1,50, 1,00\n-0,10,1,00\n").unwrap_err();
        assert!(torn.to_string().contains("semicolons"), "{torn}");
        // Four columns of which two are taken.
        assert!(from_columns(b"x,y,z,n\n0,0,1,1\n3,0,1,2\n3,2,1,3\n").is_ok());
        assert!(from_columns(b"0,0,1,1\n3,0,1,-2\n3,2,1,3\n").is_ok());
    }

    #[test]
    fn too_few_points_and_crossings_are_refused() {
        let of = |text: &str| from_columns(text.as_bytes()).unwrap_err();
        let few = |count| PointsError::Outline(OutlineError::TooFewPoints { count });
        assert_eq!(of("0,0\n1,1\n"), few(2));
        assert_eq!(of("0,0\n1,1\n0,0"), few(2));
        assert_eq!(of(""), few(0));
        assert_eq!(of("0,0\n1,1\n2,2\n"), PointsError::Outline(OutlineError::NoArea));
        assert_eq!(of("1e-310,0\n0,1e-310\n0,0\n"), PointsError::Outline(OutlineError::NoArea));
        let far = of("1e308,1e308\n-1e308,-1e308\n1e308,-1e308\n");
        assert!(matches!(far, PointsError::Outline(OutlineError::OutOfRange { .. })));
        let crossing = PointsError::Outline(OutlineError::SelfCrossing { x: 1.0, y: 1.0 });
        assert_eq!(of("0,0\n2,2\n2,0\n0,2\n"), crossing);
        assert_eq!(from_columns(b"\xff\xfe1,2").unwrap_err(), PointsError::NotText);
        let long = "1,2\n".repeat(policy::POINT_FILE_BYTES / 4 + 1);
        assert!(matches!(of(&long), PointsError::TooLong { .. }));
        let many: String = (0..=policy::OUTLINE_VERTICES).map(|i| format!("{i},0\n")).collect();
        assert!(matches!(of(&many), PointsError::Outline(OutlineError::TooManyPoints { .. })));
    }

    #[test]
    fn bad_json_says_where() {
        let of = |text: &str| from_json(text.as_bytes()).unwrap_err();
        assert!(matches!(of("[[0,0],\n[NaN,1]]"), PointsError::BadJson { line: 2, .. }));
        assert!(matches!(of("[[0,0],[1e999,1]]"), PointsError::BadJson { line: 1, .. }));
        assert_eq!(of("[[0,0],[1,null],[1,1]]"), PointsError::BadPoint { number: 2 });
        assert_eq!(of("[[0,0],[1],[1,1]]"), PointsError::BadPoint { number: 2 });
        assert_eq!(of("{\"a\": 1}"), PointsError::NoList);
        assert!(matches!(of(&"[".repeat(100_000)), PointsError::BadJson { .. }));
    }
}
