//! Long-time sintering: a hysteretic linear contact whose loading stiffness follows temperature and time.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | d, v | overlap, normal velocity (positive when approaching) | m, m/s |
//! | m | largest overlap that the contact remembers | m |
//! | k1, k2, kc | loading stiffness when cold, largest unloading stiffness, cohesive stiffness when cold | N/m |
//! | k1(T), k1(T,t) | loading stiffness that the temperature asks for, and the one that time has brought | N/m |
//! | K(m) | unloading stiffness, [`Branches::stiffness`] between k1 and k2 at l | N/m |
//! | `d_f`, l = k2 `d_f` / (k2 - k1) | fluid overlap, overlap of the largest stiffness | m |
//! | `d0` = (1 - k1(T,t)/K) m | plastic offset, at most `d_f` | m |
//! | c = kc/k2 k1(T,t)/k1 | kc(T,t,m) / K(m), 0 where the pair may not pull | - |
//! | T, `T_m`, dT | temperature, melting temperature, width of the melting range | K |
//! | `t_0` | relaxation time | s |
//! | g | dashpot constant | kg/s |
//!
//! Elastic force, the equations' numbers are the paper's: where (1 - k1(T,t)/K) m reaches `d_f` (7), K (d - `d_f`), and
//! m stays; elsewhere (4) K (d - d0), but at most k1(T,t) d (loading, m = d). Either is at least -c K d (13), where m
//! falls to that of the branch through d. F adds g v (5), unless the sliding rule acts.
//!
//! k1(T) = k1/2 (1 + tanh((`T_m` - T)/dT)) (10); dk1(T,t)/dt = y abs(y) / (k1(T) `t_0`), y = k1(T) - k1(T,t) (12), whose
//! exact step for a constant k1(T) is y / (1 + abs(y) dt / (k1(T) `t_0`)); while T falls, k1(T,t) that is below k1(T) is k1(T)
//! at once. Heating leaves m; cooling raises it at "constant d0":
//!
//! | cooling | m becomes |
//! |---|---|
//! | `lagged` (plain) | d0 / (1 - k1(T,t)/K) with the d0 and K of the last step: d0 grows, since K does. Below l, (k1 - k1(T,t)) m + (k2 - k1)/l m^2/2 stays in the limit of small steps |
//! | `implicit` | the m of d0: d0 stays exactly |
//!
//! Friction sees F without g v plus the pull-off force (14, 15), (K - k1(T,t)) m c / (1 + c), and its coefficient may
//! soften as k1(T,t)/k1 (24). The sliding rule lets a sliding contact not pull: `cut` makes its force 0, `brittle` lowers m
//! to the branch that is 0 at d, too.
//!
//! Source: Luding, Manetsberger, Mueller, *J. Mech. Phys. Solids* 53 (2005) 455. Choices where it is silent: the branch of the
//! fluid comes first; K starts from the cold k1; d0 is clamped; the dashpot does not enter friction. Valid for
//! 0 < k1(T,t) <= k1 < k2. Invariants: action = reaction, no energy gained on a closed path at constant k1(T,t). Not
//! [`super::luding_hysteretic`] when cold: its cohesion grows with K.

use serde::{Deserialize, Serialize};

use crate::error::Problem;
use crate::laws::registry::within;
use crate::laws::{Approach, NormalLaw, NormalState, PairLaw, Surroundings};

use super::hysteretic_branches::Branches;

/// How the largest overlap follows a stiffening contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Cooling {
    /// With the stiffness of the last step.
    Lagged,
    /// At an offset that stays.
    Implicit,
}

/// What sliding does to cohesion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sliding {
    /// Nothing.
    Off,
    /// A sliding contact does not pull.
    Cut,
    /// Nor does it remember more than a contact without cohesion.
    Brittle,
}

/// The law.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LudingSintering {
    /// k1 [N/m].
    pub k1: f64,
    /// k2 [N/m].
    pub k2: f64,
    /// kc [N/m].
    pub kc: f64,
    /// Fluid overlap [m].
    pub fluid_overlap: f64,
    /// Dashpot constant [kg/s].
    pub dashpot: f64,
    /// Melting temperature [K].
    pub melting_temperature: f64,
    /// Width of the melting range [K].
    pub melting_range: f64,
    /// Relaxation time until a stage sets another one [s].
    pub relaxation_time: f64,
    /// How the largest overlap follows a stiffening contact.
    pub cooling: Cooling,
    /// What sliding does to cohesion.
    pub sliding: Sliding,
}

/// The law whose sliding contacts forget: the sliding rule `brittle`.
#[derive(Clone, Copy, Debug)]
pub struct Brittle(pub LudingSintering);

impl LudingSintering {
    /// Refuses values outside the range of the law.
    ///
    /// # Errors
    /// The first such value: key, value, range.
    pub fn check(&self) -> Result<(), Problem> {
        let Self { k1, k2, kc, fluid_overlap, dashpot, melting_temperature, melting_range, relaxation_time, .. } =
            *self;
        within("model.normal.k1", k1, k1 > 0.0, "above 0 N/m")?;
        within("model.normal.k2", k2, k2 > k1, "above k1")?;
        within("model.normal.kc", kc, kc >= 0.0, "at least 0 N/m")?;
        within("model.normal.fluid_overlap", fluid_overlap, fluid_overlap > 0.0, "above 0 m")?;
        within("model.normal.dashpot", dashpot, dashpot >= 0.0, "at least 0 kg/s")?;
        within("model.normal.melting_temperature", melting_temperature, melting_temperature > 0.0, "above 0 K")?;
        within("model.normal.melting_range", melting_range, melting_range > 0.0, "above 0 K")?;
        within("model.normal.relaxation_time", relaxation_time, relaxation_time > 0.0, "above 0 s")
    }

    /// k1, k2, kc and l.
    #[must_use]
    #[inline(always)]
    pub fn branches(&self) -> Branches {
        let limit = self.k2 / (self.k2 - self.k1) * self.fluid_overlap;
        Branches { loading: self.k1, unloading: self.k2, cohesive: self.kc, limit }
    }

    /// k1(T): the loading stiffness that a temperature [K] asks for [N/m].
    #[must_use]
    pub fn softened(&self, temperature: f64) -> f64 {
        let depth = (self.melting_temperature - temperature) / self.melting_range;
        0.5 * self.k1 * (1.0 + libm::tanh(depth))
    }

    /// k1(T,t) a step `dt` [s] after it was `now` [N/m].
    #[must_use]
    pub fn relaxed(&self, now: f64, surroundings: &Surroundings, dt: f64) -> f64 {
        let target = self.softened(surroundings.temperature);
        if surroundings.temperature < surroundings.temperature_before && target > now {
            return target;
        }
        let distance = target - now;
        let time = surroundings.relaxation_time.unwrap_or(self.relaxation_time);
        target - distance / (1.0 + distance.abs() * dt / (target * time))
    }

    /// (1 - k1(T,t)/K) m, the plastic offset where the contact is not fluid [m].
    #[must_use]
    #[inline(always)]
    pub fn offset(&self, largest: f64, loading: f64) -> f64 {
        (1.0 - loading / self.branches().stiffness(largest)) * largest
    }

    /// The largest overlap [m] whose plastic offset is `offset` [m] at the loading stiffness `loading` [N/m]:
    /// m (1 - loading / K(m)) = offset.
    #[must_use]
    #[inline(always)]
    pub fn largest(&self, offset: f64, loading: f64) -> f64 {
        let Branches { loading: cold, unloading, limit, .. } = self.branches();
        let slope = (unloading - cold) / limit;
        // slope m^2 + linear m = offset cold.
        let linear = cold - loading - offset * slope;
        let root = (linear * linear + 4.0 * slope * offset * cold).sqrt();
        // Divisors that all contacts share stand by themselves: they are divided by once.
        let (halved, softer) = (1.0 / (2.0 * slope), 1.0 / (1.0 - loading / unloading));
        let below = if linear > 0.0 { 2.0 * offset * cold / (linear + root) } else { (root - linear) * halved };
        if below < limit { below } else { offset * softer }
    }

    /// The largest overlap [m] when the loading stiffness rises from `before` to `now` [N/m].
    #[must_use]
    #[inline(always)]
    pub fn cooled(&self, largest: f64, before: f64, now: f64) -> f64 {
        let stiffness = self.branches().stiffness(largest);
        let offset = self.offset(largest, before).min(self.fluid_overlap);
        let grown = match self.cooling {
            // A new contact, whose K is the cold k1, has no offset to keep.
            Cooling::Lagged if now < stiffness => offset / (1.0 - now / stiffness),
            Cooling::Lagged => largest,
            Cooling::Implicit => self.largest(offset, now),
        };
        grown.max(largest)
    }
}

impl NormalLaw for LudingSintering {
    /// Largest overlap.
    type History = f64;
    /// k1(T,t) now and one step ago.
    type Shared = (f64, f64);
    const BATCHED: bool = true;
    const SHARED: &'static [(&'static str, &'static str)] =
        &[("loading_stiffness", "N/m"), ("loading_stiffness_before", "N/m")];

    fn advance(&self, shared: &mut Self::Shared, surroundings: &Surroundings, dt: f64) {
        let (now, _) = *shared;
        *shared = if now > 0.0 {
            (self.relaxed(now, surroundings, dt), now)
        } else {
            let first = self.softened(surroundings.temperature);
            (first, first)
        };
    }

    #[inline(always)]
    fn renews(&self, &(loading, before): &Self::Shared) -> bool {
        loading > before
    }

    #[inline(always)]
    fn renew(&self, &(loading, before): &Self::Shared, history: &mut f64) {
        *history = self.cooled(*history, before, loading);
    }

    #[inline(always)]
    fn evaluate(
        &self,
        pair: &PairLaw,
        approach: &Approach,
        &(loading, _): &Self::Shared,
        history: &mut f64,
    ) -> NormalState {
        let (cold, branches) = (self.k1, self.branches());
        let overlap = approach.overlap;
        let share = loading / cold;
        let cohesion = if pair.cohesive { self.kc / self.k2 * share } else { 0.0 };
        // All branches are evaluated and one is chosen, so that several contacts are at a time.
        let known = branches.stiffness(*history);
        let offset = self.offset(*history, loading);
        let line = known * (overlap - offset.min(self.fluid_overlap));
        let loads = (offset < self.fluid_overlap) & (line >= loading * overlap);
        let holds = line > -cohesion * known * overlap;
        let fallen = self.largest((1.0 + cohesion) * overlap, loading);
        let unloaded = if holds { *history } else { fallen };
        *history = if loads { overlap } else { unloaded };
        let stiffness = branches.stiffness(*history);
        let pulled = if holds { line } else { -cohesion * stiffness * overlap };
        let elastic = if loads { loading * overlap } else { pulled };
        let pull_off = (stiffness - loading) * *history * (cohesion / (1.0 + cohesion));
        NormalState {
            force: elastic + self.dashpot * approach.normal_velocity,
            elastic,
            repulsive: elastic + pull_off,
            dashpot: self.dashpot,
            pull_off,
            contact_radius: 0.0,
            tangent_stiffness: stiffness,
            energy: 0.5 * elastic * elastic / stiffness,
            plastic: 0.0,
            friction_share: share,
        }
    }

    #[inline(always)]
    fn finish(&self, state: NormalState, sliding: bool, _: f64, _: &Self::Shared, _: &mut f64) -> NormalState {
        let breaks = (self.sliding != Sliding::Off) & sliding & (state.elastic < 0.0);
        let choose = |value: f64| if breaks { 0.0 } else { value };
        NormalState { force: choose(state.force), elastic: choose(state.elastic), ..state }
    }
}

impl NormalLaw for Brittle {
    type History = f64;
    type Shared = (f64, f64);
    const BATCHED: bool = true;
    const SHARED: &'static [(&'static str, &'static str)] = LudingSintering::SHARED;

    fn advance(&self, shared: &mut Self::Shared, surroundings: &Surroundings, dt: f64) {
        self.0.advance(shared, surroundings, dt);
    }

    #[inline(always)]
    fn renews(&self, shared: &Self::Shared) -> bool {
        self.0.renews(shared)
    }

    #[inline(always)]
    fn renew(&self, shared: &Self::Shared, history: &mut f64) {
        self.0.renew(shared, history);
    }

    #[inline(always)]
    fn evaluate(&self, pair: &PairLaw, approach: &Approach, shared: &Self::Shared, history: &mut f64) -> NormalState {
        self.0.evaluate(pair, approach, shared, history)
    }

    #[inline(always)]
    fn finish(
        &self,
        state: NormalState,
        sliding: bool,
        overlap: f64,
        shared: &Self::Shared,
        history: &mut f64,
    ) -> NormalState {
        let forgets = sliding & (state.elastic < 0.0);
        let fallen = self.0.largest(overlap, shared.0);
        *history = if forgets { fallen } else { *history };
        self.0.finish(state, sliding, overlap, shared, history)
    }
}
