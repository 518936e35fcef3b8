//! What does not change during a record: the particles, the walls, the box.

use serde::Deserialize;

use super::sphere_volume::sphere;
use crate::Vector;
use crate::bodies::BodyShape;
use crate::case::scene::{Scene, SceneDomain, SceneShape};
use crate::domain::Domain;

/// The particles, walls and box of a record.
#[derive(Clone, Debug)]
pub struct System {
    /// Radii (N) [m].
    pub radius: Vec<f64>,
    /// Masses (N) [kg].
    pub mass: Vec<f64>,
    /// Moments of inertia (N) [kg m2].
    pub moment_of_inertia: Vec<f64>,
    /// Indices of the materials (N).
    pub material: Vec<usize>,
    /// Acceleration of gravity [m/s2].
    pub gravity: Vector,
    /// The box.
    pub domain: Domain,
    /// Walls (B).
    pub bodies: Vec<Wall>,
    /// Friction of pairs of materials.
    pub friction: Vec<Friction>,
    /// Whether the particles are disks, which fill the domain across their plane.
    pub disks: bool,
}

/// A wall.
#[derive(Clone, Debug)]
pub struct Wall {
    /// Name.
    pub name: String,
    /// Index of the material.
    pub material: usize,
    /// A point of the plane or of the axis, where the record does not say it [m].
    pub point: Vector,
    /// Shape about the point.
    pub shape: BodyShape,
}

/// Friction of two materials.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Friction {
    /// Indices of the materials.
    pub between: [usize; 2],
    /// Coefficient of friction [-].
    pub value: f64,
}

/// A system as a caller states it in JSON; keys are those of a scene.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Stated {
    radius: Vec<f64>,
    mass: Vec<f64>,
    moment_of_inertia: Vec<f64>,
    #[serde(default)]
    material: Vec<usize>,
    gravity: [f64; 3],
    domain: SceneDomain,
    bodies: Vec<StatedWall>,
    #[serde(default)]
    friction: Vec<Friction>,
    #[serde(default)]
    disks: bool,
}

/// The body of a scene, whose other keys do not matter here.
#[derive(Clone, Debug, Deserialize)]
struct StatedWall {
    name: String,
    #[serde(default)]
    material: usize,
    shape: SceneShape,
}

impl Wall {
    fn new(name: &str, material: usize, shape: &SceneShape) -> Self {
        let (point, shape) = match shape {
            SceneShape::Plane { point, normal } => (point, BodyShape::Plane { normal: (*normal).into() }),
            SceneShape::Cylinder { point, axis, radius } => {
                (point, BodyShape::Cylinder { axis: (*axis).into(), radius: *radius })
            }
        };
        Self { name: name.to_owned(), material, point: (*point).into(), shape }
    }
}

impl System {
    /// The system of a scene.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let column = |value: fn(&crate::case::scene::SceneParticle) -> f64| scene.particles.iter().map(value).collect();
        let friction = |pair: &crate::material::PairProperties| {
            pair.friction.map(|value| Friction { between: pair.between, value })
        };
        Self {
            radius: column(|particle| particle.radius),
            mass: column(|particle| particle.mass),
            moment_of_inertia: column(|particle| particle.moment_of_inertia),
            material: scene.particles.iter().map(|particle| particle.material).collect(),
            gravity: scene.gravity.into(),
            domain: Domain::new(&scene.domain),
            bodies: scene.bodies.iter().map(|body| Wall::new(&body.name, body.material, &body.shape)).collect(),
            friction: scene.pairs.iter().filter_map(friction).collect(),
            disks: scene.disk_height.is_some(),
        }
    }

    /// Reads a system from JSON.
    ///
    /// # Errors
    /// The text is no system; the message names the key and what is wrong.
    pub fn parse(json: &str) -> Result<Self, String> {
        let stated: Stated = serde_json::from_str(json).map_err(|error| error.to_string())?;
        let count = stated.radius.len();
        let material = if stated.material.is_empty() { vec![0; count] } else { stated.material };
        let lengths = [
            ("mass", stated.mass.len()),
            ("moment_of_inertia", stated.moment_of_inertia.len()),
            ("material", material.len()),
        ];
        if let Some((key, length)) = lengths.into_iter().find(|(_, length)| *length != count) {
            return Err(format!("{key} has {length} values, expected {count} as in radius"));
        }
        let positive = [("radius", &stated.radius), ("mass", &stated.mass)];
        for (key, values) in positive {
            if let Some(at) = values.iter().position(|value| !(*value > 0.0 && value.is_finite())) {
                return Err(format!("{key}.{at} = {}: must be positive", values[at]));
            }
        }
        let domain = Domain::new(&stated.domain);
        if let Some(axis) = (0..3).find(|axis| domain.length[*axis].is_nan() || domain.length[*axis] <= 0.0) {
            let (min, max) = (stated.domain.min[axis], stated.domain.max[axis]);
            return Err(format!("domain.max.{axis} = {max}: must be above domain.min.{axis} = {min}"));
        }
        let bodies: Vec<_> =
            stated.bodies.iter().map(|body| Wall::new(&body.name, body.material, &body.shape)).collect();
        for (at, body) in bodies.iter().enumerate() {
            let (key, direction) = match body.shape {
                BodyShape::Plane { normal } => ("normal", normal),
                BodyShape::Cylinder { axis, .. } => ("axis", axis),
            };
            if (direction.norm() - 1.0).abs().partial_cmp(&1e-9) != Some(std::cmp::Ordering::Less) {
                let [x, y, z] = <[f64; 3]>::from(direction);
                return Err(format!("bodies.{at}.shape.{key} = [{x}, {y}, {z}]: must be a unit vector"));
            }
        }
        Ok(Self {
            radius: stated.radius,
            mass: stated.mass,
            moment_of_inertia: stated.moment_of_inertia,
            material,
            gravity: stated.gravity.into(),
            domain,
            bodies,
            friction: stated.friction,
            disks: stated.disks,
        })
    }

    /// Volume of a particle [m3]; disks are as high as the domain, which their plane crosses.
    #[must_use]
    pub fn solid(&self, radius: f64) -> f64 {
        if self.disks { std::f64::consts::PI * radius * radius * self.domain.length.y } else { sphere(radius) }
    }

    /// Names of the walls.
    #[must_use]
    pub fn body_names(&self) -> Vec<&str> {
        self.bodies.iter().map(|body| body.name.as_str()).collect()
    }

    /// Index of a wall.
    ///
    /// # Errors
    /// There is no wall of this name.
    pub fn body(&self, name: &str) -> Result<usize, String> {
        let known = || format!("no body {name} (known: {})", self.body_names().join(", "));
        self.bodies.iter().position(|body| body.name == name).ok_or_else(known)
    }

    /// Weight of all particles [N].
    ///
    /// # Errors
    /// There is no gravity.
    pub fn weight(&self) -> Result<f64, String> {
        let weight = self.mass.iter().sum::<f64>() * self.gravity.norm();
        if weight > 0.0 { Ok(weight) } else { Err("it is a share of the weight, and there is no gravity".to_owned()) }
    }

    /// Friction of a particle with another, or with a wall [-].
    ///
    /// # Errors
    /// The friction of the two materials is not stated.
    pub fn friction(&self, particle: usize, other: Partner) -> Result<f64, String> {
        let materials = match other {
            Partner::Particle(j) => [self.material[particle], self.material[j]],
            Partner::Body(b) => [self.material[particle], self.bodies[b].material],
        };
        let [first, second] = materials;
        let found = self.friction.iter().find(|pair| pair.between == materials || pair.between == [second, first]);
        let missing = || format!("it needs the friction of the materials {first} and {second}, which is not stated");
        found.map(|pair| pair.value).ok_or_else(missing)
    }
}

/// What a particle touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Partner {
    /// A particle.
    Particle(usize),
    /// A wall.
    Body(usize),
}
