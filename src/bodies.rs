//! Walls: planes and cylinders that stand still or move as prescribed.

use crate::Vector;
use crate::case::scene::{SceneBody, SceneMotion, SceneShape};
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

/// A body and its state.
#[derive(Clone, Debug)]
pub struct Body {
    /// Name.
    pub name: String,
    /// Index of the material.
    pub material: usize,
    /// A point of the plane or of the axis [m].
    pub point: Vector,
    /// Shape about the point.
    pub shape: BodyShape,
    /// Velocity [m/s].
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
        Self {
            name: scene.name.clone(),
            material: scene.material,
            point: point.into(),
            shape,
            velocity: velocity(&scene.motion),
            force: Vector::zeros(),
        }
    }

    /// Gives the body another motion.
    pub fn set_motion(&mut self, motion: &SceneMotion) {
        self.velocity = velocity(motion);
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

    /// Moves the body over a step `dt` [s].
    pub fn drift(&mut self, dt: f64) {
        self.point += self.velocity * dt;
    }
}

fn velocity(motion: &SceneMotion) -> Vector {
    match motion {
        SceneMotion::Fixed => Vector::zeros(),
        SceneMotion::Prescribed { velocity } => (*velocity).into(),
    }
}
