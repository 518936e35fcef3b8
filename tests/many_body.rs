//! What the engine promises for many bodies: order, threads and restarts change no bit; lists miss no pair; momentum and
//! energy are kept.

#![allow(clippy::unwrap_used, clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "tests")]

use std::path::PathBuf;

use crossgrain::Vector;
use crossgrain::bench::{self, MODEL, Model, bed::Bed};
use crossgrain::case::scene::SceneParticle;
use crossgrain::domain::Domain;
use crossgrain::laws::model::{Composed, ContactModel, Free, Frictionless};
use crossgrain::laws::normal::hertz::Hertz;
use crossgrain::record::checkpoint::Checkpoint;
use crossgrain::simulation::{Setup, Simulation};

const ELASTIC: Composed<Hertz, Frictionless, Free> =
    Composed { normal: Hertz { force_cut: true }, tangential: Frictionless, moments: Free };

/// Fractions in [0, 1) from a seed.
fn uniform(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// A warm, friction-coupled gas of overlapping spheres on a jittered lattice: `edge`^3 of them in a periodic box.
fn crowd(edge: usize, spread: f64) -> Setup {
    let mut random = uniform(7);
    let bed = Bed::new(edge * edge * edge, 1);
    // Small spheres stand closer, so that they touch too.
    let spacing = if spread > 3.0 { 1.6e-3 } else { 1.9e-3 };
    let mut setup = bed.setup(0.5);
    setup.domain = Domain { min: Vector::zeros(), length: Vector::repeat(spacing * edge as f64), periodic: [true; 3] };
    for k in 0..edge * edge * edge {
        let cell = [k % edge, k / edge % edge, k / edge / edge];
        let radius = 1e-3 / (1.0 + (spread - 1.0) * random());
        let mass = 2500.0 * 4.19 * radius * radius * radius;
        setup.particles.push(SceneParticle {
            material: 0,
            radius,
            mass,
            moment_of_inertia: 0.4 * mass * radius * radius,
            position: cell.map(|cell| (cell as f64 + 0.5 + 0.2 * (random() - 0.5)) * spacing),
            velocity: [0; 3].map(|_| 2.0 * (random() - 0.5)),
            angular_velocity: [0; 3].map(|_| 100.0 * (random() - 0.5)),
        });
    }
    setup.time_step = 1e-6;
    setup
}

/// The state by id, as bits.
fn bits<M: ContactModel>(simulation: &Simulation<M>) -> Vec<u64> {
    let particles = simulation.particles();
    let vectors = particles.positions().chain(particles.velocities()).chain(particles.angular_velocities());
    let vectors = vectors.chain(particles.loads().flat_map(|load| [load.force, load.torque]));
    vectors.flat_map(|v| [v.x, v.y, v.z]).map(f64::to_bits).collect()
}

fn run(setup: &Setup, steps: u64) -> Simulation<Model> {
    let mut simulation = Simulation::new(setup, MODEL).unwrap();
    simulation.advance_to(steps).unwrap();
    simulation
}

#[test]
fn threads_change_no_bit() {
    let setup = crowd(14, 1.5);
    let states: Vec<Vec<u64>> = [1, 2, 3, 8]
        .iter()
        .map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(*threads).build().unwrap();
            pool.install(|| {
                let simulation = run(&setup, 300);
                assert!(simulation.rebuilds() > 3, "the run must rebuild its list");
                bits(&simulation)
            })
        })
        .collect();
    assert!(states.iter().all(|state| *state == states[0]));
}

#[test]
fn the_order_of_the_input_changes_no_bit() {
    let setup = crowd(12, 2.0);
    let count = setup.particles.len();
    let mut order: Vec<usize> = (0..count).collect();
    let mut random = uniform(3);
    for k in (1..count).rev() {
        order.swap(k, (random() * (k + 1) as f64) as usize);
    }
    let mut shuffled = setup.clone();
    shuffled.particles = order.iter().map(|id| setup.particles[*id].clone()).collect();
    let (plain, other) = (run(&setup, 300), run(&shuffled, 300));
    let (plain, other) = (bits(&plain), bits(&other));
    for column in 0..plain.len() / (3 * count) {
        for (at, id) in order.iter().enumerate() {
            let place = |id: usize| (column.min(3) * count + id) * 3..(column.min(3) * count + id) * 3 + 3;
            if column < 3 {
                assert_eq!(plain[place(*id)], other[place(at)]);
            } else {
                let load = |id: usize| 9 * count + 6 * id..9 * count + 6 * id + 6;
                assert_eq!(plain[load(*id)], other[load(at)]);
            }
        }
    }
}

#[test]
fn the_ledger_changes_no_trajectory() {
    let mut setup = crowd(9, 1.5);
    let without = bits(&run(&setup, 200));
    setup.ledger = true;
    assert_eq!(without, bits(&run(&setup, 200)));
}

#[test]
fn a_periodic_axis_shorter_than_two_cutoffs_is_refused() {
    let mut setup = crowd(4, 1.0);
    setup.domain.length.y = 4.1e-3;
    let error = Simulation::new(&setup, MODEL).err().unwrap().to_string();
    assert!(error.contains("periodic axis y is 0.0041 m long: at least two cutoffs"), "{error}");
}

#[test]
fn a_periodic_bed_keeps_its_momentum() {
    let setup = crowd(10, 1.5);
    let momentum = |simulation: &Simulation<Model>| {
        let motions = simulation.particles().motion.iter();
        motions.fold((Vector::zeros(), 0.0), |(sum, scale), motion| {
            (sum + motion.velocity * motion.mass, scale + motion.velocity.norm() * motion.mass)
        })
    };
    let (before, scale) = momentum(&run(&setup, 0));
    let (after, _) = momentum(&run(&setup, 500));
    assert!((after - before).norm() < 1e-13 * scale);
}

/// Loads by the definition: every pair, every image.
fn all_pairs(setup: &Setup, simulation: &Simulation<Composed<Hertz, Frictionless, Free>>) -> Vec<Vector> {
    let places: Vec<Vector> = simulation.particles().positions().collect();
    let velocities: Vec<Vector> = simulation.particles().velocities().collect();
    let length = setup.domain.length;
    let mut forces = vec![Vector::zeros(); places.len()];
    for i in 0..places.len() {
        for j in 0..i {
            let mut branch = places[i] - places[j];
            for axis in 0..3 {
                branch[axis] -= length[axis] * (branch[axis] / length[axis]).round();
            }
            let (one, other) = (&setup.particles[i], &setup.particles[j]);
            let overlap = one.radius + other.radius - branch.norm();
            if overlap > 0.0 {
                let normal = branch / branch.norm();
                let reduced = |a: f64, b: f64| a * b / (a + b);
                let pair = &setup.pairs[0];
                let spot = (reduced(one.radius, other.radius) * overlap).sqrt();
                let slope = 2.0 * pair.effective_young * spot;
                let dashpot =
                    2.0 * (5.0f64 / 6.0).sqrt() * pair.damping_ratio * (slope * reduced(one.mass, other.mass)).sqrt();
                let force = 2.0 / 3.0 * slope * overlap - dashpot * (velocities[i] - velocities[j]).dot(&normal);
                forces[i] += normal * force.max(0.0);
                forces[j] -= normal * force.max(0.0);
            }
        }
    }
    forces
}

#[test]
fn lists_miss_no_pair() {
    // 1:4 in size, boxes from just two cutoffs on, moving for some rebuilds.
    for (edge, spread) in [(3, 1.0), (5, 4.0), (9, 4.0)] {
        let setup = crowd(edge, spread);
        let mut simulation = Simulation::new(&setup, ELASTIC).unwrap();
        simulation.advance_to(100).unwrap();
        let forces: Vec<Vector> = simulation.particles().loads().map(|load| load.force).collect();
        let scale = forces.iter().map(Vector::norm).fold(0.0, f64::max);
        // The loads belong to half-step velocities: undo the last half kick.
        let mut at_force = Simulation::new(&setup, ELASTIC).unwrap();
        at_force.advance_to(100).unwrap();
        at_force.undo_half_kick();
        for (listed, defined) in forces.iter().zip(all_pairs(&setup, &at_force)) {
            let error = (listed - defined).norm() / scale;
            assert!(error < 1e-12, "{edge} along an edge, 1:{spread}: relative error {error:e}");
        }
    }
}

#[test]
fn the_energy_of_an_elastic_gas_is_kept_at_second_order() {
    let drift = |steps: u64, dt: f64| {
        let mut setup = crowd(6, 1.0);
        setup.pairs[0].damping_ratio = 0.0;
        setup.time_step = dt;
        setup.ledger = true;
        let mut simulation = Simulation::new(&setup, ELASTIC).unwrap();
        let energies = simulation.energies();
        let before = energies.kinetic + energies.elastic;
        let mut worst = 0.0f64;
        for k in 1..=40 {
            simulation.advance_to(steps * k / 40).unwrap();
            let energies = simulation.energies();
            worst = worst.max(((energies.kinetic + energies.elastic) / before - 1.0).abs());
        }
        worst
    };
    let (coarse, fine) = (drift(200, 2e-6), drift(400, 1e-6));
    let order = (coarse / fine).log2();
    assert!((1.7..2.3).contains(&order), "order {order}, errors {coarse:e} and {fine:e}");
}

#[test]
fn a_restart_at_any_step_changes_no_bit() {
    let mut setup = crowd(11, 2.0);
    setup.ledger = true;
    let whole = bits(&run(&setup, 300));
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    let mut random = uniform(11);
    for trial in 0..6 {
        let step = (random() * 300.0) as u64;
        let mut state = Checkpoint::default();
        run(&setup, step).save(&mut state);
        let file = folder.join(format!("restart-{trial}.npz"));
        state.write(&file, "scene").unwrap();
        let state = Checkpoint::read(&file, "scene").unwrap();
        let mut simulation = Simulation::restore(&setup, MODEL, &state, &[]).unwrap();
        simulation.advance_to(300).unwrap();
        assert_eq!(whole, bits(&simulation), "restarted at step {step}");
    }
}

#[test]
fn a_damaged_or_foreign_checkpoint_is_refused() {
    let setup = crowd(3, 1.0);
    let mut state = Checkpoint::default();
    run(&setup, 5).save(&mut state);
    let file = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("damaged.npz");
    state.write(&file, "one").unwrap();
    assert!(Checkpoint::read(&file, "other").unwrap_err().to_string().contains("another scene"));
    let mut bytes = std::fs::read(&file).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&file, bytes).unwrap();
    assert!(Checkpoint::read(&file, "one").is_err());
}

#[test]
fn a_bed_is_the_same_for_the_same_seed() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("beds");
    let built = bench::cached(&folder, 200, 5, &|_, _| ()).unwrap();
    let read = bench::cached(&folder, 200, 5, &|_, _| ()).unwrap();
    assert_eq!(built.position, read.position);
    assert!((built.edge.powi(3) * 0.615 / (200.0 * 4.0 / 3.0 * std::f64::consts::PI * 1e-9) - 1.0).abs() < 1e-12);
}

#[test]
fn a_particle_of_a_dense_bed_takes_less_than_a_kilobyte() {
    let mut setup = crowd(20, 1.0);
    setup.ledger = false;
    setup.skin = Some(0.8e-3);
    let mut simulation = Simulation::new(&setup, MODEL).unwrap();
    simulation.advance_to(10).unwrap();
    let pairs: usize = simulation.contacts().blocks.iter().map(|block| block.pairs.candidates.len()).sum();
    // A jammed bed has 5.1 pairs per particle within the usual skin.
    assert!(pairs > 6 * setup.particles.len(), "{pairs} pairs");
    let bytes = simulation.bytes() / setup.particles.len();
    assert!(bytes > 200, "{bytes} bytes do not hold a particle and its pairs");
    assert!(bytes < 1000, "{bytes} bytes per particle");
}

#[test]
fn batches_and_single_contacts_have_the_same_bits() {
    // With a ledger contacts are evaluated one by one, without one several at a time; blocks of every filling.
    for edge in [2, 3, 5, 9] {
        let mut setup = crowd(edge + 1, 2.0);
        let states = [true, false].map(|ledger| {
            setup.ledger = ledger;
            bits(&run(&setup, 200))
        });
        assert!(states[0] == states[1], "{} particles", setup.particles.len());
    }
}

#[test]
fn a_selection_that_lasts_several_steps_misses_no_contact() {
    // A restart selects anew; slow and fast crowds, whose selections last long and short.
    for factor in [1e-3, 1.0, 20.0] {
        let mut setup = crowd(8, 1.3);
        for particle in &mut setup.particles {
            particle.velocity = particle.velocity.map(|component| component * factor);
        }
        let whole = run(&setup, 60);
        let mut broken = Simulation::new(&setup, MODEL).unwrap();
        for step in 1..=60 {
            broken.advance_to(step).unwrap();
            let mut saved = Checkpoint::default();
            broken.save(&mut saved);
            broken = Simulation::restore(&setup, MODEL, &saved, &[]).unwrap();
        }
        assert!(bits(&whole) == bits(&broken), "velocities times {factor}");
    }
}
