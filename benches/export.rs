//! What each file format of a 64-tooth pair costs, and all of them together.
#![allow(missing_docs, reason = "criterion's macros make public items without documentation")]

use std::hint::black_box;
use std::time::Duration;

use centrode::design::{DesignOptions, ToothCount, design};
use centrode::export::{
    Animation, Dxf, Export, Glb, LaserSvg, Mjcf, Obj, Parts, Step, Stl, ThreeMf,
};
use centrode::input::{LoadOptions, load};
use centrode::solid::assembly_solids;
use criterion::{Criterion, criterion_group, criterion_main};

fn formats(c: &mut Criterion) {
    let shape = |name| load(name, &LoadOptions::default()).expect("a built-in shape");
    let ratio = "1".parse().expect("a ratio");
    let options = DesignOptions { teeth: ToothCount::Teeth(64), ..DesignOptions::new(ratio) };
    let made = design(&shape("heart"), &shape("dove"), &options).expect("a pair");
    let meshes = assembly_solids(&made.assembly).expect("sound solids");
    let parts = Parts { assembly: &made.assembly, meshes: &meshes };
    let folder = tempfile::tempdir().expect("a folder to write to");
    let all: [(&str, &dyn Export); 9] = [
        ("glb", &Glb::default()),
        ("stl", &Stl),
        ("obj", &Obj),
        ("3mf", &ThreeMf),
        ("step", &Step::default()),
        ("dxf", &Dxf::default()),
        ("laser svg", &LaserSvg::default()),
        ("mjcf", &Mjcf::default()),
        ("gif", &Animation::default()),
    ];
    let mut group = c.benchmark_group("export");
    for (name, format) in all {
        group.bench_function(name, |b| b.iter(|| format.write(black_box(parts), folder.path())));
    }
    group.bench_function("solids and all formats", |b| {
        b.iter(|| {
            let meshes = assembly_solids(&made.assembly).expect("sound solids");
            let parts = Parts { assembly: &made.assembly, meshes: &meshes };
            for (_, format) in all {
                format.write(parts, folder.path()).expect("files");
            }
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
    targets = formats
}
criterion_main!(benches);
