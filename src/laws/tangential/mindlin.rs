//! Mindlin's no-slip stiffness with a displacement history and a Coulomb cap.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | s | tangential displacement that the contact remembers | m |
//! | v | slip velocity of i against j in the contact plane | m/s |
//! | a | contact radius | m |
//! | G*, m* | effective shear modulus and mass | Pa, kg |
//! | beta, mu | fraction of critical damping, coefficient of friction | - |
//! | k = 8 G* a | tangential stiffness | N/m |
//! | g = 2 sqrt(5/6) beta sqrt(k m*) | dashpot constant | kg/s |
//!
//! Before a step s is projected into the present contact plane and rescaled to its length; then s += v dt. Force on i:
//! F = -k s - g v, scaled down to mu F_n where it is larger; s is then set so that the same force comes of it.
//! Arms: R - overlap / 2. Source: Mindlin, Deresiewicz, *J. Appl. Mech.* 20 (1953) 327, without partial slip.

use crate::Vector;
use crate::laws::{Contact, NormalState, TangentialLaw, TangentialState};

/// The law; its values come with each pair.
#[derive(Clone, Copy, Debug)]
pub struct Mindlin;

impl TangentialLaw for Mindlin {
    type History = Vector;

    #[inline(always)]
    fn evaluate(&self, contact: &Contact, normal: &NormalState, dt: f64, history: &mut Vector) -> TangentialState {
        let geometry = &contact.geometry;
        let direction = geometry.normal;
        let arm_i = geometry.radius_i - 0.5 * geometry.overlap;
        let arm_j = if geometry.radius_j.is_finite() && geometry.radius_j > 0.0 {
            geometry.radius_j - 0.5 * geometry.overlap
        } else {
            0.0
        };
        let spin = contact.angular_i * arm_i + contact.angular_j * arm_j;
        let surface = contact.velocity - spin.cross(&direction);
        let slip = surface - direction * surface.dot(&direction);

        let old = *history;
        let flat = old - direction * old.dot(&direction);
        let (before, after) = (old.norm_squared(), flat.norm_squared());
        let stretch = if after > 0.0 { (before / after).sqrt() } else { 0.0 };
        let displacement = flat * stretch + slip * dt;

        let stiffness = 8.0 * contact.pair.effective_shear * normal.contact_radius;
        let constant = 2.0 * (5.0f64 / 6.0).sqrt() * contact.pair.damping_ratio;
        let dashpot = constant * (stiffness * contact.pair.effective_mass).sqrt();
        let trial = displacement * -stiffness - slip * dashpot;
        let cap = contact.pair.friction * normal.force.abs();
        let squared = trial.norm_squared();
        let sliding = squared > cap * cap;
        if sliding {
            let force = trial * (cap / squared.sqrt());
            *history = (force + slip * dashpot) * (-1.0 / stiffness);
            TangentialState { force, sliding, arms: [arm_i, arm_j] }
        } else {
            *history = displacement;
            TangentialState { force: trial, sliding, arms: [arm_i, arm_j] }
        }
    }
}
