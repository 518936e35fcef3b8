//! The laws by name: typed specifications, their checks, and the list of models that are compiled.
//!
//! A specification is matched once, before a run; what it names is monomorphised, so no contact pays for the choice.
//!
//! | normal | tangential | moments |
//! |---|---|---|
//! | hertz, dmt, sjkr, sjkr2 | frictionless, mindlin | any with mindlin |
//! | `linear_spring_dashpot`, `luding_hysteretic` | frictionless, `linear_history` | any with `linear_history` |

use serde::{Deserialize, Serialize};

use crate::error::Problem;

use super::model::{Composed, ContactModel, Free, Frictionless};
use super::moments::any::Moments;
use super::normal::cohesive::DashpotLimit;
use super::normal::dmt::Dmt;
use super::normal::hertz::Hertz;
use super::normal::hysteretic_branches::Rule;
use super::normal::linear_spring_dashpot::LinearSpringDashpot;
use super::normal::luding_hysteretic::LudingHysteretic;
use super::normal::sjkr::{Lens, Sjkr};
use super::normal::sjkr2::{Linear, Sjkr2};
use super::tangential::linear_history::LinearHistory;
use super::tangential::mindlin::Mindlin;
use super::tangential::options::{Dashpot, Options};
use super::{NormalLaw, TangentialLaw};

/// A normal law; values that belong to pairs are not here.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "law", rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "the laws' own files describe their values")]
pub enum Normal {
    Hertz { force_cut: bool },
    Dmt { force_cut: bool, dashpot_limit: DashpotLimit },
    Sjkr { force_cut: bool, energy_density: f64 },
    Sjkr2 { force_cut: bool, energy_density: f64 },
    LinearSpringDashpot { stiffness: f64, dashpot: f64, force_cut: bool },
    LudingHysteretic { k1: f64, kp: f64, kc: f64, plasticity_depth: f64, dashpot: f64, force_cut: bool, rule: Rule },
}

/// A tangential law.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "law", rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "the laws' own files describe their values")]
pub enum Tangential {
    Frictionless,
    Mindlin { dashpot: Dashpot, options: Options },
    LinearHistory { stiffness_ratio: f64, dashpot: Dashpot, options: Options },
}

/// A composed model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Specification {
    /// Force along the normal.
    pub normal: Normal,
    /// Force in the contact plane.
    pub tangential: Tangential,
    /// Moments.
    pub moments: Moments,
}

/// What is done with a model once its type is known.
pub trait Visitor {
    /// What comes of it.
    type Output;

    /// Takes the model.
    fn visit<M: ContactModel>(self, model: M) -> Self::Output;
}

impl Specification {
    /// Hands the model to `visitor`.
    ///
    /// # Errors
    /// A value is outside its law's range, or no model of these laws is compiled.
    pub fn build<V: Visitor>(&self, visitor: V) -> Result<V::Output, Problem> {
        self.check()?;
        match self.normal {
            Normal::Hertz { force_cut } => self.spot(Hertz { force_cut }, visitor),
            Normal::Dmt { force_cut, dashpot_limit } => {
                self.spot(Dmt { dashpot_limit, ..Dmt::new(force_cut) }, visitor)
            }
            Normal::Sjkr { force_cut, energy_density } => {
                self.spot(Sjkr::with_hertz(force_cut, Lens { energy_density }), visitor)
            }
            Normal::Sjkr2 { force_cut, energy_density } => {
                self.spot(Sjkr2::with_hertz(force_cut, Linear { energy_density }), visitor)
            }
            Normal::LinearSpringDashpot { stiffness, dashpot, force_cut } => {
                self.linear(LinearSpringDashpot { stiffness, dashpot, force_cut }, visitor)
            }
            Normal::LudingHysteretic { k1, kp, kc, plasticity_depth, dashpot, force_cut, rule } => {
                let (loading, unloading, cohesive) = (k1, kp, kc);
                let law = LudingHysteretic { loading, unloading, cohesive, plasticity_depth, dashpot, force_cut, rule };
                self.linear(law, visitor)
            }
        }
    }

    /// Models of a law with the contact spot of Hertz.
    fn spot<N: NormalLaw, V: Visitor>(&self, normal: N, visitor: V) -> Result<V::Output, Problem> {
        match self.tangential {
            Tangential::Frictionless => self.without_friction(normal, visitor),
            Tangential::Mindlin { dashpot: Dashpot::CriticalShare, options }
                if options == Options::plain() && self.moments == Moments::NONE =>
            {
                Ok(visitor.visit(Composed { normal, tangential: Mindlin::plain(), moments: Free }))
            }
            Tangential::Mindlin { dashpot, options } => {
                Ok(self.compose(normal, Mindlin { choices: options, dashpot }, visitor))
            }
            Tangential::LinearHistory { .. } => Err(unknown("linear_history", "frictionless and mindlin")),
        }
    }

    /// Models of a law with a constant loading stiffness.
    fn linear<N: NormalLaw, V: Visitor>(&self, normal: N, visitor: V) -> Result<V::Output, Problem> {
        match self.tangential {
            Tangential::Frictionless => self.without_friction(normal, visitor),
            Tangential::LinearHistory { stiffness_ratio, dashpot, options } => {
                Ok(self.compose(normal, LinearHistory { stiffness_ratio, dashpot, choices: options }, visitor))
            }
            Tangential::Mindlin { .. } => Err(unknown("mindlin", "frictionless and linear_history")),
        }
    }

    fn without_friction<N: NormalLaw, V: Visitor>(&self, normal: N, visitor: V) -> Result<V::Output, Problem> {
        if self.moments == Moments::NONE {
            Ok(visitor.visit(Composed { normal, tangential: Frictionless, moments: Free }))
        } else {
            Err(Problem::new("model.moments", "a moment law", "none where there is no friction"))
        }
    }

    fn compose<N: NormalLaw, T: TangentialLaw, V: Visitor>(&self, normal: N, tangential: T, visitor: V) -> V::Output {
        visitor.visit(Composed { normal, tangential, moments: self.moments })
    }

    /// Refuses values outside the laws' ranges.
    ///
    /// # Errors
    /// The first such value: key, value, range.
    pub fn check(&self) -> Result<(), Problem> {
        match self.normal {
            Normal::Hertz { .. } | Normal::Dmt { .. } => {}
            Normal::Sjkr { energy_density, .. } | Normal::Sjkr2 { energy_density, .. } => {
                within("model.normal.energy_density", energy_density, energy_density >= 0.0, "at least 0 J/m3")?;
            }
            Normal::LinearSpringDashpot { stiffness, dashpot, .. } => {
                within("model.normal.stiffness", stiffness, stiffness > 0.0, "above 0 N/m")?;
                within("model.normal.dashpot", dashpot, dashpot >= 0.0, "at least 0 kg/s")?;
            }
            Normal::LudingHysteretic { k1, kp, kc, plasticity_depth, dashpot, .. } => {
                within("model.normal.k1", k1, k1 > 0.0, "above 0 N/m")?;
                within("model.normal.kp", kp, kp > k1, "above k1")?;
                within("model.normal.kc", kc, kc >= 0.0, "at least 0 N/m")?;
                within("model.normal.plasticity_depth", plasticity_depth, plasticity_depth > 0.0, "above 0")?;
                within("model.normal.dashpot", dashpot, dashpot >= 0.0, "at least 0 kg/s")?;
            }
        }
        if let Tangential::LinearHistory { stiffness_ratio, .. } = self.tangential {
            within("model.tangential.stiffness_ratio", stiffness_ratio, stiffness_ratio > 0.0, "above 0")?;
        }
        if let Tangential::Mindlin { dashpot, .. } | Tangential::LinearHistory { dashpot, .. } = self.tangential {
            let (Dashpot::NormalShare { ratio: value } | Dashpot::Constant { value }) = dashpot else {
                return self.moments.check();
            };
            within("model.tangential.dashpot", value, value >= 0.0, "at least 0")?;
        }
        self.moments.check()
    }
}

/// A value that must hold.
pub(super) fn within(key: &str, value: f64, holds: bool, allowed: &str) -> Result<(), Problem> {
    if holds && value.is_finite() { Ok(()) } else { Err(Problem::new(key, value, allowed)) }
}

fn unknown(law: &str, known: &str) -> Problem {
    Problem::new("model.tangential.law", law, format!("with this normal law: {known}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::moments::any::Rolling;
    use crate::laws::moments::elastic_plastic_rolling::{self, ElasticPlasticRolling, Stiffness};
    use crate::laws::slider::History;

    struct Nothing;

    impl Visitor for Nothing {
        type Output = ();

        fn visit<M: ContactModel>(self, _: M) {}
    }

    fn luding(k1: f64, kc: f64) -> Normal {
        let (rule, force_cut) = (Rule::SelfConsistent, false);
        Normal::LudingHysteretic { k1, kp: 4e3, kc, plasticity_depth: 0.05, dashpot: 0.0, force_cut, rule }
    }

    fn refusal(normal: Normal, tangential: Tangential, moments: Moments) -> String {
        let specification = Specification { normal, tangential, moments };
        specification.build(Nothing).map_or_else(|problem| problem.to_string(), |()| "none".into())
    }

    #[test]
    fn values_out_of_range_and_unknown_models_are_refused_by_key() {
        let none = Moments::NONE;
        let smooth = Tangential::Frictionless;
        let hertz = Normal::Hertz { force_cut: true };
        let mindlin = Tangential::Mindlin { dashpot: Dashpot::CriticalShare, options: Options::plain() };
        assert_eq!(refusal(luding(1e3, 10.0), smooth, none), "none");
        assert_eq!(refusal(hertz, mindlin, none), "none");
        assert_eq!(refusal(luding(4e3, 10.0), smooth, none), "model.normal.kp = 4000: above k1");
        assert_eq!(refusal(luding(1e3, -1.0), smooth, none), "model.normal.kc = -1: at least 0 N/m");
        assert_eq!(
            refusal(luding(1e3, 10.0), mindlin, none),
            "model.tangential.law = mindlin: with this normal law: frictionless and linear_history"
        );
        let dashpot = elastic_plastic_rolling::Dashpot::None;
        let spring = ElasticPlasticRolling::liggghts(Stiffness::Normal { factor: 0.0 }, dashpot, false);
        let rolling = Moments { rolling: Rolling::ElasticPlasticRolling { spring }, twisting: None };
        assert_eq!(
            refusal(hertz, mindlin, rolling),
            "model.moments.rolling.stiffness = 0: above 0 where the moment is capped"
        );
        let spring = ElasticPlasticRolling::plain();
        let rolling = Moments { rolling: Rolling::ElasticPlasticRolling { spring }, twisting: None };
        assert_eq!(refusal(hertz, smooth, rolling), "model.moments = a moment law: none where there is no friction");
    }

    #[test]
    fn specifications_are_snake_case_json_and_refuse_unknown_keys() {
        let options = Options::lammps(History::Force);
        let tangential = Tangential::Mindlin { dashpot: Dashpot::CriticalShare, options };
        let text = serde_json::to_string(&tangential).unwrap();
        assert!(text.contains("\"law\":\"mindlin\"") && text.contains("\"rotation\":\"projection_rescaled\""));
        assert_eq!(serde_json::from_str::<Tangential>(&text).unwrap(), tangential);
        assert!(serde_json::from_str::<Normal>("{\"law\":\"hertz\",\"force_cut\":true,\"e\":1}").is_err());
        let error = serde_json::from_str::<Normal>("{\"law\":\"hooke\"}").unwrap_err().to_string();
        assert!(error.contains("luding_hysteretic"), "{error}");
    }
}
