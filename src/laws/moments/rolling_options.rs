//! What codes do differently in rolling. Symbols and equations: [`super::elastic_plastic_rolling`].

use serde::{Deserialize, Serialize};

/// Rolling stiffness.
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

/// Largest moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Limit {
    /// `mu_r` abs(`F_n`) R*.
    EffectiveRadius,
    /// `mu_r` abs(`F_n`) (Ri + Rj) / 2.
    MeanRadius,
    /// `mu_r` abs(`F_n`) R* where `F_n` is not zero, none where it is (YADE, whose normal force is cut at zero).
    WhilePressed,
    /// None.
    Unlimited,
}

/// Rolling dashpot.
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
