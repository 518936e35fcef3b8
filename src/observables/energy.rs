//! The energy ledger.
//!
//! Each dissipation is defined by its law: the work of the force that the law does not store. The residual of the
//! balance is therefore a measure of the integrator's error, never zero by construction. Work over a step is the mean
//! of the forces at its two ends times the half-step velocity, which velocity Verlet and the staggered start share.

use crate::bodies::Body;
use crate::contacts::Contacts;
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
    /// Work of moving bodies on the particles since the start.
    pub body_work: f64,
    /// Energy that entered contacts since the start, the scale of the residual.
    pub entered: f64,
}

impl Ledger {
    /// Adds what the last sweep dissipated and received.
    pub fn accumulate<H>(&mut self, contacts: &Contacts<H>) {
        for slot in &contacts.slots {
            self.viscous += slot.state.dissipated;
            self.entered += slot.state.entered;
            self.body_work += slot.state.body_work;
        }
    }

    /// Measures the energies of a state; `velocity` and `angular` are synchronized with the positions.
    pub fn measure<H>(
        &mut self,
        particles: &Particles,
        contacts: &Contacts<H>,
        gravity: &crate::Vector,
        synchronized: &Synchronized,
    ) {
        self.kinetic = 0.0;
        self.gravity = 0.0;
        for i in 0..particles.len() {
            self.kinetic += 0.5 * particles.mass[i] * synchronized.velocity[i].norm_squared();
            self.kinetic += 0.5 * particles.moment_of_inertia[i] * synchronized.angular[i].norm_squared();
            self.gravity -= particles.mass[i] * gravity.dot(&particles.position[i]);
        }
        self.elastic = 0.0;
        for slot in &contacts.slots {
            self.elastic += slot.state.energy;
        }
    }
}

/// Velocities at the times of the positions.
#[derive(Clone, Debug, Default)]
pub struct Synchronized {
    /// Velocities [m/s].
    pub velocity: Vec<crate::Vector>,
    /// Angular velocities [rad/s].
    pub angular: Vec<crate::Vector>,
}

/// Sum of the forces on each body in the order of the slots [N].
pub fn body_forces<H>(contacts: &Contacts<H>, bodies: &mut [Body]) {
    for body in bodies.iter_mut() {
        body.force = crate::Vector::zeros();
    }
    for slot in &contacts.slots {
        if let crate::contacts::Partner::Body(body) = slot.partner {
            bodies[body as usize].force -= slot.state.force;
        }
    }
}
