//! The passes over particles: velocity Verlet, and the same trajectory started half a step earlier (leapfrog).
//!
//! Both are v(n+1/2) = v(n-1/2) + a(n) dt, x(n+1) = x(n) + v(n+1/2) dt, and both evaluate forces at x(n+1) with
//! v(n+1/2). They differ in what they store: velocity Verlet completes v(n+1) by half a kick, the staggered scheme
//! keeps v(n+1/2). The end of a step and the beginning of the next are one pass where nothing looks between them.

use rayon::prelude::*;

use crate::Vector;
use crate::case::scene::Start;
use crate::contacts::{BLOCK, Contacts};
use crate::laws::memory::Memory;
use crate::laws::model::ContactModel;
use crate::particles::{Load, Motion, Particles, Place};

use super::Simulation;

/// What one pass does.
#[derive(Clone, Copy)]
pub(super) struct Pass {
    /// Whether loads are completed by the exports of other blocks.
    gather: bool,
    /// Kick that ends a step [s].
    close: f64,
    /// Kick that begins a step [s].
    open: f64,
    /// Time to move over [s].
    drift: f64,
    /// Whether displacements since the list was built are looked at.
    measure: bool,
    gravity: Vector,
}

/// How far particles moved.
#[derive(Clone, Copy, Default)]
pub(super) struct Moved {
    /// Largest squared displacement since the list was built, if it was looked at [m2].
    furthest: f64,
    /// Largest squared speed [m2/s2].
    speed: f64,
}

impl Moved {
    pub(super) fn or(self, other: Self) -> Self {
        Self { furthest: self.furthest.max(other.furthest), speed: self.speed.max(other.speed) }
    }
}

/// Particles of one block.
pub(super) struct Chunk<'a> {
    first: usize,
    place: &'a mut [Place],
    motion: &'a mut [Motion],
    load: &'a mut [Load],
    moment_of_inertia: &'a [f64],
    built: &'a [Vector],
}

impl<M: ContactModel> Simulation<M> {
    /// Ends a step: loads are gathered and velocities kicked.
    pub(super) fn arrival(&self) -> Pass {
        let close = match self.start {
            Start::Synchronized if self.step == 0 => 0.0,
            Start::Synchronized => 0.5 * self.time_step,
            Start::Staggered => self.time_step,
        };
        Pass { gather: true, close, open: 0.0, drift: 0.0, measure: false, gravity: self.gravity }
    }

    /// Begins a step: velocities are kicked and particles moved.
    pub(super) fn depart(&mut self) {
        let ((open, drift), measure) = (self.departure(), self.neighbors.may_be_stale());
        self.pass(Pass { gather: false, close: 0.0, open, drift, measure, gravity: self.gravity });
    }

    /// Ends a step and begins the next.
    pub(super) fn arrival_and_departure(&self) -> Pass {
        let ((open, drift), measure) = (self.departure(), self.neighbors.may_be_stale());
        let close = if self.start == Start::Staggered { self.time_step } else { open };
        Pass { gather: true, close, open, drift, measure, gravity: self.gravity }
    }

    fn departure(&self) -> (f64, f64) {
        match self.start {
            Start::Synchronized => (0.5 * self.time_step, self.time_step),
            Start::Staggered => (0.0, self.time_step),
        }
    }

    pub(super) fn pass(&mut self, pass: Pass) {
        let (contacts, built) = (&self.contacts, self.neighbors.built.chunks(BLOCK));
        let particles = &mut self.particles;
        let columns = particles.place.chunks_mut(BLOCK).zip(particles.motion.chunks_mut(BLOCK));
        let columns = columns.zip(particles.load.chunks_mut(BLOCK)).zip(particles.moment_of_inertia.chunks(BLOCK));
        let mut chunks = columns.zip(built).enumerate().map(|(index, ((((place, motion), load), moment), built))| {
            Chunk { first: index * BLOCK, place, motion, load, moment_of_inertia: moment, built }
        });
        let moved = if contacts.blocks.len() > 1 {
            let chunks: Vec<Chunk> = chunks.collect();
            let moved: Vec<Moved> = chunks.into_par_iter().map(|mut chunk| chunk.pass(pass, contacts)).collect();
            moved.into_iter().fold(Moved::default(), Moved::or)
        } else {
            chunks.next().map_or_else(Moved::default, |mut chunk| chunk.pass(pass, contacts))
        };
        self.note(pass, moved);
    }

    /// Largest squared displacement since the list was built [m2].
    pub(super) fn furthest(&self) -> f64 {
        let places = self.particles.place.iter().zip(&self.neighbors.built);
        places.map(|(place, built)| (place.position - built).norm_squared()).fold(0.0, f64::max)
    }

    /// Notes how far particles moved in a pass.
    pub(super) fn note(&mut self, pass: Pass, moved: Moved) {
        if pass.drift > 0.0 {
            self.fastest = moved.speed.sqrt() * pass.drift;
            self.neighbors.moved(self.fastest);
            let furthest = match (pass.measure, self.neighbors.may_be_stale()) {
                (true, _) => moved.furthest,
                // The first step by which half the skin may be used up: nobody has looked yet.
                (false, true) => self.furthest(),
                (false, false) => return,
            };
            self.stale = furthest >= self.neighbors.allowance();
        }
    }
}

impl<'a> Chunk<'a> {
    /// The particles in `range`.
    pub(super) fn of(range: std::ops::Range<usize>, particles: &'a mut Particles, built: &'a [Vector]) -> Self {
        Self {
            first: range.start,
            place: &mut particles.place[range.clone()],
            motion: &mut particles.motion[range.clone()],
            load: &mut particles.load[range.clone()],
            moment_of_inertia: &particles.moment_of_inertia[range.clone()],
            built: &built[range],
        }
    }
}

/// A pass, compiled for each width of vectors that processors have; the bits are the same for all.
struct Task<'a, 'b, H> {
    chunk: &'a mut Chunk<'b>,
    pass: Pass,
    contacts: &'a Contacts<H>,
}

impl<H: Memory> pulp::NullaryFnOnce for Task<'_, '_, H> {
    type Output = Moved;

    #[inline(always)]
    fn call(self) -> Moved {
        self.chunk.pass_here(self.pass, self.contacts)
    }
}

impl Chunk<'_> {
    pub(super) fn pass<H: Memory>(&mut self, pass: Pass, contacts: &Contacts<H>) -> Moved {
        pulp::Arch::new().dispatch(Task { chunk: self, pass, contacts })
    }

    #[inline(always)]
    fn pass_here<H: Memory>(&mut self, pass: Pass, contacts: &Contacts<H>) -> Moved {
        let mut moved = Moved::default();
        for at in 0..self.place.len() {
            let load = &mut self.load[at];
            if pass.gather {
                for import in contacts.imports(self.first + at) {
                    load.force += import.force;
                    load.torque += import.torque;
                }
            }
            let motion = &mut self.motion[at];
            let acceleration = load.force * (1.0 / motion.mass) + pass.gravity;
            let angular_acceleration = load.torque * (1.0 / self.moment_of_inertia[at]);
            let (mut velocity, mut angular_velocity) = (motion.velocity, motion.angular_velocity);
            for kick in [pass.close, pass.open] {
                if kick > 0.0 {
                    velocity += acceleration * kick;
                    angular_velocity += angular_acceleration * kick;
                }
            }
            (motion.velocity, motion.angular_velocity) = (velocity, angular_velocity);
            if pass.drift > 0.0 {
                let place = &mut self.place[at];
                place.position += velocity * pass.drift;
                let speed = velocity.norm_squared();
                moved.speed = if speed > moved.speed { speed } else { moved.speed };
                if pass.measure {
                    moved.furthest = moved.furthest.max((place.position - self.built[at]).norm_squared());
                }
            }
        }
        moved
    }
}
