//! Driven particles: the legs of their paths, and where the paths lead.

use serde::{Deserialize, Serialize};

use super::{Scene, SceneMotion, si};
use crate::Vector;
use crate::bodies::Body;
use crate::case::protocol::{Action, Course, Stage};
use crate::case::schema::Case;
use crate::error::Problem;
use crate::geometry::{self, ContactGeometry};
use crate::path::{Leg, Path};

/// Most places of a path that are looked at.
const LOOKS: u64 = 1_000_000;

/// The path of a driven particle: one leg per stage of the case.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "docs/formats.md describes every field")]
pub struct SceneDrive {
    pub particle: usize,
    pub legs: Vec<SceneLeg>,
}

/// One stage of a path (`src/path.rs`).
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "docs/formats.md describes every field")]
pub struct SceneLeg {
    pub steps: u64,
    pub position: [f64; 3],
    pub velocity: [f64; 3],
    pub angular_velocity: [f64; 3],
    pub course: Course,
    pub rotation: [f64; 3],
    pub point: [f64; 3],
}

/// One leg per stage for every particle that any stage drives; `stages` are the steps of the stages.
pub fn resolve(case: &Case, scene: &Scene, stages: &[u64]) -> Result<Vec<SceneDrive>, Problem> {
    let mut driven: Vec<usize> = case.stages.iter().flat_map(|stage| &stage.actions).filter_map(particle).collect();
    driven.sort_unstable();
    driven.dedup();
    let mut drives = Vec::new();
    for particle in driven {
        let start = &scene.particles[particle];
        for (name, value) in [("velocity", start.velocity), ("angular_velocity", start.angular_velocity)] {
            if value.iter().any(|component| *component != 0.0) {
                let allowed = "a driven particle starts at rest; its stages state how it moves";
                return Err(Problem::new(format!("particles.{particle}.{name}"), format!("{value:?}"), allowed));
            }
        }
        let mut place = start.position;
        let mut legs = Vec::new();
        for (stage, steps) in case.stages.iter().zip(stages) {
            let leg = leg(stage, particle, place, *steps);
            place = Leg::new(&leg).at(*steps, scene.time_step).position.into();
            legs.push(leg);
        }
        drives.push(SceneDrive { particle, legs });
    }
    Ok(drives)
}

fn particle(action: &Action) -> Option<usize> {
    match action {
        Action::Drive { particle, .. } => Some(*particle as usize),
        _ => None,
    }
}

fn leg(stage: &Stage, driven: usize, position: [f64; 3], steps: u64) -> SceneLeg {
    let stated = stage.actions.iter().find(|action| particle(action) == Some(driven));
    match stated {
        Some(Action::Drive { velocity, angular_velocity, course, rotation, point, .. }) => SceneLeg {
            steps,
            position,
            velocity: si(velocity),
            angular_velocity: si(angular_velocity),
            course: *course,
            rotation: si(rotation),
            point: si(point),
        },
        _ => SceneLeg {
            steps,
            position,
            velocity: [0.0; 3],
            angular_velocity: [0.0; 3],
            course: Course::Constant {},
            rotation: [0.0; 3],
            point: [0.0; 3],
        },
    }
}

/// Refuses paths that leave the range of every contact law, the box, or the reach of one step.
pub fn check(case: &Case, scene: &Scene) -> Result<(), Problem> {
    let paths: Vec<Path> = scene.drives.iter().map(|drive| Path::new(drive, scene.time_step)).collect();
    let stride = usize::try_from(scene.steps / LOOKS + 1).unwrap_or(usize::MAX);
    for (k, path) in paths.iter().enumerate() {
        for step in (0..=scene.steps).step_by(stride).chain([scene.steps]) {
            let found = stays(scene, path, step).and_then(|()| {
                paths[..k].iter().try_for_each(|other| apart(scene, path, other, step))?;
                scene.bodies.iter().try_for_each(|body| above(scene, path, body, step))
            });
            found.map_err(|(value, allowed)| {
                let key = stated_by(case, path, step);
                Problem::new(key, value, format!("particle {} at step {step}: {allowed}", path.particle))
            })?;
        }
    }
    Ok(())
}

/// The key that moves a particle at a step, or another one if it rests in that stage.
fn stated_by(case: &Case, path: &Path, step: u64) -> String {
    let stage = path.leg_of(step);
    let driven: Vec<Option<usize>> = case.stages[stage].actions.iter().map(particle).collect();
    let own = driven.iter().position(|driven| *driven == Some(path.particle as usize));
    match own.or_else(|| driven.iter().position(Option::is_some)) {
        Some(action) => format!("stages.{stage}.actions.{action}.velocity"),
        None => format!("stages.{stage}.name"),
    }
}

/// What is wrong, and what is allowed.
type Fault = (String, String);

fn stays(scene: &Scene, path: &Path, step: u64) -> Result<(), Fault> {
    let driven = path.at(step);
    let radius = scene.particles[path.particle as usize].radius;
    let gone = driven.velocity.norm() * scene.time_step;
    if gone.is_nan() || gone > radius {
        return Err((format!("{gone:e} m in one step"), format!("at most its radius of {radius:e} m is allowed")));
    }
    let (low, high) = (scene.domain.min, scene.domain.max);
    match (0..3).find(|axis| !(low[*axis]..=high[*axis]).contains(&driven.position[*axis])) {
        Some(axis) => {
            let place = format!("{} = {:e} m", ["x", "y", "z"][axis], driven.position[axis]);
            Err((place, format!("the domain reaches from {:e} m to {:e} m", low[axis], high[axis])))
        }
        None => Ok(()),
    }
}

fn apart(scene: &Scene, one: &Path, other: &Path, step: u64) -> Result<(), Fault> {
    let [here, there] = [one, other].map(|path| path.at(step).position);
    let [own, others] = [one, other].map(|path| scene.particles[path.particle as usize].radius);
    let overlap = geometry::sphere_sphere(here, own, there, others).map_or(own + others, |found| found.overlap);
    within(overlap, own.min(others), &format!("particle {}", other.particle))
}

fn above(scene: &Scene, path: &Path, body: &super::SceneBody, step: u64) -> Result<(), Fault> {
    let mut moved = Body::new(body);
    if let SceneMotion::Prescribed { velocity } = &body.motion {
        moved.point += Vector::from(*velocity) * (step as f64 * scene.time_step);
    }
    let radius = scene.particles[path.particle as usize].radius;
    let found: Option<ContactGeometry> = moved.geometry(path.at(step).position, radius);
    within(found.map_or(0.0, |found| found.overlap), radius, &format!("body {}", body.name))
}

fn within(overlap: f64, radius: f64, with: &str) -> Result<(), Fault> {
    if overlap < radius {
        return Ok(());
    }
    let allowed = format!("a centre comes to the surface of {with}; overlaps below {radius:e} m are allowed");
    Err((format!("overlap of {overlap:e} m"), allowed))
}
