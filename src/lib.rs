//! Centrode turns two drawings, or one, or a wanted motion into a pair of non-circular gears that mesh.
//!
//! A tour, in the order the data flows:
//! [`input`] reads drawings and finished gears into [`outline`]s; [`gear`] tells the two gears apart; [`pitch`] rolls curves on each other; [`fit`] finds axes and motion for two shapes, or the
//! mate of one; [`law`] reads motions as formulas and tables; [`teeth`] lays flanks on the pitch curves; [`pipeline`] does all
//! of it and judges the result with [`meshing`] and [`strength`]; [`assembly`] puts pairs together to trains; [`solid`],
//! [`export`] and [`report`] make files. [`schema`] keeps a design and gives its stages back; [`results`] tells of it in
//! lines, figures and pages. [`check`] judges gears of any origin, [`gallery`] ranks many pairs, [`scene`] keeps a
//! command's options in a file.
//!
//! Two shapes:
//!
//! ```no_run
//! use centrode::pipeline::{DesignOptions, design};
//! use centrode::fit::Ratio;
//! use centrode::input::{LoadOptions, load};
//!
//! let driver = load("heart", &LoadOptions::default())?;
//! let follower = load("dove.svg", &LoadOptions::default())?;
//! let made = design(&driver, &follower, &DesignOptions::new(Ratio::ONE))?;
//! assert!(made.is_sound(), "{:?}", made.diagnostics);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A motion, and the pitch curves that belong to it:
//!
//! ```
//! use centrode::law::{Formula, LawOptions, from_function};
//! use centrode::pitch::Centrodes;
//!
//! let formula = Formula::parse("1 + 0.3*cos(2*phi)")?;
//! let transmission = from_function(|phi| formula.at(phi), &LawOptions::default())?;
//! let centrodes = Centrodes { transmission, center_distance: 80.0 };
//! let touching = centrodes.driver_radius(1.0) + centrodes.follower_radius(1.0);
//! assert!((touching - 80.0).abs() < 1e-9);
//! # Ok::<(), centrode::law::LawError>(())
//! ```
//!
//! Lengths are mm, angles radians, torques N mm. Nothing but [`cli`] prints, and only [`cli`], [`input::load`], [`export`],
//! [`schema::SavedDesign::read`] and [`schema::read_train`] touch files.

// The command line is written as any other program on the library is.
extern crate self as centrode;

pub mod assembly;
pub mod check;
pub mod cli;
pub mod control;
pub mod diagnose;
pub mod export;
pub mod fit;
pub mod gallery;
pub mod gear;
pub mod geometry;
pub mod input;
pub mod law;
pub mod meshing;
pub mod outline;
pub mod pipeline;
pub mod pitch;
pub mod policy;
pub mod report;
pub mod results;
pub mod scene;
pub mod schema;
pub mod solid;
pub mod strength;
#[cfg(feature = "studio")]
#[doc(hidden)]
pub mod studio;
pub mod teeth;
mod wording;
