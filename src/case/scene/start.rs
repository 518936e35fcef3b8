//! Scenes that start from the state of another.

use super::particles::Origins;
use super::{Scene, SceneStart, prepare};
use crate::case::Stated;
use crate::case::schema::StartFrom;
use crate::case::sweep::Variant;
use crate::error::Problem;

/// Most cases that start from each other in a row.
const DEEPEST: usize = 8;

/// The scene of a variant; the case that it starts from, if any, is read and prepared first.
///
/// # Errors
/// As [`prepare`]; or the other case cannot be read, or has no such variant, stage or time.
pub fn scene(stated: &Stated, variant: &Variant, seed: Option<u64>, refinement: u32) -> Result<Scene, Problem> {
    below(stated, variant, seed, refinement, 0)
}

fn below(
    stated: &Stated,
    variant: &Variant,
    seed: Option<u64>,
    refinement: u32,
    depth: usize,
) -> Result<Scene, Problem> {
    let Some(from) = &variant.case.start_from else {
        return prepare(&variant.case, &variant.name, seed, refinement, None);
    };
    let refuse = |key: &str, value: &str, allowed: String| Problem::new(format!("start_from.{key}"), value, allowed);
    if depth == DEEPEST {
        return Err(refuse("case", &from.case, format!("at most {DEEPEST} cases start from each other in a row")));
    }
    let other = stated.ancestor(&from.case).map_err(|error| refuse("case", &from.case, error.to_string()))?;
    let point = chosen(from, variant, &other)?;
    let scene = below(&other, point, seed, refinement, depth + 1)?;
    let step = step(from, &scene)?;
    prepare(&variant.case, &variant.name, seed, refinement, Some(SceneStart { scene: Box::new(scene), step }))
}

/// The variant of the other case.
fn chosen<'a>(from: &StartFrom, variant: &Variant, other: &'a Stated) -> Result<&'a Variant, Problem> {
    let named = |name: &str| other.variants.iter().find(|one| one.name == name);
    let known = || other.variants.iter().map(|one| one.name.as_str()).collect::<Vec<_>>().join(" ");
    if let Some(name) = &from.variant {
        let refuse = || Problem::new("start_from.variant", name, format!("no such variant (known: {})", known()));
        return named(name).ok_or_else(refuse);
    }
    let own = |axis: &str| variant.points.iter().find(|point| point.axis == axis).map(|point| point.label.as_str());
    let labels: Option<Vec<&str>> = other.case.vary.iter().map(|axis| own(&axis.axis)).collect();
    let allowed = || format!("its axes are not all axes of this case: state one of its variants ({})", known());
    let name = labels.ok_or_else(|| Problem::new("start_from.variant", "nothing", allowed()))?.join(",");
    named(&name).ok_or_else(|| Problem::new("start_from.variant", &name, format!("no such variant ({})", known())))
}

/// The step of the other scene whose state it is.
fn step(from: &StartFrom, scene: &Scene) -> Result<u64, Problem> {
    let mut first = 0;
    for stage in &scene.stages {
        if stage.name == from.stage {
            let Some(at) = from.at else { return Ok(first + stage.steps) };
            let steps = (at.si() / scene.time_step).round();
            if steps > stage.steps as f64 {
                let length = stage.steps as f64 * scene.time_step;
                let allowed = format!("the stage {} lasts {length:e} s", stage.name);
                return Err(Problem::new("start_from.at", format!("{:e} s", at.si()), allowed));
            }
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "at most the steps of a stage"
            )]
            return Ok(first + steps as u64);
        }
        first += stage.steps;
    }
    let known = scene.stages.iter().map(|stage| stage.name.as_str()).collect::<Vec<_>>().join(", ");
    Err(Problem::new("start_from.stage", &from.stage, format!("no such stage (known: {known})")))
}

/// Gives a scene the particles of the other one; their places are those of that scene's own start.
pub(super) fn inherit(scene: &mut Scene, start: &SceneStart) -> Result<Origins, Problem> {
    let other = &start.scene;
    let place = |name: &str| scene.materials.iter().position(|material| material.name == name);
    let mut particles = other.particles.clone();
    for particle in &mut particles {
        let name = &other.materials[particle.material].name;
        particle.material = place(name).ok_or_else(|| {
            let allowed = format!("its particles are of the material {name}, which this case does not state");
            Problem::new("start_from.case", &other.case, allowed)
        })?;
    }
    let unlike = |key: &str, own: String, others: String| {
        Err(Problem::new(key, own, format!("{others} in the case that it starts from; states fit only their like")))
    };
    if scene.disk_height != other.disk_height {
        return unlike("geometry", format!("{:?}", scene.disk_height), format!("{:?}", other.disk_height));
    }
    for (i, material) in scene.materials.iter().enumerate() {
        let like = other.materials.iter().find(|one| one.name == material.name);
        if let Some(like) = like.filter(|like| like.expansion != material.expansion) {
            let (own, others) = (format!("{:?}", material.expansion), format!("{:?}", like.expansion));
            return unlike(&format!("materials.{i}.thermal"), own, others);
        }
    }
    if std::mem::discriminant(&scene.model.normal) != std::mem::discriminant(&other.model.normal) {
        return unlike("model.normal.law", "another law".to_owned(), "another one".to_owned());
    }
    scene.particles = particles;
    scene.temperature = other.temperature;
    Ok(Origins::default())
}
