//! The laws by name: typed specifications, their checks, and the list of models that are compiled.
//!
//! | normal | tangential | moments |
//! |---|---|---|
//! | hertz, dmt, sjkr, sjkr2 | frictionless, mindlin | any with mindlin |
//! | `linear_spring_dashpot`, `luding_hysteretic` | frictionless, `linear_history` | any with `linear_history` |
//!
//! A specification is matched once, before a run. The models of large beds, hertz with nothing or with plain mindlin, are
//! compiled for themselves; all others share one model that chooses its laws at each contact ([`super::any`]): each
//! compiled model is one more copy of the sweep.

use serde::{Deserialize, Serialize};

use crate::error::Problem;

use super::PairLaw;
use super::any::{AnyNormal, AnyTangential};
use super::model::{Composed, ContactModel, Free, Frictionless};
use super::moments::any::Moments;
use super::normal::cohesive::DashpotLimit;
use super::normal::hertz::Hertz;
use super::normal::hysteretic_branches::Rule;
use super::normal::linear_spring_dashpot::LinearSpringDashpot;
use super::normal::luding_sintering::{Brittle, LudingSintering, Sliding};
use super::tangential::luding_sintering::LudingSintering as SinteringFriction;
use super::tangential::mindlin::Mindlin;
use super::tangential::options::{Dashpot, Options};

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
    LudingSintering(LudingSintering),
}

/// A tangential law.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "law", rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "the laws' own files describe their values")]
pub enum Tangential {
    Frictionless,
    Mindlin { dashpot: Dashpot, options: Options },
    LinearHistory { stiffness_ratio: f64, dashpot: Dashpot, options: Options },
    LudingSintering(SinteringFriction),
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

impl Normal {
    /// Duration of an elastic impact at `speed` [m/s], along the loading branch where there are several [s].
    #[must_use]
    pub fn impact_duration(&self, pair: &PairLaw, speed: f64) -> f64 {
        match *self {
            Self::Hertz { .. } | Self::Dmt { .. } | Self::Sjkr { .. } | Self::Sjkr2 { .. } => {
                Hertz::elastic_impact(pair, speed).duration
            }
            Self::LinearSpringDashpot { stiffness, .. }
            | Self::LudingHysteretic { k1: stiffness, .. }
            | Self::LudingSintering(LudingSintering { k1: stiffness, .. }) => {
                LinearSpringDashpot::half_period(stiffness, pair.effective_mass)
            }
        }
    }
}

/// What is done with a model once its type is known.
pub trait Visitor {
    /// What comes of it.
    type Output;

    /// Takes the model.
    fn visit<M: ContactModel>(self, model: M) -> Self::Output;
}

/// Values that the laws of a model ask of each pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, clippy::struct_excessive_bools, reason = "the names of the values of a pair")]
pub struct Asked {
    pub effective_young: bool,
    pub effective_shear: bool,
    pub friction: bool,
    pub rolling_friction: bool,
    pub twisting_friction: bool,
    pub work_of_adhesion: bool,
    pub cohesive: bool,
}

impl Specification {
    /// What the laws ask of each pair.
    #[must_use]
    pub fn asks(&self) -> Asked {
        let stiff = matches!(
            self.normal,
            Normal::LinearSpringDashpot { .. } | Normal::LudingHysteretic { .. } | Normal::LudingSintering { .. }
        );
        Asked {
            effective_young: !stiff,
            effective_shear: matches!(self.tangential, Tangential::Mindlin { .. }),
            friction: self.tangential != Tangential::Frictionless,
            rolling_friction: self.moments.rolling.capped(),
            twisting_friction: self.moments.twisting.is_some_and(|law| law.capped()),
            work_of_adhesion: matches!(self.normal, Normal::Dmt { .. }),
            cohesive: matches!(self.normal, Normal::LudingSintering { .. }),
        }
    }

    /// Hands the model to `visitor`.
    ///
    /// # Errors
    /// A value is outside its law's range, or no model of these laws is compiled.
    pub fn build<V: Visitor>(&self, visitor: V) -> Result<V::Output, Problem> {
        self.check()?;
        let Self { normal, tangential, moments } = *self;
        Ok(match (normal, tangential) {
            (Normal::Hertz { force_cut }, Tangential::Frictionless) => {
                visitor.visit(Composed { normal: Hertz { force_cut }, tangential: Frictionless, moments: Free })
            }
            (Normal::Hertz { force_cut }, Tangential::Mindlin { dashpot: Dashpot::CriticalShare, options })
                if options == Options::plain() && moments == Moments::NONE =>
            {
                visitor.visit(Composed { normal: Hertz { force_cut }, tangential: Mindlin::plain(), moments: Free })
            }
            (Normal::LudingSintering(normal), Tangential::LudingSintering(tangential)) => {
                if normal.sliding == Sliding::Brittle {
                    visitor.visit(Composed { normal: Brittle(normal), tangential, moments: Free })
                } else {
                    visitor.visit(Composed { normal, tangential, moments: Free })
                }
            }
            (Normal::LudingSintering(normal), _) => {
                visitor.visit(Composed { normal, tangential: Frictionless, moments: Free })
            }
            _ => {
                let any = AnyNormal::new(&normal).zip(AnyTangential::new(&tangential));
                let Some((normal, tangential)) = any else { return Err(alone(&self.tangential)) };
                visitor.visit(Composed { normal, tangential, moments })
            }
        })
    }

    /// Refuses laws that do not stand together.
    fn partners(&self) -> Result<(), Problem> {
        let linear = matches!(self.normal, Normal::LinearSpringDashpot { .. } | Normal::LudingHysteretic { .. });
        if matches!(self.normal, Normal::LudingSintering { .. }) {
            return match self.tangential {
                Tangential::Frictionless | Tangential::LudingSintering { .. } if self.moments == Moments::NONE => {
                    Ok(())
                }
                Tangential::Frictionless | Tangential::LudingSintering { .. } => {
                    Err(Problem::new("model.moments", "a moment law", "none beside the law luding_sintering"))
                }
                other => Err(unknown(other.name(), "frictionless and luding_sintering")),
            };
        }
        match self.tangential {
            Tangential::LudingSintering { .. } => Err(alone(&self.tangential)),
            Tangential::LinearHistory { .. } if !linear => Err(unknown("linear_history", "frictionless and mindlin")),
            Tangential::Mindlin { .. } if linear => Err(unknown("mindlin", "frictionless and linear_history")),
            Tangential::Frictionless if self.moments != Moments::NONE => {
                Err(Problem::new("model.moments", "a moment law", "none where there is no friction"))
            }
            _ => Ok(()),
        }
    }

    /// Refuses values outside the laws' ranges.
    ///
    /// # Errors
    /// The first such value: key, value, range.
    pub fn check(&self) -> Result<(), Problem> {
        self.partners()?;
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
            Normal::LudingSintering(law) => law.check()?,
        }
        if let Tangential::LinearHistory { stiffness_ratio, .. }
        | Tangential::LudingSintering(SinteringFriction { stiffness_ratio, .. }) = self.tangential
        {
            within("model.tangential.stiffness_ratio", stiffness_ratio, stiffness_ratio > 0.0, "above 0")?;
        }
        if let Tangential::LudingSintering(SinteringFriction { dashpot, .. }) = self.tangential {
            within("model.tangential.dashpot", dashpot, dashpot >= 0.0, "at least 0 kg/s")?;
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

impl Tangential {
    fn name(&self) -> &'static str {
        match self {
            Self::Frictionless => "frictionless",
            Self::Mindlin { .. } => "mindlin",
            Self::LinearHistory { .. } => "linear_history",
            Self::LudingSintering { .. } => "luding_sintering",
        }
    }
}

/// A law of sintering beside one that is not.
fn alone(tangential: &Tangential) -> Problem {
    unknown(tangential.name(), "frictionless, mindlin and linear_history, whichever fits it")
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
