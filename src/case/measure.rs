//! What a case measures in its stages: bulk observables with their regions and time windows.

mod bounds;

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
    /// Volume of the particles over that of a bed twice as high as their centre of mass: V / (2 A z), with the area A of
    /// the floor between walls [-].
    PackingFractionByCenter {
        /// Name of the floor.
        floor: String,
    },
    /// Packing fraction of each bin [-].
    PackingProfile {
        /// Bins.
        bins: Bins,
    },
    /// Contacts per particle, walls not counted unless asked for; a contact is an overlap above zero [-].
    Coordination {
        /// Region of the centres.
        region: Region,
        /// Whether contacts with bodies count too; absent, they do not.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        bodies: bool,
    },
    /// Contacts per particle among those that are no rattlers. A rattler has fewer than `least_contacts` contacts, bodies
    /// counted and other rattlers not [-].
    CoordinationWithoutRattlers {
        /// Region of the centres.
        region: Region,
        /// Fewest contacts of a particle that is no rattler; 4 holds a sphere with friction [-].
        least_contacts: u32,
        /// Whether contacts with bodies count too; absent, they do not.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        bodies: bool,
    },
    /// Rattlers over all particles [-].
    RattlerShare {
        /// Region of the centres.
        region: Region,
        /// Fewest contacts of a particle that is no rattler; 4 holds a sphere with friction [-].
        least_contacts: u32,
    },
    /// Force of the particles on a body [N].
    WallForce {
        /// Name of the body.
        body: String,
        /// Direction, away from the particles; any length but zero [-].
        direction: [Number; 3],
    },
    /// That force over the area of the body inside the domain and the other bodies [Pa].
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
    /// Stress of the particles on a body in each bin, from its contacts [Pa].
    WallStressProfile {
        /// Name of the body.
        body: String,
        /// Which component.
        component: WallComponent,
        /// Bins, for the places of contacts on the body.
        bins: Bins,
    },
    /// Force of the particles on some bodies along gravity over the weight of all particles [-].
    WeightShare {
        /// Names of the bodies.
        bodies: Vec<String>,
    },
    /// Shear force on a body over the largest that friction allows: |sum of shear| / sum of (friction x normal force) [-].
    WallMobilisation {
        /// Name of the body.
        body: String,
        /// Direction of the shear; any length but zero [-].
        direction: [Number; 3],
    },
    /// The same in each bin, for the shear along the axis of the bins [-].
    WallMobilisationProfile {
        /// Name of the body.
        body: String,
        /// Bins, for the places of contacts on the body.
        bins: Bins,
    },
    /// Distance of two parallel planes [m].
    Distance {
        /// Names of the two bodies.
        between: [String; 2],
    },
    /// Normal forces of particle contacts as recorded, positive where they push [N].
    NormalForces {
        /// Which number of their distribution.
        statistic: Statistic,
    },
    /// Probability density of normal forces over their mean, in `count` equal classes from 0 [-].
    NormalForceDistribution {
        /// Number of classes [-].
        count: u32,
        /// End of the last class, in means [-].
        up_to: Number,
    },
    /// Tangential force of contacts over friction x normal force; contacts that do not push are left out [-].
    Mobilisation {
        /// Which number of its distribution.
        statistic: MobilisationStatistic,
        /// Which contacts.
        contacts: ContactSet,
    },
    /// Overlaps over the sum of the radii [-].
    Overlaps {
        /// Which number of their distribution.
        statistic: Statistic,
    },
    /// Kinetic energy of all particles over the sum of m g d [-].
    KineticEnergy {
        /// Which motion.
        part: KineticPart,
    },
    /// Stress tensor of a region, row by row, positive in compression [Pa].
    StressTensor {
        /// Region.
        region: Region,
        /// Which part.
        part: StressPart,
    },
    /// What is missing in the balance of momentum at one time, over the weight: |forces of bodies + forces of contacts| [-].
    MomentumResidual {},
    /// What is missing in it over a window of samples before the present one: |change of momentum - forces of bodies and
    /// weight over time| / (weight x time); the first windows are shorter, the first of all is 0 [-].
    MomentumChange {
        /// Intervals between samples in the window [-].
        samples: u32,
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

/// Equal bins along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Bins {
    /// Axis.
    pub axis: Axis,
    /// Beginning of the first bin [m].
    pub from: Length,
    /// End of the last bin [m].
    pub to: Length,
    /// Width; a whole number of bins fills the range [m].
    pub width: Length,
}

/// An axis of space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Axis {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

/// A component of the stress on a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WallComponent {
    /// Across the body, positive where particles push.
    Normal,
    /// Along the body, its component along the axis of the bins.
    Shear,
}

/// A number of the distribution of the mobilisation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MobilisationStatistic {
    /// Mean.
    Mean,
    /// Share of the contacts above 0.99.
    SlidingShare,
}

/// A set of contacts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ContactSet {
    /// Of two particles.
    Particles,
    /// Of a particle and a body.
    Bodies,
    /// All.
    All,
}

/// A part of the kinetic energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum KineticPart {
    /// Of the centres.
    Translational,
    /// Of the spins.
    Rotational,
    /// Both.
    Total,
}

/// A part of the stress tensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StressPart {
    /// Of the contacts whose place lies in the region.
    Contacts,
    /// Of the motion about the mean velocity, of the particles whose centres lie in it.
    Kinetic,
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
