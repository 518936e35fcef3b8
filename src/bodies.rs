//! Walls: planes that stand still or move as prescribed.

use crate::Vector;
use crate::case::scene::{SceneBody, SceneMotion, SceneShape};

/// A plane body and its state.
#[derive(Clone, Debug)]
pub struct Body {
    /// Name.
    pub name: String,
    /// Index of the material.
    pub material: usize,
    /// A point of the plane [m].
    pub point: Vector,
    /// Unit normal into the region of the particles [-].
    pub normal: Vector,
    /// Velocity [m/s].
    pub velocity: Vector,
    /// Force of the particles on the body [N].
    pub force: Vector,
}

impl Body {
    /// The body at the start of a scene.
    #[must_use]
    pub fn new(scene: &SceneBody) -> Self {
        let SceneShape::Plane { point, normal } = &scene.shape;
        Self {
            name: scene.name.clone(),
            material: scene.material,
            point: (*point).into(),
            normal: (*normal).into(),
            velocity: match &scene.motion {
                SceneMotion::Fixed => Vector::zeros(),
                SceneMotion::Prescribed { velocity } => (*velocity).into(),
            },
            force: Vector::zeros(),
        }
    }

    /// Moves the body over a step `dt` [s].
    pub fn drift(&mut self, dt: f64) {
        self.point += self.velocity * dt;
    }
}
