//! A normal law with an attraction added while the bodies overlap: the form of [`super::dmt`], [`super::sjkr`] and
//! [`super::sjkr2`].
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `F_b`, `F_a` | force of the base law (elastic and damping), attraction | N |
//! | d | overlap | m |
//!
//! Force: F = `F_b` - `F_a`(d) for d > 0. The base law's cut acts on `F_b` only. Invariants: action = reaction, no energy
//! gained on a closed path (the attraction has a potential), and those of the base law.

use serde::{Deserialize, Serialize};

use crate::laws::{Approach, NormalLaw, NormalState, PairLaw, Surroundings};

use super::hertz::Hertz;

/// An attraction while bodies overlap.
pub trait Attraction: Copy + Send + Sync {
    /// Attraction [N] and its potential, from first touch [J].
    fn at(&self, pair: &PairLaw, approach: &Approach) -> (f64, f64);

    /// Size of the most attractive force of a contact [N].
    fn pull_off(&self, pair: &PairLaw, approach: &Approach) -> f64;
}

/// How far a dashpot may pull besides the attraction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DashpotLimit {
    /// As the base law says.
    Base,
    /// Where the total attracts, the damping force is at most the pull-off force (YADE; its base law is not cut).
    PullOff,
}

/// A base law and an attraction.
#[derive(Clone, Copy, Debug)]
pub struct Cohesive<N, A> {
    /// Base law.
    pub base: N,
    /// Attraction.
    pub attraction: A,
    /// How far the dashpot may pull.
    pub dashpot_limit: DashpotLimit,
}

impl<A> Cohesive<Hertz, A> {
    /// The attraction with Hertz, whose cut it keeps.
    #[must_use]
    pub const fn with_hertz(force_cut: bool, attraction: A) -> Self {
        Self { base: Hertz { force_cut }, attraction, dashpot_limit: DashpotLimit::Base }
    }
}

impl<N: NormalLaw, A: Attraction> NormalLaw for Cohesive<N, A> {
    type History = N::History;
    type Shared = N::Shared;

    fn advance(&self, shared: &mut N::Shared, surroundings: &Surroundings, dt: f64) {
        self.base.advance(shared, surroundings, dt);
    }

    #[inline(always)]
    fn evaluate(
        &self,
        pair: &PairLaw,
        approach: &Approach,
        shared: &N::Shared,
        history: &mut N::History,
    ) -> NormalState {
        let base = self.base.evaluate(pair, approach, shared, history);
        let (attraction, potential) = self.attraction.at(pair, approach);
        let pull_off = self.attraction.pull_off(pair, approach);
        let damping = base.force - base.elastic;
        let excess = self.dashpot_limit == DashpotLimit::PullOff
            && base.force < attraction
            && damping.abs() > pull_off
            && pull_off > 0.0;
        let repulsive = if excess { base.elastic + pull_off.copysign(damping) } else { base.force };
        NormalState {
            force: repulsive - attraction,
            elastic: base.elastic - attraction,
            repulsive,
            pull_off,
            energy: base.energy - potential,
            ..base
        }
    }
}

/// (4/27) c^3 / K^2: the largest attraction of K d^1.5 - c d, Hertz with K = 4/3 E* sqrt(R*) and a slope c [N/m].
#[must_use]
pub(super) fn hertz_pull_off(pair: &PairLaw, slope: f64) -> f64 {
    let stiffness = 4.0 / 3.0 * pair.effective_young;
    if stiffness > 0.0 {
        4.0 / 27.0 * slope * slope * slope / (stiffness * stiffness * pair.effective_radius)
    } else {
        0.0
    }
}
