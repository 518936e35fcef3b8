//! Random sequential insertion: spheres one after the other at uniform places, each kept if it overlaps nothing.

use std::fmt;

use super::SceneBody;
use super::random::Random;
use crate::Vector;
use crate::bodies::Body;
use crate::domain::Domain;
use crate::geometry;

/// Places tried in a row for one sphere before the region counts as full. Equal spheres jam at a packing fraction of
/// 0.384 (Torquato, Uche, Stillinger 2006), and the last of them would take long: so many places come to some 0.32.
const ATTEMPTS: u32 = 10_000;

/// A region without room.
#[derive(Debug)]
pub struct Full {
    placed: usize,
    radius: f64,
    packing_fraction: f64,
}

impl fmt::Display for Full {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the region is too full: after {} particles (packing fraction {:.3} of the region) {ATTEMPTS} places in a \
             row were taken for a radius of {:e} m; equal spheres come to some 0.32",
            self.placed, self.packing_fraction, self.radius
        )
    }
}

/// Spheres in and around a region, in cells at least as wide as the largest diameter.
pub struct Insertion<'a> {
    domain: &'a Domain,
    bodies: Vec<Body>,
    region: [Vector; 2],
    /// Corner of the first cell [m].
    origin: Vector,
    /// Edges of a cell [m].
    cell: Vector,
    /// Cells along each axis.
    count: [i64; 3],
    cells: Vec<Vec<usize>>,
    placed: Vec<(Vector, f64)>,
}

impl<'a> Insertion<'a> {
    /// A region between two corners [m] in a box with its walls, for `count` spheres; no sphere of the box has a radius
    /// above `largest` [m].
    pub fn new(domain: &'a Domain, bodies: &[SceneBody], region: [Vector; 2], count: u32, largest: f64) -> Self {
        let span = Vector::from_fn(|axis, _| {
            if domain.periodic[axis] { domain.length[axis] } else { region[1][axis] - region[0][axis] }
        });
        // About one sphere to a cell where they stand apart: a large region needs no more cells.
        let edge = libm::cbrt(span.product() / f64::from(count)).max(2.0 * largest);
        let (mut origin, mut cell, mut cells) = (domain.min, Vector::repeat(edge), [1; 3]);
        for axis in 0..3 {
            let fitting = (span[axis] / edge).floor();
            if domain.periodic[axis] {
                cell[axis] = span[axis] / fitting.max(1.0);
                cells[axis] = whole(fitting).max(1);
            } else {
                // One more on both sides, for spheres outside that reach in.
                origin[axis] = region[0][axis] - edge;
                cells[axis] = whole(fitting) + 3;
            }
        }
        let total = usize::try_from(cells.iter().product::<i64>()).unwrap_or_default();
        Self {
            domain,
            bodies: bodies.iter().map(Body::new).collect(),
            region,
            origin,
            cell,
            count: cells,
            cells: vec![Vec::new(); total],
            placed: Vec::new(),
        }
    }

    /// Adds a sphere whose place [m] is given.
    pub fn add(&mut self, position: Vector, radius: f64) {
        let place = self.domain.wrap(position).0;
        if let Some(cell) = self.index(self.cell_of(&place)) {
            self.cells[cell].push(self.placed.len());
            self.placed.push((place, radius));
        }
    }

    /// Places of spheres with these radii [m]. Large spheres look for their places first, since they find fewer.
    ///
    /// # Errors
    /// The region is too full.
    pub fn fill(&mut self, radii: &[f64], random: &mut Random) -> Result<Vec<Vector>, Full> {
        let mut order: Vec<usize> = (0..radii.len()).collect();
        order.sort_by(|one, other| radii[*other].total_cmp(&radii[*one]));
        let mut places = vec![Vector::zeros(); radii.len()];
        let [low, high] = self.region;
        for (done, at) in order.iter().enumerate() {
            let radius = radii[*at];
            let mut tries = (0..ATTEMPTS).map(|_| {
                let place = Vector::from_fn(|axis, _| random.between(low[axis], high[axis]));
                self.domain.wrap(place).0
            });
            let Some(place) = tries.find(|place| self.is_free(place, radius)) else {
                let solid: f64 = order[..done].iter().map(|at| radii[*at].powi(3)).sum();
                let packing_fraction = 4.0 / 3.0 * std::f64::consts::PI * solid / (high - low).product();
                return Err(Full { placed: done, radius, packing_fraction });
            };
            places[*at] = place;
            self.add(place, radius);
        }
        Ok(places)
    }

    fn cell_of(&self, place: &Vector) -> [i64; 3] {
        std::array::from_fn(|axis| whole(((place[axis] - self.origin[axis]) / self.cell[axis]).floor()))
    }

    /// Place of a cell in memory; none outside of the region.
    fn index(&self, cell: [i64; 3]) -> Option<usize> {
        let mut index = 0;
        for axis in (0..3).rev() {
            let count = self.count[axis];
            let at = if self.domain.periodic[axis] { cell[axis].rem_euclid(count) } else { cell[axis] };
            if !(0..count).contains(&at) {
                return None;
            }
            index = index * count + at;
        }
        usize::try_from(index).ok()
    }

    /// Whether a sphere at a place of the box overlaps nothing.
    fn is_free(&self, place: &Vector, radius: f64) -> bool {
        let [x, y, z] = self.cell_of(place);
        let around = (0..27).filter_map(|k| self.index([x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1]));
        let clear = |other: &usize| {
            let (center, size) = self.placed[*other];
            let branch = self.domain.nearest(place - center);
            let squared = branch.norm_squared();
            squared > 0.0 && geometry::spheres(branch, squared, radius, size).overlap <= 0.0
        };
        let mut walls = self.bodies.iter().filter_map(|body| body.geometry(*place, radius));
        walls.all(|wall| wall.overlap <= 0.0) && around.flat_map(|cell| &self.cells[cell]).all(clear)
    }
}

#[expect(clippy::cast_possible_truncation, reason = "a place in the box, in cells")]
fn whole(number: f64) -> i64 {
    number as i64
}
