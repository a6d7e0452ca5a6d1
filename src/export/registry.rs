//! The formats there are. Help, documentation, tests, benchmarks and the command line derive their lists from here: a new
//! format is a file with its [`Entry`] and one line in [`formats`].

use super::{Encode, ExportError, Parts};
use super::{animation, dxf, glb, laser_svg, mjcf, obj, step, stl, threemf};
use crate::assembly::Assembly;
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// What a user may choose about the files.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExportOptions {
    /// Greatest distance between a vertex of the outline and the curves in STEP, DXF and `laser.svg`, mm.
    pub curve_tolerance: f64,
    /// DXF with straight segments only.
    pub dxf_polyline: bool,
    /// DXF in the dialect of AutoCAD R12.
    pub dxf_r12: bool,
    /// Width that the laser burns away, mm.
    pub kerf: f64,
    /// Whether the pitch curves are engraved in `laser.svg`.
    pub laser_pitch_curves: bool,
    /// Width and depth of the printer's bed, mm.
    pub bed: [f64; 2],
    /// How a MuJoCo scene is driven and loaded.
    pub scene: super::Mjcf,
}

impl Default for ExportOptions {
    fn default() -> Self {
        Self {
            curve_tolerance: crate::policy::EXPORT_TOLERANCE,
            dxf_polyline: false,
            dxf_r12: false,
            kerf: 0.0,
            laser_pitch_curves: false,
            bed: super::Plate::default().bed,
            scene: super::Mjcf::default(),
        }
    }
}

/// What is known of a format.
#[derive(Clone, Copy)]
pub struct Entry {
    /// Its name on the command line.
    pub name: &'static str,
    /// Other names that are understood.
    pub aliases: &'static [&'static str],
    /// The files that a pair gets, each line of them with what it is for: `(files, for)`.
    pub files: &'static [(&'static [&'static str], &'static str)],
    /// Whether it is written when no format is named.
    pub unasked: bool,
    /// Whether it is drawn from the solids of the gears, not from their outlines alone.
    pub solid: bool,
    /// Whether it can hold such an assembly; one that cannot is left out unless it was named.
    pub holds: fn(&Assembly) -> bool,
    /// What makes its files out of an assembly; none for what only a whole design has.
    pub encoders: fn(&ExportOptions) -> Vec<Box<dyn Encode>>,
}

impl fmt::Debug for Entry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Entry").field("name", &self.name).finish_non_exhaustive()
    }
}

impl Entry {
    /// What most formats have in common: written unasked, any assembly, no solids.
    pub(super) const PLAIN: Self = Self {
        name: "",
        aliases: &[],
        files: &[],
        unasked: true,
        solid: false,
        holds: |_| true,
        encoders: |_| Vec::new(),
    };
}

/// Written by the commands that make a design, for it holds more than the gears.
const HTML: Entry = Entry {
    name: "html",
    files: &[(
        &["report.html"],
        "a page where the gears turn, with plots and all numbers; no network needed",
    )],
    ..Entry::PLAIN
};

/// Written by every run.
const JSON: Entry = Entry {
    name: "json",
    files: &[(
        &["design.json"],
        "other programs: outlines, pitch curves, motion, numbers, every setting",
    )],
    ..Entry::PLAIN
};

macro_rules! formats {
    ($($(#[$about:meta])* $format:ident = $entry:expr,)*) => {
        /// What can be written of a design.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Format {
            $($(#[$about])* $format,)*
        }

        impl Format {
            /// All formats, in the order in which they are written.
            pub const ALL: &'static [Self] = &[$(Self::$format),*];

            /// What is known of it.
            #[must_use]
            pub const fn entry(self) -> &'static Entry {
                match self {
                    $(Self::$format => const { &$entry },)*
                }
            }
        }
    };
}

formats! {
    /// The page `report.html`.
    Html = HTML,
    /// [`super::Picture`] and [`super::LaserSvg`].
    Svg = laser_svg::ENTRY,
    /// [`super::Glb`].
    Glb = glb::ENTRY,
    /// [`super::Stl`].
    Stl = stl::ENTRY,
    /// [`super::Obj`].
    Obj = obj::ENTRY,
    /// [`super::ThreeMf`] and [`super::Plate`].
    ThreeMf = threemf::ENTRY,
    /// [`super::Step`].
    Step = step::ENTRY,
    /// [`super::Dxf`].
    Dxf = dxf::ENTRY,
    /// [`super::Animation`]; only written when asked for.
    Gif = animation::ENTRY,
    /// [`super::Mjcf`].
    Mjcf = mjcf::ENTRY,
    /// The record `design.json`, which every run writes.
    Json = JSON,
}

impl Format {
    /// Its name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.entry().name
    }

    /// Names of the files that every pair gets in this format.
    pub fn files(self) -> impl Iterator<Item = &'static str> {
        self.entry().files.iter().flat_map(|(names, _)| names.iter().copied())
    }

    /// What makes its files out of an assembly.
    #[must_use]
    pub fn encoders(self, options: &ExportOptions) -> Vec<Box<dyn Encode>> {
        (self.entry().encoders)(options)
    }

    /// The names of all formats, separated by commas.
    #[must_use]
    pub fn names() -> String {
        Self::ALL.iter().map(|f| f.name()).collect::<Vec<_>>().join(", ")
    }

    /// The files of a pair and what each is for, as the rows of a Markdown table.
    #[must_use]
    pub fn table() -> String {
        let row = |(names, purpose): &(&[&str], &str)| {
            let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
            format!("| {} | {purpose} |\n", names.join(", "))
        };
        Self::ALL.iter().flat_map(|f| f.entry().files).map(row).collect()
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A format that does not exist.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no format {name:?}; choose from {}", Format::names())]
pub struct UnknownFormat {
    /// What was asked for.
    pub name: String,
}

impl FromStr for Format {
    type Err = UnknownFormat;

    fn from_str(text: &str) -> Result<Self, UnknownFormat> {
        let wanted = text.trim().to_ascii_lowercase();
        let named = |e: &Entry| e.name == wanted || e.aliases.contains(&wanted.as_str());
        let found = Self::ALL.iter().copied().find(|f| named(f.entry()));
        found.ok_or_else(|| UnknownFormat { name: text.trim().to_owned() })
    }
}

/// The formats that a user wants.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wanted {
    /// Those named; none for all that are written unasked.
    pub named: Vec<Format>,
    /// Those wanted besides.
    pub also: Vec<Format>,
    /// How they are to be written.
    pub options: ExportOptions,
}

impl Wanted {
    /// Whether a format is to be written.
    #[must_use]
    pub fn wants(&self, format: Format) -> bool {
        let unasked = self.named.is_empty() && format.entry().unasked;
        unasked || self.named.contains(&format) || self.also.contains(&format)
    }

    /// Whether a wanted format is drawn from solids.
    #[must_use]
    pub fn wants_solids(&self) -> bool {
        Format::ALL.iter().any(|f| f.entry().solid && self.wants(*f))
    }

    /// Names of the files that every pair gets; the record is always among them.
    #[must_use]
    pub fn files_of_a_pair(&self) -> Vec<&'static str> {
        let wanted = |f: &Format| self.wants(*f) || *f == Format::Json;
        Format::ALL.iter().copied().filter(wanted).flat_map(Format::files).collect()
    }

    /// Writes the wanted formats that an assembly alone can fill into `folder`, which exists; returns where the files are.
    ///
    /// # Errors
    /// [`ExportError`], naming the file; files finished before it stay.
    pub fn write(&self, parts: Parts<'_>, folder: &Path) -> Result<Vec<PathBuf>, ExportError> {
        let mut files = Vec::new();
        for format in Format::ALL.iter().copied().filter(|f| self.wants(*f)) {
            if (format.entry().holds)(parts.assembly) || self.named.contains(&format) {
                for encoder in format.encoders(&self.options) {
                    files.extend(encoder.write(parts, folder)?);
                }
            }
        }
        Ok(files)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::wavy_pair;
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn names_lead_back_and_others_are_told_what_exists() {
        for format in Format::ALL {
            assert_eq!(format.name().to_uppercase().parse(), Ok(*format));
        }
        assert_eq!(" stp ".parse(), Ok(Format::Step));
        let error = "iges".parse::<Format>().unwrap_err().to_string();
        assert!(error.contains("iges") && error.contains("step, dxf"), "{error}");
    }

    #[test]
    fn every_format_makes_the_files_it_names_and_no_two_the_same() {
        let (assembly, meshes) = wavy_pair();
        let parts = Parts { assembly: &assembly, meshes: &meshes };
        let mut names = HashSet::new();
        for format in Format::ALL {
            let encoders = format.encoders(&ExportOptions::default());
            let mut made = Vec::new();
            for encoder in &encoders {
                for artifact in encoder.encode(parts).unwrap() {
                    made.push(artifact.name.clone());
                    assert!(artifact.into_bytes().unwrap().len() > 100, "{made:?}");
                }
            }
            if !encoders.is_empty() {
                let mut listed: Vec<_> = format.files().collect();
                listed.sort_unstable();
                made.sort_unstable();
                assert_eq!(made, listed, "{format}");
            }
            assert!(format.files().all(|name| names.insert(name)), "{format}");
        }
    }

    #[test]
    fn the_readme_lists_every_file_as_the_registry_does() {
        let readme = include_str!("../../README.md");
        for row in Format::table().lines() {
            assert!(readme.contains(row), "README.md lacks the row\n{row}");
        }
    }

    #[test]
    fn what_is_wanted_follows_what_is_named() {
        let all = Wanted::default();
        assert!(all.wants(Format::Glb) && !all.wants(Format::Gif) && all.wants_solids());
        let flat = Wanted {
            named: vec![Format::Dxf],
            also: vec![Format::Gif],
            options: ExportOptions::default(),
        };
        assert!(flat.wants(Format::Gif) && !flat.wants(Format::Glb) && !flat.wants_solids());
        let files = flat.files_of_a_pair();
        assert!(files.contains(&"driver.dxf") && files.contains(&"design.json"), "{files:?}");
        assert!(!files.contains(&"pair.step"), "{files:?}");
    }
}
