//! Time integration: velocity Verlet, and the same trajectory started half a step earlier (leapfrog).
//!
//! Both are v(n+1/2) = v(n-1/2) + a(n) dt, x(n+1) = x(n) + v(n+1/2) dt, and both evaluate forces at x(n+1) with
//! v(n+1/2). They differ in what they store: velocity Verlet completes v(n+1) by half a kick, the staggered scheme
//! keeps v(n+1/2).

use crate::Vector;
use crate::observables::energy::Synchronized;
use crate::particles::Particles;

/// Adds `dt` [s] times the acceleration to the velocities.
pub fn kick(particles: &mut Particles, gravity: &Vector, dt: f64) {
    for i in 0..particles.len() {
        particles.velocity[i] += (particles.force[i] / particles.mass[i] + gravity) * dt;
        particles.angular_velocity[i] += particles.torque[i] * (dt / particles.moment_of_inertia[i]);
    }
}

/// Moves the particles over `dt` [s].
pub fn drift(particles: &mut Particles, dt: f64) {
    for (position, velocity) in particles.position.iter_mut().zip(&particles.velocity) {
        *position += velocity * dt;
    }
}

/// Velocities at the times of the positions, from velocities that are ahead by `ahead` [s].
pub fn synchronized(particles: &Particles, gravity: &Vector, ahead: f64, into: &mut Synchronized) {
    into.velocity.clone_from(&particles.velocity);
    into.angular.clone_from(&particles.angular_velocity);
    if ahead == 0.0 {
        return;
    }
    for i in 0..particles.len() {
        into.velocity[i] -= (particles.force[i] / particles.mass[i] + gravity) * ahead;
        into.angular[i] -= particles.torque[i] * (ahead / particles.moment_of_inertia[i]);
    }
}
