//! Periodic axes and cylinders of cases: trajectories without jumps, collisions across a face, curvature.

#![allow(clippy::unwrap_used, reason = "tests")]

use std::path::Path;

use crossgrain::case::scene::{Scene, SceneShape};
use crossgrain::case::{self, Stated};
use crossgrain::record::Recorder;
use crossgrain::simulation::{self, Checkpoints, Options};

fn good(name: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/inputs/good").join(name);
    case::read(&path, &[]).and_then(Stated::load).unwrap().scenes.remove(0)
}

fn run(scene: &Scene) -> Recorder {
    simulation::run(scene, &Options::threads(1), &|_| {}).unwrap()
}

/// Samples of one particle [x, y, z].
fn track(record: &Recorder, column: &str, particle: usize, count: usize) -> Vec<[f64; 3]> {
    let rows = record.values(column).chunks_exact(3 * count);
    rows.map(|row| [row[3 * particle], row[3 * particle + 1], row[3 * particle + 2]]).collect()
}

/// One particle that leaves the box of 2 cm through several faces, at 30, -20 and 10 m/s, for 10 ms.
fn flight() -> Scene {
    let mut scene = good("periodic.toml");
    scene.particles.truncate(1);
    scene.gravity = [0.0, 0.0, -9.81];
    scene.particles[0].velocity = [30.0, -20.0, 10.0];
    (scene.time_step, scene.steps, scene.output_every) = (1e-5, 1000, 1);
    scene
}

#[test]
fn free_flight_through_periodic_faces_has_no_jump() {
    let scene = flight();
    let record = run(&scene);
    let (start, speed) = (scene.particles[0].position, scene.particles[0].velocity);
    let path = track(&record, "position", 0, 1);
    let edge = scene.domain.max[0] - scene.domain.min[0];
    assert!(path[1000][0] - path[0][0] > 10.0 * edge, "the particle must cross many faces");
    for (step, place) in path.iter().enumerate() {
        let time = 1e-5 * f64::from(u32::try_from(step).unwrap());
        for axis in 0..3 {
            let exact = start[axis] + speed[axis] * time + 0.5 * scene.gravity[axis] * time * time;
            // Rounding of a thousand steps.
            assert!((place[axis] - exact).abs() < 1e-14, "step {step}, axis {axis}: {} and {exact}", place[axis]);
        }
    }
    let energy = |name: &str| record.values(name).to_vec();
    let (kinetic, gravity) = (energy("energy_kinetic"), energy("energy_gravity"));
    let worst = kinetic.iter().zip(&gravity).map(|(k, g)| (k + g) / (kinetic[0] + gravity[0]) - 1.0);
    assert!(worst.map(f64::abs).fold(0.0, f64::max) < 1e-12, "the weight's energy must not jump");
}

#[test]
fn a_flight_resumed_between_faces_has_the_same_bits() {
    let scene = flight();
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("periodic-flight.npz");
    let _ = std::fs::remove_file(&file);
    let checkpoints = Some(Checkpoints { file, steps: Some(137), interval: None });
    let options = Options { checkpoints, ..Options::threads(1) };
    // The first run leaves the checkpoint of step 959; the second goes on from there.
    let whole = simulation::run(&scene, &options, &|_| {}).unwrap();
    let resumed = simulation::run(&scene, &options, &|_| {}).unwrap();
    let bits = |record: &Recorder| record.values("position").iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&whole), bits(&resumed));
}

#[test]
fn two_particles_collide_across_a_face_as_they_do_inside() {
    let inside = good("periodic.toml");
    let edge = inside.domain.max[0] - inside.domain.min[0];
    let mut across = inside.clone();
    for particle in &mut across.particles {
        particle.position[0] += 0.5 * edge;
        if particle.position[0] >= inside.domain.max[0] {
            particle.position[0] -= edge;
        }
    }
    let gap = across.particles[0].position[0] - across.particles[1].position[0];
    assert!(gap > 0.5 * edge, "the two must meet across the face");
    let (one, other) = (run(&inside), run(&across));
    let peak = one.values("force").iter().copied().fold(0.0, f64::max);
    assert!(peak > 1e-2, "nothing collided");
    for (a, b) in one.values("force").iter().zip(other.values("force")) {
        // Rounding of a place of 1 cm in an overlap of 10 micrometres.
        assert!((a - b).abs() < 1e-11 * peak, "{a} and {b} N");
    }
    for (a, b) in one.values("velocity").iter().zip(other.values("velocity")) {
        assert!((a - b).abs() < 1e-12, "{a} and {b} m/s");
    }
    for particle in 0..2 {
        let places = track(&one, "position", particle, 2).into_iter().zip(track(&other, "position", particle, 2));
        let shift = across.particles[particle].position[0] - inside.particles[particle].position[0];
        for (a, b) in places {
            assert!((b[0] - a[0] - shift).abs() < 1e-15, "{} and {} m", a[0], b[0]);
        }
    }
}

#[test]
fn a_sphere_in_a_cylinder_is_stiffened_by_its_curvature() {
    let mut scene = good("cylinder.toml");
    (scene.time_step, scene.steps) = (scene.time_step / 20.0, scene.steps * 20);
    scene.pairs.iter_mut().for_each(|pair| pair.damping_ratio = 0.0);
    let SceneShape::Cylinder { radius: bore, .. } = scene.bodies[0].shape else { unreachable!() };
    let particle = &scene.particles[0];
    let speed = particle.velocity[0].hypot(particle.velocity[1]);
    // Hertz: the greatest overlap of m v^2 / 2 = (8/15) E* sqrt(R*) d^(5/2), at which F = (4/3) E* sqrt(R*) d^(3/2).
    let peak = |curvature: f64| {
        let effective = 1.0 / (1.0 / particle.radius - curvature / bore);
        let stiffness = scene.pairs[0].effective_young * effective.sqrt();
        let overlap = (15.0 * particle.mass * speed * speed / (16.0 * stiffness)).powf(0.4);
        4.0 / 3.0 * stiffness * overlap.powf(1.5)
    };
    // Plain, and with the curvature that a mirror gives the cylinder.
    for share in [None, Some(0.5), Some(0.0)] {
        let mut mirrored = scene.clone();
        mirrored.mirror.cylinder_curvature = share;
        let record = run(&mirrored);
        let forces = track(&record, "force", 0, 1);
        let found = forces.iter().map(|f| f[0].hypot(f[1])).fold(0.0, f64::max);
        let expected = peak(share.unwrap_or(1.0));
        // Second order in the time step, 2,000 to the contact; sampled every step.
        assert!((found / expected - 1.0).abs() < 1e-5, "{share:?}: {found} and {expected} N");
        assert!(forces.iter().all(|force| force[2] == 0.0), "a cylinder does not push along its axis");
    }
}
