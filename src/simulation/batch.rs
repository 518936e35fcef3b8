//! A batch of contacts, evaluated several at a time.
//!
//! Rows have a fixed length and belong to one value on the stack: only so does the compiler know that no write of one lane
//! is read by another, and vectorises the loop over lanes. Lanes do not depend on each other, nothing is fused or
//! approximated: the bits are those of contacts evaluated one by one, for every width of vectors. Rows of four numbers are
//! copied from and added to particles at once; the loop over lanes takes them apart. Every entry of a row is read: behind
//! rows with gaps the compiler leaves the last vector of lanes to a scalar loop, an eighth of them at three times the cost.

use crate::Vector;
use crate::domain::Domain;
use crate::geometry;
use crate::laws::model::ContactModel;
use crate::material::PairProperties;
use crate::particles::{Load, Motion, Place};

use super::sweep::contact;

/// Contacts of a batch.
pub const LANES: usize = 64;
/// Contacts below which a batch is not worth its empty lanes.
pub const FEWEST: usize = 8;

/// Four numbers that stand together in memory.
pub type Row = [f64; 4];
/// One row for each contact.
type Rows = [Row; LANES];
/// One number for each contact.
type Column = [f64; LANES];

/// What contacts know before they are evaluated, what they remember, and what they do.
#[repr(align(64))]
pub struct Batch<H> {
    /// Branch vector (from j to i), and the coefficient of friction.
    branch: Rows,
    /// Velocity and the first component of the angular velocity, of i and j.
    velocity: [Rows; 2],
    /// The other components of the angular velocity, mass and radius.
    rest: [Rows; 2],
    young: Column,
    shear: Column,
    damping: Column,
    cohesive: [bool; LANES],
    history: [H; LANES],
    alive: [u64; LANES],
    /// Force on i and j, and the first component of the torque.
    force: [Rows; 2],
    /// The other components of the torque on i, then on j.
    torque: Rows,
}

/// The row of a vector that has no fourth entry.
fn row(vector: &Vector) -> Row {
    [vector.x, vector.y, vector.z, 0.0]
}

/// What the images of pairs add to branches [m].
pub struct Images {
    /// For each image.
    pub shifts: [Vector; 32],
    /// The same, as rows.
    pub rows: [Row; 32],
}

impl Images {
    /// Those of a domain.
    pub fn new(domain: &Domain) -> Self {
        let shifts = domain.shifts();
        Self { rows: shifts.each_ref().map(row), shifts }
    }
}

impl<H: Copy + Default> Batch<H> {
    /// Lanes that no contact has filled.
    #[inline(always)]
    pub fn new() -> Self {
        let (column, rows) = ([1.0; LANES], [[1.0; 4]; LANES]);
        Self {
            branch: rows,
            velocity: [rows; 2],
            rest: [rows; 2],
            young: column,
            shear: column,
            damping: column,
            cohesive: [false; LANES],
            history: [H::default(); LANES],
            alive: [0; LANES],
            force: [rows; 2],
            torque: rows,
        }
    }

    /// Fills a lane; `shift` is that of the image in which the pair meets [m].
    #[inline(always)]
    pub fn fill(
        &mut self,
        lane: usize,
        places: [&Place; 2],
        motions: [&Motion; 2],
        shift: &Row,
        friction: Option<f64>,
        history: &H,
    ) {
        let [near, far] = places.map(|place| &place.position);
        let branch = [0, 1, 2].map(|k| near[k] - far[k] + shift[k]);
        self.branch[lane] = [branch[0], branch[1], branch[2], friction.unwrap_or_default()];
        for end in 0..2 {
            let (v, w) = (&motions[end].velocity, &motions[end].angular_velocity);
            self.velocity[end][lane] = [v.x, v.y, v.z, w.x];
            self.rest[end][lane] = [w.y, w.z, motions[end].mass, places[end].radius];
        }
        self.history[lane] = *history;
    }

    /// Gives a lane the values of its pair of materials.
    #[inline(always)]
    pub fn set_properties(&mut self, lane: usize, pair: &PairProperties) {
        self.young[lane] = pair.effective_young;
        self.shear[lane] = pair.effective_shear.unwrap_or_default();
        self.damping[lane] = pair.damping_ratio;
        self.cohesive[lane] = pair.cohesive.unwrap_or_default();
    }

    /// Evaluates all lanes, the empty ones too.
    #[inline(always)]
    pub fn evaluate<M: ContactModel<History = H>>(&mut self, model: M, shared: M::Shared, elapsed: f64) {
        // Rows of another length need a place of their own.
        let mut histories = self.history;
        if model.renews(&shared) {
            for history in &mut histories {
                model.renew(&shared, history);
            }
        }
        #[expect(clippy::needless_range_loop, reason = "one index for all columns, which the compiler vectorises")]
        for lane in 0..LANES {
            let [x, y, z, friction] = self.branch[lane];
            let branch = Vector::new(x, y, z);
            let squared = branch.norm_squared();
            let [(velocity_i, angular_i, mass_i, radius_i), (velocity_j, angular_j, mass_j, radius_j)] =
                [0, 1].map(|end| {
                    let ([vx, vy, vz, wx], [wy, wz, mass, radius]) = (self.velocity[end][lane], self.rest[end][lane]);
                    (Vector::new(vx, vy, vz), Vector::new(wx, wy, wz), mass, radius)
                });
            let pair = PairProperties {
                effective_young: self.young[lane],
                effective_shear: Some(self.shear[lane]),
                damping_ratio: self.damping[lane],
                friction: Some(friction),
                cohesive: Some(self.cohesive[lane]),
                ..PairProperties::default()
            };
            let contact = contact(
                &pair,
                geometry::spheres(branch, squared, radius_i, radius_j),
                [mass_i, mass_j],
                velocity_i - velocity_j,
                [angular_i, angular_j],
            );
            let history = &mut histories[lane];
            self.alive[lane] = u64::from((squared > 0.0) & model.alive(contact.geometry.overlap, history));
            let action = model.act(&contact, &shared, elapsed, history);
            let (force, on_i, on_j) = (action.force, action.torque_i, action.torque_j);
            self.force[0][lane] = [force.x, force.y, force.z, on_i.x];
            self.force[1][lane] = [-force.x, -force.y, -force.z, on_j.x];
            self.torque[lane] = [on_i.y, on_i.z, on_j.y, on_j.z];
        }
        self.history = histories;
    }

    /// What the contact of a lane remembers, if it lives.
    #[inline(always)]
    pub fn history(&self, lane: usize) -> Option<&H> {
        (self.alive[lane] != 0).then_some(&self.history[lane])
    }

    /// Adds what the contact of a lane does to i (`END` 0) or j (1).
    #[inline(always)]
    pub fn push<const END: usize>(&self, lane: usize, load: &mut Load) {
        let ([x, y, z, first], torque) = (self.force[END][lane], self.torque[lane]);
        load.force.x += x;
        load.force.y += y;
        load.force.z += z;
        load.torque.x += first;
        load.torque.y += torque[2 * END];
        load.torque.z += torque[2 * END + 1];
    }
}
