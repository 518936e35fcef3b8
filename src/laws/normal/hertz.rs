//! Hertz normal force with the dashpot of constant restitution.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | d | overlap, positive in contact | m |
//! | v | normal velocity, positive when approaching | m/s |
//! | R*, m*, E* | effective radius, mass, Young's modulus | m, kg, Pa |
//! | a = sqrt(R* d) | contact radius | m |
//! | S = 2 E* a | tangent normal stiffness | N/m |
//! | beta | fraction of critical damping | - |
//!
//! Force: F = 4/3 E* a d + 2 sqrt(5/6) beta sqrt(S m*) v for d > 0; with the cut, F = max(F, 0).
//! Elastic energy: 8/15 E* a d^2.
//!
//! Valid for smooth elastic bodies with a << R*. Sources: Hertz, *J. reine angew. Math.* 92 (1882) 156; Tsuji, Tanaka,
//! Ishida, *Powder Technology* 71 (1992) 239 for a dashpot proportional to d^(1/4); Antypov, Elliott, *EPL* 94 (2011)
//! 50004 for its constant.

use std::f64::consts::PI;

use crate::laws::{Approach, NormalLaw, NormalState, PairLaw};

/// The law; its values come with each pair.
#[derive(Clone, Copy, Debug)]
pub struct Hertz {
    /// Whether the total force is cut at zero.
    pub force_cut: bool,
}

/// An elastic impact from first touch to separation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticImpact {
    /// Largest overlap [m].
    pub overlap: f64,
    /// Duration [s].
    pub duration: f64,
}

impl Hertz {
    /// Largest overlap (15 m* v^2 / (16 E* sqrt(R*)))^(2/5) and duration 4/5 sqrt(pi) Gamma(2/5) / Gamma(9/10) times
    /// overlap / v of an undamped impact at `speed` v [m/s]. It chooses time steps; no gate uses it.
    #[must_use]
    pub fn elastic_impact(pair: &PairLaw, speed: f64) -> ElasticImpact {
        let stiffness = pair.effective_young * pair.effective_radius.sqrt();
        let overlap = libm::pow(15.0 * pair.effective_mass * speed * speed / (16.0 * stiffness), 0.4);
        let factor = 0.8 * PI.sqrt() * libm::tgamma(0.4) / libm::tgamma(0.9);
        ElasticImpact { overlap, duration: factor * overlap / speed }
    }
}

impl NormalLaw for Hertz {
    type History = ();
    type Shared = ();
    const BATCHED: bool = true;

    #[inline(always)]
    fn evaluate(&self, pair: &PairLaw, approach: &Approach, (): &(), (): &mut ()) -> NormalState {
        let contact_radius = (pair.effective_radius * approach.overlap).sqrt();
        let tangent_stiffness = 2.0 * pair.effective_young * contact_radius;
        let elastic = 2.0 / 3.0 * tangent_stiffness * approach.overlap;
        let constant = 2.0 * (5.0f64 / 6.0).sqrt() * pair.damping_ratio;
        let dashpot = constant * (tangent_stiffness * pair.effective_mass).sqrt();
        let force = elastic + dashpot * approach.normal_velocity;
        let force = if self.force_cut && force < 0.0 { 0.0 } else { force };
        NormalState {
            force,
            elastic,
            repulsive: force,
            dashpot,
            pull_off: 0.0,
            contact_radius,
            tangent_stiffness,
            energy: 0.4 * elastic * approach.overlap,
            plastic: 0.0,
            friction_share: 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn pair(damping_ratio: f64) -> PairLaw {
        PairLaw {
            effective_young: 5e6,
            effective_shear: 0.0,
            friction: 0.0,
            effective_radius: 2e-3,
            effective_mass: 1e-5,
            damping_ratio,
            ..PairLaw::default()
        }
    }

    fn state(law: Hertz, damping_ratio: f64, overlap: f64, normal_velocity: f64) -> NormalState {
        law.evaluate(
            &pair(damping_ratio),
            &Approach { overlap, normal_velocity, radii: [4e-3; 2], at_body: false },
            &(),
            &mut (),
        )
    }

    proptest! {
        #[test]
        fn elastic_force_is_the_derivative_of_its_energy(overlap in 1e-7..1e-4f64) {
            let law = Hertz { force_cut: true };
            let width = overlap * 1e-4;
            let energy = |d| state(law, 0.0, d, 0.0).energy;
            let slope = (energy(overlap + width) - energy(overlap - width)) / (2.0 * width);
            let force = state(law, 0.0, overlap, 0.0).elastic;
            prop_assert!((slope / force - 1.0).abs() < 1e-7);
        }

        #[test]
        fn tangent_stiffness_is_the_derivative_of_the_elastic_force(overlap in 1e-7..1e-4f64) {
            let law = Hertz { force_cut: true };
            let width = overlap * 1e-4;
            let force = |d| state(law, 0.0, d, 0.0).elastic;
            let slope = (force(overlap + width) - force(overlap - width)) / (2.0 * width);
            prop_assert!((slope / state(law, 0.0, overlap, 0.0).tangent_stiffness - 1.0).abs() < 1e-7);
        }

        #[test]
        fn a_dashpot_dissipates_and_a_cut_force_never_pulls(
            overlap in 1e-9..1e-4f64, velocity in -10.0..10.0f64, beta in 0.0..1.0f64,
        ) {
            for force_cut in [true, false] {
                let state = state(Hertz { force_cut }, beta, overlap, velocity);
                prop_assert!((state.force - state.elastic) * velocity >= 0.0);
                prop_assert!(!force_cut || state.force >= 0.0);
            }
        }
    }
}
