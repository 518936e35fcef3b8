//! Which bodies approach each other at the start, and which overlap.

use super::{Scene, SceneMotion};
use crate::Vector;
use crate::bodies::Body;
use crate::case::schema::Case;
use crate::error::Problem;
use crate::geometry::{self, ContactGeometry};
use crate::laws::PairLaw;
use crate::material;

/// A pair of bodies that moves together at the start: the law's view of it and its speed [m/s].
pub struct StartApproach {
    pub law: PairLaw,
    pub speed: f64,
}

/// Every pair that approaches at the start; refuses overlaps that the case does not permit.
pub fn approaches(case: &Case, scene: &Scene) -> Result<Vec<StartApproach>, Problem> {
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
                found.push(StartApproach {
                    law: PairLaw {
                        effective_young: pair.effective_young,
                        effective_radius: geometry.effective_radius(),
                        effective_mass: mass,
                        damping_ratio: pair.damping_ratio,
                        ..PairLaw::default()
                    },
                    speed,
                });
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
