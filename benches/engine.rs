//! Times of the parts of the engine: a contact of each law, steps of a small bed, the neighbour list.
//!
//! `cargo bench` compares with its own last run; no test looks at these times.

#![allow(missing_docs, clippy::unwrap_used, reason = "a benchmark")]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};

use crossgrain::Vector;
use crossgrain::bench::{self, MODEL, bed::Bed};
use crossgrain::case::scene::SceneParticle;
use crossgrain::geometry;
use crossgrain::laws::model::{Composed, ContactModel, Free, Frictionless};
use crossgrain::laws::normal::hertz::Hertz;
use crossgrain::laws::tangential::mindlin::Mindlin;
use crossgrain::laws::{Contact, PairLaw};
use crossgrain::simulation::{Setup, Simulation};

/// Two loaded spheres that slip and spin.
fn loaded() -> Contact {
    let branch = Vector::new(1.995e-3, 2e-5, -1e-5);
    let geometry = geometry::spheres(branch, branch.norm_squared(), 1e-3, 1e-3);
    Contact {
        pair: PairLaw {
            effective_young: 5.5e7,
            effective_shear: 1.1e7,
            friction: 0.5,
            effective_radius: geometry.effective_radius(),
            effective_mass: 5e-6,
            damping_ratio: 0.2,
            ..PairLaw::default()
        },
        geometry,
        velocity: Vector::new(0.01, 0.02, -0.03),
        angular_i: Vector::new(1.0, -2.0, 3.0),
        angular_j: Vector::new(-3.0, 1.0, 2.0),
        masses: [1e-5; 2],
    }
}

fn contact<M: ContactModel<Shared = ()>>(criterion: &mut Criterion, name: &str, model: M) {
    let (contact, mut history) = (loaded(), M::History::default());
    criterion.bench_function(name, |bench| {
        bench.iter(|| model.evaluate(black_box(&contact), &(), 1e-7, &mut history).force);
    });
}

fn laws(criterion: &mut Criterion) {
    let normal = Hertz { force_cut: true };
    contact(criterion, "contact/hertz", Composed { normal, tangential: Frictionless, moments: Free });
    contact(criterion, "contact/mindlin", Composed { normal, tangential: Mindlin::plain(), moments: Free });
    contact(criterion, "contact/mindlin displacement", MODEL);
}

/// Spheres that overlap a little on a cubic lattice in a periodic box, moving and spinning.
fn lattice(edge: usize) -> Setup {
    let spacing = 1.99e-3;
    let bed = Bed::new(edge * edge * edge, 1);
    let mut setup = bed.setup(0.5);
    setup.domain.length = Vector::repeat(spacing * edge as f64);
    let mass = bed.mass();
    setup.particles = (0..bed.len())
        .map(|k| SceneParticle {
            material: 0,
            radius: bed.radius,
            mass,
            moment_of_inertia: 0.4 * mass * bed.radius * bed.radius,
            position: [k % edge, k / edge % edge, k / edge / edge].map(|cell| (cell as f64 + 0.5) * spacing),
            velocity: [7, 11, 13].map(|prime| 1e-2 * ((k * prime % 17) as f64 - 8.0)),
            angular_velocity: [5, 3, 19].map(|prime| (k * prime % 17) as f64 - 8.0),
        })
        .collect();
    setup
}

fn bed(criterion: &mut Criterion) {
    let mut simulation: Simulation<bench::Model> = Simulation::new(&lattice(16), MODEL).unwrap();
    criterion.bench_function("bed of 4096/100 steps", |bench| {
        bench.iter(|| simulation.advance_to(simulation.step() + 100).unwrap());
    });
    criterion.bench_function("bed of 4096/neighbour list", |bench| bench.iter(|| simulation.rebuild().unwrap()));
}

criterion_group!(benches, laws, bed);
criterion_main!(benches);
