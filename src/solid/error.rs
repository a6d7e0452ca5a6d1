use super::Fault;
use crate::policy;

/// Why a gear does not become a solid.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SolidError {
    /// The thickness is zero, negative or not a number.
    #[error("a thickness of {thickness} mm makes no solid; give one greater than 0 mm")]
    NotPositiveThickness {
        /// What was asked, mm.
        thickness: f64,
    },
    /// A round bore of no size, or play that closes the hole.
    #[error("a bore {diameter} mm wide is no hole; give a size greater than 0 mm, or no bore")]
    NotPositiveBore {
        /// What was asked, mm.
        diameter: f64,
    },
    /// A D bore without a proper flat.
    #[error(
        "a D bore of {diameter} mm with {flat} mm across the flat is none; give between half the diameter and all of it across the flat"
    )]
    BadFlat {
        /// Diameter, mm.
        diameter: f64,
        /// Across the flat, mm.
        flat: f64,
    },
    /// A keyway that does not go with its bore.
    #[error(
        "a keyway {width} mm wide and {depth} mm deep does not go with a bore of {diameter} mm; give a width and a depth between 0 and the diameter"
    )]
    BadKeyway {
        /// Diameter of the bore, mm.
        diameter: f64,
        /// Width of the groove, mm.
        width: f64,
        /// Depth of the groove, mm.
        depth: f64,
    },
    /// The outline cannot bound a solid.
    #[error(
        "the outline of {part} is not a simple closed curve ({why}); repair it before extruding"
    )]
    NotSimple {
        /// Name of the part.
        part: String,
        /// What is wrong, and where.
        why: String,
    },
    /// The bore leaves too thin a wall, or none.
    #[error(
        "the bore leaves a wall of {wall:.2} mm where {needed:.2} mm is needed; {}",
        remedy(*.largest, kind)
    )]
    BoreTooLarge {
        /// Thinnest wall with this bore, mm; zero where bore and outline cross.
        wall: f64,
        /// Wall that is needed, mm.
        needed: f64,
        /// Main size of the largest bore of this kind that keeps the wall, mm; zero if none does.
        largest: f64,
        /// The kind of bore, such as `round`.
        kind: &'static str,
    },
    /// Two things that a part carries touch or overlap.
    #[error("on {part} {first} and {second} overlap; make one of them smaller or leave it out")]
    Overlap {
        /// Name of the part.
        part: String,
        /// The one.
        first: String,
        /// The other.
        second: String,
    },
    /// A hub, hole or mark reaches out of its part.
    #[error(
        "{what} of {part} does not fit: {why}; make it smaller, make the part larger or leave it out"
    )]
    Outside {
        /// Name of the part.
        part: String,
        /// What does not fit.
        what: String,
        /// Half a sentence.
        why: String,
    },
    /// The bevelled edge cannot be drawn.
    #[error("the edges of {part} cannot be bevelled by {chamfer} mm; give a smaller --chamfer")]
    NoBevel {
        /// Name of the part.
        part: String,
        /// Size of the bevel, mm.
        chamfer: f64,
    },
    /// The mesh of the finished solid failed the check.
    #[error(
        "the solid of {part} is not sound: {fault}; take fewer teeth, less clearance or a stouter shape, and report the drawing if that does not help"
    )]
    Unsound {
        /// Name of the part.
        part: String,
        /// What the check found.
        fault: Fault,
    },
    /// The driver swept the whole blank away around the follower's axis.
    #[error("nothing is left around the follower's axis; use a larger center distance")]
    NothingLeft,
}

fn remedy(largest: f64, kind: &str) -> String {
    if largest > policy::SMALLEST_BORE {
        // Rounded down, so that what is told really fits.
        let largest = (100.0 * largest).floor() / 100.0;
        format!("the largest {kind} bore that fits is {largest:.2} mm")
    } else {
        "no bore fits at this axis: make the gear larger or leave the bore out".to_owned()
    }
}
