//! Engine options that reproduce another code, by the names of the options of the laws.

use serde::{Deserialize, Serialize};

macro_rules! names {
    ($($(#[$doc:meta])* $name:ident { $($(#[$variant_doc:meta])* $variant:ident,)* })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(rename_all = "snake_case")]
        pub enum $name { $($(#[$variant_doc])* $variant,)* }
    )*};
}

/// Engine options that reproduce another code; the plain engine uses [`Mirror::default`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mirror {
    /// A plane acts like a sphere whose radius is this multiple of the particle's.
    pub plane_radius_factor: Option<f64>,
    /// Where velocities start.
    pub start: Start,
    /// How the tangential spring works.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tangential: Option<TangentialOptions>,
    /// How the rolling spring works.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rolling: Option<RollingOptions>,
    /// How the twisting spring works.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub twisting: Option<TwistingOptions>,
    /// What a constant torque opposes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub opposed: Option<Opposed>,
    /// How far the dashpot of an adhesive law may pull.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dashpot_limit: Option<DashpotLimit>,
    /// How the largest overlap of a hysteretic law follows the limit of cohesion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hysteresis: Option<Hysteresis>,
}

/// Where velocities start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Start {
    /// With the positions: velocity Verlet.
    #[default]
    Synchronized,
    /// Half a step before them: leapfrog.
    Staggered,
}

names! {
    /// What a spring remembers.
    Memory {
        /// The displacement.
        Displacement,
        /// The force, from increments.
        Force,
        /// The force, rescaled when the stiffness falls.
        ForceRescaled,
    }
    /// How a remembered vector turns with the contact.
    Rotation {
        /// Exactly.
        Rigid,
        /// The part along the normal is dropped.
        Projection,
        /// The same, with the length restored.
        ProjectionRescaled,
        /// Two cross products.
        SmallAngles,
        /// Not at all.
        Fixed,
    }
    /// What comes first in a step.
    Order {
        /// The old value turns, then grows.
        RotateFirst,
        /// The value grows, then turns.
        IncrementFirst,
    }
    /// The stiffness of an increment of force.
    Increment {
        /// That at the end of the step.
        Present,
        /// The mean over the step while it grows.
        Mean,
    }
    /// What a limit holds.
    Cap {
        /// Elastic and damping parts together.
        Total,
        /// The elastic part.
        Elastic,
        /// Both together, directed against the rate.
        TotalAlongRate,
    }
    /// What the coefficient of friction multiplies.
    Friction {
        /// The total normal force.
        Total,
        /// The same without the attraction of adhesion.
        WithoutAdhesion,
        /// The pull-off force and the total normal force.
        PullOffAdded,
        /// The elastic normal force and twice the pull-off force.
        TwicePullOff,
    }
    /// A lever arm.
    Arm {
        /// R - d/2.
        MidOverlap,
        /// R.
        Radius,
        /// R - d.
        Surface,
    }
    /// Largest rolling moment.
    Limit {
        /// With R*.
        EffectiveRadius,
        /// With (Ri + Rj) / 2.
        MeanRadius,
        /// None.
        Unlimited,
    }
    /// What a constant torque opposes.
    Opposed {
        /// Rolling, at full size.
        Rolling,
        /// The whole spin, of whose torque the part along the normal is dropped.
        RollingShare,
        /// The whole spin.
        WholeSpin,
    }
    /// How far a dashpot may pull beside an adhesion.
    DashpotLimit {
        /// As the base law says.
        Base,
        /// At most as hard as the adhesion, where the total attracts.
        PullOff,
    }
    /// Rules of the largest overlap on the limit of cohesion.
    Hysteresis {
        /// The branch through the present point.
        SelfConsistent,
        /// The branch of the old stiffness.
        OldStiffness,
        /// That of YADE.
        LudingPm,
    }
}

/// The arms of a kind of contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Arms {
    /// In the slip velocity.
    pub slip: Arm,
    /// In the torque.
    pub torque: Arm,
}

/// Options of a tangential spring.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TangentialOptions {
    /// What it remembers.
    pub history: Memory,
    /// How that turns.
    pub rotation: Rotation,
    /// What comes first.
    pub order: Order,
    /// The stiffness of an increment.
    pub increment: Increment,
    /// What the limit holds.
    pub cap: Cap,
    /// What the coefficient of friction multiplies.
    pub friction: Friction,
    /// Arms between particles.
    pub pair_arms: Arms,
    /// Arms at bodies.
    pub wall_arms: Arms,
}

/// Stiffness of a rolling spring.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Stiffness {
    /// kt R*^2.
    Tangential,
    /// The same for all contacts.
    Constant {
        /// Stiffness [N m].
        value: f64,
    },
    /// value R*^2.
    PerRadiusSquared {
        /// Stiffness of the rolling displacement [N/m].
        value: f64,
    },
    /// factor kn `mu_r`^2 R*^2.
    Normal {
        /// Factor [-].
        factor: f64,
    },
}

/// Dashpot of a rolling spring.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Dashpot {
    /// None.
    None,
    /// A share of critical damping.
    CriticalShare {
        /// Share [-].
        value: f64,
    },
    /// value R*^2.
    PerRadiusSquared {
        /// Constant of the rolling velocity [kg/s].
        value: f64,
    },
}

/// Options of a rolling spring.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RollingOptions {
    /// Stiffness.
    pub stiffness: Stiffness,
    /// Largest moment.
    pub limit: Limit,
    /// Dashpot.
    pub dashpot: Dashpot,
    /// What it remembers.
    pub history: Memory,
    /// How that turns.
    pub rotation: Rotation,
    /// What the limit holds.
    pub cap: Cap,
    /// Whether the part of the spin along the normal is resisted by the same spring.
    pub torsion: bool,
    /// Whether the spin at a wall is stretched.
    pub stretched_at_walls: bool,
}

/// Stiffness, dashpot and cap of a twisting spring.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum TwistingSpring {
    /// Of the contact spot.
    Spot,
    /// Constants.
    Constant {
        /// Stiffness [N m].
        stiffness: f64,
        /// Dashpot constant [N m s].
        dashpot: f64,
        /// Length that makes a moment of friction [m]; none is no cap.
        arm: Option<f64>,
    },
}

/// Options of a twisting spring.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TwistingOptions {
    /// Stiffness, dashpot and cap.
    pub spring: TwistingSpring,
    /// What it remembers.
    pub history: Memory,
    /// How that turns.
    pub rotation: Rotation,
    /// What the limit holds.
    pub cap: Cap,
}
