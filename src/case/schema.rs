//! The types of the case file. They are the schema: Rust and Python read cases through them, and
//! `crossgrain schema` publishes them as JSON schema. Physics has no defaults here; only output has.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::gate::Gate;
use super::measure::Observable;
use super::model::{Model, PairValues};
use super::protocol::{Body, Stage};
use super::quantity::{
    Acceleration, Conductivity, Density, Duration, Expansion, HeatCapacity, Length, Number, Pressure, Temperature,
};
use super::source::ParticleSource;

/// The version of the case schema that this build reads.
pub const SCHEMA: u32 = 1;

/// One physical question, stated once for every code.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Version of the schema: 1.
    pub schema: u32,
    /// Name in decks, reports and verdicts: letters, digits, `-`.
    pub name: String,
    /// The physical question that the case asks, as a sentence.
    pub question: String,
    /// Level on the ladder of agreement.
    pub level: Level,
    /// Where parameters and targets come from.
    pub source: String,
    /// Suites that run the case.
    #[serde(default)]
    pub suites: Vec<Suite>,
    /// Spheres, or disks that move in a plane.
    pub geometry: Geometry,
    /// Gravity [m/s2].
    pub gravity: [Acceleration; 3],
    /// The box that holds every particle.
    pub domain: Domain,
    /// Materials by name.
    pub materials: Vec<Material>,
    /// Values of every pair of materials that can touch.
    #[serde(default)]
    pub pairs: Vec<Pair>,
    /// The contact model.
    pub model: Model,
    /// Walls.
    #[serde(default)]
    pub bodies: Vec<Body>,
    /// Where the particles come from.
    #[serde(default)]
    pub particles: Vec<ParticleSource>,
    /// Another case's state to start from, in place of `particles`.
    pub start_from: Option<StartFrom>,
    /// Temperature of all particles at the start [K], where the model or a stage asks for one.
    pub temperature: Option<Temperature>,
    /// Permits particles that overlap each other or a body at the start.
    #[serde(default)]
    pub allow_initial_overlap: bool,
    /// Time step.
    pub time: TimeStepping,
    /// What happens, one stage after the other.
    pub stages: Vec<Stage>,
    /// What is measured in a stage, beyond the observables that every record has.
    #[serde(default)]
    pub observables: Vec<Observable>,
    /// What is compared, and how far it may differ.
    #[serde(default)]
    pub gates: Vec<Gate>,
    /// Sweeps: every combination of the points of all axes is one variant.
    #[serde(default)]
    pub vary: Vec<Vary>,
    /// Seeds of an ensemble.
    pub ensemble: Option<Ensemble>,
    /// Sampling of the run record.
    #[serde(default)]
    pub output: Output,
}

/// Levels of the ladder of agreement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
pub enum Level {
    /// One contact along a prescribed path.
    L0,
    /// Free impacts of two bodies.
    L1,
    /// Forces of one many-body state.
    L2,
    /// Short many-body trajectories.
    L3,
    /// Bulk observables over seeds.
    L4,
    /// Closed forms, published tables, experiments.
    L5,
}

/// Named sets of cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Suite {
    /// A quick cut of everything.
    Standard,
    /// Contacts along prescribed paths.
    Laws,
    /// Two-body impacts.
    Collisions,
    /// Forces of many-body states.
    Snapshots,
    /// Beds.
    Bulk,
    /// Long-time sintering.
    Sintering,
    /// Fine powders.
    FinePowders,
    /// Packed beds, silos, heat.
    PackedBeds,
}

/// Shape of the particles.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Geometry {
    /// Spheres in three dimensions.
    Spheres {},
    /// Disks of one height that move in the x-z plane.
    Disks {
        /// Height of the disks [m].
        height: Length,
    },
}

/// The box that holds every particle.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Domain {
    /// Lower corner [m].
    pub min: [Length; 3],
    /// Upper corner [m].
    pub max: [Length; 3],
    /// What the faces of each axis do.
    pub boundary: [Boundary; 3],
}

/// Faces of the domain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Boundary {
    /// Particles must stay inside.
    Open,
    /// Particles re-enter on the other side.
    Periodic,
}

/// A material.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Name.
    pub name: String,
    /// An intent: a body of this material does not deform. It then has no other value.
    #[serde(default)]
    pub rigid: bool,
    /// Young's modulus [Pa].
    pub young: Option<Pressure>,
    /// Poisson's ratio [-], between -1 and 0.5.
    pub poisson: Option<Number>,
    /// Density [kg/m3].
    pub density: Option<Density>,
    /// Yield strength [Pa], for plastic laws.
    pub yield_strength: Option<Pressure>,
    /// Thermal properties, where temperatures differ or change.
    pub thermal: Option<Thermal>,
}

/// Thermal properties of a material.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Thermal {
    /// Thermal conductivity [W/(m K)], for laws of heat exchange.
    pub conductivity: Option<Conductivity>,
    /// Specific heat capacity [J/(kg K)], for laws of heat exchange.
    pub heat_capacity: Option<HeatCapacity>,
    /// Young's modulus of the spots that conduct [Pa], for laws of heat exchange: `young` may be softened, this is not.
    pub contact_young: Option<Pressure>,
    /// Linear thermal expansion of the radius [1/K].
    pub expansion: Expansion,
    /// Temperature at which the radii are given [K].
    pub reference_temperature: Temperature,
}

/// Values of one pair of materials.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pair {
    /// Names of the two materials.
    pub between: [String; 2],
    /// Values that the laws of the model ask for.
    pub values: PairValues,
}

/// The state of another case in one of its stages: particles, contacts with what they remember, temperatures, what the
/// law shares, and the places and velocities of the bodies. Everything else is what this case states; a body that it
/// does not state is gone. A member of an ensemble starts from the member with its seed.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StartFrom {
    /// Name of the case.
    pub case: String,
    /// Name of its variant; absent, on each of its axes the point that this case has on its axis of the same name.
    pub variant: Option<String>,
    /// Name of the stage.
    pub stage: String,
    /// Time after the beginning of that stage [s]; its end if absent.
    pub at: Option<Duration>,
}

/// The time step and its refinements.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimeStepping {
    /// How the time step is chosen.
    pub step: TimeStep,
    /// Number of times the native engine repeats the run with half the step, to know its time-step error.
    #[serde(default)]
    pub refinements: u32,
    /// A deep refinement k, above `refinements` + 2: the native engine also runs with the step divided by 2^(k - 2),
    /// 2^(k - 1) and 2^k, for gates with `check = "finest"` and `check = "extrapolated"`. Codes and mirrors do not.
    pub finest: Option<u32>,
}

impl TimeStepping {
    /// The refinements that are run, coarsest first.
    pub fn levels(&self) -> impl Iterator<Item = u32> {
        (0..=self.refinements).chain(self.finest.iter().flat_map(|finest| finest.saturating_sub(2)..=*finest))
    }
}

/// Choice of the time step.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum TimeStep {
    /// A given step.
    Fixed {
        /// Time step [s].
        value: Duration,
    },
    /// A fraction of the duration of the shortest elastic impact at the start velocities.
    ContactFraction {
        /// Steps per elastic contact duration.
        steps_per_contact: u32,
    },
    /// A fraction of the Rayleigh time of the smallest particle.
    RayleighFraction {
        /// Fraction [-].
        fraction: Number,
    },
}

/// One axis of a sweep.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Vary {
    /// Name of the axis, for plots.
    pub axis: String,
    /// Points of the axis.
    pub points: Vec<VaryPoint>,
}

/// One point of a sweep.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VaryPoint {
    /// Name of the point in the variant's name: letters, digits, `-`, `_`, `.`, `=`.
    pub label: String,
    /// Position on the axis, for plots [-].
    pub at: Option<Number>,
    /// Whether only the full form of a suite runs this point.
    #[serde(default)]
    pub full_only: bool,
    /// Keys of the case (`pairs.0.values.friction`) and their values at this point.
    #[schemars(with = "std::collections::BTreeMap<String, serde_json::Value>")]
    pub set: toml::Table,
}

/// Seeds of an ensemble.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ensemble {
    /// Seeds, one run each.
    pub seeds: Vec<u64>,
}

/// Sampling of the run record.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Output {
    /// Steps between samples.
    pub every: u64,
    /// Whether samples hold the force of every contact.
    #[serde(default)]
    pub contacts: bool,
    /// Whether samples also hold what contacts remember, and the parts of their forces; needs `contacts`.
    #[serde(default)]
    pub contact_states: bool,
    /// Whether samples hold the energy ledger, whose account of every contact takes as long as the contacts themselves.
    #[serde(default = "kept")]
    pub energies: bool,
}

const fn kept() -> bool {
    true
}

impl Default for Output {
    fn default() -> Self {
        Self { every: 1, contacts: false, contact_states: false, energies: true }
    }
}
