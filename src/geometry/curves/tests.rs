use super::*;
use crate::geometry::{Vector, rotate};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A gear-like ring without corners.
fn waves(samples: usize) -> Vec<Point> {
    let at = |i: usize| {
        let angle = TAU * i as f64 / samples as f64;
        rotate(Point::new(40.0 + 2.5 * (16.0 * angle).cos(), 0.0), angle)
    };
    (0..samples).map(at).collect()
}

/// Sixteen teeth with sharp corners, concave roots and straight flanks.
fn sharp_teeth() -> Vec<Point> {
    (0..16)
        .flat_map(|k| {
            let turned = move |p: Point| rotate(p, TAU * f64::from(k) / 16.0);
            let tip = [(22.0, -1.0), (22.3, -0.4), (22.3, 0.4), (22.0, 1.0)];
            let root = (0..=20).map(move |i| {
                let a = FRAC_PI_2 + std::f64::consts::PI * f64::from(i) / 20.0;
                let middle = rotate(Point::new(18.0, 0.0), TAU / 32.0);
                let d = rotate(Point::new(1.2 * a.cos(), -1.2 * a.sin()), TAU / 32.0);
                middle + d.coords
            });
            tip.into_iter()
                .map(|(x, y)| Point::new(x, y))
                .chain(root)
                .map(turned)
                .collect::<Vec<_>>()
        })
        .collect()
}

fn joins(path: &ArcPath) -> impl Iterator<Item = (Arc, Arc)> + '_ {
    path.arcs().iter().copied().zip(path.arcs().iter().copied().cycle().skip(1))
}

fn kink(a: &Arc, b: &Arc) -> f64 {
    let (out, into) = (a.tangents()[1], b.tangents()[0]);
    crate::geometry::cross(out, into).atan2(out.dot(&into)).abs()
}

#[test]
fn a_ring_becomes_few_arcs_without_a_kink() {
    let outline = waves(1600);
    let path = Trace::new(&outline, TraceOptions::default()).unwrap().arcs().unwrap();
    assert!((64..400).contains(&path.arcs().len()), "{} arcs", path.arcs().len());
    for (a, b) in joins(&path) {
        assert_eq!(a.to, b.from);
        assert!(kink(&a, &b) < 1e-4, "{} at {}", kink(&a, &b), a.to);
    }
    // The closed form of the waves' area; two micrometres along 500 mm move it by 1 mm^2 at most.
    let area = std::f64::consts::PI * (40.0_f64.powi(2) + 0.5 * 2.5_f64.powi(2));
    assert!((path.signed_area() - area).abs() < 0.5, "{} {area}", path.signed_area());
    // Against the formula rather than the vertices.
    for p in path.flattened(16) {
        let angle = p.y.atan2(p.x);
        let slope = 40.0 * (16.0 * angle).sin() / 40.0;
        let across = (p.coords.norm() - 40.0 - 2.5 * (16.0 * angle).cos()) / slope.hypot(1.0);
        assert!(across.abs() < 0.0025, "{across}");
    }
}

#[test]
fn corners_stay_exactly_where_they_are() {
    let outline = sharp_teeth();
    let trace = Trace::new(&outline, TraceOptions::default()).unwrap();
    let path = trace.arcs().unwrap();
    let corners: Vec<Point> =
        joins(&path).filter(|(a, b)| kink(a, b) > 0.1).map(|(a, _)| a.to).collect();
    assert!(corners.len() >= 32);
    for c in corners {
        assert!(outline.contains(&c), "{c} is no vertex");
    }
    let [vertices, _] = path.deviation();
    assert!(vertices <= policy::EXPORT_TOLERANCE);
    assert!((trace.signed_area() - path.signed_area()).abs() < 0.2);
}

#[test]
fn a_rounded_slot_is_two_lines_and_arcs() {
    // Ends of radius 2 about (+-5, 0), drawn with 24 chords each.
    let end = |side: f64| {
        (0..=24).map(move |i| {
            let a = -FRAC_PI_2 + std::f64::consts::PI * f64::from(i) / 24.0;
            Point::new(side * (5.0 + 2.0 * a.cos()), side * 2.0 * a.sin())
        })
    };
    let slot: Vec<Point> = end(1.0).chain(end(-1.0)).collect();
    let options = TraceOptions { straight_edges: true, ..TraceOptions::default() };
    let path = Trace::new(&slot, options).unwrap().arcs().unwrap();
    let lines: Vec<_> = path.arcs().iter().filter(|a| a.bulge == 0.0).collect();
    assert_eq!(lines.len(), 2);
    assert!(lines.iter().all(|l| (l.to - l.from).norm() == 10.0));
    let area = 40.0 + std::f64::consts::PI * 4.0;
    assert!((path.signed_area() - area).abs() < 0.03);
}

#[test]
fn a_square_is_four_lines() {
    let square: Vec<Point> =
        [(0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (0.0, 3.0)].map(|(x, y)| Point::new(x, y)).to_vec();
    let trace = Trace::new(&square, TraceOptions::default()).unwrap();
    assert_eq!(trace.stretches().len(), 4);
    assert_eq!(trace.arcs().unwrap(), ArcPath::polygon(&square));
}

#[test]
fn only_regular_polygons_are_round_holes() {
    let (center, radius) = (Vector::new(3.0, 1.0), 2.5);
    let corner = radius / (std::f64::consts::PI / 40.0).cos();
    let mut hole: Vec<Point> = (0..40)
        .map(|i| rotate(Point::new(corner, 0.0), TAU * f64::from(i) / 40.0) + center)
        .collect();
    let (c, r) = round_hole(&hole).unwrap();
    assert!((c.coords - center).norm() < 1e-12 && (r - radius).abs() < 1e-12);
    hole[7] += Vector::new(1e-6, 0.0);
    assert_eq!(round_hole(&hole), None);
    assert_eq!(round_hole(&hole[..8]), None);
}

#[test]
fn bad_input_is_refused() {
    let flat: Vec<Point> = (0..5).map(|i| Point::new(f64::from(i), 0.0)).collect();
    assert_eq!(Trace::new(&flat, TraceOptions::default()).unwrap_err(), TraceError::Empty);
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let options = TraceOptions { tolerance, ..TraceOptions::default() };
        let error = Trace::new(&waves(100), options).unwrap_err();
        assert!(matches!(error, TraceError::Tolerance { .. }));
    }
}

#[test]
fn folds_without_width_are_dropped() {
    let mut outline = waves(800);
    let [p, q] = [outline[100], outline[101]];
    let ahead = q + (q - p).normalize() * 0.008;
    outline.insert(102, ahead);
    outline.insert(103, q + (q - p).normalize() * 0.004);
    let plain = Trace::new(&waves(800), TraceOptions::default()).unwrap().arcs().unwrap();
    let path = Trace::new(&outline, TraceOptions::default()).unwrap().arcs().unwrap();
    assert!(path.arcs().iter().all(|a| (a.from - ahead).norm() > 3e-3));
    assert!((path.signed_area() - plain.signed_area()).abs() < 0.02);
}
