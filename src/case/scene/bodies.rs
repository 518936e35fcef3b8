//! The walls of a scene.

use super::{SceneBody, SceneMotion, SceneShape, index, si};
use crate::Vector;
use crate::case::protocol::{Motion, Shape};
use crate::case::quantity::Number;
use crate::case::schema::Case;

/// The walls that a case states.
pub fn bodies(case: &Case) -> Vec<SceneBody> {
    let mut scene = Vec::new();
    for body in &case.bodies {
        let unit = |direction: &[Number; 3]| Vector::from(direction.map(Number::get)).normalize().into();
        let shape = match &body.shape {
            Shape::Plane { point, normal } => SceneShape::Plane { point: si(point), normal: unit(normal) },
            Shape::Cylinder { point, axis, radius } => {
                SceneShape::Cylinder { point: si(point), axis: unit(axis), radius: radius.si() }
            }
            Shape::Mesh { .. } => continue,
        };
        scene.push(SceneBody {
            name: body.name.clone(),
            material: index(case, &body.material),
            shape,
            motion: match &body.motion {
                Motion::Prescribed { velocity } => SceneMotion::Prescribed { velocity: si(velocity) },
                _ => SceneMotion::Fixed,
            },
        });
    }
    scene
}
