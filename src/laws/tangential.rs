//! Laws of the force in the contact plane, one per file. They share a spring behind a slider ([`super::slider`]) and
//! differ in stiffness and damping; [`Options`] holds everything that codes do differently.

pub mod linear_history;
pub mod luding_sintering;
pub mod mindlin;
pub mod options;

use crate::laws::rotation::{InPlane, Turn};
use crate::laws::slider::{Cap, History, Increment, Memory, Order, Rules, Step};
use crate::laws::{Contact, Losses, NormalState, TangentialState};

use options::{ArmRule, Friction, Options};

/// Sine of the angle to the contact plane below which LAMMPS leaves its spring alone, relative to the cap.
const NEGLIGIBLE: f64 = 1e-10;

/// The arms of one rule at both ends [m]; a body has none.
#[inline(always)]
fn arms(contact: &Contact, pick: impl Fn(&ArmRule) -> options::Arm, options: &Options) -> [f64; 2] {
    let geometry = &contact.geometry;
    if contact.at_body() {
        [pick(&options.wall_arms).length(geometry.radius_i, geometry.overlap), 0.0]
    } else {
        let arm = pick(&options.pair_arms);
        [geometry.radius_i, geometry.radius_j].map(|radius| arm.length(radius, geometry.overlap))
    }
}

/// The force of a tangential spring of the given stiffness [N/m] and dashpot constant [kg/s].
#[inline(always)]
fn spring(
    contact: &Contact,
    normal: &NormalState,
    options: &Options,
    [stiffness, dashpot]: [f64; 2],
    dt: f64,
    history: &mut Memory,
) -> TangentialState {
    let direction = contact.geometry.normal;
    let [slip_i, slip_j] = arms(contact, |rule| rule.slip, options);
    let [torque_i, torque_j] = arms(contact, |rule| rule.torque, options);
    let spin = contact.angular_i * slip_i + contact.angular_j * slip_j;
    let surface = contact.velocity - spin.cross(&direction);
    let rate = surface - direction * surface.dot(&direction);
    let seen = match options.friction {
        Friction::Total => normal.force.abs(),
        Friction::WithoutAdhesion => normal.repulsive.abs(),
        Friction::PullOffAdded => normal.pull_off + normal.force.abs(),
        Friction::TwicePullOff => (normal.elastic + 2.0 * normal.pull_off).abs(),
    };
    let limit = contact.pair.friction * normal.friction_share * seen;
    let turn = Turn::of(contact, dt);
    let scale = if options.history == History::Displacement { stiffness } else { 1.0 };
    let negligible = NEGLIGIBLE * limit / scale;
    let rules = Rules {
        history: options.history,
        rotation: options.rotation,
        order: options.order,
        increment: options.increment,
        cap: options.cap,
    };
    let step = Step { rate, stiffness, dashpot, limit, dt };
    let response = rules.advance(&step, history, &InPlane { rotation: options.rotation, turn: &turn, negligible });
    // Work of the force on a slip that the spring does not see, where its arms in torque and slip differ.
    let unseen = contact.angular_i * (torque_i - slip_i) + contact.angular_j * (torque_j - slip_j);
    let arms_work = response.force.dot(&unseen.cross(&direction)) * dt;
    TangentialState {
        force: response.force,
        sliding: response.sliding,
        limit,
        arms: [torque_i, torque_j],
        stiffness,
        dashpot,
        energy: response.energy,
        losses: Losses {
            viscous: response.viscous,
            frictional: response.slider,
            carried: response.carried + arms_work,
            ..Losses::default()
        },
    }
}

impl Options {
    /// The choices of the native code: force increments rescaled on unloading, turned exactly with the contact; a cap
    /// on elastic and damping parts together; both arms to the middle of the overlap.
    #[must_use]
    #[inline(always)]
    pub const fn plain() -> Self {
        let arms = ArmRule { slip: options::Arm::MidOverlap, torque: options::Arm::MidOverlap };
        Self {
            history: History::ForceRescaled,
            rotation: crate::laws::rotation::Rotation::Rigid,
            order: Order::RotateFirst,
            increment: Increment::Mean,
            cap: Cap::Total,
            friction: Friction::WithoutAdhesion,
            pair_arms: arms,
            wall_arms: arms,
        }
    }
}
