use super::*;
use crate::control::Control;
use crate::gear::EvenMotion;
use crate::geometry::Vector;
use crate::meshing::spur::Spur;
use std::f64::consts::TAU;

/// Points on one flank: 0.05 mm apart at module 2, with chords 2e-5 mm off the involute.
const FLANK: usize = 180;

struct Pair {
    driver: Spur,
    follower: Spur,
    extra_distance: f64,
    present: u32,
}

impl Pair {
    fn new(driver_teeth: u32, follower_teeth: u32) -> Self {
        let spur =
            |teeth| Spur { teeth, module: 2.0, pressure_angle: 20_f64.to_radians(), thinning: 0.0 };
        let (driver, follower) = (spur(driver_teeth), spur(follower_teeth));
        Self { driver, follower, extra_distance: 0.0, present: driver_teeth }
    }

    fn thinned(mut self, thinning: f64) -> Self {
        self.driver.thinning = thinning;
        self.follower.thinning = thinning;
        self
    }

    fn distance(&self) -> f64 {
        self.driver.radius() + self.follower.radius() + self.extra_distance
    }

    fn analyse(&self, options: &ContactOptions) -> ContactAnalysis {
        self.with_input(|input| analyse(input, options)).expect("sound input")
    }

    fn with_input<T>(&self, ask: impl FnOnce(&ContactInput<'_>) -> T) -> T {
        let ratio = f64::from(self.driver.teeth) / f64::from(self.follower.teeth);
        let gap = PI + PI / f64::from(self.follower.teeth);
        ask(&ContactInput {
            driver: &self.driver.outline(0.0, FLANK, self.present),
            follower: &self.follower.outline(gap, FLANK, self.follower.teeth),
            center_distance: self.distance(),
            module: self.driver.module,
            motion: &EvenMotion { speed: ratio, cycle: TAU },
            control: Control::unwatched(),
        })
    }
}

fn quick(contact_distance: f64) -> ContactOptions {
    ContactOptions { poses: 377, contact_distance, ..ContactOptions::default() }
}

#[test]
fn involutes_turn_evenly_and_overlap_as_the_textbook_says() {
    for (z1, z2) in [(30, 30), (24, 47)] {
        let pair = Pair::new(z1, z2);
        let found = pair.analyse(&quick(5e-5)).summary;
        let error = found.transmission_error_pitch.unwrap();
        assert!(error.median.abs() < 2e-5 && error.peak_to_peak < 5e-5, "{error:?}");
        let approach = |g: &Spur| (g.tip().powi(2) - g.base().powi(2)).sqrt();
        let pressure_angle = pair.driver.pressure_angle;
        let path = approach(&pair.driver) + approach(&pair.follower)
            - pair.distance() * pressure_angle.sin();
        let ratio = path / (PI * pair.driver.module * pressure_angle.cos());
        assert!(
            (found.contact_ratio / ratio - 1.0).abs() < 0.02,
            "{} {ratio}",
            found.contact_ratio
        );
        assert_eq!(found.lost, []);
        let worst = found.max_pressure_angle.unwrap().value;
        assert!((worst - pressure_angle).abs() < 0.01, "{worst}");
    }
}

#[test]
fn contacts_lie_on_the_line_of_action() {
    let pair = Pair::new(30, 40).thinned(0.05);
    let (sin, cos) = pair.driver.pressure_angle.sin_cos();
    let found = pair.analyse(&quick(5e-5));
    for pose in &found.poses {
        let contact = pose.contacts[0];
        let from_pitch_point = contact.point - Point::new(pair.driver.radius(), 0.0);
        // A driver turning counter-clockwise pushes upwards, and away from itself.
        let push = Vector::new(sin, cos);
        assert!(contact.normal.dot(&push) > 0.9999, "{contact:?}");
        // Within the distance of two points on a flank.
        assert!(cross(from_pitch_point, push).abs() < 0.06, "{contact:?}");
    }
}

#[test]
fn thinned_flanks_open_the_backlash_they_should() {
    let thinning = 0.06;
    let pair = Pair::new(30, 40).thinned(thinning);
    let found = pair.analyse(&quick(2e-3));
    let each = thinning / pair.follower.radius();
    for pose in &found.poses {
        assert!((pose.play_behind - each).abs() < 5e-6, "{} {each}", pose.play_behind);
        assert!((pose.play_ahead - each).abs() < 5e-6, "{} {each}", pose.play_ahead);
        assert_eq!(pose.interference, 0.0);
    }
    let error = found.summary.transmission_error.unwrap();
    assert!((error.median + each).abs() < 5e-6 && error.peak_to_peak < 5e-6, "{error:?}");
}

#[test]
fn a_wider_centre_distance_opens_the_backlash_it_should() {
    let mut pair = Pair::new(30, 40);
    pair.extra_distance = 0.3;
    let standard = pair.driver.pressure_angle;
    let working = (standard.cos() * (pair.distance() - 0.3) / pair.distance()).acos();
    let involute = |angle: f64| angle.tan() - angle;
    let arc = 2.0 * pair.distance() * (involute(working) - involute(standard));
    let radius = pair.distance() * 40.0 / 70.0;
    let found = pair.analyse(&quick(5e-5)).summary;
    for backlash in [found.min_backlash, found.max_backlash] {
        let backlash = backlash.unwrap().value;
        assert!((backlash * radius / arc - 1.0).abs() < 1e-3, "{backlash}");
    }
    let pressure = found.max_pressure_angle.unwrap().value;
    assert!((pressure - working).abs() < 0.01, "{pressure} {working}");
}

#[test]
fn thick_flanks_interfere_by_the_depth_they_should() {
    let excess = 0.04;
    let pair = Pair::new(30, 40).thinned(-excess);
    let found = pair.analyse(&quick(2e-3));
    let each = excess / pair.follower.radius();
    // Each flank is thick by half the excess on either gear, measured along the pitch circle.
    let depth = excess * pair.driver.pressure_angle.cos();
    for pose in &found.poses {
        assert!((pose.play_behind + each).abs() < 5e-6, "{} {each}", pose.play_behind);
        assert!((pose.play_ahead + each).abs() < 5e-6, "{} {each}", pose.play_ahead);
        assert!((pose.interference - depth).abs() < 0.01 * depth, "{}", pose.interference);
    }
    assert!((found.summary.max_interference.unwrap().value - depth).abs() < 0.01 * depth);
}

#[test]
fn one_flank_may_interfere_while_the_other_is_free() {
    // The driver is 0.002 rad too far on: it pushes in on one side and leaves room on the other.
    let pair = Pair::new(30, 40).thinned(0.02);
    let input = pair.analyse(&quick(2e-3));
    let each = 0.02 / pair.follower.radius();
    let driver = pair.driver.outline(0.002, FLANK, 30);
    let follower = pair.follower.outline(PI + PI / 40.0, FLANK, 40);
    let shifted = analyse(
        &ContactInput {
            driver: &driver,
            follower: &follower,
            center_distance: pair.distance(),
            module: 2.0,
            motion: &EvenMotion { speed: 0.75, cycle: TAU },
            control: Control::unwatched(),
        },
        &quick(2e-3),
    )
    .unwrap();
    for (pose, free) in shifted.poses.iter().zip(&input.poses) {
        assert!((pose.play_behind - (each - 0.0015)).abs() < 5e-6, "{}", pose.play_behind);
        assert!(pose.interference > 0.0 && free.interference == 0.0);
    }
    // Where tips come upon tips the other side is less free; elsewhere it is as open as it should.
    let opened = shifted.poses.iter().filter(|p| (p.play_ahead - (each + 0.0015)).abs() < 5e-6);
    assert!(opened.count() * 20 > 19 * shifted.poses.len());
}

#[test]
fn missing_teeth_lose_contact_where_they_are_missing() {
    let mut pair = Pair::new(30, 30);
    pair.present = 27;
    // Without room to lag, a pair of flanks ends where its path of contact ends: four pitches
    // lie between the teeth that are left, and the contact of one pair spans 1.66 of them.
    let strict = ContactOptions { search_pitch: 1e-4, poses: 2000, ..quick(5e-5) };
    let found = pair.analyse(&strict).summary;
    assert_eq!(found.lost.len(), 1, "{:?}", found.lost);
    let (arc, pitch) = (found.lost[0], TAU / 30.0);
    assert!((found.lost_angle / pitch - (4.0 - 1.66)).abs() < 0.05, "{found:?}");
    // The missing teeth pass the line of centres at 1, 2 and 3 pitches, their driving flanks a
    // quarter of a pitch before them.
    assert!((0.5 * (arc.from + arc.to) / pitch - 1.75).abs() < 0.05, "{arc:?}");
    // Allowed to lag by half a pitch, the last tooth's tip holds on and the gap shrinks.
    let found = pair.analyse(&quick(2e-3)).summary;
    assert_eq!(found.lost.len(), 1, "{:?}", found.lost);
    assert!(found.lost_angle > 0.1 * pitch && found.lost_angle < 2.0 * pitch, "{found:?}");
    assert!(found.transmission_error_pitch.unwrap().peak_to_peak > 0.3);
}

#[test]
fn gears_pulled_apart_have_no_contact_at_all() {
    let mut pair = Pair::new(30, 40);
    pair.extra_distance = 4.5;
    let found = pair.analyse(&quick(2e-3));
    assert!(found.poses.iter().all(|p| p.lost && p.lost_reversed && p.interference == 0.0));
    let summary = &found.summary;
    assert_eq!(summary.lost, [super::super::LostArc { from: 0.0, to: TAU }]);
    assert_eq!((summary.contact_ratio, summary.transmission_error), (0.0, None));
}

#[test]
fn gears_pushed_together_are_seen_to_overlap_deeply() {
    let mut pair = Pair::new(30, 40);
    pair.extra_distance = -12.0;
    let found = pair.analyse(&quick(2e-3));
    for pose in &found.poses {
        assert!(pose.interference > 1.0 && pose.play_behind < 0.0 && pose.play_ahead < 0.0);
    }
}

#[test]
fn bad_input_is_refused() {
    let pair = Pair::new(30, 30);
    let good = pair.driver.outline(0.0, FLANK, 30);
    let mut broken = good.clone();
    broken[7].y = f64::NAN;
    let run = |driver: &[Point], module: f64, ratio: f64| {
        analyse(
            &ContactInput {
                driver,
                follower: &good,
                center_distance: 60.0,
                module,
                motion: &EvenMotion { speed: ratio, cycle: TAU },
                control: Control::unwatched(),
            },
            &quick(2e-3),
        )
        .map(|_| ())
    };
    assert_eq!(
        run(&good[..2], 2.0, 1.0),
        Err(ContactError::TooFewPoints { gear: Side::Driver, count: 2 })
    );
    assert_eq!(
        run(&broken, 2.0, 1.0),
        Err(ContactError::NotFinite { gear: Side::Driver, index: 7 })
    );
    assert!(matches!(run(&good, 0.0, 1.0), Err(ContactError::NotPositive { .. })));
    assert!(matches!(run(&good, 2.0, -1.0), Err(ContactError::BadMotion { .. })));
}

#[test]
fn a_refined_analysis_is_that_of_all_poses_at_once() {
    let pair = Pair::new(12, 17).thinned(0.05);
    let options = |poses| ContactOptions { poses, ..ContactOptions::default() };
    let few = pair.analyse(&options(40));
    let refined = pair.with_input(|input| few.clone().refined(input, &options(101))).unwrap();
    assert_eq!(refined, pair.analyse(&options(101)));
    assert_ne!(refined, few);
}
