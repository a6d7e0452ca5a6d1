//! The dialect of AutoCAD R12, which every machine reads: a header, two tables, entities.

use super::{Contour, Item, Sheet};
use crate::geometry::{self, Point};
use std::fmt::Write as _;

/// The file.
pub(super) fn text(sheet: &Sheet) -> Result<String, String> {
    let mut out = Groups(String::new());
    out.words(&[(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1009")]);
    // Not known to R12, which skips it; programs that read units from it find millimetres.
    out.words(&[(9, "$INSUNITS"), (70, "4")]);
    let (low, high) = extent(sheet);
    for (name, p) in [("$EXTMIN", low), ("$EXTMAX", high)] {
        out.words(&[(9, name)]);
        out.place(p);
    }
    out.words(&[(0, "ENDSEC"), (0, "SECTION"), (2, "TABLES")]);
    out.words(&[(0, "TABLE"), (2, "LTYPE"), (70, "1"), (0, "LTYPE"), (2, "CONTINUOUS")]);
    out.words(&[(70, "0"), (3, "Solid line"), (72, "65"), (73, "0"), (40, "0.0")]);
    out.words(&[(0, "ENDTAB"), (0, "TABLE"), (2, "LAYER")]);
    out.words(&[(70, &(sheet.layers.len() + 1).to_string())]);
    for (name, color) in std::iter::once(&("0".to_owned(), 7)).chain(&sheet.layers) {
        out.words(&[(0, "LAYER"), (2, name), (70, "0"), (62, &color.to_string())]);
        out.words(&[(6, "CONTINUOUS")]);
    }
    out.words(&[(0, "ENDTAB"), (0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")]);
    for (layer, item) in &sheet.items {
        match item {
            Item::Point(p) => {
                out.words(&[(0, "POINT"), (8, layer)]);
                out.place(*p);
            }
            Item::Contour(Contour::Round { center, radius }) => {
                out.words(&[(0, "CIRCLE"), (8, layer)]);
                out.place(*center);
                out.number(40, *radius);
            }
            Item::Contour(Contour::Path(path)) => {
                out.words(&[(0, "POLYLINE"), (8, layer), (66, "1")]);
                out.place(Point::origin());
                out.words(&[(70, "1")]);
                for arc in path.arcs() {
                    out.words(&[(0, "VERTEX"), (8, layer)]);
                    out.place(arc.from);
                    if arc.bulge != 0.0 {
                        out.number(42, arc.bulge);
                    }
                }
                out.words(&[(0, "SEQEND"), (8, layer)]);
            }
        }
    }
    out.words(&[(0, "ENDSEC"), (0, "EOF")]);
    Ok(out.0)
}

fn extent(sheet: &Sheet) -> (Point, Point) {
    let mut points = Vec::new();
    for (_, item) in &sheet.items {
        match item {
            Item::Point(p) => points.push(*p),
            Item::Contour(Contour::Round { center, radius }) => {
                points.extend([-*radius, *radius].map(|r| center + geometry::Vector::new(r, r)));
            }
            Item::Contour(Contour::Path(path)) => points.extend(path.flattened(4)),
        }
    }
    geometry::bounds(&points)
}

/// Pairs of lines: a code and its value.
struct Groups(String);

impl Groups {
    fn words(&mut self, pairs: &[(u8, &str)]) {
        for (code, value) in pairs {
            let _ = write!(self.0, "{code:>3}\r\n{value}\r\n");
        }
    }

    fn number(&mut self, code: u8, value: f64) {
        let _ = write!(self.0, "{code:>3}\r\n{value:.12}\r\n");
    }

    fn place(&mut self, p: Point) {
        self.number(10, p.x);
        self.number(20, p.y);
        self.number(30, 0.0);
    }
}
