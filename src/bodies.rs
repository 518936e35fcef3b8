//! Walls: planes and cylinders that stand still, move as prescribed, or follow the load on them.

use std::f64::consts::PI;

use crate::Vector;
use crate::case::scene::{SceneBody, SceneLoad, SceneMotion, SceneShape};
use crate::geometry::{self, ContactGeometry};

/// Shape of a body, about its point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BodyShape {
    /// A plane without end.
    Plane {
        /// Unit normal into the region of the particles [-].
        normal: Vector,
    },
    /// The inside of a cylinder without end.
    Cylinder {
        /// Unit vector along the axis [-].
        axis: Vector,
        /// Radius [m].
        radius: f64,
    },
}

/// What moves a body.
#[derive(Clone, Copy, Debug)]
pub enum Drive {
    /// Its velocity stays.
    Constant,
    /// The load on it: m dv/dt = (F - load) . direction - damping v, with F of the particles.
    Servo {
        /// Unit vector away from the particles [-].
        direction: Vector,
        /// External load.
        load: SceneLoad,
        /// Mass [kg].
        mass: f64,
        /// Dashpot constant [kg/s].
        damping: f64,
    },
    /// A path about the point where it began.
    Along {
        /// Direction, whose length is the amplitude [m].
        amplitude: Vector,
        /// How it moves along it.
        course: Course,
        /// Step at which it began.
        since: u64,
    },
}

/// The share of its amplitude that a path has reached.
#[derive(Clone, Copy, Debug)]
pub enum Course {
    /// (1 - cos(pi t / duration)) / 2, then 1.
    Strain {
        /// Duration [steps].
        steps: u64,
    },
    /// sin(2 pi frequency t).
    Oscillation {
        /// Frequency [Hz].
        frequency: f64,
    },
}

impl Course {
    fn share(self, steps: u64, dt: f64) -> f64 {
        match self {
            Self::Strain { steps: all } if steps >= all => 1.0,
            Self::Strain { steps: all } => 0.5 * (1.0 - libm::cos(PI * (steps as f64 / all as f64))),
            Self::Oscillation { frequency } => libm::sin(2.0 * PI * frequency * (steps as f64 * dt)),
        }
    }
}

/// A body and its state.
#[derive(Clone, Debug)]
pub struct Body {
    /// Name.
    pub name: String,
    /// Index of the material.
    pub material: usize,
    /// Whether it is there: no particle touches a body that was removed.
    pub present: bool,
    /// A point of the plane or of the axis [m].
    pub point: Vector,
    /// Where its path began [m].
    pub origin: Vector,
    /// Shape about the point.
    pub shape: BodyShape,
    /// What moves it.
    pub drive: Drive,
    /// Velocity; that of a servo wall stands half a step ahead of its point [m/s].
    pub velocity: Vector,
    /// Force of the particles on the body [N].
    pub force: Vector,
}

impl Body {
    /// The body at the start of a scene.
    #[must_use]
    pub fn new(scene: &SceneBody) -> Self {
        let (point, shape) = match &scene.shape {
            SceneShape::Plane { point, normal } => (*point, BodyShape::Plane { normal: (*normal).into() }),
            SceneShape::Cylinder { point, axis, radius } => {
                (*point, BodyShape::Cylinder { axis: (*axis).into(), radius: *radius })
            }
        };
        let mut body = Self {
            name: scene.name.clone(),
            material: scene.material,
            present: true,
            point: point.into(),
            origin: point.into(),
            shape,
            drive: Drive::Constant,
            velocity: Vector::zeros(),
            force: Vector::zeros(),
        };
        body.set_motion(&scene.motion, 0);
        body
    }

    /// Gives the body another motion at a step. A wall that becomes a servo wall keeps its velocity.
    pub fn set_motion(&mut self, motion: &SceneMotion, step: u64) {
        self.drive = Drive::Constant;
        match motion {
            SceneMotion::Fixed => self.velocity = Vector::zeros(),
            SceneMotion::Prescribed { velocity } => self.velocity = (*velocity).into(),
            SceneMotion::Servo { direction, load, mass, damping } => {
                let direction = Vector::from(*direction);
                self.velocity = direction * self.velocity.dot(&direction);
                self.drive = Drive::Servo { direction, load: *load, mass: *mass, damping: *damping };
            }
            SceneMotion::Oscillating { direction, amplitude, frequency } => {
                let course = Course::Oscillation { frequency: *frequency };
                self.set_path(Vector::from(*direction) * *amplitude, course, step);
            }
        }
    }

    /// Takes the body away: it stays where it is and touches nothing.
    pub fn remove(&mut self) {
        (self.present, self.drive, self.velocity) = (false, Drive::Constant, Vector::zeros());
    }

    /// Lets the body follow a path from its present point on.
    pub fn set_path(&mut self, amplitude: Vector, course: Course, step: u64) {
        self.origin = self.point;
        self.drive = Drive::Along { amplitude, course, since: step };
    }

    /// Contact geometry of a sphere with this body. None where no normal exists: on the axis of a cylinder.
    #[must_use]
    pub fn geometry(&self, center: Vector, radius: f64) -> Option<ContactGeometry> {
        match self.shape {
            BodyShape::Plane { normal } => Some(geometry::sphere_plane(center, radius, self.point, normal)),
            BodyShape::Cylinder { axis, radius: bore } => {
                geometry::sphere_cylinder(center, radius, self.point, axis, bore)
            }
        }
    }

    /// Moves the body over a step `dt` [s] to `step`.
    pub fn drift(&mut self, dt: f64, step: u64) {
        if let Drive::Along { amplitude, course, since } = self.drive {
            let point = self.origin + amplitude * course.share(step - since, dt);
            self.velocity = (point - self.point) / dt;
            self.point = point;
        } else {
            self.point += self.velocity * dt;
        }
    }
}

/// Kicks servo walls over `dt` [s] by the loads on them.
pub fn kick(bodies: &mut [Body], dt: f64) {
    for at in 0..bodies.len() {
        let Drive::Servo { direction, load, mass, damping } = bodies[at].drive else { continue };
        let external = match load {
            SceneLoad::Force { value } => value,
            SceneLoad::LineStress { value, between: [one, other] } => {
                let span = bodies[other].point - bodies[one].point;
                // The planes are parallel; a case says so or is refused.
                let BodyShape::Plane { normal } = bodies[one].shape else { continue };
                value * span.dot(&normal).abs()
            }
        };
        let body = &mut bodies[at];
        let force = body.force.dot(&direction) - external - damping * body.velocity.dot(&direction);
        body.velocity += direction * (force * dt / mass);
    }
}
