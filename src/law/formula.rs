//! Formulas of one angle, as people type them.

use exmex::Express;

use super::LawError;
use crate::policy;
use crate::wording::quoted;

/// Functions and constants of a formula, besides the angle.
const NAMES: [&str; 35] = [
    "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "asinh", "acosh", "atanh",
    "atan2", "min", "max", "abs", "signum", "floor", "round", "ceil", "trunc", "fract", "exp",
    "sqrt", "cbrt", "ln", "log", "log2", "log10", "PI", "E", "e", "TAU", "pi", "tau",
];

/// A function of one angle, radians.
#[derive(Clone, Debug)]
pub struct Formula {
    expression: exmex::FlatEx<f64>,
    /// Whether the angle occurs.
    varies: bool,
}

impl Formula {
    /// Reads a formula of the variable `phi` (or `theta`, or the Greek letters), with `pi`, `tau`, `e`, `+ - * / ^`
    /// and the usual functions. `-phi^2` is minus the square.
    ///
    /// # Errors
    /// [`LawError`] for what is too long, too deep, or no formula.
    ///
    /// ```
    /// use centrode::law::Formula;
    ///
    /// let formula = Formula::parse("1 + 0.3*cos(2*phi)")?;
    /// assert!((formula.at(0.0) - 1.3).abs() < 1e-12);
    /// assert!(Formula::parse("1 + sine(phi)").unwrap_err().to_string().contains("sine"));
    /// # Ok::<(), centrode::law::LawError>(())
    /// ```
    pub fn parse(text: &str) -> Result<Self, LawError> {
        let length = text.chars().count();
        let most = policy::FORMULA_LENGTH;
        if length > most {
            return Err(LawError::TooLong { length, most });
        }
        let plain = tidied(text)?;
        let unreadable =
            |reason: &str| LawError::Unreadable { text: text.to_owned(), reason: quoted(reason) };
        let expression =
            exmex::parse::<f64>(&plain).map_err(|error| unreadable(&error.to_string()))?;
        match expression.var_names() {
            [] => Ok(Self { expression, varies: false }),
            [name] if name == "phi" => Ok(Self { expression, varies: true }),
            _ => Err(unreadable("it has more than one variable")),
        }
    }

    /// The value at an angle; not a number where the formula has none.
    #[must_use]
    pub fn at(&self, angle: f64) -> f64 {
        let value =
            if self.varies { self.expression.eval(&[angle]) } else { self.expression.eval(&[]) };
        value.unwrap_or(f64::NAN)
    }
}

/// The formula in the parser's own spelling; refuses what does not belong in one.
fn tidied(text: &str) -> Result<String, LawError> {
    let mut out = String::new();
    let mut depth = 0_usize;
    let mut deepest = 0;
    let characters: Vec<char> = text.chars().collect();
    let mut i = 0;
    // Whether a sign here would be in front of an operand, not between two.
    let mut prefix = true;
    while let Some(&c) = characters.get(i) {
        if c.is_ascii_digit() || c == '.' {
            let end = number_end(&characters, i);
            let number: String = characters[i..end].iter().collect();
            if let Some(&next) = characters.get(end)
                && (next.is_alphabetic() || next == '_' || next == '(' || next == '.')
            {
                return Err(LawError::NoSign { written: format!("{number}{next}") });
            }
            let value: f64 = number.parse().map_err(|_| LawError::Unreadable {
                text: text.to_owned(),
                reason: format!("{number:?} is no number"),
            })?;
            if !value.is_finite() {
                let reason = "one of its numbers is too large".to_owned();
                return Err(LawError::Unreadable { text: text.to_owned(), reason });
            }
            // The parser does not know exponents.
            out.push_str(format!("{value:.400}").trim_end_matches('0').trim_end_matches('.'));
            (i, prefix) = (end, false);
            continue;
        }
        if c.is_alphabetic() || c == '_' {
            let end = (i..characters.len())
                .find(|&k| !(characters[k].is_alphanumeric() || characters[k] == '_'))
                .unwrap_or(characters.len());
            let name: String = characters[i..end].iter().collect();
            out.push_str(match name.as_str() {
                "phi" | "theta" | "φ" | "ϕ" | "θ" => "phi",
                "pi" | "π" => "PI",
                "tau" | "τ" => "TAU",
                other if NAMES.contains(&other) => other,
                _ => return Err(LawError::UnknownName { name }),
            });
            prefix = false;
            i = end;
            continue;
        }
        match c {
            '(' => {
                depth += 1;
                deepest = deepest.max(depth);
                out.push(c);
                prefix = true;
            }
            ')' => {
                depth = depth.saturating_sub(1);
                out.push(c);
                prefix = false;
            }
            // To the parser a leading sign binds closer than a power.
            '-' if prefix => match out.trim_end().chars().last() {
                None | Some('(' | ',') => out.push_str("0-"),
                Some('/') => out.push_str("(0-1)/"),
                Some('^') => out.push('-'),
                Some(_) => out.push_str("(0-1)*"),
            },
            '+' if prefix => {}
            '-' | '+' | '*' | '/' | '^' | ',' => {
                out.push(c);
                prefix = true;
            }
            c if c.is_whitespace() => out.push(' '),
            character => return Err(LawError::Character { character }),
        }
        i += 1;
    }
    let most = policy::FORMULA_DEPTH;
    if deepest > most {
        return Err(LawError::TooDeep { depth: deepest, most });
    }
    Ok(out)
}

/// Where the number that starts at `from` ends: digits, one point, an exponent.
fn number_end(characters: &[char], from: usize) -> usize {
    let digits = |mut k: usize| {
        while characters.get(k).is_some_and(char::is_ascii_digit) {
            k += 1;
        }
        k
    };
    let mut end = digits(from);
    if characters.get(end) == Some(&'.') {
        end = digits(end + 1);
    }
    if matches!(characters.get(end), Some('e' | 'E')) {
        let sign = usize::from(matches!(characters.get(end + 1), Some('+' | '-')));
        let exponent = digits(end + 1 + sign);
        if exponent > end + 1 + sign {
            end = exponent;
        }
    }
    end
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_mean_what_they_say() {
        type Case = (&'static str, fn(f64) -> f64);
        let cases: [Case; 18] = [
            ("1", |_| 1.0),
            ("1 + 0.3*cos(2*phi)", |x| 1.0 + 0.3 * (2.0 * x).cos()),
            ("-phi^2", |x| -(x * x)),
            ("2 - -phi", |x| 2.0 + x),
            ("2*-phi", |x| -2.0 * x),
            ("2*-phi^2 + -phi^2", |x| -3.0 * x * x),
            ("6/-2*phi", |x| -3.0 * x),
            ("--phi + +1", |x| x + 1.0),
            ("2^-1*phi", |x| 0.5 * x),
            ("(-phi)^2 + 2^3^1", |x| x * x + 8.0),
            ("1.5e-3*phi + 2E2", |x| 1.5e-3 * x + 200.0),
            ("sin(φ)*π/pi", f64::sin),
            ("max(sin(phi), 0.2)", |x| x.sin().max(0.2)),
            ("atan2(sin(phi), 2)", |x| x.sin().atan2(2.0)),
            ("sqrt(1 - 0.25*sin(theta)^2)", |x| (1.0 - 0.25 * x.sin() * x.sin()).sqrt()),
            ("e^(0.1*sin(phi))", |x| (0.1 * x.sin()).exp()),
            ("10/4/2 + .5", |_| 1.75),
            ("abs(cos(phi/2))", |x| (0.5 * x).cos().abs()),
        ];
        for (text, exact) in cases {
            let formula = Formula::parse(text).unwrap_or_else(|e| panic!("{text}: {e}"));
            for x in [-2.0, -0.3, 0.0, 0.7, 4.0] {
                let value = formula.at(x);
                assert!((value - exact(x)).abs() < 1e-12, "{text} at {x}: {value}");
            }
        }
    }

    #[test]
    fn rubbish_is_refused_with_a_sentence() {
        let deep = format!("{}phi{}", "(".repeat(51), ")".repeat(51));
        let long = "1+".repeat(600);
        let cases = [
            ("", "write it like"),
            ("foo(phi)", "\"foo\""),
            ("1 + x", "\"x\""),
            ("2phi", "2*phi"),
            ("2(phi)", "2*phi"),
            ("1 +", "write it like"),
            ("(1", "write it like"),
            ("cos()", "write it like"),
            ("1; 2", "';'"),
            ("{phi}", "'{'"),
            ("1,5 + phi", "write it like"),
            ("1.2.3", "2*phi"),
            (&deep, "flatter"),
            (&long, "shorten"),
        ];
        for (text, word) in cases {
            let error = Formula::parse(text).expect_err(text).to_string();
            assert!(error.contains(word), "{text}: {error}");
        }
    }
}
