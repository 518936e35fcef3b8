//! Where the particles of a case come from.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::quantity::{AngularSpeed, Length, Number, Speed};

/// A source of particles.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum ParticleSource {
    /// One particle.
    Single {
        /// Name of the material.
        material: String,
        /// Radius [m].
        radius: Length,
        /// Centre [m].
        position: [Length; 3],
        /// Velocity [m/s].
        velocity: [Speed; 3],
        /// Angular velocity [rad/s].
        angular_velocity: [AngularSpeed; 3],
    },
    /// Particles at random places without overlap, from the seed of the ensemble.
    Random {
        /// Name of the material.
        material: String,
        /// Number of particles.
        count: u32,
        /// Radii.
        radius: RadiusDistribution,
        /// Lower and upper corner of the region of the centres [m].
        region: [[Length; 3]; 2],
        /// Largest component of the uniform random velocity [m/s].
        velocity: Speed,
        /// Largest component of the uniform random angular velocity [rad/s]; none if absent.
        angular_velocity: Option<AngularSpeed>,
    },
    /// A cubic lattice with noise, from the seed of the ensemble.
    Lattice {
        /// Name of the material.
        material: String,
        /// Particles along each axis.
        count: [u32; 3],
        /// Radii.
        radius: RadiusDistribution,
        /// Centre of the first particle [m].
        origin: [Length; 3],
        /// Distance of neighbours [m].
        spacing: Length,
        /// Largest displacement along each axis [m].
        noise: Length,
        /// Largest component of the uniform random velocity [m/s]; at rest if absent.
        velocity: Option<Speed>,
        /// Largest component of the uniform random angular velocity [rad/s]; none if absent.
        angular_velocity: Option<AngularSpeed>,
    },
    /// Single particles or aggregates that fall one after the other and stick where they touch, with periodic sides.
    Ballistic {
        /// Name of the material.
        material: String,
        /// Number of particles.
        count: u32,
        /// Radii.
        radius: RadiusDistribution,
        /// Particles of each aggregate; 1 for random ballistic deposition.
        aggregate: u32,
        /// Lower and upper corner of the region that they fall into, onto its lower face [m].
        region: [[Length; 3]; 2],
    },
    /// Clusters that walk at random and stick when they touch, until one is left.
    Aggregate {
        /// Name of the material.
        material: String,
        /// Number of particles.
        count: u32,
        /// Radii.
        radius: RadiusDistribution,
        /// Probability that a touch sticks, in (0, 1]: 1 is limited by diffusion, little by reaction [-].
        sticking: Number,
        /// Lower and upper corner of the region, whose sides are periodic [m].
        region: [[Length; 3]; 2],
    },
    /// Particles of a file with the columns x, y, z, radius.
    File {
        /// Name of the material.
        material: String,
        /// Path relative to the case file.
        path: String,
    },
}

/// Distribution of radii.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum RadiusDistribution {
    /// One radius.
    Equal {
        /// Radius [m].
        value: Length,
    },
    /// Uniform between two radii.
    Uniform {
        /// Smallest radius [m].
        min: Length,
        /// Largest radius [m].
        max: Length,
    },
}

impl ParticleSource {
    /// Name of the material.
    #[must_use]
    pub fn material(&self) -> &str {
        match self {
            Self::Single { material, .. }
            | Self::Random { material, .. }
            | Self::Lattice { material, .. }
            | Self::Ballistic { material, .. }
            | Self::Aggregate { material, .. }
            | Self::File { material, .. } => material,
        }
    }

    /// Whether it draws from the seed of the ensemble.
    #[must_use]
    pub fn draws(&self) -> bool {
        match self {
            Self::Single { .. } | Self::File { .. } => false,
            Self::Lattice { radius, noise, velocity, angular_velocity, .. } => {
                noise.si() > 0.0
                    || velocity.is_some()
                    || angular_velocity.is_some()
                    || matches!(radius, RadiusDistribution::Uniform { .. })
            }
            Self::Random { .. } | Self::Ballistic { .. } | Self::Aggregate { .. } => true,
        }
    }

    /// Whether it can make more than one particle.
    #[must_use]
    pub fn makes_many(&self) -> bool {
        !matches!(self, Self::Single { .. })
    }
}
