//! Teeth counted on an outline of which nothing else is known.

use crate::geometry::gcd;
use crate::geometry::{Point, Vector, cross};
use crate::policy;
use realfft::RealFftPlanner;
use realfft::num_complex::Complex;
use std::f64::consts::TAU;

/// What an outline tells of its teeth. The axis is the origin.
#[derive(Clone, Debug)]
pub(super) struct Teeth {
    pub(super) count: u32,
    /// Fewest and most teeth that the outline may have had: `count`, unless a long stretch has none.
    pub(super) likely: (u32, u32),
    /// Distance of neighbouring teeth along the middle line, mm.
    pub(super) pitch: f64,
    /// Whether the middle line is a circle about the axis.
    pub(super) round: bool,
    /// Radius of the middle line at even angles from 0, mm.
    radius: Vec<f64>,
}

impl Teeth {
    /// Radius of the middle line in a direction of the gear's own frame (radians), mm.
    pub(super) fn radius(&self, direction: f64) -> f64 {
        let n = self.radius.len();
        let at = (direction / TAU).rem_euclid(1.0) * n as f64;
        let i = at as usize;
        let t = at - i as f64;
        self.radius[i % n] * (1.0 - t) + self.radius[(i + 1) % n] * t
    }
}

/// Counts the teeth of an outline; with a `given` count only their pitch is measured. `None` when
/// there are no regular teeth.
///
/// The direction of the boundary, seen along its length, swings with the teeth: the strongest
/// frequency gives their scale, a blur of that scale the middle line, and the crossings of the middle
/// line the teeth. Teeth that are missing or merged are made up for by their spacing: where there
/// are none the middle line runs along the roots, and is measured where it would run with teeth.
pub(super) fn teeth(outline: &[Point], given: Option<u32>) -> Option<Teeth> {
    let points = evenly(outline);
    let few = given.is_some_and(|n| (n as usize) < policy::COUNT_RANGE.0);
    if few { lobes(&points, given) } else { many(&points, given).or_else(|| lobes(&points, given)) }
}

/// Share of the mean radius by which lobes rise and sink, at least.
const LOBE_HEIGHT: f64 = 0.03;
/// Stray of the distances of lobes, and of their heights, as shares of a lobe.
const LOBES_ALIKE: f64 = 0.08;

/// Few lobes about the axis, as on rotors: counted by the radius. One lobe is believed only where it was said.
fn lobes(points: &[Point], given: Option<u32>) -> Option<Teeth> {
    let n = points.len();
    let radii: Vec<f64> = points.iter().map(|p| p.coords.norm()).collect();
    let (low, high) =
        radii.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), r| (l.min(*r), h.max(*r)));
    let middle = 0.5 * (low + high);
    let least = 0.25 * (high - low);
    if (high - low) < LOBE_HEIGHT * middle {
        return None;
    }
    let start = radii.iter().position(|r| *r < middle - least)?;
    let (mut up, mut places, mut tops) = (false, Vec::new(), Vec::new());
    for i in start..start + n {
        let radius = radii[i % n];
        if !up && radius > middle + least {
            up = true;
            let p = points[i % n];
            places.push(p.y.atan2(p.x));
            tops.push(radius);
        } else if up && radius < middle - least {
            up = false;
        }
        if up && let Some(top) = tops.last_mut() {
            *top = radius.max(*top);
        }
    }
    places.sort_by(f64::total_cmp);
    let count = places.len();
    let even = TAU / count.max(1) as f64;
    let alike = spacings(&places, TAU).iter().all(|s| (s - even).abs() <= LOBES_ALIKE * even)
        && tops.iter().all(|t| (high - t) <= LOBES_ALIKE * (high - low));
    let believed = given.map_or(count >= 2, |g| g as usize == count);
    if !(believed && alike) {
        return None;
    }
    let count = u32::try_from(count).ok()?;
    Some(Teeth {
        count,
        likely: (count, count),
        pitch: middle * even,
        round: true,
        radius: vec![middle; policy::RADIUS_SAMPLES],
    })
}

/// Regular teeth, as many as [`policy::COUNT_RANGE`] has.
fn many(points: &[Point], given: Option<u32>) -> Option<Teeth> {
    let points = points.to_vec();
    let mut scale = given.map_or_else(|| strongest_frequency(&points), |n| n as usize);
    let mut best = None;
    for _ in 0..4 {
        let middle = blurred(&points, policy::COUNT_BLUR * points.len() as f64 / scale as f64);
        let rises = rises(&points, &middle);
        let found = rises.len();
        if found < policy::COUNT_RANGE.0 {
            break;
        }
        best = Some((middle, rises));
        if given.is_some() || found.abs_diff(scale) * 10 <= scale {
            break;
        }
        scale = found.min(policy::COUNT_RANGE.1);
    }
    let (middle, rises) = best?;
    let radii: Vec<f64> = middle.iter().map(|p| p.coords.norm()).collect();
    let typical = median(radii.clone())?;
    let stray = median(radii.iter().map(|r| (r - typical).abs()).collect())?;
    let round = stray <= policy::ROUND_STRAY * typical;
    let length = lengths(&middle);
    let total = *length.last()?;
    let at = |s: f64| {
        let i = (s as usize).min(length.len() - 2);
        length[i] + (s - i as f64) * (length[i + 1] - length[i])
    };
    let along: Vec<f64> = rises.iter().map(|&s| at(s)).collect();
    let spacing = raised(spacings(&along, total), &points, &middle, &rises)?;
    let (counted, doubt, pitch) = walked(&spacing)?;
    let radius = radius_table(&middle);
    let whole = |count| Teeth { count, likely: (count, count), pitch, round, radius };
    if let Some(count) = given.or_else(|| by_angle(&middle, &rises).filter(|_| round)) {
        return Some(whole(count));
    }
    let (least, most) = policy::TEETH_BELIEVED;
    let bounded = |count: f64| (count.round() as u32).clamp(least, most);
    let likely = (bounded(counted - doubt), bounded(counted + doubt));
    Some(Teeth { likely, ..whole(bounded(counted)) })
}

/// Settles counts that a toothless stretch leaves in doubt: both gears come round after few turns,
/// so of the counts that are likely those with the simplest ratio hold, and of these the nearest.
pub(super) fn settle(teeth: &mut [Teeth; 2]) {
    let [first, second] = [&teeth[0], &teeth[1]];
    let turns = |a: u32, b: u32| (a + b) / gcd(a, b).max(1);
    let off = |a: u32, b: u32| a.abs_diff(first.count) + b.abs_diff(second.count);
    let pairs = (first.likely.0..=first.likely.1)
        .flat_map(|a| (second.likely.0..=second.likely.1).map(move |b| (a, b)));
    if let Some((a, b)) = pairs.min_by_key(|&(a, b)| (turns(a, b), off(a, b))) {
        teeth[0].count = a;
        teeth[1].count = b;
    }
}

/// Points at even distances along the boundary.
fn evenly(outline: &[Point]) -> Vec<Point> {
    let n = policy::COUNT_SAMPLES;
    let length = lengths(outline);
    let total = length[length.len() - 1];
    let mut i = 0;
    (0..n)
        .map(|k| {
            let s = total * k as f64 / n as f64;
            while i + 2 < length.len() && length[i + 1] <= s {
                i += 1;
            }
            let (a, b) = (outline[i], outline[(i + 1) % outline.len()]);
            let step = length[i + 1] - length[i];
            a + (b - a) * if step > 0.0 { ((s - length[i]) / step).clamp(0.0, 1.0) } else { 0.0 }
        })
        .collect()
}

/// Length of a closed polygon's boundary up to each point, and all of it.
fn lengths(points: &[Point]) -> Vec<f64> {
    let mut sum = 0.0;
    let mut lengths = vec![0.0];
    for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
        sum += (b - a).norm();
        lengths.push(sum);
    }
    lengths
}

/// Cycles in one round of the boundary's direction less its even turn. Weighted by the root of the
/// frequency, so that a drawing's own lobes do not win.
fn strongest_frequency(points: &[Point]) -> usize {
    let n = points.len();
    let step = |i: usize| points[(i + 1) % n] - points[i];
    let mut direction = step(0).y.atan2(step(0).x);
    let mut swing: Vec<f64> = Vec::with_capacity(n);
    for i in 0..n {
        swing.push(direction - TAU * i as f64 / n as f64);
        let (a, b) = (step(i), step((i + 1) % n));
        direction += cross(a, b).atan2(a.dot(&b));
    }
    let spectrum = spectrum(&mut swing);
    let (least, most) = policy::COUNT_RANGE;
    let strength = |k: usize| (k as f64).sqrt() * spectrum[k].norm();
    (least..=most).max_by(|&a, &b| strength(a).total_cmp(&strength(b))).unwrap_or(least)
}

fn spectrum(values: &mut [f64]) -> Vec<Complex<f64>> {
    let transform = RealFftPlanner::<f64>::new().plan_fft_forward(values.len());
    let mut spectrum = transform.make_output_vec();
    // The lengths fit by construction, which is all that can fail.
    let _ = transform.process(values, &mut spectrum);
    spectrum
}

/// The closed polygon blurred by a Gaussian of `width` points.
fn blurred(points: &[Point], width: f64) -> Vec<Point> {
    let n = points.len();
    let coordinate = |pick: fn(&Point) -> f64| {
        let mut values: Vec<f64> = points.iter().map(pick).collect();
        let mut spectrum = spectrum(&mut values);
        for (k, value) in spectrum.iter_mut().enumerate() {
            let angle = TAU * k as f64 * width / n as f64;
            *value *= (-0.5 * angle * angle).exp() / n as f64;
        }
        let inverse = RealFftPlanner::<f64>::new().plan_fft_inverse(n);
        let _ = inverse.process(&mut spectrum, &mut values);
        values
    };
    let (x, y) = (coordinate(|p| p.x), coordinate(|p| p.y));
    x.into_iter().zip(y).map(|(x, y)| Point::new(x, y)).collect()
}

/// Height of the boundary above its middle line, mm.
fn heights(points: &[Point], middle: &[Point]) -> Vec<f64> {
    let n = points.len();
    (0..n)
        .map(|i| {
            let along = middle[(i + 1) % n] - middle[(i + n - 1) % n];
            let outward = Vector::new(along.y, -along.x).try_normalize(0.0);
            (points[i] - middle[i]).dot(&outward.unwrap_or_else(Vector::zeros))
        })
        .collect()
}

/// Places (fractional indices) where the boundary rises through its middle line.
fn rises(points: &[Point], middle: &[Point]) -> Vec<f64> {
    let n = points.len();
    let height = heights(points, middle);
    let mean = height.iter().map(|h| h.abs()).sum::<f64>() / n as f64;
    let least = policy::COUNT_HYSTERESIS * mean;
    let Some(start) = height.iter().position(|h| *h < -least) else { return Vec::new() };
    let mut up = false;
    let mut crossing = None;
    let mut rises = Vec::new();
    for i in start..start + n {
        let (here, next) = (height[i % n], height[(i + 1) % n]);
        if here < 0.0 && next >= 0.0 {
            crossing = Some((i as f64 + here / (here - next)) % n as f64);
        }
        if !up && next > least {
            up = true;
            rises.extend(crossing.take());
        } else if up && next < -least {
            up = false;
        }
    }
    rises.sort_by(f64::total_cmp);
    rises
}

/// Spacings with those of toothless stretches measured as far above the roots as elsewhere: the
/// lengths of parallel curves differ by their distance times the turn.
fn raised(
    mut spacing: Vec<f64>,
    points: &[Point],
    middle: &[Point],
    rises: &[f64],
) -> Option<Vec<f64>> {
    let n = points.len();
    let typical = median(spacing.clone())?;
    if spacing.iter().all(|s| *s < policy::TOOTHLESS_FROM * typical) {
        return Some(spacing);
    }
    let height = heights(points, middle);
    let between = |i: usize| {
        let (from, to) = (rises[i] as usize, rises[(i + 1) % rises.len()] as usize);
        from..if to > from { to } else { to + n }
    };
    let depth = |i: usize| between(i).map(|j| -height[j % n]).fold(0.0, f64::max);
    let toothed = (0..spacing.len()).filter(|&i| spacing[i] < policy::TOOTHLESS_FROM * typical);
    let depth = median(toothed.map(depth).collect())?;
    let step = |j: usize| middle[(j + 1) % n] - middle[j % n];
    for (i, space) in spacing.iter_mut().enumerate() {
        if *space >= policy::TOOTHLESS_FROM * typical {
            let turn: f64 = between(i)
                .map(|j| (step(j), step(j + 1)))
                .map(|(a, b)| cross(a, b).atan2(a.dot(&b)))
                .sum();
            *space += depth * turn;
        }
    }
    Some(spacing)
}

/// Distances from each place to the next on a closed line of length `total`.
fn spacings(places: &[f64], total: f64) -> Vec<f64> {
    let wrapped = places.first().map(|first| first + total);
    let next = places.iter().copied().skip(1).chain(wrapped);
    places.iter().zip(next).map(|(a, b)| b - a).collect()
}

/// Teeth on a line whose distances are multiples of a pitch that changes slowly, by how many the
/// count may be wrong, and that pitch.
fn walked(spacing: &[f64]) -> Option<(f64, f64, f64)> {
    let n = spacing.len();
    let reach = 5.min(n / 2);
    let (mut count, mut doubt) = (0.0, 0.0_f64);
    let mut carried = 0.0;
    let mut single = Vec::new();
    for i in 0..n {
        let around = (i + n - reach..=i + n + reach).map(|j| spacing[j % n]).collect();
        let pitch = median(around)?;
        let pitches = (spacing[i] + carried) / pitch;
        let teeth = pitches.round();
        if teeth == 0.0 {
            carried += spacing[i];
            continue;
        }
        if teeth == 1.0 && carried == 0.0 {
            single.push(spacing[i]);
        }
        carried = 0.0;
        count += teeth;
        if teeth >= policy::TOOTHLESS_FROM {
            doubt += (policy::TOOTHLESS_DOUBT * pitches).ceil();
        }
    }
    let pitch = if single.is_empty() { median(spacing.to_vec())? } else { mean(&single) };
    Some((count, doubt, pitch))
}

/// Teeth of a round gear by the angle between neighbours.
fn by_angle(middle: &[Point], rises: &[f64]) -> Option<u32> {
    let n = middle.len();
    let mut angles: Vec<f64> = rises
        .iter()
        .map(|&s| {
            let i = s as usize % n;
            let p = middle[i] + (middle[(i + 1) % n] - middle[i]) * s.fract();
            p.y.atan2(p.x)
        })
        .collect();
    angles.sort_by(f64::total_cmp);
    let typical = median(spacings(&angles, TAU))?;
    let near = |a: &f64| (a - typical).abs() < 0.1 * typical;
    let single: Vec<f64> = spacings(&angles, TAU).into_iter().filter(near).collect();
    let (least, most) = policy::TEETH_BELIEVED;
    let count = (TAU / mean(&single)).round();
    (f64::from(least)..=f64::from(most)).contains(&count).then_some(count as u32)
}

fn radius_table(middle: &[Point]) -> Vec<f64> {
    let n = policy::RADIUS_SAMPLES;
    let mut table = vec![f64::NAN; n];
    for p in middle {
        let bin = ((p.y.atan2(p.x) / TAU).rem_euclid(1.0) * n as f64) as usize % n;
        table[bin] = table[bin].max(p.coords.norm());
    }
    // A direction without a point takes the last one's.
    let mut last = table.iter().rev().copied().find(|r| r.is_finite()).unwrap_or(1.0);
    for radius in &mut table {
        if radius.is_finite() {
            last = *radius;
        } else {
            *radius = last;
        }
    }
    table
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

pub(super) fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}
