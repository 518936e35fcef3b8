//! Rolling and twisting laws chosen when a run starts. The choice is the same for all contacts, so that its branches cost
//! little beside the laws.

use serde::{Deserialize, Serialize};

use crate::error::Problem;
use crate::laws::registry::within;
use crate::laws::slider::Memory;
use crate::laws::{Contact, MomentLaw, MomentState, NormalState, TangentialState, model::Free};

use super::constant_torque::{ConstantTorque, Opposed};
use super::elastic_plastic_rolling::{ElasticPlasticRolling, Limit, Stiffness};
use super::twisting::{Spring, Twisting};

/// A rolling law.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "law", rename_all = "snake_case", deny_unknown_fields)]
pub enum Rolling {
    /// No resistance.
    Free,
    /// A torque of constant size.
    ConstantTorque {
        /// What it opposes.
        opposed: Opposed,
    },
    /// An elastic-plastic spring.
    ElasticPlasticRolling {
        /// The law.
        spring: ElasticPlasticRolling,
    },
}

impl Rolling {
    /// Whether the moment is limited by a coefficient of the pair.
    #[must_use]
    pub fn capped(&self) -> bool {
        match self {
            Self::Free => false,
            Self::ConstantTorque { .. } => true,
            Self::ElasticPlasticRolling { spring } => spring.limit != Limit::Unlimited,
        }
    }
}

/// Rolling and twisting.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Moments {
    /// Resistance to rolling.
    pub rolling: Rolling,
    /// Resistance to twisting, if any.
    pub twisting: Option<Twisting>,
}

impl Moments {
    /// No moments.
    pub const NONE: Self = Self { rolling: Rolling::Free, twisting: None };

    /// Refuses values outside the laws' ranges.
    ///
    /// # Errors
    /// The first such value: key, value, range.
    pub fn check(&self) -> Result<(), Problem> {
        if let Rolling::ElasticPlasticRolling { spring } = &self.rolling {
            let key = "model.moments.rolling.stiffness";
            match spring.stiffness {
                Stiffness::Tangential => {}
                Stiffness::Constant { value }
                | Stiffness::PerRadiusSquared { value }
                | Stiffness::Normal { factor: value } => {
                    let capped = self.rolling.capped();
                    within(key, value, value > 0.0 || value == 0.0 && !capped, "above 0 where the moment is capped")?;
                }
            }
        }
        if let Some(Twisting { spring: Spring::Constant { stiffness, dashpot, .. }, .. }) = self.twisting {
            within("model.moments.twisting.stiffness", stiffness, stiffness > 0.0, "above 0 N m")?;
            within("model.moments.twisting.dashpot", dashpot, dashpot >= 0.0, "at least 0 N m s")?;
        }
        Ok(())
    }
}

impl MomentLaw for Moments {
    type History = (Memory, Memory);

    #[inline]
    fn evaluate(
        &self,
        contact: &Contact,
        normal: &NormalState,
        tangential: &TangentialState,
        dt: f64,
        history: &mut Self::History,
    ) -> MomentState {
        let rolling = match &self.rolling {
            Rolling::Free => Free.evaluate(contact, normal, tangential, dt, &mut ()),
            Rolling::ConstantTorque { opposed } => {
                ConstantTorque { opposed: *opposed }.evaluate(contact, normal, tangential, dt, &mut ())
            }
            Rolling::ElasticPlasticRolling { spring } => {
                spring.evaluate(contact, normal, tangential, dt, &mut history.0)
            }
        };
        let Some(twisting) = &self.twisting else { return rolling };
        let twist = twisting.evaluate(contact, normal, tangential, dt, &mut history.1);
        MomentState {
            moment: rolling.moment + twist.moment,
            energy: rolling.energy + twist.energy,
            losses: rolling.losses + twist.losses,
        }
    }
}
