//! Speed as a number: states built from a seed, and the time of one particle-step.

pub mod bed;
mod export;

use std::path::Path;
use std::time::Instant;

use serde::Serialize;

use crate::case::scene::Start;
use crate::error::Error;
use crate::laws::model::{Composed, Free};
use crate::laws::normal::hertz::Hertz;
use crate::laws::rotation::Rotation;
use crate::laws::slider::History;
use crate::laws::tangential::mindlin::Mindlin;
use crate::laws::tangential::options::{self, Choices, CriticalShare};
use crate::simulation::{Setup, Simulation};
use bed::Bed;

/// The model of the benchmark.
pub type Model = Composed<Hertz, Mindlin<Timed, CriticalShare>, Free>;

/// The options that the codes timed beside this one share in the main: a displacement that is projected.
#[derive(Clone, Copy, Debug)]
pub struct Timed;

impl Choices for Timed {
    const FIXED: bool = true;

    #[allow(clippy::inline_always, reason = "the batch of contacts is vectorised only where laws are inlined")]
    #[inline(always)]
    fn options(&self) -> options::Options {
        options::Options {
            history: History::Displacement,
            rotation: Rotation::ProjectionRescaled,
            ..options::Options::plain()
        }
    }
}

/// Hertz, cut at zero, and Mindlin with a displacement history.
pub const MODEL: Model = Composed {
    normal: Hertz { force_cut: true },
    tangential: Mindlin { choices: Timed, dashpot: CriticalShare },
    moments: Free,
};

/// One measurement, as `bench.json` lists it.
#[derive(Clone, Debug, Serialize)]
pub struct Measurement {
    /// Name of the state.
    pub state: String,
    /// Name of the code.
    pub code: &'static str,
    /// Its version.
    pub version: &'static str,
    /// Number of threads.
    pub threads: usize,
    /// Number of particles.
    pub particles: usize,
    /// Number of living contacts at the end.
    pub contacts: usize,
    /// Steps of one repeat.
    pub steps: u64,
    /// Median over the repeats [ns].
    pub ns_per_particle_step: f64,
    /// Processor time of all threads over all repeats [ns], which a busy machine disturbs less; null where the system
    /// does not tell.
    pub cpu_ns_per_particle_step: Option<f64>,
    /// Each repeat [ns].
    pub repeats: Vec<f64>,
    /// Largest resident memory of the process since the state was read [bytes], null where the system does not tell.
    pub peak_memory_bytes: Option<u64>,
}

/// Times the bed: a warm-up, then `repeats` runs of `steps` steps.
///
/// # Errors
/// The bed cannot be simulated.
pub fn time(bed: &Bed, threads: usize, steps: u64, repeats: usize) -> Result<Measurement, Error> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| Error::Scene { scene: bed.name(), reason: error.to_string() })?;
    reset_peak_memory();
    pool.install(|| {
        let mut simulation = start(bed, bed.friction)?;
        let mut done = 100;
        simulation.advance_to(done)?;
        let mut times = Vec::with_capacity(repeats);
        let used = cpu_time();
        for _ in 0..repeats {
            let started = Instant::now();
            done += steps;
            simulation.advance_to(done)?;
            times.push(started.elapsed().as_secs_f64() * 1e9 / (steps as f64 * bed.len() as f64));
        }
        let total = steps as f64 * bed.len() as f64 * repeats as f64;
        let used = cpu_time().zip(used).map(|(after, before)| (after - before) * 1e9 / total);
        simulation.finite()?;
        let mut sorted = times.clone();
        sorted.sort_by(f64::total_cmp);
        Ok(Measurement {
            state: bed.name(),
            code: "crossgrain",
            version: env!("CARGO_PKG_VERSION"),
            threads,
            particles: bed.len(),
            contacts: simulation.contacts().living(),
            steps,
            ns_per_particle_step: sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN),
            cpu_ns_per_particle_step: used,
            repeats: times,
            peak_memory_bytes: peak_memory(),
        })
    })
}

/// A simulation that starts from a bed with the given friction [-].
///
/// # Errors
/// The bed cannot be simulated.
pub fn start(bed: &Bed, friction: f64) -> Result<Simulation<Model>, Error> {
    Simulation::new(&bed.setup(friction), MODEL)
}

impl Bed {
    /// What a simulation of the bed starts from.
    #[must_use]
    pub fn setup(&self, friction: f64) -> Setup {
        Setup {
            name: self.name(),
            domain: self.domain(),
            gravity: crate::Vector::zeros(),
            time_step: self.time_step,
            materials: 1,
            pairs: vec![self.pair(friction)],
            particles: self.particles(),
            bodies: Vec::new(),
            paths: Vec::new(),
            plane_radius_factor: None,
            cylinder_curvature: None,
            start: Start::Synchronized,
            ledger: false,
            accounts: false,
            temperature: None,
            expansions: Vec::new(),
            skin: None,
        }
    }
}

/// Reads the bed of `count` particles and `seed` from the folder `cache`, or builds it there.
///
/// # Errors
/// The bed cannot be built, read or written.
pub fn cached(cache: &Path, count: usize, seed: u64, progress: &dyn Fn(u64, u64)) -> Result<Bed, Error> {
    let bed = Bed::new(count, seed);
    let folder = cache.join(bed.name());
    if folder.join("bed.json").is_file() {
        let bed = export::read(&folder)?;
        if !folder.join(export::PAIR).is_file() {
            export::pair(&bed, &folder)?;
        }
        return Ok(bed);
    }
    let bed = bed::build(bed, progress)?;
    export::write(&bed, &folder)?;
    Ok(bed)
}

fn reset_peak_memory() {
    // Where the system has no such file the peak counts from the start of the process.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
}

fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.split_whitespace().next()?.parse::<u64>().ok().map(|kilobytes| 1024 * kilobytes)
}

/// User time of the process [s], in ticks of 10 ms.
fn cpu_time() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/stat").ok()?;
    let fields = status.rsplit_once(')')?.1;
    fields.split_whitespace().nth(11)?.parse::<f64>().ok().map(|ticks| ticks / 100.0)
}
