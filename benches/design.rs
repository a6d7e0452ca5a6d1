//! What a user waits for, from smoothing a drawing to all files of a pair.
#![allow(missing_docs, reason = "criterion's macros make public items without documentation")]

use centrode::control::Control;
use std::hint::black_box;
use std::time::Duration;

use centrode::assembly::Gear;
use centrode::check::{CheckOptions, check, default_runs};
use centrode::export::{Encode, Glb, Obj, Parts, Stl, write_json};
use centrode::fit::{self, FitOptions, Ratio, Search};
use centrode::input::{LoadOptions, Shape, Toothed, load};
use centrode::meshing::{
    ContactInput, ContactOptions, DynamicsInput, DynamicsOptions, analyse, simulate,
};
use centrode::outline::{Outline, Smoothing, smooth};
use centrode::pipeline::{DesignOptions, ToothCount, design};
use centrode::pitch::{Centrodes, PolarCurve, Transmission};
use centrode::report::{PictureOptions, pair_svg};
use centrode::solid::assembly_solids;
use centrode::teeth::{TeethOptions, involute_pair};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};

const SIZES: [usize; 3] = [512, 1024, 2048];
const TEETH: [u32; 3] = [32, 64, 128];

fn shape(name: &str, samples: usize) -> Shape {
    load(name, &LoadOptions { samples, ..LoadOptions::default() }).expect("a built-in shape")
}

fn ratio() -> Ratio {
    "1".parse().expect("a ratio")
}

fn curves(c: &mut Criterion) {
    let mut group = c.benchmark_group("smoothing");
    for n in SIZES {
        let raw = shape("dove", n).raw;
        group.bench_function(BenchmarkId::from_parameter(n), |b| {
            b.iter(|| smooth(black_box(&raw), Smoothing::Auto, n));
        });
    }
    group.finish();
    let mut group = c.benchmark_group("polar curve");
    for n in SIZES {
        let outline = shape("dove", n).outline;
        let center = outline.centroid();
        group.bench_function(BenchmarkId::from_parameter(n), |b| {
            b.iter(|| PolarCurve::about(black_box(outline.points()), center, n));
        });
    }
    group.finish();
}

fn searches(c: &mut Criterion) {
    for (name, search) in [("paper search", Search::Paper), ("global search", Search::Global)] {
        let mut group = c.benchmark_group(name);
        for n in SIZES {
            let (heart, dove) = (shape("heart", n).outline, shape("dove", n).outline);
            let options = FitOptions { search, samples: n, ..FitOptions::default() };
            group.bench_function(BenchmarkId::from_parameter(n), |b| {
                b.iter(|| {
                    fit::fit(black_box(&heart), &dove, ratio(), &options, Control::unwatched())
                });
            });
        }
        group.finish();
    }
}

/// A smooth law whose pitch curves are neither round nor symmetric.
fn wavy() -> Centrodes {
    let law = |i: u32| {
        let t = std::f64::consts::TAU * f64::from(i) / 1024.0;
        (0.35 * t.cos() + 0.12 * (2.0 * t + 0.4).sin() + 0.05 * (3.0 * t).cos()).exp()
    };
    let samples: Vec<f64> = (0..1024).map(law).collect();
    let transmission = Transmission::from_derivative(&samples, 1, 1).expect("an increasing law");
    Centrodes { transmission, center_distance: 80.0 }
}

fn teeth_options(driver_teeth: u32) -> TeethOptions {
    TeethOptions { driver_teeth, ..TeethOptions::default() }
}

/// Calls `used` with a pair of so many teeth.
fn with_pair(centrodes: &Centrodes, teeth: u32, used: impl FnOnce(ContactInput<'_>)) {
    let pair = involute_pair(centrodes, &teeth_options(teeth)).expect("teeth on a smooth law");
    used(ContactInput {
        driver: &pair.driver.points,
        follower: &pair.follower.points,
        center_distance: centrodes.center_distance,
        module: pair.module,
        motion: &centrodes.transmission,
        control: Control::unwatched(),
    });
}

fn gears(c: &mut Criterion) {
    let centrodes = wavy();
    let mut group = c.benchmark_group("teeth and carving");
    for teeth in TEETH {
        group.bench_function(BenchmarkId::from_parameter(teeth), |b| {
            b.iter(|| involute_pair(black_box(&centrodes), &teeth_options(teeth)));
        });
    }
    group.finish();
    let mut group = c.benchmark_group("contact analysis");
    for teeth in TEETH {
        with_pair(&centrodes, teeth, |input| {
            group.bench_function(BenchmarkId::from_parameter(teeth), |b| {
                b.iter(|| analyse(black_box(&input), &ContactOptions::default()));
            });
        });
    }
    group.finish();
    let mut group = c.benchmark_group("one cycle as rigid bodies");
    for teeth in TEETH {
        with_pair(&centrodes, teeth, |contact| {
            let input = DynamicsInput { contact, driver_teeth: teeth };
            let options = DynamicsOptions { cycles: 1.0, ..DynamicsOptions::default() };
            group.bench_function(BenchmarkId::from_parameter(teeth), |b| {
                b.iter(|| simulate(black_box(&input), &options));
            });
        });
    }
    group.finish();
}

fn whole(c: &mut Criterion) {
    let shapes = [shape("heart", 1024), shape("dove", 1024)];
    let options = DesignOptions { teeth: ToothCount::Teeth(48), ..DesignOptions::new(ratio()) };
    let made = design(&shapes[0], &shapes[1], &options).expect("a pair");
    let mut group = c.benchmark_group("design");
    group.bench_function("solids", |b| b.iter(|| assembly_solids(black_box(&made.assembly))));
    let finished = |i: usize| {
        let gear: &Gear = &made.assembly.gears[i].gear;
        let outline = Outline::new(gear.outline.clone()).expect("a simple outline");
        Toothed { outline, holes: Vec::new(), thinned: None, record: None, notes: Vec::new() }
    };
    let finished = [finished(0), finished(1)];
    for (name, runs) in [
        ("check by contact", Vec::new()),
        ("check with a run", default_runs(&DynamicsOptions::default(), false)),
    ] {
        let options = CheckOptions {
            center_distance: Some(made.assembly.gears[1].axis.x),
            runs,
            ..CheckOptions::default()
        };
        group.bench_function(name, |b| b.iter(|| check(&finished[0], &finished[1], &options)));
    }
    let folder = tempfile::tempdir().expect("a folder to write to");
    group.bench_function("whole, with all files", |b| {
        b.iter(|| {
            let made = design(&shapes[0], &shapes[1], &options).expect("a pair");
            let meshes = assembly_solids(&made.assembly).expect("sound solids");
            let parts = Parts { assembly: &made.assembly, meshes: &meshes };
            for format in [&Glb::default() as &dyn Encode, &Stl, &Obj] {
                format.write(parts, folder.path()).expect("files");
            }
            let record = centrode::schema::Record::new(&made);
            write_json(&folder.path().join("design.json"), &record).expect("a record");
            pair_svg(&made.assembly, &PictureOptions::default()).len()
        });
    });
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(2));
    targets = curves, searches, gears, whole
}
criterion_main!(benches);
