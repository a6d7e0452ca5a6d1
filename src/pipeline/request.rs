//! What a person asks for.

use std::sync::Arc;

use super::{DesignOptions, PipelineError, Scale, ToothCount};
use crate::fit::{FittedGear, Ratio};
use crate::input::Shape;
use crate::pipeline::BoreChoice;
use crate::pitch::Transmission;
use crate::policy;

/// A drawing and where it lies in its gear.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// The drawing.
    pub shape: Arc<Shape>,
    /// Its rotation centre, and its place in the gear for a centre distance of 1.
    pub gear: FittedGear,
}

/// Where a pair comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// Two shapes that the gears are to resemble.
    TwoShapes {
        /// Shape of the driver.
        driver: Arc<Shape>,
        /// Shape of the follower.
        follower: Arc<Shape>,
    },
    /// One shape, for the driver; its mate is computed.
    OneShape {
        /// The shape.
        shape: Arc<Shape>,
    },
    /// A motion, to be kept as it is as far as teeth can follow it.
    Motion {
        /// psi.
        transmission: Transmission,
        /// What the gears are called.
        names: [String; 2],
        /// Drawings that are shown behind the gears and measured for likeness, where there are any.
        drawings: Box<[Option<Drawn>; 2]>,
    },
}

/// All that a person can ask: a source, and every option with its default.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// Where the pair comes from.
    pub source: Source,
    /// The options. [`DesignOptions::ratio`] of a motion is the motion's own.
    pub options: DesignOptions,
}

impl Request {
    /// A pair of two shapes, with the default options.
    #[must_use]
    pub fn two_shapes(driver: impl Into<Arc<Shape>>, follower: impl Into<Arc<Shape>>) -> Self {
        let source = Source::TwoShapes { driver: driver.into(), follower: follower.into() };
        Self { source, options: DesignOptions::default() }
    }

    /// A shape and its mate, with the default options.
    #[must_use]
    pub fn one_shape(shape: impl Into<Arc<Shape>>) -> Self {
        let source = Source::OneShape { shape: shape.into() };
        Self { source, options: DesignOptions::default() }
    }

    /// A motion, with the default options.
    #[must_use]
    pub fn motion(transmission: Transmission, names: [String; 2]) -> Self {
        let source = Source::Motion { transmission, names, drawings: Box::default() };
        Self { source, options: DesignOptions::default() }
    }

    /// The same with other options.
    #[must_use]
    pub fn with(self, options: DesignOptions) -> Self {
        Self { options, ..self }
    }

    /// Refuses what can be refused before anything is made.
    pub(super) fn check(&self) -> Result<(), PipelineError> {
        if let Source::Motion { transmission, .. } = &self.source {
            check_motion(transmission)?;
        }
        let options = &self.options;
        check(options)?;
        options.outfit.check(options.thickness)?;
        if let BoreChoice::Exactly(bore) = options.bore {
            bore.polygon(policy::BORE_CHORD_TOLERANCE)?;
        }
        options.outfit.check_fit(&options.bore)?;
        if let Scale::CenterDistance(distance) = options.scale {
            options.outfit.check_distance(distance)?;
        }
        Ok(())
    }

    /// Turns of the driver for one of the follower.
    pub(super) fn ratio(&self) -> Ratio {
        match &self.source {
            Source::Motion { transmission, .. } => {
                Ratio::of_folds(transmission.driver_fold(), transmission.follower_fold())
            }
            _ => self.options.ratio,
        }
    }
}

/// Refuses motions that no pair can be made from.
fn check_motion(transmission: &Transmission) -> Result<(), PipelineError> {
    let most = policy::MAX_RATIO;
    for (name, fold) in [
        ("the driver's symmetry", transmission.driver_fold()),
        ("the follower's symmetry", transmission.follower_fold()),
    ] {
        if fold > most {
            return Err(PipelineError::Option {
                name,
                value: f64::from(fold),
                remedy: format!("take a motion that repeats at most {most} times a turn"),
            });
        }
    }
    Ok(())
}

fn check(options: &DesignOptions) -> Result<(), PipelineError> {
    let refuse = |name, value, remedy: String| Err(PipelineError::Option { name, value, remedy });
    let length = |name, value: f64| {
        if value > 0.0 && value <= policy::LARGEST_LENGTH {
            Ok(())
        } else {
            refuse(
                name,
                value,
                format!("give a length above 0 and up to {} mm", policy::LARGEST_LENGTH),
            )
        }
    };
    match options.scale {
        Scale::CenterDistance(value) => length("the centre distance", value)?,
        Scale::Extent(value) => length("the size", value)?,
    }
    length("the thickness", options.thickness)?;
    let load = &options.load;
    for (name, value) in
        [("the load", load.torque), ("the speed", load.rpm), ("the friction", load.friction)]
    {
        if !(value >= 0.0 && value.is_finite()) {
            return refuse(name, value, "give a number of 0 or more".to_owned());
        }
    }
    for (name, value) in [
        ("the clearance", options.clearance),
        ("the backlash", options.backlash),
        ("the root clearance", options.root_clearance.unwrap_or(0.0)),
    ] {
        if !(0.0..=policy::LARGEST_LENGTH).contains(&value) {
            return refuse(name, value, "give a length of 0 or more".to_owned());
        }
    }
    let (least, most) = policy::CHORD_TOLERANCE_RANGE;
    if !(least..=most).contains(&options.chord_tolerance) {
        let remedy = format!("give {least:e} to {most} modules");
        return refuse("the chord tolerance", options.chord_tolerance, remedy);
    }
    let degrees = options.pressure_angle.to_degrees();
    if !(10.0..=35.0).contains(&degrees) {
        return refuse("the pressure angle", degrees, "give 10 to 35 degrees".to_owned());
    }
    if !(0.2..=1.5).contains(&options.addendum) {
        return refuse("the addendum", options.addendum, "give 0.2 to 1.5 modules".to_owned());
    }
    if let ToothCount::Teeth(count) = options.teeth {
        let (least, most) = policy::TEETH_RANGE;
        if !(least..=most).contains(&count) {
            let remedy = format!("give {least} to {most} teeth");
            return refuse("the number of teeth", f64::from(count), remedy);
        }
    }
    Ok(())
}
