//! Numbered entities of an exchange file.

use std::fmt;
use std::io::{self, Write};

/// Number of an entity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Id(usize);

impl fmt::Display for Id {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{}", self.0)
    }
}

/// The data section so far.
#[derive(Debug, Default)]
pub(super) struct Entities {
    lines: Vec<String>,
}

impl Entities {
    pub(super) fn add(&mut self, what: String) -> Id {
        self.lines.push(what);
        Id(self.lines.len())
    }

    pub(super) fn write(&self, out: &mut impl Write) -> io::Result<()> {
        for (i, line) in self.lines.iter().enumerate() {
            writeln!(out, "#{}={line};", i + 1)?;
        }
        Ok(())
    }

    pub(super) fn point(&mut self, p: [f64; 3]) -> Id {
        self.add(format!("CARTESIAN_POINT('',{})", triple(p)))
    }

    pub(super) fn direction(&mut self, d: [f64; 3]) -> Id {
        self.add(format!("DIRECTION('',{})", triple(d)))
    }

    pub(super) fn frame(&mut self, origin: [f64; 3], z: [f64; 3], x: [f64; 3]) -> Id {
        let origin = self.point(origin);
        let z = self.direction(z);
        let x = self.direction(x);
        self.add(format!("AXIS2_PLACEMENT_3D('',{origin},{z},{x})"))
    }

    pub(super) fn vertex(&mut self, p: [f64; 3]) -> Id {
        let point = self.point(p);
        self.add(format!("VERTEX_POINT('',{point})"))
    }

    /// The line through `from` along the unit direction.
    pub(super) fn line(&mut self, from: [f64; 3], along: [f64; 3]) -> Id {
        let from = self.point(from);
        let along = self.direction(along);
        let vector = self.add(format!("VECTOR('',{along},1.)"));
        self.add(format!("LINE('',{from},{vector})"))
    }
}

fn triple([x, y, z]: [f64; 3]) -> String {
    format!("({},{},{})", real(x), real(y), real(z))
}

/// A number as the format wants it: with a decimal point, to 1e-10.
pub(super) fn real(value: f64) -> String {
    let mut text = format!("{value:.10}");
    text.truncate(text.trim_end_matches('0').len());
    if text == "-0." { "0.".to_owned() } else { text }
}

/// A string as the format wants it: quotes doubled, other alphabets by their code.
pub(super) fn text(plain: &str) -> String {
    let mut out = String::from("'");
    for c in plain.chars() {
        match c {
            '\'' => out.push_str("''"),
            '\\' => out.push_str("\\\\"),
            ' '..='~' => out.push(c),
            _ if c.is_control() => out.push(' '),
            _ => out.push_str(&format!("\\X4\\{:08X}\\X0\\", u32::from(c))),
        }
    }
    out.push('\'');
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_strings_take_the_form_of_the_format() {
        assert_eq!(real(2.0), "2.");
        assert_eq!(real(-0.25), "-0.25");
        assert_eq!(real(-1e-14), "0.");
        assert_eq!(text("it's a \\"), "'it''s a \\\\'");
        assert_eq!(text("zahnr\u{e4}der\n"), "'zahnr\\X4\\000000E4\\X0\\der '");
    }
}
