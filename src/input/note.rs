//! What a reader did beyond reading, or is not sure of.

use crate::geometry::Point;

/// Something that a person should know of how a file was read. Displays as one sentence.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Note {
    /// Ends that did not meet were joined.
    Joined {
        /// In how many places.
        places: usize,
        /// The widest gap, in the unit of the drawing.
        widest: f64,
        /// The widest gap that is joined, in the same unit.
        tolerance: f64,
    },
    /// A filled path whose ends do not meet was closed by a straight line, as viewers fill it.
    ClosedByLine {
        /// One end, in the unit of the drawing, y upwards.
        from: Point,
        /// The other end.
        to: Point,
    },
    /// The drawing's unit is not the millimetre.
    Unit {
        /// Its name.
        unit: &'static str,
        /// Width of the gear, mm.
        width: f64,
    },
    /// A part was taken among several.
    Taken {
        /// What it is.
        what: String,
        /// What was left out, described.
        others: usize,
    },
    /// A file holds both gears.
    BothGears,
    /// A solid that does not lie in the xy plane was turned.
    Turned {
        /// The axis of the file along which the gear was read: `x` or `y`.
        axis: char,
    },
    /// A solid was cut where its teeth are.
    Layer {
        /// Lower end of the layer of teeth, in the unit of the file.
        from: f64,
        /// Upper end.
        to: f64,
    },
    /// The drawing has teeth of its own.
    TeethNotKept {
        /// How many.
        teeth: usize,
    },
    /// The silhouette of a picture reaches its border.
    CutByBorder,
    /// Shape and ground of a picture are hard to tell apart.
    Faint,
    /// The light falls off across a picture, and the threshold follows it.
    Uneven,
}

impl std::fmt::Display for Note {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Joined { places, widest, tolerance } => write!(
                f,
                "ends that did not meet were joined in {places} places, the widest gap {widest:.4}; --join sets the widest that is joined (here {tolerance:.4})"
            ),
            Self::ClosedByLine { from, to } => write!(
                f,
                "the filled path is open and was closed by a straight line from ({:.4}, {:.4}) to ({:.4}, {:.4}); close it if that is wrong",
                from.x, from.y, to.x, to.y
            ),
            Self::Unit { unit, width } => {
                write!(f, "the drawing's unit is the {unit}, so the gear is {width:.3} mm wide")
            }
            Self::Taken { what, others } => write!(
                f,
                "of {} shapes this one was taken: {what}; name another with #2 or #LAYER behind the file's name",
                others + 1
            ),
            Self::BothGears => f.write_str(
                "the file holds two gears: the first is the driver, the second the follower; #1 and #2 behind the file's name choose",
            ),
            Self::Turned { axis } => {
                write!(f, "the solid does not lie in the xy plane and was read along its {axis} axis")
            }
            Self::Layer { from, to } => {
                write!(f, "the solid was cut between z = {from:.3} and {to:.3}, where its teeth are")
            }
            Self::TeethNotKept { teeth } => write!(
                f,
                "the drawing has {teeth} teeth of its own, which are not kept: new ones are laid on its outline; `centrode check` reads finished gears"
            ),
            Self::CutByBorder => f.write_str(
                "the silhouette reaches the border of the picture and may be cut off there; leave some ground around it",
            ),
            Self::Faint => f.write_str(
                "shape and ground of the picture are hard to tell apart; look at the result, and set --threshold if it is wrong",
            ),
            Self::Uneven => f.write_str(
                "the picture is lit unevenly, so the threshold follows the light; look at the result, and set --threshold if it is wrong",
            ),
        }
    }
}
