//! The transmission ratio K: how many turns of the driver make one of the follower.

use std::fmt;
use std::str::FromStr;

use crate::geometry::gcd;
use crate::policy;

/// Driver turns for one turn of the follower: `K` or `1/K`, K = 1, 2, 3..., and for motions also `m/n`.
///
/// K > 1 makes the follower K times as long as the driver and K-fold symmetric; 1/K changes the roles. With m/n in lowest
/// terms the driver is n-fold and the follower m-fold symmetric: both are closed curves only if psi' repeats n times
/// in a turn of the driver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ratio {
    driver_fold: u32,
    follower_fold: u32,
}

/// Why a text or number is no transmission ratio.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{given:?} is no transmission ratio here; give a whole number such as 2, or the reciprocal of one such as 1/3, up to {most} (`motion` and `mate` take 3:2 and the like too)"
)]
pub struct RatioError {
    /// What was given.
    pub given: String,
    /// Greatest whole number allowed.
    pub most: u32,
}

impl Ratio {
    /// Driver and follower turn equally often.
    pub const ONE: Self = Self { driver_fold: 1, follower_fold: 1 };

    /// The follower turns once for `k` driver turns.
    ///
    /// # Errors
    /// `k` is 0 or beyond the greatest ratio of the program.
    pub fn integer(k: u32) -> Result<Self, RatioError> {
        Self::checked(1, k, || k.to_string())
    }

    /// The follower turns `k` times for one driver turn.
    ///
    /// # Errors
    /// `k` is 0 or beyond the greatest ratio of the program.
    pub fn reciprocal(k: u32) -> Result<Self, RatioError> {
        Self::checked(k, 1, || format!("1/{k}"))
    }

    /// `driver_turns` of the driver make `follower_turns` of the follower.
    ///
    /// # Errors
    /// Either is 0 or, in lowest terms, beyond the greatest ratio of the program.
    pub fn rational(driver_turns: u32, follower_turns: u32) -> Result<Self, RatioError> {
        let common = gcd(driver_turns, follower_turns).max(1);
        let given = || format!("{driver_turns}:{follower_turns}");
        Self::checked(follower_turns / common, driver_turns / common, given)
    }

    /// The ratio of gears with these orders of symmetry, in lowest terms; neither is 0.
    pub(crate) fn of_folds(driver_fold: u32, follower_fold: u32) -> Self {
        let common = gcd(driver_fold, follower_fold).max(1);
        Self { driver_fold: driver_fold / common, follower_fold: follower_fold / common }
    }

    /// Whether it is a whole number or the reciprocal of one.
    #[must_use]
    pub fn is_whole(self) -> bool {
        self.driver_fold == 1 || self.follower_fold == 1
    }

    fn checked(
        driver_fold: u32,
        follower_fold: u32,
        given: impl Fn() -> String,
    ) -> Result<Self, RatioError> {
        let most = policy::MAX_RATIO;
        let known = 1..=most;
        if known.contains(&driver_fold) && known.contains(&follower_fold) {
            Ok(Self { driver_fold, follower_fold })
        } else {
            Err(RatioError { given: given(), most })
        }
    }

    /// K as a number.
    #[must_use]
    pub fn value(self) -> f64 {
        f64::from(self.follower_fold) / f64::from(self.driver_fold)
    }

    /// Order of the driver's symmetry.
    #[must_use]
    pub fn driver_fold(self) -> u32 {
        self.driver_fold
    }

    /// Order of the follower's symmetry.
    #[must_use]
    pub fn follower_fold(self) -> u32 {
        self.follower_fold
    }
}

impl Default for Ratio {
    fn default() -> Self {
        Self::ONE
    }
}

impl fmt::Display for Ratio {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.driver_fold {
            1 => write!(f, "{}", self.follower_fold),
            k => write!(f, "{}/{k}", self.follower_fold),
        }
    }
}

impl FromStr for Ratio {
    type Err = RatioError;

    fn from_str(text: &str) -> Result<Self, RatioError> {
        let refuse = || RatioError { given: text.to_owned(), most: policy::MAX_RATIO };
        let number = |part: &str| part.trim().parse::<u32>().map_err(|_| refuse());
        match text.split_once('/') {
            None => Self::checked(1, number(text)?, || text.to_owned()),
            Some((k, one)) if number(one)? == 1 => Self::checked(1, number(k)?, || text.to_owned()),
            Some((one, k)) if number(one)? == 1 => Self::checked(number(k)?, 1, || text.to_owned()),
            Some(_) => Err(refuse()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rational_ratios_are_in_lowest_terms() {
        let ratio = Ratio::rational(6, 4).unwrap();
        assert_eq!((ratio.driver_fold(), ratio.follower_fold()), (2, 3));
        assert_eq!((ratio.to_string().as_str(), ratio.value()), ("3/2", 1.5));
        assert!(!ratio.is_whole() && Ratio::rational(4, 2).unwrap().is_whole());
        assert_eq!(Ratio::of_folds(6, 4), Ratio::rational(2, 3).unwrap());
        assert!(Ratio::rational(0, 3).is_err() && Ratio::rational(1, 1000).is_err());
    }

    #[test]
    fn ratios_read_and_print() {
        for (text, driver, follower, shown) in [
            ("1", 1, 1, "1"),
            (" 3 ", 1, 3, "3"),
            ("1/3", 3, 1, "1/3"),
            ("2/1", 1, 2, "2"),
            ("1/1", 1, 1, "1"),
        ] {
            let ratio: Ratio = text.parse().unwrap();
            assert_eq!((ratio.driver_fold(), ratio.follower_fold()), (driver, follower));
            assert_eq!(ratio.to_string(), shown);
        }
        assert_eq!(Ratio::reciprocal(4).unwrap().value(), 0.25);
    }

    #[test]
    fn other_ratios_are_refused() {
        for text in ["0", "1/0", "7/3", "-2", "1.5", "", "/", "two", "1000000", "0/0"] {
            let refused = text.parse::<Ratio>().unwrap_err();
            assert!(refused.to_string().contains("such as 1/3"), "{text}");
        }
    }
}
