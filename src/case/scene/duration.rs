//! The time step and the number of steps of a scene.

use super::particles::Origins;
use super::{Scene, SceneAction, SceneMotion, approach};
use crate::Vector;
use crate::case::protocol::End;
use crate::case::schema::{Case, TimeStep};
use crate::error::Problem;
use crate::laws::registry::Normal;

/// Most steps of one run: beyond it a number was mistyped.
pub const MOST_STEPS: f64 = 1e9;
/// Most numbers of one record, 8 GB.
const MOST_VALUES: f64 = 1e9;
/// Most particles whose pairs are all looked at for the shortest impact.
const MOST_PAIRED: usize = 10_000;

/// Duration of the shortest elastic impact at the start velocities [s], or why there is none.
fn shortest_impact(scene: &Scene, law: &Normal) -> Result<f64, String> {
    if scene.particles.len() > MOST_PAIRED {
        let count = scene.particles.len();
        return Err(format!(
            "every pair of the {count} particles would be looked at for its impact, at most {MOST_PAIRED} are allowed; \
             state a time in s, or a time step as a Rayleigh fraction"
        ));
    }
    let durations = approach::approaches(scene).map(|start| law.impact_duration(&start.law, start.speed));
    durations.reduce(f64::min).ok_or_else(|| {
        "nothing approaches anything at the start, so that no contact has a duration; state a time in s".to_owned()
    })
}

/// A ratio of two lengths of time that is this near to a whole number is one: both come from decimal numbers.
const WHOLE: f64 = 1e-9;

/// Smallest whole number that is not below `ratio`, but for rounding.
fn whole(ratio: f64) -> f64 {
    let nearest = ratio.round();
    if (ratio - nearest).abs() <= WHOLE * nearest { nearest } else { ratio.ceil() }
}

/// Chooses the time step and the number of steps, and returns the steps of every stage. A stage lasts a whole number of
/// samples.
pub fn steps(case: &Case, scene: &mut Scene, law: &Normal) -> Result<Vec<u64>, Problem> {
    let asked = matches!(case.time.step, TimeStep::ContactFraction { .. })
        || case.stages.iter().any(|stage| matches!(stage.end, End::Contacts { .. }));
    let impact = if asked { shortest_impact(scene, law) } else { Ok(0.0) };
    let rayleigh = scene
        .particles
        .iter()
        .filter_map(|particle| scene.materials[particle.material].rayleigh_time(particle.radius))
        .reduce(f64::min)
        .unwrap_or(f64::INFINITY);
    let (key, base) = match &case.time.step {
        TimeStep::Fixed { value } => ("time.step.value", value.si()),
        TimeStep::ContactFraction { steps_per_contact } => {
            let key = "time.step.steps_per_contact";
            let duration = impact.clone().map_err(|why| Problem::new(key, steps_per_contact, why))?;
            (key, duration / f64::from(*steps_per_contact))
        }
        TimeStep::RayleighFraction { fraction } => ("time.step.fraction", fraction.get() * rayleigh),
    };
    if base > rayleigh {
        let allowed =
            format!("above the stability limit: the Rayleigh time of the smallest particle is {rayleigh:e} s");
        return Err(Problem::new(key, format!("{base} s"), allowed));
    }
    let refined = f64::from(1u32 << scene.refinement);
    scene.time_step = base / refined;
    if !scene.time_step.is_normal() {
        return Err(Problem::new(key, format!("{base:e} s"), "a time step is a positive normal number"));
    }
    let mut stages = Vec::new();
    let (mut total, mut values) = (0.0, 0.0);
    // A particle of a packing has three contacts of its own: two ids and a force each.
    let row = if scene.contacts { 31 } else { 16 };
    for (i, stage) in case.stages.iter().enumerate() {
        let key = format!("stages.{i}.end.value");
        let length = match &stage.end {
            End::Duration { value } => value.si(),
            End::Contacts { value } => {
                value.get() * impact.clone().map_err(|why| Problem::new(&key, value.get(), why))?
            }
            // Every other end is refused by name before.
            _ => 0.0,
        };
        let every = stage.output.as_ref().map_or(case.output.every, |output| output.every) as f64;
        let own = whole(length / base / every);
        let steps = own * every * refined;
        total += steps;
        if !(1.0..=MOST_STEPS).contains(&total) {
            let allowed =
                format!("makes {steps:e} steps of {:e} s, from 1 to {MOST_STEPS:e} are allowed", scene.time_step);
            return Err(Problem::new(key, format!("{length:e} s"), allowed));
        }
        values += own * (row * scene.particles.len() + 3 * scene.bodies.len() + 8) as f64;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to MOST_STEPS")]
        stages.push(steps as u64);
    }
    if values > MOST_VALUES {
        let allowed = format!("makes a record of {values:e} values, at most {MOST_VALUES:e} are allowed");
        return Err(Problem::new("output.every", case.output.every, allowed));
    }
    scene.steps = stages.iter().sum();
    Ok(stages)
}

/// Nothing moves further than the smallest radius in one step at the start: contacts would be missed.
pub fn travel(case: &Case, scene: &Scene, origins: &Origins) -> Result<(), Problem> {
    let radii = scene.particles.iter().map(|particle| particle.radius);
    let Some(smallest) = radii.reduce(f64::min) else { return Ok(()) };
    let dt = scene.time_step;
    let far = |length: f64| length.is_nan() || length > smallest;
    let allowed = |length: f64| {
        format!("moves by {length:e} m in a step of {dt:e} s, at most the smallest radius of {smallest:e} m is allowed")
    };
    let weight = Vector::from(scene.gravity).norm() * dt * dt;
    if far(weight) {
        return Err(Problem::new("gravity", format!("{:?} m/s2", scene.gravity), allowed(weight)));
    }
    let particles = scene.particles.iter().enumerate();
    let particles = particles.map(|(i, particle)| (origins.key(case, i, "velocity"), particle.velocity));
    let walls = scene.bodies.iter().enumerate().filter_map(|(i, body)| match &body.motion {
        SceneMotion::Prescribed { velocity } => Some((format!("bodies.{i}.motion.velocity"), *velocity)),
        _ => None,
    });
    let set = scene.stages.iter().enumerate().flat_map(|(i, stage)| {
        stage.actions.iter().filter_map(move |action| match action {
            SceneAction::SetMotion { motion: SceneMotion::Prescribed { velocity }, .. } => {
                Some((format!("stages.{i}.actions"), *velocity))
            }
            _ => None,
        })
    });
    for (key, velocity) in particles.chain(walls).chain(set) {
        let length = Vector::from(velocity).norm() * dt;
        if far(length) {
            return Err(Problem::new(key, format!("{velocity:?} m/s"), allowed(length)));
        }
    }
    Ok(())
}
