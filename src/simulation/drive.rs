//! Driven particles: they follow their paths whatever acts on them, and the work of that is body work.

use crate::Vector;
use crate::laws::model::ContactModel;
use crate::particles::Load;
use crate::path::{Driven, Path};

use super::Simulation;

/// A driven particle.
#[derive(Clone, Debug)]
pub(super) struct Driver {
    pub(super) path: Path,
    /// How it moves at the present step.
    now: Driven,
    /// What contacts did to it one step ago.
    load: Load,
}

impl Driver {
    pub(super) fn new(path: Path) -> Self {
        let now = path.at(0);
        Self { path, now, load: Load::default() }
    }
}

impl<M: ContactModel> Simulation<M> {
    /// Puts driven particles where their paths have them at `step`.
    pub(super) fn drive(&mut self, step: u64) {
        if self.drivers.is_empty() {
            return;
        }
        for driver in &mut self.drivers {
            driver.now = driver.path.at(step);
            let at = self.particles.index()[driver.path.particle as usize] as usize;
            self.particles.place[at].position = driver.now.position;
        }
        self.hold();
        // Anew: the pass before this one moved driven particles by what their loads would do.
        let speeds = self.drivers.iter().map(|driver| driver.now.velocity.norm());
        let longest = speeds.fold(0.0, f64::max) * self.time_step;
        if longest > self.fastest {
            self.neighbors.moved(longest - self.fastest);
            self.fastest = longest;
        }
        self.stale = self.furthest() >= self.neighbors.allowance();
    }

    /// Gives driven particles the velocities of the present step, which no load changes.
    pub(super) fn hold(&mut self) {
        for driver in &self.drivers {
            let at = self.particles.index()[driver.path.particle as usize] as usize;
            let motion = &mut self.particles.motion[at];
            (motion.velocity, motion.angular_velocity) = (driver.now.velocity, driver.now.angular_velocity);
        }
    }

    /// Adds the work of the drives over the last step: mean of the loads at its two ends, against the motion.
    pub(super) fn account_drives(&mut self) {
        for driver in &mut self.drivers {
            let at = self.particles.index()[driver.path.particle as usize] as usize;
            let load = self.particles.load[at];
            let mean = |now: Vector, then: Vector| (now + then) * 0.5;
            let power = mean(load.force, driver.load.force).dot(&driver.now.velocity)
                + mean(load.torque, driver.load.torque).dot(&driver.now.angular_velocity);
            self.ledger.body_work -= power * self.time_step;
            driver.load = load;
        }
    }

    /// Takes up the paths at the step of a checkpoint, whose loads are complete.
    pub(super) fn resume_drives(&mut self) {
        for driver in &mut self.drivers {
            driver.now = driver.path.at(self.step);
            driver.load = self.particles.load[self.particles.index()[driver.path.particle as usize] as usize];
        }
    }
}
