//! Engine options that reproduce another code.

use serde::{Deserialize, Serialize};

use crate::error::Problem;
use crate::laws::mirror::Code;
use crate::laws::moments::constant_torque::Opposed;
use crate::laws::moments::elastic_plastic_rolling::ElasticPlasticRolling;
use crate::laws::moments::twisting::Twisting;
use crate::laws::normal::cohesive::DashpotLimit;
use crate::laws::normal::hysteretic_branches::Rule;
use crate::laws::tangential::options::Options;

/// Engine options that reproduce another code; the plain engine uses [`Mirror::default`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mirror {
    /// The code; options that it does not have are refused.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub code: Option<Code>,
    /// A plane acts like a sphere whose radius is this multiple of the particle's.
    pub plane_radius_factor: Option<f64>,
    /// Share of its curvature that a cylinder has in R*: 0 makes it a plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cylinder_curvature: Option<f64>,
    /// Where velocities start.
    pub start: Start,
    /// How the tangential spring works.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tangential: Option<Options>,
    /// How the rolling spring works.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rolling: Option<ElasticPlasticRolling>,
    /// How the twisting spring works.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub twisting: Option<Twisting>,
    /// What a constant torque opposes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub opposed: Option<Opposed>,
    /// How far the dashpot of an adhesive law may pull.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dashpot_limit: Option<DashpotLimit>,
    /// How the largest overlap of a hysteretic law follows the limit of cohesion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hysteresis: Option<Rule>,
}

impl Mirror {
    /// Refuses walls and a start that the mirrored code does not have.
    ///
    /// # Errors
    /// The first option that it does not have.
    pub fn check(&self, cylinders: bool) -> Result<(), Problem> {
        let Some(code) = self.code else { return Ok(()) };
        code.check_walls(self.plane_radius_factor, self.cylinder_curvature, cylinders)?;
        let (own, name) = match code {
            Code::Yade => (Start::Staggered, "staggered"),
            Code::Liggghts | Code::Lammps => (Start::Synchronized, "synchronized"),
        };
        if self.start == own {
            return Ok(());
        }
        let value = if self.start == Start::Staggered { "staggered" } else { "synchronized" };
        Err(Problem::new("mirror.start", value, format!("native[{}] mirrors {name}", code.name())))
    }
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
