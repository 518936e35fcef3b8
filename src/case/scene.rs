//! Scenes: one runnable problem with nothing left to resolve (docs/formats.md).

mod duration;
mod mirror;
mod specification;
mod supported;
mod valid;

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

pub use mirror::{Mirror, Start};

use super::model::{Damping, ForceCut, MomentLaw, NormalLaw, TangentialLaw};
use super::protocol::{Motion, Shape};
use super::quantity::{Kind, Number, Quantity};
use super::schema::{Boundary, Case, Level};
use super::source::ParticleSource;
use crate::Vector;
use crate::bodies::Body;
use crate::error::Problem;
use crate::geometry::{self, ContactGeometry};
use crate::laws::PairLaw;
use crate::material::{self, Material, PairProperties};

/// The version of the scene format.
pub const SCHEMA: u32 = 1;

/// One runnable problem.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "docs/formats.md describes every field")]
pub struct Scene {
    pub schema: u32,
    pub case: String,
    pub variant: String,
    pub seed: Option<u64>,
    pub refinement: u32,
    pub level: Level,
    pub time_step: f64,
    pub steps: u64,
    pub output_every: u64,
    pub gravity: [f64; 3],
    pub domain: SceneDomain,
    pub materials: Vec<Material>,
    pub pairs: Vec<PairProperties>,
    pub model: SceneModel,
    pub mirror: Mirror,
    pub bodies: Vec<SceneBody>,
    pub particles: Vec<SceneParticle>,
}

/// The box of a scene [m].
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "docs/formats.md describes every field")]
pub struct SceneDomain {
    pub min: [f64; 3],
    pub max: [f64; 3],
    pub boundary: [Boundary; 3],
}

/// The contact model of a scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "docs/formats.md describes every field")]
pub struct SceneModel {
    pub normal: NormalLaw,
    #[serde(default = "frictionless", skip_serializing_if = "is_frictionless")]
    pub tangential: TangentialLaw,
    #[serde(default = "free", skip_serializing_if = "is_free")]
    pub moments: MomentLaw,
}

const fn frictionless() -> TangentialLaw {
    TangentialLaw::Frictionless {}
}

fn is_frictionless(law: &TangentialLaw) -> bool {
    matches!(law, TangentialLaw::Frictionless {})
}

const fn free() -> MomentLaw {
    MomentLaw::Free {}
}

fn is_free(law: &MomentLaw) -> bool {
    matches!(law, MomentLaw::Free {})
}

/// A wall of a scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "docs/formats.md describes every field")]
pub struct SceneBody {
    pub name: String,
    pub material: usize,
    pub shape: SceneShape,
    pub motion: SceneMotion,
}

/// Shape of a wall [m].
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "docs/formats.md describes every field")]
pub enum SceneShape {
    Plane { point: [f64; 3], normal: [f64; 3] },
    Cylinder { point: [f64; 3], axis: [f64; 3], radius: f64 },
}

/// Motion of a wall [m/s].
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "docs/formats.md describes every field")]
pub enum SceneMotion {
    Fixed,
    Prescribed { velocity: [f64; 3] },
}

/// A particle at the start.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "docs/formats.md describes every field")]
pub struct SceneParticle {
    pub material: usize,
    pub radius: f64,
    pub mass: f64,
    pub moment_of_inertia: f64,
    pub position: [f64; 3],
    pub velocity: [f64; 3],
    pub angular_velocity: [f64; 3],
}

impl Scene {
    /// `case/variant`.
    #[must_use]
    pub fn name(&self) -> String {
        if self.variant.is_empty() { self.case.clone() } else { format!("{}/{}", self.case, self.variant) }
    }

    /// The pair of two materials, if it is stated.
    #[must_use]
    pub fn pair(&self, first: usize, second: usize) -> Option<&PairProperties> {
        self.pairs.iter().find(|pair| pair.between == [first, second] || pair.between == [second, first])
    }
}

fn si<K: Kind, const N: usize>(values: &[Quantity<K>; N]) -> [f64; N] {
    values.map(Quantity::si)
}

/// Resolves one variant into a scene whose time step is divided by 2^`refinement`.
///
/// # Errors
/// The case asks for what this build does not compute, or its start state or time step is not allowed.
pub fn prepare(case: &Case, variant: &str, refinement: u32) -> Result<Scene, Problem> {
    supported::supported(case)?;
    let mut scene = Scene {
        schema: SCHEMA,
        case: case.name.clone(),
        variant: variant.to_owned(),
        seed: None,
        refinement,
        level: case.level,
        time_step: 0.0,
        steps: 0,
        output_every: case.output.every << refinement,
        gravity: si(&case.gravity),
        domain: SceneDomain { min: si(&case.domain.min), max: si(&case.domain.max), boundary: case.domain.boundary },
        materials: case.materials.iter().map(solid).collect(),
        pairs: Vec::new(),
        model: SceneModel {
            normal: case.model.normal.clone(),
            tangential: case.model.tangential.clone(),
            moments: case.model.moments.clone(),
        },
        mirror: Mirror::default(),
        bodies: Vec::new(),
        particles: Vec::new(),
    };
    scene.pairs = pairs(case, &scene.materials);
    scene.bodies = bodies(case);
    scene.particles = case.particles.iter().filter_map(|source| single(case, source)).collect();
    weighable(&scene)?;
    drop_unused_materials(&mut scene);
    let laws = scene.model.specification(&scene.mirror)?;
    let approaches = approaches(case, &scene)?;
    duration::steps(case, &mut scene, &laws.normal, &approaches)?;
    duration::travel(&scene)?;
    Ok(scene)
}

fn solid(material: &super::schema::Material) -> Material {
    Material {
        name: material.name.clone(),
        rigid: material.rigid,
        young: material.young.map(Quantity::si),
        poisson: material.poisson.map(Number::get),
        density: material.density.map(Quantity::si),
    }
}

/// A scene states the materials that it uses and no others: a sweep over materials leaves one at each point.
fn drop_unused_materials(scene: &mut Scene) {
    let used: Vec<bool> = (0..scene.materials.len())
        .map(|index| {
            scene.particles.iter().any(|particle| particle.material == index)
                || scene.bodies.iter().any(|body| body.material == index)
        })
        .collect();
    let renumbered = |index: usize| used[..index].iter().filter(|used| **used).count();
    scene.pairs.retain(|pair| pair.between.iter().all(|index| used[*index]));
    for pair in &mut scene.pairs {
        pair.between = pair.between.map(renumbered);
    }
    for particle in &mut scene.particles {
        particle.material = renumbered(particle.material);
    }
    for body in &mut scene.bodies {
        body.material = renumbered(body.material);
    }
    let mut keep = used.iter();
    scene.materials.retain(|_| keep.next().copied().unwrap_or_default());
}

fn index(case: &Case, name: &str) -> usize {
    // Names were checked before: an unknown one never comes here.
    case.materials.iter().position(|material| material.name == name).unwrap_or_default()
}

fn pairs(case: &Case, materials: &[Material]) -> Vec<PairProperties> {
    let mixed = |pair: &super::schema::Pair| {
        let between = [index(case, &pair.between[0]), index(case, &pair.between[1])];
        let [first, second] = between.map(|at| &materials[at]);
        let (damping_ratio, restitution) = match &pair.values.damping {
            Some(Damping::Restitution { value }) => (material::damping_ratio(value.get()), Some(value.get())),
            Some(Damping::Ratio { value }) => (value.get(), None),
            Some(Damping::None {}) | None => (0.0, None),
        };
        let shear = material::effective_shear(first, second);
        PairProperties {
            between,
            effective_young: material::effective_young(first, second),
            effective_shear: shear.is_finite().then_some(shear),
            damping_ratio,
            restitution,
            friction: pair.values.friction.map(Number::get),
            rolling_friction: pair.values.rolling_friction.map(Number::get),
            twisting_friction: pair.values.twisting_friction.map(Number::get),
            work_of_adhesion: pair.values.work_of_adhesion.map(Quantity::si),
        }
    };
    case.pairs.iter().map(mixed).collect()
}

fn bodies(case: &Case) -> Vec<SceneBody> {
    let mut scene = Vec::new();
    for body in &case.bodies {
        let unit = |direction: &[Number; 3]| Vector::from(direction.map(Number::get)).normalize().into();
        let shape = match &body.shape {
            Shape::Plane { point, normal } => SceneShape::Plane { point: si(point), normal: unit(normal) },
            Shape::Cylinder { point, axis, radius } => {
                SceneShape::Cylinder { point: si(point), axis: unit(axis), radius: radius.si() }
            }
            Shape::Mesh { .. } => continue,
        };
        scene.push(SceneBody {
            name: body.name.clone(),
            material: index(case, &body.material),
            shape,
            motion: match &body.motion {
                Motion::Prescribed { velocity } => SceneMotion::Prescribed { velocity: si(velocity) },
                _ => SceneMotion::Fixed,
            },
        });
    }
    scene
}

fn single(case: &Case, source: &ParticleSource) -> Option<SceneParticle> {
    let ParticleSource::Single { material, radius, position, velocity, angular_velocity } = source else { return None };
    let material = index(case, material);
    let radius = radius.si();
    let mass = case.materials[material].density?.si() * (4.0 / 3.0 * PI * radius * radius * radius);
    Some(SceneParticle {
        material,
        radius,
        mass,
        moment_of_inertia: 0.4 * mass * radius * radius,
        position: si(position),
        velocity: si(velocity),
        angular_velocity: si(angular_velocity),
    })
}

/// A mass or a moment of inertia that underflows or overflows leaves the engine without an acceleration.
fn weighable(scene: &Scene) -> Result<(), Problem> {
    for (i, particle) in scene.particles.iter().enumerate() {
        if !(particle.mass.is_normal() && particle.moment_of_inertia.is_normal()) {
            return Err(Problem::new(
                format!("particles.{i}.radius"),
                format!("{:e} m", particle.radius),
                format!(
                    "gives a mass of {:e} kg and a moment of inertia of {:e} kg m2; both must be positive normal numbers",
                    particle.mass, particle.moment_of_inertia
                ),
            ));
        }
    }
    Ok(())
}

/// A pair of bodies that moves together at the start: the law's view of it and its speed [m/s].
struct StartApproach {
    law: PairLaw,
    speed: f64,
}

/// Every pair that approaches at the start; refuses overlaps that the case does not permit.
fn approaches(case: &Case, scene: &Scene) -> Result<Vec<StartApproach>, Problem> {
    let mut found = Vec::new();
    let mut add =
        |key: String, what: &str, geometry: ContactGeometry, mass: f64, materials: [usize; 2], velocity: Vector| {
            if geometry.overlap > 0.0 && !case.allow_initial_overlap {
                return Err(Problem::new(
                    key,
                    format!("overlap of {:e} m with {what}", geometry.overlap),
                    "particles start apart, unless allow_initial_overlap = true",
                ));
            }
            let speed = -velocity.dot(&geometry.normal);
            if let (true, Some(pair)) = (speed > 0.0, scene.pair(materials[0], materials[1])) {
                found.push(StartApproach { law: pair.law(geometry.effective_radius(), mass), speed });
            }
            Ok(())
        };
    for (i, one) in scene.particles.iter().enumerate() {
        let key = format!("particles.{i}.position");
        let (center, velocity) = (Vector::from(one.position), Vector::from(one.velocity));
        for (j, other) in scene.particles.iter().enumerate().take(i) {
            let Some(geometry) = geometry::sphere_sphere(center, one.radius, other.position.into(), other.radius)
            else {
                return Err(Problem::new(
                    key,
                    format!("{:?}", one.position),
                    format!("particle {j} is at the same place; two centres differ"),
                ));
            };
            let mass = material::reduced(one.mass, other.mass);
            add(
                key.clone(),
                &format!("particle {j}"),
                geometry,
                mass,
                [one.material, other.material],
                velocity - Vector::from(other.velocity),
            )?;
        }
        for body in &scene.bodies {
            let Some(geometry) = Body::new(body).geometry(center, one.radius) else { continue };
            let wall = match &body.motion {
                SceneMotion::Prescribed { velocity } => Vector::from(*velocity),
                SceneMotion::Fixed => Vector::zeros(),
            };
            add(
                key.clone(),
                &format!("body {}", body.name),
                geometry,
                one.mass,
                [one.material, body.material],
                velocity - wall,
            )?;
        }
    }
    Ok(found)
}

impl ForceCut {
    /// What plain native does: a dashpot never pulls unless the case says so.
    #[must_use]
    pub fn cuts(self) -> bool {
        self != Self::Off
    }
}
