//! The parts of a rolling spring: stiffness, dashpot, limit, and twisting beside it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::case::quantity::{Length, Number};

/// Stiffness of a rolling spring.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum RollingStiffness {
    /// Tangential stiffness times R*^2.
    Tangential {},
    /// The same for all contacts.
    Constant {
        /// Stiffness [N m].
        value: Number,
    },
    /// A stiffness of the rolling displacement times R*^2.
    PerRadiusSquared {
        /// Stiffness of the rolling displacement [N/m].
        value: Number,
    },
    /// A share of the secant normal stiffness times the squares of R* and of the coefficient of rolling friction.
    Normal {
        /// Factor [-].
        value: Number,
    },
}

/// Dashpot of a rolling spring.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum RollingDashpot {
    /// None.
    None {},
    /// A share of critical damping.
    CriticalShare {
        /// Share [-].
        value: Number,
    },
    /// A constant of the rolling velocity times R*^2.
    PerRadiusSquared {
        /// Dashpot constant of the rolling velocity [kg/s].
        value: Number,
    },
}

/// Largest rolling moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RollingLimit {
    /// Coefficient of rolling friction times normal force times R*.
    EffectiveRadius,
    /// None.
    Unlimited,
}

/// Twisting resistance beside a rolling spring.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Twisting {
    /// None.
    None {},
    /// In one spring with rolling, under one cap.
    Joint {},
    /// Of the contact spot: half its tangential stiffness times its radius squared.
    Spot {},
    /// Constants.
    Constant {
        /// Stiffness [N m].
        stiffness: Number,
        /// Dashpot constant [N m s].
        dashpot: Number,
        /// Length that makes a moment of twisting friction [m]; none is no cap.
        arm: Option<Length>,
    },
}
