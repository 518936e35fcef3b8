//! A batch of contacts, one column per quantity, so that several are evaluated at a time.
//!
//! Columns have a fixed length and belong to one value on the stack: only so does the compiler know that no write of one
//! lane is read by another, and vectorises the loop over lanes. Lanes do not depend on each other, nothing is fused or
//! approximated: the bits are those of contacts evaluated one by one, for every width of vectors.

use crate::Vector;
use crate::geometry;
use crate::laws::model::ContactModel;
use crate::material::PairProperties;
use crate::particles::{Load, Motion, Place};

use super::sweep::contact;

/// Contacts of a batch.
pub const LANES: usize = 64;
/// Contacts below which a batch is not worth its empty lanes.
pub const FEWEST: usize = 8;

/// A column of numbers.
type Column = [f64; LANES];
/// Vectors as columns.
type Columns = [Column; 3];

#[inline(always)]
fn get(columns: &Columns, lane: usize) -> Vector {
    Vector::new(columns[0][lane], columns[1][lane], columns[2][lane])
}

#[inline(always)]
fn set(columns: &mut Columns, lane: usize, vector: &Vector) {
    columns[0][lane] = vector.x;
    columns[1][lane] = vector.y;
    columns[2][lane] = vector.z;
}

/// What contacts know before they are evaluated, what they remember, and what they do.
#[repr(align(64))]
pub struct Batch<H> {
    branch: Columns,
    velocity: Columns,
    angular_i: Columns,
    angular_j: Columns,
    radius_i: Column,
    radius_j: Column,
    mass_i: Column,
    mass_j: Column,
    young: Column,
    shear: Column,
    friction: Column,
    damping: Column,
    history: [H; LANES],
    alive: [u64; LANES],
    force: Columns,
    torque_i: Columns,
    torque_j: Columns,
}

impl<H: Copy + Default> Batch<H> {
    /// Lanes that no contact has filled.
    #[inline(always)]
    pub fn new() -> Self {
        let (column, columns) = ([1.0; LANES], [[1.0; LANES]; 3]);
        Self {
            branch: columns,
            velocity: columns,
            angular_i: columns,
            angular_j: columns,
            radius_i: column,
            radius_j: column,
            mass_i: column,
            mass_j: column,
            young: column,
            shear: column,
            friction: column,
            damping: column,
            history: [H::default(); LANES],
            alive: [0; LANES],
            force: columns,
            torque_i: columns,
            torque_j: columns,
        }
    }

    /// Fills a lane.
    #[inline(always)]
    pub fn fill(&mut self, lane: usize, [place_i, place_j]: [&Place; 2], [motion_i, motion_j]: [&Motion; 2], shift: &Vector, history: &H) {
        set(&mut self.branch, lane, &(place_i.position - place_j.position + shift));
        set(&mut self.velocity, lane, &(motion_i.velocity - motion_j.velocity));
        set(&mut self.angular_i, lane, &motion_i.angular_velocity);
        set(&mut self.angular_j, lane, &motion_j.angular_velocity);
        self.radius_i[lane] = place_i.radius;
        self.radius_j[lane] = place_j.radius;
        self.mass_i[lane] = motion_i.mass;
        self.mass_j[lane] = motion_j.mass;
        self.history[lane] = *history;
    }

    /// Gives a lane the values of its pair of materials.
    #[inline(always)]
    pub fn set_properties(&mut self, lane: usize, pair: &PairProperties) {
        self.young[lane] = pair.effective_young;
        self.shear[lane] = pair.effective_shear.unwrap_or_default();
        self.friction[lane] = pair.friction.unwrap_or_default();
        self.damping[lane] = pair.damping_ratio;
    }

    /// Evaluates all lanes, the empty ones too.
    #[inline(always)]
    pub fn evaluate<M: ContactModel<History = H>>(&mut self, model: M, shared: M::Shared, elapsed: f64) {
        // Rows of another length than the columns' need a place of their own.
        let mut histories = self.history;
        for lane in 0..LANES {
            let branch = get(&self.branch, lane);
            let squared = branch.norm_squared();
            let pair = PairProperties {
                between: [0; 2],
                effective_young: self.young[lane],
                effective_shear: Some(self.shear[lane]),
                damping_ratio: self.damping[lane],
                restitution: None,
                friction: Some(self.friction[lane]),
            };
            let contact = contact(
                &pair,
                geometry::spheres(branch, squared, self.radius_i[lane], self.radius_j[lane]),
                [self.mass_i[lane], self.mass_j[lane]],
                get(&self.velocity, lane),
                [get(&self.angular_i, lane), get(&self.angular_j, lane)],
            );
            let history = &mut histories[lane];
            self.alive[lane] = u64::from((squared > 0.0) & model.alive(contact.geometry.overlap, history));
            let action = model.evaluate(&contact, &shared, elapsed, history);
            set(&mut self.force, lane, &action.force);
            set(&mut self.torque_i, lane, &action.torque_i);
            set(&mut self.torque_j, lane, &action.torque_j);
        }
        self.history = histories;
    }

    /// What the contact of a lane remembers and does to both particles, if it lives.
    #[inline(always)]
    pub fn result(&self, lane: usize) -> Option<(H, [Load; 2])> {
        let force = get(&self.force, lane);
        let on_i = Load { force, torque: get(&self.torque_i, lane) };
        let on_j = Load { force: -force, torque: get(&self.torque_j, lane) };
        (self.alive[lane] != 0).then_some((self.history[lane], [on_i, on_j]))
    }
}
