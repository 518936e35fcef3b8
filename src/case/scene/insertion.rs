//! Random sequential insertion: spheres one after the other at uniform places, each kept if it overlaps nothing.

use std::collections::HashMap;
use std::fmt;

use super::SceneBody;
use super::random::Random;
use crate::Vector;
use crate::bodies::Body;
use crate::domain::Domain;
use crate::geometry;

/// Places tried in a row for one sphere before the region counts as full. Equal spheres jam at a packing fraction of
/// 0.384 (Torquato, Uche, Stillinger 2006), and the last of them take long.
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
             row were taken for a radius of {:e} m; random insertion of equal spheres ends near 0.38",
            self.placed, self.packing_fraction, self.radius
        )
    }
}

/// Spheres that are placed, in cells as wide as the largest diameter.
pub struct Insertion<'a> {
    domain: &'a Domain,
    bodies: Vec<Body>,
    /// Edges of a cell [m].
    cell: Vector,
    /// Cells along periodic axes.
    count: [i64; 3],
    cells: HashMap<[i64; 3], Vec<usize>>,
    placed: Vec<(Vector, f64)>,
}

impl<'a> Insertion<'a> {
    /// An empty box with its walls; no sphere has a radius above `largest` [m].
    pub fn new(domain: &'a Domain, bodies: &[SceneBody], largest: f64) -> Self {
        let (mut cell, mut count) = (Vector::repeat(2.0 * largest), [i64::MAX; 3]);
        for axis in (0..3).filter(|axis| domain.periodic[*axis]) {
            let fitting = (domain.length[axis] / cell[axis]).floor().max(1.0);
            cell[axis] = domain.length[axis] / fitting;
            count[axis] = whole(fitting);
        }
        let bodies = bodies.iter().map(Body::new).collect();
        Self { domain, bodies, cell, count, cells: HashMap::new(), placed: Vec::new() }
    }

    /// Adds a sphere whose place [m] is given.
    pub fn add(&mut self, position: Vector, radius: f64) {
        let place = self.domain.wrap(position).0;
        self.cells.entry(self.cell_of(&place)).or_default().push(self.placed.len());
        self.placed.push((place, radius));
    }

    /// Places of spheres with these radii [m], their centres between the two corners of a region [m]. Large spheres look
    /// for their places first, since they find fewer.
    ///
    /// # Errors
    /// The region is too full.
    pub fn fill(&mut self, radii: &[f64], region: &[Vector; 2], random: &mut Random) -> Result<Vec<Vector>, Full> {
        let mut order: Vec<usize> = (0..radii.len()).collect();
        order.sort_by(|one, other| radii[*other].total_cmp(&radii[*one]));
        let mut places = vec![Vector::zeros(); radii.len()];
        for (done, at) in order.iter().enumerate() {
            let radius = radii[*at];
            let mut tries = (0..ATTEMPTS).map(|_| {
                let place = Vector::from_fn(|axis, _| random.between(region[0][axis], region[1][axis]));
                self.domain.wrap(place).0
            });
            let Some(place) = tries.find(|place| self.is_free(place, radius)) else {
                let solid: f64 = order[..done].iter().map(|at| radii[*at].powi(3)).sum();
                let volume = (region[1] - region[0]).product();
                let packing_fraction = 4.0 / 3.0 * std::f64::consts::PI * solid / volume;
                return Err(Full { placed: done, radius, packing_fraction });
            };
            places[*at] = place;
            self.add(place, radius);
        }
        Ok(places)
    }

    fn cell_of(&self, place: &Vector) -> [i64; 3] {
        std::array::from_fn(|axis| {
            let cell = whole(((place[axis] - self.domain.min[axis]) / self.cell[axis]).floor());
            cell.min(self.count[axis] - 1)
        })
    }

    /// Whether a sphere at a place of the box overlaps nothing.
    fn is_free(&self, place: &Vector, radius: f64) -> bool {
        let home = self.cell_of(place);
        let cells = (0..27).map(|k| {
            std::array::from_fn(|axis| {
                let cell = home[axis] + [k % 3, k / 3 % 3, k / 9][axis] - 1;
                if self.domain.periodic[axis] { cell.rem_euclid(self.count[axis]) } else { cell }
            })
        });
        let clear = |other: &usize| {
            let (center, size) = self.placed[*other];
            let branch = self.domain.nearest(place - center);
            let squared = branch.norm_squared();
            squared > 0.0 && geometry::spheres(branch, squared, radius, size).overlap <= 0.0
        };
        let walls = || self.bodies.iter().filter_map(|body| body.geometry(*place, radius));
        walls().all(|wall| wall.overlap <= 0.0) && cells.filter_map(|cell| self.cells.get(&cell)).flatten().all(clear)
    }
}

#[expect(clippy::cast_possible_truncation, reason = "a place in the box, in cells")]
fn whole(number: f64) -> i64 {
    number as i64
}
