//! Packing fractions: volume of the particles over the volume that holds them [-].
//!
//! | symbol | meaning |
//! |---|---|
//! | V | volume of all particles, overlaps counted twice [m3] |
//! | A | area of the floor between the walls [m2] |
//! | z | height of the centre of mass over the floor [m] |
//!
//! In a region: the sum of the exact parts of the spheres in it over its volume. By the centre of mass: a bed of uniform
//! packing fraction on a floor between vertical walls has its surface at 2 z, so that phi = V / (2 A z); no surface needs
//! to be found. Volumes: [`super::sphere_volume`].

use super::enclosure::{Enclosure, HalfSpace};
use super::region::Part;
use super::sample::Sample;
use super::sphere_volume;
use super::touching::crossings;
use crate::Vector;
use crate::bodies::BodyShape;
use crate::case::measure::{Bins, Radii, Region};

/// In a region; NaN where the region is empty.
///
/// # Errors
/// The region is not computed.
pub fn fraction(sample: &Sample, region: &Region, radii: Radii) -> Result<f64, String> {
    let part = Part::new(region, sample)?;
    let volume = part.volume(sample)?;
    let radius = match radii {
        Radii::Present => sample.radius(),
        Radii::Start => &sample.system.radius,
    };
    Ok(if volume > 0.0 { part.solid(sample, radius) / volume } else { f64::NAN })
}

/// By the centre of mass; NaN where the floor lies outside the domain or the walls.
///
/// # Errors
/// The floor is no plane, or walls enclose no computed shape.
pub fn by_center(sample: &Sample, floor: &str) -> Result<f64, String> {
    let (point, normal) = sample.plane(floor)?;
    let area =
        Enclosure::new(&sample.walls(), &sample.system.domain, &[])?.area(point, &BodyShape::Plane { normal })?;
    let (mut moment, mut mass, mut solid) = (0.0, 0.0, 0.0);
    for ((center, radius), m) in sample.centers().iter().zip(sample.radius()).zip(&sample.system.mass) {
        moment += m * (center - point).dot(&normal);
        mass += m;
        solid += sample.system.solid(*radius);
    }
    Ok(if area > 0.0 { solid / (2.0 * area * moment / mass) } else { f64::NAN })
}

/// In each bin; NaN where nothing is enclosed.
///
/// # Errors
/// Walls enclose no computed shape.
pub fn profile(sample: &Sample, bins: &Bins) -> Result<Vec<f64>, String> {
    if sample.system.disks {
        return Err("profiles of disks are not computed".to_owned());
    }
    let axis = bins.axis as usize;
    let domain = &sample.system.domain;
    let walls = sample.walls();
    let mut solid = vec![0.0; bins.count()];
    for (center, radius) in sample.centers().iter().zip(sample.radius()) {
        let (low, high) = (bins.from.si() - radius - center[axis], bins.to.si() + radius - center[axis]);
        let images = if domain.periodic[axis] { crossings(low, high, domain.length[axis]) } else { 0..=0 };
        for image in images {
            let place = center[axis] + image as f64 * domain.length[axis];
            for (bin, solid) in solid.iter_mut().enumerate() {
                let [low, high] = bins.bounds(bin);
                *solid += sphere_volume::in_slab(*radius, low - place, high - place);
            }
        }
    }
    let up = Vector::ith(axis, 1.0);
    let fraction = |(bin, solid): (usize, f64)| {
        let [low, high] = bins.bounds(bin);
        let volume = Enclosure::new(&walls, domain, &HalfSpace::slab(Vector::zeros(), up, low, high))?.volume()?;
        Ok(if volume > 0.0 { solid / volume } else { f64::NAN })
    };
    solid.into_iter().enumerate().map(fraction).collect()
}
