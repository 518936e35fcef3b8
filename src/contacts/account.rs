//! What a contact has in the energy ledger, and what a step adds to it.

use crate::Vector;
use crate::laws::memory::Memory;
use crate::laws::model::Action;
use crate::laws::{Contact, Losses};

/// Entries of a contact in the energy ledger.
#[derive(Clone, Copy, Debug, Default)]
pub struct Account {
    /// Force on i at the last step [N].
    pub force: Vector,
    /// Total normal force, positive when it repels [N].
    pub normal_force: f64,
    /// Part of the normal force that is not stored [N].
    pub damping_force: f64,
    /// Stored energy [J].
    pub energy: f64,
    /// Its part in the contact plane and in moments [J].
    pub springs: f64,
    /// Largest force in the contact plane that friction allows [N].
    pub friction_limit: f64,
}

impl Memory for Account {
    const WIDTH: usize = 8;

    fn save(&self, into: &mut Vec<f64>) {
        self.force.save(into);
        into.extend([self.normal_force, self.damping_force, self.energy, self.springs, self.friction_limit]);
    }

    fn restore(values: &mut impl Iterator<Item = f64>) -> Self {
        let (force, (normal_force, damping_force)) = <(Vector, (f64, f64))>::restore(values);
        let (energy, springs, friction_limit) = <(f64, f64, f64)>::restore(values);
        Self { force, normal_force, damping_force, energy, springs, friction_limit }
    }
}

/// What entered and left the contacts of a block in the last step [J].
#[derive(Clone, Copy, Debug, Default)]
pub struct Flow {
    /// Energy dissipated by dashpots along the normal.
    pub dissipated: f64,
    /// Losses of springs and of plastic flow.
    pub losses: Losses,
    /// Energy that entered contacts by approach, and the work of sliding, rolling and twisting.
    pub entered: f64,
    /// Work of moving bodies on the particles.
    pub body_work: f64,
}

impl Flow {
    /// Work of the last step [s] at a contact, from the forces at its two ends and the velocity between. `wall` is the
    /// velocity of its body [m/s].
    pub fn count(
        &mut self,
        contact: &Contact,
        action: Option<&Action>,
        account: &mut Account,
        elapsed: f64,
        wall: &Vector,
    ) {
        let now = action.map_or_else(Account::default, |action| Account {
            force: action.force,
            normal_force: action.normal.force,
            damping_force: action.normal.force - action.normal.elastic,
            energy: action.normal.energy + action.springs,
            springs: action.springs,
            friction_limit: action.friction_limit,
        });
        if let Some(action) = action {
            self.losses = self.losses + action.losses;
            // What slides, rolls or twists away came in across the normal, whatever the approach brought.
            self.entered += action.losses.frictional.max(0.0) + action.losses.rolling.max(0.0);
        } else {
            // A spring that is dropped with its contact.
            self.losses.carried += account.springs;
        }
        let velocity = contact.approach().normal_velocity;
        let mean = |now: f64, then: f64| 0.5 * (now + then);
        self.dissipated += mean(now.damping_force, account.damping_force) * velocity * elapsed;
        self.entered += (mean(now.normal_force, account.normal_force) * velocity * elapsed).max(0.0);
        self.body_work += 0.5 * (now.force + account.force).dot(wall) * elapsed;
        *account = now;
    }
}
