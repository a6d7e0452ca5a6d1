//! Closed forms and laws that the teeth must keep.

use super::*;
use crate::control::Control;
use crate::gear::Motion;
use crate::geometry::{self, Point, rotate};
use crate::meshing::{ContactAnalysis, ContactInput, ContactOptions, analyse};
use crate::pitch::Transmission;
use crate::solid::{carve_follower_with_manifold, circle};
use std::f64::consts::{PI, TAU};

fn centrodes(law: impl Fn(f64) -> f64, follower_fold: u32) -> Centrodes {
    let samples: Vec<f64> = (0..512).map(|i| law(TAU * f64::from(i) / 512.0)).collect();
    let transmission = Transmission::from_derivative(&samples, 1, follower_fold).unwrap();
    Centrodes { transmission, center_distance: 80.0 }
}

/// psi' of an ellipse of eccentricity `e` about its focus against itself (L = 2a).
fn ellipse(e: f64) -> impl Fn(f64) -> f64 {
    move |phi| (1.0 - e * e) / (1.0 + e * e - 2.0 * e * phi.cos())
}

fn contact(centrodes: &Centrodes, pair: &ToothedPair, clearance: f64) -> ContactAnalysis {
    let [driver, follower] = [&pair.driver, &pair.follower].map(|p| p.inset(clearance).unwrap());
    let input = ContactInput {
        driver: &driver.points,
        follower: &follower.points,
        center_distance: centrodes.center_distance,
        module: pair.module,
        motion: &centrodes.transmission,
        control: Control::unwatched(),
    };
    analyse(&input, &ContactOptions { poses: 300, ..ContactOptions::default() }).unwrap()
}

fn options(teeth: u32) -> TeethOptions {
    TeethOptions { driver_teeth: teeth, ..TeethOptions::default() }
}

/// Polar angle of the flank of a standard involute tooth, from the middle of the tooth.
fn involute_half_angle(radius: f64, pitch_radius: f64, teeth: u32, alpha: f64) -> f64 {
    let involute = |a: f64| a.tan() - a;
    let at = (pitch_radius * alpha.cos() / radius).acos();
    0.5 * PI / f64::from(teeth) + involute(alpha) - involute(at)
}

#[test]
fn a_circle_pair_has_standard_involute_flanks() {
    let centrodes = centrodes(|_| 1.0, 1);
    let pair = involute_pair(&centrodes, &options(32)).unwrap();
    assert!((pair.module - 2.5).abs() < 1e-9);
    for (gear, middle) in [(&pair.driver, 0.0), (&pair.follower, PI + PI / 32.0)] {
        let mut seen = 0;
        for (p, kind) in gear.points.iter().zip(&gear.kinds) {
            let radius = p.coords.norm();
            assert!(radius < 42.5 + 1e-9, "nothing stands above the addendum circle");
            // Edges are labelled by their first point; the last point of a flank starts a tip or a root.
            if *kind != EdgeKind::Flank || radius > 42.5 - 1e-9 {
                continue;
            }
            let step = TAU / 32.0;
            let turned = p.y.atan2(p.x) - middle;
            let from_middle = (turned - (turned / step).round() * step).abs();
            let expected = involute_half_angle(radius, 40.0, 32, 20_f64.to_radians());
            assert!(
                (from_middle - expected).abs() * radius < 1e-6 * pair.module,
                "flank at radius {radius} off by {} mm",
                (from_middle - expected) * radius
            );
            seen += 1;
        }
        assert!(seen > 32 * 2 * 6, "{seen} flank points");
    }
}

#[test]
fn fine_chords_leave_no_transmission_error_on_circles_and_ellipses() {
    for (law, teeth) in [(0.0, 32), (0.3, 31)] {
        let centrodes = centrodes(ellipse(law), 1);
        let fine = TeethOptions { chord_tolerance: 4e-6, ..options(teeth) };
        let pair = involute_pair(&centrodes, &fine).unwrap();
        let summary = contact(&centrodes, &pair, 0.0).summary;
        let error = summary.transmission_error.unwrap();
        assert!(
            error.p99_deviation.to_degrees() < 1e-4,
            "e = {law}: {} degrees",
            error.p99_deviation.to_degrees()
        );
        assert_eq!(summary.lost_poses, 0);
    }
}

#[test]
fn an_ellipse_about_its_focus_meshes_with_its_own_copy() {
    let centrodes = centrodes(ellipse(0.4), 1);
    let pair = involute_pair(&centrodes, &options(33)).unwrap();
    assert_eq!(pair.uncovered, [0.0; 2]);
    let areas = [&pair.driver, &pair.follower].map(|g| geometry::area(&g.points));
    assert!((areas[0] / areas[1] - 1.0).abs() < 1e-4);
    let analysis = contact(&centrodes, &pair, 0.1);
    assert_eq!(analysis.summary.lost_poses, 0);
    assert!(analysis.summary.max_interference.is_none());
    assert!(analysis.summary.contact_ratio > 1.4);
}

#[test]
fn fast_bends_are_shortened_and_still_hand_motion_on() {
    let centrodes = centrodes(|phi| 1.0 + 0.4 * (4.0 * phi).cos(), 1);
    let pair = involute_pair(&centrodes, &options(48)).unwrap();
    let summary = contact(&centrodes, &pair, 0.0).summary;
    assert_eq!((summary.lost_poses, summary.lost_poses_reversed), (0, 0));
    let error = summary.transmission_error_pitch.unwrap();
    assert!(error.median_deviation < 0.002 && error.p99_deviation < 0.02, "{error:?}");
}

#[test]
fn ratio_two_gives_twice_the_teeth_and_exact_symmetry() {
    let centrodes = centrodes(|phi| 0.5 + 0.15 * phi.cos(), 2);
    let pair = involute_pair(&centrodes, &options(24)).unwrap();
    let half = pair.follower.points.len() / 2;
    assert_eq!(pair.follower.points.len(), 2 * half);
    for i in 0..half {
        let turned = rotate(pair.follower.points[i], PI);
        assert!((turned - pair.follower.points[i + half]).norm() < 1e-9);
    }
    assert_eq!(contact(&centrodes, &pair, 0.0).summary.lost_poses, 0);
}

#[test]
fn the_starting_pose_is_symmetric_about_the_line_of_centres() {
    let centrodes = centrodes(ellipse(0.3), 1);
    let pair = involute_pair(&centrodes, &options(24)).unwrap();
    for gear in [&pair.driver, &pair.follower] {
        for p in gear.points.iter().filter(|p| p.coords.norm() > 1.0) {
            let mirrored = Point::new(p.x, -p.y);
            let nearest =
                gear.points.iter().map(|q| (q - mirrored).norm()).fold(f64::MAX, f64::min);
            assert!(nearest < 0.05 * pair.module, "{p} has no mirror image: {nearest}");
        }
    }
}

#[test]
fn backlash_thins_flanks_and_clearance_moves_every_face() {
    let centrodes = centrodes(|_| 1.0, 1);
    let plain = involute_pair(&centrodes, &options(32)).unwrap();
    let loose = involute_pair(&centrodes, &TeethOptions { backlash: 0.2, ..options(32) }).unwrap();
    let play = |pair: &ToothedPair, clearance: f64| {
        contact(&centrodes, pair, clearance).summary.min_backlash.unwrap().value * 40.0
    };
    let zero = play(&plain, 0.0);
    assert!((play(&loose, 0.0) - zero - 0.2).abs() < 2e-3, "{}", play(&loose, 0.0));
    // Two faces a side, each moved by 0.1 along its normal, on both flanks.
    let expected = 0.4 / 20_f64.to_radians().cos();
    assert!((play(&plain, 0.1) - zero - expected).abs() < 2e-3, "{}", play(&plain, 0.1));
    let tip = |p: &ToothedPair| p.driver.points.iter().map(|q| q.coords.norm()).fold(0.0, f64::max);
    assert!((tip(&plain) - tip(&loose)).abs() < 1e-9, "backlash leaves the tips alone");
}

/// A law with curvature and slope: fast bends that lean up to 45 degrees.
fn sloping() -> Centrodes {
    centrodes(|phi| 1.0 + 0.5 * (2.0 * phi).cos() + 0.1 * (5.0 * phi).sin(), 1)
}

#[test]
fn clearance_keeps_the_action_in_the_motion_of_the_loaded_pair() {
    for centrodes in [centrodes(ellipse(0.3), 1), sloping()] {
        let t = &centrodes.transmission;
        let options = TeethOptions { clearance: 0.1, chord_tolerance: 2e-5, ..options(48) };
        let pair = involute_pair(&centrodes, &options).unwrap();
        let [behind, ahead] = pair.loaded.as_ref().unwrap();
        let analysis = contact(&centrodes, &pair, 0.0);
        assert!(analysis.summary.max_interference.is_none());
        for pose in &analysis.poses {
            let phi = pose.driver_angle;
            let (back, front) = (t.psi(phi) - behind.psi(phi), ahead.psi(phi) - t.psi(phi));
            // Nothing touches before the flanks do, and they open by both gears' clearance at least where
            // they work at 60 degrees or less.
            for (play, lag) in [(pose.play_behind, back), (pose.play_ahead, front)] {
                assert!(play > lag - 2e-3 * pose.pitch_angle, "{phi}: {play} {lag}");
                assert!(lag * pose.follower_radius > 0.2 - 1e-9, "{phi}: {lag}");
            }
        }
        let error = analysis.against(&|phi| behind.psi(phi) - t.psi(phi)).summary;
        let error = error.transmission_error_pitch.unwrap();
        assert!(error.median.abs() < 2e-4, "{error:?}");
        assert!(error.median_deviation < 2e-4, "{error:?}");
    }
}

#[test]
fn the_loaded_motions_are_periodic_and_change_slowly() {
    let centrodes = sloping();
    let t = &centrodes.transmission;
    let pair = involute_pair(&centrodes, &TeethOptions { clearance: 0.2, ..options(40) }).unwrap();
    for motion in pair.loaded.unwrap() {
        assert!((motion.psi(1.0 + TAU) - motion.psi(1.0) - TAU).abs() < 1e-9);
        for i in 0..500 {
            let phi = TAU * f64::from(i) / 500.0;
            let share = motion.derivative(phi) / t.derivative(phi);
            assert!((share - 1.0).abs() < 0.031, "{phi}: {share}");
        }
    }
}

#[test]
fn flanks_are_flatter_where_the_pitch_curve_slopes_against_them() {
    let pair = involute_pair(&sloping(), &options(48)).unwrap();
    let angles = || pair.records.iter().flat_map(|r| r.pressure_angles);
    let flattest = angles().fold(f64::MAX, f64::min).to_degrees();
    let asked = 20.0;
    assert!(flattest > 7.9 && flattest < asked - 2.0, "{flattest}");
}

#[test]
fn the_sweep_agrees_with_carving_by_solids() {
    let centrodes = centrodes(|phi| 1.0 + 0.25 * (2.0 * phi).cos(), 1);
    let pair = wave_pair(&centrodes, &options(10)).unwrap();
    let blank = circle(60.0, 0.01);
    let swept = carved_follower(&centrodes, &pair.driver.points, &blank, 10).unwrap();
    let poses: Vec<(f64, f64)> = (0..1024)
        .map(|i| TAU * f64::from(i) / 1024.0)
        .map(|phi| (phi, centrodes.transmission.psi(phi)))
        .collect();
    let literal =
        carve_follower_with_manifold(&pair.driver.points, &blank, 80.0, &poses, 5.0).unwrap();
    let ratio = geometry::area(&swept) / literal.area;
    assert!((ratio - 1.0).abs() < 1e-4, "areas differ by {:.2e}", ratio - 1.0);
}

#[test]
fn impossible_teeth_are_refused() {
    let centrodes = centrodes(|_| 1.0, 1);
    assert!(matches!(
        involute_pair(&centrodes, &options(0)),
        Err(TeethError::Indivisible { teeth: 0, folds: 1 })
    ));
    let pair = involute_pair(&centrodes, &options(32)).unwrap();
    assert!(pair.driver.inset(100.0).is_none());
}
