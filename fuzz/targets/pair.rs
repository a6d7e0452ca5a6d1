//! Two polygons to a pair of gears, its solids and its record.
#![no_main]

use centrode::diagnose::Severity;
use centrode::pipeline::{Design, DesignOptions, TeethStyle, ToothCount, design};
use centrode::schema::{RECORD_NAME, Record, SavedDesign};
use centrode::export::write_json;
use centrode::fit::Search;
use centrode::geometry::{self, Point};
use centrode::input::Shape;
use centrode::outline::{Outline, OutlineError, Smoothing, repaired, smooth};
use centrode::solid::assembly_solids;
use centrode_fuzz::{Numbers, finite, folder, remedied, sound_shape};
use libfuzzer_sys::fuzz_target;

/// Share of a pair's area that may be covered twice in a pose of a pair that passed: what its own analysis
/// allows of interference, over whole tooth heights of a few teeth.
const SHARED: f64 = 1e-4;

fn shape(
    name: &str,
    numbers: &mut Numbers<'_>,
    smoothing: Smoothing,
) -> Result<Shape, OutlineError> {
    let raw = repaired(numbers.polygon())?;
    let outline = smooth(&raw, smoothing, 256);
    let shape = Shape { name: name.to_owned(), raw, outline };
    sound_shape(&shape);
    Ok(shape)
}

fuzz_target!(|data: &[u8]| {
    let mut numbers = Numbers::new(data);
    let mut options = DesignOptions::new(numbers.ratio());
    options.teeth = match numbers.within(0, 39) {
        0 => ToothCount::Auto,
        few => ToothCount::Teeth(4 * few.max(2)),
    };
    let bits = numbers.byte();
    let bit = |k: u32| bits >> k & 1 == 1;
    options.style = match bits & 7 {
        0 => TeethStyle::Wave,
        1 => TeethStyle::RegularWave,
        _ => TeethStyle::Involute,
    };
    options.repair = bits & 24 == 24;
    options.quick = !bit(5);
    options.fit.refine = bits & 192 == 192;
    options.fit.search = Search::Paper;
    options.fit.samples = 256;
    options.clearance = numbers.between(0.0, 0.5);
    options.pressure_angle = numbers.between(14.0, 30.0).to_radians();
    let smoothing = match numbers.byte() % 4 {
        0 => Smoothing::Fixed(0.0),
        1 => Smoothing::Fixed(0.5),
        _ => Smoothing::Auto,
    };
    let shapes = [shape("one", &mut numbers, smoothing), shape("two", &mut numbers, smoothing)];
    let [driver, follower] = match shapes {
        [Ok(driver), Ok(follower)] => [driver, follower],
        [Err(error), _] | [_, Err(error)] => return remedied(&error),
    };
    match design(&driver, &follower, &options) {
        Err(error) => remedied(&error),
        Ok(made) => judged(&made),
    }
});

fn judged(made: &Design) {
    made.told(Severity::Fault).iter().for_each(|fault| remedied(fault));
    for placed in &made.assembly.gears {
        finite(&placed.gear.outline);
        finite(&placed.gear.pitch_curve);
        finite(&placed.gear.input);
        assert!(placed.angle.iter().all(|a| a.is_finite()));
        let outline = Outline::new(placed.gear.outline.clone());
        assert!(outline.is_ok(), "the {}: {outline:?}", placed.gear.name);
    }
    let total = made.objective().map_or(0.0, |o| o.total);
    let numbers = [total, made.centrodes.center_distance, made.pair.module];
    assert!(numbers.iter().chain(made.likeness.iter().flatten()).all(|v| v.is_finite()));
    if made.is_sound() {
        assert_eq!(made.contact.summary.lost_poses, 0, "sound with contact lost");
        apart(made);
    }
    let place = folder().join(RECORD_NAME);
    write_json(&place, &Record::new(made)).expect("its record can be written");
    let saved = SavedDesign::read(&place).expect("its own record can be read");
    assert_eq!(saved.assembly(), made.assembly, "the record reads back as another pair");
    if let Err(error) = assembly_solids(&made.assembly) {
        remedied(&error);
    }
}

/// The gears of a pair that passed do not lie on each other.
fn apart(made: &Design) {
    let [driver, follower] = &made.assembly.gears[..] else { panic!("a pair has two gears") };
    let last = made.assembly.driver_angle.len() - 1;
    for k in 0..24 {
        let sample = k * last / 24;
        let posed = |gear: &centrode::assembly::PlacedGear| -> Vec<Point> {
            let turn = |p: &Point| geometry::rotate(*p, gear.angle[sample]) + gear.axis.coords;
            gear.gear.outline.iter().map(turn).collect()
        };
        let shared = geometry::intersection_over_union(&posed(driver), &posed(follower));
        assert!(shared < SHARED, "{shared:e} of the pair is covered twice at sample {sample}");
    }
}
