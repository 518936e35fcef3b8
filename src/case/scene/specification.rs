//! The laws of a scene, with the options of its mirror, as the registry of the laws builds them.

use super::{Mirror, SceneModel};
use crate::case::model::{
    Cooling as CaseCooling, History as Remembered, HotFriction, MomentLaw, NormalLaw, RollingDashpot, RollingLimit,
    RollingStiffness, Sliding as CaseSliding, TangentialLaw, Twisting as CaseTwisting,
};
use crate::case::tag;
use crate::error::Problem;
use crate::laws::moments::any::{Moments, Rolling};
use crate::laws::moments::constant_torque::Opposed;
use crate::laws::moments::elastic_plastic_rolling::{Dashpot as Damper, ElasticPlasticRolling, Limit, Stiffness};
use crate::laws::moments::twisting::{Spring, Twisting};
use crate::laws::normal::cohesive::DashpotLimit;
use crate::laws::normal::hysteretic_branches::Rule;
use crate::laws::normal::luding_sintering::{Cooling, LudingSintering, Sliding};
use crate::laws::registry::{Normal, Specification, Tangential};
use crate::laws::slider::History;
use crate::laws::tangential::luding_sintering::LudingSintering as SinteringFriction;
use crate::laws::tangential::options::{Dashpot, Options};

impl SceneModel {
    /// The sliding rule, which the tangential law of sintering states and the normal law follows.
    fn sliding(&self) -> Sliding {
        match &self.tangential {
            TangentialLaw::LudingSintering { sliding: CaseSliding::Cut, .. } => Sliding::Cut,
            TangentialLaw::LudingSintering { sliding: CaseSliding::Brittle, .. } => Sliding::Brittle,
            _ => Sliding::Off,
        }
    }

    /// The model that the engine runs.
    ///
    /// # Errors
    /// A law that this build does not compute, a value outside its law's range, or an option that the mirrored code does
    /// not have.
    pub fn specification(&self, mirror: &Mirror) -> Result<Specification, Problem> {
        let specification = Specification {
            normal: normal(&self.normal, self.sliding(), mirror)?,
            tangential: tangential(&self.tangential, mirror)?,
            moments: moments(&self.moments, mirror)?,
        };
        specification.check()?;
        if let Some(code) = mirror.code {
            code.check(&specification)?;
        }
        Ok(specification)
    }
}

fn normal(law: &NormalLaw, sliding: Sliding, mirror: &Mirror) -> Result<Normal, Problem> {
    Ok(match law {
        NormalLaw::Hertz { force_cut } => Normal::Hertz { force_cut: force_cut.cuts() },
        NormalLaw::Dmt { force_cut } => {
            let dashpot_limit = mirror.dashpot_limit.unwrap_or(DashpotLimit::Base);
            Normal::Dmt { force_cut: force_cut.cuts(), dashpot_limit }
        }
        NormalLaw::Sjkr { energy_density, force_cut } => {
            Normal::Sjkr { force_cut: force_cut.cuts(), energy_density: energy_density.si() }
        }
        NormalLaw::Sjkr2 { energy_density, force_cut } => {
            Normal::Sjkr2 { force_cut: force_cut.cuts(), energy_density: energy_density.si() }
        }
        NormalLaw::LinearSpringDashpot { stiffness, dashpot, force_cut } => Normal::LinearSpringDashpot {
            stiffness: stiffness.si(),
            dashpot: dashpot.si(),
            force_cut: force_cut.cuts(),
        },
        NormalLaw::LudingHysteretic { k1, kp, kc, plasticity_depth, dashpot, force_cut } => Normal::LudingHysteretic {
            k1: k1.si(),
            kp: kp.si(),
            kc: kc.si(),
            plasticity_depth: plasticity_depth.get(),
            dashpot: dashpot.si(),
            force_cut: force_cut.cuts(),
            rule: mirror.hysteresis.unwrap_or(Rule::SelfConsistent),
        },
        NormalLaw::LudingSintering {
            k1,
            k2,
            kc,
            fluid_overlap,
            dashpot,
            melting_temperature,
            melting_range,
            relaxation_time,
            cooling,
        } => Normal::LudingSintering(LudingSintering {
            k1: k1.si(),
            k2: k2.si(),
            kc: kc.si(),
            fluid_overlap: fluid_overlap.si(),
            dashpot: dashpot.si(),
            melting_temperature: melting_temperature.si(),
            melting_range: melting_range.si(),
            relaxation_time: relaxation_time.si(),
            cooling: match cooling {
                CaseCooling::Lagged => Cooling::Lagged,
                CaseCooling::Implicit => Cooling::Implicit,
            },
            sliding,
        }),
        NormalLaw::Jkr {} | NormalLaw::WaltonCohesive { .. } => {
            let known = "`hertz`, `dmt`, `sjkr`, `sjkr2`, `linear_spring_dashpot`, `luding_hysteretic` and \
                         `luding_sintering`";
            return Err(unknown("model.normal.law", tag(law, "law"), known));
        }
    })
}

fn tangential(law: &TangentialLaw, mirror: &Mirror) -> Result<Tangential, Problem> {
    let options = |history: History| mirror.tangential.unwrap_or(Options { history, ..Options::plain() });
    Ok(match law {
        TangentialLaw::Frictionless {} => Tangential::Frictionless,
        TangentialLaw::Mindlin { history } => {
            let history = match history {
                Remembered::Displacement => History::Displacement,
                Remembered::Force => History::Force,
                Remembered::ForceRescaled | Remembered::Default => History::ForceRescaled,
            };
            Tangential::Mindlin { dashpot: Dashpot::CriticalShare, options: options(history) }
        }
        TangentialLaw::LinearHistory { stiffness_ratio, dashpot } => Tangential::LinearHistory {
            stiffness_ratio: stiffness_ratio.get(),
            dashpot: Dashpot::Constant { value: dashpot.si() },
            options: options(Options::plain().history),
        },
        TangentialLaw::LudingSintering { stiffness_ratio, dashpot, friction, .. } => {
            Tangential::LudingSintering(SinteringFriction {
                stiffness_ratio: stiffness_ratio.get(),
                dashpot: dashpot.si(),
                softens: *friction == HotFriction::Softens,
            })
        }
        TangentialLaw::WaltonFriction { .. } => {
            let known = "`frictionless`, `mindlin`, `linear_history` and `luding_sintering`";
            return Err(unknown("model.tangential.law", tag(law, "law"), known));
        }
    })
}

fn moments(law: &MomentLaw, mirror: &Mirror) -> Result<Moments, Problem> {
    Ok(match law {
        MomentLaw::Free {} => Moments::NONE,
        MomentLaw::ConstantTorque { torsion } => {
            let plain = if *torsion { Opposed::WholeSpin } else { Opposed::Rolling };
            let opposed = mirror.opposed.unwrap_or(plain);
            Moments { rolling: Rolling::ConstantTorque { opposed }, twisting: None }
        }
        MomentLaw::ElasticPlasticRolling { stiffness, dashpot, limit, twisting } => {
            let plain = ElasticPlasticRolling {
                stiffness: self::stiffness(stiffness),
                dashpot: damper(dashpot),
                limit: match limit {
                    RollingLimit::EffectiveRadius => Limit::EffectiveRadius,
                    RollingLimit::Unlimited => Limit::Unlimited,
                },
                torsion: *twisting == CaseTwisting::Joint {},
                ..ElasticPlasticRolling::plain()
            };
            let twisting = self::twisting(twisting).map(|plain| mirror.twisting.unwrap_or(plain));
            Moments { rolling: Rolling::ElasticPlasticRolling { spring: mirror.rolling.unwrap_or(plain) }, twisting }
        }
        MomentLaw::WaltonBendingTwisting { .. } => {
            let known = "`free`, `elastic_plastic_rolling` and `constant_torque`";
            return Err(unknown("model.moments.law", tag(law, "law"), known));
        }
    })
}

fn stiffness(stiffness: &RollingStiffness) -> Stiffness {
    match stiffness {
        RollingStiffness::Tangential {} => Stiffness::Tangential,
        RollingStiffness::Constant { value } => Stiffness::Constant { value: value.get() },
        RollingStiffness::PerRadiusSquared { value } => Stiffness::PerRadiusSquared { value: value.get() },
        RollingStiffness::Normal { value } => Stiffness::Normal { factor: value.get() },
    }
}

fn damper(dashpot: &RollingDashpot) -> Damper {
    match dashpot {
        RollingDashpot::None {} => Damper::None,
        RollingDashpot::CriticalShare { value } => Damper::CriticalShare { value: value.get() },
        RollingDashpot::PerRadiusSquared { value } => Damper::PerRadiusSquared { value: value.get() },
    }
}

fn twisting(twisting: &CaseTwisting) -> Option<Twisting> {
    let spring = match twisting {
        CaseTwisting::None {} | CaseTwisting::Joint {} => return None,
        CaseTwisting::Spot {} => Spring::Spot,
        CaseTwisting::Constant { stiffness, dashpot, arm } => Spring::Constant {
            stiffness: stiffness.get(),
            dashpot: dashpot.get(),
            arm: arm.as_ref().map(|arm| arm.si()),
        },
    };
    Some(Twisting { spring, ..Twisting::plain() })
}

fn unknown(key: &str, law: String, known: &str) -> Problem {
    Problem::new(key, law, format!("this version computes only {known}"))
}
