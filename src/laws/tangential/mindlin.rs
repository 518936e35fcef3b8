//! Mindlin's no-slip stiffness with a Coulomb cap, incremental, without partial slip.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | a | contact radius | m |
//! | G*, m* | effective shear modulus and mass | Pa, kg |
//! | k = 8 G* a | tangential stiffness | N/m |
//! | g | dashpot constant, see [`Dashpot`] | kg/s |
//! | u, mu | slip velocity, coefficient of friction | m/s, - |
//!
//! Force on i: e - g u with de = -k u dt, capped at mu times what [`super::options::Friction`] says. Rules of the spring:
//! [`crate::laws::slider`]; of its rotation: [`crate::laws::rotation`].
//!
//! Valid for like solids (or one incompressible) whose micro-slip is small. Sources: Mindlin, Deresiewicz, *J. Appl.
//! Mech.* 20 (1953) 327; Thornton, Cummins, Cleary, *Powder Technology* 210 (2011) 189 for the rescaling; Tsuji, Tanaka,
//! Ishida, *Powder Technology* 71 (1992) 239 for the dashpot.
//!
//! Plain options: frame indifferent, action = reaction with angular momentum, Coulomb cap, no energy gained, a wall is
//! the limit of a large sphere. Mirrors break what [`super::options`] says they do.
//!
//! | code | words |
//! |---|---|
//! | LIGGGHTS | `model hertz tangential history` |
//! | YADE | `Law2_ScGeom_MindlinPhys_Mindlin`, betas |
//! | LAMMPS | `tangential mindlin KT XT mu`, `mindlin/force`, `mindlin_rescale/force` |

use crate::laws::slider::Memory;
use crate::laws::{Contact, NormalState, PairLaw, TangentialLaw, TangentialState};

use super::options::{Choices, CriticalShare, Dashpot, DashpotRule, Plain};

/// The law; its values come with each pair.
#[derive(Clone, Copy, Debug)]
pub struct Mindlin<C, D = Dashpot> {
    /// Where options come from.
    pub choices: C,
    /// Dashpot constant.
    pub dashpot: D,
}

impl Mindlin<Plain, CriticalShare> {
    /// The native law.
    #[must_use]
    pub const fn plain() -> Self {
        Self { choices: Plain, dashpot: CriticalShare }
    }
}

impl Dashpot {
    /// The constant [kg/s] beside a tangential stiffness [N/m].
    #[inline(always)]
    pub(super) fn constant(self, stiffness: f64, pair: &PairLaw, normal: &NormalState) -> f64 {
        match self {
            Self::CriticalShare => {
                2.0 * (5.0f64 / 6.0).sqrt() * pair.damping_ratio * (stiffness * pair.effective_mass).sqrt()
            }
            Self::NormalShare { ratio } => ratio * normal.dashpot,
            Self::Constant { value } => value,
        }
    }
}

impl<C: Choices, D: DashpotRule> TangentialLaw for Mindlin<C, D> {
    type History = Memory;
    const BATCHED: bool = C::FIXED && D::FIXED;

    #[inline(always)]
    fn evaluate(&self, contact: &Contact, normal: &NormalState, dt: f64, history: &mut Memory) -> TangentialState {
        let stiffness = 8.0 * contact.pair.effective_shear * normal.contact_radius;
        let dashpot = self.dashpot.rule().constant(stiffness, &contact.pair, normal);
        super::spring(contact, normal, &self.choices.options(), [stiffness, dashpot], dt, history)
    }
}
