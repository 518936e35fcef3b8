//! Forces and stresses on walls.
//!
//! | symbol | meaning |
//! |---|---|
//! | F, A | force of the particles on a wall [N], area of the wall inside the domain and the other walls [m2] |
//! | e | unit vector of the stated direction [-] |
//! | fc, nc | force of a contact on its particle [N], unit normal to the particle [-] |
//! | M, g | mass of all particles [kg], acceleration of gravity [m/s2] |
//! | mu | friction of particle and wall [-] |
//!
//! Force F . e, stress F . e / A, line stress F . e / length. In a bin of area A: normal stress sum(fc . nc) / A, shear
//! stress of the wall along the axis a of the bins -sum((fc - (fc . nc) nc) . a) / A. Share of the weight
//! sum(F) . g / (M g^2). Mobilisation abs(sum(shear . e)) / sum(mu fc . nc). A contact is in the bin of the point
//! of the wall that it touches. Source: balance of forces; Coulomb's law of friction.

use super::enclosure::{Enclosure, HalfSpace};
use super::sample::{Contact, Sample};
use super::system::Partner;
use crate::Vector;
use crate::bodies::BodyShape;
use crate::case::measure::{Bins, WallComponent};
use crate::case::quantity::Number;

/// Largest sine of the angle between parallel planes [-].
const PARALLEL: f64 = 1e-9;

fn unit(direction: &[Number; 3]) -> Vector {
    Vector::from(direction.map(Number::get)).normalize()
}

/// Force on a wall along a direction [N].
///
/// # Errors
/// The record has no forces on bodies.
pub fn force(sample: &Sample, body: &str, direction: &[Number; 3]) -> Result<f64, String> {
    Ok(sample.body_force(body)?.dot(&unit(direction)))
}

/// That force over the area of the wall [Pa]; NaN where no part of it bounds the particles.
///
/// # Errors
/// The record has no forces on bodies, or the area is not computed.
pub fn stress(sample: &Sample, body: &str, direction: &[Number; 3]) -> Result<f64, String> {
    let force = force(sample, body, direction)?;
    let area = area(sample, body, &[])?;
    Ok(if area > 0.0 { force / area } else { f64::NAN })
}

fn area(sample: &Sample, body: &str, more: &[HalfSpace]) -> Result<f64, String> {
    let at = sample.system.body(body)?;
    Enclosure::new(&sample.walls(), &sample.system.domain, more)?
        .area(sample.point(at), &sample.system.bodies[at].shape)
}

/// That force over the distance of two walls [N/m].
///
/// # Errors
/// The record has no forces on bodies, or the walls are no parallel planes.
pub fn line_stress(sample: &Sample, body: &str, direction: &[Number; 3], between: &[String; 2]) -> Result<f64, String> {
    Ok(force(sample, body, direction)? / distance(sample, between)?)
}

/// Distance of two parallel planes [m].
///
/// # Errors
/// The walls are no parallel planes.
pub fn distance(sample: &Sample, between: &[String; 2]) -> Result<f64, String> {
    let (first, normal) = sample.plane(&between[0])?;
    let (second, other) = sample.plane(&between[1])?;
    if normal.cross(&other).norm() > PARALLEL {
        return Err(format!("the planes {} and {} are not parallel", between[0], between[1]));
    }
    Ok((second - first).dot(&normal).abs())
}

/// Contacts of a wall.
fn contacts<'a>(sample: &'a Sample, body: &str) -> Result<impl Iterator<Item = &'a Contact>, String> {
    let at = sample.system.body(body)?;
    Ok(sample.contacts()?.iter().filter(move |contact| contact.partner == Partner::Body(at)))
}

/// Stress on a wall in each bin [Pa]; NaN where a bin has no part of the wall.
///
/// # Errors
/// The record has no contacts, the axis is not along a cylinder, or the area is not computed.
pub fn stress_profile(sample: &Sample, body: &str, component: WallComponent, bins: &Bins) -> Result<Vec<f64>, String> {
    let up = Vector::ith(bins.axis as usize, 1.0);
    along(sample, body, &up)?;
    let mut sums = vec![0.0; bins.count()];
    for contact in contacts(sample, body)? {
        if let Some(bin) = bins.bin(contact.place[bins.axis as usize]) {
            sums[bin] += match component {
                WallComponent::Normal => contact.normal_force(),
                WallComponent::Shear => -contact.tangential_force().dot(&up),
            };
        }
    }
    let stress = |(bin, sum): (usize, f64)| {
        let [low, high] = bins.bounds(bin);
        let area = area(sample, body, &HalfSpace::slab(Vector::zeros(), up, low, high))?;
        Ok(if area > 0.0 { sum / area } else { f64::NAN })
    };
    sums.into_iter().enumerate().map(stress).collect()
}

/// Refuses bins across the axis of a cylinder or along the normal of a plane.
fn along(sample: &Sample, body: &str, up: &Vector) -> Result<(), String> {
    let (lies_along, what) = match sample.system.bodies[sample.system.body(body)?].shape {
        BodyShape::Plane { normal } => (normal.cross(up).norm() > PARALLEL, "the axis of the bins is its normal"),
        BodyShape::Cylinder { axis, .. } => (axis.cross(up).norm() < PARALLEL, "the axis of the bins is not its axis"),
    };
    if lies_along { Ok(()) } else { Err(format!("body {body}: {what}")) }
}

/// Force on some walls along gravity over the weight of all particles [-].
///
/// # Errors
/// The record has no forces on bodies, or there is no gravity.
pub fn weight_share(sample: &Sample, bodies: &[String]) -> Result<f64, String> {
    let weight = sample.system.weight()?;
    let mut sum = Vector::zeros();
    for body in bodies {
        sum += sample.body_force(body)?;
    }
    Ok(sum.dot(&sample.system.gravity.normalize()) / weight)
}

/// Shear and the largest that friction allows, summed in each of `count` bins.
fn limits(
    sample: &Sample,
    body: &str,
    direction: &Vector,
    count: usize,
    bin: impl Fn(&Contact) -> Option<usize>,
) -> Result<Vec<f64>, String> {
    let mut sums = vec![[0.0; 2]; count];
    for contact in contacts(sample, body)? {
        if let Some(bin) = bin(contact) {
            let friction = sample.system.friction(contact.particle, contact.partner)?;
            sums[bin][0] += contact.tangential_force().dot(direction);
            sums[bin][1] += friction * contact.normal_force();
        }
    }
    Ok(sums.into_iter().map(|[shear, limit]| if limit > 0.0 { shear.abs() / limit } else { f64::NAN }).collect())
}

/// Mobilisation of a wall [-]; NaN where nothing presses on it or there is no friction.
///
/// # Errors
/// The record has no contacts, or the friction is not stated.
pub fn mobilisation(sample: &Sample, body: &str, direction: &[Number; 3]) -> Result<Vec<f64>, String> {
    limits(sample, body, &unit(direction), 1, |_| Some(0))
}

/// Mobilisation of a wall in each bin [-]; NaN as for the whole.
///
/// # Errors
/// The record has no contacts, or the friction is not stated.
pub fn mobilisation_profile(sample: &Sample, body: &str, bins: &Bins) -> Result<Vec<f64>, String> {
    let axis = bins.axis as usize;
    limits(sample, body, &Vector::ith(axis, 1.0), bins.count(), |contact| bins.bin(contact.place[axis]))
}
