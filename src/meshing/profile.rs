//! The surface of a gear as a collision shape, and how two of them touch.
//!
//! rapier's own treatment of compound shapes looks at every piece of one gear that lies in the box of the other, which
//! is half of the gear, at every step. Here a tree of circles over the pieces, which follow each other along the
//! outline, leads straight to the few pieces that are near each other, and only those that touch are handed on.

use super::band::surface_band;
use super::partition::PartitionError;
use super::surface::Surface;
use crate::geometry::{self, Point};
use parry2d_f64::bounding_volume::{Aabb, BoundingSphere};
use parry2d_f64::mass_properties::MassProperties;
use parry2d_f64::query::details::{NormalConstraints, ShapeCastOptions, contact_manifold_pfm_pfm};
use parry2d_f64::query::{
    ClosestPoints, Contact, ContactManifold, ContactManifoldsWorkspace, NonlinearRigidMotion,
    PersistentQueryDispatcher, PointProjection, PointQuery, QueryDispatcher, Ray, RayCast,
    RayIntersection, ShapeCastHit, ShapeDistance, ShapeIntersection, TypedWorkspaceData,
    Unsupported, WorkspaceData,
};
use parry2d_f64::shape::{ConvexPolygon, FeatureId, Shape, ShapeType, TypedShape};
use rapier2d_f64::geometry::{ContactData, ContactManifoldData};
use rapier2d_f64::math::{Pose, Vector};

type Manifold = ContactManifold<ContactManifoldData, ContactData>;

/// The surface of a gear, in world lengths.
#[derive(Clone)]
pub(super) struct Profile {
    pieces: Vec<ConvexPolygon>,
    /// Centre and radius of a circle round each piece.
    round: Vec<(Vector, f64)>,
    /// The first is the root.
    circles: Vec<Circle>,
    surface: Surface,
    bounds: Aabb,
}

/// A circle round some consecutive pieces.
#[derive(Clone, Copy)]
struct Circle {
    center: Vector,
    radius: f64,
    holds: Holds,
}

#[derive(Clone, Copy)]
enum Holds {
    Piece(u32),
    /// Two circles, by number.
    Halves([u32; 2]),
}

impl Profile {
    /// The outline and its module in world lengths.
    ///
    /// # Errors
    /// See [`PartitionError`].
    pub(super) fn new(
        outline: &[Point],
        module: f64,
        hull_tolerance: f64,
    ) -> Result<Self, PartitionError> {
        let band = surface_band(outline, module, hull_tolerance)?;
        let (points, pieces): (Vec<Vec<Point>>, Vec<ConvexPolygon>) = band
            .into_iter()
            .filter_map(|points| {
                let corners = points.iter().map(|p| Vector::new(p.x, p.y)).collect();
                Some((points, ConvexPolygon::from_convex_polyline_unmodified(corners)?))
            })
            .unzip();
        if pieces.is_empty() {
            return Err(PartitionError::NoArea);
        }
        let mut circles = Vec::with_capacity(2 * pieces.len());
        enclose(&points, 0, &mut circles);
        let mut round = vec![(Vector::ZERO, 0.0); pieces.len()];
        for circle in &circles {
            if let Holds::Piece(piece) = circle.holds {
                round[piece as usize] = (circle.center, circle.radius);
            }
        }
        let (low, high) = geometry::bounds(outline);
        let bounds = Aabb::new(Vector::new(low.x, low.y), Vector::new(high.x, high.y));
        Ok(Self { pieces, round, circles, surface: Surface::new(outline, module), bounds })
    }

    /// Pieces of this gear and of another, which stands at `pose` in this one's frame, whose circles come within
    /// `distance` of each other.
    fn pairs_near(
        &self,
        other: &Self,
        pose: &Pose,
        distance: f64,
        stack: &mut Vec<[u32; 2]>,
        found: &mut Vec<[u32; 2]>,
    ) {
        stack.clear();
        found.clear();
        stack.push([0, 0]);
        while let Some([a, b]) = stack.pop() {
            let (one, two) = (&self.circles[a as usize], &other.circles[b as usize]);
            let apart = pose.transform_point(two.center) - one.center;
            let reach = one.radius + two.radius + distance;
            // Written so that a pose that is no number is near nothing.
            let near = apart.length_squared() <= reach * reach;
            if !near {
                continue;
            }
            match (one.holds, two.holds) {
                (Holds::Piece(i), Holds::Piece(k)) => found.push([i, k]),
                (Holds::Halves(halves), Holds::Piece(_)) => {
                    stack.extend(halves.map(|half| [half, b]));
                }
                (Holds::Halves(halves), Holds::Halves(_)) if one.radius > two.radius => {
                    stack.extend(halves.map(|half| [half, b]));
                }
                (_, Holds::Halves(halves)) => stack.extend(halves.map(|half| [a, half])),
            }
        }
    }

    /// Whether the outline near a point of it faces that way.
    fn faces(&self, at: Vector, normal: Vector) -> bool {
        self.surface.faces(Point::new(at.x, at.y), geometry::Vector::new(normal.x, normal.y))
    }
}

/// Adds the circle round `pieces`, the first of which has the number `first`, and those within it; its number.
fn enclose(pieces: &[Vec<Point>], first: usize, circles: &mut Vec<Circle>) -> u32 {
    let all = || pieces.iter().flatten();
    let (low, high) = all().fold(([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]), |(l, h), p| {
        ([l[0].min(p.x), l[1].min(p.y)], [h[0].max(p.x), h[1].max(p.y)])
    });
    let center = Vector::new(0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]));
    let radius = all().map(|p| (Vector::new(p.x, p.y) - center).length()).fold(0.0, f64::max);
    let number = circles.len();
    circles.push(Circle { center, radius, holds: Holds::Piece(first as u32) });
    if pieces.len() > 1 {
        let (left, right) = pieces.split_at(pieces.len() / 2);
        let halves = [enclose(left, first, circles), enclose(right, first + left.len(), circles)];
        circles[number].holds = Holds::Halves(halves);
    }
    number as u32
}

/// Finds where two [`Profile`]s touch. Contacts with the inner sides of pieces are left out.
pub(super) struct Touching;

/// What is kept of a pair of gears from step to step.
#[derive(Clone, Default)]
struct Kept {
    stack: Vec<[u32; 2]>,
    near: Vec<[u32; 2]>,
    /// Pieces near each other that do not touch, in the order in which they were found.
    apart: Vec<Apart>,
    apart_before: Vec<Apart>,
    manifolds_before: Vec<Manifold>,
}

/// Two pieces that were apart when they were last looked at.
#[derive(Clone, Copy)]
struct Apart {
    pieces: [u32; 2],
    /// Along which they were apart, in the frame of the first.
    direction: Vector,
    /// How far the second stood away beyond the distance at which contacts are prepared.
    spare: f64,
    /// Where it stood in the frame of the first.
    pose: Pose,
}

impl Apart {
    /// Whether no point of the second piece, which lies in a circle, can have come near since.
    fn still(&self, pose: &Pose, (center, radius): (Vector, f64)) -> bool {
        let moved = pose.transform_point(center) - self.pose.transform_point(center);
        let (now, then) = (pose.rotation * Vector::X, self.pose.rotation * Vector::X);
        moved.length() + radius * (now - then).length() < self.spare
    }
}

/// Distance of two convex pieces along a direction in the frame of the first, the second at `pose` in it.
fn separation(one: &ConvexPolygon, two: &ConvexPolygon, pose: &Pose, direction: Vector) -> f64 {
    let within = pose.rotation.inverse() * direction;
    let far = one.points().iter().map(|p| p.dot(direction)).fold(f64::NEG_INFINITY, f64::max);
    let near = two.points().iter().map(|p| p.dot(within)).fold(f64::INFINITY, f64::min);
    near + pose.translation.dot(direction) - far
}

fn bare([a, b]: [u32; 2]) -> Manifold {
    ContactManifold::with_data(a, b, ContactManifoldData::default())
}

impl WorkspaceData for Kept {
    fn as_typed_workspace_data(&self) -> TypedWorkspaceData<'_> {
        TypedWorkspaceData::Custom
    }

    fn clone_dyn(&self) -> Box<dyn WorkspaceData> {
        Box::new(self.clone())
    }
}

impl PersistentQueryDispatcher<ContactManifoldData, ContactData> for Touching {
    fn contact_manifolds(
        &self,
        pose: &Pose,
        first: &dyn Shape,
        second: &dyn Shape,
        prediction: f64,
        manifolds: &mut Vec<Manifold>,
        workspace: &mut Option<ContactManifoldsWorkspace>,
    ) -> Result<(), Unsupported> {
        let (Some(first), Some(second)) =
            (first.as_shape::<Profile>(), second.as_shape::<Profile>())
        else {
            return Err(Unsupported);
        };
        let kept = workspace.get_or_insert_with(|| Kept::default().into());
        let Some(kept) = kept.0.downcast_mut::<Kept>() else { return Err(Unsupported) };
        std::mem::swap(&mut kept.manifolds_before, manifolds);
        std::mem::swap(&mut kept.apart_before, &mut kept.apart);
        manifolds.clear();
        kept.apart.clear();
        first.pairs_near(second, pose, prediction, &mut kept.stack, &mut kept.near);
        // Pairs come in nearly the same order at every step: each is looked for from where the last one was found.
        let mut expected = 0;
        for &pieces in &kept.near {
            let [a, b] = pieces;
            let (one, two) = (&first.pieces[a as usize], &second.pieces[b as usize]);
            let known = &kept.apart_before;
            let place = (expected..known.len())
                .chain(0..expected.min(known.len()))
                .find(|&i| known[i].pieces == pieces);
            let mut manifold = if let Some(place) = place {
                expected = place + 1;
                if known[place].still(pose, second.round[b as usize]) {
                    kept.apart.push(known[place]);
                    continue;
                }
                let direction = known[place].direction;
                let spare = separation(one, two, pose, direction) - prediction;
                if spare > 0.0 {
                    kept.apart.push(Apart { pieces, direction, spare, pose: *pose });
                    continue;
                }
                Manifold { local_n1: known[place].direction, ..bare(pieces) }
            } else {
                let touched =
                    kept.manifolds_before.iter_mut().find(|m| [m.subshape1, m.subshape2] == pieces);
                touched.map_or_else(|| bare(pieces), std::mem::take)
            };
            contact_manifold_pfm_pfm(
                pose,
                one,
                0.0,
                None,
                two,
                0.0,
                None,
                prediction,
                &mut manifold,
            );
            let count = manifold.points.len();
            if count == 0 {
                let direction = manifold.local_n1;
                kept.apart.push(Apart { pieces, direction, spare: 0.0, pose: *pose });
                continue;
            }
            let normals = (manifold.local_n1, pose.rotation.inverse() * -manifold.local_n1);
            manifold.points.retain(|p| {
                first.faces(p.local_p1, normals.0) && second.faces(p.local_p2, normals.1)
            });
            if manifold.points.is_empty() {
                continue;
            }
            if manifold.points.len() < count {
                // The point that was left out may be a true one at the next step.
                manifold.mark_shapes_deformed();
            }
            manifolds.push(manifold);
        }
        Ok(())
    }

    fn contact_manifold_convex_convex(
        &self,
        _: &Pose,
        _: &dyn Shape,
        _: &dyn Shape,
        _: Option<&dyn NormalConstraints>,
        _: Option<&dyn NormalConstraints>,
        _: f64,
        _: &mut Manifold,
    ) -> Result<(), Unsupported> {
        Err(Unsupported)
    }
}

/// Nothing but contacts is ever asked for.
impl QueryDispatcher for Touching {
    fn intersection_test(
        &self,
        _: &Pose,
        _: &dyn Shape,
        _: &dyn Shape,
    ) -> Result<ShapeIntersection, Unsupported> {
        Err(Unsupported)
    }

    fn distance(
        &self,
        _: &Pose,
        _: &dyn Shape,
        _: &dyn Shape,
    ) -> Result<ShapeDistance, Unsupported> {
        Err(Unsupported)
    }

    fn contact(
        &self,
        _: &Pose,
        _: &dyn Shape,
        _: &dyn Shape,
        _: f64,
    ) -> Result<Option<Contact>, Unsupported> {
        Err(Unsupported)
    }

    fn closest_points(
        &self,
        _: &Pose,
        _: &dyn Shape,
        _: &dyn Shape,
        _: f64,
    ) -> Result<ClosestPoints, Unsupported> {
        Err(Unsupported)
    }

    fn cast_shapes(
        &self,
        _: &Pose,
        _: Vector,
        _: &dyn Shape,
        _: &dyn Shape,
        _: ShapeCastOptions,
    ) -> Result<Option<ShapeCastHit>, Unsupported> {
        Err(Unsupported)
    }

    fn cast_shapes_nonlinear(
        &self,
        _: &NonlinearRigidMotion,
        _: &dyn Shape,
        _: &NonlinearRigidMotion,
        _: &dyn Shape,
        _: f64,
        _: f64,
        _: bool,
    ) -> Result<Option<ShapeCastHit>, Unsupported> {
        Err(Unsupported)
    }
}

/// As a shape it is its box: gears are given their masses, and nothing but contacts is asked for.
impl Shape for Profile {
    fn compute_local_aabb(&self) -> Aabb {
        self.bounds
    }

    fn compute_local_bounding_sphere(&self) -> BoundingSphere {
        self.bounds.bounding_sphere()
    }

    fn clone_dyn(&self) -> Box<dyn Shape> {
        Box::new(self.clone())
    }

    fn scale_dyn(&self, _: Vector, _: u32) -> Option<Box<dyn Shape>> {
        None
    }

    fn mass_properties(&self, _: f64) -> MassProperties {
        MassProperties::default()
    }

    fn shape_type(&self) -> ShapeType {
        ShapeType::Custom
    }

    fn as_typed_shape(&self) -> TypedShape<'_> {
        TypedShape::Custom(self)
    }

    fn ccd_thickness(&self) -> f64 {
        self.bounds.half_extents().min_element()
    }

    fn ccd_angular_thickness(&self) -> f64 {
        std::f64::consts::PI
    }
}

impl RayCast for Profile {
    fn cast_local_ray_and_get_normal(
        &self,
        ray: &Ray,
        most: f64,
        solid: bool,
    ) -> Option<RayIntersection> {
        self.bounds.cast_local_ray_and_get_normal(ray, most, solid)
    }
}

impl PointQuery for Profile {
    fn project_local_point(&self, point: Vector, solid: bool) -> PointProjection {
        self.bounds.project_local_point(point, solid)
    }

    fn project_local_point_and_get_feature(&self, point: Vector) -> (PointProjection, FeatureId) {
        self.bounds.project_local_point_and_get_feature(point)
    }
}
