//! Minimal good cases load and run; every case of the package loads.

#![allow(clippy::unwrap_used, reason = "tests")]

use std::path::{Path, PathBuf};

use crossgrain::case::{self, Loaded};
use crossgrain::simulation;

fn cases(folder: &str) -> Vec<(PathBuf, Loaded)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    paths.sort();
    let load = |path: &PathBuf| case::read(path, &[]).and_then(case::Stated::load);
    paths.into_iter().map(|path| (path.clone(), load(&path).unwrap())).collect()
}

#[test]
fn minimal_cases_run() {
    let cases = cases("tests/inputs/good");
    assert_eq!(cases.len(), 8);
    for (path, loaded) in cases {
        for scene in &loaded.scenes {
            let record = simulation::run(scene, &simulation::Options::threads(1), &|_| {}).unwrap();
            let moved = record.values("position").len() > 3 * scene.particles.len();
            assert!(moved, "{}: one sample only", path.display());
            let ran = record.last("time").unwrap();
            assert!((ran / (scene.time_step * scene.steps as f64) - 1.0).abs() < 1e-12, "{}", path.display());
        }
    }
}

#[test]
fn cases_of_the_package_load() {
    let cases = cases("cross_check/cases");
    assert!(cases.len() >= 8);
    for (path, loaded) in cases {
        assert!(!loaded.scenes.is_empty(), "{}", path.display());
    }
}
