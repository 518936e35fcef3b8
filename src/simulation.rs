//! One step is the passes in order, nothing else: move the particles, rebuild the neighbour list if it is stale, sweep
//! over the contacts, gather.

mod batch;
mod climate;
mod drive;
mod motion;
pub mod run;
mod state;
mod states;
mod sweep;

use crate::Vector;
use crate::bodies::Body;
use crate::case::scene::{Scene, SceneParticle, Start};
use crate::contacts::{self, Contacts};
use crate::domain::Domain;
use crate::error::Error;
use crate::laws::model::ContactModel;
use crate::material::{Expansion, PairProperties};
use crate::neighbors::Neighbors;
use crate::observables::energy::Ledger;
use crate::particles::Particles;
use crate::path::Path;

use batch::Images;
use climate::Climate;
use drive::Driver;
pub use run::{Checkpoints, Options, run};

/// Skin of the neighbour list, as a share of the smallest radius.
pub const SKIN: f64 = 0.25;

/// Everything that a simulation starts from.
#[derive(Clone, Debug)]
pub struct Setup {
    /// Name in messages.
    pub name: String,
    /// The box.
    pub domain: Domain,
    /// Acceleration on every particle [m/s2].
    pub gravity: Vector,
    /// Time step [s].
    pub time_step: f64,
    /// Number of materials.
    pub materials: usize,
    /// Values of the pairs of materials that can touch.
    pub pairs: Vec<PairProperties>,
    /// Particles; their place here is their id.
    pub particles: Vec<SceneParticle>,
    /// Walls.
    pub bodies: Vec<Body>,
    /// Paths of driven particles.
    pub paths: Vec<Path>,
    /// A plane acts like a sphere whose radius is this multiple of the particle's.
    pub plane_radius_factor: Option<f64>,
    /// Share of its curvature that a cylinder has in R*.
    pub cylinder_curvature: Option<f64>,
    /// Where velocities start.
    pub start: Start,
    /// Whether an energy ledger is kept; trajectories do not depend on it.
    pub ledger: bool,
    /// Whether contacts keep accounts of what they do at the steps at which a run stops to be looked at.
    pub accounts: bool,
    /// Temperature of the particles, at which their radii stand [K]; none where it plays no part.
    pub temperature: Option<f64>,
    /// Thermal expansion of each material.
    pub expansions: Vec<Option<Expansion>>,
    /// Skin of the neighbour list [m], a quarter of the smallest radius if not given.
    pub skin: Option<f64>,
}

impl Setup {
    /// What a scene starts from.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        Self {
            name: scene.name(),
            domain: Domain::new(&scene.domain),
            gravity: scene.gravity.into(),
            time_step: scene.time_step,
            materials: scene.materials.len(),
            pairs: scene.pairs.clone(),
            particles: scene.particles.clone(),
            bodies: scene.bodies.iter().map(Body::new).collect(),
            paths: scene.drives.iter().map(|drive| Path::new(drive, scene.time_step)).collect(),
            plane_radius_factor: scene.mirror.plane_radius_factor,
            cylinder_curvature: scene.mirror.cylinder_curvature,
            start: scene.mirror.start,
            ledger: scene.energies,
            accounts: scene.contacts,
            temperature: scene.temperature,
            expansions: scene.materials.iter().map(|material| material.expansion).collect(),
            skin: None,
        }
    }

    fn refuse(&self, reason: String) -> Error {
        Error::Scene { scene: self.name.clone(), reason }
    }

    fn table(&self) -> Result<Vec<Option<PairProperties>>, Error> {
        let count = self.materials;
        let mut table = vec![None; count * count];
        for pair in &self.pairs {
            let [a, b] = pair.between;
            if a >= count || b >= count {
                return Err(self.refuse(format!("pair {a}, {b}: there are {count} materials")));
            }
            table[a * count + b] = Some(*pair);
            table[b * count + a] = Some(*pair);
        }
        Ok(table)
    }

    fn check(&self) -> Result<(), Error> {
        if let Some(path) = self.paths.iter().find(|path| path.particle as usize >= self.particles.len()) {
            return Err(self.refuse(format!("path of particle {}: there are {}", path.particle, self.particles.len())));
        }
        if self.particles.len() >= contacts::MOST {
            return Err(self.refuse(format!("{} particles, at most {}", self.particles.len(), contacts::MOST - 1)));
        }
        let materials = self.particles.iter().map(|particle| particle.material);
        if let Some(material) =
            materials.chain(self.bodies.iter().map(|body| body.material)).find(|m| *m >= self.materials)
        {
            return Err(self.refuse(format!("material {material}: there are {}", self.materials)));
        }
        Ok(())
    }
}

/// The state of a run.
pub struct Simulation<M: ContactModel> {
    name: String,
    model: M,
    shared: M::Shared,
    gravity: Vector,
    time_step: f64,
    start: Start,
    ledger_kept: bool,
    accounts_kept: bool,
    /// Step at which the run next stops to be looked at.
    stop: u64,
    climate: Climate,
    plane_radius_factor: Option<f64>,
    cylinder_curvature: Option<f64>,
    materials: usize,
    table: Vec<Option<PairProperties>>,
    domain: Domain,
    particles: Particles,
    bodies: Vec<Body>,
    drivers: Vec<Driver>,
    neighbors: Neighbors,
    contacts: Contacts<M::History>,
    /// Those of the domain.
    images: Images,
    ledger: Ledger,
    step: u64,
    rebuilds: u64,
    stale: bool,
    /// Largest displacement of a particle in the last step [m].
    fastest: f64,
}

impl<M: ContactModel> Simulation<M> {
    /// The state at step 0, its forces evaluated.
    ///
    /// # Errors
    /// The setup is inconsistent, or a periodic axis is shorter than two cutoffs.
    pub fn new(setup: &Setup, model: M) -> Result<Self, Error> {
        let mut simulation = Self::unevaluated(setup, model)?;
        simulation.rebuild()?;
        simulation.begin();
        Ok(simulation)
    }

    fn unevaluated(setup: &Setup, model: M) -> Result<Self, Error> {
        setup.check()?;
        let smallest = setup.particles.iter().map(|particle| particle.radius).fold(f64::INFINITY, f64::min);
        let skin = setup.skin.unwrap_or(if smallest.is_finite() { SKIN * smallest } else { 0.0 });
        Ok(Self {
            name: setup.name.clone(),
            shared: M::Shared::default(),
            gravity: setup.gravity,
            time_step: setup.time_step,
            start: setup.start,
            ledger_kept: setup.ledger,
            // The ledger adds up what contacts account for.
            accounts_kept: setup.accounts || setup.ledger,
            stop: 0,
            climate: Climate::new(setup),
            plane_radius_factor: setup.plane_radius_factor,
            cylinder_curvature: setup.cylinder_curvature,
            materials: setup.materials,
            table: setup.table()?,
            domain: setup.domain.clone(),
            particles: Particles::new(&setup.particles),
            bodies: setup.bodies.clone(),
            drivers: setup.paths.iter().cloned().map(Driver::new).collect(),
            neighbors: Neighbors::new(skin, model.reach()),
            contacts: Contacts::default(),
            images: Images::new(&setup.domain),
            ledger: Ledger::default(),
            step: 0,
            rebuilds: 0,
            stale: false,
            fastest: 0.0,
            model,
        })
    }

    /// Evaluates the forces of step 0 and starts the velocities where the scheme has them.
    fn begin(&mut self) {
        if self.start == Start::Staggered {
            // v(-1/2) = v(0) - g dt / 2: only the weight acts before the first contact.
            for motion in &mut self.particles.motion {
                motion.velocity -= self.gravity * (0.5 * self.time_step);
            }
        }
        self.drive(0);
        // Leapfrog is half a step on its way already: springs of contacts at the start stretch over a whole one.
        let elapsed = if self.start == Start::Staggered { self.time_step } else { 0.0 };
        self.forces(elapsed, self.arrival());
        self.ledger = Ledger::default();
        self.hold();
    }

    /// Goes on to `step`, where loads are complete and velocities as the scheme stores them.
    ///
    /// # Errors
    /// A periodic axis is shorter than two cutoffs.
    pub fn advance_to(&mut self, step: u64) -> Result<(), Error> {
        self.stop = step;
        if self.step < step {
            self.depart();
            self.drive(self.step + 1);
        }
        while self.step < step {
            for body in &mut self.bodies {
                body.drift(self.time_step, self.step + 1);
            }
            if self.stale || self.neighbors.body_displacement(&self.bodies) >= self.neighbors.allowance() {
                self.rebuild()?;
            }
            self.step += 1;
            self.warm();
            let then = if self.step < step { self.arrival_and_departure() } else { self.arrival() };
            self.forces(self.time_step, then);
            self.account_drives();
            if self.step < step {
                self.drive(self.step + 1);
            } else {
                self.hold();
            }
        }
        Ok(())
    }

    /// Builds the neighbour list anew; contacts that live keep their memory.
    ///
    /// # Errors
    /// A periodic axis is shorter than two cutoffs.
    pub fn rebuild(&mut self) -> Result<(), Error> {
        let largest = self.particles.place.iter().map(|place| place.radius).fold(0.0, f64::max);
        let cutoff = 2.0 * largest + self.neighbors.skin + self.neighbors.reach;
        if let Some(axis) = self.domain.too_short(cutoff) {
            let (length, axis) = (self.domain.length[axis], ["x", "y", "z"][axis]);
            let reason =
                format!("the periodic axis {axis} is {length} m long: at least two cutoffs, {} m", 2.0 * cutoff);
            return Err(Error::Scene { scene: self.name.clone(), reason });
        }
        let order = self.neighbors.order(&mut self.particles, &self.domain);
        self.list(Some(&order));
        self.note_built();
        self.rebuilds += 1;
        self.stale = false;
        Ok(())
    }

    /// Searches the candidates of particles that stand in order, and carries over what contacts remember.
    fn list(&mut self, order: Option<&[u32]>) {
        let (mut pairs, mut near) = self.neighbors.search(&self.particles, &self.bodies, &self.domain);
        if self.table.iter().any(Option::is_none) {
            let material = |at: u32| self.particles.motion[at as usize].material as usize;
            let stated = |a: usize, b: usize| self.table[a * self.materials + b].is_some();
            pairs.retain(|[one, other]| stated(material(*one), material(*other)));
            near.retain(|near| stated(material(near.particle), self.bodies[near.body as usize].material));
        }
        let mut contacts = Contacts::new(&self.particles, &self.domain, &pairs, &near, self.accounts_kept);
        if let Some(order) = order
            && !self.contacts.blocks.is_empty()
        {
            contacts.carry(&self.contacts, order);
        }
        self.contacts = contacts;
    }

    /// Gives the periodic axes the edge `edge` [m] and moves the particles affinely; velocities stay.
    pub fn rescale(&mut self, edge: f64) {
        let old = self.domain.length;
        self.neighbors.moved(f64::INFINITY);
        for axis in (0..3).filter(|axis| self.domain.periodic[*axis]) {
            self.domain.length[axis] = edge;
            let (min, factor) = (self.domain.min[axis], edge / old[axis]);
            for place in &mut self.particles.place {
                place.position[axis] = min + (place.position[axis] - min) * factor;
            }
        }
        self.images = Images::new(&self.domain);
    }

    /// Takes back the last half kick of velocity Verlet: the velocities that the present loads saw, to rounding.
    pub fn undo_half_kick(&mut self) {
        for (motion, load) in self.particles.motion.iter_mut().zip(&self.particles.load) {
            motion.velocity -= (load.force / motion.mass + self.gravity) * (0.5 * self.time_step);
        }
    }

    /// Multiplies all velocities by `factor`.
    pub fn slow_down(&mut self, factor: f64) {
        for motion in &mut self.particles.motion {
            motion.velocity *= factor;
            motion.angular_velocity *= factor;
        }
    }

    /// Number of finished steps.
    #[must_use]
    pub fn step(&self) -> u64 {
        self.step
    }

    /// Memory of particles, contacts and the neighbour list between two rebuilds [bytes].
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.particles.bytes() + self.contacts.bytes() + size_of_val(&self.neighbors.built[..])
    }

    /// How often the neighbour list was built.
    #[must_use]
    pub fn rebuilds(&self) -> u64 {
        self.rebuilds
    }

    /// The particles.
    #[must_use]
    pub fn particles(&self) -> &Particles {
        &self.particles
    }

    /// The walls.
    #[must_use]
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// The contacts.
    #[must_use]
    pub fn contacts(&self) -> &Contacts<M::History> {
        &self.contacts
    }

    /// The box.
    #[must_use]
    pub fn domain(&self) -> &Domain {
        &self.domain
    }

    /// The energies at the present step.
    pub fn energies(&mut self) -> Ledger {
        let ahead = if self.start == Start::Staggered { 0.5 * self.time_step } else { 0.0 };
        let driven: Vec<u32> = self.drivers.iter().map(|driver| driver.path.particle).collect();
        self.ledger.measure(&self.particles, &driven, &self.domain, &self.contacts, &self.gravity, ahead);
        self.ledger
    }
}
