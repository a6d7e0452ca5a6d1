//! How long a cancelled design still works, wherever it is: a design is stopped at even times from its beginning to its end,
//! and what passes until it returns is told by stage.
//!
//! usage: cargo bench --bench cancel -- [DRIVER FOLLOWER [STOPS]]
//!
//! Wall time counts what else the machine does; processor time of all threads of this process (Linux) does not.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use centrode::control::{Control, StageName};
use centrode::input::{LoadOptions, load};
use centrode::meshing::{DynamicsOptions, proving_runs};
use centrode::pipeline::{Request, Session};

/// Processor time of all threads so far, s; none where the system does not say.
fn processor_time() -> Option<f64> {
    let tasks = std::fs::read_dir("/proc/self/task").ok()?.flatten();
    let spent = tasks.filter_map(|task| {
        let text = std::fs::read_to_string(task.path().join("schedstat")).ok()?;
        text.split(' ').next()?.parse::<f64>().ok()
    });
    Some(1e-9 * spent.sum::<f64>())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let said: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let name = |i: usize, usual: &str| said.get(i).map_or_else(|| usual.to_owned(), String::clone);
    let stops: u32 = said.get(2).map_or(Ok(40), |count| count.parse())?;
    let shape = |name: String| load(&name, &LoadOptions::default());
    let (driver, follower) = (shape(name(0, "heart"))?, shape(name(1, "dove"))?);
    let mut request = Request::two_shapes(driver, follower);
    request.options.runs = proving_runs(&DynamicsOptions::default(), false);

    let begin = Instant::now();
    Session::new().run(&request, StageName::Outfitted, &Control::new())?;
    let whole = begin.elapsed();
    println!("the whole design: {:.2} s", whole.as_secs_f64());

    let mut worst: BTreeMap<StageName, (u32, f64, f64, f64)> = BTreeMap::new();
    for stop in 0..stops {
        let after = whole.mul_f64((f64::from(stop) + 0.5) / f64::from(stops));
        let heard = Arc::new(Mutex::new((StageName::Wanted, 0.0)));
        let sink = heard.clone();
        let control = Control::new().with_progress(move |p| {
            if let Ok(mut last) = sink.lock() {
                *last = (p.stage, p.done);
            }
        });
        let stopper = control.clone();
        let timer = std::thread::spawn(move || {
            std::thread::sleep(after);
            let at = (Instant::now(), processor_time());
            stopper.cancel();
            at
        });
        let ended = Session::new().run(&request, StageName::Outfitted, &control);
        let (end, spent) = (Instant::now(), processor_time());
        let (cancelled, before) = timer.join().map_err(|_| "the timer failed")?;
        if ended.is_ok() {
            continue;
        }
        let wall = end.saturating_duration_since(cancelled).max(Duration::ZERO).as_secs_f64();
        let work = spent.zip(before).map_or(f64::NAN, |(s, b)| (s - b).max(0.0));
        let (stage, done) = heard.lock().map_or((StageName::Wanted, 0.0), |last| *last);
        let entry = worst.entry(stage).or_insert((0, 0.0, 0.0, 0.0));
        entry.0 += 1;
        if wall > entry.1 {
            *entry = (entry.0, wall, work, done);
        }
    }
    println!(
        "{:10} {:>5} {:>12} {:>16} {:>8}",
        "stage", "stops", "longest, ms", "its work, ms", "at"
    );
    for (stage, (count, wall, work, done)) in worst {
        let (wall, work) = (1000.0 * wall, 1000.0 * work);
        println!("{:10} {count:5} {wall:12.1} {work:16.1} {done:8.2}", stage.word());
    }
    Ok(())
}
