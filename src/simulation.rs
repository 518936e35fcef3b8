//! One step is the passes in order, nothing else.

use rayon::prelude::*;

use crate::Vector;
use crate::bodies::Body;
use crate::case::model::{ForceCut, MomentLaw, NormalLaw, TangentialLaw};
use crate::case::scene::{Scene, Start};
use crate::contacts::{Contacts, Partner, Slot, SlotState};
use crate::error::Error;
use crate::geometry;
use crate::integrate;
use crate::laws::model::{Composed, ContactModel, Free, Frictionless};
use crate::laws::normal::hertz::Hertz;
use crate::laws::{Contact, PairLaw};
use crate::material::{self, PairProperties};
use crate::neighbors::Neighbors;
use crate::observables::energy::{self, Ledger, Synchronized};
use crate::particles::Particles;
use crate::record::Recorder;

/// Contacts or particles that one task takes: fixed, so that nothing depends on the number of threads.
const CHUNK: usize = 256;

/// Runs a scene on `threads` threads; `progress` hears the number of finished steps.
///
/// # Errors
/// The scene is not valid, names a law that this build does not have, or its run diverges.
pub fn run(scene: &Scene, threads: usize, progress: &(dyn Fn(u64) + Sync)) -> Result<Recorder, Error> {
    scene.check()?;
    let model = &scene.model;
    if !matches!((&model.tangential, &model.moments), (TangentialLaw::Frictionless {}, MomentLaw::Free {})) {
        let reason = format!("this version has no law {:?} with {:?}", model.tangential, model.moments);
        return Err(Error::Scene { scene: scene.name(), reason });
    }
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| Error::Scene { scene: scene.name(), reason: error.to_string() })?;
    pool.install(|| match &scene.model.normal {
        NormalLaw::Hertz { force_cut } => {
            let normal = Hertz { force_cut: ForceCut::cuts(*force_cut) };
            Simulation::new(scene, Composed { normal, tangential: Frictionless, moments: Free }).run(progress)
        }
        other => Err(Error::Scene { scene: scene.name(), reason: format!("this version has no law {other:?}") }),
    })
}

/// The state of a run.
struct Simulation<'a, M: ContactModel> {
    scene: &'a Scene,
    model: M,
    shared: M::Shared,
    gravity: Vector,
    table: Vec<Option<PairProperties>>,
    particles: Particles,
    bodies: Vec<Body>,
    neighbors: Neighbors,
    contacts: Contacts<M::History>,
    ledger: Ledger,
}

impl<'a, M: ContactModel> Simulation<'a, M> {
    fn new(scene: &'a Scene, model: M) -> Self {
        let count = scene.materials.len();
        let mut table = vec![None; count * count];
        for pair in &scene.pairs {
            let [a, b] = pair.between;
            table[a * count + b] = Some(*pair);
            table[b * count + a] = Some(*pair);
        }
        let particles = Particles::new(scene);
        Self {
            scene,
            model,
            shared: M::Shared::default(),
            gravity: scene.gravity.into(),
            table,
            neighbors: Neighbors::new(&particles, model.reach()),
            bodies: scene.bodies.iter().map(Body::new).collect(),
            contacts: Contacts::default(),
            ledger: Ledger::default(),
            particles,
        }
    }

    fn run(mut self, progress: &(dyn Fn(u64) + Sync)) -> Result<Recorder, Error> {
        let mut recorder = Recorder::new(self.scene);
        match self.scene.mirror.start {
            Start::Synchronized => self.velocity_verlet(&mut recorder, progress)?,
            Start::Staggered => self.staggered(&mut recorder, progress)?,
        }
        Ok(recorder)
    }

    fn velocity_verlet(&mut self, recorder: &mut Recorder, progress: &(dyn Fn(u64) + Sync)) -> Result<(), Error> {
        let dt = self.scene.time_step;
        self.forces(0, 0.0);
        self.sample(recorder, 0, 0.0)?;
        for step in 1..=self.scene.steps {
            integrate::kick(&mut self.particles, &self.gravity, 0.5 * dt);
            self.drift(dt);
            self.forces(step, dt);
            integrate::kick(&mut self.particles, &self.gravity, 0.5 * dt);
            self.sample(recorder, step, 0.0)?;
            progress(step);
        }
        Ok(())
    }

    fn staggered(&mut self, recorder: &mut Recorder, progress: &(dyn Fn(u64) + Sync)) -> Result<(), Error> {
        let dt = self.scene.time_step;
        // v(-1/2) = v(0) - g dt / 2: only the weight acts before the first contact.
        for velocity in &mut self.particles.velocity {
            *velocity -= self.gravity * (0.5 * dt);
        }
        for step in 0..=self.scene.steps {
            self.forces(step, if step == 0 { 0.0 } else { dt });
            integrate::kick(&mut self.particles, &self.gravity, dt);
            self.sample(recorder, step, 0.5 * dt)?;
            self.drift(dt);
            progress(step);
        }
        Ok(())
    }

    fn drift(&mut self, dt: f64) {
        integrate::drift(&mut self.particles, dt);
        for body in &mut self.bodies {
            body.drift(dt);
        }
    }

    /// Forces at the present positions; `elapsed` [s] is the time since the last sweep.
    fn forces(&mut self, step: u64, elapsed: f64) {
        let reach = self.model.reach();
        if self.neighbors.stale(&self.particles, &self.bodies, reach) {
            let pairs = self.neighbors.rebuild(&self.particles, &self.bodies);
            self.contacts.replace(&pairs, self.particles.len());
        }
        self.model.advance(&mut self.shared, step as f64 * self.scene.time_step, elapsed);
        let mut slots = std::mem::take(&mut self.contacts.slots);
        let this = &*self;
        if slots.len() > CHUNK {
            slots.par_chunks_mut(CHUNK).for_each(|chunk| chunk.iter_mut().for_each(|slot| this.contact(slot, elapsed)));
        } else {
            for slot in &mut slots {
                this.contact(slot, elapsed);
            }
        }
        self.contacts.slots = slots;
        self.gather();
        energy::body_forces(&self.contacts, &mut self.bodies);
        self.ledger.accumulate(&self.contacts);
    }

    fn gather(&mut self) {
        let Particles { force, torque, .. } = &mut self.particles;
        let contacts = &self.contacts;
        let sum = |first: usize, force: &mut [Vector], torque: &mut [Vector]| {
            for (offset, (force, torque)) in force.iter_mut().zip(torque).enumerate() {
                (*force, *torque) = contacts.gather(first + offset);
            }
        };
        if force.len() > CHUNK {
            let chunks = force.par_chunks_mut(CHUNK).zip(torque.par_chunks_mut(CHUNK)).enumerate();
            chunks.for_each(|(chunk, (force, torque))| sum(chunk * CHUNK, force, torque));
        } else {
            sum(0, force, torque);
        }
    }

    /// Evaluates one slot over the last `elapsed` [s].
    fn contact(&self, slot: &mut Slot<M::History>, elapsed: f64) {
        let Some((contact, wall)) = self.describe(slot) else { return };
        let before = slot.state;
        let normal_velocity = contact.approach().normal_velocity;
        slot.state = SlotState::default();
        slot.alive = self.model.alive(contact.geometry.overlap, &slot.history);
        if slot.alive {
            let action = self.model.evaluate(&contact, &self.shared, elapsed, &mut slot.history);
            slot.state.force = action.force;
            slot.state.torque_i = action.torque_i;
            slot.state.torque_j = action.torque_j;
            slot.state.normal_force = action.normal.force;
            slot.state.damping_force = action.normal.force - action.normal.elastic;
            slot.state.energy = action.normal.energy;
        } else {
            slot.history = M::History::default();
        }
        let mean = |now: f64, then: f64| 0.5 * (now + then);
        slot.state.dissipated = mean(slot.state.damping_force, before.damping_force) * normal_velocity * elapsed;
        slot.state.entered = (mean(slot.state.normal_force, before.normal_force) * normal_velocity * elapsed).max(0.0);
        slot.state.body_work = 0.5 * (slot.state.force + before.force).dot(&wall) * elapsed;
    }

    /// What a law may know of a slot's contact, and the velocity of its body [m/s].
    fn describe(&self, slot: &Slot<M::History>) -> Option<(Contact, Vector)> {
        let particles = &self.particles;
        let i = slot.i as usize;
        let (mut geometry, mass, material, velocity, angular, wall) = match slot.partner {
            Partner::Particle(j) => {
                let j = j as usize;
                let geometry = geometry::sphere_sphere(
                    particles.position[i],
                    particles.radius[i],
                    particles.position[j],
                    particles.radius[j],
                )?;
                let mass = material::reduced(particles.mass[i], particles.mass[j]);
                let velocity = particles.velocity[j];
                (geometry, mass, particles.material[j], velocity, particles.angular_velocity[j], Vector::zeros())
            }
            Partner::Body(j) => {
                let body = &self.bodies[j as usize];
                let geometry =
                    geometry::sphere_plane(particles.position[i], particles.radius[i], body.point, body.normal);
                (geometry, particles.mass[i], body.material, body.velocity, Vector::zeros(), body.velocity)
            }
        };
        if let (Partner::Body(_), Some(factor)) = (slot.partner, self.scene.mirror.plane_radius_factor) {
            geometry.radius_j = factor * geometry.radius_i;
        }
        let pair = self.table[particles.material[i] * self.scene.materials.len() + material]?;
        let pair = PairLaw {
            effective_young: pair.effective_young,
            effective_radius: geometry.effective_radius(),
            effective_mass: mass,
            damping_ratio: pair.damping_ratio,
        };
        let velocity = particles.velocity[i] - velocity;
        let contact =
            Contact { pair, geometry, velocity, angular_i: particles.angular_velocity[i], angular_j: angular };
        Some((contact, wall))
    }

    /// Records the present state if it is due; velocities are ahead of positions by `ahead` [s].
    fn sample(&mut self, recorder: &mut Recorder, step: u64, ahead: f64) -> Result<(), Error> {
        if !step.is_multiple_of(self.scene.output_every) {
            return Ok(());
        }
        if let Some(particle) = self.particles.position.iter().position(|x| !x.iter().all(|c| c.is_finite())) {
            return Err(Error::Diverged { scene: self.scene.name(), particle, step });
        }
        let mut synchronized = Synchronized::default();
        integrate::synchronized(&self.particles, &self.gravity, ahead, &mut synchronized);
        self.ledger.measure(&self.particles, &self.contacts, &self.gravity, &synchronized);
        recorder.sample(step, &self.particles, &self.bodies, &self.ledger);
        Ok(())
    }
}
