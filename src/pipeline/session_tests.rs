use std::sync::Mutex;

use super::*;
use crate::input::{LoadOptions, Shape, load};
use crate::pipeline::BoreChoice;
use crate::solid::Bore;

fn shapes() -> [Shape; 2] {
    let options = LoadOptions { samples: 256, ..LoadOptions::default() };
    ["ellipse", "egg"].map(|name| load(name, &options).unwrap())
}

fn request() -> Request {
    let [driver, follower] = shapes();
    let mut request = Request::two_shapes(driver, follower);
    request.options.fit.refine = false;
    request
}

fn counts(session: &Session) -> [usize; 6] {
    StageName::ALL.map(|stage| session.made(stage))
}

#[test]
fn only_what_depends_on_a_change_is_made_again() {
    let mut session = Session::new();
    let control = Control::new();
    let mut request = request();
    let mut made = |request: &Request| {
        let before = counts(&session);
        let stages = session.run(request, StageName::Outfitted, &control).unwrap();
        let after = counts(&session);
        let made: [bool; 6] = std::array::from_fn(|i| after[i] > before[i]);
        (stages, made)
    };
    let (first, all) = made(&request);
    assert_eq!(all, [true; 6]);
    let (again, none) = made(&request);
    assert_eq!(none, [false; 6]);
    assert!(Arc::ptr_eq(again.outfitted.as_ref().unwrap(), first.outfitted.as_ref().unwrap()));
    request.options.bore = BoreChoice::Exactly(Bore::Round { diameter: 4.0 });
    let (bored, outfit_alone) = made(&request);
    assert_eq!(outfit_alone, [false, false, false, false, false, true]);
    assert!(Arc::ptr_eq(bored.proven.as_ref().unwrap(), first.proven.as_ref().unwrap()));
    request.options.clearance = 0.15;
    let (_, teeth_onwards) = made(&request);
    assert_eq!(teeth_onwards[..3], [false, false, true]);
    request.options.limits.efficiency = 0.5;
    let (_, judged) = made(&request);
    assert_eq!(judged[..3], [false; 3]);
    assert!(judged[3], "new limits judge again");
    request.options.thickness = 9.0;
    let (_, thicker) = made(&request);
    assert_eq!(
        thicker,
        [false, false, false, false, false, true],
        "without runs thickness is outfit"
    );
}

#[test]
fn a_preview_ends_with_the_pitch_curves_and_the_rest_goes_on_from_it() {
    let mut session = Session::new();
    let made = session.run(&request(), StageName::Sized, &Control::new()).unwrap();
    assert!(made.sized.is_some() && made.toothed.is_none());
    assert_eq!(counts(&session), [1, 1, 0, 0, 0, 0]);
    session.run(&request(), StageName::Toothed, &Control::new()).unwrap();
    assert_eq!(counts(&session), [1, 1, 1, 0, 0, 0]);
}

#[test]
fn the_watcher_hears_every_stage_and_the_delivered_one_last() {
    let heard: Arc<Mutex<Vec<Stage>>> = Arc::default();
    let sink = heard.clone();
    let mut session =
        Session::new().watched_by(move |stage| sink.lock().unwrap().push(stage.clone()));
    let made = session.run(&request(), StageName::Outfitted, &Control::new()).unwrap();
    let heard = heard.lock().unwrap();
    for name in StageName::ALL {
        assert!(heard.iter().any(|s| s.name() == name), "{name}");
    }
    let last = heard.iter().rev().find(|s| s.name() == StageName::Toothed).unwrap();
    let Stage::Toothed(last) = last else { unreachable!() };
    assert!(Arc::ptr_eq(last, made.toothed.as_ref().unwrap()));
}

#[test]
fn a_cancelled_request_ends_in_whatever_stage_and_leaves_a_session_that_works() {
    for stage in [StageName::Wanted, StageName::Toothed, StageName::Analysed, StageName::Proven] {
        let control = Control::new();
        let stopper = control.clone();
        let control = control.with_progress(move |p| {
            if p.stage == stage {
                stopper.cancel();
            }
        });
        let mut session = Session::new();
        let mut wanted = request();
        wanted.options.runs = crate::meshing::proving_runs(&Default::default(), false);
        let ended = session.run(&wanted, StageName::Outfitted, &control);
        assert!(ended.is_err_and(|e| e.is_cancelled()), "{stage}");
        let sized = session.run(&wanted, StageName::Sized, &Control::new()).unwrap();
        assert!(sized.sized.is_some());
    }
}

#[test]
fn what_was_used_is_told_beside_what_was_asked() {
    let mut session = Session::new();
    let made = session.run(&request(), StageName::Sized, &Control::new()).unwrap();
    assert_eq!(made.asked.options.teeth, ToothCount::Auto);
    let count = made.sized.as_ref().unwrap().teeth.driver;
    assert_eq!(made.used.teeth, ToothCount::Teeth(count));
}
