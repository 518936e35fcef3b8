//! Hysteretic linear contact with a limit of cohesion.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | d, v | overlap, normal velocity (positive when approaching) | m, m/s |
//! | m | largest overlap that the contact remembers | m |
//! | k1, kp, kc | loading, largest unloading, cohesive stiffness | N/m |
//! | `phi_f`, l = kp / (kp - k1) `phi_f` 2 R* | plasticity depth, overlap of the largest stiffness | -, m |
//! | k2(m) = k1 + (kp - k1) min(m / l, 1) | unloading stiffness | N/m |
//! | g | dashpot constant | kg/s |
//!
//! Elastic force: the line k2 (d - m) + k1 m, but at most k1 d below l (loading, m = d), and at least -kc d, where m
//! falls; beyond l the line is kp (d - l) + k1 l for loading and unloading. F adds g v; with the cut it is at least
//! min(elastic, 0). Stored: `F_line`^2 / (2 k2).
//! Plastic loss while m grows: increments of k1 m^2 (1 - k1/k2) / 2; while it falls: of kc b^2 (1 + kc/k2) / 2 with
//! b = (k2 - k1) / (k2 + kc) m, both closed in m.
//!
//! Source: Luding, *Granular Matter* 10 (2008) 235. Invariants: action = reaction, no energy gained on a closed path, a
//! wall is the limit of a large sphere (not YADE's). Codes differ once the limit of cohesion is met, by the first order
//! in the step:
//!
//! | rule | m on the limit -kc d |
//! |---|---|
//! | `self_consistent` (plain; LIGGGHTS `hooke/hysteresis`) | (d + sqrt(d^2 + 4 (k1 + kc) d l / (kp - k1))) / 2, the branch through d |
//! | `old_stiffness` (LIGGGHTS `luding`) | (k2 + kc) / (k2 - k1) d with the old k2 |
//! | `luding_pm` (YADE `LudingPM`) | the same, only while d falls; k2 of the last step's m everywhere; line k2 (d - d0) with d0 = min((1 - k1/k2) m, `phi_f` 2 R*); l = 0 at bodies, so k2 = kp, and no force until d exceeds its first value |

use crate::laws::{Approach, NormalLaw, NormalState, PairLaw};

use super::hysteretic_branches::{Branches, Rule};

/// The law.
#[derive(Clone, Copy, Debug)]
pub struct LudingHysteretic {
    /// Loading stiffness k1 [N/m].
    pub loading: f64,
    /// Largest unloading stiffness kp [N/m], above k1.
    pub unloading: f64,
    /// Cohesive stiffness kc [N/m].
    pub cohesive: f64,
    /// Plasticity depth `phi_f` [-].
    pub plasticity_depth: f64,
    /// Dashpot constant [kg/s].
    pub dashpot: f64,
    /// Whether the dashpot may not pull beyond the elastic force. LIGGGHTS cuts only where kc = 0.
    pub force_cut: bool,
    /// Rule on the limit of cohesion.
    pub rule: Rule,
}

impl NormalLaw for LudingHysteretic {
    /// Largest overlap, last overlap, and YADE's offset.
    type History = (f64, f64, f64);
    type Shared = ();

    #[inline(always)]
    fn evaluate(&self, pair: &PairLaw, approach: &Approach, (): &(), history: &mut Self::History) -> NormalState {
        let (k1, kp) = (self.loading, self.unloading);
        let yade = self.rule == Rule::LudingPm;
        let radius = if yade && approach.at_body { 0.0 } else { pair.effective_radius };
        let depth = self.plasticity_depth * 2.0 * radius;
        let limit = kp / (kp - k1) * depth;
        let branches = Branches { loading: k1, unloading: kp, cohesive: self.cohesive, limit };
        let overlap = approach.overlap;
        let (largest, last, offset) = history;
        let before = *largest;
        let elastic = if yade {
            branches.yade(overlap, *last, depth, largest, offset)
        } else {
            branches.force(overlap, largest, self.rule)
        };
        *last = overlap;
        let stiffness = branches.stiffness(*largest);
        let total = elastic + self.dashpot * approach.normal_velocity;
        let force = if self.force_cut { total.max(elastic.min(0.0)) } else { total };
        let attraction = (-elastic).max(0.0);
        let cohesion = self.cohesive * (stiffness - k1) / (stiffness + self.cohesive) * largest.min(limit);
        NormalState {
            force,
            elastic,
            repulsive: force + attraction,
            dashpot: self.dashpot,
            pull_off: cohesion,
            contact_radius: (pair.effective_radius * overlap).sqrt(),
            tangent_stiffness: k1,
            energy: 0.5 * elastic * elastic / stiffness,
            plastic: branches.plastic(before, *largest),
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

    fn law(rule: Rule) -> LudingHysteretic {
        LudingHysteretic {
            loading: 1e3,
            unloading: 4e3,
            cohesive: 800.0,
            plasticity_depth: 0.05,
            dashpot: 0.0,
            force_cut: false,
            rule,
        }
    }

    proptest! {
        #[test]
        fn work_is_stored_or_lost_to_plastic_flow_and_that_never_comes_back(
            turns in proptest::collection::vec(0.01..1.0f64, 1..8),
        ) {
            let (mut history, mut last) = (Default::default(), (0.0, 0.0));
            let (mut work, mut plastic, mut scale, mut overlap) = (0.0, 0.0, 1e-12, 0.0);
            for target in turns.iter().map(|turn| turn * 1.2e-4) {
                let from: f64 = overlap;
                for step in 1..=4000 {
                    overlap = from + (target - from) * f64::from(step) / 4000.0;
                    let approach = Approach { overlap, normal_velocity: 0.0, radii: [2e-3; 2], at_body: false };
                    let state = law(Rule::SelfConsistent).evaluate(&pair(), &approach, &(), &mut history);
                    prop_assert!(state.plastic >= -1e-20);
                    prop_assert!(state.elastic <= 4e3 * overlap && state.elastic >= -800.0 * overlap * (1.0 + 1e-12));
                    work += 0.5 * (state.force + last.0) * (overlap - last.1);
                    plastic += state.plastic;
                    last = (state.force, overlap);
                    scale = state.energy.max(scale).max(plastic);
                    let open = work - plastic - state.energy;
                    prop_assert!(open.abs() < 1e-3 * scale, "{} {} {}", work, plastic, state.energy);
                }
            }
        }

        #[test]
        fn rules_agree_until_the_limit_of_cohesion(share in 0.01..1.0f64) {
            let mut forces = [0.0; 3];
            for (rule, force) in [Rule::SelfConsistent, Rule::OldStiffness, Rule::LudingPm].into_iter().zip(&mut forces) {
                let mut history = Default::default();
                for overlap in [share * 5e-5, share * 5e-5, share * 4.9e-5] {
                    let approach = Approach { overlap, normal_velocity: 0.0, radii: [2e-3; 2], at_body: false };
                    *force = law(rule).evaluate(&pair(), &approach, &(), &mut history).force;
                }
            }
            prop_assert!((forces[0] - forces[1]).abs() < 1e-15);
        }
    }
}
