//! Laws of rolling and twisting moments, one per file. A pair of laws acts together: rolling and twisting.

pub mod any;
pub mod constant_torque;
pub mod elastic_plastic_rolling;
pub mod rolling_options;
pub mod twisting;

use crate::Vector;
use crate::geometry::Surface;

use super::slider::Response;
use super::{Contact, Losses, MomentLaw, MomentState, NormalState, TangentialState};

impl<A: MomentLaw, B: MomentLaw> MomentLaw for (A, B) {
    type History = (A::History, B::History);

    #[inline(always)]
    fn evaluate(
        &self,
        contact: &Contact,
        normal: &NormalState,
        tangential: &TangentialState,
        dt: f64,
        history: &mut Self::History,
    ) -> MomentState {
        let first = self.0.evaluate(contact, normal, tangential, dt, &mut history.0);
        let second = self.1.evaluate(contact, normal, tangential, dt, &mut history.1);
        MomentState {
            moment: first.moment + second.moment,
            energy: first.energy + second.energy,
            losses: first.losses + second.losses,
        }
    }
}

impl MomentState {
    /// The moment of a spring.
    #[inline(always)]
    fn of(response: &Response) -> Self {
        Self {
            moment: response.force,
            energy: response.energy,
            losses: Losses {
                viscous: response.viscous,
                rolling: response.slider,
                carried: response.carried,
                ..Losses::default()
            },
        }
    }
}

/// Spin of i less that of j [rad/s].
#[inline(always)]
fn relative_spin(contact: &Contact) -> Vector {
    contact.angular_i - contact.angular_j
}

/// The spin that LIGGGHTS takes: at a wall it is stretched by (R - d/2) / (R - d).
#[inline(always)]
fn liggghts_spin(contact: &Contact) -> Vector {
    let geometry = &contact.geometry;
    if geometry.surface == Surface::Sphere {
        return relative_spin(contact);
    }
    let arm = geometry.radius_i - 0.5 * geometry.overlap;
    contact.angular_i * (arm / (geometry.radius_i - geometry.overlap))
}

/// Moment of inertia of both bodies about the contact, 7/5 of the reduced m R^2 [kg m2].
#[inline(always)]
fn rolling_inertia(contact: &Contact) -> f64 {
    let geometry = &contact.geometry;
    let [mass_i, mass_j] = contact.masses;
    let own = mass_i * geometry.radius_i * geometry.radius_i;
    let other = mass_j * geometry.radius_j * geometry.radius_j;
    1.4 * if other.is_finite() { crate::material::reduced(own, other) } else { own }
}

/// A contact along x at rest but for the spin of i [rad/s], with unlike spheres.
#[cfg(test)]
pub(crate) fn probe(spin: Vector) -> (Contact, NormalState, TangentialState) {
    use super::{NormalLaw, PairLaw, normal::hertz::Hertz};
    let geometry = crate::geometry::spheres(Vector::x() * 2.999e-3, 2.999e-3 * 2.999e-3, 1e-3, 2e-3);
    let pair = PairLaw {
        effective_young: 5e6,
        effective_radius: geometry.effective_radius(),
        effective_mass: 1e-5,
        rolling_friction: 0.2,
        twisting_friction: 0.3,
        ..PairLaw::default()
    };
    let velocity = Vector::zeros();
    let contact = Contact { pair, geometry, velocity, angular_i: spin, angular_j: velocity, masses: [1.5e-5, 3e-5] };
    let normal = Hertz { force_cut: true }.evaluate(&pair, &contact.approach(), &(), &mut ());
    let tangential = TangentialState {
        force: velocity,
        sliding: false,
        limit: 0.0,
        arms: [1e-3, 2e-3],
        stiffness: 500.0,
        dashpot: 0.1,
        energy: 0.0,
        losses: Losses::default(),
    };
    (contact, normal, tangential)
}
