//! Attraction in proportion to the area in which the undeformed spheres overlap (LIGGGHTS's `sjkr`).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | k | cohesion energy density | J/m3 |
//! | d, r = Ri + Rj - d | overlap, distance of the centres | m |
//! | A | area of the circle in which the spheres meet | m2 |
//!
//! Attraction: k A with A = pi d (r + Ri - Rj)(r - Ri + Rj)(r + Ri + Rj) / (4 r^2), about 2 pi R* d; at a body
//! A = pi d (2 R - d). With Hertz the largest attraction is (4/27) (2 pi k R*)^3 / (4/3 E* sqrt(R*))^2 for small d.
//!
//! Despite its name no JKR: no force at d = 0, none across a gap, a pull-off that depends on k^3 / E*^2. Invariants:
//! action = reaction, no energy gained on a closed path, a wall is the limit of a large sphere.
//!
//! | code | words |
//! |---|---|
//! | LIGGGHTS | `cohesion sjkr`, `cohesionEnergyDensity`; friction sees the force without it unless `tangential_reduce on` |
//! | YADE, LAMMPS | none |

use std::f64::consts::{PI, TAU};

use crate::laws::{Approach, PairLaw};

use super::cohesive::{self, Attraction, Cohesive};
use super::hertz::Hertz;

/// The attraction.
#[derive(Clone, Copy, Debug)]
pub struct Lens {
    /// Cohesion energy density [J/m3].
    pub energy_density: f64,
}

/// The law with Hertz.
pub type Sjkr = Cohesive<Hertz, Lens>;

/// Nodes and weights of Gauss's rule of five points on [0, 1], for the potential: exact far beyond rounding at d < R / 4.
const GAUSS: [[f64; 2]; 5] = [
    [0.046_910_077_030_668, 0.118_463_442_528_094_54],
    [0.230_765_344_947_158_45, 0.239_314_335_249_683_24],
    [0.5, 0.284_444_444_444_444_44],
    [0.769_234_655_052_841_6, 0.239_314_335_249_683_24],
    [0.953_089_922_969_332, 0.118_463_442_528_094_54],
];

impl Lens {
    /// Area at an overlap [m2].
    fn area(radii: [f64; 2], at_body: bool, overlap: f64) -> f64 {
        let [own, other] = radii;
        if at_body {
            return PI * overlap * (2.0 * own - overlap);
        }
        let distance = own + other - overlap;
        let product = (distance + own - other) * (distance - own + other) * (distance + own + other);
        0.25 * PI * overlap * product / (distance * distance)
    }
}

impl Attraction for Lens {
    #[inline(always)]
    fn at(&self, _: &PairLaw, approach: &Approach) -> (f64, f64) {
        let area = |overlap| Self::area(approach.radii, approach.at_body, overlap);
        let volume: f64 = GAUSS.iter().map(|[node, weight]| weight * area(node * approach.overlap)).sum();
        (self.energy_density * area(approach.overlap), self.energy_density * volume * approach.overlap)
    }

    #[inline(always)]
    fn pull_off(&self, pair: &PairLaw, _: &Approach) -> f64 {
        cohesive::hertz_pull_off(pair, TAU * self.energy_density * pair.effective_radius)
    }
}
