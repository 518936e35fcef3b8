//! A jammed periodic bed of equal spheres, built from a seed.
//!
//! Spheres are inserted at random without overlap at a packing fraction of 0.30, the cubic box is shrunk affinely
//! without friction to 0.615 at a constant rate against a weak drag, and the bed then relaxes with friction.

use std::f64::consts::PI;

use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;
use serde::{Deserialize, Serialize};

use crate::Vector;
use crate::case::scene::SceneParticle;
use crate::domain::Domain;
use crate::error::Error;
use crate::laws::model::ContactModel;
use crate::material::{self, Material, PairProperties};
use crate::simulation::Simulation;

/// Packing fraction at which spheres are inserted [-].
const DILUTE: f64 = 0.30;
/// Steps of the compression.
const COMPRESSION: u64 = 30_000;
/// Steps of the relaxation with friction.
const RELAXATION: u64 = 5_000;
/// Decay of velocities during the compression [1/s].
const DRAG: f64 = 10.0;

/// A bed and its parameters.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bed {
    /// Number of particles.
    pub count: usize,
    /// Seed.
    pub seed: u64,
    /// Edge of the cubic, periodic box [m].
    pub edge: f64,
    /// Radius [m].
    pub radius: f64,
    /// Density [kg/m3].
    pub density: f64,
    /// Young's modulus [Pa].
    pub young: f64,
    /// Poisson's ratio [-].
    pub poisson: f64,
    /// Restitution of the uncut dashpot [-].
    pub restitution: f64,
    /// Coefficient of friction [-].
    pub friction: f64,
    /// Packing fraction [-].
    pub packing_fraction: f64,
    /// Time step [s].
    pub time_step: f64,
    /// Centres by id [m].
    #[serde(skip)]
    pub position: Vec<Vector>,
    /// Velocities by id [m/s].
    #[serde(skip)]
    pub velocity: Vec<Vector>,
    /// Angular velocities by id [rad/s].
    #[serde(skip)]
    pub angular_velocity: Vec<Vector>,
}

impl Bed {
    /// Parameters of a bed that is not built yet.
    #[must_use]
    pub fn new(count: usize, seed: u64) -> Self {
        let (radius, packing_fraction) = (1e-3, 0.615);
        Self {
            count,
            seed,
            edge: edge(count, radius, packing_fraction),
            radius,
            density: 2500.0,
            young: 1e8,
            poisson: 0.3,
            restitution: 0.5,
            friction: 0.5,
            packing_fraction,
            time_step: 4e-6,
            position: Vec::new(),
            velocity: Vec::new(),
            angular_velocity: Vec::new(),
        }
    }

    /// Name of the state.
    #[must_use]
    pub fn name(&self) -> String {
        format!("jammed-bed-{}-seed-{}", self.count, self.seed)
    }

    /// Number of particles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Mass of a particle [kg].
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.density * (4.0 / 3.0 * PI * self.radius * self.radius * self.radius)
    }

    /// The box.
    #[must_use]
    pub fn domain(&self) -> Domain {
        Domain { min: Vector::zeros(), length: Vector::repeat(self.edge), periodic: [true; 3] }
    }

    /// Values of the only pair of materials.
    #[must_use]
    pub fn pair(&self, friction: f64) -> PairProperties {
        let solid = Material {
            expansion: None,
            name: "spheres".to_owned(),
            rigid: false,
            young: Some(self.young),
            poisson: Some(self.poisson),
            density: Some(self.density),
        };
        PairProperties {
            between: [0, 0],
            effective_young: material::effective_young(&solid, &solid),
            effective_shear: Some(material::effective_shear(&solid, &solid)),
            damping_ratio: material::damping_ratio(self.restitution),
            restitution: Some(self.restitution),
            friction: Some(friction),
            ..PairProperties::default()
        }
    }

    /// The particles by id.
    #[must_use]
    pub fn particles(&self) -> Vec<SceneParticle> {
        let mass = self.mass();
        let motions = self.velocity.iter().zip(&self.angular_velocity);
        self.position
            .iter()
            .zip(motions)
            .map(|(position, (velocity, angular_velocity))| SceneParticle {
                material: 0,
                radius: self.radius,
                mass,
                moment_of_inertia: 0.4 * mass * self.radius * self.radius,
                position: (*position).into(),
                velocity: (*velocity).into(),
                angular_velocity: (*angular_velocity).into(),
            })
            .collect()
    }

    fn take<M: ContactModel>(&mut self, simulation: &Simulation<M>) {
        self.edge = simulation.domain().length.x;
        self.position = simulation.particles().positions().map(|place| simulation.domain().wrap(place).0).collect();
        self.velocity = simulation.particles().velocities().collect();
        self.angular_velocity = simulation.particles().angular_velocities().collect();
    }
}

/// Builds the bed; `progress` hears finished and total steps.
///
/// # Errors
/// The bed cannot be simulated: its box is shorter than two cutoffs.
pub fn build(mut bed: Bed, progress: &dyn Fn(u64, u64)) -> Result<Bed, Error> {
    let jammed = bed.edge;
    bed.edge = edge(bed.count, bed.radius, DILUTE);
    bed.position = insert(&bed);
    bed.velocity = vec![Vector::zeros(); bed.count];
    bed.angular_velocity = vec![Vector::zeros(); bed.count];
    let total = COMPRESSION + RELAXATION;
    let rate = (bed.edge - jammed) / COMPRESSION as f64;
    let dilute = bed.edge;
    let mut simulation = super::start(&bed, 0.0)?;
    for step in 1..=COMPRESSION {
        let now = if step == COMPRESSION { jammed } else { dilute - rate * step as f64 };
        simulation.rescale(now);
        simulation.slow_down(1.0 - DRAG * bed.time_step);
        simulation.advance_to(step)?;
        progress(step, total);
    }
    bed.take(&simulation);
    let mut simulation = super::start(&bed, bed.friction)?;
    for step in (0..=RELAXATION).step_by(100) {
        simulation.advance_to(step)?;
        progress(COMPRESSION + step, total);
    }
    bed.take(&simulation);
    Ok(bed)
}

fn edge(count: usize, radius: f64, packing_fraction: f64) -> f64 {
    libm::cbrt(count as f64 * (4.0 / 3.0 * PI * radius * radius * radius) / packing_fraction)
}

/// Random sequential insertion of spheres that do not overlap.
fn insert(bed: &Bed) -> Vec<Vector> {
    let mut random = Pcg64::new(u128::from(bed.seed), 0);
    let mut uniform = || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    let diameter = 2.0 * bed.radius;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a positive count")]
    let cells = (bed.edge / diameter).floor().max(1.0) as usize;
    let mut grid: Vec<Vec<u32>> = vec![Vec::new(); cells * cells * cells];
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a coordinate inside the box")]
    let cell = |x: f64| ((x / bed.edge * cells as f64) as usize).min(cells - 1);
    let mut placed: Vec<Vector> = Vec::with_capacity(bed.count);
    while placed.len() < bed.count {
        let place = Vector::new(uniform(), uniform(), uniform()) * bed.edge;
        let home = [cell(place.x), cell(place.y), cell(place.z)];
        let around = (0..27).map(|k| {
            let [x, y, z] =
                [(0, k % 3), (1, k / 3 % 3), (2, k / 9)].map(|(axis, step)| (home[axis] + cells + step - 1) % cells);
            (z * cells + y) * cells + x
        });
        let free = around.flat_map(|cell| &grid[cell]).all(|other| {
            let mut branch = place - placed[*other as usize];
            for axis in 0..3 {
                branch[axis] -= bed.edge * (branch[axis] / bed.edge).round();
            }
            branch.norm_squared() >= diameter * diameter
        });
        if free {
            grid[(home[2] * cells + home[1]) * cells + home[0]].push(u32::try_from(placed.len()).unwrap_or(u32::MAX));
            placed.push(place);
        }
    }
    placed
}
