use super::*;
use crate::assembly::{Fittings, Fixture};
use crate::solid::hardware::Screw;
use crate::solid::{Bore, Fit, assembly_solids};
use std::f64::consts::{PI, TAU};

const TEETH: f64 = 32.0;
const MODULE: f64 = 2.5;

/// Two wavy gears of pitch radius 40 beside each other.
fn pair(bore: Bore) -> Assembly {
    let gear = |name: &str, phase: f64| {
        let ring = |wave: f64| -> Vec<Point> {
            (0..960)
                .map(|i| TAU * f64::from(i) / 960.0)
                .map(|a| {
                    geometry::rotate(Point::new(40.0 + wave * (TEETH * a + phase).cos(), 0.0), a)
                })
                .collect()
        };
        Gear {
            name: name.to_owned(),
            outline: ring(2.0),
            bore: bore.polygon(policy::BORE_CHORD_TOLERANCE).unwrap(),
            pitch_curve: ring(0.0),
            input: Vec::new(),
            teeth: TEETH as u32,
            fittings: Fittings::default(),
        }
    };
    let placed =
        |gear, x, angle: Vec<f64>| PlacedGear { gear, axis: Point::new(x, 0.0), level: 0.0, angle };
    Assembly {
        gears: vec![
            placed(gear("driver", 0.0), 0.0, vec![0.0, TAU]),
            placed(gear("follower", PI), 80.0, vec![0.0, -TAU]),
        ],
        driver_angle: vec![0.0, TAU],
        thickness: 8.0,
        meshes: vec![[0, 1]],
        axles: Vec::new(),
        fixtures: Vec::new(),
    }
}

fn names() -> Vec<String> {
    ["heart", "dove"].map(str::to_owned).to_vec()
}

fn fitted(outfit: &Outfit) -> Result<(Assembly, Vec<Diagnostic>), OutfitError> {
    let mut assembly = pair(Bore::Round { diameter: 5.0 });
    let warnings = fit_out(&mut assembly, outfit, &names(), MODULE, &[])?;
    Ok((assembly, warnings))
}

/// Least distance between the corners of two finely drawn rings.
fn gap(a: &[Point], b: &[Point]) -> f64 {
    let to = |p: &Point| b.iter().map(|q| (p - q).norm()).fold(f64::INFINITY, f64::min);
    a.iter().map(to).fold(f64::INFINITY, f64::min)
}

#[test]
fn nothing_is_added_that_was_not_asked_for() {
    let (assembly, warnings) = fitted(&Outfit::default()).unwrap();
    assert_eq!((assembly, warnings), (pair(Bore::Round { diameter: 5.0 }), Vec::new()));
}

#[test]
fn phase_marks_point_at_each_other_on_the_line_of_centres() {
    let outfit = Outfit { phase_mark: Some(true), ..Outfit::default() };
    let (assembly, _) = fitted(&outfit).unwrap();
    let tips: Vec<f64> = assembly
        .gears
        .iter()
        .map(|g| {
            let ring = &g.gear.fittings.marks[0].face[0];
            assert!(geometry::signed_area(ring) > 0.0);
            assert!(gap(ring, &g.gear.outline) >= policy::MARK_WALL - 0.05);
            assert!(ring[0].y.abs() < 1e-12 && (ring[1].y + ring[2].y).abs() < 1e-12);
            ring[0].x + g.axis.x
        })
        .collect();
    assert!(tips[0] < tips[1] && tips[1] - tips[0] < 8.0, "{tips:?}");
    assert!(tips[0] > 36.0 && tips[1] < 44.0, "{tips:?}");
    assert!(assembly_solids(&assembly).is_ok());
}

#[test]
fn lightening_holes_keep_rim_hub_and_spokes() {
    for choice in [Lightening::Auto, Lightening::Holes(5)] {
        let (assembly, _) = fitted(&Outfit { lightening: choice, ..Outfit::default() }).unwrap();
        let gear = &assembly.gears[0].gear;
        let openings = &gear.fittings.openings;
        let chosen = policy::LIGHTENING_CHOICE;
        match choice {
            Lightening::Auto => assert!((chosen.0..=chosen.1).contains(&(openings.len() as u32))),
            _ => assert_eq!(openings.len(), 5),
        }
        let slack = 2.0 * policy::OPENING_TOLERANCE;
        for (i, opening) in openings.iter().enumerate() {
            assert!(
                gap(&opening.ring, &gear.outline) > policy::LIGHTENING_RIM_MODULES * MODULE - slack
            );
            let wall = gap(&opening.ring, gear.bore.as_ref().unwrap());
            assert!(wall > policy::LIGHTENING_WALL - slack, "{wall}");
            for other in &openings[..i] {
                assert!(gap(&opening.ring, &other.ring) > policy::LIGHTENING_WALL - slack);
            }
        }
        let saved: f64 = openings.iter().map(|o| geometry::area(&o.ring)).sum();
        let share = saved / geometry::area(&gear.outline);
        assert!((0.2..0.6).contains(&share), "{share}");
        // The rim is smooth: no hole's far side waves with the teeth.
        let far: Vec<f64> = openings
            .iter()
            .map(|o| o.ring.iter().map(|p| p.coords.norm()).fold(0.0, f64::max))
            .collect();
        let limit = 38.0 - policy::LIGHTENING_RIM_MODULES * MODULE + 0.3;
        assert!(far.iter().all(|r| *r < limit), "{far:?} {limit}");
        assert!(assembly_solids(&assembly).is_ok());
    }
}

#[test]
fn letters_stand_inside_and_leave_the_rest_alone() {
    let label = |text, raised| Some(Label { text, raised, height: None, place: LabelPlace::Axis });
    for (text, raised, letters) in [
        (LabelText::Names, true, [5, 4]),
        (LabelText::Each(vec!["A".into(), "No".into()]), false, [1, 2]),
        (LabelText::Same("Ω+é".into()), true, [4, 4]),
        // The dot in a 0 is left out: it would stand alone in the hole.
        (LabelText::Same("2020".into()), true, [4, 4]),
    ] {
        let outfit = Outfit { label: label(text, raised), ..Outfit::default() };
        let (assembly, warnings) = fitted(&outfit).unwrap();
        assert!(warnings.is_empty(), "{warnings:?}");
        for (placed, count) in assembly.gears.iter().zip(letters) {
            let marks: Vec<_> =
                placed.gear.fittings.marks.iter().filter(|m| m.name != "phase mark").collect();
            assert_eq!(marks.len(), count);
            assert!(marks.iter().all(|m| (m.height > 0.0) == raised));
        }
        assert!(assembly_solids(&assembly).is_ok());
    }
    let long = "a text much too long for a gear of this size, whatever the letters";
    let outfit = Outfit { label: label(LabelText::Same(long.into()), true), ..Outfit::default() };
    assert!(matches!(fitted(&outfit), Err(OutfitError::NoRoomForText { .. })));
    // A name is left out instead, and what no font has is left out of it.
    let mut assembly = pair(Bore::None);
    let outfit = Outfit { label: label(LabelText::Names, true), ..Outfit::default() };
    let names = [long.to_owned(), "do\u{7}ve".to_owned()];
    let warnings = fit_out(&mut assembly, &outfit, &names, MODULE, &[]).unwrap();
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert_eq!((warnings[0].code, &*warnings[0].subject), (Code::NameHasNoRoom, "driver"));
    assert_eq!(assembly.gears[1].gear.fittings.marks.len(), 1 + 4);
}

#[test]
fn letters_have_the_height_and_place_asked_for() {
    for (place, along) in [
        (LabelPlace::Above, Vector::new(0.0, 1.0)),
        (LabelPlace::Below, Vector::new(0.0, -1.0)),
        (LabelPlace::Left, Vector::new(-1.0, 0.0)),
        (LabelPlace::Right, Vector::new(1.0, 0.0)),
    ] {
        let text = LabelText::Same("H".into());
        let label = Label { text, raised: true, height: Some(5.0), place };
        let outfit = Outfit { label: Some(label), phase_mark: Some(false), ..Outfit::default() };
        let (assembly, _) = fitted(&outfit).unwrap();
        let face = &assembly.gears[0].gear.fittings.marks[0].face[0];
        let (low, high) = geometry::bounds(face);
        assert!((high.y - low.y - 5.0).abs() < 1e-6);
        let middle = nalgebra::center(&low, &high).coords;
        assert!(middle.dot(&along) > 0.9 * middle.norm() && middle.norm() > 15.0, "{middle}");
    }
}

#[test]
fn the_largest_that_is_told_fits() {
    let hub = |diameter| Outfit {
        hub: Some(HubChoice { diameter: Some(diameter), height: 5.0, set_screw: None }),
        ..Outfit::default()
    };
    let screws = |diameter| Outfit {
        screws: Some(Screws { count: 6, diameter, circle: Some(15.0) }),
        ..Outfit::default()
    };
    for make in [&hub as &dyn Fn(f64) -> Outfit, &screws] {
        let Err(OutfitError::NoRoom { largest, .. }) = fitted(&make(79.0)) else {
            panic!("it was not refused")
        };
        assert!(largest > 10.0);
        let (assembly, _) = fitted(&make(largest)).unwrap();
        assert!(assembly_solids(&assembly).is_ok(), "{largest}");
    }
    assert!(matches!(fitted(&hub(5.5)), Err(OutfitError::BadSize { .. })));
}

fn middle(ring: &[Point]) -> Point {
    geometry::centroid(ring)
}

fn plate(outfit: &Outfit) -> Fixture {
    let (assembly, _) = fitted(outfit).unwrap();
    assert!(assembly_solids(&assembly).is_ok());
    assembly.fixtures[0].clone()
}

#[test]
fn pins_stand_on_the_axes_and_leave_play() {
    for (fit, play) in [(None, policy::SLIDE_FIT), (Some(Fit::Play(0.3)), 0.3)] {
        let base = plate(&Outfit { base: Base::Pins, fit, ..Outfit::default() });
        assert_eq!(base.posts.len(), 4);
        for (post, x) in base.posts.iter().zip([0.0, 0.0, 80.0, 80.0]) {
            assert!((middle(&post.ring) - Point::new(x, 0.0)).norm() < 1e-9);
        }
        let pin = (geometry::area(&base.posts[1].ring) / PI).sqrt();
        assert!((pin - (2.5 - play)).abs() < 0.01, "{pin}");
        // The gears rest on the shoulders and the pins go through them.
        let z = base.stance.height_of_flat().unwrap();
        assert_eq!(base.posts[0].to + z, 0.0);
        assert_eq!(base.posts[1].to + z, 8.0 + policy::PIN_OVERHANG);
    }
    let mut bare = pair(Bore::None);
    let outfit = Outfit { base: Base::Pins, ..Outfit::default() };
    let error = fit_out(&mut bare, &outfit, &names(), MODULE, &[]).unwrap_err();
    assert!(matches!(error, OutfitError::NoBore { .. }));
}

/// World heights between which a part lies in the first pose, and its middle.
fn standing(assembly: &Assembly, part: &Fixture) -> ([f64; 2], nalgebra::Point3<f64>) {
    let mesh = crate::solid::fixture_solid(part).unwrap();
    let pose = assembly.pose_of(part);
    let points = mesh.positions.iter().map(|p| pose * nalgebra::Point3::from(*p));
    let (low, high) = points.fold(
        ([f64::INFINITY; 3].into(), [f64::NEG_INFINITY; 3].into()),
        |(low, high): (nalgebra::Point3<f64>, nalgebra::Point3<f64>), p| {
            (low.inf(&p), high.sup(&p))
        },
    );
    ([low.z, high.z], nalgebra::center(&low, &high))
}

fn part<'a>(assembly: &'a Assembly, name: &str) -> &'a Fixture {
    assembly.fixtures.iter().find(|f| f.name == name).unwrap_or_else(|| panic!("no {name}"))
}

#[test]
fn caps_sit_on_the_pins_and_leave_the_gears_play() {
    let outfit = Outfit { base: Base::Pins, caps: true, ..Outfit::default() };
    let (assembly, _) = fitted(&outfit).unwrap();
    assert!(assembly_solids(&assembly).is_ok());
    for (name, x) in [("driver-cap", 0.0), ("follower-cap", 80.0)] {
        let cap = part(&assembly, name);
        let ([low, high], middle) = standing(&assembly, cap);
        assert!((0.2..0.6).contains(&(low - 8.0)), "{low}");
        assert!((middle.x - x).abs() < 0.05 && middle.y.abs() < 0.05);
        let base = part(&assembly, "base");
        let pin = base.posts[1].to + base.stance.height_of_flat().unwrap();
        assert!(pin > low + 3.0 && pin < high - 1.0, "{pin} {low} {high}");
        // It opens downwards.
        assert!(assembly.pose_of(cap).transform_point(&nalgebra::Point3::origin()).z > low + 5.0);
    }
    let error = Outfit { caps: true, ..Outfit::default() }.check(8.0).unwrap_err();
    assert!(matches!(error, OutfitError::Needs { .. }));
}

#[test]
fn a_knob_stands_on_the_driver_and_turns_with_it() {
    let (assembly, _) = fitted(&Outfit { knob: true, ..Outfit::default() }).unwrap();
    assert!(assembly_solids(&assembly).is_ok());
    let knob = part(&assembly, "knob");
    assert_eq!(knob.stance.with, Some(0));
    let hole = &assembly.gears[0].gear.fittings.openings[0].ring;
    let ([low, high], at) = standing(&assembly, knob);
    assert!((at.xy() - middle(hole)).norm() < 0.05, "{at}");
    assert!(low > 0.0 && low < 1.0 && (high - 24.0).abs() < 1e-6, "{low} {high}");
    // As far out as the grip stays over the gear.
    let outline = &assembly.gears[0].gear.outline;
    let beyond =
        outline.iter().map(|p| (p.coords - at.xy().coords).norm()).fold(f64::MAX, f64::min);
    assert!(beyond > 5.9 && at.xy().coords.norm() > 30.0, "{beyond} {at}");
}

#[test]
fn screws_and_bearings_are_held_as_asked() {
    let fitted = |bore: Bore, base| {
        let mut assembly = pair(bore);
        let outfit = Outfit { base, ..Outfit::default() };
        fit_out(&mut assembly, &outfit, &names(), MODULE, &[])?;
        assert!(assembly_solids(&assembly).is_ok());
        Ok::<_, OutfitError>(assembly)
    };
    let round = |diameter| Bore::Round { diameter };
    for screw in crate::solid::hardware::SCREWS {
        for hold in [Hold::Through, Hold::Nut, Hold::Insert] {
            let Ok(assembly) = fitted(round(screw.clearance[0]), Base::Screw { screw, hold })
            else {
                assert!(hold == Hold::Insert && screw.insert.is_none());
                continue;
            };
            let base = part(&assembly, "base");
            let hole = (geometry::area(&base.holes[0]) / PI).sqrt();
            let wanted = match (hold, screw.insert) {
                (Hold::Insert, Some([hole, depth])) => {
                    assert!(base.posts[0].to > depth - 1e-9);
                    hole
                }
                _ => screw.clearance[0],
            };
            assert!((2.0 * hole - wanted).abs() < 0.02, "{} {hole}", screw.name);
            assert_eq!(base.pockets.len(), if hold == Hold::Nut { 2 } else { 0 });
            for trap in &base.pockets {
                assert!(trap.from == 0.0 && trap.to > screw.nut_height);
                let (low, high) = geometry::bounds(&trap.ring);
                let flats = (high.y - low.y).min(high.x - low.x);
                assert!((0.2..0.5).contains(&(flats - screw.across_flats)), "{flats}");
            }
        }
    }
    for bearing in crate::solid::hardware::BEARINGS {
        let assembly = fitted(round(bearing.shaft + 0.3), Base::Bearing(bearing)).unwrap();
        let base = part(&assembly, "base");
        let seat = &base.pockets[1];
        let wide = 2.0 * (geometry::area(&seat.ring) / PI).sqrt();
        assert!((wide - bearing.outside - 0.1).abs() < 0.02, "{wide}");
        assert!((seat.to - seat.from - bearing.width).abs() < 1e-9 && seat.from > 1.0);
        // The spacer fills the gap between plate and gear and touches the inner race only.
        let ([low, high], at) = standing(&assembly, part(&assembly, "follower-spacer"));
        assert!((low + 1.0).abs() < 1e-6 && high.abs() < 1e-6 && (at.x - 80.0).abs() < 0.05);
    }
    let m5 = Screw::named("M5").unwrap();
    let error = fitted(round(8.0), Base::Screw { screw: m5, hold: Hold::Nut }).unwrap_err();
    assert!(error.to_string().contains("--bore M5"), "{error}");
}

#[test]
fn an_upright_plate_and_its_feet_go_into_each_other() {
    let outfit = Outfit { base: Base::Pins, upright: true, ..Outfit::default() };
    let (assembly, _) = fitted(&outfit).unwrap();
    assert!(assembly_solids(&assembly).is_ok());
    let base = part(&assembly, "base");
    let floor = geometry::bounds(&base.outline).0.y;
    // Clear of the teeth.
    assert!(floor + 16.0 < -42.0, "{floor}");
    for name in ["stand-1", "stand-2"] {
        let foot = part(&assembly, name);
        let pose = assembly.pose_of(foot);
        for p in &foot.outline {
            for z in [0.0, foot.thickness] {
                let at = pose * nalgebra::Point3::new(p.x, p.y, z);
                assert!(at.y > floor - 1e-6);
                // Nothing of the foot is inside the plate: what crosses it goes through the notch.
                let depth = at.z - base.stance.place.translation.z;
                let inside = (0.0..base.thickness).contains(&depth);
                assert!(!inside || !geometry::contains(&base.outline, Point::new(at.x, at.y)));
            }
        }
    }
    let feet = Outfit { mount: Mount::Feet, ..outfit };
    assert!(matches!(feet.check(8.0), Err(OutfitError::Needs { .. })));
}

#[test]
fn a_lego_plate_has_a_hole_every_eight_millimetres() {
    let outfit = Outfit { base: Base::Lego, ..Outfit::default() };
    let base = plate(&outfit);
    assert_eq!(base.holes.len(), 3 * 13);
    for hole in &base.holes {
        let at = middle(hole) / 8.0;
        assert!((at.x - at.x.round()).abs() < 1e-9 && (at.y - at.y.round()).abs() < 1e-9);
    }
    for (post, x) in base.posts.iter().zip([0.0, 80.0]) {
        assert!((middle(&base.holes[post.hole.unwrap()]) - Point::new(x, 0.0)).norm() < 1e-9);
    }
    let error = outfit.check_distance(83.0).unwrap_err();
    assert_eq!(error, OutfitError::OffTheGrid { distance: 83.0, nearest: 10 });
    assert_eq!(outfit.check_distance(88.0), Ok(()));
}

#[test]
fn all_of_it_goes_together() {
    let outfit = Outfit {
        fit: Some(Fit::Play(policy::SLIDE_FIT)),
        hub: Some(HubChoice { diameter: None, height: 6.0, set_screw: Some(2.5) }),
        screws: None,
        lightening: Lightening::Auto,
        face: FaceChoice::default(),
        holes: DrawnHoles::default(),
        label: Some(Label {
            text: LabelText::Names,
            raised: true,
            height: Some(3.0),
            place: LabelPlace::Above,
        }),
        phase_mark: None,
        chamfer: 0.4,
        base: Base::Pins,
        base_thickness: Some(4.0),
        mount: Mount::Feet,
        upright: false,
        caps: true,
        knob: true,
        nozzle: 0.4,
    };
    let (assembly, warnings) = fitted(&outfit).unwrap();
    assert!(warnings.is_empty(), "{warnings:?}");
    assert_eq!(assembly_solids(&assembly).map(|m| m.len()), Ok(2 + 1 + 2 + 4 + 1));
}

#[test]
fn sizes_out_of_range_are_refused_with_what_would_do() {
    let plain = Outfit::default;
    let hub = |height, set_screw| Some(HubChoice { diameter: None, height, set_screw });
    let screws = |count| Some(Screws { count, diameter: 3.0, circle: None });
    for outfit in [
        Outfit { chamfer: 4.1, ..plain() },
        Outfit { chamfer: f64::NAN, ..plain() },
        Outfit { fit: Some(Fit::Play(-0.1)), ..plain() },
        Outfit { fit: Some(Fit::Play(9.0)), ..plain() },
        Outfit { hub: hub(0.0, None), ..plain() },
        Outfit { hub: hub(1.0, Some(2.5)), ..plain() },
        Outfit { hub: hub(4.0, Some(3.0)), ..plain() },
        Outfit { screws: screws(0), ..plain() },
        Outfit { screws: screws(99), ..plain() },
        Outfit { lightening: Lightening::Holes(1), ..plain() },
        Outfit { base: Base::Pins, base_thickness: Some(0.0), ..plain() },
    ] {
        let error = outfit.check(8.0).unwrap_err();
        assert!(matches!(error, OutfitError::BadSize { .. }), "{outfit:?}");
    }
    assert_eq!(Outfit { chamfer: 4.0, ..plain() }.check(8.0), Ok(()));
}

#[test]
fn an_inner_drawing_goes_on_the_face_clear_of_bore_and_edge() {
    let disc = |x: f64, r: f64| -> Vec<Point> {
        circle(r, 0.01).iter().map(|p| Point::new(p.x + x, p.y)).collect()
    };
    let patch =
        |color: u8, ring| crate::input::Patch { color: [color; 3], faces: vec![vec![ring]] };
    // A disc over the axis and the rim, with an eye in it, and a hole beside.
    let inner = Inner {
        patches: vec![patch(255, disc(12.0, 20.0)), patch(90, disc(20.0, 3.0))],
        holes: vec![disc(-22.0, 4.0)],
        lines: Vec::new(),
    };
    for style in [FaceStyle::Engrave, FaceStyle::Raise, FaceStyle::Cut] {
        for fit in [FaceFit::Follow, FaceFit::Keep] {
            let mut assembly = pair(Bore::Round { diameter: 5.0 });
            for placed in &mut assembly.gears {
                placed.gear.input = placed.gear.pitch_curve.clone();
            }
            let face = FaceChoice { style, fit, depth: None };
            let outfit = Outfit { face, ..Outfit::default() };
            let drawings = [inner.clone(), Inner::default()];
            let bare = assembly_solids(&assembly).unwrap();
            fit_out(&mut assembly, &outfit, &names(), MODULE, &drawings).unwrap();
            let gear = &assembly.gears[0].gear;
            let Fittings { openings, marks, .. } = &gear.fittings;
            assert!(openings.iter().any(|o| geometry::contains(&o.ring, Point::new(-21.0, 0.0))));
            let rings = marks.iter().flat_map(|m| &m.face).chain(openings.iter().map(|o| &o.ring));
            for ring in rings {
                assert!(gap(ring, &gear.outline) > 0.75 && gap(ring, &disc(0.0, 2.5)) > 0.7);
            }
            if style != FaceStyle::Cut {
                // The eye is a figure of its own, in a hole of the disc.
                assert_eq!(marks.len(), 2, "{style:?} {fit:?}");
            }
            let meshes = assembly_solids(&assembly).unwrap();
            let grown = meshes[0].volume() - bare[0].volume();
            let hole: f64 = openings.iter().map(|o| geometry::area(&o.ring)).sum::<f64>() * 8.0;
            if style != FaceStyle::Cut {
                assert_eq!(grown + hole > 0.0, style == FaceStyle::Raise);
            }
            assert_eq!(meshes[1].volume(), bare[1].volume());
            let outfit = Outfit { holes: DrawnHoles::Fill, ..Outfit::default() };
            let mut filled = pair(Bore::Round { diameter: 5.0 });
            fit_out(&mut filled, &outfit, &names(), MODULE, &drawings).unwrap();
            assert!(filled.gears[0].gear.fittings.is_empty());
        }
    }
    let deep = FaceChoice { style: FaceStyle::Engrave, depth: Some(7.0), ..FaceChoice::default() };
    let refused = fitted(&Outfit { face: deep, ..Outfit::default() });
    assert!(matches!(refused, Err(OutfitError::BadSize { .. })));
}
