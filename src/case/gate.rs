//! The gates of a case: what is compared with what, and how far it may differ.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::quantity::Number;

/// One comparison of one quantity.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Gate {
    /// Name of an observable: one of the case, or one that every record has.
    pub quantity: String,
    /// What is compared with what.
    pub check: Check,
    /// Name of the closed form in `reference/analytic`, for the checks `reference`, `finest`,
    /// `extrapolated` and `matched`.
    pub reference: Option<String>,
    /// How the difference is made a number.
    pub scale: Scale,
    /// Largest difference that agrees [in units of the scale].
    pub bound: Number,
    /// Where the bound comes from.
    pub bound_source: String,
    /// Interval of the order of convergence, for `check = "convergence"`.
    pub order: Option<[Number; 2]>,
    /// Two codes that have no law in common, each at its own point of a sweep, for `check = "matched"`.
    pub matched: Option<Matched>,
    /// Whether it is judged only at points that only the full form of a suite runs: ensembles too small to decide it.
    #[serde(default)]
    pub full_only: bool,
}

/// Two codes under different laws that are made alike by a closed form.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Matched {
    /// One of them.
    pub left: MatchedSide,
    /// The other.
    pub right: MatchedSide,
}

/// A code at a point of a sweep.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MatchedSide {
    /// Name of the code.
    pub code: String,
    /// Label of the point.
    pub point: String,
}

/// Kinds of comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Check {
    /// Native and every code against a closed form.
    Reference,
    /// Each code against the mirror that claims to know what it does.
    Mirror,
    /// Native at its finest time step against a closed form or an integration to high accuracy.
    Finest,
    /// Native extrapolated to a vanishing step from its finest steps, at first order, against the same.
    Extrapolated,
    /// Plain native against each code; a difference is a known one if the mirror predicts it.
    Plain,
    /// The difference of two codes against the difference of their mirrors.
    Prediction,
    /// The native engine against itself at half the time step.
    Convergence,
    /// Time until which each code and its mirror compute the same trajectory: at least the bound [s].
    Horizon,
    /// Equivalence of ensemble means within the bound: native with each code.
    Equivalence,
    /// Equivalence of the ensemble means of an observable over the whole run: native with each code.
    EquivalenceCurve,
    /// Equivalence of the ensemble means of two codes under different laws that a closed form makes alike.
    Matched,
    /// Every seed of every source has at least the bound.
    AtLeast,
    /// Every seed of every source has at most the bound.
    AtMost,
}

impl Check {
    /// Whether it judges an ensemble by an observable of the case.
    #[must_use]
    pub fn of_ensemble(self) -> bool {
        matches!(self, Self::Equivalence | Self::EquivalenceCurve | Self::Matched | Self::AtLeast | Self::AtMost)
    }
}

/// How a difference is made a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Scale {
    /// Divided by the magnitude of the right side [-].
    Relative,
    /// As it is, in the unit of the quantity.
    Absolute,
    /// Divided by the largest magnitude of the series on the right [-].
    Peak,
    /// Divided by the range of the series on the right [-].
    Range,
}
