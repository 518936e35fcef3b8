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
