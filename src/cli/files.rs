//! The formats a user asked for, written into a folder.

use std::path::{Path, PathBuf};

use centrode::export::{
    Animation, Dxf, Export, ExportError, Format, Glb, LaserSvg, Mjcf, Obj, Parts, Step, Stl,
    ThreeMf, write_atomically,
};
use centrode::report::{PictureOptions, pair_svg};

use super::args::ExportArgs;

impl ExportArgs {
    /// Whether a format is wanted; all but the moving picture are when none is named.
    pub(crate) fn wants(&self, format: Format) -> bool {
        match format {
            Format::Gif => self.animate || self.export.contains(&format),
            _ => self.export.is_empty() || self.export.contains(&format),
        }
    }
}

/// Writes the wanted formats that an assembly alone can fill; returns the files.
pub(crate) fn write_parts(
    folder: &Path,
    parts: Parts<'_>,
    args: &ExportArgs,
) -> Result<Vec<PathBuf>, ExportError> {
    let tolerance = args.curve_tolerance;
    let dxf = Dxf { polyline: args.dxf_polyline, r12: args.dxf_r12, tolerance };
    let formats: [(Format, &dyn Export); 9] = [
        (Format::Glb, &Glb::default()),
        (Format::Stl, &Stl),
        (Format::Obj, &Obj),
        (Format::ThreeMf, &ThreeMf),
        (Format::Step, &Step { tolerance }),
        (Format::Dxf, &dxf),
        (Format::Mjcf, &Mjcf::default()),
        (Format::Svg, &LaserSvg { kerf: args.kerf, tolerance }),
        (Format::Gif, &Animation::default()),
    ];
    let mut files = Vec::new();
    for (format, writer) in formats {
        // A MuJoCo scene holds no shared axles and no sectors; it is refused only where it was asked for by name.
        let possible = format != Format::Mjcf
            || (parts.assembly.axles.is_empty() && !parts.assembly.swings())
            || args.export.contains(&format);
        if args.wants(format) && possible {
            files.extend(writer.write(parts, folder)?);
        }
    }
    if args.wants(Format::Svg) {
        let picture = pair_svg(parts.assembly, &PictureOptions::default());
        files.push(write_text(folder, "pair.svg", &picture)?);
    }
    Ok(files)
}

/// Writes a text file whole; returns where it is.
pub(crate) fn write_text(folder: &Path, name: &str, text: &str) -> Result<PathBuf, ExportError> {
    let path = folder.join(name);
    write_atomically(&path, |out| std::io::Write::write_all(out, text.as_bytes()))?;
    Ok(path)
}
