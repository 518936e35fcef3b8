//! What a case measures in its stages: bulk observables with their regions and time windows.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::quantity::{Length, Number};

/// One number of one stage.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Observable {
    /// Name, for gates.
    pub name: String,
    /// What is measured.
    pub measure: Measure,
    /// Name of the stage.
    pub stage: String,
    /// Last share of the stage over which it is averaged, in [0, 1]; 0 is the end of the stage [-].
    pub average: Number,
    /// Name of the observable before this one whose value is subtracted; none if absent.
    pub minus: Option<String>,
}

/// What is measured.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Measure {
    /// Volume of the particles inside a region over its volume; areas for disks [-].
    PackingFraction {
        /// Region.
        region: Region,
        /// Which radii count.
        radii: Radii,
    },
    /// Contacts per particle, walls not counted [-].
    Coordination {
        /// Region of the centres.
        region: Region,
    },
    /// Force of the particles on a body [N].
    WallForce {
        /// Name of the body.
        body: String,
        /// Direction, away from the particles; any length but zero [-].
        direction: [Number; 3],
    },
    /// That force over the area of the body inside the domain [Pa].
    WallStress {
        /// Name of the body.
        body: String,
        /// Direction, away from the particles; any length but zero [-].
        direction: [Number; 3],
    },
    /// That force over the length of the body between two others, for disks [N/m].
    WallLineStress {
        /// Name of the body.
        body: String,
        /// Direction, away from the particles; any length but zero [-].
        direction: [Number; 3],
        /// Names of the bodies that bound the length.
        between: [String; 2],
    },
    /// Distance of two parallel planes [m].
    Distance {
        /// Names of the two bodies.
        between: [String; 2],
    },
    /// Normal forces of particle contacts without their viscous part.
    NormalForces {
        /// Which number of their distribution.
        statistic: Statistic,
    },
    /// Overlaps over the sum of the radii [-].
    Overlaps {
        /// Which number of their distribution.
        statistic: Statistic,
    },
    /// Particles in the largest fragment over all particles, a fragment being what contacts hold together [-].
    LargestFragment {},
    /// Mean temperature of the particles [K].
    Temperature {
        /// Region of the centres.
        region: Region,
    },
    /// Heat that a body gives to the particles [W].
    HeatFlow {
        /// Name of the body.
        body: String,
    },
}

/// A part of space.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Region {
    /// What the bodies and the domain enclose.
    Everything {},
    /// A box that stays where it is.
    Box {
        /// Lower corner [m].
        min: [Length; 3],
        /// Upper corner [m].
        max: [Length; 3],
    },
    /// The bed between a height above its floor and a depth below its surface, under which 97 % of the centres lie.
    Bed {
        /// Name of the floor.
        floor: String,
        /// Height above the floor [m].
        above_floor: Length,
        /// Depth below the surface [m].
        below_surface: Length,
    },
}

/// Which radii count where they change with temperature.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Radii {
    /// Those of the moment.
    Present,
    /// Those at the temperature of the start.
    Start,
}

/// A number of a distribution.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Statistic {
    /// Mean.
    Mean,
    /// Standard deviation.
    StandardDeviation,
    /// Largest value.
    Largest,
    /// Share of the negative ones: attraction, for forces.
    NegativeShare,
}
