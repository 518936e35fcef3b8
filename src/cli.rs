//! The command `crossgrain`.

use std::ffi::OsString;
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};

use clap::{Parser, Subcommand};
use indicatif::{ProgressBar, ProgressStyle};

use crate::bench;
use crate::case::scene::Scene;
use crate::case::{self, Loaded};
use crate::error::Error;
use crate::simulation::{self, Options};

mod job;
mod summary;

use job::Job;

/// Everything went well.
pub const SUCCESS: u8 = 0;
/// Bad input, or nothing could run.
pub const BAD_INPUT: u8 = 2;

#[derive(Parser)]
#[command(name = "crossgrain", version, about = "A discrete element code that is proved against others")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Runs a case and writes DIR/record/ and DIR/summary.json (one folder per variant where there are several).
    Run {
        /// Case file (TOML).
        case: PathBuf,
        /// Output folder.
        #[arg(long, default_value = "out")]
        out: PathBuf,
        /// Number of threads; the results have the same bits for every number.
        #[arg(long, default_value_t = 1)]
        threads: usize,
        /// Replaces a value of the case, for instance `time.step.value="1e-8 s"`.
        #[arg(long, value_name = "KEY=VALUE")]
        set: Vec<String>,
        /// Runs one variant only.
        #[arg(long)]
        variant: Option<String>,
        /// Seconds between two checkpoints.
        #[arg(long, default_value_t = 60.0)]
        checkpoint_seconds: f64,
        /// Steps between two checkpoints, besides the seconds.
        #[arg(long)]
        checkpoint_steps: Option<u64>,
    },
    /// Goes on with a run that was stopped, from its last checkpoint and to the same bits.
    Resume {
        /// Output folder of the run.
        folder: PathBuf,
        /// Number of threads, that of the run if not given.
        #[arg(long)]
        threads: Option<usize>,
    },
    /// Runs one scene (JSON) and writes its record into a folder.
    RunScene {
        /// Scene file.
        scene: PathBuf,
        /// Folder of the record.
        #[arg(long)]
        out: PathBuf,
        /// Number of threads.
        #[arg(long, default_value_t = 1)]
        threads: usize,
    },
    /// Times the engine on the jammed bed and writes DIR/bench.json.
    Bench {
        /// Output folder.
        #[arg(long, default_value = "out")]
        out: PathBuf,
        /// Folder of built beds, the output folder if not given.
        #[arg(long)]
        cache: Option<PathBuf>,
        /// Numbers of threads, one measurement each.
        #[arg(long, value_delimiter = ',', default_value = "1")]
        threads: Vec<usize>,
        /// Number of particles.
        #[arg(long, default_value_t = 32_000)]
        particles: usize,
        /// Seed of the bed.
        #[arg(long, default_value_t = 1)]
        seed: u64,
        /// Steps of one repeat.
        #[arg(long, default_value_t = 200)]
        steps: u64,
        /// Repeats; the median counts.
        #[arg(long, default_value_t = 5)]
        repeats: usize,
    },
    /// Checks a case file without running it.
    Check {
        /// Case file (TOML).
        case: PathBuf,
    },
    /// Prints a case with its variants and scenes as JSON; `run-scene` takes a scene.
    Scenes {
        /// Case file (TOML).
        case: PathBuf,
        /// Replaces a value of the case, for instance `time.step.value="1e-8 s"`.
        #[arg(long, value_name = "KEY=VALUE")]
        set: Vec<String>,
    },
    /// Prints the JSON schema of the case file.
    Schema,
}

/// Runs the command line `arguments` and returns its exit code.
pub fn run<I: IntoIterator<Item = OsString>>(arguments: I) -> u8 {
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(error) => {
            let code = if error.use_stderr() { BAD_INPUT } else { SUCCESS };
            return if error.print().is_ok() { code } else { BAD_INPUT };
        }
    };
    let mut out = std::io::stdout().lock();
    match execute(&arguments.command, &mut out) {
        Ok(()) => SUCCESS,
        Err(error) => {
            // Nothing is left to do where even the message cannot be written.
            let _ = writeln!(std::io::stderr(), "error: {error}");
            BAD_INPUT
        }
    }
}

fn execute(command: &Command, out: &mut impl Write) -> Result<(), Error> {
    let mut say =
        |text: String| writeln!(out, "{text}").map_err(|reason| Error::Write { file: "stdout".into(), reason });
    match command {
        Command::Run { case, out, threads, set, variant, checkpoint_seconds, checkpoint_steps } => {
            let loaded = case::read(case, set)?.load()?;
            let job = Job {
                name: loaded.case.name.clone(),
                threads: *threads,
                checkpoint_seconds: *checkpoint_seconds,
                checkpoint_steps: *checkpoint_steps,
                scenes: selected(&loaded, variant.as_deref())?.into_iter().cloned().collect(),
            };
            job.begin(out)?;
            job.run(out)?;
            say(format!("{}: {} scenes in {}", job.name, job.scenes.len(), out.display()))
        }
        Command::Resume { folder, threads } => {
            let mut job = Job::read(folder)?;
            job.threads = threads.unwrap_or(job.threads);
            job.run(folder)?;
            say(format!("{}: {} scenes in {}", job.name, job.scenes.len(), folder.display()))
        }
        Command::RunScene { scene, out, threads } => {
            let text = std::fs::read_to_string(scene).map_err(|reason| Error::Read { file: scene.clone(), reason })?;
            let scene: Scene = parse_scene(&scene.display().to_string(), &text)?;
            simulation::run(&scene, &Options::threads(*threads), &|_| {})?.write(out)
        }
        Command::Bench { out, cache, threads, particles, seed, steps, repeats } => {
            let progress = bar(0);
            let bed = bench::cached(cache.as_ref().unwrap_or(out), *particles, *seed, &|step, total| {
                progress.set_length(total);
                progress.set_position(step);
            })?;
            progress.finish_and_clear();
            let measured: Result<Vec<_>, _> = threads.iter().map(|n| bench::time(&bed, *n, *steps, *repeats)).collect();
            let measured = measured?;
            for one in &measured {
                let bytes = one.peak_memory_bytes.unwrap_or_default() / one.particles.max(1) as u64;
                let (wall, cpu) = (one.ns_per_particle_step, one.cpu_ns_per_particle_step.unwrap_or(f64::NAN));
                let name = format!("{}, {} threads", one.state, one.threads);
                say(format!("{name}: {wall:.1} ns per particle-step (cpu {cpu:.1}), {bytes} bytes per particle"))?;
            }
            let file = out.join("bench.json");
            let text = serde_json::to_string_pretty(&measured).unwrap_or_default();
            std::fs::create_dir_all(out)
                .and_then(|()| std::fs::write(&file, text + "\n"))
                .map_err(|reason| Error::Write { file, reason })
        }
        Command::Check { case } => {
            let loaded = case::read(case, &[])?.load()?;
            say(format!("{}: {} variants, {} scenes", loaded.case.name, loaded.variants.len(), loaded.scenes.len()))
        }
        Command::Scenes { case, set } => say(loaded_json(case, set, None)?),
        Command::Schema => say(serde_json::to_string_pretty(&case::json_schema()).unwrap_or_default()),
    }
}

/// A case with its variants and scenes as JSON; `overrides` as in [`case::read`].
///
/// # Errors
/// The case cannot be read or run.
pub fn loaded_json(path: &Path, overrides: &[String], variant: Option<&str>) -> Result<String, Error> {
    let stated = case::read(path, overrides)?;
    let loaded = variant.map_or_else(|| Ok(stated.clone()), |name| stated.clone().only(name))?.load()?;
    serde_json::to_string(&loaded)
        .map_err(|error| Error::Parse { file: path.display().to_string(), message: error.to_string() })
}

/// Reads a scene from JSON; `file` is its name in messages.
///
/// # Errors
/// The text is not a scene.
pub fn parse_scene(file: &str, text: &str) -> Result<Scene, Error> {
    serde_json::from_str(text).map_err(|error| Error::Parse { file: file.to_owned(), message: error.to_string() })
}

/// Scenes of the wanted variant at the time step of the case.
fn selected<'a>(loaded: &'a Loaded, variant: Option<&str>) -> Result<Vec<&'a Scene>, Error> {
    let plain = loaded.scenes.iter().filter(|scene| scene.refinement == 0);
    let scenes: Vec<&Scene> = plain.filter(|scene| variant.is_none_or(|name| scene.variant == name)).collect();
    if scenes.is_empty() {
        return Err(Error::UnknownVariant {
            wanted: variant.unwrap_or_default().to_owned(),
            known: loaded.variants.iter().map(|variant| variant.name.as_str()).collect::<Vec<_>>().join(" "),
        });
    }
    Ok(scenes)
}

pub(crate) fn bar(steps: u64) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} steps, {per_sec}, {eta} left");
    ProgressBar::new(steps).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
