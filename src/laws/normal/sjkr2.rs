//! Attraction in proportion to an area linear in the overlap (LIGGGHTS's `sjkr2`).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | k | cohesion energy density | J/m3 |
//! | d, R* | overlap, effective radius | m |
//!
//! Attraction: k A with A = 4 pi R* d between spheres, twice the area of [`super::sjkr`], but A = 2 pi R d at a body, the
//! same as there. So its wall is *not* the limit of a large sphere: it attracts half as much. Other invariants: action =
//! reaction, no energy gained on a closed path.
//!
//! | code | words |
//! |---|---|
//! | LIGGGHTS | `cohesion sjkr2`, `cohesionEnergyDensity` |
//! | YADE, LAMMPS | none |

use std::f64::consts::TAU;

use crate::laws::{Approach, PairLaw};

use super::cohesive::{self, Attraction, Cohesive};
use super::hertz::Hertz;

/// The attraction.
#[derive(Clone, Copy, Debug)]
pub struct Linear {
    /// Cohesion energy density [J/m3].
    pub energy_density: f64,
}

/// The law with Hertz.
pub type Sjkr2 = Cohesive<Hertz, Linear>;

impl Linear {
    fn slope(self, pair: &PairLaw, approach: &Approach) -> f64 {
        let area = if approach.at_body { TAU * approach.radii[0] } else { 2.0 * TAU * pair.effective_radius };
        self.energy_density * area
    }
}

impl Attraction for Linear {
    #[inline(always)]
    fn at(&self, pair: &PairLaw, approach: &Approach) -> (f64, f64) {
        let force = self.slope(pair, approach) * approach.overlap;
        (force, 0.5 * force * approach.overlap)
    }

    #[inline(always)]
    fn pull_off(&self, pair: &PairLaw, approach: &Approach) -> f64 {
        cohesive::hertz_pull_off(pair, self.slope(pair, approach))
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
        Sjkr2::with_hertz(true, Linear { energy_density: 4e4 }).evaluate(
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
            prop_assert!((ratio / 0.5 - 1.0).abs() < 1e-5);
        }
    }
}
