//! The state of a simulation as a checkpoint holds it: by id, so that it does not depend on the order of memory.
//!
//! The neighbour list is not stored but the places for which it was built: from them the same list is built again, and
//! with it the same order of every sum.

use std::collections::BTreeMap;

use crate::Vector;
use crate::bodies::Drive;
use crate::case::scene::SceneStage;
use crate::contacts::{Account, Slots};
use crate::error::Error;
use crate::laws::memory::Memory;
use crate::laws::model::ContactModel;
use crate::observables::energy::Ledger;
use crate::record::checkpoint::Checkpoint;

use super::{Setup, Simulation};

/// Living contacts as they are stored.
struct Living<H> {
    keys: Vec<u64>,
    histories: Vec<H>,
    accounts: Vec<Account>,
}

impl<H: Memory> Living<H> {
    fn new() -> Self {
        Self { keys: Vec::new(), histories: Vec::new(), accounts: Vec::new() }
    }

    fn add<C>(&mut self, slots: &Slots<C, H>, key: impl Fn(&C) -> [u64; 2]) {
        for slot in (0..slots.candidates.len()).filter(|slot| slots.alive[*slot]) {
            self.keys.extend(key(&slots.candidates[slot]));
            self.histories.push(slots.history[slot]);
            self.accounts.push(slots.accounts.get(slot).copied().unwrap_or_default());
        }
    }

    fn save(self, kind: &str, into: &mut Checkpoint) {
        into.put_counts(&format!("{kind}_keys"), self.keys);
        into.put_all(&format!("{kind}_histories"), self.histories);
        into.put_all(&format!("{kind}_accounts"), self.accounts);
    }

    fn restore(kind: &str, from: &Checkpoint) -> BTreeMap<[u64; 2], (H, Account)> {
        let keys = from.get_counts(&format!("{kind}_keys"));
        let histories = from.get_all(&format!("{kind}_histories"), keys.len() / 2);
        let accounts = from.get_all(&format!("{kind}_accounts"), keys.len() / 2);
        keys.chunks_exact(2).map(|key| [key[0], key[1]]).zip(histories.into_iter().zip(accounts)).collect()
    }
}

fn refill<C, H: Memory>(
    slots: &mut Slots<C, H>,
    saved: &BTreeMap<[u64; 2], (H, Account)>,
    key: impl Fn(&C) -> [u64; 2],
) -> usize {
    let mut found = 0;
    for slot in 0..slots.candidates.len() {
        if let Some((history, account)) = saved.get(&key(&slots.candidates[slot])) {
            slots.history[slot] = *history;
            slots.alive[slot] = true;
            if let Some(into) = slots.accounts.get_mut(slot) {
                *into = *account;
            }
            found += 1;
        }
    }
    found
}

impl<M: ContactModel> Simulation<M> {
    /// Adds the state to a checkpoint.
    pub fn save(&self, into: &mut Checkpoint) {
        let particles = &self.particles;
        into.put_counts("step", vec![self.step, self.rebuilds]);
        into.put_all("position", particles.positions());
        into.put_all("crossings", particles.crossings());
        into.put_all("velocity", particles.velocities());
        into.put_all("angular_velocity", particles.angular_velocities());
        into.put_all("force", particles.loads().map(|load| load.force));
        into.put_all("torque", particles.loads().map(|load| load.torque));
        into.put_all("built_position", particles.index().iter().map(|at| self.neighbors.built[*at as usize]));
        into.put_all("body_point", self.bodies.iter().map(|body| body.point));
        into.put_all("body_origin", self.bodies.iter().map(|body| body.origin));
        into.put_all("body_velocity", self.bodies.iter().map(|body| body.velocity));
        into.put_all("body_force", self.bodies.iter().map(|body| body.force));
        into.put_all("built_body_point", self.neighbors.built_bodies.iter().copied());
        into.put_all("box", [self.domain.min, self.domain.length]);
        into.put("climate", self.climate.saved());
        into.put("grown", vec![self.neighbors.grown]);
        into.put_all("shared", [self.shared]);
        into.put_all("ledger", [self.ledger]);
        let id = |at: usize| u64::from(particles.motion[at].id);
        let (mut pairs, mut near) = (Living::new(), Living::new());
        for block in &self.contacts.blocks {
            pairs.add(&block.pairs, |pair| [id(pair.i()), id(pair.j())]);
            near.add(&block.near, |near| [id(near.particle as usize), u64::from(near.body)]);
        }
        pairs.save("pair", into);
        near.save("near", into);
    }

    /// The simulation whose state a checkpoint holds; `stages` are those that began before it.
    ///
    /// # Errors
    /// The setup is inconsistent, or the checkpoint does not fit it.
    pub fn restore(setup: &Setup, model: M, from: &Checkpoint, stages: &[(u64, &SceneStage)]) -> Result<Self, Error> {
        let mut simulation = Self::unevaluated(setup, model)?;
        for (first, stage) in stages {
            simulation.begin_stage(stage, *first);
        }
        simulation.stale = false;
        let misfit = || setup.refuse("the checkpoint does not fit the scene".to_owned());
        let count = simulation.particles.len();
        let names = ["position", "crossings", "velocity", "angular_velocity", "force", "torque", "built_position"];
        let bodies = ["body_point", "body_origin", "body_velocity", "body_force", "built_body_point"];
        let fits = names.iter().all(|name| from.get(name).len() == 3 * count)
            && bodies.iter().all(|name| from.get(name).len() == 3 * simulation.bodies.len());
        let (&[step, rebuilds], [min, length], true) = (from.get_counts("step"), &from.vectors("box")[..], fits) else {
            return Err(misfit());
        };
        let (true, &[grown]) = (simulation.climate.restore(from.get("climate")), from.get("grown")) else {
            return Err(misfit());
        };
        (simulation.step, simulation.rebuilds) = (step, rebuilds);
        (simulation.domain.min, simulation.domain.length) = (*min, *length);
        simulation.shared = from.get_all("shared", 1)[0];
        simulation.ledger = from.get_all("ledger", 1)[0];
        for (place, built) in simulation.particles.place.iter_mut().zip(from.vectors("built_position")) {
            place.position = built;
        }
        for (body, built) in simulation.bodies.iter_mut().zip(from.vectors("built_body_point")) {
            body.point = built;
        }
        simulation.as_built();
        simulation.neighbors.order(&mut simulation.particles, &simulation.domain);
        simulation.list(None);
        simulation.as_now();
        simulation.neighbors.grown = grown;
        simulation.neighbors.moved(f64::INFINITY);
        simulation.place(from);
        if simulation.fill(from) { Ok(simulation) } else { Err(misfit()) }
    }

    /// The simulation at step 0 whose state is that of another scene with the same particles. Bodies are those of the same
    /// name: `names` are the other scene's. Motions are those of the setup.
    ///
    /// # Errors
    /// The setup is inconsistent, or the state does not fit it.
    pub fn branch(setup: &Setup, model: M, from: &Checkpoint, names: &[String]) -> Result<Self, Error> {
        let own = |name: &String| setup.bodies.iter().position(|body| body.name == *name);
        let place: Vec<Option<usize>> = names.iter().map(own).collect();
        let mut state = from.clone();
        for column in ["body_point", "body_origin", "body_velocity", "body_force", "built_body_point"] {
            let mut values: Vec<Vector> = setup.bodies.iter().map(|body| body.point).collect();
            if matches!(column, "body_velocity" | "body_force") {
                values.fill(Vector::zeros());
            }
            for (value, place) in from.vectors(column).into_iter().zip(&place) {
                if let Some(place) = place {
                    values[*place] = value;
                }
            }
            state.put_all(column, values);
        }
        let kept = |key: &[u64]| {
            let body = usize::try_from(key[1]).ok().and_then(|body| *place.get(body)?);
            body.map(|body| [key[0], body as u64])
        };
        let keys: Vec<Option<[u64; 2]>> = from.get_counts("near_keys").chunks_exact(2).map(kept).collect();
        for column in ["near_histories", "near_accounts"] {
            let values = from.get(column);
            let width = values.len() / keys.len().max(1);
            let rows = values.chunks_exact(width.max(1)).zip(&keys).filter(|(_, key)| key.is_some());
            state.put(column, rows.flat_map(|(row, _)| row.iter().copied()).collect());
        }
        state.put_counts("near_keys", keys.into_iter().flatten().flatten().collect());
        let mut simulation = Self::restore(setup, model, &state, &[])?;
        simulation.step = 0;
        simulation.climate.hold();
        simulation.ledger = Ledger::default();
        for (body, stated) in simulation.bodies.iter_mut().zip(&setup.bodies) {
            match stated.drive {
                // A path begins where the other scene left the body, a servo wall keeps its velocity.
                Drive::Along { amplitude, course, .. } => body.set_path(amplitude, course, 0),
                Drive::Constant => body.velocity = stated.velocity,
                Drive::Servo { direction, .. } => body.velocity = direction * body.velocity.dot(&direction),
            }
        }
        Ok(simulation)
    }

    fn place(&mut self, from: &Checkpoint) {
        self.particles.set_crossings(&from.vectors("crossings"));
        let [position, velocity, angular, force, torque] =
            ["position", "velocity", "angular_velocity", "force", "torque"].map(|name| from.vectors(name));
        for at in 0..self.particles.len() {
            let id = self.particles.motion[at].id as usize;
            self.particles.place[at].position = position[id];
            self.particles.motion[at].velocity = velocity[id];
            self.particles.motion[at].angular_velocity = angular[id];
            self.particles.load[at].force = force[id];
            self.particles.load[at].torque = torque[id];
        }
        let columns = ["body_point", "body_origin", "body_velocity", "body_force"];
        let [point, origin, velocity, force] = columns.map(|name| from.vectors(name));
        for (index, body) in self.bodies.iter_mut().enumerate() {
            (body.point, body.origin) = (point[index], origin[index]);
            (body.velocity, body.force) = (velocity[index], force[index]);
        }
        self.resume_drives();
    }

    /// Gives living contacts back what they remember; false if one has no slot.
    fn fill(&mut self, from: &Checkpoint) -> bool {
        let (pairs, nears) = (Living::restore("pair", from), Living::restore("near", from));
        let id = |at: usize| u64::from(self.particles.motion[at].id);
        let mut found = 0;
        for block in &mut self.contacts.blocks {
            found += refill(&mut block.pairs, &pairs, |pair| [id(pair.i()), id(pair.j())]);
            found += refill(&mut block.near, &nears, |near| [id(near.particle as usize), u64::from(near.body)]);
        }
        found == pairs.len() + nears.len()
    }
}
