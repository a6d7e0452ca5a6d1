//! Lines of a table as cells: numbers with units, and words.

/// What stands in a column.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Cell {
    /// A number, in mm if a unit stands behind it.
    Number(f64),
    Word(String),
}

/// Units of length behind numbers and in headings, and mm in one.
const UNITS: [(&str, f64); 14] = [
    ("mm", 1.0),
    ("cm", 10.0),
    ("dm", 100.0),
    ("m", 1000.0),
    ("um", 1e-3),
    ("µm", 1e-3),
    ("in", 25.4),
    ("inch", 25.4),
    ("\"", 25.4),
    ("ft", 304.8),
    ("mil", 25.4e-3),
    ("px", 1.0),
    ("pt", 25.4 / 72.0),
    ("thou", 25.4e-3),
];

impl Cell {
    pub(super) fn number(&self) -> Option<f64> {
        match self {
            Self::Number(value) => Some(*value),
            Self::Word(_) => None,
        }
    }

    /// The unit that a word names, in brackets or not.
    pub(super) fn unit(&self) -> Option<f64> {
        match self {
            Self::Number(_) => None,
            Self::Word(word) => named_unit(word),
        }
    }

    pub(super) fn is_unit(&self) -> bool {
        self.unit().is_some()
    }
}

fn named_unit(word: &str) -> Option<f64> {
    let name = word.trim_matches(['[', ']', '(', ')', '.', ' ']).to_lowercase();
    UNITS.iter().find(|(unit, _)| *unit == name).map(|(_, mm)| *mm)
}

/// The unit in a heading such as `x [in]`, `X (cm)` or `y_mm`.
pub(super) fn unit_of_heading(fields: &[String]) -> Option<f64> {
    fields.iter().find_map(|field| {
        let words = field.split(|c: char| {
            c.is_whitespace() || matches!(c, '[' | ']' | '(' | ')' | '_' | '/' | ',')
        });
        words
            .filter(|w| !w.is_empty())
            .skip(1)
            .find_map(named_unit)
            .or_else(|| field.starts_with(['[', '(']).then(|| named_unit(field)).flatten())
    })
}

/// Fields as cells; a unit in a field of its own goes with the number before it.
pub(super) fn cells(fields: &[String]) -> Vec<Cell> {
    let mut cells: Vec<Cell> = Vec::with_capacity(fields.len());
    for field in fields {
        if let Some(Cell::Number(value)) = cells.last_mut()
            && let Some(mm) = named_unit(field)
        {
            *value *= mm;
            continue;
        }
        cells.push(number(field).map_or_else(|| Cell::Word(field.clone()), Cell::Number));
    }
    cells
}

/// A finite number, also with a unit behind it.
fn number(field: &str) -> Option<f64> {
    let plain = |text: &str| text.trim().parse::<f64>().ok().filter(|v| v.is_finite());
    if let Some(value) = plain(field) {
        return Some(value);
    }
    let digits = field.rfind(|c: char| c.is_ascii_digit() || c == '.')? + 1;
    let (value, unit) = field.split_at(digits);
    Some(plain(value)? * named_unit(unit.trim())?).filter(|v| v.is_finite())
}

/// Whether a line before all numbers is a heading rather than spoiled data: no field of it begins like a number, or it is
/// the title in the first line.
pub(super) fn is_heading(cells: &[Cell], first: bool) -> bool {
    let like_number = |cell: &Cell| match cell {
        Cell::Number(_) => true,
        Cell::Word(word) => {
            let word = word.trim_start_matches(['+', '-', '.', ',']);
            word.starts_with(|c: char| c.is_ascii_digit()) || word.parse::<f64>().is_ok()
        }
    };
    if !cells.iter().any(like_number) {
        return true;
    }
    // Such as `NACA 2412`, but no label with two numbers behind it.
    let numbers = cells.iter().filter(|c| c.number().is_some()).count();
    first
        && numbers < 2
        && matches!(cells.first(), Some(Cell::Word(word)) if word.starts_with(char::is_alphabetic) && word.parse::<f64>().is_err())
}

/// The columns of x and y where something tells them apart from others.
pub(super) fn chosen(rows: &[&[Cell]]) -> Option<(usize, usize)> {
    let columns = rows.iter().map(|r| r.len()).min()?;
    let values = |i: usize| -> Option<Vec<f64>> { rows.iter().map(|r| r[i].number()).collect() };
    if columns < 3 {
        return None;
    }
    // A label in front of each point.
    if rows.iter().all(|r| r[0].number().is_none()) {
        return Some((1, 2));
    }
    let [a, b, c] = [values(0)?, values(1)?, values(2)?];
    let counts = a.len() >= crate::policy::COUNTED_ROWS
        && a[0].fract() == 0.0
        && a.windows(2).all(|w| w[1] == w[0] + 1.0);
    if counts {
        return Some((1, 2));
    }
    let constant = |v: &[f64]| v.iter().all(|x| *x == v[0]);
    match [constant(&a), constant(&b), constant(&c)] {
        [true, false, false] => Some((1, 2)),
        [false, true, false] => Some((0, 2)),
        [false, false, true] => Some((0, 1)),
        _ => None,
    }
}

/// The fields of a line of numbers, decimal points for decimal commas: see [`super::from_columns`].
pub(crate) fn split_fields(line: &str) -> Vec<String> {
    if line.contains('"') && line.matches('"').count().is_multiple_of(2) && !line.contains(" \"") {
        let bare: String = line.split('"').step_by(2).collect();
        let mark = [';', '\t', ','].into_iter().find(|m| bare.contains(*m));
        if let Some(mark) = mark {
            return split_by(line, mark);
        }
    }
    if line.contains([';', '\t']) {
        let fields = line.split([';', '\t']).map(str::trim).filter(|f| !f.is_empty());
        let semicolons = line.contains(';');
        return fields
            .map(|f| if semicolons || one_comma(f) { with_point(f) } else { f.to_owned() })
            .collect();
    }
    let words = || {
        line.split_whitespace()
            .filter(|f| f.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.')))
    };
    if words().count() > 1 && words().all(one_comma) {
        return line
            .split_whitespace()
            .map(|f| if one_comma(f) { f.replace(',', ".") } else { f.to_owned() })
            .collect();
    }
    if line.contains(',') {
        return line.split(',').map(|f| f.trim().trim_matches('"').to_owned()).collect();
    }
    line.split_whitespace()
        .map(|f| f.trim_matches('"').to_owned())
        .filter(|f| !f.is_empty())
        .collect()
}

/// The fields between marks outside quotes.
pub(super) fn split_by(line: &str, mark: char) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut quoted = false;
    for c in line.chars() {
        if c == '"' {
            quoted = !quoted;
        } else if c == mark && !quoted {
            fields.push(String::new());
        } else if let Some(field) = fields.last_mut() {
            field.push(c);
        }
    }
    let fields = fields.into_iter().map(|f| f.trim().to_owned()).filter(|f| !f.is_empty());
    fields.map(|f| if mark != ',' || one_comma(&f) { with_point(&f) } else { f }).collect()
}

/// A decimal comma as a point, dots between thousands left out.
fn with_point(field: &str) -> String {
    match (field.find('.'), field.find(',')) {
        (Some(dot), Some(comma)) if dot < comma => field.replace('.', "").replace(',', "."),
        _ => field.replace(',', "."),
    }
}

/// Whether a field has one comma with digits on both sides.
fn one_comma(field: &str) -> bool {
    field.split_once(',').is_some_and(|(whole, rest)| {
        whole.ends_with(|c: char| c.is_ascii_digit())
            && rest.starts_with(|c: char| c.is_ascii_digit())
            && !rest.contains(',')
    })
}
