//! What the native laws keep, and how much the mirrors break by design.

use crossgrain::Vector;
use crossgrain::laws::drive::{Couple, Motion, Path, Single, Stage};
use crossgrain::laws::model::{Composed, ContactModel, Free};
use crossgrain::laws::moments::elastic_plastic_rolling::ElasticPlasticRolling;
use crossgrain::laws::moments::twisting::Twisting;
use crossgrain::laws::normal::dmt::Dmt;
use crossgrain::laws::normal::hertz::Hertz;
use crossgrain::laws::normal::hysteretic_branches::Rule;
use crossgrain::laws::normal::linear_spring_dashpot::LinearSpringDashpot;
use crossgrain::laws::normal::luding_hysteretic::LudingHysteretic;
use crossgrain::laws::rotation::Rotation;
use crossgrain::laws::slider::History;
use crossgrain::laws::tangential::linear_history::LinearHistory;
use crossgrain::laws::tangential::mindlin::Mindlin;
use crossgrain::laws::tangential::options::{Dashpot, Options};
use crossgrain::laws::{NormalLaw, PairLaw};
use proptest::prelude::*;

use super::scenes::{self, DENSITY};

type Rolling = (ElasticPlasticRolling, Twisting);

const HERTZ: Hertz = Hertz { force_cut: true };

fn mindlin(options: Options) -> Mindlin<Options> {
    Mindlin { choices: options, dashpot: Dashpot::CriticalShare }
}

fn sliding(options: Options) -> Composed<Hertz, Mindlin<Options>, Free> {
    Composed { normal: HERTZ, tangential: mindlin(options), moments: Free }
}

fn native() -> Composed<Hertz, Mindlin<Options>, Rolling> {
    let moments = (ElasticPlasticRolling::plain(), Twisting::plain());
    Composed { normal: HERTZ, tangential: mindlin(Options::plain()), moments }
}

fn codes() -> [Options; 4] {
    [Options::liggghts(), Options::yade(), Options::lammps(History::Displacement), Options::lammps(History::Force)]
}

const STEPS: u32 = 10_000;

/// Loads a contact by spinning i, then turns all by 90 degrees; the tangential force and the moment on i, less that of
/// the force, before and after in the body's frame.
fn turned<M: ContactModel>(model: M, load: Vector, axis: Vector) -> [[Vector; 2]; 2] {
    let pair = PairLaw { rolling_friction: 1e9, twisting_friction: 1e9, ..scenes::pair(0.0, 1e9) };
    let still = Vector::zeros();
    let turn = axis.normalize() * (std::f64::consts::FRAC_PI_2 / f64::from(STEPS) / 1e-6);
    let stage = |steps, spin, turn| Stage { steps, velocity: still, angular_velocities: [spin, still], turn };
    let stages = vec![stage(1000, load, still), stage(u64::from(STEPS), still, turn)];
    let mut seen = [[still; 2]; 2];
    Single::new(model, Couple::spheres(pair, [1e-3, 2e-3], DENSITY))
        .drive(&Path { overlap: 1e-6, dt: 1e-6, stages }, |sample, frame| {
            let action = sample.action.unwrap();
            let normal = sample.contact.geometry.normal;
            let force = action.force - normal * action.force.dot(&normal);
            let moment = action.torque_i + normal.cross(&force) * (1e-3 - 0.5e-6);
            let at = usize::from(sample.step > 1000);
            seen[at] = [frame.inverse() * force, frame.inverse() * moment];
        })
        .unwrap();
    seen
}

/// Spin that shears by 1e-4 m, along z or y [rad/s].
const ABOUT_Y: f64 = 100.0;

#[test]
fn a_rigid_rotation_keeps_what_native_springs_remember() {
    let load = Vector::new(50.0, ABOUT_Y, 30.0);
    // A slip of r dtheta^2 theta / 6 comes with the chord that a step takes: 3e-7 of the load here.
    for axis in [Vector::z(), Vector::y(), Vector::x()] {
        let [before, after] = turned(native(), load, axis);
        for (before, after) in before.iter().zip(&after) {
            assert!(before.norm() > 0.0);
            assert!((after.norm() / before.norm() - 1.0).abs() < 1e-6, "{:e}", after.norm() / before.norm() - 1.0);
            assert!((after - before).norm() / before.norm() < 1e-4, "{before} {after}");
        }
    }
}

#[test]
fn an_oblique_rotation_adds_the_slip_of_half_a_step() {
    // Spins belong to the middle of a step and the normal to its end, in every code: about an axis at an angle alpha to
    // the normal, r dtheta theta cos(alpha) sin(alpha) / 2. What moments remember does not feel it.
    let axis = Vector::new(0.3, -0.7, 0.5).normalize();
    let theta = std::f64::consts::FRAC_PI_2;
    let slip = 0.5 * 3e-3 * theta * theta / f64::from(STEPS) * axis.x * (1.0 - axis.x * axis.x).sqrt();
    let [[force, moment], [force_after, moment_after]] = turned(native(), Vector::new(50.0, ABOUT_Y, 30.0), axis);
    let load = 1e-6 * (ABOUT_Y * ABOUT_Y + 900.0).sqrt();
    let moved = (force_after - force).norm() / force.norm() * load;
    println!("slip {moved:.3e} m, closed form {slip:.3e} m");
    assert!((moved / slip - 1.0).abs() < 2e-2);
    assert!((moment_after.norm() / moment.norm() - 1.0).abs() < 1e-6);
    assert!((moment_after - moment).norm() / moment.norm() < 1e-4);
}

#[test]
fn projection_shrinks_and_small_angles_grow_as_the_closed_form_says() {
    let step = std::f64::consts::FRAC_PI_2 / f64::from(STEPS);
    let share = 0.5 * f64::from(STEPS) * step * step;
    // Sheared along y by a spin about z, turned about z: the spring lies in the plane of rotation.
    let load = Vector::z() * ABOUT_Y;
    for (options, sign) in [(Options::liggghts(), -1.0), (Options::yade(), 1.0)] {
        let [[before, _], [after, _]] = turned(sliding(options), load, Vector::z());
        let grown = after.norm() / before.norm() - 1.0;
        println!("{:?}: {grown:.4e}, closed form {:.4e}", options.rotation, sign * share);
        assert!((grown / (sign * share) - 1.0).abs() < 1e-2);
    }
    // About the normal small angles grow alike, projections do not turn at all.
    let [[before, _], [after, _]] = turned(sliding(Options::yade()), load, Vector::x());
    assert!(((after.norm() / before.norm() - 1.0) / share - 1.0).abs() < 1e-2);
    for options in [Options::liggghts(), Options::lammps(History::Force)] {
        let [[before, _], [after, _]] = turned(sliding(options), load, Vector::x());
        assert!(after.dot(&before).abs() / before.norm_squared() < 1e-3, "left behind by 90 degrees");
    }
    // LAMMPS keeps the length, but for the slip that its arms add.
    let arms = Options { pair_arms: Options::plain().pair_arms, ..Options::lammps(History::Force) };
    assert_eq!(arms.rotation, Rotation::ProjectionRescaled);
    let [[before, _], [after, _]] = turned(sliding(arms), load, Vector::z());
    assert!((after.norm() / before.norm() - 1.0).abs() < 1e-6);
}

fn thrown(couple: &Couple, speed: f64, slip: f64, spin: Vector) -> [Motion; 2] {
    let apart = couple.radii[0] + couple.radii[1] + 1e-6;
    [
        Motion {
            position: Vector::new(apart, 1e-4, 0.0),
            velocity: Vector::new(-speed, slip, 0.3 * slip),
            angular_velocity: spin,
        },
        Motion { position: Vector::zeros(), velocity: Vector::zeros(), angular_velocity: spin * -0.4 },
    ]
}

fn angular_momentum(couple: &Couple, motions: &[Motion; 2]) -> Vector {
    let inertia = couple.moments_of_inertia();
    (0..2)
        .map(|at| {
            let motion = &motions[at];
            motion.position.cross(&motion.velocity) * couple.masses[at] + motion.angular_velocity * inertia[at]
        })
        .sum()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]
    #[test]
    fn a_free_pair_keeps_its_angular_momentum_and_the_total_its_cap(
        beta in 0.0..0.5f64, friction in 0.05..1.0f64, slip in -1.0..1.0f64,
        spin in (-90.0..90.0f64, -90.0..90.0f64, -90.0..90.0f64),
    ) {
        let pair = PairLaw { rolling_friction: 0.1, twisting_friction: 0.2, ..scenes::pair(beta, friction) };
        let couple = Couple::spheres(pair, scenes::RADII, DENSITY);
        let start = thrown(&couple, 1.0, slip, Vector::new(spin.0, spin.1, spin.2));
        let mut scale: f64 = 0.0;
        let end = Single::new(native(), couple).fly(start, 1e-6, 1200, |sample, _| {
            let Some(action) = sample.action else { return };
            let normal = sample.contact.geometry.normal;
            let flat = action.force - normal * action.force.dot(&normal);
            assert!(flat.norm() <= friction * action.normal.repulsive.abs() * (1.0 + 1e-9) + 1e-18);
            scale = scale.max(action.force.norm());
        }).unwrap();
        prop_assert!(scale > 0.0);
        let [before, after] = [start, end].map(|motions| angular_momentum(&couple, &motions));
        let size = couple.masses[0] * 1e-2;
        prop_assert!((after - before).norm() <= 1e-12 * before.norm().max(size), "{} {}", before, after);
    }

    #[test]
    fn native_springs_never_gain_on_any_path(
        legs in proptest::collection::vec((-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64), 1..6),
        friction in 0.05..1.0f64,
    ) {
        let pair = PairLaw { rolling_friction: 0.1, twisting_friction: 0.2, ..scenes::pair(0.0, friction) };
        let mut stages = Vec::new();
        let mut overlap: f64 = 1e-5;
        for (squeeze, x, y, z) in legs {
            let closer = if (1e-6..5e-5).contains(&(overlap + 2e-5 * squeeze)) { 2e-5 * squeeze } else { 0.0 };
            overlap += closer;
            stages.push(Stage {
                steps: 200,
                velocity: Vector::x() * (-closer / (200.0 * 1e-6)),
                angular_velocities: [Vector::new(x, y, z) * 100.0, Vector::zeros()],
                turn: Vector::new(z, x, y) * 50.0,
            });
        }
        let couple = Couple::spheres(pair, [1e-3, 2e-3], DENSITY);
        let mut single = Single::new(native(), couple);
        let (mut worst, mut scale): (f64, f64) = (0.0, 1e-18);
        single.drive(&Path { overlap: 1e-5, dt: 1e-6, stages }, |sample, _| {
            let action = sample.action.unwrap();
            let losses = action.losses;
            scale = scale.max(action.springs);
            for loss in [losses.frictional, losses.rolling, losses.carried] {
                worst = worst.max(-loss / scale);
            }
        }).unwrap();
        // A step in which a force passes through zero is not resolved.
        prop_assert!(worst < 1e-5, "{worst}");
    }
}

#[test]
fn a_displacement_history_gains_what_the_closed_form_says() {
    // Sheared at a small overlap, squeezed, sheared back: (k1 - k0) s^2 / 2 comes out of nothing.
    let still = Vector::zeros();
    let stage = |velocity: f64, spin: f64| Stage {
        steps: 1000,
        velocity: Vector::x() * velocity,
        angular_velocities: [Vector::z() * spin, still],
        turn: still,
    };
    let couple = Couple::spheres(scenes::pair(0.0, 1e9), [1e-3, 1e-3], DENSITY);
    let run = |options| {
        let mut single = Single::new(sliding(options), couple);
        let path =
            Path { overlap: 1e-6, dt: 1e-6, stages: vec![stage(0.0, 10.0), stage(-3e-3, 0.0), stage(0.0, -10.0)] };
        let (mut work, mut last) = (0.0, still);
        single
            .drive(&path, |sample, _| {
                let action = sample.action.unwrap();
                let moved = sample.contact.angular_i * 1e-6;
                work += 0.5 * (action.torque_i + last).dot(&-moved);
                last = action.torque_i;
            })
            .unwrap();
        (work, single.losses.carried)
    };
    let stiffness = |overlap: f64| 8.0 * scenes::pair(0.0, 0.0).effective_shear * (0.5e-3 * overlap).sqrt();
    let gain = 0.5 * (stiffness(4e-6) - stiffness(1e-6)) * 1e-5 * 1e-5;
    let (work, carried) = run(Options::liggghts());
    println!("displacement: work {work:.5e}, carried {carried:.5e}, closed form {:.5e}", -gain);
    // The arm shortens by half the overlap: 1e-3 of the slip.
    assert!((work / -gain - 1.0).abs() < 1e-2 && (carried / -gain - 1.0).abs() < 1e-2);
    let (work, carried) = run(Options::plain());
    println!("rescaled force: work {work:.5e}, carried {carried:.5e}");
    assert!(work > 0.0 && carried > 0.0);
}

#[test]
fn gross_sliding_changes_the_tangential_velocity_by_mu_times_the_normal_one() {
    let (friction, normal) = (0.2, 0.5);
    for options in codes().into_iter().chain([Options::plain()]) {
        let couple = Couple::on_plane(scenes::pair(0.0, friction), 5e-3, DENSITY);
        let ball = Motion { velocity: Vector::new(-normal, 3.0, 0.0), ..scenes::still(Vector::x() * 5.000_1e-3) };
        let start = [ball, scenes::still(Vector::zeros())];
        let end = Single::new(sliding(options), couple).fly(start, 2e-8, 80_000, |_, _| ()).unwrap();
        let change = 3.0 - end[0].velocity.y;
        println!("change off {:.2e}", change / (friction * 2.0 * normal) - 1.0);
        assert!(end[0].velocity.x > 0.0);
        // To the rebound that the step gives, exactly; to the wanted one as far as that step conserves energy.
        assert!((change / (friction * (normal + end[0].velocity.x)) - 1.0).abs() < 1e-9);
        assert!((change / (friction * 2.0 * normal) - 1.0).abs() < 1e-6);
    }
}

fn wall_against_sphere<N: NormalLaw>(normal: N, options: Options) -> f64 {
    let pair = PairLaw { work_of_adhesion: 0.5, rolling_friction: 0.1, ..scenes::pair(0.1, 0.4) };
    let moments = ElasticPlasticRolling { stretched_at_walls: false, ..ElasticPlasticRolling::plain() };
    let model = Composed { normal, tangential: mindlin(options), moments };
    let plane = Couple::on_plane(pair, 5e-3, DENSITY);
    // The sphere's radius costs digits of the overlap: 1e4 radii leave both errors at 1e-4.
    let large =
        Couple { radii: [5e-3, 50.0], masses: [plane.masses[0], 1e12], ..Couple::spheres(pair, [5e-3; 2], 1.0) };
    let run = |couple: Couple, centre: f64| {
        let ball = Motion { velocity: Vector::new(-0.5, 0.2, 0.0), ..scenes::still(Vector::x() * 5.001e-3) };
        let other = scenes::still(Vector::x() * -centre);
        Single::new(model, couple).fly([ball, other], 5e-7, 3000, |_, _| ()).unwrap()[0]
    };
    let (flat, round) = (run(plane, 0.0), run(large, 50.0));
    (flat.velocity - round.velocity).norm() + (flat.angular_velocity - round.angular_velocity).norm() * 5e-3
}

#[test]
fn a_wall_is_the_limit_of_a_large_sphere() {
    let luding = LudingHysteretic {
        loading: 5e3,
        unloading: 2e4,
        cohesive: 1e3,
        plasticity_depth: 0.05,
        dashpot: 0.01,
        force_cut: false,
        rule: Rule::SelfConsistent,
    };
    let plain = Options::plain();
    for gap in [
        wall_against_sphere(HERTZ, plain),
        wall_against_sphere(Dmt::new(true), plain),
        wall_against_sphere(luding, plain),
    ] {
        println!("{gap:.2e} m/s");
        assert!(gap < 5e-4);
    }
    // LAMMPS's arms at walls are not those of its pairs.
    assert!(wall_against_sphere(HERTZ, Options::lammps(History::Displacement)) > 1e-3);
}

#[test]
fn linear_springs_forget_which_history_they_have() {
    let normal = LinearSpringDashpot { stiffness: 2e4, dashpot: 0.05, force_cut: true };
    let run = |history| {
        let choices = Options { history, ..Options::plain() };
        let dashpot = Dashpot::Constant { value: 0.02 };
        let tangential = LinearHistory { stiffness_ratio: 0.4, dashpot, choices };
        scenes::oblique(Composed { normal, tangential, moments: Free }, scenes::pair(0.0, 0.4), 0.3, 20.0, 1500)
    };
    let [one, two, three] = [History::Displacement, History::Force, History::ForceRescaled].map(run);
    for at in 0..4 {
        assert!((one[at] - two[at]).abs() < 1e-10 * one[at].abs());
        assert!((one[at] - three[at]).abs() < 1e-10 * one[at].abs());
    }
}
