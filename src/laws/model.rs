//! Composition of laws into a contact model: normal, then tangential, then moments, then finish.

use crate::Vector;

use super::memory::Memory;
use super::{
    Contact, Losses, MomentLaw, MomentState, NormalLaw, NormalState, Surroundings, TangentialLaw, TangentialState,
};

/// Force and moments of one contact.
#[derive(Clone, Copy, Debug)]
pub struct Action {
    /// Force on i [N]; its opposite acts on j.
    pub force: Vector,
    /// Torque on i [N m].
    pub torque_i: Vector,
    /// Torque on j [N m].
    pub torque_j: Vector,
    /// The normal state behind the force.
    pub normal: NormalState,
    /// Largest force in the contact plane that friction allows [N].
    pub friction_limit: f64,
    /// Energy stored in the contact plane and in moments [J].
    pub springs: f64,
    /// Losses of the step, but for the dashpot along the normal.
    pub losses: Losses,
}

/// A composed model: the only thing that the sweep over contacts calls.
pub trait ContactModel: Copy + Send + Sync {
    /// What one contact remembers.
    type History: Memory;
    /// What all contacts share.
    type Shared: Memory;
    /// Whether contacts are evaluated several at a time, see [`NormalLaw::BATCHED`].
    const BATCHED: bool;

    /// See [`NormalLaw::SHARED`].
    const SHARED: &'static [(&'static str, &'static str)];

    /// Advances the shared state by `dt` [s] to the present surroundings.
    fn advance(&self, shared: &mut Self::Shared, surroundings: &Surroundings, dt: f64);

    /// Whether a contact lives at `overlap` [m].
    fn alive(&self, overlap: f64, history: &Self::History) -> bool;

    /// Largest gap across which the model acts [m].
    fn reach(&self) -> f64;

    /// See [`NormalLaw::renews`].
    fn renews(&self, shared: &Self::Shared) -> bool;

    /// See [`NormalLaw::renew`].
    fn renew(&self, shared: &Self::Shared, history: &mut Self::History);

    /// Force and moments of a living contact over a step `dt` [s], whose memory was renewed.
    fn act(&self, contact: &Contact, shared: &Self::Shared, dt: f64, history: &mut Self::History) -> Action;

    /// Renews the memory of a living contact where needed; force and moments over a step `dt` [s].
    #[inline(always)]
    fn evaluate(&self, contact: &Contact, shared: &Self::Shared, dt: f64, history: &mut Self::History) -> Action {
        if self.renews(shared) {
            self.renew(shared, history);
        }
        self.act(contact, shared, dt, history)
    }
}

/// Three laws that make a model.
#[derive(Clone, Copy, Debug)]
pub struct Composed<N, T, M> {
    /// Force along the normal.
    pub normal: N,
    /// Force in the contact plane.
    pub tangential: T,
    /// Moments.
    pub moments: M,
}

impl<N: NormalLaw, T: TangentialLaw, M: MomentLaw> ContactModel for Composed<N, T, M> {
    type History = (N::History, T::History, M::History);
    type Shared = N::Shared;
    const BATCHED: bool = N::BATCHED && T::BATCHED && M::BATCHED;

    const SHARED: &'static [(&'static str, &'static str)] = N::SHARED;

    fn advance(&self, shared: &mut Self::Shared, surroundings: &Surroundings, dt: f64) {
        self.normal.advance(shared, surroundings, dt);
    }

    #[inline(always)]
    fn alive(&self, overlap: f64, history: &Self::History) -> bool {
        self.normal.alive(overlap, &history.0)
    }

    fn reach(&self) -> f64 {
        self.normal.reach()
    }

    #[inline(always)]
    fn renews(&self, shared: &Self::Shared) -> bool {
        self.normal.renews(shared)
    }

    #[inline(always)]
    fn renew(&self, shared: &Self::Shared, history: &mut Self::History) {
        self.normal.renew(shared, &mut history.0);
    }

    #[inline(always)]
    fn act(&self, contact: &Contact, shared: &Self::Shared, dt: f64, history: &mut Self::History) -> Action {
        let normal = self.normal.evaluate(&contact.pair, &contact.approach(), shared, &mut history.0);
        let tangential = self.tangential.evaluate(contact, &normal, dt, &mut history.1);
        let moments = self.moments.evaluate(contact, &normal, &tangential, dt, &mut history.2);
        let overlap = contact.geometry.overlap;
        let normal = self.normal.finish(normal, tangential.sliding, overlap, shared, &mut history.0);
        let direction = contact.geometry.normal;
        let [arm_i, arm_j] = tangential.arms;
        // The contact lies at -arm_i n from i and at +arm_j n from j; j feels the opposite force.
        let twist = direction.cross(&tangential.force);
        Action {
            force: direction * normal.force + tangential.force,
            torque_i: moments.moment - twist * arm_i,
            torque_j: -moments.moment - twist * arm_j,
            normal,
            friction_limit: tangential.limit,
            springs: tangential.energy + moments.energy,
            losses: tangential.losses + moments.losses + Losses { plastic: normal.plastic, ..Losses::default() },
        }
    }
}

/// No force in the contact plane.
#[derive(Clone, Copy, Debug)]
pub struct Frictionless;

impl TangentialLaw for Frictionless {
    type History = ();
    const BATCHED: bool = true;

    #[inline(always)]
    fn evaluate(&self, _: &Contact, _: &NormalState, _: f64, (): &mut ()) -> TangentialState {
        TangentialState {
            force: Vector::zeros(),
            sliding: false,
            limit: 0.0,
            arms: [0.0; 2],
            stiffness: 0.0,
            dashpot: 0.0,
            energy: 0.0,
            losses: Losses::default(),
        }
    }
}

/// No moments.
#[derive(Clone, Copy, Debug)]
pub struct Free;

impl MomentLaw for Free {
    type History = ();
    const BATCHED: bool = true;

    #[inline(always)]
    fn evaluate(&self, _: &Contact, _: &NormalState, _: &TangentialState, _: f64, (): &mut ()) -> MomentState {
        MomentState { moment: Vector::zeros(), energy: 0.0, losses: Losses::default() }
    }
}
