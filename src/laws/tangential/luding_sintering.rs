//! Tangential spring and dashpot of long-time sintering, for the normal law of the same name.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | k = ratio times the unloading stiffness K | tangential stiffness | N/m |
//! | x | spring, which turns by projection | m |
//! | g | dashpot constant | kg/s |
//! | mu | coefficient of friction, softened by heat as k1(T,t)/k1 if the law says so | - |
//!
//! Force on i: -k x - g u for a slip velocity u, as a whole at most mu times (elastic normal force + pull-off force);
//! beyond, x is what the capped force leaves of it. Arms are the radii, in slip and torque. The spring grows before it acts,
//! since positions are half a step ahead of velocities. Source: Luding, Manetsberger, Mueller, *J. Mech. Phys. Solids* 53
//! (2005) 455, equations 14 to 24. Invariants: the cap. An arm of a radius turns a pair that overlaps: its angular
//! momentum is kept up to the overlap.

use serde::{Deserialize, Serialize};

use crate::laws::rotation::Rotation;
use crate::laws::slider::{Cap, History, Increment, Memory, Order};
use crate::laws::{Contact, NormalState, TangentialLaw, TangentialState};

use super::options::{Arm, ArmRule, Friction, Options};

/// The law.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LudingSintering {
    /// Stiffness as a share of the unloading stiffness [-].
    pub stiffness_ratio: f64,
    /// Dashpot constant [kg/s].
    pub dashpot: f64,
    /// Whether heat softens friction.
    pub softens: bool,
}

const ARMS: ArmRule = ArmRule { slip: Arm::Radius, torque: Arm::Radius };

const OPTIONS: Options = Options {
    history: History::Displacement,
    rotation: Rotation::Projection,
    order: Order::RotateFirst,
    increment: Increment::Present,
    cap: Cap::Total,
    friction: Friction::WithoutAdhesion,
    pair_arms: ARMS,
    wall_arms: ARMS,
};

impl TangentialLaw for LudingSintering {
    type History = Memory;
    const BATCHED: bool = true;

    #[inline(always)]
    fn evaluate(&self, contact: &Contact, normal: &NormalState, dt: f64, history: &mut Memory) -> TangentialState {
        let stiffness = self.stiffness_ratio * normal.tangent_stiffness;
        let friction_share = if self.softens { normal.friction_share } else { 1.0 };
        let normal = NormalState { friction_share, ..*normal };
        super::spring(contact, &normal, &OPTIONS, [stiffness, self.dashpot], dt, history)
    }
}
