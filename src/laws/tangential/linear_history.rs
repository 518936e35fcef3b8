//! Linear tangential spring and dashpot with a Coulomb cap.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | k = ratio times the normal stiffness | tangential stiffness | N/m |
//! | g | dashpot constant | kg/s |
//! | u, mu | slip velocity, coefficient of friction | m/s, - |
//!
//! Force on i: e - g u with de = -k u dt, capped at mu times what [`super::options::Friction`] says. With the constant
//! stiffness of [`crate::laws::normal::linear_spring_dashpot`] displacement and force histories are the same.
//!
//! Source: Cundall, Strack, *Geotechnique* 29 (1979) 47. Invariants as [`super::mindlin`].
//!
//! | code | words |
//! |---|---|
//! | LIGGGHTS | `model hooke/stiffness tangential history absolute_damping on`, kt, `gammat_abs` |
//! | YADE | `ViscElMat` ks = 2 k, cs = 2 g |
//! | LAMMPS | `tangential linear_history k g/gn mu` with `damping velocity` |

use crate::laws::slider::{Increment, Memory};
use crate::laws::{Contact, NormalState, TangentialLaw, TangentialState};

use super::options::{Choices, Dashpot, Options};

/// The law.
#[derive(Clone, Copy, Debug)]
pub struct LinearHistory<C> {
    /// Tangential stiffness as a share of the normal stiffness [-].
    pub stiffness_ratio: f64,
    /// Dashpot constant.
    pub dashpot: Dashpot,
    /// Where options come from.
    pub choices: C,
}

impl<C: Choices> TangentialLaw for LinearHistory<C> {
    type History = Memory;

    #[inline(always)]
    fn evaluate(&self, contact: &Contact, normal: &NormalState, dt: f64, history: &mut Memory) -> TangentialState {
        let stiffness = self.stiffness_ratio * normal.tangent_stiffness;
        let dashpot = self.dashpot.constant(stiffness, &contact.pair, normal);
        // A constant stiffness has no mean to take, not even in the first step.
        let options = Options { increment: Increment::Present, ..self.choices.options() };
        super::spring(contact, normal, &options, [stiffness, dashpot], dt, history)
    }
}
