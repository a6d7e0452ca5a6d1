use std::ops::{Index, IndexMut};

use serde::{Deserialize, Serialize};

use super::Side;

/// Something of which each gear of a pair has its own.
///
/// In files it is an object with the keys `driver` and `follower`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pair<T> {
    /// The driver's.
    pub driver: T,
    /// The follower's.
    pub follower: T,
}

impl<T> Pair<T> {
    /// Of the driver and of the follower.
    pub const fn new(driver: T, follower: T) -> Self {
        Self { driver, follower }
    }

    /// What `of` gives for each gear, the driver first.
    pub fn from_fn(mut of: impl FnMut(Side) -> T) -> Self {
        Self { driver: of(Side::Driver), follower: of(Side::Follower) }
    }

    /// The result of `change` for each gear, the driver first.
    pub fn map<U>(self, mut change: impl FnMut(T) -> U) -> Pair<U> {
        Pair { driver: change(self.driver), follower: change(self.follower) }
    }

    /// As [`Pair::map`], with which gear it is.
    pub fn map_sides<U>(self, mut change: impl FnMut(Side, T) -> U) -> Pair<U> {
        Pair {
            driver: change(Side::Driver, self.driver),
            follower: change(Side::Follower, self.follower),
        }
    }

    /// As [`Pair::map_sides`] for a `change` that may fail.
    ///
    /// # Errors
    /// The first failure; the driver is tried first.
    pub fn try_map<U, E>(
        self,
        mut change: impl FnMut(Side, T) -> Result<U, E>,
    ) -> Result<Pair<U>, E> {
        Ok(Pair {
            driver: change(Side::Driver, self.driver)?,
            follower: change(Side::Follower, self.follower)?,
        })
    }

    /// What belongs to the same gear in both.
    pub fn zip<U>(self, other: Pair<U>) -> Pair<(T, U)> {
        Pair { driver: (self.driver, other.driver), follower: (self.follower, other.follower) }
    }

    /// References to both.
    pub const fn as_ref(&self) -> Pair<&T> {
        Pair { driver: &self.driver, follower: &self.follower }
    }

    /// Mutable references to both.
    pub const fn as_mut(&mut self) -> Pair<&mut T> {
        Pair { driver: &mut self.driver, follower: &mut self.follower }
    }

    /// Each gear with what it has, the driver first.
    pub fn each(self) -> [(Side, T); 2] {
        [(Side::Driver, self.driver), (Side::Follower, self.follower)]
    }

    /// Both values, the driver's first.
    pub fn iter(&self) -> std::array::IntoIter<&T, 2> {
        [&self.driver, &self.follower].into_iter()
    }

    /// The roles exchanged.
    #[must_use]
    pub fn swapped(self) -> Self {
        Self { driver: self.follower, follower: self.driver }
    }
}

impl<T> Pair<Option<T>> {
    /// Both, if neither lacks.
    pub fn both(self) -> Option<Pair<T>> {
        Some(Pair { driver: self.driver?, follower: self.follower? })
    }
}

impl<T> Index<Side> for Pair<T> {
    type Output = T;

    fn index(&self, side: Side) -> &T {
        match side {
            Side::Driver => &self.driver,
            Side::Follower => &self.follower,
        }
    }
}

impl<T> IndexMut<Side> for Pair<T> {
    fn index_mut(&mut self, side: Side) -> &mut T {
        match side {
            Side::Driver => &mut self.driver,
            Side::Follower => &mut self.follower,
        }
    }
}

/// The driver's first, as in [`Pair::iter`].
impl<T> IntoIterator for Pair<T> {
    type Item = T;
    type IntoIter = std::array::IntoIter<T, 2>;

    fn into_iter(self) -> Self::IntoIter {
        [self.driver, self.follower].into_iter()
    }
}

impl<'a, T> IntoIterator for &'a Pair<T> {
    type Item = &'a T;
    type IntoIter = std::array::IntoIter<&'a T, 2>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

/// The driver's first.
impl<T> From<[T; 2]> for Pair<T> {
    fn from([driver, follower]: [T; 2]) -> Self {
        Self { driver, follower }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_gear_keeps_what_is_its_own() {
        let mut teeth = Pair::new(12, 30);
        teeth[Side::Follower] += 6;
        assert_eq!(teeth, Pair::from_fn(|side| if side == Side::Driver { 12 } else { 36 }));
        assert_eq!(teeth.each(), [(Side::Driver, 12), (Side::Follower, 36)]);
        assert_eq!(teeth.zip(teeth.swapped()), Pair::new((12, 36), (36, 12)));
        for side in Side::BOTH {
            assert_eq!(teeth.swapped()[side.partner()], teeth[side]);
        }
        let refused = teeth.try_map(|side, n| if n > 1 { Err(side) } else { Ok(n) });
        assert_eq!(refused, Err(Side::Driver));
    }

    #[test]
    fn files_and_messages_use_the_same_two_names() {
        let pair = Pair::new("a", "b");
        let text = serde_json::to_string(&pair).unwrap();
        assert_eq!(text, r#"{"driver":"a","follower":"b"}"#);
        for side in Side::BOTH {
            assert_eq!(serde_json::to_string(&side).unwrap(), format!("\"{side}\""));
        }
        assert!(
            serde_json::from_str::<Pair<u8>>(r#"{"driver":1,"follower":2,"idler":3}"#).is_err()
        );
    }
}
