//! Regions of a sample: their volume, and what of the particles lies in them.

use super::enclosure::{Enclosure, HalfSpace};
use super::sample::Sample;
use super::sphere_volume;
use super::touching::crossings;
use crate::Vector;
use crate::case::measure::Region;
use crate::case::quantity::Quantity;

/// Share of the centres that lie under the surface of a bed [-].
const UNDER_SURFACE: f64 = 0.97;

/// A region at one time.
#[derive(Clone, Debug)]
pub enum Part {
    /// What the walls and the domain enclose.
    Everything,
    /// A box [m].
    Box {
        /// Lower corner [m].
        min: [f64; 3],
        /// Upper corner [m].
        max: [f64; 3],
    },
    /// What lies between two heights, inside the walls and the domain.
    Slab {
        /// Where heights are zero [m].
        origin: Vector,
        /// Unit vector [-].
        up: Vector,
        /// Lower height [m].
        low: f64,
        /// Upper height [m]; below the lower one the region is empty.
        high: f64,
    },
}

impl Part {
    /// A region of a sample.
    ///
    /// # Errors
    /// The floor of a bed is no plane, or a part of a packing of disks is asked for.
    pub fn new(region: &Region, sample: &Sample) -> Result<Self, String> {
        if sample.system.disks && !matches!(region, Region::Everything {}) {
            return Err("of disks only the region `everything` is computed".to_owned());
        }
        Ok(match region {
            Region::Everything {} => Self::Everything,
            Region::Box { min, max } => Self::Box { min: min.map(Quantity::si), max: max.map(Quantity::si) },
            Region::Bed { floor, above_floor, below_surface } => {
                let (origin, up) = sample.plane(floor)?;
                let surface = surface(sample, &origin, &up);
                Self::Slab { origin, up, low: above_floor.si(), high: surface - below_surface.si() }
            }
        })
    }

    /// Its volume [m3], zero where it is empty.
    ///
    /// # Errors
    /// The walls enclose no computed shape.
    pub fn volume(&self, sample: &Sample) -> Result<f64, String> {
        let enclosed = |more: &[HalfSpace]| Enclosure::new(&sample.walls(), &sample.system.domain, more)?.volume();
        match self {
            Self::Everything => enclosed(&[]),
            Self::Box { min, max } => Ok((0..3).map(|axis| max[axis] - min[axis]).product()),
            Self::Slab { low, high, .. } if high <= low => Ok(0.0),
            Self::Slab { origin, up, low, high } => enclosed(&HalfSpace::slab(*origin, *up, *low, *high)),
        }
    }

    /// Volume of the parts of the particles in it [m3]. Walls cut no particle.
    #[must_use]
    pub fn solid(&self, sample: &Sample, radius: &[f64]) -> f64 {
        let parts = sample.centers().iter().zip(radius).map(|(center, radius)| match self {
            Self::Everything => sample.system.solid(*radius),
            Self::Box { min, max } => in_box(sample, center, *radius, min, max),
            Self::Slab { origin, up, low, high } => {
                let height = (center - origin).dot(up);
                sphere_volume::in_slab(*radius, low - height, high - height)
            }
        });
        parts.sum()
    }

    /// Whether it holds a place [m] or one of its images.
    #[must_use]
    pub fn holds(&self, sample: &Sample, place: &Vector) -> bool {
        match self {
            Self::Everything => true,
            Self::Box { min, max } => (0..3).all(|axis| {
                let (low, high) = (min[axis] - place[axis], max[axis] - place[axis]);
                let domain = &sample.system.domain;
                if domain.periodic[axis] {
                    !crossings(low, high, domain.length[axis]).is_empty()
                } else {
                    low <= 0.0 && 0.0 <= high
                }
            }),
            Self::Slab { origin, up, low, high } => {
                let height = (place - origin).dot(up);
                *low <= height && height <= *high
            }
        }
    }
}

/// Height over `origin` [m] of the highest of the lowest 97 % of the centres.
fn surface(sample: &Sample, origin: &Vector, up: &Vector) -> f64 {
    let mut heights: Vec<_> = sample.centers().iter().map(|center| (center - origin).dot(up)).collect();
    heights.sort_unstable_by(f64::total_cmp);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of a length")]
    let under = (UNDER_SURFACE * heights.len() as f64).ceil() as usize;
    heights.get(under.saturating_sub(1)).copied().unwrap_or(f64::NEG_INFINITY)
}

/// Volume of the parts of a sphere and its images in a box [m3].
#[must_use]
pub fn in_box(sample: &Sample, center: &Vector, radius: f64, min: &[f64; 3], max: &[f64; 3]) -> f64 {
    let domain = &sample.system.domain;
    let [first, second, third]: [_; 3] = std::array::from_fn(|axis| {
        let (low, high) = (min[axis] - radius - center[axis], max[axis] + radius - center[axis]);
        if domain.periodic[axis] { crossings(low, high, domain.length[axis]) } else { 0..=0 }
    });
    let mut volume = 0.0;
    for x in first {
        for y in second.clone() {
            for z in third.clone() {
                let center = center + domain.length.component_mul(&Vector::new(x as f64, y as f64, z as f64));
                let from_center = |corner: &[f64; 3]| std::array::from_fn(|axis| corner[axis] - center[axis]);
                volume += sphere_volume::in_box(radius, from_center(min), from_center(max));
            }
        }
    }
    volume
}
