//! The plate to print: every part flat on the bed, side by side.

use super::threemf::{Item, items, package};
use super::{Artifact, Encode, EncodeError, Parts};
use crate::assembly::Assembly;
use crate::geometry::{self, Point};
use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use std::f64::consts::FRAC_PI_2;

/// Room between parts and to the edge of the bed, mm: for a brim, and for fingers.
const GAP: f64 = 5.0;

/// `plate.3mf`: all parts as they are printed, named and coloured, none upon another; what does not go on one bed is on
/// the next, `plate-2.3mf` and so on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plate {
    /// Width and depth of the bed, mm.
    pub bed: [f64; 2],
}

impl Default for Plate {
    /// What nearly every printer has.
    fn default() -> Self {
        Self { bed: [200.0, 200.0] }
    }
}

impl Encode for Plate {
    fn encode<'a>(&'a self, parts: Parts<'a>) -> Result<Vec<Artifact<'a>>, EncodeError> {
        let artifact = |(number, bed): (usize, Vec<(usize, Isometry3<f64>)>)| {
            Artifact::stream(file_name(number), move |out| {
                let all = items(parts);
                let lying: Vec<Item<'_>> = bed
                    .into_iter()
                    .filter_map(|(part, place)| Some(Item { place, ..*all.get(part)? }))
                    .collect();
                package(parts.assembly, &lying, out)
            })
        };
        Ok(self.beds(parts.assembly).into_iter().enumerate().map(artifact).collect())
    }
}

fn file_name(number: usize) -> String {
    if number == 0 { "plate.3mf".to_owned() } else { format!("plate-{}.3mf", number + 1) }
}

impl Plate {
    /// Names of the parts that are larger than the bed; each lies on one of its own all the same.
    #[must_use]
    pub fn too_large(&self, assembly: &Assembly) -> Vec<String> {
        let outlines = outlines(assembly);
        let larger = outlines.iter().filter(|(_, ring)| self.lying(ring).is_none());
        larger.map(|(name, _)| (*name).to_owned()).collect()
    }

    /// The parts on each bed, by their number (gears, then fixtures), and where they lie on it.
    fn beds(&self, assembly: &Assembly) -> Vec<Vec<(usize, Isometry3<f64>)>> {
        let outlines = outlines(assembly);
        let mut boxes: Vec<(usize, Lying)> = outlines
            .iter()
            .enumerate()
            .map(|(i, (_, ring))| (i, self.lying(ring).unwrap_or_else(|| Lying::of(ring, 0.0))))
            .collect();
        boxes.sort_by(|a, b| b.1.size.y.total_cmp(&a.1.size.y));
        let mut beds: Vec<Shelves> = Vec::new();
        for (part, lying) in boxes {
            let found = beds
                .iter_mut()
                .enumerate()
                .find_map(|(i, bed)| Some((i, bed.place(lying.size, self.bed)?)));
            let (bed, corner) = found.unwrap_or_else(|| {
                // An empty bed takes anything, also what reaches beyond it.
                let mut bed = Shelves::default();
                let corner = bed.first(lying.size);
                beds.push(bed);
                (beds.len() - 1, corner)
            });
            beds[bed].parts.push((part, lying.at(corner)));
        }
        beds.into_iter().map(|bed| bed.centred(self.bed)).collect()
    }

    /// The part turned so that it fits the bed, its longer side along x if it can be; none where it does not fit.
    fn lying(&self, ring: &[Point]) -> Option<Lying> {
        // As drawn, or on its other side; then whatever angle makes it fit.
        let first = [0.0, FRAC_PI_2].map(|a| Lying::of(ring, a));
        let fits =
            |l: &Lying| l.size.x + 2.0 * GAP <= self.bed[0] && l.size.y + 2.0 * GAP <= self.bed[1];
        let best = first.into_iter().filter(fits).min_by(|a, b| a.size.y.total_cmp(&b.size.y));
        best.or_else(|| (1..90).map(|d| Lying::of(ring, f64::from(d).to_radians())).find(fits))
    }
}

/// Outlines of all parts as they are printed.
fn outlines(assembly: &Assembly) -> Vec<(&str, &[Point])> {
    let gears = assembly.gears.iter().map(|g| (g.gear.name.as_str(), g.gear.outline.as_slice()));
    let fixtures = assembly.fixtures.iter().map(|f| (f.name.as_str(), f.outline.as_slice()));
    gears.chain(fixtures).collect()
}

/// A part turned on the bed.
struct Lying {
    angle: f64,
    low: Point,
    size: geometry::Vector,
}

impl Lying {
    fn of(ring: &[Point], angle: f64) -> Self {
        let turned: Vec<Point> = ring.iter().map(|p| geometry::rotate(*p, angle)).collect();
        let (low, high) = geometry::bounds(&turned);
        Self { angle, low, size: high - low }
    }

    /// Its place with its lower left corner at `corner`.
    fn at(&self, corner: Point) -> Isometry3<f64> {
        let shift = corner - self.low;
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), self.angle);
        Isometry3::from_parts(Vector3::new(shift.x, shift.y, 0.0).into(), turn)
    }
}

/// Rows of parts on one bed, from the front.
#[derive(Default)]
struct Shelves {
    /// Front edge, depth, and where the next part begins, of each row.
    rows: Vec<[f64; 3]>,
    /// How far the parts reach.
    reach: [f64; 2],
    parts: Vec<(usize, Isometry3<f64>)>,
}

impl Shelves {
    fn first(&mut self, size: geometry::Vector) -> Point {
        self.rows.push([GAP, size.y, GAP + size.x + GAP]);
        self.reached(Point::new(GAP, GAP), size)
    }

    /// Room for a part, its corner; none when the bed is full.
    fn place(&mut self, size: geometry::Vector, bed: [f64; 2]) -> Option<Point> {
        let fitting = |row: &&mut [f64; 3]| row[2] + size.x + GAP <= bed[0] && size.y <= row[1];
        if let Some(row) = self.rows.iter_mut().find(fitting) {
            let corner = Point::new(row[2], row[0]);
            row[2] += size.x + GAP;
            return Some(self.reached(corner, size));
        }
        let front = self.rows.last().map_or(GAP, |row| row[0] + row[1] + GAP);
        if front + size.y + GAP > bed[1] || size.x + 2.0 * GAP > bed[0] {
            return None;
        }
        self.rows.push([front, size.y, GAP + size.x + GAP]);
        Some(self.reached(Point::new(GAP, front), size))
    }

    fn reached(&mut self, corner: Point, size: geometry::Vector) -> Point {
        self.reach = [self.reach[0].max(corner.x + size.x), self.reach[1].max(corner.y + size.y)];
        corner
    }

    /// The parts moved to the middle of the bed.
    fn centred(self, bed: [f64; 2]) -> Vec<(usize, Isometry3<f64>)> {
        let [x, y] = [0, 1].map(|k| (0.5 * (bed[k] - GAP - self.reach[k])).max(0.0));
        let shift = nalgebra::Translation3::new(x, y, 0.0);
        self.parts.into_iter().map(|(part, place)| (part, shift * place)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{base, wavy_pair};
    use super::*;
    use crate::solid::assembly_solids;

    #[test]
    fn parts_lie_flat_apart_and_on_the_bed() {
        let (mut assembly, _) = wavy_pair();
        assembly.fixtures.push(base());
        for (bed, count) in [([200.0, 200.0], 1), ([220.0, 118.0], 2), ([112.0, 100.0], 3)] {
            let plate = Plate { bed };
            let beds = plate.beds(&assembly);
            assert_eq!(beds.len(), count, "{bed:?}");
            assert_eq!(plate.too_large(&assembly), Vec::<String>::new());
            let mut seen = Vec::new();
            for parts in beds {
                let boxes: Vec<(Point, Point)> = parts
                    .iter()
                    .map(|(part, place)| {
                        let all = outlines(&assembly);
                        let lying: Vec<Point> = all[*part]
                            .1
                            .iter()
                            .map(|p| place * nalgebra::Point3::new(p.x, p.y, 0.0))
                            .map(|p| Point::new(p.x, p.y))
                            .collect();
                        assert_eq!(place.translation.z, 0.0);
                        geometry::bounds(&lying)
                    })
                    .collect();
                for (i, (low, high)) in boxes.iter().enumerate() {
                    assert!(low.x >= GAP - 1e-9 && high.x <= bed[0] - GAP + 1e-9, "{low} {high}");
                    assert!(low.y >= GAP - 1e-9 && high.y <= bed[1] - GAP + 1e-9, "{low} {high}");
                    for (l, h) in &boxes[..i] {
                        let gap = [l.x - high.x, low.x - h.x, l.y - high.y, low.y - h.y];
                        assert!(gap.into_iter().any(|g| g >= GAP - 1e-9), "{gap:?}");
                    }
                }
                seen.extend(parts.into_iter().map(|p| p.0));
            }
            seen.sort_unstable();
            assert_eq!(seen, [0, 1, 2]);
        }
        assert_eq!(
            Plate { bed: [90.0, 90.0] }.too_large(&assembly),
            ["driver", "follower", "base"]
        );
    }

    #[test]
    fn each_bed_is_a_file() {
        let (mut assembly, _) = wavy_pair();
        assembly.fixtures.push(base());
        let meshes = assembly_solids(&assembly).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let plate = Plate { bed: [220.0, 118.0] };
        let parts = Parts { assembly: &assembly, meshes: &meshes };
        let files = plate.write(parts, folder.path()).unwrap();
        let names: Vec<_> =
            files.iter().map(|f| f.file_name().unwrap().to_str().unwrap()).collect();
        assert_eq!(names, ["plate.3mf", "plate-2.3mf"]);
        assert_eq!(
            names,
            plate.beds(&assembly).iter().enumerate().map(|(i, _)| file_name(i)).collect::<Vec<_>>()
        );
    }
}
