//! The sweep over contacts. A block selects the candidates that may touch, evaluates them, and adds to its particles.

use rayon::prelude::*;

use crate::Vector;
use crate::bodies::{Body, BodyShape};
use crate::contacts::{Account, BLOCK, Block, Flow, Pair, Slots};
use crate::geometry;
use crate::laws::model::ContactModel;
use crate::laws::{Contact, PairLaw};
use crate::material::{self, PairProperties};
use crate::neighbors::Near;
use crate::particles::{Load, Motion, Place};

use super::Simulation;
use super::batch::{Actions, LANES, States};

/// Share by which the first, cheap test of a pair is wider than the law's own.
const SLACK: f64 = 1.0 + 1e-12;

/// Stands where a pair of materials is not stated; such pairs are no candidates.
const ABSENT: PairProperties = PairProperties {
    between: [0; 2],
    effective_young: 0.0,
    effective_shear: None,
    damping_ratio: 0.0,
    restitution: None,
    friction: None,
};

/// What all blocks read during a sweep.
struct View<'a, M: ContactModel> {
    model: M,
    shared: &'a M::Shared,
    table: &'a [Option<PairProperties>],
    absent: PairProperties,
    materials: usize,
    place: &'a [Place],
    motion: &'a [Motion],
    bodies: &'a [Body],
    plane_radius_factor: Option<f64>,
    shifts: [Vector; 32],
    reach: f64,
    elapsed: f64,
}

impl<M: ContactModel> Simulation<M> {
    /// Loads at the present positions, but for the exports; `elapsed` [s] is the time since the last sweep.
    pub(super) fn forces(&mut self, elapsed: f64) {
        self.model.advance(&mut self.shared, self.step as f64 * self.time_step, elapsed);
        let view = View {
            model: self.model,
            shared: &self.shared,
            table: &self.table,
            absent: ABSENT,
            materials: self.materials,
            place: &self.particles.place,
            motion: &self.particles.motion,
            bodies: &self.bodies,
            plane_radius_factor: self.plane_radius_factor,
            shifts: self.domain.shifts(),
            reach: self.neighbors.reach,
            elapsed,
        };
        let arch = pulp::Arch::new();
        let sweep = |block: &mut Block<M::History>, loads: &mut [Load]| {
            arch.dispatch(Task { view: &view, block, loads, ledger: self.ledger_kept });
        };
        let blocks = &mut self.contacts.blocks;
        if blocks.len() > 1 {
            let loads = self.particles.load.par_chunks_mut(BLOCK);
            blocks.par_iter_mut().zip(loads).for_each(|(block, loads)| sweep(block, loads));
        } else if let Some(block) = blocks.first_mut() {
            sweep(block, &mut self.particles.load);
        }
        self.body_forces();
        if self.ledger_kept {
            self.ledger.accumulate(&self.contacts);
        }
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
    block: &'a mut Block<M::History>,
    loads: &'a mut [Load],
    ledger: bool,
}

impl<M: ContactModel> pulp::NullaryFnOnce for Task<'_, '_, M> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        if self.ledger {
            self.view.sweep::<true>(self.block, self.loads);
        } else {
            self.view.sweep::<false>(self.block, self.loads);
        }
    }
}

impl<M: ContactModel> View<'_, M> {
    #[inline(always)]
    fn sweep<const LEDGER: bool>(&self, block: &mut Block<M::History>, loads: &mut [Load]) {
        loads.fill(Load::default());
        block.exports.fill(Load::default());
        block.flow = Flow::default();
        let mut active = std::mem::take(&mut block.active);
        self.select(&block.pairs, &mut active);
        let (mut states, mut actions) = (States::new(), Actions::new());
        let mut histories = [M::History::default(); LANES];
        for slots in active.chunks(LANES) {
            self.load(slots, &block.pairs, &mut states, &mut histories);
            self.evaluate_all(slots.len(), &states, &mut actions, &mut histories);
            self.store::<LEDGER>(slots, &actions, &histories, block, loads);
        }
        block.active = active;
        for slot in 0..block.near.candidates.len() {
            self.near::<LEDGER>(slot, block, loads);
        }
    }

    /// Lists the slots whose contacts may act now, or acted before.
    #[inline(always)]
    fn select(&self, pairs: &Slots<Pair, M::History>, active: &mut Vec<u32>) {
        active.resize(pairs.candidates.len(), 0);
        let mut count = 0;
        for ((pair, alive), slot) in pairs.candidates.iter().zip(&pairs.alive).zip(0u32..) {
            let (one, other) = (&self.place[pair.i()], &self.place[pair.j()]);
            let squared = (one.position - other.position + self.shifts[pair.image()]).norm_squared();
            let reach = one.radius + other.radius + self.reach;
            active[count] = slot;
            count += usize::from((squared < reach * reach * SLACK) | *alive);
        }
        active.truncate(count);
    }

    /// Gathers what the contacts of a batch know.
    #[inline(always)]
    fn load(
        &self,
        slots: &[u32],
        pairs: &Slots<Pair, M::History>,
        states: &mut States,
        histories: &mut [M::History; LANES],
    ) {
        for (slot, lane) in slots.iter().zip(0..LANES) {
            let pair = pairs.candidates[*slot as usize];
            histories[lane] = pairs.history[*slot as usize];
            let (place_i, place_j) = (&self.place[pair.i()], &self.place[pair.j()]);
            let (motion_i, motion_j) = (&self.motion[pair.i()], &self.motion[pair.j()]);
            states.branch.set(lane, &(place_i.position - place_j.position + self.shifts[pair.image()]));
            states.velocity.set(lane, &(motion_i.velocity - motion_j.velocity));
            states.angular_i.set(lane, &motion_i.angular_velocity);
            states.angular_j.set(lane, &motion_j.angular_velocity);
            states.radius_i[lane] = place_i.radius;
            states.radius_j[lane] = place_j.radius;
            states.mass_i[lane] = motion_i.mass;
            states.mass_j[lane] = motion_j.mass;
            let properties = &self.table[motion_i.material as usize * self.materials + motion_j.material as usize];
            let properties = properties.as_ref().unwrap_or(&self.absent);
            states.young[lane] = properties.effective_young;
            states.shear[lane] = properties.effective_shear.unwrap_or_default();
            states.friction[lane] = properties.friction.unwrap_or_default();
            states.damping[lane] = properties.damping_ratio;
        }
    }

    /// Evaluates a batch. Nothing here depends on another lane, so that the compiler takes several at a time where the
    /// law chooses by value.
    #[inline(always)]
    fn evaluate_all(&self, count: usize, states: &States, actions: &mut Actions, histories: &mut [M::History; LANES]) {
        // Copies: what stands behind `self` might otherwise change with every lane, for all that the compiler knows.
        let (model, shared, elapsed) = (self.model, *self.shared, self.elapsed);
        for lane in 0..count.next_multiple_of(8).min(LANES) {
            let branch = states.branch.get(lane);
            let squared = branch.norm_squared();
            let geometry = geometry::spheres(branch, squared, states.radius_i[lane], states.radius_j[lane]);
            let contact = Contact {
                pair: PairLaw {
                    effective_young: states.young[lane],
                    effective_shear: states.shear[lane],
                    friction: states.friction[lane],
                    effective_radius: material::reduced(geometry.radius_i, geometry.radius_j),
                    effective_mass: material::reduced(states.mass_i[lane], states.mass_j[lane]),
                    damping_ratio: states.damping[lane],
                },
                geometry,
                velocity: states.velocity.get(lane),
                angular_i: states.angular_i.get(lane),
                angular_j: states.angular_j.get(lane),
            };
            let history = &mut histories[lane];
            let alive = (squared > 0.0) & model.alive(geometry.overlap, history);
            let action = model.evaluate(&contact, &shared, elapsed, history);
            actions.alive[lane] = alive;
            actions.force.set(lane, &action.force);
            actions.torque_i.set(lane, &action.torque_i);
            actions.torque_j.set(lane, &action.torque_j);
            actions.normal_force[lane] = action.normal.force;
            actions.damping_force[lane] = action.normal.force - action.normal.elastic;
            actions.energy[lane] = action.normal.energy;
            actions.approach[lane] = contact.approach().normal_velocity;
        }
    }

    /// Writes what a batch did into its slots and adds it to the particles.
    #[inline(always)]
    fn store<const LEDGER: bool>(
        &self,
        slots: &[u32],
        actions: &Actions,
        histories: &[M::History; LANES],
        block: &mut Block<M::History>,
        loads: &mut [Load],
    ) {
        let first = block.first;
        for (slot, lane) in slots.iter().zip(0..LANES) {
            let slot = *slot as usize;
            let alive = actions.alive[lane];
            block.pairs.alive[slot] = alive;
            block.pairs.history[slot] = if alive { histories[lane] } else { M::History::default() };
            if LEDGER {
                let now = if alive { actions.account(lane) } else { Account::default() };
                let account = &mut block.pairs.accounts[slot];
                block.flow.add(&now, account, actions.approach[lane], self.elapsed, &Vector::zeros());
                *account = now;
            }
            if !alive {
                continue;
            }
            let pair = block.pairs.candidates[slot];
            let force = actions.force.get(lane);
            let on_i = Load { force, torque: actions.torque_i.get(lane) };
            let on_j = Load { force: -force, torque: actions.torque_j.get(lane) };
            if slot < block.inside {
                push(&mut loads[pair.i() - first], &on_i);
                push(&mut loads[pair.j() - first], &on_j);
            } else {
                let export = &mut block.exports[slot - block.inside];
                if pair.i() < pair.j() {
                    push(&mut loads[pair.i() - first], &on_i);
                    *export = on_j;
                } else {
                    push(&mut loads[pair.j() - first], &on_j);
                    *export = on_i;
                }
            }
        }
    }

    fn near<const LEDGER: bool>(&self, slot: usize, block: &mut Block<M::History>, loads: &mut [Load]) {
        let near = block.near.candidates[slot];
        let (particle, body) = (near.particle as usize, &self.bodies[near.body as usize]);
        let (place, motion) = (&self.place[particle], &self.motion[particle]);
        block.body_forces[slot] = Vector::zeros();
        let Some(mut geometry) = body.geometry(place.position, place.radius) else { return };
        if let (BodyShape::Plane { .. }, Some(factor)) = (body.shape, self.plane_radius_factor) {
            geometry.radius_j = factor * geometry.radius_i;
        }
        let Some(properties) = &self.table[motion.material as usize * self.materials + body.material] else { return };
        let contact = Contact {
            pair: PairLaw {
                effective_young: properties.effective_young,
                effective_shear: properties.effective_shear.unwrap_or_default(),
                friction: properties.friction.unwrap_or_default(),
                effective_radius: geometry.effective_radius(),
                effective_mass: motion.mass,
                damping_ratio: properties.damping_ratio,
            },
            geometry,
            velocity: motion.velocity - body.velocity,
            angular_i: motion.angular_velocity,
            angular_j: Vector::zeros(),
        };
        let slots: &mut Slots<Near, M::History> = &mut block.near;
        let history = &mut slots.history[slot];
        let alive = self.model.alive(contact.geometry.overlap, history);
        let mut now = Account::default();
        if alive {
            let action = self.model.evaluate(&contact, self.shared, self.elapsed, history);
            push(&mut loads[particle - block.first], &Load { force: action.force, torque: action.torque_i });
            block.body_forces[slot] = action.force;
            now = Account {
                force: action.force,
                normal_force: action.normal.force,
                damping_force: action.normal.force - action.normal.elastic,
                energy: action.normal.energy,
            };
        } else {
            *history = M::History::default();
        }
        slots.alive[slot] = alive;
        if LEDGER {
            let account = &mut slots.accounts[slot];
            block.flow.add(&now, account, contact.approach().normal_velocity, self.elapsed, &body.velocity);
            *account = now;
        }
    }
}

#[inline(always)]
fn push(load: &mut Load, more: &Load) {
    load.force += more.force;
    load.torque += more.torque;
}

impl Flow {
    /// Adds the work of the last step `elapsed` [s], from the forces at its two ends and the velocities between: of the
    /// contact along the normal and of its body [m/s].
    fn add(&mut self, now: &Account, then: &Account, approach: f64, elapsed: f64, body: &Vector) {
        let mean = |now: f64, then: f64| 0.5 * (now + then);
        self.dissipated += mean(now.damping_force, then.damping_force) * approach * elapsed;
        self.entered += (mean(now.normal_force, then.normal_force) * approach * elapsed).max(0.0);
        self.body_work += 0.5 * (now.force + then.force).dot(body) * elapsed;
    }
}
