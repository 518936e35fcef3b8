//! Twisting resistance of an elastic-plastic spring about the normal.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | w | relative spin about the normal, (wi - wj).n | rad/s |
//! | k, g | twisting stiffness, dashpot constant | N m, N m s |
//! | kt, gt, a | tangential stiffness and dashpot constant, contact radius | N/m, kg/s, m |
//! | `mu_t` | coefficient of twisting friction | - (m for the cap of `sds`) |
//!
//! Moment on i along n: e - g w with de = -k w dt, capped. Rules: [`crate::laws::slider`].
//!
//! | kind | k | g | cap |
//! |---|---|---|---|
//! | `spot` (plain; LAMMPS `marshall`) | kt a^2 / 2 | gt a^2 / 2 | 2/3 a `mu_t` abs(`F_n`) |
//! | `constant` (LAMMPS `sds`; YADE ktwist, without cap) | value | value | arm `mu_t` abs(`F_n`), or none |
//!
//! Valid for a spot that sticks (k) and for one that slides as a whole under uniform pressure (cap). Source: Marshall,
//! *J. Comput. Phys.* 228 (2009) 1541. Plain: frame indifferent, action = reaction, cap, no energy gained, a wall is the
//! limit of a large sphere. LAMMPS directs a capped moment against the spin, even where the spring still pushes along it.

use serde::{Deserialize, Serialize};

use crate::laws::rotation::{AlongNormal, Rotation, Turn};
use crate::laws::slider::{Cap, History, Increment, Memory, Order, Rules, Step};
use crate::laws::{Contact, MomentLaw, MomentState, NormalState, TangentialState};

/// Stiffness, dashpot and cap.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Spring {
    /// Of the spot, from the tangential law.
    Spot,
    /// Constants.
    Constant {
        /// Stiffness [N m].
        stiffness: f64,
        /// Dashpot constant [N m s].
        dashpot: f64,
        /// Length that makes a moment of friction [m]; none is no cap.
        arm: Option<f64>,
    },
}

/// The law; its coefficient comes with each pair.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Twisting {
    /// Stiffness, dashpot and cap.
    pub spring: Spring,
    /// What the contact remembers.
    pub history: History,
    /// How that turns with the contact.
    pub rotation: Rotation,
    /// What the limit holds.
    pub cap: Cap,
}

impl Twisting {
    /// The native law.
    #[must_use]
    pub const fn plain() -> Self {
        Self { spring: Spring::Spot, history: History::ForceRescaled, rotation: Rotation::Rigid, cap: Cap::Total }
    }

    /// YADE: ktwist [N m], never capped.
    #[must_use]
    pub const fn yade(ktwist: f64) -> Self {
        Self {
            spring: Spring::Constant { stiffness: ktwist, dashpot: 0.0, arm: None },
            history: History::Force,
            rotation: Rotation::SmallAngles,
            cap: Cap::Elastic,
        }
    }

    /// LAMMPS: `twisting marshall` ([`Spring::Spot`]) or `sds`, whose coefficient is a length (`arm` 1 m).
    #[must_use]
    pub const fn lammps(spring: Spring) -> Self {
        Self {
            spring,
            history: History::Displacement,
            rotation: Rotation::ProjectionRescaled,
            cap: Cap::TotalAlongRate,
        }
    }
}

impl Twisting {
    /// Whether the moment is limited by the coefficient of the pair.
    #[must_use]
    pub fn capped(&self) -> bool {
        !matches!(self.spring, Spring::Constant { arm: None, .. })
    }

    /// Rescaled springs, which are native, take the mean.
    const fn increment(&self) -> Increment {
        match self.history {
            History::ForceRescaled => Increment::Mean,
            _ => Increment::Present,
        }
    }
}

impl MomentLaw for Twisting {
    type History = Memory;

    #[inline(always)]
    fn evaluate(
        &self,
        contact: &Contact,
        normal: &NormalState,
        tangential: &TangentialState,
        dt: f64,
        history: &mut Memory,
    ) -> MomentState {
        let direction = contact.geometry.normal;
        let rate = direction * super::relative_spin(contact).dot(&direction);
        let friction = contact.pair.twisting_friction * normal.force.abs();
        let (stiffness, dashpot, limit) = match self.spring {
            Spring::Spot => {
                let half_square = 0.5 * normal.contact_radius * normal.contact_radius;
                let limit = 2.0 / 3.0 * normal.contact_radius * friction;
                (tangential.stiffness * half_square, tangential.dashpot * half_square, limit)
            }
            Spring::Constant { stiffness, dashpot, arm } => {
                (stiffness, dashpot, arm.map_or(f64::INFINITY, |arm| arm * friction))
            }
        };
        let turn = Turn::of(contact, dt);
        let rules = Rules {
            history: self.history,
            rotation: self.rotation,
            order: Order::RotateFirst,
            increment: self.increment(),
            cap: self.cap,
        };
        let step = Step { rate, stiffness, dashpot, limit, dt };
        MomentState::of(&rules.advance(&step, history, &AlongNormal { rotation: self.rotation, turn: &turn }))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::Vector;
    use crate::laws::moments::probe;

    proptest! {
        #[test]
        fn the_moment_lies_along_the_normal_resists_and_keeps_its_cap(
            x in 0.1..9.0f64, y in -9.0..9.0f64, sign in -1.0..1.0f64, steps in 1..400u32,
        ) {
            let (contact, normal, tangential) = probe(Vector::new(x.copysign(sign), y, 0.0));
            let limit = 2.0 / 3.0 * normal.contact_radius * contact.pair.twisting_friction * normal.force;
            let mut history = Memory::default();
            for _ in 0..steps {
                let state = Twisting::plain().evaluate(&contact, &normal, &tangential, 1e-4, &mut history);
                prop_assert!(state.moment.norm() <= limit * (1.0 + 1e-12));
                prop_assert!(state.moment.x * x.copysign(sign) <= 0.0);
                prop_assert!(state.moment.y == 0.0 && state.moment.z == 0.0);
            }
        }
    }
}
