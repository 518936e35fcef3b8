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

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::laws::{NormalLaw, NormalState};

    fn pair() -> PairLaw {
        PairLaw {
            effective_young: 5e6,
            effective_radius: 1e-3,
            effective_mass: 1e-5,
            damping_ratio: 0.2,
            work_of_adhesion: 0.05,
            ..PairLaw::default()
        }
    }

    fn state(overlap: f64, other: f64, at_body: bool) -> NormalState {
        let radii = [2e-3, other];
        let effective_radius = if at_body { radii[0] } else { crate::material::reduced(radii[0], other) };
        let approach = Approach { overlap, normal_velocity: 0.0, radii, at_body };
        Sjkr::with_hertz(true, Lens { energy_density: 4e4 }).evaluate(
            &PairLaw { effective_radius, ..pair() },
            &approach,
            &(),
            &mut (),
        )
    }

    proptest! {
        #[test]
        fn the_force_is_the_slope_of_its_energy(overlap in 1e-7..1e-4f64, other in 1e-3..1e-2f64, at_body: bool) {
            let width = 1e-3 * overlap;
            let energy = |overlap| state(overlap, other, at_body).energy;
            let slope = (energy(overlap + width) - energy(overlap - width)) / (2.0 * width);
            let got = state(overlap, other, at_body);
            prop_assert!((slope - got.elastic).abs() < 1e-5 * (got.repulsive.abs() + got.pull_off));
        }

        #[test]
        fn a_wall_attracts_as_a_large_sphere_times_its_ratio(overlap in 1e-7..1e-4f64) {
            let attraction = |state: NormalState| state.repulsive - state.force;
            let ratio = attraction(state(overlap, 2e3, true)) / attraction(state(overlap, 2e3, false));
            prop_assert!((ratio / 1.0 - 1.0).abs() < 1e-5);
        }
    }
}
