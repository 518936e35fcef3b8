//! Laws chosen when a run starts. The choice is the same for all contacts, so that its branches are predicted; what it
//! saves is one compiled copy of the sweep for each combination.

use super::model::Frictionless;
use super::normal::dmt::Dmt;
use super::normal::hertz::Hertz;
use super::normal::linear_spring_dashpot::LinearSpringDashpot;
use super::normal::luding_hysteretic::LudingHysteretic;
use super::normal::sjkr::{Lens, Sjkr};
use super::normal::sjkr2::{Linear, Sjkr2};
use super::registry::{Normal, Tangential};
use super::slider::Memory;
use super::tangential::linear_history::LinearHistory;
use super::tangential::mindlin::Mindlin;
use super::tangential::options::Options;
use super::{Approach, Contact, NormalLaw, NormalState, PairLaw, TangentialLaw, TangentialState};

/// A normal law of the registry.
#[derive(Clone, Copy, Debug)]
#[expect(missing_docs, reason = "the laws' own files describe them")]
pub enum AnyNormal {
    Hertz(Hertz),
    Dmt(Dmt),
    Sjkr(Sjkr),
    Sjkr2(Sjkr2),
    LinearSpringDashpot(LinearSpringDashpot),
    LudingHysteretic(LudingHysteretic),
}

impl AnyNormal {
    /// The law of a specification. None for a law that is compiled by itself.
    #[must_use]
    pub fn new(normal: &Normal) -> Option<Self> {
        Some(match *normal {
            Normal::Hertz { force_cut } => Self::Hertz(Hertz { force_cut }),
            Normal::Dmt { force_cut, dashpot_limit } => Self::Dmt(Dmt { dashpot_limit, ..Dmt::new(force_cut) }),
            Normal::Sjkr { force_cut, energy_density } => {
                Self::Sjkr(Sjkr::with_hertz(force_cut, Lens { energy_density }))
            }
            Normal::Sjkr2 { force_cut, energy_density } => {
                Self::Sjkr2(Sjkr2::with_hertz(force_cut, Linear { energy_density }))
            }
            Normal::LinearSpringDashpot { stiffness, dashpot, force_cut } => {
                Self::LinearSpringDashpot(LinearSpringDashpot { stiffness, dashpot, force_cut })
            }
            Normal::LudingHysteretic { k1, kp, kc, plasticity_depth, dashpot, force_cut, rule } => {
                let (loading, unloading, cohesive) = (k1, kp, kc);
                let law = LudingHysteretic { loading, unloading, cohesive, plasticity_depth, dashpot, force_cut, rule };
                Self::LudingHysteretic(law)
            }
            Normal::LudingSintering { .. } => return None,
        })
    }
}

impl NormalLaw for AnyNormal {
    type History = <LudingHysteretic as NormalLaw>::History;
    type Shared = ();

    #[inline]
    fn evaluate(&self, pair: &PairLaw, approach: &Approach, (): &(), history: &mut Self::History) -> NormalState {
        match self {
            Self::Hertz(law) => law.evaluate(pair, approach, &(), &mut ()),
            Self::Dmt(law) => law.evaluate(pair, approach, &(), &mut ()),
            Self::Sjkr(law) => law.evaluate(pair, approach, &(), &mut ()),
            Self::Sjkr2(law) => law.evaluate(pair, approach, &(), &mut ()),
            Self::LinearSpringDashpot(law) => law.evaluate(pair, approach, &(), &mut ()),
            Self::LudingHysteretic(law) => law.evaluate(pair, approach, &(), history),
        }
    }
}

/// A tangential law of the registry.
#[derive(Clone, Copy, Debug)]
#[expect(missing_docs, reason = "the laws' own files describe them")]
pub enum AnyTangential {
    Frictionless,
    Mindlin(Mindlin<Options>),
    LinearHistory(LinearHistory<Options>),
}

impl AnyTangential {
    /// The law of a specification. None for a law that is compiled by itself.
    #[must_use]
    pub fn new(tangential: &Tangential) -> Option<Self> {
        Some(match *tangential {
            Tangential::Frictionless => Self::Frictionless,
            Tangential::Mindlin { dashpot, options } => Self::Mindlin(Mindlin { choices: options, dashpot }),
            Tangential::LinearHistory { stiffness_ratio, dashpot, options } => {
                Self::LinearHistory(LinearHistory { stiffness_ratio, dashpot, choices: options })
            }
            Tangential::LudingSintering { .. } => return None,
        })
    }
}

impl TangentialLaw for AnyTangential {
    type History = Memory;

    #[inline]
    fn evaluate(&self, contact: &Contact, normal: &NormalState, dt: f64, history: &mut Memory) -> TangentialState {
        match self {
            Self::Frictionless => Frictionless.evaluate(contact, normal, dt, &mut ()),
            Self::Mindlin(law) => law.evaluate(contact, normal, dt, history),
            Self::LinearHistory(law) => law.evaluate(contact, normal, dt, history),
        }
    }
}
