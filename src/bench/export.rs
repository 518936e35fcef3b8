//! A bed as files: `bed.json` (parameters), `pair.json` (mixed values of the pair), `bed.npz` (columns by id) and
//! `bed.data` (LAMMPS text, atom style sphere).

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use crate::Vector;
use crate::error::Error;
use crate::record::arrays;

use super::bed::Bed;

/// File of the pair.
pub const PAIR: &str = "pair.json";

/// Writes the files of a bed; `bed.json` comes last, so that its presence says that the others are whole.
pub fn write(bed: &Bed, folder: &Path) -> Result<(), Error> {
    let failed = |reason| Error::Write { file: folder.to_owned(), reason };
    fs::create_dir_all(folder).map_err(failed)?;
    columns(bed, &folder.join("bed.npz")).map_err(failed)?;
    fs::write(folder.join("bed.data"), lammps(bed)).map_err(failed)?;
    pair(bed, folder)?;
    let text = serde_json::to_string_pretty(bed).map_err(|error| failed(error.into()))?;
    fs::write(folder.join("bed.json"), text + "\n").map_err(failed)
}

/// Writes the mixed values of the pair, with friction: what decks of other codes are given where they take E* or G*.
pub fn pair(bed: &Bed, folder: &Path) -> Result<(), Error> {
    let failed = |reason| Error::Write { file: folder.join(PAIR), reason };
    let text = serde_json::to_string_pretty(&bed.pair(bed.friction)).map_err(|error| failed(error.into()))?;
    fs::write(folder.join(PAIR), text + "\n").map_err(failed)
}

fn columns(bed: &Bed, path: &Path) -> std::io::Result<()> {
    let mut archive = arrays::Writer::create(path)?;
    let named = [("position", &bed.position), ("velocity", &bed.velocity), ("angular_velocity", &bed.angular_velocity)];
    for (name, column) in named {
        archive.add(name, &[column.len() as u64, 3], column.iter().flat_map(|v| [v.x, v.y, v.z]))?;
    }
    archive.finish()
}

/// Reads a bed back.
pub fn read(folder: &Path) -> Result<Bed, Error> {
    let file = folder.join("bed.json");
    let text = fs::read_to_string(&file).map_err(|reason| Error::Read { file: file.clone(), reason })?;
    let bad = |message: String| Error::Parse { file: file.display().to_string(), message };
    let mut bed: Bed = serde_json::from_str(&text).map_err(|error| bad(error.to_string()))?;
    let path = folder.join("bed.npz");
    let failed = |reason| Error::Read { file: path.clone(), reason };
    let mut archive = arrays::Reader::open(&path).map_err(failed)?;
    let mut column = |name: &str| -> Result<Vec<Vector>, Error> {
        let values: Vec<f64> = archive.read(name).map_err(failed)?;
        if values.len() != 3 * bed.count {
            return Err(bad(format!("column {name} has {} values, not {}", values.len(), 3 * bed.count)));
        }
        Ok(values.chunks_exact(3).map(Vector::from_column_slice).collect())
    };
    let (position, velocity, angular) = (column("position")?, column("velocity")?, column("angular_velocity")?);
    (bed.position, bed.velocity, bed.angular_velocity) = (position, velocity, angular);
    Ok(bed)
}

fn lammps(bed: &Bed) -> String {
    let mut text = format!("{}\n\n{} atoms\n1 atom types\n\n", bed.name(), bed.count);
    for axis in ["x", "y", "z"] {
        let _ = writeln!(text, "0 {:?} {axis}lo {axis}hi", bed.edge);
    }
    text += "\nAtoms # sphere\n\n";
    for (id, x) in (1..).zip(&bed.position) {
        let _ = writeln!(text, "{id} 1 {:?} {:?} {:?} {:?} {:?}", 2.0 * bed.radius, bed.density, x.x, x.y, x.z);
    }
    text += "\nVelocities\n\n";
    for (id, (v, w)) in (1..).zip(bed.velocity.iter().zip(&bed.angular_velocity)) {
        let _ = writeln!(text, "{id} {:?} {:?} {:?} {:?} {:?} {:?}", v.x, v.y, v.z, w.x, w.y, w.z);
    }
    text
}
