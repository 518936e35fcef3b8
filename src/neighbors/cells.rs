//! Cells in levels, found through a hash of their number on the curve.

use std::ops::Range;

use crate::domain::Domain;
use crate::particles::Particles;

use super::morton::{Grid, spread};

/// One level: cells of twice the edge of the level below.
#[derive(Clone, Debug, Default)]
struct Level {
    /// Largest radius [m].
    radius: f64,
    /// Its particles, in the order of memory: those of one cell stand together.
    members: Vec<u32>,
    /// Open addressing: number of a cell and its range of `members`; an empty range is a free place.
    table: Vec<(u64, u32, u32)>,
}

impl Level {
    fn find(&self, code: u64) -> Range<usize> {
        let mask = self.table.len() - 1;
        let mut at = hash(code) & mask;
        loop {
            let (found, start, end) = self.table[at];
            if start == end || found == code {
                return start as usize..end as usize;
            }
            at = (at + 1) & mask;
        }
    }

    fn insert(&mut self, code: u64, range: Range<u32>) {
        let mask = self.table.len() - 1;
        let mut at = hash(code) & mask;
        while self.table[at].1 != self.table[at].2 {
            at = (at + 1) & mask;
        }
        self.table[at] = (code, range.start, range.end);
    }
}

fn hash(code: u64) -> usize {
    (code.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 24) as usize
}

/// All levels over particles that stand in the order of the curve.
#[derive(Clone, Debug)]
pub struct Cells<'a> {
    particles: &'a Particles,
    domain: &'a Domain,
    grid: Grid,
    gap: f64,
    level: Vec<u8>,
    levels: Vec<Level>,
}

impl<'a> Cells<'a> {
    /// Sorts the particles into cells.
    #[must_use]
    pub fn new(particles: &'a Particles, domain: &'a Domain, gap: f64) -> Self {
        let grid = Grid::new(particles, domain, gap);
        let mut cells = Self { particles, domain, grid, gap, level: Vec::new(), levels: Vec::new() };
        for (place, at) in particles.place.iter().zip(0u32..) {
            let mut level = 0u8;
            let mut edge = cells.grid.edge;
            while edge < 2.0 * place.radius + gap && level < 20 {
                edge *= 2.0;
                level += 1;
            }
            let index = usize::from(level);
            if cells.levels.len() <= index {
                cells.levels.resize(index + 1, Level::default());
            }
            cells.level.push(level);
            cells.levels[index].members.push(at);
            cells.levels[index].radius = cells.levels[index].radius.max(place.radius);
        }
        for (index, level) in cells.levels.iter_mut().enumerate() {
            let codes =
                level.members.iter().map(|at| cells.grid.code(&particles.place[*at as usize].position) >> (3 * index));
            let codes: Vec<u64> = codes.collect();
            let runs = codes.chunk_by(|a, b| a == b);
            level.table = vec![(0, 0, 0); (2 * runs.clone().count()).next_power_of_two().max(2)];
            let mut start = 0;
            for run in runs {
                let end = start + u32::try_from(run.len()).unwrap_or(u32::MAX);
                level.insert(run[0], start..end);
                start = end;
            }
        }
        cells
    }

    /// Number of levels.
    #[must_use]
    pub fn levels(&self) -> usize {
        self.levels.iter().filter(|level| !level.members.is_empty()).count()
    }

    /// Pairs that the particles in `range` find, ordered within each particle.
    #[must_use]
    pub fn pairs(&self, range: Range<u32>) -> Vec<[u32; 2]> {
        let mut pairs = Vec::new();
        for one in range {
            let own = usize::from(self.level[one as usize]);
            let start = pairs.len();
            for (index, level) in self.levels.iter().enumerate().skip(own) {
                if !level.members.is_empty() {
                    self.search(one, index, index == own, &mut pairs);
                }
            }
            pairs[start..].sort_unstable();
        }
        pairs
    }

    /// Candidates of one particle on one level; on its own level only those behind it.
    fn search(&self, one: u32, index: usize, own: bool, pairs: &mut Vec<[u32; 2]>) {
        let level = &self.levels[index];
        let place = &self.particles.place[one as usize];
        let cutoff = place.radius + level.radius + self.gap;
        let [x, y, z] = [0, 1, 2].map(|axis| self.covering(place.position[axis], cutoff, axis, index));
        for (z, y) in z.iter().flat_map(|z| y.iter().map(move |y| (z, y))) {
            for x in x.iter() {
                for other in &level.members[level.find(x | y << 1 | z << 2)] {
                    if (own && *other <= one) || *other == one {
                        continue;
                    }
                    let partner = &self.particles.place[*other as usize];
                    let branch = self.domain.nearest(place.position - partner.position);
                    let reach = place.radius + partner.radius + self.gap;
                    if branch.norm_squared() < reach * reach {
                        pairs.push([one.min(*other), one.max(*other)]);
                    }
                }
            }
        }
    }

    /// Cells of a level that cover a coordinate and a cutoff on both sides [m], each once, as spread bits.
    fn covering(&self, center: f64, cutoff: f64, axis: usize, index: usize) -> Covering {
        let cell = |coordinate| self.grid.cell(coordinate, axis) >> index;
        let mut covering = Covering::default();
        let (low, high) = (center - cutoff, center + cutoff);
        covering.add(cell(low)..=cell(high));
        if self.domain.periodic[axis] {
            let (min, edge) = (self.domain.min[axis], self.domain.length[axis]);
            if low < min {
                covering.add(cell(low + edge)..=cell(min + edge));
            }
            if high >= min + edge {
                covering.add(cell(min)..=cell(high - edge));
            }
        }
        covering
    }
}

/// A few cells along one axis, as spread bits.
#[derive(Default)]
struct Covering {
    cells: [u64; 12],
    count: usize,
}

impl Covering {
    fn add(&mut self, range: std::ops::RangeInclusive<u32>) {
        for cell in range {
            let bits = spread(cell);
            if !self.cells[..self.count].contains(&bits) && self.count < self.cells.len() {
                self.cells[self.count] = bits;
                self.count += 1;
            }
        }
    }

    fn iter(&self) -> impl Iterator<Item = u64> + Clone + '_ {
        self.cells[..self.count].iter().copied()
    }
}
