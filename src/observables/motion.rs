//! Kinetic energy and the balance of momentum.
//!
//! | symbol | meaning |
//! |---|---|
//! | m, I, d | mass [kg], moment of inertia [kg m2], diameter of a particle [m] |
//! | v, w | its velocity [m/s], angular velocity [rad/s] |
//! | f | sum of the contact forces on it [N] |
//! | B | force of the particles on a body [N] |
//! | W, g | weight of all particles [N], acceleration of gravity [m/s2] |
//! | P, T | sum of m v [kg m/s], time between the ends of a window [s] |
//!
//! Energy: sum(m v^2 / 2 + I w^2 / 2) / sum(m g d). At one time, forces of particles on each other cancel, so that
//! abs(sum(B) + sum(f)) / W is the momentum that gets lost: rounding, where the record holds the forces that moved the
//! particles. Over a window, abs(P2 - P1 - integral of (sum(m) g - sum(B))) / (W T), the integral by the trapezoidal
//! rule over the samples: for codes whose forces are not those of the step; samples must resolve the forces. Velocities
//! half a step ahead of the forces shift the window, not its length. Source: Newton's laws.

use super::sample::{Row, Sample, State, needed};
use super::system::System;
use crate::Vector;
use crate::case::measure::KineticPart;

/// Kinetic energy over m g d [-].
///
/// # Errors
/// The record lacks velocities, or there is no gravity.
pub fn kinetic_energy(sample: &Sample, part: KineticPart) -> Result<f64, String> {
    let system = sample.system;
    let energy = |values: Option<&[Row]>, name: &str, inertia: &[f64]| -> Result<f64, String> {
        let rows = needed(values, name)?;
        Ok(rows.iter().zip(inertia).map(|(row, inertia)| 0.5 * inertia * Vector::from(*row).norm_squared()).sum())
    };
    let translational = || energy(sample.state.velocity, "velocity", &system.mass);
    let rotational = || energy(sample.state.angular_velocity, "angular_velocity", &system.moment_of_inertia);
    let sum = match part {
        KineticPart::Translational => translational()?,
        KineticPart::Rotational => rotational()?,
        KineticPart::Total => translational()? + rotational()?,
    };
    let diameters: f64 = system.mass.iter().zip(&system.radius).map(|(mass, radius)| mass * 2.0 * radius).sum();
    system.weight()?;
    Ok(sum / (diameters * system.gravity.norm()))
}

fn total(rows: &[Row]) -> Vector {
    rows.iter().map(|row| Vector::from(*row)).sum()
}

/// Momentum that is missing at one time, over the weight [-].
///
/// # Errors
/// The record lacks forces, or there is no gravity.
pub fn momentum_residual(sample: &Sample) -> Result<f64, String> {
    let bodies = total(needed(sample.state.body_force, "body_force")?);
    let particles = total(needed(sample.state.force, "force")?);
    Ok((bodies + particles).norm() / sample.system.weight()?)
}

/// Momentum that is missing over a window of samples [-]; `time` [s] and `window` hold the samples from its first to its
/// last.
///
/// # Errors
/// The record lacks velocities or forces on bodies, or there is no gravity.
pub fn momentum_change(system: &System, time: &[f64], window: &[State]) -> Result<f64, String> {
    let weight = system.weight()?;
    let mass: f64 = system.mass.iter().sum();
    let mut momentum = Vec::with_capacity(window.len());
    let mut supplied = Vec::with_capacity(window.len());
    for state in window {
        let rows = needed(state.velocity, "velocity")?;
        momentum.push(rows.iter().zip(&system.mass).map(|(row, mass)| Vector::from(*row) * *mass).sum::<Vector>());
        supplied.push(system.gravity * mass - total(needed(state.body_force, "body_force")?));
    }
    let intervals = time.windows(2).zip(supplied.windows(2));
    let received: Vector = intervals.map(|(t, f)| (f[0] + f[1]) * (0.5 * (t[1] - t[0]))).sum();
    let (Some(last), Some(first)) = (momentum.last(), momentum.first()) else { return Ok(f64::NAN) };
    let duration = time.last().zip(time.first()).map_or(0.0, |(last, first)| last - first);
    Ok((last - first - received).norm() / (weight * duration))
}
