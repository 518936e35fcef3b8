//! Linear spring and dashpot.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | d, v | overlap, normal velocity (positive when approaching) | m, m/s |
//! | k, g | stiffness, dashpot constant | N/m, kg/s |
//! | a = sqrt(R* d) | radius of the contact spot, for laws that ask | m |
//!
//! Force: F = k d + g v for d > 0; with the cut, F = max(F, 0). Energy: k d^2 / 2. Restitution without the cut:
//! exp(-pi g / sqrt(4 m* k - g^2)).
//!
//! Source: Cundall, Strack, *Geotechnique* 29 (1979) 47. Invariants: no energy gained, action = reaction, a wall is the
//! limit of a large sphere.
//!
//! | code | words |
//! |---|---|
//! | LIGGGHTS | `model hooke/stiffness absolute_damping on limitForce on`, kn, `gamman_abs` |
//! | YADE | `ViscElMat` kn = 2 k, cn = 2 g |
//! | LAMMPS | `hooke k g`, `damping velocity`, `limit_damping` |

use std::f64::consts::PI;

use crate::laws::{Approach, NormalLaw, NormalState, PairLaw};

/// The law.
#[derive(Clone, Copy, Debug)]
pub struct LinearSpringDashpot {
    /// Stiffness [N/m].
    pub stiffness: f64,
    /// Dashpot constant [kg/s].
    pub dashpot: f64,
    /// Whether the total force is cut at zero.
    pub force_cut: bool,
}

impl LinearSpringDashpot {
    /// Duration pi sqrt(m*/k) of an undamped impact [s]. It chooses time steps; no gate uses it.
    #[must_use]
    pub fn half_period(stiffness: f64, effective_mass: f64) -> f64 {
        PI * (effective_mass / stiffness).sqrt()
    }
}

impl NormalLaw for LinearSpringDashpot {
    type History = ();
    type Shared = ();

    #[inline(always)]
    fn evaluate(&self, pair: &PairLaw, approach: &Approach, (): &(), (): &mut ()) -> NormalState {
        let elastic = self.stiffness * approach.overlap;
        let force = elastic + self.dashpot * approach.normal_velocity;
        let force = if self.force_cut && force < 0.0 { 0.0 } else { force };
        NormalState {
            force,
            elastic,
            repulsive: force,
            dashpot: self.dashpot,
            pull_off: 0.0,
            contact_radius: (pair.effective_radius * approach.overlap).sqrt(),
            tangent_stiffness: self.stiffness,
            energy: 0.5 * elastic * approach.overlap,
            plastic: 0.0,
            friction_share: 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

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

    proptest! {
        #[test]
        fn the_force_is_the_slope_of_its_energy_and_the_dashpot_dissipates(
            overlap in 1e-7..1e-4f64, normal_velocity in -5.0..5.0f64, force_cut: bool,
        ) {
            let law = LinearSpringDashpot { stiffness: 2e4, dashpot: 0.1, force_cut };
            let at = |overlap| {
                let approach = Approach { overlap, normal_velocity, radii: [2e-3; 2], at_body: false };
                law.evaluate(&pair(), &approach, &(), &mut ())
            };
            let (state, width) = (at(overlap), 1e-4 * overlap);
            let slope = (at(overlap + width).energy - at(overlap - width).energy) / (2.0 * width);
            prop_assert!((slope / state.elastic - 1.0).abs() < 1e-9);
            prop_assert!((state.force - state.elastic) * normal_velocity >= 0.0);
            prop_assert!(!force_cut || state.force >= 0.0);
        }
    }
}
