//! Particles: packed records for the sweeps over contacts, in the order of a space-filling curve.
//!
//! A particle is known by its id, its place in the scene. The order in memory changes at every rebuild of the neighbour
//! list and depends on positions only, so that no result depends on the order of the input.

use crate::Vector;
use crate::case::scene::SceneParticle;
use crate::domain::Domain;

/// What the search for contacts reads.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub struct Place {
    /// Centre [m].
    pub position: Vector,
    /// Radius [m].
    pub radius: f64,
}

/// What a contact reads besides: one cache line.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Motion {
    /// Velocity [m/s].
    pub velocity: Vector,
    /// Angular velocity [rad/s].
    pub angular_velocity: Vector,
    /// Mass [kg].
    pub mass: f64,
    /// Index of the material.
    pub material: u32,
    /// Place of the particle in the scene.
    pub id: u32,
}

/// What contacts do to a particle.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct Load {
    /// Sum of contact forces, weight excluded [N].
    pub force: Vector,
    /// Sum of contact torques [N m].
    pub torque: Vector,
}

/// All particles, in the order of memory.
#[derive(Clone, Debug, Default)]
pub struct Particles {
    /// Places.
    pub place: Vec<Place>,
    /// Motions.
    pub motion: Vec<Motion>,
    /// Loads.
    pub load: Vec<Load>,
    /// Moments of inertia [kg m2].
    pub moment_of_inertia: Vec<f64>,
    /// Place in memory of each id.
    index: Vec<u32>,
    /// Edges of the box that each id has left behind along periodic axes.
    crossings: Vec<[i32; 3]>,
    /// The material of all particles, if there is only one.
    material: Option<usize>,
}

impl Particles {
    /// Particles at their start, in the order of their ids.
    #[must_use]
    pub fn new(particles: &[SceneParticle]) -> Self {
        let mut columns = Self::default();
        for (id, particle) in (0..).zip(particles) {
            columns.place.push(Place { position: particle.position.into(), radius: particle.radius });
            columns.motion.push(Motion {
                velocity: particle.velocity.into(),
                angular_velocity: particle.angular_velocity.into(),
                mass: particle.mass,
                material: u32::try_from(particle.material).unwrap_or(u32::MAX),
                id,
            });
            columns.moment_of_inertia.push(particle.moment_of_inertia);
            columns.index.push(id);
        }
        columns.load = vec![Load::default(); particles.len()];
        columns.crossings = vec![[0; 3]; particles.len()];
        let first = particles.first().map(|particle| particle.material);
        columns.material = first.filter(|first| particles.iter().all(|particle| particle.material == *first));
        columns
    }

    /// Number of particles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.place.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.place.is_empty()
    }

    /// Index of the material of all particles, if there is only one.
    #[must_use]
    pub fn material(&self) -> Option<usize> {
        self.material
    }

    /// Place in memory of each id.
    #[must_use]
    pub fn index(&self) -> &[u32] {
        &self.index
    }

    /// Memory of the columns [bytes].
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&self.place[..])
            + size_of_val(&self.motion[..])
            + size_of_val(&self.load[..])
            + size_of_val(&self.moment_of_inertia[..])
            + size_of_val(&self.index[..])
    }

    /// Puts the particle at place `order[k]` to place k.
    pub fn reorder(&mut self, order: &[u32]) {
        fn take<T: Copy>(column: &mut Vec<T>, order: &[u32]) {
            *column = order.iter().map(|old| column[*old as usize]).collect();
        }
        take(&mut self.place, order);
        take(&mut self.motion, order);
        take(&mut self.load, order);
        take(&mut self.moment_of_inertia, order);
        for (place, motion) in (0..).zip(&self.motion) {
            self.index[motion.id as usize] = place;
        }
    }

    /// Moves particles back into the box, and counts the edges that they have left behind.
    pub fn wrap(&mut self, domain: &Domain) {
        for (place, motion) in self.place.iter_mut().zip(&self.motion) {
            let (position, crossings) = domain.wrap(place.position);
            place.position = position;
            for (sum, crossing) in self.crossings[motion.id as usize].iter_mut().zip(crossings) {
                *sum = sum.saturating_add(crossing);
            }
        }
    }

    /// The centre of the particle at a place in memory as if no axis were periodic: its trajectory has no jumps [m].
    #[must_use]
    pub fn unwrapped(&self, at: usize, domain: &Domain) -> Vector {
        let crossings = self.crossings[self.motion[at].id as usize];
        let mut place = self.place[at].position;
        for axis in (0..3).filter(|axis| crossings[*axis] != 0) {
            place[axis] += domain.length[axis] * f64::from(crossings[axis]);
        }
        place
    }

    /// Centres by id as if no axis were periodic [m].
    pub fn unwrapped_positions(&self, domain: &Domain) -> impl Iterator<Item = Vector> {
        self.index.iter().map(|at| self.unwrapped(*at as usize, domain))
    }

    /// Edges of the box left behind, by id, as a checkpoint holds them.
    pub fn crossings(&self) -> impl Iterator<Item = Vector> {
        self.crossings.iter().map(|crossings| crossings.map(f64::from).into())
    }

    /// Takes the edges left behind from a checkpoint.
    pub fn set_crossings(&mut self, crossings: &[Vector]) {
        #[expect(clippy::cast_possible_truncation, reason = "they were saved from such integers")]
        let count = |edges: &Vector| [edges.x as i32, edges.y as i32, edges.z as i32];
        self.crossings = crossings.iter().map(count).collect();
    }

    /// Centres in the box by id [m]; between two builds of the neighbour list they may lie just outside.
    pub fn positions(&self) -> impl Iterator<Item = Vector> {
        self.index.iter().map(|at| self.place[*at as usize].position)
    }

    /// Radii by id [m].
    pub fn radii(&self) -> impl Iterator<Item = f64> {
        self.index.iter().map(|at| self.place[*at as usize].radius)
    }

    /// Velocities by id [m/s].
    pub fn velocities(&self) -> impl Iterator<Item = Vector> {
        self.index.iter().map(|at| self.motion[*at as usize].velocity)
    }

    /// Angular velocities by id [rad/s].
    pub fn angular_velocities(&self) -> impl Iterator<Item = Vector> {
        self.index.iter().map(|at| self.motion[*at as usize].angular_velocity)
    }

    /// Loads by id.
    pub fn loads(&self) -> impl Iterator<Item = Load> {
        self.index.iter().map(|at| self.load[*at as usize])
    }
}
