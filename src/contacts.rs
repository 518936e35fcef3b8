//! The contact store: candidate pairs, what their contacts remember, and what they did in the last sweep.

use std::collections::BTreeMap;

use crate::Vector;

/// The other side of a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Partner {
    /// A particle with a larger index.
    Particle(u32),
    /// A body.
    Body(u32),
}

/// One candidate pair: it writes only here during a sweep.
#[derive(Clone, Copy, Debug)]
pub struct Slot<H> {
    /// First particle.
    pub i: u32,
    /// Its partner.
    pub partner: Partner,
    /// Whether the contact lives.
    pub alive: bool,
    /// What the law remembers.
    pub history: H,
    /// What the last sweep found.
    pub state: SlotState,
}

/// Forces of a contact and its entries in the energy ledger.
#[derive(Clone, Copy, Debug, Default)]
pub struct SlotState {
    /// Force on i [N].
    pub force: Vector,
    /// Torque on i [N m].
    pub torque_i: Vector,
    /// Torque on j [N m].
    pub torque_j: Vector,
    /// Total normal force, positive when it repels [N].
    pub normal_force: f64,
    /// Part of the normal force that is not stored [N].
    pub damping_force: f64,
    /// Stored energy [J].
    pub energy: f64,
    /// Energy dissipated in the last step [J].
    pub dissipated: f64,
    /// Energy that entered the contact in the last step [J].
    pub entered: f64,
    /// Work of the partner, if it is a moving body, in the last step [J].
    pub body_work: f64,
}

/// All candidate pairs and, for each particle, the slots that act on it.
#[derive(Clone, Debug, Default)]
pub struct Contacts<H> {
    /// Slots in the order of (i, partner).
    pub slots: Vec<Slot<H>>,
    /// Start of each particle's entries in `entries`, and one end.
    starts: Vec<usize>,
    /// Slot index and whether the particle is the first of the slot.
    entries: Vec<(usize, bool)>,
}

impl<H: Copy + Default> Contacts<H> {
    /// Takes a new candidate list; contacts that live keep their slot's memory.
    pub fn replace(&mut self, pairs: &[(u32, Partner)], particles: usize) {
        let kept: BTreeMap<(u32, Partner), Slot<H>> =
            self.slots.iter().filter(|slot| slot.alive).map(|slot| ((slot.i, slot.partner), *slot)).collect();
        let fresh = |i, partner| Slot { i, partner, alive: false, history: H::default(), state: SlotState::default() };
        self.slots = pairs
            .iter()
            .map(|(i, partner)| kept.get(&(*i, *partner)).copied().unwrap_or_else(|| fresh(*i, *partner)))
            .collect();
        let mut lists = vec![Vec::new(); particles];
        for (index, slot) in self.slots.iter().enumerate() {
            lists[slot.i as usize].push((index, true));
            if let Partner::Particle(j) = slot.partner {
                lists[j as usize].push((index, false));
            }
        }
        self.starts = std::iter::once(0)
            .chain(lists.iter().scan(0, |end, list| {
                *end += list.len();
                Some(*end)
            }))
            .collect();
        self.entries = lists.concat();
    }

    /// Force [N] and torque [N m] on a particle, summed in the order of its slots.
    #[must_use]
    pub fn gather(&self, particle: usize) -> (Vector, Vector) {
        let mut force = Vector::zeros();
        let mut torque = Vector::zeros();
        for (slot, first) in &self.entries[self.starts[particle]..self.starts[particle + 1]] {
            let state = &self.slots[*slot].state;
            if *first {
                force += state.force;
                torque += state.torque_i;
            } else {
                force -= state.force;
                torque += state.torque_j;
            }
        }
        (force, torque)
    }
}
