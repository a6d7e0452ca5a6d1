use super::Fault;

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
        remedy(*.largest)
    )]
    BoreTooLarge {
        /// Thinnest wall with this bore, mm; zero where bore and outline cross.
        wall: f64,
        /// Wall that is needed, mm.
        needed: f64,
        /// Diameter of the largest round bore that keeps the wall, mm; zero if none does.
        largest: f64,
    },
    /// The mesh of the finished solid failed the check.
    #[error(
        "the solid of {part} is not sound: {fault}; change the outline or the thickness a little, and report the drawing"
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

fn remedy(largest: f64) -> String {
    if largest > 0.0 {
        format!("the largest round bore that fits is {largest:.2} mm")
    } else {
        "no bore fits at this axis: make the gear larger or leave the bore out".to_owned()
    }
}
