//! Prescribed paths of driven particles.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | t0, n0 | time and step at which a stage begins; t = t0 + (n - n0) dt | s, - |
//! | x0 | place at t0, where the stage before ended | m |
//! | v, w | velocity and angular velocity that the stage states, in the frame that turns | m/s, rad/s |
//! | c | course: 1, or cos(2 pi f (t - t0)) | - |
//! | S | its integral: t - t0, or sin(2 pi f (t - t0)) / (2 pi f) | s |
//! | p, Omega | point and angular velocity of the rotation; R(phi) is the rotation by phi Omega/abs(Omega) | m, rad/s |
//!
//! x(t) = p + R(abs(Omega) (t - t0)) [x0 + v S(t) - p].
//!
//! The velocity of step n is the mean over the step that ends at n, (x(n) - x(n-1)) / dt, which is what a free particle
//! of every code has there: positions advance by exactly velocity times dt. It is formed without a difference of places.
//! With m the middle of the step, h = abs(Omega) dt/2, k = Omega/abs(Omega) and C, B the means of c and of S at both ends,
//!
//! v(n) = R(m) [(2 sin(h)/dt) k x (x0 + v B - p) + (v C along k) + cos(h) (v C across k)], w(n) = R(m) w C + Omega,
//!
//! C = c(m) sin(pi f dt)/(pi f dt) and B = S(m) cos(pi f dt); for the constant course C = 1 and B = S(m).

use std::f64::consts::PI;

use crate::Vector;
use crate::case::protocol::Course;
use crate::case::scene::{SceneDrive, SceneLeg};

/// How a driven particle moves at one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Driven {
    /// Centre [m].
    pub position: Vector,
    /// Mean velocity over the step that ends here [m/s].
    pub velocity: Vector,
    /// Mean angular velocity over that step [rad/s].
    pub angular_velocity: Vector,
}

/// The path of one particle over a run.
#[derive(Clone, Debug)]
pub struct Path {
    /// Place of the particle in the scene.
    pub particle: u32,
    dt: f64,
    start: Vector,
    /// Last step of every leg, in order.
    ends: Vec<u64>,
    legs: Vec<Leg>,
}

/// One stage of a path.
#[derive(Clone, Debug)]
pub struct Leg {
    start: Vector,
    velocity: Vector,
    spin: Vector,
    course: Course,
    turn: Vector,
    point: Vector,
}

impl Path {
    /// The path that a scene states, in steps of `dt` [s].
    #[must_use]
    pub fn new(drive: &SceneDrive, dt: f64) -> Self {
        let mut step = 0;
        let ends = drive.legs.iter().map(|leg| {
            step += leg.steps;
            step
        });
        Self {
            particle: u32::try_from(drive.particle).unwrap_or(u32::MAX),
            dt,
            start: drive.legs.first().map_or_else(Vector::zeros, |leg| leg.position.into()),
            ends: ends.collect(),
            legs: drive.legs.iter().map(Leg::new).collect(),
        }
    }

    /// Index of the leg that moves the particle to `step`.
    #[must_use]
    pub fn leg_of(&self, step: u64) -> usize {
        self.ends.partition_point(|end| *end < step).min(self.legs.len().saturating_sub(1))
    }

    /// Place and velocities at `step`. At step 0 the particle rests.
    #[must_use]
    pub fn at(&self, step: u64) -> Driven {
        let at = self.leg_of(step);
        let Some(leg) = self.legs.get(at).filter(|_| step > 0) else {
            let rest = Vector::zeros();
            return Driven { position: self.start, velocity: rest, angular_velocity: rest };
        };
        let begins = if at == 0 { 0 } else { self.ends[at - 1] };
        leg.at(step - begins, self.dt)
    }
}

/// Mean of the course over a step, mean of its integral at both ends of the step, and its integral at the end [-, s, s].
fn course(course: &Course, steps: f64, dt: f64) -> (f64, f64, f64) {
    match course {
        Course::Constant {} => (1.0, (steps - 0.5) * dt, steps * dt),
        Course::Sinusoid { frequency } => {
            let rate = 2.0 * PI * frequency.si();
            let (half, middle) = (0.5 * rate * dt, rate * dt * (steps - 0.5));
            (
                libm::cos(middle) * (libm::sin(half) / half),
                libm::sin(middle) * libm::cos(half) / rate,
                libm::sin(rate * dt * steps) / rate,
            )
        }
    }
}

/// `vector` turned by `angle` [rad] about the unit vector `axis`.
fn turned(vector: &Vector, axis: &Vector, angle: f64) -> Vector {
    let along = axis * axis.dot(vector);
    along + (vector - along) * libm::cos(angle) + axis.cross(vector) * libm::sin(angle)
}

impl Leg {
    /// The leg that a scene states.
    #[must_use]
    pub fn new(leg: &SceneLeg) -> Self {
        Self {
            start: leg.position.into(),
            velocity: leg.velocity.into(),
            spin: leg.angular_velocity.into(),
            course: leg.course,
            turn: leg.rotation.into(),
            point: leg.point.into(),
        }
    }

    /// Place and velocities `steps` of `dt` [s] after the beginning of the leg, at least one.
    #[must_use]
    pub fn at(&self, steps: u64, dt: f64) -> Driven {
        let steps = steps as f64;
        let (mean, between, integral) = course(&self.course, steps, dt);
        let rate = self.turn.norm();
        if rate == 0.0 {
            return Driven {
                position: self.start + self.velocity * integral,
                velocity: self.velocity * mean,
                angular_velocity: self.spin * mean,
            };
        }
        let axis = self.turn / rate;
        let arm = self.start - self.point;
        let (half, middle) = (0.5 * rate * dt, rate * dt * (steps - 0.5));
        let drift = self.velocity * mean;
        let along = axis * axis.dot(&drift);
        let swept = axis.cross(&(arm + self.velocity * between)) * (2.0 * libm::sin(half) / dt);
        let velocity = swept + along + (drift - along) * libm::cos(half);
        Driven {
            position: self.point + turned(&(arm + self.velocity * integral), &axis, rate * dt * steps),
            velocity: turned(&velocity, &axis, middle),
            angular_velocity: turned(&(self.spin * mean), &axis, middle) + self.turn,
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::case::quantity::Quantity;

    fn vector() -> impl Strategy<Value = [f64; 3]> {
        [-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64]
    }

    fn path(legs: Vec<SceneLeg>, dt: f64) -> Path {
        Path::new(&SceneDrive { particle: 0, legs }, dt)
    }

    proptest! {
        #[test]
        fn places_advance_by_velocity_times_the_step(
            position in vector(), velocity in vector(), rotation in vector(), point in vector(), waves in any::<bool>(),
        ) {
            let course = if waves { Course::Sinusoid { frequency: Quantity::new(0.7) } } else { Course::Constant {} };
            let angular_velocity = [0.0; 3];
            let leg = SceneLeg { steps: 40, position, velocity, angular_velocity, course, rotation, point };
            let path = path(vec![leg], 0.05);
            for step in 1..=40 {
                let (before, now) = (path.at(step - 1), path.at(step));
                let gone = (now.position - before.position) / 0.05;
                prop_assert!((now.velocity - gone).norm() < 1e-13, "step {step}: {} {}", now.velocity, gone);
            }
        }
    }

    #[test]
    fn a_quarter_turn_ends_on_the_other_axis_and_turns_the_spin() {
        let leg = SceneLeg {
            steps: 100,
            position: [2.0, 0.0, 1.0],
            velocity: [0.0; 3],
            angular_velocity: [3.0, 0.0, 0.0],
            course: Course::Constant {},
            rotation: [0.0, 0.0, 0.5 * PI],
            point: [1.0, 0.0, 0.0],
        };
        let path = path(vec![leg], 0.01);
        let (first, last) = (path.at(1), path.at(100));
        assert!((last.position - Vector::new(1.0, 1.0, 1.0)).norm() < 1e-15);
        assert!((first.angular_velocity - Vector::new(3.0, 0.0, 0.5 * PI)).norm() < 0.03);
        assert!((last.angular_velocity - Vector::new(0.0, 3.0, 0.5 * PI)).norm() < 0.03);
    }

    #[test]
    fn legs_follow_one_another_and_the_particle_rests_before_the_first() {
        let leg = |position, velocity| SceneLeg {
            steps: 10,
            position,
            velocity,
            angular_velocity: [0.0; 3],
            course: Course::Constant {},
            rotation: [0.0; 3],
            point: [0.0; 3],
        };
        let path = path(vec![leg([0.0; 3], [1.0, 0.0, 0.0]), leg([1.0, 0.0, 0.0], [0.0, 2.0, 0.0])], 0.1);
        assert_eq!(path.at(0).velocity, Vector::zeros());
        assert_eq!(path.at(10).velocity, Vector::x());
        assert_eq!(path.at(11).velocity, Vector::y() * 2.0);
        assert!((path.at(20).position - Vector::new(1.0, 2.0, 0.0)).norm() < 1e-15);
    }
}
