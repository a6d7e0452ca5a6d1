//! Gears as rigid bodies in rapier2d; only this file and `profile.rs` name it.
//!
//! Units of this world: lengths such that the module is [`policy::WORLD_MODULE`], time such that
//! the driver turns by one radian, torque such that the load is the square of the centre distance.

use super::partition::PartitionError;
use super::profile::{Profile, Touching};
use crate::geometry::{self, Point};
use crate::policy;
use parry2d_f64::shape::SharedShape;
use rapier2d_f64::dynamics::{
    CCDSolver, GenericJointBuilder, ImpulseJointSet, IntegrationParameters, IslandManager,
    JointAxesMask, JointAxis, MassProperties, MotorModel, MultibodyJointSet, RigidBodyBuilder,
    RigidBodyHandle, RigidBodySet, SoftBodySet, SpringCoefficients,
};
use rapier2d_f64::geometry::{
    BroadPhaseBvh, ColliderBuilder, ColliderHandle, ColliderSet, NarrowPhase, SolverFlags,
};
use rapier2d_f64::math::Vector;
use rapier2d_f64::pipeline::{ActiveHooks, PairFilterContext, PhysicsHooks, PhysicsPipeline};
use rayon::prelude::*;
use std::collections::HashMap;
use std::f64::consts::TAU;

/// Solver substeps of one step unless a run asks for more.
pub(super) const SUBSTEPS: usize = 4;

/// What a world is made of. Lengths mm, angles radians.
pub(super) struct WorldInput<'a> {
    /// The first is the driver.
    pub(super) gears: Vec<WorldGear<'a>>,
    /// Gears that touch, by number, the one nearer the driver first.
    pub(super) meshes: Vec<[usize; 2]>,
    pub(super) center_distance: f64,
    pub(super) module: f64,
    pub(super) friction: f64,
    /// Driver angle of one step at full speed.
    pub(super) step: f64,
    /// Largest torque of the motor over the load; without one the driver is led.
    pub(super) motor: Option<f64>,
    /// Solver substeps of one step; contacts are looked for once a step.
    pub(super) substeps: usize,
}

/// One gear of a world.
pub(super) struct WorldGear<'a> {
    pub(super) outline: &'a [Point],
    /// Place of its axis, mm; the driver's is the origin.
    pub(super) axis: Point,
    /// World rotation at the start.
    pub(super) angle: f64,
    /// Its speed at the start over the driver's, counter-clockwise positive.
    pub(super) speed: f64,
    /// Inertia times the square of the driver's speed over the load.
    pub(super) inertia: f64,
    /// Torque on it over the load, counter-clockwise positive.
    pub(super) torque: f64,
    /// The gear on whose axle it is fixed, if it has none of its own; of lesser number.
    pub(super) fixed_to: Option<usize>,
}

/// One touching point.
pub(super) struct WorldContact {
    /// World position, mm.
    pub(super) point: Point,
    /// Below zero where the gears overlap, mm.
    pub(super) distance: f64,
    /// Moment about the axis of the first gear of the mesh that the second exerts here, over the load.
    pub(super) moment: f64,
    /// Force on the second gear over the load, 1/mm.
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
    gears: Vec<RigidBodyHandle>,
    shapes: Vec<ColliderHandle>,
    meshes: Vec<[usize; 2]>,
    /// Torque on each gear, in the world's units.
    torques: Vec<f64>,
    hooks: Meshes,
    /// Rotations without wrapping.
    angles: Vec<f64>,
    /// World lengths per mm.
    scale: f64,
    load: f64,
}

impl World {
    /// # Errors
    /// The first gear without convex pieces, and why.
    pub(super) fn new(input: &WorldInput<'_>) -> Result<Self, (usize, PartitionError)> {
        let scale = policy::WORLD_MODULE / input.module;
        let distance = scale * input.center_distance;
        let load = distance * distance;
        let mut bodies = RigidBodySet::new();
        let mut colliders = ColliderSet::new();
        let mut joints = ImpulseJointSet::new();
        let profiles = input
            .gears
            .par_iter()
            .enumerate()
            .map(|(i, gear)| {
                let scaled: Vec<Point> = gear.outline.iter().map(|p| p * scale).collect();
                let tolerance = policy::HULL_TOLERANCE * policy::WORLD_MODULE;
                Profile::new(&scaled, policy::WORLD_MODULE, tolerance).map_err(|e| (i, e))
            })
            .collect::<Result<Vec<_>, _>>()?;
        let mut gears: Vec<RigidBodyHandle> = Vec::new();
        for (i, gear) in input.gears.iter().enumerate() {
            if let Some(body) = gear.fixed_to.and_then(|k| gears.get(k)).copied() {
                gears.push(body);
                continue;
            }
            let mass = MassProperties::new(Vector::new(0.0, 0.0), 1.0, gear.inertia * load);
            let body = if i == 0 && input.motor.is_none() {
                RigidBodyBuilder::kinematic_velocity_based()
            } else {
                RigidBodyBuilder::dynamic().lock_translations().additional_mass_properties(mass)
            };
            let place = gear.axis * scale;
            let body = body
                .translation(Vector::new(place.x, place.y))
                .rotation(gear.angle)
                .angvel(gear.speed)
                .can_sleep(false);
            gears.push(bodies.insert(body));
        }
        // Where every gear may touch every other nothing needs to be asked.
        let hooks = if input.gears.len() > 2 {
            ActiveHooks::FILTER_CONTACT_PAIRS
        } else {
            ActiveHooks::empty()
        };
        let shapes: Vec<ColliderHandle> = profiles
            .into_iter()
            .zip(&input.gears)
            .zip(&gears)
            .map(|((profile, gear), &body)| {
                let turned = gear.fixed_to.map_or(0.0, |k| gear.angle - input.gears[k].angle);
                let collider = ColliderBuilder::new(SharedShape::new(profile))
                    .density(0.0)
                    .friction(input.friction)
                    .restitution(0.0)
                    .rotation(turned)
                    .active_hooks(hooks);
                colliders.insert_with_parent(collider, body, &mut bodies)
            })
            .collect();
        if let Some(limit) = input.motor {
            let ground = bodies.insert(RigidBodyBuilder::fixed());
            let limit = limit * load;
            let motor = GenericJointBuilder::new(JointAxesMask::empty())
                .motor_model(JointAxis::AngX, MotorModel::ForceBased)
                .motor_velocity(JointAxis::AngX, 1.0, limit / policy::MOTOR_SLIP)
                .motor_max_force(JointAxis::AngX, limit);
            joints.insert(ground, gears[0], motor, true);
        }
        let numbers = shapes.iter().enumerate().map(|(i, &shape)| (shape, i)).collect();
        // Contacts are a quarter as stiff as a substep bears.
        let stiffness = 0.25 * input.substeps as f64 / input.step;
        let softness = SpringCoefficients::new(stiffness, 1.0);
        let parameters = IntegrationParameters {
            dt: input.step,
            contact_softness: softness,
            static_contact_softness: softness,
            normalized_prediction_distance: policy::CONTACT_PREDICTION * policy::WORLD_MODULE,
            normalized_max_corrective_velocity: policy::CORRECTIVE_SPEED,
            normalized_max_linear_velocity: f64::MAX,
            max_ccd_substeps: 0,
            contact_recycling: false,
            num_solver_iterations: input.substeps,
            ..IntegrationParameters::default()
        };
        Ok(Self {
            pipeline: PhysicsPipeline::new(),
            parameters,
            islands: IslandManager::new(),
            broad: BroadPhaseBvh::new(),
            narrow: NarrowPhase::with_query_dispatcher(Touching),
            bodies,
            colliders,
            joints,
            multibodies: MultibodyJointSet::new(),
            soft: SoftBodySet::new(),
            ccd: CCDSolver::new(),
            gears,
            shapes,
            meshes: input.meshes.clone(),
            torques: input.gears.iter().map(|g| g.torque * load).collect(),
            hooks: Meshes { numbers, meshes: input.meshes.clone() },
            angles: input.gears.iter().map(|g| g.angle).collect(),
            scale,
            load,
        })
    }

    /// One step; false when a rotation is no longer a number.
    pub(super) fn step(&mut self) -> bool {
        for (gear, &torque) in self.gears.iter().zip(&self.torques) {
            if torque != 0.0
                && let Some(body) = self.bodies.get_mut(*gear)
            {
                body.reset_torques(true);
                body.add_torque(torque, true);
            }
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
            &self.hooks,
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

    /// World rotations of the gears' bodies, radians, not wrapped.
    pub(super) fn angles(&self) -> &[f64] {
        &self.angles
    }

    /// Where the gears of a mesh touch or nearly touch after the last step.
    pub(super) fn contacts(&self, mesh: usize) -> Vec<WorldContact> {
        let Some(&[first, second]) = self.meshes.get(mesh) else { return Vec::new() };
        let Some(pair) = self.narrow.contact_pair(self.shapes[first], self.shapes[second]) else {
            return Vec::new();
        };
        let Some(rigid) = pair.rigid() else { return Vec::new() };
        let driver_first = pair.collider1 == self.shapes[first];
        let place = self.bodies.get(self.gears[first]).map(|b| *b.position());
        let turned = self.colliders.get(self.shapes[first]).and_then(|c| c.position_wrt_parent());
        let (Some(body), Some(turned)) = (place, turned) else { return Vec::new() };
        // Anchors lie in the frame of the collider, which has the body's origin.
        let pose = body * *turned;
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
                    point: (Point::new(arm.x, arm.y)
                        + geometry::Vector::new(pose.translation.x, pose.translation.y))
                        / self.scale,
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

/// Lets only gears touch that mesh.
struct Meshes {
    numbers: HashMap<ColliderHandle, usize>,
    meshes: Vec<[usize; 2]>,
}

impl PhysicsHooks for Meshes {
    fn filter_contact_pair(&self, context: &PairFilterContext<'_>) -> Option<SolverFlags> {
        let number = |handle| self.numbers.get(handle).copied();
        let (a, b) = (number(&context.collider1)?, number(&context.collider2)?);
        let meshing = self.meshes.iter().any(|m| *m == [a, b] || *m == [b, a]);
        meshing.then_some(SolverFlags::COMPUTE_RIGID_IMPULSES)
    }
}
