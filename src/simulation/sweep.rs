//! The sweep over contacts. A block selects the candidates that may touch within the next steps, evaluates them, and adds
//! to its particles.

use rayon::prelude::*;

use crate::Vector;
use crate::bodies::{self, Body, BodyShape};
use crate::case::scene::Start;
use crate::contacts::{BLOCK, Block, Flow, Pair, Slots};
use crate::geometry::{self, ContactGeometry};
use crate::laws::Contact;
use crate::laws::model::{Action, ContactModel};
use crate::material::{self, PairProperties};
use crate::neighbors::Near;
use crate::particles::{Load, Motion, Place};

use super::Simulation;
use super::batch::{Batch, FEWEST, Images, LANES};
use super::motion::{Chunk, Moved, Pass};

/// Share by which the first, cheap test of a pair is wider than the law's own.
const SLACK: f64 = 1.0 + 1e-12;

/// Particles from the first one of a block on: its pairs reach none before.
#[derive(Clone, Copy)]
struct Local<'a> {
    first: usize,
    place: &'a [Place],
    motion: &'a [Motion],
}

impl<'a> Local<'a> {
    fn new(first: usize, place: &'a [Place], motion: &'a [Motion]) -> Self {
        Self { first, place: &place[first..], motion: &motion[first..] }
    }

    #[inline(always)]
    fn places(&self, pair: Pair) -> [&'a Place; 2] {
        [&self.place[pair.i() - self.first], &self.place[pair.j() - self.first]]
    }

    #[inline(always)]
    fn motions(&self, pair: Pair) -> [&'a Motion; 2] {
        [&self.motion[pair.i() - self.first], &self.motion[pair.j() - self.first]]
    }
}

/// What all blocks read during a sweep.
struct View<'a, M: ContactModel> {
    model: M,
    shared: &'a M::Shared,
    table: &'a [Option<PairProperties>],
    /// Values of all pairs of particles, if they are of one material.
    only: Option<&'a PairProperties>,
    materials: usize,
    bodies: &'a [Body],
    plane_radius_factor: Option<f64>,
    cylinder_curvature: Option<f64>,
    images: &'a Images,
    /// Gap up to which candidates are selected anew [m].
    selection: Option<f64>,
    elapsed: f64,
}

impl<M: ContactModel> Simulation<M> {
    /// Loads at the present positions, but for the exports, after `elapsed` [s] since the last sweep; then the pass over
    /// particles.
    pub(super) fn forces(&mut self, elapsed: f64, then: Pass) {
        let passed = self.sweep(elapsed, (rayon::current_num_threads() == 1).then_some(then));
        self.body_forces();
        let begins = self.step == 0 && self.start == Start::Synchronized;
        bodies::kick(&mut self.bodies, if begins { 0.5 * self.time_step } else { self.time_step });
        if self.ledger_kept {
            self.ledger.accumulate(&self.contacts);
        }
        match passed {
            Some(moved) => self.note(then, moved),
            None => self.pass(then),
        }
    }

    /// The sweeps over all blocks, and on one thread the pass over the particles of each block right behind.
    fn sweep(&mut self, elapsed: f64, then: Option<Pass>) -> Option<Moved> {
        self.model.advance(&mut self.shared, &self.climate.now, elapsed);
        let view = View {
            model: self.model,
            shared: &self.shared,
            table: &self.table,
            only: self.particles.material().and_then(|only| self.table[only * (self.materials + 1)].as_ref()),
            materials: self.materials,
            bodies: &self.bodies,
            plane_radius_factor: self.plane_radius_factor,
            cylinder_curvature: self.cylinder_curvature,
            images: &self.images,
            selection: self.neighbors.selection(self.fastest),
            elapsed,
        };
        let kept = self.ledger_kept || (self.accounts_kept && self.step == self.stop);
        let sweep = |local: Local, block: &mut Block<M::History>, loads: &mut [Load]| {
            if kept { view.sweep::<true>(local, block, loads) } else { view.sweep::<false>(local, block, loads) }
        };
        let (particles, contacts) = (&mut self.particles, &mut self.contacts);
        if then.is_none() && contacts.blocks.len() > 1 {
            let (place, motion) = (&particles.place[..], &particles.motion[..]);
            let loads = particles.load.par_chunks_mut(BLOCK);
            let blocks = contacts.blocks.par_iter_mut().zip(loads);
            blocks.for_each(|(block, loads)| sweep(Local::new(block.first, place, motion), block, loads));
        } else {
            let mut moved = Moved::default();
            for index in 0..contacts.blocks.len() {
                let block = &mut contacts.blocks[index];
                let (first, end) = (block.first, particles.place.len().min(block.first + BLOCK));
                let local = Local::new(first, &particles.place, &particles.motion);
                sweep(local, block, &mut particles.load[first..end]);
                if let Some(pass) = then {
                    // Later blocks do not look back, so that these particles may move while they are at hand.
                    moved = moved.or(Chunk::of(first..end, particles, &self.neighbors.built).pass(pass, contacts));
                }
            }
            return then.map(|_| moved);
        }
        None
    }

    /// Sum of the forces on each body in the order of memory [N].
    fn body_forces(&mut self) {
        for body in &mut self.bodies {
            body.force = Vector::zeros();
        }
        for block in &self.contacts.blocks {
            for (near, force) in block.near.candidates.iter().zip(&block.body_forces) {
                self.bodies[near.body as usize].force -= force;
            }
        }
    }
}

/// The sweep over one block, compiled for each width of vectors that processors have; the bits are the same for all.
struct Task<'a, 'b, M: ContactModel> {
    view: &'a View<'b, M>,
    local: Local<'a>,
    block: &'a mut Block<M::History>,
    loads: &'a mut [Load],
}

impl<M: ContactModel> pulp::NullaryFnOnce for Task<'_, '_, M> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.view.batches(self.local, self.block, self.loads);
    }
}

impl<M: ContactModel> View<'_, M> {
    fn sweep<const LEDGER: bool>(&self, local: Local, block: &mut Block<M::History>, loads: &mut [Load]) {
        loads.fill(Load::default());
        block.flow = Flow::default();
        if let Some(gap) = self.selection {
            // Only selected pairs write their exports.
            block.exports.fill(Load::default());
            let mut active = std::mem::take(&mut block.active);
            self.select(local, &block.pairs, gap, &mut active);
            block.active = active;
        }
        if M::BATCHED && !LEDGER {
            pulp::Arch::new().dispatch(Task { view: self, local, block, loads });
        } else {
            self.singles::<LEDGER>(local, 0, block, loads);
        }
        for slot in 0..block.near.candidates.len() {
            self.near::<LEDGER>(local, slot, block, loads);
        }
    }

    /// Contacts several at a time; those that fill no batch follow one by one.
    #[inline(always)]
    fn batches(&self, local: Local, block: &mut Block<M::History>, loads: &mut [Load]) {
        let mut batch = Batch::new();
        if let Some(properties) = self.only {
            (0..LANES).for_each(|lane| batch.set_properties(lane, properties));
        }
        let (first, inside) = (block.first, block.inside);
        let (candidates, exports) = (&block.pairs.candidates[..], &mut block.exports[..]);
        let (histories, living) = (&mut block.pairs.history[..], &mut block.pairs.alive[..]);
        let mut done = 0;
        while block.active.len() - done >= FEWEST {
            let slots = &block.active[done..block.active.len().min(done + LANES)];
            for (slot, lane) in slots.iter().zip(0..LANES) {
                let pair = candidates[*slot as usize];
                let motions = local.motions(pair);
                let properties = self.only.or_else(|| {
                    self.table[motions[0].material as usize * self.materials + motions[1].material as usize].as_ref()
                });
                let Some(properties) = properties else { continue };
                if self.only.is_none() {
                    batch.set_properties(lane, properties);
                }
                let (row, history) = (&self.images.rows[pair.image()], &histories[*slot as usize]);
                batch.fill(lane, local.places(pair), motions, row, properties.friction, history);
            }
            batch.evaluate(self.model, *self.shared, self.elapsed);
            for (slot, lane) in slots.iter().zip(0..LANES) {
                let slot = *slot as usize;
                let pair = candidates[slot];
                let history = batch.history(lane);
                living[slot] = history.is_some();
                histories[slot] = history.copied().unwrap_or_default();
                if slot < inside {
                    if history.is_some() {
                        batch.push::<0>(lane, &mut loads[pair.i() - first]);
                        batch.push::<1>(lane, &mut loads[pair.j() - first]);
                    }
                } else {
                    let export = &mut exports[slot - inside];
                    *export = Load::default();
                    if history.is_some() && pair.i() < pair.j() {
                        batch.push::<0>(lane, &mut loads[pair.i() - first]);
                        batch.push::<1>(lane, export);
                    } else if history.is_some() {
                        batch.push::<1>(lane, &mut loads[pair.j() - first]);
                        batch.push::<0>(lane, export);
                    }
                }
            }
            done += slots.len();
        }
        self.singles::<false>(local, done, block, loads);
    }

    /// Contacts one by one, from an entry of the active ones on.
    fn singles<const LEDGER: bool>(
        &self,
        local: Local,
        from: usize,
        block: &mut Block<M::History>,
        loads: &mut [Load],
    ) {
        for at in from..block.active.len() {
            let slot = block.active[at] as usize;
            let pair = block.pairs.candidates[slot];
            if let Some(action) = self.pair::<LEDGER>(local, pair, slot, &mut block.pairs, &mut block.flow) {
                let on_i = Load { force: action.force, torque: action.torque_i };
                let on_j = Load { force: -action.force, torque: action.torque_j };
                deliver(slot, [on_i, on_j], block, loads);
            } else {
                withhold(slot, block);
            }
        }
    }

    /// Lists the slots whose particles are nearer than a `gap` [m], or whose contacts live.
    fn select(&self, local: Local, pairs: &Slots<Pair, M::History>, gap: f64, active: &mut Vec<u32>) {
        active.resize(pairs.candidates.len(), 0);
        let mut count = 0;
        for ((pair, alive), slot) in pairs.candidates.iter().zip(&pairs.alive).zip(0u32..) {
            let [one, other] = local.places(*pair);
            let squared = (one.position - other.position + self.images.shifts[pair.image()]).norm_squared();
            let reach = one.radius + other.radius + gap;
            active[count] = slot;
            count += usize::from((squared < reach * reach * SLACK) | *alive);
        }
        active.truncate(count);
    }

    #[inline(always)]
    fn pair<const LEDGER: bool>(
        &self,
        local: Local,
        pair: Pair,
        slot: usize,
        slots: &mut Slots<Pair, M::History>,
        flow: &mut Flow,
    ) -> Option<Action> {
        let ([place_i, place_j], [motion_i, motion_j]) = (local.places(pair), local.motions(pair));
        let branch = place_i.position - place_j.position + self.images.shifts[pair.image()];
        let squared = branch.norm_squared();
        let properties =
            self.table[motion_i.material as usize * self.materials + motion_j.material as usize].as_ref()?;
        if squared == 0.0 {
            return None;
        }
        let contact = contact(
            properties,
            geometry::spheres(branch, squared, place_i.radius, place_j.radius),
            [motion_i.mass, motion_j.mass],
            motion_i.velocity - motion_j.velocity,
            [motion_i.angular_velocity, motion_j.angular_velocity],
        );
        self.evaluate::<LEDGER, _>(&contact, slot, slots, flow, &Vector::zeros())
    }

    fn near<const LEDGER: bool>(&self, local: Local, slot: usize, block: &mut Block<M::History>, loads: &mut [Load]) {
        let near = block.near.candidates[slot];
        let (particle, body) = (near.particle as usize - local.first, &self.bodies[near.body as usize]);
        let (place, motion) = (&local.place[particle], &local.motion[particle]);
        block.body_forces[slot] = Vector::zeros();
        if !body.present {
            block.near.alive[slot] = false;
            return;
        }
        let Some(mut geometry) = body.geometry(place.position, place.radius) else { return };
        match body.shape {
            BodyShape::Plane { .. } => {
                if let Some(factor) = self.plane_radius_factor {
                    geometry.radius_j = factor * geometry.radius_i;
                }
            }
            BodyShape::Cylinder { .. } => {
                if let Some(share) = self.cylinder_curvature {
                    geometry.radius_j = if share == 0.0 { f64::INFINITY } else { geometry.radius_j / share };
                }
            }
        }
        let Some(properties) = &self.table[motion.material as usize * self.materials + body.material] else { return };
        let velocity = motion.velocity - body.velocity;
        let masses = [motion.mass, f64::INFINITY];
        let contact = contact(properties, geometry, masses, velocity, [motion.angular_velocity, Vector::zeros()]);
        let slots: &mut Slots<Near, M::History> = &mut block.near;
        if let Some(action) = self.evaluate::<LEDGER, _>(&contact, slot, slots, &mut block.flow, &body.velocity) {
            push(&mut loads[particle], &Load { force: action.force, torque: action.torque_i });
            block.body_forces[slot] = action.force;
        }
    }

    /// Evaluates a contact if it lives; `wall` is the velocity of its body [m/s].
    #[inline(always)]
    fn evaluate<const LEDGER: bool, C>(
        &self,
        contact: &Contact,
        slot: usize,
        slots: &mut Slots<C, M::History>,
        flow: &mut Flow,
        wall: &Vector,
    ) -> Option<Action> {
        let history = &mut slots.history[slot];
        let alive = self.model.alive(contact.geometry.overlap, history);
        slots.alive[slot] = alive;
        let action = if alive {
            Some(self.model.evaluate(contact, self.shared, self.elapsed, history))
        } else {
            *history = M::History::default();
            None
        };
        if LEDGER {
            flow.count(contact, action.as_ref(), &mut slots.accounts[slot], self.elapsed, wall);
        }
        action
    }
}

/// Adds what a contact does to its particles, or exports it.
#[inline(always)]
fn deliver<H>(slot: usize, [on_i, on_j]: [Load; 2], block: &mut Block<H>, loads: &mut [Load]) {
    let pair = block.pairs.candidates[slot];
    if slot < block.inside {
        push(&mut loads[pair.i() - block.first], &on_i);
        push(&mut loads[pair.j() - block.first], &on_j);
    } else {
        let export = &mut block.exports[slot - block.inside];
        if pair.i() < pair.j() {
            push(&mut loads[pair.i() - block.first], &on_i);
            *export = on_j;
        } else {
            push(&mut loads[pair.j() - block.first], &on_j);
            *export = on_i;
        }
    }
}

/// Takes back what a contact exported in an earlier step.
#[inline(always)]
fn withhold<H>(slot: usize, block: &mut Block<H>) {
    if slot >= block.inside {
        block.exports[slot - block.inside] = Load::default();
    }
}

#[inline(always)]
fn push(load: &mut Load, more: &Load) {
    load.force += more.force;
    load.torque += more.torque;
}

#[inline(always)]
pub(super) fn contact(
    pair: &PairProperties,
    geometry: ContactGeometry,
    masses: [f64; 2],
    velocity: Vector,
    angular: [Vector; 2],
) -> Contact {
    let [mass_i, mass_j] = masses;
    let mass = if mass_j.is_finite() { material::reduced(mass_i, mass_j) } else { mass_i };
    let pair = pair.law(geometry.effective_radius(), mass);
    Contact { pair, geometry, velocity, angular_i: angular[0], angular_j: angular[1], masses }
}
