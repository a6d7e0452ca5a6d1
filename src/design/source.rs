//! What a pair is made from: a wanted motion, and the drawings it came from, if any.

use super::DesignError;
use crate::fit::{Fit, FittedGear, LimitCost, Mated};
use crate::input::Shape;
use crate::pitch::{Centrodes, Transmission};

/// A drawing and where it lies in its gear.
#[derive(Clone, Copy, Debug)]
pub struct Drawn<'a> {
    /// The drawing.
    pub shape: &'a Shape,
    /// Its rotation centre, and its place in the gear for a centre distance of 1.
    pub gear: FittedGear,
}

/// A motion on its way to becoming gears.
#[derive(Clone, Debug)]
pub(super) struct Source<'a> {
    pub(super) names: [String; 2],
    /// The motion wanted, bounds on torque and lean kept.
    pub(super) transmission: Transmission,
    /// psi' before bounds, at the samples of `transmission`.
    pub(super) raw: Vec<f64>,
    /// What the bounds changed.
    pub(super) limited: LimitCost,
    pub(super) drawings: [Option<Drawn<'a>>; 2],
    pub(super) fit: Option<Fit>,
    /// Whether the motion itself is what is wanted, to be changed only when no teeth follow it.
    pub(super) exact: bool,
    /// Whether both pitch curves must be one.
    pub(super) symmetric: bool,
}

impl<'a> Source<'a> {
    pub(super) fn fitted(shapes: [&'a Shape; 2], fit: Fit, symmetric: bool) -> Self {
        let [driver, follower] = shapes;
        Self {
            names: shapes.map(|s| s.name.clone()),
            transmission: fit.transmission.clone(),
            raw: fit.raw.clone(),
            limited: fit.limited,
            drawings: [
                Some(Drawn { shape: driver, gear: fit.driver }),
                Some(Drawn { shape: follower, gear: fit.follower }),
            ],
            fit: Some(fit),
            exact: false,
            symmetric,
        }
    }

    pub(super) fn motion(
        transmission: Transmission,
        names: [String; 2],
        drawings: [Option<Drawn<'a>>; 2],
    ) -> Self {
        Self {
            names,
            raw: transmission.samples().to_vec(),
            limited: LimitCost::default(),
            transmission,
            drawings,
            fit: None,
            exact: true,
            symmetric: false,
        }
    }

    pub(super) fn mated(shape: &'a Shape, mated: Mated) -> Self {
        Self {
            names: [shape.name.clone(), format!("mate of {}", shape.name)],
            transmission: mated.transmission,
            raw: mated.raw,
            limited: mated.limited,
            drawings: [Some(Drawn { shape, gear: mated.driver }), None],
            fit: None,
            exact: false,
            symmetric: false,
        }
    }

    pub(super) fn folds(&self) -> (u32, u32) {
        (self.transmission.driver_fold(), self.transmission.follower_fold())
    }

    /// Greatest curvature of either pitch curve times the driver's perimeter.
    pub(super) fn bend(&self) -> f64 {
        let centrodes = Centrodes { transmission: self.transmission.clone(), center_distance: 1.0 };
        let n = self.transmission.samples().len();
        let step = self.transmission.driver_period() / n as f64;
        let most = (0..n).fold(0.0_f64, |most, i| {
            let (driver, follower) = centrodes.curvatures(i as f64 * step);
            most.max(driver.abs()).max(follower.abs())
        });
        most * centrodes.perimeter().0
    }

    /// How far, radians, a motion strays from the one wanted, both begun at the same place.
    pub(super) fn strays(&self, made: &Transmission) -> f64 {
        let n = self.transmission.samples().len();
        let step = self.transmission.driver_period() / n as f64;
        let apart = |i: usize| {
            let phi = i as f64 * step;
            made.psi(phi) - self.transmission.psi(phi)
        };
        let (low, high) =
            (0..n).map(apart).fold((0.0_f64, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)));
        high - low
    }
}

/// Refuses names or motions that no pair can be made from.
pub(super) fn check(source: &Source<'_>) -> Result<(), DesignError> {
    let (a, b) = source.folds();
    let most = crate::policy::MAX_RATIO;
    for (name, fold) in [("the driver's symmetry", a), ("the follower's symmetry", b)] {
        if fold > most {
            return Err(DesignError::Option {
                name,
                value: f64::from(fold),
                remedy: format!("take a motion that repeats at most {most} times a turn"),
            });
        }
    }
    Ok(())
}
