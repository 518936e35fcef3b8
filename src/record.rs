//! Run records: `record.json` and `columns.npz` (docs/formats.md).

pub mod arrays;
pub mod checkpoint;

use std::fs;
use std::path::Path;
use std::time::Instant;

use serde_json::json;

use crate::Vector;
use crate::bodies::Body;
use crate::case::scene::{Scene, Start};
use crate::contacts::Living;
use crate::domain::Domain;
use crate::error::Error;
use crate::laws::memory::Memory;
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
    shape: Vec<usize>,
    values: Vec<f64>,
}

/// A whole column of a record.
#[derive(Debug)]
pub struct RecordColumn {
    /// Name.
    pub name: &'static str,
    /// Shape, samples first.
    pub shape: Vec<usize>,
    /// Values in C order.
    pub values: Values,
}

/// Values of a column.
#[derive(Debug)]
pub enum Values {
    /// Real numbers.
    Real(Vec<f64>),
    /// Counts and indices.
    Count(Vec<i64>),
}

/// Collects samples of a run and writes them.
pub struct Recorder {
    header: serde_json::Value,
    started: Instant,
    time_step: f64,
    steps: Vec<i64>,
    columns: Vec<Column>,
    contacts: Option<ContactColumns>,
    /// What samples hold beyond what all have.
    extras: Extras,
}

/// Columns that only some scenes have.
#[derive(Clone, Copy)]
struct Extras {
    temperature: bool,
    radius: bool,
    shared: bool,
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
    /// What contacts remember, where it is kept.
    states: Option<ContactStates>,
}

/// What the contacts of all samples remember.
#[derive(Default)]
struct ContactStates {
    /// Numbers of one contact.
    width: usize,
    /// Elastic normal force, positive where it repels [N].
    elastic: Vec<f64>,
    /// Largest force in the contact plane that friction allows [N].
    limit: Vec<f64>,
    /// Memory, as checkpoints have it.
    memory: Vec<f64>,
}

/// Units of the columns of contacts.
const CONTACTS: [(&str, &str); 3] = [("contact_start", "-"), ("contact_pair", "-"), ("contact_force", "N")];
/// Units of the columns of what contacts remember; the law's own page says what the numbers of its memory are.
const CONTACT_STATES: [(&str, &str); 3] = [("contact_elastic", "N"), ("contact_limit", "N"), ("contact_memory", "SI")];

/// The numbers of a memory.
#[must_use]
pub fn numbers<H: Memory>(memory: &H) -> Vec<f64> {
    let mut values = Vec::with_capacity(H::WIDTH);
    memory.save(&mut values);
    values
}

impl Recorder {
    /// A recorder for `scene`, with no samples. `shared` are names and units of what its law shares, `memory` is the number
    /// of values that a contact remembers.
    #[must_use]
    pub fn new(scene: &Scene, shared: &[(&str, &str)], memory: usize) -> Self {
        let (particles, bodies) = (scene.particles.len(), scene.bodies.len());
        let column = |name, unit, shape: &[usize]| Column { name, unit, shape: shape.to_vec(), values: Vec::new() };
        let mut columns = vec![
            column("time", "s", &[]),
            column("position", "m", &[particles, 3]),
            column("velocity", "m/s", &[particles, 3]),
            column("angular_velocity", "rad/s", &[particles, 3]),
            column("force", "N", &[particles, 3]),
            column("torque", "N m", &[particles, 3]),
            column("body_force", "N", &[bodies, 3]),
            column("body_point", "m", &[bodies, 3]),
        ];
        let stored = ["energy_kinetic", "energy_elastic", "energy_gravity"];
        let received = ["energy_body_work", "energy_entered"];
        if scene.energies {
            let energies = stored.into_iter().chain(DISSIPATED).chain(received);
            columns.extend(energies.map(|name| column(name, "J", &[])));
        }
        let extras = Extras {
            temperature: scene.temperature.is_some(),
            radius: scene.temperature.is_some() && scene.materials.iter().any(|one| one.expansion.is_some()),
            shared: !shared.is_empty(),
        };
        if extras.temperature {
            columns.push(column("temperature", "K", &[]));
        }
        if extras.radius {
            columns.push(column("radius", "m", &[particles]));
        }
        if extras.shared {
            columns.push(column("law_state", "SI", &[shared.len()]));
        }
        let mut header = header(scene);
        header["columns"]["step"] = json!("-");
        if extras.shared {
            header["law_state"] = json!(shared);
        }
        let states = scene.contact_states.then(|| ContactStates { width: memory, ..ContactStates::default() });
        let stated = states.is_some();
        let contacts = scene.contacts.then(|| ContactColumns { start: vec![0], states, ..ContactColumns::default() });
        if contacts.is_some() {
            for (name, unit) in CONTACTS.into_iter().chain(CONTACT_STATES.into_iter().filter(|_| stated)) {
                header["columns"][name] = json!(unit);
            }
        }
        for column in &columns {
            header["columns"][column.name] = json!(column.unit);
        }
        Self {
            header,
            started: Instant::now(),
            time_step: scene.time_step,
            steps: Vec::new(),
            columns,
            contacts,
            extras,
        }
    }

    /// Adds a sample; `climate` is the temperature [K] and what the law shares.
    pub fn sample(
        &mut self,
        step: u64,
        particles: &Particles,
        domain: &Domain,
        bodies: &[Body],
        ledger: &Ledger,
        (temperature, shared): (f64, &[f64]),
    ) {
        fn flat(vectors: impl Iterator<Item = Vector>) -> Vec<f64> {
            vectors.flat_map(|v| [v.x, v.y, v.z]).collect()
        }
        let mut rows = vec![
            vec![step as f64 * self.time_step],
            flat(particles.unwrapped_positions(domain)),
            flat(particles.velocities()),
            flat(particles.angular_velocities()),
            flat(particles.loads().map(|load| load.force)),
            flat(particles.loads().map(|load| load.torque)),
            flat(bodies.iter().map(|body| body.force)),
            flat(bodies.iter().map(|body| body.point)),
        ];
        if self.columns.iter().any(|column| column.name == "energy_kinetic") {
            let energies = [
                ledger.kinetic,
                ledger.elastic,
                ledger.gravity,
                ledger.viscous,
                ledger.frictional,
                ledger.rolling,
                ledger.plastic,
                ledger.carried,
                ledger.body_work,
                ledger.entered,
            ];
            rows.extend(energies.map(|energy| vec![energy]));
        }
        if self.extras.temperature {
            rows.push(vec![temperature]);
        }
        if self.extras.radius {
            rows.push(particles.radii().collect());
        }
        if self.extras.shared {
            rows.push(shared.to_vec());
        }
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

    /// Adds the contacts of a sample.
    pub fn contacts<H: Memory>(&mut self, found: &[Living<H>]) {
        let Some(columns) = &mut self.contacts else { return };
        for Living { pair, account, history } in found {
            columns.pair.extend(pair.map(u64::from));
            columns.force.extend([account.force.x, account.force.y, account.force.z]);
            if let Some(states) = &mut columns.states {
                states.elastic.push(account.normal_force - account.damping_force);
                states.limit.push(account.friction_limit);
                history.save(&mut states.memory);
            }
        }
        columns.start.push(columns.pair.len() as u64 / 2);
    }

    /// Adds the samples so far to a checkpoint.
    pub fn save(&self, into: &mut Checkpoint) {
        if let Some(contacts) = &self.contacts {
            into.put_counts("record_contact_start", contacts.start.clone());
            into.put_counts("record_contact_pair", contacts.pair.clone());
            into.put("record_contact_force", contacts.force.clone());
            if let Some(states) = &contacts.states {
                into.put("record_contact_elastic", states.elastic.clone());
                into.put("record_contact_limit", states.limit.clone());
                into.put("record_contact_memory", states.memory.clone());
            }
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
            if let Some(states) = &mut contacts.states {
                states.elastic = from.get("record_contact_elastic").to_vec();
                states.limit = from.get("record_contact_limit").to_vec();
                states.memory = from.get("record_contact_memory").to_vec();
            }
        }
        let steps = from.get_counts("record_step").iter();
        self.steps = steps.map(|step| i64::try_from(*step).unwrap_or(i64::MAX)).collect();
        for column in &mut self.columns {
            column.values = from.get(&format!("record_{}", column.name)).to_vec();
        }
    }

    /// The header and all columns.
    #[must_use]
    pub fn finish(self) -> (serde_json::Value, Vec<RecordColumn>) {
        let mut header = self.header;
        header["wall_time"] = json!(self.started.elapsed().as_secs_f64());
        let samples = self.steps.len();
        let mut columns = vec![RecordColumn { name: "step", shape: vec![samples], values: Values::Count(self.steps) }];
        columns.extend(self.columns.into_iter().map(|column| RecordColumn {
            name: column.name,
            shape: std::iter::once(samples).chain(column.shape).collect(),
            values: Values::Real(column.values),
        }));
        if let Some(contacts) = self.contacts {
            let signed = |values: Vec<u64>| Values::Count(values.into_iter().map(u64::cast_signed).collect());
            let count = contacts.pair.len() / 2;
            let start =
                RecordColumn { name: "contact_start", shape: vec![samples + 1], values: signed(contacts.start) };
            let pair = RecordColumn { name: "contact_pair", shape: vec![count, 2], values: signed(contacts.pair) };
            let values = Values::Real(contacts.force);
            columns.extend([start, pair, RecordColumn { name: "contact_force", shape: vec![count, 3], values }]);
            if let Some(ContactStates { width, elastic, limit, memory }) = contacts.states {
                let shapes = [vec![count], vec![count], vec![count, width]];
                for (((name, _), shape), values) in CONTACT_STATES.into_iter().zip(shapes).zip([elastic, limit, memory])
                {
                    columns.push(RecordColumn { name, shape, values: Values::Real(values) });
                }
            }
        }
        (header, columns)
    }

    /// Writes the record into `folder`.
    ///
    /// # Errors
    /// The folder or its files cannot be written.
    pub fn write(self, folder: &Path) -> Result<(), Error> {
        let failed = |reason| Error::Write { file: folder.to_owned(), reason };
        fs::create_dir_all(folder).map_err(failed)?;
        let (header, columns) = self.finish();
        write_columns(columns, &folder.join("columns.npz")).map_err(failed)?;
        let text = serde_json::to_string_pretty(&header).map_err(|error| failed(error.into()))?;
        fs::write(folder.join("record.json"), text + "\n").map_err(failed)
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

    /// Number of samples up to a step.
    #[must_use]
    pub fn samples_until(&self, step: u64) -> usize {
        self.steps.iter().filter(|sampled| sampled.unsigned_abs() <= step).count()
    }

    /// All values of a column in one row.
    #[must_use]
    pub fn values(&self, name: &str) -> &[f64] {
        self.columns.iter().find(|column| column.name == name).map_or(&[], |column| &column.values)
    }
}

fn write_columns(columns: Vec<RecordColumn>, path: &Path) -> std::io::Result<()> {
    let mut archive = arrays::Writer::create(path)?;
    for RecordColumn { name, shape, values } in columns {
        let shape: Vec<u64> = shape.into_iter().map(|length| length as u64).collect();
        match values {
            Values::Real(values) => archive.add(name, &shape, values)?,
            Values::Count(values) => archive.add(name, &shape, values)?,
        }
    }
    archive.finish()
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
