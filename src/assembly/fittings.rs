//! What parts carry besides teeth and a bore: holes, hubs, lettering, and the plate they stand on.

use crate::geometry::{Face, Point};

/// What a gear carries besides its teeth and its bore; nothing by default. All in the gear's frame, mm.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fittings {
    /// Holes through the gear, apart from each other, from the bore and from everything else.
    pub openings: Vec<Opening>,
    /// A round boss on the top face.
    pub hub: Option<Hub>,
    /// What is raised on or sunk into the top face.
    pub marks: Vec<Mark>,
    /// Length by which the bottom edges of the outline and of the bore are bevelled at 45 degrees; 0
    /// leaves them sharp.
    pub chamfer: f64,
}

impl Fittings {
    /// The same on a gear whose frame is turned by `angle` radians. The hole for a set screw stays along the x axis.
    #[must_use]
    pub fn turned(mut self, angle: f64) -> Self {
        let turn = |ring: &mut Vec<Point>| {
            ring.iter_mut().for_each(|p| *p = crate::geometry::rotate(*p, angle));
        };
        self.openings.iter_mut().for_each(|opening| turn(&mut opening.ring));
        self.marks.iter_mut().flat_map(|mark| mark.face.iter_mut()).for_each(turn);
        self
    }
}

/// A hole through a gear.
#[derive(Clone, Debug, PartialEq)]
pub struct Opening {
    /// What it is for, such as `screw 1`.
    pub name: String,
    /// Its edge, counter-clockwise.
    pub ring: Vec<Point>,
}

/// A round boss about the axis on the top face; the bore goes through it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hub {
    /// Radius, mm.
    pub radius: f64,
    /// Height above the gear's top face, mm.
    pub height: f64,
    /// Diameter of a hole along the gear's x axis from the bore out through the hub, half way up, mm.
    pub set_screw: Option<f64>,
}

/// A figure on the top face.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// What it is, such as `phase mark`.
    pub name: String,
    /// Its edge, counter-clockwise, then its holes, clockwise.
    pub face: Face,
    /// Height above the top face, mm; negative: depth below it.
    pub height: f64,
}

/// A part that stands still while the gears turn: a plate with holes and posts. In its own frame:
/// x and y as in the world, z = 0 at its bottom; mm.
#[derive(Clone, Debug, PartialEq)]
pub struct Fixture {
    /// Name of the part in every file, such as `base`.
    pub name: String,
    /// Edge of the plate, counter-clockwise.
    pub outline: Vec<Point>,
    /// Holes through the plate, each counter-clockwise.
    pub holes: Vec<Vec<Point>>,
    /// Thickness of the plate.
    pub thickness: f64,
    /// What rises from the plate, each step of a stack on its own.
    pub posts: Vec<Post>,
    /// World height of its bottom; the gears' bottoms are at 0.
    pub z: f64,
}

/// A prism on a plate or on another post.
#[derive(Clone, Debug, PartialEq)]
pub struct Post {
    /// Its edge, counter-clockwise.
    pub ring: Vec<Point>,
    /// Which of the plate's holes goes on through it, if one does.
    pub hole: Option<usize>,
    /// Height of its foot in the fixture's frame, mm: the top of what it stands on.
    pub from: f64,
    /// Height of its top, mm.
    pub to: f64,
}

impl Fittings {
    /// Whether there is nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}
