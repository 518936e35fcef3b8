//! Names the engine, and its functions that measure records, by the hash of their sources: what they computed is kept
//! until they change.

use std::fs;
use std::path::{Path, PathBuf};

fn sources(folder: &Path, into: &mut Vec<PathBuf>) -> std::io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            sources(&path, into)?;
        } else {
            into.push(path);
        }
    }
    Ok(())
}

/// Gives the hash of the files to the sources as `env!(name)`.
fn name(name: &str, mut files: Vec<PathBuf>) -> std::io::Result<()> {
    files.sort();
    let mut hash = blake3::Hasher::new();
    for file in &files {
        hash.update(&fs::read(file)?);
    }
    println!("cargo:rustc-env={name}={}", hash.finalize().to_hex());
    Ok(())
}

fn main() -> std::io::Result<()> {
    let mut all = vec![PathBuf::from("Cargo.lock")];
    sources(Path::new("src"), &mut all)?;
    let mut measuring = vec![PathBuf::from("src/case/measure.rs"), "src/geometry.rs".into(), "src/domain.rs".into()];
    sources(Path::new("src/observables"), &mut measuring)?;
    println!("cargo:rerun-if-changed=src");
    println!("cargo:rerun-if-changed=Cargo.lock");
    name("CROSSGRAIN_ENGINE", all)?;
    name("CROSSGRAIN_OBSERVABLES", measuring)
}
