//! Which bodies overlap at the start, and which approach each other.

use super::particles::Origins;
use super::{Scene, SceneMotion};
use crate::Vector;
use crate::bodies::Body;
use crate::case::schema::Case;
use crate::domain::Domain;
use crate::error::Problem;
use crate::geometry::{self, ContactGeometry};
use crate::laws::PairLaw;
use crate::material;
use crate::neighbors::Neighbors;
use crate::particles::Particles;

/// Skin of the search for overlaps, as a share of the smallest radius: rounding must not hide a pair.
const SKIN: f64 = 1e-6;

/// A pair of bodies that moves together at the start: the law's view of it and its speed [m/s].
pub struct StartApproach {
    pub law: PairLaw,
    pub speed: f64,
}

/// Refuses overlaps that the case does not permit, and centres that coincide.
pub fn overlaps(case: &Case, scene: &Scene, origins: &Origins) -> Result<(), Problem> {
    let refuse = |i: usize, what: &str, overlap: f64| {
        let value = format!("overlap of {overlap:e} m with {what}");
        let allowed = "particles start apart, unless allow_initial_overlap = true";
        Err(Problem::new(origins.key(case, i, "position"), value, allowed))
    };
    let domain = Domain::new(&scene.domain);
    // The first problem by id, whatever the order of the search.
    let mut pairs = touching(scene, &domain);
    pairs.sort_unstable();
    for [i, j] in pairs {
        match pair(scene, &domain, i, j) {
            None => {
                let value = format!("{:?}", scene.particles[i].position);
                let allowed = format!("particle {j} is at the same place; two centres differ");
                return Err(Problem::new(origins.key(case, i, "position"), value, allowed));
            }
            Some(geometry) if geometry.overlap > 0.0 && !case.allow_initial_overlap => {
                return refuse(i, &format!("particle {j}"), geometry.overlap);
            }
            Some(_) => {}
        }
    }
    for (i, particle) in scene.particles.iter().enumerate().filter(|_| !case.allow_initial_overlap) {
        for body in &scene.bodies {
            let geometry = Body::new(body).geometry(particle.position.into(), particle.radius);
            if let Some(geometry) = geometry.filter(|geometry| geometry.overlap > 0.0) {
                return refuse(i, &format!("body {}", body.name), geometry.overlap);
            }
        }
    }
    Ok(())
}

/// Particles that touch, the later one first.
fn touching(scene: &Scene, domain: &Domain) -> Vec<[usize; 2]> {
    let smallest = scene.particles.iter().map(|particle| particle.radius).fold(f64::INFINITY, f64::min);
    let mut particles = Particles::new(&scene.particles);
    let mut neighbors = Neighbors::new(SKIN * smallest, 0.0);
    neighbors.order(&mut particles, domain);
    let (pairs, _) = neighbors.search(&particles, &[], domain);
    let id = |at: u32| particles.motion[at as usize].id as usize;
    pairs.into_iter().map(|[a, b]| [id(a).max(id(b)), id(a).min(id(b))]).collect()
}

/// Two particles at their nearest images. None where the centres coincide.
fn pair(scene: &Scene, domain: &Domain, i: usize, j: usize) -> Option<ContactGeometry> {
    let (one, other) = (&scene.particles[i], &scene.particles[j]);
    let branch = domain.nearest(domain.wrap(one.position.into()).0 - domain.wrap(other.position.into()).0);
    let squared = branch.norm_squared();
    (squared > 0.0).then(|| geometry::spheres(branch, squared, one.radius, other.radius))
}

/// Every pair that approaches at the start, near or far: quadratic in the number of particles.
pub fn approaches(scene: &Scene) -> impl Iterator<Item = StartApproach> {
    let domain = Domain::new(&scene.domain);
    let pairs = (0..scene.particles.len()).flat_map(move |i| {
        let domain = domain.clone();
        (0..i).filter_map(move |j| {
            let (one, other) = (&scene.particles[i], &scene.particles[j]);
            let velocity = Vector::from(one.velocity) - Vector::from(other.velocity);
            let mass = material::reduced(one.mass, other.mass);
            approach(scene, &pair(scene, &domain, i, j)?, mass, [one.material, other.material], velocity)
        })
    });
    let walls = scene.particles.iter().flat_map(move |particle| {
        scene.bodies.iter().filter_map(move |body| {
            let geometry = Body::new(body).geometry(particle.position.into(), particle.radius)?;
            let wall = match &body.motion {
                SceneMotion::Prescribed { velocity } => Vector::from(*velocity),
                _ => Vector::zeros(),
            };
            let velocity = Vector::from(particle.velocity) - wall;
            approach(scene, &geometry, particle.mass, [particle.material, body.material], velocity)
        })
    });
    pairs.chain(walls)
}

fn approach(
    scene: &Scene,
    geometry: &ContactGeometry,
    mass: f64,
    materials: [usize; 2],
    velocity: Vector,
) -> Option<StartApproach> {
    let speed = -velocity.dot(&geometry.normal);
    let pair = scene.pair(materials[0], materials[1]).filter(|_| speed > 0.0)?;
    let law = pair.law(geometry.effective_radius(), mass);
    Some(StartApproach { law, speed })
}
