//! The particles of a scene.

use std::f64::consts::PI;

use super::{Scene, SceneParticle, index, si};
use crate::case::schema::Case;
use crate::case::source::ParticleSource;
use crate::error::Problem;

/// The particle of a source that makes one.
pub fn single(case: &Case, source: &ParticleSource) -> Option<SceneParticle> {
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
pub fn weighable(scene: &Scene) -> Result<(), Problem> {
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
