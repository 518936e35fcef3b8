//! A spring and a dashpot behind a slider: the body that tangential, rolling and twisting laws share.
//!
//! | symbol | meaning | unit (tangential; moments in brackets) |
//! |---|---|---|
//! | u | rate: slip velocity (relative spin) | m/s (rad/s) |
//! | k, g | stiffness, dashpot constant | N/m, kg/s (N m, N m s) |
//! | k0, e0 | stiffness and elastic force of the last step, turned with the contact | |
//! | e, d = -g u | elastic and damping force (moment) on i | N (N m) |
//! | L | limit | N (N m) |
//!
//! Trial: e = -k (s + u dt) from a displacement s, or e = e0 - k u dt from a force; a rescaled force first shrinks to
//! e0 k / k0 where k < k0 (Thornton, Cummins, Cleary, *Powder Technology* 210 (2011) 189). With a mean increment, k of
//! the increment is (k0 + k) / 2 while k grows, which is second order in the step; below, kd.
//!
//! | cap | beyond the limit |
//! |---|---|
//! | total | on e + d: the sum is scaled to L, the damping stays, e = sum - d |
//! | elastic | on e: e is scaled to L and d dropped; below the limit d is added without a cap |
//! | `total_when_stretched` | the same, but an unstretched spring that should slide gives neither force (LAMMPS, at setup) |
//! | `total_along_rate` | on e + d: the sum is -L u / abs(u), e = sum - d (LAMMPS, twisting) |
//!
//! Energies of a step, exact for a linear change of e over the step (mean forces times increments):
//! slider ((e0 + e)/2 + d).(trial - e)/kd; dashpot d.(e - base)/kd, where base is e before the increment; stored
//! e^2 / 2k; carried: -(k - k0) s0.s1 / 2 (displacement), ((1/k0 - 1/kd) e0^2 + (1/kd - 1/k) e^2) / 2 (force),
//! (1 - k/k0) e0.e / 2k (rescaled force, k < k0), and what an inexact rotation adds. A rescaled force never gains.

use serde::{Deserialize, Serialize};

use crate::Vector;

use super::rotation::Rotation;

/// What a spring remembers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum History {
    /// The displacement.
    Displacement,
    /// The force, from increments.
    Force,
    /// The force, from increments, rescaled when the stiffness falls.
    ForceRescaled,
}

/// What comes first in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Order {
    /// The old value turns, then grows.
    RotateFirst,
    /// The value grows, then turns.
    IncrementFirst,
}

/// What the limit holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Cap {
    /// Elastic and damping parts together.
    Total,
    /// The elastic part.
    Elastic,
    /// Both together; nothing acts where the spring is not stretched at all and the dashpot alone passes the limit.
    TotalWhenStretched,
    /// Both together, directed against the rate.
    TotalAlongRate,
}

/// The stiffness of an increment of force.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Increment {
    /// That at the end of the step.
    Present,
    /// The mean over the step while it grows.
    Mean,
}

/// Memory of a spring: its displacement or force, and its stiffness.
pub type Memory = (Vector, f64);

/// Rules of a spring.
#[derive(Clone, Copy, Debug)]
pub struct Rules {
    /// What is remembered.
    pub history: History,
    /// How it turns.
    pub rotation: Rotation,
    /// What comes first.
    pub order: Order,
    /// The stiffness of an increment of force.
    pub increment: Increment,
    /// What the limit holds.
    pub cap: Cap,
}

/// One step of a spring.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// Rate [m/s or rad/s].
    pub rate: Vector,
    /// Stiffness [N/m or N m].
    pub stiffness: f64,
    /// Dashpot constant [kg/s or N m s].
    pub dashpot: f64,
    /// Largest force or moment [N or N m].
    pub limit: f64,
    /// Duration [s].
    pub dt: f64,
}

/// What a spring does.
#[derive(Clone, Copy, Debug)]
pub struct Response {
    /// Force or moment on i [N or N m].
    pub force: Vector,
    /// Whether the slider moved.
    pub sliding: bool,
    /// Stored energy [J].
    pub energy: f64,
    /// Work of the slider [J].
    pub slider: f64,
    /// Work of the dashpot [J].
    pub viscous: f64,
    /// Loss of the carried spring [J].
    pub carried: f64,
}

/// Takes a remembered vector along with its contact. A trait and no closure, so that it is always inlined.
pub trait Carry {
    /// `vector` one step later.
    fn carry(&self, vector: &Vector) -> Vector;
}

impl Rules {
    /// A value and its increment, in the order of the rules.
    #[inline(always)]
    fn grow(self, start: &Vector, stored: &Vector, increment: Vector, turn: &impl Carry) -> Vector {
        match self.order {
            Order::RotateFirst => start + increment,
            Order::IncrementFirst => turn.carry(&(stored + increment)),
        }
    }

    /// Advances `memory` by one step; `turn` takes a vector along with the contact.
    #[inline(always)]
    pub fn advance(&self, step: &Step, memory: &mut Memory, turn: &impl Carry) -> Response {
        let (stored, before) = *memory;
        let turned = turn.carry(&stored);
        let displacement = self.history == History::Displacement;
        let shrink = if self.history == History::ForceRescaled && step.stiffness < before {
            step.stiffness / before
        } else {
            1.0
        };
        let grows = self.increment == Increment::Mean && !displacement && step.stiffness > before;
        let gain = if grows { 0.5 * (before + step.stiffness) } else { step.stiffness };
        // Elastic forces: of the last step, at the start of this one, and with the increment.
        let (last, base, remembered, trial) = if displacement {
            let grown = self.grow(&turned, &stored, step.rate * step.dt, turn);
            (turned * -before, turned * -step.stiffness, grown, grown * -step.stiffness)
        } else {
            let base = turned * shrink;
            let grown = self.grow(&base, &stored, step.rate * (-gain * step.dt), turn);
            (turned, base, grown, grown)
        };
        let dashpot = step.rate * -step.dashpot;
        let tested = if self.cap == Cap::Elastic { trial } else { trial + dashpot };
        let squared = tested.norm_squared();
        let sliding = squared > step.limit * step.limit;
        let direction = match self.cap {
            Cap::TotalAlongRate => step.rate * -(1.0 / step.rate.norm().max(f64::MIN_POSITIVE)),
            _ => tested * (1.0 / squared.sqrt()),
        };
        let unstretched = self.cap == Cap::TotalWhenStretched && remembered.norm_squared() == 0.0;
        let capped = direction * if unstretched { 0.0 } else { step.limit };
        let dropped = sliding && (self.cap == Cap::Elastic || unstretched);
        let damping = choose(dropped, &Vector::zeros(), &dashpot);
        let elastic = choose(sliding, &(capped - damping), &trial);
        let force = choose(sliding, &capped, &(trial + dashpot));
        let inverse = |stiffness: f64| if stiffness > 0.0 { 1.0 / stiffness } else { 0.0 };
        let (softness, yielding) = (inverse(step.stiffness), inverse(gain));
        let slipped = if displacement { elastic * -softness } else { elastic };
        *memory = (choose(sliding, &slipped, &remembered), step.stiffness);
        let lost = (stored.norm_squared() - turned.norm_squared()) * 0.5;
        let carried = if displacement {
            lost * before - 0.5 * (step.stiffness - before) * turned.dot(&(elastic * -softness))
        } else if shrink < 1.0 {
            lost / before + 0.5 * (1.0 - shrink) * turned.dot(&elastic) * softness
        } else {
            let old = inverse(before);
            let spent = (old - yielding) * turned.norm_squared() + (yielding - softness) * elastic.norm_squared();
            lost * old + 0.5 * spent
        };
        Response {
            force,
            sliding,
            energy: 0.5 * elastic.norm_squared() * softness,
            slider: ((last + elastic) * 0.5 + damping).dot(&(trial - elastic)) * yielding,
            viscous: damping.dot(&(elastic - base)) * yielding,
            carried,
        }
    }
}

/// Chosen by value, not by branch, so that contacts can be evaluated several at a time.
#[inline(always)]
fn choose(first: bool, one: &Vector, other: &Vector) -> Vector {
    Vector::new(
        if first { one.x } else { other.x },
        if first { one.y } else { other.y },
        if first { one.z } else { other.z },
    )
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    struct Still;

    impl Carry for Still {
        fn carry(&self, vector: &Vector) -> Vector {
            *vector
        }
    }

    proptest! {
        #[test]
        fn work_is_stored_or_lost_and_native_springs_never_gain(
            steps in proptest::collection::vec((-1.0..1.0f64, -1.0..1.0f64, 0.5..2.0f64, 0.1..1.0f64), 1..60),
        ) {
            for history in [History::Displacement, History::Force, History::ForceRescaled] {
                for (cap, increment) in [(Cap::Total, Increment::Mean), (Cap::Elastic, Increment::Present)] {
                    let order = Order::RotateFirst;
                    let rules = Rules { history, rotation: Rotation::Fixed, order, increment, cap };
                    let mut memory = Memory::default();
                    let (mut work, mut lost, mut energy, mut last) = (0.0, 0.0, 0.0, Vector::zeros());
                    for (x, y, stiffness, limit) in &steps {
                        let rate = Vector::new(*x, *y, 0.0);
                        let step = Step { rate, stiffness: *stiffness, dashpot: 0.0, limit: *limit, dt: 0.01 };
                        let response = rules.advance(&step, &mut memory, &Still);
                        work -= 0.5 * (response.force + last).dot(&rate) * 0.01;
                        last = response.force;
                        lost += response.slider + response.carried;
                        energy = response.energy;
                        prop_assert!(response.force.norm() <= limit * (1.0 + 1e-14));
                        prop_assert!(response.slider >= -1e-15);
                    }
                    prop_assert!((work - lost - energy).abs() < 1e-12, "{:?} {} {} {}", rules, work, lost, energy);
                }
            }
        }
    }
}
