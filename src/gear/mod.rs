//! The two gears of a pair: which of them is meant, and what is known of both.

mod pair;
mod side;

pub use pair::Pair;
pub use side::Side;
