//! The particles of a scene: every source of the case, expanded.

use std::f64::consts::PI;

use super::insertion::Insertion;
use super::random::Random;
use super::{Scene, SceneParticle, index, si};
use crate::Vector;
use crate::case::quantity::{Kind, Length, Quantity};
use crate::case::schema::{Case, Geometry};
use crate::case::source::{ParticleSource, RadiusDistribution};
use crate::domain::Domain;
use crate::error::Problem;

/// Which source each particle comes from.
#[derive(Default)]
pub struct Origins(Vec<usize>);

impl Origins {
    /// The key of the case that gave `value` (`radius`, `position` or `velocity`) to a particle.
    pub fn key(&self, case: &Case, particle: usize, value: &str) -> String {
        // Particles of another case have no source in this one.
        let Some(&source) = self.0.get(particle) else { return "start_from.case".to_owned() };
        let name = match (&case.particles[source], value) {
            (ParticleSource::Random { .. }, "position") => "region",
            (ParticleSource::Lattice { .. }, "position") => "spacing",
            _ => value,
        };
        format!("particles.{source}.{name}")
    }
}

/// Expands the sources into the particles of the scene, in the order of the sources. Places that are stated come first:
/// random ones keep clear of them, of the walls and of the random ones of the sources before.
///
/// # Errors
/// A region is too full.
pub fn place(case: &Case, scene: &mut Scene) -> Result<Origins, Problem> {
    let domain = Domain::new(&scene.domain);
    let seed = scene.seed.unwrap_or_default();
    let mut placed: Vec<Vec<SceneParticle>> = Vec::new();
    for (i, source) in case.particles.iter().enumerate() {
        placed.push(match source {
            ParticleSource::Single { material, radius, position, velocity, angular_velocity } => {
                let moving = (si(velocity), si(angular_velocity));
                vec![particle(case, material, radius.si(), si(position), moving)]
            }
            ParticleSource::Lattice { .. } => lattice(case, source, &domain, &mut Random::new(seed, i)),
            _ => Vec::new(),
        });
    }
    let largest = largest(case);
    for (i, source) in case.particles.iter().enumerate() {
        if let ParticleSource::Random { material, count, radius, region, velocity, angular_velocity } = source {
            let region = region.map(|corner| Vector::from(si(&corner)));
            let mut insertion = Insertion::new(&domain, &scene.bodies, region, *count, largest);
            for particle in placed.iter().flatten() {
                insertion.add(particle.position.into(), particle.radius);
            }
            let mut random = Random::new(seed, i);
            let radii: Vec<f64> = (0..*count).map(|_| draw(radius, &mut random)).collect();
            let places = insertion
                .fill(&radii, &mut random)
                .map_err(|full| Problem::new(format!("particles.{i}.count"), count, full.to_string()))?;
            let mut moving = || (any(Some(*velocity), &mut random), any(*angular_velocity, &mut random));
            let spheres = radii.iter().zip(places);
            placed[i] = spheres.map(|(radius, at)| particle(case, material, *radius, at.into(), moving())).collect();
        }
    }
    let origins = placed.iter().enumerate().flat_map(|(source, particles)| vec![source; particles.len()]).collect();
    scene.particles = placed.into_iter().flatten().collect();
    Ok(Origins(origins))
}

/// A particle of a case: a sphere, or a disk that moves and turns in its plane. Its radius is that at the temperature of the
/// start, its mass that of the radius that the case gives.
fn particle(
    case: &Case,
    material: &str,
    radius: f64,
    position: [f64; 3],
    (velocity, angular_velocity): ([f64; 3], [f64; 3]),
) -> SceneParticle {
    let material = index(case, material);
    // A material of particles has a density: checked before.
    let density = case.materials[material].density.map_or(0.0, Quantity::si);
    let expansion = super::expansion(&case.materials[material]);
    let swollen = expansion.zip(case.temperature).map_or(1.0, |(expansion, at)| expansion.factor(at.si()));
    let (mass, share, velocity, angular_velocity) = match &case.geometry {
        Geometry::Spheres {} => {
            (density * (4.0 / 3.0 * PI * radius * radius * radius), 0.4, velocity, angular_velocity)
        }
        Geometry::Disks { height } => {
            let ([x, _, z], [_, spin, _]) = (velocity, angular_velocity);
            (density * (PI * radius * radius * height.si()), 0.5, [x, 0.0, z], [0.0, spin, 0.0])
        }
    };
    let radius = radius * swollen;
    SceneParticle {
        material,
        radius,
        mass,
        moment_of_inertia: share * mass * radius * radius,
        position,
        velocity,
        angular_velocity,
    }
}

/// A cubic lattice, x running fastest; noise that crosses a periodic face re-enters on the other side.
fn lattice(case: &Case, source: &ParticleSource, domain: &Domain, random: &mut Random) -> Vec<SceneParticle> {
    let ParticleSource::Lattice { material, count, radius, origin, spacing, noise, velocity, angular_velocity } =
        source
    else {
        return Vec::new();
    };
    let sites = (0..count[2]).flat_map(|z| (0..count[1]).flat_map(move |y| (0..count[0]).map(move |x| [x, y, z])));
    let site = |cell: [u32; 3]| {
        let radius = draw(radius, random);
        let place = Vector::from_fn(|axis, _| {
            origin[axis].si() + spacing.si() * f64::from(cell[axis]) + random.between(-noise.si(), noise.si())
        });
        let moving = (any(*velocity, random), any(*angular_velocity, random));
        particle(case, material, radius, domain.wrap(place).0.into(), moving)
    };
    sites.map(site).collect()
}

/// A vector whose components are uniform up to `most`; nothing is drawn where there is none.
fn any<K: Kind>(most: Option<Quantity<K>>, random: &mut Random) -> [f64; 3] {
    most.map_or([0.0; 3], |most| [0; 3].map(|_| random.between(-most.si(), most.si())))
}

fn draw(radius: &RadiusDistribution, random: &mut Random) -> f64 {
    match radius {
        RadiusDistribution::Equal { value } => value.si(),
        RadiusDistribution::Uniform { min, max } => random.between(min.si(), max.si()),
    }
}

/// The largest radius that the sources can make [m].
fn largest(case: &Case) -> f64 {
    let most = |radius: &RadiusDistribution| -> Length {
        match radius {
            RadiusDistribution::Equal { value } => *value,
            RadiusDistribution::Uniform { max, .. } => *max,
        }
    };
    let radii = case.particles.iter().filter_map(|source| match source {
        ParticleSource::Single { radius, .. } => Some(*radius),
        ParticleSource::Random { radius, .. } | ParticleSource::Lattice { radius, .. } => Some(most(radius)),
        _ => None,
    });
    radii.map(Quantity::si).fold(0.0, f64::max)
}

/// A mass or a moment of inertia that underflows or overflows leaves the engine without an acceleration.
pub fn weighable(case: &Case, scene: &Scene, origins: &Origins) -> Result<(), Problem> {
    for (i, particle) in scene.particles.iter().enumerate() {
        if !(particle.mass.is_normal() && particle.moment_of_inertia.is_normal()) {
            return Err(Problem::new(
                origins.key(case, i, "radius"),
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
