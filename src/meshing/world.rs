//! Two gears as rigid bodies in rapier2d; the only file that names it.
//!
//! Units of this world: lengths such that the module is [`policy::WORLD_MODULE`], time such that
//! the driver turns by one radian, torque such that the load is the square of the centre distance.

use super::partition::{PartitionError, convex_partition};
use super::surface::Surface;
use crate::geometry::{self, Point};
use crate::policy;
use parry2d_f64::shape::SharedShape;
use rapier2d_f64::dynamics::{
    CCDSolver, GenericJointBuilder, ImpulseJointSet, IntegrationParameters, IslandManager,
    JointAxesMask, JointAxis, MassProperties, MotorModel, MultibodyJointSet, RigidBodyBuilder,
    RigidBodyHandle, RigidBodySet, SoftBodySet, SpringCoefficients,
};
use rapier2d_f64::geometry::{
    BroadPhaseBvh, ColliderBuilder, ColliderHandle, ColliderSet, NarrowPhase,
};
use rapier2d_f64::math::{Pose, Vector};
use rapier2d_f64::pipeline::{
    ActiveHooks, ContactModificationContext, PhysicsHooks, PhysicsPipeline,
};
use std::f64::consts::TAU;

/// What a world is made of. Lengths mm, angles radians.
pub(super) struct WorldInput<'a> {
    pub(super) outlines: [&'a [Point]; 2],
    pub(super) center_distance: f64,
    pub(super) module: f64,
    /// World rotations at the start.
    pub(super) angles: [f64; 2],
    /// The follower's speed at the start over the driver's; negative, as it turns the other way.
    pub(super) follower_speed: f64,
    /// Inertia of the follower times the square of the driver's speed over the load.
    pub(super) inertia: f64,
    pub(super) friction: f64,
    /// Driver angle of one step at full speed.
    pub(super) step: f64,
    /// Largest torque of the motor over the load; without one the driver is led.
    pub(super) motor: Option<f64>,
}

/// One touching point.
pub(super) struct WorldContact {
    /// World position, mm.
    pub(super) point: Point,
    /// Below zero where the gears overlap, mm.
    pub(super) distance: f64,
    /// Moment about the driver's axis that the follower exerts here, over the load.
    pub(super) moment: f64,
    /// Force on the follower over the load, 1/mm.
    pub(super) force: geometry::Vector,
    /// Whether it carries load.
    pub(super) loaded: bool,
}

pub(super) struct World {
    pipeline: PhysicsPipeline,
    parameters: IntegrationParameters,
    islands: IslandManager,
    broad: BroadPhaseBvh,
    narrow: NarrowPhase,
    bodies: RigidBodySet,
    colliders: ColliderSet,
    joints: ImpulseJointSet,
    multibodies: MultibodyJointSet,
    soft: SoftBodySet,
    ccd: CCDSolver,
    gears: [RigidBodyHandle; 2],
    shapes: [ColliderHandle; 2],
    surfaces: Surfaces,
    /// Rotations without wrapping.
    angles: [f64; 2],
    /// World lengths per mm.
    scale: f64,
    load: f64,
}

impl World {
    pub(super) fn new(input: &WorldInput<'_>) -> Result<Self, [Option<PartitionError>; 2]> {
        let scale = policy::WORLD_MODULE / input.module;
        let distance = scale * input.center_distance;
        let load = distance * distance;
        let shapes = input.outlines.map(|outline| compound(outline, scale));
        let [driver_shape, follower_shape] = match shapes {
            [Ok(a), Ok(b)] => [a, b],
            failed => return Err(failed.map(Result::err)),
        };
        let mass = MassProperties::new(Vector::new(0.0, 0.0), 1.0, input.inertia * load);
        let driver = if input.motor.is_some() {
            RigidBodyBuilder::dynamic().lock_translations().additional_mass_properties(mass)
        } else {
            RigidBodyBuilder::kinematic_velocity_based()
        };
        let driver = driver.rotation(input.angles[0]).angvel(1.0).can_sleep(false);
        let follower = RigidBodyBuilder::dynamic()
            .translation(Vector::new(distance, 0.0))
            .rotation(input.angles[1])
            .angvel(input.follower_speed)
            .lock_translations()
            .additional_mass_properties(mass)
            .can_sleep(false);
        let mut bodies = RigidBodySet::new();
        let mut colliders = ColliderSet::new();
        let mut joints = ImpulseJointSet::new();
        let gears = [bodies.insert(driver), bodies.insert(follower)];
        let collider = |shape: SharedShape| {
            ColliderBuilder::new(shape)
                .density(0.0)
                .friction(input.friction)
                .restitution(0.0)
                .active_hooks(ActiveHooks::MODIFY_SOLVER_CONTACTS)
        };
        let shapes = [
            colliders.insert_with_parent(collider(driver_shape), gears[0], &mut bodies),
            colliders.insert_with_parent(collider(follower_shape), gears[1], &mut bodies),
        ];
        if let Some(limit) = input.motor {
            let ground = bodies.insert(RigidBodyBuilder::fixed());
            let limit = limit * load;
            let motor = GenericJointBuilder::new(JointAxesMask::empty())
                .motor_model(JointAxis::AngX, MotorModel::ForceBased)
                .motor_velocity(JointAxis::AngX, 1.0, limit / policy::MOTOR_SLIP)
                .motor_max_force(JointAxis::AngX, limit);
            joints.insert(ground, gears[0], motor, true);
        }
        let surfaces = Surfaces {
            driver: shapes[0],
            surfaces: input.outlines.map(|outline| {
                let scaled: Vec<Point> = outline.iter().map(|p| p * scale).collect();
                Surface::new(&scaled, policy::WORLD_MODULE)
            }),
        };
        let softness = SpringCoefficients::new(1.0 / input.step, 1.0);
        let parameters = IntegrationParameters {
            dt: input.step,
            contact_softness: softness,
            static_contact_softness: softness,
            normalized_prediction_distance: policy::CONTACT_PREDICTION * policy::WORLD_MODULE,
            normalized_max_corrective_velocity: policy::CORRECTIVE_SPEED,
            normalized_max_linear_velocity: f64::MAX,
            max_ccd_substeps: 0,
            contact_recycling: false,
            ..IntegrationParameters::default()
        };
        Ok(Self {
            pipeline: PhysicsPipeline::new(),
            parameters,
            islands: IslandManager::new(),
            broad: BroadPhaseBvh::new(),
            narrow: NarrowPhase::new(),
            bodies,
            colliders,
            joints,
            multibodies: MultibodyJointSet::new(),
            soft: SoftBodySet::new(),
            ccd: CCDSolver::new(),
            gears,
            shapes,
            surfaces,
            angles: input.angles,
            scale,
            load,
        })
    }

    /// One step; false when a rotation is no longer a number.
    pub(super) fn step(&mut self) -> bool {
        if let Some(follower) = self.bodies.get_mut(self.gears[1]) {
            follower.reset_torques(true);
            // The follower turns clockwise; the load holds it back.
            follower.add_torque(self.load, true);
        }
        self.pipeline.step(
            Vector::new(0.0, 0.0),
            &self.parameters,
            &mut self.islands,
            &mut self.broad,
            &mut self.narrow,
            &mut self.bodies,
            &mut self.colliders,
            &mut self.joints,
            &mut self.multibodies,
            &mut self.soft,
            &mut self.ccd,
            &self.surfaces,
            &(),
        );
        for (gear, angle) in self.gears.iter().zip(&mut self.angles) {
            let Some(body) = self.bodies.get(*gear) else { return false };
            let turn = body.rotation().angle() - *angle;
            *angle += turn - TAU * (turn / TAU).round();
            if !angle.is_finite() {
                return false;
            }
        }
        true
    }

    /// World rotations of driver and follower, radians, not wrapped.
    pub(super) fn angles(&self) -> [f64; 2] {
        self.angles
    }

    /// Where the gears touch or nearly touch after the last step.
    pub(super) fn contacts(&self) -> Vec<WorldContact> {
        let Some(pair) = self.narrow.contact_pair(self.shapes[0], self.shapes[1]) else {
            return Vec::new();
        };
        let Some(rigid) = pair.rigid() else { return Vec::new() };
        let driver_first = pair.collider1 == self.shapes[0];
        let Some(pose) = self.bodies.get(self.gears[0]).map(|b| *b.position()) else {
            return Vec::new();
        };
        // From the driver's impulse to the follower's force, over the load and per mm.
        let unit = -self.scale / (self.parameters.dt * self.load);
        let mut found = Vec::new();
        for manifold in rigid.solver_manifolds() {
            let push = -manifold.data.normal;
            let tangent = Vector::new(-push.y, push.x);
            let sign = if driver_first { 1.0 } else { -1.0 };
            for contact in &manifold.data.solver_contacts {
                let id = (contact.contact_id[0] & !(1 << 31)) as usize;
                let Some(data) = manifold.points.get(id).map(|p| &p.data) else { continue };
                let anchor = if driver_first { contact.anchor1 } else { contact.anchor2 };
                let arm = pose.rotation * anchor;
                let impulse = (push * data.impulse + tangent * data.tangent_impulse.x) * sign;
                let moment = (arm.x * impulse.y - arm.y * impulse.x) / self.parameters.dt;
                found.push(WorldContact {
                    point: Point::new(arm.x, arm.y) / self.scale,
                    distance: contact.dist / self.scale,
                    moment: moment / self.load,
                    force: geometry::Vector::new(impulse.x, impulse.y) * unit,
                    loaded: data.impulse > 0.0,
                });
            }
        }
        found
    }
}

/// Takes away the contacts with the inner sides of convex pieces.
struct Surfaces {
    driver: ColliderHandle,
    /// Of driver and follower, in world lengths.
    surfaces: [Surface; 2],
}

impl PhysicsHooks for Surfaces {
    fn modify_solver_contacts(&self, context: &mut ContactModificationContext<'_>) {
        let [first, second] = if context.collider1 == self.driver { [0, 1] } else { [1, 0] }
            .map(|i| &self.surfaces[i]);
        let poses = [context.rigid_body1, context.rigid_body2]
            .map(|body| body.and_then(|b| context.bodies.get(b)).map(|b| *b.position()));
        let [Some(one), Some(two)] = poses else { return };
        let Some(rigid) = context.rigid_mut() else { return };
        let normal = *rigid.normal;
        let faces = |surface: &Surface, pose: &Pose, at: Vector, normal: Vector| {
            let at = pose.inverse_transform_point(at);
            let normal = pose.rotation.inverse() * normal;
            surface.faces(Point::new(at.x, at.y), geometry::Vector::new(normal.x, normal.y))
        };
        rigid.solver_contacts.retain(|contact| {
            faces(first, &one, contact.anchor1, normal)
                && faces(second, &two, contact.anchor2, -normal)
        });
    }
}

fn compound(outline: &[Point], scale: f64) -> Result<SharedShape, PartitionError> {
    let scaled: Vec<Point> = outline.iter().map(|p| p * scale).collect();
    let pieces = convex_partition(&scaled, policy::HULL_TOLERANCE * policy::WORLD_MODULE)?;
    let parts: Vec<(Pose, SharedShape)> = pieces
        .into_iter()
        .filter_map(|piece| {
            let points = piece.iter().map(|p| Vector::new(p.x, p.y)).collect();
            SharedShape::convex_polyline_unmodified(points)
        })
        .map(|shape| (Pose::IDENTITY, shape))
        .collect();
    if parts.is_empty() {
        return Err(PartitionError::NoArea);
    }
    Ok(SharedShape::compound(parts))
}
