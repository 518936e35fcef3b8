//! Rolling resistance of an elastic-plastic spring.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | w | spin wi - wj across the normal (the whole of it with torsion) | rad/s |
//! | k, g | rolling stiffness, dashpot constant | N m, N m s |
//! | kt, kn | tangential stiffness, secant normal stiffness `F_e` / d | N/m |
//! | `mu_r` | coefficient of rolling friction | - |
//! | R*, Rm | effective radius, mean radius (Ri + Rj) / 2 | m |
//! | `I_r` | 7/5 of the reduced m R^2 | kg m2 |
//!
//! Moment on i: e - g w with de = -k w dt, capped at `mu_r` abs(`F_n`) R* (or Rm). Rules: [`crate::laws::slider`].
//!
//! | stiffness | k | | dashpot | g |
//! |---|---|---|---|---|
//! | tangential | kt R*^2 | | none | 0 |
//! | constant | value | | `critical_share` | 2 value sqrt(`I_r` k), dropped when capped |
//! | `per_radius_squared` | value R*^2 | | `per_radius_squared` | value R*^2, inside the cap |
//! | normal | factor kn `mu_r`^2 R*^2 | | | |
//!
//! Sources: Ai, Chen, Rotter, Ooi, *Powder Technology* 206 (2011) 269, type C; Iwashita, Oda, *J. Eng. Mech.* 124 (1998)
//! 285 for kt R*^2; Luding, *Granular Matter* 10 (2008) 235 for the spring that turns with the contact.
//!
//! Plain: frame indifferent, action = reaction, cap, no energy gained, a wall is the limit of a large sphere (R* cap).
//!
//! | code | words | options |
//! |---|---|---|
//! | LIGGGHTS | `epsd` | normal 2.25, `critical_share`, fixed, elastic cap |
//! | | `epsd2` | tangential, none, fixed |
//! | | `epsd3` | normal `rollingStiffness`, `critical_share`, fixed |
//! | YADE | krot, eta | constant, none, `small_angles`, cap with Rm while pressed; eta = 0 is no cap |
//! | LAMMPS | `rolling sds k g mu` | `per_radius_squared`, `projection_rescaled`, total cap |

use serde::{Deserialize, Serialize};

use crate::laws::rotation::{InPlane, Rotation, Turn};
use crate::laws::slider::{Cap, History, Increment, Memory, Order, Rules, Step};
use crate::laws::{Contact, MomentLaw, MomentState, NormalState, TangentialState};

/// Sine of the angle to the contact plane below which LAMMPS leaves its spring alone, relative to the cap.
const NEGLIGIBLE: f64 = 1e-10;

pub use super::rolling_options::{Dashpot, Limit, Stiffness};

/// The law; its coefficient comes with each pair.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ElasticPlasticRolling {
    /// Stiffness.
    pub stiffness: Stiffness,
    /// Largest moment.
    pub limit: Limit,
    /// Dashpot.
    pub dashpot: Dashpot,
    /// What the contact remembers.
    pub history: History,
    /// How that turns with the contact.
    pub rotation: Rotation,
    /// What the limit holds.
    pub cap: Cap,
    /// Whether the part of the spin along the normal is resisted too, by one spring with one cap (LIGGGHTS,
    /// `torsionTorque on`).
    pub torsion: bool,
    /// Whether the spin at a wall is stretched (LIGGGHTS).
    pub stretched_at_walls: bool,
    /// Time over which the spring grows where forces are evaluated before the first step [s]: LIGGGHTS takes a step, which
    /// it then forgets.
    #[serde(default)]
    pub setup_step: f64,
}

impl ElasticPlasticRolling {
    /// The native law: kt R*^2, capped with R*, rescaled as kt falls, turned exactly.
    #[must_use]
    pub const fn plain() -> Self {
        Self {
            stiffness: Stiffness::Tangential,
            limit: Limit::EffectiveRadius,
            dashpot: Dashpot::None,
            history: History::ForceRescaled,
            rotation: Rotation::Rigid,
            cap: Cap::Total,
            torsion: false,
            stretched_at_walls: false,
            setup_step: 0.0,
        }
    }

    /// LIGGGHTS: `epsd` (normal 2.25), `epsd2` (tangential), `epsd3` (normal).
    #[must_use]
    pub const fn liggghts(stiffness: Stiffness, dashpot: Dashpot, torsion: bool) -> Self {
        Self {
            stiffness,
            dashpot,
            history: History::Force,
            rotation: Rotation::Fixed,
            cap: Cap::Elastic,
            torsion,
            stretched_at_walls: true,
            ..Self::plain()
        }
    }

    /// YADE: krot [N m]; the coefficient of the pair is eta, and eta = 0 is [`Limit::Unlimited`].
    #[must_use]
    pub const fn yade(krot: f64, limit: Limit) -> Self {
        let stiffness = Stiffness::Constant { value: krot };
        Self { stiffness, limit, history: History::Force, rotation: Rotation::SmallAngles, ..Self::plain() }
    }

    /// LAMMPS: `rolling sds` with k [N/m] and g [kg/s].
    #[must_use]
    pub const fn lammps(k: f64, g: f64) -> Self {
        Self {
            stiffness: Stiffness::PerRadiusSquared { value: k },
            dashpot: Dashpot::PerRadiusSquared { value: g },
            history: History::Displacement,
            rotation: Rotation::ProjectionRescaled,
            cap: Cap::TotalWhenStretched,
            ..Self::plain()
        }
    }

    fn stiffness(&self, contact: &Contact, normal: &NormalState, tangential: &TangentialState) -> f64 {
        let radius = contact.pair.effective_radius;
        let friction = contact.pair.rolling_friction;
        match self.stiffness {
            Stiffness::Tangential => tangential.stiffness * radius * radius,
            Stiffness::Constant { value } => value,
            Stiffness::PerRadiusSquared { value } => value * radius * radius,
            Stiffness::Normal { factor } => {
                factor * (normal.elastic / contact.geometry.overlap) * friction * friction * radius * radius
            }
        }
    }
}

impl ElasticPlasticRolling {
    /// Rescaled springs, which are native, take the mean.
    const fn increment(&self) -> Increment {
        match self.history {
            History::ForceRescaled => Increment::Mean,
            _ => Increment::Present,
        }
    }
}

impl MomentLaw for ElasticPlasticRolling {
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
        let mut forgotten = *history;
        let setup = dt == 0.0 && self.setup_step > 0.0;
        let (dt, history) = if setup { (self.setup_step, &mut forgotten) } else { (dt, history) };
        let direction = contact.geometry.normal;
        let spin = if self.stretched_at_walls { super::liggghts_spin(contact) } else { super::relative_spin(contact) };
        let rate = if self.torsion { spin } else { spin - direction * spin.dot(&direction) };
        let stiffness = self.stiffness(contact, normal, tangential);
        let radius = contact.pair.effective_radius;
        let dashpot = match self.dashpot {
            Dashpot::None => 0.0,
            Dashpot::CriticalShare { value } => 2.0 * value * (super::rolling_inertia(contact) * stiffness).sqrt(),
            Dashpot::PerRadiusSquared { value } => value * radius * radius,
        };
        let force = contact.pair.rolling_friction * normal.force.abs();
        let limit = match self.limit {
            Limit::EffectiveRadius => force * radius,
            Limit::MeanRadius => force * 0.5 * (contact.geometry.radius_i + contact.geometry.radius_j),
            Limit::WhilePressed if force > 0.0 => force * radius,
            Limit::WhilePressed | Limit::Unlimited => f64::INFINITY,
        };
        let turn = Turn::of(contact, dt);
        let negligible = NEGLIGIBLE * limit / if self.history == History::Displacement { stiffness } else { 1.0 };
        let rules = Rules {
            history: self.history,
            rotation: self.rotation,
            order: Order::RotateFirst,
            increment: self.increment(),
            cap: self.cap,
        };
        // LAMMPS remembers the rolling displacement, a quarter turn from the angle: as the contact turns, the two differ
        // to second order.
        let quarter = self.rotation == Rotation::ProjectionRescaled && !self.torsion;
        let followed = if quarter { rate.cross(&direction) } else { rate };
        let step = Step { rate: followed, stiffness, dashpot, limit, dt };
        let mut response = rules.advance(&step, history, &InPlane { rotation: self.rotation, turn: &turn, negligible });
        if quarter {
            response.force = direction.cross(&response.force);
        }
        let mut state = MomentState::of(&response);
        // Work on spins that the spring does not see: none in native laws.
        state.losses.carried -= response.force.dot(&(super::relative_spin(contact) - rate)) * dt;
        state
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
        fn the_moment_keeps_its_cap_resists_and_leaves_the_twist_alone(
            x in -9.0..9.0f64, y in -9.0..9.0f64, z in -9.0..9.0f64, steps in 1..400u32,
        ) {
            let (contact, normal, tangential) = probe(Vector::new(x, y, z));
            let limit = contact.pair.rolling_friction * normal.force * contact.pair.effective_radius;
            let law = ElasticPlasticRolling::plain();
            let mut history = Memory::default();
            for _ in 0..steps {
                let state = law.evaluate(&contact, &normal, &tangential, 1e-4, &mut history);
                prop_assert!(state.moment.norm() <= limit * (1.0 + 1e-12));
                prop_assert!(state.moment.dot(&contact.angular_i) <= 0.0);
                prop_assert!(state.moment.x.abs() <= 1e-3 * limit);
                prop_assert!(state.losses.rolling >= 0.0);
            }
        }
    }
}
