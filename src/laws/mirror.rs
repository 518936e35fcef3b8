//! Which laws and options a code has: a mirror `native[X]` may hold nothing that X cannot compute.

use serde::{Deserialize, Serialize};

use crate::error::Problem;

use super::moments::any::{Moments, Rolling};
use super::moments::elastic_plastic_rolling::Stiffness;
use super::normal::hysteretic_branches::Rule;
use super::registry::{Normal, Specification, Tangential};
use super::slider::History;
use super::tangential::options::{Friction, Options};

/// A code that the native engine mirrors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Code {
    /// LIGGGHTS-PUBLIC 3.8.0.
    Liggghts,
    /// YADE 2023.02a.
    Yade,
    /// LAMMPS, 29 Sep 2021.
    Lammps,
}

impl Code {
    /// Whether the code has these tangential options. Friction is judged apart: it depends on the normal law.
    #[must_use]
    pub fn has(self, options: &Options) -> bool {
        let sets = match self {
            Self::Liggghts => vec![Options::liggghts()],
            // At a `Wall` and at a `Facet`.
            Self::Yade => vec![Options::yade(), Options { wall_arms: Options::yade().pair_arms, ..Options::yade() }],
            Self::Lammps => {
                [History::Displacement, History::Force, History::ForceRescaled].map(Options::lammps).to_vec()
            }
        };
        let frictions: &[Friction] = match self {
            Self::Liggghts => &[Friction::Total, Friction::WithoutAdhesion],
            Self::Yade => &[Friction::Total, Friction::PullOffAdded],
            Self::Lammps => &[Friction::Total, Friction::TwicePullOff],
        };
        frictions.contains(&options.friction)
            && sets.iter().any(|set| Options { friction: options.friction, ..*set } == *options)
    }

    fn normal(self, normal: &Normal) -> Result<(), &'static str> {
        let has = match normal {
            Normal::Hertz { .. } | Normal::LinearSpringDashpot { .. } => true,
            Normal::Dmt { .. } => self != Self::Liggghts,
            Normal::Sjkr { .. } | Normal::Sjkr2 { .. } => self == Self::Liggghts,
            Normal::LudingHysteretic { rule, .. } => match self {
                Self::Liggghts => *rule != Rule::LudingPm,
                Self::Yade => *rule == Rule::LudingPm,
                Self::Lammps => false,
            },
            Normal::LudingSintering { .. } => false,
        };
        if has { Ok(()) } else { Err(self.normals()) }
    }

    const fn normals(self) -> &'static str {
        match self {
            Self::Liggghts => {
                "hertz, sjkr, sjkr2, linear_spring_dashpot, luding_hysteretic (self_consistent, old_stiffness)"
            }
            Self::Yade => "hertz, dmt, linear_spring_dashpot, luding_hysteretic (luding_pm)",
            Self::Lammps => "hertz, dmt, linear_spring_dashpot",
        }
    }

    fn moments(self, moments: &Moments) -> Result<(), &'static str> {
        let rolls = match (&moments.rolling, self) {
            (Rolling::Free, _) | (Rolling::ConstantTorque { .. }, Self::Liggghts) => true,
            (Rolling::ConstantTorque { .. }, _) => false,
            (Rolling::ElasticPlasticRolling { spring }, _) => match spring.stiffness {
                Stiffness::Tangential | Stiffness::Normal { .. } => self == Self::Liggghts,
                Stiffness::Constant { .. } => self != Self::Liggghts,
                Stiffness::PerRadiusSquared { .. } => self == Self::Lammps,
            },
        };
        if !rolls {
            return Err(match self {
                Self::Liggghts => "constant_torque, or a spring with tangential or normal stiffness",
                Self::Yade => "a spring with constant stiffness",
                Self::Lammps => "a spring with stiffness per_radius_squared or constant",
            });
        }
        match (&moments.twisting, self) {
            (Some(_), Self::Liggghts) => Err("none: torsion belongs to the rolling law"),
            _ => Ok(()),
        }
    }

    /// Refuses a specification that the code cannot compute.
    ///
    /// # Errors
    /// The first law or option that it does not have.
    pub fn check(self, specification: &Specification) -> Result<(), Problem> {
        let refuse = |key: &str, value: String, allowed: &str| {
            Err(Problem::new(key, value, format!("native[{}] mirrors {allowed}", self.name())))
        };
        let Specification { normal, tangential, moments } = specification;
        if let Err(allowed) = self.normal(normal) {
            return refuse("model.normal", text(normal), allowed);
        }
        match tangential {
            Tangential::Mindlin { options, .. } | Tangential::LinearHistory { options, .. } if !self.has(options) => {
                return refuse("model.tangential.options", text(options), "the options of that code only");
            }
            _ => {}
        }
        self.moments(moments).or_else(|allowed| refuse("model.moments", text(moments), allowed))
    }

    /// Refuses a view of walls that the code does not have: a plane as a sphere of so many radii, and the share of its
    /// curvature that a cylinder has in R*, where the scene has one.
    ///
    /// # Errors
    /// The first option that it does not have.
    pub fn check_walls(self, plane: Option<f64>, curvature: Option<f64>, cylinders: bool) -> Result<(), Problem> {
        let refuse = |key: &str, value: Option<f64>, allowed: &str| {
            let value = value.map_or_else(|| "nothing".to_owned(), |value| format!("{value:?}"));
            Err(Problem::new(format!("mirror.{key}"), value, format!("native[{}] mirrors {allowed}", self.name())))
        };
        // `Wall` by default, `Facet` by default, and both with `hertzian`.
        let (planes, allowed): (&[f64], _) = match self {
            Self::Yade => (&[1.0, 2.0, 1e8], "1, 2 and 1e8"),
            Self::Liggghts | Self::Lammps => (&[], "nothing: a plane has no radius"),
        };
        if plane.is_some_and(|plane| !planes.contains(&plane)) {
            return refuse("plane_radius_factor", plane, allowed);
        }
        let (own, allowed) = match self {
            Self::Liggghts => (Some(0.0), "0"),
            Self::Lammps => (Some(0.5), "0.5"),
            Self::Yade => (None, "nothing: it has no inside of a cylinder"),
        };
        if (curvature.is_some() || cylinders) && curvature != own {
            return refuse("cylinder_curvature", curvature, allowed);
        }
        Ok(())
    }

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Liggghts => "liggghts",
            Self::Yade => "yade",
            Self::Lammps => "lammps",
        }
    }
}

/// A law as a scene states it.
fn text(law: &impl Serialize) -> String {
    serde_json::to_string(law).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::moments::constant_torque::Opposed;
    use crate::laws::tangential::options::Dashpot;

    fn with(normal: Normal, options: Options, rolling: Rolling) -> Specification {
        let tangential = Tangential::Mindlin { dashpot: Dashpot::CriticalShare, options };
        Specification { normal, tangential, moments: Moments { rolling, twisting: None } }
    }

    #[test]
    fn each_code_accepts_its_own_set_and_refuses_the_others() {
        let hertz = Normal::Hertz { force_cut: true };
        let sets = [
            (Code::Liggghts, Options::liggghts()),
            (Code::Yade, Options::yade()),
            (Code::Lammps, Options::lammps(History::Force)),
        ];
        for (code, _) in sets {
            for (other, options) in sets {
                assert_eq!(code.check(&with(hertz, options, Rolling::Free)).is_ok(), code == other);
            }
            assert!(code.check(&with(hertz, Options::plain(), Rolling::Free)).is_err());
        }
    }

    #[test]
    fn each_code_has_its_own_planes_and_cylinders() {
        let refusal = |code: Code, plane, curvature, cylinders| {
            code.check_walls(plane, curvature, cylinders).map_or_else(|problem| problem.to_string(), |()| "none".into())
        };
        for (code, own) in [(Code::Liggghts, Some(0.0)), (Code::Lammps, Some(0.5)), (Code::Yade, None)] {
            for curvature in [None, Some(0.0), Some(0.5), Some(1.0)] {
                let message = refusal(code, None, curvature, true);
                let expected = format!("native[{}] mirrors", code.name());
                assert_eq!(message == "none", curvature == own, "{message}");
                assert!(curvature == own || message.contains(&expected), "{message}");
            }
            assert_eq!(refusal(code, None, None, false), "none");
            assert_eq!(refusal(code, Some(1e8), None, false) == "none", code == Code::Yade);
        }
        assert_eq!(
            refusal(Code::Lammps, None, Some(0.0), false),
            "mirror.cylinder_curvature = 0.0: native[lammps] mirrors 0.5"
        );
        assert_eq!(
            refusal(Code::Yade, Some(3.0), None, false),
            "mirror.plane_radius_factor = 3.0: native[yade] mirrors 1, 2 and 1e8"
        );
    }

    #[test]
    fn a_law_that_a_code_does_not_have_is_refused_by_name() {
        let sjkr = Normal::Sjkr { force_cut: true, energy_density: 1.0 };
        let error = Code::Yade.check(&with(sjkr, Options::yade(), Rolling::Free)).unwrap_err().to_string();
        assert!(error.contains("native[yade] mirrors hertz, dmt"), "{error}");
        let torque = Rolling::ConstantTorque { opposed: Opposed::RollingShare };
        let hertz = Normal::Hertz { force_cut: true };
        let error = Code::Lammps.check(&with(hertz, Options::lammps(History::Force), torque)).unwrap_err().to_string();
        assert!(error.contains("per_radius_squared"), "{error}");
    }
}
