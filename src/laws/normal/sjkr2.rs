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
