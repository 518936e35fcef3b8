//! DMT: Hertz with a constant adhesion while the bodies overlap.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | W | work of adhesion, 2 gamma for like solids of surface energy gamma | J/m2 |
//! | R* | effective radius | m |
//! | d | overlap | m |
//!
//! Force: F = `F_Hertz` - 2 pi W R* for d > 0; the contact ends at d = 0, where it pulls hardest. Energy: that of Hertz
//! less 2 pi W R* d. Valid for small stiff spheres, Tabor parameter well below 1.
//!
//! Source: Derjaguin, Muller, Toporov, *J. Colloid Interface Sci.* 53 (1975) 314; the force with contact radius of Hertz
//! is Maugis's form (1992). Invariants: action = reaction, no energy gained on a closed path, a wall is the limit of a
//! large sphere.
//!
//! | code | words |
//! |---|---|
//! | LIGGGHTS | none |
//! | YADE | `gamma` = W / 2 with `includeAdhesion`; its dashpot pulls at most as hard as the adhesion |
//! | LAMMPS | `dmt`, last coefficient W / 2; friction sees `abs(F_ne + 2 F_po)` |

use std::f64::consts::TAU;

use crate::laws::{Approach, PairLaw};

use super::cohesive::{Attraction, Cohesive, DashpotLimit};
use super::hertz::Hertz;

/// The constant attraction 2 pi W R*.
#[derive(Clone, Copy, Debug)]
pub struct Constant;

/// The law.
pub type Dmt = Cohesive<Hertz, Constant>;

impl Dmt {
    /// The law with the dashpot of [`Hertz`]: cut so that Hertz and dashpot together never pull, or not.
    #[must_use]
    pub const fn new(force_cut: bool) -> Self {
        Self::with_hertz(force_cut, Constant)
    }

    /// YADE's.
    #[must_use]
    pub const fn yade() -> Self {
        Self { dashpot_limit: DashpotLimit::PullOff, ..Self::new(false) }
    }
}

impl Attraction for Constant {
    #[inline(always)]
    fn at(&self, pair: &PairLaw, approach: &Approach) -> (f64, f64) {
        let force = TAU * pair.work_of_adhesion * pair.effective_radius;
        (force, force * approach.overlap)
    }

    #[inline(always)]
    fn pull_off(&self, pair: &PairLaw, _: &Approach) -> f64 {
        TAU * pair.work_of_adhesion * pair.effective_radius
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
        Dmt::new(true).evaluate(&PairLaw { effective_radius, ..pair() }, &approach, &(), &mut ())
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
