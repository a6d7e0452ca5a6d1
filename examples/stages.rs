//! A pair stage by stage: every stage is heard as it stands, and work that takes too long is stopped.
//!
//! usage: cargo run --release --example stages [SECONDS]

use std::time::Duration;

use centrode::control::{Control, StageName};
use centrode::input::{LoadOptions, load};
use centrode::pipeline::{Request, Session, Stage};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let patience = std::env::args().nth(1).map_or(Ok(60.0), |text| text.parse())?;
    let [driver, follower] = ["egg", "drop"].map(|name| load(name, &LoadOptions::default()));
    let mut request = Request::two_shapes(driver?, follower?);

    let control = Control::new();
    let stopper = control.clone();
    std::thread::spawn(move || {
        std::thread::sleep(Duration::from_secs_f64(patience));
        stopper.cancel();
    });

    let mut session = Session::new().watched_by(|stage| match stage {
        Stage::Sized(sized) => println!("module {:.2} mm", sized.module),
        stage => println!("{}: {} findings", stage.name().word(), stage.diagnostics().len()),
    });
    let first = session.run(&request, StageName::Outfitted, &control)?;
    println!("the pair is {}", first.verdict().word());

    // Fit and pitch curves do not depend on the clearance: they are taken from the first run.
    request.options.clearance = 0.15;
    session.run(&request, StageName::Outfitted, &control)?;
    println!("fitted {} times", session.made(StageName::Wanted));
    Ok(())
}
