//! The schema proved on paper: docs/sketches states cases of every kind that is coming. This build reads and checks them
//! all, and says which key it does not compute yet (`# refused: ...` in their first line).

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use std::path::{Path, PathBuf};

use crossgrain::case;

fn sketches() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/sketches");
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

#[test]
fn sketches_obey_the_schema_and_its_checks() {
    let paths = sketches();
    assert_eq!(paths.len(), 5);
    for path in paths {
        let stated = case::read(&path, &[]).unwrap_or_else(|error| panic!("{error}"));
        assert!(!stated.case.stages.is_empty(), "{}", path.display());
    }
}

#[test]
fn sketches_are_refused_by_the_first_key_that_this_build_does_not_compute() {
    for path in sketches() {
        let text = std::fs::read_to_string(&path).unwrap();
        let expected = text.lines().next().and_then(|line| line.strip_prefix("# refused: ")).unwrap();
        let error = case::read(&path, &[]).unwrap().load().err().map(|error| error.to_string()).unwrap_or_default();
        let wanted = format!(": {expected}: this version computes only");
        assert!(error.contains(&wanted), "{}: no `{wanted}` in: {error}", path.display());
    }
}

#[test]
fn the_published_schema_is_that_of_this_build() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/case.schema.json");
    let published: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    assert!(published == case::json_schema(), "run `crossgrain schema > docs/case.schema.json`");
}
