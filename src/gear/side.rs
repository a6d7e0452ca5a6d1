use std::fmt;

use serde::{Deserialize, Serialize};

/// One of the two gears of a pair.
///
/// Files, messages and options call them `driver` and `follower`, as [`Side::name`] and [`Display`](fmt::Display) do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Side {
    /// The gear that is turned: counter-clockwise, about the origin.
    Driver,
    /// The gear that it turns: clockwise, about (center distance, 0).
    Follower,
}

impl Side {
    /// Both, the driver first.
    pub const BOTH: [Self; 2] = [Self::Driver, Self::Follower];

    /// The other gear.
    #[must_use]
    pub const fn partner(self) -> Self {
        match self {
            Self::Driver => Self::Follower,
            Self::Follower => Self::Driver,
        }
    }

    /// +1 for the driver, -1 for the follower: the sense in which the gear turns, counter-clockwise positive, and the way
    /// along the common normal at the pitch point that leads out of the gear, from the driver to the follower positive.
    #[must_use]
    pub const fn sign(self) -> f64 {
        match self {
            Self::Driver => 1.0,
            Self::Follower => -1.0,
        }
    }

    /// `driver` or `follower`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Driver => "driver",
            Self::Follower => "follower",
        }
    }
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
