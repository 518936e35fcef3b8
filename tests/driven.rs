//! Driven particles: they follow their paths, free ones beside them stay free, the ledger knows the work of the drives,
//! and a restart changes no bit.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "tests")]

use std::path::{Path, PathBuf};

use crossgrain::Vector;
use crossgrain::case;
use crossgrain::case::scene::{Mirror, Scene, Start};
use crossgrain::path;
use crossgrain::record::Recorder;
use crossgrain::simulation::{self, Checkpoints, Options};

/// Two driven spheres and a free one that hits the first.
fn scene() -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/inputs/good/driven_pair.toml");
    case::read(&path, &[]).unwrap().load().unwrap().scenes.remove(0)
}

fn run(scene: &Scene, options: &Options) -> Recorder {
    simulation::run(scene, options, &|_| {}).unwrap()
}

fn vector(record: &Recorder, name: &str, sample: usize, particle: usize) -> Vector {
    let at = 3 * (3 * sample + particle);
    Vector::from_column_slice(&record.values(name)[at..at + 3])
}

#[test]
fn driven_particles_follow_their_paths_whatever_acts_on_them() {
    let plain = scene();
    let staggered = Scene { mirror: Mirror { start: Start::Staggered, ..Mirror::default() }, ..plain.clone() };
    for scene in [plain, staggered] {
        let record = run(&scene, &Options::threads(1));
        let mut loaded = false;
        for drive in &scene.drives {
            let path = path::Path::new(drive, scene.time_step);
            for sample in 0..=usize::try_from(scene.steps / scene.output_every).unwrap() {
                let stated = path.at(sample as u64 * scene.output_every);
                assert_eq!(vector(&record, "position", sample, drive.particle), stated.position);
                assert_eq!(vector(&record, "velocity", sample, drive.particle), stated.velocity);
                assert_eq!(vector(&record, "angular_velocity", sample, drive.particle), stated.angular_velocity);
                loaded |= vector(&record, "force", sample, drive.particle).norm() > 1e-3;
            }
        }
        assert!(loaded, "no force acts on the driven particles");
    }
}

#[test]
fn a_free_particle_rebounds_from_a_driven_one() {
    let scene = scene();
    let record = run(&scene, &Options::threads(1));
    let last = usize::try_from(scene.steps / scene.output_every).unwrap();
    assert!(vector(&record, "velocity", 0, 2).x > 0.0);
    assert!(vector(&record, "velocity", last, 2).x < 0.0);
}

/// Energy that the free particle and the contacts have gained, less the work of the drives, over what entered contacts.
fn imbalance(steps: u32) -> f64 {
    let mut scene = scene();
    // The first stage alone, straight in, without friction: nothing dissipates.
    scene.model.tangential = case::model::TangentialLaw::Frictionless {};
    scene.time_step /= f64::from(steps);
    scene.steps = scene.drives[0].legs[0].steps * u64::from(steps);
    for drive in &mut scene.drives {
        drive.legs.truncate(1);
        drive.legs[0].steps = scene.steps;
    }
    let record = run(&scene, &Options::threads(1));
    let gained = |name: &str| record.values(name).last().unwrap() - record.values(name)[0];
    let stored = gained("energy_kinetic") + gained("energy_elastic");
    assert!(gained("energy_elastic") > 1e-7);
    (stored - gained("energy_body_work")).abs() / record.last("energy_entered").unwrap()
}

#[test]
fn the_work_of_drives_closes_the_energy_balance_at_second_order() {
    let (coarse, fine) = (imbalance(1), imbalance(2));
    println!("imbalance {coarse:.2e} and at half the step {fine:.2e}");
    assert!(coarse < 1e-4);
    assert!((3.0..5.0).contains(&(coarse / fine)));
}

#[test]
fn a_restart_changes_no_bit_of_a_driven_run() {
    let scene = scene();
    let whole = run(&scene, &Options::threads(2));
    let file = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("driven.checkpoint");
    let _ = std::fs::remove_file(&file);
    // In the middle of the second stage; a second run goes on from what the first one left.
    let plan = Checkpoints { file, steps: Some(1700), interval: None };
    let options = Options { checkpoints: Some(plan), ..Options::threads(1) };
    for _ in 0..2 {
        let record = run(&scene, &options);
        for name in ["position", "velocity", "force", "torque", "energy_elastic", "energy_body_work"] {
            assert!(whole.values(name) == record.values(name), "{name}");
        }
    }
}
