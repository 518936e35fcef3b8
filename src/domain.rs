//! The box: open and periodic axes.
//!
//! Particles re-enter a periodic axis when the neighbour list is built, never between. The image in which a pair meets
//! is therefore fixed while a list lives, and is stored with the pair as a number from 0 to 26.

use crate::Vector;
use crate::case::scene::SceneDomain;
use crate::case::schema::Boundary;

/// The image of a pair that meets without crossing a face.
pub const HOME: u32 = 13;

/// The box.
#[derive(Clone, Debug)]
pub struct Domain {
    /// Lower corner [m].
    pub min: Vector,
    /// Edges [m].
    pub length: Vector,
    /// Which axes are periodic.
    pub periodic: [bool; 3],
}

impl Domain {
    /// The box of a scene.
    #[must_use]
    pub fn new(scene: &SceneDomain) -> Self {
        let (min, max) = (Vector::from(scene.min), Vector::from(scene.max));
        Self { min, length: max - min, periodic: scene.boundary.map(|boundary| boundary == Boundary::Periodic) }
    }

    /// The place in the box that a particle at `position` [m] has by periodicity, and how many edges lie between the two
    /// along each axis; places inside keep their bits.
    #[must_use]
    pub fn wrap(&self, position: Vector) -> (Vector, [i32; 3]) {
        let (mut place, mut crossings) = (position, [0; 3]);
        for axis in (0..3).filter(|axis| self.periodic[*axis]) {
            let (min, edge) = (self.min[axis], self.length[axis]);
            let from = position[axis] - min;
            if from < 0.0 || from >= edge {
                let mut edges = (from / edge).floor();
                place[axis] = min + (from - edge * edges);
                // A place just below the lower face is rounded onto the upper one, which is the lower one again.
                if place[axis] - min >= edge {
                    place[axis] = min;
                    edges += 1.0;
                }
                #[expect(clippy::cast_possible_truncation, reason = "only a run that diverges comes so far")]
                {
                    crossings[axis] = edges as i32;
                }
            }
        }
        (place, crossings)
    }

    /// The image in which two places of the box are nearest, from their `branch` [m].
    #[must_use]
    pub fn image(&self, branch: Vector) -> u32 {
        let mut image = 0;
        for axis in (0..3).rev() {
            let half = 0.5 * self.length[axis];
            let crossing = match branch[axis] {
                apart if self.periodic[axis] && apart > half => 0,
                apart if self.periodic[axis] && apart < -half => 2,
                _ => 1,
            };
            image = 3 * image + crossing;
        }
        image
    }

    /// The branch between the nearest images of two places of the box, from their `branch` [m].
    #[must_use]
    pub fn nearest(&self, branch: Vector) -> Vector {
        let mut near = branch;
        for axis in 0..3 {
            let edge = self.length[axis];
            if self.periodic[axis] && near[axis].abs() > 0.5 * edge {
                near[axis] -= edge.copysign(near[axis]);
            }
        }
        near
    }

    /// The vector to add to a branch, for every image [m].
    #[must_use]
    pub fn shifts(&self) -> [Vector; 32] {
        let mut shifts = [Vector::zeros(); 32];
        for (image, shift) in shifts.iter_mut().enumerate().take(27) {
            let step = |axis: usize| match image / 3usize.pow(u32::try_from(axis).unwrap_or(0)) % 3 {
                0 => -self.length[axis],
                2 => self.length[axis],
                _ => 0.0,
            };
            *shift = Vector::new(step(0), step(1), step(2));
        }
        shifts
    }

    /// The first periodic axis that is shorter than two cutoffs: a particle would meet a neighbour twice on it.
    #[must_use]
    pub fn too_short(&self, cutoff: f64) -> Option<usize> {
        (0..3).find(|axis| self.periodic[*axis] && self.length[*axis] < 2.0 * cutoff)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shift_of_an_image_makes_the_branch_shortest() {
        let domain = Domain { min: Vector::zeros(), length: Vector::new(1.0, 2.0, 3.0), periodic: [true, true, false] };
        let branch = Vector::new(0.9, -1.5, 2.9);
        let near = branch + domain.shifts()[domain.image(branch) as usize];
        assert_eq!(near, domain.nearest(branch));
        assert!((near - Vector::new(-0.1, 0.5, 2.9)).norm() < 1e-15);
        assert_eq!(domain.image(Vector::new(0.4, 0.9, -2.0)), HOME);
    }

    #[test]
    fn wrapping_keeps_places_inside() {
        let domain = Domain { min: Vector::repeat(-1.0), length: Vector::repeat(2.0), periodic: [true, false, true] };
        let place = Vector::new(0.123, 7.0, -0.9);
        assert_eq!(domain.wrap(place), (place, [0; 3]));
        let (place, crossings) = domain.wrap(Vector::new(1.5, 9.0, -5.5));
        assert!((place - Vector::new(-0.5, 9.0, 0.5)).norm() < 1e-15);
        assert_eq!(crossings, [1, 0, -3]);
    }

    #[test]
    fn wrapping_twice_changes_no_bit() {
        let domain = Domain { min: Vector::repeat(0.3), length: Vector::repeat(0.7), periodic: [true; 3] };
        for offset in [-1e-20, -1e-17, -1e-16, 0.7, 0.7 - 1e-16, 0.7 + 1e-16, 2.1, -0.7, -1.4 - 1e-16] {
            let (once, _) = domain.wrap(Vector::repeat(0.3 + offset));
            assert_eq!(domain.wrap(once), (once, [0; 3]), "{offset:e}");
        }
        let (origin, crossings) = Domain { min: Vector::zeros(), ..domain }.wrap(Vector::repeat(-1e-20));
        assert_eq!((origin, crossings), (Vector::zeros(), [0; 3]));
    }
}
