//! A file format of your own: the outlines of both gears as G-code for a pen plotter, and STL beside it.
//!
//! usage: cargo run --example custom_export -- FOLDER

use std::fmt::Write;
use std::path::PathBuf;

use centrode::export::{Artifact, Encode, EncodeError, Parts, Stl};
use centrode::geometry::Point;
use centrode::law::{LawOptions, Preset};
use centrode::pipeline::{DesignOptions, from_motion};
use centrode::solid::assembly_solids;

/// Moves the pen once round a closed curve.
fn trace(ring: &[Point], at: Point, out: &mut String) -> std::fmt::Result {
    for (i, p) in ring.iter().chain(ring.first()).enumerate() {
        let word = if i == 0 { "G0" } else { "G1" };
        writeln!(out, "{word} X{:.3} Y{:.3}", at.x + p.x, at.y + p.y)?;
    }
    Ok(())
}

struct GCode;

impl Encode for GCode {
    fn encode<'a>(&'a self, parts: Parts<'a>) -> Result<Vec<Artifact<'a>>, EncodeError> {
        let mut code = String::from("G21 ; mm\nG90\n");
        for placed in &parts.assembly.gears {
            trace(&placed.gear.outline, placed.axis, &mut code)
                .map_err(|why| EncodeError::new("pair.gcode", why))?;
        }
        Ok(vec![Artifact::bytes("pair.gcode", code)])
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).ok_or("give a folder that exists")?);
    let motion = Preset::Ellipse(0.4).transmission(&LawOptions::default())?;
    let names = ["ellipse", "its twin"].map(str::to_owned);
    let made = from_motion(motion, names, [None, None], &DesignOptions::default())?;

    let meshes = assembly_solids(&made.assembly)?;
    let parts = Parts { assembly: &made.assembly, meshes: &meshes };
    let formats: [&dyn Encode; 2] = [&GCode, &Stl];
    for format in formats {
        for file in format.write(parts, &folder)? {
            println!("{}", file.display());
        }
    }
    Ok(())
}
