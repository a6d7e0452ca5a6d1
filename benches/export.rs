//! What each file format of a 64-tooth pair costs, and all of them together.
#![allow(missing_docs, reason = "criterion's macros make public items without documentation")]

use std::hint::black_box;
use std::time::Duration;

use centrode::export::{ExportOptions, Format, Parts};
use centrode::input::{LoadOptions, load};
use centrode::pipeline::{DesignOptions, ToothCount, design};
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
    let all: Vec<_> =
        Format::ALL.iter().map(|f| (f.name(), f.encoders(&ExportOptions::default()))).collect();
    let mut group = c.benchmark_group("export");
    for (name, encoders) in all.iter().filter(|(_, encoders)| !encoders.is_empty()) {
        group.bench_function(*name, |b| {
            b.iter(|| {
                for encoder in encoders {
                    encoder.write(black_box(parts), folder.path()).expect("files");
                }
            });
        });
    }
    group.bench_function("solids and all formats", |b| {
        b.iter(|| {
            let meshes = assembly_solids(&made.assembly).expect("sound solids");
            let parts = Parts { assembly: &made.assembly, meshes: &meshes };
            for encoder in all.iter().flat_map(|(_, encoders)| encoders) {
                encoder.write(parts, folder.path()).expect("files");
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
