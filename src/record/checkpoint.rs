//! Checkpoints: one file from which a run goes on to the same bits.
//!
//! A zip archive with `header.json` (version, hash of the scene, hash of every array) and raw little-endian `.npy`
//! arrays, so that `numpy.load` opens it. It is written under a temporary name, synced and renamed: a file under its
//! final name is whole, whenever the process was killed.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{Cursor, Read, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};
use zip::{CompressionMethod, ZipArchive, ZipWriter};

use crate::Vector;
use crate::case::scene::Scene;
use crate::error::Error;
use crate::laws::memory::Memory;

use super::arrays;

/// The version of the checkpoint format.
pub const VERSION: u32 = 3;
const HEADER: &str = "header.json";

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Header {
    version: u32,
    code: String,
    scene: String,
    arrays: BTreeMap<String, String>,
}

/// The state of a run as named arrays.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Checkpoint {
    reals: BTreeMap<String, Vec<f64>>,
    counts: BTreeMap<String, Vec<u64>>,
}

/// The hash that ties a checkpoint to its scene.
#[must_use]
pub fn scene_hash(scene: &Scene) -> String {
    blake3::hash(serde_json::to_string(scene).unwrap_or_default().as_bytes()).to_string()
}

impl Checkpoint {
    /// Adds an array of real numbers.
    pub fn put(&mut self, name: &str, values: Vec<f64>) {
        self.reals.insert(name.to_owned(), values);
    }

    /// Adds an array of counts.
    pub fn put_counts(&mut self, name: &str, values: Vec<u64>) {
        self.counts.insert(name.to_owned(), values);
    }

    /// Adds memories, one after the other.
    pub fn put_all<M: Memory>(&mut self, name: &str, values: impl IntoIterator<Item = M>) {
        let mut flat = Vec::new();
        for value in values {
            value.save(&mut flat);
        }
        self.put(name, flat);
    }

    /// An array of real numbers; empty if there is none.
    #[must_use]
    pub fn get(&self, name: &str) -> &[f64] {
        self.reals.get(name).map_or(&[], Vec::as_slice)
    }

    /// An array of counts; empty if there is none.
    #[must_use]
    pub fn get_counts(&self, name: &str) -> &[u64] {
        self.counts.get(name).map_or(&[], Vec::as_slice)
    }

    /// `count` memories, one after the other.
    #[must_use]
    pub fn get_all<M: Memory>(&self, name: &str, count: usize) -> Vec<M> {
        let mut values = self.get(name).iter().copied();
        (0..count).map(|_| M::restore(&mut values)).collect()
    }

    /// Vectors, one after the other.
    #[must_use]
    pub fn vectors(&self, name: &str) -> Vec<Vector> {
        self.get_all(name, self.get(name).len() / 3)
    }

    /// Writes the file.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&self, path: &Path, scene: &str) -> Result<(), Error> {
        let failed = |reason| Error::Write { file: path.to_owned(), reason };
        let bytes = self.pack(scene).map_err(failed)?;
        replace(path, &bytes).map_err(failed)
    }

    fn pack(&self, scene: &str) -> std::io::Result<Vec<u8>> {
        let mut arrays: BTreeMap<String, Vec<u8>> = BTreeMap::new();
        for (name, values) in &self.reals {
            arrays.insert(name.clone(), array(values)?);
        }
        for (name, values) in &self.counts {
            arrays.insert(name.clone(), array(values)?);
        }
        let header = Header {
            version: VERSION,
            code: env!("CARGO_PKG_VERSION").to_owned(),
            scene: scene.to_owned(),
            arrays: arrays.iter().map(|(name, bytes)| (name.clone(), blake3::hash(bytes).to_string())).collect(),
        };
        let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
        let stored = |bytes: &[u8]| arrays::options(CompressionMethod::Stored, bytes.len() as u64);
        archive.start_file(HEADER, stored(&[]))?;
        archive.write_all(&serde_json::to_vec_pretty(&header)?)?;
        for (name, bytes) in &arrays {
            archive.start_file(format!("{name}.npy"), stored(bytes))?;
            archive.write_all(bytes)?;
        }
        Ok(archive.finish()?.into_inner())
    }

    /// Reads the file and checks that it is whole and belongs to the scene.
    ///
    /// # Errors
    /// The file cannot be read, is damaged, or belongs to another scene or version.
    pub fn read(path: &Path, scene: &str) -> Result<Self, Error> {
        let failed = |reason| Error::Read { file: path.to_owned(), reason };
        let bad = |message: String| Error::Parse { file: path.display().to_string(), message };
        let mut archive = ZipArchive::new(File::open(path).map_err(failed)?).map_err(|error| bad(error.to_string()))?;
        let mut entry = |name: &str| -> Result<Vec<u8>, Error> {
            let mut file = archive.by_name(name).map_err(|error| bad(format!("{name}: {error}")))?;
            let mut bytes = Vec::new();
            file.read_to_end(&mut bytes).map_err(failed)?;
            Ok(bytes)
        };
        let header: Header = serde_json::from_slice(&entry(HEADER)?).map_err(|error| bad(error.to_string()))?;
        if header.version != VERSION {
            return Err(bad(format!("version {} of the checkpoint, this build reads {VERSION}", header.version)));
        }
        if header.scene != scene {
            return Err(bad("the checkpoint belongs to another scene".to_owned()));
        }
        let mut checkpoint = Self::default();
        for (name, hash) in &header.arrays {
            let bytes = entry(&format!("{name}.npy"))?;
            if blake3::hash(&bytes).to_string() != *hash {
                return Err(bad(format!("the array {name} is damaged")));
            }
            if let Ok(values) = npyz::NpyFile::new(&bytes[..]).and_then(npyz::NpyFile::into_vec::<f64>) {
                checkpoint.put(name, values);
            } else {
                let values = npyz::NpyFile::new(&bytes[..]).and_then(npyz::NpyFile::into_vec::<u64>);
                checkpoint.put_counts(name, values.map_err(failed)?);
            }
        }
        Ok(checkpoint)
    }
}

fn array<T: npyz::AutoSerialize + Copy>(values: &[T]) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    arrays::write(&mut bytes, &[values.len() as u64], values.iter().copied())?;
    Ok(bytes)
}

/// Gives a file new content at once: whoever reads it finds the old or the new, never a part.
///
/// # Errors
/// The file cannot be written.
pub fn replace(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let temporary = path.with_extension("partial");
    let mut file = File::create(&temporary)?;
    file.write_all(bytes)?;
    file.sync_all()?;
    drop(file);
    fs::rename(&temporary, path)?;
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        File::open(folder)?.sync_all()?;
    }
    Ok(())
}
