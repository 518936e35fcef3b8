//! How a vector that a contact remembers follows the contact as it turns.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | n0, n | unit normal one step ago and now | - |
//! | phi = dt n.(wi + wj) / 2 | angle of the contact about its normal, the mean of both bodies | rad |
//! | h | the vector: a displacement, a force or a moment | |
//! | theta, N | angle and number of steps of a rigid rotation; dtheta = theta / N | rad, - |
//!
//! | rotation | h becomes | after a rigid rotation by theta, |
//! |---|---|---|
//! | rigid | Q(n, phi) Q(n0 -> n) h, exact rotations | unchanged in the body to order theta dtheta^2 |
//! | projection | h - (h.n) n (LIGGGHTS, tangential) | shrunk by N dtheta^2 / 2 if it lies in the plane of rotation |
//! | `projection_rescaled` | the same, stretched to its old length (LAMMPS) | length kept, no turn about n |
//! | `small_angles` | h - h x (n0 x n), then h - h x (phi n0) (YADE) | grown by N dtheta^2 / 2 |
//! | fixed | h (LIGGGHTS, rolling) | not turned |

use serde::{Deserialize, Serialize};

use crate::Vector;

use super::Contact;
use super::slider::Carry;

/// Rotation of a remembered vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rotation {
    /// With the contact, exactly.
    Rigid,
    /// The part along the normal is dropped.
    Projection,
    /// The part along the normal is dropped and the length restored.
    ProjectionRescaled,
    /// Two cross products, each exact to first order.
    SmallAngles,
    /// None.
    Fixed,
}

/// How a contact turned over the last step.
#[derive(Clone, Copy, Debug)]
pub struct Turn {
    /// Normal before [-].
    pub from: Vector,
    /// Normal now [-].
    pub to: Vector,
    /// Sum of both angular velocities times half the step [rad].
    pub spin: Vector,
}

impl Turn {
    /// The turn of `contact` over a step `dt` [s].
    #[must_use]
    #[inline(always)]
    pub fn of(contact: &Contact, dt: f64) -> Self {
        Self {
            from: contact.geometry.previous_normal(&contact.velocity, dt),
            to: contact.geometry.normal,
            spin: (contact.angular_i + contact.angular_j) * (0.5 * dt),
        }
    }
}

/// A rotation over one turn, for vectors in the contact plane.
#[derive(Clone, Copy, Debug)]
pub struct InPlane<'a> {
    /// The rotation.
    pub rotation: Rotation,
    /// The turn.
    pub turn: &'a Turn,
    /// See [`Rotation::carry`].
    pub negligible: f64,
}

impl Carry for InPlane<'_> {
    #[inline(always)]
    fn carry(&self, vector: &Vector) -> Vector {
        self.rotation.carry(vector, self.turn, self.negligible)
    }
}

/// A rotation over one turn, for vectors along the normal.
#[derive(Clone, Copy, Debug)]
pub struct AlongNormal<'a> {
    /// The rotation.
    pub rotation: Rotation,
    /// The turn.
    pub turn: &'a Turn,
}

impl Carry for AlongNormal<'_> {
    #[inline(always)]
    fn carry(&self, vector: &Vector) -> Vector {
        self.rotation.carry_along_normal(vector, self.turn)
    }
}

impl Rotation {
    /// `vector` after `turn`. `projection_rescaled` leaves alone a vector whose part along the normal is at most
    /// `negligible`, as LAMMPS does.
    #[must_use]
    #[inline(always)]
    pub fn carry(self, vector: &Vector, turn: &Turn, negligible: f64) -> Vector {
        match self {
            Self::Rigid => rigid(vector, turn),
            Self::Projection => vector - turn.to * vector.dot(&turn.to),
            Self::ProjectionRescaled => {
                let along = vector.dot(&turn.to);
                let flat = vector - turn.to * along;
                let (before, after) = (vector.norm_squared(), flat.norm_squared());
                let kept = along.abs() <= negligible;
                let grown = if after > 0.0 { before / after } else { 0.0 };
                // One root of either: a root on one side only would be a branch.
                let stretch = if kept { 1.0 } else { grown }.sqrt();
                flat * stretch + turn.to * if kept { along } else { 0.0 }
            }
            Self::SmallAngles => {
                let tilted = vector - vector.cross(&turn.from.cross(&turn.to));
                tilted - tilted.cross(&(turn.from * turn.from.dot(&turn.spin)))
            }
            Self::Fixed => *vector,
        }
    }

    /// A vector along the normal after `turn`: twisting laws remember one.
    #[must_use]
    #[inline(always)]
    pub fn carry_along_normal(self, vector: &Vector, turn: &Turn) -> Vector {
        match self {
            Self::SmallAngles | Self::Fixed => self.carry(vector, turn, 0.0),
            _ => turn.to * vector.dot(&turn.from),
        }
    }
}

/// The rotation that takes one normal to the other along the great circle, then the one about the new normal. The second
/// is Cayley's, which keeps lengths exactly and angles to third order.
#[inline(always)]
fn rigid(vector: &Vector, turn: &Turn) -> Vector {
    let axis = turn.from.cross(&turn.to);
    let cosine = turn.from.dot(&turn.to);
    let tilted = vector * cosine + axis.cross(vector) + axis * (axis.dot(vector) / (1.0 + cosine));
    let tangent = 0.5 * turn.to.dot(&turn.spin);
    let scale = 2.0 / (1.0 + tangent * tangent);
    let once = turn.to.cross(&tilted);
    tilted + (once + turn.to.cross(&once) * tangent) * (scale * tangent)
}

#[cfg(test)]
mod tests {
    use nalgebra::Rotation3;
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn a_rigid_turn_keeps_lengths_and_takes_a_small_rotation_exactly_to_third_order(
            axis in (-1.0..1.0f64, -1.0..1.0f64, 0.1..1.0f64), vector in (-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64),
        ) {
            let angle = 1e-3;
            let rotation = Rotation3::new(Vector::new(axis.0, axis.1, axis.2).normalize() * angle);
            let from = Vector::x();
            let spin = rotation.scaled_axis();
            let turn = Turn { from, to: rotation * from, spin };
            let vector = Vector::new(vector.0, vector.1, vector.2);
            let carried = Rotation::Rigid.carry(&vector, &turn, 0.0);
            prop_assert!((carried.norm() - vector.norm()).abs() < 1e-15);
            prop_assert!((carried - rotation * vector).norm() < angle * angle * angle);
        }
    }

    #[test]
    fn each_rotation_breaks_length_as_its_table_says() {
        let angle: f64 = 1e-3;
        let to = Vector::new(angle.cos(), angle.sin(), 0.0);
        let turn = Turn { from: Vector::x(), to, spin: Vector::z() * angle };
        let grown = |rotation: Rotation| rotation.carry(&Vector::y(), &turn, 0.0).norm() - 1.0;
        let second = 0.5 * angle * angle;
        assert!((grown(Rotation::Projection) / -second - 1.0).abs() < 1e-5);
        assert!((grown(Rotation::SmallAngles) / second - 1.0).abs() < 1e-5);
        assert!(grown(Rotation::ProjectionRescaled).abs() < 1e-15);
        assert!(grown(Rotation::Rigid).abs() < 1e-15);
    }
}
