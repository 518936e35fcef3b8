//! The engine's frame: determinism, integrators, bodies, and the energy ledger.

#![allow(clippy::unwrap_used, reason = "tests")]

use crossgrain::case::model::{ForceCut, NormalLaw};
use crossgrain::case::scene::{Mirror, Scene, SceneBody, SceneMotion, SceneParticle, SceneShape, Start};
use crossgrain::case::{Stated, scene};
use crossgrain::record::Recorder;
use crossgrain::simulation;

/// A sphere above a floor, as a scene to start from.
const CASE: &str = r#"
schema = 1
name = "floor"
question = "Does the engine keep its promises?"
level = "L1"
source = "none"
geometry = { kind = "spheres" }
gravity = [0, 0, "-9.81 m/s2"]

[domain]
min = ["-1 m", "-1 m", "-1 m"]
max = ["1 m", "1 m", "1 m"]
boundary = ["open", "open", "open"]

[[materials]]
name = "soft"
young = "10 MPa"
poisson = 0.3
density = "2500 kg/m3"

[[materials]]
name = "wall"
rigid = true

[[pairs]]
between = ["soft", "soft"]
values = { damping = { kind = "restitution", value = 0.6 } }

[[pairs]]
between = ["soft", "wall"]
values = { damping = { kind = "restitution", value = 0.6 } }

[model]
normal = { law = "hertz", force_cut = "on" }
tangential = { law = "frictionless" }
moments = { law = "free" }

[[bodies]]
name = "floor"
material = "wall"
shape = { kind = "plane", point = [0, 0, 0], normal = [0, 0, 1] }
motion = { kind = "fixed" }

[[particles]]
kind = "single"
material = "soft"
radius = "5 mm"
position = [0, 0, "5.01 mm"]
velocity = [0, 0, "-0.5 m/s"]
angular_velocity = [0, 0, 0]

[time]
step = { kind = "fixed", value = "1e-6 s" }

[[stages]]
name = "impact"
end = { kind = "duration", value = "2 ms" }
"#;

fn floor() -> Scene {
    Stated::parse("floor.toml", CASE, &[]).unwrap().load().unwrap().scenes.remove(0)
}

fn weightless(mut scene: Scene) -> Scene {
    scene.gravity = [0.0; 3];
    scene
}

/// A cloud of spheres that collide with each other and the floor.
fn cloud(side: usize) -> Scene {
    let mut scene = floor();
    let pattern = scene.particles[0].clone();
    let jitter = |index: usize, factor: f64| 4e-4 * ((index as f64 * factor) % 1.0 - 0.5);
    scene.particles = (0..side * side * side)
        .map(|index| {
            let cell = [index % side, index / side % side, index / side / side];
            let place = |axis: usize| 0.0105 * cell[axis] as f64 + 0.0055 + jitter(index, 0.618 + axis as f64);
            SceneParticle {
                position: [place(0), place(1), place(2)],
                velocity: [900.0 * jitter(index, 0.37), 900.0 * jitter(index, 0.73), -1.0],
                ..pattern.clone()
            }
        })
        .collect();
    scene.steps = 600;
    scene.time_step = 1e-5;
    scene.output_every = 100;
    scene
}

fn run(scene: &Scene, threads: usize) -> Recorder {
    simulation::run(scene, &simulation::Options::threads(threads), &|_| {}).unwrap()
}

fn bits(recorder: &Recorder) -> Vec<u64> {
    ["position", "velocity", "force", "energy_kinetic", "energy_elastic", "energy_viscous"]
        .iter()
        .flat_map(|name| recorder.values(name).iter().map(|value| value.to_bits()))
        .collect()
}

/// Largest residual of the energy balance over the energy that entered contacts [-].
fn residual(recorder: &Recorder) -> f64 {
    let column = |name| recorder.values(name);
    let balance = |i: usize| {
        column("energy_kinetic")[i]
            + column("energy_elastic")[i]
            + column("energy_gravity")[i]
            + column("energy_viscous")[i]
            - column("energy_body_work")[i]
    };
    let samples = column("energy_kinetic").len();
    let entered = column("energy_entered")[samples - 1];
    assert!(entered > 0.0);
    (0..samples).map(|i| (balance(i) - balance(0)).abs()).fold(0.0, f64::max) / entered
}

fn halved(scene: &Scene) -> Scene {
    Scene {
        time_step: scene.time_step / 2.0,
        steps: 2 * scene.steps,
        output_every: 2 * scene.output_every,
        ..scene.clone()
    }
}

#[test]
fn a_run_has_the_same_bits_on_any_number_of_threads() {
    let scene = cloud(9);
    let one = run(&scene, 1);
    assert!(one.values("energy_viscous").last().unwrap() > &0.0, "nothing collided");
    for threads in [2, 3, 8] {
        assert!(bits(&run(&scene, threads)) == bits(&one), "{threads} threads");
    }
}

#[test]
fn momentum_of_a_cloud_changes_by_weight_and_floor_only() {
    let mut scene = weightless(cloud(6));
    scene.bodies.clear();
    let record = run(&scene, 2);
    let velocity = record.values("velocity");
    let momentum = |sample: usize, axis: usize| {
        let start = sample * scene.particles.len() * 3;
        (0..scene.particles.len()).map(|i| scene.particles[i].mass * velocity[start + 3 * i + axis]).sum::<f64>()
    };
    let last = velocity.len() / scene.particles.len() / 3 - 1;
    let scale: f64 = scene.particles.iter().map(|particle| particle.mass).sum();
    for axis in 0..3 {
        assert!((momentum(last, axis) - momentum(0, axis)).abs() < 1e-13 * scale);
    }
}

#[test]
fn the_staggered_start_follows_the_same_trajectory() {
    let plain = floor();
    let staggered = Scene { mirror: Mirror { start: Start::Staggered, ..Mirror::default() }, ..plain.clone() };
    let (one, other) = (run(&plain, 1), run(&staggered, 1));
    let distance =
        one.values("position").iter().zip(other.values("position")).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(distance < 1e-14, "{distance}");
}

#[test]
fn a_moving_plane_hits_like_a_moving_sphere() {
    let resting = weightless(floor());
    let mut moving = resting.clone();
    moving.particles[0].velocity = [0.0; 3];
    moving.bodies[0].motion = SceneMotion::Prescribed { velocity: [0.0, 0.0, 0.5] };
    let (one, other) = (run(&resting, 1), run(&moving, 1));
    let peak = one.values("force").iter().copied().fold(0.0, f64::max);
    let worst = one.values("force").iter().zip(other.values("force")).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(worst < 1e-9 * peak, "{worst} of {peak}");
    // In the frame of the sphere the wall does the work that the impact dissipates and the sphere takes away.
    let work = *other.values("energy_body_work").last().unwrap();
    let gained = other.last("energy_kinetic").unwrap() + other.last("energy_viscous").unwrap();
    assert!((work / gained - 1.0).abs() < 1e-3);
}

#[test]
fn the_ledger_of_a_damped_impact_closes_at_first_order() {
    for force_cut in [ForceCut::On, ForceCut::Off] {
        let mut scene = weightless(floor());
        scene.model.normal = NormalLaw::Hertz { force_cut };
        let (coarse, fine) = (residual(&run(&scene, 1)), residual(&run(&halved(&scene), 1)));
        let order = (coarse / fine).log2();
        assert!(coarse < 1e-2 && (0.8..2.2).contains(&order), "{force_cut:?}: {coarse}, order {order}");
    }
}

#[test]
fn the_ledger_of_an_elastic_impact_closes_at_second_order() {
    let mut scene = weightless(floor());
    for pair in &mut scene.pairs {
        pair.damping_ratio = 0.0;
    }
    let order = (residual(&run(&scene, 1)) / residual(&run(&halved(&scene), 1))).log2();
    assert!((1.8..2.2).contains(&order), "order {order}");
}

#[test]
fn a_plane_as_a_large_sphere_is_softer_by_its_curvature() {
    let plane = weightless(floor());
    let factor = 1e3;
    let curved = Scene { mirror: Mirror { plane_radius_factor: Some(factor), ..Mirror::default() }, ..plane.clone() };
    let peak = |scene: &Scene| run(scene, 1).values("force").iter().copied().fold(0.0, f64::max);
    // The peak force of an elastic impact grows with R*^(1/5); damping changes both alike.
    let expected = (factor / (1.0 + factor)).powf(0.2);
    assert!((peak(&curved) / peak(&plane) / expected - 1.0).abs() < 1e-6);
}

#[test]
fn bodies_feel_what_particles_feel() {
    let mut scene = cloud(4);
    scene.bodies.push(SceneBody {
        name: "side".into(),
        material: scene.bodies[0].material,
        shape: SceneShape::Plane { point: [0.0; 3], normal: [1.0, 0.0, 0.0] },
        motion: SceneMotion::Fixed,
    });
    let record = run(&scene, 1);
    let (force, body) = (record.values("force"), record.values("body_force"));
    let samples = body.len() / 6;
    for sample in 0..samples {
        for axis in 0..3 {
            let particles: f64 = force[sample * 192..(sample + 1) * 192].iter().skip(axis).step_by(3).sum();
            let bodies = body[sample * 6 + axis] + body[sample * 6 + 3 + axis];
            assert!((particles + bodies).abs() < 1e-12 * (1.0 + particles.abs()));
        }
    }
}

#[test]
fn refinements_sample_the_same_times() {
    let text = CASE.replace("value = \"1e-6 s\" }", "value = \"1e-6 s\" }\nrefinements = 2");
    let scenes = Stated::parse("floor.toml", &text, &[]).unwrap().load().unwrap().scenes;
    assert_eq!(scenes.len(), 3);
    let times: Vec<Vec<f64>> = scenes.iter().map(|scene| run(scene, 1).values("time").to_vec()).collect();
    for finer in &times[1..] {
        assert!(times[0].iter().zip(finer).all(|(a, b)| (a - b).abs() < 1e-15));
        assert_eq!(finer.len(), times[0].len());
    }
    assert_eq!(scene::SCHEMA, 1);
}
