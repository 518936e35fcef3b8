//! Bodies and the protocol of a case: how walls move and what happens in each stage.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::model::PairValues;
use super::quantity::{
    Acceleration, AngularSpeed, Dashpot, Duration, Force, Frequency, Length, Mass, Number, Pressure, Speed, Stiffness,
    Temperature,
};
use super::source::ParticleSource;

/// A wall.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// Name.
    pub name: String,
    /// Name of the material.
    pub material: String,
    /// Shape.
    pub shape: Shape,
    /// Degrees of freedom.
    pub motion: Motion,
    /// Temperature [K], for heated beds.
    pub temperature: Option<Temperature>,
}

/// Shape of a wall.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Shape {
    /// A plane without end.
    Plane {
        /// A point of the plane [m].
        point: [Length; 3],
        /// Normal into the region of the particles; any length but zero [-].
        normal: [Number; 3],
    },
    /// The inside of a cylinder without end.
    Cylinder {
        /// A point of the axis [m].
        point: [Length; 3],
        /// Direction of the axis [-].
        axis: [Number; 3],
        /// Radius [m].
        radius: Length,
    },
    /// Triangles of a file.
    Mesh {
        /// Path relative to the case file.
        path: String,
        /// Length of one unit of the file [m].
        scale: Length,
    },
}

/// Degrees of freedom of a wall.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Motion {
    /// It does not move.
    Fixed {},
    /// It moves at a constant velocity.
    Prescribed {
        /// Velocity [m/s].
        velocity: [Speed; 3],
    },
    /// It follows the load on it and has no weight: m x'' = F - load - damping x', F the force of the particles.
    Servo {
        /// Direction of the motion, away from the particles [-].
        direction: [Number; 3],
        /// External load.
        load: Load,
        /// Mass [kg].
        mass: Mass,
        /// Dashpot constant [kg/s].
        damping: Dashpot,
    },
    /// It hangs on a spring and has weight: m x'' = m g + preload - stiffness x - load - damping x'.
    Sprung {
        /// Direction of the motion [-].
        direction: [Number; 3],
        /// Mass [kg].
        mass: Mass,
        /// Stiffness of the spring [N/m].
        stiffness: Stiffness,
        /// Dashpot constant [kg/s].
        damping: Dashpot,
        /// Force of the spring when the motion begins, along the direction [N].
        preload: Force,
    },
    /// It oscillates about its place: x = amplitude sin(2 pi frequency t).
    Oscillating {
        /// Direction of the motion [-].
        direction: [Number; 3],
        /// Amplitude [m].
        amplitude: Length,
        /// Frequency [Hz].
        frequency: Frequency,
    },
}

/// External load on a servo wall.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Load {
    /// A force [N].
    Force {
        /// Force [N].
        value: Force,
    },
    /// A pressure on the area of the wall inside the domain [Pa].
    Pressure {
        /// Pressure [Pa].
        value: Pressure,
    },
    /// A stress of two dimensions on the length of the wall between two other walls [N/m].
    LineStress {
        /// Stress [N/m].
        value: Stiffness,
        /// Names of the walls that bound the length.
        between: [String; 2],
    },
}

/// One stage: actions at its beginning, then time until its end.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stage {
    /// Name, for records and branches.
    pub name: String,
    /// When it ends.
    pub end: End,
    /// What happens at its beginning, in order.
    #[serde(default)]
    pub actions: Vec<Action>,
    /// Sampling during the stage; that of the case if absent.
    pub output: Option<StageOutput>,
}

/// Sampling of a stage, which ends with a sample.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StageOutput {
    /// Steps between samples.
    pub every: u64,
}

/// End of a stage.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum End {
    /// After a time.
    Duration {
        /// Time [s].
        value: Duration,
    },
    /// After a multiple of the duration of the shortest elastic impact at the start velocities.
    Contacts {
        /// Multiple [-].
        value: Number,
    },
    /// When the bed is at rest.
    AtRest {
        /// Kinetic energy per particle, in units of m g d [-].
        kinetic_energy: Number,
        /// Time after which the stage is given up [s].
        at_most: Duration,
    },
    /// When the contact forces on each particle balance, with or without gravity.
    Balanced {
        /// Mean resultant over mean contact force [-].
        ratio: Number,
        /// Time after which the stage is given up [s].
        at_most: Duration,
    },
    /// When the particles' load on a body passes a value.
    Load {
        /// Name of the body.
        body: String,
        /// The load, along the body's normal.
        load: Load,
        /// From which side it passes.
        passes: Passes,
        /// Time after which the stage is given up [s].
        at_most: Duration,
    },
}

/// From which side a value is passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Passes {
    /// From below.
    Upwards,
    /// From above.
    Downwards,
}

/// Actions at the beginning of a stage.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "do", rename_all = "snake_case", deny_unknown_fields)]
pub enum Action {
    /// Gives a pair of materials new values (`friction = 0` switches friction off).
    SetPair {
        /// Names of the two materials.
        between: [String; 2],
        /// The new values; what is absent stays.
        values: PairValues,
    },
    /// Gives a body another motion.
    SetMotion {
        /// Name of the body.
        body: String,
        /// The new motion.
        motion: Motion,
    },
    /// Removes a body.
    Remove {
        /// Name of the body.
        body: String,
    },
    /// Moves a body along a smooth strain path: position = start (1 - strain/2 (1 - cos(pi t / duration))).
    Strain {
        /// Name of the body.
        body: String,
        /// Name of the body from which the length is measured.
        from: String,
        /// Largest strain [-].
        strain: Number,
    },
    /// Ramps a temperature linearly over the stage.
    RampTemperature {
        /// What is heated.
        target: HeatTarget,
        /// Temperature at the end of the stage [K].
        to: Temperature,
    },
    /// Ramps the external load of a servo wall linearly over the stage.
    RampLoad {
        /// Name of the body.
        body: String,
        /// Load at the end of the stage, of the kind that the wall has.
        to: Load,
    },
    /// Gives the relaxation time of a law's stiffness.
    SetRelaxationTime {
        /// Relaxation time [s].
        value: Duration,
    },
    /// Changes gravity.
    SetGravity {
        /// Gravity [m/s2].
        value: [Acceleration; 3],
    },
    /// Slows every particle by a drag: acceleration = -rate velocity. Zero switches it off.
    SetDrag {
        /// Rate [1/s].
        rate: Frequency,
    },
    /// Adds particles.
    Deposit {
        /// Where they come from.
        particles: ParticleSource,
    },
    /// Drives one particle along a prescribed path for the stage. A particle that any stage drives is driven in all of
    /// them, whatever acts on it: it starts at rest, and rests in stages that do not mention it.
    Drive {
        /// Index of the driven particle.
        particle: u32,
        /// Velocity, in a frame that lies along the axes when the stage begins and then turns with the rotation [m/s].
        velocity: [Speed; 3],
        /// Angular velocity, in that frame; the rotation comes on top of it [rad/s].
        angular_velocity: [AngularSpeed; 3],
        /// What multiplies the two velocities as time goes on.
        course: Course,
        /// Rotation of the particle and its path, from the beginning of the stage [rad/s].
        rotation: [AngularSpeed; 3],
        /// A point of the axis of the rotation [m].
        point: [Length; 3],
    },
}

/// What multiplies the velocity of a driven particle; t is the time since the beginning of the stage.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Course {
    /// 1: a straight path.
    Constant {},
    /// cos(2 pi frequency t): a sinusoid of amplitude velocity / (2 pi frequency) about the place of the start.
    Sinusoid {
        /// Frequency [Hz].
        frequency: Frequency,
    },
}

/// What a temperature ramp heats.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum HeatTarget {
    /// All particles and the law's own temperature.
    Particles {},
    /// One body.
    Body {
        /// Name of the body.
        name: String,
    },
}
