//! Who touches whom by geometry: a contact is an overlap above zero. Periodic images count, also a particle's own.
//!
//! Particles and the images that may reach into the box are sorted into cells of the largest diameter.

use super::sample::Sample;
use crate::Vector;

/// Contacts of a sample by geometry.
#[derive(Clone, Debug, Default)]
pub struct Touching {
    /// Contacts of two particles, each once.
    pub pairs: Vec<[usize; 2]>,
    /// Overlap over the sum of the radii, of each [-].
    pub overlaps: Vec<f64>,
    /// Contacts of a particle with a body.
    pub walls: Vec<[usize; 2]>,
}

/// A particle, or an image of one.
struct Image {
    cell: [i64; 3],
    particle: usize,
    /// Edges between it and the particle.
    crossings: [i64; 3],
    center: Vector,
}

/// Finds the contacts of a sample.
#[must_use]
pub fn find(sample: &Sample) -> Touching {
    let (centers, radius) = (sample.centers(), sample.radius());
    let mut found = Touching::default();
    let edge = 2.0 * radius.iter().copied().fold(0.0, f64::max);
    let images = images(sample, edge);
    for (i, center) in centers.iter().enumerate() {
        let cell = cell_of(center, edge);
        for beside in 0..9 {
            // Cells along the last axis stand together.
            let (x, y) = (cell[0] + beside / 3 - 1, cell[1] + beside % 3 - 1);
            let from = images.partition_point(|image| image.cell < [x, y, cell[2] - 1]);
            for image in images[from..].iter().take_while(|image| image.cell <= [x, y, cell[2] + 1]) {
                let later = (image.particle, image.crossings) > (i, [0; 3]);
                let reach = radius[i] + radius[image.particle];
                let distance = (center - image.center).norm();
                if later && reach > distance {
                    found.pairs.push([i, image.particle]);
                    found.overlaps.push((reach - distance) / reach);
                }
            }
        }
        for body in 0..sample.system.bodies.len() {
            if sample.at_wall(i, body).is_some_and(|contact| contact.overlap > 0.0) {
                found.walls.push([i, body]);
            }
        }
    }
    found
}

#[expect(clippy::cast_possible_truncation, reason = "a place that is no number has no neighbours")]
fn cell_of(center: &Vector, edge: f64) -> [i64; 3] {
    // Bounded, so that the cells beside it have numbers.
    std::array::from_fn(|axis| (center[axis] / edge).floor().clamp(-1e15, 1e15) as i64)
}

/// All particles and those images that lie no farther than `reach` [m] outside the box, in the order of cells.
fn images(sample: &Sample, reach: f64) -> Vec<Image> {
    let domain = &sample.system.domain;
    let mut images = Vec::with_capacity(sample.centers().len());
    for (particle, home) in sample.centers().iter().enumerate() {
        let ranges: [_; 3] = std::array::from_fn(|axis| {
            let (low, length) = (domain.min[axis] - home[axis], domain.length[axis]);
            if domain.periodic[axis] { crossings(low - reach, low + length + reach, length) } else { 0..=0 }
        });
        let [first, second, third] = ranges;
        for x in first {
            for y in second.clone() {
                for z in third.clone() {
                    let crossings = [x, y, z];
                    let center = home + domain.length.component_mul(&Vector::from(crossings.map(|k| k as f64)));
                    images.push(Image { cell: cell_of(&center, reach), particle, crossings, center });
                }
            }
        }
    }
    images.sort_unstable_by_key(|image| (image.cell, image.particle, image.crossings));
    images
}

/// The whole numbers k for which `low` <= k `length` <= `high`.
#[must_use]
#[expect(clippy::cast_possible_truncation, reason = "only lengths beyond 1e18 boxes would not fit")]
pub fn crossings(low: f64, high: f64, length: f64) -> std::ops::RangeInclusive<i64> {
    (low / length).ceil() as i64..=(high / length).floor() as i64
}
