//! The collision that all codes were measured with, and its walls.

use crossgrain::Vector;
use crossgrain::geometry::Surface;
use crossgrain::laws::PairLaw;
use crossgrain::laws::drive::{Couple, Motion, Single};
use crossgrain::laws::model::ContactModel;
use crossgrain::material;

pub const DENSITY: f64 = 2500.0;
pub const YOUNG: f64 = 1e7;
pub const POISSON: f64 = 0.3;
pub const RADII: [f64; 2] = [5e-3, 3e-3];
pub const DT: f64 = 5e-7;

/// What LAMMPS's damping fit gives at e = 1, where it should vanish.
pub const FIT_AT_ONE: f64 = 1.2728 - 4.2783 + 11.087 - 22.348 + 27.467 - 18.022 + 4.8218;

pub fn pair(damping_ratio: f64, friction: f64) -> PairLaw {
    PairLaw {
        effective_young: YOUNG / (2.0 * (1.0 - POISSON * POISSON)),
        effective_shear: YOUNG / (4.0 * (2.0 - POISSON) * (1.0 + POISSON)),
        friction,
        damping_ratio,
        ..PairLaw::default()
    }
}

pub fn damping(restitution: f64) -> f64 {
    material::damping_ratio(restitution)
}

/// A plane that a code gives a finite radius.
pub fn rounded(couple: Couple, factor: f64) -> Couple {
    Couple { radii: [couple.radii[0], factor * couple.radii[0]], surface: Surface::Plane, ..couple }
}

pub fn still(position: Vector) -> Motion {
    Motion { position, velocity: Vector::zeros(), angular_velocity: Vector::zeros() }
}

/// The oblique collision of the codes: the first sphere stands at the origin, the second along x.
/// Returns v1x, v1z, spins about y of both, and the largest force along x.
pub fn oblique<M: ContactModel>(model: M, pair: PairLaw, tangential: f64, spin: f64, steps: u64) -> [f64; 5] {
    let first = Motion {
        velocity: Vector::new(0.5, 0.0, tangential),
        angular_velocity: Vector::new(0.0, spin, 0.0),
        ..still(Vector::zeros())
    };
    let apart = RADII[0] + RADII[1] + 1e-6;
    let second = Motion { velocity: Vector::new(-0.5, 0.0, 0.0), ..still(Vector::new(apart, 0.0, 0.0)) };
    let mut peak: f64 = 0.0;
    let end = Single::new(model, Couple::spheres(pair, RADII, DENSITY))
        .fly([first, second], DT, steps, |sample, _| {
            peak = peak.max(sample.action.map_or(0.0, |action| action.force.x.abs()));
        })
        .unwrap();
    [end[0].velocity.x, end[0].velocity.z, end[0].angular_velocity.y, end[1].angular_velocity.y, peak]
}

/// The collision with a wall: `v_n`, `v_t` and spin in the codes' axes (wall along z, tangential x, spin y).
pub fn wall<M: ContactModel>(model: M, couple: Couple, dt: f64, steps: u64) -> [f64; 3] {
    let ball = Motion { velocity: Vector::new(-0.5, 0.1, 0.0), ..still(Vector::new(couple.radii[0] + 1e-6, 0.0, 0.0)) };
    let end = Single::new(model, couple).fly([ball, still(Vector::zeros())], dt, steps, |_, _| ()).unwrap();
    [end[0].velocity.x, end[0].velocity.y, end[0].angular_velocity.z]
}

/// Fails unless `got` has the digits of `wanted`.
#[track_caller]
pub fn digits(what: &str, got: f64, wanted: f64, relative: f64) {
    println!("{what}: {got:.10} measured {wanted:.10} off {:.1e}", (got / wanted - 1.0).abs());
    assert!((got - wanted).abs() <= relative * wanted.abs(), "{what}: {got} instead of {wanted}");
}
