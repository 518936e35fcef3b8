//! The Morton curve: neighbours in space become neighbours in memory.

use crate::Vector;
use crate::domain::Domain;
use crate::particles::Particles;

/// Bits per axis.
const BITS: u32 = 21;
/// Largest cell along an axis.
const LAST: f64 = ((1u64 << BITS) - 1) as f64;

/// The finest grid: its cells fit the smallest particle.
#[derive(Clone, Debug)]
pub struct Grid {
    /// Corner of the first cell [m].
    pub origin: Vector,
    /// Edge of a cell [m].
    pub edge: f64,
}

impl Grid {
    /// The grid for particles that are candidates up to a `gap` [m].
    #[must_use]
    pub fn new(particles: &Particles, domain: &Domain, gap: f64) -> Self {
        let smallest = particles.place.iter().map(|place| place.radius).fold(f64::INFINITY, f64::min);
        let edge = 2.0 * smallest + gap;
        let mut origin = domain.min;
        for axis in (0..3).filter(|axis| !domain.periodic[*axis]) {
            let lowest = particles.place.iter().map(|place| place.position[axis]).fold(f64::INFINITY, f64::min);
            origin[axis] = if lowest.is_finite() { lowest } else { 0.0 };
        }
        Self { origin, edge: if edge.is_finite() && edge > 0.0 { edge } else { 1.0 } }
    }

    /// Cell of a coordinate [m] along an axis; beyond the grid the last one.
    #[must_use]
    pub fn cell(&self, coordinate: f64, axis: usize) -> u32 {
        let cell = ((coordinate - self.origin[axis]) / self.edge).floor().clamp(0.0, LAST);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to 21 bits")]
        {
            cell as u32
        }
    }

    /// Number of the cell of a place on the curve.
    #[must_use]
    pub fn code(&self, position: &Vector) -> u64 {
        (0..3).map(|axis| spread(self.cell(position[axis], axis)) << axis).fold(0, |code, bits| code | bits)
    }

    /// Places in memory along the curve. Particles of one cell are ordered by their coordinates, so that the order
    /// depends on positions only.
    #[must_use]
    pub fn order(&self, particles: &Particles) -> Vec<u32> {
        let mut keys: Vec<(u64, u32)> =
            particles.place.iter().zip(0u32..).map(|(place, at)| (self.code(&place.position), at)).collect();
        let place = |at: u32| &particles.place[at as usize].position;
        keys.sort_unstable_by(|a, b| {
            a.0.cmp(&b.0).then_with(|| {
                let (one, other) = (place(a.1), place(b.1));
                let axes = (0..3).map(|axis| one[axis].total_cmp(&other[axis]));
                axes.fold(std::cmp::Ordering::Equal, std::cmp::Ordering::then)
            })
        });
        keys.into_iter().map(|(_, at)| at).collect()
    }
}

/// Puts two zero bits between the 21 bits of a number.
#[must_use]
pub fn spread(cell: u32) -> u64 {
    let mut bits = u64::from(cell) & 0x1f_ffff;
    bits = (bits | bits << 32) & 0x1f_0000_0000_ffff;
    bits = (bits | bits << 16) & 0x1f_0000_ff00_00ff;
    bits = (bits | bits << 8) & 0x100f_00f0_0f00_f00f;
    bits = (bits | bits << 4) & 0x10c3_0c30_c30c_30c3;
    (bits | bits << 2) & 0x1249_2492_4924_9249
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spreading_leaves_every_third_bit() {
        assert_eq!(spread(0b111), 0b100_1001);
        assert_eq!(spread(0x1f_ffff), 0x1249_2492_4924_9249);
    }
}
