//! The contact store: candidate pairs in blocks, what their contacts remember, and what they do to particles of other
//! blocks.
//!
//! A block owns [`BLOCK`] particles that stand together in memory, and every pair whose first particle (in memory) it
//! owns. One task sweeps over a block and adds to the loads of its own particles; what its pairs do to particles of later
//! blocks it writes into its exports, which those particles fetch in a fixed order. Blocks depend on positions only, so
//! that the order of every sum is the same for every number of threads.

mod account;

use crate::Vector;
use crate::domain::Domain;
use crate::laws::memory::Memory;
use crate::neighbors::Near;
use crate::particles::{Load, Particles};

pub use account::{Account, Flow};

/// Particles of a block.
pub const BLOCK: usize = 2048;
/// Largest number of particles: the image of a pair takes the other bits.
pub const MOST: usize = 1 << INDEX_BITS;
/// The bits of an index.
const INDEX_MASK: u32 = (1 << INDEX_BITS) - 1;
const INDEX_BITS: u32 = 27;

/// A candidate pair: the particle with the smaller id comes first, whatever their places, so that a contact keeps its
/// sense when places change.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    first: u32,
    second: u32,
}

impl Pair {
    fn new(first: u32, second: u32, image: u32) -> Self {
        Self { first, second: second | image << INDEX_BITS }
    }

    /// Place in memory of the first particle.
    #[inline]
    #[must_use]
    pub fn i(self) -> usize {
        self.first as usize
    }

    /// Place in memory of the second particle.
    #[inline]
    #[must_use]
    pub fn j(self) -> usize {
        (self.second & INDEX_MASK) as usize
    }

    /// The image in which the pair meets.
    #[inline]
    #[must_use]
    pub fn image(self) -> usize {
        (self.second >> INDEX_BITS) as usize
    }

    /// Both places, the smaller first.
    #[must_use]
    pub fn places(self) -> [u32; 2] {
        let (i, j) = (self.first, self.second & INDEX_MASK);
        [i.min(j), i.max(j)]
    }
}

/// Slots of one kind: candidates and, parallel to them, what their contacts remember.
#[derive(Clone, Debug)]
pub struct Slots<C, H> {
    /// Candidates.
    pub candidates: Vec<C>,
    /// Memory of each contact.
    pub history: Vec<H>,
    /// Whether each contact lives.
    pub alive: Vec<bool>,
    /// Ledger entries; empty where no ledger is kept.
    pub accounts: Vec<Account>,
}

/// A living contact at one step.
#[derive(Clone, Copy, Debug)]
pub struct Living<H> {
    /// Ids of both particles, the smaller first, or the particle and the number of particles plus the index of the body.
    pub pair: [u32; 2],
    /// What it does.
    pub account: Account,
    /// What it remembers.
    pub history: H,
}

impl<C, H: Memory> Slots<C, H> {
    fn living(&self, pair: impl Fn(&C) -> [u32; 2], into: &mut Vec<Living<H>>) {
        for (slot, account) in self.accounts.iter().enumerate().filter(|(slot, _)| self.alive[*slot]) {
            into.push(Living { pair: pair(&self.candidates[slot]), account: *account, history: self.history[slot] });
        }
    }

    fn new(candidates: Vec<C>, ledger: bool) -> Self {
        let count = candidates.len();
        Self {
            candidates,
            history: vec![H::default(); count],
            alive: vec![false; count],
            accounts: vec![Account::default(); if ledger { count } else { 0 }],
        }
    }

    fn copy(&mut self, to: usize, other: &Self, from: usize) {
        self.history[to] = other.history[from];
        self.alive[to] = other.alive[from];
        if let (Some(into), Some(account)) = (self.accounts.get_mut(to), other.accounts.get(from)) {
            *into = *account;
        }
    }
}

/// The pairs of one block and its particles at bodies.
#[derive(Clone, Debug)]
pub struct Block<H> {
    /// Place in memory of its first particle.
    pub first: usize,
    /// Pairs: those inside the block, then those with a particle of a later block.
    pub pairs: Slots<Pair, H>,
    /// Number of pairs inside the block.
    pub inside: usize,
    /// Particles at bodies.
    pub near: Slots<Near, H>,
    /// Forces of bodies on the particles, parallel to `near` [N].
    pub body_forces: Vec<Vector>,
    /// Loads on the particles of later blocks, parallel to the pairs with them.
    pub exports: Vec<Load>,
    /// Energies of the last sweep.
    pub flow: Flow,
    /// Candidates that may touch, for one sweep.
    pub active: Vec<u32>,
}

impl<H> Block<H> {
    /// Memory behind it [bytes].
    fn bytes(&self) -> usize {
        fn slots<C, H>(slots: &Slots<C, H>) -> usize {
            size_of_val(&slots.candidates[..])
                + size_of_val(&slots.history[..])
                + size_of_val(&slots.alive[..])
                + size_of_val(&slots.accounts[..])
        }
        let lists = size_of_val(&self.body_forces[..]) + size_of_val(&self.exports[..]);
        slots(&self.pairs) + slots(&self.near) + lists + self.active.capacity() * size_of::<u32>()
    }
}

/// All blocks, and for each particle the exports that act on it.
#[derive(Clone, Debug, Default)]
pub struct Contacts<H> {
    /// Blocks in the order of memory.
    pub blocks: Vec<Block<H>>,
    /// Start of each particle's entries in `imports`, and one end.
    starts: Vec<u32>,
    /// Block and export.
    imports: Vec<[u32; 2]>,
}

impl<H: Memory> Contacts<H> {
    /// Blocks for `pairs` and `near`, both in order; no contact lives yet.
    #[must_use]
    pub fn new(particles: &Particles, domain: &Domain, pairs: &[[u32; 2]], near: &[Near], ledger: bool) -> Self {
        let count = particles.len();
        let (mut pairs, mut near) = (pairs, near);
        let mut blocks = Vec::with_capacity(count.div_ceil(BLOCK));
        for first in (0..count).step_by(BLOCK) {
            let end = (first + BLOCK).min(count);
            let (own, rest) = pairs.split_at(pairs.partition_point(|pair| (pair[0] as usize) < end));
            let (touching, later) = near.split_at(near.partition_point(|near| (near.particle as usize) < end));
            (pairs, near) = (rest, later);
            blocks.push(block(particles, domain, first..end, own, touching, ledger));
        }
        let (starts, imports) = imports(&blocks, count);
        Self { blocks, starts, imports }
    }

    /// Exports that act on a particle, in the order of the blocks that made them.
    pub fn imports(&self, particle: usize) -> impl Iterator<Item = &Load> {
        let range = self.starts[particle] as usize..self.starts[particle + 1] as usize;
        self.imports[range].iter().map(|[block, export]| &self.blocks[*block as usize].exports[*export as usize])
    }

    /// Takes over what the living contacts of an older store remember; `order` is the place that each particle had.
    pub fn carry(&mut self, old: &Self, order: &[u32]) {
        let rows: Vec<[Vec<u32>; 2]> = old.blocks.iter().map(rows).collect();
        for block in &mut self.blocks {
            for slot in 0..block.pairs.candidates.len() {
                let [one, other] = block.pairs.candidates[slot].places().map(|place| order[place as usize]);
                let [low, high] = [one.min(other), one.max(other)];
                let owner = low as usize / BLOCK;
                let from = &old.blocks[owner];
                let row = &rows[owner][usize::from(high as usize / BLOCK != owner)];
                let range = row[low as usize - from.first] as usize..row[low as usize - from.first + 1] as usize;
                let places = |pair: &Pair| pair.places() == [low, high];
                if let Some(found) = from.pairs.candidates[range.clone()].iter().position(places) {
                    block.pairs.copy(slot, &from.pairs, range.start + found);
                }
            }
            for slot in 0..block.near.candidates.len() {
                let Near { particle, body } = block.near.candidates[slot];
                let was = Near { particle: order[particle as usize], body };
                let from = &old.blocks[was.particle as usize / BLOCK].near;
                let key = |near: &Near| (near.particle, near.body);
                if let Ok(found) = from.candidates.binary_search_by_key(&key(&was), key) {
                    block.near.copy(slot, from, found);
                }
            }
        }
    }

    /// Memory of the slots, their lists and exports, and the imports [bytes].
    #[must_use]
    pub fn bytes(&self) -> usize {
        let own = size_of_val(&self.starts[..]) + size_of_val(&self.imports[..]);
        self.blocks.iter().map(Block::bytes).sum::<usize>() + own
    }

    /// The living contacts, ordered. Needs accounts of the present step.
    #[must_use]
    pub fn living_contacts(&self, particles: &Particles) -> Vec<Living<H>> {
        let id = |at: usize| particles.motion[at].id;
        let bodies = u32::try_from(particles.len()).unwrap_or(u32::MAX);
        let mut found = Vec::new();
        for block in &self.blocks {
            block.pairs.living(|pair| [id(pair.i()), id(pair.j())], &mut found);
            block.near.living(|near| [id(near.particle as usize), bodies + near.body], &mut found);
        }
        found.sort_unstable_by_key(|living| living.pair);
        found
    }

    /// Number of living contacts, pairs and bodies.
    #[must_use]
    pub fn living(&self) -> usize {
        let count = |alive: &[bool]| alive.iter().filter(|alive| **alive).count();
        self.blocks.iter().map(|block| count(&block.pairs.alive) + count(&block.near.alive)).sum()
    }
}

fn block<H: Memory>(
    particles: &Particles,
    domain: &Domain,
    range: std::ops::Range<usize>,
    pairs: &[[u32; 2]],
    near: &[Near],
    ledger: bool,
) -> Block<H> {
    let within = |pair: &&[u32; 2]| (pair[1] as usize) < range.end;
    let inside = pairs.iter().filter(within).count();
    let place = |at: u32| particles.place[at as usize].position;
    let id = |at: u32| particles.motion[at as usize].id;
    let oriented = |pair: &[u32; 2]| {
        let [i, j] = if id(pair[0]) < id(pair[1]) { *pair } else { [pair[1], pair[0]] };
        Pair::new(i, j, domain.image(place(i) - place(j)))
    };
    let border = pairs.iter().filter(|pair| !within(pair));
    let candidates: Vec<Pair> = pairs.iter().filter(within).chain(border).map(oriented).collect();
    Block {
        first: range.start,
        exports: vec![Load::default(); candidates.len() - inside],
        active: Vec::with_capacity(candidates.len()),
        pairs: Slots::new(candidates, ledger),
        inside,
        body_forces: vec![Vector::zeros(); near.len()],
        near: Slots::new(near.to_vec(), ledger),
        flow: Flow::default(),
    }
}

/// Starts of the pairs of each particle of a block, inside and with later blocks.
fn rows<H>(block: &Block<H>) -> [Vec<u32>; 2] {
    let (inside, border) = block.pairs.candidates.split_at(block.inside);
    [(inside, 0), (border, block.inside)].map(|(pairs, base)| {
        let mut starts = vec![0u32; BLOCK + 1];
        for pair in pairs {
            starts[pair.places()[0] as usize - block.first + 1] += 1;
        }
        starts[0] = u32::try_from(base).unwrap_or(u32::MAX);
        for at in 0..BLOCK {
            starts[at + 1] += starts[at];
        }
        starts
    })
}

fn imports<H>(blocks: &[Block<H>], particles: usize) -> (Vec<u32>, Vec<[u32; 2]>) {
    let exported = |block: &Block<H>| {
        let border = block.pairs.candidates[block.inside..].iter();
        border.map(|pair| pair.places()[1] as usize).collect::<Vec<_>>()
    };
    let mut starts = vec![0u32; particles + 1];
    for block in blocks {
        for particle in exported(block) {
            starts[particle + 1] += 1;
        }
    }
    for at in 0..particles {
        starts[at + 1] += starts[at];
    }
    let mut next = starts.clone();
    let mut imports = vec![[0; 2]; starts.last().copied().unwrap_or(0) as usize];
    for (block, index) in blocks.iter().zip(0u32..) {
        for (particle, export) in exported(block).into_iter().zip(0u32..) {
            imports[next[particle] as usize] = [index, export];
            next[particle] += 1;
        }
    }
    (starts, imports)
}
