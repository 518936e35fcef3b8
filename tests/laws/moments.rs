//! Rolling and twisting of a held pair that LIGGGHTS, YADE and LAMMPS were measured with: slopes and plateaus.
//!
//! R 1 and 2 mm, E 1e7 Pa, nu 0.3, overlap 2 um, spin 10 rad/s of the first, dt 1 us, 3000 steps, coefficient 0.2.

use crossgrain::Vector;
use crossgrain::laws::MomentLaw;
use crossgrain::laws::drive::{Couple, Path, Single, Stage};
use crossgrain::laws::model::Composed;
use crossgrain::laws::moments::constant_torque::{ConstantTorque, Opposed};
use crossgrain::laws::moments::elastic_plastic_rolling::{Dashpot, ElasticPlasticRolling, Limit, Stiffness};
use crossgrain::laws::moments::twisting::{Spring, Twisting};
use crossgrain::laws::normal::hertz::Hertz;
use crossgrain::laws::slider::History;
use crossgrain::laws::tangential::mindlin::Mindlin;
use crossgrain::laws::tangential::options::{self, Options};

use super::scenes::{self, digits};

const RADII: [f64; 2] = [1e-3, 2e-3];
const OVERLAP: f64 = 2e-6;
const SPIN: f64 = 10.0;
const DT: f64 = 1e-6;
/// Eight printed digits.
const PRINTED: f64 = 5e-8;
/// Measured `mu_r` `F_n` R* [N m].
const PLATEAU: f64 = 7.133_545_7e-8;
/// Measured `kt` R*^2 [N m].
const KT: f64 = 1.468_671_2e-4;

/// Moments opposing the spin at steps 10, 20 and the last.
fn held<M: MomentLaw>(moments: M, twist: bool, coefficient: f64, steps: u64) -> [f64; 3] {
    let mut pair = scenes::pair(0.0, 0.0);
    (pair.rolling_friction, pair.twisting_friction) = (coefficient, coefficient);
    let tangential =
        Mindlin { choices: Options::lammps(History::Displacement), dashpot: options::Dashpot::CriticalShare };
    let model = Composed { normal: Hertz { force_cut: true }, tangential, moments };
    let axis = if twist { Vector::x() } else { Vector::y() };
    let stage = Stage {
        steps,
        velocity: Vector::zeros(),
        angular_velocities: [axis * SPIN, Vector::zeros()],
        turn: Vector::zeros(),
    };
    let mut torques = Vec::new();
    let couple = Couple::spheres(pair, RADII, 2500.0);
    Single::new(model, couple)
        .drive(&Path { overlap: OVERLAP, dt: DT, stages: vec![stage] }, |sample, _| {
            torques.push(-sample.action.unwrap().torque_i.dot(&axis));
        })
        .unwrap();
    [torques[10], torques[20], torques[torques.len() - 1]]
}

fn check(name: &str, got: [f64; 3], stiffness: f64, plateau: f64) {
    digits(&format!("{name} stiffness"), (got[1] - got[0]) / (10.0 * DT * SPIN), stiffness, PRINTED);
    digits(&format!("{name} plateau"), got[2], plateau, PRINTED);
}

#[test]
fn rolling_springs_have_the_slopes_and_plateaus_of_liggghts() {
    let epsd = |stiffness, dashpot| ElasticPlasticRolling::liggghts(stiffness, dashpot, false);
    let normal = |factor| Stiffness::Normal { factor };
    check("epsd", held(epsd(normal(2.25), Dashpot::None), false, 0.2, 3000), 1.070_031_9e-5, PLATEAU);
    check("epsd2", held(epsd(Stiffness::Tangential, Dashpot::None), false, 0.2, 3000), KT, PLATEAU);
    check("epsd3", held(epsd(normal(1.5), Dashpot::None), false, 0.2, 3000), 7.133_545_7e-6, PLATEAU);
    let damped = held(epsd(normal(2.25), Dashpot::CriticalShare { value: 0.3 }), false, 0.2, 3000);
    check("epsd damped", damped, 1.070_031_9e-5, PLATEAU);
    let [own, other] = RADII.map(|radius| 2500.0 * 4.0 / 3.0 * std::f64::consts::PI * radius.powi(5));
    let inertia = 1.4 * own * other / (own + other);
    let offset = damped[0] - 1.070_031_9e-5 * 10.0 * DT * SPIN;
    digits("epsd dashpot", offset / SPIN, 0.3 * 2.0 * (inertia * 1.070_031_9e-5).sqrt(), 1e-7);
    let joint = ElasticPlasticRolling::liggghts(Stiffness::Tangential, Dashpot::None, true);
    check("epsd2 torsionTorque", held(joint, true, 0.2, 3000), KT, PLATEAU);
}

#[test]
fn constant_torque_has_the_size_of_liggghts() {
    let torque = |opposed, twist| held(ConstantTorque { opposed }, twist, 0.2, 3000)[2];
    digits("cdt", torque(Opposed::RollingShare, false), PLATEAU, PRINTED);
    digits("cdt torsionTorque", torque(Opposed::WholeSpin, true), PLATEAU, PRINTED);
    assert!(torque(Opposed::RollingShare, true).abs() < 1e-30);
}

#[test]
fn springs_of_yade_have_their_slopes_and_its_twist_no_cap() {
    let reduced = RADII[0] * RADII[1] / (RADII[0] + RADII[1]);
    let eta = 0.2 * reduced / (0.5 * (RADII[0] + RADII[1]));
    let kr = 8.0 * scenes::pair(0.0, 0.0).effective_shear * (reduced * OVERLAP).sqrt() * reduced * reduced;
    let capped = ElasticPlasticRolling::yade(kr, Limit::MeanRadius);
    check("krot", held(capped, false, eta, 3000), KT, PLATEAU);
    // YADE's history is one step ahead.
    let free = ElasticPlasticRolling::yade(kr, Limit::Unlimited);
    check("krot, eta 0", held(free, false, 0.0, 3001), KT, 4.407_482_2e-6);
    check("ktwist", held(Twisting::yade(kr), true, eta, 3001), KT, 4.407_482_2e-6);
}

#[test]
fn springs_of_lammps_have_their_slopes_and_plateaus() {
    let reduced = RADII[0] * RADII[1] / (RADII[0] + RADII[1]);
    let kr = 8.0 * scenes::pair(0.0, 0.0).effective_shear * (reduced * OVERLAP).sqrt() * reduced * reduced;
    let rolling = ElasticPlasticRolling::lammps(kr / (reduced * reduced), 0.0);
    check("rolling sds", held(rolling, false, 0.2, 3000), KT, PLATEAU);
    // The measured deck printed its coefficient as 0.000133333.
    let sds = Twisting::lammps(Spring::Constant { stiffness: kr, dashpot: 0.0, arm: Some(1.0) });
    check("twisting sds", held(sds, true, 0.000_133_333, 3000), KT, 7.133_527_9e-8);
    let marshall = Twisting::lammps(Spring::Spot);
    check("twisting marshall", held(marshall, true, 0.3, 3000), 2.203_006_8e-7, 3.907_203_9e-9);
}

#[test]
fn native_springs_reach_the_same_plateaus() {
    check("plain rolling", held(ElasticPlasticRolling::plain(), false, 0.2, 3000), KT, PLATEAU);
    check("plain twisting", held(Twisting::plain(), true, 0.3, 3000), 2.203_006_8e-7, 3.907_203_9e-9);
    let both = (ElasticPlasticRolling::plain(), Twisting::plain());
    check("both", held(both, false, 0.2, 3000), KT, PLATEAU);
}
