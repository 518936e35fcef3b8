//! What codes do differently in the contact plane, as typed options, and the sets of the codes.
//!
//! | code | history | rotation | order | cap | arms of pairs: slip, torque | of walls |
//! |---|---|---|---|---|---|---|
//! | plain | rescaled force | rigid | rotate first | total | R - d/2, R - d/2 | R - d/2, R - d/2 |
//! | LIGGGHTS | displacement | projection | increment first | elastic | R - d/2, R - d/2 | R - d/2, R - d/2 |
//! | YADE | force | small angles | rotate first | elastic | R - d/2, R - d/2 | R - d, R - d (`Wall`) |
//! | LAMMPS | displacement or force | `projection_rescaled` | rotate first | `total_when_stretched` | R, R - d/2 | R, R |

use serde::{Deserialize, Serialize};

use crate::laws::rotation::Rotation;
use crate::laws::slider::{Cap, History, Increment, Order};

/// A lever arm from a centre to the contact; d is the overlap, R the radius.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Arm {
    /// R - d/2.
    MidOverlap,
    /// R.
    Radius,
    /// R - d: to the surface of the other body.
    Surface,
}

impl Arm {
    /// Length [m] for a `radius` and an `overlap` [m].
    #[must_use]
    #[inline(always)]
    pub fn length(self, radius: f64, overlap: f64) -> f64 {
        match self {
            Self::MidOverlap => radius - 0.5 * overlap,
            Self::Radius => radius,
            Self::Surface => radius - overlap,
        }
    }
}

/// The arms of a kind of contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ArmRule {
    /// In the slip velocity.
    pub slip: Arm,
    /// In the torque; angular momentum of a pair is kept with `mid_overlap` only.
    pub torque: Arm,
}

/// What the coefficient of friction multiplies. `F_n` is the total normal force, `F_po` the pull-off force.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Friction {
    /// `abs(F_n)`.
    Total,
    /// The same without the attraction of adhesion (plain; LIGGGHTS unless `tangential_reduce`).
    WithoutAdhesion,
    /// `F_po` + `abs(F_n)` (YADE with `includeAdhesion`).
    PullOffAdded,
    /// `abs(F_ne + 2 F_po)` with the elastic part `F_ne` (LAMMPS, `dmt` and `jkr`).
    TwicePullOff,
}

/// How the dashpot constant g is formed; k is the tangential stiffness.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Dashpot {
    /// g = 2 sqrt(5/6) beta sqrt(k m*), which keeps restitution independent of speed for k that grows as the contact
    /// radius.
    CriticalShare,
    /// g = ratio times the normal dashpot constant (LAMMPS: `xgammat`).
    NormalShare {
        /// Ratio [-].
        ratio: f64,
    },
    /// g itself.
    Constant {
        /// Dashpot constant [kg/s].
        value: f64,
    },
}

/// Where a law takes the rule of its dashpot from.
pub trait DashpotRule: Copy + Send + Sync {
    /// Whether the rule is known when compiled.
    const FIXED: bool;

    /// The rule.
    fn rule(&self) -> Dashpot;
}

impl DashpotRule for Dashpot {
    const FIXED: bool = false;

    #[inline(always)]
    fn rule(&self) -> Dashpot {
        *self
    }
}

/// [`Dashpot::CriticalShare`], fixed when compiled.
#[derive(Clone, Copy, Debug, Default)]
pub struct CriticalShare;

impl DashpotRule for CriticalShare {
    const FIXED: bool = true;

    #[inline(always)]
    fn rule(&self) -> Dashpot {
        Dashpot::CriticalShare
    }
}

/// All options of a tangential spring.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Options {
    /// What the contact remembers.
    pub history: History,
    /// How that turns with the contact.
    pub rotation: Rotation,
    /// What comes first.
    pub order: Order,
    /// The stiffness of an increment of force.
    pub increment: Increment,
    /// What the limit holds.
    pub cap: Cap,
    /// What the coefficient of friction multiplies.
    pub friction: Friction,
    /// Arms between particles.
    pub pair_arms: ArmRule,
    /// Arms at bodies.
    pub wall_arms: ArmRule,
}

impl Options {
    /// LIGGGHTS: `tangential history`.
    #[must_use]
    pub const fn liggghts() -> Self {
        Self {
            history: History::Displacement,
            rotation: Rotation::Projection,
            order: Order::IncrementFirst,
            increment: Increment::Present,
            cap: Cap::Elastic,
            ..Self::plain()
        }
    }

    /// YADE: `Law2_ScGeom_MindlinPhys_Mindlin` and the linear law, at `Wall` bodies; `wall_arms` of a `Facet` are those
    /// of pairs.
    #[must_use]
    pub const fn yade() -> Self {
        Self {
            history: History::Force,
            rotation: Rotation::SmallAngles,
            increment: Increment::Present,
            cap: Cap::Elastic,
            friction: Friction::Total,
            wall_arms: ArmRule { slip: Arm::Surface, torque: Arm::Surface },
            ..Self::plain()
        }
    }

    /// LAMMPS: `mindlin` and `linear_history` with a displacement, `mindlin/force` with a force.
    #[must_use]
    pub const fn lammps(history: History) -> Self {
        Self {
            history,
            rotation: Rotation::ProjectionRescaled,
            increment: Increment::Present,
            cap: Cap::TotalWhenStretched,
            friction: Friction::Total,
            pair_arms: ArmRule { slip: Arm::Radius, torque: Arm::MidOverlap },
            wall_arms: ArmRule { slip: Arm::Radius, torque: Arm::Radius },
            ..Self::plain()
        }
    }
}

/// Where a law takes its options from: a type that returns a constant is compiled for it.
pub trait Choices: Copy + Send + Sync {
    /// Whether the options are known when compiled.
    const FIXED: bool = false;

    /// The options.
    fn options(&self) -> Options;
}

impl Choices for Options {
    #[inline(always)]
    fn options(&self) -> Options {
        *self
    }
}

/// The options of the native code, fixed when compiled.
#[derive(Clone, Copy, Debug, Default)]
pub struct Plain;

impl Choices for Plain {
    const FIXED: bool = true;

    #[inline(always)]
    fn options(&self) -> Options {
        Options::plain()
    }
}
