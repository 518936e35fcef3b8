//! Scenes: one runnable problem with nothing left to resolve (docs/formats.md).

mod approach;
mod bodies;
mod drives;
mod duration;
mod insertion;
mod mirror;
mod particles;
mod random;
mod specification;
mod stages;
pub mod start;
mod supported;
mod valid;

use serde::{Deserialize, Serialize};

pub use drives::{SceneDrive, SceneLeg};
pub use mirror::{Mirror, Start};
pub use stages::{SceneAction, SceneStage};

use super::measure::Observable;
use super::model::{Damping, ForceCut, MomentLaw, NormalLaw, PairValues, TangentialLaw};
use super::quantity::{Kind, Number, Quantity};
use super::schema::{Boundary, Case, Geometry, Level};
use crate::error::Problem;
use crate::material::{self, Expansion, Material, PairProperties};

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
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub drives: Vec<SceneDrive>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stages: Vec<SceneStage>,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub contacts: bool,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub contact_states: bool,
    #[serde(default = "kept", skip_serializing_if = "is_kept")]
    pub energies: bool,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub observables: Vec<Observable>,
    /// Height of disks [m]; spheres have none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub disk_height: Option<f64>,
    /// Temperature at which the radii of the particles stand [K], where the case states one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub temperature: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<SceneStart>,
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

const fn kept() -> bool {
    true
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
const fn is_kept(energies: &bool) -> bool {
    *energies
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
    Servo { direction: [f64; 3], load: SceneLoad, mass: f64, damping: f64 },
    Oscillating { direction: [f64; 3], amplitude: f64, frequency: f64 },
}

/// External load on a servo wall: a force [N], or a stress [N/m] on the length between two parallel planes.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "docs/formats.md describes every field")]
pub enum SceneLoad {
    Force { value: f64 },
    LineStress { value: f64, between: [usize; 2] },
}

/// The state of another scene after `step` steps.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "docs/formats.md describes every field")]
pub struct SceneStart {
    pub scene: Box<Scene>,
    pub step: u64,
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
    /// `case/variant/seed=1`, without the parts that the case does not have.
    #[must_use]
    pub fn name(&self) -> String {
        let member = self.member();
        if member.is_empty() { self.case.clone() } else { format!("{}/{member}", self.case) }
    }

    /// `variant/seed=1`: which of the scenes of its case it is.
    #[must_use]
    pub fn member(&self) -> String {
        let seed = self.seed.map(|seed| format!("seed={seed}"));
        let parts = [Some(self.variant.clone()).filter(|variant| !variant.is_empty()), seed];
        parts.into_iter().flatten().collect::<Vec<_>>().join("/")
    }

    /// The next step after `step` at which a sample is taken: multiples of the interval of the stage, and its end.
    #[must_use]
    pub fn next_sample(&self, step: u64) -> u64 {
        let mut first = 0;
        for stage in &self.stages {
            let end = first + stage.steps;
            if step < end {
                let every = stage.output_every.unwrap_or(self.output_every);
                return (first + ((step - first) / every + 1) * every).min(end);
            }
            first = end;
        }
        (step / self.output_every + 1) * self.output_every
    }

    /// The step of the last sample.
    #[must_use]
    pub fn last_sample(&self) -> u64 {
        if self.stages.is_empty() { self.steps / self.output_every * self.output_every } else { self.steps }
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

/// Resolves one variant, and one seed of its ensemble, into a scene whose time step is divided by 2^`refinement`; `start` is
/// the state of the case that it starts from.
///
/// # Errors
/// The case asks for what this build does not compute, or its start state or time step is not allowed.
pub fn prepare(
    case: &Case,
    variant: &str,
    seed: Option<u64>,
    refinement: u32,
    start: Option<SceneStart>,
) -> Result<Scene, Problem> {
    supported::supported(case)?;
    let mut scene = Scene {
        schema: SCHEMA,
        case: case.name.clone(),
        variant: variant.to_owned(),
        seed,
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
        drives: Vec::new(),
        stages: Vec::new(),
        contacts: case.output.contacts,
        contact_states: case.output.contact_states,
        energies: case.output.energies,
        observables: case.observables.clone(),
        disk_height: match &case.geometry {
            Geometry::Spheres {} => None,
            Geometry::Disks { height } => Some(height.si()),
        },
        temperature: case.temperature.map(Quantity::si),
        start: None,
    };
    scene.pairs = pairs(case, &scene.materials);
    scene.bodies = bodies::bodies(case);
    let origins = if let Some(start) = &start {
        start::inherit(&mut scene, start)?
    } else {
        let origins = particles::place(case, &mut scene)?;
        particles::weighable(case, &scene, &origins)?;
        origins
    };
    valid::room(case, &scene)?;
    drop_unused_materials(&mut scene);
    let laws = scene.model.specification(&scene.mirror)?;
    if start.is_none() {
        approach::overlaps(case, &scene, &origins)?;
    }
    let stages = duration::steps(case, &mut scene, &laws.normal)?;
    scene.stages = stages::resolve(case, &scene, &stages);
    duration::travel(case, &scene, &origins)?;
    scene.drives = drives::resolve(case, &scene, &stages)?;
    drives::check(case, &scene)?;
    scene.start = start;
    valid::heat(case, &scene, &laws)?;
    Ok(scene)
}

fn solid(material: &super::schema::Material) -> Material {
    Material {
        name: material.name.clone(),
        rigid: material.rigid,
        young: material.young.map(Quantity::si),
        poisson: material.poisson.map(Number::get),
        density: material.density.map(Quantity::si),
        expansion: expansion(material),
    }
}

/// Thermal expansion of a material.
pub(super) fn expansion(material: &super::schema::Material) -> Option<Expansion> {
    material.thermal.as_ref().map(|thermal| Expansion {
        coefficient: thermal.expansion.si(),
        reference_temperature: thermal.reference_temperature.si(),
    })
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
    let between = |pair: &super::schema::Pair| [index(case, &pair.between[0]), index(case, &pair.between[1])];
    case.pairs.iter().map(|pair| mixed(materials, between(pair), &pair.values)).collect()
}

/// What two materials, by index, make together.
fn mixed(materials: &[Material], between: [usize; 2], values: &PairValues) -> PairProperties {
    let [first, second] = between.map(|at| &materials[at]);
    let (damping_ratio, restitution) = match &values.damping {
        Some(Damping::Restitution { value }) => (material::damping_ratio(value.get()), Some(value.get())),
        Some(Damping::Ratio { value }) => (value.get(), None),
        Some(Damping::None {}) | None => (0.0, None),
    };
    let shear = material::effective_shear(first, second);
    let young = material::effective_young(first, second);
    PairProperties {
        between,
        // Laws that state their stiffness ask for no moduli.
        effective_young: if young.is_finite() { young } else { 0.0 },
        effective_shear: shear.is_finite().then_some(shear),
        damping_ratio,
        restitution,
        friction: values.friction.map(Number::get),
        rolling_friction: values.rolling_friction.map(Number::get),
        twisting_friction: values.twisting_friction.map(Number::get),
        work_of_adhesion: values.work_of_adhesion.map(Quantity::si),
        cohesive: values.cohesive,
    }
}

impl ForceCut {
    /// What plain native does: a dashpot never pulls unless the case says so.
    #[must_use]
    pub fn cuts(self) -> bool {
        self != Self::Off
    }
}
