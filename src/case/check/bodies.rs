//! Bodies and their motions.

use super::Checker;
use crate::case::protocol::{Load, Motion, Shape};

impl Checker<'_> {
    pub(super) fn bodies(&mut self) {
        let case = self.case;
        for (i, body) in case.bodies.iter().enumerate() {
            let key = |name: &str| format!("bodies.{i}.{name}");
            self.known_material(key("material"), &body.material);
            match &body.shape {
                Shape::Plane { normal, .. } => self.direction(key("shape.normal"), normal),
                Shape::Cylinder { axis, radius, .. } => {
                    self.direction(key("shape.axis"), axis);
                    self.positive(key("shape.radius"), *radius);
                }
                Shape::Mesh { scale, .. } => self.positive(key("shape.scale"), *scale),
            }
            self.motion(&key("motion"), &body.motion);
            if let Some(temperature) = body.temperature {
                self.positive(key("temperature"), temperature);
            }
        }
        self.distinct("bodies", case.bodies.iter().map(|body| &body.name));
    }

    pub(super) fn motion(&mut self, at: &str, motion: &Motion) {
        match motion {
            Motion::Fixed {} | Motion::Prescribed { .. } => {}
            Motion::Servo { direction, load, mass, damping } => {
                self.direction(format!("{at}.direction"), direction);
                self.positive(format!("{at}.mass"), *mass);
                self.not_negative(format!("{at}.damping"), *damping);
                self.load(&format!("{at}.load"), load);
            }
            Motion::Sprung { direction, mass, stiffness, damping, .. } => {
                self.direction(format!("{at}.direction"), direction);
                self.positive(format!("{at}.mass"), *mass);
                self.positive(format!("{at}.stiffness"), *stiffness);
                self.not_negative(format!("{at}.damping"), *damping);
            }
            Motion::Oscillating { direction, amplitude, frequency } => {
                self.direction(format!("{at}.direction"), direction);
                self.not_negative(format!("{at}.amplitude"), *amplitude);
                self.positive(format!("{at}.frequency"), *frequency);
            }
        }
    }

    pub(super) fn load(&mut self, at: &str, load: &Load) {
        if let Load::LineStress { between, .. } = load {
            for (side, name) in between.iter().enumerate() {
                self.known_body(format!("{at}.between.{side}"), name);
            }
        }
    }
}
