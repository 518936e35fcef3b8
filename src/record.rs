//! Run records: `record.json` and `columns.npz` (docs/formats.md).

pub mod checkpoint;

use std::fs::{self, File};
use std::io::BufWriter;
use std::path::Path;
use std::time::Instant;

use npyz::WriterBuilder;
use npyz::npz::NpzWriter;
use npyz::zip::DateTime;
use npyz::zip::write::FileOptions;
use serde_json::json;

use crate::Vector;
use crate::bodies::Body;
use crate::case::scene::{Scene, Start};
use crate::domain::Domain;
use crate::error::Error;
use crate::observables::energy::Ledger;
use crate::particles::Particles;
use checkpoint::Checkpoint;

/// The version of the record format.
pub const SCHEMA: u32 = 1;

/// Columns of the ledger that hold dissipated energies.
pub const DISSIPATED: [&str; 5] =
    ["energy_viscous", "energy_frictional", "energy_rolling", "energy_plastic", "energy_carried"];

/// One column of a record: unit, shape of one sample, values.
struct Column {
    name: &'static str,
    unit: &'static str,
    shape: Vec<u64>,
    values: Vec<f64>,
}

/// Collects samples of a run and writes them.
pub struct Recorder {
    header: serde_json::Value,
    started: Instant,
    time_step: f64,
    steps: Vec<i64>,
    columns: Vec<Column>,
    contacts: Option<ContactColumns>,
}

/// The contacts of all samples, one sample after the other.
#[derive(Default)]
struct ContactColumns {
    /// Number of contacts before each sample, and in all.
    start: Vec<u64>,
    /// Both sides of each contact.
    pair: Vec<u64>,
    /// Force on the first [N].
    force: Vec<f64>,
}

impl Recorder {
    /// A recorder for `scene`, with no samples.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let (particles, bodies) = (scene.particles.len() as u64, scene.bodies.len() as u64);
        let column = |name, unit, shape: &[u64]| Column { name, unit, shape: shape.to_vec(), values: Vec::new() };
        let mut columns = vec![
            column("time", "s", &[]),
            column("position", "m", &[particles, 3]),
            column("velocity", "m/s", &[particles, 3]),
            column("angular_velocity", "rad/s", &[particles, 3]),
            column("force", "N", &[particles, 3]),
            column("torque", "N m", &[particles, 3]),
            column("body_force", "N", &[bodies, 3]),
        ];
        let stored = ["energy_kinetic", "energy_elastic", "energy_gravity"];
        let received = ["energy_body_work", "energy_entered"];
        if scene.energies {
            let energies = stored.into_iter().chain(DISSIPATED).chain(received);
            columns.extend(energies.map(|name| column(name, "J", &[])));
        }
        let mut header = header(scene);
        header["columns"]["step"] = json!("-");
        let contacts = scene.contacts.then(|| ContactColumns { start: vec![0], ..ContactColumns::default() });
        if contacts.is_some() {
            for (name, unit) in [("contact_start", "-"), ("contact_pair", "-"), ("contact_force", "N")] {
                header["columns"][name] = json!(unit);
            }
        }
        for column in &columns {
            header["columns"][column.name] = json!(column.unit);
        }
        Self { header, started: Instant::now(), time_step: scene.time_step, steps: Vec::new(), columns, contacts }
    }

    /// Adds a sample.
    pub fn sample(&mut self, step: u64, particles: &Particles, domain: &Domain, bodies: &[Body], ledger: &Ledger) {
        fn flat(vectors: impl Iterator<Item = Vector>) -> Vec<f64> {
            vectors.flat_map(|v| [v.x, v.y, v.z]).collect()
        }
        let rows = [
            vec![step as f64 * self.time_step],
            flat(particles.unwrapped_positions(domain)),
            flat(particles.velocities()),
            flat(particles.angular_velocities()),
            flat(particles.loads().map(|load| load.force)),
            flat(particles.loads().map(|load| load.torque)),
            flat(bodies.iter().map(|body| body.force)),
            vec![ledger.kinetic],
            vec![ledger.elastic],
            vec![ledger.gravity],
            vec![ledger.viscous],
            vec![ledger.frictional],
            vec![ledger.rolling],
            vec![ledger.plastic],
            vec![ledger.carried],
            vec![ledger.body_work],
            vec![ledger.entered],
        ];
        self.steps.push(i64::try_from(step).unwrap_or(i64::MAX));
        for (column, row) in self.columns.iter_mut().zip(rows) {
            column.values.extend(row);
        }
    }

    /// Whether samples hold the forces of contacts.
    #[must_use]
    pub fn keeps_contacts(&self) -> bool {
        self.contacts.is_some()
    }

    /// Adds the contacts of a sample: both sides, and the force on the first [N].
    pub fn contacts(&mut self, found: Vec<([u32; 2], Vector)>) {
        let Some(columns) = &mut self.contacts else { return };
        for (pair, force) in found {
            columns.pair.extend(pair.map(u64::from));
            columns.force.extend([force.x, force.y, force.z]);
        }
        columns.start.push(columns.pair.len() as u64 / 2);
    }

    /// Adds the samples so far to a checkpoint.
    pub fn save(&self, into: &mut Checkpoint) {
        if let Some(contacts) = &self.contacts {
            into.put_counts("record_contact_start", contacts.start.clone());
            into.put_counts("record_contact_pair", contacts.pair.clone());
            into.put("record_contact_force", contacts.force.clone());
        }
        into.put_counts("record_step", self.steps.iter().map(|step| step.unsigned_abs()).collect());
        for column in &self.columns {
            into.put(&format!("record_{}", column.name), column.values.clone());
        }
    }

    /// Takes the samples of a checkpoint.
    pub fn restore(&mut self, from: &Checkpoint) {
        if let Some(contacts) = &mut self.contacts {
            contacts.start = from.get_counts("record_contact_start").to_vec();
            contacts.pair = from.get_counts("record_contact_pair").to_vec();
            contacts.force = from.get("record_contact_force").to_vec();
        }
        let steps = from.get_counts("record_step").iter();
        self.steps = steps.map(|step| i64::try_from(*step).unwrap_or(i64::MAX)).collect();
        for column in &mut self.columns {
            column.values = from.get(&format!("record_{}", column.name)).to_vec();
        }
    }

    /// Writes the record into `folder`.
    ///
    /// # Errors
    /// The folder or its files cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), Error> {
        let failed = |reason| Error::Write { file: folder.to_owned(), reason };
        fs::create_dir_all(folder).map_err(failed)?;
        self.write_columns(&folder.join("columns.npz")).map_err(failed)?;
        let mut header = self.header.clone();
        header["wall_time"] = json!(self.started.elapsed().as_secs_f64());
        let text = serde_json::to_string_pretty(&header).map_err(|error| failed(error.into()))?;
        fs::write(folder.join("record.json"), text + "\n").map_err(failed)
    }

    fn write_columns(&self, path: &Path) -> std::io::Result<()> {
        let mut archive = NpzWriter::new(BufWriter::new(File::create(path)?));
        let samples = self.steps.len() as u64;
        array(&mut archive, "step", &[samples], self.steps.iter().copied())?;
        for column in &self.columns {
            let shape: Vec<u64> = std::iter::once(samples).chain(column.shape.iter().copied()).collect();
            array(&mut archive, column.name, &shape, column.values.iter().copied())?;
        }
        if let Some(contacts) = &self.contacts {
            let signed = |values: &[u64]| values.iter().map(|value| value.cast_signed()).collect::<Vec<i64>>();
            let count = contacts.pair.len() as u64 / 2;
            array(&mut archive, "contact_start", &[samples + 1], signed(&contacts.start))?;
            array(&mut archive, "contact_pair", &[count, 2], signed(&contacts.pair))?;
            array(&mut archive, "contact_force", &[count, 3], contacts.force.iter().copied())?;
        }
        Ok(())
    }

    /// Values of the last sample of a column, for summaries.
    #[must_use]
    pub fn last(&self, name: &str) -> Option<f64> {
        self.columns.iter().find(|column| column.name == name)?.values.last().copied()
    }

    /// Contacts of all samples: where those of each sample begin and the last end, both sides, force on the first [N].
    #[must_use]
    #[expect(clippy::type_complexity, reason = "three columns")]
    pub fn contact_columns(&self) -> Option<(Vec<usize>, Vec<[u32; 2]>, &[[f64; 3]])> {
        let contacts = self.contacts.as_ref()?;
        let start = contacts.start.iter().map(|at| usize::try_from(*at).unwrap_or(usize::MAX)).collect();
        let index = |value: u64| u32::try_from(value).unwrap_or(u32::MAX);
        let pair = contacts.pair.as_chunks().0.iter().map(|[i, j]| [index(*i), index(*j)]).collect();
        Some((start, pair, contacts.force.as_chunks().0))
    }

    /// All values of a column in one row.
    #[must_use]
    pub fn values(&self, name: &str) -> &[f64] {
        self.columns.iter().find(|column| column.name == name).map_or(&[], |column| &column.values)
    }
}

fn array<T: npyz::AutoSerialize>(
    archive: &mut NpzWriter<BufWriter<File>>,
    name: &str,
    shape: &[u64],
    values: impl IntoIterator<Item = T>,
) -> std::io::Result<()> {
    let mut writer = archive
        .array(name, FileOptions::default().last_modified_time(DateTime::default()))?
        .default_dtype()
        .shape(shape)
        .begin_nd()?;
    writer.extend(values)?;
    writer.finish()
}

fn header(scene: &Scene) -> serde_json::Value {
    json!({
        "schema": SCHEMA,
        "source": "native",
        "case": scene.case,
        "variant": scene.variant,
        "seed": scene.seed,
        "refinement": scene.refinement,
        "code": {"name": "crossgrain", "version": env!("CARGO_PKG_VERSION"), "package": "crossgrain"},
        "deck_hash": "",
        "machine": std::env::consts::ARCH,
        "wall_time": 0.0,
        "time_step": scene.time_step,
        "steps": scene.steps,
        "velocity_time": match scene.mirror.start { Start::Synchronized => "synchronized", Start::Staggered => "half_step" },
        "contact_force": "exact",
        "mass": scene.particles.iter().map(|particle| particle.mass).collect::<Vec<_>>(),
        "radius": scene.particles.iter().map(|particle| particle.radius).collect::<Vec<_>>(),
        "gravity": scene.gravity,
        "bodies": scene.bodies.iter().map(|body| &body.name).collect::<Vec<_>>(),
        "columns": {},
    })
}
