//! A batch of contacts, one column per quantity, so that several are evaluated at a time.

use crate::Vector;
use crate::contacts::Account;

/// Contacts of a batch.
pub const LANES: usize = 64;

/// Vectors as columns.
pub struct Vectors([[f64; LANES]; 3]);

impl Vectors {
    const ZERO: Self = Self([[0.0; LANES]; 3]);

    #[inline(always)]
    pub fn get(&self, lane: usize) -> Vector {
        Vector::new(self.0[0][lane], self.0[1][lane], self.0[2][lane])
    }

    #[inline(always)]
    pub fn set(&mut self, lane: usize, vector: &Vector) {
        self.0[0][lane] = vector.x;
        self.0[1][lane] = vector.y;
        self.0[2][lane] = vector.z;
    }
}

/// What contacts know before they are evaluated.
pub struct States {
    pub branch: Vectors,
    pub velocity: Vectors,
    pub angular_i: Vectors,
    pub angular_j: Vectors,
    pub radius_i: [f64; LANES],
    pub radius_j: [f64; LANES],
    pub mass_i: [f64; LANES],
    pub mass_j: [f64; LANES],
    pub young: [f64; LANES],
    pub shear: [f64; LANES],
    pub friction: [f64; LANES],
    pub damping: [f64; LANES],
}

impl States {
    pub fn new() -> Self {
        let scalars = [0.0; LANES];
        Self {
            branch: Vectors::ZERO,
            velocity: Vectors::ZERO,
            angular_i: Vectors::ZERO,
            angular_j: Vectors::ZERO,
            radius_i: scalars,
            radius_j: scalars,
            mass_i: scalars,
            mass_j: scalars,
            young: scalars,
            shear: scalars,
            friction: scalars,
            damping: scalars,
        }
    }
}

/// What they do.
pub struct Actions {
    pub alive: [bool; LANES],
    pub force: Vectors,
    pub torque_i: Vectors,
    pub torque_j: Vectors,
    pub normal_force: [f64; LANES],
    pub damping_force: [f64; LANES],
    pub energy: [f64; LANES],
    pub approach: [f64; LANES],
}

impl Actions {
    pub fn new() -> Self {
        let scalars = [0.0; LANES];
        Self {
            alive: [false; LANES],
            force: Vectors::ZERO,
            torque_i: Vectors::ZERO,
            torque_j: Vectors::ZERO,
            normal_force: scalars,
            damping_force: scalars,
            energy: scalars,
            approach: scalars,
        }
    }

    pub fn account(&self, lane: usize) -> Account {
        Account {
            force: self.force.get(lane),
            normal_force: self.normal_force[lane],
            damping_force: self.damping_force[lane],
            energy: self.energy[lane],
        }
    }
}
