//! Which of a file's contours is meant: the visible one that has teeth, rather than the largest.

use super::InputError;
use super::contours::{Contour, Contours, Unit};
use super::nature::Nature;
use super::note::Note;
use super::source::Source;
use crate::gear::Side;
use crate::geometry::{self, Point};
use crate::wording::quoted;

/// Smaller contours than this share of the largest that could be meant are details.
const DETAIL: f64 = 0.2;
/// Contours that are looked at closely, the widest first: a drawing may hold many thousands of letters and specks.
const LOOKED_AT: usize = 256;
/// Contours named in a message.
const LISTED: usize = 6;
/// Contours nearer than this to each other, over their size, are the same one drawn twice.
const SAME: f64 = 1e-5;
/// Clearance of the rim about an inner gear, over the depth of its teeth: a circle about the tips is a reference circle.
const RIM: f64 = 0.15;

/// The contour that is meant, and what lies in it.
#[derive(Clone, Debug)]
pub(super) struct Chosen {
    pub(super) outer: Contour,
    pub(super) holes: Vec<Contour>,
}

/// What could be meant, best first, and all else that is closed.
struct Judged {
    candidates: Vec<(Contour, Nature)>,
    others: Vec<Contour>,
}

/// The gear among contours.
///
/// # Errors
/// [`InputError::Several`], [`InputError::Open`], [`InputError::NoContour`], [`InputError::NoSuchPart`],
/// [`InputError::InnerGear`].
pub(super) fn gear(
    contours: &mut Contours,
    source: Source<'_>,
    side: Side,
) -> Result<Chosen, InputError> {
    let list = std::mem::take(&mut contours.list);
    if contours.told {
        return told(list, source, contours.unit);
    }
    let (layered, number) = of_part(list, source, Some(side))?;
    let unit = contours.unit;
    let judged = judged(layered, source, unit)?;
    let chosen = pick(judged, number, source, unit, &mut contours.notes, false)?;
    not_inner(&chosen.0, &chosen.1, source, unit)?;
    Ok(with_holes(chosen.0, chosen.1))
}

/// The shape among contours, for a gear to be made of it.
///
/// # Errors
/// As [`gear`], without inner gears.
pub(super) fn shape(contours: &mut Contours, source: Source<'_>) -> Result<Chosen, InputError> {
    let list = std::mem::take(&mut contours.list);
    if contours.told {
        return told(list, source, contours.unit);
    }
    let (layered, number) = of_part(list, source, None)?;
    let judged = judged(layered, source, contours.unit)?;
    let (chosen, others) = pick(judged, number, source, contours.unit, &mut contours.notes, true)?;
    Ok(with_holes(chosen, others))
}

/// How many gears a file without named parts holds.
pub(super) fn count(contours: &Contours, source: Source<'_>) -> usize {
    if contours.told || source.part.is_some() {
        return 1;
    }
    let named = contours.list.iter().any(|c| Side::BOTH.iter().any(|s| c.layer == s.name()));
    let judged = judged(contours.list.clone(), source, contours.unit);
    judged
        .ok()
        .filter(|_| !named)
        .map_or(1, |j| j.candidates.iter().filter(|(_, n)| n.is_toothed()).count())
}

/// The first contour, where the file says that it is the gear.
fn told(list: Vec<Contour>, source: Source<'_>, unit: Unit) -> Result<Chosen, InputError> {
    let mut list = list.into_iter();
    let first = list.next().ok_or(InputError::NoContour { path: source.path() })?;
    if first.points.len() < 2 {
        return Err(InputError::NoContour { path: source.path() });
    }
    if !first.closed {
        return Err(open_at(&[&first], &[], source, unit));
    }
    let nature = Nature::of(&first);
    let others: Vec<Contour> = list.collect();
    not_inner(&(first.clone(), nature), &others, source, unit)?;
    if nature == Nature::Round
        && let Some(inner) = others.iter().find(|c| Nature::of(c).is_toothed())
        && first.encloses(inner)
    {
        return Err(InputError::InnerGear {
            path: source.path(),
            outside: width(&first) * unit.mm,
        });
    }
    let holes = others.into_iter().filter(|c| c.closed).collect();
    Ok(Chosen { outer: first, holes })
}

/// The contours of the layer that is named, with those of other layers that lie in them, or all; and the number that was
/// given instead of a name.
fn of_part(
    list: Vec<Contour>,
    source: Source<'_>,
    side: Option<Side>,
) -> Result<(Vec<Contour>, Option<usize>), InputError> {
    let named = |name: &str| list.iter().any(|c| belongs(&c.layer, name));
    let both = || Side::BOTH.iter().all(|s| named(s.name()));
    let wanted = match source.part {
        Some(part) if named(part) => part,
        Some(part) => match part.parse::<usize>() {
            Ok(number) if number > 0 => return Ok((list, Some(number))),
            _ => {
                let mut layers: Vec<&str> =
                    list.iter().map(|c| c.layer.as_str()).filter(|l| !l.is_empty()).collect();
                layers.sort_unstable();
                layers.dedup();
                let known = match layers.len() {
                    0 => format!("leave #{part} out"),
                    _ => format!("name one of {}", quoted(&layers.join(", "))),
                };
                return Err(InputError::NoSuchPart {
                    path: source.path(),
                    part: quoted(part),
                    known,
                });
            }
        },
        None => match side {
            Some(side)
                if named(side.name())
                    && (both() || list.iter().any(|c| c.layer == side.name())) =>
            {
                side.name()
            }
            _ => return Ok((list, None)),
        },
    };
    let points: Vec<Point> = list
        .iter()
        .filter(|c| belongs(&c.layer, wanted))
        .flat_map(|c| c.points.iter().copied())
        .collect();
    let (low, high) = geometry::bounds(&points);
    let within = |c: &Contour| c.points.iter().all(|p| *p >= low && *p <= high);
    // Of other layers what lies about the gear stays: bores may be there.
    let kept = list.into_iter().filter(|c| belongs(&c.layer, wanted) || within(c)).map(|mut c| {
        c.dashed |= !belongs(&c.layer, wanted);
        c
    });
    Ok((kept.collect(), None))
}

/// Whether a layer is the part, or a layer of it, such as `driver-cut-outlines` of `driver`.
fn belongs(layer: &str, part: &str) -> bool {
    let strip =
        |l: &str| l.strip_prefix(part).is_some_and(|rest| rest.is_empty() || rest.starts_with('-'));
    strip(layer) || layer.eq_ignore_ascii_case(part)
}

fn judged(list: Vec<Contour>, source: Source<'_>, unit: Unit) -> Result<Judged, InputError> {
    let (closed, open): (Vec<Contour>, Vec<Contour>) =
        list.into_iter().filter(|c| c.points.len() > 1).partition(|c| c.closed);
    let known: Vec<(Contour, Nature)> = distinct(closed)
        .into_iter()
        .enumerate()
        .map(|(i, c)| {
            let nature = if i < LOOKED_AT { Nature::of(&c) } else { Nature::Other };
            (c, nature)
        })
        .collect();
    let solid = known.iter().any(|(c, _)| !c.dashed);
    let fair = |c: &Contour| !(solid && c.dashed);
    let toothed: Vec<usize> =
        (0..known.len()).filter(|&i| known[i].1.is_toothed() && fair(&known[i].0)).collect();
    let shapes = |wanted: &dyn Fn(Nature) -> bool| -> Vec<usize> {
        (0..known.len()).filter(|&i| wanted(known[i].1) && fair(&known[i].0)).collect()
    };
    let mut indices = toothed;
    if indices.is_empty() {
        indices = shapes(&|n| n == Nature::Other);
        // A frame about it is none, but a plate with a small hole of some form is the plate.
        let largest = known.iter().map(|(c, _)| c.extent()).fold(0.0, f64::max);
        if indices.first().is_none_or(|&i| known[i].0.extent() < DETAIL * largest) {
            indices = shapes(&|_| true);
        }
    }
    let largest = indices.first().map_or(0.0, |&i| known[i].0.extent());
    indices.retain(|&i| known[i].0.extent() >= DETAIL * largest);
    indices.truncate(LOOKED_AT);
    let inner =
        |i: usize, list: &[usize]| list.iter().any(|&j| j != i && known[j].0.encloses(&known[i].0));
    let outermost: Vec<usize> = indices.iter().copied().filter(|&i| !inner(i, &indices)).collect();
    refuse_open(&open, outermost.first().map(|&i| &known[i]), source, unit)?;
    if outermost.is_empty() {
        return Err(InputError::NoContour { path: source.path() });
    }
    let mut candidates = Vec::new();
    let mut others = Vec::new();
    for (i, (contour, nature)) in known.into_iter().enumerate() {
        if outermost.contains(&i) {
            candidates.push((contour, nature))
        } else {
            others.push(contour)
        }
    }
    Ok(Judged { candidates, others })
}

/// Closed contours, each once, the widest first.
fn distinct(mut closed: Vec<Contour>) -> Vec<Contour> {
    closed.sort_by(|a, b| b.extent().total_cmp(&a.extent()));
    let mut kept: Vec<(Contour, Point, Point, f64)> = Vec::new();
    for contour in closed {
        let (low, high) = geometry::bounds(&contour.points);
        let size = (high - low).norm();
        let near = SAME * size;
        let area = geometry::area(&contour.points);
        let same = |(_, l, h, a): &(Contour, Point, Point, f64)| {
            (l - low).norm() <= near && (h - high).norm() <= near && (a - area).abs() <= 1e-3 * area
        };
        // Those of the same width are neighbours.
        let crowd = kept.len().saturating_sub(LOOKED_AT);
        match kept[crowd..].iter_mut().find(|k| same(k)) {
            // Of two the one that is drawn in full.
            Some(known) if known.0.dashed && !contour.dashed => known.0 = contour,
            Some(_) => {}
            None => kept.push((contour, low, high, area)),
        }
    }
    kept.into_iter().map(|(contour, ..)| contour).collect()
}

/// No fragment of the real outline loses to a smaller ring.
fn refuse_open(
    open: &[Contour],
    chosen: Option<&(Contour, Nature)>,
    source: Source<'_>,
    unit: Unit,
) -> Result<(), InputError> {
    let Some((chosen, nature)) = chosen else {
        let mut pieces: Vec<&Contour> = open.iter().filter(|c| !c.dashed).collect();
        if pieces.is_empty() {
            pieces = open.iter().collect();
        }
        pieces.sort_by(|a, b| b.extent().total_cmp(&a.extent()));
        let size = pieces.first().map_or(0.0, |c| c.extent());
        pieces.retain(|c| c.extent() >= DETAIL * size);
        return if pieces.is_empty() { Ok(()) } else { Err(open_at(&pieces, open, source, unit)) };
    };
    let of_size = |c: &&Contour| c.extent() > chosen.extent() && !c.dashed;
    let broken: Vec<&Contour> = if nature.is_toothed() {
        open.iter()
            .filter(of_size)
            .filter(|c| Nature::of(c).is_toothed() && c.encloses(chosen))
            .collect()
    } else {
        // Straight lines are no outline: centre lines, dimensions, leaders.
        open.iter().filter(of_size).filter(|c| !is_straight(&c.points)).collect()
    };
    if !broken.is_empty() {
        return Err(open_at(&broken, open, source, unit));
    }
    // Many short pieces that surround what was chosen: an outline that falls apart.
    if !nature.is_toothed() {
        let bent: Vec<&Contour> =
            open.iter().filter(|c| !c.dashed && !is_straight(&c.points)).collect();
        let points: Vec<Point> = bent.iter().flat_map(|c| c.points.iter().copied()).collect();
        let (low, high) = geometry::bounds(&points);
        let (from, to) = geometry::bounds(&chosen.points);
        if bent.len() > 3 && low <= from && high >= to {
            return Err(open_at(&bent, open, source, unit));
        }
    }
    Ok(())
}

fn is_straight(points: &[Point]) -> bool {
    match (points.first(), points.last()) {
        (Some(a), Some(b)) => {
            let length: f64 = points.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
            (b - a).norm() > 0.999 * length
        }
        _ => true,
    }
}

/// The widest gap between an end and the nearest other end, also of smaller pieces.
fn open_at(pieces: &[&Contour], all: &[Contour], source: Source<'_>, unit: Unit) -> InputError {
    let ends = |c: &Contour| {
        c.points.first().into_iter().chain(c.points.last()).copied().collect::<Vec<Point>>()
    };
    let of_pieces: Vec<Point> = pieces.iter().take(OPEN_PIECES).flat_map(|c| ends(c)).collect();
    let others: Vec<Point> = all.iter().take(OPEN_PIECES).flat_map(ends).collect();
    let near = |at: Point| {
        let apart = of_pieces
            .iter()
            .chain(&others)
            .map(|p| ((p - at).norm(), *p))
            .filter(|(gap, _)| *gap > 0.0);
        apart.min_by(|a, b| a.0.total_cmp(&b.0))
    };
    let mut gaps: Vec<(f64, Point, Point)> = of_pieces
        .iter()
        .filter_map(|&end| near(end).map(|(gap, other)| (gap, end, other)))
        .collect();
    gaps.sort_by(|a, b| b.0.total_cmp(&a.0));
    let (gap, from, to) = gaps.first().copied().unwrap_or((0.0, Point::origin(), Point::origin()));
    // Two ends of one piece are one gap.
    let both = |g: &(f64, Point, Point)| gaps.iter().any(|h| h.1 == g.2 && h.2 == g.1);
    let shared = gaps.iter().filter(|g| both(g)).count();
    let places = gaps.len() - shared / 2;
    let more = match places {
        0 | 1 => String::new(),
        2 => " and in 1 other place".to_owned(),
        n => format!(" and in {} other places", n - 1),
    };
    InputError::Open {
        path: source.path(),
        gap,
        unit: unit.name,
        from_x: from.x,
        from_y: from.y,
        to_x: to.x,
        to_y: to.y,
        more,
    }
}

/// Pieces whose ends are compared for a message.
const OPEN_PIECES: usize = 500;

/// One of the candidates, and all else that is closed.
fn pick(
    judged: Judged,
    number: Option<usize>,
    source: Source<'_>,
    unit: Unit,
    notes: &mut Vec<Note>,
    for_shape: bool,
) -> Result<((Contour, Nature), Vec<Contour>), InputError> {
    let Judged { mut candidates, mut others } = judged;
    let area = |c: &Contour| geometry::area(&c.points);
    if let Some(number) = number {
        if number > candidates.len() {
            let list = listed(&candidates, unit);
            let known = format!("it has {} ({list})", candidates.len());
            return Err(InputError::NoSuchPart {
                path: source.path(),
                part: number.to_string(),
                known: format!("{known}; name one"),
            });
        }
        let chosen = candidates.swap_remove(number - 1);
        others.extend(candidates.into_iter().map(|(c, _)| c));
        return Ok((chosen, others));
    }
    candidates.sort_by(|a, b| area(&b.0).total_cmp(&area(&a.0)));
    if candidates.len() > 1 {
        let share = area(&candidates[1].0) / area(&candidates[0].0).max(f64::MIN_POSITIVE);
        if !(for_shape && share < 0.1) {
            let layers: Vec<&str> = candidates.iter().map(|(c, _)| c.layer.as_str()).collect();
            let apart =
                layers.iter().filter(|l| **l == layers[0]).count() == 1 && !layers[0].is_empty();
            let example = if apart { quoted(layers[0]) } else { "1".to_owned() };
            return Err(InputError::Several {
                path: source.path(),
                count: candidates.len(),
                list: listed(&candidates, unit),
                example,
            });
        }
        let what = describe(&candidates[0], unit);
        notes.push(Note::Taken { what, others: candidates.len() - 1 });
    }
    let chosen = candidates.remove(0);
    others.extend(candidates.into_iter().map(|(c, _)| c));
    Ok((chosen, others))
}

/// The candidates as a message names them.
fn listed(candidates: &[(Contour, Nature)], unit: Unit) -> String {
    let mut names: Vec<String> = candidates
        .iter()
        .take(LISTED)
        .enumerate()
        .map(|(i, c)| format!("#{}: {}", i + 1, describe(c, unit)))
        .collect();
    if candidates.len() > LISTED {
        names.push(format!("and {} more", candidates.len() - LISTED));
    }
    names.join(", ")
}

fn describe((contour, nature): &(Contour, Nature), unit: Unit) -> String {
    let (low, high) = geometry::bounds(&contour.points);
    let center = nalgebra::center(&low, &high);
    let what = match nature {
        Nature::Toothed(teeth) => format!("{teeth} teeth, "),
        Nature::Round => "a circle, ".to_owned(),
        Nature::Box => "a rectangle, ".to_owned(),
        Nature::Other => String::new(),
    };
    let layer = match contour.layer.as_str() {
        "" => String::new(),
        layer => format!(" on layer {}", quoted(layer)),
    };
    format!(
        "{what}{:.4} x {:.4} {} at ({:.4}, {:.4}){layer}",
        high.x - low.x,
        high.y - low.y,
        unit.name,
        center.x,
        center.y
    )
}

fn width(contour: &Contour) -> f64 {
    let (low, high) = geometry::bounds(&contour.points);
    (high.x - low.x).max(high.y - low.y)
}

/// Refuses teeth that point inwards: in a rim, and without a bore.
fn not_inner(
    chosen: &(Contour, Nature),
    others: &[Contour],
    source: Source<'_>,
    unit: Unit,
) -> Result<(), InputError> {
    let (gear, nature) = chosen;
    if !nature.is_toothed() || others.iter().any(|c| gear.encloses(c)) {
        return Ok(());
    }
    let center = geometry::centroid(&gear.points);
    let radii = || gear.points.iter().map(|p| (p - center).norm());
    let (root, tip) = (radii().fold(f64::INFINITY, f64::min), radii().fold(0.0, f64::max));
    let rim = others.iter().find(|c| {
        let clear = c.points.iter().map(|p| (p - center).norm()).fold(f64::INFINITY, f64::min);
        !c.dashed
            && c.layer == gear.layer
            && c.encloses(gear)
            && clear - tip > RIM * (tip - root)
            && Nature::of(c) == Nature::Round
    });
    match rim {
        Some(rim) => {
            Err(InputError::InnerGear { path: source.path(), outside: width(rim) * unit.mm })
        }
        None => Ok(()),
    }
}

/// The holes in a contour: closed contours in it, without reference circles about other holes.
fn with_holes((outer, _): (Contour, Nature), others: Vec<Contour>) -> Chosen {
    let mut others = others;
    others.sort_by(|a, b| b.extent().total_cmp(&a.extent()));
    let inside: Vec<Contour> =
        others.into_iter().filter(|c| outer.encloses(c)).take(LOOKED_AT).collect();
    let holes = inside
        .iter()
        .enumerate()
        .filter(|(i, c)| !inside.iter().enumerate().any(|(j, other)| j != *i && c.encloses(other)))
        .map(|(_, c)| c.clone())
        .collect();
    Chosen { outer, holes }
}
