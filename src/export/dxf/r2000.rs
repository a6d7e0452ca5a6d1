//! The dialect of AutoCAD 2000, through the `dxf` crate.

use super::{Contour, Item, Sheet};
use crate::geometry::Point;
use dxf::entities::{Circle, Entity, EntityType, LwPolyline, ModelPoint};
use dxf::enums::{AcadVersion, DrawingUnits, Units};
use dxf::tables::Layer;
use dxf::{Color, Drawing, LwPolylineVertex};

/// First handle given to table heads; a sheet has far fewer entities.
const TABLE_HANDLES: usize = 0xF00;
/// First handle that is free after them.
const FREE_HANDLES: usize = 0x1000;

/// The file.
pub(super) fn text(sheet: &Sheet) -> Result<String, String> {
    let mut drawing = Drawing::new();
    let header = &mut drawing.header;
    header.version = AcadVersion::R2000;
    header.default_drawing_units = Units::Millimeters;
    header.drawing_units = DrawingUnits::Metric;
    // The same design gives the same bytes, whenever it is written.
    header.creation_date = Default::default();
    header.creation_date_universal = Default::default();
    header.update_date = Default::default();
    header.update_date_universal = Default::default();
    header.fingerprint_guid = Default::default();
    header.version_guid = Default::default();
    for (name, color) in &sheet.layers {
        let color = Color::from_index(*color);
        drawing.add_layer(Layer { name: name.clone(), color, ..Layer::default() });
    }
    for (layer, item) in &sheet.items {
        let mut entity = Entity::new(entity(item));
        entity.common.layer.clone_from(layer);
        drawing.add_entity(entity);
    }
    let mut bytes = Vec::new();
    drawing.save(&mut bytes).map_err(|e| e.to_string())?;
    let text = String::from_utf8(bytes).map_err(|e| e.to_string())?;
    Ok(with_table_handles(&text))
}

fn entity(item: &Item) -> EntityType {
    match item {
        Item::Point(p) => EntityType::ModelPoint(ModelPoint::new(flat(*p))),
        Item::Contour(Contour::Round { center, radius }) => {
            EntityType::Circle(Circle::new(flat(*center), *radius))
        }
        Item::Contour(Contour::Path(path)) => {
            let corner = |a: &crate::geometry::curves::Arc| LwPolylineVertex {
                x: a.from.x,
                y: a.from.y,
                bulge: a.bulge,
                ..LwPolylineVertex::default()
            };
            let vertices = path.arcs().iter().map(corner).collect();
            let mut line = LwPolyline { vertices, ..LwPolyline::default() };
            line.set_is_closed(true);
            EntityType::LwPolyline(line)
        }
    }
}

fn flat(p: Point) -> dxf::Point {
    dxf::Point::new(p.x, p.y, 0.0)
}

/// The crate gives table heads no handle, which this dialect demands.
fn with_table_handles(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 200);
    let mut before = ["", ""];
    let (mut given, mut seed) = (TABLE_HANDLES, false);
    for line in text.split_inclusive('\n') {
        let bare = line.trim();
        if seed && before[0] == "$HANDSEED" {
            out.push_str(&format!("{FREE_HANDLES:X}\r\n"));
            seed = false;
        } else {
            out.push_str(line);
        }
        seed |= bare == "$HANDSEED";
        // Lines "TABLE", "2", name: the handle follows.
        if before == ["TABLE", "2"] {
            out.push_str(&format!("  5\r\n{given:X}\r\n"));
            given += 1;
        }
        before = [before[1], bare];
    }
    out
}
