//! Bounds on files that are read back.

use super::{LARGEST_LENGTH, TEETH_RANGE};

/// Longest record of a design, bytes: ten times what a pair of 1,000 teeth takes. A list of small numbers takes 16
/// times its text in memory.
pub const RECORD_BYTES: u64 = 16 << 20;
/// Longest file of a train, bytes: [`super::TRAIN_MOST_GEARS`] gears take a hundredth of it.
pub const TRAIN_FILE_BYTES: u64 = 1 << 20;
/// Farthest that a point of a saved part may lie from its axis, mm: ten times [`LARGEST_LENGTH`].
pub const RECORD_REACH: f64 = 10.0 * LARGEST_LENGTH;
/// Most samples of a saved motion: a thousand periods of [`super::MOTION_SAMPLES`].
pub const RECORD_SAMPLES: usize = 1 << 20;
/// Least step of a saved motion, radians: a follower at a thousandth of a speed that is a hundredth of the driver's
/// still steps a hundred times as far.
pub const RECORD_LEAST_STEP: f64 = 1e-10;
/// Factor between a saved module and that of its driver's teeth, at most: the work of contact analysis grows as the
/// module falls.
pub const RECORD_MODULE_OFF: f64 = 10.0;
/// How far ratio, tooth counts and motion of a record may disagree, relative: rounding of written decimals.
pub const RECORD_RATIO_OFF: f64 = 1e-5;
/// Longest name in a record, bytes: those of files end at 255.
pub const RECORD_NAME_BYTES: usize = 1024;
/// Most rings of one saved part, holes or marks: pairs of them are compared.
pub const RECORD_RINGS: usize = 2000;
/// Most modules in the length of an outline whose contact is analysed, which sets its work: a gear of 1,000 teeth
/// has 10,000.
pub const CONTACT_MOST_MODULES: f64 = 1e6;
/// Fewest and most teeth of a gear under check, whoever says so: the most that a design has.
pub const TEETH_BELIEVED: (u32, u32) = (1, TEETH_RANGE.1);
/// Characters of a file's text that a message repeats at most: three lines of a terminal.
pub const QUOTED_LENGTH: usize = 240;
/// Highest degree of a spline: drawing programs stop at 25, and the work grows with its square.
pub const SPLINE_DEGREE: usize = 25;
/// How far the last row of a table of a motion may lie from one turn after the first and still repeat it, shares of the
/// turn: radians with two decimals are off by half of it.
pub const TABLE_TURN_WITHIN: f64 = 1e-3;
/// Characters of a message on the terminal at most: ten lines; what is longer loses its middle.
pub const MESSAGE_LENGTH: usize = 800;
/// Characters of a word in a message at most, where it is no path: a line and a half.
pub const WORD_LENGTH: usize = 120;
/// Characters of a number in a message at most before it is written in powers of ten: no honest one comes near.
pub const NUMBER_LENGTH: usize = 40;
