//! The walls of a scene.

use super::{SceneBody, SceneLoad, SceneMotion, SceneShape, index, si};
use crate::Vector;
use crate::case::protocol::{Load, Motion, Shape};
use crate::case::quantity::Number;
use crate::case::schema::Case;

/// The walls that a case states.
pub fn bodies(case: &Case) -> Vec<SceneBody> {
    let mut scene = Vec::new();
    for body in &case.bodies {
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
            motion: motion(case, &body.motion),
        });
    }
    scene
}

fn unit(direction: &[Number; 3]) -> [f64; 3] {
    Vector::from(direction.map(Number::get)).normalize().into()
}

/// A motion in SI and by index; those that this build does not compute were refused before.
pub fn motion(case: &Case, motion: &Motion) -> SceneMotion {
    let body = |name: &String| case.bodies.iter().position(|body| body.name == *name).unwrap_or_default();
    match motion {
        Motion::Prescribed { velocity } => SceneMotion::Prescribed { velocity: si(velocity) },
        Motion::Servo { direction, load, mass, damping } => SceneMotion::Servo {
            direction: unit(direction),
            load: match load {
                Load::Force { value } => SceneLoad::Force { value: value.si() },
                Load::LineStress { value, between } => {
                    SceneLoad::LineStress { value: value.si(), between: [body(&between[0]), body(&between[1])] }
                }
                Load::Pressure { .. } => SceneLoad::Force { value: 0.0 },
            },
            mass: mass.si(),
            damping: damping.si(),
        },
        Motion::Oscillating { direction, amplitude, frequency } => SceneMotion::Oscillating {
            direction: unit(direction),
            amplitude: amplitude.si(),
            frequency: frequency.si(),
        },
        Motion::Fixed {} | Motion::Sprung { .. } => SceneMotion::Fixed,
    }
}
