//! What parts carry besides teeth and a bore: holes, hubs, lettering, and the plate they stand on.

use crate::geometry::{Face, Point};
use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use std::f64::consts::{FRAC_PI_2, PI};

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

/// A part beside the gears, such as the plate they stand on or a cap: a plate with holes, posts and pockets. In its own
/// frame it lies as it is printed, flat on z = 0; mm.
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
    /// Blind holes, each apart from everything but the hole it widens.
    pub pockets: Vec<Pocket>,
    /// Where it stands.
    pub stance: Stance,
}

/// Where a part stands: what takes its own frame to the world's, or to the frame of the gear that it turns with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stance {
    /// Turn and shift, mm.
    pub place: Isometry3<f64>,
    /// Number of the gear that it turns with; none for a part that stands still.
    pub with: Option<usize>,
}

impl Stance {
    /// As it is printed, its bottom at world height `z` (the gears' bottoms are at 0).
    #[must_use]
    pub fn flat(z: f64) -> Self {
        Self::at(Point::origin(), z)
    }

    /// As it is printed, its origin at a place.
    #[must_use]
    pub fn at(p: Point, z: f64) -> Self {
        Self { place: Isometry3::translation(p.x, p.y, z), with: None }
    }

    /// Upside down, its printed bottom at height `z`, its origin at a place.
    #[must_use]
    pub fn turned_over(p: Point, z: f64) -> Self {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), PI);
        Self { place: Isometry3::from_parts(Vector3::new(p.x, p.y, z).into(), turn), with: None }
    }

    /// On its edge: its x along the world's z, its own z along the world's -x.
    #[must_use]
    pub fn on_edge(at: [f64; 3]) -> Self {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -FRAC_PI_2);
        Self { place: Isometry3::from_parts(Vector3::from(at).into(), turn), with: None }
    }

    /// The same on a gear that turns.
    #[must_use]
    pub fn turning_with(self, gear: usize) -> Self {
        Self { with: Some(gear), ..self }
    }

    /// Whether it stands still as it is printed, moved up or down only; then by how much.
    #[must_use]
    pub fn height_of_flat(&self) -> Option<f64> {
        let shift = self.place.translation.vector;
        let still = self.with.is_none() && self.place.rotation == UnitQuaternion::identity();
        (still && shift.x == 0.0 && shift.y == 0.0).then_some(shift.z)
    }
}

/// A hole that ends in the material, open to one side.
#[derive(Clone, Debug, PartialEq)]
pub struct Pocket {
    /// Its edge, counter-clockwise.
    pub ring: Vec<Point>,
    /// Which of the plate's holes it widens, if one.
    pub hole: Option<usize>,
    /// Height of its lower end in the fixture's frame, mm; 0: it opens downwards.
    pub from: f64,
    /// Height of its upper end; where it opens upwards the top of the material.
    pub to: f64,
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
