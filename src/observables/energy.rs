//! The energy ledger.
//!
//! Each dissipation is defined by its law: the work of the force that the law does not store. The residual of the
//! balance is therefore a measure of the integrator's error, never zero by construction. Work over a step is the mean
//! of the forces at its two ends times the half-step velocity, which velocity Verlet and the staggered start share.

use crate::Vector;
use crate::contacts::{Account, Contacts};
use crate::domain::Domain;
use crate::laws::memory::Memory;
use crate::particles::Particles;

/// Energies at one time [J].
#[derive(Clone, Copy, Debug, Default)]
pub struct Ledger {
    /// Kinetic energy of translation and rotation.
    pub kinetic: f64,
    /// Energy stored in contacts.
    pub elastic: f64,
    /// Potential energy of the weight.
    pub gravity: f64,
    /// Energy dissipated by dashpots since the start.
    pub viscous: f64,
    /// Energy dissipated by sliding since the start.
    pub frictional: f64,
    /// Energy dissipated by rolling and twisting since the start.
    pub rolling: f64,
    /// Energy dissipated by plastic flow since the start.
    pub plastic: f64,
    /// Energy that loaded springs lost since the start as their stiffness changed, as they turned, and with contacts that
    /// opened.
    pub carried: f64,
    /// Work of moving bodies and of driven particles on the others and on contacts since the start.
    pub body_work: f64,
    /// Energy that entered contacts since the start, by approach and as the work of sliding, rolling and twisting: the
    /// scale of the residual.
    pub entered: f64,
}

impl Ledger {
    /// Adds what the last sweep dissipated and received.
    pub fn accumulate<H>(&mut self, contacts: &Contacts<H>) {
        for block in &contacts.blocks {
            let losses = block.flow.losses;
            self.viscous += block.flow.dissipated + losses.viscous;
            self.frictional += losses.frictional;
            self.rolling += losses.rolling;
            self.plastic += losses.plastic;
            self.carried += losses.carried;
            self.entered += block.flow.entered;
            self.body_work += block.flow.body_work;
        }
    }

    /// Measures the energies of a state whose velocities are ahead of the positions by `ahead` [s].
    /// Driven particles are moved from outside, like bodies: their motion is not part of the balance.
    pub fn measure<H: Memory>(
        &mut self,
        particles: &Particles,
        driven: &[u32],
        domain: &Domain,
        contacts: &Contacts<H>,
        gravity: &Vector,
        ahead: f64,
    ) {
        self.kinetic = 0.0;
        self.gravity = 0.0;
        for i in (0..particles.len()).filter(|at| !driven.contains(&particles.motion[*at].id)) {
            let (motion, load) = (&particles.motion[i], &particles.load[i]);
            let inertia = particles.moment_of_inertia[i];
            let velocity = motion.velocity - (load.force / motion.mass + gravity) * ahead;
            let angular = motion.angular_velocity - load.torque * (ahead / inertia);
            self.kinetic += 0.5 * motion.mass * velocity.norm_squared();
            self.kinetic += 0.5 * inertia * angular.norm_squared();
            self.gravity -= motion.mass * gravity.dot(&particles.unwrapped(i, domain));
        }
        let sum = |accounts: &[Account]| accounts.iter().map(|account| account.energy).sum::<f64>();
        self.elastic = 0.0;
        for block in &contacts.blocks {
            self.elastic += sum(&block.pairs.accounts) + sum(&block.near.accounts);
        }
    }
}

impl Memory for Ledger {
    const WIDTH: usize = 10;

    fn save(&self, into: &mut Vec<f64>) {
        into.extend([self.kinetic, self.elastic, self.gravity, self.viscous, self.body_work, self.entered]);
        into.extend([self.frictional, self.rolling, self.plastic, self.carried]);
    }

    fn restore(values: &mut impl Iterator<Item = f64>) -> Self {
        let ((kinetic, elastic, gravity), (viscous, body_work, entered)) = Memory::restore(values);
        let ((frictional, rolling), (plastic, carried)) = Memory::restore(values);
        Self { kinetic, elastic, gravity, viscous, frictional, rolling, plastic, carried, body_work, entered }
    }
}
