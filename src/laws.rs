//! Contact laws and their composition.
//!
//! A contact model is composed of a normal, a tangential and a moment law and monomorphised for the listed
//! combinations ([`model`]). Every formula stands once, in its law's file; sphere-sphere contacts, bodies, and output
//! all come through the same [`model::ContactModel::evaluate`].

#![allow(clippy::inline_always, reason = "contacts are evaluated several at a time only where all laws are inlined")]

pub mod any;
pub mod drive;
pub mod memory;
pub mod mirror;
pub mod model;
pub mod moments;
pub mod normal;
pub mod registry;
pub mod rotation;
pub mod slider;
pub mod tangential;

use crate::Vector;
use crate::geometry::{ContactGeometry, Surface};
use memory::Memory;

/// What a law knows of its pair: mixed material values and the geometry of the two bodies. Values that the pair does not
/// state are zero.
#[derive(Clone, Copy, Debug, Default)]
pub struct PairLaw {
    /// E* [Pa].
    pub effective_young: f64,
    /// G* [Pa]; zero where the pair states none.
    pub effective_shear: f64,
    /// Coefficient of friction [-]; zero where the pair states none.
    pub friction: f64,
    /// R* [m].
    pub effective_radius: f64,
    /// m* [kg]; the mass of the particle at a body.
    pub effective_mass: f64,
    /// Fraction of critical damping [-].
    pub damping_ratio: f64,
    /// Coefficient of rolling friction [-].
    pub rolling_friction: f64,
    /// Coefficient of twisting friction [-].
    pub twisting_friction: f64,
    /// Work of adhesion W, twice the surface energy of like solids [J/m2].
    pub work_of_adhesion: f64,
    /// Whether the contact may pull, for laws whose cohesion is a value of the model.
    pub cohesive: bool,
}

/// What acts on all contacts alike.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Surroundings {
    /// Temperature of the particles [K]; zero where the case states none.
    pub temperature: f64,
    /// The same one step ago [K].
    pub temperature_before: f64,
    /// Relaxation time that a stage has set [s].
    pub relaxation_time: Option<f64>,
}

/// Normal kinematics of a contact.
#[derive(Clone, Copy, Debug)]
pub struct Approach {
    /// Overlap, positive in contact [m].
    pub overlap: f64,
    /// Normal velocity, positive when approaching [m/s].
    pub normal_velocity: f64,
    /// Radii of i and j as [`ContactGeometry`] has them [m].
    pub radii: [f64; 2],
    /// Whether j is a body and not a particle.
    pub at_body: bool,
}

/// What a normal law hands to the laws after it and to the ledger.
#[derive(Clone, Copy, Debug, Default)]
pub struct NormalState {
    /// Total normal force, positive when it repels [N].
    pub force: f64,
    /// Its part that is stored [N]; the rest is dissipated.
    pub elastic: f64,
    /// The total force without the attraction of adhesion, which friction may see [N].
    pub repulsive: f64,
    /// Dashpot constant [kg/s].
    pub dashpot: f64,
    /// Size of the most attractive force of the contact [N].
    pub pull_off: f64,
    /// Radius of the contact spot [m].
    pub contact_radius: f64,
    /// Slope of the elastic force on loading [N/m].
    pub tangent_stiffness: f64,
    /// Stored energy, zero without contact; negative where adhesion outweighs [J].
    pub energy: f64,
    /// Energy dissipated by plastic flow since the last evaluation [J].
    pub plastic: f64,
    /// Share of the pair's coefficient of friction that is left: below 1 where heat softens it [-].
    pub friction_share: f64,
}

/// Energies that the springs of a contact lost over one step, each as its law defines it [J].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Losses {
    /// To dashpots in the contact plane and of moments.
    pub viscous: f64,
    /// To sliding.
    pub frictional: f64,
    /// To rolling and twisting beyond the cap.
    pub rolling: f64,
    /// To plastic flow along the normal.
    pub plastic: f64,
    /// To the change of a loaded spring: its stiffness follows the overlap, and it turns with the contact. Micro-slip in
    /// plain laws, where it is never negative; an artefact of either sign in laws that mirror other codes, with the work of
    /// forces and moments on motions that their springs do not see.
    pub carried: f64,
}

impl std::ops::Add for Losses {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            viscous: self.viscous + other.viscous,
            frictional: self.frictional + other.frictional,
            rolling: self.rolling + other.rolling,
            plastic: self.plastic + other.plastic,
            carried: self.carried + other.carried,
        }
    }
}

/// A law of the force along the normal.
pub trait NormalLaw: Copy + Send + Sync {
    /// What one contact remembers; a new contact starts with the default.
    type History: Memory;
    /// What all contacts share (a stiffness that ages, a temperature): it advances once per step and keeps what it was
    /// before, because a contact may need both.
    type Shared: Memory;
    /// Whether the law chooses by value and not by branch, so that a loop over contacts is vectorised and a contact that
    /// does not live may be evaluated beside others.
    const BATCHED: bool = false;

    /// What the numbers of the shared state are, for records: names with units, in the order of [`Memory::save`].
    const SHARED: &'static [(&'static str, &'static str)] = &[];

    /// Advances the shared state by `dt` [s] to the present surroundings.
    fn advance(&self, _shared: &mut Self::Shared, _surroundings: &Surroundings, _dt: f64) {}

    /// Whether the shared state changed so that memories have to follow: one answer for all contacts.
    #[inline(always)]
    fn renews(&self, _shared: &Self::Shared) -> bool {
        false
    }

    /// Lets a memory follow the shared state, before the force of a step in which it renews.
    #[inline(always)]
    fn renew(&self, _shared: &Self::Shared, _history: &mut Self::History) {}

    /// The force at a contact that is alive.
    fn evaluate(
        &self,
        pair: &PairLaw,
        approach: &Approach,
        shared: &Self::Shared,
        history: &mut Self::History,
    ) -> NormalState;

    /// Lets the tangential force act back on the normal force: laws whose sliding contacts do not pull override it.
    #[inline(always)]
    fn finish(
        &self,
        state: NormalState,
        _sliding: bool,
        _overlap: f64,
        _shared: &Self::Shared,
        _history: &mut Self::History,
    ) -> NormalState {
        state
    }

    /// Whether a contact lives at `overlap` [m]; laws that act across a gap override it.
    #[inline(always)]
    fn alive(&self, overlap: f64, _history: &Self::History) -> bool {
        overlap > 0.0
    }

    /// Largest gap across which the law acts [m].
    fn reach(&self) -> f64 {
        0.0
    }
}

/// Force in the contact plane and the points where it acts.
#[derive(Clone, Copy, Debug)]
pub struct TangentialState {
    /// Force on i [N].
    pub force: Vector,
    /// Whether the contact slides.
    pub sliding: bool,
    /// Largest force that friction allows [N].
    pub limit: f64,
    /// Lever arms from the two centres to the contact [m]; the law owns them.
    pub arms: [f64; 2],
    /// Stiffness in the contact plane [N/m].
    pub stiffness: f64,
    /// Dashpot constant in the contact plane [kg/s].
    pub dashpot: f64,
    /// Stored energy [J].
    pub energy: f64,
    /// Losses of the step.
    pub losses: Losses,
}

/// Moments and what stands behind them.
#[derive(Clone, Copy, Debug)]
pub struct MomentState {
    /// Moment on i; its opposite acts on j [N m].
    pub moment: Vector,
    /// Stored energy [J].
    pub energy: f64,
    /// Losses of the step.
    pub losses: Losses,
}

/// A law of the force in the contact plane.
pub trait TangentialLaw: Copy + Send + Sync {
    /// What one contact remembers.
    type History: Memory;
    /// See [`NormalLaw::BATCHED`].
    const BATCHED: bool = false;

    /// The force at a contact over a step `dt` [s].
    fn evaluate(
        &self,
        contact: &Contact,
        normal: &NormalState,
        dt: f64,
        history: &mut Self::History,
    ) -> TangentialState;
}

/// A law of rolling and twisting moments.
pub trait MomentLaw: Copy + Send + Sync {
    /// What one contact remembers.
    type History: Memory;
    /// See [`NormalLaw::BATCHED`].
    const BATCHED: bool = false;

    /// The moment over a step `dt` [s].
    fn evaluate(
        &self,
        contact: &Contact,
        normal: &NormalState,
        tangential: &TangentialState,
        dt: f64,
        history: &mut Self::History,
    ) -> MomentState;
}

/// Everything a law may know of a contact.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// Mixed values.
    pub pair: PairLaw,
    /// Where the two bodies touch.
    pub geometry: ContactGeometry,
    /// Velocity of the centre of i less that of j [m/s].
    pub velocity: Vector,
    /// Angular velocity of i [rad/s].
    pub angular_i: Vector,
    /// Angular velocity of j [rad/s].
    pub angular_j: Vector,
    /// Masses of i and j, infinite for a body [kg].
    pub masses: [f64; 2],
}

impl Contact {
    /// Overlap and normal velocity.
    #[must_use]
    #[inline(always)]
    pub fn approach(&self) -> Approach {
        Approach {
            overlap: self.geometry.overlap,
            normal_velocity: -self.velocity.dot(&self.geometry.normal),
            radii: [self.geometry.radius_i, self.geometry.radius_j],
            at_body: self.at_body(),
        }
    }

    /// Whether j is a body and not a particle.
    #[must_use]
    #[inline(always)]
    pub fn at_body(&self) -> bool {
        !matches!(self.geometry.surface, Surface::Sphere)
    }
}
