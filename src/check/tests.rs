use super::teeth::{self, Teeth};
use super::*;
use crate::outline::Outline;
use std::f64::consts::PI;

const MODULE: f64 = 2.0;

/// A gear of so many flat-topped waves along r = a (1 + e cos 2t + e / 2 sin 3t), without those from
/// `first` on; a is such that its pitch is that of [`MODULE`].
fn waves(count: u32, e: f64, first: u32, missing: u32) -> Vec<Point> {
    let curve: Vec<Point> = (0..6000)
        .map(|i| TAU * f64::from(i) / 6000.0)
        .map(|t| (t, 1.0 + e * (2.0 * t).cos() + 0.5 * e * (3.0 * t).sin()))
        .map(|(t, r)| Point::new(r * t.cos(), r * t.sin()))
        .collect();
    let next = |i: usize| curve[(i + 1) % curve.len()];
    let perimeter: f64 = (0..curve.len()).map(|i| (next(i) - curve[i]).norm()).sum();
    let scale = f64::from(count) * PI * MODULE / perimeter;
    let mut along = 0.0;
    (0..curve.len())
        .map(|i| {
            let step = next(i) - curve[i];
            let tooth = f64::from(count) * along / perimeter;
            along += step.norm();
            let bare = tooth > f64::from(first) - 0.5 && tooth < f64::from(first + missing);
            let wave = (1.8 * (TAU * tooth).sin()).clamp(-1.0, 1.0);
            let height = if bare && missing > 0 { -1.0 } else { wave };
            let outward = crate::geometry::Vector::new(step.y, -step.x).normalize();
            curve[i] * scale + outward * (height * MODULE)
        })
        .collect()
}

fn counted(count: u32, e: f64, first: u32, missing: u32) -> Teeth {
    teeth::teeth(&waves(count, e, first, missing), None).expect("teeth")
}

#[test]
fn whole_gears_are_counted_without_doubt() {
    for count in [16, 23, 32, 48, 97] {
        for e in [0.0, 0.05, 0.15] {
            let teeth = counted(count, e, 0, 0);
            assert_eq!((teeth.count, teeth.likely), (count, (count, count)), "{count}, {e}");
            assert!((teeth.pitch / (PI * MODULE) - 1.0).abs() < 0.05, "{}", teeth.pitch);
            assert_eq!(teeth.round, e == 0.0);
        }
    }
}

#[test]
fn missing_teeth_are_made_up_for() {
    for e in [0.0, 0.08] {
        for (first, missing) in [(3, 1), (9, 2), (17, 3), (3, 5), (9, 8), (20, 8), (1, 12)] {
            let mut pair = [counted(40, e, first, missing), counted(40, e, 0, 0)];
            let (least, most) = pair[0].likely;
            assert!(least <= 40 && most >= 40, "{missing} from {first}: {least} to {most}");
            assert!(most - least <= 4);
            teeth::settle(&mut pair);
            assert_eq!([pair[0].count, pair[1].count], [40, 40], "{missing} from {first}, {e}");
        }
    }
}

#[test]
fn a_doubtful_count_settles_for_the_simplest_ratio() {
    let whole = counted(32, 0.1, 0, 0);
    let doubtful = |count, least, most| {
        let mut teeth = whole.clone();
        (teeth.count, teeth.likely) = (count, (least, most));
        teeth
    };
    for (first, second, settled) in [
        (doubtful(31, 30, 32), doubtful(32, 32, 32), [32, 32]),
        (doubtful(24, 24, 24), doubtful(49, 47, 50), [24, 48]),
        (doubtful(31, 31, 31), doubtful(32, 32, 32), [31, 32]),
    ] {
        let mut pair = [first, second];
        teeth::settle(&mut pair);
        assert_eq!([pair[0].count, pair[1].count], settled);
    }
}

#[test]
fn a_given_count_stands() {
    let teeth = teeth::teeth(&waves(30, 0.1, 5, 9), Some(30)).unwrap();
    assert_eq!((teeth.count, teeth.likely), (30, (30, 30)));
}

fn gear(outline: Vec<Point>, holes: &[Point]) -> Toothed {
    let round = |c: &Point| -> Outline {
        let at = |i: i32| TAU * f64::from(i) / 12.0;
        let rim = |i| c + crate::geometry::Vector::new(at(i).cos(), at(i).sin());
        Outline::new((0..12).map(rim).collect()).unwrap()
    };
    Toothed {
        outline: Outline::new(outline).unwrap(),
        holes: holes.iter().map(round).collect(),
        thinned: None,
        record: None,
        notes: Vec::new(),
    }
}

#[test]
fn the_axis_is_the_bore_or_the_origin_or_asked_for() {
    let shift = crate::geometry::Vector::new(7.0, 3.0);
    let outline = || waves(30, 0.1, 0, 0);
    let moved: Vec<Point> = outline().iter().map(|p| p + shift * 20.0).collect();
    let found = |gear: &Toothed| axis::axis(gear, Side::Driver, None);
    let (at, source, _) = found(&gear(outline(), &[Point::from(shift)])).unwrap();
    assert!((at.coords - shift).norm() < 1e-9 && source == AxisSource::Bore);
    // Of several holes the one about the origin.
    let two = gear(outline(), &[Point::new(8.0, 0.0), Point::new(0.2, 0.0)]);
    assert!((found(&two).unwrap().0.x - 0.2).abs() < 1e-9);
    assert_eq!(found(&gear(outline(), &[])), Ok((Point::origin(), AxisSource::Origin, None)));
    let none = found(&gear(moved, &[]));
    assert_eq!(none, Err(CheckError::NoAxis { gear: Side::Driver, holes: 0 }));
    let outside = axis::axis(&two, Side::Follower, Some(Point::new(90.0, 0.0)));
    assert_eq!(outside, Err(CheckError::AxisOutside { gear: Side::Follower, x: 90.0, y: 0.0 }));
}

#[test]
fn a_motion_is_read_with_heading_and_comments_in_any_separator() {
    let text = "\u{feff}driver;follower\n0;0 # start\n\n 1.5;\t0.5\n3 1\n";
    assert_eq!(motion_from_columns(text), Ok((vec![0.0, 1.5, 3.0], vec![0.0, 0.5, 1.0])));
    for (text, line) in [("0,0\n1\n", 2), ("0,0\nx,y\n", 2), ("a,b\nc,d\n", 2), ("0,inf\n", 1)] {
        assert_eq!(motion_from_columns(text), Err(MotionFileError::BadLine { line }), "{text}");
    }
}

#[test]
fn two_records_that_agree_tell_the_distance() {
    let recorded = |path: &str, center_distance| Toothed {
        record: Some(PairRecord {
            path: path.to_owned(),
            center_distance,
            teeth: None,
            driver_angle: Vec::new(),
            follower_angle: Vec::new(),
        }),
        ..gear(waves(24, 0.0, 0, 0), &[])
    };
    let [a, b, c] = [recorded("a", 48.0), recorded("b", 48.0), recorded("c", 50.0)];
    assert_eq!(common_distance(&a, &b), Some(48.0));
    assert_eq!(common_distance(&a, &c), None);
    assert_eq!(common_distance(&a, &gear(waves(24, 0.0, 0, 0), &[])), None);
}

#[test]
fn gears_out_of_reach_or_in_each_other_fail_and_numbers_that_are_none_are_refused() {
    let wave = gear(waves(24, 0.0, 0, 0), &[]);
    let at = |center_distance| {
        check(&wave, &wave, &CheckOptions { center_distance, ..CheckOptions::default() })
    };
    assert_eq!(at(None), Err(CheckError::NoCenterDistance));
    for value in [0.0, -1.0, f64::INFINITY] {
        assert!(matches!(at(Some(value)), Err(CheckError::NotPositive { .. })), "{value}");
    }
    // Two rims at 24 + 2 mm each.
    let figure = |distance, code, name| {
        let report = at(Some(distance)).unwrap();
        report.diagnostics.iter().find(|d| d.code == code).and_then(|d| d.figure(name)).unwrap()
    };
    let gap = figure(55.0, Code::NoContact, "gap");
    assert!((gap - 3.0).abs() < 0.1, "{gap}");
    let depth = figure(20.0, Code::Overlap, "depth");
    assert!(depth > 1.0, "{depth}");
    let disc = gear(waves(24, 0.0, 0, 24), &[]);
    let options = CheckOptions { center_distance: Some(48.0), ..CheckOptions::default() };
    assert_eq!(check(&disc, &wave, &options), Err(CheckError::NoTeeth { gear: Side::Driver }));
}
