//! Who may touch: a list of candidate pairs that stays valid while nothing has moved further than half its skin.
//!
//! Particles are ordered along a Morton curve whenever the list is built, and searched through cells in levels: each
//! level has cells of twice the size of the one below, a particle lives on the level that its radius fills, and searches
//! its own level and the coarser ones. Small particles therefore never meet crowds of each other in the cells of large
//! ones.

mod cells;
mod morton;

use rayon::prelude::*;

use crate::Vector;
use crate::bodies::Body;
use crate::domain::Domain;
use crate::particles::Particles;
use cells::Cells;

/// Particles that one task searches for: fixed, so that nothing depends on the number of threads.
const CHUNK: u32 = 512;

/// Steps that a selection of candidates should last.
const LASTING: f64 = 10.0;
/// Largest margin of a selection, as a share of the skin.
const WIDEST: f64 = 0.25;
/// Share by which sums of displacements are taken as longer, for their rounding.
const ROUNDING: f64 = 1.0 + 1e-6;

/// A particle and the body that it may touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Near {
    /// The particle, as its place in memory.
    pub particle: u32,
    /// The body.
    pub body: u32,
}

/// The search and the state for which the list was built.
#[derive(Clone, Debug)]
pub struct Neighbors {
    /// Gap beyond the reach of the law up to which a pair is a candidate [m].
    pub skin: f64,
    /// Largest gap across which the law acts [m].
    pub reach: f64,
    /// Centres at the last build, in the order of memory [m].
    pub built: Vec<Vector>,
    /// Points of the bodies at the last build [m].
    pub built_bodies: Vec<Vector>,
    /// No particle has moved further since the list was built [m].
    travelled: f64,
    /// No particle has moved further since candidates were selected [m].
    strayed: f64,
    /// Gap beyond the reach of the law up to which candidates were selected [m].
    margin: f64,
    /// Sum of what radii grew since the list was built, shrinking not counted [m].
    pub grown: f64,
}

impl Neighbors {
    /// No list yet.
    #[must_use]
    pub fn new(skin: f64, reach: f64) -> Self {
        Self {
            skin,
            reach,
            built: Vec::new(),
            built_bodies: Vec::new(),
            travelled: f64::INFINITY,
            strayed: f64::INFINITY,
            margin: 0.0,
            grown: 0.0,
        }
    }

    /// Square of the displacement that makes the list stale [m2].
    #[must_use]
    pub fn allowance(&self) -> f64 {
        let half = (0.5 * self.skin - self.grown).max(0.0);
        half * half
    }

    /// Says that radii grew by at most `step` [m].
    pub fn grow(&mut self, step: f64) {
        if step > 0.0 {
            self.grown += step;
            self.moved(step);
        }
    }

    /// Says that no particle moved further than `step` [m]; infinity where nobody knows.
    pub fn moved(&mut self, step: f64) {
        self.travelled += step * ROUNDING;
        self.strayed += step * ROUNDING;
    }

    /// Whether a particle may have moved by half the skin: only then its displacement has to be looked at.
    #[must_use]
    pub fn may_be_stale(&self) -> bool {
        2.0 * self.travelled >= self.skin
    }

    /// The gap up to which candidates have to be selected anew [m], None while the last selection holds every pair that
    /// touches. Particles of late moved by at most `step` [m] in a step. Results do not depend on it.
    pub fn selection(&mut self, step: f64) -> Option<f64> {
        if 2.0 * self.strayed < self.margin {
            return None;
        }
        self.strayed = 0.0;
        self.margin = (2.0 * LASTING * step).min(WIDEST * self.skin);
        Some(self.reach + self.margin)
    }

    /// Largest squared displacement of a body since the list was built [m2].
    #[must_use]
    pub fn body_displacement(&self, bodies: &[Body]) -> f64 {
        let squares = bodies.iter().zip(&self.built_bodies).map(|(body, then)| (body.point - then).norm_squared());
        squares.fold(0.0, f64::max)
    }

    /// Moves particles back into the box, orders them along the curve and returns the places that they had before.
    pub fn order(&mut self, particles: &mut Particles, domain: &Domain) -> Vec<u32> {
        particles.wrap(domain);
        let grid = morton::Grid::new(particles, domain, self.skin + self.reach);
        let order = grid.order(particles);
        particles.reorder(&order);
        order
    }

    /// All pairs (smaller place in memory first) and particles at bodies within the skin, in order.
    pub fn search(&mut self, particles: &Particles, bodies: &[Body], domain: &Domain) -> (Vec<[u32; 2]>, Vec<Near>) {
        self.built = particles.place.iter().map(|place| place.position).collect();
        self.built_bodies = bodies.iter().map(|body| body.point).collect();
        (self.travelled, self.strayed, self.grown) = (0.0, f64::INFINITY, 0.0);
        let gap = self.skin + self.reach;
        let cells = Cells::new(particles, domain, gap);
        let count = u32::try_from(particles.len()).unwrap_or(u32::MAX);
        let starts: Vec<u32> = (0..count).step_by(CHUNK as usize).collect();
        let found: Vec<(Vec<[u32; 2]>, Vec<Near>)> = starts
            .par_iter()
            .map(|start| {
                let range = *start..count.min(start + CHUNK);
                (cells.pairs(range.clone()), near_bodies(particles, bodies, gap, range))
            })
            .collect();
        let near = found.iter().flat_map(|(_, near)| near.iter().copied()).collect();
        let mut pairs: Vec<[u32; 2]> = Vec::with_capacity(found.iter().map(|(pairs, _)| pairs.len()).sum());
        for (chunk, _) in found {
            pairs.extend(chunk);
        }
        if cells.levels() > 1 {
            // A small particle finds a large one from its own side: the pair may belong to an earlier chunk.
            pairs.par_sort_unstable();
        }
        (pairs, near)
    }
}

fn near_bodies(particles: &Particles, bodies: &[Body], gap: f64, range: std::ops::Range<u32>) -> Vec<Near> {
    let mut near = Vec::new();
    for particle in range {
        let place = &particles.place[particle as usize];
        for (body, index) in bodies.iter().zip(0u32..).filter(|(body, _)| body.present) {
            if body.geometry(place.position, place.radius).is_some_and(|geometry| geometry.overlap > -gap) {
                near.push(Near { particle, body: index });
            }
        }
    }
    near
}
