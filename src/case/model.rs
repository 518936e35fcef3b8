//! The contact model of a case: a normal, a tangential and a moment law, and the values that they ask of each pair.
//!
//! The schema names every law that a case may ask for; [`crate::laws`] holds those that this build computes, and
//! preparing a scene refuses the others by name. Variants without values have braces: serde refuses unknown keys only there.

mod rolling;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use rolling::{RollingDashpot, RollingLimit, RollingStiffness, Twisting};

use super::quantity::{Dashpot, Duration, Force, Length, Number, Pressure, Stiffness, SurfaceEnergy, Temperature};

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
    /// Johnson, Kendall, Roberts (1971); its values are those of the pair.
    Jkr {},
    /// Derjaguin, Muller, Toporov (1975); its values are those of the pair.
    Dmt {
        /// Whether the force of Hertz and dashpot together is cut at zero.
        force_cut: ForceCut,
    },
    /// Hertz with an attraction in proportion to the area in which the undeformed spheres overlap.
    Sjkr {
        /// Cohesion energy density [J/m3 = Pa].
        energy_density: Pressure,
        /// Whether the force without the attraction is cut at zero.
        force_cut: ForceCut,
    },
    /// Hertz with an attraction in proportion to an area linear in the overlap.
    Sjkr2 {
        /// Cohesion energy density [J/m3 = Pa].
        energy_density: Pressure,
        /// Whether the force without the attraction is cut at zero.
        force_cut: ForceCut,
    },
    /// Hysteretic linear contact with a limit of cohesion (Luding 2008).
    LudingHysteretic {
        /// Loading stiffness [N/m].
        k1: Stiffness,
        /// Largest unloading stiffness, above `k1` [N/m].
        kp: Stiffness,
        /// Cohesive stiffness [N/m].
        kc: Stiffness,
        /// Plasticity depth: overlap over 2 R* at which the unloading stiffness stops growing [-].
        plasticity_depth: Number,
        /// Dashpot constant [kg/s].
        dashpot: Dashpot,
        /// Whether the dashpot may not pull beyond the elastic force.
        force_cut: ForceCut,
    },
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
        /// Relaxation time of the loading stiffness until a stage sets another one [s].
        relaxation_time: Duration,
        /// How the largest overlap follows a stiffening contact.
        cooling: Cooling,
    },
    /// Linearised plastic-cohesive contact (Walton); its loading stiffness follows from the yield strength.
    WaltonCohesive {
        /// Pull-off force of a contact that was never loaded [N].
        pull_off: Force,
        /// Build-up of the pull-off force with the largest load, in [0, 1) [-].
        build_up: Number,
        /// Softening of the loading stiffness, in (0, 1] [-].
        soften: Number,
        /// How it unloads.
        unloading: Unloading,
        /// Attraction beyond the plastic offset.
        tail: Tail,
        /// Dashpot on the unloading branch, as a fraction of critical damping [-].
        damping_ratio: Number,
    },
}

/// Unloading of a plastic contact.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Unloading {
    /// Along a constant multiple of the loading stiffness.
    ConstantRatio {
        /// Unloading stiffness over loading stiffness, at least 1 [-].
        value: Number,
    },
    /// Along the initial slope of Hertz at the largest load, with twice the effective radius.
    Hertz {},
}

/// Attraction of a plastic-cohesive contact beyond its plastic offset.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Tail {
    /// None.
    None {},
    /// Falls linearly to zero.
    Linear {
        /// Length over which it falls [m].
        length: Length,
        /// Whether it acts on surfaces that have not touched yet.
        on_approach: bool,
    },
    /// Van der Waals attraction, whose closest distance is 0.4 nm.
    VanDerWaals {
        /// Gap at which it is cut off [m].
        cut_off: Length,
        /// Whether it acts on surfaces that have not touched yet.
        on_approach: bool,
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
    Frictionless {},
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
    /// Spring, dashpot and cap of long-time sintering, for the normal law of the same name.
    LudingSintering {
        /// Stiffness as a share of the unloading stiffness [-].
        stiffness_ratio: Number,
        /// Dashpot constant [kg/s].
        dashpot: Dashpot,
        /// What heat does to friction.
        friction: HotFriction,
        /// What sliding does to cohesion.
        sliding: Sliding,
    },
    /// Spring with a cap on the repulsive part of the normal force (Walton), for the normal law `walton_cohesive`.
    WaltonFriction {
        /// Stiffness as a share of the loading stiffness [-].
        stiffness_ratio: Number,
        /// Whether the stiffness grows with the contact area.
        area_scaled: bool,
        /// Dashpot while it sticks, as a fraction of critical damping [-].
        damping_ratio: Number,
    },
}

/// What heat does to the friction of sintering contacts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum HotFriction {
    /// The coefficient softens like the loading stiffness.
    Softens,
    /// The coefficient is that of the pair at every temperature.
    Constant,
}

/// What sliding does to the cohesion of sintering contacts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Sliding {
    /// Nothing.
    Off,
    /// A sliding contact does not pull: its normal force is cut at zero.
    Cut,
    /// A sliding contact has no cohesive stiffness, and loses its largest overlap accordingly.
    Brittle,
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
    /// What each code remembers by itself; natively the rescaled force.
    Default,
}

/// Moment laws.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "law", rename_all = "snake_case", deny_unknown_fields)]
pub enum MomentLaw {
    /// No moments.
    Free {},
    /// Elastic-plastic rolling spring.
    ElasticPlasticRolling {
        /// Stiffness.
        stiffness: RollingStiffness,
        /// Dashpot.
        dashpot: RollingDashpot,
        /// Largest moment.
        limit: RollingLimit,
        /// Twisting about the normal.
        twisting: Twisting,
    },
    /// Rolling torque of constant size.
    ConstantTorque {
        /// Whether it opposes the whole relative spin, or only its part across the normal.
        torsion: bool,
    },
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
    BatchelorOBrien {},
    /// Conduction through contact spots and radiation between neighbours.
    ConductionAndRadiation {
        /// Emissivity, in (0, 1] [-].
        emissivity: Number,
        /// Largest distance of the centres of two particles that see each other [diameters].
        reach: Number,
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
    /// Whether the contact may pull, for laws whose cohesion is a value of the model.
    pub cohesive: Option<bool>,
}

impl PairValues {
    /// Takes the values that `new` states; what it does not state stays.
    pub fn update(&mut self, new: &Self) {
        fn take<T: Clone>(into: &mut Option<T>, from: Option<&T>) {
            if let Some(value) = from {
                *into = Some(value.clone());
            }
        }
        let Self { damping, friction, rolling_friction, twisting_friction, work_of_adhesion, cohesive } = new;
        take(&mut self.damping, damping.as_ref());
        take(&mut self.friction, friction.as_ref());
        take(&mut self.rolling_friction, rolling_friction.as_ref());
        take(&mut self.twisting_friction, twisting_friction.as_ref());
        take(&mut self.work_of_adhesion, work_of_adhesion.as_ref());
        take(&mut self.cohesive, cohesive.as_ref());
    }
}

/// Dissipation along the normal.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Damping {
    /// None.
    None {},
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
