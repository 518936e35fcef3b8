//! Rolling resistance of constant size (directional constant torque).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | w, `w_r` | relative spin wi - wj, its part across the normal | rad/s |
//! | `F_e` | elastic normal force | N |
//! | `mu_r`, R* | coefficient of rolling friction, effective radius | -, m |
//!
//! Moment on i: -`mu_r` `F_e` R* `w_r` / abs(`w_r`), zero without spin. The moment jumps where the spin changes sign, so a
//! sphere never comes to rest on a slope: use [`super::elastic_plastic_rolling`] there.
//!
//! Source: Ai, Chen, Rotter, Ooi, *Powder Technology* 206 (2011) 269, type A. Invariants: frame indifferent, action =
//! reaction, no energy gained, a wall is the limit of a large sphere.
//!
//! | code | words |
//! |---|---|
//! | LIGGGHTS | `rolling_friction cdt`; w is normalised with its part along the normal, which is then dropped, or kept with `torsionTorque on` |
//! | YADE, LAMMPS | none |

use serde::{Deserialize, Serialize};

use crate::Vector;
use crate::laws::{Contact, Losses, MomentLaw, MomentState, NormalState, TangentialState};

/// What the torque opposes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Opposed {
    /// Rolling, at full size.
    Rolling,
    /// The whole spin, of whose torque the part along the normal is dropped (LIGGGHTS).
    RollingShare,
    /// The whole spin (LIGGGHTS, `torsionTorque on`).
    WholeSpin,
}

/// The law; the coefficient comes with each pair.
#[derive(Clone, Copy, Debug)]
pub struct ConstantTorque {
    /// What the torque opposes.
    pub opposed: Opposed,
}

impl MomentLaw for ConstantTorque {
    type History = ();

    #[inline(always)]
    fn evaluate(
        &self,
        contact: &Contact,
        normal: &NormalState,
        _: &TangentialState,
        dt: f64,
        (): &mut (),
    ) -> MomentState {
        let direction = contact.geometry.normal;
        let across = |spin: &Vector| spin - direction * spin.dot(&direction);
        let spin = match self.opposed {
            Opposed::Rolling => across(&super::relative_spin(contact)),
            _ => super::liggghts_spin(contact),
        };
        let size = contact.pair.rolling_friction * normal.elastic * contact.pair.effective_radius;
        let speed = spin.norm();
        let whole = if speed > 0.0 { spin * (-size / speed) } else { Vector::zeros() };
        let moment = if self.opposed == Opposed::RollingShare { across(&whole) } else { whole };
        let rolling = -moment.dot(&super::relative_spin(contact)) * dt;
        MomentState { moment, energy: 0.0, losses: Losses { rolling, ..Losses::default() } }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::laws::moments::probe;

    proptest! {
        #[test]
        fn torque_has_its_size_opposes_the_spin_and_dissipates(x in -9.0..9.0f64, y in -9.0..9.0f64, z in -9.0..9.0f64) {
            for opposed in [Opposed::Rolling, Opposed::RollingShare, Opposed::WholeSpin] {
                let (contact, normal, tangential) = probe(Vector::new(x, y, z));
                let state = ConstantTorque { opposed }.evaluate(&contact, &normal, &tangential, 1e-6, &mut ());
                let size = contact.pair.rolling_friction * normal.elastic * contact.pair.effective_radius;
                prop_assert!(state.losses.rolling >= 0.0);
                prop_assert!(state.moment.norm() <= size * (1.0 + 1e-14));
                if opposed == Opposed::Rolling {
                    prop_assert!((state.moment.norm() / size - 1.0).abs() < 1e-12);
                    prop_assert!(state.moment.x.abs() < 1e-14 * size);
                }
            }
        }
    }

    #[test]
    fn no_spin_no_torque() {
        let (contact, normal, tangential) = probe(Vector::zeros());
        let law = ConstantTorque { opposed: Opposed::Rolling };
        assert_eq!(law.evaluate(&contact, &normal, &tangential, 1e-6, &mut ()).moment, Vector::zeros());
    }
}
