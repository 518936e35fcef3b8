//! The contact model of a case: a normal, a tangential and a moment law, and the values that they ask of each pair.
//!
//! The schema names every law that a case may ask for; [`crate::laws`] holds those that this build computes, and
//! preparing a scene refuses the others by name.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::quantity::{Dashpot, Force, Length, Number, Stiffness, SurfaceEnergy, Temperature};

/// The composed contact model.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Model {
    /// Force along the normal.
    pub normal: NormalLaw,
    /// Force in the contact plane.
    pub tangential: TangentialLaw,
    /// Moments.
    pub moments: MomentLaw,
    /// Exchange of heat.
    pub heat: Option<HeatLaw>,
}

/// Normal laws.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "law", rename_all = "snake_case", deny_unknown_fields)]
pub enum NormalLaw {
    /// Hertz with the dashpot of constant restitution (Tsuji, Tanaka, Ishida 1992).
    Hertz {
        /// Whether the total force is cut at zero.
        force_cut: ForceCut,
    },
    /// Johnson, Kendall, Roberts (1971).
    Jkr,
    /// Derjaguin, Muller, Toporov (1975).
    Dmt,
    /// Linear spring and dashpot.
    LinearSpringDashpot {
        /// Stiffness [N/m].
        stiffness: Stiffness,
        /// Dashpot constant [kg/s].
        dashpot: Dashpot,
        /// Whether the total force is cut at zero.
        force_cut: ForceCut,
    },
    /// Long-time sintering (Luding, Manetsberger, Mueller 2005).
    LudingSintering {
        /// Loading stiffness when cold [N/m].
        k1: Stiffness,
        /// Largest unloading stiffness [N/m].
        k2: Stiffness,
        /// Cohesive stiffness [N/m].
        kc: Stiffness,
        /// Fluid overlap [m].
        fluid_overlap: Length,
        /// Normal dashpot [kg/s].
        dashpot: Dashpot,
        /// Melting temperature [K].
        melting_temperature: Temperature,
        /// Width of the melting range [K].
        melting_range: Temperature,
        /// How the largest overlap follows a stiffening contact.
        cooling: Cooling,
    },
    /// Linearised plastic-cohesive contact (Walton).
    WaltonCohesive {
        /// Pull-off force [N].
        pull_off: Force,
        /// Build-up of the pull-off force with load [-].
        build_up: Number,
        /// Softening of the loading stiffness [-].
        soften: Number,
        /// Ratio of unloading and loading stiffness [-].
        stiffness_ratio: Number,
    },
}

/// Rules of the total normal force at zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ForceCut {
    /// Cut at zero: a dashpot never pulls.
    On,
    /// Not cut: the dashpot may pull at the end of an impact.
    Off,
    /// What each code does when nothing is said; natively `on`.
    Default,
}

/// Cooling rules of the sintering law.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Cooling {
    /// The stiffness of the last step stands in the rule.
    Lagged,
    /// The plastic offset is strictly constant.
    Implicit,
}

/// Tangential laws.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "law", rename_all = "snake_case", deny_unknown_fields)]
pub enum TangentialLaw {
    /// No tangential force.
    Frictionless,
    /// No-slip Mindlin stiffness with a Coulomb cap.
    Mindlin {
        /// What the contact remembers.
        history: History,
    },
    /// Linear spring and dashpot with a Coulomb cap.
    LinearHistory {
        /// Stiffness as a share of the normal stiffness [-].
        stiffness_ratio: Number,
        /// Dashpot constant [kg/s].
        dashpot: Dashpot,
    },
}

/// What a tangential contact remembers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum History {
    /// The tangential displacement.
    Displacement,
    /// The tangential force, from increments.
    Force,
    /// The tangential force, rescaled when the contact unloads (Thornton, Cummins, Cleary 2011).
    ForceRescaled,
}

/// Moment laws.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "law", rename_all = "snake_case", deny_unknown_fields)]
pub enum MomentLaw {
    /// No moments.
    Free,
    /// Elastic-plastic rolling spring.
    ElasticPlasticRolling,
    /// Rolling torque of constant size.
    ConstantTorque,
    /// Bending and twisting of plastic-cohesive contacts (Walton).
    WaltonBendingTwisting {
        /// Widening of the bending arm [-].
        widen: Number,
        /// Ratio of the largest twisting and bending moment [-].
        twist: Number,
    },
}

/// Laws of heat exchange.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "law", rename_all = "snake_case", deny_unknown_fields)]
pub enum HeatLaw {
    /// Conduction through contact spots (Batchelor, O'Brien 1977).
    BatchelorOBrien,
    /// Conduction through contact spots and radiation between neighbours.
    ConductionAndRadiation {
        /// Emissivity [-].
        emissivity: Number,
    },
}

/// Values of a pair; a law that needs one which is absent refuses the case.
#[derive(Clone, Debug, PartialEq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PairValues {
    /// Dissipation along the normal, for Hertz.
    pub damping: Option<Damping>,
    /// Coefficient of friction [-].
    pub friction: Option<Number>,
    /// Coefficient of rolling friction [-].
    pub rolling_friction: Option<Number>,
    /// Coefficient of twisting friction [-].
    pub twisting_friction: Option<Number>,
    /// Work of adhesion W = 2 gamma for like solids [J/m2].
    pub work_of_adhesion: Option<SurfaceEnergy>,
}

/// Dissipation along the normal.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Damping {
    /// None.
    None,
    /// The dashpot that gives this restitution when the force is not cut; 0 is critical damping.
    Restitution {
        /// Restitution in [0, 1] [-].
        value: Number,
    },
    /// The dashpot itself, as a fraction of critical damping.
    Ratio {
        /// Fraction of critical damping, not negative [-].
        value: Number,
    },
}
