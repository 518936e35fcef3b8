//! Names the functions that measure records by the hash of their sources: what was measured is kept until they change.

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

fn main() -> std::io::Result<()> {
    let mut files = vec![PathBuf::from("src/case/measure.rs"), "src/geometry.rs".into(), "src/domain.rs".into()];
    sources(Path::new("src/observables"), &mut files)?;
    files.sort();
    let mut hash = blake3::Hasher::new();
    for file in &files {
        println!("cargo:rerun-if-changed={}", file.display());
        hash.update(&fs::read(file)?);
    }
    println!("cargo:rerun-if-changed=src/observables");
    println!("cargo:rustc-env=CROSSGRAIN_OBSERVABLES={}", hash.finalize().to_hex());
    Ok(())
}
