//! A contact sheet of shapes, each with its name.

use super::text::{Grid, escape};
use crate::geometry::{self, Point};
use crate::outline::Outline;
use crate::policy::PICTURE_DIGITS;
use std::fmt::Write as _;

/// Side of one cell, mm.
const CELL: f64 = 40.0;
/// Longest side of a shape in its cell, mm.
const SHAPE: f64 = 30.0;
/// Room for the name below the shape, mm.
const LABEL: f64 = 7.0;

/// All shapes with their names in rows of `columns`, as a complete SVG document.
///
/// Every shape is scaled to the same longest side; y of the outlines points upwards.
/// Zero columns count as one.
#[must_use]
pub fn contact_sheet_svg(shapes: &[(&str, &Outline)], columns: usize) -> String {
    let columns = columns.clamp(1, shapes.len().max(1));
    let rows = shapes.len().div_ceil(columns).max(1);
    let grid = Grid::for_extent(CELL, PICTURE_DIGITS - 2);
    let (width, height) = (CELL * columns as f64, (CELL + LABEL) * rows as f64);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" \
         viewBox=\"0 0 {width} {height}\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
         <g id=\"shapes\" fill=\"#8fc3ea\" stroke=\"#1f4e8c\" stroke-width=\".3\" stroke-linejoin=\"round\">\n"
    );
    let mut labels = String::new();
    for (i, (name, outline)) in shapes.iter().enumerate() {
        let (column, row) = ((i % columns) as f64, (i / columns) as f64);
        let center = Point::new((column + 0.5) * CELL, row * (CELL + LABEL) + 0.5 * CELL);
        let (low, high) = geometry::bounds(outline.points());
        let scale = SHAPE / (high.x - low.x).max(high.y - low.y).max(f64::MIN_POSITIVE);
        let middle = geometry::Vector::new(low.x + high.x, low.y + high.y) / 2.0;
        let place = |p: &Point| {
            let q = (p.coords - middle) * scale;
            Point::new(center.x + q.x, center.y - q.y)
        };
        let points: Vec<Point> = outline.points().iter().map(place).collect();
        let name = escape(name);
        let _ = writeln!(svg, "<path d=\"{}\"><title>{name}</title></path>", grid.ring(&points));
        let _ = writeln!(
            labels,
            "<text x=\"{}\" y=\"{}\">{name}</text>",
            grid.number(center.x),
            grid.number(center.y + 0.5 * CELL + 1.5)
        );
    }
    let _ = write!(
        svg,
        "</g>\n<g font-family=\"system-ui, Helvetica, Arial, sans-serif\" font-size=\"3.6\" \
         text-anchor=\"middle\" fill=\"#3a4552\">\n{labels}</g>\n</svg>\n"
    );
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shape_has_its_cell() {
        let triangle = [(0.0, 0.0), (300.0, 0.0), (0.0, 200.0)].map(|(x, y)| Point::new(x, y));
        let outline = Outline::new(triangle.to_vec()).expect("a triangle");
        let shapes = vec![("a<b>&'", &outline); 5];
        let svg = contact_sheet_svg(&shapes, 2);
        let tree = usvg::Tree::from_str(&svg, &usvg::Options::default()).expect("well-formed");
        let mm = |v: f32| f64::from(v) * 25.4 / 96.0;
        assert!((mm(tree.size().width()) - 80.0).abs() < 1e-3);
        assert!((mm(tree.size().height()) - 141.0).abs() < 1e-3);
        let Some(usvg::Node::Group(cells)) = tree.node_by_id("shapes") else {
            panic!("the shapes are a group");
        };
        assert_eq!(cells.children().len(), 5);
        let first = cells.children()[0].abs_bounding_box();
        assert!((mm(first.width()) - 30.0).abs() < 0.01, "{}", mm(first.width()));
        assert!((mm(first.height()) - 20.0).abs() < 0.01, "{}", mm(first.height()));
        usvg::Tree::from_str(&contact_sheet_svg(&[], 0), &usvg::Options::default())
            .expect("an empty sheet");
    }
}
