//! Particle columns.

use crate::Vector;
use crate::case::scene::Scene;

/// Particles as columns, one entry each per particle.
#[derive(Clone, Debug, Default)]
pub struct Particles {
    /// Index of the material.
    pub material: Vec<usize>,
    /// Radius [m].
    pub radius: Vec<f64>,
    /// Mass [kg].
    pub mass: Vec<f64>,
    /// Moment of inertia [kg m2].
    pub moment_of_inertia: Vec<f64>,
    /// Centre [m].
    pub position: Vec<Vector>,
    /// Velocity [m/s].
    pub velocity: Vec<Vector>,
    /// Angular velocity [rad/s].
    pub angular_velocity: Vec<Vector>,
    /// Sum of contact forces, weight excluded [N].
    pub force: Vec<Vector>,
    /// Sum of contact torques [N m].
    pub torque: Vec<Vector>,
}

impl Particles {
    /// The particles of a scene at its start.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let mut columns = Self::default();
        for particle in &scene.particles {
            columns.material.push(particle.material);
            columns.radius.push(particle.radius);
            columns.mass.push(particle.mass);
            columns.moment_of_inertia.push(particle.moment_of_inertia);
            columns.position.push(particle.position.into());
            columns.velocity.push(particle.velocity.into());
            columns.angular_velocity.push(particle.angular_velocity.into());
        }
        columns.force = vec![Vector::zeros(); columns.mass.len()];
        columns.torque = vec![Vector::zeros(); columns.mass.len()];
        columns
    }

    /// Number of particles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.mass.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.mass.is_empty()
    }
}
