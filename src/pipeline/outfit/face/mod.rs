//! The inner drawing of a shape on the face of its gear, and the holes of the drawing in it.

mod holes;
mod lines;
mod warp;

pub(super) use holes::add as add_holes;

use super::{OutfitError, Taken};
use crate::assembly::{Gear, Mark};
use crate::control::StageName;
use crate::diagnose::{Code, Diagnostic};
use crate::geometry::{self, Face, Point};
use crate::input::Inner;
use crate::outline::simplify;
use crate::policy;
use serde::{Deserialize, Serialize};
use warp::Warp;

/// The inner drawing on the faces of the gears.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FaceChoice {
    /// What becomes of it.
    pub style: FaceStyle,
    /// How deep it is sunk, or how high it is raised, mm; that of the style when `None`.
    pub depth: Option<f64>,
    /// How it follows the gear.
    pub fit: FaceFit,
}

/// What becomes of an inner drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FaceStyle {
    /// It is left out.
    #[default]
    None,
    /// It is sunk into the face.
    Engrave,
    /// It stands out of the face.
    Raise,
    /// It is cut through where walls stay.
    Cut,
}

/// How an inner drawing lies on a gear whose outline is not quite that of the drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FaceFit {
    /// Moved along with the outline: the edge of the drawing goes to the edge of the face.
    #[default]
    Follow,
    /// As it was drawn, less what lies outside of the face.
    Keep,
}

/// What becomes of the holes of a drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DrawnHoles {
    /// They are holes of the gear, where walls stay.
    #[default]
    Keep,
    /// They are filled in.
    Fill,
}

/// Wall between a drawing on the face and edges, mm, and in nozzles: two lines of the usual one.
const WALL: (f64, f64) = (0.8, 2.0);
/// Depth of the teeth below the pitch curve, in modules.
const DEDENDUM: f64 = 1.25;
/// Most separate figures on one face; beyond it the smallest are left out.
const FIGURES: usize = 300;
/// Longest straight edge that is moved as one, mm: longer ones would not bend along.
const EDGE: f64 = 0.8;
/// How far vertices of a figure may be moved to spare some, mm: below what any printer shows.
const TOLERANCE: f64 = 0.01;

impl FaceChoice {
    /// Passes a depth that gears of a thickness can bear.
    ///
    /// # Errors
    /// [`OutfitError::BadSize`].
    pub(super) fn check(&self, thickness: f64) -> Result<(), OutfitError> {
        let most = match self.style {
            FaceStyle::Raise => policy::LARGEST_LENGTH,
            _ => 0.75 * thickness,
        };
        match self.depth {
            Some(value) if !(value > 0.0 && value <= most) => {
                let remedy = format!("give a length above 0 and up to {most:.2} mm");
                Err(OutfitError::BadSize { what: "the depth of the face", value, remedy })
            }
            _ => Ok(()),
        }
    }

    fn height(&self) -> f64 {
        match self.style {
            FaceStyle::Raise => self.depth.unwrap_or(policy::EMBOSSING_HEIGHT),
            _ => -self.depth.unwrap_or(policy::ENGRAVING_DEPTH),
        }
    }
}

/// Puts an inner drawing, given in the gear's frame, on the gear.
pub(super) fn add(
    gear: &mut Gear,
    choice: &FaceChoice,
    inner: &Inner,
    (module, nozzle): (f64, f64),
    taken: &Taken,
) -> Vec<Diagnostic> {
    if choice.style == FaceStyle::None || (inner.patches.is_empty() && inner.lines.is_empty()) {
        return Vec::new();
    }
    let said = |code| Diagnostic::warning(code, StageName::Outfitted).about(&gear.name);
    let cut = choice.style == FaceStyle::Cut;
    let wall = if cut { holes::RIM.0.max(holes::RIM.1 * module) } else { wall(nozzle) };
    let Some(room) = room(gear, wall, module, taken) else { return vec![said(Code::FaceLost)] };
    let place = Place::new(gear, module, choice.fit, nozzle);
    let mut found = Vec::new();
    // The finest details lie on top and are drawn whole.
    let mut patches: Vec<Vec<Face>> = inner.patches.iter().map(|p| place.faces(&p.faces)).collect();
    patches.push(place.lines(&inner.lines, nozzle));
    patches.sort_by(|a, b| covered(a).total_cmp(&covered(b)));
    let (mut widened, mut dropped) = (0, 0);
    let mut figures: Vec<Face> = Vec::new();
    for faces in patches {
        let before = lines::rings(&geometry::grown(&figures, nozzle, policy::OPENING_CHORD));
        let drawable = lines::drawable(&faces, nozzle);
        widened += drawable.widened;
        dropped += drawable.dropped;
        let free = geometry::without(&lines::rings(&drawable.faces), &before);
        let inside = geometry::common(&lines::rings(&free), &room);
        figures.extend(lines::opened(&inside, nozzle));
    }
    let wanted = covered(
        &place.faces(&inner.patches.iter().flat_map(|p| p.faces.clone()).collect::<Vec<_>>()),
    );
    if cut {
        figures = holes::with_bridges(figures);
    }
    figures.sort_by(|a, b| geometry::area(&b[0]).total_cmp(&geometry::area(&a[0])));
    dropped += figures.len().saturating_sub(FIGURES);
    figures.truncate(FIGURES);
    let figures: Vec<Face> = figures.into_iter().filter_map(|face| plain(&face)).collect();
    if figures.is_empty() {
        return vec![said(Code::FaceLost)];
    }
    let kept = covered(&figures) / wanted.max(f64::MIN_POSITIVE);
    if cut {
        found.extend(holes::cut(gear, figures, "face"));
    } else {
        let height = choice.height();
        for (i, face) in figures.into_iter().enumerate() {
            gear.fittings.marks.push(Mark { name: format!("face {}", i + 1), face, height });
        }
    }
    let note = |code| Diagnostic::note(code, StageName::Outfitted).about(&gear.name);
    if widened + dropped > 0 {
        let lines = note(Code::FaceLines).with("widened", widened as f64);
        found.push(lines.with("dropped", dropped as f64).with("nozzle", nozzle));
    }
    if kept < CLIPPED_WORTH_SAYING {
        found.push(note(Code::FaceClipped).with("share", 1.0 - kept));
    }
    found
}

/// Share of an inner drawing that must be there for nothing to be said of what is missing.
const CLIPPED_WORTH_SAYING: f64 = 0.9;

fn covered(faces: &[Face]) -> f64 {
    faces.iter().flatten().map(|ring| geometry::signed_area(ring)).sum()
}

fn wall(nozzle: f64) -> f64 {
    WALL.0.max(WALL.1 * nozzle)
}

/// Where a drawing may lie on a gear: inside of its roots and clear of all that it carries, as boundaries.
fn room(gear: &Gear, wall: f64, module: f64, taken: &Taken) -> Option<Vec<Vec<Point>>> {
    // Taking off half a tooth's thickness more, and giving it back, leaves no teeth.
    let tooth = policy::TOOTH_HALF_THICKNESS * module;
    let chord = policy::OPENING_CHORD;
    let inner = geometry::offset(&gear.outline, -(wall + tooth), chord);
    let body = lines::rings(&geometry::grown(&inner, tooth, chord));
    let mut barred = taken.grown(wall);
    let openings = gear.fittings.openings.iter().map(|o| vec![o.ring.clone()]).collect::<Vec<_>>();
    barred.extend(lines::rings(&geometry::grown(&openings, wall, chord)));
    let free = geometry::without(&body, &lines::rings(&geometry::union(&barred)));
    (!free.is_empty()).then(|| lines::rings(&free))
}

/// How a drawing comes to lie on a gear.
struct Place {
    warp: Option<Warp>,
}

impl Place {
    fn new(gear: &Gear, module: f64, fit: FaceFit, nozzle: f64) -> Self {
        let follows = || {
            let inset = DEDENDUM * module + wall(nozzle);
            let faces = geometry::offset(&gear.pitch_curve, -inset, policy::OPENING_CHORD);
            let rings = faces.into_iter().filter_map(|f| f.into_iter().next());
            let mut about = rings.filter(|r| geometry::contains(r, Point::origin()));
            Warp::new(&gear.input, &about.next()?)
        };
        Self { warp: if fit == FaceFit::Follow { follows() } else { None } }
    }

    fn line(&self, points: impl Iterator<Item = (Point, Point)>) -> Vec<Point> {
        let Some(warp) = &self.warp else { return points.map(|(a, _)| a).collect() };
        points
            .flat_map(|(a, b)| {
                let steps = ((b - a).norm() / EDGE).ceil().max(1.0);
                (0..steps as usize).map(move |i| a + (b - a) * (i as f64 / steps))
            })
            .map(|p| warp.apply(&p))
            .collect()
    }

    fn ring(&self, ring: &[Point]) -> Vec<Point> {
        self.line(ring.iter().copied().zip(ring.iter().copied().cycle().skip(1)))
    }

    fn faces(&self, faces: &[Face]) -> Vec<Face> {
        let moved: Vec<Vec<Point>> = faces.iter().flatten().map(|ring| self.ring(ring)).collect();
        // Where the map folds, what lies double is once there.
        geometry::union(&moved)
    }

    /// Lines drawn with a pen.
    fn lines(&self, lines: &[Vec<Point>], pen: f64) -> Vec<Face> {
        let half = 0.5 * pen;
        let bar = |a: Point, b: Point| {
            let along = (b - a).normalize();
            let across = geometry::quarter_turn(along) * half;
            let end = along * half;
            vec![a - end - across, b + end - across, b + end + across, a - end + across]
        };
        let mut bars = Vec::new();
        for line in lines {
            let ends = line.windows(2).map(|w| (w[0], w[1]));
            let mut moved = self.line(ends);
            moved.extend(line.last().map(|p| self.warp.as_ref().map_or(*p, |w| w.apply(p))));
            moved.dedup();
            bars.extend(moved.windows(2).map(|w| bar(w[0], w[1])));
        }
        geometry::union(&bars)
    }
}

/// A figure without vertices that no printer shows; none where nothing is left of it.
fn plain(face: &Face) -> Option<Face> {
    let mut rings = face.iter().map(|ring| simplify(ring, TOLERANCE));
    let outer = rings.next().filter(|ring| ring.len() > 2)?;
    let rest = rings.filter(|ring| ring.len() > 2 && geometry::area(ring) > TOLERANCE);
    Some(std::iter::once(outer).chain(rest).collect())
}
