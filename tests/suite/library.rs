//! The library: load, fit, design, without touching a folder.

use centrode::control::Control;
use centrode::fit::{FitOptions, Ratio, Search, fit};
use centrode::input::{LoadOptions, Shape, load};
use centrode::pipeline::{DesignOptions, design};

fn shape(name: &str) -> Shape {
    load(name, &LoadOptions::default()).unwrap()
}

#[test]
fn two_names_become_gears_in_a_dozen_lines() {
    let (driver, follower) = (shape("egg"), shape("drop"));
    let made = design(&driver, &follower, &DesignOptions::new(Ratio::ONE)).unwrap();
    assert!(made.is_sound(), "{:?}", made.diagnostics);
    assert_eq!(made.names, ["egg", "drop"]);
    assert_eq!(made.teeth[0], made.teeth[1]);
    let [first, second] = &made.assembly.gears[..] else { panic!("not two gears") };
    assert!((second.axis.x - first.axis.x - 80.0).abs() < 1e-9);
    assert!(made.likeness.iter().flatten().all(|l| (0.5..=1.0).contains(l)), "{:?}", made.likeness);
}

#[test]
fn the_global_search_is_never_worse_than_the_paper() {
    let two = Ratio::integer(2).unwrap();
    let half = Ratio::reciprocal(2).unwrap();
    let pairs = [
        ("heart", "dove", Ratio::ONE),
        ("fish", "butterfly", Ratio::ONE),
        ("bell", "candy", two),
        ("candy", "bell", half),
    ];
    for (driver, follower, ratio) in pairs {
        let (a, b) = (shape(driver).outline, shape(follower).outline);
        let total = |search| {
            // The refinement makes another measure small.
            let options = FitOptions { search, refine: false, ..FitOptions::default() };
            fit(&a, &b, ratio, &options, Control::unwatched()).unwrap().objective.total
        };
        let (global, paper) = (total(Search::Global), total(Search::Paper));
        assert!(global <= paper, "{driver} {follower}: {global} against {paper}");
    }
}
